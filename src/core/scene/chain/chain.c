#include "scene/chain/chain.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "engine/stepping.h"
#include "engine/ode/system.h"
#include "engine/resistance.h"
#include "ground/real.h"
#include "scene/chain/modes.h"

typedef struct chain {
  rot_links links;
  double mass_kg[ROT_LINKS_MAX]; /* > 0 */
  double theta0_rad[ROT_LINKS_MAX];
  double omega0_rad_per_s[ROT_LINKS_MAX];
  double start_s;
  rot_links_modes modes;
} chain;

/* ---- inputs ---------------------------------------------------------------------------------- */

enum { LENGTH, MASS, LINKS, THETA0, OMEGA0, RESISTANCE, GRAVITY, START, INPUTS };

static const char *const kinds[] = {"rods", "points", NULL};

static const rot_input inputs[INPUTS] = {
#define INPUT(name, unit, kind, required, low, above, otherwise, words)                            \
  { name, unit, kind, required, low, DBL_MAX, above, otherwise, words, NULL }
    [LENGTH] = INPUT("length_m", "m", ROT_INPUT_NUMBERS, 1, 0.0, 1, NAN,
                     "of each link, from the pivot down; 1 to 16"),
    [MASS] = INPUT("mass_kg", "kg", ROT_INPUT_NUMBERS, 1, 0.0, 1, NAN, "of each link, or of all"),
    [LINKS] = {"links", "", ROT_INPUT_CHOICE, 0, 0.0, 0.0, 0, NAN,
               "uniform rods, or point masses at the lower ends of massless rods", kinds},
    [THETA0] = INPUT("theta0_rad", "rad", ROT_INPUT_NUMBERS, 1, -DBL_MAX, 0, NAN,
                     "angle of each link from the downward vertical at the start, or of all"),
    [OMEGA0] = INPUT("omega0_rad_per_s", "rad/s", ROT_INPUT_NUMBERS, 0, -DBL_MAX, 0, 0.0,
                     "rate of each link at the start, or of all"),
    [RESISTANCE] = {"resistance", "N*m*s", ROT_RESISTANCES, 0, 0.0, DBL_MAX, 0, 0.0,
                    "viscous, to the relative rate in the joint above each link: numbers, "
                    "resistances, one or a list",
                    rot_viscous_resistance},
    [GRAVITY] = INPUT("gravity_m_per_s2", "m/s^2", ROT_INPUT_NUMBER, 0, 0.0, 0, 9.80665,
                      "acceleration of gravity"),
    [START] =
        INPUT("start_s", "s", ROT_INPUT_NUMBER, 0, -DBL_MAX, 0, 0.0, "when the state above holds"),
};

/* input => one number per link, from one number per link or one for all. */
static rot_status spread(const rot_given given[], size_t input, size_t n, double to[],
                         rot_refusal *no) {
  const rot_given *g = &given[input];
  if (g->is && g->n != 1 && g->n != n) {
    return rot_refuse(no, input, "must be one number or %zu, one for each length; it has %zu", n,
                      g->n);
  }
  for (size_t i = 0; i < n; i++) {
    to[i] = g->is ? g->x[g->n == 1 ? 0 : i] : inputs[input].otherwise;
  }
  return ROT_OK;
}

/* 1 if rates and energies are finite, else 0. */
static int in_range(const chain *c) {
  const rot_links *links = &c->links;
  double reach = 0.0, fast = 0.0, ok = 0.0;
  for (size_t i = 0; i < links->n; i++) {
    const double length = links->length_m[i], scaled = links->joint_n_m_s[i] / links->total_kg;
    reach += length;
    fast += length * fabs(c->omega0_rad_per_s[i]);
    ok += scaled / length / length + length / length; /* not finite where it overflows */
  }
  ok += links->total_kg * (links->gravity_m_per_s2 * reach + fast * fast);
  ok += sqrt(links->gravity_m_per_s2) * c->modes.rate[links->n - 1] + reach * reach;
  return ok < INFINITY;
}

