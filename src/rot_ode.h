/* The integrator: steps of GSL's Prince-Dormand 8(7), or of Radau IIA where that is stiff, under a
 * control of our own.
 *
 * GSL's adaptive driver accepts a NaN error estimate and must be reset by hand after each jump of
 * the right-hand side, so only its stepper is used. Here: an error test that NaN fails, exact
 * stops at the breaks and where the motion comes to rest, a step budget, rows filled in between
 * the steps (rot_dense.h), and an error estimate by a second run.
 *
 * A coarse run chooses the steps; a fine run goes through the halves of each, and is the result.
 * At order 8 the difference of the two is 255 times the error of the fine one, so nothing that was
 * computed is thrown away, and the estimate is not the tolerance, which was off by 0.28 to 2600 in
 * 60 scenes. tests/core/coverage_ode.c measures how the estimate holds. */
#ifndef ROT_ODE_H
#define ROT_ODE_H

#include <stddef.h>

#include "rot_events.h"
#include "rot_status.h"

/* dydt = f(t, y). Not finite means "not here": the step is tried shorter. */
typedef rot_status (*rot_ode_rhs)(double t, const double y[], double dydt[], void *ctx);

/* A right-hand side with a kink or jump where y[watched] = 0. It is integrated with the sign fixed
 * at *mode = 1 or -1, so that it is smooth, up to the zero itself; there, and wherever a stretch
 * begins at zero, dydt[driver] with *mode = 0 decides: up to `holds` in size it is held at rest
 * (*mode = 0: the controlled components stay), else it goes on the way dydt[driver] points. */
typedef struct rot_ode_switch {
  size_t watched, driver;
  double holds; /* >= 0; 0: nothing holds */
  int *mode;    /* read by rhs */
  rot_events *events;
} rot_ode_switch;

typedef struct rot_ode_params {
  size_t dim;
  size_t controlled; /* the first so many components are the state: they steer the step */
  rot_ode_rhs rhs;
  void *ctx;
  size_t n_breaks; /* times where rhs may jump or kink, increasing; it is never evaluated there */
  const double *breaks;
  double start_s;
  const double *start;        /* dim values */
  double accuracy;            /* largest error wanted in the state, relative to its largest value */
  size_t max_steps;           /* a run, rejected steps included */
  rot_method method;          /* ROT_METHOD_NONE: choose */
  const rot_ode_switch *turn; /* may be NULL */
  void (*at_break)(double t, double y[], int forward, void *ctx); /* may be NULL: y may jump */
  size_t sloped; /* the component whose slope is wanted at the rows */
  /* What rhs itself leaves uncertain of the controlled slopes, or NULL: a step may be off by so
   * much a second besides, or a motion that begins in rhs's rounding would never be resolved. */
  const double *noise;
  int kinks; /* rhs may have kinks in y that no break and no switch tells of */
} rot_ode_params;

/* Relative errors below this cannot be shown by a second run: its own rounding. */
#define ROT_ODE_BEST_ACCURACY 1e-13

/* y (n rows of dim, row by row) at the times, which do not decrease; the estimated error of each
 * component, error[dim], largest over the rows; and its largest size on the way, largest[dim].
 * `slope` may be NULL, or takes dydt[sloped] of each row from the rows' own polynomial: NaN where
 * that is not good to the accuracy, and at breaks. Times before start_s are reached backwards. On
 * failure the first info->rows_done rows are good. */
rot_status rot_ode_run(const rot_ode_params *p, size_t n, const double time_s[], double y[],
                       double slope[], double error[], double largest[], const rot_hooks *hooks,
                       rot_info *info);

#endif
