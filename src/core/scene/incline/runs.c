#include "scene/incline/runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/fixed.h"
#include "scene/incline/ledger.h"
#include "scene/incline/time_scales.h"

const rot_column_of rot_incline_all_columns[ROT_INCLINE_ALL_COLUMNS] = {
    {"x_m", 0, 0, "m", 1 + ROT_INCLINE_X, 0},
    {"v_m_per_s", 0, 0, "m/s", 1 + ROT_INCLINE_V, 0},
    {"theta_rad", 0, 0, "rad", 1 + ROT_INCLINE_THETA, 0},
    {"omega_rad_per_s", 0, 0, "rad/s", 1 + ROT_INCLINE_OMEGA, 0},
    {"slip_speed_m_per_s", 0, 0, "m/s", 0, 0},
    {"friction_force_n", 0, 0, "N", 0, 0},
    {"translational_kinetic_energy_j", 0, 0, "J", 0, 0},
    {"rotational_kinetic_energy_j", 0, 0, "J", 0, 0},
    {"potential_energy_j", 0, 0, "J", 0, 0},
    {"slip_heat_j", 0, 0, "J", 0, 0},
    {"rolling_heat_j", 0, 0, "J", 0, 0},
    {"rolling", 1, 0, "", 0, 0},
    {"drag_force_n", 0, ROT_INCLINE_OUTER, "N", 0, 0},
    {"applied_force_n", 0, ROT_INCLINE_OUTER, "N", 0, 0},
    {"drag_heat_j", 0, ROT_INCLINE_OUTER, "J", 0, 0}};
enum { DRAG_FORCE = ROT_INCLINE_ALL_COLUMNS - 3, APPLIED_FORCE, DRAG_HEAT };

