/* The shapes and their moments of inertia, against integrals worked out by hand. */
#include "rot_shapes.h"
#include "rot_test.h"

/* name, I/(m size^2) about the axis named, about the centre along x, y, z, and how it reads */
static const struct {
  const char *name;
  double axis, x, y, z;
  const char *formula;
} known[] = {
    {"hoop", 1.0, 1.0 / 2.0, 1.0 / 2.0, 1.0, "m r^2"},
    {"disk", 1.0 / 2.0, 1.0 / 4.0, 1.0 / 4.0, 1.0 / 2.0, "m r^2 / 2"},
    {"sphere", 2.0 / 5.0, 2.0 / 5.0, 2.0 / 5.0, 2.0 / 5.0, "2 m r^2 / 5"},
    {"spherical_shell", 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, "2 m r^2 / 3"},
    {"rod", 1.0 / 12.0, 0.0, 1.0 / 12.0, 1.0 / 12.0, "m l^2 / 12"},
    {"rod_end", 1.0 / 3.0, 0.0, 1.0 / 12.0, 1.0 / 12.0, "m l^2 / 3"},
    {"point", 1.0, 0.0, 0.0, 0.0, "m r^2"},
    {"sliding_point", 0.0, 0.0, 0.0, 0.0, "0"},
};

enum { KNOWN = sizeof known / sizeof known[0] };

static void check_shapes(void) {
  ROT_CHECK_EQ_INT(rot_shape_count(), KNOWN);
  for (size_t i = 0; i < KNOWN && i < rot_shape_count(); i++) {
    const rot_shape *shape = rot_shape_at(i);
    ROT_CHECK(strcmp(shape->name, known[i].name) == 0);
    ROT_CHECK_ULP(shape->axis, known[i].axis, 0);
    ROT_CHECK_ULP(shape->principal[0], known[i].x, 0);
    ROT_CHECK_ULP(shape->principal[1], known[i].y, 0);
    ROT_CHECK_ULP(shape->principal[2], known[i].z, 0);
    ROT_CHECK(strcmp(shape->formula, known[i].formula) == 0);
    ROT_CHECK(strlen(shape->axis_text) > 0);
    ROT_CHECK(strcmp(shape->size, i == 4 || i == 5 ? "length_m" : "radius_m") == 0);
    for (size_t j = 0; j < i; j++) ROT_CHECK(strcmp(shape->name, rot_shape_at(j)->name) != 0);
  }
}

/* What every body obeys: I1 + I2 >= I3 about the centre, and flat bodies with equality. */
static void check_triangle(void) {
  for (size_t i = 0; i < rot_shape_count(); i++) {
    const double *I = rot_shape_at(i)->principal;
    ROT_CHECK(I[0] + I[1] >= I[2] && I[1] + I[2] >= I[0] && I[2] + I[0] >= I[1]);
    ROT_CHECK(I[0] >= 0.0 && I[1] >= 0.0 && I[2] >= 0.0);
  }
  for (size_t i = 0; i < 2; i++) { /* hoop and disk lie in the plane z = 0 */
    const double *I = rot_shape_at(i)->principal;
    ROT_CHECK(I[0] + I[1] == I[2]);
  }
}

/* A spin axis through the centre is the body's z; the rod's end is half a length off its centre. */
static void check_axes(void) {
  for (size_t i = 0; i < 5; i++) ROT_CHECK(rot_shape_at(i)->axis == rot_shape_at(i)->principal[2]);
  ROT_CHECK_ULP(rot_shape_at(5)->axis, rot_shape_at(5)->principal[2] + 0.25, 0);
}

/* Masses, summed: a rod of 2000 points and a sphere of as many slices (disks). */
static void check_by_summation(void) {
  double rod = 0.0, end = 0.0, sphere = 0.0, volume = 0.0;
  for (int i = 0; i < 2000; i++) {
    const double x = (i + 0.5) / 2000.0, z = 2.0 * x - 1.0, area = 1.0 - z * z;
    rod += (x - 0.5) * (x - 0.5) / 2000.0;
    end += x * x / 2000.0;
    sphere += 0.5 * area * area;
    volume += area;
  }
  ROT_CHECK_REL(rod, rot_shape_at(4)->axis, 1e-6);
  ROT_CHECK_REL(end, rot_shape_at(5)->axis, 1e-6);
  ROT_CHECK_REL(sphere / volume, rot_shape_at(2)->axis, 1e-6);
}

/* k = 1/4, m = 2, size = 3: I = k m size^2, gyration sqrt(k) size. */
static void check_table(void) {
  const double k[] = {0.25, 4.0, 9.0, 1.0}, mass[] = {2.0, 5.0, 7.0, 1.0}, size = 3.0;
  const rot_column ks = {k, 1}, masses = {mass, 1}, sizes = {&size, 0};
  double inertia[4] = {-7.0, -7.0, -7.0, -7.0}, gyration[4] = {-7.0, -7.0, -7.0, -7.0};
  rot_shapes_table(3, ks, masses, sizes, inertia, gyration);
  ROT_CHECK(inertia[0] == 4.5 && gyration[0] == 1.5);
  ROT_CHECK(inertia[1] == 180.0 && gyration[1] == 6.0);
  ROT_CHECK(inertia[2] == 567.0 && gyration[2] == 9.0);
  ROT_CHECK(inertia[3] == -7.0 && gyration[3] == -7.0);
  rot_shapes_table(0, ks, masses, sizes, inertia + 3, gyration + 3);
  ROT_CHECK(inertia[3] == -7.0);
  const rot_column one_k = {k, 0}, one_mass = {mass, 0}, many_sizes = {mass, 1};
  rot_shapes_table(3, one_k, one_mass, many_sizes, inertia, gyration);
  ROT_CHECK(inertia[1] == 12.5 && gyration[1] == 2.5);
  ROT_CHECK(inertia[2] == 24.5 && gyration[2] == 3.5);
}

static void check_ends(void) {
  const double k[] = {0.5, 0.5, NAN, 0.0}, mass[] = {2e300, 2e-300, 2.0, 2.0},
               size[] = {1e-200, 1e200, 3.0, 3.0};
  const rot_column ks = {k, 1}, masses = {mass, 1}, sizes = {size, 1};
  double inertia[4], gyration[4];
  rot_shapes_table(4, ks, masses, sizes, inertia, gyration);
  ROT_CHECK_ULP(inertia[0], 1e-100, 3); /* size^2 is out of range, the moment is not */
  ROT_CHECK_ULP(inertia[1], 1e100, 3);
  ROT_CHECK(isnan(inertia[2]) && isnan(gyration[2]));
  ROT_CHECK(inertia[3] == 0.0 && gyration[3] == 0.0);
}

int main(void) {
  check_shapes();
  check_triangle();
  check_axes();
  check_by_summation();
  check_table();
  check_ends();
  return rot_test_report("inertia");
}
