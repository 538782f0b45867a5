/* The trajectory of a run on one side of the start, as the reference of what follows: the ends of
 * its steps, of a run that divides them; its nodes with derivatives, of collocation. */
#ifndef ROT_ODE_TRACE_H
#define ROT_ODE_TRACE_H

#include "engine/ode/state.h"
#include "maths/dense.h"

/* Room for an item more, of so many numbers. */
rot_status rot_ode_make_room(double **data, size_t *room, size_t count, size_t each);

/* Ends of the steps, outward: t, the error that the test found in the step that ends there (a part
 * of the largest value), y[dim]. */
typedef struct rot_ode_trace {
  size_t dim, count, room;
  int ended; /* by an event */
  double *data;
} rot_ode_trace;

static inline const double *rot_ode_node(const rot_ode_trace *m, size_t i) {
  return m->data + i * (2 + m->dim);
}

rot_status rot_ode_trace_add(rot_ode_trace *m, double t, double error, const double y[]);

typedef struct rot_ode_reference {
  const rot_ode_clock *clock;
  const rot_ode_trace *trace; /* its steps are divided into `parts`; NULL: the error test rules */
  size_t parts;
  double gain; /* by what that lessens the error of a step */
  size_t at;   /* the time lies from this node of it to the next */
} rot_ode_reference;

/* The end of the next step before `stop`: equal parts of those of the reference. NaN: there are no
 * more; it may have ended early, at an event. */
double rot_ode_reference_aim(rot_ode_reference *g, double stop);
/* A part of a step should have the error of the whole over the gain. Where it does not, the motion
 * is too quick for these steps, or has a kink, and the error that the test found counts in full. */
int rot_ode_is_unresolved(const rot_ode_reference *g, double error);

/* All nodes, twins where a segment begins, and the derivatives of dydt by the controlled components
 * there, dim x controlled each; NaN where a segment begins. */
typedef struct rot_ode_trajectory {
  rot_dense nodes;
  size_t controlled, room;
  int slid; /* along a surface, somewhere */
  double *derivative;
} rot_ode_trajectory;

void rot_ode_trajectory_free(rot_ode_trajectory *trajectory);
/* A step's end, or the start of a segment. */
rot_status rot_ode_trajectory_node(rot_ode_trajectory *trajectory, const rot_ode_params *p,
                                   double t, const double y[], const double slope[]);

#endif
