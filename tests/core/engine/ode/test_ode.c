/* The integrator: order, error estimate against true error, breaks, and every way a run can end. */
#include <stdlib.h>

#include "engine/ode/ode.h"
#include "ground/real.h"
#include "rot_test.h"

/* ---- right-hand sides ----------------------------------------------------------------------- */

/* What a right-hand side is told, and what it saw. */
typedef struct probe {
  double rate;
  long calls, stop_at; /* answers `says` from call stop_at on */
  rot_status says;
  double nan_after; /* gives NaN beyond this time */
  size_t n_breaks;
  const double *breaks;
  long on_a_break;         /* calls at a break's very time */
  double earliest, latest; /* times seen */
} probe;

static probe quiet(double rate) {
  probe p = {rate, 0, -1, ROT_OK, INFINITY, 0, NULL, 0, INFINITY, -INFINITY};
  return p;
}

static rot_status seen(probe *p, double t) {
  p->calls++;
  for (size_t i = 0; i < p->n_breaks; i++) p->on_a_break += t == p->breaks[i];
  p->earliest = fmin(p->earliest, t);
  p->latest = fmax(p->latest, t);
  return p->stop_at >= 0 && p->calls >= p->stop_at ? p->says : ROT_OK;
}

static double or_nan(const probe *p, double t, double value) {
  return t > p->nan_after ? NAN : value;
}

/* y'' = -rate^2 y */
static rot_status oscillator(double t, const double y[], double dydt[], void *ctx) {
  probe *p = ctx;
  dydt[0] = y[1];
  dydt[1] = or_nan(p, t, -p->rate * p->rate * y[0]);
  return seen(p, t);
}

/* y'' = -sin y */
static rot_status pendulum(double t, const double y[], double dydt[], void *ctx) {
  dydt[0] = y[1];
  dydt[1] = -sin(y[0]);
  return seen(ctx, t);
}

/* y' = -rate y */
static rot_status decay(double t, const double y[], double dydt[], void *ctx) {
  probe *p = ctx;
  dydt[0] = or_nan(p, t, -p->rate * y[0]);
  return seen(p, t);
}

/* y' = -2 t y^2, y = 1/(1 + t^2) from y(0) = 1 */
static rot_status bell(double t, const double y[], double dydt[], void *ctx) {
  dydt[0] = -2.0 * t * y[0] * y[0];
  return seen(ctx, t);
}

/* y' = rate (y - sin t) + cos t: sin t itself, off which every error grows by exp(rate t) */
static rot_status unstable(double t, const double y[], double dydt[], void *ctx) {
  const probe *p = ctx;
  dydt[0] = p->rate * (y[0] - sin(t)) + cos(t);
  return seen(ctx, t);
}

/* y' = y^2: 1/(1 - t), which leaves at 1 */
static rot_status explosion(double t, const double y[], double dydt[], void *ctx) {
  dydt[0] = y[0] * y[0];
  return seen(ctx, t);
}

/* Jumps at the breaks, and t^7 between them: 2 + 8 t^7, then -3, then 5, then NaN at a break. */
static const double jump_s[] = {-0.5, 1.1, 2.3};
static rot_status jumps(double t, const double y[], double dydt[], void *ctx) {
  (void)y;
  dydt[0] = t < -0.5 ? -4.0 : t < 1.1 ? 2.0 + 8.0 * pow(t, 7) : t < 2.3 ? -3.0 : 5.0;
  for (int i = 0; i < 3; i++) dydt[0] = t == jump_s[i] ? NAN : dydt[0];
  return seen(ctx, t);
}

static double jumps_solved(double t) {
  const double at_low = -1.0 + pow(0.5, 8), at_mid = 2.2 + pow(1.1, 8), at_high = at_mid - 3.6;
  return t < -0.5  ? at_low - 4.0 * (t + 0.5)
         : t < 1.1 ? 2.0 * t + pow(t, 8)
         : t < 2.3 ? at_mid - 3.0 * (t - 1.1)
                   : at_high + 5.0 * (t - 2.3);
}

/* ---- helpers -------------------------------------------------------------------------------- */

enum { MAX = 4096 };

typedef struct outcome {
  double y[MAX], error[4], largest[4];
  rot_status status;
  rot_info info;
} outcome;

static outcome result;

static rot_ode_params problem(size_t dim, rot_ode_rhs rhs, probe *ctx, const double start[],
                              double accuracy) {
  rot_ode_params p = {.dim = dim,
                      .controlled = dim,
                      .rhs = rhs,
                      .ctx = ctx,
                      .start = start,
                      .accuracy = accuracy,
                      .max_steps = 1000000};
  return p;
}

static void run(const rot_ode_params *p, size_t n, const double time_s[], const rot_hooks *hooks) {
  memset(&result, 0x5a, sizeof result);
  result.status =
      rot_ode_run(p, n, time_s, result.y, NULL, result.error, result.largest, hooks, &result.info);
  ROT_CHECK_EQ_INT(result.status, result.info.status);
}

