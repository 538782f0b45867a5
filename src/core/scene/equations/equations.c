#include "scene/equations/equations.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/fixed.h"
#include "engine/ode/ode.h"
#include "ground/real.h"

enum { MAX = ROT_MAX_MEASURES };

typedef struct equations {
  size_t n;
  double y0[MAX];
  int position[MAX]; /* of each state */
  int positions;     /* some are given */
  rot_law rates;
  double start;
} equations;

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { RATES, STATES, POSITIONS, START };

static const rot_input inputs[] = {
    {"f", "", ROT_INPUT_LAW | ROT_INPUT_RATES, 1, ROT_NO_DOMAIN, NAN,
     "the rates of the states, of time_s and the states", NULL},
    {"start", "", ROT_INPUT_NUMBERS, 1, ROT_NO_DOMAIN, NAN, "the states at start_s, 1 to 16", NULL},
    {"positions", "1", ROT_INPUT_NUMBERS, 0, 1.0, MAX, 0, NAN,
     "which states are positions, counted from 1: for semi-implicit steps", NULL},
    ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds")};

static rot_status read_positions(const rot_given *given, equations *e, rot_refusal *no) {
  size_t count = 0;
  for (size_t i = 0; i < given->n && given->is; i++) {
    const double at = given->x[i];
    if (at != floor(at) || !(at >= 1.0 && at <= (double)e->n)) {
      return rot_refuse(no, POSITIONS, "must be numbers of states, 1 to %zu", e->n);
    }
    count += !e->position[(size_t)at - 1];
    e->position[(size_t)at - 1] = 1;
  }
  if (count == e->n) return rot_refuse(no, POSITIONS, "must leave a state that is no position");
  e->positions = count > 0;
  return ROT_OK;
}

static rot_status build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  equations *e = to;
  (void)store;
  memset(e, 0, sizeof *e);
  if (given[RATES].is != ROT_INPUT_LAW) return rot_refuse(no, RATES, "must be a function");
  e->rates = given[RATES].law;
  e->n = given[STATES].n;
  if (e->n < 1 || e->n > MAX) {
    return rot_refuse(no, STATES, "must have 1 to %d numbers; it has %zu", MAX, e->n);
  }
  memcpy(e->y0, given[STATES].x, e->n * sizeof *e->y0);
  e->start = rot_input_number(inputs, given, START);
  return read_positions(&given[POSITIONS], e, no);
}

static double start_s(const void *scene) { return ((const equations *)scene)->start; }

/* ---- columns and measures -------------------------------------------------------------------- */

#define EACH(X)                                                                                    \
  X(1), X(2), X(3), X(4), X(5), X(6), X(7), X(8), X(9), X(10), X(11), X(12), X(13), X(14), X(15),  \
      X(16)
#define NAME(i) "y_" #i
#define COLUMN(i)                                                                                  \
  { NAME(i), 0, ROT_AS_SHOWN, "", i, 0 }

static const char *const names[MAX + 1] = {EACH(NAME), NULL};
static const rot_column_of columns[MAX] = {EACH(COLUMN)};

