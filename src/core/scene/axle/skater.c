#include "scene/axle/skater.h"

#include <math.h>

#include "scene/axle/effects.h"
#include "scene/axle/pieces.h"
#include "ground/dd.h"

/* State of a run. Inertia, torque and momentum are divided by 2^exponent: no over- or underflow. */
typedef struct skater {
  const rot_axle_scene *scene;
  rot_torque inertia; /* I(t) stored as a rot_torque, to reuse its interpolation */
  int exponent, forward;
  size_t inertia_index, torque_index;
  rot_torque_piece inertia_piece;
  double torque; /* in the piece */
  double time_s, moment;
  rot_dd theta, momentum;
  double theta_error, momentum_error;
} skater;

static double moment_at(const skater *run, double t) {
  return ldexp(rot_torque_in_piece(&run->inertia_piece, t), -run->exponent);
}

static void enter_piece(skater *run) {
  run->inertia_piece = rot_torque_piece_at(&run->inertia, run->inertia_index);
  run->torque = ldexp(rot_torque_piece_at(&run->scene->linear.torque, run->torque_index).start_n_m,
                      -run->exponent);
  run->moment = moment_at(run, run->time_s);
}

/* Base and pieces at the start, scaled. */
static void restart(void *model, int forward) {
  skater *run = model;
  const rot_axle_params *p = &run->scene->linear;
  const double t = p->start_s, I = ldexp(rot_torque_at(&run->inertia, t), -run->exponent);
  run->forward = forward;
  run->inertia_index = rot_torque_find(&run->inertia, t, forward);
  run->torque_index = rot_torque_find(&p->torque, t, forward);
  run->time_s = t;
  run->theta = (rot_dd){p->theta0_rad, 0.0};
  run->momentum = rot_dd_mul2(I, p->omega0_rad_per_s);
  enter_piece(run);
  /* Error of I between knots: 3 ulp. */
  const rot_torque_piece *piece = &run->inertia_piece;
  const int known = piece->start_n_m == piece->end_n_m || t == piece->start_s || t == piece->end_s;
  run->theta_error = 0.0;
  run->momentum_error = known ? 0.0 : 8.0 * ROT_EPS * fabs(run->momentum.hi);
}

static double piece_end(const void *model) {
  const skater *run = model;
  const rot_torque_piece torque =
      rot_torque_piece_at(&run->scene->linear.torque, run->torque_index);
  return run->forward ? fmin(run->inertia_piece.end_s, torque.end_s)
                      : fmax(run->inertia_piece.start_s, torque.start_s);
}

/* (x - log(1 + x)) / x^2 for -1/2 <= x <= 2, from log(1 + x) = 2 atanh(v), v = x/(2 + x):
 *
 *   1/(2 + x) - 2 v/(2 + x)^2 (1/3 + v^2/5 + v^4/7 + ...).
 *
 * The second term is at most a third of the first. 26 terms: truncation error 2^-56 at v = 1/2. */
static double second_log(double x) {
  const double v = x / (2.0 + x), v2 = v * v, y = 1.0 / (2.0 + x);
  double sum = 0.0;
  for (int j = v2 < 0.01 ? 8 : 26; j >= 0; j--) sum = sum * v2 + 1.0 / (2 * j + 3);
  return y - 2.0 * v * sum * y * y;
}

/* x = I/I0 - 1 => first, second of the angle omega0 s first + (torque s^2/I0) second. */
static void log_weights(const skater *run, double t, double s, double *first, double *second) {
  const rot_torque_piece *piece = &run->inertia_piece;
  if (piece->start_n_m == piece->end_n_m || s == 0.0) {
    *first = 1.0;
    *second = 0.5;
    return;
  }
  const double rise = ldexp(piece->end_n_m - piece->start_n_m, -run->exponent);
  const double x = rise / run->moment * (s / (piece->end_s - piece->start_s));
  if (x >= -0.5 && x <= 2.0) {
    *first = x != 0.0 ? log1p(x) / x : 1.0;
    *second = second_log(x);
  } else { /* towards x = -1: 1 + x is I/I0, with all its digits */
    const double moment = moment_at(run, t), change = (moment - run->moment) / run->moment;
    *first = log(moment / run->moment) / change;
    *second = (1.0 - *first) / change;
  }
}

