#include "scene/axle/pendulum.h"

#include <math.h>

#include "scene/axle/effects.h"
#include "scene/axle/pieces.h"
#include "ground/dd_trig.h"
#include "maths/jacobi.h"

typedef enum manner { STILL, TO_AND_FRO, SEPARATRIX, ALL_ROUND, TOO_NEAR } manner;

/* Smallest distance from the top (rad, or omega/w0) whose square does not underflow. */
static const double nearest_top = 1e-130;

/* Constants of a motion. Unit of time: 2^exponent s, such that w0 is in [1/2, 2]. */
typedef struct pendulum {
  const rot_axle_scene *scene;
  manner manner;
  int forward;
  int exponent;
  double half_turns;   /* phi = theta - rest - pi half_turns is in [-pi, pi] at the start */
  rot_dd sine, cosine; /* of phi/2 at the start; the cosine is >= 0 */
  rot_dd w0, speed;    /* speed 2^speed_exponent: omega0/(2 w0) */
  int speed_exponent;
  rot_dd k; /* k 2^k_exponent */
  int k_exponent;
  double sign;  /* of the rate of u */
  rot_dd rate;  /* of u: w0, or k w0 */
  rot_dd start; /* u at the start; its error */
  double start_error;
  double top;  /* largest speed 2 k w0, rad/s */
  double size; /* k as a double: sine of half the amplitude */
  rot_jacobi jacobi;
  double m1_loss; /* error of m1: relative; absolute on the separatrix */
} pendulum;

/* ---- the start ------------------------------------------------------------------------------ */

static rot_dd square(rot_dd x) { return rot_dd_mul(x, x); }

/* Sine and cosine of phi/2. The angle is reduced to the nearest hanging position before any
 * rounding: the smaller one keeps its digits, also near the top. */
static void half_angle(pendulum *out, double theta, double rest, double gravity) {
  const int hangs_up = gravity < 0.0;
  rot_dd r;
  double n = rot_dd_quarter_turns(rot_dd_ldexp(rot_dd_sum2(theta, -rest), -1), &r) - hangs_up;
  const rot_dd s = rot_dd_sine(r);
  const rot_dd c = rot_dd_sqrt(rot_dd_sub((rot_dd){1.0, 0.0}, square(s)));
  if (fmod(n, 2.0) == 0.0) {
    out->sine = s;
    out->cosine = c;
  } else if (r.hi <= 0.0) { /* phi/2 = pi/2 + r */
    n -= 1.0;
    out->sine = c;
    out->cosine = rot_dd_neg(s);
  } else {
    n += 1.0;
    out->sine = rot_dd_neg(c);
    out->cosine = s;
  }
  out->half_turns = n + hangs_up;
}

/* x => number near 1, binary exponent. */
static rot_dd split(rot_dd x, int *exponent) {
  (void)frexp(x.hi, exponent);
  return rot_dd_ldexp(x, -*exponent);
}

static void rates(pendulum *out, rot_dd inertia, rot_dd gravity, double omega) {
  int ei, eg, eo = 0;
  const rot_dd mi = split(inertia, &ei), mg = split(rot_dd_abs(gravity), &eg);
  const double mo = frexp(omega, &eo);
  const int e = eg - ei, half = (e >= 0 ? e : e - 1) / 2;
  out->exponent = -half;
  out->w0 = rot_dd_sqrt(rot_dd_ldexp(rot_dd_div(mg, mi), e - 2 * half));
  out->speed = rot_dd_div((rot_dd){mo, 0.0}, out->w0);
  out->speed_exponent = eo - 1 - half;
}

/* k^2 = sine^2 + speed^2 without over- or underflow. */
static void modulus(pendulum *out) {
  int es = 0, ev = 0;
  (void)frexp(out->sine.hi, &es);
  (void)frexp(out->speed.hi, &ev);
  ev += out->speed_exponent;
  const int moves = out->speed.hi != 0.0;
  out->k_exponent = moves && (out->sine.hi == 0.0 || ev > es) ? ev : es;
  const rot_dd s = rot_dd_ldexp(out->sine, -out->k_exponent);
  const rot_dd v = rot_dd_ldexp(out->speed, out->speed_exponent - out->k_exponent);
  out->k = rot_dd_sqrt(rot_dd_add(square(s), square(v)));
  out->size = ldexp(out->k.hi, out->k_exponent);
}

/* (1 - k^2) 4^-e = (cosine^2 - speed^2) 4^-e, the distance from the separatrix, as a product; error
 * of the difference: 2^-100 of cosine^2. */