/* ---- errors --------------------------------------------------------------------------------- */

/* Order 8: the error against the steps that were taken, over three decades of accuracy; 9 where the
 * leading term happens to cancel. */
static void check_order(void) {
  enum { ROWS = 40 };
  double steps[2], error[2], t[ROWS];
  for (int i = 0; i < ROWS; i++) t[i] = i + 1.0;
  for (int k = 0; k < 2; k++) {
    probe seen_by = quiet(1.0);
    const double start[] = {1.0, 0.0};
    const rot_ode_params p = problem(2, pendulum, &seen_by, start, k == 0 ? 1e-9 : 1e-12);
    run(&p, ROWS, t, NULL);
    ROT_CHECK_EQ_INT(result.status, ROT_OK);
    steps[k] = (double)result.info.steps;
    error[k] = result.error[0];
  }
  const double order = log(error[0] / error[1]) / log(steps[1] / steps[0]);
  printf("order: %.2f\n", order);
  ROT_CHECK(order > 7.5 && order < 9.5);
}

/* True errors against the estimate, and against what was asked for, where the tolerance rules. */
static void check_estimate(void) {
  const double t[] = {1.5, 5.0, 7.7, 10.0};
  const double start[3][2] = {{1.0, 0.0}, {3.0, 0.0}, {1.0, 0.0}};
  const rot_ode_rhs rhs[] = {oscillator, decay, bell};
  double lowest = INFINITY, highest = 0.0;
  for (int k = 0; k < 3; k++) {
    for (double accuracy = 1e-4; accuracy > 0.9e-9; accuracy *= 0.1) {
      probe seen_by = quiet(k == 0 ? 2.0 : 0.7);
      const size_t dim = k == 0 ? 2 : 1;
      const rot_ode_params p = problem(dim, rhs[k], &seen_by, start[k], accuracy);
      run(&p, 4, t, NULL);
      ROT_CHECK_EQ_INT(result.status, ROT_OK);
      ROT_CHECK_EQ_INT(result.info.rows_done, 4);
      double error = 0.0;
      for (size_t i = 0; i < 4; i++) {
        const double want = k == 0   ? cos(2.0 * t[i])
                            : k == 1 ? 3.0 * exp(-0.7 * t[i])
                                     : 1.0 / (1.0 + t[i] * t[i]);
        error = fmax(error, fabs(result.y[i * dim] - want));
      }
      ROT_CHECK(error <= accuracy * result.largest[0]);
      ROT_CHECK(result.error[0] <= accuracy * result.largest[0]);
      lowest = fmin(lowest, result.error[0] / error);
      highest = fmax(highest, result.error[0] / error);
      ROT_CHECK_EQ_INT(result.info.rhs_calls, seen_by.calls);
      if (accuracy > 3e-6) continue; /* more runs, perhaps: long steps need a wide margin */
      /* Steps in three parts where the accuracy asks for small ones, else in halves. */
      const int parts = accuracy < 3e-7 ? 3 : 2;
      const double factor = parts == 3 ? 256.0 * 8.0 / 6561.0 : 10.0 / 32.0;
      ROT_CHECK_REL(result.info.tolerance, factor * accuracy, 1e-12);
      /* Both runs: each one slope, then 13 calls a trial; one or two more for a row. */
      const long trials = (long)result.info.steps * (parts + 1) / parts;
      ROT_CHECK(seen_by.calls >= 2 + 13 * trials && seen_by.calls <= 10 + 15 * trials);
    }
  }
  printf("estimate over true error: %.3f to %.3f\n", lowest, highest);
  ROT_CHECK(lowest >= 1.0 && highest <= 100.0);
}

/* y'' = -a sin y + b cos(d t) - c y' */
typedef struct driven {
  double a, b, c, d;
} driven;

static rot_status drive(double t, const double y[], double dydt[], void *ctx) {
  const driven *s = ctx;
  dydt[0] = y[1];
  dydt[1] = -s->a * sin(y[0]) + s->b * cos(s->d * t) - s->c * y[1];
  return ROT_OK;
}

/* With one row an oscillation may have no difference there, in one of its measures: at accuracies
 * from 1e-2 to 1e-10 the estimate covers both errors in 95 of 100 scenes. */
