/* The shapes: every one against integrals over its geometry (shape_cases.h), limits in which one
 * shape is another, extremes of size, and the table. */
#include <stdlib.h>

#include "ground/dd.h"
#include "body/shapes.h"
#include "rot_test.h"
#include "shared_table.h"
#include "shape_cases.h"

enum { CASES = sizeof shape_cases / sizeof shape_cases[0] };

static const rot_shape *find(const char *name) {
  for (size_t i = 0; i < rot_shape_count(); i++) {
    if (strcmp(rot_shape_at(i)->name, name) == 0) return rot_shape_at(i);
  }
  return NULL;
}

static rot_shape_body make(const char *name, double mass, double a, double b, double c, double d) {
  rot_shape_body body;
  rot_shape_make(find(name), mass, 0, (double[]){a, b, c, d}, &body);
  return body;
}

static int id_of(const char *name) { return (int)(find(name) - rot_shape_at(0)); }

/* ---- the list ------------------------------------------------------------------------------- */

static void check_list(void) {
  ROT_CHECK(rot_shape_count() >= 30);
  for (size_t i = 0; i < rot_shape_count(); i++) {
    const rot_shape *shape = rot_shape_at(i);
    ROT_CHECK(find(shape->name) == shape); /* no name comes twice */
    ROT_CHECK(shape->sizes >= 1 && shape->sizes <= ROT_SIZES);
    ROT_CHECK(shape->dimension >= 0 && shape->dimension <= 3);
    int cases = 0;
    for (size_t c = 0; c < CASES; c++) cases += strcmp(shape_cases[c].shape, shape->name) == 0;
    ROT_CHECK(cases >= 1 || shape->dimension == 0);
  }
  for (int i = 0; i < ROT_SIZE_COUNT; i++) {
    for (int j = 0; j < i; j++) {
      ROT_CHECK(strcmp(rot_size_at(i)->name, rot_size_at(j)->name) != 0);
    }
  }
}

/* ---- against integrals ---------------------------------------------------------------------- */

static double max_ulps;

/* The error reported holds of each entry, by the trace; what is no more than one product is better
 * than that by itself. */
static void check_second(const double got[], const double want[], double error) {
  const double trace = want[0] + want[1] + want[2];
  for (int k = 0; k < 4; k++) {
    /* Half an ulp is the reference's own, as a double. */
    ROT_CHECK(fabs(got[k] - want[k]) <= (error + ROT_EPS) * trace);
    if (k < 3 && want[k] > 0.0) {
      ROT_CHECK_REL(got[k], want[k], error + ROT_EPS);
      max_ulps = fmax(max_ulps, rot_test_ulp(got[k], want[k]));
    }
  }
}

static void check_integrals(void) {
  for (size_t c = 0; c < CASES; c++) {
    const rot_shape *shape = find(shape_cases[c].shape);
    const double *size = shape_cases[c].size, *want = shape_cases[c].second;
    rot_shape_body one, two;
    rot_shape_make(shape, 1.0, 0, size, &one);
    check_second(one.second_kg_m2, want, one.error);
    ROT_CHECK(one.second_kg_m2[4] == 0.0 && one.second_kg_m2[5] == 0.0);
    for (int k = 0; k < 3; k++) {
      ROT_CHECK(fabs(one.centre_m[k] - shape_cases[c].centre[k]) <= 8.0 * ROT_EPS * one.reach_m);
    }
    ROT_CHECK_ULP(one.gyration_m, sqrt(one.moment_kg_m2), 1);
    /* A mass by its density. */
    rot_shape_make(shape, 2.5, 1, size, &two);
    if (isnan(shape_cases[c].measure)) {
      ROT_CHECK(isnan(two.mass_kg));
    } else {
      ROT_CHECK_ULP(two.mass_kg, 2.5 * shape_cases[c].measure, 6);
      const double mass = 2.5 * shape_cases[c].measure;
      const double by_mass[4] = {mass * want[0], mass * want[1], mass * want[2], mass * want[3]};
      check_second(two.second_kg_m2, by_mass, two.error);
    }
  }
  printf("second moments of %d cases: at most %g ulp\n", CASES, max_ulps);
}

/* No point is farther away than `reach`, and none so near that it is idle: second moments are
 * averages of squares. */
