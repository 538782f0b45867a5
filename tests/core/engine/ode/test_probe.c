/* Narrow changes of a law, which no step would call by chance: by hand, from the energy, the
 * momentum, and the time that each part of the path takes. */
#include "engine/ode/ode.h"
#include "rot_test.h"

typedef enum where { BY_TIME, BY_ANGLE, BY_RATE, NOWHERE } where;

typedef struct law {
  where of;
  double from, to, height; /* added in this interval */
  double base;
  int mode;
  size_t calls;
} law;

enum { THETA, OMEGA, IMPULSE, DIM };

static rot_status slope(double t, const double y[], double f[], void *ctx) {
  law *l = ctx;
  const double x = l->of == BY_TIME ? t : l->of == BY_ANGLE ? y[THETA] : y[OMEGA];
  const double torque = l->base + (l->of != NOWHERE && x > l->from && x < l->to ? l->height : 0.0);
  l->calls++;
  f[THETA] = y[OMEGA];
  f[OMEGA] = l->mode == 0 ? 0.0 : torque - (l->mode == 2 ? 0.0 : l->mode);
  f[IMPULSE] = torque;
  return ROT_OK;
}

static double y[3 * DIM], error[DIM], largest[DIM];

static rot_ode_params problem(law *l, const double start[], double resolution, rot_method method) {
  l->mode = 2; /* no friction */
  l->calls = 0;
  return (rot_ode_params){.dim = DIM,
                          .controlled = 2,
                          .rhs = slope,
                          .ctx = l,
                          .start = start,
                          .accuracy = 1e-9,
                          .max_steps = 100000,
                          .method = method,
                          .sloped = IMPULSE,
                          .resolution = resolution};
}

/* From omega = 10 without another torque, 10 s in either direction of time, 100 rad: the change
 * covers 1/200 of the range. */
static void check_changes(void) {
  const double start[] = {0.0, 10.0, 0.0}, none[DIM] = {0.0, 10.0, 0.0};
  for (int method = ROT_METHOD_RK8PD; method <= ROT_METHOD_RADAU; method++) {
    for (double at = 0.9; at < 95.0; at += 3.7) {
      for (int back = 0; back < 2; back++) {
        const double direction = back ? -1.0 : 1.0, t[] = {direction * 10.0};
        rot_info info;
        law angle = {BY_ANGLE, direction * at, direction * at + 0.55, 4.0, 0.0, 2, 0};
        rot_ode_params p = problem(&angle, start, 0.005, (rot_method)method);
        ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
        /* Forward it adds 4 * 0.55 J for 1 kg m^2; backward it had been added. */
        const double now = sqrt(100.0 + direction * 2.0 * 4.0 * 0.55);
        ROT_CHECK(fabs(y[OMEGA] - now) <= fmax(error[OMEGA], 1e-13) && error[OMEGA] < 1e-8);
        const double takes = 0.55 / (0.5 * (10.0 + now));
        const double before = back ? at - 0.55 : at; /* met first, in its own direction */
        const double theta = before + 0.55 + now * (10.0 - before / 10.0 - takes);
        ROT_CHECK(fabs(y[THETA] - direction * theta) <= fmax(error[THETA], 1e-12));

        law time = {
            BY_TIME, direction * at / 10.0 - 0.0255, direction * at / 10.0 + 0.0255, 3.0, 0.0, 2,
            0};
        p = problem(&time, start, 0.005, (rot_method)method);
        ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
        ROT_CHECK(fabs(y[OMEGA] - (10.0 + direction * 0.153)) <= fmax(error[OMEGA], 1e-13));

        /* Not looked at, it is passed over. */
        p = problem(&time, start, 0.0, (rot_method)method);
        ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
        if (method == ROT_METHOD_RK8PD && at > 40.0) ROT_CHECK(y[OMEGA] == none[OMEGA]);
      }
    }
  }
}