static uint64_t shows(const void *scene) {
  return ((uint64_t)1 << ((const equations *)scene)->n) - 1;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* Two runs solved more loosely do not differ as their orders say (engine/ode/system.c). */
#define LOOSEST 3e-7

/* Beside what the estimate finds: orbits of eccentricity 0.9 were off by 3 times that. */
#define MARGIN 5.0

typedef struct motion {
  const equations *of;
  rot_status failed; /* of a call that ends the run */
} motion;

static rot_status call(const equations *e, double t, const double y[], double rate[]) {
  double argument[1 + MAX] = {t};
  memcpy(argument + 1, y, e->n * sizeof *y);
  return e->rates.call(argument, rate, e->rates.ctx);
}

static rot_status rates(double t, const double y[], double dydt[], void *ctx) {
  motion *m = ctx;
  if (m->failed != ROT_OK) return m->failed;
  const rot_status status = call(m->of, t, y, dydt);
  if (status == ROT_EUNWIND) m->failed = status; /* nothing more is called */
  return status;
}

/* What the rounding of the states leaves uncertain of each rate, at the start: a motion that begins
 * in it would never be resolved. */
static rot_status uncertain_rates(const equations *e, double noise[]) {
  double y[MAX], rate[MAX], moved[MAX];
  rot_status status = call(e, e->start, e->y0, rate);
  memcpy(y, e->y0, e->n * sizeof *y);
  for (size_t j = 0; j < e->n && status == ROT_OK; j++) {
    const double step = 1e-6 * e->y0[j];
    y[j] = e->y0[j] + step;
    if (step != 0.0) status = call(e, e->start, y, moved);
    y[j] = e->y0[j];
    for (size_t i = 0; i < e->n && step != 0.0 && status == ROT_OK; i++) {
      const double by = 4e6 * ROT_EPS * fabs(moved[i] - rate[i]);
      if (by < INFINITY) noise[i] += by;
    }
  }
  return status == ROT_ERHS ? ROT_OK : status;
}

/* The rates of the positions where these are those before, and all else is new. */
static void new_positions(double t, double h, const double before[], double y[], void *ctx) {
  motion *m = ctx;
  const equations *e = m->of;
  double at[MAX], rate[MAX];
  for (size_t i = 0; i < e->n; i++) at[i] = e->position[i] ? before[i] : y[i];
  const rot_status status = m->failed != ROT_OK ? m->failed : call(e, t, at, rate);
  if (status != ROT_OK) m->failed = status;
  for (size_t i = 0; i < e->n; i++) {
    if (e->position[i]) y[i] = status == ROT_OK ? before[i] + h * rate[i] : NAN;
  }
}

static void fill_rows(const equations *e, size_t n, const double y[], const rot_rows *rows) {
  for (size_t k = 0; k < e->n; k++) {
    double *column = rows->column[k];
    for (size_t i = 0; i < n; i++) column[i] = y[i * e->n + k];
  }
}

/* A surface that is none, found in steep but smooth rates, is common to the two runs of the
 * estimate: a van der Pol oscillator of 1000 was off by 100 times its figure. Implicit steps are
 * chosen anew, for a smaller error and without probes: the rows differ by what they are off,
 * nearly. */
static rot_status compare(const rot_ode_params *ode, const rot_task *task, const double y[],
                          double error[], const rot_hooks *hooks, rot_info *info) {
  rot_ode_params other = *ode;
  double own[MAX], size[MAX];
  rot_info seen = *info;
  double *again = malloc((task->n + 1) * ode->dim * sizeof *again);
  if (!again) return ROT_ENOMEM;
  other.accuracy = 0.2 * ode->accuracy;
  other.method = ROT_METHOD_RADAU;
  other.resolution = 0.0;
  const rot_status status =
      rot_ode_run(&other, task->n, task->time_s, again, NULL, own, size, hooks, &seen);
  for (size_t i = 0; i < task->n * ode->dim && status == ROT_OK; i++) {
    const double difference = 2.0 * fabs(again[i] - y[i]);
    if (!(difference <= error[i % ode->dim])) error[i % ode->dim] = difference;
  }
  for (size_t k = 0; k < ode->dim && status != ROT_OK; k++) error[k] *= 100.0;
  free(again);
  info->rhs_calls += seen.rhs_calls;
  return status == ROT_EUNWIND || status == ROT_ENOMEM ? status : ROT_OK;
}

/* The times of a system that only the caller knows are unknown. */
static void time_scales(const void *scene, const double sizes[], rot_time_scales *to) {
  (void)scene, (void)sizes;
  *to = (rot_time_scales){INFINITY, 0.0};
}

static rot_status integrate(const void *scene, const rot_task *task, rot_method method,
                            const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const equations *e = scene;
  const rot_time_scales unknown = {INFINITY, 0.0};
  motion m = {e, ROT_OK};
  double error[MAX] = {0.0}, largest[MAX] = {0.0}, noise[MAX] = {0.0};
  rot_info_clear(info, names);
  info->n_measures = e->n;
  if (!rot_ode_is_fixed(method)) {
    const rot_status known = uncertain_rates(e, noise);
    if (known != ROT_OK) return info->status = known;
  }
  double *y = malloc((task->n + 1) * e->n * sizeof *y);
  if (!y) return info->status = ROT_ENOMEM;
  for (size_t k = 0; k < e->n; k++) largest[k] = fabs(e->y0[k]);
  const rot_ode_params ode = {
      .dim = e->n,
      .controlled = e->n,
      .rhs = rates,
      .ctx = &m,
      .start_s = e->start,
      .start = e->y0,
      .accuracy = fmin(task->accuracy, LOOSEST) / MARGIN,
      .max_steps = task->max_steps,
      .method = rot_task_method(task, method),
      .noise = noise,
      .fine_propagation = 1,
      .resolution = rot_ode_resolution(1, task->resolution),
      .step_s = rot_ode_is_fixed(method) ? rot_fixed_task_step_s(task, e->start, &unknown) : 0.0,
      .positions = new_positions};
  rot_status status =
      rot_ode_run(&ode, task->n, task->time_s, y, NULL, error, largest, hooks, info);
  if (status == ROT_OK && info->method == ROT_METHOD_RADAU) {
    status = compare(&ode, task, y, error, hooks, info);
  }
  if (m.failed != ROT_OK) status = m.failed;
  if (status != ROT_EUNWIND && status != ROT_ENOMEM) {
    fill_rows(e, info->rows_done < task->n ? info->rows_done : task->n, y, rows);
  }
  for (size_t k = 0; k < e->n; k++) {
    info->measure[k].largest = fmax(largest[k], fabs(e->y0[k]));
    info->measure[k].error = rot_ode_is_fixed(method) ? error[k] : MARGIN * error[k];
  }
  free(y);
  return info->status = status;
}

/* ---- effects and models ---------------------------------------------------------------------- */

static const rot_effect effects[] = {{"rates", "a right-hand side of the user's own", 0, 0}};

static unsigned effects_of(const void *scene) {
  (void)scene;
  return 1u;
}

/* How many steps these are is not known before the run. */
static double adaptive_s(const rot_model *model, const void *scene, const rot_query *query) {
  const double steps = 50.0 * pow(fmax(query->accuracy, model->promise), -1.0 / 8.5);
  (void)scene;
  return model->seconds[0] * steps * (1e-6 + query->law_s) + (double)query->n * model->seconds[1];
}

static double fixed_s(const rot_model *model, const void *scene, const rot_query *query) {
  const rot_time_scales unknown = {INFINITY, 0.0};
  return rot_fixed_cost_s(model, query, start_s(scene), 1, &unknown);
}

static const char *needs_positions(const void *scene, const rot_query *query) {
  (void)query;
  return ((const equations *)scene)->positions
             ? NULL
             : "it must know which states are positions: name them by `positions` of the scene";
}

#define ADAPTIVE(id, steps, calls)                                                                 \
  {                                                                                                \
    id, 1u, ROT_ADAPTIVE, 1e-12, ROT_FREELY, "no closed form is known: integrated, " steps, NULL,  \
        adaptive_s, {                                                                              \
      calls, 0.4e-6, 0.0, 0.0                                                                      \
    }                                                                                              \
  }

static const rot_model models[] = {
    ADAPTIVE("equations_rk8pd", "explicitly", 5.0), ADAPTIVE("equations_radau", "implicitly", 50.0),
    ROT_FIXED_MODEL("equations_euler", 1u, "explicit Euler: order 1", NULL, fixed_s, 0.25e-6),
    ROT_FIXED_MODEL("equations_semi_implicit", 1u, "semi-implicit Euler: order 1", needs_positions,
                    fixed_s, 0.25e-6),
    ROT_FIXED_MODEL("equations_rk4", 1u, "Runge-Kutta: order 4", NULL, fixed_s, 0.4e-6)};
static const rot_model_run runs[] = {
    {ROT_METHOD_RK8PD, integrate}, {ROT_METHOD_RADAU, integrate}, ROT_FIXED_METHODS(integrate)};

/* What is conserved, the caller knows. */
static void audit(const void *scene, const rot_span *span, double term[]) {
  (void)scene, (void)span, (void)term;
}

const rot_constraint rot_equations_constraint = {
    .id = "equations",
    .measures = names,
    .n_effects = ROT_COUNT(effects),
    .effects = effects,
    .effects_of = effects_of,
    .n_models = ROT_COUNT(models),
    .models = models,
    .runs = runs,
    ROT_MADE_BY("scene_equations", inputs, ROT_COUNT(inputs), build, NULL, 0),
    .scene_size = sizeof(equations),
    .start_s = start_s,
    .n_columns = ROT_COUNT(columns),
    .columns = columns,
    .shows = shows,
    .audit = audit,
    .time_scales = time_scales};
