/* Exact motion of the heavy symmetric top: a body with an axis of symmetry, a point of this axis
 * fixed, under uniform gravity.
 *
 *   I1 w1' = (I1 - I3) w2 w3 + G z2,   I1 w2' = (I3 - I1) w3 w1 - G z1,   w3' = 0
 *
 * in body axes, 3 along the axis of symmetry. I1 and I3: about the fixed point; G = m g l, l from
 * the fixed point to the centre of mass along axis 3; z: the vertical in body axes. u, the cosine
 * of the angle between axis 3 and the vertical, is an elliptic function of time. The sum and the
 * difference of the Euler angles phi and psi are regular at the poles: each is a linear function of
 * time plus a periodic part, an integral of the third kind. All rates have twice the precision, so
 * that the error does not grow with time.
 *
 * References: Goldstein, Poole & Safko 2002, section 5.7; Whittaker 1937, sections 71 to 72; DLMF
 * 19.8, 19.36, 22. */
#ifndef ROT_TOP_MOTION_H
#define ROT_TOP_MOTION_H

#include "scene/free/motion.h"
#include "maths/jacobi.h"
#include "ground/status.h"

/* Initial state, in twice the precision: its rounding grows with time. */
typedef struct rot_top_start {
  rot_dd q[4];     /* attitude, body to space (z up); any length > 0 */
  rot_dd omega[3]; /* rad/s, in body axes */
} rot_top_start;

/* (Euler angles z-x-z, phi', theta', omega3) => initial state. */
void rot_top_from_euler(double phi, double theta, double psi, double phi_rate, double theta_rate,
                        double omega3, rot_top_start *out);

/* The angle phi + psi or phi - psi: a linear function of time plus a periodic part. */
typedef struct rot_top_angle {
  rot_dd rate;     /* mean */
  double size;     /* sum of |terms| of the mean rate */
  double g, part;  /* periodic part of the rate: g/(1 + part sn^2) */
  double whole;    /* 1 + part */
  double j;        /* mean of sn^2/(1 + part sn^2) */
  double near[4];  /* constants for large 1 + part: see swing_of() */
  double start;    /* periodic part at the start */
  double rounding; /* of `start`, in units of ROT_EPS */
} rot_top_angle;

/* Constants of a motion. Unit of time: 2^-exponent s. */
typedef struct rot_top_motion {
  int exponent;
  int hangs;            /* 1: G < 0, computed with body axes 2 and 3 reversed */
  int still;            /* 1: permanently at rest */
  int steady;           /* 1: u is constant */
  int weightless;       /* 1: G = 0, free motion */
  rot_free_motion free; /* if weightless */
  double q0[4];         /* attitude at the start */
  double omega3;
  double spin;                /* omega3 - L3/I1: rotation about axis 3 only */
  double pull;                /* |G|/I1 */
  double b_minus_a, b_plus_a; /* phi' = (b - a u)/(1 - u^2) */
  double above, below, swing; /* 1 - u2, 1 + u1, u2 - u1, with u in [u1, u2] */
  double cosine;              /* u at the start */
  double precession;          /* mean of phi'; NaN: weightless, or balanced upright */
  double nutates;             /* steady: frequency of a small nutation; 0: unstable */
  rot_dd lambda, start;       /* argument of the elliptic functions: lambda t + start */
  rot_jacobi jacobi;
  rot_top_angle sum, difference;  /* phi + psi, phi - psi */
  double sum0[2], difference0[2]; /* cosine and sine of half of them at the start */
  double rate;                    /* maximum of |omega| */
  double start_error;             /* of `start` */
  double m1_loss;                 /* error of the modulus by cancellation */
  double given;                   /* relative error of the constants */
  /* Errors of the rates of both angles, of lambda and of K: see rot_top_differ(). */
  double sum_error, difference_error, lambda_error, k_error;
  double omega0[3];
} rot_top_motion;

/* (moments, G, initial state) => motion. given: relative error of the constants. ROT_EVALUE: I1 <=
 * 0, I3 < 0, I3 > 2 I1, a number not finite, or an attitude of length 0. ROT_ERANGE: G/I1 below
 * 1e-60 of the squares of the rates. */
rot_status rot_top_begin(double transverse_kg_m2, double axial_kg_m2, double weight_n_m,
                         const rot_top_start *start, double given, rot_top_motion *out);

/* (transverse moment, G, momentum of wheels, largest component of the initial rates) => 0, or what
 * makes that a ROT_ERANGE: G times 4 to this power is none. */
int rot_top_excess(double transverse_kg_m2, double weight_n_m, double wheels,
                   double omega_rad_per_s);

/* The same with wheels on the axis. wheels: their constant angular momentum relative to the body;
 * the axis follows from the total, I3 omega3 + wheels. The moments are those with locked wheels.
 * With wheels the weight must not be 0 (ROT_EVALUE). */
rot_status rot_top_begin_wheels(double transverse_kg_m2, double axial_kg_m2, rot_dd weight_n_m,
                                rot_dd wheels, const rot_top_start *start, double given,
                                rot_top_motion *out);

/* Adds the effect of an uncertain start to the errors: `other` is the motion from an equally likely
 * start; the differences of the rates grow with time. */
void rot_top_differ(rot_top_motion *motion, const rot_top_motion *other);

typedef struct rot_top_state {
  double q[4];     /* attitude, body to space, unit quaternion */
  double omega[3]; /* rad/s, in body axes */
  double q_error;  /* rad, 0 to pi */
  double omega_error;
} rot_top_state;

/* (motion, t in s, any sign) => state, its errors. */
void rot_top_at(const rot_top_motion *motion, rot_dd t, rot_top_state *out);

/* The nutation of a motion. */
typedef struct rot_top_nutation {
  double period_s;                      /* > 0, of a small one if u is constant; Inf: none */
  double lowest_cosine, highest_cosine; /* limits of u */
  double lowest_rad;                    /* angle of axis 3 where the centre of mass is lowest */
  double amplitude_rad;                 /* half the difference of the two angles */
  double precession_rad_per_s;          /* mean of phi'; vertical: the slow rate beside it */
} rot_top_nutation;

/* motion => nutation. */
rot_top_nutation rot_top_nutates(const rot_top_motion *motion);

/* (moments, G, cosine of the angle, omega3) => slow and fast rate phi' of steady precession in
 * rad/s; NaN: none. */
void rot_top_steady(double transverse_kg_m2, double axial_kg_m2, double weight_n_m, double cosine,
                    double omega3, double *slow, double *fast);

#endif
