/* The torques on a body that turns about a point, for the models that go by steps. */
#ifndef ROT_FREE_TORQUE_H
#define ROT_FREE_TORQUE_H

#include "scene/free/free.h"

/* Torques linear between knots at n times x, which do not decrease: *i and *part, so that t lies
 * between knots *i and *i + 1; where two are at t, the later one counts. 0: t is outside. */
int rot_free_between_knots(size_t n, const double x[], double t, size_t *i, double *part);

int rot_free_has_weight(const rot_free_params *p);

/* Adds that of gravity, in principal axes. */
void rot_free_add_weight(const rot_free_params *p, const double q[4], double torque[3]);

/* In principal axes, at an attitude q of these; with that of gravity, or without. */
rot_status rot_free_torque(const rot_free_params *p, double t, const double omega[3],
                           const double q[4], int weight, double out[3]);

#endif
