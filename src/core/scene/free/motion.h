/* Exact motion of a free rigid body: Euler's equations and the attitude, for any moments and times.
 *
 *   I omega' = I omega x omega,   q' = q (0, omega)/2,   q(0) = 1 and omega(0) given,
 *
 * in principal axes. With sorted moments I1 <= I2 <= I3, the rates are Jacobi's functions of lambda
 * t + u0. The attitude is a rotation about the angular momentum L by an angle psi between two
 * rotations that take L to the z axis. psi is a linear function of time plus a periodic part, an
 * integral of the third kind. All rates have twice the precision, so that the error does not grow
 * with time.
 *
 * References: Landau & Lifshitz, Mechanics, section 37; DLMF 19.8, 19.36, 22; van Zon & Schofield,
 * J. Comput. Phys. 225 (2007) 145. */
#ifndef ROT_FREE_MOTION_H
#define ROT_FREE_MOTION_H

#include "maths/jacobi.h"
#include "ground/status.h"

/* Constants of a motion. Unit of time: 2^-exponent s; moments are divided by a power of two. */
typedef struct rot_free_motion {
  int exponent;
  int order[3];     /* sorted axis k is body axis order[k] */
  double sign[3];   /* sense of sorted axis k: the sorted axes are right-handed */
  double moment[3]; /* sorted */
  double omega0[3]; /* as given */
  int still;        /* 1: at rest */
  int steady;       /* 1: omega is constant */
  double axis[3];   /* steady: unit vector along omega, sorted */
  int o;            /* axis of cn */
  int c;            /* axis of dn */
  int r;            /* reference axis of psi: o or c */
  int lead;         /* the other one of o and c */
  double amplitude[3];
  double momentum;      /* |L| */
  rot_dd lambda, start; /* u = lambda t + start */
  rot_dd psi;           /* mean rate of psi */
  rot_jacobi jacobi;
  double psi_size;                                        /* sum of |terms| of the mean rate */
  double nu, g, mean, near_mean, swing0, swing0_rounding; /* of the periodic part of psi */
  int near;                                               /* 1: close to the separatrix */
  int quarter;        /* half of the angle about r at the start, in units of pi/4 */
  int turns;          /* change of that angle for each 2 K, in units of pi */
  double first[4];    /* inverse of the rotation that takes L to z at the start */
  double rate;        /* |omega| at the start */
  double start_error; /* of u at the start */
  double m1_loss;     /* error of m1: relative; absolute if m1 = 0 */
  double given;       /* relative error of all rates due to the input */
} rot_free_motion;

/* (moments, rates) => motion. given: relative error of moments and rates; 0: exact. ROT_EVALUE: a
 * moment < 0 or not finite, or an axis without moment that spins or whose other moments differ.
 * ROT_ERANGE: moments with ratios beyond 1e100, or two that differ by less than 1e-80 next to the
 * middle axis: squares would underflow. */
rot_status rot_free_begin(const double moment_kg_m2[3], const double omega_rad_per_s[3],
                          double given, rot_free_motion *out);

typedef struct rot_free_state {
  double q[4];     /* body axes to those at time 0; continuous in time, 1 at time 0 */
  double omega[3]; /* rad/s, in body axes */
  double q_error;  /* rad, 0 to pi */
  double omega_error;
} rot_free_state;

/* (motion, t in s, any sign) => state, its errors. */
void rot_free_at(const rot_free_motion *motion, rot_dd t, rot_free_state *out);

/* motion => time between two zeros of the rate about the middle axis, 2 K/lambda, after which two
 * components of omega have changed sign. Inf: never (steady spin, separatrix). */
double rot_free_half_period(const rot_free_motion *motion);

#endif
