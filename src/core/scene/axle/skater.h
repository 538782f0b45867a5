/* A body on an axle (a skater) with a moment of inertia piecewise linear in time and torques
 * piecewise constant in time, without resistance:
 *
 *   d(I(t) omega)/dt = tau,   d(theta)/dt = omega.
 *
 * The angular momentum L is continuous, also at jumps of I; omega = L/I. */
#ifndef ROT_AXLE_SKATER_H
#define ROT_AXLE_SKATER_H

#include "scene/axle/scene.h"

/* A model. ROT_EVALUE: loads other than knots of I(t) > 0 (or none) and knots of a
 * piecewise-constant torque. The initial state holds after a jump of the inertia at the start. The
 * errors in *info are bounds. */
rot_axle_run rot_axle_skater;

#endif
