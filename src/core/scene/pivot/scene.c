#include "scene/pivot/scene.h"

#include <math.h>

#include "scene/free/scene.h"
#include "scene/pivot/approx.h"
#include "scene/pivot/ledger.h"
#include "scene/pivot/pivot.h"

/* ---- columns --------------------------------------------------------------------------------- */

enum { POTENTIAL = ROT_FREE_ALL_COLUMNS, INCLINATION }; /* following those of free bodies */

uint64_t rot_pivot_shows(const void *scene) {
  return ~(uint64_t)0 << ROT_FREE_ALL_COLUMNS | rot_free_shows(scene);
}

static void fill_columns(const rot_free_params *p, size_t n, void *const column[]) {
  double *potential = column[POTENTIAL], *inclination = column[INCLINATION];
  for (size_t i = 0; i < n; i++) {
    double q[4], lever[3];
    for (int k = 0; k < 4; k++) q[k] = ((const double *)column[k])[i];
    rot_pivot_lever(p, q, lever);
    const double across = sqrt(lever[0] * lever[0] + lever[1] * lever[1]);
    const int held = across == 0.0 && lever[2] == 0.0; /* at its centre of mass */
    potential[i] = lever[2];
    inclination[i] = held ? NAN : atan2(across, lever[2]);
  }
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* Closed forms with gravity: rows, potential energy, flows of gravity. */
static rot_status run_heavy(rot_free_rows_of *form, const void *scene, const rot_task *task,
                            const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  rot_status status = rot_free_run_closed(form, scene, task, rows, hooks, info);
  fill_columns(scene, info->rows_done, rows->column);
  if (rows->flow && status == ROT_OK) {
    status = rot_pivot_flows(form, scene, task, rows, info, hooks);
  }
  return info->status = status;
}

static rot_status run_top(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return run_heavy(rot_pivot_top, scene, task, rows, hooks, info);
}

static rot_status run_precession(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return run_heavy(rot_pivot_precession, scene, task, rows, hooks, info);
}

static rot_status run_nutation(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return run_heavy(rot_pivot_small_nutation, scene, task, rows, hooks, info);
}

#define RUN(name)                                                                                  \
  static rot_status name(ROT_FREE_RUN_ARGUMENTS) {                                                 \
    const rot_status status = rot_free_run_##name(scene, task, method, rows, hooks, info);         \
    fill_columns(scene, info->rows_done, rows->column);                                            \
    return status;                                                                                 \
  }
RUN(exact)
RUN(gyrostat)
RUN(integrated)
RUN(steps)

const rot_model_run rot_pivot_runs[ROT_PIVOT_MODELS] = {
    {ROT_METHOD_NONE, run_top},        {ROT_METHOD_NONE, run_precession},
    {ROT_METHOD_NONE, run_nutation},   {ROT_METHOD_NONE, exact},
    {ROT_METHOD_NONE, gyrostat},       {ROT_METHOD_RK8PD, integrated},
    {ROT_METHOD_RADAU, integrated},    {ROT_METHOD_EULER, steps},
    {ROT_METHOD_SEMI_IMPLICIT, steps}, {ROT_METHOD_RK4, steps},
    {ROT_METHOD_SPLIT, steps},
};
