/* Free bodies by the integrator alone: a quaternion (scalar first, body to space) and the angular
 * momentum in body axes, as groups with norms of their own; the projection. */
#include <stdlib.h>

#include "long_double.h"
#include "engine/ode/ode.h"
#include "ground/real.h"
#include "rot_test.h"

enum { DIM = 7 };

static const rot_ode_group groups[] = {{0, 4, ROT_ODE_QUATERNION}, {4, 3, ROT_ODE_VECTOR}};

typedef struct body {
  double inertia[3];
  long calls, projections;
} body;

#define FREE_BODY(name, real)                                                                      \
  static void name(const double inertia[3], const real y[], real f[]) {                            \
    const real *q = y, *L = y + 4;                                                                 \
    const real w[3] = {L[0] / inertia[0], L[1] / inertia[1], L[2] / inertia[2]};                   \
    f[0] = (-q[1] * w[0] - q[2] * w[1] - q[3] * w[2]) / 2;                                         \
    f[1] = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;                                          \
    f[2] = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;                                          \
    f[3] = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;                                          \
    f[4] = L[1] * w[2] - L[2] * w[1];                                                              \
    f[5] = L[2] * w[0] - L[0] * w[2];                                                              \
    f[6] = L[0] * w[1] - L[1] * w[0];                                                              \
  }
FREE_BODY(free_body, double)
FREE_BODY(long_free_body, long double)

static rot_status rhs(double t, const double y[], double f[], void *ctx) {
  body *b = ctx;
  (void)t;
  b->calls++;
  free_body(b->inertia, y, f);
  return ROT_OK;
}

static void renormalise(double t, double y[], void *ctx) {
  const double length = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
  (void)t;
  ((body *)ctx)->projections++;
  for (int i = 0; i < 4; i++) y[i] /= length;
}

/* The truth: Gragg's midpoint rule, extrapolated eight times (order 16), in long double. */
static void gragg(const body *b, long double h, long double y[DIM]) {
  enum { LEVELS = 8 };
  long double table[LEVELS][DIM], f[DIM];
  for (int k = 0; k < LEVELS; k++) {
    const int n = 2 * (k + 1);
    const long double step = h / n;
    long double before[DIM], now[DIM];
    long_free_body(b->inertia, y, f);
    for (int c = 0; c < DIM; c++) {
      before[c] = y[c];
      now[c] = y[c] + step * f[c];
    }
    for (int i = 1; i < n; i++) {
      long_free_body(b->inertia, now, f);
      for (int c = 0; c < DIM; c++) {
        const long double next = before[c] + 2 * step * f[c];
        before[c] = now[c];
        now[c] = next;
      }
    }
    long_free_body(b->inertia, now, f);
    for (int c = 0; c < DIM; c++) table[k][c] = (now[c] + before[c] + step * f[c]) / 2;
    for (int j = k - 1; j >= 0; j--) {
      const long double ratio = (long double)(k + 1) / (j + 1);
      for (int c = 0; c < DIM; c++) {
        table[j][c] = table[j + 1][c] + (table[j + 1][c] - table[j][c]) / (ratio * ratio - 1);
      }
    }
  }
  for (int c = 0; c < DIM; c++) y[c] = table[0][c];
}

static rot_ode_params problem(body *b, const double start[], double accuracy, rot_method method) {
  const rot_ode_params p = {.dim = DIM,
                            .controlled = DIM,
                            .n_groups = 2,
                            .groups = groups,
                            .rhs = rhs,
                            .ctx = b,
                            .start = start,
                            .accuracy = accuracy,
                            .max_steps = 100000,
                            .method = method};
  return p;
}

/* Angle between two attitudes. */
static double angle(const double q[4], const double p[4]) {
  double plus = 0.0, minus = 0.0;
  for (int i = 0; i < 4; i++) {
    plus += (q[i] + p[i]) * (q[i] + p[i]);
    minus += (q[i] - p[i]) * (q[i] - p[i]);
  }
  return 4.0 * asin(0.5 * sqrt(fmin(plus, minus)));
}

