/* Held at rest: what drives it, and where it breaks loose. */
#ifndef ROT_ODE_REST_H
#define ROT_ODE_REST_H

#include "engine/ode/run.h"

/* The slope that drives it from rest at t, and what it is beyond what holds: positive is loose. */
rot_status rot_ode_held_slope(rot_ode_march *run, double t, double *drive, double *grip);

/* At rest, up to `stop` or to where it breaks loose. */
rot_status rot_ode_hold(rot_ode_march *run, double stop, int *broke_loose);

#endif