/* inputs => chain with masses and modes, or a refusal. */
static rot_status build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  (void)store;
  chain *c = to;
  rot_links *links = &c->links;
  const size_t n = given[LENGTH].n;
  memset(c, 0, sizeof *c);
  if (n < 1 || n > ROT_LINKS_MAX) {
    return rot_refuse(no, LENGTH, "must have 1 to %d numbers; it has %zu", ROT_LINKS_MAX, n);
  }
  links->n = n;
  links->rods = given[LINKS].option == 0;
  links->gravity_m_per_s2 = rot_input_number(inputs, given, GRAVITY);
  c->start_s = rot_input_number(inputs, given, START);
  memcpy(links->length_m, given[LENGTH].x, n * sizeof *links->length_m);
  rot_status status = spread(given, MASS, n, c->mass_kg, no);
  if (status == ROT_OK) status = spread(given, THETA0, n, c->theta0_rad, no);
  if (status == ROT_OK) status = spread(given, OMEGA0, n, c->omega0_rad_per_s, no);
  if (status == ROT_OK) {
    status = rot_resistance_each(&inputs[RESISTANCE], RESISTANCE, &given[RESISTANCE], n,
                                 links->joint_n_m_s, no);
  }
  if (status != ROT_OK) return status;
  if (!rot_links_masses(links, c->mass_kg)) {
    return rot_refuse(no, MASS, "must not differ beyond double precision, nor their sum exceed it");
  }
  status = rot_links_modes_build(links, &c->modes);
  if (status == ROT_ENOMEM) return status;
  if (status != ROT_OK || !in_range(c)) {
    return rot_refuse(no, LENGTH, "leaves energies or rates beyond double precision");
  }
  return ROT_OK;
}

static size_t rows_per_time(const void *scene) { return ((const chain *)scene)->links.n; }

/* ---- equations ------------------------------------------------------------------------------- */

enum { HEAT, IMPULSE, FLOWS };
static const char *const flows[FLOWS] = {"dissipated_j", "torque_impulse_n_m_s"};

/* (angles, rates) => accelerations; rates of heat and impulse. */
static void slopes(const void *scene, const rot_system_state *at, double acceleration[],
                   double flow[], rot_dry_forces *forces) {
  const rot_links *c = &((const chain *)scene)->links;
  (void)forces;
  rot_links_accelerations(c, at->q, at->q_low, at->v, acceleration);
  double heat = 0.0, pull = 0.0;
  for (size_t i = 0; i < c->n; i++) {
    double sine, cosine;
    rot_links_sine(at->q[i], at->q_low[i], &sine, &cosine);
    pull += rot_links_weight(c, i) * sine;
    const double difference = at->v[i] - (i ? at->v[i - 1] : 0.0);
    heat += c->joint_n_m_s[i] * difference * difference;
  }
  flow[HEAT] = heat;
  flow[IMPULSE] = rot_links_joint(c, at->v, 0) - c->total_kg * c->gravity_m_per_s2 * pull;
}

/* ---- columns --------------------------------------------------------------------------------- */

enum { THETA, OMEGA, X, Y, VX, VY, KINETIC, POTENTIAL, TORQUE, COLUMNS };
static const rot_column_of columns[COLUMNS] = {
    ROT_COLUMN("theta_rad", "rad", 1 + ROT_THETA),
    ROT_COLUMN("omega_rad_per_s", "rad/s", 1 + ROT_OMEGA),
    ROT_COLUMN("x_m", "m", 0),
    ROT_COLUMN("y_m", "m", 0),
    ROT_COLUMN("vx_m_per_s", "m/s", 0),
    ROT_COLUMN("vy_m_per_s", "m/s", 0),
    ROT_COLUMN("kinetic_energy_j", "J", 0),
    ROT_COLUMN("potential_energy_j", "J", 0),
    ROT_COLUMN("joint_torque_n_m", "N m", 0)};

/* state => one row per link, from row `at` on. */
static void row(const void *scene, const rot_system_state *state, size_t at, void *const column[]) {
  const chain *c = scene;
  const rot_links *links = &c->links;
  const double f = rot_links_first(links);
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0, rise = 0.0;
  for (size_t i = 0; i < links->n; i++) {
    const double l = links->length_m[i], omega = state->v[i], m = c->mass_kg[i];
    double sine, cosine, half, unused;
    rot_links_sine(state->q[i], state->q_low[i], &sine, &cosine);
    rot_links_sine(0.5 * state->q[i], 0.5 * state->q_low[i], &half, &unused);
    const double dx = l * omega * cosine, dy = l * omega * sine, up = 2.0 * l * half * half;
    const double centre = hypot(vx + f * dx, vy + f * dy);
    const double spin = links->rods ? l * omega * sqrt(1.0 / 12.0) : 0.0;
    const double height = rise + f * up;
    x += l * sine;
    y -= l * cosine;
    vx += dx;
    vy += dy;
    rise += up;
    const double value[COLUMNS] = {state->q[i],
                                   omega,
                                   x,
                                   y,
                                   vx,
                                   vy,
                                   0.5 * m * (centre * centre + spin * spin),
                                   m * links->gravity_m_per_s2 * height,
                                   rot_links_joint(links, state->v, i)};
    for (int k = 0; k < COLUMNS; k++) ((double *)column[k])[at + i] = value[k];
  }
}