/* L in space axes: q L q*. */
static void to_space(const double y[DIM], double out[3]) {
  const double *q = y, *v = y + 4;
  const double c[3] = {q[2] * v[2] - q[3] * v[1] + q[0] * v[0],
                       q[3] * v[0] - q[1] * v[2] + q[0] * v[1],
                       q[1] * v[1] - q[2] * v[0] + q[0] * v[2]};
  out[0] = v[0] + 2.0 * (q[2] * c[2] - q[3] * c[1]);
  out[1] = v[1] + 2.0 * (q[3] * c[0] - q[1] * c[2]);
  out[2] = v[2] + 2.0 * (q[1] * c[1] - q[2] * c[0]);
}

/* Spun about x alone: two components of q and of L stay at zero, or at rounding about it. Turned by
 * a start attitude they are rounding, not zero. */
static void check_spin_about_an_axis(void) {
  const double start[2][DIM] = {{1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0},
                                {0.6, 0.0, 0.8, 0.0, 2.0, 0.0, 0.0}};
  enum { ROWS = 50 };
  double t[ROWS], y[ROWS * DIM], error[2], largest[2];
  for (int i = 0; i < ROWS; i++) t[i] = i - 10.0;
  for (int k = 0; k < 4; k++) {
    body b = {{1.0, 2.0, 3.0}, 0, 0};
    const double *s = start[k / 2];
    const rot_ode_params p = problem(&b, s, 1e-12, k % 2 ? ROT_METHOD_RADAU : ROT_METHOD_NONE);
    rot_info info;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK_EQ_INT(info.method, k % 2 ? ROT_METHOD_RADAU : ROT_METHOD_RK8PD);
    double worst = 0.0;
    for (int i = 0; i < ROWS; i++) {
      const double c = cos(t[i]), x = sin(t[i]);
      const double want[4] = {s[0] * c, s[0] * x, s[2] * c, -s[2] * x}; /* start times exp(i t) */
      worst = fmax(worst, angle(y + i * DIM, want));
      ROT_CHECK_ULP(y[i * DIM + 4], 2.0, 4);
      ROT_CHECK(y[i * DIM + 5] == 0.0 && y[i * DIM + 6] == 0.0);
    }
    printf("spin %d: %ld calls, off by %.1e rad, estimate %.1e\n", k, b.calls, worst, error[0]);
    ROT_CHECK(worst <= error[0] && error[0] <= 1e-12);
    ROT_CHECK(largest[0] == 1.0);
    ROT_CHECK_REL(largest[1], 2.0, 1e-12);
  }
}

/* I = (1, 2, 3) spun about the middle axis, a little off: it turns over again and again, and
 * magnifies a change of the start by 4e-16 to 2e-12. Beyond the sum of all such changes no error is
 * held. */
