/* The integrated axle against the closed form, and the torque laws that only it can run. */
#include "rot_axle_ode.h"
#include "rot_real.h"
#include "rot_test.h"

/* ---- helpers -------------------------------------------------------------------------------- */

enum { MOST_ROWS = 64 };

typedef struct table {
  double value[7][MOST_ROWS];
  rot_axle_columns out;
  rot_axle_ledger ledger;
  rot_info info;
  rot_status status;
} table;

static table integrated, exact;

static rot_axle_columns columns(table *to) {
  rot_axle_columns out = {to->value[0], to->value[1], to->value[2], to->value[3],
                          to->value[4], to->value[5], to->value[6]};
  return out;
}

/* Nothing but what rot_axle_params can say. */
static rot_axle_scene scene_of(const rot_axle_params *p) {
  rot_axle_scene scene;
  memset(&scene, 0, sizeof scene);
  scene.linear = *p;
  scene.viscous_n_m_s = p->viscous_n_m_s;
  return scene;
}

static rot_events events;
static rot_method method = ROT_METHOD_NONE;

static void integrate_scene(const rot_axle_scene *scene, double accuracy, size_t n,
                            const double t[], const rot_hooks *hooks) {
  const rot_axle_ode_options options = {accuracy, 100000, method};
  memset(&integrated, 0x5a, sizeof integrated);
  integrated.out = columns(&integrated);
  rot_events_free(&events);
  integrated.status = rot_axle_integrate(scene, &options, n, t, &integrated.out, &events,
                                         &integrated.ledger, hooks, &integrated.info);
  ROT_CHECK_EQ_INT(integrated.status, integrated.info.status);
}

static void integrate(const rot_axle_params *p, double accuracy, size_t n, const double t[],
                      const rot_hooks *hooks) {
  const rot_axle_scene scene = scene_of(p);
  integrate_scene(&scene, accuracy, n, t, hooks);
}

static void solve(const rot_axle_params *p, size_t n, const double t[]) {
  rot_info info;
  exact.out = columns(&exact);
  ROT_CHECK_EQ_INT(rot_axle_linear(p, n, t, &exact.out, NULL, &exact.info), ROT_OK);
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(p, t[0], t[n - 1], NULL, &exact.ledger, &info), ROT_OK);
}

static rot_axle_params axle(double inertia, double viscous, double start, double theta0,
                            double omega0, rot_torque torque) {
  rot_axle_params p = {inertia, viscous, start, theta0, omega0, torque};
  return p;
}

static rot_torque knots(size_t n, const double time_s[], const double torque_n_m[]) {
  rot_torque torque = {n, time_s, torque_n_m, torque_n_m[0], torque_n_m[n - 1], NULL, NULL};
  return torque;
}

static rot_torque law(rot_torque_fn call, void *ctx) {
  rot_torque torque = {0, NULL, NULL, 0.0, 0.0, call, ctx};
  return torque;
}

/* ---- against the closed form ---------------------------------------------------------------- */

static void check_ledger(double got, double rounding, double want, double want_rounding,
                         double size) {
  ROT_CHECK(fabs(got - want) <= rounding + want_rounding);
  ROT_CHECK(fabs(got - want) <= 1e-8 * size);
  ROT_CHECK(rounding >= 0.0 && rounding <= 1e-8 * size);
}

