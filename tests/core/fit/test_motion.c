/* Derivatives of motions by their inputs against closed forms, with a stop, the end of a slip and a
 * lock before, between, at and after the samples; edges of domains, clocks, refusals. */
#include "fit/motion.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "../sweep/sweep_kit.h"

enum { N = 41 };

static rot_object *coasting(void) {
  rot_object *scene = of("scene_axle");
  put(scene, "body", 1.0);
  part(scene, "resistance", loss(0.0, 0.0, 0.5));
  put(scene, "omega0_rad_per_s", 3.0);
  return scene;
}

static rot_object *bowling(void) {
  rot_object *scene = of("scene_incline"), *ball = of("body_sphere");
  put(ball, "mass_kg", 6.0);
  put(ball, "radius_m", 0.108);
  part(scene, "body", ball);
  put(scene, "incline_angle_deg", 0.0);
  put(scene, "static_friction", 0.12);
  put(scene, "v0_m_per_s", 8.0);
  put(scene, "omega0_rad_per_s", 0.0);
  return scene;
}

static rot_object *coupled(void) {
  static const double omega[] = {10.0, 0.0};
  rot_object *scene = of("scene_clutch");
  put(scene, "body_1", 2.0);
  put(scene, "body_2", 3.0);
  put(scene, "capacity_n_m", 4.0);
  puts_of(scene, "omega0_rad_per_s", 2, omega);
  return scene;
}

static rot_fit_column column_named(const rot_object *scene, const char *name) {
  return (rot_fit_column){rot_run_column(scene->constraint, name), 0};
}

/* (input, time) => value, derivative; the event at *event_s */
typedef struct closed {
  double value, slope;
} closed;

static closed coast_by_friction(double tau, double t, double *event_s) {
  const double w = 3.0, stop = w / tau;
  *event_s = stop;
  if (t < stop) return (closed){w * t - tau * t * t / 2.0, -t * t / 2.0};
  return (closed){w * w / (2.0 * tau), -w * w / (2.0 * tau * tau)};
}

static closed coast_by_speed(double w, double t, double *event_s) {
  const double tau = 0.5, stop = w / tau;
  *event_s = stop;
  if (t < stop) return (closed){w * t - tau * t * t / 2.0, t};
  return (closed){w * w / (2.0 * tau), w / tau};
}

/* A solid ball rolls from 2 v/(7 mu g) on, with 5/7 of its speed. */
static closed bowl_by_friction(double mu, double t, double *event_s) {
  const double v = 8.0, g = 9.80665, end = 2.0 * v / (7.0 * mu * g);
  *event_s = end;
  if (t < end) return (closed){v * t - mu * g * t * t / 2.0, -g * t * t / 2.0};
  return (closed){12.0 * v * v / (49.0 * mu * g) + 5.0 / 7.0 * v * (t - end),
                  -2.0 * v * v / (49.0 * mu * mu * g)};
}

static closed lock_by_capacity(double capacity, double t, double *event_s) {
  const double lock = 10.0 / (capacity / 2.0 + capacity / 3.0);
  *event_s = lock;
  if (t < lock) return (closed){10.0 - capacity * t / 2.0, -t / 2.0};
  return (closed){4.0, 0.0};
}

typedef struct motion_case {
  rot_object *(*make)(void);
  const char *input, *column;
  double x, end_s;
  closed (*truth)(double x, double t, double *event_s);
} motion_case;

static const motion_case cases[] = {
    {coasting, "resistance$coulomb_n_m", "theta_rad", 0.5, 10.0, coast_by_friction},
    {coasting, "omega0_rad_per_s", "theta_rad", 3.0, 10.0, coast_by_speed},
    {bowling, "static_friction", "x_m", 0.12, 4.0, bowl_by_friction},
    {coupled, "capacity_n_m", "omega_1_rad_per_s", 4.0, 6.0, lock_by_capacity},
};

/* Even times, and some at, just before and just after the event. */
static void times_of(const motion_case *c, double t[N]) {
  double event_s;
  (void)c->truth(c->x, 0.0, &event_s);
  for (int i = 0; i < N; i++) t[i] = c->end_s * i / (N - 1.0);
  const double near[] = {-1e-3, -1e-6, -1e-9, 0.0, 1e-9, 1e-6, 1e-3};
  int at = 0;
  while (t[at] < event_s) at++;
  for (int k = 0; k < 7 && at - 3 + k < N; k++) {
    const double here = event_s * (1.0 + near[k]);
    if (here > t[at - 4 + (k < 1)] - DBL_MAX) t[at - 3 + k] = here;
  }
  for (int i = 1; i < N; i++) {
    for (int k = i; k > 0 && t[k] < t[k - 1]; k--) {
      const double x = t[k];
      t[k] = t[k - 1];
      t[k - 1] = x;
    }
  }
}

