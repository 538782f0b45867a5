/* Motions of an axle under torque laws with kinks and jumps, in quadruple precision: the truth for
 * laws.R. Extrapolated midpoint steps (Gragg, Bulirsch, Stoer) that end at the surfaces where the
 * law changes, each in the law of its own side. Reads a scene a line, writes a line for each:
 *
 *   in:  inertia, theta0, omega0, a, b, c, w, phase, theta1, kink_theta, jump_theta, omega1,
 *        kink_omega, jump_omega, time1, kink_time, jump_time, pulse, pulse_s, width_s, rows, times
 *   out: theta and omega of each row; nothing where a motion slides along a surface. */
#include <math.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>

#include "midpoint.h"

enum { PARAMETERS = 20, MOST_ROWS = 400, MOST_STEPS = 5000 };

typedef struct law {
  double x[PARAMETERS];
  int above_theta, above_omega, after; /* the side of each surface */
} law;

static void slope(const void *system, quad t, const quad y[2], quad f[2]) {
  const law *l = system;
  const double *x = l->x;
  quad torque = -x[3] * sinq(y[0]) - x[4] * y[1] + x[5] * cosq(x[6] * t + x[7]);
  if (l->above_theta) torque += x[9] * (y[0] - x[8]) + x[10];
  if (l->above_omega) torque += x[12] * (y[1] - x[11]) + x[13];
  if (l->after) torque += x[15] * (t - x[14]) + x[16];
  if (x[17] != 0.0) {
    const quad u = (t - x[18]) / x[19];
    torque += x[17] * expq(-u * u);
  }
  f[0] = y[1];
  f[1] = torque / x[0];
}

/* One step of length h; its error, of numbers below 1 absolute. */
static double step(const law *l, quad t, const quad y[2], quad h, quad out[2]) {
  static const midpoint rule = {slope, 2, 12, 1e-29};
  static const quad size[2] = {1, 1};
  return midpoint_step(&rule, l, t, h, y, size, out);
}

/* How far the state lies beyond the surface, outward from its present side. */
static quad beyond(const law *l, int which, const quad y[2]) {
  const quad up = which ? y[1] - (quad)l->x[11] : y[0] - (quad)l->x[8];
  return (which ? l->above_omega : l->above_theta) ? -up : up;
}

static int has(const law *l, int which) {
  return which ? l->x[12] != 0.0 || l->x[13] != 0.0 : l->x[9] != 0.0 || l->x[10] != 0.0;
}

/* The side of the surface that the motion goes to; 0 where it would slide. */
static int settle(law *l, int which, quad t, const quad y[2]) {
  int *side = which ? &l->above_omega : &l->above_theta;
  for (*side = 0; *side < 2; ++*side) {
    quad f[2];
    slope(l, t, y, f);
    const quad rate = which ? f[1] : f[0] != 0 ? f[0] : f[1];
    if (*side ? rate > 0 : rate < 0) return 1;
  }
  return 0;
}

/* Goes to `end`; 0 if it cannot. */
static int march(law *l, quad *t, quad y[2], quad end, quad *h) {
  for (int steps = 0; *t < end; steps++) {
    if (steps > MOST_STEPS) return 0;
    quad out[2], d = fminq(*h, end - *t);
    const double error = step(l, *t, y, d, out);
    if (!(error < 1e-27)) {
      *h = d / 2;
      if (*h < 1e-20Q) return 0;
      continue;
    }
    int which = -1;
    for (int k = 0; k < 2; k++) {
      if (!has(l, k) || !(beyond(l, k, out) > 0)) continue;
      /* The step that ends on the surface, by false position (Illinois). */
      quad lo = 0, hi = d, at = beyond(l, k, y), past = beyond(l, k, out);
      if (at > 0) at = 0;
      for (int i = 0; i < 200 && hi - lo > 1e-31Q * fmaxq(1, fabsq(*t)); i++) {
        quad mid = past - at != 0 ? hi - past * (hi - lo) / (past - at) : (lo + hi) / 2;
        if (i % 4 == 3 || !(mid > lo && mid < hi)) mid = (lo + hi) / 2;
        step(l, *t, y, mid, out);
        const quad now = beyond(l, k, out);
        if (now > 0) {
          hi = mid;
          past = now;
          at /= 2;
        } else {
          lo = mid;
          at = now;
          past /= 2;
        }
      }
      d = hi;
      step(l, *t, y, d, out);
      which = k;
    }
    *t = d == end - *t ? end : *t + d;
    y[0] = out[0];
    y[1] = out[1];
    if (which >= 0 && !settle(l, which, *t, y)) return 0;
    if (error < 1e-30) *h = fminq(*h * 2, l->x[17] != 0.0 ? fminq(0.05Q, l->x[19]) : 0.05Q);
  }
  return 1;
}

int main(void) {
  law l;
  while (scanf("%lf", l.x) == 1) {
    double rows_s[MOST_ROWS], rows;
    for (int i = 1; i < PARAMETERS; i++) {
      if (scanf("%lf", l.x + i) != 1) return 1;
    }
    if (scanf("%lf", &rows) != 1 || !(rows <= MOST_ROWS)) return 1;
    for (int i = 0; i < (int)rows; i++) {
      if (scanf("%lf", rows_s + i) != 1) return 1;
    }
    quad t = 0, y[2] = {l.x[1], l.x[2]}, h = 0.01Q;
    int good = 1;
    l.after = l.x[14] <= 0.0;
    l.above_theta = y[0] > l.x[8];
    l.above_omega = y[1] > l.x[11];
    for (int i = 0; i < (int)rows && good; i++) {
      if (!l.after && rows_s[i] >= l.x[14]) {
        good = march(&l, &t, y, l.x[14], &h);
        l.after = 1;
      }
      good = good && march(&l, &t, y, rows_s[i], &h);
      if (good) printf("%.17g %.17g ", (double)y[0], (double)y[1]);
    }
    printf("\n");
    fflush(stdout);
  }
  return 0;
}
