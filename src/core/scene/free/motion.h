/* A free rigid body, exactly: Euler's equations and the attitude for any moments, at any time.
 *
 *   I omega' = I omega x omega,   q' = q (0, omega)/2,   q(0) = 1 and omega(0) given,
 *
 * in the principal axes of the body. With the moments in order, I1 <= I2 <= I3, the rates are
 * Jacobi's functions of lambda t + u0; the attitude is a turn about the angular momentum L by an
 * angle psi between two rotations that take L to the z axis. psi grows evenly but for a part that
 * repeats, an integral of the third kind. All rates are known to twice the precision, so the error
 * does not grow with time.
 *
 * References: Landau & Lifshitz, Mechanics, section 37; DLMF 19.8, 19.36, 22; van Zon & Schofield,
 * J. Comput. Phys. 225 (2007) 145. */
#ifndef ROT_FREE_MOTION_H
#define ROT_FREE_MOTION_H

#include "maths/jacobi.h"
#include "ground/status.h"

/* Times are in the unit 2^-exponent s, moments in parts of a power of two. */
typedef struct rot_free_motion {
  int exponent;
  int order[3];     /* sorted axis k is axis order[k] of the body, */
  double sign[3];   /* in this sense: right-handed, too */
  double moment[3]; /* sorted */
  double omega0[3]; /* as given */
  int still;        /* does not turn */
  int steady;       /* omega is constant */
  double axis[3];   /* unit vector along omega, sorted: where it is constant */
  int o;            /* axis of cn */
  int c;            /* axis of dn */
  int r;            /* reference axis of psi */
  int lead;         /* of o and c, the one that is not r */
  double amplitude[3];
  double momentum;           /* |L| */
  rot_dd lambda, start, psi; /* u = lambda t + start; psi: its mean rate */
  rot_jacobi jacobi;
  double psi_size;                                        /* the sum of sizes of its terms */
  double nu, g, mean, near_mean, swing0, swing0_rounding; /* of the part of psi that repeats */
  int near;                                               /* the separatrix */
  int quarter, turns; /* of the angle about r: pi/4 at the start, pi for each 2 K */
  double first[4];    /* inverse of the rotation that takes L to z at the start */
  double rate;        /* |omega| at the start */
  /* errors: of u at the start, of m1 (relative; absolute where it is 0), of all rates by what is
   * uncertain in the input */
  double start_error, m1_loss, given;
} rot_free_motion;

/* ROT_EVALUE: a moment below 0 or not finite, an axis without moment that spins or whose other
 * moments differ. ROT_ERANGE: moments so far apart (1e100), or beside the middle axis two so close
 * (1e-80), that squares would underflow. `given`: relative error of moments and rates, 0
 * where they are exact. */
rot_status rot_free_begin(const double moment_kg_m2[3], const double omega_rad_per_s[3],
                          double given, rot_free_motion *out);

typedef struct rot_free_state {
  double q[4];     /* body to where the body's axes were at time 0; continuous, 1 at time 0 */
  double omega[3]; /* rad/s, in the body's axes */
  double q_error;  /* an angle in rad, at most pi */
  double omega_error;
} rot_free_state;

/* After t seconds, of any sign. */
void rot_free_at(const rot_free_motion *motion, rot_dd t, rot_free_state *out);

/* The time between two zeros of the rate about the middle axis, 2 K/lambda: after it two components
 * of omega have changed sign. Inf: never (a steady spin, or the separatrix). */
double rot_free_half_period(const rot_free_motion *motion);

#endif
