/* Torques on a body rotating about a point, for the integrators and fixed-step methods. */
#ifndef ROT_FREE_TORQUE_H
#define ROT_FREE_TORQUE_H

#include "scene/free/free.h"

/* (n not decreasing times x, t) => knots *i and *i + 1 around t, fraction *part between them; at
 * equal times the later one. Returns 0 if t is outside, else 1. */
int rot_free_between_knots(size_t n, const double x[], double t, size_t *i, double *part);

/* parameters => 1 if gravity has a torque, else 0. */
int rot_free_has_weight(const rot_free_params *p);

/* attitude => torque[] += torque of gravity, in principal axes. */
void rot_free_add_weight(const rot_free_params *p, const double q[4], double torque[3]);

/* (t, omega, attitude of the principal axes) => torque in principal axes. weight: 1: with gravity,
 * 0: without. */
rot_status rot_free_torque(const rot_free_params *p, double t, const double omega[3],
                           const double q[4], int weight, double out[3]);

#endif
