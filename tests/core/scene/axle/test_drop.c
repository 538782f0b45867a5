/* What leaving an effect out changes, against scenes whose full and reduced motions are both exact:
 * the bound covers the difference, and not by decades. */
#include "axle_friction.h"
#include "scene/axle/drag.h"
#include "scene/axle/drop.h"
#include "scene/axle/models.h"
#include "scene/axle/oscillator.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"

enum { ROWS = 16 };

static run full, reduced;
static rot_drop drop;

static const rot_model *model_of(const char *id) {
  for (size_t i = 0; i < rot_axle_constraint.n_models; i++) {
    if (!strcmp(rot_axle_constraint.models[i].id, id)) return &rot_axle_constraint.models[i];
  }
  return NULL;
}

static void bound(const rot_axle_scene *scene, unsigned effects, const char *model, size_t n,
                  const double time_s[], double worst) {
  const rot_query query = {n, time_s, 1e-9, 0.0};
  rot_axle_constraint.drop(scene, model_of(model), effects, &query, worst, &drop);
}

/* `most`: the bound is at most so many times the difference. */
static void expect_covered(const rot_axle_scene *scene, rot_axle_model exact, unsigned effects,
                           const char *model, const rot_axle_scene *without, size_t n,
                           const double time_s[], double max) {
  run_model(&full, exact, scene, n, time_s);
  run_model(&reduced, rot_axle_form(model_of(model)), without, n, time_s);
  ROT_CHECK_EQ_INT(full.status, ROT_OK);
  ROT_CHECK_EQ_INT(reduced.status, ROT_OK);
  double theta = 0.0, omega = 0.0, size = 0.0;
  for (size_t i = 0; i < n; i++) {
    theta = fmax(theta, fabs(full.theta[i] - reduced.theta[i]));
    omega = fmax(omega, fabs(full.omega[i] - reduced.omega[i]));
    size = fmax(size, fabs(reduced.omega[i]));
  }
  bound(scene, effects, model, n, time_s, INFINITY);
  ROT_CHECK(!drop.why_not && drop.until_s == time_s[n - 1]);
  ROT_CHECK(theta <= drop.bound[ROT_THETA] && drop.bound[ROT_THETA] <= max * theta);
  ROT_CHECK(omega <= drop.bound[ROT_OMEGA] && drop.bound[ROT_OMEGA] <= max * omega);
  /* The relative error refers to a size that the motion reaches. */
  ROT_CHECK(isfinite(drop.error) && drop.error >= 0.9 * omega / size);
  double sum = 0.0;
  for (int i = 0; i < ROT_AXLE_EFFECTS; i++) sum += drop.each[i];
  ROT_CHECK(sum * size >= 0.9 * omega && sum <= 1.001 * drop.error);
}

/* Resistance of every order under stepped torques. */
static void check_resistance(double half[]) {
  const double knots_s[] = {0.0, 3.0, 3.0, 8.0}, torque[] = {0.8, 0.8, -0.2, -0.2};
  const struct {
    double viscous, quadratic, coulomb, at_rest;
    unsigned effects;
  } cases[] = {{0.03, 1e-6, 0.0, 0.0, ROT_AXLE_QUADRATIC},
               {0.03, 0.0, 1e-4, 2e-4, ROT_AXLE_FRICTION},
               {0.03, 1e-5, 1e-3, 1e-3, ROT_AXLE_QUADRATIC | ROT_AXLE_FRICTION},
               {0.0, 1e-5, 0.0, 0.0, ROT_AXLE_QUADRATIC},
               {1e-5, 0.0, 0.0, 0.0, ROT_AXLE_VISCOUS}};
  const double starts[] = {-3.0, 0.0, 5.0};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    for (int i = 0; i < 3; i++) {
      rot_axle_scene s = plain_scene(0.0625, cases[k].viscous, starts[i], 0.0);
      s.linear.theta0_rad = 1.0;
      s.linear.torque = (rot_torque){4, knots_s, torque, 0.0, -0.2, NULL, NULL};
      s.quadratic_n_m_s2 = cases[k].quadratic;
      s.coulomb_n_m = cases[k].coulomb;
      s.static_n_m = cases[k].at_rest;
      rot_axle_scene without = s;
      without.quadratic_n_m_s2 = without.coulomb_n_m = without.static_n_m = 0.0;
      if (cases[k].effects == ROT_AXLE_VISCOUS) {
        without.viscous_n_m_s = without.linear.viscous_n_m_s = 0.0;
      }
      expect_covered(&s, rot_axle_drag, cases[k].effects,
                     cases[k].effects == ROT_AXLE_VISCOUS ? "axle_skater" : "axle_linear", &without,
                     ROWS, half, 100.0);
    }
  }
}

