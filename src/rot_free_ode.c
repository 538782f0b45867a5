#include "rot_free_ode.h"

#include <math.h>
#include <stdlib.h>

#include "rot_attitude.h"
#include "rot_free_torque.h"
#include "rot_ode.h"
#include "rot_real.h"

/* The state: q since the start, in the principal axes there; L in principal axes. */
enum { MOMENTUM = 4, STATE = 7, DIM = STATE + ROT_FREE_FLOWS };

typedef struct motion {
  const rot_free_params *p;
  double q0[4]; /* of the principal axes at the start */
  double omega0[3];
  int middle;
  rot_events flips; /* of all runs, those that count */
} motion;

const char *rot_free_not_integrated(const rot_free_params *p) {
  const double *m = p->moment_kg_m2;
  return m[0] > 0.0 && m[1] > 0.0 && m[2] > 0.0 ? NULL : "the body has an axis without moment";
}

/* ---- the right-hand side --------------------------------------------------------------------- */

static void attitude_of(const motion *m, const double y[], double q[4]) {
  rot_attitude_times(m->q0, y, q);
}

static void omega_of(const motion *m, const double y[], double omega[3]) {
  for (int k = 0; k < 3; k++) omega[k] = y[MOMENTUM + k] / m->p->moment_kg_m2[k];
}

static rot_status rhs(double t, const double y[], double f[], void *ctx) {
  const motion *m = ctx;
  const double *l = y + MOMENTUM, damping = m->p->damping_per_s;
  double q[4], w[3], torque[3], space[3];
  attitude_of(m, y, q);
  omega_of(m, y, w);
  const rot_status status = rot_free_torque(m->p, t, w, q, 1, torque);
  if (status != ROT_OK) return status;
  f[0] = 0.5 * (-y[1] * w[0] - y[2] * w[1] - y[3] * w[2]);
  f[1] = 0.5 * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]);
  f[2] = 0.5 * (y[0] * w[1] + y[3] * w[0] - y[1] * w[2]);
  f[3] = 0.5 * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]);
  f[4] = l[1] * w[2] - l[2] * w[1] + torque[0] - damping * l[0];
  f[5] = l[2] * w[0] - l[0] * w[2] + torque[1] - damping * l[1];
  f[6] = l[0] * w[1] - l[1] * w[0] + torque[2] - damping * l[2];
  f[STATE] = torque[0] * w[0] + torque[1] * w[1] + torque[2] * w[2];
  f[STATE + 1] = damping * (l[0] * w[0] + l[1] * w[1] + l[2] * w[2]);
  rot_attitude_to_space(q, torque, space);
  for (int k = 0; k < 3; k++) f[STATE + 2 + k] = space[k];
  rot_attitude_to_space(q, l, space);
  for (int k = 0; k < 3; k++) f[STATE + 5 + k] = -damping * space[k];
  return ROT_OK;
}

static void renormalise(double t, double y[], void *ctx) {
  (void)t, (void)ctx;
  (void)rot_attitude_unit(y);
}

/* ---- the run --------------------------------------------------------------------------------- */

static int middle_of(const double m[3]) {
  for (int i = 0; i < 3; i++) {
    const double a = m[(i + 1) % 3], b = m[(i + 2) % 3];
    if ((m[i] > a && m[i] < b) || (m[i] < a && m[i] > b)) return i;
  }
  return -1;
}

/* A component of L passes zero in any tumbling; a flip is one of a body that turns over. */
static rot_ode_then at_zero(double t, double y[], int *mode, int forward, void *ctx) {
  motion *m = ctx;
  double w[3];
  (void)mode, (void)forward;
  omega_of(m, y, w);
  if (rot_free_flips(m->p->moment_kg_m2, w)) (void)rot_events_add(&m->flips, t, ROT_EVENT_FLIP);
  return ROT_ODE_GO_ON;
}

