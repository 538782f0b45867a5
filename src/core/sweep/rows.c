#include "sweep/rows.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/outputs.h"

const char *rot_row_status_name(int status) {
  if (status == ROT_OK) return "ok";
  if (status > 0 && status < ROT_STATUS_COUNT) return rot_status_kind((rot_status)status);
  return status == ROT_ROW_NO_MODEL ? "model" : status == ROT_ROW_COUNT ? "count" : NULL;
}

struct rot_rows_worker {
  const rot_row_plan *plan;
  const rot_constraint *constraint;
  const rot_model *named; /* of all rows; NULL: each has the cheapest */
  int steps;              /* 1: the named model steps in time, or it is not known which runs */
  rot_task task;          /* of all rows, but for the times */
  rot_variants *variants;
  rot_output_of *outputs;
  const char **paths;      /* without the time */
  size_t n_paths, time_at; /* the place of the time among the inputs; n_inputs: it does not vary */
  size_t rows_per_time, max_times;
  int audits;                    /* an output needs flows */
  void *column[ROT_MAX_COLUMNS]; /* one after another */
  size_t cells;
  double *flow[ROT_MAX_FLOWS], flow_error[ROT_MAX_FLOWS];
  double *time_s, *cell;
  rot_store store;
};

static int has_input(const rot_object *scene, const char *name) {
  return rot_input_named(scene->n, scene->inputs, name) < scene->n;
}

static rot_status open_memory(rot_rows_worker *w) {
  const rot_constraint *c = w->constraint;
  const size_t each = w->max_times * w->rows_per_time;
  if (w->max_times > SIZE_MAX / 1024 / w->rows_per_time) return ROT_ENOMEM;
  w->cells = c->n_columns * each;
  double *columns = rot_store_get(&w->store, w->cells, sizeof *columns);
  double *flows = rot_store_get(&w->store, c->n_flows * w->max_times, sizeof *flows);
  w->time_s = rot_store_get(&w->store, w->max_times, sizeof *w->time_s);
  w->cell = rot_store_get(&w->store, 2 * c->n_columns * w->rows_per_time, sizeof *w->cell);
  if (!columns || !flows || !w->time_s || !w->cell) return ROT_ENOMEM;
  for (size_t i = 0; i < c->n_columns; i++) w->column[i] = columns + i * each;
  for (size_t k = 0; k < c->n_flows; k++) w->flow[k] = flows + k * w->max_times;
  return ROT_OK;
}

static rot_status open_worker(rot_rows_worker *w, rot_refusal *no) {
  const rot_row_plan *plan = w->plan;
  const size_t n = plan->n_inputs;
  if (!plan->scene || !plan->scene->constraint) return rot_refuse(no, n, "it is no scene");
  w->constraint = plan->scene->constraint;
  w->named = plan->model ? rot_choice_model(w->constraint, plan->model) : NULL;
  /* Models that step in time always have their flows, as trajectory() asks for them. */
  w->steps = !w->named || w->named->error_kind == ROT_ADAPTIVE || w->named->use == ROT_BY_NAME;
  w->task = (rot_task){.accuracy = plan->accuracy,
                       .max_steps = (size_t)fmin(plan->max_steps, 1e15),
                       .asked = plan->asked};
  w->paths = rot_store_get(&w->store, n, sizeof *w->paths);
  w->outputs = rot_store_get(&w->store, plan->n_outputs, sizeof *w->outputs);
  if (!w->paths || !w->outputs) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) {
    if (w->time_at == n && !strcmp(plan->inputs[i], "time_s") &&
        !has_input(plan->scene, "time_s")) {
      w->time_at = i;
    } else {
      w->paths[w->n_paths++] = plan->inputs[i];
    }
  }
  for (size_t k = 0; k < plan->n_outputs; k++) {
    if (!rot_output_named(w->constraint, plan->outputs[k], &w->outputs[k])) {
      return rot_refuse(no, n + k, "scenes of this kind have no output `%s`", plan->outputs[k]);
    }
    w->audits |= rot_output_audits(&w->outputs[k]);
  }
  rot_status status = rot_variants_new(plan->scene, w->n_paths, w->paths, &w->variants, no);
  if (status == ROT_EVALUE && no->input == w->n_paths) {
    no->input = n + plan->n_outputs;
  } else if (status == ROT_EVALUE && no->input >= w->time_at) {
    no->input++;
  }
  if (status == ROT_OK) {
    w->rows_per_time = rot_run_rows_per_time(w->constraint, rot_variants_base(w->variants));
    status = open_memory(w);
  }
  return status;
}

