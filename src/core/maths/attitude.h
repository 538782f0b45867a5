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

/* form => count of its numbers */
int rot_attitude_numbers(rot_attitude_form form);

/* A sequence of three rotations. */
typedef struct rot_euler {
  int axis[3];   /* 0, 1, 2; neighbours differ */
  int intrinsic; /* 1: about axes that turn with the body; 0: about the axes of space */
} rot_euler;

/* (form, numbers x) => unit quaternion to a few roundings, size of the correction. The correction
 * is |length - 1| of a quaternion, the max element of |R'R - 1| of a matrix (Inf for a reflection),
 * else 0. A zero quaternion or axis gives NaN. `sequence` is for Euler angles. */
double rot_attitude_from(rot_attitude_form form, const double x[], const rot_euler *sequence,
                         double q[4]);

/* Gimbal lock: the middle Euler angle is closer than this (rad) to a value at which the other two
 * are not unique. */
#define ROT_GIMBAL_LOCK 1e-7

/* (form, unit quaternion) => numbers x, gimbal lock. Angles of rotation are 0 to pi, Rodrigues
 * parameters at most 1 in length, Euler angles -pi to pi, the middle one -pi/2 to pi/2, or 0 to pi
 * if the first and the third axis are equal. The axis of a rotation by 0 is x. At an exact gimbal
 * lock the third angle is 0. */
int rot_attitude_to(rot_attitude_form form, const double q[4], const rot_euler *sequence,
                    double x[]);

/* Normalizes q in place; returns its length before. No over- or underflow; zeros become NaN. */
double rot_attitude_unit(double q[4]);

/* (p, q) => p q, the rotation q followed by p; `out` may be p or q */
void rot_attitude_times(const double p[4], const double q[4], double out[4]);

/* (unit q, v in the body's axes) => q v q*, v in the axes of space */
void rot_attitude_to_space(const double q[4], const double v[3], double out[3]);
/* (unit q, v in the axes of space) => q* v q, v in the body's axes */
void rot_attitude_to_body(const double q[4], const double v[3], double out[3]);

/* (p, q) => angle of the rotation from p to q, 0 to pi rad */
double rot_attitude_angle(const double p[4], const double q[4]);

/* (p, q, fraction) => attitude on the shortest rotation from p (0) to q or -q (1) at constant rate
 */
void rot_attitude_slerp(const double p[4], const double q[4], double fraction, double out[4]);

#endif
