/* Objects of the C interface: lists of inputs, setting, lists, copies, refusals, wrong runs. */
#include "api/object.h"

#include <stdlib.h>

#include "rot_test.h"

/* Sets an input to an object, which is freed. */
static int give(rotdyn_object *object, const char *input, rotdyn_object *part) {
  const int status = rotdyn_set_object(object, input, part);
  rotdyn_object_free(part);
  return status;
}

/* Whether the check names the input (NULL: any), and says these words. */
static int refused(const rotdyn_object *object, const char *input, const char *words) {
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const int status = rotdyn_object_check(object, &report);
  const int ok = status == ROTDYN_EARGUMENT && report.status == status && report.input &&
                 (!input || !strcmp(report.input, input)) && strstr(report.reason, words) != NULL;
  if (!ok) printf("%d, %s: %s\n", status, report.input ? report.input : "-", report.reason);
  return ok;
}

/* ---- lists of inputs ------------------------------------------------------------------------- */

static void check_lists(void) {
  static const char *const some[] = {
      "scene_axle", "scene_rotors", "scene_clutch",  "scene_drive",   "scene_incline",
      "scene_free", "scene_pivot",  "body_disk",     "body_tensor",   "torque_constant",
      "torque_sum", "resistance",   "inertia_knots", "coupling_gear", "brake"};
  size_t n = 0, scenes = 0, found = 0;
  const char *name;
  while ((name = rotdyn_object_at(n++)) != NULL) {
    const char *kind = rotdyn_object_kind(name);
    rotdyn_input input = ROTDYN_INIT(rotdyn_input);
    size_t i = 0;
    const int scene = kind && !strcmp(kind, "scene");
    ROT_CHECK(kind && scene == (rotdyn_column_at(name, 0) != NULL));
    for (; rotdyn_input_at(name, i, &input) == ROTDYN_OK; i++) {
      ROT_CHECK(input.name && input.unit && *input.kinds && *input.words);
      ROT_CHECK(input.low <= input.high && strlen(input.kinds) + 1 < sizeof input.kinds);
      /* A default lies in the domain. */
      ROT_CHECK(isnan(input.otherwise) ||
                (input.otherwise >= input.low && input.otherwise <= input.high));
      ROT_CHECK(!input.options == !strstr(input.kinds, "choice"));
    }
    ROT_CHECK(i > 0 && i <= ROT_MAX_INPUTS);
    ROT_CHECK_EQ_INT(rotdyn_input_at(name, i, &input), ROTDYN_EEND);
    scenes += scene != 0;
    for (size_t k = 0; k < sizeof some / sizeof *some; k++) found += !strcmp(name, some[k]);
  }
  ROT_CHECK(scenes >= 7 && found == sizeof some / sizeof *some);
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  ROT_CHECK_EQ_INT(rotdyn_input_at("scene_none", 0, &input), ROTDYN_ENAME);
  ROT_CHECK_EQ_INT(rotdyn_input_at("scene_axle", 0, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK(!rotdyn_object_kind("scene_none") && !rotdyn_object_kind(NULL));
  ROT_CHECK(!rotdyn_column_at("scene_none", 0) && !rotdyn_column_at("body_disk", 0));
  ROT_CHECK(!rotdyn_object_new("scene_none") && !rotdyn_object_new(NULL));
  ROT_CHECK(rotdyn_input_at("scene_drive", 2, &input) == ROTDYN_OK &&
            !strcmp(input.kinds, "number, law, torque, list, nothing"));
  size_t columns = 0;
  while (rotdyn_column_at("scene_drive", columns)) columns++;
  ROT_CHECK_EQ_INT(columns, 10);
}

/* Bodies have the sizes that the catalogue says, and its mass or density. */
static void check_shapes(void) {
  rotdyn_shape shape = ROTDYN_INIT(rotdyn_shape);
  size_t i = 0;
  for (; rotdyn_shape_at(i, &shape) == ROTDYN_OK; i++) {
    char name[64];
    rotdyn_input input = ROTDYN_INIT(rotdyn_input);
    rotdyn_object *body;
    (void)snprintf(name, sizeof name, "body_%s", shape.name);
    body = rotdyn_object_new(name);
    ROT_CHECK(rotdyn_input_at(name, 0, &input) == ROTDYN_OK && !strcmp(input.name, "mass_kg"));
    ROT_CHECK(input.required == (shape.dimension == 0));
    for (size_t k = 0; k < shape.n_sizes; k++) {
      ROT_CHECK(rotdyn_input_at(name, 1 + k, &input) == ROTDYN_OK);
      ROT_CHECK(!strcmp(input.name, shape.size_name[k]));
      ROT_CHECK_EQ_INT(rotdyn_set_number(body, input.name, 3.0), ROTDYN_OK);
    }
    ROT_CHECK(refused(body, "mass_kg", "missing"));
    ROT_CHECK_EQ_INT(rotdyn_set_number(body, "mass_kg", 1.0), ROTDYN_OK);
    ROT_CHECK_EQ_INT(rotdyn_object_check(body, NULL), ROTDYN_OK);
    rotdyn_object_free(body);
  }
  ROT_CHECK(i >= 40);
}

/* ---- setting --------------------------------------------------------------------------------- */

static int no_law(const double *argument, double *value, void *context) {
  (void)argument, (void)context;
  *value = 0.0;
  return 0;
}

static void check_setting(void) {
  const double x[] = {1.0, 2.0, 3.0};
  rotdyn_object *axle = rotdyn_object_new("scene_axle"), *list = rotdyn_object_new("list");
  rotdyn_object *disk = rotdyn_object_new("body_disk");
  ROT_CHECK_EQ_INT(rotdyn_set_number(axle, "bodies", 1.0), ROTDYN_ENAME);
  ROT_CHECK_EQ_INT(rotdyn_set_number(axle, NULL, 1.0), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_number(NULL, "body", 1.0), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_number(list, "body", 1.0), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_number(axle, "resistance", 1.0), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(axle, "theta0_rad", 1, x), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(axle, "axis", 3, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(axle, "axis", 3, x), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_text(axle, "axis", "w"), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_text(axle, "axis", NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_text(axle, "axis", "y"), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_text(axle, "torque", "y"), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_law(axle, "body", no_law, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_law(axle, "torque", NULL, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_law(axle, "torque", no_law, NULL), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_object(axle, "torque", disk), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_object(axle, "torque", axle), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_object(axle, "torque", NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_object(axle, "body", list), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_unset(axle, "torque"), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_unset(axle, "none"), ROTDYN_ENAME);
  /* Parts are copied: what is set later does not change what was given. */
  (void)rotdyn_set_number(disk, "mass_kg", 2.0);
  (void)rotdyn_set_number(disk, "radius_m", 0.5);
  ROT_CHECK_EQ_INT(rotdyn_set_object(axle, "body", disk), ROTDYN_OK);
  (void)rotdyn_set_number(disk, "radius_m", -0.5);
  ROT_CHECK_EQ_INT(rotdyn_object_check(axle, NULL), ROTDYN_OK);
  ROT_CHECK(refused(disk, "radius_m", "at least 0"));
  ROT_CHECK_EQ_INT(rotdyn_set_object(axle, "body", disk), ROTDYN_OK);
  ROT_CHECK(refused(axle, "body", "in body_disk, `radius_m` must be at least 0; it is -0.5"));
  (void)rotdyn_set_number(disk, "radius_m", -0.1);
  (void)rotdyn_set_object(axle, "body", disk);
  ROT_CHECK(refused(axle, "body", "at least 0; it is -0.1"));
  /* Of a report: rows for each time. */
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_object *rotors = rotdyn_object_new("scene_rotors");
  (void)rotdyn_set_numbers(rotors, "bodies", 3, x);
  (void)rotdyn_set_number(rotors, "stiffness_n_m_per_rad", 10.0);
  ROT_CHECK_EQ_INT(rotdyn_object_check(rotors, &report), ROTDYN_OK);
  ROT_CHECK(report.rows_per_time == 3 && report.index && !strcmp(report.index, "rotor"));
  rotdyn_object_free(rotors);
  rotdyn_object_free(axle);
  rotdyn_object_free(list);
  rotdyn_object_free(disk);
  rotdyn_object_free(NULL);
}

static void check_list_objects(void) {
  const double x[] = {1.0, 2.0, 3.0};
  rotdyn_object *rotors = rotdyn_object_new("scene_rotors"), *list = rotdyn_object_new("list");
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  (void)rotdyn_set_number(rotors, "stiffness_n_m_per_rad", 10.0);
  /* A list of numbers is numbers, and the other way round. */
  for (int i = 0; i < 3; i++) ROT_CHECK_EQ_INT(rotdyn_set_number(list, NULL, x[i]), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_object(rotors, "bodies", list), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_object(rotors, "theta0_rad", list), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(rotors, &report), ROTDYN_OK);
  ROT_CHECK_EQ_INT(report.rows_per_time, 3);
  ROT_CHECK_EQ_INT(rotdyn_unset(list, NULL), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_object(rotors, "theta0_rad", list), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_object(rotors, "bodies", list), ROTDYN_OK);
  ROT_CHECK(refused(rotors, "bodies", "item 4 is nothing"));
  ROT_CHECK_EQ_INT(rotdyn_object_check(list, &report), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_text(list, NULL, "z"), ROTDYN_EARGUMENT);
  rotdyn_object *sum = rotdyn_object_new("torque_sum");
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(sum, "laws", 3, x), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(sum, NULL), ROTDYN_OK);
  /* What the input does not take is refused with its place. */
  rotdyn_object *laws = rotdyn_object_new("list"), *pulse = rotdyn_object_new("torque_pulse");
  (void)rotdyn_set_number(pulse, "start_s", 1.0);
  (void)rotdyn_set_number(pulse, "duration_s", -1.0);
  (void)rotdyn_set_number(pulse, "torque_n_m", 1.0);
  (void)rotdyn_set_law(laws, NULL, no_law, NULL);
  (void)rotdyn_set_object(laws, NULL, pulse);
  ROT_CHECK_EQ_INT(rotdyn_set_object(sum, "laws", laws), ROTDYN_OK);
  ROT_CHECK(refused(sum, "laws",
                    "in item 2, in torque_pulse, `duration_s` must be greater than 0; it is -1"));
  ROT_CHECK_EQ_INT(give(laws, NULL, rotdyn_object_new("brake")), ROTDYN_OK);
  (void)rotdyn_set_number(pulse, "duration_s", 1.0);
  rotdyn_object_free(laws);
  laws = rotdyn_object_new("list");
  rotdyn_object *disk = rotdyn_object_new("body_disk");
  (void)rotdyn_set_number(disk, "mass_kg", 1.0);
  (void)rotdyn_set_number(disk, "radius_m", 1.0);
  (void)give(laws, NULL, disk);
  ROT_CHECK_EQ_INT(rotdyn_set_object(sum, "laws", laws), ROTDYN_OK);
  ROT_CHECK(refused(sum, "laws", "item 1 is of a kind that this input does not take"));
  /* Lists in lists, to a depth. */
  int status = ROTDYN_OK, depth = 0;
  while (status == ROTDYN_OK && depth < 100) {
    rotdyn_object *outer = rotdyn_object_new("list");
    status = rotdyn_set_object(outer, NULL, list);
    rotdyn_object_free(list);
    list = outer;
    depth++;
  }
  ROT_CHECK(status == ROTDYN_EARGUMENT && depth > 8 && depth < 100);
  rotdyn_object_free(sum);
  rotdyn_object_free(rotors);
  rotdyn_object_free(list);
  rotdyn_object_free(laws);
  rotdyn_object_free(pulse);
}

/* ---- refusals -------------------------------------------------------------------------------- */

/* Each input on its own: of an object that is right, one number is set wrong. */
static rotdyn_object *right(const char *constructor) {
  static const struct {
    const char *constructor, *input;
    size_t n; /* 0: one number */
    double x[3];
  } values[] = {{"torque_constant", "torque_n_m", 0, {1.0}},
                {"torque_knots", "time_s", 2, {0.0, 1.0}},
                {"torque_knots", "torque_n_m", 2, {1.0, 2.0}},
                {"torque_steps", "time_s", 2, {0.0, 1.0}},
                {"torque_steps", "torque_n_m", 2, {1.0, 2.0}},
                {"torque_pulse", "start_s", 0, {1.0}},
                {"torque_pulse", "duration_s", 0, {1.0}},
                {"torque_pulse", "torque_n_m", 2, {1.0, 2.0}},
                {"torque_polynomial", "breaks_s", 2, {0.0, 1.0}},
                {"torque_polynomial", "coefficients", 2, {1.0, 2.0}},
                {"torque_sinusoid", "amplitude_n_m", 0, {1.0}},
                {"torque_sinusoid", "angular_frequency_rad_per_s", 0, {1.0}},
                {"torque_exponential", "torque_n_m", 0, {1.0}},
                {"torque_exponential", "decay_per_s", 0, {1.0}},
                {"torque_motor", "stall_torque_n_m", 0, {1.0}},
                {"torque_motor", "no_load_omega_rad_per_s", 0, {10.0}},
                {"torque_curve", "omega_rad_per_s", 2, {0.0, 1.0}},
                {"torque_curve", "torque_n_m", 2, {1.0, 2.0}},
                {"torque_spring", "stiffness_n_m_per_rad", 0, {1.0}},
                {"torque_gravity", "mass_kg", 0, {1.0}},
                {"torque_gravity", "distance_m", 0, {1.0}},
                {"inertia_knots", "time_s", 2, {0.0, 1.0}},
                {"inertia_knots", "moment_of_inertia_kg_m2", 2, {1.0, 2.0}},
                {"coupling_shaft", "stiffness_n_m_per_rad", 0, {1.0}},
                {"coupling_clutch", "capacity_n_m", 0, {1.0}},
                {"coupling_gear", "ratio", 0, {1.0}},
                {"brake", "capacity_n_m", 0, {1.0}},
                {"body_annulus", "mass_kg", 0, {1.0}},
                {"body_annulus", "outer_radius_m", 0, {1.0}},
                {"body_annulus", "inner_radius_m", 0, {0.5}},
                {"body_polygon_plate", "mass_kg", 0, {1.0}},
                {"body_polygon_plate", "radius_m", 0, {1.0}},
                {"body_polygon_plate", "sides", 0, {5.0}},
                {"body_spherical_cap", "mass_kg", 0, {1.0}},
                {"body_spherical_cap", "radius_m", 0, {1.0}},
                {"body_spherical_cap", "height_m", 0, {0.5}},
                {"body_ellipsoid_shell", "semi_x_m", 0, {1.0}},
                {"body_ellipsoid_shell", "semi_y_m", 0, {1.0}},
                {"body_ellipsoid_shell", "semi_z_m", 0, {1.5}},
                {"body_tensor", "mass_kg", 0, {1.0}},
                {"body_tensor", "inertia_kg_m2", 3, {1.0, 1.0, 1.0}},
                {"scene_axle", "body", 0, {1.0}},
                {"scene_rotors", "bodies", 3, {1.0, 2.0, 3.0}},
                {"scene_rotors", "stiffness_n_m_per_rad", 0, {1.0}},
                {"scene_clutch", "body_1", 0, {1.0}},
                {"scene_clutch", "body_2", 0, {1.0}},
                {"scene_clutch", "capacity_n_m", 0, {1.0}},
                {"scene_drive", "bodies", 2, {1.0, 2.0}}};
  rotdyn_object *object = rotdyn_object_new(constructor);
  for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
    if (strcmp(values[i].constructor, constructor)) continue;
    ROT_CHECK_EQ_INT(values[i].n
                         ? rotdyn_set_numbers(object, values[i].input, values[i].n, values[i].x)
                         : rotdyn_set_number(object, values[i].input, values[i].x[0]),
                     ROTDYN_OK);
  }
  if (!strcmp(constructor, "scene_drive")) (void)give(object, "couplings", right("coupling_shaft"));
  return object;
}

static void check_refusals(void) {
  static const struct {
    const char *constructor, *input;
    size_t n;
    double x[3];
    const char *words;
  } wrong[] = {
      {"torque_constant", "torque_n_m", 0, {NAN}, "finite"},
      {"torque_knots", "time_s", 2, {1.0, 0.0}, "back in time"},
      {"torque_knots", "time_s", 2, {-1e308, 1e308}, "finite time"},
      {"torque_knots", "time_s", 1, {1.0}, "two knots"},
      {"torque_knots", "torque_n_m", 1, {1.0}, "as many"},
      {"torque_knots", "torque_n_m", 2, {1.0, INFINITY}, "item 2 must be finite"},
      {"torque_knots", "outside", 3, {1.0, 2.0, 3.0}, "two numbers"},
      {"torque_steps", "time_s", 2, {0.0, 0.0}, "increase"},
      {"torque_steps", "time_s", 3, {0.0, 1.0, 2.0}, "as many"},
      {"torque_pulse", "duration_s", 0, {0.0}, "greater than 0"},
      {"torque_pulse", "duration_s", 0, {1e-17}, "shorter"},
      {"torque_pulse", "start_s", 3, {1.0, 2.0, 3.0}, "must have 1 or 3"},
      {"torque_polynomial", "breaks_s", 3, {0.0, 1.0, 2.0}, "a row for each"},
      {"torque_polynomial", "breaks_s", 1, {0.0}, "two times"},
      {"torque_sinusoid", "from_s", 0, {INFINITY}, "before `to_s`"},
      {"torque_sinusoid", "from_s", 0, {NAN}, "number, or Inf"},
      {"torque_exponential", "from_s", 0, {-INFINITY}, "finite"},
      {"torque_exponential", "to_s", 0, {-1.0}, "before `to_s`"},
      {"torque_motor", "no_load_omega_rad_per_s", 0, {-10.0}, "sign"},
      {"torque_motor", "no_load_omega_rad_per_s", 0, {0.0}, "must not be 0"},
      {"torque_curve", "omega_rad_per_s", 2, {1.0, 0.0}, "increase"},
      {"torque_curve", "omega_rad_per_s", 1, {1.0}, "two points"},
      {"torque_spring", "stiffness_n_m_per_rad", 0, {0.0}, "greater than 0"},
      {"torque_gravity", "mass_kg", 0, {-1.0}, "at least 0"},
      {"torque_gravity", "mass_kg", 0, {1e308}, "beyond double precision"},
      {"inertia_knots", "moment_of_inertia_kg_m2", 2, {1.0, 0.0}, "item 2 must be greater than 0"},
      {"inertia_knots", "moment_of_inertia_kg_m2", 3, {1.0, 1.0, 1.0}, "2 numbers"},
      {"inertia_knots", "time_s", 2, {1.0, 0.0}, "back in time"},
      {"inertia_knots", "time_s", 1, {1.0}, "two knots"},
      {"resistance", "quadratic_n_m_s2", 0, {-1.0}, "at least 0"},
      {"coupling_shaft", "ratio", 0, {0.0}, "must not be 0"},
      {"coupling_clutch", "capacity_n_m", 0, {-1.0}, "at least 0"},
      {"coupling_clutch", "static_ratio", 0, {0.5}, "at least 1"},
      {"coupling_clutch", "ratio", 0, {0.0}, "must not be 0"},
      {"coupling_gear", "efficiency", 0, {0.0}, "greater than 0"},
      {"coupling_gear", "efficiency", 0, {1.5}, "at most 1"},
      {"brake", "from_s", 0, {INFINITY}, "before"},
      {"body_annulus", "inner_radius_m", 0, {1.5}, "at most `outer_radius_m`"},
      {"body_annulus", "areal_density_kg_m2", 0, {1.0}, "so is the mass"},
      {"body_polygon_plate", "sides", 0, {2.0}, "at least 3"},
      {"body_polygon_plate", "sides", 0, {4.5}, "whole number"},
      {"body_spherical_cap", "height_m", 0, {2.5}, "twice `radius_m`"},
      {"body_ellipsoid_shell", "areal_density_kg_m2", 0, {1.0}, "or none"},
      {"body_tensor", "inertia_kg_m2", 3, {1.0, 1.0, 3.0}, "of no body"},
      {"body_tensor", "inertia_kg_m2", 2, {1.0, 1.0}, "3 or 6 numbers"},
      {"scene_axle", "body", 0, {0.0}, "greater than 0"},
      {"scene_axle", "axis", 3, {0.0, 0.0, 0.0}, "must not be 0"},
      {"scene_axle", "axis", 2, {0.0, 1.0}, "3 numbers"},
      {"scene_rotors", "bodies", 3, {1.0, -1.0, 1.0}, "item 2"},
      {"scene_rotors", "stiffness_n_m_per_rad", 3, {1.0, 1.0, 1.0}, "must have 1 or 2"},
      {"scene_rotors", "stiffness_n_m_per_rad", 0, {-1.0}, "at least 0"},
      {"scene_rotors", "torque", 0, {1.0}, "each of the 3"},
      {"scene_rotors", "theta0_rad", 2, {1.0, 2.0}, "must have 1 or 3"},
      {"scene_clutch", "static_capacity_n_m", 0, {0.5}, "at least the slipping capacity"},
      {"scene_clutch", "engage_s", 0, {INFINITY}, "or -Inf"},
      {"scene_clutch", "body_2", 0, {-2.0}, "greater than 0"},
      {"scene_drive", "bodies", 3, {1.0, -2.0, 1.0}, "item 2"},
      {"scene_drive", "torque", 3, {1.0, 2.0, 3.0}, "each of the 2"},
      {"scene_drive", "torque", 0, {1.0}, "each of the 2"},
      {"scene_drive", "omega0_rad_per_s", 3, {1.0, 2.0, 3.0}, "must have 1 or 2"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    rotdyn_object *object = right(wrong[i].constructor);
    const size_t n = wrong[i].n;
    ROT_CHECK_EQ_INT(rotdyn_object_check(object, NULL),
                     strcmp(wrong[i].constructor, "body_ellipsoid_shell") ? ROTDYN_OK
                                                                          : ROTDYN_EARGUMENT);
    ROT_CHECK_EQ_INT(n ? rotdyn_set_numbers(object, wrong[i].input, n, wrong[i].x)
                       : rotdyn_set_number(object, wrong[i].input, wrong[i].x[0]),
                     ROTDYN_OK);
    ROT_CHECK(refused(object, NULL, wrong[i].words));
    rotdyn_object_free(object);
  }
}

/* Capacities: one table below 0 is refused, a sum or another law with values below 0 is not. */
static void check_capacities(void) {
  static const double time_s[] = {0.0, 1.0, 2.0}, values[] = {1.0, -0.5, 1.0};
  static const char *const makers[] = {"brake", "coupling_clutch"};
  for (size_t i = 0; i < 2; i++) {
    rotdyn_object *part = rotdyn_object_new(makers[i]), *knots = rotdyn_object_new("torque_knots");
    rotdyn_object *list = rotdyn_object_new("list"), *wave = rotdyn_object_new("torque_sinusoid");
    rotdyn_object *sum = rotdyn_object_new("torque_sum");
    (void)rotdyn_set_numbers(knots, "time_s", 3, time_s);
    (void)rotdyn_set_numbers(knots, "torque_n_m", 3, values);
    (void)rotdyn_set_object(part, "capacity_n_m", knots);
    ROT_CHECK(refused(part, "capacity_n_m", "at least 0 at all knots; it falls to -0.5"));
    (void)rotdyn_set_object(list, NULL, knots);
    (void)rotdyn_set_number(list, NULL, 2.0);
    (void)rotdyn_set_object(sum, "laws", list);
    (void)rotdyn_set_object(part, "capacity_n_m", sum);
    ROT_CHECK_EQ_INT(rotdyn_object_check(part, NULL), ROTDYN_OK);
    (void)rotdyn_set_number(wave, "amplitude_n_m", 1.0);
    (void)rotdyn_set_number(wave, "angular_frequency_rad_per_s", 2.0);
    (void)rotdyn_set_object(part, "capacity_n_m", wave);
    ROT_CHECK_EQ_INT(rotdyn_object_check(part, NULL), ROTDYN_OK);
    rotdyn_object_free(wave);
    rotdyn_object_free(sum);
    rotdyn_object_free(list);
    rotdyn_object_free(knots);
    rotdyn_object_free(part);
  }
}

/* Rows of a polynomial and of a tensor. */
static void check_rows(void) {
  const double row[] = {1.0, 2.0, 3.0},
               moments[3][3] = {{2.0, 0.1, 0.0}, {0.1, 2.0, 0.0}, {0.0, 0.0, 3.0}};
  rotdyn_object *law = rotdyn_object_new("torque_polynomial"), *list = rotdyn_object_new("list");
  (void)rotdyn_set_numbers(law, "breaks_s", 3, row);
  (void)rotdyn_set_numbers(list, NULL, 2, row);
  (void)rotdyn_set_object(law, "coefficients", list);
  ROT_CHECK(refused(law, "coefficients", "a row for each of the 2 pieces; it has 1"));
  (void)rotdyn_set_numbers(list, NULL, 2, row);
  (void)rotdyn_set_object(law, "coefficients", list);
  ROT_CHECK_EQ_INT(rotdyn_object_check(law, NULL), ROTDYN_OK);
  (void)rotdyn_set_numbers(law, "breaks_s", 2, row);
  ROT_CHECK(refused(law, "coefficients", "a row for each of the 1 pieces; it has 2"));
  rotdyn_object_free(list);
  list = rotdyn_object_new("list");
  rotdyn_object *body = rotdyn_object_new("body_tensor");
  (void)rotdyn_set_number(body, "mass_kg", 1.0);
  for (int i = 0; i < 3; i++) {
    (void)rotdyn_set_object(body, "inertia_kg_m2", list);
    ROT_CHECK(refused(body, "inertia_kg_m2", "3 symmetric rows"));
    (void)rotdyn_set_numbers(list, NULL, 3, moments[i]);
  }
  (void)rotdyn_set_object(body, "inertia_kg_m2", list);
  ROT_CHECK_EQ_INT(rotdyn_object_check(body, NULL), ROTDYN_OK);
  const double skew[] = {2.0, 0.2, 0.0, 0.1, 2.0, 0.0, 0.0, 0.0, 3.0};
  (void)rotdyn_set_numbers(body, "inertia_kg_m2", 9, skew);
  ROT_CHECK(refused(body, "inertia_kg_m2", "3 symmetric rows"));
  rotdyn_object_free(list);
  rotdyn_object_free(body);
  rotdyn_object_free(law);
}

/* ---- runs that are asked wrongly ------------------------------------------------------------- */

static void check_wrong_runs(void) {
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK_EQ_INT(rotdyn_scene_run(NULL, 0, NULL, NULL, 0, 0, NULL, NULL, &report),
                   ROTDYN_EARGUMENT);
  rotdyn_object *scene = right("scene_rotors");
  const double end = 1.0;
  const char *name = "theta_rad";
  double value[3], *columns[] = {value};
#define RUN(n, time, room, names, to)                                                              \
  rotdyn_scene_run(scene, n, time, NULL, room, 1, names, to, &report)
  ROT_CHECK_EQ_INT(RUN(1, NULL, 3, &name, columns), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(RUN(1, &end, 3, NULL, columns), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(RUN(1, &end, 3, &name, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(RUN(1, &end, 2, &name, columns), ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(report.reason, "no room"));
  ROT_CHECK_EQ_INT(RUN(1, &end, 3, &name, columns), ROTDYN_OK);
  rotdyn_object *disk = rotdyn_object_new("body_disk");
  ROT_CHECK_EQ_INT(rotdyn_scene_run(disk, 0, NULL, NULL, 0, 0, NULL, NULL, &report),
                   ROTDYN_EARGUMENT);
  report.size = 3;
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_object_check(NULL, NULL), ROTDYN_EARGUMENT);
  rotdyn_object_free(disk);
  rotdyn_object_free(scene);
}

/* Far from zero the end of a pulse is a rounded number, 1e-13 of its duration off: the impulse
 * is torque times duration all the same. */
static void check_pulse(void) {
  static const double start_s[] = {0.0, 10.0, 1000.0, 1e6};
  for (int i = 0; i < 4; i++) {
    rotdyn_object *scene = rotdyn_object_new("scene_axle"), *pulse;
    const double end = 2.0 * start_s[i] + 1.0;
    const char *name = "omega_rad_per_s";
    double value[1], *columns[] = {value};
    pulse = rotdyn_object_new("torque_pulse");
    (void)rotdyn_set_number(pulse, "start_s", start_s[i]);
    (void)rotdyn_set_number(pulse, "duration_s", 0.1);
    (void)rotdyn_set_number(pulse, "torque_n_m", 2.0);
    (void)rotdyn_set_number(scene, "body", 1.0);
    (void)rotdyn_set_object(scene, "torque", pulse);
    ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 1, &end, NULL, 1, 1, &name, columns, NULL), ROTDYN_OK);
    ROT_CHECK_ULP(value[0], 0.2, 2);
    rotdyn_object_free(pulse);
    rotdyn_object_free(scene);
  }
}

int main(void) {
  check_lists();
  check_shapes();
  check_setting();
  check_list_objects();
  check_refusals();
  check_capacities();
  check_rows();
  check_wrong_runs();
  check_pulse();
  return rot_test_report("api object");
}
