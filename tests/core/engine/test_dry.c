#include "engine/dry.h"

#include <float.h>
#include <math.h>

#include "rot_test.h"

static rot_dd dd(double x) { return (rot_dd){x, 0.0}; }

/* Powers of two: all results are exact. Down and up; the wire may press from either side. */
static void check_start(void) {
  for (int side = -1; side <= 1; side += 2) {
    const rot_dry d = rot_dry_from(dd(0.75), dd(2.0 * side), 0.5, 0.25);
    ROT_CHECK(d.slides[0] == 1.25 && d.slides[1] == 0.25);
    ROT_CHECK(d.breaks[0] == 1.75 && d.breaks[1] == -0.25);
    ROT_CHECK(d.presses == 2.0 * side && d.loose > 0.5 && d.loose < 0.5 + DBL_EPSILON);
  }
}

/* The change of a normal force of 3 in the plane and 4 across it, from 2; what is left of 10. */
static void check_left(void) {
  const rot_dry d = rot_dry_from(dd(8.0), dd(2.0), 0.5, 0.25);
  const rot_dry_forces f = rot_dry_now(&d, 10.0, 2.0, 3.0, 1.0, 4.0);
  ROT_CHECK(f.along == 10.0 && f.normal == 5.0 && f.more_along == 2.0);
  ROT_CHECK_REL(f.more_normal, 3.0, 1e-15);
  ROT_CHECK_REL(rot_dry_left(&d, &f, 1), 10.0 - 0.25 * 5.0, 1e-15);
  ROT_CHECK_REL(rot_dry_left(&d, &f, -1), 10.0 + 0.25 * 5.0, 1e-15);
  ROT_CHECK(rot_dry_left(&d, &f, 0) == 10.0);
  ROT_CHECK_REL(rot_dry_drive(&d, &f), 2.0, 1e-15);
}

/* Beside mu_static, which the quotient of the doubles meets or misses on either side: a difference
 * of 1e-18 tells where the force is. */
static void check_drive_at(double along, int beyond) {
  const double sign = along > 0.0 ? 1.0 : -1.0, little = sign * 1e-18 * fabs(along);
  const rot_dd presses = rot_dd_div(dd(fabs(along)), dd(0.97));
  const rot_dd force = rot_dd_add(dd(along), dd(beyond ? little : -little));
  const rot_dry d = rot_dry_from(force, presses, 0.97, 0.1);
  const rot_dry_forces rest = rot_dry_now(&d, force.hi, 0.0, presses.hi, 0.0, 0.0);
  ROT_CHECK(sign * rot_dry_drive(&d, &rest) > 0.0);
  ROT_CHECK((fabs(rot_dry_drive(&d, &rest)) > 0.97) == beyond);
  /* A normal force that grows holds what was beyond; friction at rest, not in motion, counts. */
  const double more = 10.0 * fabs(little);
  const rot_dry_forces held = rot_dry_now(&d, force.hi, 4.0 * little, presses.hi, more, 0.0);
  ROT_CHECK(fabs(rot_dry_drive(&d, &held)) <= 0.97);
}

static void check_drive(void) {
  for (int i = 1; i < 100; i++) {
    check_drive_at(0.01 * i, i % 2);
    check_drive_at(-0.01 * i, i % 2);
  }
}

int main(void) {
  check_start();
  check_left();
  check_drive();
  return rot_test_report("dry");
}