/* ---- balances -------------------------------------------------------------------------------- */

enum { ENERGY, MOMENTUM, BALANCES };
static const rot_balance balances[BALANCES] = {
    [ENERGY] = {"energy", NULL, "J"}, [MOMENTUM] = {"angular_momentum", "the pivot", "kg m^2/s"}};

static const rot_balance_term terms[] = {
    {ENERGY, ROT_CHANGE, "change of kinetic energy", 0},
    {ENERGY, ROT_CHANGE, "change of potential energy", 0},
    {ENERGY, ROT_DISSIPATED, "heat in the joints", 0},
    {MOMENTUM, ROT_CHANGE, "change of angular momentum", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of gravity and of the joint at the pivot", 0}};
enum { TERMS = ROT_COUNT(terms) };

/* (two rows, flows) => terms of the balances. Changes as products: a small change of a large energy
 * keeps its digits. */
static void audit(const void *scene, const rot_span *s, double term[]) {
  const rot_links *links = &((const chain *)scene)->links;
  const size_t n = links->n;
  const double *a = s->first + THETA * n, *b = s->last + THETA * n;
  const double *u = s->first + OMEGA * n, *v = s->last + OMEGA * n;
  double kinetic = 0.0, potential = 0.0, momentum = 0.0;
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      const double inertia = links->total_kg * rot_links_inertia(links, i, j);
      const double before = a[i] - a[j], after = b[i] - b[j];
      const double change = (b[i] - a[i]) - (b[j] - a[j]);
      const double bent = -2.0 * sin(0.5 * (after + before)) * sin(0.5 * change);
      kinetic += 0.5 * inertia * ((v[i] - u[i]) * cos(after) * (v[j] + u[j]) + u[i] * bent * u[j]);
      momentum += inertia * (cos(after) * (v[j] - u[j]) + bent * u[j]);
    }
    potential += 2.0 * links->total_kg * links->gravity_m_per_s2 * rot_links_weight(links, i) *
                 sin(0.5 * (b[i] - a[i])) * sin(0.5 * (b[i] + a[i]));
  }
  const double value[TERMS] = {kinetic, potential, s->flow[HEAT], momentum, s->flow[IMPULSE]};
  memcpy(term, value, sizeof value);
}

static int rubs(const chain *c) {
  int any = 0;
  for (size_t i = 0; i < c->links.n; i++) any = any || c->links.joint_n_m_s[i] != 0.0;
  return any;
}

static size_t conserved(const void *scene, size_t balance, const char *why[]) {
  const chain *c = scene;
  const int heavy = c->links.gravity_m_per_s2 != 0.0;
  if (balance == ENERGY) {
    *why = rubs(c) ? "the joints dissipate energy" : "gravity alone works, and has a potential";
    return rubs(c) != 0;
  }
  if (heavy) return (*why = "gravity has a torque about the pivot", 1);
  if (c->links.joint_n_m_s[0] != 0.0) return (*why = "the joint at the pivot has a torque", 1);
  *why = "no torque about the pivot: the force of the pivot has no arm";
  return 0;
}

/* The sum of the decay rates is the trace of M^-1 C. */
static void time_scales(const void *scene, const double sizes[], rot_time_scales *to) {
  const chain *c = scene;
  const size_t n = c->links.n;
  const double *inverse = c->modes.inverse;
  double fades = 0.0;
  for (size_t k = 0; k < n; k++) {
    const double own = inverse[k * n + k];
    const double relative =
        k ? own - 2.0 * inverse[k * n + k - 1] + inverse[(k - 1) * n + k - 1] : own;
    fades += c->links.joint_n_m_s[k] / c->links.total_kg * fmax(relative, 0.0);
  }
  to->fades_s = fades > 0.0 ? 1.0 / fades : INFINITY;
  to->swing_rad_per_s =
      2.0 * sizes[ROT_OMEGA] + sqrt(c->links.gravity_m_per_s2) * c->modes.rate[n - 1];
}

