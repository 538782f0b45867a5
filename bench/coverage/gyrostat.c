/* Does the reported error of a free body with rotors cover the true one? Gyrostats in closed form:
 * the bound must cover each error. Bodies with motors, integrated: the figure must be within a
 * factor 2 of the truth in 95 of 100 scenes, and be exceeded in 5 at most.
 *
 * The truth is computed in quadruple precision, by extrapolated midpoint steps of the equations of
 * the body and of each rotor; of symmetric gyrostats after a long time by their closed form, which
 * is compared with the steps after a short one; of others by a period, found from the steps, and
 * the turn in it.
 *
 *   gyrostat [scenes] [seed] */
#include <math.h>
#include <quadmath.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "attitude.h"
#include "midpoint.h"
#include "random.h"
#include "maths/attitude.h"
#include "scene/free/gyrostat.h"
#include "scene/free/ode.h"

enum {
  KINDS = 14,
  SYMMETRIC = 10,
  WHEEL_KINDS = 8,
  ROWS = 12,
  LEVELS = 10,
  MOST = 4,
  DIM = 7 + MOST
};
static const char *const kind_names[KINDS] = {"driven",
                                              "free of torque",
                                              "several",
                                              "a ball",
                                              "momentum near 0",
                                              "spin near 0",
                                              "strong rotor",
                                              "any scale",
                                              "moments of a measured body",
                                              "flat or thin",
                                              "three moments",
                                              "three, near an axis",
                                              "three, near symmetric",
                                              "three, weak rotor"};
static const char *const wheel_names[WHEEL_KINDS] = {"one wheel",
                                                     "three wheels",
                                                     "knots",
                                                     "driven, no principal axis",
                                                     "torque and damping",
                                                     "functions",
                                                     "free, torque in space",
                                                     "from rest"};

typedef struct scene {
  rot_free_params p;
  rot_free_rotor rotor[MOST];
  quad moment[3], axis[MOST][3]; /* those of the truth */
  double knot_s[4], knot[4];
  double wave[MOST], frequency, drag; /* of the functions */
  double span, rate, accuracy;
} scene;

/* ---- the truth ------------------------------------------------------------------------------- */

/* Gauss: the rates of L = I omega + sum of J W a with J (W + a omega) = s where not driven. */
static void rates_of(const scene *s, const quad y[DIM], quad w[3], quad speed[MOST]) {
  const rot_free_params *p = &s->p;
  quad m[3][4] = {{0}};
  for (int i = 0; i < 3; i++) m[i][i] = s->moment[i], m[i][3] = y[4 + i];
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor *r = &s->rotor[k];
    for (int i = 0; i < 3; i++) {
      if (r->driven) {
        m[i][3] -= (quad)r->moment_kg_m2 * r->omega_rad_per_s * s->axis[k][i];
      } else {
        m[i][3] -= y[7 + k] * s->axis[k][i];
        for (int j = 0; j < 3; j++) m[i][j] -= r->moment_kg_m2 * s->axis[k][i] * s->axis[k][j];
      }
    }
  }
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      if (j == i) continue;
      const quad by = m[j][i] / m[i][i];
      for (int c = 0; c < 4; c++) m[j][c] -= by * m[i][c];
    }
  }
  for (int i = 0; i < 3; i++) w[i] = m[i][3] / m[i][i];
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor *r = &s->rotor[k];
    speed[k] = r->driven ? (quad)r->omega_rad_per_s
                         : y[7 + k] / r->moment_kg_m2 -
                               (s->axis[k][0] * w[0] + s->axis[k][1] * w[1] + s->axis[k][2] * w[2]);
  }
}

typedef struct stretch {
  const scene *s;
  int piece; /* between which knots; -1: none */
} stretch;

