/* How well the heavy top's error bound covers its error: random tops against a Taylor integration
 * of order 34 in quadruple precision. After up to 1e12 rad: against its first nutation, repeated,
 * where one is found and passes no pole. Called by tools/check-coverage.sh; by hand:
 *
 *   cc -O2 -std=gnu99 -Isrc/core bench/coverage/top.c $(find src/core -name '*.c') \
 *     -lgsl -lgslcblas -lquadmath -lm
 *
 * Arguments: scenes, seed, longest time of the first comparison in radians of the fastest rate
 * (60). */
#include <math.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "maths/attitude.h"
#include "scene/pivot/pivot.h"
#include "scene/pivot/top_motion.h"

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
static void step(double i1, double i3, quad weight, double wheels, quad h, quad state[STATE]) {
  static quad y[STATE][ORDER + 1];
  const quad a = ((quad)i1 - (quad)i3) / (quad)i1, g = weight / (quad)i1;
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
  double i1, i3;
  quad weight;
  double wheels, theta, omega[3], time_s;
} scene;

static double rate_of(const scene *s) {
  return sqrt(fabs((double)s->weight) / s->i1) + fabs(s->omega[0]) + fabs(s->omega[1]) +
         fabs(s->omega[2]) + fabs(s->wheels) / s->i1;
}

static scene draw(int kind, double span) {
  scene s = {1.0, uniform(0.0, 2.0), 0, 0.0, uniform(0.0, 3.14159), {0}, 0.0};
  double weight = log_uniform(-2.0, 2.0);
  if (rand() % 4 == 0) weight = -weight;
  for (int i = 0; i < 3; i++) s.omega[i] = uniform(-1.0, 1.0) * log_uniform(-2.0, 1.3);
  const double critical = 2.0 * sqrt(fabs(weight)) / s.i3;
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
    weight = fabs(weight);
    s.theta = log_uniform(-9.0, -1.0);
    s.omega[0] = s.omega[1] = 0.0;
    s.omega[2] = critical * (1.0 + uniform(-1.0, 1.0) * log_uniform(-8.0, -1.0));
    break;
  case 6: { /* nearly steady */
    double slow, fast;
    s.omega[2] *= 10.0;
    rot_top_steady(s.i1, s.i3, weight, cos(s.theta), s.omega[2], &slow, &fast);
    const double phi = isnan(slow) ? 1.0 : rand() % 2 && isfinite(fast) ? fast : slow;
    s.omega[0] = 0.0;
    s.omega[1] = phi * sin(s.theta) * (1.0 + uniform(-1.0, 1.0) * log_uniform(-12.0, -1.0));
    break;
  }
  case 7: /* a rod, or a plate */ s.i3 = rand() % 2 ? 0.0 : 2.0; break;
  case 8: /* weak gravity */ weight *= log_uniform(-12.0, -2.0); break;
  case 9: /* fast */ s.omega[2] *= 30.0; break;
  case 10: /* wheels */
    s.wheels = uniform(-1.0, 1.0) * log_uniform(-2.0, 1.3);
    if (rand() % 3 == 0) s.theta = rand() % 2 ? 0.0 : 0x1.921fb54442d18p+1;
    break;
  default: /* fast wheels in a body that is let go */
    s.wheels = uniform(-1.0, 1.0) * log_uniform(-1.0, 2.8);
    for (int i = 0; i < 3; i++) s.omega[i] *= rand() % 3 ? 0.0 : 0.1;
  }
  s.weight = weight;
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

/* ---- scenes as a user gives them ------------------------------------------------------------- */

enum { GIVEN = 4 };
static const char *const given_names[GIVEN] = {"axis and angle", "Euler angles z-x-z", "quaternion",
                                               "hanging"};

/* The attitude in quadruple precision, and as the package makes it of the same numbers. */
static void attitude(int kind, quad q[4], double rounded[4]) {
  quad length = 0;
  if (kind == 1) {
    const rot_euler order = {{2, 0, 2}, 1};
    const double x[3] = {uniform(-3.0, 3.0), uniform(0.05, 3.09), uniform(-3.0, 3.0)};
    const quad c = cosq((quad)x[1] / 2), s = sinq((quad)x[1] / 2);
    const quad sum = ((quad)x[0] + x[2]) / 2, difference = ((quad)x[0] - x[2]) / 2;
    (void)rot_attitude_from(ROT_FORM_EULER, x, &order, rounded);
    q[0] = c * cosq(sum), q[1] = s * cosq(difference), q[2] = s * sinq(difference);
    q[3] = c * sinq(sum);
    return;
  }
  double x[4];
  for (int i = 0; i < 4; i++) x[i] = uniform(-1.0, 1.0);
  if (kind == 2) {
    (void)rot_attitude_from(ROT_FORM_QUATERNION, x, NULL, rounded);
    for (int i = 0; i < 4; i++) length += (quad)x[i] * x[i];
    for (int i = 0; i < 4; i++) q[i] = x[i] / sqrtq(length);
    return;
  }
  if (rand() % 3) { /* about a horizontal axis */
    x[2] = 0.0;
    if (rand() % 2) x[0] = 1.0, x[1] = 0.0;
  }
  x[3] = uniform(0.05, 3.09);
  (void)rot_attitude_from(ROT_FORM_AXIS_ANGLE, x, NULL, rounded);
  for (int i = 0; i < 3; i++) length += (quad)x[i] * x[i];
  q[0] = cosq((quad)x[3] / 2);
  for (int i = 0; i < 3; i++) q[1 + i] = sinq((quad)x[3] / 2) * x[i] / sqrtq(length);
}