/* ---- effects --------------------------------------------------------------------------------- */

enum { WEIGHS = 1, DAMPS = 2, ALL = 3 };
static const rot_effect effects[] = {{"gravity", "gravity", 0, 0},
                                     {"damping", "viscous joints", 0, 0}};

static unsigned effects_of(const void *scene) {
  const chain *c = scene;
  return (c->links.gravity_m_per_s2 != 0.0 ? WEIGHS : 0u) | (rubs(c) ? DAMPS : 0u);
}

/* ---- the integrator -------------------------------------------------------------------------- */

static rot_system_start start(const void *scene) {
  const chain *c = scene;
  const size_t n = c->links.n;
  const double fastest = c->modes.rate[n - 1];
  double leans = 0.0;
  for (size_t i = 0; i < n; i++) leans = fmax(leans, fabs(sin(c->theta0_rad[i])));
  return (rot_system_start){.n = n,
                            .rows_per_time = n,
                            .q = c->theta0_rad,
                            .v = c->omega0_rad_per_s,
                            .start_s = c->start_s,
                            .rounding = c->links.gravity_m_per_s2 * fastest * fastest * leans};
}

static const rot_system of_links = {FLOWS, start, slopes, row, time_scales};
ROT_SYSTEM_RUNS(of_links)

/* ---- small amplitudes ------------------------------------------------------------------------ */

static const char *why_no_modes(const void *scene, const rot_query *query) {
  const chain *c = scene;
  (void)query;
  if (c->links.gravity_m_per_s2 == 0.0) return "without gravity nothing swings";
  const rot_links_bound bound =
      rot_links_linear_bound(&c->links, &c->modes, c->theta0_rad, c->omega0_rad_per_s, 0.0);
  return isinf(bound.theta) ? "the links may swing by more than half a radian from hanging" : NULL;
}

static double farthest(const chain *c, size_t n, const double time_s[]) {
  return n ? fmax(fabs(time_s[0] - c->start_s), fabs(time_s[n - 1] - c->start_s)) : 0.0;
}

enum { LOOKS = 32 };

/* Bound of the error, relative to the largest values at the start and at 32 of the query's
 * times. */
static double modes_bound(const rot_model *model, const void *scene, const rot_query *query) {
  const chain *c = scene;
  if (model->error_kind != ROT_BOUND) return 0.0;
  const rot_links *links = &c->links;
  const size_t n = links->n;
  const double t = farthest(c, query->n, query->time_s);
  const rot_links_bound off =
      rot_links_linear_bound(links, &c->modes, c->theta0_rad, c->omega0_rad_per_s, t);
  if (isinf(off.theta)) return INFINITY;
  double max[2] = {0.0, 0.0};
  rot_links_swing swing;
  rot_links_swing_start(links, &c->modes, c->theta0_rad, c->omega0_rad_per_s, &swing);
  for (int k = 0; k <= LOOKS; k++) {
    double theta[ROT_LINKS_MAX], omega[ROT_LINKS_MAX], at = c->start_s;
    if (k && query->n) at = query->time_s[(size_t)(k - 1) * (query->n - 1) / (LOOKS - 1)];
    rot_links_swing_at(links, &c->modes, &swing, at - c->start_s, theta, omega, NULL);
    for (size_t i = 0; i < n; i++) {
      max[0] = fmax(max[0], fabs(theta[i]));
      max[1] = fmax(max[1], fabs(omega[i]));
    }
  }
  return fmax(rot_relative_error(off.theta, max[0]), rot_relative_error(off.omega, max[1]));
}

typedef struct modes_run {
  const chain *c;
  const double *time_s;
  const rot_rows *rows;
  rot_links_swing swing;
  rot_info *info;
} modes_run;