static void derivatives(const motion_case *c) {
  rot_object *scene = c->make();
  const rot_fit_column column = column_named(scene, c->column);
  double t[N], value[N], slope[N], error, size = 0.0, worst = 0.0, off = 0.0, largest = 0.0;
  times_of(c, t);
  const rot_fit_motion_plan plan = {.scene = scene,
                                    .n_inputs = 1,
                                    .inputs = &c->input,
                                    .n_columns = 1,
                                    .columns = &column,
                                    .n = N,
                                    .time_s = t,
                                    .accuracy = 1e-10,
                                    .max_steps = 1e6};
  rot_fit_motion *m;
  rot_refusal no;
  ROT_CHECK(rot_fit_motion_open(&plan, &m, &no) == ROT_OK);
  for (int again = 0; again < 2; again++) {
    ROT_CHECK(rot_fit_motion_at(m, &c->x, 0.0, value, &error) == ROT_OK);
    ROT_CHECK(rot_fit_motion_slope(m, 0, 0.0, DBL_MAX, &size, slope) == ROT_OK && size > 0.0);
  }
  for (int i = 0; i < N; i++) {
    double event_s;
    largest = fmax(largest, fabs(c->truth(c->x, t[i], &event_s).slope));
  }
  for (int i = 0; i < N; i++) {
    double event_s;
    const closed want = c->truth(c->x, t[i], &event_s);
    off = fmax(off, fabs(value[i] - want.value));
    /* At the event itself both sides are derivatives. */
    double miss = fabs(slope[i] - want.slope);
    if (fabs(t[i] - event_s) <= 1e-12 * event_s) {
      const closed before = c->truth(c->x, t[i] * (1.0 - 1e-12), &event_s);
      miss = fmin(miss, fabs(slope[i] - before.slope));
    }
    worst = fmax(worst, miss / largest);
  }
  printf("%s by %s: derivatives within %.1e of the largest\n", c->column, c->input, worst);
  ROT_CHECK(off < 1e-11 && error < 1e-11);
  ROT_CHECK(worst < 1e-6);
  rot_fit_motion_close(m);
  rot_object_free(scene);
}

/* At the edge of its domain, an input has one side; the clock moves all samples. */
static void edges_and_clocks(void) {
  static const char *const input[] = {"resistance$viscous_n_m_s", "omega0_rad_per_s"};
  rot_object *scene = of("scene_axle");
  put(scene, "body", 2.0);
  part(scene, "resistance", loss(0.0, 0.0, 0.0));
  put(scene, "omega0_rad_per_s", 3.0);
  rot_fit_column columns[] = {column_named(scene, "theta_rad"),
                              column_named(scene, "omega_rad_per_s")};
  double t[N], value[2 * N], slope[2 * N], size = 0.0;
  const double x[] = {0.0, 3.0};
  for (int i = 0; i < N; i++) t[i] = 0.5 + 0.1 * i;
  rot_fit_motion_plan plan = {.scene = scene,
                              .n_inputs = 2,
                              .inputs = input,
                              .n_columns = 2,
                              .columns = columns,
                              .n = N,
                              .time_s = t,
                              .accuracy = 1e-10,
                              .max_steps = 1e6};
  rot_fit_motion *m;
  rot_refusal no;
  ROT_CHECK(rot_fit_motion_open(&plan, &m, &no) == ROT_OK);
  ROT_CHECK(rot_fit_motion_at(m, x, 0.25, value, NULL) == ROT_OK);
  /* d theta/dc = -w t^2/(2 I) at c = 0 */
  ROT_CHECK(rot_fit_motion_slope(m, 0, 0.0, DBL_MAX, &size, slope) == ROT_OK);
  for (int i = 0; i < N; i++) {
    const double s = t[i] + 0.25;
    ROT_CHECK_REL(value[i], 3.0 * s, 1e-14);
    ROT_CHECK_REL(slope[i], -3.0 * s * s / 4.0, 1e-6);
    ROT_CHECK_REL(slope[N + i], -3.0 * s / 2.0, 1e-6);
  }
  size = 0.0;
  ROT_CHECK(rot_fit_motion_slope(m, 2, -DBL_MAX, DBL_MAX, &size, slope) == ROT_OK);
  for (int i = 0; i < N; i++) {
    ROT_CHECK_REL(slope[i], 3.0, 1e-8);
    ROT_CHECK(fabs(slope[N + i]) < 1e-8);
  }
  /* The step is the difference of two doubles: of numbers that are exact so is the slope. */
  const double third[] = {0.0, 1.0 / 3.0};
  ROT_CHECK(rot_fit_motion_at(m, third, 0.0, value, NULL) == ROT_OK);
  size = 0.0;
  ROT_CHECK(rot_fit_motion_slope(m, 1, -DBL_MAX, DBL_MAX, &size, slope) == ROT_OK);
  for (int i = 0; i < N; i++) ROT_CHECK(slope[N + i] == 1.0);
  ROT_CHECK(strcmp(rot_fit_motion_model(m)->id, "axle_linear") == 0 ||
            strcmp(rot_fit_motion_model(m)->id, "axle_free") == 0);
  /* Refused numbers. */
  const double bad[] = {0.0, INFINITY};
  ROT_CHECK(rot_fit_motion_at(m, bad, 0.0, value, NULL) == ROT_EVALUE);
  rot_fit_motion_close(m);
  static const char *const unknown[] = {"omega0_rad_per_s", "mass"};
  plan.inputs = unknown;
  ROT_CHECK(rot_fit_motion_open(&plan, &m, &no) == ROT_EVALUE && no.input == 1 && !m);
  rot_object_free(scene);
}