rot_status rot_rows_open(const rot_row_plan *plan, rot_rows_worker **to, rot_refusal *no) {
  rot_rows_worker *w = calloc(1, sizeof *w);
  *to = NULL;
  if (!w) return ROT_ENOMEM;
  w->plan = plan;
  w->time_at = plan->n_inputs;
  w->max_times = (plan->n_times ? plan->n_times : 1) + 1; /* the start, too */
  const rot_status status = open_worker(w, no);
  if (status == ROT_OK)
    *to = w;
  else
    rot_rows_close(w);
  return status;
}

void rot_rows_close(rot_rows_worker *w) {
  if (!w) return;
  rot_variants_free(w->variants);
  rot_store_free(&w->store);
  free(w);
}

/* ---- a row ----------------------------------------------------------------------------------- */

/* => the times of a row: the start, unless the first time is before it, and those of the plan */
static size_t times_of(rot_rows_worker *w, const void *scene, double last) {
  const rot_row_plan *plan = w->plan;
  const double start = w->constraint->start_s(scene);
  size_t n = 0;
  const int varies = w->time_at < plan->n_inputs;
  const int one = plan->n_times == 0 || (varies && plan->n_times == 1);
  const double first = one || plan->time_s[0] > last ? last : plan->time_s[0];
  if (first > start) w->time_s[n++] = start;
  for (size_t i = 0; i + (varies ? 1 : 0) < plan->n_times; i++) {
    if (!varies || plan->time_s[i] <= last) w->time_s[n++] = plan->time_s[i];
  }
  if (varies) w->time_s[n++] = last;
  return n;
}

static int finite_times(const rot_rows_worker *w, const void *scene, size_t n) {
  const double start = w->constraint->start_s(scene);
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(w->time_s[i] - start) || (i && w->time_s[i] < w->time_s[i - 1])) return 0;
  }
  return 1;
}

/* Sets the inputs of a row and builds its scene. */
static rot_status build_row(rot_rows_worker *w, const double input[], const void **scene,
                            size_t *n_times, rot_refusal *no) {
  const rot_row_plan *plan = w->plan;
  double last = plan->n_times ? plan->time_s[plan->n_times - 1] : 0.0;
  size_t path = 0;
  for (size_t i = 0; i < plan->n_inputs; i++) {
    if (i == w->time_at)
      last = input[i];
    else
      rot_variants_set(w->variants, path++, input[i]);
  }
  const rot_status status = rot_variants_build(w->variants, scene, no);
  if (status != ROT_OK) return status;
  *n_times = times_of(w, *scene, last);
  return finite_times(w, *scene, *n_times)
             ? ROT_OK
             : rot_refuse(no, plan->scene->n, "the times must be finite and increase");
}

/* Flows of a closed form at the first and the last time alone, as the audit has them: between more
 * times they are rounded otherwise. The values in between stay. */
static rot_status flows_at_ends(rot_rows_worker *w, const void *scene, const rot_task *task,
                                const rot_outcome *o) {
  const size_t n = task->n;
  const double ends[] = {w->time_s[0], w->time_s[n - 1]};
  const rot_rows want = {.flow = w->flow, .flow_error = w->flow_error};
  rot_task own = *task;
  rot_outcome two;
  two.events = (rot_events){0};
  own.n = ends[0] < ends[1] ? 2 : 1;
  own.time_s = ends;
  own.asked = 1;
  own.without = o->picked.dropped ? o->picked.untaken : 0u;
  rot_run_model(w->constraint, scene, o->picked.model, &own, &want, &two, NULL);
  rot_events_free(&two.events);
  for (size_t k = 0; k < w->constraint->n_flows; k++) w->flow[k][n - 1] = w->flow[k][own.n - 1];
  return two.info.status;
}