/* Mass, gravity, length and attitude are rounded before the motion begins: up to 1e9 rad. */
static int as_given(int scenes) {
  int missed = 0, later = 0;
  double worst[GIVEN] = {0}, above[GIVEN] = {0}, least[GIVEN], most[GIVEN] = {0};
  for (int k = 0; k < GIVEN; k++) least[k] = INFINITY;
  for (int k = 0; k < scenes; k++) {
    const int kind = k % GIVEN, axis = rand() % 3;
    const double i1 = log_uniform(-3.0, 1.0), mass = uniform(0.1, 2.0), gravity = 9.80665;
    const double length = uniform(0.02, 0.5) * sqrt(i1 / mass) * (kind == 3 ? -1.0 : 1.0);
    scene s = {i1, i1 * uniform(0.05, 1.9), (quad)mass * gravity * length, 0.0, 0.0, {0}, 0.0};
    const double pace = sqrt(fabs((double)s.weight) / i1);
    const int released = rand() % 2;
    s.omega[2] = uniform(-1.0, 1.0) * log_uniform(-1.0, 1.5) * pace;
    for (int i = 0; i < 2; i++) s.omega[i] = released ? 0.0 : uniform(-1.0, 1.0) * pace;
    quad first[STATE], y[STATE];
    rot_free_params p;
    memset(&p, 0, sizeof p);
    attitude(kind, first, p.q0);
    double centre[3] = {0.0, 0.0, 0.0};
    centre[axis] = length;
    p.axes[0] = 1.0;
    for (int i = 0; i < 3; i++) { /* the top's axes 1, 2, 3 are axis + 1, axis + 2, axis */
      p.moment_kg_m2[(axis + 1 + i) % 3] = i < 2 ? s.i1 : s.i3;
      p.omega0_rad_per_s[(axis + 1 + i) % 3] = s.omega[i];
      p.lever_n_m[i] = mass * gravity * centre[i];
      first[4 + i] = s.omega[i];
    }
    rot_pivot_sharpen(&p, mass, gravity, centre);
    /* the attitude of the top's axes: q turn; turn_0 = 1/2, as are the others for axes x and y */
    const double *turn = rot_pivot_turns[axis];
    const quad a = first[0], b = first[1], c = first[2], d = first[3];
    first[0] = a * turn[0] - b * turn[1] - c * turn[2] - d * turn[3];
    first[1] = a * turn[1] + b * turn[0] + c * turn[3] - d * turn[2];
    first[2] = a * turn[2] + c * turn[0] + d * turn[1] - b * turn[3];
    first[3] = a * turn[3] + d * turn[0] + b * turn[2] - c * turn[1];
    nutation by;
    if (!find_nutation(&s, first, &by)) continue;
    double t[1] = {log_uniform(0.0, 9.0) / rate_of(&s)}, cell[14][1];
    const rot_free_columns out = {cell[0],  cell[1],  cell[2],  cell[3], cell[4],
                                  cell[5],  cell[6],  cell[7],  cell[8], cell[9],
                                  cell[10], cell[11], cell[12], cell[13]};
    rot_info info;
    memcpy(y, first, sizeof y);
    repeat(&s, &by, floorq(t[0] / by.period), t[0], y);
    if (rot_pivot_top(&p, 1, t, &out, NULL, NULL, &info) != ROT_OK) {
      printf("as given: scene %d failed\n", k);
      missed++;
      continue;
    }
    double q[4], want[4], off = 0.0;
    for (int i = 0; i < 4; i++) q[i] = cell[i][0];
    for (int i = 0; i < 4; i++) {
      want[i] = (double)y[i];
      if (i < 3) off = hypot(off, (double)(cell[4 + (axis + 1 + i) % 3][0] - y[4 + i]));
    }
    double top[4];
    rot_attitude_times(q, turn, top);
    const double angle = rot_attitude_angle(top, want), phase = t[0] * rate_of(&s);
    const double bound = info.measure[ROT_FREE_ATTITUDE].error;
    const double ratio = fmax(angle / bound, off / info.measure[ROT_FREE_OMEGA].error);
    const double size = bound / (0x1p-52 * (100.0 + phase)); /* beside a rounding of the phase */
    later++;
    worst[kind] = fmax(worst[kind], ratio);
    least[kind] = fmin(least[kind], size);
    above[kind] = fmax(above[kind], size);
    most[kind] = fmax(most[kind], angle);
    if (ratio <= 1.0) continue;
    missed++;
    printf("missed: %s, scene %d, %.3g of the bound %.2e after %.1e rad\n", given_names[kind], k,
           ratio, bound, phase);
  }
  for (int k = 0; k < GIVEN; k++) {
    printf("%-18s error at most %.1e, %.2f of the bound, which is %.1e to %.1e roundings of the "
           "phase\n",
           given_names[k], most[k], worst[k], least[k], above[k]);
  }
  printf("top as given: %d of %d outside the bound\n", missed, later);
  return missed;
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
    if (rot_top_begin_wheels(s.i1, s.i3, (rot_dd){(double)s.weight, 0.0}, (rot_dd){s.wheels, 0.0},
                             &start, 0.0, &motion) != ROT_OK) {
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
          names[kind], worse, now.q_error, s.i3, (double)s.weight, s.wheels, s.theta, s.omega[0],
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
  missed += as_given(scenes);
  return missed != 0;
}
