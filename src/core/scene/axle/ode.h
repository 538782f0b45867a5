/* Numerical integration of an axle with any loads.
 *
 * If I(t) changes, the state is the angular momentum over the inertia at the start: it is as smooth
 * as the torques, and continuous at jumps of I(t). Friction and quadratic resistance have a kink at
 * rest: each segment is integrated with a fixed sign of omega, up to its zero
 * (engine/ode/ode.h). */
#ifndef ROT_AXLE_ODE_H
#define ROT_AXLE_ODE_H

#include "scene/axle/flows.h"
#include "scene/axle/scene.h"

typedef struct rot_axle_ode_options {
  double accuracy; /* requested error of theta and omega, relative to their largest values */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: choose */
  double resolution; /* of changes of a law given as a function; 0: default (engine/ode/ode.h) */
  double step_s;     /* step of a fixed-step method */
} rot_axle_ode_options;

/* (scene, options, times) => rows, events, errors (estimates). A call of the scene is added to its
 * knots and terms. flows: since the start of the scene; NULL: none. */
rot_status rot_axle_integrate(const rot_axle_scene *scene, const rot_axle_ode_options *options,
                              size_t n, const double time_s[], const rot_axle_columns *out,
                              rot_events *events, const rot_axle_flows *flows,
                              const rot_hooks *hooks, rot_info *info);

#endif
