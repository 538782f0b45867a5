/* How well the heavy top's error bound covers its error: random tops against a Taylor integration
 * of order 34 in quadruple precision. After up to 1e12 rad: against its first nutation, repeated,
 * where one is found and passes no pole. Called by tools/check-coverage.sh; by hand:
 *
 *   cc -O2 -std=gnu99 -Isrc bench/coverage/top.c src/rot_*.c -lgsl -lgslcblas -lquadmath -lm
 *
 * Arguments: scenes, seed, longest time of the first comparison in radians of the fastest rate
 * (60). */
#include <math.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rot_attitude.h"
#include "rot_top_motion.h"

typedef __float128 quad;

enum { ORDER = 34, STATE = 7 };

static double uniform(double low, double high) {
  return low + (high - low) * ((double)rand() / (double)RAND_MAX);
}

static double log_uniform(double low, double high) { return pow(10.0, uniform(low, high)); }

/* Series coefficient k of the product of two series. */
static quad product(quad (*y)[ORDER + 1], int i, int j, int k) {
  quad sum = 0;
  for (int l = 0; l <= k; l++) sum += y[i][l] * y[j][k - l];
  return sum;
}

/* One step of Euler's equations with the quaternion. */
static void step(double i1, double i3, double weight, double wheels, quad h, quad state[STATE]) {
  static quad y[STATE][ORDER + 1];
  const quad a = ((quad)i1 - (quad)i3) / (quad)i1, g = (quad)weight / (quad)i1;
  const quad turn = (quad)wheels / (quad)i1;
  for (int i = 0; i < STATE; i++) y[i][0] = state[i];
  for (int k = 0; k < ORDER; k++) {
    const quad n = k + 1;
#define P(i, j) product(y, i, j, k)
    y[0][k + 1] = -(P(1, 4) + P(2, 5) + P(3, 6)) / (2 * n);
    y[1][k + 1] = (P(0, 4) + P(2, 6) - P(3, 5)) / (2 * n);
    y[2][k + 1] = (P(0, 5) + P(3, 4) - P(1, 6)) / (2 * n);
    y[3][k + 1] = (P(0, 6) + P(1, 5) - P(2, 4)) / (2 * n);
    y[4][k + 1] = (a * P(5, 6) - turn * y[5][k] + 2 * g * (P(2, 3) + P(0, 1))) / n;
    y[5][k + 1] = (-a * P(4, 6) + turn * y[4][k] - 2 * g * (P(1, 3) - P(0, 2))) / n;
    y[6][k + 1] = 0;
#undef P
  }
  for (int i = 0; i < STATE; i++) {
    quad sum = 0;
    for (int k = ORDER; k >= 0; k--) sum = sum * h + y[i][k];
    state[i] = sum;
  }
}

static quad value(rot_dd x) { return (quad)x.hi + (quad)x.lo; }

typedef struct scene {
  double i1, i3, weight, wheels, theta, omega[3], time_s;
} scene;

static double rate_of(const scene *s) {
  return sqrt(fabs(s->weight)) + fabs(s->omega[0]) + fabs(s->omega[1]) + fabs(s->omega[2]) +
         fabs(s->wheels) / s->i1;
}

static scene draw(int kind, double span) {
  scene s = {1.0, uniform(0.0, 2.0), log_uniform(-2.0, 2.0), 0.0, uniform(0.0, 3.14159), {0}, 0.0};
  if (rand() % 4 == 0) s.weight = -s.weight;
  for (int i = 0; i < 3; i++) s.omega[i] = uniform(-1.0, 1.0) * log_uniform(-2.0, 1.3);
  const double critical = 2.0 * sqrt(fabs(s.weight)) / s.i3;
  switch (kind) {
  case 0: break;
  case 1: /* released */ s.omega[0] = s.omega[1] = 0.0; break;
  case 2: /* planar */ s.omega[1] = s.omega[2] = 0.0; break;
  case 3: /* at a pole */ s.theta = rand() % 2 ? 0.0 : 0x1.921fb54442d18p+1; break;
  case 4: /* next to a pole */
    s.theta = log_uniform(-15.0, -1.0);
    if (rand() % 2) s.theta = 0x1.921fb54442d18p+1 - s.theta;
    break;
  case 5: /* nearly asleep */
    s.weight = fabs(s.weight);
    s.theta = log_uniform(-9.0, -1.0);
    s.omega[0] = s.omega[1] = 0.0;
    s.omega[2] = critical * (1.0 + uniform(-1.0, 1.0) * log_uniform(-8.0, -1.0));
    break;
  case 6: { /* nearly steady */
    double slow, fast;
    s.omega[2] *= 10.0;
    rot_top_steady(s.i1, s.i3, s.weight, cos(s.theta), s.omega[2], &slow, &fast);
    const double phi = isnan(slow) ? 1.0 : rand() % 2 && isfinite(fast) ? fast : slow;
    s.omega[0] = 0.0;
    s.omega[1] = phi * sin(s.theta) * (1.0 + uniform(-1.0, 1.0) * log_uniform(-12.0, -1.0));
    break;
  }
  case 7: /* a rod, or a plate */ s.i3 = rand() % 2 ? 0.0 : 2.0; break;
  case 8: /* weak gravity */ s.weight *= log_uniform(-12.0, -2.0); break;
  case 9: /* fast */ s.omega[2] *= 30.0; break;
  case 10: /* wheels */
    s.wheels = uniform(-1.0, 1.0) * log_uniform(-2.0, 1.3);
    if (rand() % 3 == 0) s.theta = rand() % 2 ? 0.0 : 0x1.921fb54442d18p+1;
    break;
  default: /* fast wheels in a body that is let go */
    s.wheels = uniform(-1.0, 1.0) * log_uniform(-1.0, 2.8);
    for (int i = 0; i < 3; i++) s.omega[i] *= rand() % 3 ? 0.0 : 0.1;
  }
  s.time_s = uniform(0.0, span) / rate_of(&s);
  return s;
}

