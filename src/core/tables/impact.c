#include "tables/impact.h"

#include <math.h>

rot_bounce rot_impact_bounce(const rot_bounce_input *in) {
  const double m = in->mass_kg, r = in->radius_m, fraction = 1.0 / (1.0 + 1.0 / in->beta);
  rot_bounce out = {in->vx, in->vy, in->omega, 0.0, 0.0, 0.0, 0.0, 0};
  if (!(in->vy < 0.0)) return out;
  const double e = in->restitution, u = in->vx - r * in->omega;
  out.normal_impulse = -(1.0 + e) * m * in->vy;
  out.vy = -e * in->vy;
  out.normal_loss = 0.5 * m * (1.0 - e) * (1.0 + e) * in->vy * in->vy;
  /* Impulse that stops the slip; with tangential restitution. */
  const double et = in->tangential, stop = m * fabs(u) * fraction, stick = (1.0 + et) * stop;
  const double max = in->friction * out.normal_impulse;
  out.sticks = stick <= max;
  const double size = out.sticks ? stick : max;
  out.friction_impulse = u > 0.0 ? -size : size;
  out.vx = in->vx + out.friction_impulse / m;
  out.omega = in->omega - out.friction_impulse / (m * in->beta * r);
  /* The slip changes linearly with the impulse: its mean gives the loss. */
  const double left = out.sticks ? -et * fabs(u) : fabs(u) * (1.0 - max / stop);
  out.friction_loss = 0.5 * size * (fabs(u) + left);
  return out;
}

double rot_impact_hinge_fraction(double inertia, double mass, double centre, double distance) {
  return mass * centre * distance / inertia - 1.0;
}

rot_hinged rot_impact_hinged(const rot_hinged_input *in) {
  const double d = in->distance, closing = in->particle_v - in->omega * d;
  rot_hinged out = {0.0, in->omega, in->particle_v, 0.0, 0.0};
  if (!(closing > 0.0)) return out;
  const double e = in->restitution, inverse = 1.0 / in->particle_mass + d * d / in->inertia;
  if (isinf(inverse)) { /* the same with other quotients */
    const double ratio = in->particle_mass * d / in->inertia * d, by = (1.0 + e) * closing;
    const double turn = by / (in->inertia / in->particle_mass / d + d), change = by / (1.0 + ratio);
    out.impulse = ratio < 1.0 ? in->particle_mass * change : turn / d * in->inertia;
    out.omega = in->omega + turn;
    out.particle_v = in->particle_v - change;
    out.hinge_impulse = turn * in->mass * in->centre - out.impulse;
    out.loss = 0.5 * (1.0 - e) * closing * out.impulse;
    return out;
  }
  out.impulse = (1.0 + e) * closing / inverse;
  out.omega = in->omega + out.impulse * d / in->inertia;
  out.particle_v = in->particle_v - out.impulse / in->particle_mass;
  out.hinge_impulse = out.impulse * rot_impact_hinge_fraction(in->inertia, in->mass, in->centre, d);
  out.loss = 0.5 * (1.0 - e) * (1.0 + e) * closing * closing / inverse;
  return out;
}

rot_rims rot_impact_rims(const rot_rims_input *in) {
  const double r1 = in->radius[0], r2 = in->radius[1];
  /* Relative velocity of the rims: r1 omega1 + r2 omega2. */
  const double slip = r1 * in->omega[0] + r2 * in->omega[1], e = in->restitution;
  const double give[2] = {r1 * r1 / in->inertia[0], r2 * r2 / in->inertia[1]};
  const double stop = fabs(slip) / (give[0] + give[1]), stick = (1.0 + e) * stop;
  rot_rims out = {{in->omega[0], in->omega[1]}, 0.0, 0.0, 1};
  out.locked = stick <= in->max;
  const double size = out.locked ? stick : in->max;
  out.impulse = slip > 0.0 ? -size : size;
  out.omega[0] += out.impulse * r1 / in->inertia[0];
  out.omega[1] += out.impulse * r2 / in->inertia[1];
  const double left = out.locked ? -e * fabs(slip) : fabs(slip) * (1.0 - size / stop);
  out.loss = 0.5 * size * (fabs(slip) + left);
  return out;
}
