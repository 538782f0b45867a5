/* A fixed axle with viscous resistance of any sign, under knots and sums of sinusoids, exponentials
 * and polynomials of time, each in its window: the exact solution, by superposition.
 *
 * Between breaks, with s the time since the last one and z = c s/I, a torque tau adds
 *
 *   omega += (1/I) int_0^s exp(-c (s - u)/I) tau(u) du,
 *   theta += (1/I) int_0^s (s - u) phi_1(-c (s - u)/I) tau(u) du
 *
 * to what the state and the knots give (rot_axle_step()): divided differences of the exponential
 * (maths/divided.h) and phi functions (maths/phi.h). Every row is one step from the last break, so
 * no error grows with the number of rows or of periods. */
#ifndef ROT_AXLE_FORCED_H
#define ROT_AXLE_FORCED_H

#include "scene/axle/scene.h"

/* Polynomials of time up to this degree. */
int rot_axle_forced_max_degree(void);

/* Whether the scene is one of this model's: constant inertia, no resistance but the viscous one, no
 * call, and terms of the three kinds. */
int rot_axle_forced_fits(const rot_axle_scene *scene);

/* A scene that does not fit is ROT_EVALUE. The errors in *info are bounds. */
rot_axle_run rot_axle_forced;

#endif