static void check_tumbling(void) {
  if (!long_double_is_longer("a tumbling body")) return;
  const double start[DIM] = {1.0, 0.0, 0.0, 0.0, 0.01, 4.0, 0.03};
  enum { ROWS = 100 };
  static double t[ROWS], y[ROWS * DIM];
  static long double want[ROWS][DIM];
  long double now[DIM];
  double error[2], largest[2];
  body b = {{1.0, 2.0, 3.0}, 0, 0};
  for (int c = 0; c < DIM; c++) now[c] = start[c];
  for (int i = 0; i < ROWS; i++) {
    t[i] = i + 1.0;
    for (int k = 0; k < 10; k++) gragg(&b, 0.1L, now);
    for (int c = 0; c < DIM; c++) want[i][c] = now[c];
  }
  /* In 113 bits half an ulp of L at the start moves the motion by 1.6e-12. Some 1800 steps: the
   * square root of their number, and some 16 roundings in each. */
  const double held = 700.0 * 1.6e-12;
  double before[3];
  to_space(start, before);
  const double energy = 0.5 * (0.01 * 0.01 + 16.0 / 2.0 + 0.03 * 0.03 / 3.0);
  for (int k = 0; k < 8; k++) {
    const double accuracy = pow(10.0, -6 - 2 * (k / 2));
    rot_ode_params p = problem(&b, start, accuracy, ROT_METHOD_NONE);
    rot_info info;
    p.project = k % 2 ? renormalise : NULL;
    b.calls = b.projections = 0;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    double worst = 0.0, momentum = 0.0, lost = 0.0, in_space = 0.0, length = 0.0;
    for (int i = 0; i < ROWS; i++) {
      const double *row = y + i * DIM;
      double q[4], difference = 0.0, space[3];
      for (int c = 0; c < 4; c++) q[c] = (double)want[i][c];
      for (int c = 4; c < DIM; c++) difference += pow((double)(row[c] - want[i][c]), 2);
      to_space(row, space);
      worst = fmax(worst, angle(row, q));
      momentum = fmax(momentum, sqrt(difference));
      for (int c = 0; c < 3; c++) in_space = fmax(in_space, fabs(space[c] - before[c]));
      lost =
          fmax(lost, fabs(0.5 * (row[4] * row[4] + row[5] * row[5] / 2.0 + row[6] * row[6] / 3.0) -
                          energy));
      length = fmax(length, fabs(row[0] * row[0] + row[1] * row[1] + row[2] * row[2] +
                                 row[3] * row[3] - 1.0));
    }
    printf("tumbling 1e-%02d%s: %ld calls, off by %.1e rad (estimate %.1e), L %.1e (%.1e), energy "
           "%.1e, L in space %.1e, length %.1e\n",
           6 + 2 * (k / 2), k % 2 ? " projected" : "", b.calls, worst, error[0], momentum, error[1],
           lost, in_space, length);
    ROT_CHECK(worst <= error[0] && momentum <= error[1]);
    ROT_CHECK(worst <= accuracy + held && momentum <= 4.1 * (accuracy + held));
    ROT_CHECK(error[0] <= accuracy + 2.0 * held && error[1] <= 4.1 * (accuracy + 2.0 * held));
    ROT_CHECK(lost <= 10.0 * accuracy && in_space <= 20.0 * accuracy);
    if (k % 2) {
      ROT_CHECK(b.projections > 0 && length <= 8.0 * ROT_EPS);
    }
  }
}

/* A projection that moves what the integration did not err: its moves are the error reported (less
 * that of the row itself, which comes on top). */
static void tamper(double t, double y[], void *ctx) {
  (void)t;
  ((body *)ctx)->projections++;
  y[4] *= 1.0 + 1e-7;
}

static void check_projection_counts(void) {
  const double start[DIM] = {1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0}, t = 10.0;
  double y[DIM], error[2], largest[2];
  body b = {{1.0, 2.0, 3.0}, 0, 0};
  rot_ode_params p = problem(&b, start, 1e-9, ROT_METHOD_NONE);
  rot_info info;
  p.project = tamper;
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
  ROT_CHECK(y[4] > 2.0 && error[1] >= 0.97 * fabs(y[4] - 2.0));
}

/* The same motion twice: the same to the last bit. */
static void check_repeatable(void) {
  const double start[DIM] = {1.0, 0.0, 0.0, 0.0, 0.3, 4.0, -1.0}, t[] = {-3.0, 0.5, 20.0};
  double y[2][3 * DIM], error[2], largest[2];
  for (int k = 0; k < 2; k++) {
    body b = {{1.0, 2.0, 3.0}, 0, 0};
    rot_ode_params p = problem(&b, start, 1e-9, ROT_METHOD_NONE);
    rot_info info;
    p.project = renormalise;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 3, t, y[k], NULL, error, largest, NULL, &info), ROT_OK);
  }
  ROT_CHECK(memcmp(y[0], y[1], sizeof y[0]) == 0);
}

int main(void) {
  check_spin_about_an_axis();
  check_tumbling();
  check_projection_counts();
  check_repeatable();
  return rot_test_report("ode_attitude");
}