static rot_incline_columns columns_of(void *const column[]) {
  rot_incline_columns out;
  size_t i = 0;
#define X(type, name) out.name = column[i++];
  ROT_INCLINE_COLUMNS(X)
#undef X
  return out;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* row => flow[][i]; flow_error[]: maximum over the rows. */
static void fill_flows(const rot_incline_params *p, const rot_incline_place *at, int exact,
                       const rot_info *info, const rot_rows *rows, size_t i) {
  double value[ROT_INCLINE_FLOWS], error[ROT_INCLINE_FLOWS];
  rot_incline_flow(p, at, exact, info, value, error);
  for (int k = 0; k < ROT_INCLINE_FLOWS; k++) {
    rows->flow[k][i] = value[k];
    rows->flow_error[k] = fmax(rows->flow_error[k], error[k]);
  }
}

/* Rows at events => columns of `to`; frees `from`. */
static rot_status give_event_rows(const rot_incline_params *p, rot_incline_event_rows *from,
                                  int exact, const rot_info *info, rot_event_rows *to) {
  double error[ROT_INCLINE_FLOWS]; /* not used: the rows have at least this error */
  rot_status status = ROT_OK;
  for (size_t i = 0; i < from->count && status == ROT_OK; i++) {
    const rot_incline_row *row = &from->row[i];
    double *value = rot_event_rows_add(to, row->time_s);
    if (!value) {
      status = ROT_ENOMEM;
      break;
    }
#define X(type, name) *value++ = (double)row->name;
    ROT_INCLINE_COLUMNS(X)
#undef X
    *value++ = row->drag_force_n;
    *value++ = row->applied_force_n;
    *value++ = row->drag_heat_j;
    const rot_incline_place at = {row->time_s,
                                  row->x_m,
                                  row->slip_heat_j,
                                  row->rolling_heat_j,
                                  {row->applied_work_j, row->drag_heat_j, row->friction_impulse_n_s,
                                   row->drag_impulse_n_s, row->applied_impulse_n_s,
                                   row->resistance_impulse_n_m_s}};
    rot_incline_flow(p, &at, exact, info, value, error);
  }
  rot_incline_event_rows_free(from);
  return status;
}

/* (scene, task) => rows, flows, event rows, by the closed form. */
static rot_status run_exact(const void *of, const rot_task *task, rot_method method,
                            const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const rot_incline_params *p = &((const rot_incline_scene *)of)->slope;
  const rot_incline_columns out = columns_of(rows->column);
  rot_incline_event_rows log = {0, 0, NULL};
  (void)method;
  const rot_status ran = rot_incline_run(p, task->n, task->time_s, &out, rows->events,
                                         rows->at_events ? &log : NULL, hooks, info);
  for (size_t i = 0; rows->flow && i < info->rows_done; i++) {
    const rot_incline_place at = {
        task->time_s[i], out.x_m[i], out.slip_heat_j[i], out.rolling_heat_j[i], {0.0}};
    fill_flows(p, &at, 1, info, rows, i);
  }
  const rot_status given = give_event_rows(p, &log, 1, info, rows->at_events);
  return info->status = ran == ROT_OK ? given : ran;
}

/* Destination of the sums: the flow columns, or memory allocated here. */
static rot_status open_sums(size_t n, const rot_rows *rows, rot_incline_sums *sums,
                            double **memory) {
  enum { SUMS = ROT_INCLINE_FLOWS - ROT_INCLINE_SUM };
  double *at[SUMS];
  *memory = rows->flow ? NULL : malloc((n ? n : 1) * SUMS * sizeof **memory);
  if (!rows->flow && !*memory) return ROT_ENOMEM;
  for (size_t k = 0; k < SUMS; k++) {
    at[k] = rows->flow ? rows->flow[ROT_INCLINE_SUM + k] : *memory + n * k;
  }
  *sums = (rot_incline_sums){at[0],
                             at[1],
                             at[2],
                             at[3],
                             at[4],
                             at[5],
                             rows->column[DRAG_FORCE],
                             rows->column[APPLIED_FORCE],
                             {0.0}};
  sums->drag_heat_j = rows->column[DRAG_HEAT];
  return ROT_OK;
}

/* (scene, task) => rows, flows, event rows, by integration. */
static rot_status run_integrated(const void *of, const rot_task *task, rot_method method,
                                 const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const rot_incline_scene *scene = of;
  const rot_incline_columns out = columns_of(rows->column);
  rot_time_scales time_scales;
  rot_incline_time_scales_of_start(scene, &time_scales);
  const rot_incline_ode_options options = {
      task->accuracy, task->max_steps, rot_task_method(task, method), task->resolution,
      rot_fixed_task_step_s(task, scene->slope.start_s, &time_scales)};
  rot_incline_event_rows log = {0, 0, NULL};
  rot_incline_sums sums;
  double *memory;
  if (open_sums(task->n, rows, &sums, &memory) != ROT_OK) {
    rot_info_clear(info, rot_incline_measures);
    return info->status = ROT_ENOMEM;
  }
  const rot_status ran =
      rot_incline_integrate(scene, &options, task->n, task->time_s, &out, &sums, rows->events,
                            rows->at_events ? &log : NULL, hooks, info);
  for (size_t i = 0; rows->flow && i < info->rows_done; i++) {
    const rot_incline_place at = {task->time_s[i],
                                  out.x_m[i],
                                  out.slip_heat_j[i],
                                  out.rolling_heat_j[i],
                                  {sums.applied_work_j[i], sums.drag_heat_j[i],
                                   sums.friction_impulse_n_s[i], sums.drag_impulse_n_s[i],
                                   sums.applied_impulse_n_s[i], sums.resistance_impulse_n_m_s[i]}};
    fill_flows(&scene->slope, &at, 0, info, rows, i);
  }
  for (int k = 0; rows->flow && k < ROT_INCLINE_FLOWS - ROT_INCLINE_SUM; k++) {
    rows->flow_error[ROT_INCLINE_SUM + k] += sums.error[k];
  }
  if (rows->flow) {
    rows->flow_error[ROT_INCLINE_SLIP_HEAT] += sums.error[ROT_INCLINE_OF_SLIP_HEAT];
    rows->flow_error[ROT_INCLINE_ROLLING_HEAT] += sums.error[ROT_INCLINE_OF_ROLLING_HEAT];
  }
  const rot_status given = give_event_rows(&scene->slope, &log, 0, info, rows->at_events);
  free(memory);
  return info->status = ran == ROT_OK ? given : ran;
}

const rot_model_run rot_incline_runs[ROT_INCLINE_MODELS] = {
    {ROT_METHOD_NONE, run_exact},
    {ROT_METHOD_RK8PD, run_integrated},
    {ROT_METHOD_RADAU, run_integrated},
    ROT_FIXED_METHODS(run_integrated),
};
