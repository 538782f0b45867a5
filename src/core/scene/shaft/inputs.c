#include "scene/shaft/inputs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/parts.h"
#include "engine/resistance.h"
#include "scene/shaft/ledger.h"
#include "scene/shaft/modal.h"
#include "scene/shaft/rigid.h"

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { BODIES, STIFFNESS, DAMPING, TORQUE, RESISTANCE, THETA0, OMEGA0, START };

#define EACH(name, unit, required, low, otherwise, words)                                          \
  { name, unit, ROT_INPUT_NUMBERS, required, low, DBL_MAX, 0, otherwise, words, NULL }

const rot_input rot_shaft_inputs[ROT_SHAFT_INPUTS] = {
    [BODIES] = {"bodies", "kg*m^2", ROT_BODY_KINDS | ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1, 0.0,
                DBL_MAX, 1, NAN,
                "in the order of the shaft: bodies, of which Izz counts, or moments", NULL},
    [STIFFNESS] = EACH("stiffness_n_m_per_rad", "N*m/rad", 1, 0.0, NAN,
                       "of the shaft between neighbours: one number, or one for each piece"),
    [DAMPING] = EACH("damping_n_m_s", "N*m*s", 0, 0.0, 0.0, "between neighbours, likewise"),
    [TORQUE] = EACH("torque", "N*m", 0, -DBL_MAX, 0.0, "constant, on each rotor from outside"),
    [RESISTANCE] = {"resistance", "N*m*s", ROT_RESISTANCES, 0, 0.0, DBL_MAX, 0, 0.0,
                    "viscous, of each rotor: numbers, resistances, one or a list",
                    rot_viscous_resistance},
    [THETA0] = EACH("theta0_rad", "rad", 0, -DBL_MAX, 0.0, "angles at the start, likewise"),
    [OMEGA0] = EACH("omega0_rad_per_s", "rad/s", 0, -DBL_MAX, 0.0,
                    "angular velocities at the start, likewise"),
    [START] = ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds"),
};

/* One number for each rotor or spring, or one for all. */
rot_status rot_shaft_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_shaft_params *p = to;
  memset(p, 0, sizeof *p);
  p->n = rot_body_count(&given[BODIES]);
  double *inertia = rot_store_get(store, p->n, sizeof *inertia);
  if (!inertia) return ROT_ENOMEM;
  rot_status status = rot_body_moments(given, BODIES, inertia, no);
  if (status != ROT_OK) return status;
  if (p->n == 1 && given[STIFFNESS].n) {
    return rot_refuse(no, STIFFNESS, "must be empty where there is one body");
  }
  if (given[TORQUE].is && given[TORQUE].n == 1 && p->n > 1 && given[TORQUE].x[0] != 0.0) {
    return rot_refuse(no, TORQUE, "must have a torque for each of the %zu bodies", p->n);
  }
  const struct {
    size_t input, n;
    const double **to;
  } each[] = {{STIFFNESS, p->n - 1, &p->stiffness_n_m_per_rad},
              {DAMPING, p->n - 1, &p->damping_n_m_s},
              {TORQUE, p->n, &p->torque_n_m},
              {THETA0, p->n, &p->theta0_rad},
              {OMEGA0, p->n, &p->omega0_rad_per_s}};
  for (size_t i = 0; i < sizeof each / sizeof *each; i++) {
    double *x = rot_store_get(store, each[i].n, sizeof *x);
    if (!x) return ROT_ENOMEM;
    status = rot_input_each(rot_shaft_inputs, given, each[i].input, each[i].n, x, no);
    if (status != ROT_OK) return status;
    *each[i].to = x;
  }
  double *viscous = rot_store_get(store, p->n, sizeof *viscous);
  if (!viscous) return ROT_ENOMEM;
  status = rot_resistance_each(&rot_shaft_inputs[RESISTANCE], RESISTANCE, &given[RESISTANCE], p->n,
                               viscous, no);
  if (status != ROT_OK) return status;
  p->viscous_n_m_s = viscous;
  p->inertia_kg_m2 = inertia;
  p->start_s = rot_input_number(rot_shaft_inputs, given, START);
  return ROT_OK;
}

double rot_shaft_start_s(const void *scene) { return ((const rot_shaft_params *)scene)->start_s; }

size_t rot_shaft_rows_per_time(const void *scene) { return ((const rot_shaft_params *)scene)->n; }

/* ---- columns --------------------------------------------------------------------------------- */

enum { THETA, OMEGA, MOMENTUM, ENERGY, SHAFT_TORQUE };

const rot_column_of rot_shaft_all_columns[ROT_SHAFT_ALL_COLUMNS] = {
    [THETA] = ROT_COLUMN("theta_rad", "rad", 1 + ROT_THETA),
    [OMEGA] = ROT_COLUMN("omega_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    [MOMENTUM] = ROT_COLUMN("angular_momentum_kg_m2_per_s", "kg m^2/s", 0),
    [ENERGY] = ROT_COLUMN("rotational_kinetic_energy_j", "J", 0),
    [SHAFT_TORQUE] = ROT_COLUMN("shaft_torque_n_m", "N m", 0)};

/* ---- runs ------------------------------------------------------------------------------------ */

/* Rows that share a step are exact to 1e-11. */
static rot_shaft_care care_of(const rot_task *task) {
  if (task->sizes_only) return ROT_SHAFT_SIZES;
  return task->accuracy >= 1e-11 ? ROT_SHAFT_EVEN : ROT_SHAFT_EACH;
}

/* (shaft, task) => rows, flows, by the modes or the rigid body. */
static rot_status run(int rigid, const void *scene, const rot_task *task, const rot_rows *rows,
                      const rot_hooks *hooks, rot_info *info) {
  const rot_shaft_params *p = scene;
  double *const *column = (double *const *)rows->column;
  const rot_shaft_columns out = {column[THETA], column[OMEGA], column[SHAFT_TORQUE]};
  const size_t n = task->n;
  const rot_status status =
      rigid ? rot_shaft_rigid(p, n, task->time_s, &out, hooks, info)
            : rot_shaft_modal(p, care_of(task), n, task->time_s, &out, hooks, info);
  for (size_t i = 0; i < info->rows_done * p->n; i++) {
    const double momentum = p->inertia_kg_m2[i % p->n] * out.omega_rad_per_s[i];
    column[MOMENTUM][i] = momentum;
    column[ENERGY][i] = 0.5 * momentum * out.omega_rad_per_s[i];
    if ((i + 1) % p->n == 0) out.shaft_torque_n_m[i] = NAN;
  }
  if (status != ROT_OK || !rows->flow) return status;
  return rot_shaft_flow(p, rigid, n, task->time_s, &out, info, rows->flow, rows->flow_error, hooks);
}

#define RUN(name, rigid)                                                                           \
  static rot_status name(const void *scene, const rot_task *task, rot_method method,               \
                         const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {           \
    (void)method;                                                                                  \
    return run(rigid, scene, task, rows, hooks, info);                                             \
  }
RUN(run_rigid, 1)
RUN(run_modal, 0)

const rot_model_run rot_shaft_runs[ROT_SHAFT_MODELS] = {{ROT_METHOD_NONE, run_rigid},
                                                        {ROT_METHOD_NONE, run_modal}};