static void check_reach(void) {
  for (size_t c = 0; c < CASES; c++) {
    rot_shape_body b;
    rot_shape_make(find(shape_cases[c].shape), 1.0, 0, shape_cases[c].size, &b);
    const double mean = b.second_kg_m2[0] + b.second_kg_m2[1] + b.second_kg_m2[2];
    ROT_CHECK(b.reach_m * b.reach_m >= mean * (1.0 - 1e-15));
    ROT_CHECK(b.reach_m * b.reach_m <= 40.0 * mean);
  }
  /* By hand: 3-4-5 triangles. */
  ROT_CHECK_ULP(make("cylinder", 1, 3, 8, 0, 0).reach_m, 5.0, 1);
  ROT_CHECK_ULP(make("cone", 1, 3, 16, 0, 0).reach_m, 12.0, 1);
  ROT_CHECK_ULP(make("cone", 1, 12, 20, 0, 0).reach_m, 15.0, 1);
  ROT_CHECK_ULP(make("cone", 1, 12, 4, 0, 0).reach_m, hypot(12.0, 1.0), 1);
  ROT_CHECK_ULP(make("box", 1, 4, 6, 12, 0).reach_m, 7.0, 1);
  ROT_CHECK_ULP(make("hemisphere", 1, 8, 0, 0, 0).reach_m, sqrt(73.0), 1);
  ROT_CHECK_ULP(make("spherical_cap", 1, 8, 8, 0, 0).reach_m, sqrt(73.0), 2);
  ROT_CHECK_ULP(make("triangle", 1, 3, 3, 0, 0).reach_m, sqrt(5.0), 1);
  ROT_CHECK_ULP(make("capsule", 1, 2, 6, 0, 0).reach_m, 5.0, 0);
  ROT_CHECK_ULP(make("torus", 1, 3, 2, 0, 0).reach_m, 5.0, 0);
}

/* What rolls: beta is I_zz/(m r^2) on the outer radius. What does not: NaN. */
static void check_beta(void) {
  static const struct {
    const char *name;
    double size[4], radius;
  } rolls[] = {{"hoop", {3.0}, 3.0},
               {"disk", {3.0}, 3.0},
               {"annulus", {3.0, 2.0}, 3.0},
               {"tube", {3.0, 5.0}, 3.0},
               {"can", {3.0, 5.0}, 3.0},
               {"cylinder", {3.0, 5.0}, 3.0},
               {"thick_tube", {3.0, 2.0, 5.0}, 3.0},
               {"sphere", {3.0}, 3.0},
               {"spherical_shell", {3.0}, 3.0},
               {"hollow_sphere", {3.0, 2.0}, 3.0},
               {"torus", {3.0, 2.0}, 5.0},
               {"torus_shell", {3.0, 2.0}, 5.0},
               {"capsule", {3.0, 5.0}, 3.0}};
  size_t rolling = 0;
  for (size_t i = 0; i < sizeof rolls / sizeof rolls[0]; i++) {
    rot_shape_body b;
    rot_shape_make(find(rolls[i].name), 1.0, 0, rolls[i].size, &b);
    ROT_CHECK_ULP(b.beta * rolls[i].radius * rolls[i].radius, b.moment_kg_m2, 4);
  }
  for (size_t i = 0; i < rot_shape_count(); i++) {
    rot_shape_body b;
    rot_shape_make(rot_shape_at(i), 1.0, 0, (double[]){3.0, 3.0, 3.0, 3.0}, &b);
    if (!isnan(b.beta)) rolling++;
  }
  /* and the point that slides */
  ROT_CHECK_EQ_INT(rolling, 1 + sizeof rolls / sizeof rolls[0]);
  ROT_CHECK(make("sliding_point", 1, 3, 0, 0, 0).beta == 0.0);
  ROT_CHECK(make("disk", 1, 0, 0, 0, 0).beta == 0.5);
  ROT_CHECK(isnan(make("annulus", 1, 0, 0, 0, 0).beta));
  ROT_CHECK(isnan(make("hollow_sphere", 1, 0, 0, 0, 0).beta));
  ROT_CHECK(isnan(make("capsule", 1, 0, 0, 0, 0).beta));
}

static void check_moment(void) {
  ROT_CHECK(make("point", 2, 3, 0, 0, 0).moment_kg_m2 == 18.0);
  ROT_CHECK(make("point", 2, 3, 0, 0, 0).centre_m[0] == 3.0);
  ROT_CHECK(make("sliding_point", 2, 3, 0, 0, 0).moment_kg_m2 == 0.0);
  ROT_CHECK(make("rod", 2, 3, 0, 0, 0).moment_kg_m2 == 1.5);
  ROT_CHECK(make("rod_end", 2, 3, 0, 0, 0).moment_kg_m2 == 6.0);
  ROT_CHECK(make("rod_end", 2, 3, 0, 0, 0).second_kg_m2[0] == 1.5);
}

