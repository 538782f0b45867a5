/* The steps of an explicit run, solved anew by collocation at Gauss's nodes: for a right-hand side
 * whose calls cost more than the arithmetic here.
 *
 * A sweep goes through the steps from the start. Within a step it takes the state from the sweep
 * before, moved by what the start of the step has changed; calls the right-hand side at the nodes;
 * and solves the equations of collocation, linear about that state, with derivatives by the state
 * that are interpolated between those of the run. The error falls by some hundred a
 * sweep. A sweep costs 6 to 16 calls a step, where dividing a step of order 8 by three costs 39.
 *
 * A sweep has other nodes than the one before. The distance of the last two, times four times what
 * it fell by, estimates the error of the last; what its polynomials leave out comes beside it, from
 * their last terms. Kinks that no node shows: see look_between() in the file.
 *
 * Reference: Hairer, Lubich & Wanner, Geometric Numerical Integration, II.1.2 and VIII.6. */
#ifndef ROT_ODE_COLLOCATE_H
#define ROT_ODE_COLLOCATE_H

#include "engine/ode/law.h"
#include "engine/ode/rows.h"

enum { ROT_ODE_MAX_COLLOCATED = 4, ROT_ODE_MAX_COLLOCATED_ALL = 12 }; /* controlled; all */

/* ROT_OK and *good = 1: y, slope, error[] (without rounding) and largest[] hold, to the accuracy
 * or to rounding. *good = 0: they do not, other steps are needed. Scalars alone, without events, a
 * switch and a projection; rhs reads no component beyond the controlled ones. Steps that end on a
 * surface end where the motion of the last sweep meets it; motions along surfaces are not good.
 * `probes` may be NULL. */
rot_status rot_ode_collocate(const rot_ode_params *p, const rot_ode_trajectory trajectory[2],
                             const rot_ode_surfaces *surfaces, const rot_ode_output *rows,
                             rot_ode_probes *probes, const rot_hooks *hooks, rot_info *info,
                             int *good);

#endif
