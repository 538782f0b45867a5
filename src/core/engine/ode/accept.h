/* The end of a step: its trial becomes the state, and goes to all that follows the run. */
#ifndef ROT_ODE_ACCEPT_H
#define ROT_ODE_ACCEPT_H

#include "engine/ode/run.h"

/* The error test of rk8pd ignores the first so many calls of an attempt beside its given slope.
 * Where one of them meets another law, the later ones lie beside the motion. */
enum { ROT_ODE_UNWEIGHED = 4 };

/* run->y counts among the largest. */
void rot_ode_note_sizes(rot_ode_march *run);

/* The trial, projected, becomes the state at t. */
rot_status rot_ode_accept(rot_ode_march *run, double t, double error);

/* Adds the state to the trace, and to the nodes of the rows' polynomials. */
rot_status rot_ode_trace_end(rot_ode_march *run, double error);
rot_status rot_ode_add_node(rot_ode_march *run);

#endif
