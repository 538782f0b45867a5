/* Laws that jump or kink at a value of one component or at a time, and slide there; by hand. */
#include "engine/ode/ode.h"
#include "rot_test.h"

typedef struct law {
  int which;
  size_t calls;
} law;

enum {
  FRICTION,
  FORCED_FRICTION,
  STEP_IN_OMEGA,
  BANG,
  TWO_SPRINGS,
  STEP_IN_TIME,
  WAVE,
  FILM,
  LOST
};

static double sign(double x) { return (x > 0.0) - (x < 0.0); }

static rot_status slope(double t, const double y[], double f[], void *ctx) {
  law *l = ctx;
  l->calls++;
  f[0] = y[1];
  switch (l->which) {
  case FRICTION: f[1] = -0.5 * sign(y[1]); break;
  case FORCED_FRICTION: f[1] = sin(t) - 0.5 * sign(y[1]); break;
  case STEP_IN_OMEGA: f[1] = y[1] < 1.0 ? 0.5 : 2.0; break;
  case BANG: f[1] = -2.0 * sign(y[0]); break;
  case TWO_SPRINGS: f[1] = -y[0] * (y[0] > 0.0 ? 4.0 : 1.0); break;
  case STEP_IN_TIME: f[1] = t < 0.7 ? 1.0 : -3.0; break;
  case WAVE: f[1] = t - floor(t) < 0.5 ? 1.0 : -1.0; break;
  case LOST: /* beyond omega = 0 there is nothing any more from 8 s on */
    if (y[1] > 0.0 && t > 8.0) return ROT_ERHS;
    f[1] = sin(t) + (y[1] > 0.0 ? 0.25 : 0.0) - 0.1 * y[0];
    break;
  default: f[1] = y[1] > 0.0 ? -1.0 - y[0] : 2.0; break; /* slides while y[0] > -1 */
  }
  return ROT_OK;
}

/* The last state against theta and omega, within the estimate and the accuracy. */
static void go(int which, double theta0, double omega0, double start, double end, double theta,
               double omega, size_t max_calls) {
  const double y0[] = {theta0, omega0};
  for (int method = ROT_METHOD_RK8PD; method <= ROT_METHOD_RADAU; method++) {
    double t[5], y[10], error[2], largest[2];
    rot_info info;
    law l = {which, 0};
    rot_ode_params p = {.dim = 2,
                        .controlled = 2,
                        .rhs = slope,
                        .ctx = &l,
                        .start_s = start,
                        .start = y0,
                        .accuracy = 1e-9,
                        .max_steps = 100000,
                        .method = (rot_method)method};
    const int back = end < start;
    for (int i = 0; i < 5; i++) t[i] = (back ? end : start) + i / 4.0 * fabs(end - start);
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 5, t, y, NULL, error, largest, NULL, &info), ROT_OK);
    const double *last = back ? y : y + 8;
    ROT_CHECK(fabs(last[0] - theta) <= fmin(error[0], 1e-9) + 1e-14 * (1.0 + fabs(theta)));
    ROT_CHECK(fabs(last[1] - omega) <= fmin(error[1], 1e-9) + 1e-14 * (1.0 + fabs(omega)));
    if (method == ROT_METHOD_RK8PD) ROT_CHECK(l.calls < max_calls);
  }
}

/* Dry friction as sign(omega): at rest from 2 s on. */
static void check_friction(void) { go(FRICTION, 0.0, 1.0, 0.0, 5.0, 1.0, 0.0, 2000); }

/* sin t breaks loose where it is 1/2; omega = cos(pi/6) - cos t - (t - pi/6)/2 from there. */
static void check_breaking_loose(void) {
  const double loose = asin(0.5), t = 2.0, u = t - loose;
  go(FORCED_FRICTION, 0.3, 0.0, 0.0, t, 0.3 + cos(loose) * u - (sin(t) - sin(loose)) - 0.25 * u * u,
     cos(loose) - cos(t) - 0.5 * u, 3000);
}

/* The step that ends a hold goes beyond its end by a part of itself, which is lost as the square:
 * nothing of it is seen. At an accuracy of 1e-12 the rest is exact, too. */
static void check_end_of_hold(void) {
  const double y0[] = {0.3, 0.0}, t = 1.0, loose = asin(0.5), u = t - loose;
  for (int method = ROT_METHOD_RK8PD; method <= ROT_METHOD_RADAU; method++) {
    double y[2], error[2], largest[2];
    rot_info info;
    law l = {FORCED_FRICTION, 0};
    const rot_ode_params p = {.dim = 2,
                              .controlled = 2,
                              .rhs = slope,
                              .ctx = &l,
                              .start = y0,
                              .accuracy = 1e-12,
                              .max_steps = 100000,
                              .method = (rot_method)method};
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK(fabs(y[0] - (0.3 + cos(loose) * u - (sin(t) - sin(loose)) - 0.25 * u * u)) < 1e-14);
    ROT_CHECK(fabs(y[1] - (cos(loose) - cos(t) - 0.5 * u)) < 1e-14);
    ROT_CHECK(error[0] < 1e-12 && error[1] < 1e-12);
  }
}