static int run_row(rot_rows_worker *w, const void *scene, size_t n, rot_outcome *o, double output[],
                   double *error) {
  const rot_row_plan *plan = w->plan;
  const rot_constraint *c = w->constraint;
  const int flows = w->audits || w->steps;
  rot_task task = w->task;
  task.n = n;
  task.time_s = w->time_s;
  task.max_steps += n;
  const rot_rows want = {.column = w->column,
                         .cells = w->cells,
                         .flow = flows ? w->flow : NULL,
                         .flow_error = flows ? w->flow_error : NULL};
  if (plan->model && !w->named) return ROT_ROW_NO_MODEL;
  const rot_run_end end = w->named ? rot_run_named(c, scene, w->named, &task, 0.0, &want, o, NULL)
                                   : rot_run(c, scene, NULL, &task, 0.0, &want, o, NULL);
  if (end != ROT_RUN_DONE) return ROT_ROW_NO_MODEL;
  if (o->info.status != ROT_OK) return (int)o->info.status;
  if (isinf(o->error)) return ROT_ERANGE;
  if (w->audits && !w->steps && n > 2) {
    const rot_status status = flows_at_ends(w, scene, &task, o);
    if (status != ROT_OK) return (int)status;
  }
  const rot_output_run run = {.constraint = c,
                              .scene = scene,
                              .outcome = o,
                              .n_times = n,
                              .rows_per_time = w->rows_per_time,
                              .column = w->column,
                              .time_s = w->time_s,
                              .flow = w->flow,
                              .flow_error = w->flow_error,
                              .cell = w->cell};
  *error = o->error;
  return (int)rot_outputs_of(&run, plan->n_outputs, w->outputs, output);
}

int rot_rows_run(rot_rows_worker *w, const double input[], double output[], double *error,
                 const rot_model **model, rot_refusal *no) {
  rot_outcome o;
  rot_refusal own;
  const void *scene;
  size_t n = 0;
  o.events = (rot_events){0};
  *error = NAN;
  if (model) *model = NULL;
  int status = (int)build_row(w, input, &scene, &n, no ? no : &own);
  if (status == ROT_OK && rot_run_rows_per_time(w->constraint, scene) != w->rows_per_time) {
    status = ROT_ROW_COUNT;
  }
  if (status == ROT_OK) status = run_row(w, scene, n, &o, output, error);
  rot_events_free(&o.events);
  if (status == ROT_OK) {
    if (model) *model = o.model;
    return status;
  }
  *error = NAN;
  for (size_t k = 0; k < w->plan->n_outputs; k++) output[k] = NAN;
  return status;
}

/* ---- the model of all rows ------------------------------------------------------------------- */

const rot_model *rot_rows_model(rot_rows_worker *w, size_t n, const double *const input[],
                                size_t *taken) {
  const rot_constraint *c = w->constraint;
  size_t takes[ROT_MAX_MODELS] = {0};
  double cost[ROT_MAX_MODELS] = {0.0};
  double *row = malloc((w->plan->n_inputs + 1) * sizeof *row);
  *taken = 0;
  for (size_t i = 0; i < n && row; i++) {
    rot_candidate all[ROT_MAX_MODELS];
    rot_refusal no;
    const void *scene;
    size_t times = 0;
    for (size_t k = 0; k < w->plan->n_inputs; k++) row[k] = input[k][i];
    if (build_row(w, row, &scene, &times, &no) != ROT_OK) continue;
    const rot_query query = {times, w->time_s, w->plan->accuracy, 0.0};
    const size_t found = rot_choice_candidates(c, scene, &query, all);
    for (size_t m = 0; m < found; m++) {
      if (!all[m].applies || all[m].model->use != ROT_FREELY) continue;
      const size_t place = (size_t)(all[m].model - c->models);
      takes[place]++;
      cost[place] += all[m].cost_s;
    }
  }
  free(row);
  const rot_model *best = NULL;
  for (size_t m = 0; m < c->n_models; m++) {
    if (takes[m] == 0) continue;
    const size_t at = best ? (size_t)(best - c->models) : 0;
    if (!best || takes[m] > takes[at] || (takes[m] == takes[at] && cost[m] < cost[at])) {
      best = &c->models[m];
    }
  }
  if (best) *taken = takes[best - c->models];
  return best;
}