static void slopes(const void *system, quad t, const quad y[DIM], quad f[DIM]) {
  const scene *s = ((const stretch *)system)->s;
  const int piece = ((const stretch *)system)->piece;
  const rot_free_params *p = &s->p;
  const quad *l = y + 4, *q = y;
  quad w[3], speed[MOST], own[3], torque[3] = {p->torque[0], p->torque[1], p->torque[2]};
  rates_of(s, y, w, speed);
  if (p->in_space) {
    turn(q, torque, 1, own);
  } else {
    memcpy(own, torque, sizeof own);
  }
  attitude_slopes(q, w, f);
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    f[4 + i] = l[j] * w[k] - l[k] * w[j] + own[i] - p->damping_per_s * l[i];
  }
  for (int k = 0; k < MOST; k++) {
    f[7 + k] = 0;
    if (k >= (int)p->n_rotors || s->rotor[k].driven) continue;
    f[7 + k] = s->rotor[k].torque;
    if (piece >= 0 && s->rotor[k].n_knots) {
      const quad part = (t - s->knot_s[piece]) / ((quad)s->knot_s[piece + 1] - s->knot_s[piece]);
      f[7 + k] += s->knot[piece] + ((quad)s->knot[piece + 1] - s->knot[piece]) * part;
    }
    if (p->motors)
      f[7 + k] += s->wave[k] * sinq(s->frequency * t + k) +
                  s->drag * (s->axis[k][0] * w[0] + s->axis[k][1] * w[1] + s->axis[k][2] * w[2]);
  }
}

static void step(const scene *s, int piece, quad t, quad h, quad y[DIM]) {
  static const midpoint rule = {slopes, DIM, LEVELS, 0.0};
  const stretch now = {s, piece};
  midpoint_step(&rule, &now, t, h, y, NULL, y);
}

/* To a time of either sign, with stops at the knots. */
static void go_to(const scene *s, quad to, quad longest, quad *t, quad y[DIM]) {
  const int back = to < *t;
  while (back ? *t > to : *t < to) {
    quad end = to;
    int piece = -1;
    for (int k = 0; k < 4 && s->p.n_breaks; k++) {
      if (s->knot_s[k] <= *t) piece = k;
      if (s->knot_s[k] > *t && s->knot_s[k] < end) end = s->knot_s[k];
    }
    if (piece == 3) piece = -1;
    const int n = (int)ceilq(fabsq(end - *t) / longest);
    const quad h = (end - *t) / n, from = *t;
    for (int i = 0; i < n; i++) step(s, piece, from + i * h, h, y);
    *t = end;
  }
}

static void begin(const scene *s, quad y[DIM]) {
  const rot_free_params *p = &s->p;
  quad norm = 0;
  memset(y, 0, DIM * sizeof *y);
  for (int i = 0; i < 4; i++) norm += (quad)p->q0[i] * p->q0[i];
  for (int i = 0; i < 4; i++) y[i] = p->q0[i] / sqrtq(norm);
  for (int i = 0; i < 3; i++) y[4 + i] = s->moment[i] * p->omega0_rad_per_s[i];
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor *r = &s->rotor[k];
    quad along = r->omega_rad_per_s;
    for (int i = 0; i < 3; i++) {
      y[4 + i] += (quad)r->moment_kg_m2 * r->omega_rad_per_s * s->axis[k][i];
      along += s->axis[k][i] * p->omega0_rad_per_s[i];
    }
    if (!r->driven) y[7 + k] = r->moment_kg_m2 * along;
  }
}

/* A gyrostat after t: the turn about L by |L| t/A, after that about c by -|c| t. */
static void closed(const scene *s, int axis, quad t, quad y[DIM]) {
  quad c[3], size = 0, momentum = 0, d[4] = {1, 0, 0, 0}, e[4] = {1, 0, 0, 0};
  const quad across = s->moment[axis < 3 ? (axis + 1) % 3 : 0];
  begin(s, y);
  for (int i = 0; i < 3; i++) {
    const quad w = s->p.omega0_rad_per_s[i];
    c[i] = axis == 3 || axis == i ? y[4 + i] / across - w : 0;
    size += c[i] * c[i];
    momentum += y[4 + i] * y[4 + i];
  }
  size = sqrtq(size);
  momentum = sqrtq(momentum);
  const quad a = fmodq(momentum / across * t, 4 * M_PIq), b = fmodq(size * t, 4 * M_PIq);
  d[0] = cosq(a / 2);
  e[0] = cosq(b / 2);
  for (int i = 0; i < 3; i++) {
    if (momentum > 0) d[1 + i] = sinq(a / 2) * y[4 + i] / momentum;
    if (size > 0) e[1 + i] = -sinq(b / 2) * c[i] / size;
  }
  quad l[3];
  turn(e, y + 4, 1, l); /* L in the body: back by the second turn, for the first leaves it */
  memcpy(y + 4, l, sizeof l);
  times(y, d, y);
  times(y, e, y);
}

