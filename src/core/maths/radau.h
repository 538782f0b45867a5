/* One step of Radau IIA with five stages (order 9, L-stable) for small stiff systems:
 *
 *   Z_i = h sum_j a_ij f(t + c_j h, y + Z_j),   y(t + h) = y + Z_5,
 *
 * by simplified Newton with a Jacobian from differences. Components beyond the first `controlled`
 * are integrals along the way: they take part in no equation. The error is that of an embedded
 * formula of order 5. Reference: Hairer & Wanner, Solving Ordinary Differential Equations II,
 * sections IV.5, IV.8. */
#ifndef ROT_RADAU_H
#define ROT_RADAU_H

#include <stddef.h>

#include "ground/ieee.h"

#define ROT_RADAU_ERROR_ORDER 5 /* the error of a step goes with h^6 */

/* dydt = f(t, y); anything but 0 ends the step. */
typedef int (*rot_radau_rhs)(double t, const double y[], double dydt[], void *ctx);

typedef struct rot_radau rot_radau;

rot_radau *rot_radau_alloc(size_t dim, size_t controlled);
void rot_radau_free(rot_radau *r);

enum { ROT_RADAU_OK, ROT_RADAU_DIVERGED = -1000 };

/* From y to y(t + h), in place, with its error. slope = f(t, y); allowed[i] > 0 is what the caller
 * takes for a good step: Newton stops at a small part of it. Returns 0, what f said, or that
 * Newton does not converge. */
int rot_radau_step(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h, double y[],
                   double error[], const double slope[], const double allowed[]);

#endif
