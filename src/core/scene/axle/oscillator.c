#include "scene/axle/oscillator.h"

#include <math.h>
#include <stdlib.h>

#include "scene/axle/effects.h"
#include "scene/axle/pieces.h"
#include "ground/real.h"
#include "maths/oscillator.h"

/* The response to the knots is computed piece by piece; the response to each wave in one step from
 * rest at the start of the scene, and added: its error is independent of the knots. */

/* Absolute error of exp(-z): at least 2^-1074; its factors are below 2^11 where it matters. */
static const double min_error = 0x1p-1060;

typedef struct wave {
  double amplitude, omega, phase; /* omega >= 0, rad/s */
  double rate;                    /* omega per unit of time */
  rot_complex start;              /* exp(i (omega start_s + phase)) */
  rot_complex steady;             /* steady response: Re(steady exp(i (omega t + phase))) */
  double size;                    /* |steady| */
  double loss;                    /* relative error of steady beyond 8 roundings: near resonance */
} wave;

typedef struct base_state {
  double time_s;
  rot_dd theta;
  double omega;
  double theta_error, omega_error;
  double norm_error; /* of both, in the energy norm, rad/s: does not grow with the pieces */
} base_state;

typedef struct swing {
  const rot_axle_scene *scene;
  rot_oscillator of;
  double rest;       /* rest angle of the spring */
  double unit_s;     /* unit of time */
  double swing_rate; /* sqrt(k/I), 1/s */
  size_t n_waves;
  wave *waves;
  int forward, well_scaled;
  size_t index;
  rot_torque_piece piece;
  base_state base;
} swing;

/* ---- products ------------------------------------------------------------------------------- */

static int well_scaled(double x) { return rot_well_scaled(x, 1e60); }

/* Product of n numbers times 2^e, over d. */
static double product(int plain, int n, const double x[], double d, int e) {
  if (plain) {
    double p = x[0];
    for (int i = 1; i < n; i++) p *= x[i];
    return p / d;
  }
  int exponent;
  const double p = rot_product_split(n, x, d, &exponent);
  return ldexp(p, exponent + e);
}

/* ---- the knots ------------------------------------------------------------------------------ */

static int sloped(const rot_torque_piece *piece) { return piece->start_n_m != piece->end_n_m; }

/* Result of a step and its errors. */
typedef struct step_sum {
  rot_dd theta;
  double omega, theta_error, omega_error;
} step_sum;

/* Torque at the base minus that of the spring: pull 2^e, its error. */
static double net_pull(const swing *run, double a, rot_dd y, int *e, double *error) {
  const double k = run->of.stiffness;
  int ea = 0, ek = 0, ey = 0;
  *e = 0;
  if (!run->well_scaled) {
    (void)frexp(a, &ea);
    const double mk = frexp(k, &ek), my = frexp(y.hi, &ey);
    *e = y.hi != 0.0 && (a == 0.0 || ek + ey > ea) ? ek + ey : ea;
    a = ldexp(a, -*e);
    y = (rot_dd){ldexp(my, ek + ey - *e), ldexp(y.lo, ek - *e)};
    y = rot_dd_mul1(y, mk);
    y.lo = isfinite(y.lo) ? y.lo : 0.0;
  } else {
    y = rot_dd_mul1(y, k);
  }
  *error = ROT_DD_EPS * 4.0 * (fabs(a) + fabs(y.hi)) +
           (sloped(&run->piece) ? 8.0 * ROT_EPS * fabs(a) : 0.0);
  return rot_dd_sub((rot_dd){a, 0.0}, y).hi;
}

/* A step shorter than the slow time scale of the spring:
 *
 *   theta = theta0 + omega0 psi_1 + pull/I psi_2 + slope/I psi_3;
 *
 * for k -> 0 the free axle. */
