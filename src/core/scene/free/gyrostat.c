#include "scene/free/gyrostat.h"

#include <math.h>
#include <string.h>

#include "ground/real.h"
#include "maths/attitude.h"
#include "ground/dd_trig.h"
#include "scene/free/gyrostat_motion.h"
#include "scene/free/rotors.h"
#include "engine/stepping.h"

static const rot_dd none = {0.0, 0.0};
static const double pi = 0x1.921fb54442d18p+1;

typedef struct gyrostat {
  rot_free_rotors rotors;
  const rot_free_params *p;
  double q0[4];                /* attitude of the principal axes at the start */
  double axis[3];              /* a */
  int exponent;                /* unit of the rates: 2^exponent rad/s */
  rot_dd turn, spin;           /* |L|/A, c */
  double turn_size, spin_size; /* sums of their |terms| */
  double direction[3];         /* of L at the start */
  double along;                /* omega_a at the start */
  double across[3], ahead[3];  /* omega - omega_a a at the start; a x it */
  double size;                 /* |across| */
  double given, direction_error;
  int general;                /* 1: the moments across a differ */
  int order[3];               /* general: axes of the motion */
  rot_gyrostat_motion motion; /* general: in axes order[0], order[1], order[2] */
  const double *time_s;
  const rot_free_columns *out;
  rot_info *info;
} gyrostat;

/* off[k]: components across axis k of the momenta of rotors, summed; 0 within the rounding of
 * inexact axes; Inf: a rotor that is not driven is not along axis k. */
static void off_axes(const rot_free_rotors *r, double given, double off[3]) {
  for (int i = 0; i < 3; i++) off[i] = 0.0;
  for (size_t k = 0; k < r->n; k++) {
    const rot_free_rotor *rotor = &r->p->rotors[k];
    const double spin = fabs(rotor->moment_kg_m2 * rotor->omega_rad_per_s);
    for (int i = 0; i < 3; i++) {
      const double side = fmax(fabs(r->axis[k][(i + 1) % 3]), fabs(r->axis[k][(i + 2) % 3]));
      if (side > 8.0 * given) off[i] += rotor->driven ? spin * side : INFINITY;
    }
  }
}

/* Axis k along all momenta of rotors, with equal moments across it; 3: a ball, any axis. */
static int axis_of(const rot_free_rotors *r, double given) {
  const double *m = r->p->moment_kg_m2;
  double off[3];
  int found = -1, ball = r->n_states == 0;
  off_axes(r, given, off);
  for (int i = 0; i < 3; i++) {
    const double a = m[(i + 1) % 3], b = m[(i + 2) % 3];
    const int even = fabs(a - b) <= 8.0 * given * fmax(a, b);
    if (even && off[i] == 0.0) found = i;
    ball &= even;
  }
  return found < 0 && ball ? 3 : found;
}

static double given_of(const rot_free_params *p) {
  return p->turned ? fmax(p->given, 4.0 * ROT_EPS) : p->given;
}

/* Set-up with exact, unequal moments and rotors along a principal axis. */
static rot_status begin_general(const rot_free_params *p, const rot_free_rotors *r, int scale,
                                gyrostat *g) {
  double off[3], omega[3];
  rot_dd moment[3], h = none;
  if (given_of(p) != 0.0) return ROT_EVALUE;
  off_axes(r, 0.0, off);
  const int axis = off[2] == 0.0 ? 2 : off[1] == 0.0 ? 1 : off[0] == 0.0 ? 0 : -1;
  if (axis < 0) return ROT_EVALUE;
  for (int i = 0; i < 3; i++) {
    g->order[i] = (axis + 1 + i) % 3;
    moment[i] = (rot_dd){ldexp(p->moment_kg_m2[g->order[i]], -scale), 0.0};
    omega[i] = ldexp(r->omega0[g->order[i]], -g->exponent);
  }
  for (size_t k = 0; k < r->n; k++) {
    const double own = ldexp(p->rotors[k].moment_kg_m2, -scale), a = r->axis[k][axis];
    const double speed = ldexp(p->rotors[k].omega_rad_per_s, -g->exponent);
    h = rot_dd_add(h, rot_dd_mul1(rot_dd_mul2(own, speed), a));
    if (p->rotors[k].driven) continue;
    moment[2] = rot_dd_add1(moment[2], -own);
    h = rot_dd_add(h, rot_dd_mul2(own, omega[2]));
  }
  g->general = 1;
  return rot_gyrostat_begin(moment, omega, h, &g->motion);
}

