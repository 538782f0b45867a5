#include "scene/axle/inputs.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "body/parts.h"
#include "engine/laws.h"
#include "ground/real.h"
#include "ground/search.h"
#include "scene/axle/train.h"

/* ---- parts ----------------------------------------------------------------------------------- */

typedef struct inertia_knots {
  size_t n;
  const double *time_s, *inertia_kg_m2;
} inertia_knots;

static const rot_input knots_inputs[] = {
    {"time_s", "s", ROT_INPUT_NUMBERS, 1, ROT_NO_DOMAIN, NAN,
     "of the knots, not decreasing; a repeated time is a jump", NULL},
    {"moment_of_inertia_kg_m2", "kg*m^2", ROT_INPUT_NUMBERS, 1, 0.0, DBL_MAX, 1, NAN,
     "at each: straight lines between, held outside", NULL}};

static rot_status build_knots(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  const size_t n = given[0].n;
  const double *t = given[0].x;
  (void)part, (void)store;
  if (n < 2) return rot_refuse(no, 0, "must have two knots or more; it has %zu", n);
  if (given[1].n != n) return rot_refuse(no, 1, "must have %zu numbers; it has %zu", n, given[1].n);
  for (size_t i = 1; i < n; i++) {
    if (t[i] < t[i - 1]) return rot_refuse(no, 0, "must not go back in time");
  }
  if (!isfinite(t[n - 1] - t[0])) return rot_refuse(no, 0, "must span a finite time");
  *(inertia_knots *)to = (inertia_knots){n, t, given[1].x};
  return ROT_OK;
}

const rot_part rot_axle_parts[] = {
    {"inertia_knots", ROT_INPUT_INERTIA, 2, knots_inputs, sizeof(inertia_knots), build_knots},
};
const size_t rot_axle_n_parts = sizeof rot_axle_parts / sizeof *rot_axle_parts;

/* ---- loads ----------------------------------------------------------------------------------- */

rot_status rot_axle_gather_breaks(rot_axle_scene *scene, rot_store *store) {
  double *all = rot_store_get(store, rot_axle_scene_room(scene), sizeof *all);
  if (!all) return ROT_ENOMEM;
  scene->n_breaks = rot_axle_scene_breaks(scene, all);
  scene->breaks_s = all;
  return ROT_OK;
}

/* Torque => knots, call, terms, motor, breaks; resistance => coefficients. */
rot_status rot_axle_load(const rot_given *torque, const rot_resistance *resists, rot_store *store,
                         rot_axle_scene *scene, rot_axle_own *own) {
  rot_loads loads;
  const rot_status status = rot_loads_of(torque, store, &loads);
  if (status != ROT_OK) return status;
  scene->linear.torque = loads.knots;
  scene->motor_n_m_s = loads.motor_n_m_s;
  scene->noise_n_m = loads.noise_n_m;
  scene->n_terms = loads.n_terms;
  scene->terms = loads.terms;
  scene->n_breaks = loads.n_breaks;
  scene->breaks_s = loads.breaks_s;
  if (own) *own = (rot_axle_own){loads.n_breaks, loads.breaks_s};
  if (resists) {
    scene->viscous_n_m_s = resists->viscous_n_m_s;
    scene->quadratic_n_m_s2 = resists->quadratic_n_m_s2;
    scene->coulomb_n_m = resists->coulomb_n_m;
    scene->static_n_m = resists->static_n_m;
  }
  scene->linear.viscous_n_m_s = scene->viscous_n_m_s + scene->motor_n_m_s;
  return rot_axle_gather_breaks(scene, store);
}

double rot_axle_inertia_at(const rot_axle_scene *scene, double t) {
  const size_t n = scene->n_inertia, past = rot_upper_bound(n, scene->inertia_time_s, t);
  if (n == 0) return scene->linear.inertia_kg_m2;
  const double *at = scene->inertia_time_s, *moment = scene->inertia_kg_m2;
  if (past == 0) return moment[0];
  if (past == n) return moment[n - 1];
  const size_t i = past - 1;
  const double width = at[i + 1] - at[i];
  return moment[i] * ((at[i + 1] - t) / width) + moment[i + 1] * ((t - at[i]) / width);
}

/* ---- inputs ---------------------------------------------------------------------------------- */

