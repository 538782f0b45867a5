#include "scene/axle/inputs.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body/parts.h"
#include "ground/search.h"
#include "scene/axle/bands.h"
#include "scene/axle/drag.h"
#include "scene/axle/drop.h"
#include "scene/axle/forced.h"
#include "scene/axle/linear.h"
#include "scene/axle/ode.h"
#include "scene/axle/oscillator.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"

/* ---- parts ----------------------------------------------------------------------------------- */

typedef struct resistance {
  double viscous_n_m_s, quadratic_n_m_s2, coulomb_n_m, static_n_m;
} resistance;

enum { VISCOUS, QUADRATIC, COULOMB, STATIC };

static const rot_input resistance_inputs[] = {
    [VISCOUS] = ROT_NUMBER_INPUT("viscous_n_m_s", "N*m*s", 0, -DBL_MAX, 0, 0.0,
                                 "torque over the angular velocity; below 0 it drives"),
    [QUADRATIC] = ROT_NUMBER_INPUT("quadratic_n_m_s2", "N*m*s^2", 0, 0.0, 0, 0.0,
                                   "torque over the square of the angular velocity"),
    [COULOMB] = ROT_NUMBER_INPUT("coulomb_n_m", "N*m", 0, 0.0, 0, 0.0, "sliding friction"),
    [STATIC] = ROT_NUMBER_INPUT("static_n_m", "N*m", 0, 0.0, 0, NAN,
                                "largest static friction; default: the sliding one")};

static rot_status build_resistance(const rot_part *part, const rot_given given[], rot_store *store,
                                   void *to, rot_refusal *no) {
  resistance *r = to;
  (void)store;
  r->viscous_n_m_s = rot_input_number(part->inputs, given, VISCOUS);
  r->quadratic_n_m_s2 = rot_input_number(part->inputs, given, QUADRATIC);
  r->coulomb_n_m = rot_input_number(part->inputs, given, COULOMB);
  r->static_n_m = given[STATIC].is ? given[STATIC].x[0] : r->coulomb_n_m;
  if (r->static_n_m >= r->coulomb_n_m) return ROT_OK;
  return rot_refuse(no, STATIC, "must be at least the sliding friction, %g; it is %g",
                    r->coulomb_n_m, r->static_n_m);
}

typedef struct inertia_knots {
  size_t n;
  const double *time_s, *inertia_kg_m2;
} inertia_knots;

static const rot_input knots_inputs[] = {
    {"time_s", "s", ROT_INPUT_NUMBERS, 1, ROT_NO_DOMAIN, NAN,
     "of the knots, not decreasing; a repeated time is a jump", NULL},
    {"moment_of_inertia_kg_m2", "kg*m^2", ROT_INPUT_NUMBERS, 1, 0.0, DBL_MAX, 1, NAN,
     "at each: straight lines between, held outside", NULL}};

static rot_status build_knots(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  const size_t n = given[0].n;
  const double *t = given[0].x;
  (void)part, (void)store;
  if (n < 2) return rot_refuse(no, 0, "must have two knots or more; it has %zu", n);
  if (given[1].n != n) return rot_refuse(no, 1, "must have %zu numbers; it has %zu", n, given[1].n);
  for (size_t i = 1; i < n; i++) {
    if (t[i] < t[i - 1]) return rot_refuse(no, 0, "must not go back in time");
  }
  if (!isfinite(t[n - 1] - t[0])) return rot_refuse(no, 0, "must span a finite time");
  *(inertia_knots *)to = (inertia_knots){n, t, given[1].x};
  return ROT_OK;
}

const rot_part rot_axle_parts[] = {
    {"resistance", ROT_INPUT_RESISTANCE, 4, resistance_inputs, sizeof(resistance),
     build_resistance},
    {"inertia_knots", ROT_INPUT_INERTIA, 2, knots_inputs, sizeof(inertia_knots), build_knots},
};
const size_t rot_axle_n_parts = sizeof rot_axle_parts / sizeof *rot_axle_parts;

/* ---- what acts ------------------------------------------------------------------------------- */

static rot_status gather_breaks(rot_axle_scene *scene, rot_store *store) {
  double *all = rot_store_get(store, rot_axle_scene_room(scene), sizeof *all);
  if (!all) return ROT_ENOMEM;
  scene->n_breaks = rot_axle_scene_breaks(scene, all);
  scene->breaks_s = all;
  return ROT_OK;
}