static void check_estimate_of_one_row(void) {
  enum { SCENES = 100 };
  for (double accuracy = 1e-2; accuracy > 0.5e-10; accuracy *= 1e-2) {
    int missed = 0;
    double worst = 0.0;
    for (int i = 0; i < SCENES; i++) {
      /* Additive recurrences of irrational steps: spread evenly, the same everywhere. */
      const double u = fmod(0.7548776662466927 * i, 1.0), v = fmod(0.5698402909980532 * i, 1.0);
      driven s = {6.0 + 24.0 * u, 3.0 * v, i % 2 ? 0.2 * u : 0.0, 0.5 + 7.0 * v};
      const double start[] = {3.0 * u, 2.0 * v - 1.0}, t = 3.0 + 5.0 * fmod(u + v, 1.0);
      rot_ode_params p = problem(2, drive, NULL, start, 1e-13);
      p.ctx = &s;
      run(&p, 1, &t, NULL);
      const double want[] = {result.y[0], result.y[1]};
      p.accuracy = accuracy;
      run(&p, 1, &t, NULL);
      ROT_CHECK_EQ_INT(result.status, ROT_OK);
      const double over = fmax(fabs(result.y[0] - want[0]) / result.error[0],
                               fabs(result.y[1] - want[1]) / result.error[1]);
      missed += over > 1.0;
      worst = fmax(worst, over);
    }
    printf("one row, %.0e: %d of %d missed, by %.2g at most\n", accuracy, missed, SCENES, worst);
    ROT_CHECK(missed <= SCENES / 20 && worst <= 10.0);
  }
}

/* Dense rows: landed on or filled in, the estimate must not fall silent, nor cry. Forward, then
 * backward. */
static void check_estimate_of_dense_rows(void) {
  const int rows[] = {60, 200, 1000, 2000, -1000};
  for (int k = 0; k < 5; k++) {
    static double t[2000];
    const int n = abs(rows[k]);
    probe seen_by = quiet(2.0);
    const double start[] = {1.0, 0.0};
    const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
    double error = 0.0;
    for (int i = 0; i < n; i++) t[i] = rows[k] > 0 ? 10.0 * (i + 1) / n : 10.0 * (i - n) / n;
    run(&p, (size_t)n, t, NULL);
    ROT_CHECK_EQ_INT(result.status, ROT_OK);
    for (int i = 0; i < n; i++) error = fmax(error, fabs(result.y[2 * i] - cos(2.0 * t[i])));
    printf("%d rows: error %.3g, estimate %.3g\n", n, error, result.error[0]);
    ROT_CHECK(error <= result.error[0]);
    ROT_CHECK(result.error[0] <= 1e-8);
    /* More rows than the steps need are filled in between them. */
    if (n >= 1000) ROT_CHECK(seen_by.calls < 8 * n);
  }
}

/* Where run and companion agree to the last bit, roundings are left: never an estimate of zero. */
static rot_status steady(double t, const double y[], double dydt[], void *ctx) {
  (void)y;
  dydt[0] = 2.0;
  return seen(ctx, t);
}

static void check_estimate_of_roundings(void) {
  const double t[] = {1.0, 3.0}, start[] = {1.0};
  probe seen_by = quiet(0.0);
  const rot_ode_params p = problem(1, steady, &seen_by, start, 1e-9);
  run(&p, 2, t, NULL);
  ROT_CHECK_ULP(result.y[1], 7.0, 4);
  ROT_CHECK(result.error[0] >= ROT_EPS * 7.0 && result.error[0] <= 1e-13);
}

/* The steps that a tolerance costs: tolerance^(-1/8). */
static void check_cost(void) {
  size_t steps[2];
  for (int k = 0; k < 2; k++) {
    const double t = 40.0, start[] = {1.0, 0.0}, accuracy[] = {1e-8, 1e-12};
    probe seen_by = quiet(2.0);
    const rot_ode_params p = problem(2, oscillator, &seen_by, start, accuracy[k]);
    run(&p, 1, &t, NULL);
    steps[k] = result.info.steps;
    ROT_CHECK(result.info.rejected <= result.info.steps / 4);
  }
  ROT_CHECK(5 * steps[1] > 14 * steps[0] && 2 * steps[1] < 7 * steps[0]); /* 3.16 */
  ROT_CHECK(steps[0] < 210);
}

/* Errors that the motion itself blows up by 1e5: the run is made again until they are met. */
static void check_repeated_until_accurate(void) {
  const double t[] = {1.0, 3.0}, start[] = {0.0};
  probe seen_by = quiet(4.0);
  const rot_ode_params p = problem(1, unstable, &seen_by, start, 1e-5);
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK(result.info.tolerance < 1e-7 && result.info.tolerance > 1e-12);
  ROT_CHECK(fabs(result.y[1] - sin(3.0)) <= 1e-5);
  ROT_CHECK(result.error[0] <= 1e-5 * result.largest[0]);
  ROT_CHECK(result.error[0] >= 0.9 * fabs(result.y[1] - sin(3.0)));
}

/* More than doubles can give: it comes back, says so and does not go on for ever. */
static void check_accuracy_out_of_reach(void) {
  const double t[] = {1.0, 5.0}, start[] = {0.0};
  probe seen_by = quiet(4.0);
  const rot_ode_params p = problem(1, unstable, &seen_by, start, 1e-13);
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(result.info.rows_done, 2);
  ROT_CHECK(result.error[0] > 1e-12);
  ROT_CHECK(result.error[0] >= 0.5 * fabs(result.y[1] - sin(5.0)));
}

