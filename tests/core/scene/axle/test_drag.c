/* Stepped torque and resistance of every order: known scenes, every way to stop and to start, the
 * energy balance, published cases. */
#include <stdlib.h>

#include "axle_friction.h"
#include "scene/axle/linear.h"
#include "scene/axle/drag.h"
#include "shared_table.h"

static run r;

static void go(const rot_axle_scene *scene, size_t n, const double time_s[]) {
  run_model(&r, rot_axle_drag, scene, n, time_s);
}

static void expect_events(size_t n, const double time_s[], const rot_event kind[]) {
  ROT_CHECK_EQ_INT(r.events.count, n);
  for (size_t i = 0; i < n && i < r.events.count; i++) {
    ROT_CHECK_EQ_INT(r.events.event[i], kind[i]);
    ROT_CHECK(fabs(r.events.time_s[i] - time_s[i]) <= 1e-14 * fabs(time_s[i]));
  }
}

static rot_axle_scene rubbing(double inertia, double omega0, double coulomb, double max) {
  rot_axle_scene s = plain_scene(inertia, 0.0, omega0, 0.0);
  s.coulomb_n_m = coulomb;
  s.static_n_m = max;
  return s;
}

static void with_knots(rot_axle_scene *s, size_t n, const double t[], const double torque[]) {
  s->linear.torque = (rot_torque){n, t, torque, 0.0, 0.0, NULL, NULL};
}

/* ---- stops and starts ----------------------------------------------------------------------- */

static void check_at_rest(void) {
  /* Held at the start, 1 N m against at most 2, then 3; sliding friction 1. */
  const double knots[] = {0.0, 2.0, 2.0, 5.0}, torque[] = {1.0, 1.0, 3.0, 3.0};
  const double t[] = {0.0, 1.0, 2.0, 3.0, 5.0, 7.0, 20.0};
  rot_axle_scene s = rubbing(2.0, 0.0, 1.0, 2.0);
  with_knots(&s, 4, knots, torque);
  go(&s, 7, t);
  ROT_CHECK_EQ_INT(r.status, ROT_OK);
  /* From 2 s on 1 rad/s^2 up to 5 s, then -1/2 rad/s^2: it stops at 11 s. */
  const double omega[] = {0.0, 0.0, 0.0, 1.0, 3.0, 2.0, 0.0};
  const double theta[] = {0.0, 0.0, 0.0, 0.5, 4.5, 9.5, 13.5};
  for (int i = 0; i < 7; i++) {
    ROT_CHECK_ULP(r.omega[i], omega[i], 2);
    ROT_CHECK_ULP(r.theta[i], theta[i], 2);
  }
  /* Held: what is applied is taken up. At the start of the slip friction is at work already. */
  ROT_CHECK(r.applied[1] == 1.0 && r.damping[1] == -1.0 && r.net[1] == 0.0);
  ROT_CHECK(r.applied[2] == 3.0 && r.damping[2] == -1.0 && r.net[2] == 2.0);
  ROT_CHECK(r.damping[3] == -1.0 && r.net[3] == 2.0);
  ROT_CHECK(r.net[6] == 0.0 && r.damping[6] == 0.0);
  const double at[] = {2.0, 11.0}; /* held from the start on: no event */
  const rot_event kind[] = {ROT_EVENT_SLIP, ROT_EVENT_STICK};
  expect_events(2, at, kind);
  ROT_CHECK(r.info.measure[ROT_OMEGA].largest == 3.0);
  double stop, angle;
  ROT_CHECK_EQ_INT(rot_axle_drag_stop(&s, &stop, &angle), ROT_OK);
  ROT_CHECK_ULP(stop, 11.0, 1);
  ROT_CHECK_ULP(angle, 13.5, 1);
  /* Rows that begin when all is over, one at a time. */
  const double late[] = {11.5};
  go(&s, 1, late);
  ROT_CHECK(r.omega[0] == 0.0);
  ROT_CHECK_ULP(r.theta[0], 13.5, 2);
  expect_events(2, at, kind);
}

