/* One step of GSL's rk8pd or of Radau, its error test, and the right-hand side as they call it. */
#ifndef ROT_ODE_STEP_H
#define ROT_ODE_STEP_H

#include "engine/ode/march.h"

/* Calls of an attempt of rk8pd beside its given slope; its error test ignores the first four.
 * Where one of them meets another law, the later ones lie beside the motion. */
enum { ROT_ODE_CALLS = 13, ROT_ODE_UNWEIGHED = 4 };

/* The right-hand side in GSL's form: on this side of the breaks, counted, and finite. */
int rot_ode_slope_at(double t, const double y[], double dydt[], void *march);

/* The slope at (run->t, run->y), into run->slope. */
rot_status rot_ode_know_slope(rot_ode_march *run);

/* ROT_ERANDOM where two calls at (run->t, run->y) differ by more than the accuracy, of the slope: a
 * law that draws random numbers, or keeps count, has no solution that steps converge to. */
rot_status rot_ode_check_repeats(rot_ode_march *run);

/* From (t, y) with its slope to t + h: trial, trial_error, trial_slope. ROT_ERHS (not finite) and
 * ROT_ESTEP (Newton diverged): try shorter; any other status ends the run. */
rot_status rot_ode_attempt(rot_ode_march *run, double t, double h, const double y[],
                           const double slope[]);

/* Error of the trial step over what is allowed; NaN if it makes no sense. */
double rot_ode_trial_ratio(const rot_ode_march *run, double h);

/* run->y counts among the largest. */
void rot_ode_note_sizes(rot_ode_march *run);

/* The trial, projected, becomes the state at t. */
rot_status rot_ode_accept(rot_ode_march *run, double t, double error);

/* Adds the state to the trace, and to the nodes of the rows' polynomials. */
rot_status rot_ode_trace_end(rot_ode_march *run, double error);
rot_status rot_ode_add_node(rot_ode_march *run);

#endif