/* largest: the size on the way, not that of the rows. */
static void check_largest(void) {
  const double t[] = {0.5, 3.14159265358979}, start[] = {0.0, 3.0};
  probe seen_by = quiet(1.0); /* 3 sin t */
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-9);
  run(&p, 2, t, NULL);
  ROT_CHECK(result.largest[0] > 2.5 && result.largest[0] < 3.0 + 1e-8);
  ROT_CHECK_REL(result.largest[1], 3.0, 1e-8);
  const double later = 2.0, one[] = {-3.0};
  const rot_ode_params q = problem(1, decay, &seen_by, one, 1e-9);
  run(&q, 1, &later, NULL);
  ROT_CHECK(result.largest[0] == 3.0);
}

/* ---- time ----------------------------------------------------------------------------------- */

/* Rows before, at and after the start, in one run. */
static void check_backward_and_forward(void) {
  const double t[] = {-4.0, -1.0, -1.0, 2.0, 2.5, 2.5, 6.0}, start[] = {cos(1.0), -sin(1.0)};
  probe seen_by = quiet(1.0);
  rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-10);
  p.start_s = 2.0; /* y = cos(t - 1) */
  run(&p, 7, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(result.info.rows_done, 7);
  ROT_CHECK(result.info.time_s == 6.0);
  for (size_t i = 0; i < 7; i++) {
    ROT_CHECK(fabs(result.y[2 * i] - cos(t[i] - 1.0)) <= 1e-10);
    ROT_CHECK(fabs(result.y[2 * i + 1] + sin(t[i] - 1.0)) <= 1e-10);
  }
  ROT_CHECK(result.y[6] == start[0] && result.y[7] == start[1]); /* the start itself, untouched */
  ROT_CHECK(result.y[2] == result.y[4] && result.y[8] == result.y[10]); /* repeated times */
  /* It asks for nothing outside of what it was asked. */
  ROT_CHECK(seen_by.earliest >= -4.0 && seen_by.latest <= 6.0);
}

/* Time mirrored, or the motion: the same steps to the last bit. */
static void check_mirrors(void) {
  const double t[] = {1.5, 5.0, 7.7, 10.0}, back[] = {-10.0, -7.7, -5.0, -1.5};
  const double start[] = {0.0, 3.0}, mirrored[] = {0.0, -3.0};
  static outcome forward;
  probe seen_by = quiet(2.0);
  rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
  run(&p, 4, t, NULL);
  forward = result;
  for (int k = 0; k < 2; k++) {
    p.start = k == 0 ? start : mirrored;
    run(&p, 4, k == 0 ? back : t, NULL);
    ROT_CHECK_EQ_INT(result.status, ROT_OK);
    ROT_CHECK_EQ_INT(result.info.rows_done, 4);
    ROT_CHECK_EQ_INT(result.info.steps, forward.info.steps);
    ROT_CHECK_EQ_INT(result.info.rejected, forward.info.rejected);
    ROT_CHECK_EQ_INT(result.info.rhs_calls, forward.info.rhs_calls);
    ROT_CHECK(result.error[0] == forward.error[0] && result.error[1] == forward.error[1]);
    ROT_CHECK(result.largest[0] == forward.largest[0]);
    for (size_t i = 0; i < 4; i++) {
      ROT_CHECK(result.y[2 * (k == 0 ? 3 - i : i)] == -forward.y[2 * i]);
    }
  }
}

/* Forward from a time below zero, under a law of time. */
static void check_negative_times(void) {
  const double t[] = {-2.0, -1.0, -0.5}, start[] = {0.1};
  probe seen_by = quiet(0.0);
  rot_ode_params p = problem(1, bell, &seen_by, start, 1e-9);
  p.start_s = -3.0;
  run(&p, 3, t, NULL);
  for (size_t i = 0; i < 3; i++) ROT_CHECK_REL(result.y[i], 1.0 / (1.0 + t[i] * t[i]), 3e-9);
  ROT_CHECK(seen_by.earliest == -3.0 && seen_by.latest == -0.5);
}

/* Nothing moves: no error, and no trouble with a largest value of zero. */
static void check_rest(void) {
  const double t = 10.0, start[] = {0.0, 0.0};
  probe seen_by = quiet(2.0);
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-9);
  run(&p, 1, &t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK(result.y[0] == 0.0 && result.y[1] == 0.0);
  ROT_CHECK(result.error[0] == 0.0 && result.largest[0] == 0.0);
  ROT_CHECK_EQ_INT(result.info.rejected, 0);
}

/* One row backward, one forward: the estimate covers both sides. */
static void check_estimate_of_both_sides(void) {
  const double t[] = {-9.0, 0.1}, start[] = {1.0, 0.0};
  probe seen_by = quiet(2.0);
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-5);
  run(&p, 2, t, NULL);
  const double error = fabs(result.y[0] - cos(18.0));
  ROT_CHECK(result.error[0] >= 0.9 * error && result.error[0] <= 1e-5);
}

