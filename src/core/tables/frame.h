/* Rotating frames: projectiles and pendulums on a rotating planet in closed form, transformation of
 * motions to a rotating frame and back.
 *
 *   r'' = g - 2 Omega x r',  g the effective gravity (with the centrifugal part), uniform.
 *
 * References: Landau & Lifshitz 1976, section 39; Goldstein, Poole & Safko 2002, section 4.10. */
#ifndef ROT_FRAME_H
#define ROT_FRAME_H

#include "ground/ieee.h"

/* Vectors are east, north, up, relative to the start. */
typedef struct rot_projectile_input {
  double omega_rad_per_s;  /* of the planet */
  double latitude_deg;     /* -90 to 90 */
  double gravity_m_per_s2; /* > 0 */
  double v_m_per_s[3];     /* at the start */
  double time_s;
} rot_projectile_input;

typedef struct rot_projectile {
  double r_m[3], v_m_per_s[3];
  double deflection_m[3];     /* from the parabola without rotation */
  double first_order_m[3];    /* deflection to first order in Omega */
  double first_order_error_m; /* bound of the length of its error */
} rot_projectile;

/* (start, time) => position, velocity, deflection */
rot_projectile rot_frame_projectile(const rot_projectile_input *in);

/* height >= 0 => time in s of a fall from rest; NaN if the height is never reached */
double rot_frame_fall_time(double omega, double latitude_deg, double gravity, double height);

/* Foucault pendulum of small amplitude: (r0, v0 relative to the ground, t) => r, v (east, north),
 * rate of rotation of its plane, rate of its phase; NaN: the phase is 2^52 rad or more */
void rot_frame_foucault(double omega, double latitude_deg, double gravity, double length,
                        const double r0[2], const double v0[2], double t, double r[2], double v[2],
                        double *plane_rate, double *swing_rate_rad_per_s);

/* => angle rate beta/(1 + beta) t modulo 4 pi, to some roundings up to 1e15 rad; rate t for
 * beta = Inf */
double rot_frame_angle(double rate, double beta, double t);

/* A frame that rotates about an axis through the origin. */
typedef struct rot_frame {
  double axis[3]; /* unit vector */
  double theta_rad;
  double omega_rad_per_s;
  double alpha_rad_per_s2;
} rot_frame;

/* (r, v, a in the inertial frame) => (r, v, a) relative to the rotating frame, in its axes */
void rot_frame_enter(const rot_frame *frame, const double r[3], const double v[3],
                     const double a[3], double r_in[3], double v_in[3], double a_in[3]);

/* The inverse of rot_frame_enter(). */
void rot_frame_leave(const rot_frame *frame, const double r_in[3], const double v_in[3],
                     const double a_in[3], double r[3], double v[3], double a[3]);

/* (r, v in the rotating frame) => apparent accelerations in its axes: -omega x (omega x r),
 * -2 omega x v, -alpha x r */
void rot_frame_terms(const rot_frame *frame, const double r_in[3], const double v_in[3],
                     double centrifugal[3], double coriolis[3], double euler[3]);

#endif
