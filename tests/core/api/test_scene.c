/* Runs of scenes through the C interface: refusals, rows against closed forms and against the
 * core's own run, laws, many scenes, threads. */
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

/* Sets an input to an object, which is freed. */
static int give(rotdyn_object *scene, const char *input, rotdyn_object *object) {
  const int status = rotdyn_set_object(scene, input, object);
  rotdyn_object_free(object);
  return status;
}

static rotdyn_object *sphere(double mass_kg, double radius_m) {
  rotdyn_object *body = rotdyn_object_new("body_sphere");
  (void)rotdyn_set_number(body, "mass_kg", mass_kg);
  (void)rotdyn_set_number(body, "radius_m", radius_m);
  return body;
}

/* Six numbers, or three. */
static rotdyn_object *tensor(double mass_kg, size_t n, const double moments[]) {
  rotdyn_object *body = rotdyn_object_new("body_tensor");
  (void)rotdyn_set_number(body, "mass_kg", mass_kg);
  (void)rotdyn_set_numbers(body, "inertia_kg_m2", n, moments);
  return body;
}

static rotdyn_object *slope(double angle_deg) {
  rotdyn_object *scene = rotdyn_object_new(NAME);
  ROT_CHECK(scene && give(scene, "body", sphere(2.0, 0.25)) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(scene, "incline_angle_deg", angle_deg) == ROTDYN_OK);
  return scene;
}

/* One column at one time. */
static double at(const rotdyn_object *scene, const char *column, double time_s,
                 const rotdyn_options *options, rotdyn_report *report) {
  double value = NAN;
  double *columns[] = {&value};
  report->size = sizeof *report;
  (void)rotdyn_scene_run(scene, 1, &time_s, options, 1, 1, &column, columns, report);
  return value;
}

static int refused(const rotdyn_object *scene, const char *input, const char *words) {
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const int status = rotdyn_object_check(scene, &report);
  return status == ROTDYN_EARGUMENT && report.status == status && report.input &&
         !strcmp(report.input, input) && strstr(report.reason, words) != NULL;
}

/* ---- inputs ---------------------------------------------------------------------------------- */

static void check_refusals(void) {
  rotdyn_object *empty = rotdyn_object_new(NAME), *scene = slope(20.0);
  ROT_CHECK(refused(empty, "body", "missing"));
  ROT_CHECK(rotdyn_object_check(scene, NULL) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(scene, "angle", 1.0) == ROTDYN_ENAME);
  ROT_CHECK(rotdyn_set_number(scene, "body", 1.0) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_set_number(NULL, "body", 1.0) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_set_number(scene, NULL, 1.0) == ROTDYN_EARGUMENT);
  ROT_CHECK(give(scene, "radius_m", sphere(2.0, 0.25)) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_set_numbers(scene, "radius_m", 0, NULL) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_set_law(scene, "force", NULL, NULL) == ROTDYN_EARGUMENT);

  const struct {
    const char *input;
    double value;
    const char *words;
  } wrong[] = {
      {"incline_angle_deg", 90.5, "at most 90"}, {"incline_angle_deg", -91.0, "at least -90"},
      {"incline_angle_deg", NAN, "finite"},      {"static_friction", -0.1, "at least 0"},
      {"static_friction", -INFINITY, "Inf"},     {"rolling_arm_m", INFINITY, "finite"},
      {"radius_m", 0.0, "greater than 0"},       {"gravity_m_per_s2", -1.0, "at least 0"},
      {"start_s", INFINITY, "finite"},           {"v0_m_per_s", 1e308, "double precision"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    ROT_CHECK(rotdyn_set_number(scene, wrong[i].input, wrong[i].value) == ROTDYN_OK);
    ROT_CHECK(refused(scene, wrong[i].input, wrong[i].words));
    ROT_CHECK(rotdyn_unset(scene, wrong[i].input) == ROTDYN_OK);
    if (!strcmp(wrong[i].input, "incline_angle_deg")) {
      ROT_CHECK(refused(scene, "incline_angle_deg", "missing"));
      (void)rotdyn_set_number(scene, "incline_angle_deg", 20.0);
    }
  }
  (void)rotdyn_set_number(scene, "radius_m", 1e-200);
  ROT_CHECK(refused(scene, "body", "I/(m r^2)"));
  (void)rotdyn_unset(scene, "radius_m");
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 1.0);
  ROT_CHECK(refused(scene, "kinetic_friction", "slips"));
  /* A slip of rounding alone is none. The radius is 0.25 m. */
  (void)rotdyn_set_number(scene, "v0_m_per_s", 0.25);
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 1.0 + 1e-13);
  ROT_CHECK(refused(scene, "kinetic_friction", "slips"));
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 1.0 + 4e-16);
  ROT_CHECK(rotdyn_object_check(scene, NULL) == ROTDYN_OK);
  (void)rotdyn_unset(scene, "v0_m_per_s");
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 1.0);
  (void)rotdyn_set_number(scene, "static_friction", 0.2);
  (void)rotdyn_set_number(scene, "kinetic_friction", 0.3);
  ROT_CHECK(refused(scene, "kinetic_friction", "at most"));
  (void)rotdyn_unset(scene, "kinetic_friction");
  const double breaks[] = {1.0, 2.0, 2.0};
  ROT_CHECK(rotdyn_set_numbers(scene, "breaks_s", 3, breaks) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "breaks_s", "increase"));
  ROT_CHECK(rotdyn_set_numbers(scene, "breaks_s", 2, breaks) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "breaks_s", "force"));
  ROT_CHECK(rotdyn_unset(scene, "breaks_s") == ROTDYN_OK);
  ROT_CHECK(give(scene, "body", sphere(0.0, 0.25)) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "body", "mass"));
  const double moments[] = {0.05, 0.05, 0.05};
  ROT_CHECK(give(scene, "body", tensor(2.0, 3, moments)) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "radius_m", "missing"));
  rotdyn_object_free(empty);
  rotdyn_object_free(scene);
  rotdyn_object_free(NULL);
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* Rolls: v = 5/7 g sin(30) t. Slides on 60 degrees: v = g (sin - mu cos) t. */
static void check_closed_forms(void) {
  rotdyn_report report;
  rotdyn_object *scene = slope(30.0);
  ROT_CHECK_ULP(at(scene, "v_m_per_s", 2.0, NULL, &report), 9.80665 / 1.4, 4);
  ROT_CHECK(report.status == ROTDYN_OK && report.error_is_bound && report.error < 2e-14);
  ROT_CHECK(report.model && !strcmp(report.model, "incline_exact") && report.rows_done == 1);
  ROT_CHECK(report.n_measures == 4 && !strcmp(report.measure[1], "v"));
  ROT_CHECK(at(scene, "rolling", 2.0, NULL, &report) == 1.0);
  ROT_CHECK(at(scene, "drag_force_n", 2.0, NULL, &report) == 0.0);
  (void)rotdyn_set_number(scene, "incline_angle_deg", 60.0);
  (void)rotdyn_set_number(scene, "static_friction", 0.1);
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
  rotdyn_object_free(scene);
}