static void short_step(const swing *run, const rot_oscillator_step *step, double s, double a,
                       rot_dd y, step_sum *out) {
  const rot_torque_piece *piece = &run->piece;
  const double I = run->of.inertia, w0 = run->base.omega;
  const int plain = run->well_scaled && well_scaled(s);
  int e;
  double pull_error, pull = net_pull(run, a, y, &e, &pull_error);
  const double rise =
      sloped(piece) ? (piece->end_n_m - piece->start_n_m) * (s / (piece->end_s - piece->start_s))
                    : 0.0;
  const double coast = product(plain, 3, (double[]){w0, s, step->first}, 1.0, 0);
  const double pulled = product(plain, 4, (double[]){pull, s, s, step->second}, I, e);
  const double risen = product(plain, 4, (double[]){rise, s, s, step->third}, I, 0);
  const double pulled_w = product(plain, 3, (double[]){pull, s, step->first}, I, e);
  const double risen_w = product(plain, 3, (double[]){rise, s, step->second}, I, 0);
  const double off = product(plain, 4, (double[]){pull_error, s, s, step->second}, I, e);
  const double off_w = product(plain, 3, (double[]){pull_error, s, step->first}, I, e);
  const double roundings = (step->near_roots ? 24.0 : 48.0) * ROT_EPS;
  out->theta = rot_dd_add1(rot_dd_add1(rot_dd_add1(run->base.theta, pulled), risen), coast);
  out->omega = w0 * step->psi0 + pulled_w + risen_w;
  out->theta_error = roundings * (fabs(coast) + fabs(pulled) + fabs(risen)) + fabs(off);
  out->omega_error =
      roundings * (fabs(w0) * step->psi0_size + fabs(pulled_w) + fabs(risen_w)) + fabs(off_w);
}

/* A longer step, about the moving rest angle a(t)/k - lag with lag = c slope/k^2, which moves at
 * slope/k:
 *
 *   theta = rest + a(t)/k - lag + u dy + psi_1 dw. */
static void long_step(const swing *run, const rot_oscillator_step *step, double t, double a,
                      rot_dd y, step_sum *out) {
  const rot_torque_piece *piece = &run->piece;
  const double k = run->of.stiffness, c = run->of.damping, T = run->unit_s;
  const double b = rot_torque_in_piece(piece, t), w2 = run->of.stiff.hi;
  double lag = 0.0, drift = 0.0, at_lo, at = rot_muldiv(a, 1.0, k, &at_lo);
  if (sloped(piece)) {
    const double rise = piece->end_n_m - piece->start_n_m, span = piece->end_s - piece->start_s;
    drift = rot_muldiv(rise, 1.0 / span, k, NULL);
    lag = rot_muldiv(c, drift, k, NULL);
  }
  const rot_dd away = rot_dd_sub(y, (rot_dd){at, at_lo});
  const double dy = rot_dd_add1(away, lag).hi, dw = (run->base.omega - drift) * T;
  const double now = b / k, swung = step->u * dy, thrown = step->psi1 * dw;
  const double dy_error = (sloped(piece) ? 8.0 * ROT_EPS * (fabs(at) + fabs(lag)) : 0.0) +
                          ROT_EPS * fabs(dy) + 4.0 * ROT_DD_EPS * (fabs(y.hi) + fabs(at));
  const double dw_error = 8.0 * ROT_EPS * (fabs(run->base.omega) + fabs(drift)) * T;
  const double psi1 = fabs(step->psi1), roundings = 10.0 * ROT_EPS;
  out->theta = rot_dd_add1(rot_dd_add1(rot_dd_sum2(run->rest, now), swung - lag), thrown);
  out->theta_error = roundings * (fabs(now) + fabs(lag) + fabs(thrown) + step->u_size * fabs(dy)) +
                     step->u_size * dy_error + psi1 * dw_error + step->u_phase * fabs(dy) +
                     step->psi1_phase * fabs(dw) + min_error * (1.0 + fabs(dy) + fabs(dw));
  out->omega = drift + (step->psi0 * dw - w2 * step->psi1 * dy) / T;
  out->omega_error = roundings * fabs(drift) +
                     (step->psi0_size * (roundings * fabs(dw) + dw_error) +
                      w2 * psi1 * (roundings * fabs(dy) + dy_error) + step->u_phase * fabs(dw) +
                      w2 * step->psi1_phase * fabs(dy) + min_error * (1.0 + fabs(dy) + fabs(dw))) /
                         T +
                     min_error;
}