/* Values to the accuracy asked; true errors within the estimate; ledgers alike. */
static void compare(const rot_axle_params *p, size_t n, const double t[]) {
  const double accuracy[] = {1e-6, 1e-9, 1e-12};
  solve(p, n, t);
  for (int k = 0; k < 3; k++) {
    integrate(p, accuracy[k], n, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
    ROT_CHECK_EQ_INT(integrated.info.rows_done, n);
    ROT_CHECK(rot_info_error(&integrated.info) <= accuracy[k]);
    const double theta_max = integrated.info.theta_max, omega_max = integrated.info.omega_max;
    double theta_error = 0.0, omega_error = 0.0;
    for (size_t i = 0; i < n; i++) {
      const double theta = integrated.out.theta_rad[i], omega = integrated.out.omega_rad_per_s[i];
      theta_error = fmax(theta_error, fabs(theta - exact.out.theta_rad[i]));
      omega_error = fmax(omega_error, fabs(omega - exact.out.omega_rad_per_s[i]));
      ROT_CHECK(fabs(theta) <= theta_max * (1 + accuracy[k]));
      ROT_CHECK(fabs(omega) <= omega_max * (1 + accuracy[k]));
      ROT_CHECK_ULP(integrated.out.applied_n_m[i], exact.out.applied_n_m[i], 3);
      ROT_CHECK(integrated.out.momentum_kg_m2_per_s[i] == p->inertia_kg_m2 * omega);
      ROT_CHECK_ULP(integrated.out.damping_n_m[i], -p->viscous_n_m_s * omega, 0);
    }
    ROT_CHECK(theta_error <= 1.2 * integrated.info.theta_error + exact.info.theta_error);
    ROT_CHECK(omega_error <= 1.2 * integrated.info.omega_error + exact.info.omega_error);
    ROT_CHECK(theta_error <= accuracy[k] * theta_max);
    ROT_CHECK(omega_error <= accuracy[k] * omega_max);
  }
  const rot_axle_ledger *a = &integrated.ledger, *b = &exact.ledger;
  const double size = fabs(b->work_j) + fabs(b->dissipated_j);
  check_ledger(a->work_j, a->work_rounding_j, b->work_j, b->work_rounding_j, size);
  check_ledger(a->dissipated_j, a->dissipated_rounding_j, b->dissipated_j, b->dissipated_rounding_j,
               size);
  check_ledger(a->impulse_n_m_s, a->impulse_rounding_n_m_s, b->impulse_n_m_s,
               b->impulse_rounding_n_m_s, 1.0 + fabs(b->impulse_n_m_s));
}

static void check_scenes(void) {
  static const double time_s[] = {0.0, 2.0, 2.0, 3.0, 3.0, 6.0},
                      torque_n_m[] = {1.0, 5.0, -3.0, 2.0, 0.0, 4.0};
  static const double pulse_s[] = {1.0, 1.0, 1.001, 1.001}, pulse_n_m[] = {0.0, 3e3, 3e3, 0.0};
  const double t[] = {-2.0, -0.5, 0.0, 0.7, 1.0, 1.0005, 2.0, 2.0, 2.5, 3.0, 5.0, 6.0, 9.0};
  const double viscous[] = {0.0, 0.4, -0.4, 6.0}, starts[] = {0.0, -0.5, 2.0, 4.5};
  for (int v = 0; v < 4; v++) {
    for (int s = 0; s < 4; s++) {
      const rot_axle_params ramps = axle(0.7, viscous[v], starts[s], 0.3, 2.0,
                                         knots(6, time_s, torque_n_m)),
                            pulse = axle(2.0, viscous[v], starts[s], 0.3, -1.5,
                                         knots(4, pulse_s, pulse_n_m));
      /* Backward against strong resistance the motion grows by exp(60): leave those rows. */
      const size_t first = viscous[v] > 1.0 ? 8 : 0, n = sizeof t / sizeof t[0];
      compare(&ramps, n - first, t + first);
      compare(&pulse, n - first, t + first);
    }
  }
}

/* A pulse shorter than any step would be: it is a break, so nobody steps over it. */
static void check_pulse_is_not_missed(void) {
  static const double time_s[] = {50.0, 50.0, 50.0 + 1e-7, 50.0 + 1e-7},
                      torque_n_m[] = {0.0, 6e7, 6e7, 0.0};
  const double t = 100.0;
  const rot_axle_params p = axle(2.0, 0.0, 0.0, 0.0, 5.0, knots(4, time_s, torque_n_m));
  integrate(&p, 1e-9, 1, &t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  ROT_CHECK_REL(integrated.out.omega_rad_per_s[0], 8.0, 1e-8); /* 6 N m s over 2 */
}

/* ---- laws that depend on the state ---------------------------------------------------------- */

typedef struct pendulum {
  double stiffness; /* m g l */
  long calls, stop_at;
  rot_status says;
  double nan_at; /* NaN at this very time */
} pendulum;

static rot_status gravity(double t, double theta, double omega, double *torque, void *ctx) {
  pendulum *p = ctx;
  (void)omega;
  *torque = t == p->nan_at ? NAN : -p->stiffness * sin(theta);
  return ++p->calls == p->stop_at ? p->says : ROT_OK;
}

static pendulum hanging(double stiffness) {
  pendulum p = {stiffness, 0, -1, ROT_OK, NAN};
  return p;
}

/* A large swing keeps I omega^2/2 - k cos(theta); gravity's work is what the speed gains. */
static void check_pendulum_energy(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.0, 0.0, 2.5, 0.0, law(gravity, &p));
  double t[MOST_ROWS];
  for (int i = 0; i < MOST_ROWS; i++) t[i] = 0.37 * i;
  integrate(&scene, 1e-11, MOST_ROWS, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  for (int i = 0; i < MOST_ROWS; i++) {
    const double energy = integrated.out.energy_j[i] - 18.0 * cos(integrated.out.theta_rad[i]);
    ROT_CHECK(fabs(energy + 18.0 * cos(2.5)) <= 18.0 * 1e-9);
    ROT_CHECK_ULP(integrated.out.applied_n_m[i], -18.0 * sin(integrated.out.theta_rad[i]), 0);
  }
  const double gained = integrated.out.energy_j[MOST_ROWS - 1] - integrated.out.energy_j[0];
  ROT_CHECK(fabs(integrated.ledger.work_j - gained) <= 18.0 * 1e-9);
  ROT_CHECK(integrated.ledger.dissipated_j == 0.0);
  ROT_CHECK_EQ_INT(integrated.info.rhs_calls, p.calls);
}

/* A small swing: theta0 cos(3 t), 3 = sqrt(18/2), to the square of the amplitude. */
static void check_small_swing(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.0, -1.0, 1e-4, 0.0, law(gravity, &p));
  const double t[] = {-2.0, -1.0, 0.0, 0.6, 2.0};
  integrate(&scene, 1e-9, 5, t, NULL);
  for (int i = 0; i < 5; i++) {
    ROT_CHECK(fabs(integrated.out.theta_rad[i] - 1e-4 * cos(3.0 * (t[i] + 1.0))) <= 1e-12);
    ROT_CHECK(fabs(integrated.out.omega_rad_per_s[i] + 3e-4 * sin(3.0 * (t[i] + 1.0))) <= 3e-12);
  }
}

/* With resistance the ledger balances: work - heat = gain. */
static void check_balance(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.8, 0.0, 1.0, 3.0, law(gravity, &p));
  const double t[] = {-0.5, 1.0, 2.0, 6.0};
  integrate(&scene, 1e-10, 4, t, NULL);
  const double gained = integrated.out.energy_j[3] - integrated.out.energy_j[0];
  ROT_CHECK(integrated.ledger.dissipated_j > 5.0);
  ROT_CHECK(fabs(integrated.ledger.work_j - integrated.ledger.dissipated_j - gained) <= 1e-8);
  /* The angular impulse less what the resistance took is the gain of momentum. */
  const double turned = integrated.out.theta_rad[3] - integrated.out.theta_rad[0];
  const double momentum =
      integrated.out.momentum_kg_m2_per_s[3] - integrated.out.momentum_kg_m2_per_s[0];
  ROT_CHECK(fabs(integrated.ledger.impulse_n_m_s - 0.8 * turned - momentum) <= 1e-8);
}

