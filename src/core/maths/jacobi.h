/* Jacobi's elliptic functions and integrals from the complementary parameter m1 = 1 - m in [0, 1],
 * which resolves the limit m1 -> 0 (a separatrix). */
#ifndef ROT_JACOBI_H
#define ROT_JACOBI_H

#include "ground/dd.h"

/* One m1, 0 or 1e-290 <= m1 <= 1, or any that is as small as rot_jacobi_begin_far() takes, and many
 * arguments. */
typedef struct rot_jacobi {
  double m1; /* of less than DBL_MIN: that */
  rot_dd k;  /* K, to twice the precision if m1 is; Inf at m1 = 0 */
  int n;     /* steps of the arithmetic-geometric mean; -1: begun by rot_jacobi_begin_far() */
  double a[24], g[24];
} rot_jacobi;

void rot_jacobi_begin(rot_dd m1, rot_jacobi *out);

/* m1 = square(root 2^-halvings), the root between 2^-60 and 2^-50, and m1 of any size below:
 * K = log(4/sqrt(m1)), and the functions are hyperbolic ones of the distance from 0 or K. */
void rot_jacobi_begin_far(rot_dd root, double halvings, rot_jacobi *out);

/* sn, cn, dn of u.hi + u.lo, |u| <= K. Relative errors: sn 8 eps, cn and dn 6 eps (1 + w), with w
 * the distance from the nearer of 0 and K, and eps = 2^-53. */
void rot_jacobi_at(const rot_jacobi *jacobi, rot_dd u, double *sn, double *cn, double *dn);

/* Subtracts the nearest multiple of 2K from u; returns the multiple. */
double rot_jacobi_reduce(const rot_jacobi *jacobi, rot_dd *u);

/* Carlson's R_F of x, y, z >= 0, at most one of them 0. */
double rot_carlson_rf(double x, double y, double z);

/* Carlson's R_J of x, y, z >= 0, at most one of them 0, and p > 0. */
double rot_carlson_rj(double x, double y, double z, double p);

/* The mean over K of sn^2/(1 + (p - 1) sn^2), p > 0, to 2^-90; 1/p at m1 = 0. Its integral from 0
 * to u is sn^3/3 R_J(cn^2, dn^2, 1, 1 + (p - 1) sn^2). */
rot_dd rot_jacobi_mean(rot_dd m1, rot_dd p);

/* The argument |u| <= K at which the functions have these values, cn >= 0; near K from the distance
 * to it, so that cn keeps its digits. A common factor of sn and cn has no effect. *error: of u, for
 * values to some roundings. */
rot_dd rot_jacobi_argument(const rot_jacobi *jacobi, double sn, double cn, double dn,
                           double *error);

#endif
