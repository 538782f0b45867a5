#include "scene/shaft/coupled.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/expm.h"
#include "ground/real.h"
#include "scene/shaft/decoupled.h"

size_t rot_shaft_coupled_room(size_t n) {
  const size_t size = 2 * n + 1;
  return 2 * size * size + ROT_EXPM_WORK(size);
}

static double system_start(const rot_shaft_modes *s, size_t place, double unit, double scale) {
  const size_t n = s->n;
  if (place == 2 * n) return unit;
  if (place == n) return s->r0[0] * s->root_inertia;
  if (place > n) return s->r0[place - n];
  return place <= s->floppy ? s->p0[place] * scale : s->p0[place];
}

static double system_force(const rot_shaft_modes *s, size_t m) {
  return m == 0 ? s->alpha * s->root_inertia : s->force[m];
}

rot_shaft_stepper rot_shaft_stepper_in(size_t n, double memory[]) {
  const size_t size = 2 * n + 1, square = size * size;
  return (rot_shaft_stepper){size, 0.0, 0.0, 0.0, memory, memory + square, memory + 2 * square};
}

/* Fills A h, with the torque scaled to the unit. */
static void fill_step(const rot_shaft_modes *s, rot_shaft_stepper *y, double h) {
  const size_t n = s->n, size = y->size;
  double max = 0.0;
  int exponent = 0;
  memset(y->a, 0, size * size * sizeof *y->a);
  for (size_t m = 0; m < n; m++) max = fmax(max, fabs(system_force(s, m) * h));
  frexp(max, &exponent);
  y->step = h;
  y->scale = 1.0 / fabs(h);
  y->unit = max > 0.0 && isfinite(max) ? ldexp(1.0, exponent) : 1.0;
  for (size_t m = 0; m < n; m++) {
    double *position = y->a + m * size, *velocity = y->a + (n + m) * size;
    position[n + m] = m <= s->floppy ? (h < 0.0 ? -1.0 : 1.0) : s->sigma[m] * h;
    if (m > s->floppy) velocity[m] = -s->sigma[m] * h;
    for (size_t b = 0; b < n; b++) velocity[n + b] = -s->coupling[m * n + b] * h;
    velocity[2 * n] = system_force(s, m) * h / y->unit;
  }
}

rot_status rot_shaft_set_step(const rot_shaft_modes *s, rot_shaft_stepper *y, double h) {
  fill_step(s, y, h);
  return rot_expm(y->size, y->a, y->e, y->work, s->hooks);
}

void rot_shaft_coupled_read(const rot_shaft_modes *s, const rot_shaft_stepper *y,
                            const double state[], double p[], double r[]) {
  for (size_t m = 0; m < s->n; m++) {
    p[m] = m <= s->floppy ? state[m] / y->scale : state[m];
    r[m] = state[s->n + m];
  }
  p[0] /= s->root_inertia;
  r[0] /= s->root_inertia;
}

/* ---- from the start -------------------------------------------------------------------------- */

/* By how much of itself an input is moved: far from rounding, and still linear. */
#define SHIFT 0x1p-30