static void check_only_the_start(void) {
  const double t[] = {2.0, 2.0}, start[] = {7.0};
  probe seen_by = quiet(1.0);
  rot_ode_params p = problem(1, decay, &seen_by, start, 1e-9);
  p.start_s = 2.0;
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(result.info.rows_done, 2);
  ROT_CHECK_EQ_INT(result.info.steps, 0);
  ROT_CHECK_EQ_INT(seen_by.calls, 0);
  ROT_CHECK(result.y[0] == 7.0 && result.y[1] == 7.0);
}

static void check_no_rows(void) {
  const double start[] = {7.0};
  probe seen_by = quiet(1.0);
  const rot_ode_params p = problem(1, decay, &seen_by, start, 1e-9);
  run(&p, 0, NULL, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(result.info.rows_done, 0);
  ROT_CHECK_EQ_INT(seen_by.calls, 0);
}

/* ---- breaks --------------------------------------------------------------------------------- */

/* Jumps are integrated to rounding, and nobody asks for a value on one: it is NaN there. */
static void check_breaks(void) {
  const double t[] = {-2.0, -0.5, -0.2, 0.0, 0.7, 1.1, 1.1, 1.5, 2.3, 4.0}, start[] = {0.0};
  probe seen_by = quiet(0.0);
  seen_by.n_breaks = 3;
  seen_by.breaks = jump_s;
  rot_ode_params p = problem(1, jumps, &seen_by, start, 1e-10);
  p.n_breaks = 3;
  p.breaks = jump_s;
  run(&p, 10, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(result.info.rows_done, 10);
  ROT_CHECK_EQ_INT(seen_by.on_a_break, 0);
  for (size_t i = 0; i < 10; i++) {
    ROT_CHECK(fabs(result.y[i] - jumps_solved(t[i])) <= 2e-14);
    ROT_CHECK(fabs(result.y[i] - jumps_solved(t[i])) <= result.error[0]); /* roundings count */
  }
  ROT_CHECK(result.info.rejected == 0);
}

/* The same from a start that lies on a break, both ways. */
static void check_start_on_break(void) {
  for (int i = 0; i < 3; i++) {
    const double at = jump_s[i], t[] = {-1.0, 0.3, 1.7, 3.0}, start[] = {jumps_solved(at)};
    probe seen_by = quiet(0.0);
    seen_by.n_breaks = 3;
    seen_by.breaks = jump_s;
    rot_ode_params p = problem(1, jumps, &seen_by, start, 1e-10);
    p.n_breaks = 3;
    p.breaks = jump_s;
    p.start_s = at;
    run(&p, 4, t, NULL);
    ROT_CHECK_EQ_INT(result.status, ROT_OK);
    ROT_CHECK_EQ_INT(seen_by.on_a_break, 0);
    for (size_t j = 0; j < 4; j++) ROT_CHECK(fabs(result.y[j] - jumps_solved(t[j])) <= 2e-14);
  }
}

/* Without rows between, breaks still hold; and a break given twice is one. */
static void check_breaks_between_rows(void) {
  const double twice_s[] = {-0.5, -0.5, 1.1, 1.1, 2.3, 2.3}, t[] = {-2.0, 4.0}, start[] = {0.0};
  probe seen_by = quiet(0.0);
  seen_by.n_breaks = 3;
  seen_by.breaks = jump_s;
  rot_ode_params p = problem(1, jumps, &seen_by, start, 1e-10);
  p.n_breaks = 6;
  p.breaks = twice_s;
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(seen_by.on_a_break, 0);
  ROT_CHECK(fabs(result.y[0] - jumps_solved(-2.0)) <= 2e-14);
  ROT_CHECK(fabs(result.y[1] - jumps_solved(4.0)) <= 2e-14);
  /* A jump that nobody declared is found, too, but costs many steps. */
  const size_t steps = result.info.steps;
  probe blind = quiet(0.0);
  const rot_ode_params q = problem(1, jumps, &blind, start, 1e-10);
  run(&q, 2, t, NULL);
  ROT_CHECK(result.info.rejected > 0 && result.info.steps > 2 * steps);
}

/* ---- components that do not steer ----------------------------------------------------------- */

/* y0' = -y0 steers; y1' = a wave of 1000 rad/s, or NaN, does not. */
static rot_status rider(double t, const double y[], double dydt[], void *ctx) {
  const probe *p = ctx;
  dydt[0] = -y[0];
  dydt[1] = or_nan(p, t, cos(1000.0 * t));
  return seen(ctx, t);
}

static void check_riders(void) {
  const double t = 4.0, start[] = {1.0, 0.0};
  probe alone = quiet(1.0), ridden = quiet(1.0), spoilt = quiet(1.0);
  spoilt.nan_after = 3.0;
  const rot_ode_params p = problem(1, decay, &alone, start, 1e-8);
  run(&p, 1, &t, NULL);
  const size_t steps = result.info.steps;
  const double y = result.y[0];
  rot_ode_params q = problem(2, rider, &ridden, start, 1e-8);
  q.controlled = 1;
  run(&q, 1, &t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK_EQ_INT(result.info.steps, steps);
  ROT_CHECK(result.y[0] == y);
  q.ctx = &spoilt;
  run(&q, 1, &t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK(result.y[0] == y && isnan(result.y[1]));
  q.controlled = 2; /* now it does steer */
  q.ctx = &ridden;
  run(&q, 1, &t, NULL);
  ROT_CHECK(result.info.steps > 20 * steps);
}

/* y1' = cos(rate t) */
static rot_status wave(double t, const double y[], double dydt[], void *ctx) {
  const probe *p = ctx;
  dydt[0] = -y[0];
  dydt[1] = cos(p->rate * t);
  return seen(ctx, t);
}

/* The polynomials between the steps are worse of such a component than the steps are: its error is
 * that of the rows. */
static void check_riders_between_steps(void) {
  enum { ROWS = 25 };
  const double start[] = {1.0, 0.0};
  double t[ROWS];
  int shows = 0;
  for (int i = 0; i < ROWS; i++) t[i] = 0.16 * (i + 1);
  for (int k = 0; k < 20; k++) {
    probe ridden = quiet(4.0 + k);
    rot_ode_params p = problem(2, wave, &ridden, start, 1e-7);
    p.controlled = 1;
    p.integrals_between = 1;
    run(&p, ROWS, t, NULL);
    double off = 0.0, last = 0.0;
    for (int i = 0; i < ROWS; i++) {
      last = fabs(result.y[2 * i + 1] - sin(ridden.rate * t[i]) / ridden.rate);
      off = fmax(off, last);
    }
    shows += off > 10.0 * last;
    ROT_CHECK(off <= result.error[1]);
  }
  ROT_CHECK(shows > 5);
}

/* ---- how a run ends ------------------------------------------------------------------------- */

static void check_nan_later(void) {
  const double t[] = {0.5, 1.0, 2.9, 3.5, 4.0}, start[] = {1.0, 0.0};
  probe seen_by = quiet(1.0);
  seen_by.nan_after = 3.0;
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-9);
  run(&p, 5, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ERHS);
  ROT_CHECK_EQ_INT(result.info.rows_done, 3);
  ROT_CHECK(result.info.time_s > 3.0 && result.info.time_s < 3.0 + 1e-9);
  for (size_t i = 0; i < 3; i++) ROT_CHECK(fabs(result.y[2 * i] - cos(t[i])) <= 1e-9);
  ROT_CHECK(result.error[0] < 1e-9);
}

/* In the first component as in the last. */
static void check_nan_in_first(void) {
  const double t[] = {0.5, 4.0}, start[] = {1.0};
  probe seen_by = quiet(1.0);
  seen_by.nan_after = 3.0;
  const rot_ode_params p = problem(1, decay, &seen_by, start, 1e-9);
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ERHS);
  ROT_CHECK(fabs(result.info.time_s - 3.0) < 1e-9);
}

static void check_nan_everywhere(void) {
  const double t[] = {0.0, 1.0, 2.0}, start[] = {1.0, 0.0};
  probe seen_by = quiet(1.0);
  seen_by.nan_after = -1.0;
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-9);
  run(&p, 3, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ERHS);
  ROT_CHECK_EQ_INT(result.info.rows_done, 1); /* the start needs no torque */
  ROT_CHECK(result.info.time_s == 0.0);
  ROT_CHECK(seen_by.calls < 10);
  run(&p, 2, t + 1, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ERHS);
  ROT_CHECK_EQ_INT(result.info.rows_done, 0);
}

/* Failing on the way back promises no row at all: the first rows are the last to be reached. */
static void check_nan_backward(void) {
  const double t[] = {-6.0, -4.5, -2.0, 1.0}, start[] = {1.0, 0.0};
  probe seen_by = quiet(1.0);
  rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-9);
  seen_by.says = ROT_ETORQUE;
  seen_by.stop_at = 200;
  p.accuracy = 1e-12;
  run(&p, 4, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ETORQUE);
  ROT_CHECK_EQ_INT(result.info.rows_done, 0);
}

