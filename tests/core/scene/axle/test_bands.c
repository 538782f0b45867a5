/* Torque in straight lines over time and over omega, with friction: known scenes, the ways to meet
 * an edge, agreement with the models that it contains. */
#include "axle_friction.h"
#include "scene/axle/linear.h"
#include "scene/axle/bands.h"
#include "scene/axle/drag.h"

static run r, other;

static void go(const rot_axle_scene *scene, size_t n, const double time_s[]) {
  run_model(&r, rot_axle_bands, scene, n, time_s);
}

static void with_knots(rot_axle_scene *s, size_t n, const double t[], const double torque[]) {
  s->linear.torque = (rot_torque){n, t, torque, 0.0, 0.0, NULL, NULL};
}

static void with_curve(rot_axle_scene *s, rot_term *term, size_t length, const double x[]) {
  *term = (rot_term){ROT_TERM_CURVE, -INFINITY, INFINITY, length, x};
  s->n_terms = 1;
  s->terms = term;
}

/* Rows of two runs agree within the bounds of both. */
static void expect_same(const run *a, const run *b, size_t n) {
  const double theta = a->info.measure[ROT_THETA].error + b->info.measure[ROT_THETA].error;
  const double omega = a->info.measure[ROT_OMEGA].error + b->info.measure[ROT_OMEGA].error;
  for (size_t i = 0; i < n; i++) {
    ROT_CHECK(fabs(a->theta[i] - b->theta[i]) <= theta);
    ROT_CHECK(fabs(a->omega[i] - b->omega[i]) <= omega);
  }
}

/* ---- the models that this one contains ------------------------------------------------------ */

/* rot_axle_linear() as a model. */
static rot_status linear(const rot_axle_scene *scene, size_t n, const double time_s[],
                         const rot_axle_columns *out, rot_events *events, const rot_hooks *hooks,
                         rot_info *info) {
  (void)events;
  return rot_axle_linear(&scene->linear, n, time_s, out, hooks, info);
}

static void check_linear(void) {
  const double knots[] = {0.5, 1.5, 1.5, 3.0}, torque[] = {2.0, 3.0, -4.0, 1.0};
  const double t[] = {0.0, 0.3, 0.5, 1.0, 1.5, 2.0, 2.5, 3.5, 60.0};
  const double c[] = {0.7, 0.0, -0.1, 1e8};
  rot_term term;
  for (int k = 0; k < 4; k++) {
    rot_axle_scene s = plain_scene(2.0, c[k], 3.0, 0.0);
    with_knots(&s, 4, knots, torque);
    go(&s, 9, t);
    run_model(&other, linear, &s, 9, t);
    expect_same(&r, &other, 9);
    for (int i = 0; i < 9; i++) ROT_CHECK(r.applied[i] == other.applied[i]);
    /* Friction too small to be felt. */
    s.coulomb_n_m = s.static_n_m = 1e-19;
    go(&s, 9, t);
    expect_same(&r, &other, 9);
    /* A straight curve with many points is more resistance: -omega/2 around 1 N m at 0. */
    const double curve[] = {5, -40.0, -1.0, 0.5, 1.0, 40.0, 21.0, 1.5, 0.75, 0.5, -19.0};
    const double above[] = {3.0, 4.0, -3.0, 2.0};
    s.coulomb_n_m = s.static_n_m = 0.0;
    with_curve(&s, &term, 11, curve);
    go(&s, 9, t);
    ROT_CHECK_EQ_INT(r.status, ROT_OK);
    rot_axle_scene more = plain_scene(2.0, c[k] + 0.5, 3.0, 0.0);
    more.linear.torque = (rot_torque){4, knots, above, 1.0, 1.0, NULL, NULL};
    run_model(&other, linear, &more, 9, t);
    if (c[k] < 1e6) expect_same(&r, &other, 9);
  }
}

