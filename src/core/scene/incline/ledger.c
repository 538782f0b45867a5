#include "scene/incline/ledger.h"

#include <math.h>
#include <string.h>

#include "ground/real.h"

const char *const rot_incline_flow_names[ROT_INCLINE_FLOWS] = {
    "work_j",
    "gravity_impulse_n_s",
    "slip_heat_j",
    "rolling_heat_j",
    "applied_work_j",
    "drag_heat_j",
    "friction_impulse_n_s",
    "drag_impulse_n_s",
    "applied_impulse_n_s",
    "resistance_impulse_n_m_s",
};

enum { ENERGY, MOMENTUM, SPIN, SPIN_AT_SLOPE };
const rot_balance rot_incline_balances[ROT_INCLINE_KEPT] = {
    [ENERGY] = {"energy", NULL, "J"},
    [MOMENTUM] = {"momentum_along_slope", NULL, "kg m/s"},
    [SPIN] = {"angular_momentum", "the centre of mass", "kg m^2/s"},
    [SPIN_AT_SLOPE] = {"angular_momentum", "a point of the slope", "kg m^2/s"}};

const rot_balance_term rot_incline_terms[ROT_INCLINE_TERMS] = {
    {ENERGY, ROT_CHANGE, "change of translational energy", 0},
    {ENERGY, ROT_CHANGE, "change of rotational energy", 0},
    {ENERGY, ROT_SUPPLIED, "work of gravity", 0},
    {ENERGY, ROT_SUPPLIED, "work of the force", ROT_INCLINE_OUTER},
    {ENERGY, ROT_DISSIPATED, "heat of friction", 0},
    {ENERGY, ROT_DISSIPATED, "heat of rolling resistance", 0},
    {ENERGY, ROT_DISSIPATED, "heat of air drag", ROT_INCLINE_OUTER},
    {MOMENTUM, ROT_CHANGE, "change of momentum", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of gravity", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of friction", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of air drag and the force", ROT_INCLINE_OUTER},
    {SPIN, ROT_CHANGE, "change of angular momentum", 0},
    {SPIN, ROT_SUPPLIED, "impulse of friction", 0},
    {SPIN, ROT_DISSIPATED, "impulse of rolling resistance", 0}};

/* ---- flows ----------------------------------------------------------------------------------- */

static double pull_of(const rot_incline_params *p) {
  return p->mass_kg * p->gravity_m_per_s2 * rot_sin_deg(p->angle_deg);
}

/* row => errors of the flows, from the errors of the measures in *info. */
static void errors_of(const rot_incline_params *p, const rot_incline_place *at,
                      const rot_info *info, const double value[], double error[]) {
  const double weight = p->mass_kg * p->gravity_m_per_s2, pull = fabs(pull_of(p));
  const double x_error = info->measure[ROT_INCLINE_X].error;
  /* The error of a path changes the heat by the friction along it. */
  const double off = 4.0 * (x_error + p->radius_m * info->measure[ROT_INCLINE_THETA].error);
  const double mu = fmin(p->mu_kinetic, 1e300), arm = fmin(p->arm_m / p->radius_m, 1e300);
  for (int k = 0; k < ROT_INCLINE_FLOWS; k++) {
    error[k] = 8.0 * ROT_EPS * fabs(value[k]);
  }
  error[ROT_INCLINE_WORK] += pull * (x_error + 4.0 * ROT_EPS * fabs(at->x_m - p->x0_m));
  error[ROT_INCLINE_GRAVITY_IMPULSE] +=
      8.0 * ROT_EPS * pull * fmax(fabs(at->time_s), fabs(p->start_s));
  if (at->slip_heat_j != 0.0) error[ROT_INCLINE_SLIP_HEAT] += mu * weight * off;
  if (at->rolling_heat_j != 0.0) error[ROT_INCLINE_ROLLING_HEAT] += arm * weight * off;
}

void rot_incline_flow(const rot_incline_params *p, const rot_incline_place *at, int exact,
                      const rot_info *info, double value[], double error[]) {
  const double pull = pull_of(p);
  value[ROT_INCLINE_WORK] = pull == 0.0 ? 0.0 : pull * (at->x_m - p->x0_m);
  value[ROT_INCLINE_GRAVITY_IMPULSE] = pull == 0.0 ? 0.0 : pull * (at->time_s - p->start_s);
  value[ROT_INCLINE_SLIP_HEAT] = at->slip_heat_j;
  value[ROT_INCLINE_ROLLING_HEAT] = at->rolling_heat_j;
  memcpy(value + ROT_INCLINE_SUM, at->sum, sizeof at->sum);
  errors_of(p, at, info, value, error);
  if (!exact) return;
  rot_incline_ledger of;
  const int known = rot_incline_flows(p, p->start_s, at->time_s, &of) == ROT_OK;
  value[ROT_INCLINE_WORK] = known ? of.work_j : NAN;
  value[ROT_INCLINE_FRICTION_IMPULSE] = of.friction_impulse_n_s;
  value[ROT_INCLINE_RESISTANCE_IMPULSE] = of.resistance_impulse_n_m_s;
  error[ROT_INCLINE_WORK] = of.work_rounding_j;
  error[ROT_INCLINE_GRAVITY_IMPULSE] = of.gravity_rounding_n_s;
  error[ROT_INCLINE_FRICTION_IMPULSE] = of.friction_rounding_n_s;
  error[ROT_INCLINE_RESISTANCE_IMPULSE] = of.resistance_rounding_n_m_s;
}

/* ---- balances -------------------------------------------------------------------------------- */

/* Changes as products: a small change of a large energy keeps its digits. */
void rot_incline_audit(const void *of, const rot_span *s, double term[]) {
  const rot_incline_params *p = &((const rot_incline_scene *)of)->slope;
  const double m = p->mass_kg, inertia = p->inertia_kg_m2, *flow = s->flow;
  const double u = s->first[1], v = s->last[1], before = s->first[3], after = s->last[3];
  const double friction = flow[ROT_INCLINE_FRICTION_IMPULSE];
  const double value[ROT_INCLINE_TERMS] = {0.5 * m * (v - u) * (v + u),
                                           0.5 * inertia * (after - before) * (after + before),
                                           flow[ROT_INCLINE_WORK],
                                           flow[ROT_INCLINE_APPLIED_WORK],
                                           flow[ROT_INCLINE_SLIP_HEAT],
                                           flow[ROT_INCLINE_ROLLING_HEAT],
                                           flow[ROT_INCLINE_DRAG_HEAT],
                                           m * (v - u),
                                           flow[ROT_INCLINE_GRAVITY_IMPULSE],
                                           friction,
                                           flow[ROT_INCLINE_DRAG_IMPULSE] +
                                               flow[ROT_INCLINE_APPLIED_IMPULSE],
                                           inertia * (after - before),
                                           -p->radius_m * friction,
                                           flow[ROT_INCLINE_RESISTANCE_IMPULSE]};
  memcpy(term, value, sizeof value);
}

/* Friction dissipates if the contact slips: from the start, or because static friction does not
 * suffice. */
size_t rot_incline_conserved(const void *of, size_t balance, const char *why[]) {
  const rot_incline_scene *scene = of;
  const rot_incline_params *p = &scene->slope;
  const double slope = fabs(rot_sin_deg(p->angle_deg)), across = rot_cos_deg(p->angle_deg);
  const double beta = p->inertia_kg_m2 / p->mass_kg / p->radius_m / p->radius_m;
  const int acts = p->gravity_m_per_s2 != 0.0, level = !acts || p->angle_deg == 0.0;
  const int rack = isinf(p->mu_static) != 0;
  const int sticks = p->v0_m_per_s == p->radius_m * p->omega0_rad_per_s &&
                     (rack || slope * beta / (1.0 + beta) <= p->mu_static * across);
  /* No normal force on a vertical slope. */
  const int smooth = !acts || (!rack && p->mu_static * across == 0.0);
  const int slips = !smooth && !sticks && p->mu_kinetic != 0.0;
  const int arm = acts && p->arm_m * across != 0.0;
  const int drag = scene->drag_n_s_per_m != 0.0 || scene->drag_n_s2_per_m2 != 0.0;
  const int force = scene->force != NULL;
  const int rim = slips || (!level && !smooth) || (sticks && (drag || force));
  const struct {
    unsigned of; /* balances */
    int acts;
    const char *words;
  } causes[] = {
      {1u << ENERGY, slips, "the contact slips: heat"},
      {1u << ENERGY, arm, "the rolling resistance dissipates"},
      {1u << MOMENTUM | 1u << SPIN_AT_SLOPE, !level, "gravity acts along the slope"},
      {1u << MOMENTUM, slips, "friction acts along the slope"},
      {1u << SPIN, rim, "friction acts at the rim"},
      {1u << MOMENTUM | 1u << SPIN | 1u << SPIN_AT_SLOPE, arm, "the rolling resistance acts"},
      {1u << ENERGY | 1u << MOMENTUM | 1u << SPIN_AT_SLOPE, drag, "air drag acts"},
      {1u << ENERGY | 1u << MOMENTUM | 1u << SPIN_AT_SLOPE, force, "a force acts along the slope"},
  };
  static const char *const kept[] = {
      [MOMENTUM] = "no force acts along the slope",
      [SPIN] = "no torque acts about the centre of mass",
      [SPIN_AT_SLOPE] =
          "friction acts along a line through it, gravity and the normal force cancel"};
  size_t n = 0;
  for (size_t i = 0; i < ROT_COUNT(causes); i++) {
    if (causes[i].acts && causes[i].of >> balance & 1u) why[n++] = causes[i].words;
  }
  if (n) return n;
  why[0] = balance != ENERGY ? kept[balance]
           : smooth          ? "no friction acts: kinetic plus potential energy stays"
                    : "the contact sticks, so friction does no work: kinetic plus potential energy "
                      "stays";
  return 0;
}
