#include "scene/axle/ode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/ode.h"
#include "ground/real.h"

/* State. TURNED: theta - theta0, so that a large theta0 does not hide a small motion: an inverted
 * pendulum pushed by 1e-12 rad/s never left pi. After it: omega, flows. */
enum {
  TURNED,
  OMEGA,
  FLOWS,
  WORK = FLOWS + ROT_AXLE_FLOW_WORK,
  VISCOUS = FLOWS + ROT_AXLE_FLOW_VISCOUS,
  QUADRATIC = FLOWS + ROT_AXLE_FLOW_QUADRATIC,
  COULOMB = FLOWS + ROT_AXLE_FLOW_COULOMB,
  IMPULSE = FLOWS + ROT_AXLE_FLOW_IMPULSE,
  DAMPING = FLOWS + ROT_AXLE_FLOW_DAMPING,
  INERTIA = FLOWS + ROT_AXLE_FLOW_INERTIA,
  DIM = FLOWS + ROT_AXLE_FLOWS
};

typedef struct motion {
  const rot_axle_scene *scene;
  rot_torque inertia; /* I(t) as knots; no knot: constant */
  double reference;   /* y[OMEGA] = I(t) omega / reference */
  int turns;          /* 1: the resistance has a kink at rest */
  int mode;           /* 1, -1: sign of omega; 0: held */
  size_t n_breaks;
  double *breaks;
} motion;

static double inertia_at(const motion *m, double t) {
  return m->inertia.n ? rot_torque_at(&m->inertia, t) : m->reference;
}

static double omega_of(const motion *m, double t, double y) {
  return m->inertia.n ? y * (m->reference / inertia_at(m, t)) : y;
}

static rot_status applied_now(const rot_axle_scene *scene, double t, double turned, double omega,
                              double *torque) {
  double theta_lo, theta = rot_two_sum(scene->linear.theta0_rad, turned, &theta_lo);
  const rot_torque *law = &scene->linear.torque;
  double called = 0.0;
  if (law->call) {
    const rot_status status = law->call(t, theta, omega, &called, law->ctx);
    if (status != ROT_OK) return status;
  }
  /* A single law keeps its digits and the sign of zero. */
  const int alone = law->call && law->n == 0 && scene->n_terms == 0 && scene->motor_n_m_s == 0.0 &&
                    law->before_n_m == 0.0;
  *torque = alone ? called : called + rot_axle_scene_applied(scene, t, theta, theta_lo, omega);
  return ROT_OK;
}

static double inertia_slope(const motion *m, double t) {
  if (m->inertia.n < 2) return 0.0;
  const rot_torque_piece piece =
      rot_torque_piece_at(&m->inertia, rot_torque_find(&m->inertia, t, 1));
  const double width = piece.end_s - piece.start_s;
  return isfinite(width) && width > 0.0 ? (piece.end_n_m - piece.start_n_m) / width : 0.0;
}

/* (t, state) => rates of the state and the flows, in the present mode. */
static rot_status axle_rhs(double t, const double y[], double dydt[], void *ctx) {
  const motion *m = ctx;
  const rot_axle_scene *scene = m->scene;
  const int held = m->turns && m->mode == 0;
  const double omega = held ? 0.0 : omega_of(m, t, y[OMEGA]);
  double torque;
  const rot_status status = applied_now(scene, t, y[TURNED], omega, &torque);
  if (status != ROT_OK) return status;
  /* The sign of the segment: a stage beyond the zero has no kink. */
  const double sign = m->mode;
  const double viscous = scene->viscous_n_m_s * omega,
               quadratic = scene->quadratic_n_m_s2 * omega * omega * sign,
               coulomb = m->turns ? scene->coulomb_n_m * sign : 0.0;
  const double resistance = (m->turns ? quadratic + coulomb : 0.0) + viscous;
  dydt[TURNED] = omega;
  dydt[OMEGA] = held ? 0.0 : (torque - resistance) / m->reference;
  dydt[WORK] = torque * omega;
  dydt[VISCOUS] = viscous * omega;
  dydt[QUADRATIC] = m->turns ? quadratic * omega : 0.0;
  dydt[COULOMB] = coulomb * omega;
  dydt[IMPULSE] = torque;
  dydt[DAMPING] = held ? -torque : -resistance;
  dydt[INERTIA] = m->inertia.n ? -0.5 * inertia_slope(m, t) * omega * omega : 0.0;
  return ROT_OK;
}

static void new_positions(double t, double h, const double before[], double y[], void *ctx) {
  y[TURNED] = before[TURNED] + h * omega_of(ctx, t, y[OMEGA]);
}

/* At a jump of I(t) L is continuous; the change of L^2 / 2 I is the work of the change of
 * inertia. */
