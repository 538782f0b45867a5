/* Torque terms that are not piecewise linear in time. A law is the sum of its knots (rot_torque.h)
 * and of these. */
#ifndef ROT_TERM_H
#define ROT_TERM_H

#include <stddef.h>

/* kind, and what x holds. R packs them by the same numbers: R/torque-terms.R. */
typedef enum rot_term_kind {
  ROT_TERM_SINUSOID,    /* x[0] cos(x[1] t + x[2]) */
  ROT_TERM_EXPONENTIAL, /* x[0] exp(-x[1] (t - x[2])) */
  ROT_TERM_POLYNOMIAL, /* n pieces of m coefficients: n, m, n + 1 breaks, then n rows of m; in piece
                           i sum_j a_ij (t - break_i)^j; zero outside the breaks */
  ROT_TERM_CHEBYSHEV,  /* the same layout; in piece i sum_j a_ij T_j, on the piece as [-1, 1] */
  ROT_TERM_CURVE,      /* piecewise linear in omega: n, n speeds (increasing), n torques; held
                           outside */
  ROT_TERM_SPRING,     /* -x[0] (theta - x[1]) */
  ROT_TERM_GRAVITY,    /* -x[0] sin(theta - x[1]) */
  ROT_TERM_KINDS
} rot_term_kind;

typedef struct rot_term {
  rot_term_kind kind;
  double from_s, to_s; /* it acts from from_s on and before to_s */
  size_t length;       /* of x */
  const double *x;
} rot_term;

/* The first kinds are functions of time alone. */
static inline int rot_term_of_time(const rot_term *term) { return term->kind < ROT_TERM_CURVE; }

/* Torque of the term, N m; after the jump at a jump. The angle is theta + theta_lo. */
double rot_term_at(const rot_term *term, double t, double theta, double theta_lo, double omega);

/* Whether length and x make sense: nothing may be read outside x. */
int rot_term_valid(const rot_term *term);

#endif