static rot_dd distance(const pendulum *p, int e, double *error) {
  const rot_dd c = rot_dd_ldexp(p->cosine, -e);
  const rot_dd v = rot_dd_ldexp(rot_dd_abs(p->speed), p->speed_exponent - e);
  *error = 2.0 * ROT_DD_EPS * (c.hi + v.hi) * (c.hi + v.hi);
  return rot_dd_mul(rot_dd_sub(c, v), rot_dd_add(c, v));
}

static void begin_swing(pendulum *p, rot_dd m1) {
  const rot_dd s = rot_dd_ldexp(p->sine, -p->k_exponent);
  const rot_dd v = rot_dd_ldexp(p->speed, p->speed_exponent - p->k_exponent);
  p->manner = TO_AND_FRO;
  rot_jacobi_begin(m1, &p->jacobi);
  p->rate = p->w0;
  p->start = rot_jacobi_argument(&p->jacobi, fabs(s.hi / p->k.hi), fabs(v.hi / p->k.hi),
                                 p->cosine.hi, &p->start_error);
  if (v.hi < 0.0) { /* moving back: u reflected at K */
    p->start = rot_dd_sub(rot_dd_ldexp(p->jacobi.k, 1), p->start);
  }
  if (s.hi < 0.0) p->start = rot_dd_neg(p->start);
}

static void begin_turning(pendulum *p, rot_dd over) {
  const rot_dd v = rot_dd_ldexp(rot_dd_abs(p->speed), p->speed_exponent - p->k_exponent);
  p->manner = ALL_ROUND;
  rot_jacobi_begin(rot_dd_div(over, square(p->k)), &p->jacobi);
  p->rate = rot_dd_mul(p->k, p->w0); /* its exponent: see run_of_u() */
  p->start =
      rot_jacobi_argument(&p->jacobi, p->sine.hi, p->cosine.hi, v.hi / p->k.hi, &p->start_error);
}

static void begin_separatrix(pendulum *p, double error) {
  const int exact = p->w0.lo == 0.0 && p->speed.lo == 0.0 && p->sine.hi == 0.0;
  p->manner = SEPARATRIX;
  p->rate = p->w0;
  p->start = (rot_dd){asinh(p->sine.hi / p->cosine.hi), 0.0};
  p->start_error = 8.0 * ROT_EPS * fabs(p->start.hi);
  p->m1_loss = exact ? 0.0 : error;
}

/* state at the start => kind of motion, modulus, argument. */
static void begin(pendulum *p, rot_dd inertia, rot_dd gravity, double theta, double rest,
                  double omega) {
  half_angle(p, theta, rest, gravity.hi);
  rates(p, inertia, gravity, omega);
  modulus(p);
  const int e = p->k_exponent > 0 ? p->k_exponent : 0;
  double error;
  const rot_dd from = distance(p, e, &error);
  p->sign = 1.0;
  p->top = ldexp(p->k.hi * p->w0.hi, 1 + p->k_exponent - p->exponent);
  p->m1_loss = error / fabs(from.hi);
  if (omega == 0.0 && (p->sine.hi == 0.0 || p->cosine.hi == 0.0)) {
    p->manner = STILL;
  } else if (p->cosine.hi < nearest_top &&
             fabs(p->speed.hi) < ldexp(nearest_top, -p->speed_exponent)) {
    p->manner = TOO_NEAR;
  } else if (from.hi > 0.0) {
    begin_swing(p, rot_dd_ldexp(from, 2 * e));
  } else {
    p->sign = omega < 0.0 ? -1.0 : 1.0;
    if (from.hi < 0.0) {
      begin_turning(p, rot_dd_ldexp(rot_dd_neg(from), 2 * (e - p->k_exponent)));
    } else {
      begin_separatrix(p, error);
    }
  }
}

/* ---- the motion ----------------------------------------------------------------------------- */

/* s seconds => change of u. */
static rot_dd run_of_u(const pendulum *p, rot_dd s) {
  const int e = p->manner == ALL_ROUND ? p->k_exponent - p->exponent : -p->exponent;
  const rot_dd run = rot_dd_ldexp(rot_dd_mul(p->rate, rot_dd_mul1(s, p->sign)), e);
  return rot_dd_add(run, p->start);
}

/* phi = pi half_turns + 2 half_phi, |half_phi| <= pi/4: small angles from top and bottom keep their
 * digits. */
typedef struct pose {
  double half_phi, omega;
  rot_dd half_turns;
  double half_phi_error, omega_error;
} pose;