static void cross_inertia(double t, double y[], int forward, void *ctx) {
  const motion *m = ctx;
  if (m->inertia.n == 0) return;
  double side[2];
  for (int after = 0; after < 2; after++) {
    const rot_torque_piece piece =
        rot_torque_piece_at(&m->inertia, rot_torque_find(&m->inertia, t, after));
    side[after] = rot_torque_in_piece(&piece, t);
  }
  const double from = side[!forward], to = side[forward != 0], momentum = m->reference * y[OMEGA];
  if (from != to) y[INERTIA] += 0.5 * momentum * (momentum * ((from - to) / from / to));
}

/* 1 if a torque-speed curve has more than one line, else 0. */
static int has_kinks(const rot_axle_scene *scene) {
  for (size_t i = 0; i < scene->n_terms; i++) {
    if (scene->terms[i].kind == ROT_TERM_CURVE) return 1;
  }
  return 0;
}

/* ---- the scene ------------------------------------------------------------------------------- */

static rot_status collect_breaks(motion *m) {
  m->breaks = malloc(rot_axle_scene_room(m->scene) * sizeof *m->breaks);
  if (!m->breaks) return ROT_ENOMEM;
  m->n_breaks = rot_axle_scene_breaks(m->scene, m->breaks);
  return ROT_OK;
}

/* scene => motion: inertia, mode at the start. */
static motion motion_of(const rot_axle_scene *scene) {
  motion m;
  memset(&m, 0, sizeof m);
  m.scene = scene;
  m.reference = scene->linear.inertia_kg_m2;
  if (scene->n_inertia) {
    m.inertia.n = scene->n_inertia;
    m.inertia.time_s = scene->inertia_time_s;
    m.inertia.torque_n_m = scene->inertia_kg_m2;
    m.inertia.before_n_m = scene->inertia_kg_m2[0];
    m.inertia.after_n_m = scene->inertia_kg_m2[scene->n_inertia - 1];
    m.reference = rot_torque_at(&m.inertia, scene->linear.start_s);
  }
  m.turns = rot_axle_kinks_at_rest(scene);
  m.mode = 1;
  return m;
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* states => columns. slope: torque of each row as called in the run, NaN: not called; NULL:
 * none. */
static rot_status fill_columns(const motion *m, size_t n, const double time_s[], const double y[],
                               const double slope[], const rot_axle_columns *out, rot_info *info) {
  const rot_axle_scene *scene = m->scene;
  const size_t reached = info->rows_done;
  info->rows_done = 0;
  for (size_t i = 0; i < n && i < reached; i++) {
    const double t = time_s[i], turned = y[i * DIM + TURNED];
    const double omega = omega_of(m, t, y[i * DIM + OMEGA]);
    double torque;
    if (slope && !isnan(slope[i])) {
      torque = slope[i];
    } else {
      rot_status status = applied_now(scene, t, turned, omega, &torque);
      if (scene->linear.torque.call) info->rhs_calls++;
      if (status == ROT_OK && !isfinite(torque)) status = ROT_ETORQUE;
      if (status != ROT_OK) {
        info->time_s = t;
        return status;
      }
    }
    const int stuck =
        m->turns && scene->static_n_m > 0.0 && omega == 0.0 && fabs(torque) <= scene->static_n_m;
    rot_axle_scene_row(scene, out, i, t, scene->linear.theta0_rad + turned, omega, torque, stuck);
    info->rows_done = i + 1;
  }
  return ROT_OK;
}

/* Largest theta: of the rows and the start, or the one implied by the largest |theta - theta0|.
 * Largest omega, its error: those of the state, converted at the rows if the inertia changes. */
static void note_sizes(const motion *m, size_t n, const double time_s[], const double y[],
                       const double error[], const double largest[], rot_info *info) {
  const double theta0 = m->scene->linear.theta0_rad;
  rot_measure *theta = &info->measure[ROT_THETA], *omega = &info->measure[ROT_OMEGA];
  theta->largest = fmax(fabs(theta0), largest[TURNED] - fabs(theta0));
  for (size_t i = 0; i < n; i++) {
    theta->largest = fmax(theta->largest, fabs(theta0 + y[i * DIM + TURNED]));
  }
  /* With half an ulp of theta, 2 of 1000 motions had a larger error, 3e-16. */
  theta->error = error[TURNED] + 4.0 * ROT_EPS * theta->largest;
  omega->error = error[OMEGA];
  omega->largest = largest[OMEGA];
  if (m->inertia.n == 0) return;
  double max = 0.0;
  omega->largest = fabs(m->scene->linear.omega0_rad_per_s);
  for (size_t i = 0; i < n; i++) {
    max = fmax(max, omega_of(m, time_s[i], 1.0));
    omega->largest = fmax(omega->largest, fabs(omega_of(m, time_s[i], y[i * DIM + OMEGA])));
  }
  omega->error *= max;
}

/* Twice the errors: at both ends. The impulse of the resistance follows from that of the torque. */
static void write_flows(const motion *m, size_t n, const double time_s[], const double y[],
                        const double error[], const rot_axle_columns *rows,
                        const rot_axle_flows *flows) {
  for (int k = 0; k < ROT_AXLE_FLOWS; k++) {
    for (size_t i = 0; i < n; i++) flows->value[k][i] = y[i * DIM + FLOWS + (size_t)k];
    flows->error[k] = FLOWS + k == DAMPING ? 0.0 : 2.0 * error[FLOWS + k];
  }
  rot_axle_flows_jumps(m->scene, n, time_s, rows->angular_momentum_kg_m2_per_s, flows);
}

/* => rot_ode_params.fades_s: with linear losses and no torque that itself fades */
static double fades_s_of(const motion *m, const rot_axle_scene *scene) {
  if (m->turns || scene->linear.torque.call || scene->quadratic_n_m_s2 != 0.0) return 0.0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term_kind kind = scene->terms[i].kind;
    const int steady =
        kind == ROT_TERM_SINUSOID || kind == ROT_TERM_SPRING || kind == ROT_TERM_GRAVITY;
    if (!steady) return 0.0;
  }
  return m->reference / (fabs(scene->viscous_n_m_s) + fabs(scene->motor_n_m_s));
}