/* base => response to the knots at t in its piece. */
static void knots_step(const swing *run, const rot_oscillator_step *step, double t,
                       base_state *to) {
  const base_state *from = &run->base;
  const double a = rot_torque_in_piece(&run->piece, from->time_s), T = run->unit_s;
  const rot_dd y = rot_dd_sub(from->theta, (rot_dd){run->rest, 0.0});
  step_sum sum;
  *to = *from;
  to->time_s = t;
  if (t == from->time_s) return;
  if (step->early) {
    short_step(run, step, t - from->time_s, a, y, &sum);
  } else {
    long_step(run, step, t, a, y, &sum);
  }
  const double carried = from->norm_error * step->norm, psi1 = fabs(step->psi1);
  to->theta = sum.theta;
  to->omega = sum.omega;
  to->norm_error = carried + run->swing_rate * sum.theta_error + sum.omega_error;
  to->theta_error =
      sum.theta_error + fmin(step->u_size * from->theta_error + psi1 * T * from->omega_error,
                             carried / run->swing_rate);
  to->omega_error = sum.omega_error + fmin(step->psi0_size * from->omega_error +
                                               run->of.stiff.hi * psi1 / T * from->theta_error,
                                           carried);
}

/* ---- the waves ------------------------------------------------------------------------------ */

/* exp(i (a t + b)) with the angle in twice the precision. */
static rot_complex turn(double a, double t, double b) {
  const rot_dd x = rot_dd_add1(rot_dd_mul2(a, t), b);
  const double c = cos(x.hi), s = sin(x.hi);
  if (fabs(x.lo) < 0x1p-28) {
    return (rot_complex){c - x.lo * (s + 0.5 * x.lo * c), s + x.lo * (c - 0.5 * x.lo * s)};
  }
  const double cl = cos(x.lo), sl = sin(x.lo);
  return (rot_complex){c * cl - s * sl, s * cl + c * sl};
}

