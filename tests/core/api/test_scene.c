/* Scenes by name through the C interface: lists of inputs, refusals, rows against closed forms and
 * against the core's own run, laws, damaged calls. */
#include "api/scene.h"

#include <stdint.h>
#include <stdlib.h>

#include "rot_test.h"
#include "scene/incline/incline.h"
#include "scene/pivot/pivot.h"

#ifndef _WIN32
#include <pthread.h>
#endif

#define NAME "scene_incline"

/* A solid sphere: I = 2/5 m r^2. */
static rotdyn_body sphere(double mass_kg, double radius_m) {
  rotdyn_body body = ROTDYN_INIT(rotdyn_body);
  const double I = 0.4 * mass_kg * radius_m * radius_m;
  body.mass_kg = mass_kg;
  body.radius_m = radius_m;
  for (int i = 0; i < 3; i++) body.inertia_kg_m2[i] = I;
  return body;
}

static rotdyn_scene *slope(double angle_deg) {
  const rotdyn_body body = sphere(2.0, 0.25);
  rotdyn_scene *scene = rotdyn_scene_new(NAME);
  ROT_CHECK(scene && rotdyn_scene_body(scene, "body", &body) == ROTDYN_OK);
  ROT_CHECK(rotdyn_scene_number(scene, "incline_angle_deg", angle_deg) == ROTDYN_OK);
  return scene;
}

/* One column at one time. */
static double at(const rotdyn_scene *scene, const char *column, double time_s,
                 const rotdyn_options *options, rotdyn_report *report) {
  double value = NAN;
  double *columns[] = {&value};
  report->size = sizeof *report;
  (void)rotdyn_scene_run(scene, 1, &time_s, options, 1, &column, columns, report);
  return value;
}

static int refused(const rotdyn_scene *scene, const char *input, const char *words) {
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const int status = rotdyn_scene_check(scene, &report);
  return status == ROTDYN_EARGUMENT && report.status == status && report.input &&
         !strcmp(report.input, input) && strstr(report.reason, words) != NULL;
}

/* ---- lists ----------------------------------------------------------------------------------- */

static void check_lists(void) {
  size_t n = 0, columns = 0;
  const char *name;
  int inclines = 0;
  while ((name = rotdyn_scene_at(n)) != NULL) {
    rotdyn_input input = ROTDYN_INIT(rotdyn_input);
    size_t i = 0, required = 0;
    for (; rotdyn_input_at(name, i, &input) == ROTDYN_OK; i++) {
      ROT_CHECK(input.name && input.unit && input.kind && input.words && input.low <= input.high);
      required += input.required != 0;
      /* A default lies in the domain. */
      ROT_CHECK(isnan(input.otherwise) ||
                (input.otherwise >= input.low && input.otherwise <= input.high));
    }
    ROT_CHECK(i > 0 && required > 0 && rotdyn_input_at(name, i, &input) == ROTDYN_EEND);
    inclines += !strcmp(name, NAME);
    n++;
  }
  ROT_CHECK(n > 0 && inclines == 1);
  while (rotdyn_column_at(NAME, columns)) columns++;
  ROT_CHECK(columns == 14 && !rotdyn_column_at("scene_none", 0) && !rotdyn_column_at(NULL, 0));
  ROT_CHECK(rotdyn_input_at("scene_none", 0, NULL) == ROTDYN_EARGUMENT);
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  ROT_CHECK(rotdyn_input_at("scene_none", 0, &input) == ROTDYN_ENAME);
  ROT_CHECK(!rotdyn_scene_new("scene_none") && !rotdyn_scene_new(NULL));
}

/* ---- inputs ---------------------------------------------------------------------------------- */

