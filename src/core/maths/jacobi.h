/* Jacobi's elliptic functions and integrals from the complementary parameter m1 = 1 - m in [0, 1],
 * which resolves the limit m1 -> 0 (a separatrix). */
#ifndef ROT_JACOBI_H
#define ROT_JACOBI_H

#include "ground/dd.h"

/* Constants of one m1, for many arguments. */
typedef struct rot_jacobi {
  double m1;           /* at least DBL_MIN, or 0 */
  rot_dd k;            /* K, to twice the precision if m1 is; Inf at m1 = 0 */
  int n;               /* steps of the arithmetic-geometric mean; -1: from rot_jacobi_begin_far() */
  double a[24], g[24]; /* means of each step, arithmetic and geometric */
} rot_jacobi;

/* m1 (0, or 1e-290 to 1) => constants */
void rot_jacobi_begin(rot_dd m1, rot_jacobi *out);

/* sqrt(m1) = root 2^-halvings, root from 2^-60 to 2^-50 => constants, for any smaller m1.
 * K = log(4/sqrt(m1)); the functions are hyperbolic functions of the distance from 0 or K. */
void rot_jacobi_begin_far(rot_dd root, double halvings, rot_jacobi *out);

/* u, |u| <= K => sn, cn, dn. Relative errors: sn 8 eps, cn and dn 6 eps (1 + w), with w the
 * distance from the nearer of 0 and K, and eps = 2^-53. */
void rot_jacobi_at(const rot_jacobi *jacobi, rot_dd u, double *sn, double *cn, double *dn);

/* Subtracts the nearest multiple of 2K from u; returns the multiple, rounded. *quarter: the
 * multiple modulo 4, 0 to 3, exact also where a double does not hold the multiple. */
double rot_jacobi_reduce(const rot_jacobi *jacobi, rot_dd *u, int *quarter);

/* x, y, z >= 0, at most one of them 0 => Carlson's R_F */
double rot_carlson_rf(double x, double y, double z);

/* x, y, z >= 0, at most one of them 0, p > 0 => Carlson's R_J */
double rot_carlson_rj(double x, double y, double z, double p);

/* (m1, p > 0) => mean of sn^2/(1 + (p - 1) sn^2) over K, to 2^-90; 1/p at m1 = 0. The integral of
 * this function from 0 to u is sn^3/3 R_J(cn^2, dn^2, 1, 1 + (p - 1) sn^2). */
rot_dd rot_jacobi_mean(rot_dd m1, rot_dd p);

/* (sn, cn >= 0, dn) => argument |u| <= K, *error of u for values to some roundings. Near K it is
 * computed from the distance to K, so that cn stays accurate. A common factor of sn and cn has no
 * effect. */
rot_dd rot_jacobi_argument(const rot_jacobi *jacobi, double sn, double cn, double dn,
                           double *error);

#endif
