/* Rotating frames: 40-digit values (the shared table), the equations of motion by differences,
 * round trips, motions known by hand. */
#include <stdlib.h>

#include "tables/frame.h"
#include "rot_test.h"
#include "shared_table.h"

static const double pi = 0x1.921fb54442d18p+1;

/* omega, g, latitude in rad, t, east, north, down */
static void test_drop(void) {
  FILE *table = shared_table("refs/coriolis_drop.csv");
  double x[7];
  int rows = 0;
  if (!table) return;
  while (shared_row(table, 7, x)) {
    const rot_projectile_input in = {x[0], x[2] * 180.0 / pi, x[1], {0.0, 0.0, 0.0}, x[3]};
    const rot_projectile out = rot_frame_projectile(&in);
    /* The latitude in degrees is rounded: an ulp or two of each. */
    ROT_CHECK_REL(out.r_m[0], x[4], 2e-15);
    ROT_CHECK_REL(out.r_m[1], x[5], fabs(2.0 * x[0] * x[3]) < 1.0 ? 2e-15 : 1e-14);
    ROT_CHECK_REL(-out.r_m[2], x[6], fabs(2.0 * x[0] * x[3]) < 1.0 ? 1e-15 : 2e-14);
    ROT_CHECK(hypot(out.deflection_m[0] - out.first_order_m[0],
                    hypot(out.deflection_m[1] - out.first_order_m[1],
                          out.deflection_m[2] - out.first_order_m[2])) <=
              out.first_order_error_m + 2e-16 * fabs(out.deflection_m[0]));
    if (fabs(x[0] * x[3]) < 0.2) { /* within (2 omega t)^2/20 to the east */
      const double y = 2.0 * x[0] * x[3];
      ROT_CHECK(fabs(out.first_order_m[0] / out.r_m[0] - 1.0) <= y * y / 19.0 + 1e-15);
    }
    rows++;
  }
  ROT_CHECK(rows == 5);
}

static double uniform(double low, double high) {
  return low + (high - low) * ((double)rand() / (double)RAND_MAX);
}

/* r'' = g - 2 Omega x r' and r' by differences of order 4; the two forms meet at 2 Omega t = 1. */
static void test_equations(void) {
  srand(30);
  for (int k = 0; k < 300; k++) {
    rot_projectile_input in = {uniform(-2.0, 2.0),
                               uniform(-90.0, 90.0),
                               uniform(1.0, 10.0),
                               {0.0, 0.0, 0.0},
                               uniform(-3.0, 3.0)};
    for (int i = 0; i < 3; i++) in.v_m_per_s[i] = uniform(-10.0, 10.0);
    const double h = 1e-3, lat = in.latitude_deg * pi / 180.0, w = in.omega_rad_per_s;
    const rot_projectile now = rot_frame_projectile(&in);
    const double *v = now.v_m_per_s;
    double dr[3] = {0.0}, dv[3] = {0.0};
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};
    for (int j = 0; j < 4; j++) {
      rot_projectile_input at = in;
      at.time_s += (j < 2 ? j - 2 : j - 1) * h;
      const rot_projectile there = rot_frame_projectile(&at);
      for (int i = 0; i < 3; i++) {
        dr[i] += weight[j] * there.r_m[i] / h;
        dv[i] += weight[j] * there.v_m_per_s[i] / h;
      }
    }
    const double c = w * cos(lat), s = w * sin(lat);
    const double want[3] = {-2.0 * (c * v[2] - s * v[1]), -2.0 * s * v[0],
                            2.0 * c * v[0] - in.gravity_m_per_s2};
    for (int i = 0; i < 3; i++) {
      ROT_CHECK(fabs(dr[i] - v[i]) <= 1e-8);
      ROT_CHECK(fabs(dv[i] - want[i]) <= 1e-8);
      const double straight = in.v_m_per_s[i] * in.time_s -
                              (i == 2 ? 0.5 * in.gravity_m_per_s2 * in.time_s * in.time_s : 0.0);
      ROT_CHECK(fabs(now.r_m[i] - straight - now.deflection_m[i]) <= 2e-13);
    }
    const double off = hypot(now.deflection_m[0] - now.first_order_m[0],
                             hypot(now.deflection_m[1] - now.first_order_m[1],
                                   now.deflection_m[2] - now.first_order_m[2]));
    ROT_CHECK(off <= now.first_order_error_m * (1.0 + 1e-12));
  }
}

static void test_fall(void) {
  srand(31);
  for (int k = 0; k < 300; k++) {
    rot_projectile_input in = {
        pow(10.0, uniform(-8.0, -0.5)), uniform(-90.0, 90.0), 9.8, {0.0, 0.0, 0.0}, 0.0};
    const double height = pow(10.0, uniform(-3.0, 3.0));
    in.time_s = rot_frame_fall_time(in.omega_rad_per_s, in.latitude_deg, 9.8, height);
    if (isnan(in.time_s)) continue;
    ROT_CHECK_REL(-rot_frame_projectile(&in).r_m[2], height, 1e-13);
  }
  ROT_CHECK_REL(rot_frame_fall_time(0.0, 45.0, 9.8, 4.9), 1.0, 3e-16);
  ROT_CHECK(rot_frame_fall_time(1.0, 45.0, 9.8, 0.0) == 0.0);
  /* At the equator it falls at most g/(2 Omega^2). */
  ROT_CHECK(isnan(rot_frame_fall_time(7.0, 0.0, 9.8, 0.11)));
}