static void check_refusals(void) {
  rotdyn_scene *empty = rotdyn_scene_new(NAME), *scene = slope(20.0);
  rotdyn_body body = sphere(2.0, 0.25);
  ROT_CHECK(refused(empty, "body", "missing"));
  ROT_CHECK(rotdyn_scene_check(scene, NULL) == ROTDYN_OK);
  ROT_CHECK(rotdyn_scene_number(scene, "angle", 1.0) == ROTDYN_ENAME);
  ROT_CHECK(rotdyn_scene_number(scene, "body", 1.0) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_number(NULL, "body", 1.0) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_number(scene, NULL, 1.0) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_body(scene, "radius_m", &body) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_numbers(scene, "radius_m", 0, NULL) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_law(scene, "force_n", NULL, NULL) == ROTDYN_EARGUMENT);

  const struct {
    const char *input;
    double value;
    const char *words;
  } wrong[] = {
      {"incline_angle_deg", 90.5, "at most 90"}, {"incline_angle_deg", -91.0, "at least -90"},
      {"incline_angle_deg", NAN, "finite"},      {"static_friction", -0.1, "at least 0"},
      {"static_friction", -INFINITY, "Inf"},     {"rolling_arm_m", INFINITY, "finite"},
      {"radius_m", 0.0, "greater than 0"},       {"gravity_m_per_s2", -1.0, "at least 0"},
      {"drag_n_s_per_m", -1.0, "at least 0"},    {"start_s", INFINITY, "finite"},
      {"v0_m_per_s", 1e308, "double precision"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    ROT_CHECK(rotdyn_scene_number(scene, wrong[i].input, wrong[i].value) == ROTDYN_OK);
    ROT_CHECK(refused(scene, wrong[i].input, wrong[i].words));
    ROT_CHECK(rotdyn_scene_unset(scene, wrong[i].input) == ROTDYN_OK);
    if (!strcmp(wrong[i].input, "incline_angle_deg")) {
      ROT_CHECK(refused(scene, "incline_angle_deg", "missing"));
      (void)rotdyn_scene_number(scene, "incline_angle_deg", 20.0);
    }
  }
  (void)rotdyn_scene_number(scene, "radius_m", 1e-200);
  ROT_CHECK(refused(scene, "body", "I/(m r^2)"));
  (void)rotdyn_scene_unset(scene, "radius_m");
  (void)rotdyn_scene_number(scene, "omega0_rad_per_s", 1.0);
  ROT_CHECK(refused(scene, "kinetic_friction", "slips"));
  (void)rotdyn_scene_number(scene, "static_friction", 0.2);
  (void)rotdyn_scene_number(scene, "kinetic_friction", 0.3);
  ROT_CHECK(refused(scene, "kinetic_friction", "at most"));
  (void)rotdyn_scene_unset(scene, "kinetic_friction");
  const double breaks[] = {1.0, 2.0, 2.0};
  ROT_CHECK(rotdyn_scene_numbers(scene, "force_breaks_s", 3, breaks) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "force_breaks_s", "increase"));
  ROT_CHECK(rotdyn_scene_numbers(scene, "force_breaks_s", 2, breaks) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "force_breaks_s", "force"));
  ROT_CHECK(rotdyn_scene_unset(scene, "force_breaks_s") == ROTDYN_OK);
  body.mass_kg = 0.0;
  ROT_CHECK(rotdyn_scene_body(scene, "body", &body) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "body", "mass"));
  body = sphere(2.0, 0.25);
  body.radius_m = 0.0;
  ROT_CHECK(rotdyn_scene_body(scene, "body", &body) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "radius_m", "missing"));
  rotdyn_scene_free(empty);
  rotdyn_scene_free(scene);
  rotdyn_scene_free(NULL);
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* Rolls: v = 5/7 g sin(30) t. Slides on 60 degrees: v = g (sin - mu cos) t. */
static void check_closed_forms(void) {
  rotdyn_report report;
  rotdyn_scene *scene = slope(30.0);
  ROT_CHECK_ULP(at(scene, "v_m_per_s", 2.0, NULL, &report), 9.80665 / 1.4, 4);
  ROT_CHECK(report.status == ROTDYN_OK && report.error_is_bound && report.error < 2e-14);
  ROT_CHECK(report.model && !strcmp(report.model, "incline_exact") && report.rows_done == 1);
  ROT_CHECK(report.n_measures == 4 && !strcmp(report.measure[1], "v"));
  ROT_CHECK(at(scene, "rolling", 2.0, NULL, &report) == 1.0);
  ROT_CHECK(at(scene, "drag_force_n", 2.0, NULL, &report) == 0.0);
  (void)rotdyn_scene_number(scene, "incline_angle_deg", 60.0);
  (void)rotdyn_scene_number(scene, "static_friction", 0.1);
  ROT_CHECK_REL(at(scene, "v_m_per_s", 2.0, NULL, &report),
                2.0 * 9.80665 * (0.86602540378443864676 - 0.1 * 0.5), 1e-15);
  ROT_CHECK(at(scene, "rolling", 2.0, NULL, &report) == 0.0);
  /* Before the start no model runs; beyond what one promises none does. */
  (void)at(scene, "v_m_per_s", -1.0, NULL, &report);
  ROT_CHECK(report.status == ROTDYN_EMODEL && strstr(report.reason, "backwards"));
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  options.accuracy = 1e-16;
  (void)at(scene, "v_m_per_s", 2.0, &options, &report);
  ROT_CHECK(report.status == ROTDYN_EACCURACY && strstr(report.reason, "8e-15"));
  options.accuracy = 2.0;
  (void)at(scene, "v_m_per_s", 2.0, &options, &report);
  ROT_CHECK(report.status == ROTDYN_EARGUMENT && strstr(report.reason, "accuracy"));
  rotdyn_scene_free(scene);
}