/* Set-up with equal moments; scaled: moments by a power of two, |rates| about 1 at most. */
static void begin_scaled(gyrostat *g, int axis, const double m[3], const double w[3],
                         const double spin[], const double speed[]) {
  const rot_free_params *p = g->p;
  rot_dd l[3], h[3] = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}, sum = none;
  double sizes = 0.0, min = 0.0;
  for (int i = 0; i < 3; i++) l[i] = rot_dd_mul2(m[i], w[i]);
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_dd one = rot_dd_mul2(spin[k], speed[k]);
    for (int i = 0; i < 3; i++) {
      const double a = axis < 3 && i != axis ? 0.0 : g->rotors.axis[k][i];
      h[i] = rot_dd_add(h[i], rot_dd_mul1(one, a));
    }
    sizes += fabs(one.hi);
  }
  const double a = axis < 3 ? m[(axis + 1) % 3] : m[0];
  for (int i = 0; i < 3; i++) {
    l[i] = rot_dd_add(l[i], h[i]);
    sum = rot_dd_add(sum, rot_dd_mul(l[i], l[i]));
    min += m[i] * fabs(w[i]);
  }
  const rot_dd momentum = rot_dd_sqrt(sum), by = {a, 0.0};
  g->turn = rot_dd_div(momentum, by);
  g->turn_size = (sizes + min) / a;
  for (int i = 0; i < 3; i++) g->direction[i] = momentum.hi > 0.0 ? l[i].hi / momentum.hi : 0.0;
  g->direction_error =
      momentum.hi > 0.0 ? fmin(16.0 * ROT_DD_EPS * (sizes + min) / momentum.hi, pi) : 0.0;
  if (axis < 3) {
    g->axis[axis] = 1.0;
    g->spin = rot_dd_sub(rot_dd_div(l[axis], by), (rot_dd){w[axis], 0.0});
    g->spin_size = (m[axis] * fabs(w[axis]) + sizes) / a + fabs(w[axis]);
  } else {
    rot_dd square = none;
    for (int i = 0; i < 3; i++) square = rot_dd_add(square, rot_dd_mul(h[i], h[i]));
    const rot_dd all = rot_dd_sqrt(square);
    for (int i = 0; i < 3; i++) g->axis[i] = all.hi > 0.0 ? h[i].hi / all.hi : i == 2;
    g->spin = rot_dd_div(all, by);
    g->spin_size = sizes / a;
    if (all.hi > 0.0) g->direction_error += fmin(16.0 * ROT_DD_EPS * sizes / all.hi, pi);
  }
}

/* parameters => scaled motion of the kind that applies. */
static rot_status begin(const rot_free_params *p, gyrostat *g) {
  double w[3], m[3], spin[ROT_FREE_MAX_ROTORS], speed[ROT_FREE_MAX_ROTORS], max = 0.0;
  int scale;
  memset(g, 0, sizeof *g);
  g->p = p;
  g->given = given_of(p);
  if (!p->n_rotors || rot_free_rotors_begin(p, &g->rotors)) return ROT_EVALUE;
  const int axis = axis_of(&g->rotors, g->given);
  rot_free_principal(p, w, g->q0);
  (void)frexp(fmax(p->moment_kg_m2[0], fmax(p->moment_kg_m2[1], p->moment_kg_m2[2])), &scale);
  for (int i = 0; i < 3; i++) {
    m[i] = ldexp(p->moment_kg_m2[i], -scale);
    max = fmax(max, fabs(w[i]));
  }
  for (size_t k = 0; k < p->n_rotors; k++) {
    spin[k] = ldexp(p->rotors[k].moment_kg_m2, -scale);
    max = fmax(max, spin[k] * fabs(p->rotors[k].omega_rad_per_s));
  }
  (void)frexp(max, &g->exponent);
  for (size_t k = 0; k < p->n_rotors; k++) {
    speed[k] = ldexp(p->rotors[k].omega_rad_per_s, -g->exponent);
  }
  if (axis < 0) return begin_general(p, &g->rotors, scale, g);
  double scaled[3];
  for (int i = 0; i < 3; i++) scaled[i] = ldexp(w[i], -g->exponent);
  begin_scaled(g, axis, m, scaled, spin, speed);
  for (int i = 0; i < 3; i++) g->along += g->axis[i] * w[i];
  for (int i = 0; i < 3; i++) g->across[i] = axis == i ? 0.0 : w[i] - g->along * g->axis[i];
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    g->ahead[i] = g->axis[j] * g->across[k] - g->axis[k] * g->across[j];
  }
  g->size = rot_length(g->across);
  return ROT_OK;
}

const char *rot_free_not_gyrostat(const rot_free_params *p) {
  rot_free_rotors r;
  gyrostat g;
  if (!p->n_rotors) return "it carries no rotor";
  const char *why = rot_free_rotors_begin(p, &r);
  if (why) return why;
  switch (begin(p, &g)) {
  case ROT_OK: return NULL;
  case ROT_ERANGE: return "too near a separatrix, or both ends of the axis are passed";
  default: return "the rotors are not along a principal axis";
  }
}

