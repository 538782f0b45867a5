/* Rotors in a free body. Rotor k has the moment J about its axis a, fixed in the body, and turns by
 * W relative to the body. I is the body's tensor with all rotors locked. Then
 *
 *   L = I omega + sum J W a   in the body's axes.
 *
 * A driven rotor has a constant W, and its motor whatever torque that takes. Any other has the
 * torque u of its motor, and its bearing no friction:
 *
 *   s' = u,  s = J (W + a omega),   which is its momentum about the axis,
 *   omega = (I - sum J a a*)^-1 (L - sum of s a - sum of the driven J W a).
 *
 * Reference: Hughes, Spacecraft Attitude Dynamics (1986), sections 3.4 and 6.2. */
#ifndef ROT_FREE_ROTORS_H
#define ROT_FREE_ROTORS_H

#include "scene/free/free.h"

typedef struct rot_free_rotors {
  const rot_free_params *p;
  size_t n, n_states;                           /* rotors; those that are not driven */
  size_t state[ROT_FREE_MAX_ROTORS];            /* of such a rotor: which s is its own */
  double axis[ROT_FREE_MAX_ROTORS][3];          /* principal axes */
  double inverse[3][3];                         /* of I - sum J a a* */
  double min;                                   /* a lower bound on the moments of that */
  double driven[3];                             /* their sum of J W a */
  double omega0[3], start[ROT_FREE_MAX_ROTORS]; /* s at the start */
  double momentum0[3], size;                    /* L there; the sum of sizes of rotors' J W */
} rot_free_rotors;

/* NULL, or why the rates are not determined. Without rotors omega is L over the moments. */
const char *rot_free_rotors_begin(const rot_free_params *p, rot_free_rotors *out);

/* Principal axes; s: n_states values. */
void rot_free_rotors_omega(const rot_free_rotors *r, const double l[3], const double s[],
                           double omega[3]);

/* Where no motor has a torque: omega = (L - h)/m with these constants, if the rotors that are not
 * driven lie along principal axes. Else 0 is returned. */
int rot_free_rotors_constant(const rot_free_rotors *r, double m[3], double h[3]);

/* W of each rotor. */
void rot_free_rotors_speeds(const rot_free_rotors *r, const double omega[3], const double s[],
                            double speed[]);

/* The torques u of the motors, those of driven rotors 0: at rates and an attitude in principal
 * axes. */
rot_status rot_free_rotors_torque(const rot_free_rotors *r, double t, const double omega[3],
                                  const double q[4], double torque[]);

/* s' and the power of the motors, without that of driven ones. */
rot_status rot_free_rotors_slopes(const rot_free_rotors *r, double t, const double omega[3],
                                  const double q[4], const double s[], double slope[],
                                  double *power);

/* The work of the motors of driven rotors, from the start to these rates. */
double rot_free_rotors_driven_work(const rot_free_rotors *r, const double omega[3]);

/* As rot_free_note(), with the momenta of the rotors. */
void rot_free_rotors_note(const rot_free_rotors *r, const double omega[3], double angle_error,
                          double omega_error, rot_info *info);

/* What rotors change in row i, which rot_free_write() wrote: L, the energy; and their columns. */
rot_status rot_free_rotors_write(const rot_free_rotors *r, const double omega[3], const double q[4],
                                 const double s[], size_t i, const rot_free_columns *out);

#endif
