/* Bodies made of others by the C interface's parts: closed forms, turned moments, what is
 * refused. */
#include "body/compound.h"

#include <math.h>
#include <string.h>

#include "api/object.h"
#include "api/scene.h"
#include "rot_test.h"

static rotdyn_object *sphere(double mass, double radius) {
  rotdyn_object *of = rotdyn_object_new("body_sphere");
  ROT_CHECK(rotdyn_set_number(of, "mass_kg", mass) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(of, "radius_m", radius) == ROTDYN_OK);
  return of;
}

static void give(rotdyn_object *to, const char *input, rotdyn_object *part) {
  ROT_CHECK_EQ_INT(rotdyn_set_object(to, input, part), ROTDYN_OK);
  rotdyn_object_free(part);
}

static rotdyn_object *placed(rotdyn_object *body, double x, double y, double z) {
  const double at[] = {x, y, z};
  rotdyn_object *of = rotdyn_object_new("place_body");
  give(of, "body", body);
  ROT_CHECK(rotdyn_set_numbers(of, "at_m", 3, at) == ROTDYN_OK);
  return of;
}

/* The body's moment about z through its centre of mass: what a torque of 1 N m turns in 1 s. */
static double moment_of(rotdyn_object *body) {
  const double time_s = 1.0;
  double momentum = NAN, omega = NAN, *columns[] = {&momentum, &omega};
  const char *names[] = {"angular_momentum_kg_m2_per_s", "omega_rad_per_s"};
  rotdyn_object *scene = rotdyn_object_new("scene_axle");
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  give(scene, "body", body);
  ROT_CHECK(rotdyn_set_number(scene, "omega0_rad_per_s", 2.0) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_text(scene, "through", "centre") == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 1, &time_s, NULL, 1, 2, names, columns, &report),
                   ROTDYN_OK);
  rotdyn_object_free(scene);
  return momentum / omega;
}

/* Two balls on a line along x at 1 m and -1 m, one in the middle: 2 m d^2 + 3 (2/5) m r^2. */
static void check_joined(void) {
  rotdyn_object *whole = rotdyn_object_new("join_bodies"), *list = rotdyn_object_new("list");
  rotdyn_object *inner = rotdyn_object_new("list");
  give(list, NULL, placed(sphere(2.0, 0.1), 1.0, 0.0, 5.0));
  give(inner, NULL, placed(sphere(2.0, 0.1), -1.0, 0.0, 5.0));
  give(inner, NULL, placed(sphere(2.0, 0.1), 0.0, 0.0, 5.0));
  give(list, NULL, inner);
  give(whole, "bodies", list);
  ROT_CHECK_REL(moment_of(whole), 4.0 + 3.0 * 0.4 * 2.0 * 0.01, 1e-15);
}

/* A ball of 8 kg and radius 0.2 m without a ball of radius 0.1 m at its middle. */
static void check_cut(void) {
  rotdyn_object *left = rotdyn_object_new("cut_body");
  give(left, "body", sphere(8.0, 0.2));
  give(left, "hole", sphere(1.0, 0.1));
  ROT_CHECK_REL(moment_of(left), 0.4 * (8.0 * 0.04 - 0.01), 4e-15);
}

/* A box of 3 kg, 0.4 by 0.5 by 0.3 m, turned by 90 degrees about y: its x axis lies along -z. */
static void check_turned(int by_rows) {
  const double half = sqrt(0.5), q[] = {half, 0.0, half, 0.0};
  const double rows[3][3] = {{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}};
  const char *const sizes[] = {"length_m", "width_m", "height_m"};
  const double size[] = {0.4, 0.5, 0.3};
  rotdyn_object *box = rotdyn_object_new("body_box"), *of = rotdyn_object_new("place_body");
  ROT_CHECK(rotdyn_set_number(box, "mass_kg", 3.0) == ROTDYN_OK);
  for (int k = 0; k < 3; k++) ROT_CHECK(rotdyn_set_number(box, sizes[k], size[k]) == ROTDYN_OK);
  give(of, "body", box);
  if (by_rows) {
    rotdyn_object *matrix = rotdyn_object_new("list");
    for (int i = 0; i < 3; i++)
      ROT_CHECK(rotdyn_set_numbers(matrix, NULL, 3, rows[i]) == ROTDYN_OK);
    give(of, "rotation", matrix);
  } else {
    ROT_CHECK(rotdyn_set_numbers(of, "rotation", 4, q) == ROTDYN_OK);
  }
  ROT_CHECK_REL(moment_of(of), 3.0 * (0.25 + 0.09) / 12.0, 1e-15);
}

