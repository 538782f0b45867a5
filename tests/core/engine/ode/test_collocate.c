/* Collocation in the steps of the run that chose them. The truth is a motion that was written down
 * first: the law is what makes it one. */
#include <stdlib.h>

#include "engine/ode/ode.h"
#include "rot_test.h"

/* theta = a cos(p t) + b sin(q t) with a pendulum's law; from `kink_s` on, with `bend` or `jump` of
 * the acceleration of a spring instead of the pendulum. */
typedef struct law {
  double bend, jump, kink_s;
  double stop, at;        /* a spring beside, beyond theta = at; 0: none */
  size_t calls, fails_at; /* fails_at: the call that has no value; 0: none */
  rot_status failure;
  int on_break;
} law;

enum { THETA, OMEGA, WORK, IMPULSE, DIM };

static double motion(double t, int derivative) {
  const double a = 0.8, p = 1.3, b = 0.3, q = 2.1;
  if (derivative == 0) return a * cos(p * t) + b * sin(q * t);
  if (derivative == 1) return -a * p * sin(p * t) + b * q * cos(q * t);
  return -a * p * p * cos(p * t) - b * q * q * sin(q * t);
}

static rot_status slope(double t, const double y[], double f[], void *ctx) {
  law *l = ctx;
  if (++l->calls == l->fails_at) return l->failure;
  l->on_break |= t == l->kink_s;
  double torque = motion(t, 2);
  if (l->bend != 0.0 || l->jump != 0.0) {
    torque += motion(t, 0) - y[THETA];
    if (t > l->kink_s) torque += l->jump + l->bend * (t - l->kink_s);
  } else {
    torque += 2.0 * sin(motion(t, 0)) - 2.0 * sin(y[THETA]);
  }
  if (l->stop != 0.0)
    torque -= l->stop * (fmax(y[THETA] - l->at, 0.0) - fmax(motion(t, 0) - l->at, 0.0));
  f[THETA] = y[OMEGA];
  f[OMEGA] = torque;
  f[WORK] = torque * y[OMEGA];
  f[IMPULSE] = torque;
  return ROT_OK;
}

/* Theta and omega. Beyond the kink x'' = -x + jump + bend (t - kink). */
static void truth(const law *l, double t, double y[2]) {
  const double d = fmax(0.0, t - l->kink_s);
  y[0] = motion(t, 0) + l->jump * (1.0 - cos(d)) + l->bend * (d - sin(d));
  y[1] = motion(t, 1) + l->jump * sin(d) + l->bend * (1.0 - cos(d));
}

enum { ROWS = 201 };

static double resolution = 0.0; /* of the runs to come */

typedef struct result {
  rot_info info;
  double y[ROWS * DIM], slope[ROWS], error[DIM], largest[DIM];
  double off, over; /* largest error, of the size; of its estimate */
  size_t calls;
} result;

static rot_status solve(law *l, double from, double accuracy, int expensive, int told,
                        const rot_hooks *hooks, result *out) {
  double t[ROWS];
  const double start[DIM] = {motion(from, 0), motion(from, 1), 0.0, 0.0};
  const rot_ode_params p = {.dim = DIM,
                            .controlled = 2,
                            .rhs = slope,
                            .ctx = l,
                            .n_breaks = told ? 1 : 0,
                            .breaks = &l->kink_s,
                            .start_s = from,
                            .start = start,
                            .accuracy = accuracy,
                            .max_steps = 100000,
                            .sloped = IMPULSE,
                            .resolution = resolution,
                            .expensive = expensive};
  for (size_t i = 0; i < ROWS; i++) t[i] = 0.1 * (double)i;
  l->calls = 0;
  const rot_status status =
      rot_ode_run(&p, ROWS, t, out->y, out->slope, out->error, out->largest, hooks, &out->info);
  out->off = out->over = 0.0;
  out->calls = l->calls;
  for (size_t i = 0; i < ROWS && status == ROT_OK; i++) {
    double y[2];
    truth(l, t[i], y);
    for (size_t k = 0; k < 2; k++) {
      const double off = fabs(out->y[i * DIM + k] - y[k]);
      out->off = fmax(out->off, off / out->largest[k]);
      out->over = fmax(out->over, off / out->error[k]);
    }
  }
  return status;
}

