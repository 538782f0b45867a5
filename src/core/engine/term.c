#include "engine/term.h"

#include <math.h>
#include <string.h>

#include "ground/dd_trig.h"
#include "maths/divided.h"
#include "ground/real.h"
#include "ground/search.h"

/* cos(a t + b): the product's residual counts where a t is large. */
static double wave(double a, double t, double b) {
  double lo, sum_lo, sine, cosine;
  const double at = rot_two_prod(a, t, &lo), angle = rot_two_sum(at, b, &sum_lo);
  rot_sin_cos(angle, lo + sum_lo, &sine, &cosine);
  return cosine;
}

/* x[0] times the width, sin(half)/half and cos(middle): half of the phase's change and its mean
 * have twice the precision, each with an error of less than 2^-100 of its terms. */
double rot_sinusoid_impulse(const double x[3], double from, double to, double *error) {
  const rot_dd width = rot_dd_sub((rot_dd){to, 0.0}, (rot_dd){from, 0.0});
  const rot_dd half = rot_dd_mul1(width, 0.5 * x[1]);
  const rot_dd mean = rot_dd_mul1(rot_dd_sum2(from, to), 0.5 * x[1]);
  const rot_dd middle = rot_dd_add1(mean, x[2]);
  const double turned = fabs(half.hi);
  if (!(turned + fabs(mean.hi) + fabs(x[2]) < 0x1p52)) {
    *error = (1.0 + 4.0 * ROT_EPS) * fabs(x[0]) * fmin(width.hi, 2.0 / fabs(x[1]));
    return 0.0;
  }
  double ratio = width.hi; /* width sin(half)/half */
  double phases = ratio;   /* what the errors of both phases are multiplied by */
  rot_dd sine, cosine, other;
  if (turned > 1e-9) {
    rot_dd_sine_cosine(half, &sine, &other);
    ratio *= sine.hi / half.hi;
    if (turned > 1.0) phases /= turned;
  }
  rot_dd_sine_cosine(middle, &other, &cosine);
  const double value = x[0] * ratio * cosine.hi;
  *error = 9.0 * ROT_EPS * fabs(value) +
           0x1p-100 * fabs(x[0]) * phases * (turned + fabs(mean.hi) + fabs(x[2]) + 1.0);
  return value;
}

static double in_pieces(const rot_term *term, double t) {
  const double *x = term->x;
  const size_t n = (size_t)x[0], m = (size_t)x[1];
  const double *breaks = x + 2, *rows = breaks + n + 1;
  /* Samples of a function reach to the last row, which is asked for too. */
  const int closed = term->kind == ROT_TERM_CHEBYSHEV && t == breaks[n];
  if (!(t >= breaks[0] && (t < breaks[n] || closed))) return 0.0;
  const size_t i = rot_upper_bound(n, breaks, t) - 1;
  const double *a = rows + i * m;
  if (term->kind == ROT_TERM_POLYNOMIAL) {
    double sum = 0.0;
    for (size_t j = m; j-- > 0;) sum = sum * (t - breaks[i]) + a[j];
    return sum;
  }
  const double u = ((t - breaks[i]) - (breaks[i + 1] - t)) / (breaks[i + 1] - breaks[i]);
  double b1 = 0.0, b2 = 0.0; /* Clenshaw */
  for (size_t j = m; j-- > 1;) {
    const double b = 2.0 * u * b1 - b2 + a[j];
    b2 = b1;
    b1 = b;
  }
  return u * b1 - b2 + a[0];
}

static double on_curve(const rot_term *term, double omega) {
  const double *x = term->x;
  const size_t n = (size_t)x[0];
  const double *speed = x + 1, *torque = speed + n;
  if (!(omega > speed[0])) return omega != omega ? omega : torque[0];
  if (omega >= speed[n - 1]) return torque[n - 1];
  const size_t i = rot_upper_bound(n, speed, omega) - 1;
  const double span = speed[i + 1] - speed[i];
  return torque[i] * ((speed[i + 1] - omega) / span) + torque[i + 1] * ((omega - speed[i]) / span);
}

/* From the angle of rest: its digits are those of theta + theta_lo, however near they are. */
static double since_rest(double theta, double theta_lo, double rest, double *lo) {
  double sum_lo, sum = rot_two_sum(theta, -rest, &sum_lo);
  return rot_two_sum(sum, sum_lo + theta_lo, lo);
}

static double pull_of_gravity(double theta, double theta_lo, double rest) {
  double lo, sine, cosine, angle = since_rest(theta, theta_lo, rest, &lo);
  rot_sin_cos(angle, lo, &sine, &cosine);
  return sine;
}

double rot_term_at(const rot_term *term, double t, double theta, double theta_lo, double omega) {
  const double *x = term->x;
  double lo;
  if (!(t >= term->from_s && t < term->to_s)) return 0.0;
  switch (term->kind) {
  case ROT_TERM_SINUSOID: return x[0] * wave(x[1], t, x[2]);
  case ROT_TERM_EXPONENTIAL: return x[0] * exp(-x[1] * (t - x[2]));
  case ROT_TERM_POLYNOMIAL:
  case ROT_TERM_CHEBYSHEV: return in_pieces(term, t);
  case ROT_TERM_CURVE: return on_curve(term, omega);
  case ROT_TERM_SPRING: return -x[0] * since_rest(theta, theta_lo, x[1], &lo);
  case ROT_TERM_GRAVITY: return -x[0] * pull_of_gravity(theta, theta_lo, x[1]);
  case ROT_TERM_KINDS: break;
  }
  return NAN;
}

static int is_count(double x) { return x >= 1.0 && x <= 1e9 && x == floor(x); }

int rot_term_valid(const rot_term *term) {
  const double *x = term->x;
  const double length = (double)term->length;
  switch (term->kind) {
  case ROT_TERM_SINUSOID:
  case ROT_TERM_EXPONENTIAL: return term->length == 3;
  case ROT_TERM_POLYNOMIAL:
  case ROT_TERM_CHEBYSHEV:
    return term->length > 2 && is_count(x[0]) && is_count(x[1]) &&
           length == 3.0 + x[0] + x[0] * x[1];
  case ROT_TERM_CURVE: return term->length > 1 && is_count(x[0]) && length == 1.0 + 2.0 * x[0];
  case ROT_TERM_SPRING: return term->length == 2;
  case ROT_TERM_GRAVITY: return term->length == 2 || term->length == 3;
  case ROT_TERM_KINDS: break;
  }
  return 0;
}

rot_term_kind rot_term_named(const char *name) {
  static const char *const names[] = {
#define X(code, name) name,
      ROT_TERM_LIST(X)
#undef X
  };
  int kind = 0;
  while (kind < ROT_TERM_KINDS && strcmp(names[kind], name)) kind++;
  return (rot_term_kind)kind;
}

size_t rot_term_breaks(const rot_term *term, double out[]) {
  const int pieces = term->kind == ROT_TERM_POLYNOMIAL || term->kind == ROT_TERM_CHEBYSHEV;
  const size_t edges = pieces ? (size_t)term->x[0] + 1 : 0;
  const double ends[] = {term->from_s, term->to_s};
  size_t n = 0;
  if (!out) return edges + 2;
  for (size_t i = 0; i < edges; i++) out[n++] = term->x[2 + i];
  for (size_t i = 0; i < 2; i++) {
    if (isfinite(ends[i])) out[n++] = ends[i];
  }
  return n;
}