/* a/b to half an ulp. */
static double quotient(rot_dd a, double b) {
  const double q = a.hi / b;
  return isfinite(q) ? q + (fma(-q, b, a.hi) + a.lo) / b : q;
}

/* Rounding of each term of the angle: 3 of I0, 3 to 8 of a weight, those of the product. */
static const double angle_roundings = 24.0 * ROT_EPS;

/* base => state at t in its pieces. */
static void move(const skater *run, double t, skater *to) {
  const rot_dd s = rot_dd_sum2(t, -run->time_s);
  double first, second;
  log_weights(run, t, s.hi, &first, &second);
  const rot_dd given = rot_dd_mul1(s, run->torque);
  const double coasted = run->momentum.hi / run->moment * s.hi * first;
  const double driven = given.hi / run->moment * s.hi * second;
  *to = *run;
  to->time_s = t;
  to->moment = moment_at(run, t);
  to->momentum = rot_dd_add(run->momentum, given);
  to->theta = rot_dd_add1(rot_dd_add1(run->theta, coasted), driven);
  to->momentum_error = run->momentum_error + ROT_DD_EPS * (fabs(run->momentum.hi) + fabs(given.hi));
  to->theta_error = run->theta_error + run->momentum_error / run->moment * fabs(s.hi) * first +
                    angle_roundings * (fabs(coasted) + fabs(driven));
}

static void read_state(const skater *at, rot_axle_point *state) {
  state->theta_rad = at->theta.hi;
  state->omega_rad_per_s = quotient(at->momentum, at->moment);
  state->theta_error = at->theta_error + ROT_EPS * fabs(at->theta.hi);
  state->omega_error =
      at->momentum_error / at->moment + 10.0 * ROT_EPS * fabs(state->omega_rad_per_s);
}

static void state_at(const void *model, double t, rot_axle_point *state) {
  const skater *run = model;
  skater at;
  move(run, t, &at);
  if (t == run->time_s) { /* after a jump, also backward in time */
    at.moment = ldexp(rot_torque_at(&at.inertia, t), -at.exponent);
  }
  read_state(&at, state);
}

static void next_piece(void *model, rot_axle_point *at_end) {
  skater *run = model, at;
  const double end = piece_end(run);
  move(run, end, &at);
  *run = at;
  read_state(run, at_end);
  const rot_torque_piece torque =
      rot_torque_piece_at(&run->scene->linear.torque, run->torque_index);
  const size_t step = run->forward ? 1 : (size_t)-1;
  if ((run->forward ? torque.end_s : torque.start_s) == end) run->torque_index += step;
  const rot_torque_piece *inertia = &run->inertia_piece;
  if ((run->forward ? inertia->end_s : inertia->start_s) == end) run->inertia_index += step;
  enter_piece(run);
}

/* Exponent of the scale, then rows by pieces. */
rot_status rot_axle_skater(const rot_axle_scene *scene, size_t n, const double time_s[],
                           const rot_axle_columns *out, rot_events *events, const rot_hooks *hooks,
                           rot_info *info) {
  static const rot_axle_pieces pieces = {restart, piece_end, next_piece, state_at};
  skater run = {.scene = scene};
  const double I = scene->linear.inertia_kg_m2, *moments = scene->inertia_kg_m2;
  const size_t knots = scene->n_inertia;
  (void)events; /* none occur */
  rot_info_clear(info, rot_turning);
  if (!rot_axle_fits(scene, ROT_AXLE_SKATER_TAKES)) return info->status = ROT_EVALUE;
  run.inertia = (rot_torque){knots,
                             scene->inertia_time_s,
                             moments,
                             knots ? moments[0] : I,
                             knots ? moments[knots - 1] : I,
                             NULL,
                             NULL};
  (void)frexp(rot_axle_scene_inertia(scene, scene->linear.start_s), &run.exponent);
  return rot_axle_by_pieces(scene, &pieces, &run, n, time_s, out, hooks, info);
}
