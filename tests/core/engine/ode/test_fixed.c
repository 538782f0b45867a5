/* Steps of fixed length: each method's own solution, its order, events, rows between steps, how a
 * run ends. */
#include <stdlib.h>

#include "engine/ode/fixed.h"
#include "engine/ode/ode.h"
#include "ground/real.h"
#include "rot_test.h"

/* y'' = -y - friction sign(y'), sign and rest as *mode says; y[2]: the driving force, y[3]:
 * heat. */
typedef struct block {
  double friction;
  int mode;
} block;

static rot_status swing(double t, const double y[], double dydt[], void *ctx) {
  const block *b = ctx;
  (void)t;
  dydt[0] = b->mode ? y[1] : 0.0;
  dydt[1] = b->mode ? -y[0] - b->friction * b->mode : 0.0;
  dydt[2] = -y[0];
  dydt[3] = b->friction * fabs(y[1]);
  return ROT_OK;
}

static void positions(double t, double h, const double before[], double y[], void *ctx) {
  (void)t, (void)ctx;
  y[0] = before[0] + h * y[1];
}

#define check_near(got, want, max) ROT_CHECK(fabs((got) - (want)) <= (max))

enum { MAX = 64 };

typedef struct result {
  double y[MAX][4], error[4], largest[4];
  rot_info info;
  rot_events events;
} result;

static rot_ode_params problem(block *b, const double start[4], rot_method method, double step_s) {
  static const rot_ode_switch turn = {1, 2, 0.0};
  static rot_ode_switch held;
  held = turn;
  held.holds = b->friction;
  b->mode = 1;
  const rot_ode_params p = {.dim = 4,
                            .controlled = 2,
                            .rhs = swing,
                            .ctx = b,
                            .start = start,
                            .accuracy = 1.0,
                            .max_steps = 1000000,
                            .method = method,
                            .mode = &b->mode,
                            .turn = b->friction > 0.0 ? &held : NULL,
                            .step_s = step_s,
                            .positions = positions};
  return p;
}

static rot_status solve(rot_ode_params p, size_t n, const double time_s[], result *to) {
  memset(to, 0, sizeof *to);
  p.log = &to->events;
  return rot_ode_run(&p, n, time_s, to->y[0], NULL, to->error, to->largest, NULL, &to->info);
}

/* One step of each method on y'' = -y, as a matrix, to the power n. */
static void by_matrix(rot_method method, double h, int n, double y[2]) {
  const double h2 = h * h, h3 = h2 * h / 6.0, h4 = h2 * h2 / 24.0;
  for (int k = 0; k < n; k++) {
    const double x = y[0], v = y[1];
    switch (method) {
    case ROT_METHOD_EULER:
      y[0] = x + h * v;
      y[1] = v - h * x;
      break;
    case ROT_METHOD_SEMI_IMPLICIT:
      y[1] = v - h * x;
      y[0] = x + h * y[1];
      break;
    default:
      y[0] = (1.0 - h2 / 2.0 + h4) * x + (h - h3) * v;
      y[1] = (1.0 - h2 / 2.0 + h4) * v - (h - h3) * x;
    }
  }
}

