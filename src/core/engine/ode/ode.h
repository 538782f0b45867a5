/* The integrator: steps of GSL's Prince-Dormand 8(7), or of Radau IIA for stiff motions.
 *
 * GSL's adaptive driver accepts a NaN error estimate and must be reset after each jump of the
 * right-hand side, so only its stepper is used. Here: an error test that NaN fails, exact stops at
 * the breaks and the events, a step budget, rows between the steps (maths/dense.h), and an error
 * estimate by a second run.
 *
 * A coarse run chooses the steps; a fine run divides each by two to four, and is the result. At
 * order 8 the difference of the two is 255 to 65535 times the error of the fine one. The tolerance
 * is no estimate: it was off by 0.28 to 2600 in 60 scenes. bench/coverage/ode.c measures the
 * estimate. */
#ifndef ROT_ODE_H
#define ROT_ODE_H

#include "engine/ode/params.h"

/* y (n rows of dim, row by row) at the times, which do not decrease; of each measure the estimated
 * error, error[], largest over the rows, and the largest size on the way, largest[] (of a
 * quaternion 1). `slope` may be NULL, or takes dydt[sloped] of each row, by
 * rhs itself: NaN where that is not known, at breaks among others. Times before start_s are
 * reached backwards. On failure, and after an event that ends the run, the first info->rows_done
 * rows are good. The measures of *info are the caller's: named before or after the run. */
rot_status rot_ode_run(const rot_ode_params *p, size_t n, const double time_s[], double y[],
                       double slope[], double error[], double largest[], const rot_hooks *hooks,
                       rot_info *info);

#endif
