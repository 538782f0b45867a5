#include "tables/kinematics.h"

#include <math.h>

#include "ground/real.h"

/* ---- numbers with 106 bits and a separate exponent ------------------------------------------
 *
 * (hi + lo) 2^e, with |hi| in [1/2, 1) and lo below half an ulp of hi, or all zero. Products of
 * doubles are exact. A sum has a relative error of 3 2^-106, also where it cancels (Joldes, Muller
 * & Popescu 2017, algorithm 6), and no intermediate result overflows. */
typedef struct extended {
  double hi, lo;
  int e;
} extended;

static extended normal(double hi, double lo, int e) {
  int shift = 0;
  extended x;
  const double sum = hi + lo;
  lo = lo - (sum - hi);
  x.hi = frexp(sum, &shift);
  x.lo = ldexp(lo, -shift);
  x.e = sum != 0.0 ? e + shift : 0;
  return x;
}

static extended extended_of(double x) { return normal(x, 0.0, 0); }

static double narrow(extended x) { return ldexp(x.hi, x.e); }

static extended scaled(extended x, int power_of_two) {
  if (x.hi != 0.0) x.e += power_of_two;
  return x;
}

static extended minus(extended x) { return (extended){-x.hi, -x.lo, x.e}; }

static extended times(extended x, extended y) {
  double lo;
  const double hi = rot_two_prod(x.hi, y.hi, &lo);
  return normal(hi, lo + (x.hi * y.lo + x.lo * y.hi), x.e + y.e);
}

/* (x, y) => x + y, aligned to the larger exponent */
static extended plus(extended x, extended y) {
  double lo, far, farther;
  if (x.hi == 0.0) return y;
  if (y.hi == 0.0) return x;
  if (x.e < y.e) {
    const extended swap = x;
    x = y;
    y = swap;
  }
  const int shift = y.e - x.e;
  if (shift < -220) return x; /* y is below the last bit of x */
  const double hi = rot_two_sum(x.hi, ldexp(y.hi, shift), &lo);
  far = rot_two_sum(x.lo, ldexp(y.lo, shift), &farther);
  lo += far;
  const double top = hi + lo;
  lo = lo - (top - hi);
  return normal(top, farther + lo, x.e);
}

static extended over(extended x, extended y) {
  double lo;
  const double q = x.hi / y.hi, p = rot_two_prod(q, y.hi, &lo);
  const double rest = ((x.hi - p) - lo) + (x.lo - q * y.lo);
  return normal(q, rest / y.hi, x.e - y.e);
}

static extended root(extended x) {
  if (!(x.hi > 0.0)) return extended_of(0.0);
  if (x.e % 2) x = (extended){2.0 * x.hi, 2.0 * x.lo, x.e - 1};
  double lo;
  const double s = sqrt(x.hi), square = rot_two_prod(s, s, &lo);
  return normal(s, ((x.hi - square) - lo + x.lo) / (2.0 * s), x.e / 2);
}

/* ---- the ten cases --------------------------------------------------------------------------
 *
 * Functions for seven of them; the other three follow by time reversal, which exchanges omega0 and
 * omega and changes the signs of time and angle. */
enum {
  THETA = 1 << ROT_MOTION_THETA,
  OMEGA0 = 1 << ROT_MOTION_OMEGA0,
  OMEGA = 1 << ROT_MOTION_OMEGA,
  ALPHA = 1 << ROT_MOTION_ALPHA,
  TIME = 1 << ROT_MOTION_TIME
};

static rot_motion_kind from_rates_and_time(double x[ROT_MOTION_SIZE]) {
  const extended before = extended_of(x[ROT_MOTION_OMEGA0]),
                 after = extended_of(x[ROT_MOTION_OMEGA]);
  const extended t = extended_of(x[ROT_MOTION_TIME]);
  if (t.hi == 0.0) {
    if (x[ROT_MOTION_OMEGA0] != x[ROT_MOTION_OMEGA]) return ROT_MOTION_IMPOSSIBLE;
    x[ROT_MOTION_THETA] = 0.0;
    return ROT_MOTION_UNDETERMINED;
  }
  x[ROT_MOTION_ALPHA] = narrow(over(plus(after, minus(before)), t));
  x[ROT_MOTION_THETA] = narrow(scaled(times(plus(before, after), t), -1));
  return ROT_MOTION_ONE;
}