static void check_jump_in_omega(void) {
  go(STEP_IN_OMEGA, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 1500); /* omega = 1 at 2 s */
  go(STEP_IN_OMEGA, 3.0, 3.0, 3.0, 0.0, 0.0, 0.0, 1500); /* and back */
}

/* theta = 1 - t^2 up to 1 s, then parabolas of 2 s: at 5 s through zero downward, as at 1 s. */
static void check_jump_in_theta(void) { go(BANG, 1.0, 0.0, 0.0, 5.0, 0.0, -2.0, 2500); }

/* Half periods of pi/2 above and pi below zero: from rest at 1 it is back after 3 pi/2. */
static void check_kink(void) {
  go(TWO_SPRINGS, 1.0, 0.0, 0.0, 1.5 * acos(-1.0), 1.0, 0.0, 3000);
  go(TWO_SPRINGS, 1.0, 0.0, 0.0, 0.75 * acos(-1.0), -2.0, 0.0, 3000);
}

static void check_jump_in_time(void) {
  /* omega = 0.7 at 0.7 s, then 0.7 - 3 u. */
  const double u = 1.3;
  go(STEP_IN_TIME, 0.0, 0.0, 0.0, 2.0, 0.245 + 0.7 * u - 1.5 * u * u, 0.7 - 3.0 * u, 1500);
}

/* From omega = -1: up at 2 rad/s^2, on to the surface at 1/2 s with theta = -1/4, and held: above
 * it the slope is -3/4, below it 2. */
static void check_slide(void) { go(FILM, 0.0, -1.0, 0.0, 4.0, -0.25, 0.0, 2000); }

/* Collocation knows no sliding, so calls that cost much are not spent on a try of it. */
static void check_slide_of_costly_law(void) {
  const double y0[] = {0.0, -1.0}, t = 4.0;
  size_t calls[2];
  for (int expensive = 0; expensive < 2; expensive++) {
    double y[2], error[2], largest[2];
    rot_info info;
    law l = {FILM, 0};
    const rot_ode_params p = {.dim = 2,
                              .controlled = 2,
                              .rhs = slope,
                              .ctx = &l,
                              .start = y0,
                              .accuracy = 1e-9,
                              .max_steps = 100000,
                              .expensive = expensive};
    ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
    ROT_CHECK(fabs(y[0] + 0.25) <= 1e-14 && fabs(y[1]) <= 1e-14);
    calls[expensive] = l.calls;
  }
  ROT_CHECK_EQ_INT((long long)calls[1], (long long)calls[0]);
}

/* Where the far side of a surface has lost its law the run ends on the surface, and does not search
 * for a way along it. */
static void check_lost_side(void) {
  const double y0[] = {0.0, -0.5};
  double t[41], y[82], error[2], largest[2];
  rot_info info;
  law l = {LOST, 0};
  const rot_ode_params p = {.dim = 2,
                            .controlled = 2,
                            .rhs = slope,
                            .ctx = &l,
                            .start = y0,
                            .accuracy = 1e-9,
                            .max_steps = 100000};
  for (int i = 0; i < 41; i++) t[i] = 0.5 * i;
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 41, t, y, NULL, error, largest, NULL, &info), ROT_ERHS);
  ROT_CHECK_EQ_INT((long long)info.rows_done, 17);
  /* Nearly -0.284 + sin(8.2) u: zero some 0.47 s after the row at 8 s, by a series of omega. */
  const double omega = y[33], pull = sin(8.0) - 0.1 * y[32], u = info.time_s - 8.0;
  ROT_CHECK(fabs(omega + pull * u + 0.5 * (cos(8.0) - 0.1 * omega) * u * u) < 0.03);
  ROT_CHECK(l.calls < 1130);
}

/* A square wave of 257 periods: each turns it by 1/4, and leaves no rate. */
static void check_many_jumps(void) {
  const double y0[] = {0.0, 0.0}, t = 257.25;
  double y[2], error[2], largest[2];
  rot_info info;
  law l = {WAVE, 0};
  const rot_ode_params p = {.dim = 2,
                            .controlled = 2,
                            .rhs = slope,
                            .ctx = &l,
                            .start = y0,
                            .accuracy = 1e-9,
                            .max_steps = 1000000};
  ROT_CHECK_EQ_INT(rot_ode_run(&p, 1, &t, y, NULL, error, largest, NULL, &info), ROT_OK);
  printf("257 periods: off by %.1e, estimate %.1e, %zu calls\n",
         fabs(y[0] - 257.0 / 4.0 - 1.0 / 32.0), error[0], l.calls);
  ROT_CHECK(fabs(y[0] - 257.0 / 4.0 - 1.0 / 32.0) <= error[0] && error[0] <= 1e-7);
  ROT_CHECK(fabs(y[1] - 0.25) <= error[1] && error[1] <= 1e-9);
  ROT_CHECK(l.calls < 400000);
}

int main(void) {
  check_many_jumps();
  check_friction();
  check_breaking_loose();
  check_jump_in_omega();
  check_jump_in_theta();
  check_kink();
  check_jump_in_time();
  check_slide();
  check_end_of_hold();
  check_lost_side();
  check_slide_of_costly_law();
  return rot_test_report("ode_wall");
}
