#include "scene/free/scene.h"

#include <math.h>
#include <stdlib.h>

#include "scene/free/exact.h"
#include "scene/free/gyrostat.h"
#include "scene/free/ledger.h"
#include "scene/free/ode.h"
#include "scene/free/steps.h"

/* ---- columns --------------------------------------------------------------------------------- */

uint64_t rot_free_shows(const void *scene) {
  const rot_free_params *p = scene;
  return ((uint64_t)1 << (ROT_FREE_OWN_COLUMNS + 2 * p->n_rotors)) - 1;
}

void rot_free_out_of(void *const column[], rot_free_out *out) {
  size_t i = 0;
#define X(type, name) out->columns.name = column[i++];
  ROT_FREE_COLUMNS(X)
#undef X
  for (size_t k = 0; k < ROT_FREE_MAX_ROTORS; k++) {
    out->omega[k] = column[i++];
    out->momentum[k] = column[i++];
  }
  out->columns.rotor_omega = out->omega;
  out->columns.rotor_momentum = out->momentum;
}

/* ---- runs ------------------------------------------------------------------------------------ */

rot_status rot_free_run_closed(rot_free_rows_of *form, const void *scene, const rot_task *task,
                               const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  rot_free_out out;
  rot_free_out_of(rows->column, &out);
  return form(scene, task->n, task->time_s, &out.columns, rows->events, hooks, info);
}

rot_status rot_free_run_exact(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  const rot_status status = rot_free_run_closed(rot_free_exact, scene, task, rows, hooks, info);
  if (rows->flow && status == ROT_OK) rot_free_exact_flows(scene, task, rows);
  return status;
}

rot_status rot_free_run_gyrostat(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  const rot_status status = rot_free_run_closed(rot_free_gyrostat, scene, task, rows, hooks, info);
  if (rows->flow && status == ROT_OK) rot_free_gyrostat_flows(scene, task, rows, info);
  return status;
}

/* Flows of an integrated run: columns of the caller, or memory allocated here. */
typedef struct flows {
  double *flow[ROT_FREE_FLOWS], error[ROT_FREE_FLOWS], *memory;
} flows;

static int open_flows(size_t n, const rot_rows *rows, flows *f) {
  f->memory = rows->flow ? NULL : malloc((n ? n : 1) * ROT_FREE_FLOWS * sizeof *f->memory);
  if (!rows->flow && !f->memory) return 0;
  for (size_t k = 0; k < ROT_FREE_FLOWS; k++) {
    f->flow[k] = rows->flow ? rows->flow[k] : f->memory + k * n;
    f->error[k] = 0.0;
  }
  return 1;
}

static rot_status close_flows(flows *f, const rot_rows *rows, rot_status status) {
  for (size_t k = 0; k < ROT_FREE_FLOWS && rows->flow; k++) rows->flow_error[k] = f->error[k];
  free(f->memory);
  return status;
}

static rot_status no_memory(rot_info *info) {
  rot_info_clear(info, rot_free_measures);
  return info->status = ROT_ENOMEM;
}

rot_status rot_free_run_integrated(ROT_FREE_RUN_ARGUMENTS) {
  const rot_free_ode_options options = {task->accuracy, task->max_steps,
                                        task->asked ? method : ROT_METHOD_NONE, task->resolution};
  rot_free_out out;
  flows f;
  rot_free_out_of(rows->column, &out);
  if (!open_flows(task->n, rows, &f)) return no_memory(info);
  return close_flows(&f, rows,
                     rot_free_integrate(scene, &options, task->n, task->time_s, &out.columns,
                                        f.flow, f.error, rows->events, hooks, info));
}

/* Default step if none is given. */
rot_status rot_free_run_steps(ROT_FREE_RUN_ARGUMENTS) {
  const rot_free_params *p = scene;
  const double *t = task->time_s;
  const double span =
      task->n ? fmax(fabs(t[0] - p->start_s), fabs(t[task->n - 1] - p->start_s)) : 0.0;
  const double step_s = task->step_s > 0.0 ? task->step_s : rot_free_default_step(p, method, span);
  const rot_free_step_options options = {method, step_s, task->max_steps};
  rot_free_out out;
  flows f;
  rot_free_out_of(rows->column, &out);
  if (!open_flows(task->n, rows, &f)) return no_memory(info);
  const rot_status status =
      rot_free_step_through(p, &options, task->n, t, &out.columns, f.flow, f.error, hooks, info);
  info->step_s = step_s;
  return close_flows(&f, rows, status);
}

const rot_model_run rot_free_runs[ROT_FREE_MODELS] = {
    {ROT_METHOD_NONE, rot_free_run_exact},       {ROT_METHOD_NONE, rot_free_run_gyrostat},
    {ROT_METHOD_RK8PD, rot_free_run_integrated}, {ROT_METHOD_RADAU, rot_free_run_integrated},
    {ROT_METHOD_EULER, rot_free_run_steps},      {ROT_METHOD_SEMI_IMPLICIT, rot_free_run_steps},
    {ROT_METHOD_RK4, rot_free_run_steps},        {ROT_METHOD_SPLIT, rot_free_run_steps},
};