rot_status rot_axle_load(const rot_given *torque, const rot_given *resists, rot_store *store,
                         rot_axle_scene *scene, rot_axle_own *own) {
  rot_loads loads;
  const rot_status status = rot_loads_of(torque, store, &loads);
  if (status != ROT_OK) return status;
  scene->linear.torque = loads.knots;
  scene->motor_n_m_s = loads.motor_n_m_s;
  scene->n_terms = loads.n_terms;
  scene->terms = loads.terms;
  scene->n_breaks = loads.n_breaks;
  scene->breaks_s = loads.breaks_s;
  if (own) *own = (rot_axle_own){loads.n_breaks, loads.breaks_s};
  if (resists && resists->is) {
    const resistance *r = resists->object;
    scene->viscous_n_m_s = r->viscous_n_m_s;
    scene->quadratic_n_m_s2 = r->quadratic_n_m_s2;
    scene->coulomb_n_m = r->coulomb_n_m;
    scene->static_n_m = r->static_n_m;
  }
  scene->linear.viscous_n_m_s = scene->viscous_n_m_s + scene->motor_n_m_s;
  return gather_breaks(scene, store);
}

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { BODY, TORQUE, RESISTANCE, THETA0, OMEGA0, START, AXIS, THROUGH };

static const char *const axes[] = {"z", "x", "y", NULL};
static const char *const points[] = {"centre", "origin", NULL};

const rot_input rot_axle_inputs[ROT_AXLE_INPUTS] = {
    [BODY] = {"body", "kg*m^2", ROT_BODY_KINDS | ROT_INPUT_INERTIA, 1, 0.0, DBL_MAX, 1, NAN,
              "a body, its moment of inertia about the axle, or how that changes", NULL},
    [TORQUE] = {"torque", "N*m", ROT_TORQUE_KINDS, 0, ROT_NO_DOMAIN, NAN,
                "a law of time_s, theta_rad, omega_rad_per_s; a list is the sum of its laws", NULL},
    [RESISTANCE] = {"resistance", "", ROT_INPUT_RESISTANCE, 0, ROT_NO_DOMAIN, NAN,
                    "what resists the rotation", NULL},
    [THETA0] = ROT_NUMBER_INPUT("theta0_rad", "rad", 0, -DBL_MAX, 0, 0.0, "angle at the start"),
    [OMEGA0] = ROT_NUMBER_INPUT("omega0_rad_per_s", "rad/s", 0, -DBL_MAX, 0, 0.0,
                                "angular velocity at the start"),
    [START] = ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds"),
    [AXIS] = {"axis", "1", ROT_INPUT_CHOICE | ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,
              "direction of the axle, in the body's own axes", axes},
    [THROUGH] = {"through", "m", ROT_INPUT_CHOICE | ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,
                 "a point of the axle, in the body's own axes; default: of the axle that the body "
                 "names, or its centre of mass",
                 points},
};

static int unit_axis(const rot_given *given, double axis[3]) {
  static const double along[3][3] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  return rot_input_axis(
      given->is == ROT_INPUT_VECTOR ? given->x : along[given->is ? given->option : 0], axis);
}

double rot_axle_inertia_at(const rot_axle_scene *scene, double t) {
  const size_t n = scene->n_inertia, past = rot_upper_bound(n, scene->inertia_time_s, t);
  if (n == 0) return scene->linear.inertia_kg_m2;
  const double *at = scene->inertia_time_s, *moment = scene->inertia_kg_m2;
  if (past == 0) return moment[0];
  if (past == n) return moment[n - 1];
  const size_t i = past - 1;
  const double width = at[i + 1] - at[i];
  return moment[i] * ((at[i + 1] - t) / width) + moment[i + 1] * ((t - at[i]) / width);
}

static rot_status build_inertia(const rot_given given[], rot_axle_scene *scene, rot_refusal *no) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  const rot_given *body = &given[BODY], *through = &given[THROUGH];
  double axis[3], *inertia = &scene->linear.inertia_kg_m2;
  if (!unit_axis(&given[AXIS], axis)) return rot_refuse(no, AXIS, "must not be 0");
  if (body->is == ROT_INPUT_INERTIA) {
    const inertia_knots *knots = body->object;
    scene->n_inertia = knots->n;
    scene->inertia_time_s = knots->time_s;
    scene->inertia_kg_m2 = knots->inertia_kg_m2;
    *inertia = rot_axle_inertia_at(scene, scene->linear.start_s);
  } else if (body->is == ROT_INPUT_BODY) {
    const double *point = through->is == ROT_INPUT_VECTOR ? through->x
                          : !through->is                  ? NULL
                          : through->option == 0          ? body->body.centre_m
                                                          : origin;
    *inertia = rot_body_moment(&body->body, axis, point);
    if (*inertia > 0.0 && *inertia < DBL_MIN) {
      return rot_refuse(no, BODY, "has a moment of inertia below what double precision resolves");
    }
  } else {
    *inertia = body->x[0];
  }
  if (*inertia > 0.0 && *inertia < INFINITY) return ROT_OK;
  return rot_refuse(no, BODY, "must have a moment of inertia, finite and greater than 0; it is %g",
                    *inertia);
}