/* All columns, with slip that ends, are those of the core's run to the last bit. */
static void check_bits(void) {
  enum { ROWS = 50 };
  rotdyn_scene *scene = slope(10.0);
  double time_s[ROWS], own[12][ROWS];
  int rolling[ROWS];
  const rot_incline_params p = {.mass_kg = 2.0,
                                .radius_m = 0.25,
                                .inertia_kg_m2 = 0.4 * 2.0 * 0.25 * 0.25,
                                .angle_deg = 10.0,
                                .gravity_m_per_s2 = 9.80665,
                                .mu_kinetic = 0.15,
                                .mu_static = 0.2,
                                .arm_m = 0.001,
                                .v0_m_per_s = 3.0,
                                .omega0_rad_per_s = -2.0};
  for (int i = 0; i < ROWS; i++) time_s[i] = 0.07 * i;
  rot_incline_columns out;
  out.x_m = own[0], out.v_m_per_s = own[1], out.theta_rad = own[2], out.omega_rad_per_s = own[3];
  out.slip_speed_m_per_s = own[4], out.friction_force_n = own[5];
  out.translational_kinetic_energy_j = own[6], out.rotational_kinetic_energy_j = own[7];
  out.potential_energy_j = own[8], out.slip_heat_j = own[9], out.rolling_heat_j = own[10];
  out.rolling = rolling;
  rot_info info;
  ROT_CHECK(rot_incline_run(&p, ROWS, time_s, &out, NULL, NULL, NULL, &info) == ROT_OK);
  (void)rotdyn_scene_number(scene, "static_friction", 0.2);
  (void)rotdyn_scene_number(scene, "kinetic_friction", 0.15);
  (void)rotdyn_scene_number(scene, "rolling_arm_m", 0.001);
  (void)rotdyn_scene_number(scene, "v0_m_per_s", 3.0);
  (void)rotdyn_scene_number(scene, "omega0_rad_per_s", -2.0);
  double got[12][ROWS];
  const char *names[12];
  double *columns[12];
  for (size_t i = 0; i < 12; i++) names[i] = rotdyn_column_at(NAME, i), columns[i] = got[i];
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  double event_s[4];
  const char *event[4];
  rotdyn_events events = {.size = sizeof events, .room = 4, .time_s = event_s, .name = event};
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  options.events = &events;
  ROT_CHECK(rotdyn_scene_run(scene, ROWS, time_s, &options, 12, names, columns, &report) ==
            ROTDYN_OK);
  for (size_t i = 0; i < 11; i++) ROT_CHECK(!memcmp(got[i], own[i], sizeof own[i]));
  for (int i = 0; i < ROWS; i++) ROT_CHECK(got[11][i] == rolling[i]);
  ROT_CHECK(rolling[0] == 0 && rolling[ROWS - 1] == 1);
  ROT_CHECK(events.count == 1 && !strcmp(event[0], "roll") && event_s[0] > 0.0);
  rotdyn_scene_free(scene);
}

