#include "scene/shaft/coupled.h"

#include <math.h>
#include <string.h>

#include "maths/expm.h"
#include "ground/real.h"
#include "scene/shaft/decoupled.h"

size_t rot_shaft_coupled_room(size_t n) {
  const size_t size = 2 * n + 1;
  return 2 * size * size + ROT_EXPM_WORK(size);
}

static double system_start(const rot_shaft_modes *s, size_t place, double unit, double step) {
  const size_t n = s->n;
  if (place == 2 * n) return unit;
  if (place == n) return s->r0[0] * s->root_inertia;
  if (place > n) return s->r0[place - n];
  return place <= s->floppy ? s->p0[place] / fabs(step) : s->p0[place];
}

static double system_force(const rot_shaft_modes *s, size_t m) {
  return m == 0 ? s->alpha * s->root_inertia : s->force[m];
}

rot_shaft_stepper rot_shaft_stepper_in(size_t n, double memory[]) {
  const size_t size = 2 * n + 1, square = size * size;
  return (rot_shaft_stepper){size, 0.0, 0.0, memory, memory + square, memory + 2 * square};
}

/* Fills A h, with the torque scaled to the unit, and its exponential. */
rot_status rot_shaft_set_step(const rot_shaft_modes *s, rot_shaft_stepper *y, double h) {
  const size_t n = s->n, size = y->size;
  double max = 0.0;
  int exponent = 0;
  memset(y->a, 0, size * size * sizeof *y->a);
  for (size_t m = 0; m < n; m++) max = fmax(max, fabs(system_force(s, m) * h));
  frexp(max, &exponent);
  y->step = h;
  y->unit = max > 0.0 && isfinite(max) ? ldexp(1.0, exponent) : 1.0;
  for (size_t m = 0; m < n; m++) {
    double *position = y->a + m * size, *velocity = y->a + (n + m) * size;
    position[n + m] = m <= s->floppy ? (h < 0.0 ? -1.0 : 1.0) : s->sigma[m] * h;
    if (m > s->floppy) velocity[m] = -s->sigma[m] * h;
    for (size_t b = 0; b < n; b++) velocity[n + b] = -s->coupling[m * n + b] * h;
    velocity[2 * n] = system_force(s, m) * h / y->unit;
  }
  return rot_expm(size, y->a, y->e, y->work, s->hooks);
}

void rot_shaft_coupled_read(const rot_shaft_modes *s, const rot_shaft_stepper *y,
                            const double state[], double p[], double r[]) {
  for (size_t m = 0; m < s->n; m++) {
    p[m] = state[m] * (m <= s->floppy ? fabs(y->step) : 1.0);
    r[m] = state[s->n + m];
  }
  p[0] /= s->root_inertia;
  r[0] /= s->root_inertia;
}

/* Error of the twists in units of roundoff, after a motion from the start to p, r. */
static double system_error(const rot_shaft_modes *s, double t, const double p[], const double r[]) {
  double start = 0.0, now = 0.0, force = 0.0, leak = 0.0;
  for (size_t m = s->mean_alone ? 1 : 0; m < s->n; m++) {
    const double weight = m == 0 ? s->root_inertia : 1.0;
    const int twist = m > s->floppy;
    start = hypot(start, hypot(twist ? s->p0[m] : 0.0, weight * s->r0[m]));
    now = hypot(now, hypot(twist ? p[m] : 0.0, weight * r[m]));
    force = hypot(force, system_force(s, m));
    leak =
        hypot(leak, s->leak[m] + s->force_leak[m] *
                                     (m > s->floppy ? fmin(fabs(t), 2.0 / s->sigma[m]) : fabs(t)));
  }
  const double phase = s->norm * fabs(t), propagation = t < 0.0 ? 1.0 + phase : 1.0;
  return propagation * leak +
         (2.0 * (double)s->n + phase) *
             (propagation * fmax(start, now) + force * (phase > 1.0 ? 1.0 / s->norm : fabs(t)));
}

/* Applies exp(A t) to the start. */
rot_status rot_shaft_jump(const rot_shaft_modes *s, rot_shaft_stepper *y, rot_dd time,
                          double state[], double p[], double r[]) {
  double *start = y->work; /* unused after the exponential */
  const double t = time.hi;
  if (t == 0.0) {
    y->step = 1.0;
    for (size_t i = 0; i < y->size; i++) state[i] = system_start(s, i, 1.0, 1.0);
  } else {
    const rot_status status = rot_shaft_set_step(s, y, t);
    if (status != ROT_OK) return status;
    for (size_t i = 0; i < y->size; i++) start[i] = system_start(s, i, y->unit, t);
    rot_expm_apply(y->size, y->e, start, state);
    if (time.lo != 0.0) { /* low part of the time, to first order */
      rot_expm_apply(y->size, y->a, state, start);
      for (size_t i = 0; i < y->size; i++) state[i] += time.lo / t * start[i];
    }
  }
  rot_shaft_coupled_read(s, y, state, p, r);
  return ROT_OK;
}

void rot_shaft_coupled_errors(const rot_shaft_modes *s, double t, double extra, const double p[],
                              const double r[], double error[]) {
  const double all = ROT_EPS * 4.0 * system_error(s, t, p, r) * (1.0 + extra);
  for (size_t m = 1; m < s->n; m++) error[m] = all;
  error[0] = s->mean_alone ? ROT_EPS * rot_shaft_roundings(s) * rot_shaft_mode_error(s, 0, t)
                           : all / s->root_inertia;
}
