/* A free body of any moments with rotors along its principal axis 3, exactly. With the momentum h
 * of the rotors beside that of the body,
 *
 *   L' = L x omega,  omega = (L1/I1, L2/I2, (L3 - h)/I3),
 *
 * L1^2 and L2^2 are polynomials of degree 2 in L3, and (L3')^2 = (1/I2 - 1/I1)^2 L1^2 L2^2. Between
 * the two turning points x1, x2 of L3, with L3 = x1 cos^2(a/2) + x2 sin^2(a/2),
 *
 *   tan(a/2) = k tan(A/2),  A = am(lambda t + start, m),  k^4 = R(x1)/R(x2),
 *   (L1 L2)^2 = (x - x1)(x2 - x) R(x):
 *
 * one form for real and complex zeros of R, and no term of a row cancels. m < 0 is transformed to
 * 0 < m < 1. The attitude is the smallest turn from L to the axis, and one about the axis by psi,
 * with
 *
 *   psi' = omega.(l + r)/(1 + l.r),  l = L/|L|,  r the axis, in its sense away from which L stays:
 *
 * a rational function of cn, so psi is an integral of the third kind and an arc tangent. All rates
 * are known to twice the precision.
 *
 * References: Wittenburg, Dynamics of Systems of Rigid Bodies (1977), section 3.3; Hughes,
 * Spacecraft Attitude Dynamics (1986), section 6.4; DLMF 19.36, 22. */
#ifndef ROT_FREE_GYROSTAT_MOTION_H
#define ROT_FREE_GYROSTAT_MOTION_H

#include "maths/jacobi.h"
#include "ground/status.h"

typedef struct rot_gyrostat_motion {
  int steady;                        /* omega is constant: */
  rot_dd rate;                       /* its size */
  double axis[3];                    /* and direction */
  double moment[3], omega0[3], size; /* size: a bound on all rates */
  /* of L: which component is 0 at x1 and at x2; those of the polynomials there; signs */
  int low, high;
  double momentum, x1, x2, low1, low2, high1, high2, root, sign_low, sign_high;
  double k, square; /* k and its square */
  int negative;     /* m < 0 */
  rot_jacobi jacobi;
  double root_m1;
  rot_dd lambda, start, psi;               /* of the functions' argument; psi: its mean rate */
  double direction, d1, d2;                /* r; |L| (1 + l.r) at x1 and x2 */
  double turn, turn_root, nu, swing, mean; /* of the parts of psi that repeat */
  double first[4], psi0;                   /* at the start */
  double start_error, lambda_error, psi_error, m1_error; /* relative; of psi absolute */
} rot_gyrostat_motion;

/* Moments near 1: I1, I2, and I3 without that of rotors that are not driven; rates and h near 1 at
 * most. ROT_ERANGE: a motion too near a separatrix, or one that passes both ends of axis 3. */
rot_status rot_gyrostat_begin(const rot_dd moment[3], const double omega[3], rot_dd h,
                              rot_gyrostat_motion *out);

/* After t: attitude since the start, rates; errors, of the angle and of the rates. */
void rot_gyrostat_at(const rot_gyrostat_motion *g, rot_dd t, double q[4], double omega[3],
                     double *q_error, double *omega_error);

#endif