/* ---- laws ------------------------------------------------------------------------------------ */

typedef struct count {
  int calls, stop_at;
} count;

/* 7 N from 1 s on. */
static int push(const double *argument, double *value, void *context) {
  count *c = context;
  *value = argument[0] < 1.0 ? 0.0 : 7.0;
  return ++c->calls == c->stop_at;
}

/* It rolls on the level: 7/5 m v' = F. */
static void check_law(void) {
  rotdyn_report report;
  rotdyn_scene *scene = slope(0.0);
  count c = {0, 0};
  const double breaks[] = {1.0};
  ROT_CHECK(rotdyn_scene_law(scene, "force_n", push, &c) == ROTDYN_OK);
  ROT_CHECK(rotdyn_scene_numbers(scene, "force_breaks_s", 1, breaks) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "v_m_per_s", 3.0, NULL, &report), 7.0 / 2.8 * 2.0, 1e-12);
  ROT_CHECK(c.calls > 0 && report.law_calls > 0 && !report.error_is_bound);
  ROT_CHECK(report.model && !strcmp(report.model, "incline_rk8pd"));
  ROT_CHECK(at(scene, "applied_force_n", 3.0, NULL, &report) == 7.0);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  options.model = "incline_radau";
  ROT_CHECK_REL(at(scene, "v_m_per_s", 3.0, &options, &report), 7.0 / 2.8 * 2.0, 1e-12);
  ROT_CHECK(!strcmp(report.model, "incline_radau"));
  options.model = "incline_exact";
  (void)at(scene, "v_m_per_s", 3.0, &options, &report);
  ROT_CHECK(report.status == ROTDYN_EMODEL && strstr(report.reason, "a force along the slope"));
  options.model = "none";
  (void)at(scene, "v_m_per_s", 3.0, &options, &report);
  ROT_CHECK(report.status == ROTDYN_EMODEL && strstr(report.reason, "no model"));
  c = (count){0, 5};
  (void)at(scene, "v_m_per_s", 3.0, NULL, &report);
  ROT_CHECK(report.status == ROTDYN_ESTOPPED);
  /* The candidates: the closed form does not take the force. */
  rotdyn_candidate candidate = ROTDYN_INIT(rotdyn_candidate);
  const double time_s = 3.0;
  size_t k = 0, fit = 0;
  for (; rotdyn_scene_candidate(scene, 1, &time_s, NULL, k, &candidate) == ROTDYN_OK; k++) {
    fit += candidate.applies != 0;
    ROT_CHECK(candidate.applies == (strcmp(candidate.model, "incline_exact") != 0));
  }
  ROT_CHECK(k == 3 && fit == 2);
  rotdyn_scene_free(scene);
}

/* ---- bodies in space ------------------------------------------------------------------------- */