/* A weak spring, a repelling one (theta'' = 1e-9 theta), weak gravity, a spring that a decrease of
 * inertia pumps. */
static void check_pulls(void) {
  const double t[] = {0.0, 0.5, 1.0}, weak[] = {1e-6, 0.0}, away[] = {-1e-9, 0.0};
  rot_term term = {ROT_TERM_SPRING, -INFINITY, INFINITY, 2, weak};
  rot_axle_scene s = plain_scene(1.0, 0.0, 20.0, 0.0), without = s;
  s.n_terms = 1;
  s.terms = &term;
  expect_covered(&s, rot_axle_oscillator, ROT_AXLE_SPRING, "axle_free", &without, 3, t, 100.0);
  term.x = away;
  bound(&s, ROT_AXLE_SPRING, "axle_free", 3, t, INFINITY);
  const double k = sqrt(1e-9), omega = 20.0 * (cosh(k) - 1.0);
  ROT_CHECK(fabs(20.0 / k * sinh(k) - 20.0) <= drop.bound[ROT_THETA]);
  ROT_CHECK(omega <= drop.bound[ROT_OMEGA] && drop.bound[ROT_OMEGA] <= 100.0 * omega);
  term.kind = ROT_TERM_GRAVITY;
  term.x = weak;
  s.linear.omega0_rad_per_s = without.linear.omega0_rad_per_s = 0.1;
  s.linear.theta0_rad = without.linear.theta0_rad = 1.0;
  expect_covered(&s, rot_axle_pendulum, ROT_AXLE_GRAVITY, "axle_free", &without, 3, t, 100.0);
}

/* I from 5 to 0.5 at once: omega = 10, and omega' = -(q/I) omega^2 after. */
static void check_skater(void) {
  const double at_s[] = {0.001, 0.001}, inertia[] = {5.0, 0.5}, t[] = {0.0, 10.0};
  rot_axle_scene s = plain_scene(5.0, 0.0, 1.0, 0.0);
  s.n_inertia = 2;
  s.inertia_time_s = at_s;
  s.inertia_kg_m2 = inertia;
  s.quadratic_n_m_s2 = 1e-5;
  bound(&s, ROT_AXLE_QUADRATIC, "axle_skater", 2, t, INFINITY);
  const double lost = 10.0 - 10.0 / (1.0 + 1e-5 * 10.0 / 0.5 * 10.0);
  ROT_CHECK(lost <= drop.bound[ROT_OMEGA] && drop.bound[ROT_OMEGA] <= 20.0 * lost);
}

static rot_status law(double time_s, double theta, double omega, double *torque, void *ctx) {
  (void)time_s, (void)theta, (void)omega, (void)ctx;
  *torque = 1.0;
  return ROT_OK;
}

/* No bound: an unknown torque, a motion of size 0, times before the start, none at all, static
 * friction that decides, an effect that cannot be left out. */