static const char *const axes[] = {"z", "x", "y", NULL};
static const char *const points[] = {"centre", "origin", NULL};

/* Inputs shared by constructors. */
#define RESISTS       ROT_RESISTANCE_INPUT("what resists the rotation", rot_axle_resistance)
#define THETA0(words) ROT_NUMBER_INPUT("theta0_rad", "rad", 0, -DBL_MAX, 0, 0.0, words)
#define OMEGA0(words) ROT_NUMBER_INPUT("omega0_rad_per_s", "rad/s", 0, -DBL_MAX, 0, 0.0, words)
#define START         ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, WHEN)
#define AXIS                                                                                       \
  {                                                                                                \
    "axis", "1", ROT_INPUT_CHOICE | ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,                       \
        "direction of the axle, in the body's own axes", axes                                      \
  }
#define LAW(words)                                                                                 \
  { "torque", "N*m", ROT_TORQUE_KINDS, 0, ROT_NO_DOMAIN, NAN, words, NULL }
#define GRAVITY                                                                                    \
  ROT_NUMBER_INPUT("gravity_m_per_s2", "m/s^2", 0, -DBL_MAX, 0, 9.80665, "acceleration of gravity")
#define WHEN          "when the state above holds"
#define AT_START      "angle at the start"
#define RATE_AT_START "angular velocity at the start"

#define MOMENT(at)                                                                                 \
  { "moment_of_inertia_kg_m2", offsetof(rot_axle_built, at), 1 }
#define UNIT_AXIS                                                                                  \
  { "axis", offsetof(rot_axle_built, axis), 3 }

/* Initial state, axis z. state: index of the angle; the rate follows it. */
static void begin(const rot_input inputs[], const rot_given given[], size_t state, size_t start,
                  rot_axle_built *built) {
  memset(built, 0, sizeof *built);
  built->scene.linear.theta0_rad = rot_input_number(inputs, given, state);
  built->scene.linear.omega0_rad_per_s = rot_input_number(inputs, given, state + 1);
  built->scene.linear.start_s = rot_input_number(inputs, given, start);
  built->axis[2] = 1.0;
}

static rot_status set_axis(const rot_given given[], size_t input, double axis[3], rot_refusal *no) {
  static const double along[3][3] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const rot_given *x = &given[input];
  const double *of = x->is == ROT_INPUT_VECTOR ? x->x : along[x->is ? x->option : 0];
  return rot_input_axis(of, axis) ? ROT_OK : rot_refuse(no, input, "must not be 0");
}

/* Checks a moment of inertia. computed: from the data of a body; then below 2.2e-308 it has lost
 * digits. */
static rot_status turns(double inertia, int computed, size_t input, rot_refusal *no) {
  if (computed && inertia > 0.0 && inertia < DBL_MIN) {
    return rot_refuse(no, input, "has a moment of inertia below what double precision resolves");
  }
  if (inertia > 0.0 && inertia < INFINITY) return ROT_OK;
  return rot_refuse(no, input,
                    "must have a moment of inertia about the axle, finite and greater than 0; it "
                    "is %g: check mass, size and axis",
                    inertia);
}

/* (inputs `torque`, `resists`) => loads of the scene. */
static rot_status load(const rot_input inputs[], const rot_given given[], size_t torque,
                       size_t resists, rot_store *store, rot_axle_built *built, rot_refusal *no) {
  rot_resistance terms;
  rot_status status = rot_resistance_of(&inputs[resists], resists, &given[resists], &terms, no);
  if (status != ROT_OK) return status;
  status = rot_axle_load(&given[torque], &terms, store, &built->scene, &built->own);
  return status == ROT_EVALUE ? rot_refuse(no, torque, "adds up beyond double precision") : status;
}

/* ---- scene_axle() ---------------------------------------------------------------------------- */

enum { BODY, TORQUE, RESISTANCE, THETA, OMEGA, FROM, AXLE, THROUGH };

