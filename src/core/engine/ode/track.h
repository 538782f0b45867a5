/* All nodes of one run on one side, with derivatives of the right-hand side. */
#ifndef ROT_ODE_TRACK_H
#define ROT_ODE_TRACK_H

#include "engine/ode/params.h"
#include "maths/dense.h"

/* Twins where a stretch begins; the derivatives of dydt by the controlled components, dim x
 * controlled of each node; NaN where a stretch begins. */
typedef struct rot_ode_track {
  rot_dense nodes;
  size_t controlled, room;
  int slid; /* along a wall, somewhere */
  double *derivative;
} rot_ode_track;

void rot_ode_track_free(rot_ode_track *track);
/* A step's end, or the start of a stretch. */
rot_status rot_ode_track_node(rot_ode_track *track, const rot_ode_params *p, double t,
                              const double y[], const double slope[]);
/* The derivative of dydt[] by component i, at the last node. */
void rot_ode_track_derivative(rot_ode_track *track, size_t i, const double rise[], double step);

#endif