/* A motion of the caller's: a exp(-k t), and a jump by 1 where k t = 1. */
typedef struct caller {
  size_t calls, ends_at; /* the call that ends the fit; 0: none */
  double lowest;         /* smaller k are refused */
} caller;

static rot_status decay(size_t record, const double input[], size_t n, const double time_s[],
                        double value[], size_t events[], double *error, void *ctx) {
  caller *c = ctx;
  ROT_CHECK(record == 3);
  if (++c->calls == c->ends_at) return ROT_EUNWIND;
  if (input[1] < c->lowest) return ROT_EVALUE;
  for (size_t i = 0; i < n; i++) {
    events[i] = input[1] * time_s[i] >= 1.0;
    value[i] = input[0] * exp(-input[1] * time_s[i]) + (double)events[i];
    value[n + i] = time_s[i];
  }
  *error = 1e-15;
  return ROT_OK;
}

static void motions_of_a_caller(void) {
  enum { M = 12 };
  double t[M], value[2 * M], slope[2 * M], error;
  const double x[] = {2.0, 0.5};
  for (int i = 0; i < M; i++) t[i] = 0.4 * i;
  t[5] = 2.0 - 1e-7; /* just before the jump, and at it */
  t[6] = 2.0;
  caller c = {0};
  const rot_fit_motion_plan plan = {
      .n_inputs = 2, .n_columns = 2, .n = M, .time_s = t, .run = decay, .ctx = &c, .record = 3};
  rot_fit_motion *m;
  rot_refusal no;
  ROT_CHECK(rot_fit_motion_open(&plan, &m, &no) == ROT_OK);
  ROT_CHECK(rot_fit_motion_at(m, x, 0.0, value, &error) == ROT_OK && error == 1e-15);
  /* A first step within the rounding of the number grows. */
  double size[3] = {1.1 * DBL_EPSILON * x[0]};
  for (size_t j = 0; j < 3; j++) {
    ROT_CHECK(rot_fit_motion_slope(m, j, -DBL_MAX, DBL_MAX, &size[j], slope) == ROT_OK);
    for (int i = 0; i < M; i++) {
      const double e = exp(-0.5 * t[i]);
      const double want = j == 0 ? e : j == 1 ? -2.0 * t[i] * e : -e;
      ROT_CHECK(fabs(slope[i] - want) < 1e-7);
      ROT_CHECK(fabs(slope[M + i] - (j == 2 ? 1.0 : 0.0)) < 1e-7);
    }
  }
  ROT_CHECK(rot_fit_motion_model(m) == NULL && rot_fit_motion_runs(m) == c.calls);
  /* A refused side leaves the other one. */
  const double low[] = {2.0, 0.25};
  c.lowest = 0.25;
  ROT_CHECK(rot_fit_motion_at(m, low, 0.0, value, NULL) == ROT_OK);
  ROT_CHECK(rot_fit_motion_slope(m, 1, 0.25, DBL_MAX, &size[1], slope) == ROT_OK);
  for (int i = 0; i < M; i++) {
    ROT_CHECK(fabs(slope[i] + 2.0 * t[i] * exp(-0.25 * t[i])) < 1e-6);
  }
  const double lower[] = {2.0, 0.125};
  ROT_CHECK(rot_fit_motion_at(m, lower, 0.0, value, NULL) == ROT_EVALUE);
  rot_fit_motion_close(m);
  /* Nothing is called after the end. */
  c = (caller){0, 3, 0.0};
  ROT_CHECK(rot_fit_motion_open(&plan, &m, &no) == ROT_OK);
  ROT_CHECK(rot_fit_motion_at(m, x, 0.0, value, &error) == ROT_OK);
  ROT_CHECK(rot_fit_motion_slope(m, 1, -DBL_MAX, DBL_MAX, &size[1], slope) == ROT_EUNWIND);
  ROT_CHECK(rot_fit_motion_slope(m, 0, -DBL_MAX, DBL_MAX, &size[0], slope) == ROT_EUNWIND);
  ROT_CHECK(rot_fit_motion_at(m, low, 0.0, value, &error) == ROT_EUNWIND);
  ROT_CHECK(c.calls == 3);
  rot_fit_motion_close(m);
}

int main(void) {
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) derivatives(&cases[i]);
  edges_and_clocks();
  motions_of_a_caller();
  return rot_test_report("fit_motion");
}