static rot_motion_kind from_rates_and_alpha(double x[ROT_MOTION_SIZE]) {
  const extended before = extended_of(x[ROT_MOTION_OMEGA0]),
                 after = extended_of(x[ROT_MOTION_OMEGA]);
  const extended alpha = extended_of(x[ROT_MOTION_ALPHA]);
  if (alpha.hi == 0.0) {
    return x[ROT_MOTION_OMEGA0] == x[ROT_MOTION_OMEGA] ? ROT_MOTION_UNDETERMINED
                                                       : ROT_MOTION_IMPOSSIBLE;
  }
  const extended t = over(plus(after, minus(before)), alpha);
  x[ROT_MOTION_TIME] = narrow(t);
  x[ROT_MOTION_THETA] = narrow(scaled(times(plus(before, after), t), -1));
  return ROT_MOTION_ONE;
}

static rot_motion_kind from_rates_and_angle(double x[ROT_MOTION_SIZE]) {
  const extended before = extended_of(x[ROT_MOTION_OMEGA0]),
                 after = extended_of(x[ROT_MOTION_OMEGA]);
  const extended theta = extended_of(x[ROT_MOTION_THETA]), sum = plus(before, after);
  if (sum.hi == 0.0) return theta.hi == 0.0 ? ROT_MOTION_UNDETERMINED : ROT_MOTION_IMPOSSIBLE;
  if (theta.hi == 0.0) { /* the mean rate is not 0 and the angle is: the time is 0 */
    if (x[ROT_MOTION_OMEGA0] != x[ROT_MOTION_OMEGA]) return ROT_MOTION_IMPOSSIBLE;
    x[ROT_MOTION_TIME] = 0.0;
    return ROT_MOTION_UNDETERMINED;
  }
  x[ROT_MOTION_TIME] = narrow(scaled(over(theta, sum), 1));
  x[ROT_MOTION_ALPHA] = narrow(scaled(over(times(plus(after, minus(before)), sum), theta), -1));
  return ROT_MOTION_ONE;
}

static rot_motion_kind from_start_alpha_time(double x[ROT_MOTION_SIZE]) {
  const extended before = extended_of(x[ROT_MOTION_OMEGA0]), t = extended_of(x[ROT_MOTION_TIME]);
  const extended gain = times(extended_of(x[ROT_MOTION_ALPHA]), t);
  x[ROT_MOTION_OMEGA] = narrow(plus(before, gain));
  x[ROT_MOTION_THETA] = narrow(times(plus(before, scaled(gain, -1)), t));
  return ROT_MOTION_ONE;
}

/* omega = +-s with s^2 = omega0^2 + 2 alpha theta. With q = omega0 + sign(omega0) s, which does not
 * cancel, the times are 2 theta/q for the omega with the sign of omega0 and -q/alpha for the other.
 */
static rot_motion_kind from_start_alpha_angle(double x[2][ROT_MOTION_SIZE]) {
  const extended before = extended_of(x[0][ROT_MOTION_OMEGA0]),
                 alpha = extended_of(x[0][ROT_MOTION_ALPHA]);
  const extended theta = extended_of(x[0][ROT_MOTION_THETA]);
  if (alpha.hi == 0.0) {
    if (before.hi == 0.0 && theta.hi != 0.0) return ROT_MOTION_IMPOSSIBLE;
    x[0][ROT_MOTION_OMEGA] = x[0][ROT_MOTION_OMEGA0];
    if (before.hi == 0.0) return ROT_MOTION_UNDETERMINED;
    x[0][ROT_MOTION_TIME] = narrow(over(theta, before));
    return ROT_MOTION_ONE;
  }
  const extended square = plus(times(before, before), scaled(times(alpha, theta), 1));
  if (square.hi < 0.0) return ROT_MOTION_IMPOSSIBLE;
  if (square.hi == 0.0) {
    x[0][ROT_MOTION_OMEGA] = 0.0;
    x[0][ROT_MOTION_TIME] = narrow(minus(over(before, alpha)));
    return ROT_MOTION_ONE;
  }
  const extended s = before.hi < 0.0 ? minus(root(square)) : root(square), q = plus(before, s);
  const int other_first = (q.hi > 0.0) == (alpha.hi > 0.0); /* times differ by 2 s/alpha */
  for (int i = 0; i < ROT_MOTION_SIZE; i++) x[1][i] = x[0][i];
  double *same = x[other_first], *other = x[!other_first];
  same[ROT_MOTION_OMEGA] = narrow(s);
  same[ROT_MOTION_TIME] = narrow(scaled(over(theta, q), 1));
  other[ROT_MOTION_OMEGA] = narrow(minus(s));
  other[ROT_MOTION_TIME] = narrow(minus(over(q, alpha)));
  return ROT_MOTION_TWO;
}

