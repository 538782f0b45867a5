#include "fit/motion.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/run.h"

/* Values of a run at the samples, and how many events are behind each of them. */
typedef struct rows {
  double *value;
  size_t *events;
  double error;
} rows;

struct rot_fit_motion {
  const rot_fit_motion_plan *plan;
  const rot_constraint *constraint;
  const rot_model *model;
  rot_variants *variants;
  double *input, *time_s; /* of the present run */
  double shift_s;
  size_t rows_per_time;
  void *column[ROT_MAX_COLUMNS]; /* one after another */
  size_t cells;
  rows base, up, down, far_up, far_down;
  int has_base;   /* base is the run of input and shift_s */
  double up_step; /* up has the input of find_step() moved by it */
  double *slope;  /* by each input and the shift, at the base */
  int *has_slope;
  size_t runs;
  size_t steps;     /* of the first run that took any */
  rot_status ended; /* what ends the fit: ROT_EUNWIND, ROT_ENOMEM; nothing runs after it */
  rot_store store;
};

static int open_rows(rot_fit_motion *m, rows *r) {
  const rot_fit_motion_plan *plan = m->plan;
  r->value = rot_store_get(&m->store, plan->n_columns * plan->n + 1, sizeof *r->value);
  r->events = rot_store_get(&m->store, plan->n + 1, sizeof *r->events);
  return r->value && r->events;
}

static rot_status open_memory(rot_fit_motion *m) {
  const rot_fit_motion_plan *plan = m->plan;
  const size_t each = (plan->n + 1) * m->rows_per_time;
  const size_t n_columns = m->constraint ? m->constraint->n_columns : 0;
  m->input = rot_store_get(&m->store, 2 * plan->n_inputs + 1, sizeof *m->input);
  m->time_s = rot_store_get(&m->store, plan->n + 1, sizeof *m->time_s);
  m->cells = n_columns * each;
  double *columns = rot_store_get(&m->store, m->cells, sizeof *columns);
  m->slope = rot_store_get(&m->store, (plan->n_inputs + 1) * plan->n_columns * plan->n + 1,
                           sizeof *m->slope);
  m->has_slope = rot_store_get(&m->store, plan->n_inputs + 1, sizeof *m->has_slope);
  if (!m->input || !m->time_s || !columns || !m->slope || !m->has_slope) return ROT_ENOMEM;
  for (size_t i = 0; i < n_columns; i++) m->column[i] = columns + i * each;
  return open_rows(m, &m->base) && open_rows(m, &m->up) && open_rows(m, &m->down) &&
                 open_rows(m, &m->far_up) && open_rows(m, &m->far_down)
             ? ROT_OK
             : ROT_ENOMEM;
}

rot_status rot_fit_motion_open(const rot_fit_motion_plan *plan, rot_fit_motion **to,
                               rot_refusal *no) {
  rot_fit_motion *m = calloc(1, sizeof *m);
  *to = NULL;
  if (!m) return ROT_ENOMEM;
  m->plan = plan;
  rot_status status = ROT_OK;
  if (!plan->run) {
    status = rot_variants_new(plan->scene, plan->n_inputs, plan->inputs, &m->variants, no);
    if (status == ROT_OK) {
      m->constraint = plan->scene->constraint;
      m->rows_per_time = rot_run_rows_per_time(m->constraint, rot_variants_base(m->variants));
    }
  }
  if (status == ROT_OK) status = open_memory(m);
  if (status == ROT_OK)
    *to = m;
  else
    rot_fit_motion_close(m);
  return status;
}

void rot_fit_motion_close(rot_fit_motion *m) {
  if (!m) return;
  rot_variants_free(m->variants);
  rot_store_free(&m->store);
  free(m);
}

const rot_model *rot_fit_motion_model(const rot_fit_motion *m) { return m->model; }
size_t rot_fit_motion_runs(const rot_fit_motion *m) { return m->runs; }

/* ---- a run ----------------------------------------------------------------------------------- */

static double cell(const rot_fit_motion *m, const rot_fit_column *of, size_t time) {
  const size_t at = time * m->rows_per_time + (of->place ? of->place - 1 : 0);
  return ((const double *)m->column[of->column])[at];
}