static const rot_input axle_inputs[] = {
    [BODY] = {"body", "kg*m^2", ROT_BODY_KINDS | ROT_INPUT_INERTIA, 1, 0.0, DBL_MAX, 1, NAN,
              "a body, its moment of inertia about the axle, or how that changes", NULL},
    [TORQUE] = LAW("a law of time_s, theta_rad, omega_rad_per_s; a list is the sum of its laws"),
    [RESISTANCE] = RESISTS,
    [THETA] = THETA0(AT_START),
    [OMEGA] = OMEGA0(RATE_AT_START),
    [FROM] = START,
    [AXLE] = AXIS,
    [THROUGH] = {"through", "m", ROT_INPUT_CHOICE | ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,
                 "a point of the axle, in the body's own axes; default: of the axle that the body "
                 "names, or its centre of mass",
                 points},
};

/* Body, number, or table of inertia => moment of inertia. */
static rot_status build_inertia(const rot_given given[], rot_axle_built *built, rot_refusal *no) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  const rot_given *body = &given[BODY], *through = &given[THROUGH];
  rot_axle_scene *scene = &built->scene;
  double *inertia = &scene->linear.inertia_kg_m2;
  if (body->is == ROT_INPUT_INERTIA) {
    const inertia_knots *knots = body->object;
    scene->n_inertia = knots->n;
    scene->inertia_time_s = knots->time_s;
    scene->inertia_kg_m2 = knots->inertia_kg_m2;
    *inertia = rot_axle_inertia_at(scene, scene->linear.start_s);
  } else if (body->is == ROT_INPUT_BODY) {
    const double *point = through->is == ROT_INPUT_VECTOR ? through->x
                          : !through->is                  ? NULL
                          : through->option == 0          ? body->body.centre_m
                                                          : origin;
    *inertia = rot_body_moment(&body->body, built->axis, point);
  } else {
    *inertia = body->x[0];
  }
  return turns(*inertia, body->is == ROT_INPUT_BODY, BODY, no);
}

static rot_status build_axle(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_axle_built *built = to;
  begin(axle_inputs, given, THETA, FROM, built);
  rot_status status = set_axis(given, AXLE, built->axis, no);
  if (status == ROT_OK) status = build_inertia(given, built, no);
  return status == ROT_OK ? load(axle_inputs, given, TORQUE, RESISTANCE, store, built, no) : status;
}

static const rot_derived axle_derived[] = {MOMENT(scene.linear.inertia_kg_m2), UNIT_AXIS};

/* ---- scene_pendulum() ------------------------------------------------------------------------ */

enum { P_BODY, P_DISTANCE, P_RESISTANCE, P_THETA, P_OMEGA, P_TORQUE, P_FROM, P_AXLE, P_GRAVITY };

static const rot_input pendulum_inputs[] = {
    [P_BODY] = {"body", "", ROT_INPUT_BODY, 1, ROT_NO_DOMAIN, NAN, "that hangs from the axle",
                NULL},
    [P_DISTANCE] = ROT_NUMBER_INPUT("distance_m", "m", 0, 0.0, 0, NAN,
                                    "of the centre of mass from the axle; default: from the axle "
                                    "that the body names"),
    [P_RESISTANCE] = RESISTS,
    [P_THETA] = THETA0("angle at the start, 0 where it hangs straight down"),
    [P_OMEGA] = OMEGA0(RATE_AT_START),
    [P_TORQUE] = LAW("what acts beside gravity"),
    [P_FROM] = START,
    [P_AXLE] = AXIS,
    [P_GRAVITY] = GRAVITY,
};

/* Distance of the centre of mass from the axle given with the body; 0: none given, or the same
 * point. */
static double named_distance(const rot_given_body *body, const double axis[3]) {
  double off[3], along = 0.0, max = 0.0, square = 0.0;
  for (int k = 0; k < 3; k++) {
    off[k] = body->centre_m[k] - body->axle_m[k];
    along += off[k] * axis[k];
  }
  for (int k = 0; k < 3; k++) {
    off[k] -= along * axis[k];
    max = fmax(max, fabs(off[k]));
  }
  for (int k = 0; k < 3 && max > 0.0; k++) square += (off[k] / max) * (off[k] / max);
  return max > 0.0 ? max * sqrt(square) : 0.0;
}

