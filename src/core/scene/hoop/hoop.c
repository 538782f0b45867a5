#include "scene/hoop/hoop.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "engine/ode/system.h"
#include "ground/real.h"

typedef struct hoop {
  double mass_kg, radius_m, turn_rad_per_s; /* of the hoop about the vertical */
  double theta0_rad, omega0_rad_per_s, drag_n_s_per_m, mu_kinetic, mu_static, gravity_m_per_s2;
  double start_s;
} hoop;

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { MASS, RADIUS, TURN, THETA0, OMEGA0, DRAG, STATIC, KINETIC, GRAVITY, START, INPUTS };

static const rot_input inputs[INPUTS] = {
#define NUMBER(name, unit, required, low, above, otherwise, words)                                 \
  { name, unit, ROT_INPUT_NUMBER, required, low, DBL_MAX, above, otherwise, words, NULL }
    [MASS] = NUMBER("mass_kg", "kg", 1, 0.0, 1, NAN, "of the bead"),
    [RADIUS] = NUMBER("radius_m", "m", 1, 0.0, 1, NAN, "of the hoop"),
    [TURN] = NUMBER("hoop_omega_rad_per_s", "rad/s", 1, -DBL_MAX, 0, NAN,
                    "rate of the hoop about its vertical diameter"),
    [THETA0] = NUMBER("theta0_rad", "rad", 0, -DBL_MAX, 0, 0.0, "from the lowest point, at start"),
    [OMEGA0] = NUMBER("omega0_rad_per_s", "rad/s", 0, -DBL_MAX, 0, 0.0, "theta' at the start"),
    [DRAG] = NUMBER("drag_n_s_per_m", "N*s/m", 0, 0.0, 0, 0.0, "viscous drag along the hoop"),
    [STATIC] = NUMBER("static_friction", "1", 0, 0.0, 0, 0.0, "coefficient of static friction"),
    [KINETIC] = NUMBER("kinetic_friction", "1", 0, 0.0, 0, NAN,
                       "coefficient of kinetic friction; default: that of static friction"),
    [GRAVITY] = NUMBER("gravity_m_per_s2", "m/s^2", 0, 0.0, 0, 9.80665, "acceleration of gravity"),
    [START] = NUMBER("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds"),
};

static rot_status build(const rot_given given[], void *to, rot_refusal *no) {
  hoop *h = to;
#define VALUE(input) rot_input_number(inputs, given, input)
  *h = (hoop){VALUE(MASS), VALUE(RADIUS),  VALUE(TURN),   VALUE(THETA0),  VALUE(OMEGA0),
              VALUE(DRAG), VALUE(KINETIC), VALUE(STATIC), VALUE(GRAVITY), VALUE(START)};
  if (!given[KINETIC].is) h->mu_kinetic = h->mu_static;
  if (h->mu_kinetic > h->mu_static) {
    return rot_refuse(no, KINETIC, "must be at most that of static friction, %g; it is %g",
                      h->mu_static, h->mu_kinetic);
  }
  const double energy = h->mass_kg * h->radius_m * h->radius_m *
                        (h->turn_rad_per_s * h->turn_rad_per_s + h->gravity_m_per_s2 / h->radius_m);
  if (!(h->drag_n_s_per_m / h->mass_kg < INFINITY && energy < INFINITY)) {
    return rot_refuse(no, MASS, "leaves energies or rates beyond double precision");
  }
  return ROT_OK;
}

static double start_s(const void *scene) { return ((const hoop *)scene)->start_s; }

/* ---- equations ------------------------------------------------------------------------------- */

/* Forces over m R. `low`: what theta lacks of the exact angle. */
typedef struct forces {
  double sine, cosine, along, normal;
} forces;

static forces forces_at(const hoop *h, double theta, double low, double omega) {
  const double s = sin(theta) + low * cos(theta), c = cos(theta) - low * sin(theta);
  const double turn = h->turn_rad_per_s, pull = h->gravity_m_per_s2 / h->radius_m;
  const double in_plane = pull * c + omega * omega + turn * turn * s * s;
  return (forces){s, c, (turn * turn * c - pull) * s, hypot(in_plane, 2.0 * turn * c * omega)};
}

enum { WORK, HEAT, IMPULSE, FLOWS };
static const char *const flows[FLOWS] = {"work_j", "dissipated_j", "torque_impulse_n_m_s"};

