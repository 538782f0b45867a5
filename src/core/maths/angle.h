/* Sine and cosine of an angle by its change from a start: near the start their changes keep the
 * digits of the change. */
#ifndef ROT_ANGLE_H
#define ROT_ANGLE_H

#include "ground/dd.h"

/* Of the start. */
typedef struct rot_angle {
  rot_dd sine, cosine;
} rot_angle;

/* change, rise: cosine and sine less those of the start */
typedef struct rot_angle_now {
  double sine, cosine, change, rise;
} rot_angle_now;

/* start, rad => its sine and cosine; as doubles from 1e15 rad on */
rot_angle rot_angle_from(double start);

/* (start, angle less start) => the same now. Absolute errors of some roundings. */
rot_angle_now rot_angle_after(const rot_angle *start, double turned);

#endif
