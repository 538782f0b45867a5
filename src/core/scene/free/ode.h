/* A free body integrated, with any torque and rotors: the quaternion since the start, the angular
 * momentum in principal axes, and the momenta of rotors (engine/ode/ode.h). The error is the
 * distance from a second run at a hundredth of the accuracy: bench/coverage/forced.c and gyrostat.c
 * say how near it is to the truth. */
#ifndef ROT_FREE_ODE_H
#define ROT_FREE_ODE_H

#include "scene/free/free.h"

typedef struct rot_free_ode_options {
  double accuracy;
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: explicit, unless that is stiff */
  double resolution; /* of changes of a law that is called: see engine/ode/ode.h; 0: as there */
} rot_free_ode_options;

/* NULL, or why it cannot be integrated. */
const char *rot_free_not_integrated(const rot_free_params *p);

/* Times do not decrease, before start_s as well. flow[k][i] is ROT_FREE_LEDGER k from the start to
 * row i, flow_error[k] its estimated error. Events: flip, where at that
 * time rot_free_flips().
 * Errors are estimates. */
rot_status rot_free_integrate(const rot_free_params *p, const rot_free_ode_options *options,
                              size_t n, const double time_s[], const rot_free_columns *out,
                              double *const flow[ROT_FREE_FLOWS], double flow_error[ROT_FREE_FLOWS],
                              rot_events *events, const rot_hooks *hooks, rot_info *info);

#endif