/* ---- long times ------------------------------------------------------------------------------ */

static void integrate(const scene *s, quad time, quad y[STATE]) {
  const int steps = 1 + (int)ceil((double)fabsq(time) * rate_of(s) / 0.4);
  for (int i = 0; i < steps; i++) step(s->i1, s->i3, s->weight, s->wheels, time / steps, y);
}

/* How fast the axis rises. */
static quad rise(const quad q[STATE]) {
  return 2 * (q[1] * q[3] - q[0] * q[2]) * q[5] - 2 * (q[2] * q[3] + q[0] * q[1]) * q[4];
}

/* On to the next time at which the axis is lowest. */
static int next_lowest(const scene *s, quad *t, quad y[STATE]) {
  const quad h = 0.2Q / rate_of(s);
  for (int k = 0; k < 600; k++) {
    quad next[STATE], low = 0, high = h, at = rise(y), past, last = -1;
    memcpy(next, y, sizeof next);
    step(s->i1, s->i3, s->weight, s->wheels, h, next);
    past = rise(next);
    if (at < 0 && past >= 0) {
      for (int i = 0; i < 200; i++) { /* false position (Illinois) */
        const quad mid = low + (high - low) * (at / (at - past));
        if (fabsq(mid - last) <= 1e-32Q * (h + *t)) break;
        last = mid;
        memcpy(next, y, sizeof next);
        step(s->i1, s->i3, s->weight, s->wheels, mid, next);
        const quad now = rise(next);
        if (now >= 0) {
          high = mid, past = now, at /= 2;
        } else {
          low = mid, at = now, past /= 2;
        }
      }
      memcpy(y, next, sizeof next);
      *t += last;
      return 1;
    }
    memcpy(y, next, sizeof next);
    *t += h;
  }
  return 0;
}

/* What a nutation turns q0 + i q3, q1 + i q2 and w1 + i w2 by. */
typedef struct nutation {
  quad period, sum, difference;
} nutation;

static int find_nutation(const scene *s, const quad start[STATE], nutation *out) {
  quad y[STATE], z[STATE], t = 0, end;
  memcpy(y, start, sizeof y);
  if (!next_lowest(s, &t, y)) return 0;
  memcpy(z, y, sizeof z);
  end = t;
  step(s->i1, s->i3, s->weight, s->wheels, 0.01Q / rate_of(s), z); /* off the zero */
  end += 0.01Q / rate_of(s);
  if (!next_lowest(s, &end, z)) return 0;
  if (y[0] * y[0] + y[3] * y[3] < 1e-6Q || y[1] * y[1] + y[2] * y[2] < 1e-6Q) return 0;
  out->period = end - t;
  out->sum = atan2q(z[3], z[0]) - atan2q(y[3], y[0]);
  out->difference = atan2q(z[2], z[1]) - atan2q(y[2], y[1]);
  return 1;
}

static void rotate(quad angle, quad *x, quad *y) {
  const quad c = cosq(angle), s = sinq(angle), a = *x, b = *y;
  *x = c * a - s * b;
  *y = s * a + c * b;
}

/* The state at a time, by n whole nutations and what is left. */
static void repeat(const scene *s, const nutation *by, quad n, quad time, quad y[STATE]) {
  integrate(s, time - n * by->period, y);
  rotate(n * by->sum, &y[0], &y[3]);
  rotate(n * by->difference, &y[1], &y[2]);
  rotate(n * (by->difference - by->sum), &y[4], &y[5]);
}