/* Body or moment, distance, gravity => gravity term. */
static rot_status build_pendulum(const rot_given given[], rot_store *store, void *to,
                                 rot_refusal *no) {
  rot_axle_built *built = to;
  const rot_given_body *body = &given[P_BODY].body;
  begin(pendulum_inputs, given, P_THETA, P_FROM, built);
  rot_status status = set_axis(given, P_AXLE, built->axis, no);
  if (status != ROT_OK) return status;
  const double distance = built->distance_m =
      given[P_DISTANCE].is ? given[P_DISTANCE].x[0] : named_distance(body, built->axis);
  if (!given[P_DISTANCE].is && distance == 0.0) {
    return rot_refuse(no, P_DISTANCE,
                      "is missing: the axle passes through no point that this body names");
  }
  const double arms[] = {body->mass_kg, distance, distance};
  built->scene.linear.inertia_kg_m2 = rot_sum_product(
      rot_body_moment(body, built->axis, body->centre_m), 3, arms, &built->scene.inertia_lo);
  status = turns(built->scene.linear.inertia_kg_m2, 1, P_BODY, no);
  if (status != ROT_OK) return status;
  rot_law_sum pull;
  const double gravity = rot_input_number(pendulum_inputs, given, P_GRAVITY);
  status = rot_law_gravity(body->mass_kg, distance, gravity, 0.0, store, &pull);
  if (status == ROT_EVALUE) return rot_refuse(no, P_BODY, "has a weight beyond double precision");
  if (status != ROT_OK) return status;
  const rot_given laws[] = {{.is = ROT_INPUT_TORQUE, .n = 1, .object = &pull}, given[P_TORQUE]};
  const rot_given all = {.is = ROT_INPUT_LIST, .n = given[P_TORQUE].is ? 2 : 1, .item = laws};
  rot_resistance terms;
  status = rot_resistance_of(&pendulum_inputs[P_RESISTANCE], P_RESISTANCE, &given[P_RESISTANCE],
                             &terms, no);
  if (status != ROT_OK) return status;
  status = rot_axle_load(&all, &terms, store, &built->scene, &built->own);
  if (status != ROT_EVALUE) return status;
  return rot_refuse(no, P_TORQUE, "adds up beyond double precision");
}

static const rot_derived pendulum_derived[] = {
    MOMENT(scene.linear.inertia_kg_m2),
    {"distance_m", offsetof(rot_axle_built, distance_m), 1},
    UNIT_AXIS};

/* ---- scene_hanging_mass() -------------------------------------------------------------------- */

enum {
  H_BODY,
  H_MASS,
  H_RADIUS,
  H_RESISTANCE,
  H_THETA,
  H_OMEGA,
  H_COUNTER,
  H_FROM,
  H_AXLE,
  H_GRAVITY
};

static const rot_input hanging_inputs[] = {
    [H_BODY] = {"body", "kg*m^2", ROT_BODY_KINDS, 1, 0.0, DBL_MAX, 0, NAN,
                "the pulley, or its moment of inertia", NULL},
    [H_MASS] = ROT_NUMBER_INPUT("mass_kg", "kg", 1, 0.0, 1, NAN, "the mass that hangs"),
    [H_RADIUS] = ROT_NUMBER_INPUT("radius_m", "m", 0, 0.0, 1, NAN,
                                  "at which the rope leaves the pulley; default: that of a body "
                                  "which is round about its z axis"),
    [H_RESISTANCE] = RESISTS,
    [H_THETA] = THETA0("angle at the start; it grows where the mass goes down"),
    [H_OMEGA] = OMEGA0(RATE_AT_START),
    [H_COUNTER] =
        ROT_NUMBER_INPUT("counter_mass_kg", "kg", 0, 0.0, 0, 0.0, "the mass on the other side"),
    [H_FROM] = START,
    [H_AXLE] = AXIS,
    [H_GRAVITY] = GRAVITY,
};