static void test_methods(void) {
  static const rot_method method[] = {ROT_METHOD_EULER, ROT_METHOD_SEMI_IMPLICIT, ROT_METHOD_RK4};
  const double start[4] = {1.0, 0.5, 0.0, 0.0};
  for (int k = 0; k < 3; k++) {
    block b = {0.0, 1};
    result r;
    /* 2.53 lies between two steps: the row takes 0.03 from 2.5. */
    const double t[] = {0.0, 0.1, 2.5, 2.53, 3.0};
    ROT_CHECK_EQ_INT(solve(problem(&b, start, method[k], 0.1), 5, t, &r), ROT_OK);
    ROT_CHECK_EQ_INT((int)r.info.method, (int)method[k]);
    ROT_CHECK_EQ_INT((int)r.info.steps, 30);
    ROT_CHECK(r.info.step_s == 0.1);
    for (int i = 0; i < 5; i++) {
      double y[2] = {1.0, 0.5};
      by_matrix(method[k], 0.1, (int)(t[i] * 10.0 + 1e-9), y);
      if (i == 3) by_matrix(method[k], t[3] - 2.5, 1, y);
      check_near(r.y[i][0], y[0], 1e-14);
      check_near(r.y[i][1], y[1], 1e-14);
    }
    /* Calls: one a step and run (RK4: four), and those of the rows between. */
    const long stages = method[k] == ROT_METHOD_RK4 ? 4 : 1;
    ROT_CHECK((long)r.info.rhs_calls >= 90 * stages && (long)r.info.rhs_calls < 96 * stages + 20);
    double truth = 0.0;
    for (int i = 0; i < 5; i++) {
      truth = fmax(truth, fabs(r.y[i][0] - (cos(t[i]) + 0.5 * sin(t[i]))));
    }
    ROT_CHECK(r.error[0] >= truth && r.error[0] <= 2.0 * truth);
  }
}

