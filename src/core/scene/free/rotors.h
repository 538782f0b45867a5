/* Rotors in a free body. Rotor k has the moment J about its axis a, fixed in the body, and the rate
 * W relative to the body. I: inertia tensor with all rotors locked. Then
 *
 *   L = I omega + sum J W a   in body axes.
 *
 * Driven rotor: W is constant, its motor supplies the torque needed. Other rotors: torque u of the
 * motor, no friction in the bearing:
 *
 *   s' = u,  s = J (W + a omega): momentum about the axis,
 *   omega = (I - sum J a a*)^-1 (L - sum of s a - sum of the driven J W a).
 *
 * Reference: Hughes, Spacecraft Attitude Dynamics (1986), sections 3.4 and 6.2. */
#ifndef ROT_FREE_ROTORS_H
#define ROT_FREE_ROTORS_H

#include "scene/free/free.h"

typedef struct rot_free_rotors {
  const rot_free_params *p;
  size_t n;                            /* number of rotors */
  size_t n_states;                     /* number of rotors that are not driven */
  size_t state[ROT_FREE_MAX_ROTORS];   /* index of s of a rotor that is not driven */
  double axis[ROT_FREE_MAX_ROTORS][3]; /* principal axes */
  double inverse[3][3];                /* of I - sum J a a*, over the rotors not driven */
  double min;                          /* lower bound on the moments of that tensor */
  double driven[3];                    /* sum of J W a over the driven rotors */
  double omega0[3];                    /* at the start, principal axes */
  double start[ROT_FREE_MAX_ROTORS];   /* s at the start */
  double momentum0[3];                 /* L at the start */
  double size;                         /* sum of |J W| over the rotors */
} rot_free_rotors;

/* parameters => rotors; returns NULL, or why the rates are not determined. Without rotors omega is
 * L over the moments. */
const char *rot_free_rotors_begin(const rot_free_params *p, rot_free_rotors *out);

/* (L in principal axes, s) => omega in principal axes. s: n_states values. */
void rot_free_rotors_omega(const rot_free_rotors *r, const double l[3], const double s[],
                           double omega[3]);

/* rotors without motor torque => m, h of omega = (L - h)/m. Returns 0 unless the rotors that are
 * not driven are along principal axes, else 1. */
int rot_free_rotors_constant(const rot_free_rotors *r, double m[3], double h[3]);

/* (omega, s) => W of each rotor. */
void rot_free_rotors_speeds(const rot_free_rotors *r, const double omega[3], const double s[],
                            double speed[]);

/* (t, rates, attitude in principal axes) => torques u of the motors; driven rotors: 0. */
rot_status rot_free_rotors_torque(const rot_free_rotors *r, double t, const double omega[3],
                                  const double q[4], double torque[]);

/* (t, state) => s', power of the motors without those of driven rotors. */
rot_status rot_free_rotors_slopes(const rot_free_rotors *r, double t, const double omega[3],
                                  const double q[4], const double s[], double slope[],
                                  double *power);

/* rates => work of the motors of driven rotors since the start. */
double rot_free_rotors_driven_work(const rot_free_rotors *r, const double omega[3]);

/* rot_free_note() with the momenta of the rotors. */
void rot_free_rotors_note(const rot_free_rotors *r, const double omega[3], double angle_error,
                          double omega_error, rot_info *info);

/* (state) => row i, already written by rot_free_write(): L and energy with rotors, columns of
 * rotors. */
rot_status rot_free_rotors_write(const rot_free_rotors *r, const double omega[3], const double q[4],
                                 const double s[], size_t i, const rot_free_columns *out);

#endif