static void check_none(double half[]) {
  const double knots_s[] = {50.0, 60.0}, torque[] = {1.0, 2.0}, before[] = {-1.0, 1.0};
  rot_axle_scene s = plain_scene(1.0, 0.0, 0.0, 0.0);
  s.quadratic_n_m_s2 = 1e-30;
  s.linear.torque = (rot_torque){2, knots_s, torque, 0.0, 0.0, NULL, NULL};
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", ROWS, half, INFINITY);
  ROT_CHECK(drop.error == INFINITY);
  s.linear.omega0_rad_per_s = 1.0;
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", ROWS, half, INFINITY);
  ROT_CHECK(drop.error < 1e-20);
  /* The run for its size is spared where the bound is beyond use. */
  const double error = drop.error;
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", ROWS, half, 2.0 * error);
  ROT_CHECK(drop.error == error);
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", ROWS, half, 1e-12 * error);
  ROT_CHECK(drop.error == INFINITY);
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", 2, before, INFINITY);
  ROT_CHECK(drop.error == INFINITY);
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", 0, before, INFINITY);
  ROT_CHECK(drop.error == INFINITY);
  bound(&s, ROT_AXLE_TORQUE, "axle_free", ROWS, half, INFINITY);
  ROT_CHECK(drop.error == INFINITY);
  s.coulomb_n_m = 0.1;
  s.static_n_m = 1.5;
  bound(&s, ROT_AXLE_QUADRATIC, "axle_bands", ROWS, half, INFINITY);
  ROT_CHECK(drop.error == INFINITY);
  s.coulomb_n_m = s.static_n_m = 0.0;
  s.linear.torque.call = law;
  bound(&s, ROT_AXLE_QUADRATIC, "axle_linear", ROWS, half, INFINITY);
  ROT_CHECK(drop.error == INFINITY);
  /* The model's reason against what is left. */
  const double none[] = {-1.0, 0.0};
  const rot_term repelling = {ROT_TERM_SPRING, -INFINITY, INFINITY, 2, none};
  s = plain_scene(1.0, 0.0, 1.0, 0.0);
  s.quadratic_n_m_s2 = 1e-30;
  s.n_terms = 1;
  s.terms = &repelling;
  bound(&s, ROT_AXLE_QUADRATIC, "axle_oscillator", ROWS, half, INFINITY);
  ROT_CHECK(drop.why_not && drop.error == INFINITY);
}

static void check_disturbance(void) {
  const double t[] = {0.0, 4.0}, both[] = {-4.0, 4.0};
  rot_query q = {2, t, 1e-9, 0.0};
  double theta, omega;
  rot_axle_scene s = plain_scene(2.0, 0.0, 1.0, 0.0);
  rot_axle_disturbance(&s, &q, 3.0, INFINITY, NAN, &theta, &omega);
  ROT_CHECK(omega == 6.0 && theta == 24.0);
  rot_axle_disturbance(&s, &q, 3.0, 1.0, NAN, &theta, &omega);
  ROT_CHECK(omega == 0.5 && theta == 2.0);
  rot_axle_disturbance(&s, &q, 3.0, INFINITY, 10.0, &theta, &omega);
  ROT_CHECK(omega == 60.0);
  s = plain_scene(2.0, 1.0, 1.0, 0.0); /* no longer than I/c = 2 s */
  rot_axle_disturbance(&s, &q, 3.0, INFINITY, NAN, &theta, &omega);
  ROT_CHECK(omega == 3.0);
  q.time_s = both; /* backward, what brakes drives */
  rot_axle_disturbance(&s, &q, 3.0, INFINITY, NAN, &theta, &omega);
  ROT_CHECK_ULP(omega, 3.0 * exp(2.0), 4);
}

int main(void) {
  double half[ROWS];
  for (int i = 0; i < ROWS; i++) half[i] = 0.5 * (i + 1);
  check_resistance(half);
  check_pulls();
  check_skater();
  check_none(half);
  check_disturbance();
  rot_events_free(&full.events);
  rot_events_free(&reduced.events);
  return rot_test_report("axle_drop");
}