/* A body of moments 1, 1, 2 about its centre of mass. Without checks: threads call it. */
static rotdyn_scene *spinning(const char *constructor, const double omega0[3], double lever_m) {
  rotdyn_scene *scene = rotdyn_scene_new(constructor);
  rotdyn_body body = ROTDYN_INIT(rotdyn_body);
  body.mass_kg = 0.5;
  body.centre_m[2] = lever_m;
  body.inertia_kg_m2[0] = body.inertia_kg_m2[1] = 1.0;
  body.inertia_kg_m2[2] = 2.0;
  (void)rotdyn_scene_body(scene, "body", &body);
  (void)rotdyn_scene_numbers(scene, "omega0_rad_per_s", 3, omega0);
  return scene;
}

/* omega turns in the body at (I3 - I1)/I1 omega3 = 2 rad/s. */
static void check_free(void) {
  const double omega0[] = {0.3, 0.0, 2.0}, torque[] = {0.0, 0.0, 0.7};
  const double across[] = {0.0, 3.0, 4.0};
  rotdyn_report report;
  rotdyn_scene *scene = spinning("scene_free", omega0, 0.0);
  ROT_CHECK_REL(at(scene, "omega_x_rad_per_s", 0.7, NULL, &report), 0.3 * cos(1.4), 4e-16);
  ROT_CHECK_REL(at(scene, "omega_y_rad_per_s", 0.7, NULL, &report), 0.3 * sin(1.4), 4e-16);
  ROT_CHECK(!strcmp(report.model, "free_exact") && report.error_is_bound && report.error < 1e-13);
  /* A torque about the axis: omega3 = 2 + 0.35 t. */
  ROT_CHECK(rotdyn_scene_numbers(scene, "torque_n_m", 3, torque) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 2.0, NULL, &report), 2.7, 1e-11);
  ROT_CHECK(!strcmp(report.model, "free_rk8pd") && !report.error_is_bound);
  /* In axes of space, of a body turned over: against it. */
  const double over[] = {0.0, 2.0, 0.0, 0.0};
  (void)rotdyn_scene_unset(scene, "omega0_rad_per_s");
  ROT_CHECK(refused(scene, "omega0_rad_per_s", "missing"));
  const double along[] = {0.0, 0.0, 2.0};
  (void)rotdyn_scene_numbers(scene, "omega0_rad_per_s", 3, along);
  ROT_CHECK(rotdyn_scene_numbers(scene, "attitude0", 4, over) == ROTDYN_OK);
  ROT_CHECK(rotdyn_scene_text(scene, "torque_axes", "space") == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 2.0, NULL, &report), 1.3, 1e-11);
  ROT_CHECK(rotdyn_scene_text(scene, "torque_axes", "moon") == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_text(scene, "torque_axes", NULL) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_text(scene, "attitude0", "space") == ROTDYN_EARGUMENT);
  /* Steps of fixed length only where they are named. */
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  options.model = "free_rk4";
  options.accuracy = 1.0;
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 2.0, &options, &report), 1.3, 1e-6);
  ROT_CHECK(!strcmp(report.model, "free_rk4"));
  const double none[] = {0.0, 0.0, 0.0, 0.0};
  (void)rotdyn_scene_numbers(scene, "attitude0", 4, none);
  ROT_CHECK(refused(scene, "attitude0", "not be 0"));
  (void)rotdyn_scene_numbers(scene, "attitude0", 3, none);
  ROT_CHECK(refused(scene, "attitude0", "4 numbers"));
  (void)rotdyn_scene_unset(scene, "attitude0");
  /* Turned axes: omega along a principal axis of a tensor that is not diagonal stays. */
  rotdyn_body body = ROTDYN_INIT(rotdyn_body);
  const double tensor[] = {2.0, 1.64, 1.36, 0.0, 0.0, -0.48}; /* 1 about (0, 3, 4)/5, 2 across */
  memcpy(body.inertia_kg_m2, tensor, sizeof tensor);
  body.mass_kg = 1.0;
  (void)rotdyn_scene_body(scene, "body", &body);
  (void)rotdyn_scene_unset(scene, "torque_n_m");
  (void)rotdyn_scene_numbers(scene, "omega0_rad_per_s", 3, across);
  ROT_CHECK_REL(at(scene, "omega_y_rad_per_s", 5.0, NULL, &report), 3.0, 1e-14);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 5.0, NULL, &report), 4.0, 1e-14);
  ROT_CHECK_REL(at(scene, "rotational_kinetic_energy_j", 5.0, NULL, &report), 12.5, 1e-14);
  /* A rod cannot spin about itself. */
  const double rod[] = {1.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  memcpy(body.inertia_kg_m2, rod, sizeof rod);
  (void)rotdyn_scene_body(scene, "body", &body);
  ROT_CHECK(refused(scene, "body", "spin"));
  memset(body.inertia_kg_m2, 0, sizeof rod);
  (void)rotdyn_scene_body(scene, "body", &body);
  ROT_CHECK(refused(scene, "body", "moment of inertia"));
  rotdyn_scene_free(scene);
}

