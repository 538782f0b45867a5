#include "sweep/outputs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- names ----------------------------------------------------------------------------------- */

static const struct {
  rot_output_kind kind;
  const char *name, *unit, *words;
} whole_run[] = {
    {ROT_OUT_STOP, "stop_time_s", "s", "time since when all is at rest; Inf: it moves at the end"},
    {ROT_OUT_PERIOD, "period_s", "s", "period of the motion in closed form; NaN: it has none"},
    {ROT_OUT_SUPPLIED, "supplied_j", "J", "energy supplied from the first time to the last"},
    {ROT_OUT_LOST, "lost_j", "J", "energy lost to resistance from the first time to the last"},
    {ROT_OUT_BALANCED, "balanced", "1", "1: all balances of the audit hold; 0: one does not"},
    {ROT_OUT_ERROR, "error", "1", "largest relative error"},
    {ROT_OUT_STEPS, "steps", "1", "accepted steps; segments of a closed form"},
};
enum { WHOLE_RUN = sizeof whole_run / sizeof *whole_run };

static const struct {
  rot_output_kind kind;
  const char *prefix, *words;
} of_column[] = {
    {ROT_OUT_FINAL, "final_", "at the last time"},
    {ROT_OUT_MAX_ABS, "max_abs_", "largest size at the times of the plan"},
    {ROT_OUT_MAX, "max_", "largest value at the times of the plan"},
    {ROT_OUT_MIN, "min_", "least value at the times of the plan"},
};
enum { OF_COLUMN = sizeof of_column / sizeof *of_column, NAME = 96 };

/* => text behind the prefix, or NULL */
static const char *behind(const char *text, const char *prefix) {
  const size_t n = strlen(prefix);
  return strncmp(text, prefix, n) ? NULL : text + n;
}

/* "stick" => event; ROT_EVENT_COUNT: scenes of the constraint have none of this name */
static size_t event_named(const rot_constraint *c, const char *name) {
  size_t i = 0;
  while (i < ROT_EVENT_COUNT &&
         (!(c->events >> i & 1u) || strcmp(rot_event_name((rot_event)i), name))) {
    i++;
  }
  return i;
}

/* name without its place in brackets => *place, from 1; 0: it has none. Returns 0 for a wrong
 * name. */
static int split_place(const char *name, char base[NAME], size_t *place) {
  const size_t n = strcspn(name, "[");
  *place = 0;
  if (n == 0 || n >= NAME) return 0;
  memcpy(base, name, n);
  base[n] = '\0';
  if (!name[n]) return 1;
  const char *at = name + n + 1;
  if (*at < '1' || *at > '9') return 0;
  while (*at >= '0' && *at <= '9' && *place < 100000000)
    *place = 10 * *place + (size_t)(*at++ - '0');
  return at[0] == ']' && at[1] == '\0';
}

static int has_energy(const rot_constraint *c) {
  size_t k = 0;
  while (k < c->n_balances && strcmp(c->balances[k].quantity, "energy")) k++;
  return k < c->n_balances;
}

/* => 1 if runs of the constraint have this number */
static int has_number(const rot_constraint *c, rot_output_kind kind) {
  if (kind == ROT_OUT_PERIOD) return c->period_s != NULL;
  return (kind != ROT_OUT_SUPPLIED && kind != ROT_OUT_LOST) || has_energy(c);
}

int rot_output_named(const rot_constraint *c, const char *name, rot_output_of *to) {
  char base[NAME];
  memset(to, 0, sizeof *to);
  if (!split_place(name, base, &to->place)) return 0;
  for (int i = 0; i < WHOLE_RUN; i++) {
    to->kind = whole_run[i].kind;
    if (strcmp(base, whole_run[i].name)) continue;
    return to->place == 0 && has_number(c, to->kind);
  }
  for (int i = 0; i < OF_COLUMN; i++) {
    const char *column = behind(base, of_column[i].prefix);
    to->kind = of_column[i].kind;
    to->at = column ? rot_run_column(c, column) : c->n_columns;
    if (to->at < c->n_columns) return !c->index || to->place > 0 ? c->index || to->place == 0 : 0;
  }
  const char *first = behind(base, "first_"), *count = behind(base, "n_");
  to->kind = first ? ROT_OUT_FIRST : ROT_OUT_COUNT;
  if (count) {
    to->at = event_named(c, count);
  } else if (first && strlen(first) > 7 && !strcmp(first + strlen(first) - 7, "_time_s")) {
    base[strlen(base) - 7] = '\0';
    to->at = event_named(c, first);
  } else {
    return 0;
  }
  return to->at < ROT_EVENT_COUNT && (c->index || to->place == 0);
}

