/* Exact solution, by superposition, of a fixed axle with viscous resistance of any sign under knots
 * and sums of sinusoids, exponentials and polynomials of time, each in its window.
 *
 * Between breaks, with s the time since the last one and z = c s/I, a torque tau adds
 *
 *   omega += (1/I) int_0^s exp(-c (s - u)/I) tau(u) du,
 *   theta += (1/I) int_0^s (s - u) phi_1(-c (s - u)/I) tau(u) du
 *
 * to the contributions of the state and the knots (rot_axle_step()): divided differences of the
 * exponential (maths/divided.h) and phi functions (maths/phi.h). Each row is one step from the last
 * break: the error does not grow with the number of rows or periods. */
#ifndef ROT_AXLE_FORCED_H
#define ROT_AXLE_FORCED_H

#include "scene/axle/scene.h"

/* => largest degree of a polynomial of time. */
int rot_axle_forced_max_degree(void);

/* 1 if the model takes the scene: constant inertia, no resistance except viscous, no call, terms of
 * the three kinds; else 0. */
int rot_axle_forced_fits(const rot_axle_scene *scene);

/* A model. ROT_EVALUE: the scene does not fit. The errors in *info are bounds. */
rot_axle_run rot_axle_forced;

#endif
