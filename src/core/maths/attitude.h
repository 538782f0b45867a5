/* Attitudes as unit quaternions, scalar first: v_space = q v_body q*. q and -q are one attitude.
 *
 * References: Shepperd, J. Guid. Control 1 (1978) 223 (from a matrix); Schaub & Junkins, J.
 * Astronaut. Sci. 44 (1996) 1 (modified Rodrigues parameters); Bernardes & Viollet, PLOS ONE 17
 * (2022) e0276302 (Euler angles of any sequence). */
#ifndef ROT_ATTITUDE_H
#define ROT_ATTITUDE_H

#include "ground/ieee.h"

typedef enum rot_attitude_form {
  ROT_FORM_QUATERNION, /* w, x, y, z */
  ROT_FORM_MATRIX,     /* r11, r12, r13, r21, ...: v_space = R v_body */
  ROT_FORM_VECTOR,     /* rotation vector: axis times angle, in rad */
  ROT_FORM_AXIS_ANGLE, /* axis, angle in rad */
  ROT_FORM_RODRIGUES,  /* modified Rodrigues parameters: axis tan(angle/4) */
  ROT_FORM_EULER,      /* angles in rad, in the order of the sequence */
  ROT_FORM_COUNT
} rot_attitude_form;

enum { ROT_FORM_MAX = 9 };

/* How many numbers a form has. */
int rot_attitude_numbers(rot_attitude_form form);

/* Axes 0, 1, 2 of three rotations, neighbours different; about the body's axes (intrinsic: each
 * turns with those before), or about those of space. */
typedef struct rot_euler {
  int axis[3];
  int intrinsic;
} rot_euler;

/* Unit quaternion of an attitude in some form, to a few roundings. Returned: what was corrected, 0
 * where nothing was: |length - 1| of a quaternion, the largest element of |R'R - 1| of a matrix
 * (Inf for a reflection). A zero quaternion or axis gives NaN. `sequence` is for Euler angles. */
double rot_attitude_from(rot_attitude_form form, const double x[], const rot_euler *sequence,
                         double q[4]);

/* Euler angles: the middle one is closer than this (rad) to where the others are not unique. */
#define ROT_GIMBAL_LOCK 1e-7

/* The numbers of a form, of a unit quaternion. Angles of rotation are 0 to pi, Rodrigues parameters
 * at most 1 in length, Euler angles -pi to pi, the middle one -pi/2 to pi/2, or 0 to pi where the
 * first and the third axis are the same. The axis of no rotation is x. Returned: gimbal lock; at
 * the lock itself the third angle is 0. */
int rot_attitude_to(rot_attitude_form form, const double q[4], const rot_euler *sequence,
                    double x[]);

/* Scales to unit length; returns the length before. Without over- or underflow; NaN of zeros. */
double rot_attitude_unit(double q[4]);

/* p q: first q, then p. `out` may be one of them. */
void rot_attitude_times(const double p[4], const double q[4], double out[4]);

/* q v q*, and q* v q: of a unit quaternion. */
void rot_attitude_to_space(const double q[4], const double v[3], double out[3]);
void rot_attitude_to_body(const double q[4], const double v[3], double out[3]);

/* The angle of the rotation from p to q, 0 to pi. */
double rot_attitude_angle(const double p[4], const double q[4]);

/* The rotation from p to q by a constant rate, the short way; at 0 p, at 1 q or -q. */
void rot_attitude_slerp(const double p[4], const double q[4], double fraction, double out[4]);

#endif
