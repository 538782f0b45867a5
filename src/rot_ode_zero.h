/* Where a step brings the watched component to zero. */
#ifndef ROT_ODE_ZERO_H
#define ROT_ODE_ZERO_H

#include "rot_ode_march.h"

/* What an accepted step did to the watched component. */
typedef enum rot_ode_passage {
  ROT_ODE_SAME_SIDE,
  ROT_ODE_AT_ZERO,
  ROT_ODE_CUT_SHORT,
  ROT_ODE_TRY_SHORTER
} rot_ode_passage;

/* Looks for a zero of the watched component in the trial step; *h becomes the step that is left. */
rot_status rot_ode_look_for_zero(rot_ode_march *run, double *h, rot_ode_passage *what);

#endif
