#include "scene/free/scene.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body/inertia.h"
#include "maths/attitude.h"
#include "scene/free/exact.h"
#include "scene/free/gyrostat.h"
#include "scene/free/ode.h"
#include "scene/free/steps.h"

/* ---- inputs ---------------------------------------------------------------------------------- */

const char *const rot_free_axes[] = {"body", "space", NULL};

enum { BODY, OMEGA0, COMMON };

const rot_input rot_free_inputs[ROT_FREE_INPUTS] = {
    {"body", "kg*m^2", ROT_INPUT_BODY | ROT_INPUT_VECTOR, 1, ROT_FREE_ANY, NAN,
     "about its centre of mass: a body, or its three principal moments of inertia", NULL},
    ROT_FREE_OMEGA0_INPUT,
    ROT_FREE_COMMON_INPUTS};

static rot_status call_torque(double t, const double omega[3], const double q[4], double torque[3],
                              void *ctx) {
  const rot_law *law = ctx;
  double argument[8] = {t};
  memcpy(argument + 1, omega, 3 * sizeof *omega);
  memcpy(argument + 4, q, 4 * sizeof *q);
  return law->call(argument, torque, law->ctx);
}

/* A diagonal tensor keeps its axes and its numbers. */
rot_status rot_free_build_moments(const double inertia[6], const double second[6],
                                  rot_free_params *p) {
  rot_principal principal;
  static const double along[4] = {1.0, 0.0, 0.0, 0.0};
  memcpy(p->axes, along, sizeof along);
  if (inertia[ROT_XY] == 0.0 && inertia[ROT_XZ] == 0.0 && inertia[ROT_YZ] == 0.0) {
    memcpy(p->moment_kg_m2, inertia, 3 * sizeof *inertia);
    return ROT_OK;
  }
  if (rot_inertia_principal(second, 1e-12, &principal) != ROT_OK) return ROT_ERANGE;
  double *s = principal.second;
  if (s[2] < 0.0) { /* a turned rod: a rounding error below 0 */
    for (int i = 0; i < 3; i++) s[i] = fmax(s[i], 0.0);
    principal.moment[0] = s[1] + s[2];
    principal.moment[1] = s[0] + s[2];
    principal.moment[2] = s[0] + s[1];
  }
  memcpy(p->moment_kg_m2, principal.moment, sizeof principal.moment);
  (void)rot_attitude_from(ROT_FORM_MATRIX, principal.axes, NULL, p->axes);
  p->turned = p->axes[0] != 1.0;
  p->given = 2e-15;
  return ROT_OK;
}

/* An axis without moment of inertia: no spin about it, and no torque. */
static int spins_freely(const rot_free_params *p) {
  double omega[3], q[4];
  memcpy(omega, p->omega0_rad_per_s, sizeof omega);
  memcpy(q, p->q0, sizeof q);
  rot_free_principal(p, omega, q);
  const int acts = p->law || p->torque[0] != 0.0 || p->torque[1] != 0.0 || p->torque[2] != 0.0;
  for (int i = 0; i < 3; i++) {
    if (p->moment_kg_m2[i] == 0.0 && (acts || omega[i] != 0.0)) return 0;
  }
  return 1;
}

rot_status rot_free_build_rest(const rot_input inputs[], const rot_given given[], size_t omega0,
                               size_t common, rot_free_built *built, rot_refusal *no) {
  rot_free_params *p = &built->params;
  const rot_given *of = given + common;
  const rot_given *torque = &of[ROT_FREE_TORQUE], *breaks = &of[ROT_FREE_BREAKS];
  int any = 0;
  for (int i = 0; i < 3; i++) {
    if (p->moment_kg_m2[i] < 0.0) return rot_refuse(no, 0, "must have no negative moment");
    any |= p->moment_kg_m2[i] > 0.0;
  }
  if (!any) return rot_refuse(no, 0, "must have a moment of inertia");
  rot_input_vector(&given[omega0], p->omega0_rad_per_s);
  p->q0[0] = 1.0;
  if (of[ROT_FREE_ATTITUDE0].is) {
    (void)rot_attitude_from(ROT_FORM_QUATERNION, of[ROT_FREE_ATTITUDE0].x, NULL, p->q0);
  }
  if (torque->is == ROT_INPUT_LAW) {
    built->law = torque->law;
    p->law = call_torque;
    p->ctx = &built->law;
  } else {
    rot_input_vector(torque, p->torque);
  }
  p->in_space = of[ROT_FREE_AXES].is && of[ROT_FREE_AXES].option == 1;
  p->damping_per_s = rot_input_number(inputs, given, common + ROT_FREE_DAMPING);
  p->start_s = rot_input_number(inputs, given, common + ROT_FREE_START);
  p->n_breaks = breaks->is ? breaks->n : 0;
  p->breaks_s = breaks->x;
  if (!spins_freely(p)) {
    return rot_refuse(no, 0,
                      "can neither spin about an axis without moment of inertia nor bear a "
                      "torque there");
  }
  return ROT_OK;
}

