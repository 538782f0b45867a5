#include "scene/drive/inputs.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "ground/sort.h"
#include "body/parts.h"
#include "engine/laws.h"
#include "scene/axle/inputs.h"
#include "scene/drive/mesh.h"
#include "scene/drive/exact.h"
#include "engine/ode/fixed.h"
#include "scene/drive/ledger.h"
#include "scene/drive/time_scales.h"

/* ---- couplings and brakes -------------------------------------------------------------------- */

#define RATIO(required, otherwise)                                                                 \
  ROT_NUMBER_INPUT("ratio", "1", required, -DBL_MAX, 0, otherwise,                                 \
                   "omega over the next one's: not 0")
#define CAPACITY_INPUTS                                                                            \
  {"capacity_n_m",                                                                                 \
   "N*m",                                                                                          \
   ROT_TORQUE_KINDS,                                                                               \
   1,                                                                                              \
   0.0,                                                                                            \
   DBL_MAX,                                                                                        \
   0,                                                                                              \
   NAN,                                                                                            \
   "torque while it slips; a law is of time_s, theta_rad and the slip speed; below 0 it is 0",     \
   NULL},                                                                                          \
      ROT_NUMBER_INPUT("static_ratio", "1", 0, 1.0, 0, 1.0,                                        \
                       "largest torque at no slip over the capacity at no slip")

static const rot_input shaft_inputs[] = {
    ROT_NUMBER_INPUT("stiffness_n_m_per_rad", "N*m/rad", 1, 0.0, 0, NAN, "at the first rotor"),
    ROT_NUMBER_INPUT("damping_n_m_s", "N*m*s", 0, 0.0, 0, 0.0, "at the first rotor"),
    RATIO(0, 1.0)};
static const rot_input clutch_inputs[] = {CAPACITY_INPUTS, ROT_WINDOW_INPUTS(-INFINITY),
                                          RATIO(0, 1.0)};
static const rot_input gear_inputs[] = {
    RATIO(1, NAN),
    {"efficiency", "1", ROT_INPUT_NUMBER, 0, 0.0, 1.0, 1, 1.0, "power out over power in", NULL}};
static const rot_input brake_inputs[] = {CAPACITY_INPUTS, ROT_WINDOW_INPUTS(-INFINITY)};

static rot_status ratio_of(const rot_part *part, const rot_given given[], size_t input,
                           double *ratio, rot_refusal *no) {
  *ratio = rot_input_number(part->inputs, given, input);
  return *ratio != 0.0 ? ROT_OK : rot_refuse(no, input, "must not be 0");
}

static rot_status build_shaft(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  rot_drive_coupling *c = to;
  (void)store;
  memset(c, 0, sizeof *c);
  c->kind = ROT_DRIVE_SHAFT;
  c->stiffness_n_m_per_rad = rot_input_number(part->inputs, given, 0);
  c->damping_n_m_s = rot_input_number(part->inputs, given, 1);
  c->efficiency = 1.0;
  return ratio_of(part, given, 2, &c->ratio, no);
}

static rot_status build_gear(const rot_part *part, const rot_given given[], rot_store *store,
                             void *to, rot_refusal *no) {
  rot_drive_coupling *c = to;
  (void)store;
  memset(c, 0, sizeof *c);
  c->kind = ROT_DRIVE_GEAR;
  c->efficiency = rot_input_number(part->inputs, given, 1);
  return ratio_of(part, given, 0, &c->ratio, no);
}

/* Refuses a negative capacity given by a single table of knots; negative values of other laws are
 * taken as 0. */
static rot_status check_capacity(const rot_given given[], rot_store *store, rot_refusal *no) {
  rot_law_sum sum;
  if (rot_law_sum_of(&given[0], store, &sum) != ROT_OK) return ROT_ENOMEM;
  if (sum.n != 1 || sum.law->kind != ROT_LAW_KNOTS) return ROT_OK;
  const rot_torque *knots = &sum.law->knots;
  double min = fmin(knots->before_n_m, knots->after_n_m);
  for (size_t i = 0; i < knots->n; i++) min = fmin(min, knots->torque_n_m[i]);
  return min >= 0.0 ? ROT_OK
                    : rot_refuse(no, 0, "must be at least 0 at all knots; it falls to %g", min);
}

