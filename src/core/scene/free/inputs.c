#include "scene/free/inputs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ground/sort.h"
#include "body/inertia.h"
#include "engine/resistance.h"
#include "maths/attitude.h"

const char *const rot_free_axes[] = {"body", "space", NULL};
const char *const rot_free_resistance[] = {"damping_per_s", NULL};

enum { BODY, OMEGA0, COMMON };

const rot_input rot_free_inputs[ROT_FREE_INPUTS] = {
    {"body", "kg*m^2", ROT_INPUT_BODY | ROT_INPUT_VECTOR | ROT_INPUT_MOMENTS, 1, ROT_FREE_ANY, NAN,
     "about its centre of mass: a body, or its three principal moments of inertia", NULL},
    ROT_FREE_OMEGA0_INPUT,
    ROT_FREE_COMMON_INPUTS};

/* ---- moments --------------------------------------------------------------------------------- */

/* A diagonal tensor keeps its axes and numbers. */
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
  if (s[2] < 0.0) { /* a rotated rod: negative by rounding */
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

int rot_free_read_moments(const rot_given *given, rot_free_params *p) {
  if (given->is == ROT_INPUT_VECTOR) {
    p->axes[0] = 1.0;
    memcpy(p->moment_kg_m2, given->x, sizeof p->moment_kg_m2);
    return 1;
  }
  if (given->is != ROT_INPUT_MOMENTS) return 0;
  const rot_free_moments_of *of = given->object;
  memcpy(p->moment_kg_m2, of->moment_kg_m2, sizeof p->moment_kg_m2);
  memcpy(p->axes, of->axes, sizeof p->axes);
  p->turned = p->axes[0] != 1.0;
  p->given = 2e-15;
  return 1;
}

static int acts(const rot_free_params *p) {
  return p->law || p->n_knots || p->torque[0] != 0.0 || p->torque[1] != 0.0 || p->torque[2] != 0.0;
}

/* Checks axes without moment of inertia: no spin about them, no torque. */
static int spins_freely(const rot_free_params *p) {
  double omega[3], q[4];
  rot_free_principal(p, omega, q);
  for (int i = 0; i < 3; i++) {
    if (p->moment_kg_m2[i] == 0.0 && (acts(p) || omega[i] != 0.0)) return 0;
  }
  return 1;
}

/* moments => ROT_OK, or a refusal. */
static rot_status check_moments(const rot_free_params *p, size_t rotors, rot_refusal *no) {
  int some = 0, all = 1;
  for (int i = 0; i < 3; i++) {
    if (p->moment_kg_m2[i] < 0.0) return rot_refuse(no, 0, "must have no negative moment");
    some |= p->moment_kg_m2[i] > 0.0;
    all &= p->moment_kg_m2[i] > 0.0;
  }
  if (!some) return rot_refuse(no, 0, "must have a moment of inertia");
  if (p->n_rotors && !all) {
    return rot_refuse(no, rotors, "must be those of a body with a moment about each axis");
  }
  if (spins_freely(p)) return ROT_OK;
  return rot_refuse(no, 0,
                    "can neither spin about an axis without moment of inertia nor bear a "
                    "torque there");
}

/* ---- laws ------------------------------------------------------------------------------------ */

static rot_status call(const rot_law *law, double t, const double omega[3], const double q[4],
                       double value[]) {
  double argument[8] = {t};
  memcpy(argument + 1, omega, 3 * sizeof *omega);
  memcpy(argument + 4, q, 4 * sizeof *q);
  return law->call(argument, value, law->ctx);
}

static rot_status call_torque(double t, const double omega[3], const double q[4], double torque[3],
                              void *ctx) {
  return call(ctx, t, omega, q, torque);
}

static rot_status call_motors(double t, const double omega[3], const double q[4], double torque[],
                              void *ctx) {
  const rot_free_built *built = ctx;
  rot_status status = ROT_OK;
  for (size_t k = 0; k < built->params.n_rotors && status == ROT_OK; k++) {
    if (built->motor[k].call) status = call(&built->motor[k], t, omega, q, &torque[k]);
  }
  return status;
}

/* torque input: constant, table or law. */
static rot_status read_torque(const rot_given *torque, size_t input, rot_free_built *built,
                              rot_refusal *no) {
  rot_free_params *p = &built->params;
  if (torque->is == ROT_INPUT_LAW) {
    built->law = torque->law;
    p->law = call_torque;
    p->ctx = &built->law;
    p->law_noise_n_m = torque->law.noise;
  } else if (torque->is == ROT_INPUT_TABLE) {
    const rot_free_table_of *table = torque->object;
    if (table->columns != 3) {
      return rot_refuse(no, input, "must have the columns `x_n_m`, `y_n_m`, `z_n_m`");
    }
    p->n_knots = table->n;
    p->knot_s = table->time_s;
    for (int k = 0; k < 3; k++) p->knot_torque[k] = table->torque[k];
  } else {
    rot_input_vector(torque, p->torque);
  }
  return ROT_OK;
}

static const rot_free_rotor_of *rotor_of(const rot_given *rotors, size_t k) {
  return rotors->is == ROT_INPUT_LIST ? rotors->item[k].object : rotors->object;
}

/* rotor inputs => rotors, motors, or a refusal. */
static rot_status read_rotors(const rot_given *rotors, size_t input, rot_free_built *built,
                              rot_refusal *no) {
  rot_free_params *p = &built->params;
  if (!rotors->is) return ROT_OK;
  if (rotors->n > ROT_FREE_MAX_ROTORS) {
    return rot_refuse(no, input, "must be at most %d; it is a list of %zu", ROT_FREE_MAX_ROTORS,
                      rotors->n);
  }
  for (size_t k = 0; k < rotors->n && rotors->is == ROT_INPUT_LIST; k++) {
    if (rotors->item[k].is != ROT_INPUT_ROTOR) return rot_refuse(no, input, "must be rotors");
  }
  p->n_rotors = rotors->n;
  p->rotors = built->rotor;
  for (size_t k = 0; k < rotors->n; k++) {
    const rot_free_rotor_of *of = rotor_of(rotors, k);
    built->rotor[k] = of->rotor;
    built->motor[k] = of->law;
    if (!of->law.call) continue;
    p->motors = call_motors;
    p->motors_ctx = built;
  }
  return ROT_OK;
}

/* ---- breaks ---------------------------------------------------------------------------------- */

static void add(size_t n, const double x[], double to[], size_t *at) {
  if (n && to) memcpy(to + *at, x, n * sizeof *x);
  *at += n;
}

/* Given breaks and times of tables, with repetitions. `to` NULL: their number only. */
static size_t gather(const rot_given *breaks, const rot_given *rotors, const rot_free_params *p,
                     double to[]) {
  size_t at = 0;
  add(breaks->n, breaks->x, to, &at);
  add(p->n_knots, p->knot_s, to, &at);
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor_of *of = rotor_of(rotors, k);
    add(of->n_breaks, of->breaks_s, to, &at);
    add(of->rotor.n_knots, of->rotor.knot_s, to, &at);
  }
  return at;
}

