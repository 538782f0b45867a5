#include "tables/frame.h"

#include <math.h>

#include "ground/dd_trig.h"
#include "ground/real.h"

/* ---- relative to the ground ------------------------------------------------------------------ */

/* y => (y - sin y)/y^2. Series for |y| < 1: the terms decrease by a factor of 42 or more. */
static double sine_lack(double y) {
  if (fabs(y) >= 1.0) return (y - sin(y)) / y / y;
  const double y2 = y * y;
  double sum = 0.0;
  for (int k = 10; k >= 1; k--) sum = (1.0 - y2 * sum) / (2.0 * k * (2.0 * k + 1.0));
  return y * sum;
}

/* y => (1 - cos y)/y^2 */
static double cosine_lack(double y) {
  const double h = 0.5 * y, s = h == 0.0 ? 1.0 : sin(h) / h;
  return 0.5 * s * s;
}

/* y => (1 - cos y)/y^2 - 1/2 */
static double cosine_rest(double y) {
  if (fabs(y) >= 1.0) return cosine_lack(y) - 0.5;
  const double y2 = y * y;
  double sum = 0.0;
  for (int k = 10; k >= 2; k--) sum = (1.0 - y2 * sum) / ((2.0 * k - 1.0) * 2.0 * k);
  return -0.5 * y2 * sum;
}

static double sine_over(double y) { return y == 0.0 ? 1.0 : sin(y) / y; }

/* The axis of rotation is (0, c, s) in east, north, up. In the plane normal to it, along east and
 * (0, s, -c), the velocity rotates by -2 Omega t. */
rot_projectile rot_frame_projectile(const rot_projectile_input *in) {
  rot_projectile out;
  const double c = rot_sin_deg(90.0 - fabs(in->latitude_deg)), s = rot_sin_deg(in->latitude_deg);
  const double t = in->time_s, g = in->gravity_m_per_s2, omega = in->omega_rad_per_s;
  const double *v = in->v_m_per_s;
  const double y = 2.0 * omega * t;
  const double v1 = v[0], v2 = v[1] * s - v[2] * c, along = v[1] * c + v[2] * s;
  const double lack = sine_lack(y), turn = y * cosine_lack(y);
  const double east = g * c * t * t * lack + t * (v2 * turn - v1 * y * lack);
  const double across = g * c * t * t * cosine_rest(y) - t * (v2 * y * lack + v1 * turn);
  out.deflection_m[0] = east;
  out.deflection_m[1] = s * across;
  out.deflection_m[2] = -c * across;
  if (fabs(y) < 1.0) {
    out.r_m[0] = v[0] * t + east;
    out.r_m[1] = v[1] * t + out.deflection_m[1];
    out.r_m[2] = v[2] * t - 0.5 * g * t * t + out.deflection_m[2];
  } else { /* the position is far from the parabola: computed directly */
    const double r1 = g * c * t * t * lack + t * (v1 * sine_over(y) + v2 * turn);
    const double r2 = g * c * t * t * cosine_lack(y) + t * (v2 * sine_over(y) - v1 * turn);
    const double r3 = along * t - 0.5 * g * s * t * t;
    out.r_m[0] = r1;
    out.r_m[1] = s * r2 + c * r3;
    out.r_m[2] = s * r3 - c * r2;
  }
  const double cosine = cos(y), sine = sin(y);
  const double w1 = g * c * t * turn + v1 * cosine + v2 * sine;
  const double w2 = g * c * t * sine_over(y) + v2 * cosine - v1 * sine;
  const double w3 = along - g * s * t;
  out.v_m_per_s[0] = w1;
  out.v_m_per_s[1] = s * w2 + c * w3;
  out.v_m_per_s[2] = s * w3 - c * w2;
  out.first_order_m[0] = omega * t * t * (s * v[1] - c * v[2] + g * c * t / 3.0);
  out.first_order_m[1] = -omega * t * t * s * v[0];
  out.first_order_m[2] = omega * t * t * c * v[0];
  /* |y - sin y| <= |y|^3/6 and so on, for each y */
  const double h = fabs(y);
  out.first_order_error_m = hypot(v1, v2) * fabs(t) * h * h * (1.0 / 6.0 + h / 24.0) +
                            fabs(g * c) * t * t * h * h * (1.0 / 24.0 + h / 120.0);
  return out;
}

/* t => depth, its rate */
static double depth(double omega, double c, double s, double g, double t, double *rate) {
  const double y = 2.0 * omega * t;
  *rate = g * t * (c * c * sine_over(y) + s * s);
  return g * t * t * (c * c * cosine_lack(y) + 0.5 * s * s);
}