/* ---- the shared table ----------------------------------------------------------------------- */

static void check_shared(void) {
  FILE *file = shared_table("refs/inertia_ratios.csv");
  double x[5];
  int rows = 0;
  if (!file) return;
  while (shared_row(file, 5, x)) {
    rows++;
    const rot_shape_body hollow = make("hollow_sphere", 1, x[0], x[1], 0, 0),
                         tube = make("thick_tube", 1, x[0], x[1], 1, 0),
                         frustum = make("frustum", 1, x[0], x[1], 1, 0);
    ROT_CHECK_ULP(hollow.moment_kg_m2, x[2], 4);
    ROT_CHECK_ULP(2.0 * hollow.second_kg_m2[2], x[2], 4);
    ROT_CHECK_ULP(tube.moment_kg_m2, x[3], 2);
    ROT_CHECK_ULP(frustum.moment_kg_m2, x[4], 4);
  }
  ROT_CHECK(rows > 5);
}

/* Walls from all of the sphere to 1e-16 of it, against 31 digits: (R^5 - r^5)/(R^3 - r^3) with the
 * common factor divided out. */
static void check_hollow_sphere(void) {
  double max = 0.0;
  for (int i = 0; i <= 4000; i++) {
    const double outer = 1.0 + 0.618 * i / 4000.0, wall = pow(10.0, -16.5 * (i % 401) / 400.0),
                 inner = outer * (1.0 - wall);
    const rot_dd R = {outer, 0.0}, r = {inner, 0.0}, R2 = rot_dd_mul2(outer, outer),
                 r2 = rot_dd_mul2(inner, inner), Rr = rot_dd_mul2(outer, inner);
    const rot_dd s2 = rot_dd_add(rot_dd_add(R2, Rr), r2);
    const rot_dd s4 = rot_dd_add(rot_dd_add(rot_dd_mul(R2, R2), rot_dd_mul(R2, Rr)),
                                 rot_dd_add(rot_dd_mul(Rr, Rr), rot_dd_mul(r2, rot_dd_mul(r, R))));
    const rot_dd k =
        rot_dd_div(rot_dd_mul1(rot_dd_add(s4, rot_dd_mul(r2, r2)), 2.0), rot_dd_mul1(s2, 5.0));
    const double got = make("hollow_sphere", 1, outer, inner, 0, 0).moment_kg_m2;
    ROT_CHECK_ULP(got, k.hi, 4);
    max = fmax(max, rot_test_ulp(got, k.hi));
  }
  printf("hollow spheres: at most %g ulp\n", max);
}

/* ---- limits --------------------------------------------------------------------------------- */

static void same(rot_shape_body a, rot_shape_body b, double ulps) {
  for (int k = 0; k < 4; k++) ROT_CHECK_ULP(a.second_kg_m2[k], b.second_kg_m2[k], ulps);
  for (int k = 0; k < 3; k++) ROT_CHECK_ULP(a.centre_m[k], b.centre_m[k], ulps);
  ROT_CHECK_ULP(a.reach_m, b.reach_m, ulps);
}

static void same_measure(const char *one, const double s[4], const char *two, const double t[4],
                         double ulps) {
  rot_shape_body a, b;
  rot_shape_make(find(one), 1.5, 1, s, &a);
  rot_shape_make(find(two), 1.5, 1, t, &b);
  ROT_CHECK_ULP(a.mass_kg, b.mass_kg, ulps);
}

