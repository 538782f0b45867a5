/* Free oscillations with losses: angle or rate at given times and at its extremes, with derivatives
 * by the parameters, for fits of measured oscillations.
 *
 *   theta'' = -omega0^2 sin(theta) - 2 decay theta' - coulomb sgn(theta')
 *             - quadratic theta' |theta'|
 *
 * (theta instead of sin(theta) for a spring). Between turning points the solution and its
 * derivatives are Taylor series, truncated below rounding. At a turning point the friction reverses
 * and the derivatives of the rate jump. Losses may be negative, for fits without bounds.
 *
 * Reference: Jorba and Zou 2005, Exp. Math. 14, 99 (Taylor series of ODEs). */
#ifndef ROT_SWING_H
#define ROT_SWING_H

#include <stddef.h>

#include "ground/status.h"

/* Order of parameters and of derivatives. */
enum {
  ROT_SWING_THETA, /* rad at the start */
  ROT_SWING_OMEGA, /* rad/s at the start */
  ROT_SWING_OMEGA0,
  ROT_SWING_DECAY,
  ROT_SWING_COULOMB,
  ROT_SWING_QUADRATIC,
  ROT_SWING_PARAMETERS
};

typedef struct rot_swing {
  double p[ROT_SWING_PARAMETERS];
  int spring; /* 1: spring; 0: gravity */
  int rate;   /* 1: values are rates in rad/s; 0: angles in rad */
} rot_swing;

/* (swing, n non-decreasing times from start_s on) => values, a row of derivatives for each.
 * ROT_EBUDGET for losses too strong for an oscillation. */
rot_status rot_swing_rows(const rot_swing *swing, double start_s, size_t n, const double time_s[],
                          const rot_hooks *hooks, double value[], double derivative[]);

/* (swing, end) => times and values of the first *n <= max extremes after the start, up to the end.
 * An angle at rest has no further extremes. */
rot_status rot_swing_extremes(const rot_swing *swing, double start_s, double end_s, size_t max,
                              const rot_hooks *hooks, size_t *n, double time_s[], double value[],
                              double derivative[]);

#endif