/* A dip of the torque from 1 to 0.1 over 1/200 of the rates from 0 to 10. */
static void check_rates(void) {
  const double start[] = {0.0, 0.0, 0.0}, t[] = {10.0};
  for (int method = ROT_METHOD_RK8PD; method <= ROT_METHOD_RADAU; method++) {
    for (double at = 0.3; at < 9.0; at += 0.41) {
      rot_info info;
      law l = {BY_RATE, at, at + 0.05, -0.9, 1.0, 2, 0};
      const rot_ode_params p = problem(&l, start, 0.005, (rot_method)method);
      ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
      /* 0.05 rad/s take 0.5 s instead of 0.05 s. */
      ROT_CHECK(fabs(y[OMEGA] - 9.55) <= fmax(error[OMEGA], 1e-12));
      const double theta = 0.5 * at * at + 0.5 * (at + 0.025) + (9.5 - at) * 0.5 * (at + 9.6);
      ROT_CHECK(fabs(y[THETA] - theta) <= fmax(error[THETA], 1e-11));
    }
  }
}

/* omega' = 1 - omega/limit without the dip, t = -limit log(1 - omega/limit). */
typedef struct dip {
  double limit, at, width;
} dip;

static rot_status eased(double t, const double x[], double f[], void *ctx) {
  const dip *d = ctx;
  (void)t;
  f[0] = (1.0 - x[0] / d->limit) * (x[0] > d->at && x[0] < d->at + d->width ? 0.5 : 1.0);
  return ROT_OK;
}

static void check_dips(rot_method method, double limit, double width, double spacing,
                       double finest) {
  const double start[] = {0.0}, t[] = {2.0};
  for (double at = 0.05; at < (limit > 2.0 ? 1.7 : 1.2); at += spacing) {
    dip d = {limit, at, width};
    for (double accuracy = 1e-4; accuracy > finest; accuracy *= 1e-2) {
      rot_info info;
      const rot_ode_params p = {.dim = 1,
                                .controlled = 1,
                                .rhs = eased,
                                .ctx = &d,
                                .start = start,
                                .accuracy = accuracy,
                                .max_steps = 100000,
                                .method = method,
                                .resolution = 0.005};
      ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
      /* The dip takes twice its time. */
      const double more = limit * log((1.0 - at / limit) / (1.0 - (at + width) / limit));
      const double omega = -limit * expm1(-(2.0 - more) / limit);
      ROT_CHECK(fabs(y[0] - omega) <= fmax(error[0], 1e-13));
    }
  }
}

/* Ten times narrower: found where that is asked for, at ten times the probes. */
static void check_resolution(void) {
  const double start[] = {0.0, 10.0, 0.0}, t[] = {10.0};
  size_t calls[2];
  for (int fine = 0; fine < 2; fine++) {
    rot_info info;
    law l = {NOWHERE, 0.0, 0.0, 0.0, 0.0, 2, 0};
    rot_ode_params p = problem(&l, start, fine ? 0.0005 : 0.005, ROT_METHOD_NONE);
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    calls[fine] = l.calls;
    for (double at = 30.3; fine && at < 80.0; at += 1.03) {
      law narrow = {BY_ANGLE, at, at + 0.055, 4.0, 0.0, 2, 0};
      p = problem(&narrow, start, 0.0005, ROT_METHOD_NONE);
      ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
      ROT_CHECK(fabs(y[OMEGA] - sqrt(100.44)) <= fmax(error[OMEGA], 1e-13));
    }
  }
  printf("calls of a law without a change: %zu, %zu for a tenth of the width\n", calls[0],
         calls[1]);
  /* 1.43/resolution places, of which the steps' own calls are some. */
  ROT_CHECK(calls[0] > 286 && calls[0] < 286 + 200 && calls[1] > 2700 && calls[1] < 2860 + 400);
}

/* A swing passes its angles again and again: they are looked at once. */
typedef struct swing {
  double height;
  size_t calls;
} swing;

static rot_status pendulum(double t, const double x[], double f[], void *ctx) {
  swing *s = ctx;
  (void)t;
  s->calls++;
  f[0] = x[1];
  f[1] = -4.0 * x[0] + (x[0] > 0.300 && x[0] < 0.312 ? s->height : 0.0);
  return ROT_OK;
}