static void check_limits(void) {
  same(make("thick_tube", 2, 3, 0, 5, 0), make("cylinder", 2, 3, 5, 0, 0), 0);
  same(make("thick_tube", 2, 3, 3, 5, 0), make("tube", 2, 3, 5, 0, 0), 0);
  same(make("annulus", 2, 3, 0, 0, 0), make("disk", 2, 3, 0, 0, 0), 0);
  same(make("annulus", 2, 3, 3, 0, 0), make("hoop", 2, 3, 0, 0, 0), 0);
  same(make("hollow_sphere", 2, 3, 0, 0, 0), make("sphere", 2, 3, 0, 0, 0), 1);
  same(make("hollow_sphere", 2, 3, 3, 0, 0), make("spherical_shell", 2, 3, 0, 0, 0), 1);
  const rot_shape_body frustum = make("frustum", 2, 3, 3, 5, 0),
                       cylinder = make("cylinder", 2, 3, 5, 0, 0);
  for (int k = 0; k < 3; k++) {
    ROT_CHECK_ULP(frustum.second_kg_m2[k], cylinder.second_kg_m2[k], 2);
  }
  ROT_CHECK_ULP(frustum.centre_m[2], 2.5, 1);
  same(make("frustum", 2, 3, 0, 5, 0), make("cone", 2, 3, 5, 0, 0), 2);
  same(make("frustum_shell", 2, 3, 0, 5, 0), make("cone_shell", 2, 3, 5, 0, 0), 2);
  same(make("capsule", 2, 3, 0, 0, 0), make("sphere", 2, 3, 0, 0, 0), 1);
  same(make("capsule", 2, 0, 3, 0, 0), make("cylinder", 2, 0, 3, 0, 0), 1);
  same(make("spherical_cap", 2, 3, 3, 0, 0), make("hemisphere", 2, 3, 0, 0, 0), 2);
  same(make("spherical_cap_shell", 2, 3, 3, 0, 0), make("hemispherical_shell", 2, 3, 0, 0, 0), 2);
  const rot_shape_body ball = make("spherical_cap", 2, 3, 6, 0, 0),
                       sphere = make("sphere", 2, 3, 0, 0, 0);
  for (int k = 0; k < 3; k++) ROT_CHECK_ULP(ball.second_kg_m2[k], sphere.second_kg_m2[k], 2);
  ROT_CHECK_ULP(ball.centre_m[2], 3.0, 0);
  ROT_CHECK_ULP(ball.reach_m, 3.0, 0);
  same(make("can", 2, 3, 0, 0, 0), make("disk", 2, 3, 0, 0, 0), 0);
  same(make("box", 2, 3, 0, 0, 0), make("rod", 2, 3, 0, 0, 0), 0);
  same(make("box", 2, 3, 5, 0, 0), make("rectangle", 2, 3, 5, 0, 0), 0);
  same(make("box_shell", 2, 3, 5, 0, 0), make("rectangle", 2, 3, 5, 0, 0), 0);
  same(make("ellipsoid", 2, 3, 3, 3, 0), make("sphere", 2, 3, 0, 0, 0), 0);
  same(make("ellipsoid_shell", 2, 3, 3, 3, 0), make("spherical_shell", 2, 3, 0, 0, 0), 0);
  same(make("torus", 2, 3, 0, 0, 0), make("hoop", 2, 3, 0, 0, 0), 0);
  same(make("elliptic_plate", 2, 3, 3, 0, 0), make("disk", 2, 3, 0, 0, 0), 0);
  same(make("polygon_plate", 2, 3, 1e9, 0, 0), make("disk", 2, 3, 0, 0, 0), 1);
  /* A square by its corners on the circle. */
  same(make("polygon_plate", 2, 3 * sqrt(2.0), 4, 0, 0), make("rectangle", 2, 6, 6, 0, 0), 3);
  same_measure("thick_tube", (double[]){3, 0, 5, 0}, "cylinder", (double[]){3, 5, 0, 0}, 1);
  same_measure("frustum", (double[]){3, 3, 5, 0}, "cylinder", (double[]){3, 5, 0, 0}, 2);
  same_measure("capsule", (double[]){3, 0, 0, 0}, "sphere", (double[]){3, 0, 0, 0}, 2);
  same_measure("spherical_cap", (double[]){3, 6, 0, 0}, "sphere", (double[]){3, 0, 0, 0}, 2);
  same_measure("hollow_sphere", (double[]){3, 0, 0, 0}, "sphere", (double[]){3, 0, 0, 0}, 2);
}

/* Nothing at all: no size, no mass. */
static void check_nothing(void) {
  for (size_t i = 0; i < rot_shape_count(); i++) {
    const rot_shape *shape = rot_shape_at(i);
    double none[4] = {0.0, 0.0, 0.0, 0.0}, some[4] = {3.0, 2.0, 2.0, 2.0};
    for (int k = 0; k < shape->sizes; k++) {
      if (shape->size[k] == ROT_SIDES) none[k] = some[k] = 5.0;
    }
    rot_shape_body b;
    rot_shape_make(shape, 2.0, 0, none, &b);
    for (int k = 0; k < 6; k++) ROT_CHECK(b.second_kg_m2[k] == 0.0);
    for (int k = 0; k < 3; k++) ROT_CHECK(b.centre_m[k] == 0.0);
    ROT_CHECK(b.reach_m == 0.0 && b.moment_kg_m2 == 0.0 && b.gyration_m == 0.0 && b.error == 0.0);
    rot_shape_make(shape, 0.0, 0, some, &b);
    for (int k = 0; k < 6; k++) ROT_CHECK(b.second_kg_m2[k] == 0.0);
    ROT_CHECK(b.error == 0.0 && b.moment_kg_m2 == 0.0);
  }
}

