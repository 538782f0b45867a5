/* Nonlinear least squares by trust regions (GSL), for residuals whose derivatives are known:
 * minimum of the sum of r_i(x)^2, covariance and condition there. Columns may be nearly dependent.
 *
 * Reference: More, in Numerical Analysis, Lecture Notes in Mathematics 630 (1978) 105. */
#ifndef ROT_TRUST_REGION_H
#define ROT_TRUST_REGION_H

#include <stddef.h>

#include "ground/status.h"

typedef struct rot_squares_problem {
  size_t n, p; /* residuals, parameters; n > p */
  /* x => residuals. Another status than ROT_OK: the point has none, and the step is rejected. */
  rot_status (*residual)(const double x[], double r[], void *ctx);
  /* x => n rows of p derivatives, for a point that has residuals */
  rot_status (*jacobian)(const double x[], double j[], void *ctx);
  void *ctx;
  double rounding;  /* of a residual */
  double dependent; /* a column depends on others if less than this share of it is across them */
} rot_squares_problem;

typedef struct rot_squares {
  double squares;   /* sum of squares */
  double sigma;     /* s.d. of a residual, n - p degrees of freedom; at least its rounding */
  double size;      /* s.d. by which the covariance goes */
  double condition; /* of the Jacobian with columns of length 1 */
  size_t iterations;
  /* p x p by rows, each NULL or of the caller. covariance = factor factor', of which sums of nearly
   * dependent parameters are accurate; triangle: R of the Jacobian, upper. */
  double *covariance, *factor, *triangle;
} rot_squares;

/* (problem, start x) => minimum x. Adds to to->iterations. ROT_EVALUE: n <= p or p = 0; ROT_ERANGE,
 * ROT_EBUDGET: no minimum was found, x is the start. */
rot_status rot_squares_solve(const rot_squares_problem *problem, const rot_hooks *hooks, double x[],
                             rot_squares *to);

#endif
