#include "scene/axle/runs.h"

#include "scene/axle/bands.h"
#include "scene/axle/drag.h"
#include "scene/axle/drop.h"
#include "scene/axle/forced.h"
#include "scene/axle/linear.h"
#include "engine/ode/fixed.h"
#include "scene/axle/ode.h"
#include "scene/axle/time_scales.h"
#include "scene/axle/oscillator.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"
#include "scene/axle/train.h"

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
/* Indices of columns: of a single mass, of two masses. */
enum { MOMENT = 7, ALPHA, SINGLE, FIRST = SINGLE + ROT_AXLE_OF_MASS };

/* Columns from..to - 1 as a mask. */
#define COLUMNS(from, to) (((uint64_t)1 << (to)) - ((uint64_t)1 << (from)))

uint64_t rot_axle_shows(const void *built) {
  const rot_axle_built *axle = built;
  const double *mass = axle->rope.mass_kg;
  uint64_t shown = COLUMNS(0, axle->scene.n_inertia > 0 ? MOMENT + 1 : MOMENT);
  if (!(mass[0] > 0.0)) return shown;
  shown |= COLUMNS(ALPHA, ALPHA + 1);
  return shown | (mass[1] == 0.0 ? COLUMNS(SINGLE, FIRST) : COLUMNS(FIRST, ROT_AXLE_ALL_COLUMNS));
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
  return rot_axle_gather_breaks(scene, store);
}

/* Completes the columns: all torques, and columns of special scenes. */
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

/* Adds the error due to the rounding of the coefficients of a gear train. */
static void add_rounding(const rot_axle_built *axle, const rot_task *task, rot_info *info) {
  if (!axle->is_train || !task->n) return;
  double error[2];
  const double min = axle->geared ? axle->gears.min_n_m_s : axle->scene.viscous_n_m_s;
  rot_axle_train_error(&axle->scene, axle->rounding, min, task->time_s[0],
                       task->time_s[task->n - 1], info->measure[ROT_OMEGA].largest, error);
  for (int i = 0; i < 2; i++) info->measure[i].error += error[i];
}

static double step_of(const rot_axle_built *axle, const rot_task *task) {
  rot_time_scales time_scales;
  rot_axle_time_scales_of_start(axle, &time_scales);
  return rot_fixed_task_step_s(task, axle->scene.linear.start_s, &time_scales);
}

/* (closed form or NULL, scene, task) => rows, flows: closed form, or integration. */
static rot_status run(rot_axle_model closed, const rot_axle_built *axle, const rot_task *task,
                      rot_method method, const rot_rows *rows, const rot_hooks *hooks,
                      rot_info *info) {
  const rot_axle_columns out = columns_of(rows->column);
  const rot_axle_ode_options options = {task->accuracy, task->max_steps,
                                        rot_task_method(task, method), task->resolution,
                                        rot_ode_is_fixed(method) ? step_of(axle, task) : 0.0};
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
  add_rounding(axle, task, info);
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
    ROT_FIXED_METHODS(run_integrated),
};
