/* Torque terms that are not piecewise linear in time. A law is the sum of its knots
 * (engine/torque.h) and of these. */
#ifndef ROT_TERM_H
#define ROT_TERM_H

#include <stddef.h>

#include "ground/ieee.h"

/* code, name in R. The first kinds are functions of time alone. What x holds:
 *
 *   sinusoid     x[0] cos(x[1] t + x[2])
 *   exponential  x[0] exp(-x[1] (t - x[2]))
 *   polynomial   n pieces of m coefficients: n, m, n + 1 breaks, then n rows of m; in piece i
 *                sum_j a_ij (t - break_i)^j; zero outside the breaks
 *   chebyshev    the same layout; in piece i sum_j a_ij T_j, with the piece mapped to [-1, 1]
 *   curve        piecewise linear in omega: n, n speeds (increasing), n torques; constant outside
 *   spring       -x[0] (theta - x[1])
 *   gravity      -x[0] sin(theta - x[1]); x[2], or 0: what the product x[0] lacks */
#define ROT_TERM_LIST(X)                                                                           \
  X(ROT_TERM_SINUSOID, "sinusoid")                                                                 \
  X(ROT_TERM_EXPONENTIAL, "exponential")                                                           \
  X(ROT_TERM_POLYNOMIAL, "polynomial")                                                             \
  X(ROT_TERM_CHEBYSHEV, "chebyshev")                                                               \
  X(ROT_TERM_CURVE, "curve")                                                                       \
  X(ROT_TERM_SPRING, "spring")                                                                     \
  X(ROT_TERM_GRAVITY, "gravity")

typedef enum rot_term_kind {
#define X(code, name) code,
  ROT_TERM_LIST(X)
#undef X
      ROT_TERM_KINDS
} rot_term_kind;

/* ROT_TERM_KINDS where there is none of this name. */
rot_term_kind rot_term_named(const char *name);

typedef struct rot_term {
  rot_term_kind kind;
  double from_s, to_s; /* it acts from from_s on and before to_s */
  size_t length;       /* of x */
  const double *x;
} rot_term;

/* Torque of the term, N m; after the jump at a jump. The angle is theta + theta_lo. */
double rot_term_at(const rot_term *term, double t, double theta, double theta_lo, double omega);

/* x of a sinusoid => its integral over from <= to, N m s, and a bound of its error: nine roundings
 * of the integral, and 2^-100 of the phases. Phases beyond 2^52 rad: 0, and the largest value that
 * the integral may have. */
double rot_sinusoid_impulse(const double x[3], double from, double to, double *error);

/* Whether length and x make sense: nothing may be read outside x. */
int rot_term_valid(const rot_term *term);

/* Finite times where the term jumps or kinks, unsorted; returns how many. With `out` NULL: room
 * that is enough. */
size_t rot_term_breaks(const rot_term *term, double out[]);

#endif