static int compare(const void *x, const void *y) {
  const double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

static void keep_flips(motion *m, rot_events *events) {
  size_t kept = 0;
  if (!events) return;
  if (m->flips.count) qsort(m->flips.time_s, m->flips.count, sizeof(double), compare);
  for (size_t i = 0; i < events->count; i++) {
    const double t = events->time_s[i];
    if (m->flips.count && bsearch(&t, m->flips.time_s, m->flips.count, sizeof t, compare)) {
      events->time_s[kept++] = t;
    }
  }
  events->count = kept;
}

static rot_status fill_rows(const motion *m, size_t n, const double y[],
                            const rot_free_columns *out, double *const flow[], rot_info *info) {
  const size_t reached = info->rows_done;
  for (size_t i = 0; i < n && i < reached; i++) {
    const double *row = y + i * DIM;
    double q[4], w[3];
    attitude_of(m, row, q);
    (void)rot_attitude_unit(q);
    omega_of(m, row, w);
    for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k][i] = row[STATE + k];
    const rot_status status = rot_free_write(m->p, w, q, i, out);
    if (status != ROT_OK) {
      info->rows_done = i;
      return status;
    }
  }
  return ROT_OK;
}

/* Errors of the two groups as those of the measures; L in space has that of the attitude, too. */
static void note_errors(const motion *m, const double error[], const double largest[],
                        rot_info *info) {
  const double *moment = m->p->moment_kg_m2;
  const double least = fmin(moment[0], fmin(moment[1], moment[2]));
  rot_info_measures(info, rot_free_measures);
  info->measure[ROT_FREE_ATTITUDE] = (rot_measure){error[0] + 8.0 * ROT_EPS, 1.0, 1.0, 1.0};
  info->measure[ROT_FREE_MOMENTUM].error = error[1] + largest[1] * (error[0] + 16.0 * ROT_EPS);
  info->measure[ROT_FREE_MOMENTUM].largest = largest[1];
  info->measure[ROT_FREE_OMEGA].error = error[1] / least;
}

rot_status rot_free_integrate(const rot_free_params *p, const rot_free_ode_options *options,
                              size_t n, const double time_s[], const rot_free_columns *out,
                              double *const flow[ROT_FREE_FLOWS], double flow_error[ROT_FREE_FLOWS],
                              rot_events *events, const rot_hooks *hooks, rot_info *info) {
  static const rot_ode_group groups[] = {{0, 4, ROT_ODE_QUATERNION}, {4, 3, ROT_ODE_VECTOR}};
  motion m = {.p = p, .middle = middle_of(p->moment_kg_m2)};
  double start[DIM] = {1.0}, error[DIM] = {0.0}, largest[DIM] = {0.0};
  rot_info_clear(info, rot_free_measures);
  rot_free_principal(p, m.omega0, m.q0);
  for (int k = 0; k < 3; k++) start[MOMENTUM + k] = p->moment_kg_m2[k] * m.omega0[k];
  const rot_ode_event flip = {.component = (size_t)(MOMENTUM + (m.middle < 0 ? 0 : m.middle)),
                              .name = ROT_EVENT_FLIP,
                              .then = at_zero};
  const rot_ode_params ode = {
      .dim = DIM,
      .controlled = STATE,
      .n_groups = 2,
      .groups = groups,
      .rhs = rhs,
      .ctx = &m,
      .n_breaks = p->n_breaks,
      .breaks = p->breaks_s,
      .start_s = p->start_s,
      .start = start,
      /* L in space errs by both: that of L in the body, and that of the attitude. */
      .accuracy = 0.5 * options->accuracy,
      .max_steps = options->max_steps,
      .method = options->method,
      .n_events = m.middle >= 0 && !rot_free_has_weight(p),
      .events = &flip,
      .log = events,
      .project = renormalise,
      .kinks = p->law != NULL};
  double *y = malloc((n ? n : 1) * DIM * sizeof *y);
  if (!y) return info->status = ROT_ENOMEM;
  rot_status status = rot_ode_run(&ode, n, time_s, y, NULL, error, largest, hooks, info);
  if (status == ROT_ERHS && p->law) status = ROT_ETORQUE;
  if (status != ROT_EUNWIND && status != ROT_ENOMEM) {
    const rot_status rows = fill_rows(&m, n, y, out, flow, info);
    if (rows != ROT_OK) status = rows;
  }
  note_errors(&m, error, largest, info);
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow_error[k] = 2.0 * error[2 + k];
  rot_note_value(&info->measure[ROT_FREE_OMEGA],
                 hypot(hypot(m.omega0[0], m.omega0[1]), m.omega0[2]));
  for (size_t i = 0; i < info->rows_done && i < n; i++) {
    double w[3];
    omega_of(&m, y + i * DIM, w);
    rot_note_value(&info->measure[ROT_FREE_OMEGA], hypot(hypot(w[0], w[1]), w[2]));
  }
  keep_flips(&m, events);
  rot_events_free(&m.flips);
  free(y);
  return info->status = status;
}
