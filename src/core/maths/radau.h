/* One step of Radau IIA with five stages (order 9, L-stable) for small stiff systems:
 *
 *   Z_i = h sum_j a_ij f(t + c_j h, y + Z_j),   y(t + h) = y + Z_5,
 *
 * by simplified Newton iteration with a Jacobian from differences. Components after the first
 * `controlled` are quadratures, without implicit equations. The error is that of an embedded
 * formula of order 5. Reference: Hairer & Wanner, Solving Ordinary Differential Equations II,
 * sections IV.5, IV.8. */
#ifndef ROT_RADAU_H
#define ROT_RADAU_H

#include <stddef.h>

#include "ground/ieee.h"

#define ROT_RADAU_ERROR_ORDER 5 /* the error of a step goes with h^6 */

/* (t, y) => dydt; a result other than 0 ends the step */
typedef int (*rot_radau_rhs)(double t, const double y[], double dydt[], void *ctx);

typedef struct rot_radau rot_radau;

/* => work space for dim components; NULL: no memory */
rot_radau *rot_radau_alloc(size_t dim, size_t controlled);
/* Frees it; r may be NULL. */
void rot_radau_free(rot_radau *r);

enum { ROT_RADAU_OK, ROT_RADAU_DIVERGED = -1000 };

/* (t, h, y, slope = f(t, y)) => y(t + h) in place, its error. allowed[i] > 0: the caller's
 * tolerance for a step; Newton stops at a small fraction of it, predicted from the last two
 * corrections. `kinked`: f may have a kink at the end of the step, where the prediction is too
 * small. Returns 0, the code of f, or ROT_RADAU_DIVERGED. */
int rot_radau_step(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h, double y[],
                   double error[], const double slope[], const double allowed[], int kinked);

#endif