/* Times with the shift, the start before them: errors are relative to the motion from there on. */
static size_t times_of(rot_fit_motion *m, const void *scene, double shift_s) {
  const double start = m->constraint->start_s(scene);
  const size_t first = m->plan->n && m->plan->time_s[0] + shift_s > start;
  if (first) m->time_s[0] = start;
  for (size_t i = 0; i < m->plan->n; i++) m->time_s[first + i] = m->plan->time_s[i] + shift_s;
  return first;
}

/* Steps that a run may take, of so many times those of the first one: where the search strays, as
 * to a negative resistance, a motion can take millions: a swing's fit minutes, so 0.3 s
 * (tests/testthat/test-fit-scene.R, "a search that strays"). */
#define STRAYS    30
#define MIN_STEPS 20000

static size_t max_steps(const rot_fit_motion *m) {
  const double given = fmin(m->plan->max_steps, 1e15) + (double)m->plan->n;
  const double known = (double)(STRAYS * m->steps + MIN_STEPS + m->plan->n);
  return (size_t)(m->steps ? fmin(given, known) : given);
}

static rot_status run_scene(rot_fit_motion *m, const void *scene, double shift_s, rows *to) {
  const rot_fit_motion_plan *plan = m->plan;
  const size_t first = times_of(m, scene, shift_s);
  const rot_task task = {.n = plan->n + first,
                         .time_s = m->time_s,
                         .accuracy = plan->accuracy,
                         .max_steps = max_steps(m)};
  const rot_rows want = {.column = m->column, .cells = m->cells};
  rot_outcome o;
  m->runs++;
  o.events = (rot_events){0};
  rot_status status = ROT_OK;
  if (rot_run_rows_per_time(m->constraint, scene) != m->rows_per_time) return ROT_EVALUE;
  if (rot_run(m->constraint, scene, NULL, &task, 0.0, &want, &o, NULL) != ROT_RUN_DONE) {
    status = ROT_EVALUE;
  } else {
    status = o.info.status;
    m->model = o.model;
    if (status == ROT_OK && !m->steps) m->steps = o.info.steps;
    to->error = o.error;
  }
  for (size_t i = 0, k = 0; i < plan->n && status == ROT_OK; i++) {
    for (size_t c = 0; c < plan->n_columns; c++) {
      to->value[c * plan->n + i] = cell(m, &plan->columns[c], first + i);
    }
    while (k < o.events.count && o.events.time_s[k] <= m->time_s[first + i]) k++;
    to->events[i] = k;
  }
  rot_events_free(&o.events);
  return status;
}

/* The motion of m->input with input j moved by h, as the caller computes it. */
static rot_status run_callers(rot_fit_motion *m, size_t j, double h, rows *to) {
  const rot_fit_motion_plan *plan = m->plan;
  const size_t n = plan->n_inputs;
  double *input = m->input + n;
  for (size_t i = 0; i < n; i++) input[i] = m->input[i] + (i == j ? h : 0.0);
  const double shift_s = m->shift_s + (j == n ? h : 0.0);
  for (size_t i = 0; i < plan->n; i++) m->time_s[i] = plan->time_s[i] + shift_s;
  m->runs++;
  return plan->run(plan->record, input, plan->n, m->time_s, to->value, to->events, &to->error,
                   plan->ctx);
}

/* The same by the core (j = n_inputs: the shift). */
static rot_status run_own(rot_fit_motion *m, size_t j, double h, rows *to) {
  const size_t n = m->plan->n_inputs;
  rot_refusal no;
  const void *scene;
  for (size_t i = 0; i < n; i++) rot_variants_set(m->variants, i, m->input[i] + (i == j ? h : 0.0));
  const rot_status status = rot_variants_build(m->variants, &scene, &no);
  return status == ROT_OK ? run_scene(m, scene, m->shift_s + (j == n ? h : 0.0), to) : status;
}