/* ---- periods --------------------------------------------------------------------------------- */

typedef struct period {
  int found;
  quad length, angle,
      axis[3]; /* after it L in the body is as before, and the body has turned by it */
} period;

static quad ahead(const quad y[DIM], const quad l0[3], const quad way[3]) {
  return (y[4] - l0[0]) * way[0] + (y[5] - l0[1]) * way[1] + (y[6] - l0[2]) * way[2];
}

/* The first return of L to its start, within 400 rad. */
static void find_period(const scene *s, quad longest, period *out) {
  const stretch free_of_knots = {s, -1};
  quad y[DIM], f[DIM], l0[3], t = 0, size = 0, speed = 0;
  memset(out, 0, sizeof *out);
  begin(s, y);
  slopes(&free_of_knots, 0, y, f);
  for (int i = 0; i < 3; i++) {
    l0[i] = y[4 + i];
    size += l0[i] * l0[i];
    speed += f[4 + i] * f[4 + i];
  }
  const quad way[3] = {f[4], f[5], f[6]};
  if (speed < 1e-12Q * size * s->rate * s->rate) return;
  const quad scale = sqrtq(size);
  quad before = 0;
  while (t * s->rate < 400) {
    quad next[DIM], far = 0;
    memcpy(next, y, sizeof next);
    step(s, -1, t, longest, next);
    const quad now = ahead(next, l0, way);
    for (int i = 0; i < 3; i++) far = fmaxq(far, fabsq(next[4 + i] - l0[i]));
    if (before < 0 && now >= 0 && far < 0.5Q * scale) {
      quad h = longest * before / (before - now), z[DIM];
      for (int k = 0; k < 60; k++) { /* Newton's method */
        memcpy(z, y, sizeof z);
        step(s, -1, t, h, z);
        slopes(&free_of_knots, t + h, z, f);
        const quad by = ahead(z, l0, way) / (f[4] * way[0] + f[5] * way[1] + f[6] * way[2]);
        h -= by;
        if (fabsq(by) < 1e-33Q * (t + h)) break;
      }
      far = 0;
      for (int i = 0; i < 3; i++) far = fmaxq(far, fabsq(z[4 + i] - l0[i]));
      if (far < 1e-20Q * scale) {
        quad start[DIM], d[4];
        begin(s, start);
        const quad back[4] = {start[0], -start[1], -start[2], -start[3]};
        times(z, back, d);
        quad sine = sqrtq(d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
        out->found = 1;
        out->length = t + h;
        out->angle = 2 * atan2q(sine, d[0]);
        for (int i = 0; i < 3; i++) out->axis[i] = sine > 0 ? d[1 + i] / sine : 0;
        return;
      }
    }
    before = now;
    memcpy(y, next, sizeof y);
    t += longest;
  }
}

/* After t: by the turn of whole periods, and steps. */
static void by_periods(const scene *s, const period *p, quad t, quad longest, quad y[DIM]) {
  quad at = 0, n = p->found ? floorq(t / p->length) : 0;
  begin(s, y);
  go_to(s, t - n * p->length, longest, &at, y);
  const quad angle = fmodq(n * p->angle, 4 * M_PIq), sine = sinq(angle / 2);
  const quad q[4] = {cosq(angle / 2), sine * p->axis[0], sine * p->axis[1], sine * p->axis[2]};
  times(q, y, y);
}

/* ---- results --------------------------------------------------------------------------------- */

typedef struct table {
  double cell[14][ROWS], speed[MOST][ROWS], momentum[MOST][ROWS];
  double *speeds[MOST], *momenta[MOST];
} table;

static rot_free_columns columns_of(table *x) {
  double(*c)[ROWS] = x->cell;
  for (int k = 0; k < MOST; k++) x->speeds[k] = x->speed[k], x->momenta[k] = x->momentum[k];
  return (rot_free_columns){c[0], c[1], c[2],  c[3],  c[4],  c[5],  c[6],      c[7],
                            c[8], c[9], c[10], c[11], c[12], c[13], x->speeds, x->momenta};
}

/* The larger of these errors and those of row k. */
static void compare(const scene *s, const table *x, int k, const quad y[DIM], double error[3]) {
  const quad got[4] = {x->cell[0][k], x->cell[1][k], x->cell[2][k], x->cell[3][k]};
  quad norm = 0, q[4], l[3], w[3], speed[MOST], off = 0, off_l = 0, off_s = 0;
  for (int c = 0; c < 4; c++) norm += y[c] * y[c];
  for (int c = 0; c < 4; c++) q[c] = y[c] / sqrtq(norm);
  turn(q, y + 4, 0, l);
  rates_of(s, y, w, speed);
  for (int c = 0; c < 3; c++) {
    const quad d = x->cell[4 + c][k] - w[c], dl = x->cell[10 + c][k] - l[c];
    off += d * d;
    off_l += dl * dl;
  }
  for (size_t c = 0; c < s->p.n_rotors; c++) {
    if (s->rotor[c].driven) continue;
    const quad d = x->momentum[c][k] - y[7 + c];
    off_s += d * d;
  }
  error[0] = fmax(error[0], angle_between(q, got));
  error[1] = fmax(error[1], (double)sqrtq(off));
  error[2] = fmax(error[2], (double)sqrtq(fmaxq(off_l, off_s)));
}

static int by_size(const void *x, const void *y) {
  const double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

static void keep_truth(scene *s) {
  for (int i = 0; i < 3; i++) s->moment[i] = s->p.moment_kg_m2[i];
  for (int k = 0; k < MOST; k++) {
    for (int i = 0; i < 3; i++) s->axis[k][i] = s->rotor[k].axis[i];
  }
  s->p.rotors = s->rotor;
}

static void random_start(scene *s) {
  memset(s, 0, sizeof *s);
  for (int i = 0; i < 3; i++) s->p.omega0_rad_per_s[i] = uniform(-2.0, 2.0);
  s->p.axes[0] = 1.0;
  for (int i = 0; i < 4; i++) s->p.q0[i] = uniform(-1.0, 1.0);
  (void)rot_attitude_unit(s->p.q0);
}

static void random_axis(double axis[3]) {
  double size = 0.0;
  for (int i = 0; i < 3; i++) axis[i] = uniform(-1.0, 1.0), size = hypot(size, axis[i]);
  for (int i = 0; i < 3; i++) axis[i] /= size;
}

/* ---- gyrostats ------------------------------------------------------------------------------- */

/* Returns the axis, 3 for a ball, 4 for three moments. */
static int draw_gyrostat(int kind, scene *s) {
  random_start(s);
  rot_free_params *p = &s->p;
  const int axis = (int)uniform(0.0, 3.0), ball = kind == 3;
  const double across = uniform(0.2, 1.0);
  double along = across * uniform(0.1, 1.9);
  if (kind == 9) along = across * (chance(0.5) ? 2.0 : power(-6.0, -1.0));
  for (int i = 0; i < 3; i++) p->moment_kg_m2[i] = i == axis && !ball ? along : across;
  p->n_rotors = kind == 2 || ball ? 3 : 1;
  for (size_t k = 0; k < p->n_rotors; k++) {
    rot_free_rotor *r = &s->rotor[k];
    r->moment_kg_m2 = (ball ? across : along) * uniform(0.01, 0.3);
    r->omega_rad_per_s = uniform(-20.0, 20.0);
    r->driven = kind != 1 && (ball || chance(0.6));
    r->axis[axis] = either(1.0);
    if (ball) random_axis(r->axis);
  }
  rot_free_rotor *r = s->rotor;
  double *w = p->omega0_rad_per_s;
  if (kind >= SYMMETRIC) {
    double m[3] = {uniform(0.3, 1.0), uniform(0.3, 1.0), uniform(0.3, 1.0)};
    if (kind == 12) m[(axis + 1) % 3] = m[(axis + 2) % 3] * (1.0 + either(power(-12.0, -1.0)));
    memcpy(p->moment_kg_m2, m, sizeof m);
    r->moment_kg_m2 = m[axis] * uniform(0.01, 0.3);
    if (kind == 13) r->omega_rad_per_s *= power(-12.0, -1.0);
    if (kind == 11) {
      const int near = (int)uniform(0.0, 3.0);
      const double aside = power(-9.0, -1.0);
      for (int i = 0; i < 3; i++) w[i] *= i == near ? 1.0 : aside;
    }
  }
  if (kind == 4) { /* I omega + J W = 0 along the axis, but for 1e-16 to 1e-3 */
    r->omega_rad_per_s =
        -r->axis[axis] * along * w[axis] / r->moment_kg_m2 * (1.0 + either(power(-16.0, -3.0)));
    w[(axis + 1) % 3] *= power(-16.0, 0.0);
    w[(axis + 2) % 3] *= power(-16.0, 0.0);
  }
  if (kind == 5) { /* L/A = omega along the axis */
    r->omega_rad_per_s = r->axis[axis] * (across - along) * w[axis] / r->moment_kg_m2 *
                         (1.0 + either(power(-16.0, -3.0)));
  }
  if (kind == 6) r->omega_rad_per_s *= power(1.0, 6.0);
  if (kind == 7) {
    const double inertia = power(-140.0, 140.0), speed = power(-60.0, 60.0);
    for (int i = 0; i < 3; i++) {
      p->moment_kg_m2[i] *= inertia;
      w[i] *= speed;
    }
    r->moment_kg_m2 *= inertia;
    r->omega_rad_per_s *= speed;
  }
  keep_truth(s);
  if (kind == 8) {
    p->given = 2e-15;
    for (int i = 0; i < 3; i++) {
      s->moment[i] *= 1 + (quad)uniform(-1.0, 1.0) * 2e-15Q;
      if (i != axis) s->axis[0][i] = uniform(-1.0, 1.0) * 2e-15Q;
    }
  }
  s->rate = 0.0;
  for (int i = 0; i < 3; i++) s->rate += fabs(w[i]);
  for (size_t k = 0; k < p->n_rotors; k++) {
    s->rate += fabs(s->rotor[k].moment_kg_m2 * s->rotor[k].omega_rad_per_s) /
               p->moment_kg_m2[(axis + 1) % 3];
  }
  return kind >= SYMMETRIC ? 4 : ball ? 3 : axis;
}

static long check_gyrostats(int scenes) {
  long missed = 0, rows = 0, refused = 0;
  double doubts = 0.0, worst[KINDS] = {0.0}, said[KINDS] = {0.0}, least[KINDS];
  for (int k = 0; k < KINDS; k++) least[k] = INFINITY;
  for (int i = 0; i < scenes; i++) {
    const int kind = i % KINDS;
    scene s;
    const int axis = draw_gyrostat(kind, &s);
    period full = {0};
    const quad longest = 0.1Q / s.rate;
    if (rot_free_not_gyrostat(&s.p)) {
      refused++;
      if (getenv("COVERAGE_SHOW")) {
        printf("gyrostat: scene %d (%s) refused: %s\n", i, kind_names[kind],
               rot_free_not_gyrostat(&s.p));
      }
      continue;
    }
    if (axis == 4) {
      find_period(&s, longest, &full);
      if (full.found && i % (4 * KINDS) < KINDS) {
        period again;
        find_period(&s, longest / 2, &again);
        doubts = fmax(doubts, (double)(fabsq(again.length - full.length) * s.rate));
      }
    } else if (i % (2 * KINDS) < KINDS) {
      quad y[DIM], z[DIM], t = 0;
      const quad to = 8 / (quad)s.rate;
      begin(&s, y);
      go_to(&s, to, 0.1Q / s.rate, &t, y);
      closed(&s, axis, to, z);
      if (kind != 8) doubts = fmax(doubts, angle_between(y, z));
    }
    for (int row = 0; row < 4; row++) {
      double error[3] = {0.0, 0.0, 0.0};
      double t = either(power(-1.0, 12.0)) / s.rate;
      if (kind == 8 || (axis == 4 && !full.found)) t = either(power(-1.0, 2.5)) / s.rate;
      table x;
      const rot_free_columns out = columns_of(&x);
      rot_info info;
      if (rot_free_gyrostat(&s.p, 1, &t, &out, NULL, NULL, &info) != ROT_OK) {
        printf("gyrostat: scene %d (%s) failed\n", i, kind_names[kind]);
        missed++;
        break;
      }
      quad y[DIM], at = 0;
      if (axis == 4) {
        by_periods(&s, &full, t, longest, y);
      } else if (kind == 8) {
        begin(&s, y);
        go_to(&s, t, longest, &at, y);
      } else {
        closed(&s, axis, t, y);
      }
      compare(&s, &x, 0, y, error);
      rows++;
      worst[kind] = fmax(worst[kind], error[0]);
      said[kind] = fmax(said[kind], info.measure[0].error);
      for (int k = 0; k < 3; k++) {
        const double bound = info.measure[k].error;
        least[kind] = fmin(least[kind], error[k] > 0.0 ? bound / error[k] : INFINITY);
        if (error[k] <= bound) continue;
        missed++;
        printf("gyrostat: scene %d (%s), t %g: %s off %.2e, bound %.2e\n", i, kind_names[kind], t,
               rot_free_measures[k], error[k], bound);
      }
    }
  }
  for (int k = 0; k < KINDS; k++) {
    printf("  %-28s attitude off by %.1e rad, bound %.1e at most; the closest %.2g\n",
           kind_names[k], worst[k], said[k], least[k]);
  }
  printf("gyrostat: %d scenes, %ld refused, %ld rows, %ld not covered; the truth is good to %.0e\n",
         scenes, refused, rows, missed, doubts);
  return missed;
}

/* ---- bodies with motors ---------------------------------------------------------------------- */

static rot_status motors(double t, const double omega[3], const double q[4], double torque[],
                         void *ctx) {
  const scene *s = ctx;
  (void)q;
  for (size_t k = 0; k < s->p.n_rotors; k++) {
    torque[k] = s->rotor[k].driven ? 0.0
                                   : s->wave[k] * sin(s->frequency * t + (double)k) +
                                         s->drag * (s->rotor[k].axis[0] * omega[0] +
                                                    s->rotor[k].axis[1] * omega[1] +
                                                    s->rotor[k].axis[2] * omega[2]);
  }
  return ROT_OK;
}

static void draw_wheels(int kind, scene *s) {
  random_start(s);
  rot_free_params *p = &s->p;
  const double size = power(-1.0, 0.3);
  double rate = 0.0, strong = 0.0;
  for (int i = 0; i < 3; i++) {
    p->moment_kg_m2[i] = uniform(0.6, 1.0);
    rate = hypot(rate, p->omega0_rad_per_s[i]);
  }
  p->n_rotors = kind == 1 ? 3 : kind == 4 || kind == 5 || kind == 6 ? 2 : 1;
  if (kind == 7) { /* no momentum at all */
    p->n_rotors = 3;
    for (int i = 0; i < 3; i++) p->omega0_rad_per_s[i] = 0.0;
  }
  for (size_t k = 0; k < p->n_rotors; k++) {
    rot_free_rotor *r = &s->rotor[k];
    r->moment_kg_m2 = uniform(0.02, 0.2);
    r->omega_rad_per_s = uniform(-1.0, 1.0) * power(0.0, 1.3);
    r->driven = kind == 3 || (kind == 4 && k);
    random_axis(r->axis);
    if (kind == 0 || kind == 1) {
      for (size_t i = 0; i < 3; i++) r->axis[i] = i == k;
    }
    if (kind == 7) r->omega_rad_per_s = 0.0;
    if (kind == 0 || kind == 1 || kind == 4 || kind == 7) r->torque = size * uniform(-1.0, 1.0);
    strong += fabs(r->moment_kg_m2 * r->omega_rad_per_s);
  }
  s->span = power(0.3, 1.5) / (rate + strong + (kind == 7 ? sqrt(size) : 0.0));
  s->accuracy = power(-10.0, -2.0);
  if (kind == 2) {
    p->n_breaks = s->rotor[0].n_knots = 4;
    p->breaks_s = s->rotor[0].knot_s = s->knot_s;
    s->rotor[0].knot_torque = s->knot;
    for (int k = 0; k < 4; k++) {
      s->knot_s[k] = s->span * (k + uniform(0.1, 0.9)) / 4.5;
      s->knot[k] = size * uniform(-1.0, 1.0);
    }
  }
  if (kind == 4 || kind == 6) {
    for (int i = 0; i < 3; i++) p->torque[i] = size * uniform(-1.0, 1.0);
    p->in_space = kind == 6;
    p->damping_per_s = kind == 4 ? power(-2.0, 0.0) : 0.0;
  }
  if (kind == 5) {
    for (int k = 0; k < MOST; k++) s->wave[k] = size * uniform(-1.0, 1.0);
    s->frequency = power(-0.5, 0.7);
    s->drag = uniform(0.0, 0.3);
    p->motors = motors;
    p->motors_ctx = s;
  }
  s->rate = rate + 2.0 * strong + sqrt(4.0 * size) + 2.0 * size * fmin(s->span, 8.0) + s->frequency;
  keep_truth(s);
}

static int check_wheels(int scenes) {
  double *ratios = malloc((size_t)(scenes > 0 ? scenes : 1) * sizeof *ratios), doubts = 0.0;
  int within = 0, missed = 0, of[WHEEL_KINDS] = {0}, good[WHEEL_KINDS] = {0};
  for (int i = 0; i < scenes; i++) {
    const int kind = i % WHEEL_KINDS;
    scene s;
    draw_wheels(kind, &s);
    double t[ROWS], flows[ROT_FREE_FLOWS][ROWS], errors[ROT_FREE_FLOWS], error[3] = {0.0};
    double *flow[ROT_FREE_FLOWS];
    for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = flows[k];
    for (int k = 0; k < ROWS; k++) t[k] = uniform(0.0, s.span);
    qsort(t, ROWS, sizeof *t, by_size);
    t[ROWS - 1] = s.span;
    table x;
    const rot_free_columns out = columns_of(&x);
    const rot_free_ode_options options = {s.accuracy, 1000000, ROT_METHOD_NONE, 0.0};
    rot_info info;
    ratios[i] = 0.0;
    if (rot_free_integrate(&s.p, &options, ROWS, t, &out, flow, errors, NULL, NULL, &info) !=
        ROT_OK) {
      printf("wheels: scene %d (%s) failed\n", i, wheel_names[kind]);
      missed++;
      continue;
    }
    quad y[DIM], again[DIM], at = 0, at_again = 0;
    begin(&s, y);
    begin(&s, again);
    for (int k = 0; k < ROWS; k++) {
      go_to(&s, t[k], 0.2Q / s.rate, &at, y);
      compare(&s, &x, k, y, error);
    }
    if (i % 32 < WHEEL_KINDS) {
      go_to(&s, s.span, 0.1Q / s.rate, &at_again, again);
      doubts = fmax(doubts, angle_between(y, again));
    }
    double true_figure = 0.0;
    for (int k = 0; k < 3; k++) {
      true_figure = fmax(true_figure, error[k] / info.measure[k].largest);
    }
    const double figure = rot_info_error(&info), ratio = figure / true_figure;
    ratios[i] = ratio;
    of[kind]++;
    if (ratio < 1.0) missed++;
    if (ratio >= 0.5 && ratio <= 2.0) {
      within++;
      good[kind]++;
    } else if (getenv("COVERAGE_SHOW")) {
      printf("wheels: scene %d (%s), asked %.1e: off %.2e, figure %.2e\n", i, wheel_names[kind],
             s.accuracy, true_figure, figure);
    }
  }
  if (scenes > 0) qsort(ratios, (size_t)scenes, sizeof *ratios, by_size);
  for (int k = 0; k < WHEEL_KINDS; k++) {
    printf("  %-28s %d of %d within a factor 2\n", wheel_names[k], good[k], of[k]);
  }
  if (scenes > 0) {
    printf("wheels: figure/truth %.3g at least, %.3g in the middle, %.3g at most\n", ratios[0],
           ratios[scenes / 2], ratios[scenes - 1]);
  }
  printf("wheels: %d scenes, %d within a factor 2, %d exceeded; the truth is good to %.0e\n",
         scenes, within, missed, doubts);
  free(ratios);
  return within < 0.95 * scenes || missed > 0.05 * scenes;
}

int main(int argc, char **argv) {
  const int scenes = argc > 1 ? atoi(argv[1]) : 1000;
  state = 0x9e3779b97f4a7c15u ^ (argc > 2 ? strtoull(argv[2], NULL, 10) : 1u);
  for (int i = 0; i < 20; i++) (void)uniform(0.0, 1.0);
  const long missed = check_gyrostats(scenes);
  return check_wheels(scenes / 2) || missed > 0;
}
