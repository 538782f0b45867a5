/* Numerical integration of a free body with any torque and rotors (engine/ode/ode.h). State:
 * quaternion since the start, angular momentum in principal axes, momenta of rotors. Error:
 * difference from a second run at a hundredth of the accuracy; coverage: bench/coverage/forced.c
 * and gyrostat.c. */
#ifndef ROT_FREE_ODE_H
#define ROT_FREE_ODE_H

#include "scene/free/free.h"

typedef struct rot_free_ode_options {
  double accuracy; /* requested relative error of each measure */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: explicit unless stiff */
  double resolution; /* of changes of a law given as a function; 0: default (engine/ode/ode.h) */
} rot_free_ode_options;

/* parameters => NULL, or why the body cannot be integrated. */
const char *rot_free_not_integrated(const rot_free_params *p);

/* (parameters, options, times) => rows, flows, events, errors (estimates). Times: not decreasing,
 * also before start_s. flow[k][i]: ROT_FREE_LEDGER k from the start to row i; flow_error[k]: its
 * estimated error. Events: flip, if rot_free_flips() holds at that time. */
rot_status rot_free_integrate(const rot_free_params *p, const rot_free_ode_options *options,
                              size_t n, const double time_s[], const rot_free_columns *out,
                              double *const flow[ROT_FREE_FLOWS], double flow_error[ROT_FREE_FLOWS],
                              rot_events *events, const rot_hooks *hooks, rot_info *info);

#endif