rot_status rot_shaft_coupled_begin(rot_shaft_coupled *x, const rot_shaft_modes *s, int rated) {
  const size_t n = s->n, size = 2 * n + 1;
  memset(x, 0, sizeof *x);
  x->s = s;
  x->rated = rated;
  x->memory = calloc(5 * size, sizeof *x->memory);
  if (!x->memory) return ROT_ENOMEM;
  x->now = (rot_dd *)x->memory;
  x->moved = x->now + size;
  x->error = x->memory + 4 * size;
  double force = 0.0;
  int exponent = 0;
  x->rate = s->norm;
  for (size_t m = 0; m < n; m++) {
    x->rate = fmax(x->rate, fabs(s->coupling[m]));
    force = fmax(force, fabs(system_force(s, m)));
  }
  if (!(x->rate > 0.0)) x->rate = 1.0;
  (void)frexp(force / x->rate, &exponent);
  x->unit = force > 0.0 && isfinite(force / x->rate) ? ldexp(1.0, exponent) : 1.0;
  for (int k = 0; rated && k < ROT_SHAFT_SHIFTS; k++) {
    const rot_status status = rot_shaft_modes_shift(s, SHIFT, k, &x->shifted[k]);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

void rot_shaft_coupled_end(rot_shaft_coupled *x) {
  for (int k = 0; k <= ROT_SHAFT_SHIFTS; k++) {
    if (k < ROT_SHAFT_SHIFTS) rot_shaft_modes_free(&x->shifted[k]);
    for (int back = 0; back < 2; back++) rot_propagator_end(&x->propagator[back][k]);
  }
  free(x->memory);
}

/* Propagator of the modes s, made when first needed. */
static rot_status make_propagator(const rot_shaft_coupled *x, const rot_shaft_modes *s, int back,
                                  rot_propagator *out) {
  const size_t n = s->n, size = 2 * n + 1;
  const double sign = back ? -1.0 : 1.0;
  if (out->n) return ROT_OK;
  rot_dd *a = calloc(size * size, sizeof *a);
  if (!a) return ROT_ENOMEM;
  for (size_t m = 0; m < n; m++) {
    rot_dd *position = a + m * size, *velocity = a + (n + m) * size;
    position[n + m].hi = sign * x->rate;
    if (m > s->floppy) {
      const rot_dd sigma = {s->sigma[m], isfinite(s->sigma_lo[m]) ? s->sigma_lo[m] : 0.0};
      position[n + m] = rot_dd_mul1(sigma, sign);
      velocity[m] = rot_dd_neg(position[n + m]);
    }
    for (size_t b = 0; b < n; b++) {
      const rot_dd c = {s->coupling[m * n + b], s->coupling_lo[m * n + b]};
      velocity[n + b] = rot_dd_mul1(c, -sign);
    }
    velocity[2 * n].hi = sign * system_force(s, m) / x->unit;
  }
  const rot_status status = rot_propagator_begin(out, size, a, s->hooks);
  free(a);
  return status;
}

/* (modes, t) => state by propagator k */
static rot_status move(rot_shaft_coupled *x, const rot_shaft_modes *s, int k, rot_dd t,
                       rot_dd state[]) {
  const int back = t.hi < 0.0;
  rot_propagator *p = &x->propagator[back][k];
  const rot_status status = make_propagator(x, s, back, p);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < 2 * s->n + 1; i++) {
    state[i] = (rot_dd){system_start(s, i, x->unit, x->rate), 0.0};
  }
  return rot_propagator_move(p, rot_dd_abs(t), state);
}

/* Errors of the modes at t: the distance from the motions of moved inputs, as far as rounding moves
 * them. Of a twist it is an amplitude, which no phase hides; overdamped, either of angle and rate
 * moves the other by sigma/damping alone. */
static rot_status find_errors(rot_shaft_coupled *x, rot_dd t, double error[]) {
  const rot_shaft_modes *s = x->s;
  const size_t n = s->n;
  const double unit = ROT_EPS * rot_shaft_roundings(s) / SHIFT, T = fabs(t.hi);
  const rot_dd *now = x->now, *moved = x->moved;
  for (size_t m = 0; m < n; m++) {
    const double then = m > s->floppy ? hypot(s->p0[m], s->r0[m]) : 0.0;
    const double size = m > s->floppy ? hypot(now[m].hi, now[n + m].hi) : 0.0;
    const double phase = s->sigma_off[m] * s->sigma[m] * T * (size + then);
    error[m] = 2.0 * ROT_EPS * fabs(now[n + m].hi) + phase;
    error[n + m] = 2.0 * ROT_EPS * fabs(now[m].hi) + phase;
  }
  for (int k = 0; k < ROT_SHAFT_SHIFTS; k++) {
    const rot_status status = move(x, &x->shifted[k], k + 1, t, x->moved);
    if (status != ROT_OK) return status;
    for (size_t m = 0; m < n; m++) {
      const double dp = fabs(rot_dd_sub(moved[m], now[m]).hi);
      const double dr = fabs(rot_dd_sub(moved[n + m], now[n + m]).hi);
      const double drift = T > 0.0 ? dp / (x->rate * T) : 0.0;
      const double damp = s->coupling[m * n + m];
      const double part = damp > s->sigma[m] ? s->sigma[m] / damp : 1.0;
      error[m] = hypot(error[m], unit * (m > s->floppy ? hypot(dr, part * dp) : fmax(dr, drift)));
      error[n + m] = hypot(error[n + m], unit * hypot(dp, part * dr));
    }
  }
  error[0] /= s->root_inertia;
  return ROT_OK;
}

rot_status rot_shaft_coupled_at(rot_shaft_coupled *x, rot_dd t, double p[], double r[],
                                double error[]) {
  const rot_shaft_modes *s = x->s;
  const size_t n = s->n;
  if (t.hi == 0.0) {
    for (size_t m = 0; m < n; m++) {
      p[m] = s->p0[m];
      r[m] = s->r0[m];
      error[m] = error[n + m] = ROT_EPS * rot_shaft_roundings(s) * s->leak[m];
    }
    return ROT_OK;
  }
  rot_status status = move(x, s, 0, t, x->now);
  /* They grow by no more than in proportion to the time, forwards. */
  const int near = x->errors_s > 0.0 && t.hi >= x->errors_s && t.hi < 1.0625 * x->errors_s;
  if (status == ROT_OK && x->rated && !near) status = find_errors(x, t, x->error);
  if (status != ROT_OK) return status;
  if (!near) x->errors_s = t.hi;
  for (size_t m = 0; m < 2 * n; m++) error[m] = 1.0625 * x->error[m];
  for (size_t m = 0; m < n; m++) {
    const double scale = m <= s->floppy ? x->rate : 1.0, weight = m ? 1.0 : s->root_inertia;
    p[m] = x->now[m].hi / scale / weight;
    r[m] = x->now[n + m].hi / weight;
  }
  if (s->mean_alone) error[0] = ROT_EPS * rot_shaft_roundings(s) * rot_shaft_mode_error(s, 0, t.hi);
  return ROT_OK;
}

/* The exponential is rounded from twice the precision, column by column. */
rot_status rot_shaft_coupled_step(rot_shaft_coupled *x, double h, rot_shaft_stepper *y) {
  const size_t n = x->s->n, size = y->size, floppy = x->s->floppy;
  const double angle = 1.0 / (fabs(h) * x->rate);
  rot_status status = ROT_OK;
  fill_step(x->s, y, h);
  for (size_t j = 0; j < size && status == ROT_OK; j++) {
    rot_propagator *p = &x->propagator[h < 0.0][0];
    for (size_t i = 0; i < size; i++) x->moved[i] = (rot_dd){i == j ? 1.0 : 0.0, 0.0};
    status = make_propagator(x, x->s, h < 0.0, p);
    if (status == ROT_OK) status = rot_propagator_move(p, (rot_dd){fabs(h), 0.0}, x->moved);
    const double from = j <= floppy ? angle : j == 2 * n ? y->unit / x->unit : 1.0;
    for (size_t i = 0; i < size; i++) {
      const double to = i <= floppy ? angle : i == 2 * n ? y->unit / x->unit : 1.0;
      y->e[i * size + j] = x->moved[i].hi * to / from;
    }
  }
  return status;
}

/* The exponential and the state are rounded, each entry to its own digits: of a twist as an
 * amplitude. */
void rot_shaft_step_errors(const rot_shaft_coupled *x, const rot_shaft_stepper *y,
                           const double state[], double error[]) {
  const rot_shaft_modes *s = x->s;
  const size_t n = s->n, size = y->size;
  for (size_t m = s->mean_alone ? 1 : 0; m < n; m++) {
    double angle = 0.0, rate = 0.0;
    for (size_t j = 0; j < size; j++) {
      angle += fabs(y->e[m * size + j] * state[j]);
      rate += fabs(y->e[(n + m) * size + j] * state[j]);
    }
    const double part = ROT_EPS * 2.0 * (double)n * (m ? 1.0 : 1.0 / s->root_inertia);
    if (m > s->floppy) rate = angle = hypot(angle, rate);
    error[m] += part * rate;
    error[n + m] += part * angle;
  }
}
