/* Angles by their change from a start, against sums of angles in long double, and starts beyond the
 * domain of twice the precision. */
#include "maths/angle.h"

#include <float.h>
#include <math.h>

#include "rot_test.h"

static const double starts[] = {0.0, 1e-3, 0.7, 1.5, 3.0, -2.0, 1e3, -4e5};
static const double turns[] = {0.0, 1e-12, -3e-9, 1e-4, 0.3, -1.0, 2.5, 40.0};

static void changes(void) {
  for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
    const rot_angle from = rot_angle_from(starts[i]);
    for (size_t k = 0; k < sizeof turns / sizeof *turns; k++) {
      const long double half = 0.5L * (long double)turns[k], start = starts[i];
      const long double change = -2.0L * sinl(half) * sinl(start + half);
      const rot_angle_now now = rot_angle_after(&from, turns[k]);
      /* The sum of the angles is rounded. */
      const double off = 8 * DBL_EPSILON + 4 * (double)LDBL_EPSILON * fabs(starts[i]);
      ROT_CHECK(fabs(now.change - (double)change) <= off * fabs(sin((double)half)));
      ROT_CHECK(fabs(now.sine - (double)sinl(start + 2.0L * half)) <= off);
      ROT_CHECK(fabs(now.cosine - (double)cosl(start + 2.0L * half)) <= off);
    }
  }
}

/* The start has more digits than a double: sin^2 + cos^2 - 1 vanishes in twice the precision. */
static void the_start(void) {
  for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
    const rot_angle a = rot_angle_from(starts[i]);
    const rot_dd square = rot_dd_add(rot_dd_mul(a.sine, a.sine), rot_dd_mul(a.cosine, a.cosine));
    ROT_CHECK(fabs(rot_dd_add1(square, -1.0).hi) <= 1e-30);
    ROT_CHECK(fabs(a.sine.hi - sin(starts[i])) <= 2 * DBL_EPSILON);
  }
  const rot_angle far = rot_angle_from(1e200);
  ROT_CHECK(far.sine.hi == sin(1e200) && far.sine.lo == 0.0 && far.cosine.hi == cos(1e200));
}

int main(void) {
  changes();
  the_start();
  return rot_test_report("angle");
}
