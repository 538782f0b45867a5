/* Scenes of several constraints of which some numbers vary, made anew as objects, and their runs by
 * rot_run() alone: what rows of a sweep must equal. */
#ifndef SWEEP_KIT_H
#define SWEEP_KIT_H

#include <math.h>
#include <string.h>

#include "rot_test.h"
#include "sweep/rows.h"

/* ---- objects --------------------------------------------------------------------------------- */

static inline rot_object *of(const char *constructor) {
  rot_object *object = rot_object_new(constructor);
  if (!object) exit(EXIT_FAILURE);
  return object;
}

static inline void put(rot_object *to, const char *input, double x) {
  ROT_CHECK(rot_object_number(to, input, x) == ROT_SET_DONE);
}

static inline void puts_of(rot_object *to, const char *input, size_t n, const double x[]) {
  ROT_CHECK(rot_object_numbers(to, input, n, x) == ROT_SET_DONE);
}

/* Adds a part and frees it. */
static inline void part(rot_object *to, const char *input, rot_object *from) {
  ROT_CHECK(rot_object_part(to, input, from) == ROT_SET_DONE);
  rot_object_free(from);
}

static inline rot_object *disk(double mass_kg, double radius_m) {
  rot_object *body = of("body_disk");
  put(body, "mass_kg", mass_kg);
  put(body, "radius_m", radius_m);
  return body;
}