/* Steps and friction alone are a scene of the drag model too. */
static void check_drag(void) {
  const double *x = friction_scenes;
  int compared = 0;
  for (int i = 0; i < FRICTION_SCENES; i++) {
    friction_case c;
    x = read_case(x, &c);
    if (c.model != 0) continue;
    c.scene.quadratic_n_m_s2 = 0.0;
    run_model(&other, rot_axle_drag, &c.scene, c.rows, c.time_s);
    go(&c.scene, c.rows, c.time_s);
    expect_same(&r, &other, c.rows);
    ROT_CHECK_EQ_INT(r.events.count, other.events.count);
    for (size_t k = 0; k < r.events.count && k < other.events.count; k++) {
      ROT_CHECK_EQ_INT(r.events.event[k], other.events.event[k]);
      ROT_CHECK(fabs(r.events.time_s[k] - other.events.time_s[k]) <= 1e-13 * fabs(c.time_s[4]));
    }
    compared += r.status == ROT_OK;
  }
  ROT_CHECK_EQ_INT(compared, 16);
}

/* ---- friction under a ramp ------------------------------------------------------------------ */

static void check_ramp(void) {
  /* Torque t from -3 to 5 s, static friction 2, sliding 1: it breaks loose at 2 s, and then
   * omega' = t - 1: omega = (t - 1)^2/2 - 1/2. Before: held from the start on; at the start the
   * torque is -3, and it slides backward: omega' = t + 1 from rest at -3 s, back to rest at 1 s. */
  const double knots[] = {-3.0, 5.0}, torque[] = {-3.0, 5.0};
  const double t[] = {-3.0, -2.0, -1.0, 0.0, 1.0, 1.5, 2.0, 3.0, 5.0};
  rot_axle_scene s = plain_scene(1.0, 0.0, 0.0, 0.0);
  s.linear.start_s = -3.0;
  s.coulomb_n_m = 1.0;
  s.static_n_m = 2.0;
  with_knots(&s, 2, knots, torque);
  go(&s, 9, t);
  for (int i = 0; i < 9; i++) {
    const double u = t[i];
    const double omega = u <= 1.0   ? 0.5 * (u + 3.0) * (u - 1.0)
                         : u <= 2.0 ? 0.0
                                    : 0.5 * u * (u - 2.0);
    ROT_CHECK(fabs(r.omega[i] - omega) <= 1e-15 * (1.0 + fabs(omega)));
  }
  /* integral of (u + 3)(u - 1)/2 from -3 to 1 */
  ROT_CHECK_REL(r.theta[5], -16.0 / 3.0, 1e-15);
  ROT_CHECK_REL(r.theta[7], -16.0 / 3.0 + 2.0 / 3.0, 1e-15);
  const double at[] = {1.0, 2.0};
  const rot_event kind[] = {ROT_EVENT_STICK, ROT_EVENT_SLIP};
  ROT_CHECK_EQ_INT(r.events.count, 2);
  for (size_t i = 0; i < 2 && i < r.events.count; i++) {
    ROT_CHECK_EQ_INT(r.events.event[i], kind[i]);
    ROT_CHECK(fabs(r.events.time_s[i] - at[i]) <= 1e-15);
  }
  ROT_CHECK(r.net[5] == 0.0 && r.damping[5] == -1.5);
  ROT_CHECK_REL(r.info.measure[ROT_OMEGA].largest, 7.5, 1e-15);
  /* Static = sliding friction, a triangle that just reaches it: held all the time. */
  const double three[] = {0.0, 1.0, 2.0}, up[] = {0.0, 0.1, 0.0}, rows[] = {0.5, 1.0, 3.0};
  s = plain_scene(1.0, 0.0, 0.0, 0.0);
  s.coulomb_n_m = s.static_n_m = 0.1;
  with_knots(&s, 3, three, up);
  go(&s, 3, rows);
  ROT_CHECK(r.status == ROT_OK && r.events.count == 0 && r.omega[2] == 0.0 && r.theta[2] == 0.0);
  /* It slows down, touches rest where the torque equals the sliding friction, and is held there:
   * omega' = t - 1 from 1/2. The torque never exceeds the static friction. */
  const double touch_t[] = {0.0, 2.0}, touch[] = {0.0, 2.0}, held[] = {0.5, 1.5, 3.0};
  s = plain_scene(1.0, 0.0, 0.5, 0.0);
  s.coulomb_n_m = 1.0;
  s.static_n_m = 2.0;
  with_knots(&s, 2, touch_t, touch);
  go(&s, 3, held);
  ROT_CHECK(r.omega[0] == 0.125 && r.omega[1] == 0.0 && r.omega[2] == 0.0);
  ROT_CHECK_ULP(r.theta[2], 1.0 / 6.0, 2);
  ROT_CHECK(r.events.count == 1 && r.events.event[0] == ROT_EVENT_STICK);
  ROT_CHECK_ULP(r.events.time_s[0], 1.0, 1);
  /* Without any friction rest is left at once: omega = t^2/2 - t, back through 0 at 2 s. */
  const double two[] = {0.0, 4.0}, line[] = {-1.0, 3.0}, later[] = {1.0, 2.0, 3.0};
  s = plain_scene(1.0, 0.0, 0.0, 0.0);
  with_knots(&s, 2, two, line);
  go(&s, 3, later);
  ROT_CHECK_ULP(r.omega[0], -0.5, 1);
  ROT_CHECK(fabs(r.omega[1]) <= 1e-15);
  ROT_CHECK_ULP(r.omega[2], 1.5, 2);
  ROT_CHECK_REL(r.info.measure[ROT_THETA].largest, 2.0 / 3.0, 1e-15); /* where it turns, 2 s */
  ROT_CHECK_REL(r.info.measure[ROT_OMEGA].largest, 1.5, 1e-15);
}