/* A law of the speed: torque = -3 omega is a resistance by another name. */
static rot_status brake(double t, double theta, double omega, double *torque, void *ctx) {
  (void)t;
  (void)theta;
  *torque = -*(const double *)ctx * omega;
  return ROT_OK;
}

static void check_law_of_speed(void) {
  double rate = 3.0;
  const rot_axle_params scene = axle(2.0, 1.0, 0.5, 0.25, 5.0, law(brake, &rate));
  const double t[] = {0.0, 0.5, 2.5};
  integrate(&scene, 1e-10, 3, t, NULL);
  for (int i = 0; i < 3; i++) {
    const double left = exp(-2.0 * (t[i] - 0.5)); /* (3 + 1)/2 a second */
    ROT_CHECK_REL(integrated.out.omega_rad_per_s[i], 5.0 * left, 1e-9);
    ROT_CHECK(fabs(integrated.out.theta_rad[i] - (0.25 + 2.5 * (1.0 - left))) <= 1e-8);
    ROT_CHECK_ULP(integrated.out.applied_n_m[i], -3.0 * integrated.out.omega_rad_per_s[i], 0);
    ROT_CHECK_ULP(integrated.out.net_n_m[i], -4.0 * integrated.out.omega_rad_per_s[i], 1);
  }
  /* Three parts of the loss are the brake's work, one the resistance's heat. */
  ROT_CHECK_REL(integrated.ledger.work_j, -3.0 * integrated.ledger.dissipated_j, 1e-8);
}

