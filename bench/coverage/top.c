/* How well the heavy top's error bound covers its error: random tops against a Taylor integration
 * of order 34 in quadruple precision. Called by tools/check-coverage.sh; by hand:
 *
 *   cc -O2 -std=gnu99 -Isrc bench/coverage/top.c src/rot_*.c -lgsl -lgslcblas -lm && ./a.out 300 7
 *
 * Arguments: scenes, seed, longest time in radians of the fastest rate (60). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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

int main(int argc, char **argv) {
  enum { KINDS = 12 };
  static const char *const names[KINDS] = {
      "any",           "released",   "planar",       "at a pole", "next to a pole", "nearly asleep",
      "nearly steady", "rod, plate", "weak gravity", "fast",      "wheels",         "fast wheels"};
  const int scenes = argc > 1 ? atoi(argv[1]) : 300;
  const unsigned seed = argc > 2 ? (unsigned)atoi(argv[2]) : 1u;
  const double span = argc > 3 ? atof(argv[3]) : 60.0;
  int missed = 0;
  double worst[KINDS] = {0}, ratio[KINDS] = {0}, most[KINDS] = {0};
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
    const int steps = 1 + (int)ceil(s.time_s * rate_of(&s) / 0.4);
    for (int i = 0; i < steps; i++) step(s.i1, s.i3, s.weight, s.wheels, (quad)s.time_s / steps, y);
    double q[4], off = 0.0;
    for (int i = 0; i < 4; i++) q[i] = (double)y[i];
    for (int i = 0; i < 3; i++) {
      const double d = (double)((quad)now.omega[i] - y[4 + i]);
      off += d * d;
    }
    const double angle = rot_attitude_angle(q, now.q);
    const double worse = fmax(angle / now.q_error, sqrt(off) / now.omega_error);
    most[kind] = fmax(most[kind], angle);
    ratio[kind] = fmax(ratio[kind], now.q_error);
    if (!(worse <= worst[kind])) worst[kind] = worse;
    if (!(worse <= 1.0)) {
      missed++;
      printf(
          "missed: %s, %.3g of the bound %.2e; I3 %a G %a wheels %a theta %a omega %a %a %a t %a\n",
          names[kind], worse, now.q_error, s.i3, s.weight, s.wheels, s.theta, s.omega[0],
          s.omega[1], s.omega[2], s.time_s);
    }
  }
  for (int k = 0; k < KINDS; k++) {
    printf("%-14s error at most %.1e, bound at most %.1e, %.2f of the bound\n", names[k], most[k],
           ratio[k], worst[k]);
  }
  printf("top, seed %u: %d of %d outside the bound\n", seed, missed, scenes);
  return missed != 0;
}
