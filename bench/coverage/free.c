/* Does the reported error of a free body cover the true one? Random bodies, judged in quadruple
 * precision: Jacobi's functions by the phases of the arithmetic-geometric mean, the angle about L
 * by Gauss-Legendre quadrature of its rate. That truth is itself compared with an integration of
 * Euler's equations (extrapolated midpoint steps) where the time is short.
 *
 *   free [scenes] [seed]
 *   free truth I1 I2 I3 w1 w2 w3 t ...    prints t and the true quaternion, a line each */
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
#include "scene/free/exact.h"
#include "scene/free/table.h"

enum { KINDS = 12, NODES = 20, MOST_PANELS = 400 };
static const char *const kind_names[KINDS] = {"generic",
                                              "near oblate 1e-12",
                                              "near prolate 1e-12",
                                              "near separatrix 1e-12",
                                              "symmetric",
                                              "near a ball",
                                              "inertia ratios",
                                              "plate",
                                              "near the middle axis",
                                              "damped",
                                              "middle axis, 1e-300",
                                              "one off it, 1e-300"};

/* ---- the truth ------------------------------------------------------------------------------- */

static quad node[NODES], weight[NODES];

/* Gauss-Legendre on (0, 1), by Newton's method. */
static void find_nodes(void) {
  for (int i = 0; i < NODES; i++) {
    quad x = cosq(M_PIq * ((quad)i + 0.75Q) / (NODES + 0.5Q)), slope = 0;
    for (int k = 0; k < 60; k++) {
      quad p = x, before = 1;
      for (int n = 2; n <= NODES; n++) {
        const quad next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
        before = p;
        p = next;
      }
      slope = NODES * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    node[i] = (1 - x) / 2;
    weight[i] = 1 / ((1 - x * x) * slope * slope);
  }
}

/* A free body in sorted principal axes. */
typedef struct truth {
  int order[3];
  quad sign[3], moment[3], w0[3], size; /* size: |omega| of a steady spin */
  int steady, o, c;
  quad amplitude[3], lambda, m1, k, start, momentum;
  int n;
  quad a[32], b[32]; /* of the mean: a_i, c_i */
  int panels;
  quad sum[MOST_PANELS + 1];
} truth;

static void jacobi(const truth *s, quad u, quad *sn, quad *cn, quad *dn) {
  quad phi = ldexpq(s->a[s->n] * u, s->n);
  for (int i = s->n; i > 0; i--) {
    phi = (phi + asinq(s->b[i] / s->a[i] * sinq(phi))) / 2;
  }
  *sn = sinq(phi);
  *cn = cosq(phi);
  /* without the cancellation of the last two phases */
  *dn = sqrtq(s->m1 + (1 - s->m1) * *cn * *cn);
}

static quad rf(quad x, quad y, quad z) {
  for (int i = 0; i < 60; i++) {
    const quad sx = sqrtq(x), sy = sqrtq(y), sz = sqrtq(z), l = sx * (sy + sz) + sy * sz;
    x = (x + l) / 4;
    y = (y + l) / 4;
    z = (z + l) / 4;
  }
  return 1 / sqrtq((x + y + z) / 3);
}

/* L and omega at u. */
static void momenta(const truth *s, quad u, quad w[3], quad l[3]) {
  quad sn, cn, dn;
  jacobi(s, u, &sn, &cn, &dn);
  w[s->o] = s->amplitude[s->o] * cn;
  w[s->c] = s->amplitude[s->c] * dn;
  w[1] = s->amplitude[1] * sn;
  for (int i = 0; i < 3; i++) l[i] = s->moment[i] * w[i];
}

/* The reference axis: L stays away from it. */
static int reference(const truth *s) {
  return fabsq(s->moment[s->o] * s->amplitude[s->o]) < fabsq(s->moment[s->c] * s->amplitude[s->c])
             ? s->o
             : s->c;
}

/* d psi/d u. */
static quad psi_rate(const truth *s, quad u) {
  quad w[3], l[3];
  const int r = reference(s), x = (r + 1) % 3, y = (r + 2) % 3;
  momenta(s, u, w, l);
  return s->momentum * (l[x] * w[x] + l[y] * w[y]) / (l[x] * l[x] + l[y] * l[y]) / s->lambda;
}

static quad panel(const truth *s, quad from, quad to) {
  quad sum = 0;
  for (int i = 0; i < NODES; i++) sum += weight[i] * psi_rate(s, from + (to - from) * node[i]);
  return sum * (to - from);
}

/* Where a panel begins: they are even, or, where K is large, narrow near 0. */
static quad edge(const truth *s, int i) {
  const quad part = (quad)i / s->panels;
  return s->k * (s->panels < MOST_PANELS ? part : part * part);
}

/* The integral of psi_rate from 0, an even function of period 2 K. */
static quad psi_to(const truth *s, quad u) {
  const quad n = rintq(u / (2 * s->k)), r = u - 2 * s->k * n, size = fabsq(r);
  const quad place = s->panels < MOST_PANELS ? size / s->k : sqrtq(size / s->k);
  int at = (int)(place * s->panels);
  if (at > s->panels) at = s->panels;
  const quad from = edge(s, at), part = s->sum[at] + panel(s, from, size);
  return 2 * n * s->sum[s->panels] + (r < 0 ? -part : part);
}

static void begin_truth(const double moment[3], const double omega[3], truth *s) {
  memset(s, 0, sizeof *s);
  int odd = 0;
  for (int i = 0; i < 3; i++) {
    s->order[i] = i;
    s->sign[i] = 1;
  }
  for (int i = 0; i < 3; i++) {
    const int at = i == 1;
    if (moment[s->order[at]] > moment[s->order[at + 1]]) {
      const int first = s->order[at];
      s->order[at] = s->order[at + 1];
      s->order[at + 1] = first;
      odd = !odd;
    }
  }
  if (odd) s->sign[1] = -1;
  int scale, exponent;
  (void)frexp(fmax(moment[0], fmax(moment[1], moment[2])), &scale);
  (void)frexp(fmax(fabs(omega[0]), fmax(fabs(omega[1]), fabs(omega[2]))), &exponent);
  for (int i = 0; i < 3; i++) {
    s->moment[i] = ldexpq(moment[s->order[i]], -scale);
    s->w0[i] = s->sign[i] * (quad)omega[s->order[i]];
  }
  const quad *m = s->moment, *w = s->w0, d21 = m[1] - m[0], d32 = m[2] - m[1], d31 = m[2] - m[0];
  const quad p = m[0] * d31 * w[0] * w[0] + m[1] * d32 * w[1] * w[1];
  const quad r = m[1] * d21 * w[1] * w[1] + m[2] * d31 * w[2] * w[2];
  const quad from = m[2] * d32 * w[2] * w[2] - m[0] * d21 * w[0] * w[0];
  const int high = from >= 0;
  const quad x = high ? p : r, y = high ? r : p, dcm = high ? d32 : d21;
  s->size = sqrtq(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  s->c = high ? 2 : 0;
  s->o = 2 - s->c;
  if (!(y * dcm > 0) || (w[s->o] == 0 && (w[1] == 0 || w[s->c] == 0))) {
    s->steady = 1;
    return;
  }
  s->momentum =
      sqrtq(m[0] * m[0] * w[0] * w[0] + m[1] * m[1] * w[1] * w[1] + m[2] * m[2] * w[2] * w[2]);
  s->lambda = sqrtq(y * dcm / (m[0] * m[1] * m[2]));
  s->m1 = d31 * fabsq(from) / (dcm * y);
  const quad so = w[s->o] < 0 ? -1 : 1, sc = w[s->c] < 0 ? -1 : 1;
  s->amplitude[s->o] = so * sqrtq(x / (m[s->o] * d31));
  s->amplitude[s->c] = sc * sqrtq(y / (m[s->c] * d31));
  s->amplitude[1] = so * sc * sqrtq(x / (m[1] * dcm));
  quad a = 1, g = sqrtq(s->m1);
  s->a[0] = 1;
  for (s->n = 0; fabsq(a - g) > 1e-33Q * a && s->n < 30;) {
    const quad mean = (a + g) / 2, half = (a - g) / 2;
    g = sqrtq(a * g);
    a = mean;
    s->n++;
    s->a[s->n] = a;
    s->b[s->n] = half;
  }
  s->k = M_PIq / (2 * a);
  const quad sn = w[1] / s->amplitude[1], cn = w[s->o] / s->amplitude[s->o];
  const quad dn = w[s->c] / s->amplitude[s->c], length = sqrtq(sn * sn + cn * cn);
  s->start = sn / length * rf(cn * cn / length / length, dn * dn, 1);
  s->panels = (int)(s->k / 0.4Q) + 1;
  if (s->panels > MOST_PANELS) s->panels = MOST_PANELS;
  for (int i = 0; i < s->panels; i++) {
    s->sum[i + 1] = s->sum[i] + panel(s, edge(s, i), edge(s, i + 1));
  }
}

/* Takes L to the z axis, in the axes (x, y, z = r). */
static void to_z(const truth *s, const quad l[3], quad q[4]) {
  const int r = reference(s), x = (r + 1) % 3, y = (r + 2) % 3;
  const quad theta = atan2q(sqrtq(l[x] * l[x] + l[y] * l[y]), l[r]), chi = atan2q(l[x], l[y]);
  const quad tilt[4] = {cosq(theta / 2), sinq(theta / 2), 0, 0};
  const quad turn[4] = {cosq(chi / 2), 0, 0, sinq(chi / 2)};
  times(tilt, turn, q);
}

/* omega and the quaternion, body to body at 0, after t. */
static void true_state(const truth *s, quad t, quad omega[3], quad q[4]) {
  quad w[3], v[3];
  if (s->steady) {
    const quad half = s->size * t / 2;
    q[0] = cosq(half);
    for (int i = 0; i < 3; i++) {
      w[i] = s->w0[i];
      v[i] = s->size > 0 ? sinq(half) * w[i] / s->size : 0;
    }
  } else {
    quad l[3], l0[3], end[4], begin[4];
    const int r = reference(s);
    const quad u = s->lambda * t + s->start, n = rintq(u / (2 * s->k)), rest = u - 2 * s->k * n;
    momenta(s, rest, w, l);
    if (fmodq(n, 2) != 0) {
      w[s->o] = -w[s->o], l[s->o] = -l[s->o];
      w[1] = -w[1], l[1] = -l[1];
    }
    for (int i = 0; i < 3; i++) l0[i] = s->moment[i] * s->w0[i];
    const quad psi = fmodq(psi_to(s, u) - psi_to(s, s->start), 4 * M_PIq);
    const quad turn[4] = {cosq(psi / 2), 0, 0, sinq(psi / 2)};
    to_z(s, l, end);
    to_z(s, l0, begin);
    for (int i = 1; i < 4; i++) begin[i] = -begin[i];
    times(turn, end, end);
    times(begin, end, end);
    q[0] = end[0];
    for (int i = 0; i < 3; i++) v[(r + 1 + i) % 3] = end[1 + i];
  }
  for (int i = 0; i < 3; i++) {
    omega[s->order[i]] = s->sign[i] * w[i];
    q[1 + s->order[i]] = s->sign[i] * v[i];
  }
}

/* ---- the truth of the truth: midpoint steps, extrapolated ------------------------------------ */

static void rates(const void *moments, quad t, const quad y[7], quad f[7]) {
  const quad *m = moments, *w = y + 4;
  (void)t;
  attitude_slopes(y, w, f);
  f[4] = (m[1] - m[2]) / m[0] * w[1] * w[2];
  f[5] = (m[2] - m[0]) / m[1] * w[2] * w[0];
  f[6] = (m[0] - m[1]) / m[2] * w[0] * w[1];
}

/* How far the two ways to the truth are apart after some rad. */
static double doubt(const truth *s, const double moment[3], const double omega[3]) {
  static const midpoint rule = {rates, 7, 10, 0.0};
  const quad h = 0.1Q / fmaxq(s->size, s->steady ? 0 : 4 * s->lambda);
  quad m[3], y[7] = {1, 0, 0, 0, omega[0], omega[1], omega[2]}, w[3], q[4];
  for (int i = 0; i < 3; i++) m[i] = moment[i];
  for (int k = 0; k < 80; k++) midpoint_step(&rule, m, k * h, h, y, NULL, y);
  true_state(s, 80 * h, w, q);
  return angle_between(y, q);
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static void draw(int kind, rot_free_params *p) {
  double m[3], w[3];
  memset(p, 0, sizeof *p);
  for (int i = 0; i < 3; i++) {
    m[i] = uniform(0.1, 1.0);
    w[i] = uniform(-1.0, 1.0);
  }
  /* moments in order here; relabelled below */
  if (kind == 6) m[0] = power(-6.0, 0.0), m[1] = power(-3.0, 0.0), m[2] = 1.0;
  for (int i = 0; i < 3; i++) {
    const int at = i == 1;
    const double a = fmin(m[at], m[at + 1]), b = fmax(m[at], m[at + 1]);
    m[at] = a, m[at + 1] = b;
  }
  const double close = 1e-12 * uniform(0.1, 1.0);
  if (kind == 1) m[1] = m[0] * (1.0 + close);
  if (kind == 2) m[1] = m[2] * (1.0 - close);
  if (kind == 3) { /* L^2 = 2 T I2, but for 1e-12 */
    w[2] = either(fabs(w[0]) * sqrt(m[0] * (m[1] - m[0]) / (m[2] * (m[2] - m[1]))) *
                  (1.0 + either(power(-16.0, -8.0))));
  }
  if (kind == 4) m[1] = m[uniform(0.0, 1.0) < 0.5 ? 0 : 2];
  if (kind == 5) m[0] = m[1] * (1.0 - power(-15.0, -3.0)), m[2] = m[1] * (1.0 + power(-15.0, -3.0));
  if (kind == 7) m[2] = m[0] + m[1];
  if (kind == 8) w[0] *= power(-15.0, -1.0), w[2] *= power(-15.0, -1.0);
  if (kind >= 10) w[0] *= power(-300.0, -1.0), w[2] *= power(-300.0, -1.0);
  if (kind == 10) w[2] = w[0] * uniform(-3.0, 3.0);
  if (kind == 11 && uniform(0.0, 1.0) < 0.5) w[uniform(0.0, 1.0) < 0.5 ? 0 : 2] = 0.0;
  if (kind == 9) p->damping_per_s = either(power(-4.0, 0.0));
  const int shift = (int)uniform(0.0, 3.0), odd = uniform(0.0, 1.0) < 0.5;
  const double inertia = uniform(0.0, 1.0) < 0.2 ? power(-150.0, 150.0) : 1.0;
  const double speed = kind == 9 ? 1.0 : uniform(0.0, 1.0) < 0.2 ? power(-70.0, 70.0) : 1.0;
  for (int i = 0; i < 3; i++) {
    const int at = (shift + (odd ? 3 - i : i)) % 3;
    p->moment_kg_m2[at] = m[i] * inertia;
    p->omega0_rad_per_s[at] = w[i] * speed;
  }
  p->axes[0] = 1.0;
  for (int i = 0; i < 4; i++) p->q0[i] = uniform(-1.0, 1.0);
  (void)rot_attitude_unit(p->q0);
}

/* Quaternion, rates and bound of a row of tumbling_table(); the bound. */
static double table_row(const rot_free_params *p, double t, double a[8]) {
  const double *m = p->moment_kg_m2, *w = p->omega0_rad_per_s, *q = p->q0;
  const rot_free_table_rows in = {1,
                                  {{m, 0}, {m + 1, 0}, {m + 2, 0}},
                                  {{w, 0}, {w + 1, 0}, {w + 2, 0}},
                                  {{q, 0}, {q + 1, 0}, {q + 2, 0}, {q + 3, 0}},
                                  {&t, 0}};
  const rot_free_table_columns out = {a, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7};
  rot_info info;
  (void)rot_free_table(&in, 1, &out, NULL, &info);
  return a[7];
}

static int print_truth(int argc, char **argv) {
  double m[3], w[3];
  truth s;
  if (argc < 9) return 2;
  for (int i = 0; i < 3; i++) {
    m[i] = atof(argv[2 + i]);
    w[i] = atof(argv[5 + i]);
  }
  begin_truth(m, w, &s);
  for (int i = 8; i < argc; i++) {
    quad omega[3], q[4];
    true_state(&s, atof(argv[i]), omega, q);
    printf("%.17g", atof(argv[i]));
    for (int k = 0; k < 4; k++) printf(" %.20g", (double)q[k]);
    printf("\n");
  }
  return 0;
}

int main(int argc, char **argv) {
  if (argc > 1 && !strcmp(argv[1], "truth")) {
    find_nodes();
    return print_truth(argc, argv);
  }
  const int scenes = argc > 1 ? atoi(argv[1]) : 1000;
  state = 0x9e3779b97f4a7c15u ^ (argc > 2 ? strtoull(argv[2], NULL, 10) : 1u);
  for (int i = 0; i < 20; i++) (void)uniform(0.0, 1.0);
  find_nodes();
  long missed = 0, rows = 0;
  double table_least = INFINITY, table_worst = 0.0, doubts = 0.0, worst[KINDS] = {0.0},
         said[KINDS] = {0.0}, least[KINDS];
  for (int k = 0; k < KINDS; k++) least[k] = INFINITY;
  for (int i = 0; i < scenes; i++) {
    const int kind = i % KINDS;
    rot_free_params p;
    truth s;
    draw(kind, &p);
    begin_truth(p.moment_kg_m2, p.omega0_rad_per_s, &s);
    if (i % 20 < KINDS) {
      const double d = doubt(&s, p.moment_kg_m2, p.omega0_rad_per_s);
      doubts = fmax(doubts, d);
    }
    for (int row = 0; row < 4; row++) {
      double c[14][1], t = either(power(-1.0, 12.0)) / (double)s.size;
      if (kind == 9) t = either(power(-1.0, 0.8)) / fabs(p.damping_per_s);
      const rot_free_columns out = {c[0], c[1], c[2], c[3],  c[4],  c[5],  c[6],
                                    c[7], c[8], c[9], c[10], c[11], c[12], c[13]};
      rot_info info;
      if (rot_free_exact(&p, 1, &t, &out, NULL, NULL, &info) != ROT_OK) {
        printf("free: scene %d (%s) failed\n", i, kind_names[kind]);
        missed++;
        break;
      }
      quad w[3], q[4], qs[4], q0[4], off = 0, off_l = 0, size = 0, size_l = 0;
      const quad g = p.damping_per_s, fade = expq(-g * t);
      true_state(&s, g == 0 ? (quad)t : -expm1q(-g * t) / g, w, q);
      for (int k = 0; k < 4; k++) q0[k] = p.q0[k];
      times(q0, q, qs);
      const quad got[4] = {c[0][0], c[1][0], c[2][0], c[3][0]};
      for (int k = 0; k < 3; k++) {
        const quad d = c[4 + k][0] - fade * w[k], l = (quad)p.moment_kg_m2[k] * w[k] * fade;
        off += d * d;
        size += w[k] * w[k] * fade * fade;
        size_l += l * l;
      }
      if (g == 0) { /* the same body as a row of a table */
        double a[8];
        const double angle = table_row(&p, t, a);
        const quad by_table[4] = {a[0], a[1], a[2], a[3]};
        const double gone = angle_between(qs, by_table);
        table_least = fmin(table_least, gone > 0.0 ? angle / gone : INFINITY);
        if (kind != 3) table_worst = fmax(table_worst, gone);
        if (!(gone <= angle)) {
          missed++;
          printf("free: scene %d (%s), t %g: row off %.2e, bound %.2e\n", i, kind_names[kind], t,
                 gone, angle);
        }
      }
      /* L in space: turned from the start, where it is */
      quad l0[4] = {0, 0, 0, 0}, back[4] = {q0[0], -q0[1], -q0[2], -q0[3]};
      for (int k = 0; k < 3; k++)
        l0[1 + k] = (quad)p.moment_kg_m2[k] * p.omega0_rad_per_s[k] * fade;
      times(q0, l0, l0);
      times(l0, back, l0);
      const quad norm = q0[0] * q0[0] + q0[1] * q0[1] + q0[2] * q0[2] + q0[3] * q0[3];
      for (int k = 0; k < 3; k++) {
        const quad d = c[10 + k][0] - l0[1 + k] / norm;
        off_l += d * d;
      }
      const double error[3] = {angle_between(qs, got), (double)sqrtq(off), (double)sqrtq(off_l)};
      rows++;
      worst[kind] = fmax(worst[kind], error[0]);
      said[kind] = fmax(said[kind], info.measure[0].error);
      for (int k = 0; k < 3; k++) {
        const double bound = info.measure[k].error;
        least[kind] = fmin(least[kind], error[k] > 0.0 ? bound / error[k] : INFINITY);
        if (!(error[k] <= bound)) {
          missed++;
          printf("free: scene %d (%s), t %g: %s off %.2e, bound %.2e\n", i, kind_names[kind], t,
                 rot_free_measures[k], error[k], bound);
        }
      }
    }
  }
  for (int k = 0; k < KINDS; k++) {
    printf("  %-22s attitude off by %.1e rad, bound %.1e at most; the closest %.2g\n",
           kind_names[k], worst[k], said[k], least[k]);
  }
  printf("  rows of tables: attitude off by %.1e rad but near the separatrix; the closest %.2g\n",
         table_worst, table_least);
  printf("free: %d scenes, %ld rows, %ld not covered; the truth is good to %.0e\n", scenes, rows,
         missed, doubts);
  return missed > 0;
}
