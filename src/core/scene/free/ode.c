#include "scene/free/ode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/attitude.h"
#include "scene/free/rotors.h"
#include "scene/free/torque.h"
#include "engine/ode/ode.h"
#include "ground/real.h"

/* State: q since the start, in the principal axes at the start; L in principal axes; momenta of the
 * rotors that are not driven. Then the flows, without rotors all but the last. */
enum { MOMENTUM = 4, ROTORS = 7, MAX = ROTORS + ROT_FREE_MAX_ROTORS + ROT_FREE_FLOWS };

typedef struct motion {
  const rot_free_params *p;
  rot_free_rotors rotors;
  size_t state;  /* number of components of the state */
  size_t flows;  /* number of flows */
  size_t dim;    /* state + flows */
  size_t groups; /* number of groups of the state */
  double q0[4];  /* attitude of the principal axes at the start */
  int weight;    /* 1: gravity acts */
  rot_free_hung hung;
  double omega0[3]; /* principal axes */
  int middle;       /* axis of the middle moment */
  int hangs;        /* see hangs() */
  double law;       /* what rounding leaves uncertain of a law beside gravity, N m */
  double span_s;    /* from the start to the farthest row */
  rot_events seen;  /* valid events of all runs */
} motion;

/* One run at an accuracy. */
typedef struct run {
  rot_info info;
  rot_events events;
  double *y, error[MAX], largest[MAX];
  double measure[3]; /* errors of the measures */
} run;

const char *rot_free_not_integrated(const rot_free_params *p) {
  rot_free_rotors rotors;
  return rot_free_rotors_begin(p, &rotors);
}

/* ---- the right-hand side --------------------------------------------------------------------- */

static void attitude_of(const motion *m, const double y[], double q[4]) {
  rot_attitude_times(m->q0, y, q);
}

static void omega_of(const motion *m, const double y[], double omega[3]) {
  rot_free_rotors_omega(&m->rotors, y + MOMENTUM, y + ROTORS, omega);
}

/* (t, state) => rates of state and flows. */
static rot_status rhs(double t, const double y[], double f[], void *ctx) {
  const motion *m = ctx;
  const double *l = y + MOMENTUM, damping = m->p->damping_per_s;
  double q[4], w[3], torque[3], space[3];
  if (m->hangs) {
    memset(f, 0, m->dim * sizeof *f);
    return ROT_OK;
  }
  attitude_of(m, y, q);
  omega_of(m, y, w);
  const rot_status status = m->weight ? rot_free_torque_hung(m->p, &m->hung, t, w, q, y, torque)
                                      : rot_free_torque(m->p, t, w, q, torque);
  if (status != ROT_OK) return status;
  f[0] = 0.5 * (-y[1] * w[0] - y[2] * w[1] - y[3] * w[2]);
  f[1] = 0.5 * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]);
  f[2] = 0.5 * (y[0] * w[1] + y[3] * w[0] - y[1] * w[2]);
  f[3] = 0.5 * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]);
  f[4] = l[1] * w[2] - l[2] * w[1] + torque[0] - damping * l[0];
  f[5] = l[2] * w[0] - l[0] * w[2] + torque[1] - damping * l[1];
  f[6] = l[0] * w[1] - l[1] * w[0] + torque[2] - damping * l[2];
  double *flow = f + m->state;
  flow[0] = torque[0] * w[0] + torque[1] * w[1] + torque[2] * w[2];
  flow[1] = damping * (l[0] * w[0] + l[1] * w[1] + l[2] * w[2]);
  rot_attitude_to_space(q, torque, space);
  for (int k = 0; k < 3; k++) flow[2 + k] = space[k];
  rot_attitude_to_space(q, l, space);
  for (int k = 0; k < 3; k++) flow[5 + k] = -damping * space[k];
  if (!m->rotors.n) return ROT_OK;
  return rot_free_rotors_slopes(&m->rotors, t, w, q, y + ROTORS, f + ROTORS,
                                &flow[ROT_FREE_MOTOR_WORK]);
}