/* All columns, with slip that ends, are those of the core's run to the last bit. */
static void check_bits(void) {
  enum { ROWS = 50 };
  rotdyn_object *scene = slope(10.0);
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
  (void)rotdyn_set_number(scene, "static_friction", 0.2);
  (void)rotdyn_set_number(scene, "kinetic_friction", 0.15);
  (void)rotdyn_set_number(scene, "rolling_arm_m", 0.001);
  (void)rotdyn_set_number(scene, "v0_m_per_s", 3.0);
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", -2.0);
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
  ROT_CHECK(rotdyn_scene_run(scene, ROWS, time_s, &options, ROWS, 12, names, columns, &report) ==
            ROTDYN_OK);
  for (size_t i = 0; i < 11; i++) ROT_CHECK(!memcmp(got[i], own[i], sizeof own[i]));
  for (int i = 0; i < ROWS; i++) ROT_CHECK(got[11][i] == rolling[i]);
  ROT_CHECK(rolling[0] == 0 && rolling[ROWS - 1] == 1);
  ROT_CHECK(events.count == 1 && !strcmp(event[0], "roll") && event_s[0] > 0.0);
  rotdyn_object_free(scene);
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
  rotdyn_object *scene = slope(0.0);
  count c = {0, 0};
  const double breaks[] = {1.0};
  ROT_CHECK(rotdyn_set_law(scene, "force", push, &c) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "breaks_s", 1, breaks) == ROTDYN_OK);
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
  /* The candidates: the closed form does not take the force; fixed steps have to be named. */
  rotdyn_candidate candidate = ROTDYN_INIT(rotdyn_candidate);
  const double time_s = 3.0;
  size_t k = 0, fit = 0;
  for (; rotdyn_scene_candidate(scene, 1, &time_s, NULL, k, &candidate) == ROTDYN_OK; k++) {
    fit += candidate.applies != 0;
    const int adapts =
        !strcmp(candidate.model, "incline_rk8pd") || !strcmp(candidate.model, "incline_radau");
    ROT_CHECK(candidate.applies == adapts);
  }
  ROT_CHECK(k == 6 && fit == 2);
  rotdyn_object_free(scene);
}

/* ---- lists of numbers ------------------------------------------------------------------------ */

/* A chain: rows for each link. */
static void check_numbers(void) {
  enum { LINKS = 3, TIMES = 2 };
  const double length[LINKS] = {1.0, 0.5, 0.25}, mass = 2.0, theta0[LINKS] = {0.1, 0.2, 0.3};
  const double time_s[TIMES] = {0.0, 1.0};
  double theta[TIMES * LINKS + 1], kinetic[TIMES * LINKS + 1];
  const char *const names[] = {"theta_rad", "kinetic_energy_j"};
  double *columns[] = {theta, kinetic};
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_object *scene = rotdyn_object_new("scene_chain");
  ROT_CHECK(rotdyn_input_at("scene_chain", 0, &input) == ROTDYN_OK);
  ROT_CHECK(!strcmp(input.name, "length_m") && !strcmp(input.kinds, "numbers"));
  ROT_CHECK(rotdyn_set_number(scene, "length_m", 1.0) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "length_m", LINKS, length) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "mass_kg", 1, &mass) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "theta0_rad", "missing"));
  ROT_CHECK(rotdyn_set_numbers(scene, "theta0_rad", 2, theta0) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "theta0_rad", "one for each length"));
  ROT_CHECK(rotdyn_set_numbers(scene, "theta0_rad", LINKS, theta0) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "resistance", 0, NULL) == ROTDYN_OK);
  ROT_CHECK(refused(scene, "resistance", "it has 0"));
  ROT_CHECK(rotdyn_unset(scene, "resistance") == ROTDYN_OK);
  theta[TIMES * LINKS] = kinetic[TIMES * LINKS] = 7.0;
  ROT_CHECK(rotdyn_scene_run(scene, TIMES, time_s, NULL, TIMES * LINKS, 2, names, columns,
                             &report) == ROTDYN_OK);
  ROT_CHECK(report.rows_done == TIMES && report.error <= 1e-8);
  for (size_t i = 0; i < LINKS; i++) {
    ROT_CHECK(theta[i] == theta0[i] && kinetic[i] == 0.0 && kinetic[LINKS + i] > 0.0);
  }
  ROT_CHECK(theta[TIMES * LINKS] == 7.0 && kinetic[TIMES * LINKS] == 7.0);
  rotdyn_object_free(scene);
}

/* ---- bodies in space ------------------------------------------------------------------------- */

/* A body of moments 1, 1, 2 about its centre of mass. Without checks: threads call it. */
static rotdyn_object *spinning(const char *constructor, const double omega0[3], double lever_m) {
  const double moments[] = {1.0, 1.0, 2.0}, centre[] = {0.0, 0.0, lever_m};
  rotdyn_object *scene = rotdyn_object_new(constructor), *body = tensor(0.5, 3, moments);
  (void)rotdyn_set_numbers(body, "centre_m", 3, centre);
  (void)give(scene, "body", body);
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, omega0);
  return scene;
}

/* omega turns in the body at (I3 - I1)/I1 omega3 = 2 rad/s. */
static void check_free(void) {
  const double omega0[] = {0.3, 0.0, 2.0}, torque[] = {0.0, 0.0, 0.7};
  const double across[] = {0.0, 3.0, 4.0};
  rotdyn_report report;
  rotdyn_object *scene = spinning("scene_free", omega0, 0.0);
  ROT_CHECK_REL(at(scene, "omega_x_rad_per_s", 0.7, NULL, &report), 0.3 * cos(1.4), 4e-16);
  ROT_CHECK_REL(at(scene, "omega_y_rad_per_s", 0.7, NULL, &report), 0.3 * sin(1.4), 4e-16);
  ROT_CHECK(!strcmp(report.model, "free_exact") && report.error_is_bound && report.error < 1e-13);
  /* A torque about the axis: omega3 = 2 + 0.35 t. */
  ROT_CHECK(rotdyn_set_numbers(scene, "torque", 3, torque) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 2.0, NULL, &report), 2.7, 1e-11);
  ROT_CHECK(!strcmp(report.model, "free_rk8pd") && !report.error_is_bound);
  /* In axes of space, of a body turned over: against it. */
  const double over[] = {0.0, 2.0, 0.0, 0.0};
  (void)rotdyn_unset(scene, "omega0_rad_per_s");
  ROT_CHECK(refused(scene, "omega0_rad_per_s", "missing"));
  const double along[] = {0.0, 0.0, 2.0};
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, along);
  ROT_CHECK(rotdyn_set_numbers(scene, "attitude0", 4, over) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_text(scene, "torque_axes", "space") == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 2.0, NULL, &report), 1.3, 1e-11);
  ROT_CHECK(rotdyn_set_text(scene, "torque_axes", "moon") == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_set_text(scene, "torque_axes", NULL) == ROTDYN_EARGUMENT);
  ROT_CHECK(rotdyn_set_text(scene, "attitude0", "space") == ROTDYN_EARGUMENT);
  /* Steps of fixed length only where they are named. */
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  options.model = "free_rk4";
  options.accuracy = 1.0;
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 2.0, &options, &report), 1.3, 1e-6);
  ROT_CHECK(!strcmp(report.model, "free_rk4"));
  const double none[] = {0.0, 0.0, 0.0, 0.0};
  (void)rotdyn_set_numbers(scene, "attitude0", 4, none);
  ROT_CHECK(refused(scene, "attitude0", "not be 0"));
  (void)rotdyn_set_numbers(scene, "attitude0", 3, none);
  ROT_CHECK(refused(scene, "attitude0", "4 numbers"));
  (void)rotdyn_unset(scene, "attitude0");
  /* Turned axes: omega along a principal axis of a tensor that is not diagonal stays. */
  const double turned[] = {2.0, 1.64, 1.36, 0.0, 0.0, -0.48}; /* 1 about (0, 3, 4)/5, 2 across */
  (void)give(scene, "body", tensor(1.0, 6, turned));
  (void)rotdyn_unset(scene, "torque");
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, across);
  ROT_CHECK_REL(at(scene, "omega_y_rad_per_s", 5.0, NULL, &report), 3.0, 1e-14);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 5.0, NULL, &report), 4.0, 1e-14);
  ROT_CHECK_REL(at(scene, "rotational_kinetic_energy_j", 5.0, NULL, &report), 12.5, 1e-14);
  /* A rod cannot spin about itself. */
  const double rod[] = {1.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  (void)give(scene, "body", tensor(1.0, 6, rod));
  ROT_CHECK(refused(scene, "body", "spin"));
  (void)give(scene, "body", tensor(1.0, 3, rod + 3));
  ROT_CHECK(refused(scene, "body", "moment of inertia"));
  rotdyn_object_free(scene);
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
  rotdyn_object *scene = spinning("scene_free", omega0, 0.0);
  ROT_CHECK(rotdyn_set_law(scene, "torque", twist, &k) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 3.0, NULL, &report), 2.0 * exp(-1.5), 1e-9);
  ROT_CHECK(report.law_calls > 0 && report.error < 1e-9);
  rotdyn_object_free(scene);
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
  rotdyn_object *scene = spinning("scene_pivot", omega0, 0.4);
  (void)rotdyn_set_numbers(scene, "attitude0", 4, tilted);
  const char *names[14];
  double *columns[14];
  for (size_t i = 0; i < 14; i++)
    names[i] = rotdyn_column_at("scene_pivot", i), columns[i] = got[i];
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK(rotdyn_scene_run(scene, ROWS, time_s, NULL, ROWS, 14, names, columns, &report) ==
            ROTDYN_OK);
  ROT_CHECK(!strcmp(report.model, "pivot_top"));
  for (size_t i = 0; i < 14; i++) ROT_CHECK(!memcmp(got[i], own[i], sizeof own[i]));
  /* The centre of mass to the right, along x: it falls, about y. */
  const double right[] = {0.70710678118654752, 0.0, 0.70710678118654752, 0.0};
  (void)rotdyn_set_numbers(scene, "attitude0", 4, right);
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, still);
  ROT_CHECK_REL(at(scene, "omega_y_rad_per_s", 1e-5, NULL, &report),
                1e-5 * 0.5 * 9.80665 * 0.4 / 1.08, 1e-8);
  /* Held at the centre of mass nothing turns it. */
  (void)rotdyn_set_numbers(scene, "pivot_m", 3, centre);
  ROT_CHECK(at(scene, "omega_y_rad_per_s", 1.0, NULL, &report) == 0.0);
  rotdyn_object_free(scene);
}

