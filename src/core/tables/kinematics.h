/* Motion about an axle at constant angular acceleration, motion of a point on the body, units of
 * angles.
 *
 *   omega = omega0 + alpha t,   theta = omega0 t + alpha t^2/2,
 *   theta = (omega0 + omega) t/2,   omega^2 = omega0^2 + 2 alpha theta
 *
 * Any three of the five quantities give the other two: ten cases, with two solutions where the
 * equation for omega^2 is solved. Numbers have 106 bits and a separate exponent, so results have an
 * error of at most 0.51 ulp for the given doubles, for any cancellation and any scale.
 * Source: Goldstein, Classical Mechanics, 3rd ed., section 1.1 (fixed axis: one coordinate). */
#ifndef ROT_KINEMATICS_H
#define ROT_KINEMATICS_H

#include <stddef.h>

#include "ground/column.h"

enum {
  ROT_MOTION_THETA,
  ROT_MOTION_OMEGA0,
  ROT_MOTION_OMEGA,
  ROT_MOTION_ALPHA,
  ROT_MOTION_TIME,
  ROT_MOTION_SIZE
};

typedef enum rot_motion_kind {
  ROT_MOTION_IMPOSSIBLE = 0,   /* the three are inconsistent: the other two are NaN */
  ROT_MOTION_ONE = 1,          /* x[0] is the motion */
  ROT_MOTION_TWO = 2,          /* x[0] and x[1], the smaller time first */
  ROT_MOTION_UNDETERMINED = -1 /* the motion is not unique: x[0] has the values that are */
} rot_motion_kind;

/* Three values in x[0], finite or NaN, of the bits `given` (1 << ROT_MOTION_THETA, ...) => the
 * other two. NaN if a given value is NaN. */
rot_motion_kind rot_motion_solve(unsigned given, double x[2][ROT_MOTION_SIZE]);

/* Point at a distance from the axle => tangential speed, signed */
double rot_tangential_speed(double omega, double radius);
/* => tangential acceleration, signed */
double rot_tangential_acceleration(double alpha, double radius);
/* => omega^2 radius */
double rot_centripetal_acceleration(double omega, double radius);
/* => size of the acceleration */
double rot_total_acceleration(double omega, double alpha, double radius);
/* => angle of the acceleration from the inward radius, positive in the direction of motion:
 * atan2(alpha, omega^2), the limit at the axle */
double rot_acceleration_angle(double omega, double alpha);

/* => mass (position - about) x vector: the torque of a force for mass 1, else an angular momentum.
 * One rounding, unless a component cancels to less than 1e-15 of its terms. */
void rot_moment(double mass, const double position[3], const double about[3],
                const double vector[3], double out[3]);
/* => mass radius size sin(angle), with the angle from the radius to the vector */
double rot_lever(double mass, double radius, double size, double angle_deg);

/* Factors: name, high and low part (mpmath, 50 digits). */
#define ROT_ANGLE_UNIT_LIST(X)                                                                     \
  X(ROT_RAD_FROM_DEG, 0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62)        /* pi/180 */             \
  X(ROT_DEG_FROM_RAD, 0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49)       /* 180/pi */             \
  X(ROT_RAD_FROM_TURN, 0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52)       /* 2 pi */               \
  X(ROT_TURN_FROM_RAD, 0x1.45f306dc9c883p-3, -0x1.6b01ec5417056p-57)      /* 1/(2 pi) */           \
  X(ROT_RAD_PER_S_FROM_RPM, 0x1.acee9f37bebd6p-4, -0x1.7d74eb872d10ap-58) /* pi/30 */              \
  X(ROT_RPM_FROM_RAD_PER_S, 0x1.3193d66ed2bfap+3, 0x1.ebae32712a6afp-51)  /* 30/pi */

typedef enum rot_angle_unit {
#define X(code, hi, lo) code,
  ROT_ANGLE_UNIT_LIST(X)
#undef X
      ROT_ANGLE_UNIT_COUNT
} rot_angle_unit;

/* (x, unit) => x times the factor, one rounding */
double rot_convert_angle(double x, rot_angle_unit unit);

#endif
