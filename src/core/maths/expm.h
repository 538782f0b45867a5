/* The exponential of a matrix: Pade approximants of degree 3 to 13, scaling and squaring.
 *
 * Reference: Higham, SIAM J. Matrix Anal. Appl. 26 (2005) 1179. */
#ifndef ROT_EXPM_H
#define ROT_EXPM_H

#include <stddef.h>

#include "ground/status.h"

/* Doubles of work space. */
#define ROT_EXPM_WORK(n) (7 * (n) * (n))

/* a => e = exp(a), n x n, by rows. If the exponential does not grow, the error is some 1e-16 times
 * the 1-norm of a. ROT_ERANGE if it overflows. Polls the hooks (NULL: none) for large n. */
rot_status rot_expm(size_t n, const double a[], double e[], double work[], const rot_hooks *hooks);

/* (a, b) => c = a b, n x n; polls for large n. */
rot_status rot_expm_multiply(size_t n, const double a[], const double b[], double c[],
                             const rot_hooks *hooks);
/* (a, x) => y = a x */
void rot_expm_apply(size_t n, const double a[], const double x[], double y[]);

#endif
