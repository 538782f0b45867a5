/* Sizes of the measures of a state: groups of components, then integrals along the way. */
#ifndef ROT_ODE_NORM_H
#define ROT_ODE_NORM_H

#include <math.h>

#include "engine/ode/params.h"

/* Below, doubles have no 16 digits left that an error test could ask for. */
#define ROT_ODE_MIN_SIZE 1e-290

/* How many measures steer the step. */
static inline size_t rot_ode_steering(const rot_ode_params *p) {
  return p->n_groups ? p->n_groups : p->controlled;
}

static inline rot_ode_group rot_ode_group_of(const rot_ode_params *p, size_t measure) {
  if (measure < p->n_groups) return p->groups[measure];
  const rot_ode_group one = {measure + (p->n_groups ? p->controlled - p->n_groups : 0), 1,
                             ROT_ODE_SCALAR};
  return one;
}

static inline double rot_ode_length(const double x[], size_t n) {
  double max = 0.0, sum = 0.0;
  if (n == 1) return fabs(x[0]);
  for (size_t i = 0; i < n; i++) max = fmax(max, fabs(x[i]));
  if (!(max > 0.0 && isfinite(max))) return max;
  for (size_t i = 0; i < n; i++) sum += (x[i] / max) * (x[i] / max);
  return max * sqrt(sum);
}

/* Of a state. */
static inline double rot_ode_size(rot_ode_group g, const double y[]) {
  return g.norm == ROT_ODE_QUATERNION ? 1.0 : rot_ode_length(y + g.first, g.count);
}

/* Of what rounds component i. A rotation near 1 has a vector part as small as its angle, rounded by
 * that: a body that swings by 1e-12 rad has 4 digits of its attitude, but all of its rotation. */
static inline double rot_ode_rounds(rot_ode_group g, const double y[], size_t i) {
  if (g.norm != ROT_ODE_QUATERNION) return rot_ode_size(g, y);
  return i == g.first ? 1.0 : rot_ode_length(y + g.first + 1, g.count - 1);
}

/* Of a slope, or of a small change. */
static inline double rot_ode_rate(rot_ode_group g, const double f[]) {
  return (g.norm == ROT_ODE_QUATERNION ? 2.0 : 1.0) * rot_ode_length(f + g.first, g.count);
}

/* Between y and y + change. The vector part of conj(y) (y + change) is that of conj(y) change, so
 * nothing cancels, and the sign of either does not matter. */
static inline double rot_ode_difference(rot_ode_group g, const double y[], const double change[]) {
  if (g.norm != ROT_ODE_QUATERNION) return rot_ode_length(change + g.first, g.count);
  const double *q = y + g.first, *d = change + g.first;
  const double v[3] = {q[0] * d[1] - q[1] * d[0] - (q[2] * d[3] - q[3] * d[2]),
                       q[0] * d[2] - q[2] * d[0] - (q[3] * d[1] - q[1] * d[3]),
                       q[0] * d[3] - q[3] * d[0] - (q[1] * d[2] - q[2] * d[1])};
  const double sine =
      rot_ode_length(v, 3) / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return 2.0 * asin(sine < 1.0 ? sine : sine >= 1.0 ? 1.0 : NAN);
}

#endif