static rot_complex times(rot_complex a, rot_complex b) {
  return (rot_complex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static void begin_wave(const swing *run, const rot_term *term, wave *out) {
  const rot_oscillator *of = &run->of;
  const double sign = term->x[1] < 0.0 ? -1.0 : 1.0;
  *out = (wave){.amplitude = term->x[0], .omega = sign * term->x[1], .phase = sign * term->x[2]};
  out->rate = ldexp(out->omega, of->exponent);
  out->start = turn(out->omega, run->scene->linear.start_s, out->phase);
  const rot_complex steady = rot_oscillator_steady(of, out->omega);
  const double x[2][2] = {{out->amplitude, steady.re}, {out->amplitude, steady.im}};
  out->steady.re = product(0, 2, x[0], of->inertia, 2 * of->exponent);
  out->steady.im = product(0, 2, x[1], of->inertia, 2 * of->exponent);
  out->size = hypot(out->steady.re, out->steady.im);
  out->loss =
      16.0 * ROT_DD_EPS * (of->stiff.hi + out->rate * out->rate) * hypot(steady.re, steady.im);
}

/* Steady response minus the free motion equal to it at the start. */
static void far_answer(const swing *run, const wave *w, const rot_oscillator_step *step, double t,
                       rot_axle_point *sum) {
  const double T = run->unit_s, w2 = run->of.stiff.hi, rate = w->rate, psi1 = fabs(step->psi1);
  const rot_complex now = times(w->steady, turn(w->omega, t, w->phase));
  const rot_complex start = times(w->steady, w->start);
  const double start_y = start.re, start_v = -rate * start.im;
  sum->theta_rad += now.re - step->u * start_y - step->psi1 * start_v;
  sum->omega_rad_per_s += (-rate * now.im - step->psi0 * start_v + w2 * step->psi1 * start_y) / T;
  const double relative =
      16.0 * ROT_EPS + w->loss +
      8.0 * ROT_DD_EPS * w->omega * (fabs(t) + fabs(run->scene->linear.start_s)) +
      8.0 * ROT_DD_EPS * fabs(w->phase);
  sum->theta_error += w->size * (relative * (1.0 + step->u_size + rate * psi1) + step->u_phase +
                                 rate * step->psi1_phase + min_error * (1.0 + rate)) +
                      min_error;
  sum->omega_error +=
      w->size *
          (relative * (rate + rate * step->psi0_size + w2 * psi1) + rate * step->u_phase +
           w2 * step->psi1_phase + min_error * (1.0 + rate)) /
          T +
      min_error;
}

/* Response to one wave from rest at the start; far from resonance: far_answer(). */
static void wave_answer(const swing *run, const wave *w, const rot_oscillator_step *step, double t,
                        rot_axle_point *sum) {
  const double s = t - run->scene->linear.start_s, I = run->of.inertia;
  const int plain = run->well_scaled && well_scaled(s);
  rot_complex y, v;
  double y_size, v_size;
  if (!rot_oscillator_wave(step, w->omega, &y, &v, &y_size, &v_size)) {
    far_answer(run, w, step, t, sum);
    return;
  }
  const double A = w->amplitude;
  const double to_y = product(plain, 3, (double[]){A, s, s}, I, 0);
  const double to_v = product(plain, 2, (double[]){A, s}, I, 0);
  const double relative =
      32.0 * ROT_EPS + 8.0 * ROT_DD_EPS *
                           (w->omega * (fabs(t) + fabs(run->scene->linear.start_s)) +
                            fabs(w->phase) + step->phase.hi);
  sum->theta_rad += to_y * (w->start.re * y.re - w->start.im * y.im);
  sum->omega_rad_per_s += to_v * (w->start.re * v.re - w->start.im * v.im);
  sum->theta_error += fabs(to_y) * relative * y_size;
  sum->omega_error += fabs(to_v) * relative * v_size;
}

/* Adds all waves at t. step: from the base; usable only if the base is the start of the scene. */
static void all_waves(const swing *run, const rot_oscillator_step *step, double t,
                      rot_axle_point *sum) {
  const double start = run->scene->linear.start_s;
  rot_oscillator_step from_start;
  *sum = (rot_axle_point){0.0, 0.0, 0.0, 0.0, 0.0};
  if (run->n_waves == 0) return;
  if (run->base.time_s != start) {
    rot_oscillator_at(&run->of, rot_dd_sum2(t, -start), &from_start);
    step = &from_start;
  }
  for (size_t i = 0; i < run->n_waves; i++) wave_answer(run, &run->waves[i], step, t, sum);
}

/* ---- time stepping -------------------------------------------------------------------------- */

static void restart(void *model, int forward) {
  swing *run = model;
  const rot_axle_params *p = &run->scene->linear;
  run->forward = forward;
  run->index = rot_torque_find(&p->torque, p->start_s, forward);
  run->piece = rot_torque_piece_at(&p->torque, run->index);
  run->base = (base_state){p->start_s, {p->theta0_rad, 0.0}, p->omega0_rad_per_s, 0.0, 0.0, 0.0};
}

static double piece_end(const void *model) {
  const swing *run = model;
  return run->forward ? run->piece.end_s : run->piece.start_s;
}

/* base => state at t: knots and waves. */
static void move(const swing *run, double t, base_state *to, rot_axle_point *state) {
  rot_oscillator_step step;
  rot_axle_point waves;
  rot_oscillator_at(&run->of, rot_dd_sum2(t, -run->base.time_s), &step);
  knots_step(run, &step, t, to);
  all_waves(run, &step, t, &waves);
  state->theta_rad = to->theta.hi + (to->theta.lo + waves.theta_rad);
  state->omega_rad_per_s = to->omega + waves.omega_rad_per_s;
  state->theta_error = to->theta_error + waves.theta_error + ROT_EPS * fabs(state->theta_rad);
  state->omega_error = to->omega_error + waves.omega_error + ROT_EPS * fabs(state->omega_rad_per_s);
}

static void state_at(const void *model, double t, rot_axle_point *state) {
  base_state at;
  move(model, t, &at, state);
}

static void next_piece(void *model, rot_axle_point *at_end) {
  swing *run = model;
  base_state end;
  move(run, piece_end(run), &end, at_end);
  run->base = end;
  run->index = run->forward ? run->index + 1 : run->index - 1;
  run->piece = rot_torque_piece_at(&run->scene->linear.torque, run->index);
}

/* scene => its spring; NULL: the model does not take the scene. */
static const rot_term *the_spring(const rot_axle_scene *scene) {
  const rot_term *spring = NULL;
  if (!rot_axle_fits(scene, ROT_AXLE_OSCILLATOR_TAKES)) return NULL;
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term *term = &scene->terms[i];
    if (term->from_s != -INFINITY || term->to_s != INFINITY) return NULL;
    if (term->kind != ROT_TERM_SPRING) continue;
    if (spring || !(term->x[0] > 0.0)) return NULL;
    spring = term;
  }
  return spring;
}

static int all_well_scaled(const rot_axle_scene *scene, const rot_term *spring) {
  const rot_axle_params *p = &scene->linear;
  int ok = well_scaled(p->inertia_kg_m2) && well_scaled(p->viscous_n_m_s) &&
           well_scaled(p->theta0_rad) && well_scaled(p->omega0_rad_per_s) &&
           well_scaled(p->torque.before_n_m) && well_scaled(p->torque.after_n_m) &&
           well_scaled(spring->x[0]) && well_scaled(spring->x[1]);
  for (size_t i = 0; ok && i < p->torque.n; i++) ok = well_scaled(p->torque.torque_n_m[i]);
  for (size_t i = 0; ok && i < scene->n_terms; i++) ok = well_scaled(scene->terms[i].x[0]);
  return ok;
}

/* scene => constants of oscillator and waves. */
static rot_status begin(const rot_axle_scene *scene, swing *run) {
  const rot_term *spring = the_spring(scene);
  *run = (swing){.scene = scene};
  if (!spring) return ROT_EVALUE;
  const rot_status status = rot_oscillator_begin(
      scene->linear.inertia_kg_m2, scene->linear.viscous_n_m_s, spring->x[0], &run->of);
  if (status != ROT_OK) return status;
  run->rest = spring->x[1];
  run->unit_s = ldexp(1.0, run->of.exponent);
  run->swing_rate = run->of.omega0 / run->unit_s;
  run->well_scaled = all_well_scaled(scene, spring);
  if (scene->n_terms < 2) return ROT_OK;
  run->waves = malloc((scene->n_terms - 1) * sizeof *run->waves);
  if (!run->waves) return ROT_ENOMEM;
  for (size_t i = 0; i < scene->n_terms; i++) {
    if (&scene->terms[i] != spring) {
      begin_wave(run, &scene->terms[i], &run->waves[run->n_waves++]);
    }
  }
  return ROT_OK;
}

rot_status rot_axle_oscillator(const rot_axle_scene *scene, size_t n, const double time_s[],
                               const rot_axle_columns *out, rot_events *events,
                               const rot_hooks *hooks, rot_info *info) {
  static const rot_axle_pieces pieces = {restart, piece_end, next_piece, state_at};
  swing run;
  (void)events; /* none occur */
  rot_info_clear(info, rot_turning);
  info->status = begin(scene, &run);
  if (info->status == ROT_OK) {
    rot_axle_by_pieces(scene, &pieces, &run, n, time_s, out, hooks, info);
  }
  free(run.waves);
  return info->status;
}