/* Each time is one, and so is its distance from the start. */
static void check_times(void) {
  const double omega0[] = {0.3, 0.0, 2.0};
  const double times[][2] = {{-1e308, 0.0}, {0.0, -1.0}, {NAN, 0.0}, {0.0, INFINITY}};
  const char *column = "omega_z_rad_per_s";
  double value[2], *columns[] = {value};
  rotdyn_object *scene = spinning("scene_free", omega0, 0.0);
  (void)rotdyn_set_number(scene, "start_s", 1e308);
  for (int i = 0; i < 4; i++) {
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    ROT_CHECK(rotdyn_scene_run(scene, 2, times[i], NULL, 2, 1, &column, columns, &report) ==
              ROTDYN_EARGUMENT);
    ROT_CHECK(strstr(report.reason, "times") != NULL);
  }
  /* From the first to the last further than a double reaches. */
  const double far[] = {-1e308, 0.0, 1e308};
  double three[3], *wide[] = {three};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  (void)rotdyn_set_number(scene, "start_s", 0.0);
  ROT_CHECK(rotdyn_scene_run(scene, 3, far, NULL, 3, 1, &column, wide, &report) ==
            ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(report.reason, "times") != NULL);
  rotdyn_object_free(scene);
}

/* ---- axles ----------------------------------------------------------------------------------- */

static const double knot_s[] = {0.0, 1.0, 4.0, 6.0, 8.0}, knot_n_m[] = {0.0, 0.8, 0.8, 0.0, 0.0};

/* An object with some numbers. */
static rotdyn_object *part(const char *constructor, size_t n, const char *const names[],
                           const double x[]) {
  rotdyn_object *object = rotdyn_object_new(constructor);
  for (size_t i = 0; i < n; i++) {
    ROT_CHECK_EQ_INT(rotdyn_set_number(object, names[i], x[i]), ROTDYN_OK);
  }
  return object;
}
static rotdyn_object *axle(double inertia) {
  rotdyn_object *scene = rotdyn_object_new("scene_axle");
  ROT_CHECK_EQ_INT(rotdyn_set_number(scene, "body", inertia), ROTDYN_OK);
  return scene;
}

static void resist(rotdyn_object *scene, const char *name, double value) {
  ROT_CHECK_EQ_INT(give(scene, "resistance", part("resistance", 1, &name, &value)), ROTDYN_OK);
}

/* A disk of 2 kg and 0.25 m under a torque that rises, is constant and falls. */
static rotdyn_object *disk(void) {
  static const char *const names[] = {"mass_kg", "radius_m"};
  static const double sizes[] = {2.0, 0.25};
  rotdyn_object *scene = rotdyn_object_new("scene_axle"),
                *knots = rotdyn_object_new("torque_knots");
  (void)rotdyn_set_numbers(knots, "time_s", 5, knot_s);
  (void)rotdyn_set_numbers(knots, "torque_n_m", 5, knot_n_m);
  ROT_CHECK_EQ_INT(give(scene, "body", part("body_disk", 2, names, sizes)), ROTDYN_OK);
  ROT_CHECK_EQ_INT(give(scene, "torque", knots), ROTDYN_OK);
  resist(scene, "viscous_n_m_s", 0.03);
  return scene;
}

/* theta and omega at one time, and the report. */
typedef struct one {
  double theta, omega;
  int status;
  rotdyn_report report;
} one;

static one state(const rotdyn_object *scene, double time_s, const rotdyn_options *options) {
  static const char *const names[] = {"theta_rad", "omega_rad_per_s"};
  one x = {0};
  double *const columns[] = {&x.theta, &x.omega};
  x.report.size = sizeof x.report;
  x.status = rotdyn_scene_run(scene, 1, &time_s, options, 1, 2, names, columns, &x.report);
  return x;
}

static void check_spin_up(void) {
  const double time_s[] = {0.5, 3.0, 8.0};
  const double theta[] = {0.25140496914891098451, 28.00522306631831973, 107.85864533301710375};
  const double omega[] = {1.4793256148085228207, 18.557492928167208804, 5.8278502401517953138};
  rotdyn_object *scene = disk();
  double x[7][3], alone[3], *columns[7], *few[] = {alone};
  const char *names[7];
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  for (size_t i = 0; i < 7; i++) names[i] = rotdyn_column_at("scene_axle", i), columns[i] = x[i];
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 3, time_s, NULL, 3, 7, names, columns, &report),
                   ROTDYN_OK);
  ROT_CHECK(!strcmp(report.model, "axle_linear") && report.error_is_bound && report.rows_done == 3);
  ROT_CHECK(report.error > 0.0 && report.error < 1e-14 && !*report.reason);
  ROT_CHECK(report.rows_per_time == 1 && !report.index);
  for (int i = 0; i < 3; i++) {
    ROT_CHECK_REL(x[0][i], theta[i], 1e-15);
    ROT_CHECK_REL(x[1][i], omega[i], 1e-15);
    ROT_CHECK_ULP(x[3][i], -0.03 * x[1][i], 0);
    ROT_CHECK_ULP(x[4][i], x[2][i] + x[3][i], 0);
    ROT_CHECK_ULP(x[5][i], 0.0625 * x[1][i], 0);
    ROT_CHECK_REL(x[6][i], 0.5 * 0.0625 * omega[i] * omega[i], 1e-15);
  }
  ROT_CHECK_ULP(x[2][0], 0.4, 0);
  /* The same numbers where columns are left out, without a report, without a row. */
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 3, time_s, NULL, 3, 1, names + 1, few, NULL), ROTDYN_OK);
  ROT_CHECK(!memcmp(alone, x[1], sizeof alone));
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 0, NULL, NULL, 0, 1, names, few, &report), ROTDYN_OK);
  ROT_CHECK_EQ_INT(report.rows_done, 0);
  rotdyn_object_free(scene);
}