rot_status rot_axle_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_axle_built *built = to;
  rot_axle_scene *scene = &built->scene;
  memset(built, 0, sizeof *built);
  scene->linear.start_s = rot_input_number(rot_axle_inputs, given, START);
  scene->linear.theta0_rad = rot_input_number(rot_axle_inputs, given, THETA0);
  scene->linear.omega0_rad_per_s = rot_input_number(rot_axle_inputs, given, OMEGA0);
  rot_status status = build_inertia(given, scene, no);
  if (status != ROT_OK) return status;
  status = rot_axle_load(&given[TORQUE], &given[RESISTANCE], store, scene, &built->own);
  if (status == ROT_EVALUE) return rot_refuse(no, TORQUE, "adds up beyond double precision");
  return status;
}

double rot_axle_start_s(const void *scene) {
  return ((const rot_axle_scene *)scene)->linear.start_s;
}

/* ---- columns --------------------------------------------------------------------------------- */

const rot_column_of rot_axle_all_columns[ROT_AXLE_ALL_COLUMNS] = {
    ROT_COLUMN("theta_rad", "rad", 1 + ROT_THETA),
    ROT_COLUMN("omega_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    ROT_COLUMN("applied_torque_n_m", "N m", 0),
    ROT_COLUMN("damping_torque_n_m", "N m", 0),
    ROT_COLUMN("net_torque_n_m", "N m", 0),
    ROT_COLUMN("angular_momentum_kg_m2_per_s", "kg m^2/s", 0),
    ROT_COLUMN("rotational_kinetic_energy_j", "J", 0),
    {"moment_of_inertia_kg_m2", 0, ROT_AS_SHOWN, "kg m^2", 0, 0},
    {"alpha_rad_per_s2", 0, ROT_AS_SHOWN, "rad/s^2", 0, 0},
#define X(name, unit) {name, 0, ROT_AS_SHOWN, unit, 0, 0},
    ROT_AXLE_MASS_COLUMNS(X, "") ROT_AXLE_MASS_COLUMNS(X, "_1") ROT_AXLE_MASS_COLUMNS(X, "_2")
#undef X
};
/* Their places: of a single mass, of two. */
enum { MOMENT = 7, ALPHA, SINGLE, FIRST = SINGLE + ROT_AXLE_OF_MASS };

int rot_axle_shows(const void *built, size_t column) {
  const rot_axle_built *axle = built;
  const double *mass = axle->rope.mass_kg;
  if (column < MOMENT) return 1;
  if (column == MOMENT) return axle->scene.n_inertia > 0;
  if (column == ALPHA) return mass[0] > 0.0;
  return mass[0] > 0.0 && (column < FIRST) == (mass[1] == 0.0);
}

static rot_axle_columns columns_of(void *const column[]) {
  rot_axle_columns out;
  size_t i = 0;
#define X(type, name) out.name = column[i++];
  ROT_AXLE_COLUMNS(X)
#undef X
  return out;
}

/* ---- runs ------------------------------------------------------------------------------------ */

rot_status rot_axle_reduce(const void *built, unsigned without, rot_store *store, void *to) {
  const rot_axle_built *whole = built;
  rot_axle_built *reduced = to;
  rot_axle_scene *scene = &reduced->scene;
  *reduced = *whole;
  if (!without) return ROT_OK;
  rot_term *terms = rot_store_get(store, scene->n_terms, sizeof *terms);
  if (!terms) return ROT_ENOMEM;
  *scene = rot_axle_without(&whole->scene, without, terms);
  scene->n_breaks = whole->own.n;
  scene->breaks_s = whole->own.breaks_s;
  return gather_breaks(scene, store);
}

/* Beside those of the scene that was solved: all torques, and what scenes of their own add. */
static void finish_rows(const rot_axle_built *axle, const rot_task *task, void *const column[],
                        const rot_info *info) {
  const rot_axle_scene *scene = &axle->scene;
  const rot_axle_columns out = columns_of(column);
  const size_t n = info->rows_done;
  double *inertia = column[MOMENT], *mass[2][ROT_AXLE_OF_MASS];
  if (task->without) {
    rot_axle_scene_torques(scene, n, task->time_s, out.theta_rad, out.omega_rad_per_s,
                           out.applied_torque_n_m, out.damping_torque_n_m, out.net_torque_n_m);
  }
  for (size_t i = 0; i < n && scene->n_inertia; i++) {
    inertia[i] = rot_axle_inertia_at(scene, task->time_s[i]);
  }
  for (size_t i = 0; i < n && axle->geared; i++) {
    out.applied_torque_n_m[i] = axle->gears.applied_n_m + 0.0 * out.applied_torque_n_m[i];
    out.damping_torque_n_m[i] = out.net_torque_n_m[i] - out.applied_torque_n_m[i];
  }
  if (axle->rope.mass_kg[0] == 0.0) return;
  for (int k = 0; k < ROT_AXLE_OF_MASS; k++) {
    mass[0][k] = column[(axle->rope.mass_kg[1] > 0.0 ? FIRST : SINGLE) + k];
    mass[1][k] = column[FIRST + ROT_AXLE_OF_MASS + k];
  }
  rot_axle_rope_rows(&axle->rope, scene->linear.inertia_kg_m2, n, &out, column[ALPHA],
                     (double *const(*)[ROT_AXLE_OF_MASS])mass);
}

/* By a closed form, or integrated where there is none. */
static rot_status run(rot_axle_model closed, const rot_axle_built *axle, const rot_task *task,
                      rot_method method, const rot_rows *rows, const rot_hooks *hooks,
                      rot_info *info) {
  const rot_axle_columns out = columns_of(rows->column);
  const rot_axle_ode_options options = {task->accuracy, task->max_steps,
                                        task->asked ? method : ROT_METHOD_NONE, task->resolution};
  const rot_axle_flows flows = {rows->flow, rows->flow_error};
  rot_axle_built solved;
  rot_store store = {0};
  rot_events own = {0}, *events = rows->events ? rows->events : &own;
  rot_info_clear(info, rot_turning);
  rot_status status = info->status = rot_axle_reduce(axle, task->without, &store, &solved);
  if (status == ROT_OK) {
    status = closed ? closed(&solved.scene, task->n, task->time_s, &out, events, hooks, info)
                    : rot_axle_integrate(&solved.scene, &options, task->n, task->time_s, &out,
                                         events, rows->flow ? &flows : NULL, hooks, info);
  }
  if (status == ROT_OK && closed && rows->flow) {
    const rot_axle_motion motion = {
        &solved.scene, task->flows_of_whole ? &axle->scene : &solved.scene, closed, events, info};
    status = info->status = rot_axle_flows_of(&motion, task->n, task->time_s, &flows, hooks);
  }
  if (rows->flow && axle->geared) {
    rot_axle_flows_geared(&solved.scene, &axle->gears, info->rows_done, task->time_s, out.theta_rad,
                          &flows);
  }
  finish_rows(axle, task, rows->column, info);
  rot_events_free(&own);
  rot_store_free(&store);
  return status;
}

#define RUN(name, closed)                                                                          \
  static rot_status name(const void *scene, const rot_task *task, rot_method method,               \
                         const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {           \
    return run(closed, scene, task, method, rows, hooks, info);                                    \
  }
RUN(run_free, rot_axle_free_scene)
RUN(run_linear, rot_axle_linear_scene)
RUN(run_skater, rot_axle_skater)
RUN(run_drag, rot_axle_drag)
RUN(run_forced, rot_axle_forced)
RUN(run_oscillator, rot_axle_oscillator)
RUN(run_pendulum, rot_axle_pendulum)
RUN(run_bands, rot_axle_bands)
RUN(run_integrated, NULL)

const rot_model_run rot_axle_runs[ROT_AXLE_MODELS] = {
    {ROT_METHOD_NONE, run_free},        {ROT_METHOD_NONE, run_linear},
    {ROT_METHOD_NONE, run_skater},      {ROT_METHOD_NONE, run_drag},
    {ROT_METHOD_NONE, run_forced},      {ROT_METHOD_NONE, run_oscillator},
    {ROT_METHOD_NONE, run_pendulum},    {ROT_METHOD_NONE, run_bands},
    {ROT_METHOD_RK8PD, run_integrated}, {ROT_METHOD_RADAU, run_integrated},
};
