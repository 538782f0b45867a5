#include "engine/ode/system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/ode.h"
#include "ground/real.h"

/* The state: the coordinates less q0 (a small motion about a large angle keeps its digits), their
 * rates; then the flows and, where friction is dry, the drive. */
enum { MAX_DIM = 2 * ROT_SYSTEM_MAX + ROT_MAX_FLOWS + 1 };

/* Two runs solved loosely through a short, fast turn do not differ as their orders say: one of 60
 * chains was off by 22 times its figure at 1.6e-5, one of 300 hoops by 14 times at 1.7e-4. The
 * estimate of a motion with dry friction is that of kinks, which is none of orders. */
#define LOOSEST 3e-7

typedef struct motion {
  const rot_system *system;
  const void *scene;
  rot_system_start s;
  size_t dim, flows, drive; /* places in the state */
  int mode;
  double max[2]; /* |q|, |v| so far */
} motion;

typedef struct place {
  double q[ROT_SYSTEM_MAX], q_low[ROT_SYSTEM_MAX];
} place;

static rot_system_state state_of(const motion *m, const double y[], int sign, place *at) {
  for (size_t i = 0; i < m->s.n; i++) at->q[i] = rot_two_sum(m->s.q[i], y[i], &at->q_low[i]);
  return (rot_system_state){at->q, at->q_low, y + m->s.n, sign, y};
}

static rot_status slopes(double t, const double y[], double dydt[], void *ctx) {
  const motion *m = ctx;
  const size_t n = m->s.n;
  place at;
  const int held = m->s.dry && m->mode == 0;
  const rot_system_state state = state_of(m, y, m->s.dry ? m->mode : 0, &at);
  double *acceleration = dydt + n;
  rot_dry_forces forces = {0.0, 0.0, 0.0, 0.0};
  (void)t;
  memcpy(dydt, state.v, n * sizeof *dydt);
  m->system->slopes(m->scene, &state, acceleration, dydt + m->flows, &forces);
  acceleration[0] += m->s.dry ? rot_dry_left(m->s.dry, &forces, state.sign) : forces.along;
  if (m->s.dry) dydt[m->drive] = rot_dry_drive(m->s.dry, &forces);
  if (held) dydt[0] = acceleration[0] = 0.0;
  return ROT_OK;
}

static void note_state(double t, double y[], void *ctx) {
  motion *m = ctx;
  (void)t;
  for (size_t i = 0; i < m->s.n; i++) {
    m->max[0] = fmax(m->max[0], fabs(m->s.q[i] + y[i]));
    m->max[1] = fmax(m->max[1], fabs(y[m->s.n + i]));
  }
}

static rot_status fill_rows(const motion *m, size_t n, const double y[], const rot_rows *rows,
                            rot_info *info) {
  const size_t reached = info->rows_done;
  for (size_t i = 0; i < n && i < reached; i++) {
    const double *row = y + i * m->dim;
    place at;
    const rot_system_state state = state_of(m, row, (row[m->s.n] > 0.0) - (row[m->s.n] < 0.0), &at);
    m->system->row(m->scene, &state, i * m->s.rows_per_time, rows->column);
    for (size_t k = 0; rows->flow && k < m->system->n_flows; k++)
      rows->flow[k][i] = row[m->flows + k];
    for (size_t k = 0; k < 2 * m->s.n; k++) {
      if (isfinite(row[k])) continue;
      info->rows_done = i;
      return ROT_ERANGE;
    }
  }
  return ROT_OK;
}

static void new_positions(double t, double h, const double before[], double y[], void *ctx) {
  const size_t n = ((const motion *)ctx)->s.n;
  (void)t;
  for (size_t i = 0; i < n; i++) y[i] = before[i] + h * y[n + i];
}

static rot_time_scales time_scales_of_start(const rot_system *system, const void *scene,
                                            const rot_system_start *s) {
  double sizes[2] = {0.0, 0.0};
  rot_time_scales time_scales;
  for (size_t i = 0; i < s->n; i++) {
    sizes[0] = fmax(sizes[0], fabs(s->q[i]));
    sizes[1] = fmax(sizes[1], fabs(s->v[i]));
  }
  system->time_scales(scene, sizes, &time_scales);
  return time_scales;
}

/* What is left of the forces of the one coordinate, as it moves or would begin to. */
static double force_at_start(const motion *m, const double y[]) {
  place at;
  double dydt[MAX_DIM] = {0.0};
  rot_dry_forces forces = {0.0, 0.0, 0.0, 0.0};
  const rot_system_state state = state_of(m, y, 0, &at);
  m->system->slopes(m->scene, &state, dydt + m->s.n, dydt + m->flows, &forces);
  const double heading = state.v[0] != 0.0 ? state.v[0] : forces.along;
  return fabs(m->s.dry ? rot_dry_left(m->s.dry, &forces, heading > 0.0 ? 1 : -1) : forces.along);
}

