/* The axle with anything that may act on it, integrated.
 *
 * With I(t) changing the state is the angular momentum, over the inertia at the start: it is smooth
 * wherever the torques are, and goes on unchanged where I(t) jumps. Friction and quadratic
 * resistance have a kink at rest: each segment is integrated with the sign of omega fixed, up to
 * the zero itself (engine/ode/ode.h). */
#ifndef ROT_AXLE_ODE_H
#define ROT_AXLE_ODE_H

#include "scene/axle/flows.h"
#include "scene/axle/scene.h"

typedef struct rot_axle_ode_options {
  double accuracy; /* largest error wanted in theta and omega, relative to their largest values */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: choose */
  double resolution; /* of changes of a law that is called: see engine/ode/ode.h; 0: as there */
  double step_s;     /* of a method with steps of fixed length */
} rot_axle_ode_options;

/* The scene's call, if it has one, is added to its knots and terms. Errors are estimates. `flows`:
 * NULL, or what flowed since the start of the scene. */
rot_status rot_axle_integrate(const rot_axle_scene *scene, const rot_axle_ode_options *options,
                              size_t n, const double time_s[], const rot_axle_columns *out,
                              rot_events *events, const rot_axle_flows *flows,
                              const rot_hooks *hooks, rot_info *info);

#endif
