/* One run of the integrator: its phases, choice of steps, breaks, stretches between events. */
#ifndef ROT_ODE_MARCH_H
#define ROT_ODE_MARCH_H

#include "engine/ode/run.h"

/* By what the error of a step falls if the step is divided into so many. */
double rot_ode_gain(rot_method method, double parts);

/* From the start to `end`, all breaks on the way. */
rot_status rot_ode_march_to(rot_ode_march *run, double end, int forward);

#endif