rot_status rot_free_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  (void)store;
  rot_free_built *built = to;
  const rot_given_body *body = &given[BODY].body;
  memset(built, 0, sizeof *built);
  if (given[BODY].is == ROT_INPUT_VECTOR) {
    built->params.axes[0] = 1.0;
    rot_input_vector(&given[BODY], built->params.moment_kg_m2);
  } else if (rot_free_build_moments(body->inertia_kg_m2, body->second_kg_m2, &built->params) !=
             ROT_OK) {
    return rot_refuse(no, BODY, "must have finite principal moments");
  }
  return rot_free_build_rest(rot_free_inputs, given, OMEGA0, COMMON, built, no);
}

double rot_free_start(const void *scene) { return ((const rot_free_params *)scene)->start_s; }

/* ---- columns --------------------------------------------------------------------------------- */

#define X(type, name) {#name, 0, 0, NULL, 0, 0},
const rot_column_of rot_free_all_columns[ROT_FREE_ALL_COLUMNS] = {ROT_FREE_COLUMNS(X)};
#undef X

static rot_free_columns columns_of(void *const column[]) {
  rot_free_columns out;
  size_t i = 0;
#define X(type, name) out.name = column[i++];
  ROT_FREE_COLUMNS(X)
#undef X
  out.rotor_omega = out.rotor_momentum = NULL;
  return out;
}

/* ---- runs ------------------------------------------------------------------------------------ */

rot_status rot_free_run_closed(rot_free_rows_of *form, const void *scene, const rot_task *task,
                               const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const rot_free_columns out = columns_of(rows->column);
  return form(scene, task->n, task->time_s, &out, rows->events, hooks, info);
}

rot_status rot_free_run_exact(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return rot_free_run_closed(rot_free_exact, scene, task, rows, hooks, info);
}

rot_status rot_free_run_gyrostat(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return rot_free_run_closed(rot_free_gyrostat, scene, task, rows, hooks, info);
}

/* Room for the ledger, which these runs fill. */
static double *ledger_of(size_t n, double *flow[ROT_FREE_FLOWS]) {
  double *values = malloc((n ? n : 1) * ROT_FREE_FLOWS * sizeof *values);
  for (size_t k = 0; k < ROT_FREE_FLOWS && values; k++) flow[k] = values + k * n;
  return values;
}

static rot_status no_memory(rot_info *info) {
  rot_info_clear(info, rot_free_measures);
  return info->status = ROT_ENOMEM;
}

rot_status rot_free_run_integrated(ROT_FREE_RUN_ARGUMENTS) {
  const rot_free_columns out = columns_of(rows->column);
  const rot_free_ode_options options = {task->accuracy, task->max_steps,
                                        task->asked ? method : ROT_METHOD_NONE, task->resolution};
  double *flow[ROT_FREE_FLOWS], errors[ROT_FREE_FLOWS], *values = ledger_of(task->n, flow);
  if (!values) return no_memory(info);
  const rot_status status = rot_free_integrate(scene, &options, task->n, task->time_s, &out, flow,
                                               errors, rows->events, hooks, info);
  free(values);
  return status;
}

rot_status rot_free_run_steps(ROT_FREE_RUN_ARGUMENTS) {
  const rot_free_params *p = scene;
  const rot_free_columns out = columns_of(rows->column);
  const double *t = task->time_s;
  const double span =
      task->n ? fmax(fabs(t[0] - p->start_s), fabs(t[task->n - 1] - p->start_s)) : 0.0;
  const rot_free_step_options options = {method, rot_free_default_step(p, method, span),
                                         task->max_steps};
  double *flow[ROT_FREE_FLOWS], errors[ROT_FREE_FLOWS], *values = ledger_of(task->n, flow);
  if (!values) return no_memory(info);
  const rot_status status =
      rot_free_step_through(p, &options, task->n, t, &out, flow, errors, hooks, info);
  free(values);
  return status;
}

const rot_model_run rot_free_runs[ROT_FREE_MODELS] = {
    {ROT_METHOD_NONE, rot_free_run_exact},       {ROT_METHOD_NONE, rot_free_run_gyrostat},
    {ROT_METHOD_RK8PD, rot_free_run_integrated}, {ROT_METHOD_RADAU, rot_free_run_integrated},
    {ROT_METHOD_EULER, rot_free_run_steps},      {ROT_METHOD_SEMI_IMPLICIT, rot_free_run_steps},
    {ROT_METHOD_RK4, rot_free_run_steps},        {ROT_METHOD_SPLIT, rot_free_run_steps},
};