static rot_status run_moved(rot_fit_motion *m, size_t j, double h, rows *to) {
  if (m->ended != ROT_OK) return m->ended;
  const rot_status status = m->plan->run ? run_callers(m, j, h, to) : run_own(m, j, h, to);
  if (status == ROT_EUNWIND || status == ROT_ENOMEM) m->ended = status;
  return status;
}

rot_status rot_fit_motion_at(rot_fit_motion *m, const double input[], double shift_s,
                             double value[], double *error) {
  const rot_fit_motion_plan *plan = m->plan;
  const size_t size = plan->n_inputs * sizeof *input;
  const int same =
      m->has_base && m->shift_s == shift_s && (!size || memcmp(m->input, input, size) == 0);
  if (!same) {
    if (size) memcpy(m->input, input, size);
    m->shift_s = shift_s;
    m->has_base = 0;
    memset(m->has_slope, 0, (plan->n_inputs + 1) * sizeof *m->has_slope);
    const rot_status status = run_moved(m, plan->n_inputs + 1, 0.0, &m->base);
    if (status != ROT_OK) return status;
    m->has_base = 1;
  }
  memcpy(value, m->base.value, plan->n_columns * plan->n * sizeof *value);
  if (error) *error = m->base.error;
  return ROT_OK;
}

/* ---- derivatives ----------------------------------------------------------------------------- */

/* The largest change of a column from the base, as a share of its largest size. */
static double change_of(const rot_fit_motion *m, const rows *moved) {
  const size_t n = m->plan->n;
  double largest = 0.0;
  for (size_t c = 0; c < m->plan->n_columns; c++) {
    double size = 0.0, change = 0.0;
    for (size_t i = 0; i < n; i++) {
      const size_t at = c * n + i;
      if (moved->events[i] != m->base.events[i]) continue;
      size = fmax(size, fmax(fabs(m->base.value[at]), fabs(moved->value[at])));
      change = fmax(change, fabs(moved->value[at] - m->base.value[at]));
    }
    if (size > 0.0) largest = fmax(largest, change / size);
  }
  return largest;
}

/* A step that x + h and x - h represent, within the domain: the side with more room if both are not
 * inside. */
static double step_in(double x, double h, double low, double high) {
  if (x + h > high || x - h < low) {
    const double up = high - x, down = x - low;
    if (up >= down) return fmin(h, 0.25 * up);
    return -fmin(h, 0.25 * down);
  }
  const volatile double beyond = x + h;
  return beyond - x;
}

/* Differences of the third order of smallness where both sides have the events of the base, of the
 * second where one side alone has them. */
static void differences(const rot_fit_motion *m, double h, const rows *up, const rows *down,
                        const rows *far_up, const rows *far_down, double slope[]) {
  const size_t n = m->plan->n;
  for (size_t i = 0; i < n; i++) {
    const size_t k = m->base.events[i];
    const int above = up && up->events[i] == k, below = down && down->events[i] == k;
    for (size_t c = 0; c < m->plan->n_columns; c++) {
      const size_t at = c * n + i;
      const double x = m->base.value[at];
      if (above == below && up && down) {
        slope[at] = (up->value[at] - down->value[at]) / (2.0 * h);
      } else if (above || !below) {
        const rows *one = up ? up : down, *two = up ? far_up : far_down;
        const double s = up ? h : -h;
        slope[at] = two && two->events[i] == k
                        ? (4.0 * one->value[at] - 3.0 * x - two->value[at]) / (2.0 * s)
                        : (one->value[at] - x) / s;
      } else {
        slope[at] = far_down && far_down->events[i] == k
                        ? (3.0 * x - 4.0 * down->value[at] + far_down->value[at]) / (2.0 * h)
                        : (x - down->value[at]) / h;
      }
    }
  }
}

/* Some sample has the events of the base on one side of it alone. */
static int one_sided(const rot_fit_motion *m, const rows *here, const rows *there) {
  for (size_t i = 0; i < m->plan->n; i++) {
    const size_t k = m->base.events[i];
    if (here->events[i] == k && there->events[i] != k) return 1;
  }
  return 0;
}