static void start_state(const motion *m, double y[MAX]) {
  memset(y, 0, MAX * sizeof *y);
  y[0] = 1.0;
  memcpy(y + MOMENTUM, m->rotors.momentum0, sizeof m->rotors.momentum0);
  memcpy(y + ROTORS, m->rotors.start, m->rotors.n_states * sizeof *y);
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

/* Rate of the potential energy: the power of gravity, reversed. */
static double rise(double t, const double y[], void *ctx) {
  const motion *m = ctx;
  double w[3], torque[3] = {0.0, 0.0, 0.0};
  (void)t;
  omega_of(m, y, w);
  rot_free_add_hung(m->p, &m->hung, y, torque);
  return -rot_dot(w, torque);
}

/* Logs a highest or lowest point of the centre of mass, by its rate a little later. */
static void note_turn(double t, const double y[], motion *m, rot_events *events) {
  double f[MAX], later[MAX];
  if (rhs(t, y, f, m) != ROT_OK) return;
  const double rate = hypot(hypot(f[0], f[1]), hypot(f[2], f[3]));
  const double h = 1e-6 / (rate > 0.0 ? rate : 1.0);
  for (size_t k = 0; k < m->dim; k++) later[k] = y[k] + h * f[k];
  const double up = rise(t, later, m);
  if (up != 0.0) (void)rot_events_add(events, t, up > 0.0 ? ROT_EVENT_LOWEST : ROT_EVENT_HIGHEST);
}

/* A component of L changes its sign in any tumbling; only in a body that flips it is an event. */
static rot_ode_then at_zero(double t, double y[], int *mode, int forward, void *ctx) {
  motion *m = ctx;
  (void)mode, (void)forward;
  if (m->weight) {
    note_turn(t, y, m, &m->seen);
  } else {
    double w[3];
    omega_of(m, y, w);
    if (rot_free_flips(m->p->moment_kg_m2, w)) (void)rot_events_add(&m->seen, t, ROT_EVENT_FLIP);
  }
  return ROT_ODE_GO_ON;
}

typedef struct entry {
  double time_s; /* first member: compare() casts a time to an entry */
  rot_event event;
} entry;

static int compare(const void *x, const void *y) {
  const double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

/* Reduces a log to the valid events, with the names set by at_zero(). */
static rot_status keep_seen(motion *m, rot_events *log) {
  const size_t n = m->seen.count;
  entry *list = malloc((n ? n : 1) * sizeof *list);
  size_t kept = 0;
  for (size_t i = 0; list && i < n; i++) list[i] = (entry){m->seen.time_s[i], m->seen.event[i]};
  if (list) qsort(list, n, sizeof *list, compare);
  for (size_t i = 0; list && i < log->count; i++) {
    const entry *found = bsearch(&log->time_s[i], list, n, sizeof *list, compare);
    if (!found) continue;
    log->time_s[kept] = found->time_s;
    log->event[kept++] = found->event;
  }
  log->count = kept;
  rot_events_free(&m->seen);
  free(list);
  return list ? ROT_OK : ROT_ENOMEM;
}

/* states => columns, flows. */
static rot_status fill_rows(const motion *m, size_t n, const double y[],
                            const rot_free_columns *out, double *const flow[], rot_info *info) {
  const size_t reached = info->rows_done;
  for (size_t i = 0; i < n && i < reached; i++) {
    const double *row = y + i * m->dim;
    double q[4], w[3];
    attitude_of(m, row, q);
    (void)rot_attitude_unit(q);
    omega_of(m, row, w);
    flow[ROT_FREE_MOTOR_WORK][i] = 0.0;
    for (size_t k = 0; k < m->flows; k++) flow[k][i] = row[m->state + k];
    rot_status status = rot_free_write(m->p, w, q, i, out);
    if (status == ROT_OK && m->rotors.n) {
      flow[ROT_FREE_MOTOR_WORK][i] += rot_free_rotors_driven_work(&m->rotors, w);
      status = rot_free_rotors_write(&m->rotors, w, q, row + ROTORS, i, out);
    }
    if (status != ROT_OK) {
      info->rows_done = i;
      return status;
    }
  }
  return ROT_OK;
}

/* Errors of the groups => errors of the measures. L in space also has the error of the attitude.
 * Momenta of rotors count as angular momentum. A law's rounding may have one direction all the
 * time: what it grows to is in the error of the groups as if it had none. */
static void measure_errors(const motion *m, run *r) {
  const double min = m->rotors.min, off = m->law * m->span_s;
  const double own = m->groups > 2 ? sqrt((double)m->rotors.n_states) * r->error[2] : 0.0;
  r->measure[ROT_FREE_ATTITUDE] = r->error[0] + off / min * m->span_s;
  r->measure[ROT_FREE_OMEGA] = (r->error[1] + own + off) / min;
  r->measure[ROT_FREE_MOMENTUM] = fmax(r->error[1] + r->largest[1] * r->error[0], own) + off;
}

static double omega_size(const motion *m, const double y[]) {
  double w[3];
  omega_of(m, y, w);
  return hypot(hypot(w[0], w[1]), w[2]);
}

/* Largest momentum: the total, or that of the rotors if it cancels that of the body. */
static double momentum_size(const motion *m, const run *r) {
  return fmax(r->largest[1], fmax(m->rotors.size, m->groups > 2 ? r->largest[2] : 0.0));
}

static void note_errors(const motion *m, const run *r, rot_info *info) {
  const double start = hypot(hypot(m->omega0[0], m->omega0[1]), m->omega0[2]);
  rot_info_measures(info, rot_free_measures);
  for (int k = 0; k < 3; k++) info->measure[k].error = r->measure[k];
  info->measure[ROT_FREE_ATTITUDE] =
      (rot_measure){r->measure[ROT_FREE_ATTITUDE] + 8.0 * ROT_EPS, 1.0, 1.0, 1.0};
  const double momentum = momentum_size(m, r);
  info->measure[ROT_FREE_MOMENTUM].error += 16.0 * ROT_EPS * momentum;
  info->measure[ROT_FREE_MOMENTUM].largest = momentum;
  rot_note_value(&info->measure[ROT_FREE_OMEGA], start);
  for (size_t i = 0; i < info->rows_done; i++) {
    rot_note_value(&info->measure[ROT_FREE_OMEGA], omega_size(m, r->y + i * m->dim));
  }
}

/* (options, accuracy, times) => one run, its error estimates. */
static rot_status run_at(motion *m, const rot_free_ode_options *options, double accuracy, size_t n,
                         const double time_s[], const rot_hooks *hooks, run *out) {
  const rot_ode_group groups[] = {{0, 4, ROT_ODE_QUATERNION},
                                  {4, 3, ROT_ODE_VECTOR},
                                  {ROTORS, m->rotors.n_states, ROT_ODE_VECTOR}};
  const rot_free_params *p = m->p;
  double start[MAX];
  start_state(m, start);
  /* Noise level: a motion that starts within the noise of its torque has no digits to resolve. */
  const double off = 2.0 * (p->law_noise_n_m + m->law);
  const double noise[] = {off / m->rotors.min * m->span_s, off, off};
  const double rounds[] = {0.0, m->law, 0.0};
  const rot_ode_event zero = {.g = m->weight ? rise : NULL,
                              .component = (size_t)(MOMENTUM + (m->middle < 0 ? 0 : m->middle)),
                              .name = m->weight ? ROT_EVENT_HIGHEST : ROT_EVENT_FLIP,
                              .then = at_zero};
  const rot_ode_params ode = {
      .dim = m->dim,
      .controlled = m->state,
      .n_groups = m->groups,
      .groups = groups,
      .rhs = rhs,
      .ctx = m,
      .n_breaks = p->n_breaks,
      .breaks = p->breaks_s,
      .start_s = p->start_s,
      .start_breaks = p->law != NULL || p->motors != NULL,
      .start = start,
      /* The error of L in space is the sum of that of L in the body and that of the attitude. */
      .accuracy = 0.5 * accuracy,
      .max_steps = options->max_steps,
      .method = options->method,
      .n_events = m->weight || (m->middle >= 0 && !m->rotors.n),
      .events = &zero,
      .log = &out->events,
      .project = renormalise,
      .noise = off > 0.0 ? noise : NULL,
      .rounds = m->law > 0.0 ? rounds : NULL,
      .integrals_between = 1,
      .fades_s = p->law || p->motors      ? 0.0
                 : p->damping_per_s > 0.0 ? 1.0 / p->damping_per_s
                                          : INFINITY,
      .resolution = rot_ode_resolution(p->law || p->motors, options->resolution)};
  memset(out->error, 0, sizeof out->error);
  memset(out->largest, 0, sizeof out->largest);
  const rot_status status =
      rot_ode_run(&ode, n, time_s, out->y, NULL, out->error, out->largest, hooks, &out->info);
  const rot_status kept = keep_seen(m, &out->events);
  measure_errors(m, out);
  return kept == ROT_OK ? status : kept;
}

static double rates_difference(const motion *m, const double x[], const double z[]) {
  double a[3], b[3];
  omega_of(m, x, a);
  omega_of(m, z, b);
  return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Differences between the rows of two runs: in the measures and the flows. */
static void differences(const motion *m, const run *a, const run *b, double measure[3],
                        double flow[ROT_FREE_FLOWS]) {
  memset(measure, 0, 3 * sizeof *measure);
  memset(flow, 0, ROT_FREE_FLOWS * sizeof *flow);
  for (size_t i = 0; i < a->info.rows_done; i++) {
    const double *x = a->y + i * m->dim, *z = b->y + i * m->dim;
    double lx[3], lz[3], difference = 0.0, rate = 0.0, own = 0.0;
    rot_attitude_to_space(x, x + MOMENTUM, lx);
    rot_attitude_to_space(z, z + MOMENTUM, lz);
    for (int k = 0; k < 3; k++) {
      difference = hypot(difference, lx[k] - lz[k]);
      rate = hypot(rate, (x[MOMENTUM + k] - z[MOMENTUM + k]) / m->p->moment_kg_m2[k]);
    }
    if (m->rotors.n) rate = rates_difference(m, x, z);
    for (size_t k = 0; k < m->rotors.n_states; k++) {
      own = hypot(own, x[ROTORS + k] - z[ROTORS + k]);
    }
    measure[ROT_FREE_ATTITUDE] = fmax(measure[ROT_FREE_ATTITUDE], rot_attitude_angle(x, z));
    measure[ROT_FREE_OMEGA] = fmax(measure[ROT_FREE_OMEGA], rate);
    measure[ROT_FREE_MOMENTUM] = fmax(measure[ROT_FREE_MOMENTUM], fmax(difference, own));
    for (size_t k = 0; k < m->flows; k++) {
      flow[k] = fmax(flow[k], fabs(x[m->state + k] - z[m->state + k]));
    }
  }
}

/* Errors of a run: its difference from a finer run, plus the error of that. The estimate of a
 * single run is a safe upper limit. Two runs may have the same error: with a torque function at its
 * kinks, and by rounding: without that the body of test-model-free.R is off by 5.7 times the
 * estimate. */
static void judge(const motion *m, run *a, const run *finer) {
  const double rounding = 2.0 * ROT_EPS * sqrt(1.0 + (double)a->info.steps);
  const double cap = m->p->law || m->p->motors ? 0.9 : 0.5, min = m->rotors.min;
  const double momentum = hypot(a->largest[1], m->groups > 2 ? a->largest[2] : 0.0);
  const double size[3] = {1.0, momentum / min, momentum};
  double difference[3], flow[ROT_FREE_FLOWS];
  differences(m, a, finer, difference, flow);
  /* A law that balances gravity rounds in both runs alike, by more than the motion does. */
  const int balances = m->law * m->span_s > 32.0 * rounding * momentum;
  for (int k = 0; k < 3; k++) {
    const double common =
        fmax(cap * difference[k], balances ? INFINITY : 32.0 * rounding * size[k]);
    a->measure[k] = 1.02 * difference[k] + fmin(finer->measure[k], common) + rounding * size[k];
  }
  for (size_t k = 0; k < m->flows; k++) {
    const size_t at = m->groups + k;
    const double common = fmax(cap * flow[k], 32.0 * rounding * a->largest[at]);
    a->error[at] = flow[k] + fmin(finer->error[at], common) + rounding * a->largest[at];
  }
}

static double figure_of(const motion *m, run *r) {
  rot_info info = {.rows_done = r->info.rows_done};
  note_errors(m, r, &info);
  return rot_info_error(&info);
}

static void swap(run *a, run *b) {
  const run one = *a;
  *a = *b;
  *b = one;
}

/* A run and a finer one, which replaces it while the error is too large. 1/100 of the accuracy
 * needs 1.7 times the steps. If breaks and rows determine the steps, the finer run needs fewer
 * additional steps, or both runs are equal. */
static rot_status run_twice(motion *m, const rot_free_ode_options *options, size_t n,
                            const double time_s[], const rot_hooks *hooks, run *result,
                            run *finer) {
  double accuracy = options->accuracy;
  rot_status status = run_at(m, options, accuracy, n, time_s, hooks, result);
  size_t calls = result->info.rhs_calls;
  while (status == ROT_OK && n && accuracy > 0.02 * ROT_ODE_BEST_ACCURACY) {
    accuracy = fmax(0.01 * accuracy, 0.01 * ROT_ODE_BEST_ACCURACY);
    const rot_status second = run_at(m, options, accuracy, n, time_s, hooks, finer);
    calls += finer->info.rhs_calls;
    if (second == ROT_EUNWIND || second == ROT_ENOMEM) status = second;
    if (second != ROT_OK) break; /* too many steps: keep the estimate of the first run */
    if ((double)finer->info.steps < 1.25 * (double)result->info.steps) continue;
    judge(m, result, finer);
    if (figure_of(m, result) <= options->accuracy) break;
    if (accuracy < 0.1 * ROT_ODE_BEST_ACCURACY) break;
    swap(result, finer);
  }
  result->info.rhs_calls = calls;
  return status;
}

/* At rest at the start, for ever: all slopes are exactly 0, and no law depends on the time. */
static int stays(motion *m) {
  const rot_free_params *p = m->p;
  double y[MAX], f[MAX], sum = 0.0;
  if (p->law || p->motors || p->n_breaks) return 0;
  start_state(m, y);
  if (rhs(p->start_s, y, f, m) != ROT_OK) return 0;
  for (size_t k = 0; k < m->state; k++) sum += fabs(f[k]);
  return sum == 0.0;
}

/* At rest, under its weight alone, within 4 roundings of the stable equilibrium: it swings by no
 * more than the error of its attitude. */
static int hangs(const motion *m) {
  const rot_free_params *p = m->p;
  const double *g = p->lever_n_m;
  if (p->law || p->n_knots || m->rotors.n) return 0;
  for (int k = 0; k < 3; k++) {
    if (m->omega0[k] != 0.0 || p->torque[k] != 0.0) return 0;
  }
  return rot_dot(g, m->hung.up) < 0.0 &&
         rot_length(m->hung.torque) <= 4.0 * ROT_EPS * rot_length(g);
}

/* Events of a run. A body released at a turning point has an event at the start, as in closed
 * form. */
static rot_status give_events(motion *m, const rot_events *log, rot_events *events) {
  double y[MAX];
  rot_events start = {0};
  rot_status status = ROT_OK;
  start_state(m, y);
  if (m->weight && rise(m->p->start_s, y, m) == 0.0) {
    note_turn(m->p->start_s, y, m, &start);
  }
  size_t i = 0;
  for (; i < log->count && log->time_s[i] < m->p->start_s && status == ROT_OK; i++) {
    status = rot_events_add(events, log->time_s[i], log->event[i]);
  }
  if (start.count && status == ROT_OK) {
    status = rot_events_add(events, start.time_s[0], start.event[0]);
  }
  for (; i < log->count && status == ROT_OK; i++) {
    if (start.count && log->time_s[i] == m->p->start_s) continue;
    status = rot_events_add(events, log->time_s[i], log->event[i]);
  }
  rot_events_free(&start);
  return status;
}

/* Two runs, rows, flows, events, errors. */
rot_status rot_free_integrate(const rot_free_params *p, const rot_free_ode_options *options,
                              size_t n, const double time_s[], const rot_free_columns *out,
                              double *const flow[ROT_FREE_FLOWS], double flow_error[ROT_FREE_FLOWS],
                              rot_events *events, const rot_hooks *hooks, rot_info *info) {
  motion m = {.p = p, .middle = middle_of(p->moment_kg_m2)};
  rot_info_clear(info, rot_free_measures);
  if (rot_free_rotors_begin(p, &m.rotors)) return info->status = ROT_EVALUE;
  m.state = ROTORS + m.rotors.n_states;
  m.flows = m.rotors.n ? ROT_FREE_FLOWS : ROT_FREE_FLOWS - 1;
  m.dim = m.state + m.flows;
  m.groups = m.rotors.n_states ? 3 : 2;
  const size_t room = (n ? n : 1) * m.dim;
  double *y = malloc(2 * room * sizeof *y);
  run result = {.y = y}, finer = {.y = y + room};
  if (!y) return info->status = ROT_ENOMEM;
  rot_free_principal(p, m.omega0, m.q0);
  m.weight = rot_free_has_weight(p);
  rot_free_hang(p, &m.hung);
  m.hangs = hangs(&m);
  m.law = rot_free_law_rounding(p);
  if (n) m.span_s = fmax(fabs(time_s[0] - p->start_s), fabs(time_s[n - 1] - p->start_s));
  rot_status status = run_twice(&m, options, n, time_s, hooks, &result, &finer);
  *info = result.info;
  if (status == ROT_ERHS && (p->law || p->motors)) status = ROT_ETORQUE;
  if (status != ROT_EUNWIND && status != ROT_ENOMEM) {
    const rot_status rows = fill_rows(&m, n, result.y, out, flow, info);
    if (rows != ROT_OK) status = rows;
  }
  if (stays(&m)) memset(result.measure, 0, sizeof result.measure);
  note_errors(&m, &result, info);
  flow_error[ROT_FREE_MOTOR_WORK] = 0.0;
  for (size_t k = 0; k < m.flows; k++) flow_error[k] = 2.0 * result.error[m.groups + k];
  for (int k = 0; k < 3; k++) {
    flow_error[ROT_FREE_MOTOR_WORK] +=
        2.0 * fabs(m.rotors.driven[k]) * info->measure[ROT_FREE_OMEGA].error;
  }
  if (events && status != ROT_ENOMEM) {
    const rot_status given = give_events(&m, &result.events, events);
    if (given != ROT_OK) status = given;
  }
  rot_events_free(&result.events);
  rot_events_free(&finer.events);
  free(y);
  return info->status = status;
}