/* Deterministic noise beside the oscillator's torque, beyond x = after: two calls, two values. */
typedef struct noise {
  double after, size;
  unsigned seed;
  size_t calls;
} noise;

static rot_status noisy(double t, const double y[], double dydt[], void *ctx) {
  noise *n = ctx;
  (void)t;
  n->calls++;
  n->seed = n->seed * 1664525u + 1013904223u;
  dydt[0] = y[1];
  dydt[1] = -y[0];
  if (y[0] < n->after) dydt[1] += n->size * ((double)(n->seed >> 8) / 16777216.0 - 0.5);
  return ROT_OK;
}

static void check_random(void) {
  const double t[] = {1.0, 20.0}, start[] = {1.0, 0.0};
  noise n = {2.0, 1e-3, 1u, 0};
  rot_ode_params p = problem(2, noisy, NULL, start, 1e-9);
  p.ctx = &n;
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ERANDOM); /* at the start */
  ROT_CHECK(result.info.time_s == 0.0 && n.calls < 10);
  n = (noise){0.5, 1e-3, 1u, 0};
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_ERANDOM); /* where steps fail: cos t < 0.5 */
  ROT_CHECK_REL(result.info.time_s, 1.0471975511965976, 0.1);
  ROT_CHECK(n.calls < 5000);
  n = (noise){2.0, 1e-8, 1u, 0}; /* less than the accuracy asked */
  p.accuracy = 1e-4;
  run(&p, 2, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
}