/* Three points of 1 kg at distances 0, 3, 6 m along x: about their middle 18 kg m^2. */
static rotdyn_object *points(int own_mass) {
  const double x[] = {1.0, 4.0, 7.0}, y[] = {2.0, 2.0, 2.0};
  rotdyn_object *data = rotdyn_object_new("data"), *of = rotdyn_object_new("body_points");
  ROT_CHECK(rotdyn_set_numbers(data, "x_m", 3, x) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(data, "y_m", 3, y) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(data, "z_m", 9.0) == ROTDYN_OK);
  if (own_mass) ROT_CHECK(rotdyn_set_number(data, "mass_kg", 1.0) == ROTDYN_OK);
  give(of, "data", data);
  return of;
}

static void check_points(void) {
  rotdyn_object *other = points(0);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK_REL(moment_of(points(1)), 18.0, 1e-15);
  ROT_CHECK_EQ_INT(rotdyn_object_check(other, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(!strcmp(report.input, "mass_kg") && strstr(report.reason, "no point has a mass"));
  ROT_CHECK(rotdyn_set_number(other, "mass_kg", 2.0) == ROTDYN_OK);
  ROT_CHECK_REL(moment_of(other), 36.0, 1e-15);
}

/* A square plate of 6 kg and side 1 m: m/6. */
static void check_polygon(void) {
  const double corner[4][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  for (int crossed = 0; crossed < 2; crossed++) {
    rotdyn_object *plate = rotdyn_object_new("body_polygon"), *rows = rotdyn_object_new("list");
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    for (int i = 0; i < 4; i++) {
      const int at = crossed && i > 1 ? 5 - i : i;
      ROT_CHECK(rotdyn_set_numbers(rows, NULL, 2, corner[at]) == ROTDYN_OK);
    }
    give(plate, "vertices_m", rows);
    ROT_CHECK_EQ_INT(rotdyn_object_check(plate, &report), ROTDYN_EARGUMENT);
    ROT_CHECK(!strcmp(report.input, "mass_kg"));
    ROT_CHECK(rotdyn_set_number(plate, "areal_density_kg_m2", 6.0) == ROTDYN_OK);
    if (!crossed) {
      ROT_CHECK_REL(moment_of(plate), 1.0, 4e-15);
      continue;
    }
    ROT_CHECK_EQ_INT(rotdyn_object_check(plate, &report), ROTDYN_EARGUMENT);
    ROT_CHECK(!strcmp(report.input, "vertices_m") && strstr(report.reason, "cross"));
    rotdyn_object_free(plate);
  }
}

/* By its numbers: second moments 1, 2, 3; a body has none below 0. */
static void check_numbers(void) {
  double second[3][3] = {{1.0, 0.5, 0.0}, {0.5, 2.0, 0.0}, {0.0, 0.0, 3.0}};
  const double centre[] = {7.0, 8.0, 9.0};
  for (int wrong = 0; wrong < 3; wrong++) {
    rotdyn_object *of = rotdyn_object_new("rot_body"), *rows = rotdyn_object_new("list");
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    if (wrong == 1) second[0][1] = 0.6;
    if (wrong == 2) second[0][1] = second[1][0] = 1.5;
    for (int i = 0; i < 3; i++)
      ROT_CHECK(rotdyn_set_numbers(rows, NULL, 3, second[i]) == ROTDYN_OK);
    give(of, "second_moment_kg_m2", rows);
    ROT_CHECK(rotdyn_set_text(of, "shape", "a stone") == ROTDYN_OK);
    ROT_CHECK(rotdyn_set_number(of, "mass_kg", 4.0) == ROTDYN_OK);
    ROT_CHECK(rotdyn_set_numbers(of, "centre_m", 3, centre) == ROTDYN_OK);
    ROT_CHECK(rotdyn_set_number(of, "reach_m", INFINITY) == ROTDYN_OK);
    if (wrong == 0) {
      ROT_CHECK_REL(moment_of(of), 3.0, 1e-15);
      continue;
    }
    ROT_CHECK_EQ_INT(rotdyn_object_check(of, &report), ROTDYN_EARGUMENT);
    ROT_CHECK(strstr(report.reason, wrong == 1 ? "symmetric" : "no body"));
    rotdyn_object_free(of);
  }
}

static void refuse(rotdyn_object *of, const char *input, const char *words) {
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK_EQ_INT(rotdyn_object_check(of, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(report.input && !strcmp(report.input, input) && strstr(report.reason, words));
  rotdyn_object_free(of);
}

static void check_refusals(void) {
  const double mirror[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}};
  rotdyn_object *cut = rotdyn_object_new("cut_body"), *turned, *rows, *join, *none;
  give(cut, "body", sphere(1.0, 0.2));
  give(cut, "hole", sphere(2.0, 0.1));
  refuse(cut, "hole", "lighter");
  /* A row of another length. */
  none = rotdyn_object_new("body_polygon");
  rows = rotdyn_object_new("list");
  for (size_t i = 0; i < 4; i++) {
    ROT_CHECK(rotdyn_set_numbers(rows, NULL, i == 2 ? 3 : 2, mirror[i % 3]) == ROTDYN_OK);
  }
  ROT_CHECK(rotdyn_set_number(none, "mass_kg", 1.0) == ROTDYN_OK);
  give(none, "vertices_m", rows);
  refuse(none, "vertices_m", "rows of two numbers");
  cut = rotdyn_object_new("cut_body");
  give(cut, "body", sphere(2.0, 0.2));
  give(cut, "hole", placed(sphere(1.0, 0.1), 3.0, 0.0, 0.0));
  refuse(cut, "hole", "no body");
  turned = placed(sphere(1.0, 0.1), 0.0, 0.0, 0.0);
  rows = rotdyn_object_new("list");
  for (int i = 0; i < 3; i++) ROT_CHECK(rotdyn_set_numbers(rows, NULL, 3, mirror[i]) == ROTDYN_OK);
  give(turned, "rotation", rows);
  refuse(turned, "rotation", "three rows");
  turned = placed(sphere(1.0, 0.1), 0.0, 0.0, 0.0);
  ROT_CHECK(rotdyn_set_numbers(turned, "rotation", 3, mirror[0]) == ROTDYN_OK);
  refuse(turned, "rotation", "quaternion");
  refuse(placed(placed(sphere(1.0, 0.1), 1e308, 0.0, 0.0), 1e308, 0.0, 0.0), "at_m", "beyond");
  join = rotdyn_object_new("join_bodies");
  none = rotdyn_object_new("list");
  give(join, "bodies", none);
  refuse(join, "bodies", "one body at least");
}

/* Numbers of few digits are a rotation, those that are off by more are none. */
static void check_nearly_turned(void) {
  for (int k = 0; k < 2; k++) {
    const double off = k ? 1e-7 : 2e-9; /* of the square of a row */
    const double rows[3][3] = {{0.0, 0.0, 1.0 + 0.5 * off}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}};
    rotdyn_object *turned = placed(sphere(1.0, 0.1), 0.0, 0.0, 0.0);
    rotdyn_object *matrix = rotdyn_object_new("list");
    for (int i = 0; i < 3; i++)
      ROT_CHECK(rotdyn_set_numbers(matrix, NULL, 3, rows[i]) == ROTDYN_OK);
    give(turned, "rotation", matrix);
    if (k) {
      refuse(turned, "rotation", "three rows");
    } else {
      ROT_CHECK_REL(moment_of(turned), 0.004, 1e-15);
    }
  }
}

int main(void) {
  check_joined();
  check_cut();
  check_turned(0);
  check_turned(1);
  check_points();
  check_polygon();
  check_numbers();
  check_refusals();
  check_nearly_turned();
  return rot_test_report("compound");
}
