/* Torques on a body rotating about a point, for the integrators and fixed-step methods. */
#ifndef ROT_FREE_TORQUE_H
#define ROT_FREE_TORQUE_H

#include "scene/free/free.h"

/* (n not decreasing times x, t) => knots *i and *i + 1 around t, fraction *part between them; at
 * equal times the later one. Returns 0 if t is outside, else 1. */
int rot_free_between_knots(size_t n, const double x[], double t, size_t *i, double *part);

/* parameters => 1 if gravity has a torque, else 0. */
int rot_free_has_weight(const rot_free_params *p);

/* Gravity at the start, in principal axes: up, and the torque, which near an equilibrium is what
 * two products leave: of the given numbers in twice the precision. So is its sum with the constant
 * torque, which may balance it. */
typedef struct rot_free_hung {
  double up[3], torque[3];
  double lost[3];  /* the torque less its double */
  double both[3];  /* that and the constant torque */
  double space[3]; /* the constant torque, where it stays in space; else 0 */
} rot_free_hung;

/* (t, omega, attitude of the principal axes) => torque in principal axes, without gravity's. */
rot_status rot_free_torque(const rot_free_params *p, double t, const double omega[3],
                           const double q[4], double out[3]);

void rot_free_hang(const rot_free_params *p, rot_free_hung *out);
/* (rotation q since the start) => torque[] += torque of gravity: that at the start and its change,
 * which keep the digits of a motion of 1e-12 rad. */
void rot_free_add_hung(const rot_free_params *p, const rot_free_hung *hung, const double q[4],
                       double torque[3]);

/* (t, omega, attitude, rotation since the start) => torque with gravity's, in principal axes. */
rot_status rot_free_torque_hung(const rot_free_params *p, const rot_free_hung *hung, double t,
                                const double omega[3], const double q[4], const double turned[4],
                                double out[3]);

/* What rounding leaves uncertain of a law or a table beside gravity, N m; else 0. */
double rot_free_law_rounding(const rot_free_params *p);

#endif