/* inputs => rot_drive_friction, or a refusal. */
static rot_status build_brake(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  rot_drive_friction *friction = to;
  double window[2];
  memset(friction, 0, sizeof *friction);
  rot_status status = check_capacity(given, store, no);
  if (status == ROT_OK) status = rot_law_window(part->inputs, given, 2, window, no);
  if (status != ROT_OK) return status;
  friction->acts = 1;
  friction->static_ratio = rot_input_number(part->inputs, given, 1);
  friction->from_s = window[0];
  friction->to_s = window[1];
  friction->law.linear.inertia_kg_m2 = 1.0;
  status = rot_axle_load(&given[0], NULL, store, &friction->law, NULL);
  return status == ROT_EVALUE ? rot_refuse(no, 0, "adds up beyond double precision") : status;
}

static rot_status build_clutch(const rot_part *part, const rot_given given[], rot_store *store,
                               void *to, rot_refusal *no) {
  rot_drive_coupling *c = to;
  memset(c, 0, sizeof *c);
  c->kind = ROT_DRIVE_CLUTCH;
  c->efficiency = 1.0;
  const rot_status status = build_brake(part, given, store, &c->friction, no);
  return status == ROT_OK ? ratio_of(part, given, 4, &c->ratio, no) : status;
}

#define PART(constructor, makes, inputs, type, build)                                              \
  { constructor, makes, sizeof inputs / sizeof *inputs, inputs, sizeof(type), build }

const rot_part rot_drive_parts[] = {
    PART("coupling_shaft", ROT_INPUT_COUPLING, shaft_inputs, rot_drive_coupling, build_shaft),
    PART("coupling_clutch", ROT_INPUT_COUPLING, clutch_inputs, rot_drive_coupling, build_clutch),
    PART("coupling_gear", ROT_INPUT_COUPLING, gear_inputs, rot_drive_coupling, build_gear),
    PART("brake", ROT_INPUT_BRAKE, brake_inputs, rot_drive_friction, build_brake),
};
const size_t rot_drive_n_parts = sizeof rot_drive_parts / sizeof *rot_drive_parts;

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { BODIES, COUPLINGS, TORQUE, RESISTANCE, BRAKE, THETA0, OMEGA0, START };

const rot_input rot_drive_inputs[ROT_DRIVE_INPUTS] = {
    [BODIES] = {"bodies", "kg*m^2", ROT_BODY_KINDS | ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1, 0.0,
                DBL_MAX, 1, NAN, "in their order: bodies, of which Izz counts, or moments", NULL},
    [COUPLINGS] = {"couplings", "", ROT_INPUT_COUPLING | ROT_INPUT_LIST, 0, ROT_NO_DOMAIN, NAN,
                   "one less than there are bodies, or one for all", NULL},
    [TORQUE] = {"torque", "N*m", ROT_TORQUE_KINDS | ROT_INPUT_LIST | ROT_INPUT_NOTHING, 0,
                ROT_NO_DOMAIN, NAN,
                "a list with a law or nothing for each rotor; of one rotor the law", NULL},
    [RESISTANCE] = {"resistance", "", ROT_INPUT_RESISTANCE | ROT_INPUT_LIST | ROT_INPUT_NOTHING, 0,
                    ROT_NO_DOMAIN, NAN, "likewise", rot_axle_resistance},
    [BRAKE] = {"brake", "", ROT_INPUT_BRAKE | ROT_INPUT_LIST | ROT_INPUT_NOTHING, 0, ROT_NO_DOMAIN,
               NAN, "likewise", NULL},
    [THETA0] = {"theta0_rad", "rad", ROT_INPUT_NUMBERS, 0, ROT_NO_DOMAIN, 0.0,
                "angles at the start, or that of the first, which the others follow at the ratios",
                NULL},
    [OMEGA0] = {"omega0_rad_per_s", "rad/s", ROT_INPUT_NUMBERS, 0, ROT_NO_DOMAIN, 0.0,
                "angular velocities at the start, likewise", NULL},
    [START] = ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds"),
};

/* input with one item per rotor => item i, or the item of a single rotor. */
static const rot_given *item_of(const rot_given *given, size_t i) {
  static const rot_given nothing = {0};
  if (!given->is) return &nothing;
  return given->is == ROT_INPUT_LIST ? &given->item[i] : given;
}