/* Equal to the static friction: held. The next double: not. */
static void check_equality(void) {
  const double t[] = {1.0, 2.0}, max = 0.3;
  rot_axle_scene s = rubbing(1.0, 0.0, 0.3, max);
  for (int sign = -1; sign <= 1; sign += 2) {
    s.linear.torque.before_n_m = s.linear.torque.after_n_m = sign * max;
    go(&s, 2, t);
    ROT_CHECK(r.omega[1] == 0.0 && r.theta[1] == 0.0 && r.net[1] == 0.0);
    s.linear.torque.before_n_m = s.linear.torque.after_n_m = sign * nextafter(max, 1.0);
    go(&s, 2, t);
    ROT_CHECK_ULP(r.omega[1], sign * 2.0 * (nextafter(max, 1.0) - max), 0);
    ROT_CHECK_EQ_INT(r.events.count, 0);
  }
  /* Sliding to rest against a torque as large as the static friction: it stays. */
  s.linear.omega0_rad_per_s = 0.6;
  s.linear.torque.before_n_m = s.linear.torque.after_n_m = -0.3;
  const double late[] = {0.5, 5.0};
  go(&s, 2, late);
  ROT_CHECK_ULP(r.omega[0], 0.3, 2);
  ROT_CHECK(r.omega[1] == 0.0);
  ROT_CHECK_ULP(r.theta[1], 0.3, 2);
}

/* Against a stronger torque it turns round, with the friction on the other side. */
static void check_reversal(void) {
  const double t[] = {0.5, 1.0, 2.0};
  rot_axle_scene s = rubbing(1.0, 4.0, 1.0, 1.5);
  s.linear.torque.before_n_m = s.linear.torque.after_n_m = -3.0;
  go(&s, 3, t);
  const double omega[] = {2.0, 0.0, -2.0}, theta[] = {1.5, 2.0, 1.0};
  for (int i = 0; i < 3; i++) {
    ROT_CHECK_ULP(r.omega[i], omega[i], 2);
    ROT_CHECK_ULP(r.theta[i], theta[i], 2);
  }
  ROT_CHECK(r.damping[2] == 1.0 && r.net[2] == -2.0 && r.damping[0] == -1.0);
  const double at[] = {1.0};
  const rot_event kind[] = {ROT_EVENT_REVERSE};
  expect_events(1, at, kind);
  ROT_CHECK_ULP(r.info.measure[ROT_THETA].largest, 2.0, 2); /* the turning point */
  double stop, angle;
  ROT_CHECK_EQ_INT(rot_axle_drag_stop(&s, &stop, &angle), ROT_OK);
  ROT_CHECK(isinf(stop) && isnan(angle));
}

/* No friction but q: after the stop the flow is that of the mirror image. */
static void check_mirrored_quadratic(void) {
  rot_axle_scene s = plain_scene(2.0, 0.0, 3.0, -4.0);
  s.quadratic_n_m_s2 =
      0.5; /* omega' = -2 - omega |omega|/4: atan, then tanh; stop at sqrt 2 atan */
  const double rate = sqrt(0.5), stop = atan(3.0 * rate / 2.0) / rate;
  const double t[] = {0.25 * stop, stop + 0.5, stop + 1.0, stop + 40.0};
  go(&s, 4, t);
  const double terminal = -2.0 * sqrt(2.0);
  ROT_CHECK_REL(r.omega[0], 2.0 * sqrt(2.0) * tan(rate * 0.75 * stop), 2e-15);
  for (int i = 1; i < 4; i++) {
    ROT_CHECK_REL(r.omega[i], terminal * tanh(rate * (t[i] - stop)), 2e-15);
  }
  const double top = 4.0 * 0.5 * log1p(9.0 / 8.0); /* (1/2k) log(1 + k omega^2/|a|), k = 1/4 */
  ROT_CHECK_REL(r.theta[1], top - 4.0 * log(cosh(rate * 0.5)), 2e-15);
  const rot_event kind[] = {ROT_EVENT_REVERSE};
  expect_events(1, &stop, kind);
  ROT_CHECK_ULP(rot_axle_drag_terminal(&s), terminal, 1);
}