/* A motion that leaves in finite time ends where it left, not in an endless crawl, and the rows
 * before are as good as asked. */
static void check_explosion(void) {
  const double t[] = {0.25, 0.5, 0.9, 1.5}, start[] = {1.0};
  probe seen_by = quiet(0.0);
  const rot_ode_params p = problem(1, explosion, &seen_by, start, 1e-8);
  run(&p, 4, t, NULL);
  ROT_CHECK(result.status == ROT_ESTEP || result.status == ROT_ERHS);
  ROT_CHECK_EQ_INT(result.info.rows_done, 3);
  ROT_CHECK(fabs(result.info.time_s - 1.0) < 1e-6);
  for (size_t i = 0; i < 3; i++) ROT_CHECK_REL(result.y[i], 1.0 / (1.0 - t[i]), 1e-7);
  ROT_CHECK(seen_by.calls < 100000);
}

/* The budget counts steps and rejections of one run; the rows before stay good. */
static void check_budget(void) {
  double t[40];
  const double start[] = {1.0, 0.0};
  probe seen_by = quiet(2.0);
  rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
  for (int i = 0; i < 40; i++) t[i] = 1.0 + i;
  p.max_steps = 40;
  run(&p, 40, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_EBUDGET);
  ROT_CHECK(result.info.rows_done > 0 && result.info.rows_done < 20);
  ROT_CHECK(result.info.steps + result.info.rejected <= 40);
  ROT_CHECK(result.info.time_s < 20.0 && result.info.time_s >= t[result.info.rows_done - 1]);
  for (size_t i = 0; i < result.info.rows_done; i++) {
    ROT_CHECK(fabs(result.y[2 * i] - cos(2.0 * t[i])) <= 1e-8);
  }
  p.max_steps = 0;
  run(&p, 40, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_EBUDGET);
  ROT_CHECK_EQ_INT(result.info.rows_done, 0);
  ROT_CHECK(result.info.time_s == 0.0);
}

/* An end that the budget cannot reach: a lossless run ends early, its rows good; with losses in
 * reach, or an end, the budget counts. */
