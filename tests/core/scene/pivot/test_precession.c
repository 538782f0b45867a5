/* Precession: cases by hand, the shared table of tops, the limits of numbers. */
#include <math.h>

#include "scene/pivot/precession.h"
#include "rot_test.h"
#include "shared_table.h"

static void test_horizontal(void) {
  const rot_precession_input in = {0.5, 0.08, 0.002, 500.0, NAN, 90.0, 9.80665};
  const rot_precession out = rot_precession_of(&in);
  ROT_CHECK_REL(out.torque_n_m, 0.392266, 4e-16);
  ROT_CHECK_REL(out.momentum_kg_m2_per_s, 1.0, 4e-16);
  ROT_CHECK_REL(out.rate_rad_per_s, 0.392266, 4e-16);
  ROT_CHECK_REL(out.period_s, 16.017664817189322, 4e-16); /* 2 pi/0.392266 */
  ROT_CHECK(out.slow_rad_per_s == out.rate_rad_per_s && out.error == 0.0);
  ROT_CHECK(isnan(out.fast_rad_per_s) && isnan(out.nutation_s));
  /* Exact at any spin, also where the parts of the error leave the doubles. */
  const rot_precession_input faint = {0.5, 0.08, 0.002, 1e-200, 0.003, 90.0, 9.80665};
  ROT_CHECK(rot_precession_of(&faint).error == 0.0);
}

/* A top that sleeps upright: to a rounding of its angle it stays there. */
static void test_upright(void) {
  rot_precession_input in = {0.5, 0.08, 0.002, 500.0, 0.003, 0.0, 9.80665};
  for (int hangs = 0; hangs < 2; hangs++) {
    in.angle_deg = hangs ? 180.0 : 0.0;
    const rot_precession out = rot_precession_of(&in);
    ROT_CHECK(out.nutation_s > 0.0 && out.nutation_s < 1.0);
    ROT_CHECK(fabs(out.lowest_deg - in.angle_deg) <= 1e-13);
  }
}

/* The lowest angle of a small nutation is in proportion to the angle of the release, however small:
 * a top sleeps from 2 sqrt(m g l/I1) = 26.3 of I3 omega/I1 on. */
static void test_small_angles(void) {
  rot_precession_input in = {0.5, 0.08, 0.002, 0.0, 0.003, 0.0, 9.80665};
  static const double spin[] = {45.0, 60.0, 500.0};
  for (int i = 0; i < 3; i++) {
    in.spin_rad_per_s = spin[i];
    in.angle_deg = 1e-9;
    const double lowest = rot_precession_of(&in).lowest_deg / in.angle_deg;
    ROT_CHECK(lowest > 1.0 && lowest < 10.0);
    for (in.angle_deg = 1e-18; in.angle_deg > 1e-300; in.angle_deg *= 1e-20) {
      ROT_CHECK_REL(rot_precession_of(&in).lowest_deg / in.angle_deg, lowest, 1e-9);
    }
  }
}

/* I1, I3, G, theta, omega3, slow, fast, formula, period, lowest cosine, angle of a nutation. */
static void test_table(void) {
  FILE *table = shared_table("refs/heavy_top_scalar.csv");
  double x[11];
  int rows = 0;
  if (!table) return;
  while (shared_row(table, 11, x)) {
    const double degrees = x[3] * 180.0 / 0x1.921fb54442d18p+1;
    const rot_precession_input in = {x[2], 1.0, x[1], x[4], x[0], degrees, 1.0};
    const rot_precession out = rot_precession_of(&in);
    ROT_CHECK_REL(out.rate_rad_per_s, x[7], 4e-16);
    ROT_CHECK_REL(out.slow_rad_per_s, x[5], 1e-15);
    if (degrees == 90.0) { /* the table's angle is the double next to it */
      ROT_CHECK(isnan(out.fast_rad_per_s));
    } else {
      ROT_CHECK_REL(out.fast_rad_per_s, x[6], 2e-15);
    }
    ROT_CHECK(fabs(out.error - fabs(x[7] / x[5] - 1.0)) <= 4e-16);
    ROT_CHECK_REL(out.nutation_s, x[8], 4e-15);
    ROT_CHECK(fabs(cos(out.lowest_deg * 0x1.921fb54442d18p+1 / 180.0) - x[9]) <= 4e-15);
    ROT_CHECK_REL(out.mean_rad_per_s, x[10] / x[8], 4e-15);
    rows++;
  }
  ROT_CHECK(rows == 6);
}