/* Knots that repeat act for no time; knots 1e-15 apart act for as long. */
static void check_knots(void) {
  const double knots[] = {0.0, 1.0, 1.0, 1.0, 1.0, 2.0}, torque[] = {2.0, 2.0, 1e9, 1e9, 2.0, 2.0};
  const double plain_knots[] = {0.0, 2.0}, plain[] = {2.0, 2.0}, t[] = {0.5, 1.0, 1.5, 3.0};
  rot_axle_scene s = rubbing(1.0, 0.0, 1.0, 1.0);
  with_knots(&s, 6, knots, torque);
  go(&s, 4, t);
  static run a;
  rot_axle_scene one = s;
  with_knots(&one, 2, plain_knots, plain);
  run_model(&a, rot_axle_drag, &one, 4, t);
  for (int i = 0; i < 4; i++) {
    ROT_CHECK_ULP(r.omega[i], a.omega[i], 2);
    ROT_CHECK_ULP(r.theta[i], a.theta[i], 2);
  }
  ROT_CHECK_EQ_INT(r.events.count, 0); /* the stop at 4 s is beyond the rows */
  /* 1e15 N m for 2^-50 s around 1 s, on a body at rest: 0.888 rad/s, and friction does nothing. */
  const double width = 0x1p-50, pulse_t[] = {1.0, 1.0 + width}, pulse[] = {1e15, 1e15};
  rot_axle_scene hit = rubbing(1.0, 0.0, 0.1, 0.1);
  with_knots(&hit, 2, pulse_t, pulse);
  const double after[] = {1.0, 1.0 + width, 2.0};
  go(&hit, 3, after);
  const double kick = 1e15 * width;
  ROT_CHECK(r.omega[0] == 0.0);
  ROT_CHECK_ULP(r.omega[1], kick - 0.1 * width, 2);
  ROT_CHECK_REL(r.omega[2], kick - 0.1, 1e-15);
  rot_events_free(&a.events);
}

/* A jump at the very moment of the stop: what holds from then on decides, and it does not stick. */
static void check_jump_at_stop(void) {
  const double knots[] = {0.0, 2.0, 2.0, 4.0}, torque[] = {-1.0, -1.0, 2.0, 2.0};
  const double t[] = {1.0, 2.0, 3.0};
  rot_axle_scene s = rubbing(1.0, 4.0, 1.0, 1.0);
  with_knots(&s, 4, knots, torque);
  go(&s, 3, t);
  ROT_CHECK(r.omega[0] == 2.0 && r.omega[1] == 0.0 && r.omega[2] == 1.0);
  ROT_CHECK_EQ_INT(r.events.count, 0);
}

/* ---- published cases ------------------------------------------------------------------------ */

/* (J/R^2 + m) v' = 10 - 0.4 v^2 from 0.1 s on: 5 tanh(t - 0.1). The table is good to 1e-5. */
static void check_modelica(void) {
  const double knots[] = {0.1}, torque[] = {10.0};
  static double t[MAX_ROWS], theta[MAX_ROWS], omega[MAX_ROWS];
  rot_axle_scene s = plain_scene(2.0, 0.0, 0.0, 0.0);
  size_t n = 0;
  s.quadratic_n_m_s2 = 0.4;
  s.linear.torque = (rot_torque){1, knots, torque, 0.0, 10.0, NULL, NULL};
  for (n = 0; n < 500; n++) t[n] = 0.1 + 0.01 * (double)n;
  go(&s, n, t);
  for (size_t i = 0; i < n; i++) {
    const double since = t[i] - 0.1; /* rounded: 4e-16 */
    ROT_CHECK(fabs(r.omega[i] - 5.0 * tanh(since)) <= 4e-15);
    ROT_CHECK(fabs(r.theta[i] - 5.0 * (since + log1p(expm1(-2.0 * since) / 2.0))) <= 8e-15);
  }
  ROT_CHECK_ULP(rot_axle_drag_terminal(&s), 5.0, 1);
  FILE *file = shared_table("cases/modelica_torque_step_quadratic_drag/reference.csv");
  double x[3];
  if (!file) return;
  n = 0;
  while (shared_row(file, 3, x) && n < MAX_ROWS) {
    t[n] = x[0];
    theta[n] = x[1];
    omega[n] = x[2];
    n += n == 0 || t[n] >= t[n - 1];
  }
  ROT_CHECK(n > 400);
  go(&s, n, t);
  ROT_CHECK_EQ_INT(r.status, ROT_OK);
  for (size_t i = 0; i < n; i++) {
    ROT_CHECK(fabs(r.theta[i] - theta[i]) < 1e-5 && fabs(r.omega[i] - omega[i]) < 1e-5);
  }
}