static rot_motion_kind from_start_time_angle(double x[ROT_MOTION_SIZE]) {
  const extended before = extended_of(x[ROT_MOTION_OMEGA0]), t = extended_of(x[ROT_MOTION_TIME]);
  const extended theta = extended_of(x[ROT_MOTION_THETA]);
  if (t.hi == 0.0) {
    if (theta.hi != 0.0) return ROT_MOTION_IMPOSSIBLE;
    x[ROT_MOTION_OMEGA] = x[ROT_MOTION_OMEGA0];
    return ROT_MOTION_UNDETERMINED;
  }
  /* omega t = 2 theta - omega0 t: one division, at the end. */
  const extended turned = times(before, t);
  x[ROT_MOTION_OMEGA] = narrow(over(plus(scaled(theta, 1), minus(turned)), t));
  x[ROT_MOTION_ALPHA] = narrow(scaled(over(plus(theta, minus(turned)), times(t, t)), 1));
  return ROT_MOTION_ONE;
}

/* => theta + sign alpha t^2/2. The product of three factors has 159 bits and theta may cancel the
 * first hundred: exact partial products are added in descending order. */
static extended angle_with_half(extended theta, extended alpha, extended t, double sign) {
  const extended rate = times(alpha, t);
  const extended max = times(normal(sign * rate.hi, 0.0, rate.e - 1), t);
  const extended rest = times(normal(sign * rate.lo, 0.0, rate.e - 1), t);
  const extended first = plus(theta, normal(max.hi, 0.0, max.e));
  const extended second = plus(normal(max.lo, 0.0, max.e), normal(rest.hi, 0.0, rest.e));
  return plus(plus(first, second), normal(rest.lo, 0.0, rest.e));
}

/* theta = (omega0 + alpha t/2) t = (omega - alpha t/2) t. */
static rot_motion_kind from_alpha_time_angle(double x[ROT_MOTION_SIZE]) {
  const extended alpha = extended_of(x[ROT_MOTION_ALPHA]), t = extended_of(x[ROT_MOTION_TIME]);
  const extended theta = extended_of(x[ROT_MOTION_THETA]);
  if (t.hi == 0.0) return theta.hi == 0.0 ? ROT_MOTION_UNDETERMINED : ROT_MOTION_IMPOSSIBLE;
  x[ROT_MOTION_OMEGA0] = narrow(over(angle_with_half(theta, alpha, t, -1.0), t));
  x[ROT_MOTION_OMEGA] = narrow(over(angle_with_half(theta, alpha, t, 1.0), t));
  return ROT_MOTION_ONE;
}

static void turn_back(double x[ROT_MOTION_SIZE]) {
  const double before = x[ROT_MOTION_OMEGA0];
  x[ROT_MOTION_OMEGA0] = x[ROT_MOTION_OMEGA];
  x[ROT_MOTION_OMEGA] = before;
  x[ROT_MOTION_THETA] = -x[ROT_MOTION_THETA];
  x[ROT_MOTION_TIME] = -x[ROT_MOTION_TIME];
}