/* ---- edges ---------------------------------------------------------------------------------- */

/* A curve with a kink at 2: no torque above, 3 (2 - omega) below. */
static const double kink[] = {3, 0.0, 2.0, 100.0, 6.0, 0.0, 0.0};

static void check_edges(void) {
  rot_term term;
  rot_axle_scene s = plain_scene(1.0, 0.0, 2.5, 0.0);
  const double knots[] = {0.0, 2.0}, dip[] = {-1.0, 1.0}, t[] = {0.5, 1.0, 1.5, 2.0, 9.0};
  with_curve(&s, &term, 7, kink);
  with_knots(&s, 2, knots, dip);
  /* omega = 2.5 - t + t^2/2 comes down to the edge, touches it at 1 s, and goes up again. */
  go(&s, 5, t);
  const double touch[] = {2.125, 2.0, 2.125, 2.5, 2.5};
  ROT_CHECK_EQ_INT(r.status, ROT_OK);
  for (int i = 0; i < 5; i++) ROT_CHECK(fabs(r.omega[i] - touch[i]) <= 4e-15);
  /* A hair lower it dips below for a while; a hair higher it does not. No chatter either way. */
  for (int k = 1; k <= 50; k++) {
    for (int sign = -1; sign <= 1; sign += 2) {
      const double start = 2.5 + sign * ldexp(1.0, -k);
      s.linear.omega0_rad_per_s = start;
      go(&s, 5, t);
      ROT_CHECK_EQ_INT(r.status, ROT_OK);
      ROT_CHECK(r.info.steps <= 8);
      if (sign > 0) ROT_CHECK(fabs(r.omega[4] - start) <= 4e-15);
      if (sign < 0 && k < 30) ROT_CHECK(r.omega[4] > start);
    }
  }
  /* Equilibrium on the edge, reached from below: 2 - 2 exp(-3 t). */
  s = plain_scene(1.0, 0.0, 0.0, 0.0);
  with_curve(&s, &term, 7, kink);
  const double late[] = {1.0, 20.0, 1e6};
  go(&s, 3, late);
  ROT_CHECK_REL(r.omega[0], 2.0 - 2.0 * exp(-3.0), 1e-15);
  ROT_CHECK_REL(r.omega[1], 2.0, 1e-15);
  ROT_CHECK_REL(r.omega[2], 2.0, 1e-15);
  s.linear.omega0_rad_per_s = 2.0;
  go(&s, 3, late);
  ROT_CHECK(r.omega[2] == 2.0 && r.info.steps <= 3);
}

/* Through three bands by constant torque: the times are logarithms. */
/* Torque 6 - 3 omega below the edge at 2 rad/s, 1e-15 N m on it: omega = 2 - 2 exp(-3 t) is put on
 * the edge as soon as its error hides the difference, by which the bound grows. */
