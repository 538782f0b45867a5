/* The flow of drag: against 40-digit values, its bounds, its branches where they meet. */
#include <stdlib.h>

#include "maths/drag.h"
#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

static rot_drag flow_of(double a, double b, double k, double omega0, double t) {
  const rot_drag_law law = {a, 0.0, b, k, 1.0};
  return rot_drag_from(&law, omega0, t);
}

static void check_row(double a, double b, double k, double omega0, double t, double theta,
                      double omega, double stop) {
  const rot_drag flow = flow_of(a, b, k, omega0, t);
  const rot_drag_state at = rot_drag_at(&flow, t, 0.0);
  /* Half a unit in the last place is the known value's own. */
  ROT_CHECK(fabs(at.omega - omega) <= at.omega_error + ROT_EPS * omega);
  ROT_CHECK(fabs(at.theta - theta) <= at.theta_error + ROT_EPS * theta);
  ROT_CHECK(at.theta_error <= 70.0 * ROT_EPS * theta + 1e-320);
  ROT_CHECK_ULP(rot_drag_stop(&flow), stop, 4);
  ROT_CHECK_ULP(at.theta, theta, 8); /* 7 seen, 36 000 cases */
  if (a >= 0.0) {
    ROT_CHECK_ULP(at.omega, omega, 6); /* 5 seen */
    ROT_CHECK_ULP(at.theta, theta, 5); /* 4 seen */
    ROT_CHECK(at.omega_error <= 40.0 * ROT_EPS * omega);
  }
}

/* a, b, k, omega0, t, theta, omega, stop: mpmath, 1200 digits. */
static const double known[][8] = {
#include "drag_cases.h"
};

static void check_known(void) {
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    const double *x = known[i];
    check_row(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
  }
}

static void check_shared_table(void) {
  FILE *file = shared_table("refs/quad_drag.csv");
  double x[8];
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 8, x)) {
    check_row(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
    rows++;
  }
  ROT_CHECK(rows >= 60);
}

/* The inertia divides, and powers of two of it change nothing. */
static void check_inertia(void) {
  for (int p = -900; p <= 900; p += 300) {
    const rot_drag_law law = {ldexp(3.0, p), 0.0, ldexp(0.7, p), ldexp(0.2, p), ldexp(1.0, p)};
    const rot_drag flow = rot_drag_from(&law, 0.4, 2.0), one = flow_of(3.0, 0.7, 0.2, 0.4, 2.0);
    const rot_drag_state at = rot_drag_at(&flow, 2.0, 0.0), want = rot_drag_at(&one, 2.0, 0.0);
    ROT_CHECK(at.omega == want.omega && at.theta == want.theta);
    ROT_CHECK(at.omega_error == want.omega_error && at.reach_s == want.reach_s);
  }
}

/* gain and reach are derivatives. */
static void check_derivatives(void) {
  const double law[][5] = {{2.0, 0.5, 0.3, 1.0, 0.2},  {2.0, 0.5, 0.3, 1.0, 5.0},
                           {0.0, 0.0, 0.3, 1.0, 2.0},  {-0.5, 0.5, 0.3, 1.0, 0.3},
                           {-0.1, 2.0, 0.1, 1.0, 1.2}, {1.0, 0.0, 0.0, 1.0, 2.0}};
  for (int i = 0; i < 6; i++) {
    const double *x = law[i], d = 1e-6;
    const rot_drag mid = flow_of(x[0], x[1], x[2], x[3], x[4]);
    const rot_drag up = flow_of(x[0], x[1], x[2], x[3] + d, x[4]);
    const rot_drag down = flow_of(x[0], x[1], x[2], x[3] - d, x[4]);
    const rot_drag_state m = rot_drag_at(&mid, x[4], 0.0), u = rot_drag_at(&up, x[4], 0.0),
                         l = rot_drag_at(&down, x[4], 0.0);
    ROT_CHECK(fabs(m.gain - (u.omega - l.omega) / (2.0 * d)) <= 1e-9);
    ROT_CHECK_REL(m.reach_s, (u.theta - l.theta) / (2.0 * d), 1e-8);
  }
}

static void check_terminal(void) {
  const rot_drag_law both = {6.0, 0.0, 1.0, 1.0, 3.0}, viscous = {6.0, 0.0, 4.0, 0.0, 3.0},
                     quadratic = {8.0, 0.0, 0.0, 2.0, 3.0}, none = {1.0, 0.0, 0.0, 0.0, 1.0},
                     held = {-1.0, 0.0, 1.0, 1.0, 1.0};
  ROT_CHECK_ULP(rot_drag_terminal(&both), 2.0, 1);
  ROT_CHECK_ULP(rot_drag_terminal(&viscous), 1.5, 1);
  ROT_CHECK_ULP(rot_drag_terminal(&quadratic), 2.0, 1);
  ROT_CHECK(isinf(rot_drag_terminal(&none)));
  ROT_CHECK(rot_drag_terminal(&held) == 0.0);
  /* k tiny: the plain root (s - b/2)/k is 0/0 or 10 % off. */
  const rot_drag_law faint = {1.0, 0.0, 1.0, 1e-17, 1.0};
  ROT_CHECK_ULP(rot_drag_terminal(&faint), 1.0, 1);
}