static rot_status check_counts(const rot_given given[], size_t n, rot_refusal *no) {
  for (size_t input = TORQUE; input <= BRAKE; input++) {
    const rot_given *g = &given[input];
    if (g->is && (g->is == ROT_INPUT_LIST ? g->n != n : n != 1)) {
      return rot_refuse(no, input, "must be a list with one item for each of the %zu rotors", n);
    }
    for (size_t i = 0; g->is == ROT_INPUT_LIST && i < n; i++) {
      if (g->item[i].is == ROT_INPUT_LIST) {
        return rot_refuse(no, input, "item %zu must not be a list", i + 1);
      }
    }
  }
  return ROT_OK;
}

/* list of couplings => kinds, ratios, parameters, or a refusal. */
static rot_status build_couplings(const rot_given given[], size_t n, rot_store *store,
                                  rot_drive_scene *scene, rot_refusal *no) {
  const rot_given *g = &given[COUPLINGS];
  rot_drive_coupling *coupling = rot_store_get(store, n - 1, sizeof *coupling);
  int clutch = 0, lossy = 0;
  if (!coupling) return ROT_ENOMEM;
  if (g->is != ROT_INPUT_COUPLING && (g->is ? g->n : 0) != n - 1) {
    return rot_refuse(no, COUPLINGS,
                      "must have one item less than there are bodies, %zu; it has %zu", n - 1,
                      g->is ? g->n : 0);
  }
  for (size_t i = 0; i + 1 < n; i++) {
    const rot_given *one = item_of(g, i);
    if (one->is != ROT_INPUT_COUPLING) {
      return rot_refuse(no, COUPLINGS, "item %zu must be a coupling", i + 1);
    }
    coupling[i] = *(const rot_drive_coupling *)one->object;
    clutch |= coupling[i].kind == ROT_DRIVE_CLUTCH;
    lossy |= rot_drive_mesh_loses(&coupling[i]);
  }
  scene->coupling = coupling;
  if (clutch && lossy) {
    return rot_refuse(
        no, COUPLINGS,
        "must not have a clutch and a gear with a loss: give the loss as a resistance of a rotor, "
        "or replace the clutch by a coupling_shaft");
  }
  return ROT_OK;
}

/* input => n numbers, or the first number and the others by the ratios. */
static rot_status through_ratios(const rot_given given[], size_t input, size_t n,
                                 const double ratio[], double x[], rot_refusal *no) {
  const rot_status status = rot_input_each(rot_drive_inputs, given, input, n, x, no);
  if (status != ROT_OK || (given[input].is && given[input].n != 1)) return status;
  for (size_t i = 0; i < n; i++) {
    x[i] /= ratio[i];
    if (!isfinite(x[i])) return rot_refuse(no, input, "over the ratios is beyond double precision");
  }
  return ROT_OK;
}

static rot_status check_geared_rates(size_t n, const rot_drive_coupling coupling[],
                                     const double omega[], rot_refusal *no) {
  for (size_t i = 0; i + 1 < n; i++) {
    if (coupling[i].kind != ROT_DRIVE_GEAR) continue;
    const double off = fabs(omega[i] - coupling[i].ratio * omega[i + 1]);
    if (!(off <= 1e-12 * fabs(omega[i]))) {
      return rot_refuse(no, OMEGA0,
                        "must agree with the gears: rotor %zu turns at %g, the next at %g, and the "
                        "ratio is %g",
                        i + 1, omega[i], omega[i + 1], coupling[i].ratio);
    }
  }
  return ROT_OK;
}