/* Powers of two come through every shape without a change of digits, as far as they go. */
static void check_scales(void) {
  const int powers[] = {-490, -300, -61, -59, 40, 59, 61, 300, 490};
  for (size_t c = 0; c < CASES; c++) {
    const rot_shape *shape = find(shape_cases[c].shape);
    rot_shape_body one, other;
    rot_shape_make(shape, 1.0, 0, shape_cases[c].size, &one);
    for (size_t p = 0; p < sizeof powers / sizeof powers[0]; p++) {
      double size[4] = {0.0};
      for (int k = 0; k < shape->sizes; k++) {
        const double s = shape_cases[c].size[k];
        size[k] = shape->size[k] == ROT_SIDES ? s : ldexp(s, powers[p]);
      }
      rot_shape_make(shape, ldexp(1.0, -powers[p]), 0, size, &other);
      for (int k = 0; k < 4; k++) {
        ROT_CHECK(other.second_kg_m2[k] == ldexp(one.second_kg_m2[k], powers[p]));
      }
      for (int k = 0; k < 3; k++) {
        ROT_CHECK(other.centre_m[k] == ldexp(one.centre_m[k], powers[p]));
      }
      ROT_CHECK(other.reach_m == ldexp(one.reach_m, powers[p]));
      ROT_CHECK(other.moment_kg_m2 == ldexp(one.moment_kg_m2, powers[p]));
      ROT_CHECK(other.gyration_m == ldexp(one.gyration_m, powers[p]));
    }
  }
}

/* Sizes in a ratio of 1e150: nothing is lost that a double can hold. Each shape is thin in one
 * size after the other, and the moments of what is thick must be those of 1e-20: to within 1e-15
 * alike; those across the thin size must go with its square. */
static void check_ratios(void) {
  const double thin = 1e-150, less = 1e-20;
  for (size_t i = 0; i < rot_shape_count(); i++) {
    const rot_shape *shape = rot_shape_at(i);
    for (int t = 0; t < shape->sizes; t++) {
      double a[4] = {1.0, 1.0, 1.0, 1.0}, b[4] = {1.0, 1.0, 1.0, 1.0};
      int slot;
      for (int k = 0; k < shape->sizes; k++) {
        if (shape->size[k] == ROT_SIDES) a[k] = b[k] = 5.0;
      }
      if (shape->size[t] == ROT_SIDES) continue;
      a[t] = thin;
      b[t] = less;
      if (rot_shape_check(shape, a, &slot) != ROT_SHAPE_FITS) continue;
      rot_shape_body x, y;
      rot_shape_make(shape, 1.0, 0, a, &x);
      rot_shape_make(shape, 1.0, 0, b, &y);
      for (int k = 0; k < 3; k++) {
        const double u = x.second_kg_m2[k], v = y.second_kg_m2[k];
        if (v < 1e-38) { /* with the square of the thin size, or it is a shape of one size */
          ROT_CHECK_REL(u / thin / thin, v / less / less, 1e-14);
        } else if (v < 1e-18) { /* a cap's, with its height */
          ROT_CHECK_REL(u / thin, v / less, 1e-14);
        } else {
          ROT_CHECK_REL(u, v, 1e-14);
        }
      }
    }
  }
  /* Two radii of 1e-150 beside a height of 1. */
  const rot_shape_body needle = make("frustum", 1, 2e-150, 1e-150, 1, 0);
  const rot_shape_body frustum = make("frustum", 1, 2, 1, 1, 0);
  ROT_CHECK_ULP(needle.second_kg_m2[2], frustum.second_kg_m2[2], 0);
  ROT_CHECK_REL(needle.second_kg_m2[0] / 1e-150 / 1e-150, frustum.second_kg_m2[0], 1e-15);
  /* A mass that brings a square back into range, and one that does not. */
  ROT_CHECK_ULP(make("hoop", 1e300, 1e-200, 0, 0, 0).moment_kg_m2, 1e-100, 2);
  ROT_CHECK_ULP(make("hoop", 1e-300, 1e200, 0, 0, 0).moment_kg_m2, 1e100, 2);
  ROT_CHECK(isinf(make("hoop", 1, 1e200, 0, 0, 0).moment_kg_m2));
  ROT_CHECK(
      isinf(make("disk", 1, 1e-200, 0, 0, 0).error)); /* all digits are gone, and it says so */
  const rot_shape_body small = make("disk", 1, 3e-161, 0, 0, 0);
  ROT_CHECK(small.second_kg_m2[0] > 0.0 && small.error > 1e-4 && small.error < 1.0);
}

