/* Kinks of the right-hand side in the state: found, stepped over, and covered by the estimate. The
 * truth is the same motion with an event at each kink, where the law changes its mode. */
#include <stdint.h>
#include <stdlib.h>

#include "engine/ode/ode.h"
#include "rot_test.h"

/* An oscillator with a stop at `at`, smooth beyond and before, driven. With `mode` set the law is
 * that of one side, whatever y is. */
typedef struct law {
  double stiffness, stop, at, drive, rate, damping;
  const int *mode;
  size_t calls;
} law;

static rot_status stopped(double t, const double y[], double f[], void *ctx) {
  law *l = ctx;
  const double in = y[0] - l->at;
  l->calls++;
  f[0] = y[1];
  f[1] = -l->stiffness * y[0] - l->damping * y[1] + l->drive * cos(l->rate * t);
  if (l->mode ? *l->mode > 0 : in > 0.0) f[1] -= l->stop * in;
  return ROT_OK;
}

static double depth(double t, const double y[], void *ctx) {
  (void)t;
  return y[0] - ((const law *)ctx)->at;
}

static rot_ode_then change(double t, double y[], int *mode, int forward, void *ctx) {
  (void)t;
  (void)y;
  (void)forward;
  (void)ctx;
  *mode = -*mode;
  return ROT_ODE_NEW_SEGMENT;
}

static double uniform(uint64_t *seed) {
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(*seed >> 11) / 9007199254740992.0;
}

enum { ROWS = 101 };

/* The largest error over the estimate; counts the calls. NaN where the truth is in doubt: its event
 * may be missed where the motion only just touches the kink. */
static double one(const law *l, const double start[2], double accuracy, int backward,
                  size_t *calls) {
  double t[ROWS], y[2 * ROWS], truth[2 * ROWS], error[2], largest[2], unused[2];
  rot_info info;
  law with_mode = *l, plain = *l;
  int mode = start[0] > l->at ? 1 : -1;
  const rot_ode_event event = {depth, 0, 0, ROT_EVENT_REVERSE, change, NULL, 0};
  with_mode.mode = &mode;
  for (int i = 0; i < ROWS; i++) t[i] = 0.2 * (backward ? i - (ROWS - 1) : i);
  rot_ode_params p = {.dim = 2,
                      .controlled = 2,
                      .rhs = stopped,
                      .ctx = &with_mode,
                      .start = start,
                      .accuracy = 1e-13,
                      .max_steps = 100000,
                      .method = ROT_METHOD_RK8PD,
                      .mode = &mode,
                      .n_events = 1,
                      .events = &event};
  ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, truth, NULL, unused, largest, NULL, &info), ROT_OK);
  p.ctx = &plain;
  p.mode = NULL;
  p.n_events = 0;
  ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, y, NULL, error, largest, NULL, &info), ROT_OK);
  for (int i = 0; i < 2 * ROWS; i++) {
    if (!(fabs(y[i] - truth[i]) <= 1e-9 * largest[i % 2])) return NAN;
  }
  plain.calls = 0;
  p.accuracy = accuracy;
  ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, y, NULL, error, largest, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.rhs_calls, plain.calls);
  double worst = 0.0;
  for (int k = 0; k < 2; k++) {
    double off = 0.0;
    for (int i = 0; i < ROWS; i++) off = fmax(off, fabs(y[2 * i + k] - truth[2 * i + k]));
    worst = fmax(worst, fmax(0.0, off - 2.0 * unused[k]) / error[k]);
  }
  *calls += plain.calls;
  return worst;
}

