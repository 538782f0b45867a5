/* Exact motion of a free body of any moments with rotors along its principal axis 3. With the
 * momentum h of the rotors in addition to that of the body,
 *
 *   L' = L x omega,  omega = (L1/I1, L2/I2, (L3 - h)/I3).
 *
 * L1^2 and L2^2 are polynomials of degree 2 in L3, and (L3')^2 = (1/I2 - 1/I1)^2 L1^2 L2^2. Between
 * the turning points x1, x2 of L3, with L3 = x1 cos^2(a/2) + x2 sin^2(a/2),
 *
 *   tan(a/2) = k tan(A/2),  A = am(lambda t + start, m),  k^4 = R(x1)/R(x2),
 *   (L1 L2)^2 = (x - x1)(x2 - x) R(x):
 *
 * one form for real and complex zeros of R, without cancellation in a row. m < 0 is transformed to
 * 0 < m < 1. The attitude is the smallest rotation from L to the axis, and one about the axis by
 * psi, with
 *
 *   psi' = omega.(l + r)/(1 + l.r),  l = L/|L|,  r: +axis or -axis, the one that l never opposes:
 *
 * a rational function of cn; psi is an integral of the third kind plus an arc tangent. All rates
 * have twice the precision.
 *
 * References: Wittenburg, Dynamics of Systems of Rigid Bodies (1977), section 3.3; Hughes,
 * Spacecraft Attitude Dynamics (1986), section 6.4; DLMF 19.36, 22. */
#ifndef ROT_FREE_GYROSTAT_MOTION_H
#define ROT_FREE_GYROSTAT_MOTION_H

#include "maths/jacobi.h"
#include "ground/status.h"

typedef struct rot_gyrostat_motion {
  int steady;     /* 1: omega is constant */
  rot_dd rate;    /* steady: |omega| */
  double axis[3]; /* steady: direction of omega */
  double moment[3], omega0[3];
  double size;                     /* upper bound of all rates */
  int low, high;                   /* components of L that are 0 at x1, at x2 */
  double momentum;                 /* |L| */
  double x1, x2;                   /* turning points of L3 */
  double low1, low2, high1, high2; /* of the cofactors of L1^2, L2^2 at x1, x2 */
  double root;                     /* common factor of the components `low`, `high` */
  double sign_low, sign_high;      /* their signs */
  double k, square;                /* k, k^2 */
  int negative;                    /* 1: m < 0 */
  rot_jacobi jacobi;
  double root_m1;
  rot_dd lambda, start;                    /* argument of the functions: lambda t + start */
  rot_dd psi;                              /* mean rate of psi */
  double direction;                        /* sign of r along axis 3 */
  double d1, d2;                           /* |L| (1 + l.r) at x1, x2 */
  double turn, turn_root, nu, swing, mean; /* constants of the periodic parts of psi */
  double first[4], psi0;                   /* attitude, psi at the start */
  double start_error, lambda_error, psi_error, m1_error; /* relative; psi_error: absolute */
} rot_gyrostat_motion;

/* (moments, rates, h) => motion. Moments near 1: I1, I2, and I3 without the rotors that are not
 * driven; |rates| and |h| about 1 at most. ROT_ERANGE: close to a separatrix, or L passes both ends
 * of axis 3. */
rot_status rot_gyrostat_begin(const rot_dd moment[3], const double omega[3], rot_dd h,
                              rot_gyrostat_motion *out);

/* (motion, t) => attitude since the start, rates; errors of angle and rates. */
void rot_gyrostat_at(const rot_gyrostat_motion *g, rot_dd t, double q[4], double omega[3],
                     double *q_error, double *omega_error);

#endif
