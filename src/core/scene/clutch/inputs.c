#include "scene/clutch/inputs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/parts.h"
#include "engine/loads.h"

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { BODY_1, BODY_2, CAPACITY, STATIC, TORQUE, THETA0, OMEGA0, ENGAGE, START };

#define BODY(name)                                                                                 \
  {                                                                                                \
    name, "kg*m^2", ROT_BODY_KINDS, 1, 0.0, DBL_MAX, 1, NAN,                                       \
        "a body, of which Izz counts, or its moment of inertia", NULL                              \
  }
#define STATE(name, unit, words)                                                                   \
  { name, unit, ROT_INPUT_NUMBERS, 0, ROT_NO_DOMAIN, 0.0, words, NULL }

const rot_input rot_clutch_inputs[ROT_CLUTCH_INPUTS] = {
    [BODY_1] = BODY("body_1"),
    [BODY_2] = BODY("body_2"),
    [CAPACITY] =
        ROT_NUMBER_INPUT("capacity_n_m", "N*m", 1, 0.0, 0, NAN, "torque of the slipping clutch"),
    [STATIC] = ROT_NUMBER_INPUT("static_capacity_n_m", "N*m", 0, 0.0, 0, NAN,
                                "largest torque of the locked clutch; default: the slipping one's"),
    [TORQUE] = {"torque", "N*m",
                ROT_INPUT_NUMBER | ROT_INPUT_TORQUE | ROT_INPUT_LIST | ROT_INPUT_NOTHING, 0,
                ROT_NO_DOMAIN, NAN,
                "constant between jumps: a list with a law or nothing for each body", NULL},
    [THETA0] = STATE("theta0_rad", "rad", "of the two bodies at the start"),
    [OMEGA0] = STATE("omega0_rad_per_s", "rad/s", "of the two bodies at the start"),
    [ENGAGE] = {"engage_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, DBL_MAX, 0, -INFINITY,
                "the clutch is pressed from then on", NULL},
    [START] = ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds"),
};

/* torque input => steps in time; a refusal if it is not piecewise constant. */
static rot_status steps_of(const rot_given *given, rot_store *store, rot_steps *steps,
                           rot_refusal *no) {
  static const char *const words = "must be constant between jumps";
  const size_t input = TORQUE;
  rot_loads loads;
  const rot_status status = rot_loads_of(given, store, &loads);
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

/* input => numbers of the two bodies; absent, or a single 0: both 0. */
static rot_status both_of(const rot_given given[], size_t input, double x[2], rot_refusal *no) {
  const rot_given *g = &given[input];
  if (g->is && g->n != 2 && !(g->n == 1 && g->x[0] == 0.0)) {
    return rot_refuse(no, input, "must have 2 numbers, one for each body; it has %zu", g->n);
  }
  for (size_t i = 0; i < 2; i++) x[i] = g->is ? g->x[g->n == 2 ? i : 0] : 0.0;
  return ROT_OK;
}

rot_status rot_clutch_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_clutch_params *p = to;
  memset(p, 0, sizeof *p);
#define NUMBER(input) rot_input_number(rot_clutch_inputs, given, input)
  const rot_given *torque = &given[TORQUE];
  if (torque->is && !(torque->is == ROT_INPUT_LIST && torque->n == 2)) {
    return rot_refuse(no, TORQUE, "must be a list with one item for each of the 2 bodies");
  }
  rot_status status = both_of(given, THETA0, p->theta0_rad, no);
  if (status == ROT_OK) status = both_of(given, OMEGA0, p->omega0_rad_per_s, no);
  for (size_t i = 0; i < 2 && status == ROT_OK; i++) {
    static const rot_given nothing = {0};
    status = rot_body_moments(given, BODY_1 + i, &p->inertia_kg_m2[i], no);
    if (status != ROT_OK) return status;
    status = steps_of(torque->is ? &torque->item[i] : &nothing, store, &p->torque_n_m[i], no);
    if (status == ROT_EVALUE) rot_refused_in(no, "item %zu", i + 1);
  }
  if (status != ROT_OK) return status;
  p->capacity_n_m = NUMBER(CAPACITY);
  p->static_n_m = given[STATIC].is ? NUMBER(STATIC) : p->capacity_n_m;
  if (p->static_n_m < p->capacity_n_m) {
    return rot_refuse_numbers(no, STATIC, "must be at least the slipping capacity, %s; it is %s",
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