/* => time of the largest depth, where the rate changes from + to - */
static double deepest_between(double omega, double c, double s, double g, double low, double high) {
  for (int i = 0; i < 60; i++) {
    const double t = 0.5 * (low + high);
    double rate;
    (void)depth(omega, c, s, g, t, &rate);
    if (rate > 0.0) {
      low = t;
    } else {
      high = t;
    }
  }
  return low;
}

/* Height and gravity near 1: see rot_frame_fall_time(). */
static double scaled_fall_time(double omega, double c, double s, double g, double height) {
  /* The depth is at most g t^2/2: a lower bound of the time. */
  double low = sqrt(height / g) * sqrt(2.0), high = low, rate;
  if (!isfinite(omega)) return NAN;
  /* Many turns later c^2 sin(y)/y is below s^2: the depth increases for good, and is at least
   * s^2 g t^2/2. */
  const int steady = 2.0 * fabs(omega) * low * s * s > c * c;
  if (steady) high = low / fabs(s);
  const double step = fmin(low, omega == 0.0 ? low : 0.25 / fabs(omega));
  for (int i = 0; !steady && depth(omega, c, s, g, high, &rate) < height; i++) {
    const int falls = rate > 0.0;
    if (i == 100000) return NAN;
    low = high;
    high += i == 0 ? step * 0x1p-20 : i < 20 ? step * ldexp(1.0, i - 20) : step;
    if (falls && depth(omega, c, s, g, high, &rate) < height && rate < 0.0) {
      /* Near the equator the body rises again: check the largest depth in between. */
      const double deepest = deepest_between(omega, c, s, g, low, high);
      if (depth(omega, c, s, g, deepest, &rate) >= height) high = deepest;
    }
  }
  for (int i = 0; i < 60 && low < high; i++) {
    const double t = 0.5 * (low + high), d = depth(omega, c, s, g, t, &rate) - height;
    if (d < 0.0) {
      low = t;
    } else {
      high = t;
    }
    const double next = t - d / rate;
    if (next > low && next < high && fabs(next - t) < 1e-4 * t) {
      const double off = depth(omega, c, s, g, next, &rate) - height;
      return next - off / rate;
    }
  }
  return high;
}

double rot_frame_fall_time(double omega, double latitude_deg, double g, double height) {
  int eg, eh;
  const double c = rot_sin_deg(90.0 - fabs(latitude_deg)), s = rot_sin_deg(latitude_deg);
  if (height == 0.0) return 0.0;
  const double gravity = frexp(g, &eg), fall = frexp(height, &eh);
  const int odd = (eh - eg) % 2 != 0, half = (eh - eg - odd) / 2;
  return ldexp(scaled_fall_time(ldexp(omega, half), c, s, gravity, ldexp(fall, odd)), half);
}

/* (rate, t) => cosine and sine of rate t, with the phase to twice the precision; NaN: the phase is
 * undetermined */
static void phase_at(rot_dd rate, double t, double *cosine, double *sine) {
  const rot_dd x = rot_dd_mul1(rate, t);
  rot_dd s, c;
  if (fabs(x.hi) < 0x1p52) {
    rot_dd_sine_cosine(x, &s, &c);
    *cosine = c.hi;
    *sine = s.hi;
  } else {
    *cosine = *sine = NAN;
  }
}

/* => Omega sin(latitude) */
static rot_dd turning_rate(double omega, double latitude_deg) {
  static const rot_dd half_turn = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
  rot_dd s, c;
  const rot_dd degree = rot_dd_div(half_turn, (rot_dd){180.0, 0.0});
  rot_dd_sine_cosine(rot_dd_mul1(degree, latitude_deg), &s, &c);
  return rot_dd_mul1(s, omega);
}

/* => sqrt(gravity/length + turn^2) */
static rot_dd swing_rate(double gravity, double length, rot_dd turn) {
  int eg, el;
  const double ratio = gravity / length;
  const int normal = ratio > 1e-290 && ratio < 1e290;
  const double nu = hypot(normal ? sqrt(ratio) : sqrt(gravity) / sqrt(length), turn.hi);
  if (!(nu > 1e-100 && nu < 1e100)) return (rot_dd){nu, 0.0};
  const double g = frexp(gravity, &eg), l = frexp(length, &el);
  const rot_dd pull = rot_dd_ldexp(rot_dd_div((rot_dd){g, 0.0}, (rot_dd){l, 0.0}), eg - el);
  return rot_dd_sqrt(rot_dd_add(pull, rot_dd_mul(turn, turn)));
}

