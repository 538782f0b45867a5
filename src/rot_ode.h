/* The integrator: Prince-Dormand 8(7) steps of GSL under a step control of our own.
 *
 * GSL's adaptive driver accepts a NaN error estimate and must be reset by hand after each jump of
 * the right-hand side, so only its stepper is used. Here: an error test that NaN fails, exact
 * stops at the breaks, a step budget, and a companion run with other steps, at a hundredth of the
 * tolerance where that is needed, whose difference is the error estimate. The tolerance itself is
 * no error bar: it was off by 0.28 to 2600 in 60 scenes, the companion by 0.957 to 1.026. */
#ifndef ROT_ODE_H
#define ROT_ODE_H

#include <stddef.h>

#include "rot_status.h"

/* dydt = f(t, y). Not finite means "not here": the step is tried shorter. */
typedef rot_status (*rot_ode_rhs)(double t, const double y[], double dydt[], void *ctx);

typedef struct rot_ode_params {
  size_t dim;
  size_t controlled; /* the first so many components are the state: they steer the step */
  rot_ode_rhs rhs;
  void *ctx;
  size_t n_breaks; /* times where rhs may jump or kink, increasing; it is never evaluated there */
  const double *breaks;
  double start_s;
  const double *start; /* dim values */
  double accuracy;     /* largest error wanted in the state, relative to its largest value */
  size_t max_steps;    /* a run, rejected steps included */
} rot_ode_params;

/* Relative errors below this cannot be shown by the companion run: its own rounding. */
#define ROT_ODE_BEST_ACCURACY 1e-13

/* y (n rows of dim, row by row) at the times, which do not decrease; the estimated error of each
 * component, error[dim], largest over the rows; and its largest size on the way, largest[dim].
 * Times before start_s are reached backwards. On failure the first info->rows_done rows are
 * good. */
rot_status rot_ode_run(const rot_ode_params *p, size_t n, const double time_s[], double y[],
                       double error[], double largest[], const rot_hooks *hooks, rot_info *info);

#endif