/* Three numbers from eight: the torque about z. */
static int twist(const double *argument, double *value, void *context) {
  const double *size = context;
  value[0] = value[1] = 0.0;
  value[2] = *size * argument[3]; /* omega_z */
  return 0;
}

/* omega_z' = -k omega_z/I3. */
static void check_free_law(void) {
  const double omega0[] = {0.0, 0.0, 2.0};
  double k = -1.0;
  rotdyn_report report;
  rotdyn_scene *scene = spinning("scene_free", omega0, 0.0);
  ROT_CHECK(rotdyn_scene_law(scene, "torque_n_m", twist, &k) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 3.0, NULL, &report), 2.0 * exp(-1.5), 1e-9);
  ROT_CHECK(report.law_calls > 0 && report.error < 1e-9);
  rotdyn_scene_free(scene);
}

/* The bits of the core's own top; and a body that falls: m g l about y, against moments about the
 * point, 1 + m l^2. */
static void check_pivot(void) {
  enum { ROWS = 20 };
  const double omega0[] = {0.1, 0.2, 30.0}, still[] = {0.0, 0.0, 0.0};
  const double tilted[] = {0.92387953251128674, 0.0, 0.38268343236508978, 0.0}; /* 45 degrees */
  rot_free_params p;
  memset(&p, 0, sizeof p);
  p.moment_kg_m2[0] = p.moment_kg_m2[1] = 1.0 + 0.5 * 0.4 * 0.4;
  p.moment_kg_m2[2] = 2.0;
  p.axes[0] = 1.0;
  memcpy(p.omega0_rad_per_s, omega0, sizeof omega0);
  memcpy(p.q0, tilted, sizeof tilted);
  p.lever_n_m[2] = 0.5 * 9.80665 * 0.4;
  const double centre[] = {0.0, 0.0, 0.4};
  rot_pivot_sharpen(&p, 0.5, 9.80665, centre);
  double time_s[ROWS], own[14][ROWS], got[14][ROWS];
  rot_free_columns out;
  size_t k = 0;
  for (int i = 0; i < ROWS; i++) time_s[i] = 0.11 * i;
#define X(type, name) out.name = own[k++];
  ROT_FREE_COLUMNS(X)
#undef X
  rot_info info;
  ROT_CHECK(rot_pivot_top(&p, ROWS, time_s, &out, NULL, NULL, &info) == ROT_OK);
  rotdyn_scene *scene = spinning("scene_pivot", omega0, 0.4);
  (void)rotdyn_scene_numbers(scene, "attitude0", 4, tilted);
  const char *names[14];
  double *columns[14];
  for (size_t i = 0; i < 14; i++)
    names[i] = rotdyn_column_at("scene_pivot", i), columns[i] = got[i];
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK(rotdyn_scene_run(scene, ROWS, time_s, NULL, 14, names, columns, &report) == ROTDYN_OK);
  ROT_CHECK(!strcmp(report.model, "pivot_top"));
  for (size_t i = 0; i < 14; i++) ROT_CHECK(!memcmp(got[i], own[i], sizeof own[i]));
  /* The centre of mass to the right, along x: it falls, about y. */
  const double right[] = {0.70710678118654752, 0.0, 0.70710678118654752, 0.0};
  (void)rotdyn_scene_numbers(scene, "attitude0", 4, right);
  (void)rotdyn_scene_numbers(scene, "omega0_rad_per_s", 3, still);
  ROT_CHECK_REL(at(scene, "omega_y_rad_per_s", 1e-5, NULL, &report),
                1e-5 * 0.5 * 9.80665 * 0.4 / 1.08, 1e-8);
  /* Held at the centre of mass nothing turns it. */
  (void)rotdyn_scene_numbers(scene, "pivot_m", 3, centre);
  ROT_CHECK(at(scene, "omega_y_rad_per_s", 1.0, NULL, &report) == 0.0);
  rotdyn_scene_free(scene);
}

