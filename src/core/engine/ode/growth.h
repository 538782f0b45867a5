/* What becomes of rounding on the way: two runs of one program share it, so that their distance
 * does not show it. The variational equation of the run that chooses the steps carries a covariance
 * of one rounding a step (of each step that divides it). */
#ifndef ROT_ODE_GROWTH_H
#define ROT_ODE_GROWTH_H

#include "engine/ode/law.h"
#include "engine/ode/trace.h"

enum { ROT_ODE_MOST_GROWTH = 32 }; /* controlled components; with more it is not followed */

typedef struct rot_ode_growth {
  size_t n;
  int known; /* slope0 holds the derivative at the step's start */
  double *spread, *derivative0, *derivative1, *map, *work; /* n x n each, but work */
  double *y, *f;                                           /* dim each */
  double *worst;                                           /* of each group */
} rot_ode_growth;

/* NULL without memory or with too many components. */
rot_ode_growth *rot_ode_growth_alloc(const rot_ode_params *p);
void rot_ode_growth_free(rot_ode_growth *g);

/* A run sets out; a stretch begins; a component is held. */
void rot_ode_growth_set_out(rot_ode_growth *g);
void rot_ode_growth_new_stretch(rot_ode_growth *g);
void rot_ode_growth_hold(rot_ode_growth *g, size_t component);
/* A step of length h from `before` was accepted, of which the result makes `parts`. The track, or
 * NULL, takes the derivatives. */
rot_status rot_ode_growth_step(rot_ode_growth *g, rot_ode_law *law, const rot_ode_state *state,
                               rot_ode_track *track, double h, const double before[], size_t parts);

#endif