/* One row of the table: its moment and radius of gyration, then Ixx, Iyy and Izz. */
static void one_row(const rot_shape *shape, double mass, const double size[], double got[5]) {
  const int at = (int)(shape - rot_shape_at(0));
  const double none = NAN;
  double store[ROT_SHAPE_COLUMNS], *out[ROT_SHAPE_COLUMNS];
  rot_shape_rows rows = {&at, 0, {&mass, 0}, {&none, 0}, {{NULL, 0}}};
  size_t row;
  int slot;
  for (int k = 0; k < shape->sizes; k++) rows.size[shape->size[k]] = (rot_column){&size[k], 0};
  for (int c = 0; c < ROT_SHAPE_COLUMNS; c++) out[c] = &store[c];
  ROT_CHECK_EQ_INT(rot_shapes_table(1, &rows, out, &row, &slot), ROT_SHAPE_FITS);
  got[0] = store[ROT_SHAPE_MOMENT];
  got[1] = store[ROT_SHAPE_GYRATION];
  for (int k = 0; k < 3; k++) got[2 + k] = store[ROT_SHAPE_IXX + k];
}

/* Sizes in a ratio of 1e280, in every choice of thin ones: the squares of those are beneath the
 * smallest double, and a mass brings them back. Against sizes in a ratio of 1e-20. */
static void check_simd(void) {
  const double thin = 1e-280, less = 1e-20, mass = 1e300;
  for (size_t i = 0; i < rot_shape_count(); i++) {
    const rot_shape *shape = rot_shape_at(i);
    for (int set = 1; set < 1 << shape->sizes; set++) {
      double a[4] = {1.0, 1.0, 1.0, 1.0}, b[4] = {1.0, 1.0, 1.0, 1.0}, p[5], q[5];
      int slot;
      for (int k = 0; k < shape->sizes; k++) {
        if (set >> k & 1) {
          a[k] = thin;
          b[k] = less;
        }
        if (shape->size[k] == ROT_SIDES) a[k] = b[k] = 5.0;
      }
      if (rot_shape_check(shape, a, &slot) != ROT_SHAPE_FITS) continue;
      rot_shape_body x, y;
      rot_shape_make(shape, mass, 0, a, &x);
      rot_shape_make(shape, 1.0, 0, b, &y);
      const double *u = x.second_kg_m2, *v = y.second_kg_m2;
      for (int k = 0; k < 3; k++) {
        const double by = v[k] < 1e-38 ? mass * thin * thin : v[k] < 1e-18 ? mass * thin : mass;
        const double unit = v[k] < 1e-38 ? less * less : v[k] < 1e-18 ? less : 1.0;
        ROT_CHECK_REL(u[k], v[k] / unit * by, 1e-14);
      }
      one_row(shape, mass, a, p);
      one_row(shape, 1.0, b, q);
      ROT_CHECK_REL(p[0], x.moment_kg_m2, 4.0 * ROT_EPS);
      ROT_CHECK_REL(p[1], x.gyration_m, 4.0 * ROT_EPS);
      if (q[1] > 1e-5 || q[1] < 1e-15)
        ROT_CHECK_REL(p[1], q[1] * (q[1] < 1e-15 ? thin / less : 1), 1e-14);
      ROT_CHECK_REL(p[2], u[1] + u[2], 4.0 * ROT_EPS);
      ROT_CHECK_REL(p[3], u[0] + u[2], 4.0 * ROT_EPS);
      ROT_CHECK_REL(p[4], u[0] + u[1], 4.0 * ROT_EPS);
    }
  }
  /* By mpmath, 50 digits: m r^2/2 of a wire, r = 1e-150 and l = 1e150, m = 3. */
  ROT_CHECK_ULP(make("cylinder", 3, 1e-150, 1e150, 0, 0).moment_kg_m2, 1.5e-300, 4);
}