/* Each closed form is what the choice takes; references of mpmath, 40 digits. */
static void check_axle_forms(void) {
  static const char *const of_spring[] = {"stiffness_n_m_per_rad"};
  static const char *const of_sinusoid[] = {"amplitude_n_m", "angular_frequency_rad_per_s",
                                            "phase_rad"};
  static const char *const of_gravity[] = {"mass_kg", "distance_m", "gravity_m_per_s2"};
  rotdyn_object *scene = axle(2.0);
  (void)rotdyn_set_number(scene, "theta0_rad", 1.0);
  (void)give(scene, "torque", part("torque_gravity", 3, of_gravity, (double[]){1.0, 2.0, 9.75}));
  one x = state(scene, 1.0, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && !strcmp(x.report.model, "axle_pendulum"));
  ROT_CHECK_REL(x.theta, -0.97827747599739700569, 1e-14);
  ROT_CHECK_REL(x.omega, -0.59491539467318678721, 1e-14);
  (void)rotdyn_set_number(scene, "body", 0.5);
  (void)rotdyn_set_number(scene, "theta0_rad", 0.3);
  resist(scene, "viscous_n_m_s", 0.2);
  (void)give(scene, "torque", part("torque_spring", 1, of_spring, (double[]){8.0}));
  x = state(scene, 2.0, NULL);
  ROT_CHECK(!strcmp(x.report.model, "axle_oscillator"));
  ROT_CHECK_REL(x.theta, -0.017292823763693817845, 1e-13);
  ROT_CHECK_REL(x.omega, -0.79795331558058467284, 1e-14);
  (void)rotdyn_unset(scene, "theta0_rad");
  (void)give(scene, "torque", part("torque_sinusoid", 3, of_sinusoid, (double[]){1.5, 3.0, 0.25}));
  x = state(scene, 2.0, NULL);
  ROT_CHECK(!strcmp(x.report.model, "axle_forced"));
  ROT_CHECK_REL(x.theta, -0.53164406741112678458, 1e-13);
  ROT_CHECK_REL(x.omega, -0.067925548837629020837, 1e-13);
  resist(scene, "quadratic_n_m_s2", 0.25);
  (void)rotdyn_set_number(scene, "torque", 2.0);
  x = state(scene, 0.75, NULL);
  ROT_CHECK(!strcmp(x.report.model, "axle_drag"));
  ROT_CHECK_REL(x.theta, 0.96145700114501991779, 1e-14);
  ROT_CHECK_REL(x.omega, 2.2229072552546211283, 1e-14);
  /* A skater: I omega stays. */
  rotdyn_object *skater = rotdyn_object_new("inertia_knots");
  (void)rotdyn_set_numbers(skater, "time_s", 2, (double[]){0.0, 1.0});
  (void)rotdyn_set_numbers(skater, "moment_of_inertia_kg_m2", 2, (double[]){3.0, 1.0});
  (void)give(scene, "body", skater);
  (void)rotdyn_unset(scene, "torque");
  (void)rotdyn_unset(scene, "resistance");
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 2.0);
  x = state(scene, 1.0, NULL);
  ROT_CHECK(!strcmp(x.report.model, "axle_skater"));
  ROT_CHECK_REL(x.theta, 3.2958368660043290, 1e-14); /* 3 log(3) */
  ROT_CHECK_ULP(x.omega, 6.0, 1);
  rotdyn_report report;
  ROT_CHECK(at(scene, "moment_of_inertia_kg_m2", 0.5, NULL, &report) == 2.0);
  rotdyn_object_free(scene);
}

/* Where the axle passes: a rod of 1 kg and 2 m, about its end, its centre, along itself. */
static void check_axes(void) {
  static const char *const names[] = {"mass_kg", "length_m"};
  rotdyn_object *scene = rotdyn_object_new("scene_axle");
  rotdyn_report report;
  (void)give(scene, "body", part("body_rod_end", 2, names, (double[]){1.0, 2.0}));
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 1.0);
#define MOMENT at(scene, "angular_momentum_kg_m2_per_s", 1.0, NULL, &report)
  ROT_CHECK_ULP(MOMENT, 4.0 / 3.0, 2);
  (void)rotdyn_set_text(scene, "through", "centre");
  ROT_CHECK_ULP(MOMENT, 1.0 / 3.0, 2);
  (void)rotdyn_set_text(scene, "through", "origin");
  ROT_CHECK_ULP(MOMENT, 4.0 / 3.0, 2);
  (void)rotdyn_set_numbers(scene, "through", 3, (double[]){3.0, 0.0, 0.0});
  ROT_CHECK_ULP(MOMENT, 1.0 / 3.0 + 4.0, 2);
  (void)rotdyn_unset(scene, "through");
  (void)rotdyn_set_text(scene, "axis", "x");
  ROT_CHECK(isnan(MOMENT) && refused(scene, "body", "moment of inertia"));
  (void)rotdyn_set_numbers(scene, "axis", 3, (double[]){1.0, 0.0, 1.0});
  ROT_CHECK_ULP(MOMENT, 2.0 / 3.0, 4);
#undef MOMENT
  rotdyn_object_free(scene);
}

static int give_sum(rotdyn_object *scene, const rotdyn_object *laws) {
  rotdyn_object *sum = rotdyn_object_new("torque_sum");
  (void)rotdyn_set_object(sum, "laws", laws);
  return give(scene, "torque", sum);
}

/* A sum is the law in normal form: constants and motors, two laws of the caller. */
static void check_sums(void) {
  static const char *const of_motor[] = {"stall_torque_n_m", "no_load_omega_rad_per_s"};
  rotdyn_object *scene = axle(0.5), *list = rotdyn_object_new("list");
  (void)rotdyn_set_number(list, NULL, 1.0);
  (void)give(list, NULL, part("torque_motor", 2, of_motor, (double[]){2.0, 8.0}));
  (void)give_sum(scene, list);
  /* I omega' = 3 - omega/4 */
  one x = state(scene, 2.0, NULL);
  ROT_CHECK(!strcmp(x.report.model, "axle_linear"));
  ROT_CHECK_REL(x.omega, -12.0 * expm1(-1.0), 1e-14);
  (void)rotdyn_set_number(list, NULL, 5.0);
  (void)rotdyn_set_number(list, NULL, -5.0);
  (void)give_sum(scene, list);
  const one same = state(scene, 2.0, NULL);
  ROT_CHECK(same.omega == x.omega && same.theta == x.theta);
  /* A sum has a name: numbers of an axle are a mistake, as in R. */
  ROT_CHECK_EQ_INT(rotdyn_set_object(scene, "torque", list), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(scene, "torque", 2, (double[]){1.0, 2.0}), ROTDYN_EARGUMENT);
  rotdyn_object *outer = rotdyn_object_new("list");
  (void)rotdyn_set_object(outer, NULL, list);
  (void)give_sum(scene, outer);
  ROT_CHECK(refused(scene, "torque", "item 1 must not be a list"));
  rotdyn_object_free(outer);
  rotdyn_object_free(list);
  rotdyn_object_free(scene);
}

static int driven(const double *argument, double *torque, void *context) {
  const double omega = argument[2];
  *torque = 2.0 - 0.25 * omega * fabs(omega);
  return context && argument[0] > *(double *)context;
}

/* Half of it. */
static int half_drive(const double *argument, double *torque, void *context) {
  (void)driven(argument, torque, context);
  *torque /= 2.0;
  return 0;
}

static int no_number(const double *argument, double *torque, void *context) {
  (void)context;
  *torque = argument[0] > 0.5 ? (double)NAN : 1.0;
  return 0;
}

static void check_integrated(void) {
  rotdyn_object *scene = axle(0.5), *list = rotdyn_object_new("list");
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  double limit = 0.5;
  (void)rotdyn_set_law(scene, "torque", driven, NULL);
  one x = state(scene, 0.75, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && !strcmp(x.report.model, "axle_rk8pd"));
  ROT_CHECK(!x.report.error_is_bound && x.report.error <= 1e-9 && x.report.steps > 0);
  ROT_CHECK_REL(x.theta, 0.96145700114501991779, x.report.error);
  ROT_CHECK_REL(x.omega, 2.2229072552546211283, x.report.error);
  /* Two halves are the whole, to the last bit. */
  (void)rotdyn_set_law(list, NULL, half_drive, NULL);
  (void)rotdyn_set_law(list, NULL, half_drive, NULL);
  (void)give_sum(scene, list);
  const one halves = state(scene, 0.75, NULL);
  ROT_CHECK(halves.omega == x.omega && halves.theta == x.theta);
  (void)rotdyn_set_law(scene, "torque", driven, NULL);
  options.accuracy = 1e-4;
  x = state(scene, 0.75, &options);
  ROT_CHECK(x.report.error > 1e-9 && x.report.error <= 1e-4);
  options.accuracy = 1e-12;
  options.model = "axle_radau";
  x = state(scene, 0.75, &options);
  ROT_CHECK(x.status == ROTDYN_OK && !strcmp(x.report.model, "axle_radau"));
  ROT_CHECK_REL(x.omega, 2.2229072552546211283, 1e-12);
  (void)rotdyn_set_law(scene, "torque", driven, &limit);
  ROT_CHECK_EQ_INT(state(scene, 0.75, &options).status, ROTDYN_ESTOPPED);
  (void)rotdyn_set_law(scene, "torque", no_number, NULL);
  ROT_CHECK_EQ_INT(state(scene, 0.75, NULL).status, ROTDYN_ETORQUE);
  (void)rotdyn_set_law(scene, "torque", driven, NULL);
  options.model = "axle_rk8pd";
  options.max_steps = 2.0;
  x = state(scene, 1e6, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EBUDGET);
  ROT_CHECK(x.report.rows_done == 0);
  rotdyn_object_free(scene);
  rotdyn_object_free(list);
}