/* Body, masses, radius => inertia, constant torque of the weights, rope. */
static rot_status build_hanging(const rot_given given[], rot_store *store, void *to,
                                rot_refusal *no) {
#define VALUE(input) rot_input_number(hanging_inputs, given, input)
  rot_axle_built *built = to;
  const rot_given *body = &given[H_BODY];
  double lo;
  begin(hanging_inputs, given, H_THETA, H_FROM, built);
  rot_status status = set_axis(given, H_AXLE, built->axis, no);
  if (status != ROT_OK) return status;
  const int round = body->is == ROT_INPUT_BODY && fabs(built->axis[2]) == 1.0;
  const double own = body->is == ROT_INPUT_BODY
                         ? rot_body_moment(&body->body, built->axis, body->body.centre_m)
                         : body->x[0];
  const double r = given[H_RADIUS].is ? given[H_RADIUS].x[0] : round ? body->body.radius_m : NAN;
  if (!(r > 0.0 && r < INFINITY)) {
    return rot_refuse(no, H_RADIUS, "is missing: the pulley has no radius of its own");
  }
  const double first[] = {VALUE(H_MASS), r, r}, second[] = {VALUE(H_COUNTER), r, r};
  const double weights[] = {first[0] - second[0], VALUE(H_GRAVITY), r};
  built->rope = (rot_axle_rope){{first[0], second[0]}, r, own, weights[1]};
  built->scene.linear.inertia_kg_m2 =
      rot_sum_product(rot_sum_product(own, 3, first, &lo), 3, second, &lo);
  status = turns(built->scene.linear.inertia_kg_m2, 1, H_BODY, no);
  if (status != ROT_OK) return status;
  const double torque = rot_sum_product(0.0, 3, weights, &lo);
  if (!isfinite(torque)) {
    return rot_refuse(no, H_MASS, "has a weight whose torque exceeds double precision");
  }
  const rot_given weight = {.is = ROT_INPUT_NUMBER, .n = 1, .x = &torque};
  rot_resistance terms;
  status = rot_resistance_of(&hanging_inputs[H_RESISTANCE], H_RESISTANCE, &given[H_RESISTANCE],
                             &terms, no);
  if (status != ROT_OK) return status;
  return rot_axle_load(&weight, &terms, store, &built->scene, &built->own);
#undef VALUE
}

static const rot_derived hanging_derived[] = {
    MOMENT(scene.linear.inertia_kg_m2),
    {"radius_m", offsetof(rot_axle_built, rope.radius_m), 1},
    UNIT_AXIS};

/* ---- scene_gears() --------------------------------------------------------------------------- */

enum { G_BODIES, G_RATIOS, G_EFFICIENCY, G_TORQUE, G_VISCOUS, G_THETA, G_OMEGA, G_FROM };

#define EACH(name, unit, required, low, high, above, otherwise, words)                             \
  { name, unit, ROT_INPUT_NUMBERS, required, low, high, above, otherwise, words, NULL }

static const rot_input gears_inputs[] = {
    [G_BODIES] = {"bodies", "kg*m^2", ROT_BODY_KINDS | ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1, 0.0,
                  DBL_MAX, 1, NAN,
                  "of the shafts, in their order: bodies, of which Izz counts, or moments", NULL},
    [G_RATIOS] = EACH("ratios", "1", 1, -DBL_MAX, DBL_MAX, 0, NAN,
                      "of each stage, omega before it over omega behind it: one number, or one for "
                      "each; not 0"),
    [G_EFFICIENCY] = EACH("efficiency", "1", 0, 0.0, 1.0, 1, 1.0, "of each stage, likewise"),
    [G_TORQUE] = EACH("torque", "N*m", 0, -DBL_MAX, DBL_MAX, 0, 0.0, "on each shaft from outside"),
    [G_VISCOUS] = {"resistance", "N*m*s", ROT_RESISTANCES, 0, 0.0, DBL_MAX, 0, 0.0,
                   "viscous, of each shaft: numbers, resistances, one or a list",
                   rot_viscous_resistance},
    [G_THETA] = THETA0("angle of the first shaft at the start"),
    [G_OMEGA] = OMEGA0("angular velocity of the first shaft at the start"),
    [G_FROM] = START,
};