/* The angle of a coast-down that never ends, mpmath at 50 digits: I, c, q, omega0, I w/c or
 * I/q log(1 + q w/c). */
static void check_reach(void) {
  static const double x[][5] = {
      {2.5, 0.004, 0.0, 150.0, 93749.999999999998048},
      {2.5, 0.004, 2e-05, 150.0, 69951.973491927833329},
      {1.2, 1e-12, 0.0003, 200.0, 99270.441596740718783},
      {0.7, 3.0, 1e-18, 0.1, 0.023333333333333333148},
      {0.001, 100000.0, 2.0, 0.001, 9.9999999000000017497e-12},
      {1e+200, 1e-50, 1e+100, 1e+100, 5.7564627324851139445e+102},
      {3.0, 1e-300, 1e+200, 1e+200, 4.8354286952874960825e-197},
      {1e-300, 1e-300, 1e-300, 1.0, 0.69314718055994530942},
  };
  for (size_t i = 0; i < sizeof x / sizeof *x; i++) {
    const rot_drag_law law = {0.0, 0.0, x[i][1], x[i][2], x[i][0]};
    ROT_CHECK_REL(rot_drag_reach(&law, x[i][3]), x[i][4], 1e-15);
  }
  const rot_drag_law quadratic = {0.0, 0.0, 0.0, 2.0, 3.0}, driven = {1.0, 0.0, 1.0, 0.0, 1.0};
  ROT_CHECK(isinf(rot_drag_reach(&quadratic, 1.0)) && rot_drag_reach(&quadratic, 0.0) == 0.0);
  ROT_CHECK(isnan(rot_drag_reach(&driven, 1.0)));
}

/* Nothing is lost at the ends: no time, no drag, NaN. */
static void check_ends(void) {
  const rot_drag still = flow_of(1.0, 1.0, 1.0, 0.5, 0.0);
  rot_drag_state at = rot_drag_at(&still, 0.0, 0.0);
  ROT_CHECK_ULP(at.omega, 0.5, 1);
  ROT_CHECK(at.theta == 0.0 && at.theta_error == 0.0);
  const rot_drag free_spin = flow_of(0.0, 0.0, 0.0, 0.5, 8.0);
  at = rot_drag_at(&free_spin, 8.0, 0.0);
  ROT_CHECK(at.omega == 0.5);
  ROT_CHECK_ULP(at.theta, 4.0, 1);
  ROT_CHECK(isinf(rot_drag_stop(&free_spin)));
  /* k omega0 t = 1e290: log(1 + 1e290)/k, 1/(k t) */
  const rot_drag huge = flow_of(0.0, 0.0, 1e100, 1e90, 1e100);
  at = rot_drag_at(&huge, 1e100, 0.0);
  ROT_CHECK_REL(at.omega, 1e-200, 1e-15);
  ROT_CHECK_REL(at.theta, 667.74967696827324836e-100, 1e-15);
  /* a k is no normal number, and its root none with 53 bits: omega0 + a t. */
  for (double k = 5e-324; k < 1e-300; k *= 1.7 + 1e-323 / k) {
    const rot_drag slow = flow_of(-1.0, 0.0, k, 3.0, 2.0);
    ROT_CHECK_REL(rot_drag_at(&slow, 2.0, 0.0).omega, 1.0, 1e-15);
  }
  const rot_drag bad = flow_of(NAN, 1.0, 1.0, 0.5, 1.0);
  at = rot_drag_at(&bad, 1.0, 0.0);
  ROT_CHECK(isnan(at.omega) && isnan(at.theta));
  /* A time known to twice the precision: the second half counts. */
  const rot_drag fast = flow_of(0.0, 700.0, 0.0, 1.0, 1.0);
  const double late = rot_drag_at(&fast, 1.0, 0x1p-54).omega;
  ROT_CHECK_ULP(late, rot_drag_at(&fast, 1.0, 0.0).omega * (1.0 - 700.0 * 0x1p-54), 1);
}

int main(void) {
  check_known();
  check_shared_table();
  check_inertia();
  check_derivatives();
  check_terminal();
  check_reach();
  check_ends();
  return rot_test_report("drag");
}