/* A law with a break: 7 N m from 1 s on. */
static int late(const double *argument, double *torque, void *context) {
  (void)context;
  *torque = argument[0] < 1.0 ? 0.0 : 7.0;
  return 0;
}

static void check_breaks(void) {
  rotdyn_object *scene = axle(2.0), *law = rotdyn_object_new("torque_function");
  const double breaks[] = {1.0};
  (void)rotdyn_set_law(law, "f", late, NULL);
  (void)rotdyn_set_numbers(law, "breaks_s", 1, breaks);
  (void)give(scene, "torque", law);
  const one x = state(scene, 3.0, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && x.report.steps < 30);
  ROT_CHECK_REL(x.omega, 7.0, 1e-13);
  rotdyn_object_free(scene);
}

static int count_poll(void *context, double fraction) {
  int *calls = context;
  ROT_CHECK(fraction >= 0.0 && fraction <= 1.0);
  return ++*calls >= 3;
}

static void check_stops(void) {
  rotdyn_object *scene = disk();
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const size_t n = 200000;
  double *t = malloc(n * sizeof *t);
  int calls = 0;
  ROT_CHECK(t != NULL);
  for (size_t i = 0; t && i < n; i++) t[i] = 8.0 * (double)i / (double)n;
  options.poll = count_poll;
  options.poll_context = &calls;
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, n, t, &options, 0, 0, NULL, NULL, &report),
                   ROTDYN_ESTOPPED);
  ROT_CHECK(calls == 3 && report.rows_done > 0 && report.rows_done < n);
  free(t);
  rotdyn_object_free(scene);
}

/* A brake: it comes to rest at I omega0/tau and stays there. */
static void check_events(void) {
  rotdyn_object *scene = axle(0.5);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_events events = ROTDYN_INIT(rotdyn_events);
  double when[1] = {0.0};
  const char *name[1] = {NULL};
  events.room = 1;
  events.time_s = when;
  events.name = name;
  options.events = &events;
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 3.0);
  resist(scene, "coulomb_n_m", 0.75);
  const one x = state(scene, 5.0, &options);
  ROT_CHECK(x.status == ROTDYN_OK && x.omega == 0.0);
  ROT_CHECK_REL(x.theta, 3.0, 1e-15); /* I omega0^2/(2 tau) */
  ROT_CHECK_EQ_INT(events.count, 1);
  ROT_CHECK(name[0] && !strcmp(name[0], "stick"));
  ROT_CHECK_REL(when[0], 2.0, 1e-15);
  /* Events of a wrong size would be left as they are. */
  events.size = 7;
  ROT_CHECK_EQ_INT(state(scene, 5.0, &options).status, ROTDYN_EARGUMENT);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_balance balance = ROTDYN_INIT(rotdyn_balance);
  const double end = 1.0;
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 1, &end, &options, 0, &balance, &report),
                   ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(report.reason, "`events`") != NULL);
  rotdyn_object_free(scene);
}

static void check_choice(void) {
  static const char *const of_drag[] = {"viscous_n_m_s", "quadratic_n_m_s2"};
  rotdyn_object *scene = disk();
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_candidate c = ROTDYN_INIT(rotdyn_candidate);
  const double end = 8.0;
  double cost = 0.0;
  size_t k = 0;
  int chosen = 0;
  for (; rotdyn_scene_candidate(scene, 1, &end, NULL, k, &c) == ROTDYN_OK; k++) {
    ROT_CHECK(c.cost_s >= cost && *c.reason);
    ROT_CHECK(!c.applies || strstr(c.reason, chosen ? "fits, but axle_linear is cheaper"
                                                    : "viscous resistance: closed form"));
    chosen |= c.applies;
    cost = c.cost_s;
  }
  ROT_CHECK_EQ_INT(k, 13);
  ROT_CHECK_EQ_INT(rotdyn_scene_candidate(scene, 1, &end, NULL, k, &c), ROTDYN_EEND);
  /* Drag that 1e-6 does not see, with its bound, and that 1e-12 does. */
  (void)give(scene, "resistance", part("resistance", 2, of_drag, (double[]){0.03, 1e-12}));
  options.accuracy = 1e-6;
  one x = state(scene, end, &options);
  ROT_CHECK(!strcmp(x.report.model, "axle_linear") &&
            strstr(x.report.reason, "quadratic drag ignored"));
  ROT_CHECK(x.report.error > 1e-12 && x.report.error < 1e-6);
  rotdyn_report report;
  const double damping = at(scene, "damping_torque_n_m", end, &options, &report);
  ROT_CHECK(damping == -0.03 * x.omega - 1e-12 * x.omega * fabs(x.omega));
  options.accuracy = 1e-12;
  x = state(scene, end, &options);
  ROT_CHECK(!strcmp(x.report.model, "axle_rk8pd") && !*x.report.reason);
  ROT_CHECK_REL(x.omega, 5.8278502401517953138, 2e-9); /* the drag takes 1e-9 */
  /* The model asked for; none that reaches the accuracy. */
  options.model = "axle_free";
  x = state(scene, end, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EMODEL);
  ROT_CHECK(strstr(x.report.reason, "it does not take") && !x.report.model);
  options.model = "axle_none";
  ROT_CHECK_EQ_INT(state(scene, end, &options).status, ROTDYN_EMODEL);
  options.model = NULL;
  options.accuracy = 1e-15;
  x = state(scene, end, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EACCURACY);
  ROT_CHECK(strstr(x.report.reason, "the best promises 1e-13"));
  /* Friction does not run backward in time. */
  resist(scene, "coulomb_n_m", 0.1);
  options.accuracy = 1e-9;
  x = state(scene, -1.0, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EMODEL);
  ROT_CHECK(strstr(x.report.reason, "backwards"));
  rotdyn_object_free(scene);
}

/* ---- rotors, clutches, drives ---------------------------------------------------------------- */

/* Two equal rotors drivened against each other: theta_1 = a cos(sqrt(2 k/J) t). */
/* A model on trial runs: its error is what the shaft twists. */
static void check_trials(void) {
  static const double stiffness[] = {1e2, 1e22}, bodies[] = {1.0, 2.0}, torque[] = {1.0, 0.0};
  const double end = 4.0;
  for (int i = 0; i < 2; i++) {
    rotdyn_object *scene = rotdyn_object_new("scene_rotors");
    rotdyn_candidate rigid = ROTDYN_INIT(rotdyn_candidate), modal = rigid;
    (void)rotdyn_set_numbers(scene, "bodies", 2, bodies);
    (void)rotdyn_set_number(scene, "stiffness_n_m_per_rad", stiffness[i]);
    (void)rotdyn_set_numbers(scene, "torque", 2, torque);
    ROT_CHECK(!rotdyn_scene_candidate(scene, 1, &end, NULL, 0, &rigid));
    ROT_CHECK(!rotdyn_scene_candidate(scene, 1, &end, NULL, 1, &modal));
    ROT_CHECK(!strcmp(rigid.model, "rotors_rigid") && !strcmp(modal.model, "rotors_modal"));
    ROT_CHECK(rigid.applies == i && modal.applies == 1);
    ROT_CHECK(i ? rigid.error < 1e-9 : rigid.error > 1e-4 && rigid.error < 1.0);
    ROT_CHECK(strstr(rigid.reason, i ? "turns as one body" : "exceeds the accuracy asked"));
    ROT_CHECK(strstr(modal.reason, i ? "fits, but rotors_rigid is cheaper" : "modes are exact"));
    rotdyn_object_free(scene);
  }
}

