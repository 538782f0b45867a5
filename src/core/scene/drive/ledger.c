#include "scene/drive/ledger.h"

#include <math.h>
#include <string.h>

#include "ground/real.h"
#include "scene/drive/mesh.h"

enum { WORK, RESISTANCE, BRAKE, DAMPER, CLUTCH, MESH, TORQUE, RESISTING, HOUSING, ELASTIC };
const char *const rot_drive_flow_names[ROT_DRIVE_FLOWS] = {
#define X(name) #name,
    ROT_DRIVE_LEDGER(X)
#undef X
};

/* ---- flows ----------------------------------------------------------------------------------- */

/* From the torque of the shaft: a difference of two angles loses the twist of a stiff shaft. */
void rot_drive_elastic(const rot_drive_scene *scene, size_t n, const rot_drive_columns *rows,
                       const rot_info *info, rot_drive_ledger *ledger) {
  const size_t rotors = scene->n;
  double max = 0.0;
  for (size_t i = 0; i < n * rotors; i++) max = fmax(max, fabs(rows->omega_rad_per_s[i]));
  const double omega_error = info->measure[ROT_OMEGA].error + 2.0 * ROT_EPS * max;
  ledger->elastic_error_j = 0.0;
  for (size_t row = 0; row < n; row++) {
    double change = 0.0, error = 0.0;
    for (size_t i = 0; i + 1 < rotors; i++) {
      const rot_drive_coupling *c = &scene->coupling[i];
      const double k = c->stiffness_n_m_per_rad;
      if (c->kind != ROT_DRIVE_SHAFT || k == 0.0) continue;
      const size_t at = row * rotors + i;
      const double *omega = rows->omega_rad_per_s + at, total = rows->coupling_torque_n_m[at];
      const double a = scene->rotor[i].linear.theta0_rad;
      const double b = c->ratio * scene->rotor[i + 1].linear.theta0_rad;
      const double before = k * (a - b);
      const double spring = total - c->damping_n_m_s * (omega[0] - c->ratio * omega[1]);
      const double size = c->damping_n_m_s * (fabs(omega[0]) + fabs(c->ratio * omega[1]));
      const double off = k * ledger->twist_error_rad +
                         c->damping_n_m_s * (1.0 + fabs(c->ratio)) * omega_error +
                         8.0 * ROT_EPS * (fabs(total) + size);
      const double late = 8.0 * ROT_EPS * k * (fabs(a) + fabs(b));
      change += 0.5 * (spring - before) * (spring + before) / k;
      error += (fabs(spring) * off + off * off + fabs(before) * late) / k;
    }
    ledger->elastic_j[row] = change;
    ledger->elastic_error_j = fmax(ledger->elastic_error_j, error);
  }
}

void rot_drive_flow_errors(const rot_drive_scene *scene, const rot_drive_ledger *ledger,
                           double error[ROT_DRIVE_FLOWS]) {
  const double columns = (double)(2 * scene->n - 1);
  for (int k = 0; k < ROT_DRIVE_FLOWS; k++) error[k] = 0.0;
  error[WORK] = ledger->work_error_j;
  error[RESISTANCE] = error[DAMPER] =
      0.5 * ledger->heat_error_j / columns; /* at both ends of a change */
  error[TORQUE] = ledger->impulse_error_n_m_s;
  error[ELASTIC] = ledger->elastic_error_j;
}

/* ---- balances -------------------------------------------------------------------------------- */

enum { ENERGY, MOMENTUM };
const rot_balance rot_drive_balances[ROT_DRIVE_BALANCES] = {
    [ENERGY] = {"energy", NULL, "J"}, [MOMENTUM] = {"angular_momentum", "the axis", "kg m^2/s"}};

const rot_balance_term rot_drive_terms[ROT_DRIVE_TERMS] = {
    {ENERGY, ROT_CHANGE, "change of kinetic energy", 0},
    {ENERGY, ROT_CHANGE, "change of elastic energy", 0},
    {ENERGY, ROT_SUPPLIED, "work of the torques", 0},
    {ENERGY, ROT_DISSIPATED, "heat of resistance and brakes", 0},
    {ENERGY, ROT_DISSIPATED, "heat of dampers", 0},
    {ENERGY, ROT_DISSIPATED, "heat of clutches", 0},
    {ENERGY, ROT_DISSIPATED, "heat of gears", ROT_DRIVE_MESH},
    {MOMENTUM, ROT_CHANGE, "change of angular momentum", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of the torques", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of the gear housings", 0},
    {MOMENTUM, ROT_DISSIPATED, "impulse of resistance and brakes", 0}};