/* From the start, from the middle to both sides, from the end backward. */
static void check_smooth(void) {
  static result cheap, out;
  for (int decades = 8; decades <= 13; decades++) {
    for (double from = 0.0; from <= 20.0; from += 10.0) {
      const double accuracy = pow(10.0, -decades);
      law l = {.kink_s = 1e9};
      ROT_CHECK_EQ_INT(solve(&l, from, accuracy, 0, 0, NULL, &cheap), ROT_OK);
      ROT_CHECK_EQ_INT(solve(&l, from, accuracy, 1, 0, NULL, &out), ROT_OK);
      printf("smooth, 1e-%d, from %g: off by %.1e, %.2f of the estimate, %zu calls, %zu by steps\n",
             decades, from, out.off, out.over, out.calls, cheap.calls);
      ROT_CHECK(out.off <= accuracy && out.over <= 1.0);
      ROT_CHECK(out.calls == out.info.rhs_calls);
      ROT_CHECK((double)out.calls <= (decades == 8 ? 0.95 : 0.7) * (double)cheap.calls);
      /* The integrals beside the state: the impulse is what omega gained. */
      const double gained = out.y[(ROWS - 1) * DIM + OMEGA] - out.y[OMEGA];
      const double impulse = out.y[(ROWS - 1) * DIM + IMPULSE] - out.y[IMPULSE];
      ROT_CHECK(fabs(gained - impulse) <= 2.0 * (out.error[OMEGA] + out.error[IMPULSE]));
      /* The torque of the rows is asked for where the law is looked at. */
      size_t seen = 0;
      resolution = ROT_ODE_RESOLUTION;
      ROT_CHECK_EQ_INT(solve(&l, from, accuracy, 1, 0, NULL, &out), ROT_OK);
      resolution = 0.0;
      for (size_t i = 1; i + 1 < ROWS; i++) {
        if (isnan(out.slope[i])) continue;
        seen++;
        ROT_CHECK(fabs(out.slope[i] - motion(0.1 * (double)i, 2)) <= 10.0 * accuracy);
      }
      ROT_CHECK(seen >= ROWS - 4);
    }
  }
}

/* A break is met, and not called. */
static void check_break(void) {
  static result out;
  for (double jump = 0.0; jump <= 3.0; jump += 3.0) {
    law l = {.jump = jump, .bend = 2.0, .kink_s = 6.543};
    ROT_CHECK_EQ_INT(solve(&l, 0.0, 1e-9, 1, 1, NULL, &out), ROT_OK);
    printf("break, jump %g: off by %.1e, %.2f of the estimate, %zu calls\n", jump, out.off,
           out.over, out.calls);
    ROT_CHECK(out.off <= 1e-9 && out.over <= 1.0 && !l.on_break && out.calls < 2200);
  }
}

/* Kinks that nothing marks, some of which fall between the nodes: the estimate covers them as often
 * as that of a finer run does. */
static void check_kinks(void) {
  static result out;
  for (double bend = 1e-6; bend < 2.0; bend *= 10.0) {
    size_t covered[2] = {0, 0};
    double worst[2] = {0.0, 0.0};
    for (int i = 0; i < 120; i++) {
      const int expensive = i % 2;
      law l = {.bend = bend, .kink_s = 0.37 + 0.3137 * (double)(i / 2)};
      ROT_CHECK_EQ_INT(solve(&l, 0.0, 1e-9, expensive, 0, NULL, &out), ROT_OK);
      covered[expensive] += out.over <= 1.0;
      worst[expensive] = fmax(worst[expensive], out.over);
    }
    printf("kinks of %.0e: %zu of 60 covered, the worst by %.2g; %zu and %.2g by steps\n", bend,
           covered[1], worst[1], covered[0], worst[0]);
    ROT_CHECK(covered[1] + 1 >= covered[0] && worst[1] <= fmax(1.0, 1.01 * worst[0]));
  }
}

/* A spring that is met at an angle, again and again: a surface from its first meeting on. */
static void check_surface(void) {
  static result cheap, out;
  for (int decades = 8; decades <= 12; decades += 2) {
    for (double at = -0.5; at < 0.9; at += 0.25) {
      const double accuracy = pow(10.0, -decades);
      law l = {.kink_s = 1e9, .stop = 3.0, .at = at};
      ROT_CHECK_EQ_INT(solve(&l, 0.0, accuracy, 0, 0, NULL, &cheap), ROT_OK);
      ROT_CHECK_EQ_INT(solve(&l, 0.0, accuracy, 1, 0, NULL, &out), ROT_OK);
      printf("spring at %g, 1e-%d: off by %.1e, %.2f of the estimate, %zu calls, %zu by steps\n",
             at, decades, out.off, out.over, out.calls, cheap.calls);
      ROT_CHECK(out.off <= 2.0 * accuracy && out.over <= 1.0);
    }
  }
}

/* A call without a value in a sweep: other steps. An error of the caller: no call more. */
static void check_failures(void) {
  static result out;
  law l = {.kink_s = 1e9};
  ROT_CHECK_EQ_INT(solve(&l, 0.0, 1e-9, 1, 0, NULL, &out), ROT_OK);
  const size_t late = out.calls - 100;
  l.fails_at = late;
  l.failure = ROT_ERHS;
  ROT_CHECK_EQ_INT(solve(&l, 0.0, 1e-9, 1, 0, NULL, &out), ROT_OK);
  ROT_CHECK(out.off <= 1e-9 && out.over <= 1.0 && out.calls > late + 1000);
  l.failure = ROT_EUNWIND;
  ROT_CHECK_EQ_INT(solve(&l, 0.0, 1e-9, 1, 0, NULL, &out), ROT_EUNWIND);
  ROT_CHECK(out.calls == late && out.info.rows_done == 0);
}

int main(void) {
  check_smooth();
  check_break();
  check_kinks();
  check_surface();
  check_failures();
  return rot_test_report("ode_collocate");
}
