/* Events of the integrator: plain, with a jump and a next mode, terminal; several at one time. */
#include <stdlib.h>

#include "engine/ode/ode.h"
#include "ground/real.h"
#include "rot_test.h"

static rot_events events;

static rot_ode_params problem(size_t dim, rot_ode_rhs rhs, const double start[], double accuracy,
                              size_t n_events, const rot_ode_event event[]) {
  const rot_ode_params p = {.dim = dim,
                            .controlled = dim,
                            .rhs = rhs,
                            .start = start,
                            .accuracy = accuracy,
                            .max_steps = 100000,
                            .n_events = n_events,
                            .events = event,
                            .log = &events};
  return p;
}

/* ---- turning points of a pendulum ------------------------------------------------------------ */

static rot_status pendulum(double t, const double y[], double f[], void *ctx) {
  (void)t;
  (void)ctx;
  f[0] = y[1];
  f[1] = -sin(y[0]);
  return ROT_OK;
}

static double quarter_period(double amplitude) { /* K(sin(amplitude/2)) by the AGM */
  double a = 1.0, b = cos(0.5 * amplitude);
  for (int k = 0; k < 10; k++) {
    const double mean = 0.5 * (a + b);
    b = sqrt(a * b);
    a = mean;
  }
  return 1.57079632679489661923 / a;
}

static double rate_of(double t, const double y[], void *ctx) {
  (void)t;
  (void)ctx;
  return y[1];
}

/* By component and by function; rising, falling and both; forward and backward. */
static void check_turning_points(void) {
  const double start[] = {2.0, 0.0}, span = 40.0, k4 = 2.0 * quarter_period(2.0);
  for (int k = 0; k < 12; k++) {
    const int direction = k % 3 - 1, by_function = k / 3 % 2, backward = k / 6;
    const rot_ode_event event = {
        by_function ? rate_of : NULL, 1, direction, ROT_EVENT_REVERSE, NULL, NULL, 0};
    const rot_ode_params p = problem(2, pendulum, start, 1e-11, 1, &event);
    const double t = backward ? -span : span;
    double y[2], error[2], largest[2];
    rot_info info;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
    /* From the top the rate falls at first: it rises through zero at odd multiples of 2 K. */
    size_t want = 0;
    double off = 0.0;
    for (int i = 1; i * k4 < span; i++) {
      const int at = backward ? -i : i, rises = i % 2;
      if (direction != 0 && (direction == 1) != rises) continue;
      for (size_t j = 0; j < events.count; j++) {
        if (fabs(events.time_s[j] - at * k4) < 0.1) {
          off = fmax(off, fabs(events.time_s[j] - at * k4));
          want++;
        }
      }
    }
    ROT_CHECK_EQ_INT(events.count, want);
    ROT_CHECK(want >= 4);
    ROT_CHECK(off <= 1e-10);
  }
}

/* A peak that only just reaches the level, twice within a step. */
static double above(double t, const double y[], void *ctx) {
  (void)t;
  return y[0] - *(const double *)ctx;
}

static void check_two_within_a_step(void) {
  const double start[] = {0.0, 2.0 * sin(0.5)}, t = 20.0; /* amplitude 1 */
  const double period = 4.0 * quarter_period(1.0);
  double level = 0.99;
  const rot_ode_event event = {above, 0, 0, ROT_EVENT_REVERSE, NULL, NULL, 0};
  rot_ode_params p = problem(2, pendulum, start, 1e-4, 1, &event);
  double y[2], error[2], largest[2];
  rot_info info;
  p.ctx = &level;
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(events.count, 6);
  for (size_t i = 0; i < events.count; i++) { /* either side of each peak */
    const double peak = (0.25 + (double)(i / 2)) * period;
    ROT_CHECK(fabs(fabs(events.time_s[i] - peak) - 0.1546) < 0.01);
  }
}

/* ---- a bouncing ball ------------------------------------------------------------------------- */

typedef struct ball {
  double restitution;
  int bounces, max, mode;
} ball;

static rot_status fall(double t, const double y[], double f[], void *ctx) {
  const ball *b = ctx;
  (void)t;
  f[0] = b->mode ? 0.0 : y[1]; /* mode 1: it lies */
  f[1] = b->mode ? 0.0 : -9.81;
  f[2] = b->mode ? 0.0 : 9.81 * y[1]; /* an integral along the way */
  return ROT_OK;
}

static rot_ode_then bounce(double t, double y[], int *mode, int forward, void *ctx) {
  ball *b = ctx;
  (void)t;
  (void)forward;
  y[1] *= -b->restitution;
  if (*mode == 0 && fabs(y[1]) < 0.05) {
    *mode = 1;
    y[1] = 0.0;
  }
  return ROT_ODE_NEW_SEGMENT;
}

static double height(double t, const double y[], void *ctx) {
  (void)t;
  (void)ctx;
  return y[0];
}