void rot_frame_foucault(double omega, double latitude_deg, double gravity, double length,
                        const double r0[2], const double v0[2], double t, double r[2], double v[2],
                        double *plane_rate, double *swing_rate_rad_per_s) {
  const rot_dd turns = turning_rate(omega, latitude_deg),
               swings = swing_rate(gravity, length, turns);
  const double turn = turns.hi, nu = swings.hi;
  double c, s, ct, st;
  *plane_rate = -turn;
  *swing_rate_rad_per_s = nu;
  phase_at(swings, t, &c, &s);
  phase_at(turns, t, &ct, &st);
  /* zeta = exp(-i turn t) (z0 cos(nu t) + (v0 + i turn z0) sin(nu t)/nu) */
  const double b[2] = {v0[0] - turn * r0[1], v0[1] + turn * r0[0]};
  double e[2], f[2];
  for (int i = 0; i < 2; i++) {
    e[i] = r0[i] * c + b[i] * (nu == 0.0 ? t : s / nu);
    f[i] = b[i] * c - nu * s * r0[i];
  }
  r[0] = ct * e[0] + st * e[1];
  r[1] = ct * e[1] - st * e[0];
  v[0] = ct * f[0] + st * f[1] + turn * r[1];
  v[1] = ct * f[1] - st * f[0] - turn * r[0];
}

double rot_frame_angle(double rate, double beta, double t) {
  rot_dd part = {rate, 0.0};
  if (isfinite(beta)) {
    part = rot_dd_div(rot_dd_mul2(beta, rate), rot_dd_sum2(1.0, beta));
    if (!isfinite(part.lo)) part = (rot_dd){beta / (1.0 + beta) * rate, 0.0};
  }
  const rot_dd angle = rot_dd_mul1(part, t);
  return fabs(angle.hi) < 0x1p52 ? rot_dd_less_double_turns(angle).hi : angle.hi;
}

/* ---- to a rotating frame and back ------------------------------------------------------------ */

/* (unit axis, angle, x) => x rotated */
static void rotate(const double axis[3], double angle, const double x[3], double out[3]) {
  const double sine = sin(angle), half = sin(0.5 * angle);
  double over[3], twice[3];
  rot_cross(axis, x, over);
  rot_cross(axis, over, twice);
  for (int i = 0; i < 3; i++) out[i] = x[i] + sine * over[i] + 2.0 * half * half * twice[i];
}

void rot_frame_terms(const rot_frame *frame, const double r_in[3], const double v_in[3],
                     double centrifugal[3], double coriolis[3], double euler[3]) {
  double over[3], twice[3], moving[3];
  const double w = frame->omega_rad_per_s;
  rot_cross(frame->axis, r_in, over);
  rot_cross(frame->axis, over, twice);
  rot_cross(frame->axis, v_in, moving);
  for (int i = 0; i < 3; i++) {
    centrifugal[i] = -w * w * twice[i];
    coriolis[i] = -2.0 * w * moving[i];
    euler[i] = -frame->alpha_rad_per_s2 * over[i];
  }
}

void rot_frame_enter(const rot_frame *frame, const double r[3], const double v[3],
                     const double a[3], double r_in[3], double v_in[3], double a_in[3]) {
  double over[3], term[3][3];
  rotate(frame->axis, -frame->theta_rad, r, r_in);
  rotate(frame->axis, -frame->theta_rad, v, v_in);
  rotate(frame->axis, -frame->theta_rad, a, a_in);
  rot_cross(frame->axis, r_in, over);
  for (int i = 0; i < 3; i++) v_in[i] -= frame->omega_rad_per_s * over[i];
  rot_frame_terms(frame, r_in, v_in, term[0], term[1], term[2]);
  for (int i = 0; i < 3; i++) a_in[i] += term[0][i] + term[1][i] + term[2][i];
}

void rot_frame_leave(const rot_frame *frame, const double r_in[3], const double v_in[3],
                     const double a_in[3], double r[3], double v[3], double a[3]) {
  double over[3], term[3][3], v_there[3], a_there[3];
  rot_cross(frame->axis, r_in, over);
  rot_frame_terms(frame, r_in, v_in, term[0], term[1], term[2]);
  for (int i = 0; i < 3; i++) {
    v_there[i] = v_in[i] + frame->omega_rad_per_s * over[i];
    a_there[i] = a_in[i] - (term[0][i] + term[1][i] + term[2][i]);
  }
  rotate(frame->axis, frame->theta_rad, r_in, r);
  rotate(frame->axis, frame->theta_rad, v_there, v);
  rotate(frame->axis, frame->theta_rad, a_there, a);
}