static void test_signs(void) {
  const rot_precession_input down = {1.0, -0.1, 0.01, 50.0, 0.02, 60.0, 10.0};
  rot_precession out = rot_precession_of(&down);
  ROT_CHECK(out.rate_rad_per_s < 0.0 && out.slow_rad_per_s < 0.0 && out.fast_rad_per_s > 0.0);
  ROT_CHECK(out.lowest_deg < 60.0 && out.mean_rad_per_s < 0.0);
  const rot_precession_input slow = {1.0, 0.1, 0.01, 5.0, 0.02, 30.0, 10.0};
  out = rot_precession_of(&slow); /* below the least spin, 2 sqrt(0.02)/0.01 sqrt(cos 30) */
  ROT_CHECK(isnan(out.slow_rad_per_s) && isnan(out.error) && out.nutation_s > 0.0);
  ROT_CHECK_REL(rot_precession_sleeps(0.01, 0.02, 1.0, 0.1, 10.0), 28.284271247461902, 4e-16);
  ROT_CHECK(rot_precession_sleeps(0.01, 0.02, 1.0, -0.1, 10.0) == 0.0);
}

/* Upright or hanging, and without weight, it keeps its angle. From the horizontal, barely spinning,
 * it swings through the bottom. */
static void test_ends(void) {
  for (int lever = -1; lever <= 1; lever++) {
    for (int half = 0; half <= 2; half++) {
      const rot_precession_input in = {1.0, 0.1 * lever, 0.01, 1e-9, 0.02, 90.0 * half, 10.0};
      const double lowest = rot_precession_of(&in).lowest_deg;
      const double want = half != 1 || lever == 0 ? 90.0 * half : 90.0 + 90.0 * lever;
      ROT_CHECK(fabs(lowest - want) <= 1e-5);
    }
  }
}

/* Next to the vertical z'' - i a z' - g z = 0 with a = I3 omega3/I1, g = G/I1 has the period
 * 2 pi/sqrt(a^2 - 4 g); below the least spin of sleeping an upright top stays where it is. */
static void test_vertical(void) {
  for (int turned = 0; turned < 2; turned++) {
    for (int hangs = 0; hangs < 2; hangs++) {
      const double lever = (turned != hangs) ? -0.08 : 0.08;
      const rot_precession_input in = {0.5, lever, 0.002, 60.0, 0.0042, 180.0 * turned, 9.80665};
      rot_precession_input slow = in;
      const rot_precession out = rot_precession_of(&in);
      const double a = 0.002 * 60.0 / 0.0042, g = 0.5 * 9.80665 * 0.08 / 0.0042;
      ROT_CHECK_REL(out.nutation_s, 0x1.921fb54442d18p+2 / sqrt(a * a + (hangs ? 4 : -4) * g),
                    1e-14);
      ROT_CHECK_REL(out.mean_rad_per_s, out.slow_rad_per_s, 1e-14);
      ROT_CHECK_EQ_INT(out.lowest_deg == in.angle_deg, 1);
      slow.spin_rad_per_s = 40.0; /* of 40.6 */
      const rot_precession falls = rot_precession_of(&slow);
      ROT_CHECK(hangs ? isfinite(falls.nutation_s) : isinf(falls.nutation_s));
      ROT_CHECK(falls.lowest_deg == in.angle_deg && (hangs || isnan(falls.mean_rad_per_s)));
    }
  }
}

/* Angle, lowest angle, period and mean rate of released tops, by elliptic integrals in 120 digits;
 * then the same with a small gravity at 30 degrees, in 250 digits. */