static void check_coast_down(void) {
  /* 900 rpm, 5 rpm/s: 180 s and 1350 turns; after 1000 turns 458 rpm. BYU Physics 121. */
  const double turn = 6.283185307179586;
  rot_axle_scene s = rubbing(1.0, 15.0 * turn, turn / 12.0, turn / 12.0);
  double stop, angle;
  ROT_CHECK_EQ_INT(rot_axle_drag_stop(&s, &stop, &angle), ROT_OK);
  ROT_CHECK_REL(stop, 180.0, 1e-15);
  ROT_CHECK_REL(angle / turn, 1350.0, 1e-15);
  const double at[] = {180.0 - 91.65151389911680}; /* sqrt(2*5*350*12/5) s before the stop */
  go(&s, 1, at);
  ROT_CHECK_REL(r.theta[0] / turn, 1000.0, 1e-14);
  ROT_CHECK_REL(r.omega[0] / turn * 60.0, 458.2575694955840, 1e-14);
  /* J omega' = -(Tc + b omega + c omega^2). mpmath, 50 digits, for the doubles given here. */
  s = plain_scene(2.5, 0.004, 150.0, 0.0);
  s.quadratic_n_m_s2 = 2e-5;
  s.coulomb_n_m = s.static_n_m = 0.05;
  ROT_CHECK_EQ_INT(rot_axle_drag_stop(&s, &stop, &angle), ROT_OK);
  ROT_CHECK_ULP(stop, 1379.2887829199234897, 4);
  ROT_CHECK_ULP(angle, 55261.275042902383969, 6);
  s = plain_scene(1.2, 0.0, 200.0, 0.0);
  s.quadratic_n_m_s2 = 3e-4;
  const double ten[] = {10.0};
  go(&s, 1, ten);
  ROT_CHECK_REL(r.omega[0], 400.0 / 3.0, 1e-15);
  s = rubbing(1.2, 200.0, 0.3, 0.3);
  ROT_CHECK_EQ_INT(rot_axle_drag_stop(&s, &stop, &angle), ROT_OK);
  ROT_CHECK_REL(stop, 800.0, 1e-15);
  ROT_CHECK_REL(angle, 80000.0, 1e-15);
}

/* ---- against the linear model, energy ------------------------------------------------------- */

static void check_limits(void) {
  const double knots[] = {0.5, 1.5, 1.5, 3.0}, torque[] = {2.0, 2.0, -1.0, -1.0};
  const double t[] = {0.0, 0.3, 0.5, 1.0, 1.5, 2.0, 2.5, 3.5, 60.0};
  rot_axle_scene s = plain_scene(2.0, 0.7, 3.0, 0.0);
  static double c[7][16];
  const rot_axle_columns out = {c[0], c[1], c[2], c[3], c[4], c[5], c[6]};
  rot_info info;
  with_knots(&s, 4, knots, torque);
  ROT_CHECK_EQ_INT(rot_axle_linear(&s.linear, 9, t, &out, NULL, &info), ROT_OK);
  const double small[][2] = {{0.0, 0.0}, {1e-18, 0.0}, {0.0, 1e-18}};
  for (int k = 0; k < 3; k++) {
    s.coulomb_n_m = s.static_n_m = small[k][0];
    s.quadratic_n_m_s2 = small[k][1];
    go(&s, 9, t);
    for (int i = 0; i < 9; i++) {
      ROT_CHECK(fabs(r.omega[i] - c[1][i]) <= 3e-15 && fabs(r.theta[i] - c[0][i]) <= 1e-14);
      ROT_CHECK(r.applied[i] == c[2][i]);
    }
  }
}

static void check_balance(void) {
  const double knots[] = {0.0, 1.0, 1.0, 2.0}, torque[] = {5.0, 5.0, -4.0, -4.0};
  rot_axle_scene s = plain_scene(0.7, 0.4, -2.0, 0.0);
  s.quadratic_n_m_s2 = 0.3;
  s.coulomb_n_m = 0.5;
  s.static_n_m = 0.8;
  with_knots(&s, 4, knots, torque);
  const double end[] = {30.0};
  go(&s, 1, end);
  ROT_CHECK_EQ_INT(r.events.count, 3); /* two reversals and the stop */
  double edge[] = {0.0, 0.0, 1.0, 0.0, 2.0, 0.0};
  for (int i = 0; i < 3; i++) edge[2 * i + 1] = r.events.time_s[i];
  check_energy(rot_axle_drag, &s, 6, edge, 2e-14);
}

/* Thousands of pieces: the angle is summed to twice the precision, and the bounds add up. */
static void check_many_pieces(void) {
  enum { PIECES = 2000 };
  static double knots[PIECES], torque[PIECES];
  const double end[] = {4.0 * PIECES}, short_end[] = {1.0};
  rot_axle_scene s = plain_scene(1.0, 0.0, 0.1, 0.0);
  for (int i = 0; i < PIECES; i++) knots[i] = 0.3 * i;
  with_knots(&s, PIECES, knots, torque);
  go(&s, 1, end);
  ROT_CHECK_ULP(r.theta[0], 0.1 * 4.0 * PIECES, 2);
  ROT_CHECK(r.omega[0] == 0.1);
  const double all = r.info.measure[ROT_OMEGA].error;
  go(&s, 1, short_end);
  ROT_CHECK(all > 0.4 * PIECES / 4.0 * r.info.measure[ROT_OMEGA].error);
}