/* (rate, t) => angle, cosine and sine of its half. */
static double half_of(rot_dd rate, rot_dd t, double *c, double *s) {
  const double angle = rot_dd_less_double_turns(rot_dd_mul(rate, t)).hi;
  *c = cos(0.5 * angle);
  *s = sin(0.5 * angle);
  return angle;
}

/* Angle error due to moments and axes: they change both rates, and omega_a in phase with c t. */
static double by_given(const gyrostat *g, double t) {
  if (g->given == 0.0) return 0.0;
  const double rate = g->turn_size + g->spin_size, turned = rate * fabs(t);
  const double swing = fmin(turned, rate / fmax(fabs(g->spin.hi), 1e-300 * rate));
  return 8.0 * g->given * turned * (1.0 + swing);
}

/* t => row i, unequal moments. */
static rot_status write_general(const gyrostat *g, rot_dd t, size_t i) {
  double turn[4], own[4], rate[3], w[3], q[4], angle_error, omega_error;
  if (!(fabs(t.hi) * g->motion.size < 1e250)) return ROT_ERANGE;
  rot_gyrostat_at(&g->motion, t, turn, rate, &angle_error, &omega_error);
  own[0] = turn[0];
  for (int k = 0; k < 3; k++) {
    own[1 + g->order[k]] = turn[1 + k];
    w[g->order[k]] = ldexp(rate[k], g->exponent);
  }
  rot_attitude_times(g->q0, own, q);
  (void)rot_attitude_unit(q);
  rot_free_rotors_note(&g->rotors, w, angle_error + 8.0 * ROT_EPS, ldexp(omega_error, g->exponent),
                       g->info);
  const rot_status status = rot_free_write(g->p, w, q, i, g->out);
  if (status != ROT_OK) return status;
  return rot_free_rotors_write(&g->rotors, w, q, g->rotors.start, i, g->out);
}

/* (motion, i) => row i, its errors. */
static rot_status write_row(void *model, size_t i) {
  const gyrostat *g = model;
  const rot_dd t = rot_dd_ldexp(rot_dd_sum2(g->time_s[i], -g->p->start_s), g->exponent);
  const double rate = g->turn_size + g->spin_size;
  double q[4], w[3], c, s, d, e;
  if (g->general) return write_general(g, t, i);
  if (!(fabs(t.hi) * rate < 1e250)) return ROT_ERANGE;
  (void)half_of(g->turn, t, &c, &s);
  const double angle = half_of(g->spin, t, &d, &e);
  const double turn[4] = {c, s * g->direction[0], s * g->direction[1], s * g->direction[2]};
  const double spin[4] = {d, -e * g->axis[0], -e * g->axis[1], -e * g->axis[2]};
  rot_attitude_times(g->q0, turn, q);
  rot_attitude_times(q, spin, q);
  (void)rot_attitude_unit(q);
  c = cos(angle);
  s = sin(angle);
  for (int k = 0; k < 3; k++) w[k] = g->along * g->axis[k] + g->across[k] * c + g->ahead[k] * s;
  const double given = by_given(g, t.hi), phase = 16.0 * ROT_DD_EPS * fabs(t.hi);
  const double angle_error =
      fmin(32.0 * ROT_EPS + phase * rate + 2.0 * g->direction_error + given, pi);
  const double omega_error = 12.0 * ROT_EPS * (g->size + fabs(g->along)) +
                             fmin(phase * g->spin_size + g->direction_error, 2.0) * g->size +
                             fmin(given, 2.0) * ldexp(rate, g->exponent);
  rot_free_rotors_note(&g->rotors, w, angle_error, omega_error, g->info);
  const rot_status status = rot_free_write(g->p, w, q, i, g->out);
  if (status != ROT_OK) return status;
  return rot_free_rotors_write(&g->rotors, w, q, g->rotors.start, i, g->out);
}

rot_status rot_free_gyrostat(const rot_free_params *p, size_t n, const double time_s[],
                             const rot_free_columns *out, rot_events *events,
                             const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {NULL, NULL, NULL, write_row, NULL};
  gyrostat g;
  (void)events;
  rot_info_clear(info, rot_free_measures);
  info->status = begin(p, &g);
  if (info->status != ROT_OK) return info->status;
  g.time_s = time_s;
  g.out = out;
  g.info = info;
  rot_free_rotors_note(&g.rotors, g.rotors.omega0, 0.0, 0.0, info);
  return rot_step_rows(&stepping, &g, p->start_s, n, time_s, hooks, info);
}
