/* All nodes of one run on one side, with derivatives of the right-hand side: see run.h. */
#ifndef ROT_ODE_TRACK_H
#define ROT_ODE_TRACK_H

#include "engine/ode/run.h"

void rot_ode_track_free(rot_ode_track *track);
/* The state and slope of a run where it is now: a step's end, or the start of a stretch. */
rot_status rot_ode_track_node(rot_ode_track *track, const rot_ode_march *run);
/* The derivative of dydt[] by component i, at the last node. */
void rot_ode_track_derivative(rot_ode_track *track, size_t i, const double rise[], double step);

#endif