static void check_rotors(void) {
  rotdyn_object *scene = rotdyn_object_new("scene_rotors");
  static const char *const names[] = {"theta_rad", "rotational_kinetic_energy_j",
                                      "angular_momentum_kg_m2_per_s", "shaft_torque_n_m"};
  double x[4][4], *const columns[] = {x[0], x[1], x[2], x[3]};
  const double time_s[] = {0.25, 0.5}, swing = 0.1 * cos(20.0 * 0.5);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  (void)rotdyn_set_numbers(scene, "bodies", 2, (double[]){2.0, 2.0});
  (void)rotdyn_set_number(scene, "stiffness_n_m_per_rad", 400.0);
  (void)rotdyn_set_numbers(scene, "theta0_rad", 2, (double[]){0.1, -0.1});
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 2, time_s, NULL, 4, 4, names, columns, &report),
                   ROTDYN_OK);
  ROT_CHECK(!strcmp(report.model, "rotors_modal") && report.rows_per_time == 2 &&
            !strcmp(report.index, "rotor"));
  ROT_CHECK_REL(x[0][2], swing, 1e-13);
  ROT_CHECK_REL(x[0][3], -swing, 1e-13);
  ROT_CHECK_REL(x[3][2], 400.0 * 2.0 * swing, 1e-13);
  ROT_CHECK(isnan(x[3][1]) && isnan(x[3][3]));
  const double rate = 2.0 * sin(20.0 * 0.5); /* 0.1 times 20 */
  ROT_CHECK_REL(x[1][2], rate * rate, 1e-13);
  ROT_CHECK_REL(x[2][3], 2.0 * rate, 1e-13);
  /* So stiff that it turns as one: 4 kg m^2 under 3 N m. */
  (void)rotdyn_unset(scene, "theta0_rad");
  (void)rotdyn_set_number(scene, "stiffness_n_m_per_rad", 1e22);
  (void)rotdyn_set_numbers(scene, "torque", 2, (double[]){3.0, 0.0});
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 2, time_s, NULL, 4, 4, names, columns, &report),
                   ROTDYN_OK);
  ROT_CHECK(!strcmp(report.model, "rotors_rigid") && report.error_is_bound);
  ROT_CHECK_REL(x[2][3], 2.0 * 0.75 * 0.5, 1e-12);
  rotdyn_object_free(scene);
}

/* 2 and 3 kg m^2, 12 N m, 10 rad/s apart: they lock at 10/(6 + 4) s, at 4 rad/s. */
static void check_clutch(void) {
  static const char *const names[] = {"body_1", "body_2", "capacity_n_m"};
  rotdyn_object *scene = part("scene_clutch", 3, names, (double[]){2.0, 3.0, 12.0});
  rotdyn_object *torques = rotdyn_object_new("list");
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 2, (double[]){10.0, 0.0});
  rotdyn_report report;
  rotdyn_events events = ROTDYN_INIT(rotdyn_events);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  double when[2];
  const char *event[2];
  events.room = 2;
  events.time_s = when;
  events.name = event;
  options.events = &events;
  ROT_CHECK_REL(at(scene, "omega_1_rad_per_s", 0.5, NULL, &report), 7.0, 1e-15);
  ROT_CHECK(at(scene, "locked", 0.5, NULL, &report) == 0.0);
  ROT_CHECK_REL(at(scene, "omega_2_rad_per_s", 2.0, &options, &report), 4.0, 1e-15);
  ROT_CHECK(at(scene, "locked", 2.0, NULL, &report) == 1.0);
  ROT_CHECK(events.count == 1 && !strcmp(event[0], "lock"));
  ROT_CHECK_REL(when[0], 1.0, 1e-15);
  ROT_CHECK_REL(at(scene, "heat_j", 2.0, NULL, &report), 60.0, 1e-15);
  /* Pressed later; static above sliding; a torque in steps, and one that is none. */
  (void)rotdyn_set_number(scene, "engage_s", 1.0);
  ROT_CHECK_REL(at(scene, "omega_1_rad_per_s", 1.5, NULL, &report), 7.0, 1e-15);
  rotdyn_object *steps = rotdyn_object_new("torque_steps");
  (void)rotdyn_set_numbers(steps, "time_s", 2, (double[]){0.0, 0.5});
  (void)rotdyn_set_numbers(steps, "torque_n_m", 2, (double[]){8.0, 0.0});
  (void)give(torques, NULL, steps);
  (void)rotdyn_set_object(scene, "torque", torques);
  ROT_CHECK(refused(scene, "torque", "each of the 2 bodies"));
  (void)rotdyn_unset(torques, NULL); /* nothing on body 2 */
  (void)rotdyn_set_object(scene, "torque", torques);
  ROT_CHECK_REL(at(scene, "omega_1_rad_per_s", 1.0, NULL, &report), 12.0, 1e-15);
  rotdyn_object_free(torques);
  rotdyn_object *knots = rotdyn_object_new("torque_knots");
  (void)rotdyn_set_numbers(knots, "time_s", 2, (double[]){0.0, 0.5});
  (void)rotdyn_set_numbers(knots, "torque_n_m", 2, (double[]){8.0, 0.0});
  rotdyn_object *others[] = {
      part("torque_sinusoid", 2,
           (const char *const[]){"amplitude_n_m", "angular_frequency_rad_per_s"},
           (double[]){1.0, 2.0}),
      knots};
  for (int i = 0; i < 2; i++) {
    torques = rotdyn_object_new("list");
    (void)rotdyn_unset(torques, NULL);
    (void)give(torques, NULL, others[i]);
    (void)give(scene, "torque", torques);
    ROT_CHECK(refused(scene, "torque", "constant between jumps") &&
              refused(scene, "torque", "item 2"));
  }
  (void)rotdyn_unset(scene, "torque");
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 10.0);
  ROT_CHECK(refused(scene, "omega0_rad_per_s", "one for each body"));
  rotdyn_object_free(scene);
}

/* A gear of ratio 2: (1 + 4/4) omega' = 6 - 2/2. Of a lossy one, 1 + 4/(4 e) where power enters the
 * first. */