static void set_angle(pose *out, double sine, double cosine, double turns) {
  const double side = sine < 0.0 ? -1.0 : 1.0;
  const int high = cosine < fabs(sine);
  out->half_turns = rot_dd_sum2(2.0 * turns, high ? side : 0.0);
  out->half_phi = high ? -side * atan2(cosine, fabs(sine)) : atan2(sine, cosine);
}

/* Error of u. Above 2^52 even the number of turns is rounded. */
static double argument_error(const pendulum *p, rot_dd u, double turns) {
  const double uncounted =
      fabs(turns) > 0x1p52 ? p->jacobi.k.hi * (2.0 + 0x1p-51 * fabs(turns)) : 0.0;
  return p->start_error + 8.0 * ROT_DD_EPS * fabs(u.hi) + (fabs(turns) + 1.0) * p->m1_loss +
         uncounted;
}

/* Relative rounding of sn, cn, dn at r, |r| <= K, and of their products. */
static double roundings(const pendulum *p, rot_dd r) {
  const double x = fabs(r.hi);
  return ROT_EPS * (18.0 + 6.0 * fmin(x, fabs(p->jacobi.k.hi - x)));
}

static void swing_pose(const pendulum *p, rot_dd u, pose *out) {
  double sn, cn, dn;
  rot_dd r = u;
  int quarter;
  const double turns = rot_jacobi_reduce(&p->jacobi, &r, &quarter),
               du = argument_error(p, u, turns);
  rot_jacobi_at(&p->jacobi, r, &sn, &cn, &dn);
  if (quarter % 2) {
    sn = -sn;
    cn = -cn;
  }
  const double k = p->size;
  set_angle(out, k * sn, dn, 0.0);
  out->omega = p->top * cn;
  out->half_phi_error = roundings(p, r) * k * fabs(sn) * dn + k * fabs(cn) * du;
  out->omega_error = p->top * (roundings(p, r) * fabs(cn) + fabs(sn) * dn * du);
}

static void turning_pose(const pendulum *p, rot_dd u, pose *out) {
  double sn, cn, dn;
  rot_dd r = u;
  int quarter;
  const double turns = rot_jacobi_reduce(&p->jacobi, &r, &quarter),
               du = argument_error(p, u, turns);
  const double m = 1.0 - p->jacobi.m1;
  rot_jacobi_at(&p->jacobi, r, &sn, &cn, &dn);
  set_angle(out, sn, cn, turns);
  out->omega = p->sign * p->top * dn;
  out->half_phi_error = roundings(p, r) * fabs(sn * cn) + dn * du;
  out->omega_error = p->top * (roundings(p, r) * dn + m * fabs(sn * cn) * du);
}

/* Taking a small m1 as 0 changes phi/2 by m1 sinh(u)/4. */
static void separatrix_pose(const pendulum *p, rot_dd u, pose *out) {
  const double sech = 1.0 / cosh(u.hi);
  const double du =
      (p->start_error + ROT_EPS * fabs(u.hi)) * sech + p->m1_loss * fmin(cosh(u.hi), 1e300);
  set_angle(out, tanh(u.hi), sech, 0.0);
  out->omega = p->sign * p->top * sech;
  out->half_phi_error = 8.0 * ROT_EPS * sech + du;
  out->omega_error = p->top * (8.0 * ROT_EPS * sech + du);
}

/* Absolute error of results below the smallest normal double. */
static const double min_error = 0x1p-1070;

/* t => angle, rate, their bounds. */
static void state_at(const void *model, double t, rot_axle_point *state) {
  static const rot_dd pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
  const pendulum *p = model;
  const rot_axle_params *at = &p->scene->linear;
  const double rest = p->scene->terms[0].x[1];
  pose at_t;
  if (p->manner == STILL || t == at->start_s) {
    *state = (rot_axle_point){at->theta0_rad, at->omega0_rad_per_s, 0.0, 0.0, 0.0};
    return;
  }
  const rot_dd u = run_of_u(p, rot_dd_sum2(t, -at->start_s));
  if (p->manner == TO_AND_FRO) {
    swing_pose(p, u, &at_t);
  } else if (p->manner == ALL_ROUND) {
    turning_pose(p, u, &at_t);
  } else {
    separatrix_pose(p, u, &at_t);
  }
  const rot_dd whole = rot_dd_mul(pi, rot_dd_add1(at_t.half_turns, p->half_turns));
  const rot_dd theta = rot_dd_add1(rot_dd_add1(whole, rest), 2.0 * at_t.half_phi);
  state->theta_rad = theta.hi;
  state->theta_lo = theta.lo;
  state->omega_rad_per_s = at_t.omega;
  state->theta_error = 2.0 * (at_t.half_phi_error + 2.0 * ROT_EPS * fabs(at_t.half_phi)) +
                       ROT_EPS * fabs(state->theta_rad) +
                       4.0 * ROT_DD_EPS * (fabs(whole.hi) + fabs(rest)) + min_error;
  state->omega_error = at_t.omega_error + min_error;
}

