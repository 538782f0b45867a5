#include "scene/hoop/hoop.h"

#include <float.h>
#include <math.h>

#include "engine/ode/system.h"
#include "maths/angle.h"

/* Units of the inputs below. turn: rate of the hoop about the vertical; drag: N s/m; start: s. */
typedef struct hoop {
  double mass, radius, turn, theta0, omega0, drag, mu_static, mu_kinetic, gravity, start;
  double inertia, weight, lifts; /* m R^2, m g R, turn^2 cos(theta0) - g/R */
  rot_angle from;                /* theta0 */
  rot_dry dry;                   /* of forces over m R */
} hoop;

/* ---- inputs ---------------------------------------------------------------------------------- */

/* clang-format off */
static const rot_input inputs[] = {
    ROT_NUMBER_INPUT("mass_kg", "kg", 1, 0.0, 1, NAN, "of the bead"),
    ROT_NUMBER_INPUT("radius_m", "m", 1, 0.0, 1, NAN, "of the hoop"),
    ROT_NUMBER_INPUT("hoop_omega_rad_per_s", "rad/s", 1, -DBL_MAX, 0, NAN, "about the vertical"),
    ROT_NUMBER_INPUT("theta0_rad", "rad", 0, -DBL_MAX, 0, 0.0, "at the start, 0: lowest"),
    ROT_NUMBER_INPUT("omega0_rad_per_s", "rad/s", 0, -DBL_MAX, 0, 0.0, "its rate at the start"),
    ROT_RESISTANCE_INPUT("drag along the hoop", rot_drag_resistance),
    ROT_NUMBER_INPUT("static_friction", "1", 0, 0.0, 0, 0.0, "coefficient of dry friction at rest"),
    {"kinetic_friction", "1", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, NAN, "moving", rot_max_static},
    ROT_NUMBER_INPUT("gravity_m_per_s2", "m/s^2", 0, 0.0, 0, 9.80665, "acceleration of gravity"),
    ROT_NUMBER_INPUT("start_s", "s", 0, -DBL_MAX, 0, 0.0, "when the state above holds")};
/* clang-format on */

static rot_status build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  (void)store;
  hoop *h = to;
  if (rot_resistance_numbers(ROT_COUNT(inputs), inputs, given, to, no)) return ROT_EVALUE;
  h->inertia = h->mass * h->radius * h->radius;
  h->weight = h->mass * h->gravity * h->radius;
  h->from = rot_angle_from(h->theta0);
  /* 0 where the bead rests: in twice the precision. */
  const rot_dd pull = rot_dd_div((rot_dd){h->gravity, 0.0}, (rot_dd){h->radius, 0.0});
  const rot_dd sine = h->from.sine, cosine = h->from.cosine, square = rot_dd_mul2(h->turn, h->turn);
  const rot_dd up = rot_dd_sub(rot_dd_mul(square, cosine), pull), along = rot_dd_mul(up, sine);
  h->lifts = up.hi;
  const rot_dd in = rot_dd_mul(pull, cosine), out = rot_dd_mul(square, rot_dd_mul(sine, sine));
  h->dry = rot_dry_from(along, rot_dd_add(in, out), h->mu_static, h->mu_kinetic);
  const double rates = h->turn * h->turn + h->gravity / h->radius + h->drag / h->mass;
  if (h->inertia * rates < INFINITY) return ROT_OK;
  return rot_refuse(no, 0, "leaves energies or rates beyond double precision");
}

/* ---- motion ---------------------------------------------------------------------------------- */

/* Forces over m R. By differences from the start: about a rest that is not the lowest point gravity
 * and the centrifugal force cancel, and 1e-9 rad/s was off by 1e-7 of itself. */
static rot_dry_forces forces_at(const hoop *h, const rot_angle_now *at, double omega) {
  const double square = h->turn * h->turn, pull = h->gravity / h->radius, centre = omega * omega;
  const double more = at->change * (pull - square * (at->cosine + h->from.cosine.hi)) + centre;
  const double plane = pull * at->cosine + centre + square * at->sine * at->sine;
  const double gains = square * at->change, across = 2.0 * h->turn * at->cosine * omega;
  return rot_dry_now(&h->dry, (h->lifts + gains) * at->sine, h->lifts * at->rise + gains * at->sine,
                     plane, more, across);
}

static const char *const flows[] = {"work_j", "dissipated_j", "torque_impulse_n_m_s"};
enum { WORK, HEAT, IMPULSE };

