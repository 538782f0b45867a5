#include "maths/angle.h"

#include <math.h>

#include "ground/dd_trig.h"
#include "ground/ieee.h"

rot_angle rot_angle_from(double start) {
  rot_angle a = {{sin(start), 0.0}, {cos(start), 0.0}};
  if (fabs(start) < 1e15) rot_dd_sine_cosine((rot_dd){start, 0.0}, &a.sine, &a.cosine);
  return a;
}

rot_angle_now rot_angle_after(const rot_angle *start, double turned) {
  const double half = 0.5 * turned, s = sin(half), c = cos(half);
  const double sine = start->sine.hi, cosine = start->cosine.hi;
  const double change = -2.0 * s * (c * sine + s * cosine);
  const double rise = 2.0 * s * (c * cosine - s * sine);
  return (rot_angle_now){sine + rise, cosine + change, change, rise};
}
