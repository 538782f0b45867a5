#include "scene/drive/mesh.h"

#include <math.h>

int rot_drive_mesh_loses(const rot_drive_coupling *coupling) {
  return coupling->kind == ROT_DRIVE_GEAR && coupling->efficiency > 0.0 &&
         coupling->efficiency < 1.0;
}

static double efficiency_of(const rot_drive_system *s, size_t i) {
  const rot_drive_coupling *c = &s->scene->coupling[i];
  return rot_drive_mesh_loses(c) ? c->efficiency : 1.0;
}

double rot_drive_mesh_gain(const rot_drive_system *s, const rot_drive_unit *unit) {
  double gain = 1.0;
  for (size_t i = unit->first; i + 1 < unit->end; i++) gain /= efficiency_of(s, i);
  return gain * gain; /* torques and inertia */
}

/* Torque on rotor i without the gears of its unit. */
static double force_on(const rot_drive_system *s, const rot_drive_unit *unit, size_t i) {
  double torque = s->applied[i] + s->smooth[i] + s->dry[i] + s->brake[i];
  if (i == unit->first && i > 0) torque += s->scene->coupling[i - 1].ratio * s->torque[i - 1];
  if (i + 1 == unit->end && i + 1 < s->n) torque -= s->torque[i];
  return s->fraction[i] * torque;
}

static double inertia_on(const rot_drive_system *s, size_t i) {
  return s->scene->rotor[i].linear.inertia_kg_m2 * s->fraction[i] * s->fraction[i];
}

/* (torque `taken` by rotor i + 1 from its gear) => torque given by rotor i. part: 1: full loss
 * forward, -1: full loss backward; between: a gear at rest. */
static double given(rot_drive_system *s, size_t i, double taken, double part) {
  const double loss = pow(efficiency_of(s, i), taken > 0.0 ? part : taken < 0.0 ? -part : 0.0);
  s->passed[i] = loss;
  s->torque[i] = taken / loss / s->fraction[i];
  return taken / loss;
}

/* ---- turning --------------------------------------------------------------------------------- */

/* Acceleration under the directions of power flow at acceleration a; torques of the gears at a. */
static double with_flows_at(rot_drive_system *s, const rot_drive_unit *unit, double direction,
                            double a) {
  double force = 0.0, inertia = 0.0, taken = 0.0;
  for (size_t i = unit->end; i-- > unit->first;) {
    if (i + 1 < unit->end) {
      const double gives = given(s, i, taken, direction);
      force /= s->passed[i];
      inertia /= s->passed[i];
      taken = gives;
    }
    const double known = force_on(s, unit, i), own = inertia_on(s, i);
    force += known;
    inertia += own;
    taken += own * a - known;
  }
  return force / inertia;
}

/* The torque residual of the first rotor is convex in direction * a and piecewise linear: Newton's
 * iteration is finite, a few steps, monotonic from the second on. */
void rot_drive_mesh_turns(rot_drive_system *s, size_t unit, double direction) {
  const rot_drive_unit *u = &s->unit[unit];
  double a = s->force[unit] / u->inertia;
  const size_t max = 10 + 4 * (u->end - u->first);
  for (size_t turn = 0; turn < max; turn++) {
    const double next = with_flows_at(s, u, direction, a);
    if (turn > 0 && !(direction * next < direction * a)) break;
    a = next;
  }
  with_flows_at(s, u, direction, a);
  s->acceleration[unit] = a;
}

/* ---- at rest --------------------------------------------------------------------------------- */

/* Torque residual of the first rotor if friction and losses resist at the fraction `part`. */
static double lacking(rot_drive_system *s, const rot_drive_unit *unit, double part) {
  double taken = 0.0;
  for (size_t i = unit->end; i-- > unit->first;) {
    if (i + 1 < unit->end) taken = given(s, i, taken, part);
    taken += part * fabs(s->fraction[i]) * (s->dry_cap[i] + s->brake_cap[i]) - force_on(s, unit, i);
  }
  return taken;
}

/* Solves for the common fraction at which friction and losses balance the load. */
void rot_drive_mesh_rests(rot_drive_system *s, size_t unit, double *capacity, double *load) {
  const rot_drive_unit *u = &s->unit[unit];
  double low = -1.0, high = 1.0, at_low = lacking(s, u, low), at_high = lacking(s, u, high);
  *capacity = 0.5 * (at_high - at_low);
  *load = -0.5 * (at_high + at_low);
  double part = at_high <= 0.0 ? high : at_low >= 0.0 ? low : 0.0;
  /* The residual increases with the fraction: regula falsi with bisection. */
  for (int k = 0; at_low < 0.0 && at_high > 0.0 && k < 120; k++) {
    part = k % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * (at_low / (at_low - at_high));
    if (!(part > low && part < high)) break;
    const double at = lacking(s, u, part);
    if (at == 0.0) break;
    if (at < 0.0) {
      low = part;
      at_low = at;
    } else {
      high = part;
      at_high = at;
    }
  }
  lacking(s, u, part);
  for (size_t i = u->first; i < u->end; i++) {
    const double sign = s->fraction[i] > 0.0 ? 1.0 : -1.0;
    s->dry[i] = -part * sign * s->dry_cap[i];
    s->brake[i] = -part * sign * s->brake_cap[i];
  }
  s->acceleration[unit] = 0.0;
}
