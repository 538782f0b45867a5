#include "rot_impact.h"

#include <math.h>

rot_bounce rot_impact_bounce(const rot_bounce_input *in) {
  const double m = in->mass_kg, r = in->radius_m, share = 1.0 / (1.0 + 1.0 / in->beta);
  rot_bounce out = {in->vx, in->vy, in->omega, 0.0, 0.0, 0.0, 0.0, 0};
  if (!(in->vy < 0.0)) return out;
  const double e = in->restitution, u = in->vx - r * in->omega;
  out.normal_impulse = -(1.0 + e) * m * in->vy;
  out.vy = -e * in->vy;
  out.normal_loss = 0.5 * m * (1.0 - e) * (1.0 + e) * in->vy * in->vy;
  const double stick = m * fabs(u) * share, most = in->friction * out.normal_impulse;
  out.grips = stick <= most;
  const double size = out.grips ? stick : most;
  out.friction_impulse = u > 0.0 ? -size : size;
  out.vx = in->vx + out.friction_impulse / m;
  out.omega = in->omega - out.friction_impulse / (m * in->beta * r);
  /* The slip falls from |u| to the rest evenly with the impulse: the mean of both counts. */
  const double left = out.grips ? 0.0 : fabs(u) * (1.0 - most / stick);
  out.friction_loss = 0.5 * size * (fabs(u) + left);
  return out;
}

double rot_impact_hinge_share(double inertia, double mass, double centre, double distance) {
  return mass * centre * distance / inertia - 1.0;
}

rot_hinged rot_impact_hinged(const rot_hinged_input *in) {
  const double d = in->distance, closing = in->particle_v - in->omega * d;
  rot_hinged out = {0.0, in->omega, in->particle_v, 0.0, 0.0};
  if (!(closing > 0.0)) return out;
  const double e = in->restitution, inverse = 1.0 / in->particle_mass + d * d / in->inertia;
  out.impulse = (1.0 + e) * closing / inverse;
  out.omega = in->omega + out.impulse * d / in->inertia;
  out.particle_v = in->particle_v - out.impulse / in->particle_mass;
  out.hinge_impulse = out.impulse * rot_impact_hinge_share(in->inertia, in->mass, in->centre, d);
  out.loss = 0.5 * (1.0 - e) * (1.0 + e) * closing * closing / inverse;
  return out;
}