/* At loose accuracies some kinks pass the error test. */
static void check_cover(void) {
  uint64_t seed = 20260;
  for (int a = 3; a <= 12; a += 3) {
    int missed = 0, doubtful = 0, cases = 0;
    double worst = 0.0;
    size_t calls = 0;
    for (; cases < 100; cases++) {
      law l = {1.0 + 4.0 * uniform(&seed), 0.0, 0.0, 0.0, 0.0, 0.0, NULL, 0};
      l.stop = (cases % 4 == 0 ? 300.0 : 5.0) * uniform(&seed);
      l.at = 1.5 * uniform(&seed) - 0.5;
      l.drive = uniform(&seed);
      l.rate = 0.5 + 3.0 * uniform(&seed);
      l.damping = cases % 3 ? 0.0 : 0.3 * uniform(&seed);
      const double start[2] = {2.0 * uniform(&seed) - 1.0, 2.0 * uniform(&seed) - 1.0};
      const double off = one(&l, start, pow(10.0, -a), cases % 5 == 4, &calls);
      if (isnan(off)) {
        doubtful++;
        continue;
      }
      worst = fmax(worst, off);
      if (!(off <= 1.0)) missed++;
    }
    printf("accuracy 1e-%02d: %d of %d missed, %d in doubt, error at most %.2g of the estimate, "
           "%zu calls each\n",
           a, missed, cases, doubtful, worst, calls / (size_t)cases);
    /* Of 1500 cases 4, 40, 11 and 1 are missed; rk8pd with fused products misses 1, 2, 2 and 1 of
     * these 100. */
    ROT_CHECK(missed <= 3 && doubtful <= 5);
  }
}

/* Calls with and without kinks to find, of a motion that meets ten. */
static void check_calls(void) {
  const law l = {2.0, 3.0, 0.5, 0.5, 2.0, 0.0, NULL, 0};
  const double start[] = {0.8, 0.0};
  for (int a = 6; a <= 12; a += 3) {
    size_t calls = 0;
    const double off = one(&l, start, pow(10.0, -a), 0, &calls);
    printf("ten kinks, accuracy 1e-%02d: %zu calls, error %.2g of the estimate\n", a, calls, off);
    ROT_CHECK(off <= 1.0 && calls < (a == 12 ? 9000 : 5000));
  }
}

/* A kink on a line across the state: y'' = -y on one side of y + y'/2 = 0, and -4 y - 3/2 y' on the
 * other. From a state on the line it is back on it after half a period, of the opposite sign, times
 * exp(-3/4 of the time) in the second case. No value of one component is such a line: a step ends
 * near it, and a short one goes over. */
static rot_status oblique(double t, const double y[], double f[], void *ctx) {
  size_t *calls = ctx;
  const double in = y[0] + 0.5 * y[1];
  ++*calls;
  (void)t;
  f[0] = y[1];
  f[1] = -y[0] - (in > 0.0 ? 3.0 * in : 0.0);
  return ROT_OK;
}

static void check_oblique(void) {
  enum { CYCLES = 5 };
  const double pi = acos(-1.0), half = pi / sqrt(4.0 - 0.5625), start[] = {1.0, -2.0};
  const double end = CYCLES * (half + pi), by = exp(-0.75 * CYCLES * half);
  for (int a = 6; a <= 12; a += 3) {
    size_t calls = 0;
    double y[2], error[2], largest[2];
    rot_info info;
    const rot_ode_params p = {.dim = 2,
                              .controlled = 2,
                              .rhs = oblique,
                              .ctx = &calls,
                              .start = start,
                              .accuracy = pow(10.0, -a),
                              .max_steps = 100000,
                              .method = ROT_METHOD_RK8PD};
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &end, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK(fabs(y[0] - by) <= error[0] + 1e-15 && fabs(y[1] + 2.0 * by) <= error[1] + 1e-15);
    ROT_CHECK(calls < 20000); /* 55000 at 1e-12 by the error control alone */
    printf("kinks across the state, accuracy 1e-%02d: %zu calls, off by %.1e of %.1e\n", a, calls,
           fmax(fabs(y[0] - by), fabs(y[1] + 2.0 * by)), error[1]);
  }
}

int main(void) {
  check_oblique();
  check_calls();
  check_cover();
  return rot_test_report("ode_kink");
}
