/* Kinks of the right-hand side in the state, which no break marks, found where the error test of
 * rk8pd fails by far. */
#ifndef ROT_ODE_KINK_H
#define ROT_ODE_KINK_H

#include "engine/ode/probe.h"

/* The step over h from run->t was rejected; run->trial and run->trial_slope are its result. Where
 * there is a kink within it, run->kink and run->over are times just before and just after it, so
 * near that a step from one to the other errs by less than the accuracy, and so far apart that the
 * kink of any other run lies between them, too. */
rot_status rot_ode_look_for_kink(rot_ode_march *run, double h);

/* The same for walls alone (engine/ode/wall.h), of a step that need not have been rejected. */
rot_status rot_ode_look_for_wall(rot_ode_march *run, double h);

/* A wall where the law changes before or behind the place of the sight: at a jump, or through the
 * place itself. *break_s: NaN, or the time of the place where no wall was added. `run` has state
 * and walls alone. */
rot_status rot_ode_look_at_sight(rot_ode_march *run, const rot_ode_sight *sight, double *break_s);

#endif