rot_status rot_system_run(const rot_system *system, const void *scene, const rot_task *task,
                          rot_method method, const rot_rows *rows, const rot_hooks *hooks,
                          rot_info *info) {
  rot_system_start s = system->start(scene);
  if (s.dry && s.dry->mu_static == 0.0) s.dry = NULL;
  const size_t n = s.n, rows_n = task->n;
  const double *t = task->time_s;
  const double span = rows_n ? fmax(fabs(t[0] - s.start_s), fabs(t[rows_n - 1] - s.start_s)) : 0.0;
  motion m = {.system = system, .scene = scene, .s = s, .flows = 2 * n, .mode = 1};
  double start[MAX_DIM] = {0.0}, error[MAX_DIM] = {0.0}, largest[MAX_DIM] = {0.0};
  int offset = 0;
  m.drive = 2 * n + system->n_flows;
  m.dim = m.drive + (s.dry ? 1 : 0);
  memcpy(start + n, s.v, n * sizeof *start);
  const double rounding = 4.0 * ROT_EPS * (s.rounding + force_at_start(&m, start));
  for (size_t i = 0; i < n; i++) offset |= s.q[i] != 0.0;
  note_state(s.start_s, start, &m);
  rot_info_clear(info, rot_turning);
  double *y = malloc((rows_n ? rows_n : 1) * m.dim * sizeof *y);
  if (!y) return info->status = ROT_ENOMEM;
  /* Relative to the largest of all, which a norm of them may exceed; and to q, which may be half as
   * large as q less q0. */
  const double accuracy = (offset ? 0.5 : 1.0) / sqrt((double)n) * task->accuracy;
  const rot_ode_group groups[] = {{0, n, ROT_ODE_VECTOR}, {n, n, ROT_ODE_VECTOR}};
  const rot_ode_switch turn = {n, m.drive, s.dry ? s.dry->mu_static : 0.0};
  const double noise[] = {rounding * span, rounding};
  const rot_time_scales time_scales = time_scales_of_start(system, scene, &s);
  const rot_ode_params ode = {.dim = m.dim,
                              .controlled = 2 * n,
                              .n_groups = 2,
                              .groups = groups,
                              .rhs = slopes,
                              .ctx = &m,
                              .start_s = s.start_s,
                              .start = start,
                              .accuracy = s.dry ? accuracy : fmin(accuracy, LOOSEST),
                              .max_steps = task->max_steps,
                              .method = rot_task_method(task, method),
                              .mode = &m.mode,
                              .turn = s.dry ? &turn : NULL,
                              .log = rows->events,
                              .project = note_state,
                              .noise = noise,
                              .integrals_between = 1,
                              .kinks = s.dry != NULL,
                              .fades_s = s.dry ? 0.0 : time_scales.fades_s,
                              .settles_s = ROT_SETTLED * time_scales.fades_s,
                              .step_s = rot_ode_is_fixed(method)
                                            ? rot_fixed_task_step_s(task, s.start_s, &time_scales)
                                            : 0.0,
                              .positions = new_positions};
  rot_status status = rot_ode_run(&ode, rows_n, t, y, NULL, error, largest, hooks, info);
  if (status != ROT_EUNWIND && status != ROT_ENOMEM) {
    const rot_status filled = fill_rows(&m, rows_n, y, rows, info);
    if (filled != ROT_OK) status = filled;
  }
  for (size_t k = 0; k < 2; k++) {
    info->measure[k].largest = m.max[k];
    info->measure[k].error = error[k] + (k ? 0.0 : 4.0 * ROT_EPS * m.max[0]);
  }
  for (size_t k = 0; rows->flow_error && k < system->n_flows; k++) {
    rows->flow_error[k] = 2.0 * error[2 + k];
  }
  free(y);
  return info->status = status;
}

double rot_system_cost_s(const rot_system *system, const rot_model *model, const void *scene,
                         const rot_query *query, int implicit) {
  const rot_system_start s = system->start(scene);
  const double span = query->n ? fabs(query->time_s[query->n - 1] - s.start_s) : 0.0;
  const rot_time_scales time_scales = time_scales_of_start(system, scene, &s);
  const double swings = fmin(0.1 * time_scales.swing_rad_per_s * span, 1e300);
  const double fades = fmin(span / time_scales.fades_s, 1e300);
  const double steps = 30.0 + (implicit ? log1p(fades) : fades) +
                       pow(fmax(query->accuracy, model->promise), -1.0 / 8.5) * swings;
  /* Matrices of the growth of errors and of implicit steps: 16 links take 3 and 25 times as long
   * as in proportion to their number. */
  const double n = (double)s.n, matrices = implicit ? n : (5.0 + n) / 6.0;
  return n * (steps * matrices * model->seconds[0] + (double)query->n * model->seconds[1]);
}

double rot_system_fixed_s(const rot_system *system, const rot_model *model, const void *scene,
                          const rot_query *query) {
  const rot_system_start s = system->start(scene);
  const rot_time_scales time_scales = time_scales_of_start(system, scene, &s);
  return rot_fixed_cost_s(model, query, s.start_s, 0, &time_scales);
}