/* Changes as products: a small change of a large energy keeps its digits. */
void rot_drive_audit(const void *of, const rot_span *s, double term[]) {
  enum { OMEGA = 1, HEAT = 8, COUPLING_HEAT = 9 }; /* indices of columns */
  const rot_drive_scene *scene = of;
  const size_t n = scene->n;
  const double *before = s->first + OMEGA * n, *after = s->last + OMEGA * n;
  double kinetic = 0.0, momentum = 0.0, heat = 0.0, behind[3] = {0.0, 0.0, 0.0};
  for (size_t i = 0; i < n; i++) {
    const double inertia = scene->rotor[i].linear.inertia_kg_m2, gain = after[i] - before[i];
    kinetic += 0.5 * inertia * gain * (after[i] + before[i]);
    momentum += inertia * gain;
    heat += s->last[HEAT * n + i] - s->first[HEAT * n + i];
    if (i + 1 < n) { /* shafts, clutches, gears: order of rot_drive_kind */
      behind[scene->coupling[i].kind] +=
          s->last[COUPLING_HEAT * n + i] - s->first[COUPLING_HEAT * n + i];
    }
  }
  const double value[ROT_DRIVE_TERMS] = {kinetic,
                                         s->flow[ELASTIC],
                                         s->flow[WORK],
                                         heat,
                                         behind[ROT_DRIVE_SHAFT],
                                         behind[ROT_DRIVE_CLUTCH],
                                         behind[ROT_DRIVE_GEAR],
                                         momentum,
                                         s->flow[TORQUE],
                                         s->flow[HOUSING],
                                         -s->flow[RESISTING]};
  memcpy(term, value, sizeof value);
}

static int pushes(const rot_axle_scene *rotor) {
  const rot_torque *knots = &rotor->linear.torque;
  int acts = knots->before_n_m != 0.0 || knots->after_n_m != 0.0 || knots->call || rotor->n_terms ||
             rotor->motor_n_m_s != 0.0;
  for (size_t i = 0; i < knots->n; i++) acts |= knots->torque_n_m[i] != 0.0;
  return acts;
}

/* External: torques, resistance, brakes, supports of gears. A clutch may slip unless all joined
 * rotors turn together. */
size_t rot_drive_conserved(const void *of, size_t balance, const char *why[]) {
  const rot_drive_scene *scene = of;
  int torque = 0, resistance = 0, brake = 0, damped = 0, clutch = 0, mesh = 0, housing = 0;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    torque |= pushes(r);
    resistance |= r->viscous_n_m_s != 0.0 || r->quadratic_n_m_s2 != 0.0 || r->coulomb_n_m != 0.0 ||
                  r->static_n_m != 0.0;
    brake |= scene->brake[i].acts;
    if (i + 1 == scene->n) break;
    const rot_drive_coupling *c = &scene->coupling[i];
    damped |= c->damping_n_m_s != 0.0;
    clutch |= c->kind == ROT_DRIVE_CLUTCH;
    mesh |= rot_drive_mesh_loses(c);
    housing |= c->ratio != 1.0;
  }
  const struct {
    unsigned of; /* mask of balances */
    int acts;
    const char *words;
  } causes[] = {{3, torque, "a torque acts on a rotor"},
                {3, resistance, "a resistance acts on a rotor"},
                {3, brake, "a brake acts on a rotor"},
                {1u << ENERGY, damped, "a shaft is damped"},
                {1u << ENERGY, clutch, "a clutch may slip: heat"},
                {1u << ENERGY, mesh, "a gear has a loss"},
                {1u << MOMENTUM, housing, "the housings of the gears take a torque"}};
  size_t n = 0;
  for (size_t i = 0; i < ROT_COUNT(causes); i++) {
    if (causes[i].acts && causes[i].of >> balance & 1u) why[n++] = causes[i].words;
  }
  if (n) return n;
  why[0] = balance == ENERGY
               ? "the shafts give back what they take: kinetic plus elastic energy stays"
               : "all torques act between the rotors";
  return 0;
}