static void check_put_on_edge(void) {
  const double curve[] = {3, 0.0, 2.0, 3.0, 6.0, 1e-15, 3.0};
  for (double end = 10.5; end <= 11.8; end += 0.1) {
    const double t[] = {1.0, end}, off = 2.0 * exp(-3.0 * end);
    rot_axle_scene s = plain_scene(1.0, 0.0, 0.0, 0.0);
    rot_term term;
    with_curve(&s, &term, 7, curve);
    go(&s, 2, t);
    ROT_CHECK(r.status == ROT_OK);
    ROT_CHECK(fabs(r.omega[1] - 2.0 + off) <= r.info.measure[ROT_OMEGA].error + 4e-16);
  }
}

static void check_crossing_times(void) {
  /* Motor: 10 N m up to 1, falling to 4 at 3, held. I = 2, c = 1. */
  const double curve[] = {2, 1.0, 3.0, 10.0, 4.0};
  rot_term term;
  rot_axle_scene s = plain_scene(2.0, 1.0, 0.0, 0.0);
  with_curve(&s, &term, 5, curve);
  /* to 1: 2 w' = 10 - w; then 2 w' = 13 - 4 w, which tends to 3.25: at 3 after ln(9)/2 more; then
   * 2 w' = 4 - w. */
  const double t1 = 2.0 * log(10.0 / 9.0), t2 = t1 + 0.5 * log(9.0);
  const double t[] = {0.5 * t1, 0.5 * (t1 + t2), t2 + 1.0};
  go(&s, 3, t);
  ROT_CHECK_REL(r.omega[0], -10.0 * expm1(-0.25 * t1), 2e-15);
  ROT_CHECK_REL(r.omega[1], 3.25 - 2.25 * exp(-(t2 - t1)), 2e-15);
  ROT_CHECK_REL(r.omega[2], 4.0 - exp(-0.5), 2e-15);
  ROT_CHECK_EQ_INT(r.info.steps, 3);
  const double edge[] = {0.0, t1, t2, t2 + 5.0};
  check_energy(rot_axle_bands, &s, 4, edge, 2e-14);
}

/* Far down an exponential: c/I = 1e28, and the torque turns it round at I/c log(1 + c omega0/tau),
 * 1e-26 s after the start of a run of 100 s. A first guess in the middle would settle there. */
static void check_stiff_crossing(void) {
  rot_axle_scene s = plain_scene(1.0, 1e28, 10.0, -1.0);
  s.coulomb_n_m = s.static_n_m = 1e-300;                               /* else it is no event */
  const double t[] = {50.0, 100.0}, when = 1e-28 * 66.774967696827325; /* log(1e29) */
  go(&s, 2, t);
  ROT_CHECK(r.events.count == 1 && r.events.event[0] == ROT_EVENT_REVERSE);
  ROT_CHECK_REL(r.events.time_s[0], when, 1e-15);
  ROT_CHECK_REL(r.omega[1], -1e-28, 1e-15);
  ROT_CHECK(fabs(r.theta[1] - (1e-27 - 1e-26)) <= 1e-40);
  ROT_CHECK(rot_info_error(&r.info) < 1e-13);
}

/* Rising curves: resistance that drives. Balanced it stays, off balance it runs away to the next
 * band. */
static void check_rising(void) {
  const double curve[] = {3, -1.0, 0.0, 1.0, -2.0, 0.0, 2.0}, t[] = {1.0, 10.0, 1e6};
  rot_term term;
  rot_axle_scene s = plain_scene(1.0, 0.5, 0.0, 0.0);
  with_curve(&s, &term, 7, curve);
  go(&s, 3, t);
  ROT_CHECK(r.status == ROT_OK && r.omega[2] == 0.0 && r.theta[2] == 0.0);
  s.linear.omega0_rad_per_s = 1e-200; /* w' = 1.5 w to 1, then tends to 2/0.5 */
  go(&s, 3, t);
  ROT_CHECK_REL(r.omega[0], 1e-200 * exp(1.5), 1e-15);
  ROT_CHECK_REL(r.omega[1], 1e-200 * exp(15.0), 1e-14);
  ROT_CHECK_REL(r.omega[2], 4.0, 1e-15);
  ROT_CHECK(r.info.steps <= 6);
  /* Beyond the last point it is held: driving resistance grows without end, and says so. */
  s = plain_scene(1.0, -1.0, 1.0, 0.0);
  const double far[] = {1.0, 1e4};
  go(&s, 2, far);
  ROT_CHECK_REL(r.omega[0], exp(1.0), 1e-15);
  ROT_CHECK(r.status == ROT_ERANGE && r.info.rows_done == 1);
}