static void test_small(void) {
  static const double tilted[][4] = {
      {1.0, 1.357802392188754524, 0.29857950678770204051, 3.7648361480159809393},
      {1e-3, 0.0013578682760555743845, 0.29861083002507780205, 3.7650220085727153673},
      {1e-6, 1.3578682761214731152e-6, 0.29861083005640994816, 3.7650220087586210253},
      {1e-9, 1.3578682761214733271e-9, 0.29861083005640997949, 3.7650220087586212112},
      {1e-14, 1.3578682761214732409e-14, 0.29861083005640997949, 3.7650220087586212112}};
  static const double light[][4] = {
      {9.80665e-12, 30.000000000006555263, 0.2199114857513290874, 3.268883333333657096e-12},
      {9.80665e-20, 30.0, 0.21991148575128550853, 3.2688833333333334224e-20},
      {9.80665e-30, 30.0, 0.21991148575128550853, 3.2688833333333334577e-30},
      {9.80665e-50, 30.0, 0.21991148575128550853, 3.2688833333333335393e-50},
      {9.80665e-290, 30.0, 0.21991148575128550853, 3.2688833333333335e-290}};
  for (int i = 0; i < 10; i++) {
    const double *x = i < 5 ? tilted[i] : light[i - 5];
    const double angle = i < 5 ? x[0] : 30.0, gravity = i < 5 ? 9.80665 : x[0];
    rot_precession_input in = {0.5, 0.08, 0.002, 60.0, 0.0042, angle, gravity};
    const rot_precession out = rot_precession_of(&in);
    ROT_CHECK_REL(out.lowest_deg, x[1], 1e-15);
    ROT_CHECK_REL(out.nutation_s, x[2], 2e-15);
    ROT_CHECK_REL(out.mean_rad_per_s, x[3], 1e-15);
    if (i < 5) continue;
    /* slow and fast rates without gravity: G/(I3 omega3), I3 omega3/(I1 cos) */
    ROT_CHECK_REL(out.slow_rad_per_s, x[0] / 3.0, 1e-10);
    ROT_CHECK_REL(out.fast_rad_per_s, 0.12 / (0.0042 * sqrt(0.75)), 1e-10);
  }
}

/* At the least spin of a steady precession, 2 sqrt(I1 G)/I3 = 2 upright, it turns twice as fast as
 * the formula says, and stays; a spin backwards differs by signs alone. */
static void test_least_spin(void) {
  rot_precession_input in = {1.0, 1.0, 1.0, 2.0, 1.0, 0.0, 1.0};
  rot_precession out = rot_precession_of(&in);
  ROT_CHECK(out.slow_rad_per_s == 1.0 && out.fast_rad_per_s == 1.0 && out.error == 0.5);
  ROT_CHECK(isinf(out.nutation_s) && out.lowest_deg == 0.0);
  in.spin_rad_per_s = nextafter(2.0, 0.0);
  ROT_CHECK(isnan(rot_precession_of(&in).error));
  for (int fast = 0; fast < 2; fast++) {
    in.spin_rad_per_s = fast ? 3.0 : 1.5;
    out = rot_precession_of(&in);
    in.spin_rad_per_s = -in.spin_rad_per_s;
    const rot_precession back = rot_precession_of(&in);
    ROT_CHECK(back.nutation_s == out.nutation_s && isinf(out.nutation_s) == !fast);
    ROT_CHECK(!fast || back.mean_rad_per_s == -out.mean_rad_per_s);
  }
}

/* The same top in other units of mass and time. */
static void test_scales(void) {
  const rot_precession_input in = {1.0, 0.5, 0.25, 8.0, 0.375, 60.0, 8.0};
  const rot_precession out = rot_precession_of(&in);
  for (int e = -300; e <= 300; e += 100) {
    rot_precession_input big = in;
    big.mass_kg = ldexp(in.mass_kg, e);
    big.axial_kg_m2 = ldexp(in.axial_kg_m2, e);
    big.transverse_kg_m2 = ldexp(in.transverse_kg_m2, e);
    big.spin_rad_per_s = ldexp(in.spin_rad_per_s, e);
    big.gravity_m_per_s2 = ldexp(in.gravity_m_per_s2, 2 * e);
    const rot_precession there = rot_precession_of(&big);
    ROT_CHECK(there.slow_rad_per_s == ldexp(out.slow_rad_per_s, e));
    ROT_CHECK(there.fast_rad_per_s == ldexp(out.fast_rad_per_s, e));
    ROT_CHECK(there.nutation_s == ldexp(out.nutation_s, -e));
    ROT_CHECK(there.lowest_deg == out.lowest_deg && there.error == out.error);
  }
}

int main(void) {
  test_horizontal();
  test_upright();
  test_small_angles();
  test_table();
  test_signs();
  test_ends();
  test_vertical();
  test_small();
  test_least_spin();
  test_scales();
  return rot_test_report("precession");
}