int rot_output_audits(const rot_output_of *output) {
  return output->kind == ROT_OUT_SUPPLIED || output->kind == ROT_OUT_LOST ||
         output->kind == ROT_OUT_BALANCED;
}

void rot_outputs_walk(const rot_constraint *c, const void *scene, rot_output_visit visit,
                      void *ctx) {
  const size_t rows_each = rot_run_rows_per_time(c, scene);
  const unsigned effects = c->effects_of(scene);
  char name[NAME + 16];
  for (int k = 0; k < OF_COLUMN; k++) {
    for (size_t i = 0; i < c->n_columns; i++) {
      if (!rot_run_shows(c, scene, effects, i)) continue;
      for (size_t copy = 1; copy <= rows_each; copy++) {
        const int used =
            snprintf(name, sizeof name, "%s%s", of_column[k].prefix, c->columns[i].name);
        if (c->index && used > 0 && (size_t)used < sizeof name) {
          (void)snprintf(name + used, sizeof name - (size_t)used, "[%zu]", copy);
        }
        if (visit(name, c->columns[i].unit, of_column[k].words, ctx)) return;
      }
    }
  }
  for (size_t i = 0; i < ROT_EVENT_COUNT; i++) {
    if (!(c->events >> i & 1u)) continue;
    (void)snprintf(name, sizeof name, "first_%s_time_s", rot_event_name((rot_event)i));
    if (visit(name, "s", "time of the first event of the kind; Inf: there is none", ctx)) return;
    (void)snprintf(name, sizeof name, "n_%s", rot_event_name((rot_event)i));
    if (visit(name, "1", "number of events of the kind", ctx)) return;
  }
  for (int i = 0; i < WHOLE_RUN; i++) {
    if (whole_run[i].kind == ROT_OUT_STOP && !(c->events >> ROT_EVENT_STICK & 1u)) continue;
    if (!has_number(c, whole_run[i].kind)) continue;
    if (visit(whole_run[i].name, whole_run[i].unit, whole_run[i].words, ctx)) return;
  }
}

/* ---- values ---------------------------------------------------------------------------------- */

/* => column i of a copy (from 0) at a time; NaN where it means nothing */
static double cell_of(const rot_output_run *run, size_t i, size_t time, size_t copy) {
  const size_t at = time * run->rows_per_time + copy;
  if (!run->constraint->columns[i].flag) return ((const double *)run->column[i])[at];
  const int flag = ((const int *)run->column[i])[at];
  return flag < 0 ? (double)NAN : flag;
}

static double of_times(const rot_output_run *run, const rot_output_of *output) {
  const size_t copy = output->place ? output->place - 1 : 0;
  double found = NAN;
  if (copy >= run->rows_per_time) return found;
  /* Columns that a row does not show are not written. */
  const rot_constraint *c = run->constraint;
  if (c->columns[output->at].only_with &&
      !rot_run_shows(c, run->scene, c->effects_of(run->scene), output->at)) {
    return found;
  }
  if (output->kind == ROT_OUT_FINAL) return cell_of(run, output->at, run->n_times - 1, copy);
  for (size_t i = 0; i < run->n_times; i++) {
    double x = cell_of(run, output->at, i, copy);
    if (output->kind == ROT_OUT_MAX_ABS) x = fabs(x);
    const int beyond = output->kind == ROT_OUT_MIN ? x < found : x > found;
    if (beyond || isnan(found)) found = x;
  }
  return found;
}

/* Places of events below 0: what couples the rows of a time. */
static int is_event(const rot_output_run *run, const rot_output_of *output, size_t i) {
  const rot_events *events = &run->outcome->events;
  return events->event[i] == (rot_event)output->at &&
         (output->place == 0 || events->place[i] == (int)output->place);
}

static double of_events(const rot_output_run *run, const rot_output_of *output) {
  const rot_events *events = &run->outcome->events;
  double first = INFINITY, count = 0.0;
  for (size_t i = 0; i < events->count; i++) {
    if (!is_event(run, output, i)) continue;
    count += 1.0;
    first = fmin(first, events->time_s[i]);
  }
  return output->kind == ROT_OUT_COUNT ? count : first;
}