static void restart(void *model, int forward) { ((pendulum *)model)->forward = forward; }

static double piece_end(const void *model) {
  return ((const pendulum *)model)->forward ? INFINITY : -INFINITY;
}

static int fits(const rot_axle_scene *scene) {
  const rot_term *term = scene->terms;
  return rot_axle_fits(scene, ROT_AXLE_PENDULUM_TAKES) && scene->n_terms == 1 &&
         term->from_s == -INFINITY && term->to_s == INFINITY && term->x[0] != 0.0;
}

static const double farthest = 1e15; /* rad: below it whole turns are exact */

static rot_status begin_scene(pendulum *run, const rot_axle_scene *scene) {
  const rot_axle_params *p = &scene->linear;
  const double *x = scene->terms[0].x, rest = x[1];
  const rot_dd gravity = {x[0], scene->terms[0].length > 2 ? x[2] : 0.0};
  const rot_dd inertia = {p->inertia_kg_m2, scene->inertia_lo};
  if (!(fabs(p->theta0_rad - rest) <= farthest)) return ROT_ERANGE;
  begin(run, inertia, gravity, p->theta0_rad, rest, p->omega0_rad_per_s);
  return run->manner == TOO_NEAR ? ROT_ERANGE : ROT_OK;
}

rot_status rot_axle_pendulum(const rot_axle_scene *scene, size_t n, const double time_s[],
                             const rot_axle_columns *out, rot_events *events,
                             const rot_hooks *hooks, rot_info *info) {
  static const rot_axle_pieces pieces = {restart, piece_end, NULL, state_at};
  pendulum run = {.scene = scene};
  (void)events; /* none occur */
  rot_info_clear(info, rot_turning);
  if (!fits(scene)) return info->status = ROT_EVALUE;
  info->status = begin_scene(&run, scene);
  if (info->status != ROT_OK) return info->status;
  return rot_axle_by_pieces(scene, &pieces, &run, n, time_s, out, hooks, info);
}

/* motion => period, amplitude: Inf and pi on the separatrix and if balanced; NaN if rotating or not
 * resolved. */
static double period_of(const pendulum *p, double *amplitude) {
  *amplitude = 0.0;
  if (p->manner == STILL && p->sine.hi == 0.0) { /* limit of small swings */
    return ldexp(0x1.921fb54442d18p+2 / p->w0.hi, p->exponent);
  }
  if (p->manner == TO_AND_FRO) {
    *amplitude = 2.0 * atan2(p->size, p->jacobi.g[0]);
    return ldexp(4.0 * p->jacobi.k.hi / p->w0.hi, p->exponent);
  }
  *amplitude = NAN;
  if (p->manner == ALL_ROUND) {
    return ldexp(2.0 * p->jacobi.k.hi / p->rate.hi, p->exponent - p->k_exponent);
  }
  if (p->manner == TOO_NEAR) return NAN;
  *amplitude = 0x1.921fb54442d18p+1;
  return INFINITY;
}

double rot_pendulum_period(double inertia_kg_m2, double gravity_n_m, double theta_rad,
                           double omega_rad_per_s) {
  pendulum p = {0};
  double amplitude;
  if (!(fabs(theta_rad) <= farthest) || gravity_n_m == 0.0) return NAN;
  const rot_dd inertia = {inertia_kg_m2, 0.0}, gravity = {gravity_n_m, 0.0};
  begin(&p, inertia, gravity, theta_rad, 0.0, omega_rad_per_s);
  return period_of(&p, &amplitude);
}

rot_status rot_axle_pendulum_period(const rot_axle_scene *scene, double *period_s,
                                    double *amplitude_rad) {
  pendulum p = {0};
  *period_s = *amplitude_rad = NAN;
  if (!fits(scene)) return ROT_EVALUE;
  const rot_status status = begin_scene(&p, scene);
  if (status == ROT_OK) *period_s = period_of(&p, amplitude_rad);
  return status;
}