/* A density carries a mass that has few digits, or none, and the error says so. */
static void check_small_masses(void) {
  rot_shape_body b;
  rot_shape_make(find("sphere"), 1.0, 1, (double[]){1e-150}, &b);
  ROT_CHECK(b.mass_kg == 0.0 && isinf(b.error));
  /* 4 smallest doubles of kg/m^2 on 1.1875 m^2: 4.75 of them, which round to 5. */
  rot_shape_make(find("rectangle"), 0x1p-1072, 1, (double[]){0x1p200, 0x1.3p-200}, &b);
  ROT_CHECK(b.mass_kg == 0x1.4p-1072 && b.error > 0.25 / 4.75 && b.error < 1.0);
  rot_shape_make(find("rectangle"), 0.0, 1, (double[]){1.0, 2.0}, &b);
  ROT_CHECK(b.mass_kg == 0.0 && b.error <= 16.0 * ROT_EPS);
  rot_shape_make(find("rectangle"), 1.0, 1, (double[]){1.0, 0.0}, &b);
  ROT_CHECK(b.mass_kg == 0.0 && b.error <= 16.0 * ROT_EPS);
}

/* ---- what does not fit ---------------------------------------------------------------------- */

static void check_faults(void) {
  static const struct {
    const char *name;
    double size[4];
    rot_shape_fault fault;
    int slot;
  } wrong[] = {{"disk", {-1.0}, ROT_SHAPE_NEGATIVE, 0},
               {"box", {1.0, 1.0, -1e-300}, ROT_SHAPE_NEGATIVE, 2},
               {"annulus", {1.0, 1.0 + 0x1p-52}, ROT_SHAPE_OUTSIDE, 1},
               {"thick_tube", {1.0, 2.0, 1.0}, ROT_SHAPE_OUTSIDE, 1},
               {"hollow_sphere", {1.0, 2.0}, ROT_SHAPE_OUTSIDE, 1},
               {"torus", {1.0, 2.0}, ROT_SHAPE_OUTSIDE, 1},
               {"spherical_cap", {1.0, 2.0 + 0x1p-50}, ROT_SHAPE_TOO_HIGH, 1},
               {"spherical_cap", {1e308, 1.5e308}, ROT_SHAPE_FITS, 0},
               {"spherical_cap_shell", {1.0, 2.5}, ROT_SHAPE_TOO_HIGH, 1},
               {"polygon_plate", {1.0, 2.0}, ROT_SHAPE_SIDES, 1},
               {"polygon_plate", {1.0, 3.5}, ROT_SHAPE_SIDES, 1},
               {"polygon_prism", {1.0, -4.0, 1.0}, ROT_SHAPE_SIDES, 1},
               {"triangle", {1.0, 1.0, -7.0}, ROT_SHAPE_FITS, 0},
               {"annulus", {1.0, 1.0}, ROT_SHAPE_FITS, 0},
               {"spherical_cap", {1.0, 2.0}, ROT_SHAPE_FITS, 0},
               {"frustum", {1.0, 2.0, 1.0}, ROT_SHAPE_FITS, 0},
               {"annulus", {NAN, 1.0}, ROT_SHAPE_FITS, 0}};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
    int slot = -1;
    ROT_CHECK_EQ_INT(rot_shape_check(find(wrong[i].name), wrong[i].size, &slot), wrong[i].fault);
    if (wrong[i].fault) ROT_CHECK_EQ_INT(slot, wrong[i].slot);
  }
}

/* ---- the table ------------------------------------------------------------------------------ */