static void check_drive(void) {
  static const char *const of_gear[] = {"ratio", "efficiency"};
  static const char *const names[] = {"omega_rad_per_s", "locked", "coupling_torque_n_m"};
  rotdyn_object *scene = rotdyn_object_new("scene_drive");
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  double x[3][2], *const columns[] = {x[0], x[1], x[2]};
  const double end = 2.0;
#define RUN rotdyn_scene_run(scene, 1, &end, NULL, 2, 3, names, columns, &report)
  (void)rotdyn_set_numbers(scene, "bodies", 2, (double[]){1.0, 4.0});
  (void)rotdyn_set_numbers(scene, "torque", 2, (double[]){6.0, -2.0});
  ROT_CHECK(refused(scene, "couplings", "one item less"));
  (void)give(scene, "couplings", part("coupling_gear", 1, of_gear, (double[]){2.0}));
  ROT_CHECK_EQ_INT(RUN, ROTDYN_OK);
  ROT_CHECK(!strcmp(report.model, "drive_axle") && report.rows_per_time == 2);
  ROT_CHECK_REL(x[0][0], 5.0, 1e-15);
  ROT_CHECK_REL(x[0][1], 2.5, 1e-15);
  ROT_CHECK(x[1][0] == 0.0 && isnan(x[1][1]) && isnan(x[2][1]));
  ROT_CHECK_REL(x[2][0], 6.0 - 2.5, 1e-15);
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 2, (double[]){1.0, 1.0});
  ROT_CHECK(refused(scene, "omega0_rad_per_s", "agree with the gears"));
  (void)rotdyn_set_number(scene, "omega0_rad_per_s", 1.0);
  ROT_CHECK_EQ_INT(RUN, ROTDYN_OK);
  ROT_CHECK_REL(x[0][1], 3.0, 1e-9);
  (void)rotdyn_unset(scene, "omega0_rad_per_s");
  (void)give(scene, "couplings", part("coupling_gear", 2, of_gear, (double[]){2.0, 0.8}));
  ROT_CHECK_EQ_INT(RUN, ROTDYN_OK);
  ROT_CHECK_REL(x[0][0], 2.0 * (6.0 - 1.0 / 0.8) / (1.0 + 1.0 / 0.8), 1e-9);
  /* A clutch that slips, and a brake that holds the other rotor: 6 - 5 on the first. */
  static const char *const of_excess[] = {"capacity_n_m"};
  rotdyn_object *brakes = rotdyn_object_new("list");
  (void)give(scene, "couplings", part("coupling_clutch", 1, of_excess, (double[]){5.0}));
  (void)rotdyn_unset(brakes, NULL);
  ROT_CHECK_EQ_INT(rotdyn_set_object(scene, "brake", brakes), ROTDYN_OK);
  ROT_CHECK(refused(scene, "brake", "each of the 2 rotors"));
  (void)give(brakes, NULL, part("brake", 1, of_excess, (double[]){10.0}));
  (void)rotdyn_set_object(scene, "brake", brakes);
  ROT_CHECK_EQ_INT(RUN, ROTDYN_OK);
  ROT_CHECK_REL(x[0][0], 2.0, 1e-9);
  ROT_CHECK(x[0][1] == 0.0 && x[1][0] == 0.0);
  /* A clutch beside a gear with a loss. */
  rotdyn_object *both = rotdyn_object_new("list");
  (void)give(both, NULL, part("coupling_clutch", 1, of_excess, (double[]){5.0}));
  (void)give(both, NULL, part("coupling_gear", 2, of_gear, (double[]){2.0, 0.8}));
  (void)rotdyn_set_numbers(scene, "bodies", 3, (double[]){1.0, 4.0, 1.0});
  (void)rotdyn_unset(scene, "torque");
  (void)rotdyn_unset(scene, "brake");
  (void)rotdyn_set_object(scene, "couplings", both);
  ROT_CHECK(refused(scene, "couplings", "gear with a loss"));
  rotdyn_object_free(both);
  rotdyn_object_free(brakes);
  rotdyn_object_free(scene);
#undef RUN
}

/* 10 rad/s and rest, 12 N m: the clutch locks after 1 s. With a brake of 15 N m on the second rotor
 * it stops both: together they have 5 kg m^2 and 20 N m s. */
static void check_places(void) {
  static const char *const of_excess[] = {"capacity_n_m", "from_s"}, *const name =
                                                                         "omega_rad_per_s";
  rotdyn_object *scene = rotdyn_object_new("scene_drive"), *brakes = rotdyn_object_new("list");
  const char *event[2];
  double event_s[2], omega[2], *const column = omega;
  int place[2] = {9, 9};
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_events events = {.size = sizeof events, .room = 2, .time_s = event_s, .name = event};
  const double end = 9.0;
  events.place = place;
  options.events = &events;
  (void)rotdyn_set_numbers(scene, "bodies", 2, (double[]){2.0, 3.0});
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 2, (double[]){10.0, 0.0});
  (void)give(scene, "couplings", part("coupling_clutch", 1, of_excess, (double[]){12.0}));
  (void)rotdyn_unset(brakes, NULL);
  (void)give(brakes, NULL, part("brake", 2, of_excess, (double[]){15.0, 2.0}));
  (void)rotdyn_set_object(scene, "brake", brakes);
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 1, &end, &options, 2, 1, &name, &column, NULL),
                   ROTDYN_OK);
  ROT_CHECK_EQ_INT((long)events.count, 2);
  ROT_CHECK(!strcmp(event[0], "lock") && place[0] == -1);
  ROT_CHECK(!strcmp(event[1], "stick") && place[1] == 2);
  ROT_CHECK_REL(event_s[0], 1.0, 1e-12);
  ROT_CHECK_REL(event_s[1], 2.0 + 20.0 / 15.0, 1e-12);
  rotdyn_object_free(brakes);
  rotdyn_object_free(scene);
}

/* ---- many scenes, a row each ----------------------------------------------------------------- */

static void check_rows(void) {
  enum { N = 200 };
  static const char *const inputs[] = {"body", "omega0_rad_per_s"};
  static const char *const names[] = {"theta_rad", "omega_rad_per_s"};
  rotdyn_object *scene = disk();
  double inertia[N], omega0[N], time_s[N], x[2][N], again[2][N], error[N];
  double *const columns[] = {x[0], x[1]}, *const others[] = {again[0], again[1]};
  int status[N];
  const char *model[N];
  rotdyn_rows_in in = ROTDYN_INIT(rotdyn_rows_in);
  rotdyn_rows_out out = ROTDYN_INIT(rotdyn_rows_out);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  for (int i = 0; i < N; i++) {
    inertia[i] = i == 7 ? -1.0 : 0.01 * (i + 1);
    omega0[i] = 0.1 * i;
    time_s[i] = i == 9 ? NAN : 0.05 * i;
  }
  (void)rotdyn_set_number(scene, "body", 1.0);
  resist(scene, "quadratic_n_m_s2", 0.01); /* integrated, where the torque is not constant */
  const rotdyn_column values[] = {{inertia, 1}, {omega0, 1}};
  in.time_s = (rotdyn_column){time_s, 1};
  in.n_inputs = 2;
  in.inputs = inputs;
  in.values = values;
  out.n_columns = 2;
  out.names = names;
  out.columns = columns;
  out.error = error;
  out.status = status;
  out.model = model;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(scene, N, &in, &options, &out, &report), ROTDYN_OK);
  ROT_CHECK(report.rows_done == N && report.error > 0.0 && report.error <= 1e-9);
  for (int i = 0; i < N; i++) {
    if (i == 7 || i == 9) {
      ROT_CHECK(status[i] == ROTDYN_EARGUMENT && isnan(x[0][i]) && isnan(error[i]) && !model[i]);
      continue;
    }
    (void)rotdyn_set_number(scene, "body", inertia[i]);
    (void)rotdyn_set_number(scene, "omega0_rad_per_s", omega0[i]);
    const one alone = state(scene, time_s[i], NULL);
    ROT_CHECK(status[i] == ROTDYN_OK && alone.theta == x[0][i] && alone.omega == x[1][i]);
    ROT_CHECK(alone.report.error == error[i] && !strcmp(alone.report.model, model[i]));
  }
  /* No bit depends on the threads. */
  options.threads = 4;
  out.columns = others;
  out.error = NULL;
  out.status = NULL;
  out.model = NULL;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(scene, N, &in, &options, &out, &report), ROTDYN_OK);
  ROT_CHECK(!memcmp(x, again, sizeof x));
  /* A law of the caller is called by one thread. */
  (void)rotdyn_set_law(scene, "torque", half_drive, NULL);
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(scene, 20, &in, &options, &out, NULL), ROTDYN_OK);
  ROT_CHECK(again[1][0] == omega0[0] && again[1][19] > 0.0);
  /* Several rows a time. */
  rotdyn_object *rotors = rotdyn_object_new("scene_rotors");
  (void)rotdyn_set_numbers(rotors, "bodies", 2, (double[]){2.0, 2.0});
  (void)rotdyn_set_number(rotors, "stiffness_n_m_per_rad", 400.0);
  (void)rotdyn_set_numbers(rotors, "theta0_rad", 2, (double[]){0.1, -0.1});
  in.n_inputs = 0;
  out.n_columns = 1;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(rotors, 3, &in, NULL, &out, &report), ROTDYN_OK);
  ROT_CHECK(report.rows_per_time == 2 && again[0][0] == 0.1 && again[0][1] == -0.1);
  ROT_CHECK_REL(again[0][4], 0.1 * cos(20.0 * 0.1), 1e-13);
  /* Refusals. */
  static const char *const wrong[] = {"resistance"}, *const none[] = {"none"};
  static const char *const bodies[] = {"bodies"};
  static const char *const twice[] = {"start_s", "start_s"};
  in.n_inputs = 1;
  in.inputs = bodies; /* one rotor in place of two */
  out.status = status;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(rotors, 3, &in, NULL, &out, &report), ROTDYN_OK);
  ROT_CHECK(status[2] == ROTDYN_EARGUMENT && isnan(again[0][4]));
  in.inputs = wrong;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(scene, 3, &in, NULL, &out, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(report.input && !strcmp(report.input, "resistance"));
  in.inputs = none;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(rotors, 3, &in, NULL, &out, &report), ROTDYN_ENAME);
  in.inputs = twice;
  in.n_inputs = 2;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(rotors, 3, &in, NULL, &out, &report), ROTDYN_EARGUMENT);
  in.n_inputs = 0;
  out.names = none;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(rotors, 3, &in, NULL, &out, &report), ROTDYN_ENAME);
  in.time_s.values = NULL;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(rotors, 3, &in, NULL, &out, &report), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(NULL, 3, &in, NULL, &out, &report), ROTDYN_EARGUMENT);
  rotdyn_object_free(rotors);
  rotdyn_object_free(scene);
}