/* The error falls by 2^order when the step is halved, through turns with dry friction. */
static double final_of(rot_method method, double h, double t, result *r) {
  block b = {0.125, 1};
  const double start[4] = {2.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(solve(problem(&b, start, method, h), 1, &t, r), ROT_OK);
  return r->y[0][0];
}

static void test_friction(void) {
  /* From 2 it swings about 1/8 to -7/4, about -1/8 to 3/2, ...: each half swing takes 1/4. */
  static const rot_method method[] = {ROT_METHOD_EULER, ROT_METHOD_SEMI_IMPLICIT, ROT_METHOD_RK4};
  static const double pi = 3.14159265358979323846;
  /* In the fourth half swing: about -1/8, from -5/4. */
  const double t = 3.25 * pi, exact = -0.125 - 1.125 * sqrt(0.5);
  for (int k = 0; k < 3; k++) {
    result r;
    const double order = k == 2 ? 4.0 : 1.0, h = k == 2 ? 0.05 : 1e-3;
    const double coarse = fabs(final_of(method[k], h, t, &r) - exact);
    ROT_CHECK(r.error[0] >= coarse);
    ROT_CHECK_EQ_INT((int)r.events.count, 3);
    rot_events_free(&r.events);
    const double fine = fabs(final_of(method[k], 0.5 * h, t, &r) - exact);
    check_near(log2(coarse / fine), order, 0.25);
    rot_events_free(&r.events);
  }
  /* It comes to rest after eight half swings, at 0, or before where the method gains or loses. */
  result r;
  check_near(final_of(ROT_METHOD_RK4, 0.01, 100.0, &r), 0.0, 0.126);
  ROT_CHECK(r.y[0][1] == 0.0);
  ROT_CHECK_EQ_INT((int)r.events.event[r.events.count - 1], (int)ROT_EVENT_STICK);
  rot_events_free(&r.events);
}

static void test_ends(void) {
  block b = {0.0, 1};
  result r;
  const double start[4] = {1.0, 0.5, 0.0, 0.0};
  /* Backward in time. */
  const double both[] = {-1.0, 1.0};
  ROT_CHECK_EQ_INT(solve(problem(&b, start, ROT_METHOD_RK4, 0.01), 2, both, &r), ROT_OK);
  check_near(r.y[0][0], cos(1.0) - 0.5 * sin(1.0), 1e-8);
  check_near(r.y[1][0], cos(1.0) + 0.5 * sin(1.0), 1e-8);
  /* Euler's energy grows by 1 + h^2 a step. */
  const double late[] = {1.0, 1e4};
  ROT_CHECK_EQ_INT(solve(problem(&b, start, ROT_METHOD_EULER, 1.0), 2, late, &r), ROT_ERANGE);
  ROT_CHECK_EQ_INT((int)r.info.rows_done, 1);
  ROT_CHECK(r.info.time_s > 900.0 && r.info.time_s < 1100.0);
  /* The budget; a step longer than the run; a step that time does not resolve. */
  rot_ode_params p = problem(&b, start, ROT_METHOD_RK4, 0.01);
  p.max_steps = 50;
  ROT_CHECK_EQ_INT(solve(p, 2, late, &r), ROT_EBUDGET);
  ROT_CHECK_EQ_INT((int)r.info.rows_done, 0);
  ROT_CHECK_EQ_INT(solve(problem(&b, start, ROT_METHOD_RK4, 1e6), 1, late, &r), ROT_OK);
  check_near(r.y[0][0], cos(1.0) + 0.5 * sin(1.0), 0.02);
  ROT_CHECK_EQ_INT((int)r.info.steps, 1);
  p = problem(&b, start, ROT_METHOD_EULER, 1e-20);
  p.start_s = 1.0;
  ROT_CHECK(solve(p, 1, late + 1, &r) != ROT_OK);
}

static void test_default_step(void) {
  const rot_time_scales swing = {INFINITY, 2.0}, fades = {0.5, 2.0}, none = {INFINITY, 0.0};
  check_near(rot_fixed_step_s(&swing, 10.0), 3.14159265358979 / 64.0, 1e-15);
  check_near(rot_fixed_step_s(&fades, 10.0), 0.5 / 64.0, 1e-16);
  check_near(rot_fixed_step_s(&none, 10.0), 0.01, 1e-17);
  check_near(rot_ode_fixed_factor(1, 0.01, 1.0), 2.4, 1e-15);
  check_near(rot_ode_fixed_factor(4, 1e-6, 1.0), 1.0786516853932584, 1e-15);
}

/* With one row, wherever it is, one of the two measures may have no error there: the estimate is of
 * both. */
static void check_one_row(void) {
  static const rot_method methods[] = {ROT_METHOD_EULER, ROT_METHOD_SEMI_IMPLICIT, ROT_METHOD_RK4};
  enum { ROWS = 60 };
  const double start[] = {1.0, 0.0, 0.0, 0.0};
  for (int m = 0; m < 3; m++) {
    int missed = 0;
    for (int i = 0; i < ROWS; i++) {
      block b = {0.0, 0};
      static result got;
      const double t = 6.0 + 0.11 * i;
      ROT_CHECK(solve(problem(&b, start, methods[m], 0.05), 1, &t, &got) == ROT_OK);
      missed +=
          fabs(got.y[0][0] - cos(t)) > got.error[0] || fabs(got.y[0][1] + sin(t)) > got.error[1];
      if (methods[m] == ROT_METHOD_SEMI_IMPLICIT) continue; /* its angle errs far less */
      /* A swing of amplitude 1: neither error is small against the other. */
      ROT_CHECK(got.error[0] < 3.0 * got.error[1] && got.error[1] < 3.0 * got.error[0]);
    }
    printf("one row: %d of %d missed\n", missed, ROWS);
    ROT_CHECK(missed == 0);
  }
}

/* A row within the first step, or after few steps of up to a twelfth of a turn. */
static void check_few_steps(void) {
  static const rot_method methods[] = {ROT_METHOD_EULER, ROT_METHOD_SEMI_IMPLICIT, ROT_METHOD_RK4};
  const double start[] = {0.6, 0.8, 0.0, 0.0};
  for (int m = 0; m < 3; m++) {
    int missed = 0;
    for (int i = 1; i <= 60; i++) {
      block b = {0.0, 0};
      static result got;
      const double t = 0.025 * i;
      ROT_CHECK(solve(problem(&b, start, methods[m], 0.5), 1, &t, &got) == ROT_OK);
      missed += fabs(got.y[0][0] - (0.6 * cos(t) + 0.8 * sin(t))) > got.error[0];
      missed += fabs(got.y[0][1] - (0.8 * cos(t) - 0.6 * sin(t))) > got.error[1];
    }
    printf("few steps: %d of 120 missed\n", missed);
    ROT_CHECK(missed == 0);
  }
}

int main(void) {
  test_methods();
  test_friction();
  test_ends();
  test_default_step();
  check_one_row();
  check_few_steps();
  return rot_test_report("ode_fixed");
}