static rot_status read_breaks(const rot_given *breaks, const rot_given *rotors, rot_store *store,
                              rot_free_params *p) {
  const size_t n = gather(breaks, rotors, p, NULL);
  double *all = rot_store_get(store, n + 1, sizeof *all);
  if (!all) return ROT_ENOMEM;
  (void)gather(breaks, rotors, p, all);
  p->n_breaks = rot_sort_once(n, all);
  p->breaks_s = all;
  return ROT_OK;
}

/* ---- scenes ---------------------------------------------------------------------------------- */

/* Rates, attitude, torque, resistance, rotors, breaks, start. */
rot_status rot_free_build_rest(const rot_input inputs[], const rot_given given[], size_t omega0,
                               size_t common, rot_store *store, rot_free_built *built,
                               rot_refusal *no) {
  rot_free_params *p = &built->params;
  const rot_given *of = given + common, *rotors = &of[ROT_FREE_ROTORS];
  rot_input_vector(&given[omega0], p->omega0_rad_per_s);
  p->q0[0] = 1.0;
  if (of[ROT_FREE_ATTITUDE0].is) rot_free_read_attitude(of[ROT_FREE_ATTITUDE0].x, p->q0);
  p->in_space = of[ROT_FREE_AXES].is && of[ROT_FREE_AXES].option == 1;
  p->start_s = rot_input_number(inputs, given, common + ROT_FREE_START);
  const size_t resists = common + ROT_FREE_RESISTANCE;
  rot_resistance terms;
  rot_status status = rot_resistance_of(&inputs[resists], resists, &given[resists], &terms, no);
  if (status != ROT_OK) return status;
  p->damping_per_s = terms.damping_per_s;
  status = read_torque(&of[ROT_FREE_TORQUE], common + ROT_FREE_TORQUE, built, no);
  if (status == ROT_OK) status = read_rotors(rotors, common + ROT_FREE_ROTORS, built, no);
  if (status == ROT_OK) status = read_breaks(&of[ROT_FREE_BREAKS], rotors, store, p);
  return status == ROT_OK ? check_moments(p, common + ROT_FREE_ROTORS, no) : status;
}

rot_status rot_free_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_free_built *built = to;
  const rot_given_body *body = &given[BODY].body;
  memset(built, 0, sizeof *built);
  if (!rot_free_read_moments(&given[BODY], &built->params) &&
      rot_free_build_moments(body->inertia_kg_m2, body->second_kg_m2, &built->params) != ROT_OK) {
    return rot_refuse(no, BODY, "must have finite principal moments");
  }
  return rot_free_build_rest(rot_free_inputs, given, OMEGA0, COMMON, store, built, no);
}

double rot_free_start(const void *scene) { return ((const rot_free_params *)scene)->start_s; }
