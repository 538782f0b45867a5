/* One step of GSL's rk8pd or of Radau, and its error test. */
#ifndef ROT_ODE_STEP_H
#define ROT_ODE_STEP_H

#include "engine/ode/run.h"

/* From (t, y) with its slope to t + h: trial, trial_error, trial_slope. ROT_ERHS (not finite) and
 * ROT_ESTEP (Newton diverged): try shorter; any other status ends the run. */
rot_status rot_ode_attempt(rot_ode_march *run, double t, double h, const double y[],
                           const double slope[]);

/* Error of the trial step over what is allowed; NaN if it makes no sense. */
double rot_ode_trial_ratio(const rot_ode_march *run, double h);

#endif