/* The step moves the motion by the cube root of its error: then the rounding error of a central
 * difference is as large as what it leaves out. *none: no step moves it by more than its errors, as
 * the mass of a pendulum, whose derivative would be rounding alone. */
static rot_status find_step(rot_fit_motion *m, size_t j, double low, double high, double *h,
                            int *none) {
  const double x = j < m->plan->n_inputs ? m->input[j] : m->shift_s;
  const double error = fmax(m->base.error, 4.0 * DBL_EPSILON), target = cbrt(error);
  double size = *h > 0.0 ? *h : fmax(target * fabs(x), 1e-9);
  m->up_step = 0.0;
  *none = 0;
  for (int round = 0; round < 40; round++) {
    const double step = step_in(x, size, low, high);
    rot_status status = step != 0.0 ? run_moved(m, j, step, &m->up) : ROT_EVALUE;
    if (m->ended != ROT_OK) return m->ended;
    if (status != ROT_OK) {
      size *= 0.1;
      if (size < DBL_EPSILON * fabs(x) + DBL_MIN) return status;
      continue;
    }
    const double change = change_of(m, &m->up);
    *none = change <= 2.0 * (error + fmax(m->up.error, 4.0 * DBL_EPSILON)) &&
            !memcmp(m->up.events, m->base.events, m->plan->n * sizeof *m->up.events);
    *h = size;
    m->up_step = step;
    if (change > 0.2 * target && change < 5.0 * target) return ROT_OK;
    if (*none && size > 1e6 * fmax(fabs(x), 1.0)) return ROT_OK;
    const int cut = fabs(step) < size && (x + size > high || x - size < low);
    if (cut && change < target) return ROT_OK; /* the domain ends */
    const double factor = change > 0.0 ? target / change : 1e3;
    size *= fmin(fmax(factor, 1e-3), 1e3);
  }
  return ROT_OK;
}

/* The run with input j moved by h; find_step() may have left it in up. */
static rot_status run_up(rot_fit_motion *m, size_t j, double h) {
  return m->up_step == h ? ROT_OK : run_moved(m, j, h, &m->up);
}

static rot_status new_slope(rot_fit_motion *m, size_t j, double low, double high, double *size,
                            double slope[]) {
  const double x = j < m->plan->n_inputs ? m->input[j] : m->shift_s;
  int none;
  rot_status status = find_step(m, j, low, high, size, &none);
  if (status != ROT_OK) return status;
  if (none) {
    memset(slope, 0, m->plan->n_columns * m->plan->n * sizeof *slope);
    return ROT_OK;
  }
  const double step = step_in(x, *size, low, high), h = fabs(step);
  const int both = x + h <= high && x - h >= low;
  if (!both) { /* at the edge of the domain: one side */
    status = run_up(m, j, step);
    if (status == ROT_OK) status = run_moved(m, j, 2.0 * step, &m->far_up);
    if (status == ROT_OK) differences(m, step, &m->up, NULL, &m->far_up, NULL, slope);
    return status;
  }
  status = run_up(m, j, h);
  if (status == ROT_OK) status = run_moved(m, j, -h, &m->down);
  if (status != ROT_OK) return status;
  const int up = one_sided(m, &m->up, &m->down), down = one_sided(m, &m->down, &m->up);
  const int has_up = up && run_moved(m, j, 2.0 * h, &m->far_up) == ROT_OK;
  const int has_down = down && run_moved(m, j, -2.0 * h, &m->far_down) == ROT_OK;
  differences(m, h, &m->up, &m->down, has_up ? &m->far_up : NULL, has_down ? &m->far_down : NULL,
              slope);
  return m->ended;
}

rot_status rot_fit_motion_slope(rot_fit_motion *m, size_t j, double low, double high, double *size,
                                double slope[]) {
  const size_t n = m->plan->n_columns * m->plan->n;
  double *own = m->slope + j * n;
  if (!m->has_slope[j]) {
    const rot_status status = new_slope(m, j, low, high, size, own);
    if (status != ROT_OK) return status;
    m->has_slope[j] = 1;
  }
  memcpy(slope, own, n * sizeof *slope);
  return ROT_OK;
}
