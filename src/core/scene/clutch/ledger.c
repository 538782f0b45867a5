#include "scene/clutch/ledger.h"

#include <string.h>

#include "scene/clutch/clutch.h"
#include "scene/clutch/inputs.h"

enum { ENERGY, MOMENTUM };
const rot_balance rot_clutch_balances[ROT_CLUTCH_BALANCES] = {
    [ENERGY] = {"energy", NULL, "J"}, [MOMENTUM] = {"angular_momentum", "the axle", "kg m^2/s"}};

const rot_balance_term rot_clutch_terms[ROT_CLUTCH_TERMS] = {
    {ENERGY, ROT_CHANGE, "change of kinetic energy", 0},
    {ENERGY, ROT_SUPPLIED, "work of the torques", 0},
    {ENERGY, ROT_DISSIPATED, "heat of the clutch", 0},
    {MOMENTUM, ROT_CHANGE, "change of angular momentum", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of the torques", 0}};

/* Changes as products: a small change of a large energy keeps its digits. */
void rot_clutch_audit(const void *scene, const rot_span *s, double term[]) {
  const rot_clutch_params *p = scene;
  double kinetic = 0.0, momentum = 0.0;
  for (int b = 0; b < 2; b++) {
    const size_t omega = b ? ROT_CLUTCH_OMEGA_2 : ROT_CLUTCH_OMEGA_1;
    const double before = s->first[omega], after = s->last[omega];
    kinetic += 0.5 * p->inertia_kg_m2[b] * (after - before) * (after + before);
    momentum += p->inertia_kg_m2[b] * (after - before);
  }
  const double value[ROT_CLUTCH_TERMS] = {kinetic, s->flow[ROT_CLUTCH_WORK],
                                          s->last[ROT_CLUTCH_HEAT_J] - s->first[ROT_CLUTCH_HEAT_J],
                                          momentum, s->flow[ROT_CLUTCH_IMPULSE]};
  memcpy(term, value, sizeof value);
}

/* The clutch acts between the bodies, and dissipates while it slips. */
size_t rot_clutch_conserved(const void *scene, size_t balance, const char *why[]) {
  const rot_clutch_params *p = scene;
  const int slips = p->capacity_n_m > 0.0 && p->omega0_rad_per_s[0] != p->omega0_rad_per_s[1];
  size_t n = 0;
  if (rot_clutch_is_driven(p)) why[n++] = "a torque acts on a body";
  if (balance == ENERGY && slips) why[n++] = "the clutch slips: heat";
  if (n) return n;
  why[0] = balance == ENERGY ? "the clutch does not slip" : "the clutch acts between the bodies";
  return 0;
}