/* With Omega = 1/s near the equator what falls swings: it is at a depth of
 * g (cos^2 (1 - cos 2 t)/4 + sin^2 t^2/2). The time is the first at which it is deep enough. */
static void test_swinging_fall(void) {
  /* The last two just reach a depth from which the body turns back. */
  const double cases[][2] = {{2.0, 5.07}, {3.0, 7.22},   {5.0, 8.38},        {6.0, 8.1},
                             {8.0, 15.6}, {3.0, 4.9195}, {0.0, 0.9951 * 4.9}};
  for (int k = 0; k < 7; k++) {
    const double c = cos(cases[k][0] * pi / 180.0), s = sin(cases[k][0] * pi / 180.0);
    double t = 0.0;
    while (9.8 * (0.25 * c * c * (1.0 - cos(2.0 * t)) + 0.5 * s * s * t * t) < cases[k][1]) {
      t += 1e-3;
    }
    ROT_CHECK(fabs(rot_frame_fall_time(1.0, cases[k][0], 9.8, cases[k][1]) - t) < 2e-3);
  }
}

/* zeta'' + 2 i turn zeta' + (g/l) zeta = 0, by differences; the start. */
static void test_foucault(void) {
  srand(32);
  for (int k = 0; k < 200; k++) {
    const double omega = uniform(-1.0, 1.0), lat = uniform(-90.0, 90.0), length = uniform(1.0, 9.0);
    const double r0[2] = {uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
    const double v0[2] = {uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
    const double turn = omega * sin(lat * pi / 180.0), t = uniform(-5.0, 5.0), h = 1e-3;
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};
    double r[2], v[2], rate, swings, dr[2] = {0.0}, dv[2] = {0.0};
    for (int j = 0; j < 4; j++) {
      rot_frame_foucault(omega, lat, 9.8, length, r0, v0, t + (j < 2 ? j - 2 : j - 1) * h, r, v,
                         &rate, &swings);
      for (int i = 0; i < 2; i++) {
        dr[i] += weight[j] * r[i] / h;
        dv[i] += weight[j] * v[i] / h;
      }
    }
    rot_frame_foucault(omega, lat, 9.8, length, r0, v0, t, r, v, &rate, &swings);
    ROT_CHECK_REL(rate, -turn, 1e-15);
    ROT_CHECK_REL(swings, sqrt(9.8 / length + turn * turn), 1e-15);
    ROT_CHECK(fabs(dr[0] - v[0]) <= 1e-8 && fabs(dr[1] - v[1]) <= 1e-8);
    ROT_CHECK(fabs(dv[0] - 2.0 * turn * v[1] + 9.8 / length * r[0]) <= 1e-8);
    ROT_CHECK(fabs(dv[1] + 2.0 * turn * v[0] + 9.8 / length * r[1]) <= 1e-8);
    rot_frame_foucault(omega, lat, 9.8, length, r0, v0, 0.0, r, v, &rate, &swings);
    ROT_CHECK(r[0] == r0[0] && r[1] == r0[1]);
    ROT_CHECK(fabs(v[0] - v0[0]) <= 1e-15 && fabs(v[1] - v0[1]) <= 1e-15);
  }
}

static void test_carry(void) {
  /* At rest in space, seen from a frame that turns at 2 rad/s by a quarter: it runs clockwise. */
  const rot_frame quarter = {{0.0, 0.0, 1.0}, 0.5 * pi, 2.0, 3.0};
  const double r[3] = {1.0, 0.0, 5.0}, none[3] = {0.0, 0.0, 0.0};
  double r1[3], v1[3], a1[3], t[3][3];
  rot_frame_enter(&quarter, r, none, none, r1, v1, a1);
  ROT_CHECK(fabs(r1[0]) <= 3e-16 && fabs(r1[1] + 1.0) <= 2e-16 && r1[2] == 5.0);
  ROT_CHECK(fabs(v1[0] + 2.0) <= 1e-15 && fabs(v1[1]) <= 1e-15 && v1[2] == 0.0);
  ROT_CHECK(fabs(a1[0] + 3.0) <= 1e-15 && fabs(a1[1] - 4.0) <= 1e-15); /* 4 inward, 3 clockwise */
  rot_frame_terms(&quarter, r1, v1, t[0], t[1], t[2]);
  ROT_CHECK(fabs(t[0][1] + 4.0) <= 1e-15 && fabs(t[1][1] - 8.0) <= 1e-15);
  ROT_CHECK(fabs(t[2][0] + 3.0) <= 1e-15);
  srand(33);
  for (int k = 0; k < 1000; k++) {
    rot_frame f = {{0.0}, uniform(-50.0, 50.0), uniform(-3.0, 3.0), uniform(-3.0, 3.0)};
    double x[9], length = 0.0, y[9], z[9];
    for (int i = 0; i < 3; i++) f.axis[i] = uniform(-1.0, 1.0);
    for (int i = 0; i < 3; i++) length += f.axis[i] * f.axis[i];
    for (int i = 0; i < 3; i++) f.axis[i] /= sqrt(length);
    for (int i = 0; i < 9; i++) x[i] = uniform(-1.0, 1.0);
    rot_frame_enter(&f, x, x + 3, x + 6, y, y + 3, y + 6);
    rot_frame_leave(&f, y, y + 3, y + 6, z, z + 3, z + 6);
    for (int i = 0; i < 9; i++) ROT_CHECK(fabs(z[i] - x[i]) <= 3e-14);
  }
}

int main(void) {
  test_drop();
  test_equations();
  test_fall();
  test_swinging_fall();
  test_foucault();
  test_carry();
  return rot_test_report("frame");
}