static void slopes(const void *scene, const rot_system_state *at, double acceleration[],
                   double flow[], double *drive) {
  const hoop *h = scene;
  const double omega = *at->v, inertia = h->mass_kg * h->radius_m * h->radius_m;
  const forces f = forces_at(h, *at->q, *at->q_low, omega);
  const double drag = h->drag_n_s_per_m / h->mass_kg * omega;
  const double dry = h->mu_kinetic * f.normal * at->sign;
  const double torque = 2.0 * inertia * h->turn_rad_per_s * f.sine * f.cosine * omega;
  acceleration[0] = f.along - drag - dry;
  flow[WORK] = torque * h->turn_rad_per_s;
  flow[HEAT] = inertia * (drag + dry) * omega;
  flow[IMPULSE] = torque;
  if (drive) *drive = f.along / fmax(f.normal, DBL_MIN);
}

/* ---- columns --------------------------------------------------------------------------------- */

enum { THETA, OMEGA, TORQUE, NORMAL, KINETIC_J, POTENTIAL_J, COLUMNS };
static const rot_column_of columns[COLUMNS] = {
    {"theta_rad", 0, 0, "rad", 1 + ROT_THETA}, {"omega_rad_per_s", 0, 0, "rad/s", 1 + ROT_OMEGA},
    {"drive_torque_n_m", 0, 0, "N m", 0},      {"normal_n", 0, 0, "N", 0},
    {"kinetic_energy_j", 0, 0, "J", 0},        {"potential_energy_j", 0, 0, "J", 0}};

static void row(const void *scene, const rot_system_state *at, size_t i, void *const column[]) {
  const hoop *h = scene;
  const double omega = *at->v, m = h->mass_kg, r = h->radius_m, turn = h->turn_rad_per_s;
  const forces f = forces_at(h, *at->q, *at->q_low, omega);
  const double half = sin(0.5 * *at->q);
  const double value[COLUMNS] = {*at->q,
                                 omega,
                                 2.0 * m * r * r * turn * f.sine * f.cosine * omega,
                                 m * r * f.normal,
                                 0.5 * m * r * r * (omega * omega + turn * turn * f.sine * f.sine),
                                 2.0 * m * h->gravity_m_per_s2 * r * half * half};
  for (int k = 0; k < COLUMNS; k++) ((double *)column[k])[i] = value[k];
}

/* ---- balances -------------------------------------------------------------------------------- */

enum { ENERGY, SEEN, MOMENTUM, BALANCES };
static const rot_balance balances[BALANCES] = {
    [ENERGY] = {"energy", NULL, "J"},
    [SEEN] = {"energy_in_the_hoop", NULL, "J"},
    [MOMENTUM] = {"angular_momentum", "the vertical axis", "kg m^2/s"}};

