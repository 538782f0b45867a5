/* Fixed axle, piecewise-constant torque, viscous, quadratic and dry resistance together:
 *
 *   I omega' = tau - c omega - q omega |omega| - tau_c sign(omega),
 *
 * held at rest while |tau| <= tau_s. Closed forms (maths/drag.h), stops and starts at their
 * times. */
#ifndef ROT_AXLE_DRAG_H
#define ROT_AXLE_DRAG_H

#include "scene/axle/scene.h"

/* A model (scene/axle/scene.h). ROT_EVALUE where a knot's piece is not constant, for anything but
 * knots, motor and resistance, for negative resistance, and for times before the start. */
rot_axle_run rot_axle_drag;

/* When it comes to rest for good, and the angle there. A body at rest from the start has stopped at
 * the start. Inf where it does not, with the angle that it tends to: finite with viscous
 * resistance, infinite with quadratic drag alone, NaN where a speed is left. */
rot_status rot_axle_drag_stop(const rot_axle_scene *scene, double *time_s, double *theta_rad);

/* Where omega tends to under the last knot's torque; +-Inf where nothing resists, 0 where friction
 * exceeds the torque. */
double rot_axle_drag_terminal(const rot_axle_scene *scene);

#endif