/* Rates are the columns of the measures "omega" and "v". */
static double stop_of(const rot_output_run *run) {
  const rot_constraint *c = run->constraint;
  const rot_events *events = &run->outcome->events;
  for (size_t i = 0; i < c->n_columns; i++) {
    const char *measure = c->columns[i].measure ? c->measures[c->columns[i].measure - 1] : "";
    if (strcmp(measure, "omega") && strcmp(measure, "v")) continue;
    for (size_t copy = 0; copy < run->rows_per_time; copy++) {
      if (cell_of(run, i, run->n_times - 1, copy) != 0.0) return INFINITY;
    }
  }
  double last = -INFINITY;
  for (size_t i = 0; i < events->count; i++) {
    if (events->event[i] == ROT_EVENT_STICK) last = fmax(last, events->time_s[i]);
  }
  return last > -INFINITY ? last : c->start_s(run->scene);
}

/* The energies and verdicts of the audit. */
typedef struct audit {
  double supplied, lost, balanced;
} audit;

static rot_status audit_of(const rot_output_run *run, audit *to) {
  const rot_constraint *c = run->constraint;
  const size_t last = run->n_times - 1, cells = c->n_columns * run->rows_per_time;
  double flow[ROT_MAX_FLOWS], error[ROT_MAX_MEASURES], term[ROT_MAX_TERMS];
  double explained[ROT_MAX_BALANCES];
  const rot_info *info = &run->outcome->info;
  const void *scene = run->scene;
  rot_store store = {0}; /* of the reduced scene, if effects are left out */
  rot_status status = ROT_OK;
  *to = (audit){NAN, NAN, 1.0};
  rot_run_cells(c, scene, run->column, 0, run->cell);
  rot_run_cells(c, scene, run->column, last, run->cell + cells);
  for (size_t i = 0; i < info->n_measures; i++) error[i] = info->measure[i].error;
  for (size_t i = 0; i < c->n_flows; i++) flow[i] = run->flow[i][last] - run->flow[i][0];
  if (run->outcome->picked.dropped && c->reduce) {
    void *solved = rot_store_get(&store, 1, c->scene_size);
    status = solved ? c->reduce(scene, run->outcome->picked.untaken, &store, solved) : ROT_ENOMEM;
    scene = solved;
  }
  const rot_span span = {{run->time_s[0], run->time_s[last]},
                         run->cell,
                         run->cell + cells,
                         flow,
                         run->flow_error,
                         error};
  if (status == ROT_OK) status = rot_run_audit(c, scene, &span, term, explained);
  for (size_t k = 0; k < c->n_balances && status == ROT_OK; k++) {
    const rot_balance_sums sums = rot_run_balance(c, scene, k, term, explained);
    if (sums.balanced < 0 && to->balanced == 1.0) to->balanced = NAN;
    if (sums.balanced == 0) to->balanced = 0.0;
    if (strcmp(c->balances[k].quantity, "energy")) continue;
    to->supplied = sums.supplied;
    to->lost = sums.dissipated;
  }
  rot_store_free(&store);
  return status;
}

rot_status rot_outputs_of(const rot_output_run *run, size_t n, const rot_output_of outputs[],
                          double value[]) {
  audit found = {NAN, NAN, NAN};
  int audited = 0;
  for (size_t i = 0; i < n; i++) {
    if (rot_output_audits(&outputs[i]) && !audited) {
      const rot_status status = audit_of(run, &found);
      if (status != ROT_OK) return status;
      audited = 1;
    }
    switch (outputs[i].kind) {
    case ROT_OUT_FIRST:
    case ROT_OUT_COUNT: value[i] = of_events(run, &outputs[i]); break;
    case ROT_OUT_STOP: value[i] = stop_of(run); break;
    case ROT_OUT_PERIOD: value[i] = run->constraint->period_s(run->scene); break;
    case ROT_OUT_SUPPLIED: value[i] = found.supplied; break;
    case ROT_OUT_LOST: value[i] = found.lost; break;
    case ROT_OUT_BALANCED: value[i] = found.balanced; break;
    case ROT_OUT_ERROR: value[i] = run->outcome->error; break;
    case ROT_OUT_STEPS: value[i] = (double)run->outcome->info.steps; break;
    default: value[i] = of_times(run, &outputs[i]);
    }
  }
  return ROT_OK;
}