static void slopes(const void *scene, const rot_system_state *at, double acceleration[],
                   double flow[], rot_dry_forces *forces) {
  const hoop *h = scene;
  const rot_angle_now now = rot_angle_after(&h->from, *at->moved);
  *forces = forces_at(h, &now, *at->v);
  acceleration[0] = -h->drag / h->mass * *at->v;
  const double rubs = h->mu_kinetic * at->sign * forces->normal - acceleration[0];
  flow[HEAT] = h->inertia * rubs * *at->v;
  flow[IMPULSE] = 2.0 * h->inertia * h->turn * now.sine * now.cosine * *at->v;
  flow[WORK] = flow[IMPULSE] * h->turn;
}

/* clang-format off */
static const rot_column_of columns[] = {
    ROT_COLUMN("theta_rad", "rad", 1 + ROT_THETA),
    ROT_COLUMN("omega_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    ROT_COLUMN("drive_torque_n_m", "N m", 0), ROT_COLUMN("normal_n", "N", 0),
    ROT_COLUMN("kinetic_energy_j", "J", 0), ROT_COLUMN("potential_energy_j", "J", 0)};
/* clang-format on */

static void row(const void *scene, const rot_system_state *at, size_t i, void *const column[]) {
  const hoop *h = scene;
  const double omega = *at->v, half = sin(0.5 * *at->q);
  const rot_angle_now now = rot_angle_after(&h->from, *at->moved);
  const double round = h->turn * now.sine, torque = 2.0 * h->inertia * round * now.cosine * omega;
  const double kinetic = 0.5 * h->inertia * (omega * omega + round * round);
  const double normal = h->mass * h->radius * forces_at(h, &now, omega).normal;
  const double value[] = {*at->q, omega, torque, normal, kinetic, 2.0 * h->weight * half * half};
  for (size_t k = 0; k < ROT_COUNT(columns); k++) ((double *)column[k])[i] = value[k];
}

static void time_scales(const void *scene, const double sizes[], rot_time_scales *to) {
  const hoop *h = scene;
  to->fades_s = h->drag > 0.0 ? h->mass / h->drag : INFINITY;
  to->swing_rad_per_s = 2.0 * sizes[ROT_OMEGA] + fabs(h->turn) + sqrt(h->gravity / h->radius);
}

static rot_system_start start(const void *scene) {
  const hoop *h = scene;
  return (rot_system_start){1, 1, &h->theta0, &h->omega0, h->start, 0.0, &h->dry};
}

/* ---- balances -------------------------------------------------------------------------------- */

enum { ENERGY, SEEN, MOMENTUM };
static const rot_balance balances[] = {{"energy", NULL, "J"},
                                       {"energy_in_the_hoop", NULL, "J"},
                                       {"angular_momentum", "the vertical axis", "kg m^2/s"}};
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

/* Changes as products: a small change of a large energy keeps its digits. */
static void audit(const void *scene, const rot_span *s, double term[]) {
  const hoop *h = scene;
  const double a = s->first[0], b = s->last[0], u = s->first[1], v = s->last[1];
  const double along = 0.5 * h->inertia * (v - u) * (v + u);
  const double height = 2.0 * h->weight * sin(0.5 * (b - a)) * sin(0.5 * (b + a));
  const double momentum = h->turn * h->inertia * sin(b - a) * sin(b + a);
  const double round = 0.5 * h->turn * momentum, heat = s->flow[HEAT];
  const double value[] = {along + round, height, s->flow[WORK], heat,     along,
                          height,        -round, heat,          momentum, s->flow[IMPULSE]};
  for (size_t k = 0; k < ROT_COUNT(terms); k++) term[k] = value[k];
}

static size_t conserved(const void *scene, size_t balance, const char *why[]) {
  const hoop *h = scene;
  const int driven = h->turn != 0.0 && balance != SEEN;
  const int rubs = (h->drag != 0.0 || h->mu_kinetic != 0.0) && balance != MOMENTUM;
  *why = driven           ? "the drive works and turns: it keeps the rate of the hoop"
         : rubs           ? "friction along the hoop"
         : h->turn == 0.0 ? "the hoop is at rest"
                          : "in the frame of the hoop all forces that work have a potential";
  return driven || rubs;
}

/* ---- effects and models ---------------------------------------------------------------------- */

static const rot_effect effects[] = {{"gravity", "gravity", 0, 0},
                                     {"turn", "the turning of the hoop", 0, 0},
                                     {"drag", "viscous drag", 0, 0},
                                     {"friction", "dry friction", 0, 0}};

static unsigned effects_of(const void *scene) {
  const hoop *h = scene;
  return (unsigned)(h->gravity != 0.0) | (unsigned)(h->turn != 0.0) << 1 |
         (unsigned)(h->drag != 0.0) << 2 | (unsigned)(h->mu_static != 0.0) << 3;
}

static const rot_system of_bead = {ROT_COUNT(flows), start, slopes, row, time_scales};
ROT_SYSTEM_CONSTRAINT(hoop, of_bead, 15u);