static double far_from(const quad y[STATE], const rot_top_state *at, double *omega) {
  double q[4], off = 0.0;
  for (int i = 0; i < 4; i++) q[i] = (double)y[i];
  for (int i = 0; i < 3; i++) {
    const double d = (double)((quad)at->omega[i] - y[4 + i]);
    off += d * d;
  }
  *omega = sqrt(off);
  return rot_attitude_angle(q, at->q);
}

int main(int argc, char **argv) {
  enum { KINDS = 12 };
  static const char *const names[KINDS] = {
      "any",           "released",   "planar",       "at a pole", "next to a pole", "nearly asleep",
      "nearly steady", "rod, plate", "weak gravity", "fast",      "wheels",         "fast wheels"};
  const int scenes = argc > 1 ? atoi(argv[1]) : 300;
  const unsigned seed = argc > 2 ? (unsigned)atoi(argv[2]) : 1u;
  const double span = argc > 3 ? atof(argv[3]) : 60.0;
  int missed = 0;
  double worst[KINDS] = {0}, ratio[KINDS] = {0}, most[KINDS] = {0}, doubts = 0.0, farthest = 0.0;
  int later[KINDS] = {0};
  srand(seed);
  for (int k = 0; k < scenes; k++) {
    const int kind = k % KINDS;
    const scene s = draw(kind, span);
    rot_top_start start;
    rot_top_motion motion;
    rot_top_state now;
    rot_top_from_euler(uniform(-3.0, 3.0), s.theta, uniform(-3.0, 3.0), 0.0, 0.0, s.omega[2],
                       &start);
    for (int i = 0; i < 2; i++) start.omega[i] = (rot_dd){s.omega[i], 0.0};
    if (rot_top_begin_wheels(s.i1, s.i3, s.weight, (rot_dd){s.wheels, 0.0}, &start, 0.0, &motion) !=
        ROT_OK) {
      printf("refused: %s\n", names[kind]);
      missed++;
      continue;
    }
    rot_top_at(&motion, (rot_dd){s.time_s, 0.0}, &now);
    quad y[STATE], length = 0;
    for (int i = 0; i < 4; i++) length += value(start.q[i]) * value(start.q[i]);
    quad size = 1; /* 1/sqrt(length) */
    for (int i = 0; i < 4; i++) size = size * (3 - length * size * size) / 2;
    for (int i = 0; i < 4; i++) y[i] = value(start.q[i]) * size;
    for (int i = 0; i < 3; i++) y[4 + i] = value(start.omega[i]);
    quad first[STATE];
    memcpy(first, y, sizeof first);
    integrate(&s, s.time_s, y);
    double off, angle = far_from(y, &now, &off);
    nutation by;
    double times[2] = {s.time_s, s.time_s};
    if (find_nutation(&s, first, &by)) {
      times[1] = log_uniform(2.0, 12.0) / rate_of(&s);
      later[kind]++;
    }
    for (int long_after = 0; long_after < 2; long_after++) {
      if (long_after) {
        if (times[1] == times[0]) break;
        quad near[STATE];
        const quad n = floorq(times[1] / by.period);
        memcpy(near, first, sizeof near);
        repeat(&s, &by, 1, s.time_s, near); /* the truth against the truth */
        rot_top_state direct;
        for (int i = 0; i < 4; i++) direct.q[i] = (double)y[i];
        for (int i = 0; i < 3; i++) direct.omega[i] = (double)y[4 + i];
        doubts = fmax(doubts, far_from(near, &direct, &off));
        memcpy(y, first, sizeof y);
        repeat(&s, &by, n, times[1], y);
        rot_top_at(&motion, (rot_dd){times[1], 0.0}, &now);
        angle = far_from(y, &now, &off);
        farthest = fmax(farthest, times[1] * rate_of(&s));
      }
      const double worse = fmax(angle / now.q_error, off / now.omega_error);
      most[kind] = fmax(most[kind], angle);
      ratio[kind] = fmax(ratio[kind], now.q_error);
      if (!(worse <= worst[kind])) worst[kind] = worse;
      if (worse <= 1.0) continue;
      missed++;
      printf(
          "missed: %s, %.3g of the bound %.2e; I3 %a G %a wheels %a theta %a omega %a %a %a t %a\n",
          names[kind], worse, now.q_error, s.i3, s.weight, s.wheels, s.theta, s.omega[0],
          s.omega[1], s.omega[2], times[long_after]);
    }
  }
  for (int k = 0; k < KINDS; k++) {
    printf("%-14s error at most %.1e, bound at most %.1e, %.2f of the bound; %d after long times\n",
           names[k], most[k], ratio[k], worst[k], later[k]);
  }
  printf("top: up to %.1e rad; two ways to the truth are %.0e apart, as doubles\n", farthest,
         doubts);
  printf("top, seed %u: %d of %d outside the bound\n", seed, missed, scenes);
  return missed != 0;
}