/* ---- threads --------------------------------------------------------------------------------- */

#ifndef _WIN32
/* One scene is shared, others are the thread's own. */
typedef struct job {
  const rotdyn_object *shared;
  double sum;
} job;

static void *run_job(void *of) {
  job *j = of;
  const double omega0[] = {0.01, 6.0, 0.02};
  rotdyn_report report;
  j->sum = 0.0;
  for (int i = 0; i < 50; i++) {
    rotdyn_object *own = spinning("scene_free", omega0, 0.0);
    j->sum += at(j->shared, "x_m", 0.1 * i, NULL, &report);
    j->sum += at(own, "qw", 0.1 * i, NULL, &report);
    rotdyn_object_free(own);
  }
  return NULL;
}

static void check_threads(void) {
  enum { THREADS = 4 };
  rotdyn_object *scene = slope(12.0);
  job alone = {scene, 0.0}, jobs[THREADS];
  pthread_t thread[THREADS];
  resist(scene, "drag_n_s_per_m", 0.5);
  (void)run_job(&alone);
  for (int i = 0; i < THREADS; i++) {
    jobs[i] = (job){scene, 0.0};
    ROT_CHECK_EQ_INT(pthread_create(&thread[i], NULL, run_job, &jobs[i]), 0);
  }
  for (int i = 0; i < THREADS; i++) {
    ROT_CHECK_EQ_INT(pthread_join(thread[i], NULL), 0);
    ROT_CHECK(jobs[i].sum == alone.sum);
  }
  rotdyn_object_free(scene);
}
#else
static void check_threads(void) { ROT_CHECK(1); }
#endif

/* A law of the caller is called by the caller's own thread alone, however many are allowed. */
#ifndef _WIN32
static pthread_t caller;
static int is_elsewhere = 0, watched_calls = 0;

static int watched(const double *argument, double *value, void *context) {
  (void)argument, (void)context;
  watched_calls++;
  is_elsewhere |= !pthread_equal(caller, pthread_self());
  *value = 1.0;
  return 0;
}

static void check_own_thread(void) {
  enum { N = 64 };
  static const char *const inputs[] = {"omega0_rad_per_s"}, *const names[] = {"omega_rad_per_s"};
  rotdyn_object *scene = axle(0.5);
  double omega0[N], time_s[N], x[N];
  double *const columns[] = {x};
  rotdyn_rows_in in = ROTDYN_INIT(rotdyn_rows_in);
  rotdyn_rows_out out = ROTDYN_INIT(rotdyn_rows_out);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  for (int i = 0; i < N; i++) omega0[i] = i, time_s[i] = 0.5;
  ROT_CHECK(rotdyn_set_law(scene, "torque", watched, NULL) == ROTDYN_OK);
  caller = pthread_self();
  const rotdyn_column values[] = {{omega0, 1}};
  in.time_s = (rotdyn_column){time_s, 1};
  in.n_inputs = 1;
  in.inputs = inputs;
  in.values = values;
  out.n_columns = 1;
  out.names = names;
  out.columns = columns;
  options.threads = 4;
  ROT_CHECK_EQ_INT(rotdyn_scene_rows(scene, N, &in, &options, &out, &report), ROTDYN_OK);
  ROT_CHECK(!is_elsewhere && watched_calls > N);
  for (int i = 0; i < N; i++) ROT_CHECK(fabs(x[i] - (i + 1.0)) <= 1e-9 * (i + 1.0));
  rotdyn_object_free(scene);
}
#else
static void check_own_thread(void) { ROT_CHECK(1); }
#endif

/* The relative error is of the largest value between the times, from the earliest on. A wheel under
 * 1 N m that turned back at -T/2 is where it was: theta = 0 in all rows, and 9/2 rad on the way. */
static void check_sizes(void) {
  rotdyn_object *scene = axle(1.0);
  const double time_s[] = {-6.0, -1e-9};
  double theta[2], *columns[] = {theta};
  const char *const names[] = {"theta_rad"};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK(rotdyn_set_number(scene, "torque", 1.0) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(scene, "omega0_rad_per_s", 3.0) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(scene, "theta0_rad", 0.0) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 2, time_s, NULL, 2, 1, names, columns, &report),
                   ROTDYN_OK);
  ROT_CHECK(fabs(theta[0]) <= 1e-14 && fabs(theta[1] + 3e-9) <= 1e-16);
  ROT_CHECK(report.error <= 1e-13 && report.error >= 1e-16);
  rotdyn_object_free(scene);
}

/* A pivot so far away that the moments about it exceed doubles, a pulley without a radius. */
static void check_far_pivot(void) {
  const double moments[] = {1.0, 1.0, 2.0}, omega0[] = {0.0, 0.0, 1.0}, far[] = {1e200, 0.0, 0.0};
  rotdyn_object *top = rotdyn_object_new("scene_pivot");
  ROT_CHECK_EQ_INT(give(top, "body", tensor(2.0, 3, moments)), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(top, "omega0_rad_per_s", 3, omega0), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(top, "pivot_m", 3, far), ROTDYN_OK);
  ROT_CHECK(refused(top, "pivot_m", "finite moments"));
  rotdyn_object_free(top);
  rotdyn_object *pulley = rotdyn_object_new("scene_hanging_mass");
  ROT_CHECK_EQ_INT(rotdyn_set_number(pulley, "body", 0.1), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_number(pulley, "mass_kg", 1.0), ROTDYN_OK);
  ROT_CHECK(refused(pulley, "radius_m", "no radius"));
  rotdyn_object_free(pulley);
}

/* A body rolls about its third axis: g sin(alpha)/(1 + I/(m r^2)). */
static void check_rolling_axis(void) {
  rotdyn_object *scene = rotdyn_object_new(NAME);
  const double moments[] = {0.03, 0.02, 0.04};
  rotdyn_report report;
  ROT_CHECK(give(scene, "body", tensor(2.0, 3, moments)) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(scene, "radius_m", 0.2) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(scene, "incline_angle_deg", 30.0) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "v_m_per_s", 2.0, NULL, &report), 9.80665 / 1.5, 1e-14);
  rotdyn_object_free(scene);
}

int main(void) {
  check_refusals();
  check_closed_forms();
  check_bits();
  check_law();
  check_numbers();
  check_free();
  check_free_law();
  check_pivot();
  check_spin_up();
  check_axle_forms();
  check_axes();
  check_sums();
  check_integrated();
  check_breaks();
  check_stops();
  check_events();
  check_choice();
  check_rotors();
  check_trials();
  check_clutch();
  check_drive();
  check_places();
  check_rows();
  check_times();
  check_threads();
  check_own_thread();
  check_sizes();
  check_far_pivot();
  check_rolling_axis();
  return rot_test_report("api scene");
}