static inline rot_object *loss(double viscous, double quadratic, double coulomb) {
  rot_object *r = of("resistance");
  put(r, "viscous_n_m_s", viscous);
  put(r, "quadratic_n_m_s2", quadratic);
  put(r, "coulomb_n_m", coulomb);
  return r;
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static inline rot_object *make_wheel(const double x[]) {
  rot_object *scene = of("scene_axle");
  part(scene, "body", disk(x[0], 0.25));
  put(scene, "torque", 0.8);
  part(scene, "resistance", loss(x[1], 0.0, 0.0));
  put(scene, "omega0_rad_per_s", x[2]);
  return scene;
}

static inline rot_object *make_dry(const double x[]) {
  rot_object *scene = of("scene_axle");
  part(scene, "body", disk(2.0, 0.25));
  part(scene, "resistance", loss(0.01, x[1], x[0]));
  put(scene, "omega0_rad_per_s", x[2]);
  return scene;
}

static inline rot_object *make_knots(const double x[]) {
  const double time_s[] = {0.0, 1.0, x[1], 4.0}, torque[] = {0.0, x[0], 0.3, 0.0};
  rot_object *scene = of("scene_axle"), *knots = of("torque_knots");
  puts_of(knots, "time_s", 4, time_s);
  puts_of(knots, "torque_n_m", 4, torque);
  put(scene, "body", x[2]);
  part(scene, "torque", knots);
  part(scene, "resistance", loss(0.03, 0.0, 0.0));
  return scene;
}

static inline rot_object *make_pendulum(const double x[]) {
  rot_object *scene = of("scene_pendulum");
  part(scene, "body", disk(1.5, 0.1));
  put(scene, "distance_m", x[0]);
  put(scene, "theta0_rad", x[1]);
  put(scene, "gravity_m_per_s2", x[2]);
  return scene;
}

static inline rot_object *make_slope(const double x[]) {
  rot_object *scene = of("scene_incline"), *ball = of("body_sphere");
  put(ball, "mass_kg", 1.0);
  put(ball, "radius_m", x[0]);
  part(scene, "body", ball);
  put(scene, "incline_angle_deg", x[1]);
  put(scene, "static_friction", x[2]);
  put(scene, "v0_m_per_s", 1.0);
  put(scene, "omega0_rad_per_s", 0.0);
  return scene;
}

static inline rot_object *make_box(const double x[]) {
  const double omega[] = {1.0, x[1], 3.0}, attitude[] = {x[2], 0.0, 0.0, 0.0};
  rot_object *scene = of("scene_free"), *box = of("body_box");
  put(box, "mass_kg", 2.0);
  put(box, "length_m", x[0]);
  put(box, "width_m", 0.35);
  put(box, "height_m", 0.45);
  part(scene, "body", box);
  puts_of(scene, "omega0_rad_per_s", 3, omega);
  if (x[2] != 1.0) puts_of(scene, "attitude0", 4, attitude);
  return scene;
}

static inline rot_object *make_top(const double x[]) {
  const double pivot[] = {0.0, 0.0, x[0]}, omega[] = {0.3, x[2], x[1]};
  rot_object *scene = of("scene_pivot");
  part(scene, "body", disk(0.5, 0.05));
  puts_of(scene, "omega0_rad_per_s", 3, omega);
  puts_of(scene, "pivot_m", 3, pivot);
  return scene;
}

static inline rot_object *make_clutch(const double x[]) {
  const double omega[] = {x[1], 0.0};
  rot_object *scene = of("scene_clutch");
  put(scene, "body_1", 1.0);
  part(scene, "body_2", disk(x[2], 1.0));
  put(scene, "capacity_n_m", x[0]);
  puts_of(scene, "omega0_rad_per_s", 2, omega);
  return scene;
}

static inline rot_object *make_hoop(const double x[]) {
  rot_object *scene = of("scene_hoop");
  put(scene, "mass_kg", x[0]);
  put(scene, "radius_m", 0.3);
  put(scene, "hoop_omega_rad_per_s", x[1]);
  put(scene, "theta0_rad", x[2]);
  return scene;
}

static inline rot_object *make_chain(const double x[]) {
  const double length[] = {x[0], 0.4}, mass[] = {1.0, x[2]}, theta[] = {0.5, x[1]};
  rot_object *scene = of("scene_chain");
  puts_of(scene, "length_m", 2, length);
  puts_of(scene, "mass_kg", 2, mass);
  puts_of(scene, "theta0_rad", 2, theta);
  return scene;
}

static inline rot_object *make_rotors(const double x[]) {
  const double torque[] = {1.0, x[2]};
  rot_object *scene = of("scene_rotors"), *bodies = of("list");
  ROT_CHECK(rot_object_number(bodies, NULL, x[0]) == ROT_SET_DONE);
  part(bodies, NULL, disk(2.0, x[1]));
  part(scene, "bodies", bodies);
  put(scene, "stiffness_n_m_per_rad", 30.0);
  put(scene, "damping_n_m_s", 0.1);
  puts_of(scene, "torque", 2, torque);
  return scene;
}

enum { KIT_INPUTS = 3, KIT_TIMES = 4 };

typedef struct kit_case {
  const char *model;
  rot_object *(*make)(const double x[]);
  const char *path[KIT_INPUTS];
  double low[KIT_INPUTS], high[KIT_INPUTS];
  double end_s;
  size_t copies;
} kit_case;

static const kit_case kit_cases[] = {
    {"axle_linear",
     make_wheel,
     {"body$mass_kg", "resistance$viscous_n_m_s", "omega0_rad_per_s"},
     {1.0, 0.0, -3.0},
     {3.0, 0.3, 3.0},
     2.0,
     1},
    {"axle_drag",
     make_dry,
     {"resistance$coulomb_n_m", "resistance$quadratic_n_m_s2", "omega0_rad_per_s"},
     {0.0, 0.0, -3.0},
     {0.2, 0.02, 3.0},
     2.0,
     1},
    {"axle_linear",
     make_knots,
     {"torque$torque_n_m[2]", "torque$time_s[3]", "body"},
     {-1.0, 1.2, 0.05},
     {1.0, 3.5, 0.5},
     5.0,
     1},
    {"axle_pendulum",
     make_pendulum,
     {"distance_m", "theta0_rad", "gravity_m_per_s2"},
     {0.1, -3.0, 1.0},
     {0.5, 3.0, 20.0},
     3.0,
     1},
    {"incline_exact",
     make_slope,
     {"body$radius_m", "incline_angle_deg", "static_friction"},
     {0.05, -20.0, 0.0},
     {0.5, 40.0, 0.6},
     2.0,
     1},
    {"free_exact",
     make_box,
     {"body$length_m", "omega0_rad_per_s[2]", "attitude0[1]"},
     {0.1, -3.0, 0.5},
     {0.6, 3.0, 2.0},
     4.0,
     1},
    {"pivot_rk8pd",
     make_top,
     {"pivot_m[3]", "omega0_rad_per_s[3]", "omega0_rad_per_s[2]"},
     {-0.1, 20.0, -1.0},
     {-0.02, 60.0, 1.0},
     0.1,
     1},
    {"clutch_exact",
     make_clutch,
     {"capacity_n_m", "omega0_rad_per_s[1]", "body_2$mass_kg"},
     {0.5, -5.0, 1.0},
     {4.0, 5.0, 3.0},
     2.0,
     1},
    {"hoop_rk8pd",
     make_hoop,
     {"mass_kg", "hoop_omega_rad_per_s", "theta0_rad"},
     {0.1, 0.0, -2.0},
     {1.0, 9.0, 2.0},
     0.4,
     1},
    {"chain_rk8pd",
     make_chain,
     {"length_m[1]", "theta0_rad[2]", "mass_kg[2]"},
     {0.3, -1.0, 0.5},
     {1.0, 1.0, 2.0},
     0.3,
     2},
    {"rotors_modal",
     make_rotors,
     {"bodies[1]", "bodies[2]$radius_m", "torque[2]"},
     {0.5, 0.3, -1.0},
     {3.0, 1.0, 1.0},
     2.0,
     2},
};
enum { KIT_CASES = sizeof kit_cases / sizeof *kit_cases };

/* Numbers between low and high that do not repeat for some millions of k. */
static inline void kit_inputs(const kit_case *c, size_t k, double x[KIT_INPUTS]) {
  static const double step[] = {0.6180339887498949, 0.7548776662466927, 0.5698402909980532};
  for (int i = 0; i < KIT_INPUTS; i++) {
    const double u = (double)(k + 1) * step[i];
    x[i] = c->low[i] + (c->high[i] - c->low[i]) * (u - floor(u));
  }
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* A scene built from an object and its run. */
typedef struct kit_run {
  const rot_constraint *constraint;
  void *scene;
  size_t n, copies;
  const double *time_s;
  void *column[ROT_MAX_COLUMNS];
  double *flow[ROT_MAX_FLOWS], flow_error[ROT_MAX_FLOWS];
  rot_outcome out;
  rot_run_end end;
  rot_store store;
} kit_run;

/* (object, model or NULL, times) => run with flows; free by kit_free() */
static inline kit_run kit_run_of(const rot_object *object, const char *model, double accuracy,
                                 size_t n, const double time_s[]) {
  kit_run r;
  rot_given *given;
  rot_refusal no;
  memset(&r, 0, sizeof r);
  r.constraint = object->constraint;
  r.n = n;
  r.time_s = time_s;
  r.scene = rot_store_get(&r.store, 1, r.constraint->scene_size);
  ROT_CHECK(rot_object_given(object, &r.store, &given, &no) == ROT_OK);
  ROT_CHECK(rot_run_build(object->maker, given, &r.store, r.scene, &no) == ROT_OK);
  r.copies = rot_run_rows_per_time(r.constraint, r.scene);
  for (size_t i = 0; i < r.constraint->n_columns; i++) {
    r.column[i] = rot_store_get(&r.store, n * r.copies, sizeof(double));
  }
  for (size_t i = 0; i < r.constraint->n_flows; i++) {
    r.flow[i] = rot_store_get(&r.store, n, sizeof(double));
  }
  const rot_task task = {.n = n, .time_s = time_s, .accuracy = accuracy, .max_steps = 1000000};
  const rot_rows want = {.column = r.column, .flow = r.flow, .flow_error = r.flow_error};
  r.end = rot_run(r.constraint, r.scene, model, &task, 0.0, &want, &r.out, NULL);
  return r;
}

static inline void kit_free(kit_run *r) {
  rot_events_free(&r->out.events);
  rot_store_free(&r->store);
}

/* => column i of a copy (from 0) at a time; NaN where it means nothing or is not shown */
static inline double kit_cell(const kit_run *r, size_t i, size_t time, size_t copy) {
  const rot_constraint *c = r->constraint;
  if (!rot_run_shows(c, r->scene, c->effects_of(r->scene), i)) return NAN;
  if (!c->columns[i].flag) return ((const double *)r->column[i])[time * r->copies + copy];
  const int flag = ((const int *)r->column[i])[time * r->copies + copy];
  return flag < 0 ? (double)NAN : flag;
}

static inline int same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

#endif
