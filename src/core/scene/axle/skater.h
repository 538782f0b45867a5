/* The skater: a body on an axle whose moment of inertia is linear from knot to knot, under torques
 * that are constant from knot to knot, without resistance:
 *
 *   d(I(t) omega)/dt = tau,   d(theta)/dt = omega.
 *
 * The angular momentum L is continuous, also where I jumps, and omega = L/I. */
#ifndef ROT_AXLE_SKATER_H
#define ROT_AXLE_SKATER_H

#include "scene/axle/scene.h"

/* Knots of I(t) > 0 (or none), knots of a torque that is constant between them, nothing else:
 * ROT_EVALUE otherwise. The state at the start belongs to the inertia after a jump there. The
 * errors in *info are bounds. */
rot_axle_run rot_axle_skater;

#endif