static void check_out_of_reach(void) {
  const double t[] = {-1.0, 1.0, 1e80}, start[] = {1.0, 0.0};
  probe seen_by = quiet(2.0);
  rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
  p.max_steps = 400000;
  p.fades_s = INFINITY;
  run(&p, 3, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_EBUDGET);
  ROT_CHECK_EQ_INT(result.info.rows_done, 2);
  for (size_t i = 0; i < 2; i++) ROT_CHECK(fabs(result.y[2 * i] - cos(2.0)) <= 1e-8);
  const long few = seen_by.calls;
  p.fades_s = 1e5;
  run(&p, 3, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_EBUDGET);
  ROT_CHECK(seen_by.calls - few > 10 * few);
  const double near[] = {2e4};
  p.fades_s = INFINITY;
  run(&p, 1, near, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK(result.info.steps > 10000);
}

/* Enough for the coarse run, not for the fine one: only what both reached is given. */
static void check_budget_of_fine_run(void) {
  const double t[] = {1.5, 5.0, 7.7, 10.0}, start[] = {1.0, 0.0};
  probe seen_by = quiet(2.0);
  rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
  run(&p, 4, t, NULL);
  p.max_steps = result.info.steps - 1;
  run(&p, 4, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_EBUDGET);
  ROT_CHECK(result.info.rows_done > 0 && result.info.rows_done < 4);
  const double last = t[result.info.rows_done - 1];
  ROT_CHECK(result.info.time_s >= last && result.info.time_s < 10.0);
  ROT_CHECK(result.error[0] > 0.0 && result.error[0] <= 1e-8);
  for (size_t i = 0; i < result.info.rows_done; i++) {
    ROT_CHECK(fabs(result.y[2 * i] - cos(2.0 * t[i])) <= result.error[0]);
  }
}

/* What the right-hand side says ends the run at that very call, wherever in a step it falls. */
static void check_stop_by_rhs(void) {
  const double t[] = {-3.0, 2.0, 5.0}, start[] = {1.0, 0.0};
  const rot_status says[] = {ROT_EUNWIND, ROT_EVALUE, ROT_ETORQUE};
  for (long stop_at = 1; stop_at <= 300; stop_at += stop_at < 60 ? 1 : 7) {
    probe seen_by = quiet(2.0);
    const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
    seen_by.stop_at = stop_at;
    seen_by.says = ROT_EUNWIND;
    run(&p, 3, t, NULL);
    ROT_CHECK_EQ_INT(result.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(seen_by.calls, stop_at);
    if (stop_at < 100) ROT_CHECK_EQ_INT(result.info.rows_done, 0); /* still backward */
  }
  for (int i = 0; i < 3; i++) {
    probe seen_by = quiet(2.0);
    const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
    seen_by.stop_at = 500;
    seen_by.says = says[i];
    run(&p, 3, t, NULL);
    ROT_CHECK_EQ_INT(result.status, says[i]);
  }
}

typedef struct poller {
  long calls, stop_at;
} poller;

static rot_status poll(void *ctx, double fraction) {
  poller *p = ctx;
  ROT_CHECK(fraction >= 0.0 && fraction <= 1.0);
  return ++p->calls == p->stop_at ? ROT_EUNWIND : ROT_OK;
}

static void check_stop_by_poll(void) {
  const double t[] = {-3.0, 2.0, 50.0}, start[] = {1.0, 0.0};
  poller patient = {0, -1};
  rot_hooks hooks = {poll, &patient};
  probe seen_by = quiet(2.0);
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
  run(&p, 3, t, &hooks);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  /* Some dozen calls of the right-hand side pass between two polls. */
  ROT_CHECK(patient.calls > 20 && seen_by.calls < 300 * patient.calls);
  for (long stop_at = 1; stop_at <= patient.calls; stop_at++) {
    poller stopping = {0, stop_at};
    hooks.ctx = &stopping;
    run(&p, 3, t, &hooks);
    ROT_CHECK_EQ_INT(result.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(stopping.calls, stop_at);
  }
}

/* ---- sizes ---------------------------------------------------------------------------------- */

/* Time and state in other units: the same steps, the same digits. */
static void check_scaling(void) {
  size_t steps = 0;
  for (int e = -300; e <= 300; e += 100) {
    const double unit = ldexp(1.0, e), start[] = {unit, 0.0}, t = 7.0;
    probe seen_by = quiet(2.0);
    const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-8);
    run(&p, 1, &t, NULL);
    if (e > -300) ROT_CHECK_EQ_INT(result.info.steps, steps);
    steps = result.info.steps;
    ROT_CHECK_REL(result.y[0], unit * cos(14.0), 1e-7);
    ROT_CHECK(result.error[0] <= 1e-8 * unit);
  }
}

/* A start a million times smaller than the later motion: its first decades are not worth a step. */
static rot_status late_pulse(double t, const double y[], double dydt[], void *ctx) {
  (void)y;
  dydt[0] = exp(-0.5 * (t - 20.0) * (t - 20.0));
  return seen(ctx, t);
}

static void check_rise_out_of_nothing(void) {
  const double t[] = {10.0, 20.0, 40.0}, start[] = {0.0};
  probe seen_by = quiet(0.0);
  const rot_ode_params p = problem(1, late_pulse, &seen_by, start, 1e-8);
  run(&p, 3, t, NULL);
  ROT_CHECK_EQ_INT(result.status, ROT_OK);
  ROT_CHECK(fabs(result.y[2] - 2.50662827463100050) <= 1e-8 * 2.6); /* sqrt(2 pi) */
  ROT_CHECK(fabs(result.y[1] - 1.25331413731550025) <= 1e-8 * 2.6);
  printf("a pulse out of nothing: %ld calls\n", seen_by.calls);
  ROT_CHECK(seen_by.calls < 20000);
}

/* A caller names its measures before the run, or after it. */
static void check_measures_stay(void) {
  probe seen_by = quiet(1.0);
  const double start[] = {1.0, 0.0}, t = 1.0;
  const rot_ode_params p = problem(2, oscillator, &seen_by, start, 1e-9);
  rot_info info;
  rot_info_clear(&info, rot_turning);
  info.measure[ROT_OMEGA].largest = 3.0;
  ROT_CHECK_EQ_INT(
      rot_ode_run(&p, 1, &t, result.y, NULL, result.error, result.largest, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT((long long)info.n_measures, 2);
  ROT_CHECK(info.measure_names == rot_turning && info.measure[ROT_OMEGA].largest == 3.0);
  ROT_CHECK(info.steps > 0 && info.rows_done == 1);
}

int main(void) {
  check_measures_stay();
  check_random();
  check_order();
  check_estimate();
  check_estimate_of_one_row();
  check_estimate_of_dense_rows();
  check_estimate_of_roundings();
  check_cost();
  check_repeated_until_accurate();
  check_accuracy_out_of_reach();
  check_largest();
  check_backward_and_forward();
  check_mirrors();
  check_negative_times();
  check_rest();
  check_estimate_of_both_sides();
  check_only_the_start();
  check_no_rows();
  check_breaks();
  check_start_on_break();
  check_breaks_between_rows();
  check_riders();
  check_riders_between_steps();
  check_nan_later();
  check_nan_in_first();
  check_nan_everywhere();
  check_nan_backward();
  check_explosion();
  check_budget();
  check_out_of_reach();
  check_budget_of_fine_run();
  check_stop_by_rhs();
  check_stop_by_poll();
  check_scaling();
  check_rise_out_of_nothing();
  return rot_test_report("ode");
}
