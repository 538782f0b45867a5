/* What rounding makes of a motion, seen: runs of the same steps, each state of which is moved by a
 * rounding, are as far from each other as it carries them. It needs no derivatives, where the maps
 * of the variational equation (propagation.h) are too rough to be multiplied: those of one turn of
 * an orbit of eccentricity 0.9 shear by 1e5, and errors of 1e-3 in them grow tenfold a turn. */
#ifndef ROT_ODE_ROUNDING_H
#define ROT_ODE_ROUNDING_H

#include "engine/ode/stepping.h"

/* Whether what the variational equation found is worth the runs: more than the accuracy asked. */
int rot_ode_roundings_rule(const rot_ode_job *coarse);

/* coarse->propagation->worst from runs of `fine`, which has a reference. It stays where the runs
 * would take more steps than are allowed, fail, or have too few steps in common. `traces`: of two
 * runs, both sides. `seen`: twice the measures; `change`: dim. */
rot_status rot_ode_see_roundings(const rot_ode_job *coarse, const rot_ode_job *fine,
                                 rot_ode_trace traces[2][2], double seen[], double change[],
                                 const rot_hooks *hooks, rot_info *info);

#endif