/* A motor's falling torque is resistance to the motion and torque in the columns. */
static void check_motor(void) {
  const double t[] = {1.0, 3.0};
  rot_axle_scene s = plain_scene(2.0, 0.5, 0.0, 6.0);
  s.linear.viscous_n_m_s = 2.0;
  s.motor_n_m_s = 1.5;
  go(&s, 2, t);
  for (int i = 0; i < 2; i++) {
    ROT_CHECK_REL(r.omega[i], -3.0 * expm1(-t[i]), 1e-15);
    ROT_CHECK_REL(r.applied[i], 6.0 - 1.5 * r.omega[i], 1e-15);
    ROT_CHECK_REL(r.damping[i], -0.5 * r.omega[i], 1e-15);
  }
}

/* ---- what is refused, and how runs end ------------------------------------------------------ */

static rot_status no_more(void *ctx, double fraction) {
  int *left = ctx;
  ROT_CHECK(fraction >= 0.0 && fraction <= 1.0);
  return --*left < 0 ? ROT_EUNWIND : ROT_OK;
}

static void check_refusals(void) {
  const double knots[] = {0.0, 1.0}, ramp[] = {0.0, 1.0}, t[] = {0.5, 2.0}, early[] = {-1.0, 0.0};
  rot_axle_scene s = plain_scene(1.0, 0.1, 1.0, 0.0);
  go(&s, 2, early);
  ROT_CHECK(r.status == ROT_EVALUE && r.info.time_s == -1.0 && r.info.rows_done == 0);
  with_knots(&s, 2, knots, ramp);
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  s = plain_scene(1.0, -0.1, 1.0, 0.0);
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  s = rubbing(1.0, 1.0, 1.0, 0.9);
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  s = plain_scene(1.0, 0.0, 1.0, 1e308);
  const double far[] = {1.0, 1e10};
  go(&s, 2, far);
  ROT_CHECK(r.status == ROT_ERANGE && r.info.rows_done == 1 && r.info.time_s == 1e10);
  s = plain_scene(1.0, 0.0, NAN, 0.0);
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_ERANGE);
  enum { MANY = 20000 };
  static double many[MANY], c[7][MANY];
  for (int i = 0; i < MANY; i++) many[i] = 1e-3 * i;
  const rot_axle_columns out = {c[0], c[1], c[2], c[3], c[4], c[5], c[6]};
  int polls = 1;
  const rot_hooks hooks = {no_more, &polls};
  s = plain_scene(1.0, 0.1, 1.0, 0.0);
  ROT_CHECK_EQ_INT(rot_axle_drag(&s, MANY, many, &out, NULL, &hooks, &r.info), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(r.info.rows_done, 16384);
  go(&s, 0, t);
  ROT_CHECK(r.status == ROT_OK && r.info.rows_done == 0);
}

/* A row at the very time of a stop: the rate errs as just before, and by four roundings of the time
 * of the stop, 10 s, times the deceleration. Behind it the body rests exactly. */
static void check_settling(void) {
  const double before[] = {10.0 * (1.0 - 1e-9)}, at[] = {10.0}, later[] = {10.1};
  const rot_axle_scene s = rubbing(1.0, 1.0, 0.1, 0.1);
  go(&s, 1, before);
  const double moving = r.info.measure[ROT_OMEGA].error;
  go(&s, 1, at);
  ROT_CHECK(fabs(r.omega[0]) <= 1e-15);
  ROT_CHECK(fabs(r.info.measure[ROT_OMEGA].error - moving - 4.0 * ROT_EPS) <= 0.5 * ROT_EPS);
  go(&s, 1, later);
  ROT_CHECK(r.omega[0] == 0.0 && r.info.measure[ROT_OMEGA].error == 0.0);
}

int main(void) {
  ROT_CHECK_EQ_INT(check_known_cases(&r, rot_axle_drag, 0), 16);
  check_mirrors(rot_axle_drag, 0);
  check_units(rot_axle_drag, 0);
  check_splits(rot_axle_drag, 0);
  check_at_rest();
  check_equality();
  check_reversal();
  check_mirrored_quadratic();
  check_knots();
  check_jump_at_stop();
  check_modelica();
  check_coast_down();
  check_limits();
  check_balance();
  check_many_pieces();
  check_motor();
  check_refusals();
  rot_events_free(&r.events);
  check_settling();
  return rot_test_report("axle_drag");
}
