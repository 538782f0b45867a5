/* Held at rest: what drives it, and where it breaks loose. */
#ifndef ROT_ODE_REST_H
#define ROT_ODE_REST_H

#include "engine/ode/step.h"

typedef struct rot_ode_rest {
  const rot_ode_clock *clock;
  const rot_ode_state *state;
  rot_ode_law *law;
  rot_ode_stepper *step; /* trial and trial_slope: the state at the end of a segment */
  double grace;          /* held up to here whatever drives */
} rot_ode_rest;

/* The slope that drives it from rest at t, and what it is beyond what holds: positive is loose. */
rot_status rot_ode_held_slope(rot_ode_rest *r, double t, double *drive, double *excess);

/* At rest at t in the state `from`: the state at t + h, held till then, and the slope there. */
rot_status rot_ode_integrals_at_rest(rot_ode_law *law, double t, double h, const double from[],
                                     double y[], double slope[]);

/* A segment of *h at rest, of `whole` up to `stop`. *end: where it ends, or where it breaks loose;
 * the trial is its state. NaN: the segment was too long, *h is the next one, or loose already. */
rot_status rot_ode_hold(rot_ode_rest *r, double stop, double whole, double *h, double *end,
                        int *broke_loose);

#endif
