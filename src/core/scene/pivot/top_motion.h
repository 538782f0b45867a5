/* The heavy symmetric top, exactly: a body with an axis of symmetry, one point of that axis fixed,
 * under uniform gravity.
 *
 *   I1 w1' = (I1 - I3) w2 w3 + G z2,   I1 w2' = (I3 - I1) w3 w1 - G z1,   w3' = 0,
 *
 * in the body's axes, 3 along the symmetry axis: I1 and I3 about the fixed point, G = m g l with l
 * from the fixed point to the centre of mass along axis 3, z the vertical in these axes. The cosine
 * u of the angle between axis 3 and the vertical is an elliptic function of time; the sum and the
 * difference of the Euler angles phi and psi, which are regular at the poles, grow evenly but for a
 * part that repeats, an integral of the third kind. All rates are known to twice the precision, so
 * the error does not grow with time.
 *
 * References: Goldstein, Poole & Safko 2002, section 5.7; Whittaker 1937, sections 71 to 72; DLMF
 * 19.8, 19.36, 22. */
#ifndef ROT_TOP_MOTION_H
#define ROT_TOP_MOTION_H

#include "scene/free/motion.h"
#include "maths/jacobi.h"
#include "ground/status.h"

/* The start: attitude, body to space, z up, of any length but 0; angular velocity in the body's
 * axes. Numbers of twice the precision, since their rounding grows with time. */
typedef struct rot_top_start {
  rot_dd q[4], omega[3];
} rot_top_start;

/* From Euler angles z-x-z (phi, theta, psi) and the rates phi', theta' and omega3. */
void rot_top_from_euler(double phi, double theta, double psi, double phi_rate, double theta_rate,
                        double omega3, rot_top_start *out);

/* Of phi + psi and phi - psi: an angle that grows evenly but for a part that repeats. */
typedef struct rot_top_angle {
  rot_dd rate;    /* mean */
  double size;    /* the sum of sizes of its terms */
  double g, part; /* g/(1 + part sn^2): what is not even of its rate */
  double whole;   /* 1 + part */
  double j;       /* mean of sn^2/(1 + part sn^2) */
  double near[4]; /* where 1 + part is large: see swing_of() */
  double start;   /* the part that repeats, at the start */
  double rounding;
} rot_top_angle;

/* Times are in the unit 2^-exponent s. */
typedef struct rot_top_motion {
  int exponent;
  int hangs;         /* G < 0: seen with the body's axes 2 and 3 turned over */
  int still, steady; /* at rest for good; or u is constant */
  int weightless;    /* G = 0: free */
  rot_free_motion free;
  double q0[4];        /* the attitude at the start */
  double omega3, spin; /* spin: omega3 - L3/I1, which only turns the body on its axis */
  double pull;         /* |G|/I1 */
  double b_minus_a, b_plus_a;
  double above, below, swing; /* 1 - u2, 1 + u1, u2 - u1: u goes from u1 to u2 */
  double cosine;              /* u at the start */
  rot_dd lambda, start;       /* the argument: lambda t + start */
  rot_jacobi jacobi;
  rot_top_angle sum, difference;
  double sum0[2], difference0[2]; /* cosine and sine of half of them at the start */
  double rate;                    /* |omega| at most */
  double start_error, m1_loss, given;
  /* of the rates of both angles, of lambda, and of K: see rot_top_differ() */
  double sum_error, difference_error, lambda_error, k_error;
  double omega0[3];
} rot_top_motion;

/* ROT_EVALUE: moments that are not positive (I1) or negative (I3) or not finite, I3 > 2 I1, other
 * numbers not finite, an attitude of length 0. ROT_ERANGE: G/I1 below 1e-60 of the squares of the
 * rates. `given`: relative error of the constants. */
rot_status rot_top_begin(double transverse_kg_m2, double axial_kg_m2, double weight_n_m,
                         const rot_top_start *start, double given, rot_top_motion *out);

/* With wheels on the axis, which have this constant angular momentum relative to the body: the axis
 * follows from that of all, I3 omega3 + wheels. The moments are those with the wheels locked; with
 * wheels the weight must not be 0 (ROT_EVALUE). */
rot_status rot_top_begin_wheels(double transverse_kg_m2, double axial_kg_m2, rot_dd weight_n_m,
                                rot_dd wheels, const rot_top_start *start, double given,
                                rot_top_motion *out);

/* The start is uncertain, and `other` begins at a start that is as likely: adds the differences of
 * their rates, which grow with time, to the errors of the motion. */
void rot_top_differ(rot_top_motion *motion, const rot_top_motion *other);

typedef struct rot_top_state {
  double q[4];     /* body to space, unit */
  double omega[3]; /* rad/s, in the body's axes */
  double q_error;  /* an angle in rad, at most pi */
  double omega_error;
} rot_top_state;

/* After t seconds, of any sign. */
void rot_top_at(const rot_top_motion *motion, rot_dd t, rot_top_state *out);

/* Of the nutation: its period in s (Inf: none), the cosines between which it goes, and how far phi
 * goes on in a period, in rad. */
typedef struct rot_top_nutation {
  double period_s, lowest_cosine, highest_cosine, precession_rad;
} rot_top_nutation;

rot_top_nutation rot_top_nutates(const rot_top_motion *motion);

/* The rates phi' of steady precession at an angle with this cosine, in rad/s: the slow one and the
 * fast one; NaN where there is none. */
void rot_top_steady(double transverse_kg_m2, double axial_kg_m2, double weight_n_m, double cosine,
                    double omega3, double *slow, double *fast);

#endif