/* The terms of the torque at the start, in size: their sum is rounded by that. About an angle at
 * which they cancel, motions of 1e-9 rad/s took the whole budget to resolve it. */
static double terms_of(const rot_axle_scene *scene) {
  const rot_axle_params *linear = &scene->linear;
  const double t = linear->start_s, theta = linear->theta0_rad, omega = linear->omega0_rad_per_s;
  double size = fabs(rot_torque_at(&linear->torque, t)) + fabs(scene->motor_n_m_s * omega);
  for (size_t i = 0; i < scene->n_terms; i++) {
    size += fabs(rot_term_at(&scene->terms[i], t, theta, 0.0, omega));
  }
  return size;
}

/* Builds the problem of rot_ode_run(); rows, sizes, flows. */
rot_status rot_axle_integrate(const rot_axle_scene *scene, const rot_axle_ode_options *options,
                              size_t n, const double time_s[], const rot_axle_columns *out,
                              rot_events *events, const rot_axle_flows *flows,
                              const rot_hooks *hooks, rot_info *info) {
  motion m = motion_of(scene);
  double start[DIM] = {0.0, scene->linear.omega0_rad_per_s};
  double error[DIM] = {0.0}, largest[DIM] = {0.0};
  const double holds = fmax(scene->static_n_m, scene->coulomb_n_m);
  const rot_ode_switch turn = {OMEGA, IMPULSE, holds};
  const int called = scene->linear.torque.call != NULL;
  rot_info_clear(info, rot_turning);
  info->status = collect_breaks(&m);
  double *y = malloc((n ? n : 1) * DIM * sizeof *y);
  double *slope = called ? malloc((n ? n : 1) * sizeof *slope) : NULL;
  if (!y || (called && !slope)) info->status = ROT_ENOMEM;
  rot_status failure = info->status;
  if (failure == ROT_OK) {
    const double span = n ? fmax(fabs(time_s[0] - scene->linear.start_s),
                                 fabs(time_s[n - 1] - scene->linear.start_s))
                          : 0.0;
    const double rounds[] = {0.0, ROT_EPS * terms_of(scene) / m.reference};
    const double off = scene->noise_n_m / m.reference + 4.0 * rounds[1];
    const double noise[] = {off * span, off};
    const rot_ode_params ode = {.dim = DIM,
                                .controlled = 2,
                                .rhs = axle_rhs,
                                .ctx = &m,
                                .n_breaks = m.n_breaks,
                                .breaks = m.breaks,
                                .start_s = scene->linear.start_s,
                                .start = start,
                                /* Relative to theta, which may be half of |theta - theta0|. */
                                .accuracy = (scene->linear.theta0_rad == 0.0 ? 1.0 : 0.5) *
                                            options->accuracy,
                                .max_steps = options->max_steps,
                                .method = options->method,
                                .mode = &m.mode,
                                .turn = m.turns ? &turn : NULL,
                                .log = events,
                                .at_break = m.inertia.n ? cross_inertia : NULL,
                                .sloped = IMPULSE,
                                .noise = noise,
                                .rounds = rounds,
                                .kinks = has_kinks(scene),
                                .resolution = rot_ode_resolution(called, options->resolution),
                                .fades_s = fades_s_of(&m, scene),
                                .expensive = called,
                                .step_s = rot_ode_is_fixed(options->method) ? options->step_s : 0.0,
                                .positions = new_positions};
    failure = rot_ode_run(&ode, n, time_s, y, slope, error, largest, hooks, info);
    if (failure == ROT_ERHS) failure = ROT_ETORQUE;
    if (failure == ROT_EUNWIND || failure == ROT_ENOMEM) {
      info->rows_done = 0;
    } else {
      const rot_status columns = fill_columns(&m, n, time_s, y, slope, out, info);
      if (columns != ROT_OK) failure = columns;
    }
    note_sizes(&m, info->rows_done, time_s, y, error, largest, info);
    if (flows) write_flows(&m, info->rows_done, time_s, y, error, out, flows);
  }
  free(slope);
  free(y);
  free(m.breaks);
  return info->status = failure;
}