static rot_motion_kind forwards(unsigned given, double x[2][ROT_MOTION_SIZE]) {
  switch (given) {
  case OMEGA0 | OMEGA | TIME: return from_rates_and_time(x[0]);
  case OMEGA0 | OMEGA | ALPHA: return from_rates_and_alpha(x[0]);
  case OMEGA0 | OMEGA | THETA: return from_rates_and_angle(x[0]);
  case OMEGA0 | ALPHA | TIME: return from_start_alpha_time(x[0]);
  case OMEGA0 | ALPHA | THETA: return from_start_alpha_angle(x);
  case OMEGA0 | TIME | THETA: return from_start_time_angle(x[0]);
  case ALPHA | TIME | THETA: return from_alpha_time_angle(x[0]);
  default: return ROT_MOTION_IMPOSSIBLE;
  }
}

static rot_motion_kind backwards(unsigned given, double x[2][ROT_MOTION_SIZE]) {
  turn_back(x[0]);
  const rot_motion_kind kind = forwards((given & ~(unsigned)OMEGA) | OMEGA0, x);
  turn_back(x[0]);
  if (kind == ROT_MOTION_TWO) {
    turn_back(x[1]);
    for (int i = 0; i < ROT_MOTION_SIZE; i++) { /* the order of times is reversed */
      const double swap = x[0][i];
      x[0][i] = x[1][i];
      x[1][i] = swap;
    }
  }
  return kind;
}

rot_motion_kind rot_motion_solve(unsigned given, double x[2][ROT_MOTION_SIZE]) {
  double missing = 0.0;
  for (unsigned i = 0; i < ROT_MOTION_SIZE; i++) {
    if (!(given >> i & 1U))
      x[0][i] = NAN;
    else if (isnan(x[0][i]))
      missing = x[0][i];
  }
  if (isnan(missing)) {
    for (unsigned i = 0; i < ROT_MOTION_SIZE; i++) {
      if (!(given >> i & 1U)) x[0][i] = missing;
    }
    return ROT_MOTION_ONE;
  }
  const int from_the_end = (given & OMEGA) && !(given & OMEGA0);
  return from_the_end ? backwards(given, x) : forwards(given, x);
}

/* ---- a point of the body -------------------------------------------------------------------- */

double rot_tangential_speed(double omega, double radius) { return omega * radius; }

double rot_tangential_acceleration(double alpha, double radius) { return alpha * radius; }

double rot_centripetal_acceleration(double omega, double radius) {
  const double x[] = {omega, omega, radius};
  return rot_product(3, x, 1.0);
}

double rot_total_acceleration(double omega, double alpha, double radius) {
  return hypot(rot_tangential_acceleration(alpha, radius),
               rot_centripetal_acceleration(omega, radius));
}

/* omega^2 may overflow for a finite angle: its power of two is moved to alpha. */
double rot_acceleration_angle(double omega, double alpha) {
  int e = 0;
  const double m = frexp(omega, &e);
  return atan2(ldexp(alpha, -2 * e), m * m);
}

/* ---- units of angles ------------------------------------------------------------------------ */

static const struct {
  double hi, lo;
} factor[] = {
#define X(code, hi, lo) {hi, lo},
    ROT_ANGLE_UNIT_LIST(X)
#undef X
};

/* frexp() keeps the low part of the product from underflow, and from NaN at infinity. */
double rot_convert_angle(double x, rot_angle_unit unit) {
  int e = 0;
  const double m = frexp(x, &e);
  double lo;
  const double hi = rot_two_prod(m, factor[unit].hi, &lo);
  return isfinite(x) ? ldexp(hi + (lo + m * factor[unit].lo), e) : x;
}

/* ---- moments -------------------------------------------------------------------------------- */

void rot_moment(double mass, const double position[3], const double about[3],
                const double vector[3], double out[3]) {
  extended r[3], f[3];
  for (int i = 0; i < 3; i++) {
    r[i] = plus(extended_of(position[i]), minus(extended_of(about[i])));
    f[i] = times(extended_of(mass), extended_of(vector[i]));
  }
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = narrow(plus(times(r[j], f[k]), minus(times(r[k], f[j]))));
  }
}

double rot_lever(double mass, double radius, double size, double angle_deg) {
  const double x[] = {mass, radius, size, rot_sin_deg(angle_deg)};
  extended product = extended_of(x[0]);
  for (int i = 0; i < 4; i++) {
    if (!isfinite(x[i])) return mass * radius * size * x[3];
    if (i) product = times(product, extended_of(x[i]));
  }
  return narrow(product);
}