/* A law with breakpoints of its own: a switch that turns at 1.3 s. */
static rot_status on_off(double t, double theta, double omega, double *torque, void *ctx) {
  (void)theta;
  (void)omega;
  *torque = t < *(const double *)ctx ? 6.0 : -2.0;
  return ROT_OK;
}

static void check_law_with_breaks(void) {
  double at[] = {1.3}, unused[] = {0.0};
  rot_torque torque = law(on_off, at);
  torque.n = 1;
  torque.time_s = at;
  torque.torque_n_m = unused;
  const rot_axle_params scene = axle(2.0, 0.0, 0.0, 0.0, 0.0, torque);
  const double t[] = {1.3, 3.3};
  integrate(&scene, 1e-10, 2, t, NULL);
  ROT_CHECK_REL(integrated.out.omega_rad_per_s[0], 3.9, 1e-14);
  ROT_CHECK_REL(integrated.out.omega_rad_per_s[1], 1.9, 1e-14);
  ROT_CHECK(integrated.out.applied_n_m[0] == -2.0); /* after the switch */
  ROT_CHECK_EQ_INT(integrated.info.rejected, 0);
}

/* ---- how a run ends ------------------------------------------------------------------------- */

static void check_stop_by_law(void) {
  const double t[] = {0.5, 1.0, 9.0};
  for (long stop_at = 1; stop_at < 60; stop_at += 3) {
    pendulum p = hanging(18.0);
    const rot_axle_params scene = axle(2.0, 0.0, 0.0, 1.0, 0.0, law(gravity, &p));
    p.stop_at = stop_at;
    p.says = ROT_EUNWIND;
    integrate(&scene, 1e-9, 3, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(p.calls, stop_at); /* not asked again, not even for a column */
  }
}

/* Also while the columns are filled, after the run itself. */
static void check_stop_in_columns(void) {
  const double t[] = {0.5, 1.0, 2.0};
  pendulum whole = hanging(18.0);
  rot_axle_params scene = axle(2.0, 0.0, 0.0, 1.0, 0.0, law(gravity, &whole));
  integrate(&scene, 1e-9, 3, t, NULL);
  for (long before_end = 0; before_end < 3; before_end++) {
    pendulum p = hanging(18.0);
    p.stop_at = whole.calls - before_end;
    p.says = ROT_EUNWIND;
    scene.torque.ctx = &p;
    integrate(&scene, 1e-9, 3, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(integrated.info.rows_done, 2 - before_end);
    ROT_CHECK_EQ_INT(p.calls, p.stop_at);
  }
}

/* NaN at a break is never met by a step, but the column of a row there shows it. */
static void check_nan_in_a_column(void) {
  double at[] = {1.5}, unused[] = {0.0};
  const double t[] = {0.5, 1.0, 1.5, 2.0};
  pendulum p = hanging(18.0);
  rot_axle_params scene = axle(2.0, 0.0, 0.0, 1.0, 0.0, law(gravity, &p));
  scene.torque.n = 1;
  scene.torque.time_s = at;
  scene.torque.torque_n_m = unused;
  p.nan_at = 1.5;
  integrate(&scene, 1e-9, 4, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_ETORQUE);
  ROT_CHECK_EQ_INT(integrated.info.rows_done, 2);
  ROT_CHECK(integrated.info.time_s == 1.5);
}

static rot_status nan_after_three(double t, double theta, double omega, double *torque, void *ctx) {
  (void)theta;
  (void)omega;
  (void)ctx;
  *torque = t > 3.0 ? NAN : 6.0;
  return ROT_OK;
}

static void check_nan_later(void) {
  const double t[] = {0.0, 1.0, 2.0, 4.0};
  const rot_axle_params scene = axle(2.0, 0.0, 0.0, 0.0, 0.0, law(nan_after_three, NULL));
  integrate(&scene, 1e-9, 4, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_ETORQUE);
  ROT_CHECK_EQ_INT(integrated.info.rows_done, 3);
  ROT_CHECK(fabs(integrated.info.time_s - 3.0) < 1e-9);
  ROT_CHECK_REL(integrated.out.theta_rad[2], 6.0, 1e-9);
  /* The ledger covers the rows that stand. */
  ROT_CHECK_REL(integrated.ledger.work_j, 36.0, 1e-9);
  ROT_CHECK_REL(integrated.ledger.impulse_n_m_s, 12.0, 1e-12);
}

static void check_budget(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.0, 0.0, 1.0, 0.0, law(gravity, &p));
  const rot_axle_ode_options options = {1e-9, 60, ROT_METHOD_NONE};
  const rot_axle_scene whole = scene_of(&scene);
  const double t[] = {0.5, 1.0, 400.0};
  rot_axle_columns out = columns(&integrated);
  ROT_CHECK_EQ_INT(
      rot_axle_integrate(&whole, &options, 3, t, &out, NULL, &integrated.ledger, NULL, &integrated.info),
      ROT_EBUDGET);
  ROT_CHECK_EQ_INT(integrated.info.rows_done, 2);
  ROT_CHECK(integrated.info.time_s > 1.0 && integrated.info.time_s < 30.0);
}

/* Where the state grows out of the doubles, that is what is said, not that the torque was bad. */
static void check_overflow(void) {
  static const double time_s[] = {0.0}, torque_n_m[] = {0.0};
  const double t[] = {1.0, 100.0, 800.0}, omega0[] = {1.0, -1.0};
  for (int i = 0; i < 2; i++) {
    const rot_axle_params scene =
        axle(2.0, -2.0, 0.0, 0.0, omega0[i], knots(1, time_s, torque_n_m));
    integrate(&scene, 1e-6, 3, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_ERANGE);
    ROT_CHECK_EQ_INT(integrated.info.rows_done, 2);
    ROT_CHECK(integrated.info.time_s > 600.0 && integrated.info.time_s < 720.0);
  }
}

static void check_no_rows(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.0, 0.0, 1.0, 0.0, law(gravity, &p));
  integrate(&scene, 1e-9, 0, NULL, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  ROT_CHECK_EQ_INT(integrated.info.rows_done, 0);
  ROT_CHECK_EQ_INT(p.calls, 0);
}

/* One row, at the start: the state given, one call for its column, an empty ledger. */
static void check_only_the_start(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.5, 3.0, 1.0, -7.0, law(gravity, &p));
  const double t = 3.0;
  integrate(&scene, 1e-9, 1, &t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  ROT_CHECK(integrated.out.theta_rad[0] == 1.0 && integrated.out.omega_rad_per_s[0] == -7.0);
  ROT_CHECK(integrated.out.damping_n_m[0] == 3.5 && integrated.out.energy_j[0] == 49.0);
  ROT_CHECK(integrated.ledger.work_j == 0.0 && integrated.ledger.impulse_n_m_s == 0.0);
  ROT_CHECK_EQ_INT(p.calls, 1);
  ROT_CHECK(integrated.info.theta_max == 1.0 && integrated.info.omega_max == 7.0);
}

int main(void) {
  check_scenes();
  check_pulse_is_not_missed();
  check_pendulum_energy();
  check_small_swing();
  check_balance();
  check_law_of_speed();
  check_law_with_breaks();
  check_stop_by_law();
  check_stop_in_columns();
  check_nan_in_a_column();
  check_nan_later();
  check_budget();
  check_overflow();
  check_no_rows();
  check_only_the_start();
  return rot_test_report("axle_ode");
}