/* inputs of the shafts => train converted to the first shaft. */
static rot_status read_train(const rot_given given[], rot_store *store, rot_axle_train *train,
                             rot_refusal *no) {
  const size_t n = rot_body_count(&given[G_BODIES]), meshes = n ? n - 1 : 0;
  double *inertia = rot_store_get(store, n, sizeof *inertia);
  double *ratio = rot_store_get(store, meshes, sizeof *ratio);
  double *efficiency = rot_store_get(store, meshes, sizeof *efficiency);
  double *torque = rot_store_get(store, n, sizeof *torque);
  double *viscous = rot_store_get(store, n, sizeof *viscous);
  if (!inertia || !ratio || !efficiency || !torque || !viscous) return ROT_ENOMEM;
  rot_status status = rot_body_moments(given, G_BODIES, inertia, no);
  if (status != ROT_OK) return status;
  if (given[G_TORQUE].n == 1 && n > 1 && given[G_TORQUE].x[0] != 0.0) {
    return rot_refuse(no, G_TORQUE, "must have a torque for each of the %zu shafts", n);
  }
  const struct {
    size_t input, n;
    double *to;
  } each[] = {{G_RATIOS, meshes, ratio}, {G_EFFICIENCY, meshes, efficiency}, {G_TORQUE, n, torque}};
  for (size_t i = 0; i < ROT_COUNT(each); i++) {
    status = rot_input_each(gears_inputs, given, each[i].input, each[i].n, each[i].to, no);
    if (status != ROT_OK) return status;
  }
  status =
      rot_resistance_each(&gears_inputs[G_VISCOUS], G_VISCOUS, &given[G_VISCOUS], n, viscous, no);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < meshes; i++) {
    if (ratio[i] == 0.0) return rot_refuse(no, G_RATIOS, "must not be 0");
  }
  return rot_axle_train_reflect(n, ratio, inertia, viscous, torque, efficiency, store, train);
}

/* Train => law as torque, curve, viscous and dry resistance. */
static rot_status build_gears(const rot_given given[], rot_store *store, void *to,
                              rot_refusal *no) {
  rot_axle_built *built = to;
  rot_axle_scene *scene = &built->scene;
  rot_axle_train train;
  rot_axle_train_law law;
  begin(gears_inputs, given, G_THETA, G_FROM, built);
  rot_status status = read_train(given, store, &train, no);
  if (status != ROT_OK) return status;
  status = rot_axle_train_law_of(&train, store, &law);
  if (status == ROT_ESTEP) {
    return rot_refuse(no, G_VISCOUS, "makes power flows change at too many rates");
  }
  if (status != ROT_OK) return status;
  status = turns(law.inertia_kg_m2, 1, G_BODIES, no);
  if (status != ROT_OK) return status;
  if (!isfinite(law.torque_n_m) || !isfinite(law.viscous_n_m_s) || !isfinite(law.dry_n_m)) {
    return rot_refuse(no, G_TORQUE, "at the first shaft exceeds double precision");
  }
  scene->linear.inertia_kg_m2 = law.inertia_kg_m2;
  scene->viscous_n_m_s = law.viscous_n_m_s;
  scene->coulomb_n_m = scene->static_n_m = law.dry_n_m;
  built->is_train = 1;
  memcpy(built->rounding, law.rounding, sizeof law.rounding);
  built->geared = law.lossy;
  built->gears = law.gears;
  rot_law_sum curve;
  const rot_given laws[] = {{.is = ROT_INPUT_NUMBER, .n = 1, .x = &law.torque_n_m},
                            {.is = ROT_INPUT_TORQUE, .n = 1, .object = &curve}};
  const rot_given all = {.is = ROT_INPUT_LIST, .n = law.n_curve ? 2 : 1, .item = laws};
  if (law.n_curve) {
    status = rot_law_curve(law.n_curve, law.omega_rad_per_s, law.curve_n_m, store, &curve);
    if (status != ROT_OK) return status;
  }
  return rot_axle_load(&all, NULL, store, scene, &built->own);
}

static const rot_derived gears_derived[] = {MOMENT(scene.linear.inertia_kg_m2)};

/* ---- constructors ---------------------------------------------------------------------------- */

#define MAKER(name, inputs, build, derived)                                                        \
  { name, ROT_COUNT(inputs), inputs, build, ROT_COUNT(derived), derived }

const rot_maker rot_axle_makers[ROT_AXLE_MAKERS] = {
    MAKER("scene_axle", axle_inputs, build_axle, axle_derived),
    MAKER("scene_pendulum", pendulum_inputs, build_pendulum, pendulum_derived),
    MAKER("scene_hanging_mass", hanging_inputs, build_hanging, hanging_derived),
    MAKER("scene_gears", gears_inputs, build_gears, gears_derived),
};