/* inputs of each rotor => axle scene, brake, or a refusal. */
static rot_status build_rotors(const rot_given given[], size_t n, rot_store *store,
                               rot_drive_scene *scene, rot_refusal *no) {
  double *inertia = rot_store_get(store, n, 4 * sizeof *inertia);
  rot_axle_scene *rotor = rot_store_get(store, n, sizeof *rotor);
  rot_drive_friction *brake = rot_store_get(store, n, sizeof *brake);
  if (!inertia || !rotor || !brake) return ROT_ENOMEM;
  double *ratio = inertia + n, *theta = ratio + n, *omega = theta + n;
  long double product = 1.0L; /* as in R */
  rot_status status = rot_body_moments(given, BODIES, inertia, no);
  for (size_t i = 0; i < n; i++) {
    if (i > 0) product *= scene->coupling[i - 1].ratio;
    ratio[i] = (double)product;
    if (!isfinite(ratio[i]) || ratio[i] == 0.0) {
      return rot_refuse(no, COUPLINGS, "have a product of ratios beyond double precision");
    }
  }
  if (status == ROT_OK) status = through_ratios(given, THETA0, n, ratio, theta, no);
  if (status == ROT_OK) status = through_ratios(given, OMEGA0, n, ratio, omega, no);
  if (status == ROT_OK) status = check_geared_rates(n, scene->coupling, omega, no);
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    const rot_given *holds = item_of(&given[BRAKE], i);
    rotor[i].linear.inertia_kg_m2 = inertia[i];
    rotor[i].linear.start_s = scene->start_s;
    rotor[i].linear.theta0_rad = theta[i];
    rotor[i].linear.omega0_rad_per_s = omega[i];
    if (holds->is) brake[i] = *(const rot_drive_friction *)holds->object;
    rot_resistance terms;
    status = rot_resistance_of(&rot_drive_inputs[RESISTANCE], RESISTANCE,
                               item_of(&given[RESISTANCE], i), &terms, no);
    if (status != ROT_OK) return status;
    status = rot_axle_load(item_of(&given[TORQUE], i), &terms, store, &rotor[i], NULL);
    if (status == ROT_EVALUE) {
      return rot_refuse(no, TORQUE, "item %zu adds up beyond double precision", i + 1);
    }
  }
  scene->rotor = rotor;
  scene->brake = brake;
  scene->inertia_kg_m2 = inertia;
  scene->ratio_to_first = ratio;
  scene->theta0_rad = theta;
  scene->omega0_rad_per_s = omega;
  return status;
}

/* Breaks of the loads of one rotor or coupling, unsorted. Returns their number; `out` NULL: an
 * upper limit. */
static size_t breaks_of(const rot_axle_scene *law, const rot_drive_friction *window, double out[]) {
  if (out && law->n_breaks) memcpy(out, law->breaks_s, law->n_breaks * sizeof *out);
  size_t n = law->n_breaks;
  for (int k = 0; window && k < 2; k++) {
    const double at = k ? window->to_s : window->from_s;
    if (out && isfinite(at)) out[n] = at;
    n += !out || isfinite(at);
  }
  return n;
}

static size_t all_breaks(const rot_drive_scene *scene, double out[]) {
  size_t n = 0;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_drive_friction *friction[] = {&scene->brake[i],
                                            i + 1 < scene->n ? &scene->coupling[i].friction : NULL};
    n += breaks_of(&scene->rotor[i], NULL, out ? out + n : NULL);
    for (int k = 0; k < 2; k++) {
      if (friction[k] && friction[k]->acts)
        n += breaks_of(&friction[k]->law, friction[k], out ? out + n : NULL);
    }
  }
  return n;
}

static rot_status gather_breaks(rot_drive_scene *scene, rot_store *store) {
  double *all = rot_store_get(store, all_breaks(scene, NULL), sizeof *all);
  if (!all) return ROT_ENOMEM;
  scene->n_breaks = rot_sort_once(all_breaks(scene, all), all);
  scene->breaks_s = all;
  return ROT_OK;
}

rot_status rot_drive_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_drive_scene *scene = to;
  const size_t n = rot_body_count(&given[BODIES]);
  memset(scene, 0, sizeof *scene);
  if (n == 0) return rot_refuse(no, BODIES, "is empty");
  scene->n = n;
  scene->start_s = rot_input_number(rot_drive_inputs, given, START);
  rot_status status = check_counts(given, n, no);
  if (status == ROT_OK) status = build_couplings(given, n, store, scene, no);
  if (status == ROT_OK) status = build_rotors(given, n, store, scene, no);
  if (status == ROT_OK) status = gather_breaks(scene, store);
  return status;
}

const rot_derived rot_drive_derived[ROT_DRIVE_DERIVED] = {
    {"moment_of_inertia_kg_m2", offsetof(rot_drive_scene, inertia_kg_m2), 0},
    {"ratio_to_first", offsetof(rot_drive_scene, ratio_to_first), 0},
    {"theta0_rad", offsetof(rot_drive_scene, theta0_rad), 0},
    {"omega0_rad_per_s", offsetof(rot_drive_scene, omega0_rad_per_s), 0}};

double rot_drive_start_s(const void *scene) { return ((const rot_drive_scene *)scene)->start_s; }

size_t rot_drive_rows_per_time(const void *scene) { return ((const rot_drive_scene *)scene)->n; }

