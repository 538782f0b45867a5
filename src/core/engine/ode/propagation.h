/* What becomes of rounding on the way: two runs of one program share it, so that their distance
 * does not show it. The variational equation of the run that chooses the steps carries a covariance
 * of one rounding a step (of each step that divides it). */
#ifndef ROT_ODE_PROPAGATION_H
#define ROT_ODE_PROPAGATION_H

#include "engine/ode/law.h"
#include "engine/ode/trace.h"

enum { ROT_ODE_MAX_PROPAGATION = 32 }; /* controlled components; with more it is not followed */

typedef struct rot_ode_propagation {
  size_t n;
  int known; /* slope0 holds the derivative at the step's start */
  int seen;  /* `worst` is of runs that were moved (rounding.h) */
  double *spread, *derivative0, *derivative1, *map, *work; /* n x n each, but work */
  double *y, *f;                                           /* dim each */
  double *worst;                                           /* of each group */
  double *units;                                           /* of each component, in a step */
  /* For the order 4: state and slope at the end of the step before, and in the middle; dim each. */
  double *last_y, *last_slope, *mid_y, *mid_slope;
} rot_ode_propagation;

/* NULL without memory or with too many components. */
rot_ode_propagation *rot_ode_propagation_alloc(const rot_ode_params *p);
void rot_ode_propagation_free(rot_ode_propagation *g);

/* At the start of a run. */
void rot_ode_propagation_begin(rot_ode_propagation *g);
/* At the start of a smooth segment. */
void rot_ode_propagation_new_segment(rot_ode_propagation *g);
/* A component is held constant from here on. */
void rot_ode_propagation_hold(rot_ode_propagation *g, size_t component);
/* A step of length h was accepted: its start with the slope there. */
typedef struct rot_ode_propagation_of {
  double h;
  const double *before, *slope;
  size_t parts;         /* steps of the result in it */
  int rows;             /* some rows lie within it */
  const double *rounds; /* of the slopes of each group, or NULL */
} rot_ode_propagation_of;
/* The kept nodes, or NULL, take the derivatives. */
rot_status rot_ode_propagation_step(rot_ode_propagation *g, rot_ode_law *law,
                                    const rot_ode_state *state, rot_ode_trajectory *trajectory,
                                    const rot_ode_propagation_of *step);

#endif
