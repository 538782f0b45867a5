#include "scene/clutch/inputs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/parts.h"
#include "engine/loads.h"

/* ---- inputs ---------------------------------------------------------------------------------- */

enum {
  BODY_1,
  BODY_2,
  CAPACITY,
  STATIC,
  TORQUE_1,
  TORQUE_2,
  OMEGA_1,
  OMEGA_2,
  THETA_1,
  THETA_2,
  ENGAGE,
  START
};

#define BODY(name)                                                                                 \
  {                                                                                                \
    name, "kg*m^2", ROT_BODY_KINDS, 1, 0.0, DBL_MAX, 1, NAN,                                       \
        "a body, of which Izz counts, or its moment of inertia", NULL                              \
  }
#define TORQUE(name)                                                                               \
  {                                                                                                \
    name, "N*m", ROT_INPUT_NUMBER | ROT_INPUT_TORQUE | ROT_INPUT_LIST, 0, ROT_NO_DOMAIN, NAN,      \
        "constant between jumps; a list is the sum of its laws", NULL                              \
  }
#define STATE(name, unit, words) ROT_NUMBER_INPUT(name, unit, 0, -DBL_MAX, 0, 0.0, words)

const rot_input rot_clutch_inputs[ROT_CLUTCH_INPUTS] = {
    [BODY_1] = BODY("body_1"),
    [BODY_2] = BODY("body_2"),
    [CAPACITY] =
        ROT_NUMBER_INPUT("capacity_n_m", "N*m", 1, 0.0, 0, NAN, "torque of the slipping clutch"),
    [STATIC] = ROT_NUMBER_INPUT("static_capacity_n_m", "N*m", 0, 0.0, 0, NAN,
                                "largest torque of the locked clutch; default: the slipping one's"),
    [TORQUE_1] = TORQUE("torque_1"),
    [TORQUE_2] = TORQUE("torque_2"),
    [OMEGA_1] = STATE("omega1_rad_per_s", "rad/s", "of body 1 at the start"),
    [OMEGA_2] = STATE("omega2_rad_per_s", "rad/s", "of body 2 at the start"),
    [THETA_1] = STATE("theta1_rad", "rad", "of body 1 at the start"),
    [THETA_2] = STATE("theta2_rad", "rad", "of body 2 at the start"),
    [ENGAGE] = {"engage_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, DBL_MAX, 0, -INFINITY,
                "the clutch is pressed from then on", NULL},
    [START] = STATE("start_s", "s", "when the state above holds"),
};

/* Value i + 1 holds from time i on. */
static rot_status steps_of(const rot_given given[], size_t input, rot_store *store,
                           rot_steps *steps, rot_refusal *no) {
  static const char *const words = "must be constant between jumps";
  rot_loads loads;
  const rot_status status = rot_loads_of(&given[input], store, &loads);
  if (status == ROT_EVALUE) return rot_refuse(no, input, "adds up beyond double precision");
  if (status != ROT_OK) return status;
  if (loads.n_terms || loads.knots.call || loads.motor_n_m_s != 0.0) {
    return rot_refuse(no, input, "%s", words);
  }
  const rot_torque *knots = &loads.knots;
  const double *t = knots->time_s, *tau = knots->torque_n_m;
  double *time_s = rot_store_get(store, knots->n, sizeof *time_s);
  double *value = rot_store_get(store, knots->n + 1, sizeof *value);
  size_t n = 0;
  if (!time_s || !value) return ROT_ENOMEM;
  value[0] = knots->before_n_m;
  for (size_t i = 0; i < knots->n; i++) {
    const int last = i + 1 == knots->n;
    if (!last && !(t[i + 1] > t[i])) continue;
    if (!last && tau[i] != tau[i + 1]) return rot_refuse(no, input, "%s", words);
    time_s[n] = t[i];
    value[++n] = last ? knots->after_n_m : tau[i];
  }
  *steps = (rot_steps){n, time_s, value};
  return ROT_OK;
}

rot_status rot_clutch_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_clutch_params *p = to;
  memset(p, 0, sizeof *p);
#define NUMBER(input) rot_input_number(rot_clutch_inputs, given, input)
  for (size_t i = 0; i < 2; i++) {
    rot_status status = rot_body_moments(given, BODY_1 + i, &p->inertia_kg_m2[i], no);
    if (status == ROT_OK) {
      status = steps_of(given, TORQUE_1 + i, store, &p->torque_n_m[i], no);
    }
    if (status != ROT_OK) return status;
    p->omega0_rad_per_s[i] = NUMBER(OMEGA_1 + i);
    p->theta0_rad[i] = NUMBER(THETA_1 + i);
  }
  p->capacity_n_m = NUMBER(CAPACITY);
  p->static_n_m = given[STATIC].is ? NUMBER(STATIC) : p->capacity_n_m;
  if (p->static_n_m < p->capacity_n_m) {
    return rot_refuse(no, STATIC, "must be at least the slipping capacity, %g; it is %g",
                      p->capacity_n_m, p->static_n_m);
  }
  p->start_s = NUMBER(START);
  p->engage_s = fmax(NUMBER(ENGAGE), p->start_s);
#undef NUMBER
  return ROT_OK;
}

double rot_clutch_start_s(const void *scene) { return ((const rot_clutch_params *)scene)->start_s; }

/* ---- columns --------------------------------------------------------------------------------- */

const rot_column_of rot_clutch_all_columns[ROT_CLUTCH_ALL_COLUMNS] = {
    ROT_COLUMN("theta_1_rad", "rad", 1 + ROT_THETA),
    ROT_COLUMN("omega_1_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    ROT_COLUMN("theta_2_rad", "rad", 1 + ROT_THETA),
    ROT_COLUMN("omega_2_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    ROT_COLUMN("clutch_torque_n_m", "N m", 0),
    {"heat_j", 0, 0, "J", 0, 1 + ROT_CLUTCH_HEAT},
    {"locked", 1, 0, "", 0, 0}};

/* ---- the run --------------------------------------------------------------------------------- */

static rot_status run(const void *scene, const rot_task *task, rot_method method,
                      const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  rot_clutch_columns out;
  size_t i = 0;
  (void)method;
#define X(type, name) out.name = rows->column[i++];
  ROT_CLUTCH_COLUMNS(X)
#undef X
  return rot_clutch_run(scene, task->n, task->time_s, &out, rows->flow, rows->flow_error,
                        rows->events, hooks, info);
}

const rot_model_run rot_clutch_runs[ROT_CLUTCH_MODELS] = {{ROT_METHOD_NONE, run}};