/* ---- columns --------------------------------------------------------------------------------- */

const rot_column_of rot_drive_all_columns[ROT_DRIVE_ALL_COLUMNS] = {
    ROT_COLUMN("theta_rad", "rad", 1 + ROT_THETA),
    ROT_COLUMN("omega_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    ROT_COLUMN("angular_momentum_kg_m2_per_s", "kg m^2/s", 0),
    ROT_COLUMN("rotational_kinetic_energy_j", "J", 0),
    ROT_COLUMN("applied_torque_n_m", "N m", 0),
    ROT_COLUMN("damping_torque_n_m", "N m", 0),
    ROT_COLUMN("coupling_torque_n_m", "N m", 0),
    {"locked", 1, 0, "", 0, 0},
    {"heat_j", 0, 0, "J", 0, 2},
    {"coupling_heat_j", 0, 0, "J", 0, 4}};

/* ---- runs ------------------------------------------------------------------------------------ */

static rot_drive_columns columns_of(void *const column[]) {
  rot_drive_columns out;
  size_t i = 0;
#define X(type, name) out.name = column[i++];
  ROT_DRIVE_COLUMNS(X)
#undef X
  return out;
}

/* Ledger columns: the requested flows, or memory from the store. */
static rot_status open_ledger(size_t n, const rot_rows *rows, rot_store *store,
                              rot_drive_ledger *ledger) {
  size_t k = 0, no_memory = 0;
  memset(ledger, 0, sizeof *ledger);
#define X(name)                                                                                    \
  ledger->name = rows->flow ? rows->flow[k] : rot_store_get(store, n, sizeof(double));             \
  no_memory += !ledger->name;                                                                      \
  k++;
  ROT_DRIVE_LEDGER(X)
#undef X
  return no_memory ? ROT_ENOMEM : ROT_OK;
}

/* (form, scene, task) => rows by the closed form, or by integration (no form). */
static rot_status run(rot_drive_form form, const rot_drive_scene *scene, const rot_task *task,
                      rot_method method, const rot_rows *rows, const rot_hooks *hooks,
                      rot_info *info) {
  rot_time_scales time_scales;
  rot_drive_time_scales_of_start(scene, &time_scales);
  const rot_drive_ode_options options = {task->accuracy, task->max_steps,
                                         rot_task_method(task, method), task->resolution,
                                         rot_fixed_task_step_s(task, scene->start_s, &time_scales)};
  const rot_drive_columns out = columns_of(rows->column);
  const int exact = form != ROT_DRIVE_FORMS;
  rot_drive_ledger ledger;
  rot_store store = {0};
  rot_info_clear(info, rot_turning);
  info->status = open_ledger(task->n, rows, &store, &ledger);
  if (info->status == ROT_OK) {
    info->status = exact ? rot_drive_exact(scene, form, task->n, task->time_s, &out,
                                           rows->flow ? &ledger : NULL, rows->events, hooks, info)
                         : rot_drive_integrate(scene, &options, task->n, task->time_s, &out,
                                               &ledger, rows->events, hooks, info);
  }
  if (rows->flow) rot_drive_flow_errors(scene, &ledger, rows->flow_error);
  for (size_t k = scene->n - 1; k < info->rows_done * scene->n; k += scene->n) {
    out.coupling_torque_n_m[k] = out.coupling_heat_j[k] = NAN;
    out.locked[k] = -1;
  }
  rot_store_free(&store);
  return info->status;
}

#define RUN(name, form)                                                                            \
  static rot_status name(const void *scene, const rot_task *task, rot_method method,               \
                         const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {           \
    return run(form, scene, task, method, rows, hooks, info);                                      \
  }
RUN(run_axle, ROT_DRIVE_AS_AXLE)
RUN(run_clutch, ROT_DRIVE_AS_CLUTCH)
RUN(run_shaft, ROT_DRIVE_AS_SHAFT)
RUN(run_integrated, ROT_DRIVE_FORMS)

const rot_model_run rot_drive_runs[ROT_DRIVE_MODELS] = {
    {ROT_METHOD_NONE, run_axle},        {ROT_METHOD_NONE, run_clutch},
    {ROT_METHOD_NONE, run_shaft},       {ROT_METHOD_RK8PD, run_integrated},
    {ROT_METHOD_RADAU, run_integrated}, ROT_FIXED_METHODS(run_integrated)};