static void check_bouncing_ball(void) {
  enum { ROWS = 200 };
  const double start[] = {5.0, 0.0, 0.0};
  double t[ROWS], y[3 * ROWS], error[3], largest[3];
  for (int i = 0; i < ROWS; i++) t[i] = 0.05 * (i + 1);
  for (int k = 0; k < 2; k++) {
    ball b = {0.7, 0, 0, 0};
    const rot_ode_event floor = {k ? height : NULL, 0, -1, ROT_EVENT_REVERSE, bounce, NULL, 0};
    rot_ode_params p = problem(3, fall, start, 1e-10, 1, &floor);
    rot_info info;
    p.controlled = 2;
    p.ctx = &b;
    p.mode = &b.mode;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK_EQ_INT(info.rows_done, ROWS);
    const double impact = sqrt(2.0 * 9.81 * 5.0);
    double at = impact / 9.81, speed = 0.7 * impact, worst = 0.0;
    size_t n = 0, row = 0;
    for (; row < ROWS && t[row] < at; row++) {
      worst = fmax(worst, fabs(y[3 * row] - (5.0 - 0.5 * 9.81 * t[row] * t[row])));
    }
    while (n < events.count) {
      ROT_CHECK(fabs(events.time_s[n] - at) <= 1e-13 * (double)(n + 1));
      n++;
      if (speed < 0.05) break;
      const double next = at + 2.0 * speed / 9.81;
      for (; row < ROWS && t[row] < next; row++) {
        const double s = t[row] - at;
        worst = fmax(worst, fabs(y[3 * row] - (speed * s - 0.5 * 9.81 * s * s)));
      }
      at = next;
      speed *= 0.7;
    }
    for (; row < ROWS; row++) worst = fmax(worst, fabs(y[3 * row]));
    printf("ball: %zu bounces, off by %.1e m\n", events.count, worst);
    ROT_CHECK_EQ_INT(events.count, n);
    ROT_CHECK(n > 10);
    ROT_CHECK(worst <= 1e-12);
    ROT_CHECK(worst <= error[0]);
    ROT_CHECK_EQ_INT(b.mode, 1);
  }
}

/* ---- the end, and several -------------------------------------------------------------------- */

static rot_ode_then stop(double t, double y[], int *mode, int forward, void *ctx) {
  (void)t;
  (void)y;
  (void)mode;
  (void)forward;
  (void)ctx;
  return ROT_ODE_END;
}

static double clock_of(double t, const double y[], void *ctx) {
  (void)y;
  (void)ctx;
  return sin(3.0 * t + 0.3);
}

/* The rate turns, a clock strikes, and at -1 rad the run ends: first come, first logged. */
static void check_several(void) {
  enum { ROWS = 400 };
  const double start[] = {2.0, -0.1};
  const double low = -1.9;
  double t[ROWS], y[2 * ROWS], error[2], largest[2];
  for (int i = 0; i < ROWS; i++) t[i] = 0.05 * (i + 1);
  const rot_ode_event several[] = {{rate_of, 0, 0, ROT_EVENT_REVERSE, NULL, NULL, 0},
                                   {clock_of, 0, 1, ROT_EVENT_LOCK, NULL, NULL, 0},
                                   {above, 0, -1, ROT_EVENT_SLIP, stop, NULL, 0}};
  for (double accuracy = 1e-4; accuracy > 1e-12; accuracy *= 1e-3) {
    rot_ode_params p = problem(2, pendulum, start, accuracy, 3, several);
    rot_info info;
    p.ctx = (void *)&low;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, ROWS, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK(info.rows_done > 10 && info.rows_done < ROWS);
    ROT_CHECK(t[info.rows_done] > info.time_s && t[info.rows_done - 1] <= info.time_s);
    ROT_CHECK(events.count > 0 && events.event[events.count - 1] == ROT_EVENT_SLIP);
    ROT_CHECK(events.time_s[events.count - 1] == info.time_s);
    size_t strikes = 0;
    for (size_t i = 0; i < events.count; i++) {
      if (i) ROT_CHECK(events.time_s[i] >= events.time_s[i - 1]);
      if (events.event[i] != ROT_EVENT_LOCK) continue;
      strikes++;
      const double turns = (3.0 * events.time_s[i] + 0.3) / 6.28318530717958647693;
      ROT_CHECK(fabs(turns - floor(turns + 0.5)) <= 1e-14);
    }
    ROT_CHECK_EQ_INT(strikes, (int)((3.0 * info.time_s + 0.3) / 6.28318530717958647693));
    for (size_t i = 0; i < info.rows_done; i++) ROT_CHECK(y[2 * i] >= low);
    printf("accuracy %.0e: ends at %.15g, estimate %.1e\n", accuracy, info.time_s, error[0]);
  }
}

/* A body at rest whose steps are as long as the run: only the event knows of the time. */
static double tide(double t, const double y[], void *ctx) {
  (void)y;
  return sin(t + *(const double *)ctx);
}

static void check_clock_at_rest(void) {
  const double start[] = {0.0, 0.0}, pi = 3.14159265358979323846;
  const rot_ode_event event = {tide, 0, 0, ROT_EVENT_LOCK, NULL, NULL, 0};
  for (int k = 0; k < 40; k++) {
    double phase = 0.05 + 0.157 * k, t = 5.0 + 0.7 * k, y[2], error[2], largest[2], off = 0.0;
    rot_ode_params p = problem(2, pendulum, start, 1e-6, 1, &event);
    rot_info info;
    p.ctx = &phase;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
    const double first = ceil(phase / pi);
    ROT_CHECK_EQ_INT(events.count, (int)(floor((t + phase) / pi) - first) + 1);
    for (size_t i = 0; i < events.count; i++) {
      off = fmax(off, fabs(events.time_s[i] - ((first + (double)i) * pi - phase)));
    }
    ROT_CHECK(off <= 1e-13);
  }
}

int main(void) {
  check_turning_points();
  check_clock_at_rest();
  check_two_within_a_step();
  check_bouncing_ball();
  check_several();
  rot_events_free(&events);
  return rot_test_report("ode_event");
}