/* Rows of all links at time i, by modes. */
static rot_status modes_row(void *model, size_t i) {
  static const double none[ROT_LINKS_MAX] = {0.0};
  const modes_run *run = model;
  const rot_links *links = &run->c->links;
  double theta[ROT_LINKS_MAX], omega[ROT_LINKS_MAX], sum;
  rot_links_swing_at(links, &run->c->modes, &run->swing, run->time_s[i] - run->c->start_s, theta,
                     omega, &sum);
  const rot_system_state state = {.q = theta, .q_low = none, .v = omega};
  row(run->c, &state, i * links->n, run->rows->column);
  for (size_t k = 0; k < links->n; k++) rot_note_state(run->info, theta[k], omega[k]);
  if (run->rows->flow) {
    run->rows->flow[HEAT][i] = 0.0;
    run->rows->flow[IMPULSE][i] = -links->total_kg * sum;
  }
  return ROT_OK;
}

/* (scene, task) => rows and flows by modes, error bounds. */
static rot_status swing_rows(const void *scene, const rot_task *task, rot_method method,
                             const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {.write_row = modes_row};
  const chain *c = scene;
  modes_run run = {.c = c, .time_s = task->time_s, .rows = rows, .info = info};
  (void)method;
  rot_links_swing_start(&c->links, &c->modes, c->theta0_rad, c->omega0_rad_per_s, &run.swing);
  for (size_t k = 0; k < c->links.n; k++) {
    rot_note_state(info, c->theta0_rad[k], c->omega0_rad_per_s[k]);
  }
  const rot_status status =
      rot_step_rows(&stepping, &run, c->start_s, task->n, task->time_s, hooks, info);
  const rot_links_bound off = rot_links_linear_bound(
      &c->links, &c->modes, c->theta0_rad, c->omega0_rad_per_s, farthest(c, task->n, task->time_s));
  info->measure[ROT_THETA].error = off.theta;
  info->measure[ROT_OMEGA].error = off.omega;
  if (rows->flow_error) {
    rows->flow_error[HEAT] = 0.0;
    rows->flow_error[IMPULSE] = c->links.total_kg * off.sum;
  }
  return status;
}

static double modes_s(const rot_model *model, const void *scene, const rot_query *query) {
  const double n = (double)((const chain *)scene)->links.n;
  return model->seconds[0] * n * n +
         (double)query->n * n * (model->seconds[1] + model->seconds[2] * n);
}

rot_status rot_chain_modes(const double length[], const double mass[], size_t n, int rods,
                           double gravity, double omega_rad_per_s[], double shape[]) {
  rot_links links = {.n = n, .rods = rods};
  rot_links_modes modes;
  if (n < 1 || n > ROT_LINKS_MAX || !(gravity >= 0.0 && gravity < INFINITY)) return ROT_EVALUE;
  for (size_t i = 0; i < n; i++) {
    if (!(length[i] > 0.0 && length[i] < INFINITY && mass[i] > 0.0)) return ROT_EVALUE;
    links.length_m[i] = length[i];
  }
  if (!rot_links_masses(&links, mass)) return ROT_EVALUE;
  const rot_status status = rot_links_modes_build(&links, &modes);
  if (status != ROT_OK) return status;
  for (size_t j = 0; j < n; j++) {
    double max = 0.0;
    omega_rad_per_s[j] = sqrt(gravity) * modes.rate[j];
    if (!isfinite(omega_rad_per_s[j])) return ROT_ERANGE;
    for (size_t i = 0; i < n; i++) {
      const double angle = modes.shape[i * n + j] / modes.root[i];
      if (fabs(angle) > fabs(max)) max = angle;
    }
    for (size_t i = 0; i < n; i++) {
      shape[i * n + j] = modes.shape[i * n + j] / modes.root[i] / max;
    }
  }
  return ROT_OK;
}

/* ---- the table ------------------------------------------------------------------------------- */

static const rot_model models[] = {{"chain_modes",
                                    WEIGHS,
                                    ROT_BOUND,
                                    1e-14,
                                    ROT_FREELY,
                                    "small swings: a sum of its modes",
                                    why_no_modes,
                                    modes_s,
                                    {1e-6, 0.15e-6, 0.01e-6, 0.0}},
                                   ROT_SYSTEM_MODELS("chain_", ALL)};
static const rot_model_run runs[] = {{ROT_METHOD_NONE, swing_rows}, ROT_SYSTEM_METHODS};

const rot_constraint rot_chain_constraint = {ROT_CONSTRAINT(chain, rot_turning),
                                             .bound = modes_bound, .index = "link",
                                             .rows_per_time = rows_per_time};
