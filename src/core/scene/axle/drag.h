/* Fixed axle, piecewise-constant torque with viscous, quadratic and dry resistance:
 *
 *   I omega' = tau - c omega - q omega |omega| - tau_c sign(omega).
 *
 * Static contact at rest: |tau| <= tau_s. Closed forms (maths/drag.h), exact times of stops and
 * starts. */
#ifndef ROT_AXLE_DRAG_H
#define ROT_AXLE_DRAG_H

#include "scene/axle/scene.h"

/* A model (scene/axle/scene.h). ROT_EVALUE: a piece that is not constant, loads other than knots,
 * motor and resistance, negative resistance, or times before the start. */
rot_axle_run rot_axle_drag;

/* scene => time of the final stop, angle there. At rest from the start: the start. Never: Inf, and
 * the limit of the angle (finite with viscous resistance, infinite with quadratic drag only, NaN if
 * a speed remains). */
rot_status rot_axle_drag_stop(const rot_axle_scene *scene, double *time_s, double *theta_rad);

/* scene => limit of omega under the final torque; +-Inf without resistance, 0 if friction exceeds
 * the torque. */
double rot_axle_drag_terminal(const rot_axle_scene *scene);

#endif
