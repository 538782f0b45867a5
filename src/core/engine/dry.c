#include "engine/dry.h"

#include <float.h>
#include <math.h>

#include "ground/ieee.h"

rot_dry rot_dry_from(rot_dd along, rot_dd presses, double mu_static, double mu_kinetic) {
  rot_dry d = {.mu_static = mu_static, .mu_kinetic = mu_kinetic, .presses = presses.hi};
  d.loose = nextafter(mu_static, INFINITY);
  for (int up = 0; up < 2; up++) {
    const double sign = (presses.hi < 0.0) == up ? -1.0 : 1.0;
    d.slides[up] = rot_dd_add(along, rot_dd_mul1(presses, -sign * mu_kinetic)).hi;
    d.breaks[up] = rot_dd_add(along, rot_dd_mul1(presses, -sign * mu_static)).hi;
  }
  return d;
}

rot_dry_forces rot_dry_now(const rot_dry *d, double along, double more_along, double in_plane,
                           double more, double across) {
  const double normal = hypot(in_plane, across);
  const double by = 1.0 / fmax(normal + fabs(d->presses), DBL_MIN);
  return (rot_dry_forces){along, normal, more_along,
                          more * ((in_plane + d->presses) * by) + across * (across * by)};
}

/* The sum of what acts: a bead at 1e-13 rad/s was off by 3e-4 of itself, 10 times its figure. */
double rot_dry_left(const rot_dry *d, const rot_dry_forces *f, int sign) {
  const double mu = d->mu_kinetic * sign;
  if (mu == 0.0) return f->along;
  return d->slides[sign > 0] + (f->more_along - mu * f->more_normal);
}

/* Within the rounding of mu_static the quotient would break loose where the forces, which know
 * better, push back. */
double rot_dry_drive(const rot_dry *d, const rot_dry_forces *f) {
  const int up = f->along > 0.0;
  const double sign = up ? 1.0 : -1.0;
  const double beyond =
      sign * (d->breaks[up] + (f->more_along - sign * d->mu_static * f->more_normal));
  const double drive = fabs(f->along) / fmax(f->normal, DBL_MIN);
  return sign * (beyond > 0.0 ? fmax(drive, d->loose) : fmin(drive, d->mu_static));
}