static const rot_balance_term terms[] = {
    {ENERGY, ROT_CHANGE, "change of kinetic energy", 0},
    {ENERGY, ROT_CHANGE, "change of potential energy", 0},
    {ENERGY, ROT_SUPPLIED, "work that keeps the hoop turning", 0},
    {ENERGY, ROT_DISSIPATED, "heat of friction", 0},
    {SEEN, ROT_CHANGE, "change of kinetic energy along the hoop", 0},
    {SEEN, ROT_CHANGE, "change of potential energy", 0},
    {SEEN, ROT_CHANGE, "change of centrifugal potential", 0},
    {SEEN, ROT_DISSIPATED, "heat of friction", 0},
    {MOMENTUM, ROT_CHANGE, "change of angular momentum", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse that keeps the hoop turning", 0}};
enum { TERMS = sizeof terms / sizeof *terms };

/* Changes as products: a small one of a large energy keeps its digits. */
static void audit(const void *scene, const rot_span *s, double term[], double explained[]) {
  const hoop *h = scene;
  const double inertia = h->mass_kg * h->radius_m * h->radius_m, turn = h->turn_rad_per_s;
  const double a = s->first[THETA], b = s->last[THETA], u = s->first[OMEGA], v = s->last[OMEGA];
  const double along = 0.5 * inertia * (v - u) * (v + u);
  const double squares = inertia * sin(b - a) * sin(b + a); /* of m R^2 sin^2 theta */
  const double weight = h->mass_kg * h->gravity_m_per_s2 * h->radius_m;
  const double height = 2.0 * weight * sin(0.5 * (b - a)) * sin(0.5 * (b + a));
  const double round = turn * turn * squares;
  const double value[TERMS] = {
      along + 0.5 * round, height,        s->flow[WORK],  s->flow[HEAT],   along, height,
      -0.5 * round,        s->flow[HEAT], turn * squares, s->flow[IMPULSE]};
  const double off = s->error[ROT_THETA], sloped = fabs(sin(2.0 * a)) + fabs(sin(2.0 * b));
  const double most = inertia * (sloped + 2.0 * off) * off; /* of the squares */
  const double seen = inertia * (fabs(u) + fabs(v)) * s->error[ROT_OMEGA] +
                      weight * (fabs(sin(a)) + fabs(sin(b)) + off) * off +
                      0.5 * turn * turn * most + s->flow_error[HEAT];
  memcpy(term, value, sizeof value);
  explained[SEEN] = seen;
  explained[ENERGY] = seen + s->flow_error[WORK];
  explained[MOMENTUM] = fabs(turn) * most + s->flow_error[IMPULSE];
  for (int k = 0; k < TERMS; k++) explained[terms[k].balance] += 8.0 * ROT_EPS * fabs(value[k]);
}

static int keeps(const void *scene, size_t balance, const char **why) {
  const hoop *h = scene;
  const int rubs = h->drag_n_s_per_m != 0.0 || h->mu_kinetic != 0.0;
  const int turns = h->turn_rad_per_s != 0.0;
  const char *const driven = "the drive works and turns: it keeps the rate of the hoop";
  if (turns && balance != SEEN) return (*why = driven, 0);
  if (rubs && balance != MOMENTUM) return (*why = "friction along the hoop", 0);
  *why = turns ? "in the frame of the hoop no force works but those with a potential"
               : "the hoop is at rest";
  return 1;
}

static void pace(const void *scene, const double sizes[], rot_pace *to) {
  const hoop *h = scene;
  const double drag = h->drag_n_s_per_m / h->mass_kg;
  to->fades_s = drag > 0.0 ? 1.0 / drag : INFINITY;
  to->swing_rad_per_s =
      2.0 * sizes[ROT_OMEGA] + fabs(h->turn_rad_per_s) + sqrt(h->gravity_m_per_s2 / h->radius_m);
}

/* ---- effects and models ---------------------------------------------------------------------- */

enum { WEIGHS = 1, TURNS = 2, DRAGS = 4, RUBS = 8, ALL = 15 };
static const rot_effect effects[] = {{"gravity", "gravity", 0, 0},
                                     {"turn", "the turning of the hoop", 0, 0},
                                     {"drag", "viscous drag", 0, 0},
                                     {"friction", "dry friction", 0, 0}};

static unsigned effects_of(const void *scene) {
  const hoop *h = scene;
  return (h->gravity_m_per_s2 != 0.0 ? WEIGHS : 0u) | (h->turn_rad_per_s != 0.0 ? TURNS : 0u) |
         (h->drag_n_s_per_m != 0.0 ? DRAGS : 0u) | (h->mu_static != 0.0 ? RUBS : 0u);
}

static rot_status run(const void *scene, const rot_task *task, rot_method method,
                      const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const hoop *h = scene;
  const double rates = h->gravity_m_per_s2 / h->radius_m + h->turn_rad_per_s * h->turn_rad_per_s;
  const rot_system system = {.n = 1,
                             .n_flows = FLOWS,
                             .start_s = h->start_s,
                             .q0 = &h->theta0_rad,
                             .v0 = &h->omega0_rad_per_s,
                             .slopes = slopes,
                             .dry = h->mu_static != 0.0,
                             .holds = h->mu_static,
                             .rounding = rates * fabs(sin(h->theta0_rad)),
                             .row = row};
  return rot_system_run(&system, scene, rot_turning, 1, task, method, rows, hooks, info);
}

static double cost_s(const rot_model *model, const void *scene, const rot_query *query,
                     int implicit) {
  const hoop *h = scene;
  const double sizes[] = {0.0, fabs(h->omega0_rad_per_s)};
  rot_pace own;
  pace(scene, sizes, &own);
  return rot_system_cost_s(model, query, h->start_s, &own, implicit);
}

static double explicit_s(const rot_model *model, const void *scene, const rot_query *query) {
  return cost_s(model, scene, query, 0);
}

static double implicit_s(const rot_model *model, const void *scene, const rot_query *query) {
  return cost_s(model, scene, query, 1);
}

static const rot_model models[] = {ROT_SYSTEM_MODELS("hoop_", ALL, explicit_s, implicit_s)};
static const rot_model_run runs[] = {{ROT_METHOD_RK8PD, run}, {ROT_METHOD_RADAU, run}};

const rot_constraint rot_hoop_constraint = {
    .id = "hoop",
    .measures = rot_turning,
    .n_effects = sizeof effects / sizeof *effects,
    .n_models = sizeof models / sizeof *models,
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    .constructor = "scene_hoop",
    .n_inputs = INPUTS,
    .n_columns = COLUMNS,
    .inputs = inputs,
    .columns = columns,
    .runs = runs,
    .scene_size = sizeof(hoop),
    .build = build,
    .start_s = start_s,
    .n_flows = FLOWS,
    .n_balances = BALANCES,
    .n_terms = TERMS,
    .flows = flows,
    .balances = balances,
    .terms = terms,
    .audit = audit,
    .keeps = keeps,
    .pace = pace,
};