/* Each time is one, and so is its distance from the start. */
static void check_times(void) {
  const double omega0[] = {0.3, 0.0, 2.0};
  const double times[][2] = {{-1e308, 0.0}, {0.0, -1.0}, {NAN, 0.0}, {0.0, INFINITY}};
  const char *column = "omega_z_rad_per_s";
  double value[2], *columns[] = {value};
  rotdyn_scene *scene = spinning("scene_free", omega0, 0.0);
  (void)rotdyn_scene_number(scene, "start_s", 1e308);
  for (int i = 0; i < 4; i++) {
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    ROT_CHECK(rotdyn_scene_run(scene, 2, times[i], NULL, 1, &column, columns, &report) ==
              ROTDYN_EARGUMENT);
    ROT_CHECK(strstr(report.reason, "times") != NULL);
  }
  rotdyn_scene_free(scene);
}

/* ---- damaged calls --------------------------------------------------------------------------- */

/* xorshift64 */
static uint64_t next(void) {
  static uint64_t x = 88172645463325252u;
  x ^= x << 13;
  x ^= x >> 7;
  return x ^= x << 17;
}

static double odd_number(void) {
  static const double odd[] = {0.0,   -1.0,   1.0,    NAN,    INFINITY, -INFINITY,
                               1e308, -1e308, 1e-320, 1e-300, 0.1,      30.0};
  return odd[next() % (sizeof odd / sizeof *odd)];
}

/* Any input, by any of the functions. */
static void set_at_random(rotdyn_scene *scene, const char *constructor) {
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  if (rotdyn_input_at(constructor, next() % 18, &input) != ROTDYN_OK) return;
  double x[5];
  rotdyn_body body = sphere(fabs(odd_number()), odd_number());
  for (int i = 0; i < 5; i++) x[i] = next() % 3 ? 0.3 * i : odd_number();
  if (next() % 4 == 0) body.inertia_kg_m2[next() % 6] = odd_number();
  if (next() % 4 == 0) body.centre_m[next() % 3] = odd_number();
  switch (next() % 6) {
  case 0: (void)rotdyn_scene_number(scene, input.name, odd_number()); break;
  case 1: (void)rotdyn_scene_numbers(scene, input.name, next() % 6, x); break;
  case 2: (void)rotdyn_scene_text(scene, input.name, next() % 2 ? "space" : "none"); break;
  case 3: (void)rotdyn_scene_body(scene, input.name, &body); break;
  case 4: (void)rotdyn_scene_unset(scene, input.name); break;
  default: (void)rotdyn_scene_number(scene, "none", 1.0); break;
  }
}