static void check_swings(void) {
  const double start[] = {1.0, 0.0}, t[] = {100.0};
  size_t calls[2];
  double x[2];
  for (int looked = 0; looked < 2; looked++) {
    swing s = {0.0, 0};
    rot_info info;
    const rot_ode_params p = {.dim = 2,
                              .controlled = 2,
                              .rhs = pendulum,
                              .ctx = &s,
                              .start = start,
                              .accuracy = 1e-9,
                              .max_steps = 100000,
                              .resolution = looked ? 0.005 : 0.0,
                              .expensive = 1};
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, x, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK(fabs(x[0] - cos(200.0)) <= error[0] && fabs(x[1] + 2.0 * sin(200.0)) <= error[1]);
    calls[looked] = s.calls;
  }
  printf("calls of a swing: %zu, looked at %zu\n", calls[0], calls[1]);
  ROT_CHECK(calls[1] < calls[0] + 400 && 10 * calls[1] < 11 * calls[0]);
  /* A change that keeps an energy: 2 x^2 less 0.5 (x - 0.3) there, so that each swing ends where it
   * would without, at rest at 1 and, less 0.006 J, at -x1. */
  swing s = {0.5, 0};
  rot_info info;
  const rot_ode_params p = {.dim = 2,
                            .controlled = 2,
                            .rhs = pendulum,
                            .ctx = &s,
                            .start = start,
                            .accuracy = 1e-9,
                            .max_steps = 100000,
                            .resolution = 0.005,
                            .expensive = 1};
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, x, NULL, error, largest, NULL, &info), ROT_OK);
  const double added = 0.5 * fmin(0.012, fmax(0.0, x[0] - 0.3)) - 0.5 * 0.012;
  const double energy = 0.5 * x[1] * x[1] + 2.0 * x[0] * x[0] - added;
  ROT_CHECK(fabs(energy - 2.0) <= 4.0 * error[0] + 2.0 * error[1] + 1e-12);
}

/* Held by friction of 1 N m, pushed with 3 N m for 0.06 s: it gains 2 * 0.06 rad/s, and is at rest
 * again after 0.12 s. */
static void check_held(void) {
  const double start[] = {0.0, 0.0, 0.0}, t[] = {10.0};
  for (double at = 0.35; at < 9.0; at += 0.61) {
    rot_info info;
    law l = {BY_TIME, at, at + 0.06, 3.0, 0.0, 2, 0};
    const rot_ode_switch turn = {OMEGA, IMPULSE, 1.0};
    rot_ode_params p = problem(&l, start, 0.005, ROT_METHOD_NONE);
    p.mode = &l.mode;
    p.turn = &turn;
    l.mode = 1;
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK(y[OMEGA] == 0.0);
    ROT_CHECK_REL(y[THETA], 0.5 * 0.12 * (0.06 + 0.12), 1e-9);
  }
}

/* A law that is not finite in a narrow interval is met there. */
static rot_status broken(double t, const double x[], double f[], void *ctx) {
  (void)x, (void)ctx;
  f[0] = fabs(t - 6.02) < 0.026 ? NAN : 1.0;
  return ROT_OK;
}

static void check_not_finite(void) {
  const double start[] = {0.0}, t[] = {10.0};
  rot_info info;
  rot_ode_params p = {.dim = 1,
                      .controlled = 1,
                      .rhs = broken,
                      .start = start,
                      .accuracy = 1e-9,
                      .max_steps = 100000};
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_OK);
  p.resolution = 0.005;
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, t, y, NULL, error, largest, NULL, &info), ROT_ERHS);
  ROT_CHECK(fabs(info.time_s - 5.994) < 0.06);
}

int main(void) {
  check_changes();
  check_rates();
  /* In so few implicit steps their polynomials are unsure: the probes are compared among
   * themselves. The dip is 1.12 times as wide as the resolution. */
  check_dips(ROT_METHOD_RADAU, 8.0, 0.01, 0.073, 1e-11);
  check_dips(ROT_METHOD_RK8PD, 8.0, 0.01, 0.0071, 1e-11);
  /* A rate that grows, and one that ends: 1 to 1.4 times as wide as the resolution. */
  check_dips(ROT_METHOD_RADAU, -3.0, 0.02, 0.0071, 1e-12);
  check_dips(ROT_METHOD_RADAU, 2.0, 0.01, 0.0071, 1e-12);
  check_resolution();
  check_swings();
  check_held();
  check_not_finite();
  return rot_test_report("ode_probe");
}