static void check_table(void) {
  enum { ROWS = 6 };
  const int shape[ROWS] = {id_of("disk"),
                           id_of("rod_end"),
                           id_of("hollow_sphere"),
                           id_of("cone"),
                           -1,
                           id_of("triangular_prism")};
  const double mass[ROWS] = {2, 3, 4, 5, 6, 7}, beta[ROWS] = {NAN, NAN, NAN, NAN, 0.7, NAN};
  const double radius[ROWS] = {3, NAN, NAN, 2, 5, NAN}, length[ROWS] = {NAN, 4, NAN, NAN, NAN, 3};
  const double outer = 3.0, inner = 2.0, height = 6.0, base = 2.0, apex = -1.0;
  rot_shape_rows rows = {shape, 1, {mass, 1}, {beta, 1}, {{NULL, 0}}};
  rows.size[ROT_RADIUS] = (rot_column){radius, 1};
  rows.size[ROT_LENGTH] = (rot_column){length, 1};
  rows.size[ROT_OUTER_RADIUS] = (rot_column){&outer, 0};
  rows.size[ROT_INNER_RADIUS] = (rot_column){&inner, 0};
  rows.size[ROT_HEIGHT] = (rot_column){&height, 0};
  rows.size[ROT_BASE] = (rot_column){&base, 0};
  rows.size[ROT_APEX] = (rot_column){&apex, 0};
  double store[ROT_SHAPE_COLUMNS][ROWS], *out[ROT_SHAPE_COLUMNS];
  for (int c = 0; c < ROT_SHAPE_COLUMNS; c++) out[c] = store[c];
  size_t row;
  int slot;
  ROT_CHECK_EQ_INT(rot_shapes_table(ROWS, &rows, out, &row, &slot), ROT_SHAPE_FITS);
  const double sizes[ROWS][4] = {{3}, {4}, {3, 2}, {2, 6}, {5}, {2, 6, -1, 3}};
  for (int i = 0; i < ROWS; i++) {
    if (shape[i] < 0) continue;
    rot_shape_body b;
    rot_shape_make(rot_shape_at((size_t)shape[i]), mass[i], 0, sizes[i], &b);
    const double *c = b.second_kg_m2;
    ROT_CHECK_ULP(store[ROT_SHAPE_MOMENT][i], b.moment_kg_m2, 0);
    ROT_CHECK_ULP(store[ROT_SHAPE_IXX][i], c[1] + c[2], 2);
    ROT_CHECK_ULP(store[ROT_SHAPE_IYY][i], c[0] + c[2], 2);
    ROT_CHECK_ULP(store[ROT_SHAPE_IZZ][i], c[0] + c[1], 2);
    ROT_CHECK_ULP(store[ROT_SHAPE_ROLLS][i], b.beta, 0);
    ROT_CHECK_ULP(store[ROT_SHAPE_GYRATION][i], b.gyration_m, 0);
  }
  ROT_CHECK(store[ROT_SHAPE_IXX][0] == 4.5 && store[ROT_SHAPE_IZZ][0] == 9.0);
  ROT_CHECK_ULP(store[ROT_SHAPE_MOMENT][4], 0.7 * 6 * 25, 2);
  ROT_CHECK(isnan(store[ROT_SHAPE_IXX][4]) && store[ROT_SHAPE_ROLLS][4] == 0.7);
}

static void check_table_ends(void) {
  const int shape[] = {id_of("hoop"), id_of("disk"), id_of("disk"), id_of("hollow_sphere")};
  double mass[] = {2, NAN, 2, 2}, radius[] = {1, 1, NAN, 1}, outer = 1.0, inner = 2.0, none = NAN;
  rot_shape_rows rows = {shape, 1, {mass, 1}, {&none, 0}, {{NULL, 0}}};
  rows.size[ROT_RADIUS] = (rot_column){radius, 1};
  rows.size[ROT_OUTER_RADIUS] = (rot_column){&outer, 0};
  rows.size[ROT_INNER_RADIUS] = (rot_column){&inner, 0};
  double store[ROT_SHAPE_COLUMNS][4], *out[ROT_SHAPE_COLUMNS];
  for (int c = 0; c < ROT_SHAPE_COLUMNS; c++) {
    out[c] = store[c];
    store[c][3] = -7.0;
  }
  size_t row = 99;
  int slot = 99;
  ROT_CHECK_EQ_INT(rot_shapes_table(4, &rows, out, &row, &slot), ROT_SHAPE_OUTSIDE);
  ROT_CHECK(row == 3 && slot == 1 && store[ROT_SHAPE_IZZ][3] == -7.0);
  ROT_CHECK(store[ROT_SHAPE_MOMENT][0] == 2.0);
  for (int c = 0; c < ROT_SHAPE_COLUMNS; c++) ROT_CHECK(isnan(store[c][1]) && isnan(store[c][2]));
  mass[0] = -1.0;
  ROT_CHECK_EQ_INT(rot_shapes_table(3, &rows, out, &row, &slot), ROT_SHAPE_MASS);
  ROT_CHECK(row == 0);
  mass[0] = 1.0;
  radius[2] = -1.0;
  ROT_CHECK_EQ_INT(rot_shapes_table(3, &rows, out, &row, &slot), ROT_SHAPE_NEGATIVE);
  ROT_CHECK(row == 2 && slot == 0);
  none = -1.0;
  ROT_CHECK_EQ_INT(rot_shapes_table(3, &rows, out, &row, &slot), ROT_SHAPE_BETA);
  ROT_CHECK_EQ_INT(rot_shapes_table(0, &rows, out, &row, &slot), ROT_SHAPE_FITS);
}

int main(void) {
  check_list();
  check_integrals();
  check_reach();
  check_beta();
  check_moment();
  check_shared();
  check_hollow_sphere();
  check_limits();
  check_nothing();
  check_scales();
  check_ratios();
  check_simd();
  check_small_masses();
  check_faults();
  check_table();
  check_table_ends();
  return rot_test_report("shapes");
}