/* Each ends in a status, or in rows. */
static void check_damaged_calls(void) {
  const int trials = rot_test_trials(6000);
  const double omega0[] = {0.1, 2.0, 0.3};
  size_t ran = 0, scenes = 0;
  while (rotdyn_scene_at(scenes)) scenes++;
  for (int i = 0; i < trials; i++) {
    const char *constructor = rotdyn_scene_at(next() % scenes);
    rotdyn_scene *scene =
        strcmp(constructor, NAME) ? spinning(constructor, omega0, 0.1) : slope(odd_number());
    for (size_t k = next() % 5; k > 0; k--) set_at_random(scene, constructor);
    double time_s[] = {0.0, odd_number()}, value[2] = {NAN, NAN}, *columns[] = {value};
    const char *name = next() % 8 ? rotdyn_column_at(constructor, next() % 14) : "none";
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    rotdyn_options options = ROTDYN_INIT(rotdyn_options);
    options.accuracy = next() % 4 ? 0.0 : odd_number();
    options.max_steps = 1000.0;
    const int status =
        rotdyn_scene_run(scene, next() % 3, time_s, &options, 1, &name, columns, &report);
    ROT_CHECK(status >= ROTDYN_OK && status < ROTDYN_EINTERNAL && report.status == status);
    ROT_CHECK(status == ROTDYN_OK || report.reason[0] || report.model);
    ran += status == ROTDYN_OK;
    rotdyn_scene_free(scene);
  }
  ROT_CHECK(ran > (size_t)trials / 20);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK(rotdyn_scene_run(NULL, 0, NULL, NULL, 0, NULL, NULL, &report) == ROTDYN_EARGUMENT);
  rotdyn_scene *scene = slope(20.0);
  ROT_CHECK(rotdyn_scene_run(scene, 1, NULL, NULL, 0, NULL, NULL, NULL) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_scene_run(scene, 0, NULL, NULL, 1, NULL, NULL, NULL) == ROTDYN_EARGUMENT);
  report.size = 3;
  ROT_CHECK(rotdyn_scene_check(scene, &report) == ROTDYN_EARGUMENT);
  rotdyn_scene_free(scene);
}

/* ---- threads --------------------------------------------------------------------------------- */

#ifndef _WIN32
/* One scene is shared, others are the thread's own. */
typedef struct job {
  const rotdyn_scene *shared;
  double sum;
} job;

static void *run_job(void *of) {
  job *j = of;
  const double omega0[] = {0.01, 6.0, 0.02};
  rotdyn_report report;
  j->sum = 0.0;
  for (int i = 0; i < 50; i++) {
    rotdyn_scene *own = spinning("scene_free", omega0, 0.0);
    j->sum += at(j->shared, "x_m", 0.1 * i, NULL, &report);
    j->sum += at(own, "qw", 0.1 * i, NULL, &report);
    rotdyn_scene_free(own);
  }
  return NULL;
}

static void check_threads(void) {
  enum { THREADS = 4 };
  rotdyn_scene *scene = slope(12.0);
  job alone = {scene, 0.0}, jobs[THREADS];
  pthread_t thread[THREADS];
  (void)rotdyn_scene_number(scene, "drag_n_s_per_m", 0.5);
  (void)run_job(&alone);
  for (int i = 0; i < THREADS; i++) {
    jobs[i] = (job){scene, 0.0};
    ROT_CHECK_EQ_INT(pthread_create(&thread[i], NULL, run_job, &jobs[i]), 0);
  }
  for (int i = 0; i < THREADS; i++) {
    ROT_CHECK_EQ_INT(pthread_join(thread[i], NULL), 0);
    ROT_CHECK(jobs[i].sum == alone.sum);
  }
  rotdyn_scene_free(scene);
}
#else
static void check_threads(void) { ROT_CHECK(1); }
#endif

int main(void) {
  check_lists();
  check_refusals();
  check_closed_forms();
  check_bits();
  check_law();
  check_free();
  check_free_law();
  check_pivot();
  check_times();
  check_damaged_calls();
  check_threads();
  return rot_test_report("api scene");
}
