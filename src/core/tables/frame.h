/* Rotating frames: projectiles and pendulums on a rotating planet in closed form, and motions
 * carried into a frame and out of it.
 *
 *   r'' = g - 2 Omega x r',  g the effective gravity (with the centrifugal part), uniform.
 *
 * References: Landau & Lifshitz 1976, section 39; Goldstein, Poole & Safko 2002, section 4.10. */
#ifndef ROT_FRAME_H
#define ROT_FRAME_H

#include "ground/ieee.h"

/* East, north, up, from where it started, with this velocity there. */
typedef struct rot_projectile_input {
  double omega_rad_per_s, latitude_deg, gravity_m_per_s2, v_m_per_s[3], time_s;
} rot_projectile_input;

typedef struct rot_projectile {
  double r_m[3], v_m_per_s[3];
  double deflection_m[3];     /* from the parabola without rotation */
  double first_order_m[3];    /* the same to the first order in Omega */
  double first_order_error_m; /* at most, of the length of that vector */
} rot_projectile;

rot_projectile rot_frame_projectile(const rot_projectile_input *in);

/* The time in s in which a body that starts at rest falls by h >= 0; NaN where it never does. */
double rot_frame_fall_time(double omega, double latitude_deg, double gravity, double height);

/* A Foucault pendulum, small swings: east and north at a time, from r0 and v0 over the ground; the
 * rate at which its plane turns. */
void rot_frame_foucault(double omega, double latitude_deg, double gravity, double length,
                        const double r0[2], const double v0[2], double t, double r[2], double v[2],
                        double *plane_rate);

/* rate beta/(1 + beta) t less whole double turns, good to some roundings up to 1e15 rad; beta Inf:
 * rate t. */
double rot_frame_angle(double rate, double beta, double t);

/* A frame that is turned by an angle about a unit axis through the origin, at this rate, with this
 * angular acceleration. */
typedef struct rot_frame {
  double axis[3], theta_rad, omega_rad_per_s, alpha_rad_per_s2;
} rot_frame;

/* A motion in an inertial frame as seen in the turned one: position, velocity, acceleration. */
void rot_frame_enter(const rot_frame *frame, const double r[3], const double v[3],
                     const double a[3], double r_in[3], double v_in[3], double a_in[3]);

/* The reverse. */
void rot_frame_leave(const rot_frame *frame, const double r_in[3], const double v_in[3],
                     const double a_in[3], double r[3], double v[3], double a[3]);

/* The accelerations that appear in the turned frame, in its axes: -omega x (omega x r),
 * -2 omega x v, -alpha x r. */
void rot_frame_terms(const rot_frame *frame, const double r_in[3], const double v_in[3],
                     double centrifugal[3], double coriolis[3], double euler[3]);

#endif