/* Static friction against the curve's torque at rest, which is between two points. */
static void check_hold_on_curve(void) {
  const double curve[] = {2, -1.0, 3.0, 2.0, -2.0}; /* 1 at rest */
  const double knots[] = {0.0, 4.0}, torque[] = {0.0, -4.0}, t[] = {1.0, 3.5, 4.0};
  rot_term term;
  rot_axle_scene s = plain_scene(1.0, 0.0, 0.0, 0.0);
  with_curve(&s, &term, 5, curve);
  with_knots(&s, 2, knots, torque);
  s.coulomb_n_m = 1.5;
  s.static_n_m = 2.0;
  go(&s, 3, t); /* 1 - t: held until 3 s, then w' = 1 - t + 1.5 - w backward */
  ROT_CHECK(r.applied[0] == 0.0 && r.net[0] == 0.0 && r.omega[0] == 0.0);
  for (int i = 1; i < 3; i++) {
    const double u = t[i] - 3.0;
    ROT_CHECK(fabs(r.omega[i] - (0.5 * (1.0 - exp(-u)) - u)) <= 1e-15);
  }
  ROT_CHECK_EQ_INT(r.events.count, 1);
  ROT_CHECK_ULP(r.events.time_s[0], 3.0, 1);
}

/* The limit of the segments is one for each piece of the torque. */
static void check_many_pieces(void) {
  enum { PIECES = 3000 };
  static double knots[PIECES + 1], torque[PIECES + 1];
  const double t[] = {PIECES};
  for (int i = 0; i <= PIECES; i++) {
    knots[i] = i;
    torque[i] = i % 2 ? 0.5 : 1.0;
  }
  rot_axle_scene s = plain_scene(1.0, 0.0, 1.0, 0.0);
  s.coulomb_n_m = s.static_n_m = 0.25;
  with_knots(&s, PIECES + 1, knots, torque);
  go(&s, 1, t); /* 0.75 N m in the mean */
  ROT_CHECK(r.status == ROT_OK);
  ROT_CHECK_REL(r.omega[0], 1.0 + 0.5 * PIECES, 1e-14);
}

/* ---- what is refused ------------------------------------------------------------------------ */

static void check_refusals(void) {
  const double t[] = {0.5, 2.0}, early[] = {-1.0, 0.0}, moments[] = {1.0, 2.0};
  const double spring[] = {1.0, 0.0};
  rot_term terms[2];
  rot_axle_scene s = plain_scene(1.0, 0.1, 1.0, 0.0);
  go(&s, 2, early);
  ROT_CHECK(r.status == ROT_EVALUE && r.info.time_s == -1.0 && r.info.rows_done == 0);
  s.quadratic_n_m_s2 = 1.0;
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  s = plain_scene(1.0, 0.1, 1.0, 0.0);
  with_curve(&s, terms, 7, kink);
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_OK);
  terms[0].to_s = 2.0; /* it ends at the last row: that row is without it */
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  terms[0].to_s = INFINITY;
  terms[1] = terms[0];
  s.n_terms = 2;
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  terms[0] = (rot_term){ROT_TERM_SPRING, -INFINITY, INFINITY, 2, spring};
  s.n_terms = 1;
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  s = plain_scene(1.0, 0.1, 1.0, 0.0);
  s.n_inertia = 2;
  s.inertia_time_s = t;
  s.inertia_kg_m2 = moments;
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_EVALUE);
  s = plain_scene(1.0, 0.1, NAN, 0.0);
  go(&s, 2, t);
  ROT_CHECK_EQ_INT(r.status, ROT_ERANGE);
}

int main(void) {
  ROT_CHECK_EQ_INT(check_known_cases(&r, rot_axle_bands, 1), 16);
  check_mirrors(rot_axle_bands, 1);
  check_units(rot_axle_bands, 1);
  check_splits(rot_axle_bands, 1);
  check_linear();
  check_drag();
  check_ramp();
  check_edges();
  check_put_on_edge();
  check_crossing_times();
  check_stiff_crossing();
  check_rising();
  check_hold_on_curve();
  check_many_pieces();
  check_refusals();
  rot_events_free(&r.events);
  rot_events_free(&other.events);
  return rot_test_report("axle_bands");
}
