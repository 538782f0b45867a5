#include "engine/ode/stiff.h"

#include <math.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

void rot_ode_stiffness_begin(rot_ode_stiffness *s) {
  s->t = NAN;
  s->rate = 0.0;
  s->stiff = s->calm = 0;
}

void rot_ode_stiffness_note(rot_ode_stiffness *s, double t, const double y[], const double f[]) {
  const rot_ode_params *p = s->p;
  if (t == s->t) {
    double apart = 0.0, rise = 0.0;
    for (size_t i = 0; i < p->controlled; i++) {
      s->y[i] -= y[i];
      s->f[i] -= f[i];
    }
    for (size_t m = 0; m < rot_ode_steering(p); m++) {
      const rot_ode_group g = rot_ode_group_of(p, m);
      const double size = fmax(ROT_ODE_LEAST_SIZE, fmax(s->largest[m], rot_ode_size(g, y)));
      apart = fmax(apart, rot_ode_rate(g, s->y) / size);
      rise = fmax(rise, rot_ode_rate(g, s->f) / size);
    }
    /* Differences at rounding level say nothing about stiffness. */
    s->rate = apart > 64.0 * ROT_EPS ? rise / apart : 0.0;
  }
  s->t = t;
  memcpy(s->y, y, p->controlled * sizeof *y);
  memcpy(s->f, f, p->controlled * sizeof *f);
}

/* A stiff problem costs an explicit method steps that its error test would not need. */
int rot_ode_is_stiff(rot_ode_stiffness *s, double h, double left) {
  if (fabs(h) * s->rate > 4.0) {
    s->stiff++;
    s->calm = 0;
  } else if (++s->calm >= 6) {
    s->stiff = 0;
  }
  return s->stiff >= 15 && fabs(left) > 50.0 * fabs(h);
}
