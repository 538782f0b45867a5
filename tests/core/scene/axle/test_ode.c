/* The integrated axle against the closed form, and the torque laws that only it can run. */
#include <stdlib.h>

#include "scene/axle/linear.h"
#include "scene/axle/ledger.h"
#include "scene/axle/ode.h"
#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

/* ---- helpers -------------------------------------------------------------------------------- */

enum { MAX_ROWS = 64 };

typedef struct table {
  double value[7][MAX_ROWS];
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

/* What flowed between the first row and the last, as the closed form gives it. */
static rot_axle_ledger ledger_of(size_t rows, double flow[ROT_AXLE_FLOWS][MAX_ROWS],
                                 const double error[]) {
  double sum[ROT_AXLE_FLOWS] = {0.0};
  for (int k = 0; k < ROT_AXLE_FLOWS && rows; k++) sum[k] = flow[k][rows - 1] - flow[k][0];
  const rot_axle_ledger out = {
      .work_j = sum[ROT_AXLE_FLOW_WORK],
      .dissipated_j =
          sum[ROT_AXLE_FLOW_VISCOUS] + sum[ROT_AXLE_FLOW_QUADRATIC] + sum[ROT_AXLE_FLOW_COULOMB],
      .impulse_n_m_s = sum[ROT_AXLE_FLOW_IMPULSE],
      .work_rounding_j = error[ROT_AXLE_FLOW_WORK] + error[ROT_AXLE_FLOW_INERTIA],
      .dissipated_rounding_j = error[ROT_AXLE_FLOW_VISCOUS] + error[ROT_AXLE_FLOW_QUADRATIC] +
                               error[ROT_AXLE_FLOW_COULOMB],
      .impulse_rounding_n_m_s = error[ROT_AXLE_FLOW_IMPULSE] + error[ROT_AXLE_FLOW_DAMPING],
      .viscous_j = sum[ROT_AXLE_FLOW_VISCOUS],
      .quadratic_j = sum[ROT_AXLE_FLOW_QUADRATIC],
      .coulomb_j = sum[ROT_AXLE_FLOW_COULOMB],
      .damping_impulse_n_m_s = sum[ROT_AXLE_FLOW_DAMPING],
      .inertia_work_j = sum[ROT_AXLE_FLOW_INERTIA]};
  return out;
}

static void integrate_scene(const rot_axle_scene *scene, double accuracy, size_t n,
                            const double t[], const rot_hooks *hooks) {
  static double flow[ROT_AXLE_FLOWS][MAX_ROWS];
  double error[ROT_AXLE_FLOWS] = {0.0}, *value[ROT_AXLE_FLOWS];
  const rot_axle_flows flows = {value, error};
  for (int k = 0; k < ROT_AXLE_FLOWS; k++) value[k] = flow[k];
  const rot_axle_ode_options options = {accuracy, 100000, method, 0.0, 0.0};
  memset(&integrated, 0x5a, sizeof integrated);
  integrated.out = columns(&integrated);
  rot_events_free(&events);
  integrated.status = rot_axle_integrate(scene, &options, n, t, &integrated.out, &events, &flows,
                                         hooks, &integrated.info);
  integrated.ledger = ledger_of(integrated.info.rows_done, flow, error);
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
    const double theta_max = integrated.info.measure[ROT_THETA].largest,
                 omega_max = integrated.info.measure[ROT_OMEGA].largest;
    double theta_error = 0.0, omega_error = 0.0;
    for (size_t i = 0; i < n; i++) {
      const double theta = integrated.out.theta_rad[i], omega = integrated.out.omega_rad_per_s[i];
      theta_error = fmax(theta_error, fabs(theta - exact.out.theta_rad[i]));
      omega_error = fmax(omega_error, fabs(omega - exact.out.omega_rad_per_s[i]));
      ROT_CHECK(fabs(theta) <= theta_max * (1 + accuracy[k]));
      ROT_CHECK(fabs(omega) <= omega_max * (1 + accuracy[k]));
      ROT_CHECK_ULP(integrated.out.applied_torque_n_m[i], exact.out.applied_torque_n_m[i], 3);
      ROT_CHECK(integrated.out.angular_momentum_kg_m2_per_s[i] == p->inertia_kg_m2 * omega);
      ROT_CHECK_ULP(integrated.out.damping_torque_n_m[i], -p->viscous_n_m_s * omega, 0);
    }
    ROT_CHECK(theta_error <=
              1.2 * integrated.info.measure[ROT_THETA].error + exact.info.measure[ROT_THETA].error);
    ROT_CHECK(omega_error <=
              1.2 * integrated.info.measure[ROT_OMEGA].error + exact.info.measure[ROT_OMEGA].error);
    ROT_CHECK(theta_error <= accuracy[k] * theta_max);
    ROT_CHECK(omega_error <= accuracy[k] * omega_max);
  }
  const rot_axle_ledger *a = &integrated.ledger, *b = &exact.ledger;
  /* With the energy at the start: of a wheel that nothing drives it is what there is to lose. */
  const double size = fabs(b->work_j) + fabs(b->dissipated_j) +
                      0.5 * p->inertia_kg_m2 * pow(exact.out.omega_rad_per_s[0], 2);
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
  double t[MAX_ROWS];
  for (int i = 0; i < MAX_ROWS; i++) t[i] = 0.37 * i;
  integrate(&scene, 1e-11, MAX_ROWS, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  for (int i = 0; i < MAX_ROWS; i++) {
    const double energy =
        integrated.out.rotational_kinetic_energy_j[i] - 18.0 * cos(integrated.out.theta_rad[i]);
    ROT_CHECK(fabs(energy + 18.0 * cos(2.5)) <= 18.0 * 1e-9);
    ROT_CHECK_ULP(integrated.out.applied_torque_n_m[i], -18.0 * sin(integrated.out.theta_rad[i]),
                  0);
  }
  const double gained = integrated.out.rotational_kinetic_energy_j[MAX_ROWS - 1] -
                        integrated.out.rotational_kinetic_energy_j[0];
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
  const double gained =
      integrated.out.rotational_kinetic_energy_j[3] - integrated.out.rotational_kinetic_energy_j[0];
  ROT_CHECK(integrated.ledger.dissipated_j > 5.0);
  ROT_CHECK(fabs(integrated.ledger.work_j - integrated.ledger.dissipated_j - gained) <= 1e-8);
  /* The angular impulse less what the resistance took is the gain of momentum. */
  const double turned = integrated.out.theta_rad[3] - integrated.out.theta_rad[0];
  const double momentum = integrated.out.angular_momentum_kg_m2_per_s[3] -
                          integrated.out.angular_momentum_kg_m2_per_s[0];
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
    ROT_CHECK_ULP(integrated.out.applied_torque_n_m[i], -3.0 * integrated.out.omega_rad_per_s[i],
                  0);
    ROT_CHECK_ULP(integrated.out.net_torque_n_m[i], -4.0 * integrated.out.omega_rad_per_s[i], 1);
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
  ROT_CHECK(integrated.out.applied_torque_n_m[0] == -2.0); /* after the switch */
  ROT_CHECK_EQ_INT(integrated.info.rejected, 0);
}

/* ---- friction ------------------------------------------------------------------------------- */

static rot_axle_scene bare(double inertia, double theta0, double omega0) {
  const rot_torque none = {0, NULL, NULL, 0.0, 0.0, NULL, NULL};
  const rot_axle_params p = axle(inertia, 0.0, 0.0, theta0, omega0, none);
  return scene_of(&p);
}

static void check_events(size_t n, const double time_s[], const rot_event event[], double within) {
  ROT_CHECK_EQ_INT(events.count, n);
  for (size_t i = 0; i < n && i < events.count; i++) {
    ROT_CHECK(fabs(events.time_s[i] - time_s[i]) <= within);
    ROT_CHECK_EQ_INT(events.event[i], event[i]);
  }
}

/* Rows, their error figures, and the balance of energy and of momentum. */
static void check_rows(size_t n, const double (*want)[3], double accuracy) {
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  ROT_CHECK_EQ_INT(integrated.info.rows_done, n);
  ROT_CHECK(rot_info_error(&integrated.info) <= accuracy);
  double theta_error = 0.0, omega_error = 0.0;
  for (size_t i = 0; i < n; i++) {
    theta_error = fmax(theta_error, fabs(integrated.out.theta_rad[i] - want[i][1]));
    omega_error = fmax(omega_error, fabs(integrated.out.omega_rad_per_s[i] - want[i][2]));
  }
  ROT_CHECK(theta_error <= integrated.info.measure[ROT_THETA].error);
  ROT_CHECK(omega_error <= integrated.info.measure[ROT_OMEGA].error);
}

static void check_balances(size_t n, double within) {
  const rot_axle_ledger *l = &integrated.ledger;
  const double *energy = integrated.out.rotational_kinetic_energy_j,
               *momentum = integrated.out.angular_momentum_kg_m2_per_s;
  ROT_CHECK(fabs(energy[n - 1] - energy[0] - l->work_j - l->inertia_work_j + l->dissipated_j) <=
            within);
  ROT_CHECK(fabs(momentum[n - 1] - momentum[0] - l->impulse_n_m_s - l->damping_impulse_n_m_s) <=
            within);
  ROT_CHECK(l->dissipated_j == l->viscous_j + l->quadratic_j + l->coulomb_j);
}

/* I = 2, omega0 = -4, Coulomb 1: against 3 N m it stops at 2 s at -4 rad and turns, against
 * 1.2 N m at 4/1.1 s and sticks; 1.5 N m hold. */
static void check_constant_torque_and_friction(void) {
  const double time_s[] = {-5.0, 50.0}, t[] = {0.0, 1.0, 2.0, 4.0, 10.0};
  for (int k = 0; k < 2; k++) {
    const double torque = k == 0 ? 3.0 : 1.2, torques[] = {torque, torque};
    rot_axle_scene scene = bare(2.0, 0.0, -4.0);
    scene.linear.torque = knots(2, time_s, torques);
    scene.coulomb_n_m = 1.0;
    scene.static_n_m = 1.5;
    double want[5][3], heat = 0.0;
    const double slowing = (torque + 1.0) / 2.0, at = 4.0 / slowing, turned = -2.0 * at;
    for (int i = 0; i < 5; i++) {
      const double before = fmin(t[i], at), after = t[i] - before;
      const double speeding = k == 0 ? 1.0 : 0.0;
      want[i][0] = t[i];
      want[i][1] = -4.0 * before + 0.5 * slowing * before * before + 0.5 * speeding * after * after;
      want[i][2] = after > 0.0 ? speeding * after : -4.0 + slowing * before;
      heat = -turned + 0.5 * speeding * after * after;
    }
    integrate_scene(&scene, 1e-10, 5, t, NULL);
    check_rows(5, (const double(*)[3])want, 1e-10);
    const rot_event event[] = {k == 0 ? ROT_EVENT_REVERSE : ROT_EVENT_STICK};
    check_events(1, &at, event, 1e-14);
    check_balances(5, 1e-12);
    ROT_CHECK_REL(integrated.ledger.coulomb_j, heat, 1e-13);
    ROT_CHECK_REL(integrated.ledger.impulse_n_m_s, 10.0 * torque, 1e-13);
    ROT_CHECK(integrated.ledger.viscous_j == 0.0 && integrated.ledger.quadratic_j == 0.0);
    ROT_CHECK(integrated.out.damping_torque_n_m[0] == 1.0); /* against the motion */
    ROT_CHECK(integrated.out.damping_torque_n_m[4] == (k == 0 ? -1.0 : -1.2));
    ROT_CHECK(integrated.out.net_torque_n_m[4] == (k == 0 ? 2.0 : 0.0));
  }
}

/* mpmath, 50 digits: I = 1, torque 2 cos t, from rest. First friction that only turns it (Coulomb
 * 0.5, static 0.6), then one that sticks each time (1.25, 1.75). */
static const double turning[9][3] = {{1.0, 0.6693953882637205652, 1.1829419696157930133},
                                     {2.0, 1.832293673094284774, 0.81859485365136339079},
                                     {3.0, 1.8680197693861958511, -0.69233677125009456836},
                                     {5.0, -1.6284431694808056175, -1.8924253366961059504},
                                     {7.5, -1.2327543443657461105, 1.6652045135468882982},
                                     {10.0, -0.38960276218727840774, -1.4893788486489027206},
                                     {12.5, -3.546959522939522501, 0.42352828943998507757},
                                     {15.0, -0.20405692850875248714, 0.60674776445662018708},
                                     {20.0, -2.2964741812921577703, 1.8144411663924012572}};
static const double turning_s[6] = {2.4745767873698290126, 6.0137813473672395949,
                                    8.9405411868675736761, 12.207508711012549549,
                                    15.278365345254693493, 18.460743926049452986};
enum { STICKS = 12 };
static const double sticking_s[STICKS] = {
    1.5993478908531697357, 2.6362321433056359315, 4.961456953372145768,  5.77782479689542917,
    8.1030496069619390064, 8.9194174504852224084, 11.244642260551732245, 12.061010104075015647,
    14.386234914141525483, 15.202602757664808885, 17.527827567731318722, 18.344195411254602124};
static const rot_event sticking_event[STICKS] = {ROT_EVENT_STICK, ROT_EVENT_SLIP,  ROT_EVENT_STICK,
                                                 ROT_EVENT_SLIP,  ROT_EVENT_STICK, ROT_EVENT_SLIP,
                                                 ROT_EVENT_STICK, ROT_EVENT_SLIP,  ROT_EVENT_STICK,
                                                 ROT_EVENT_SLIP,  ROT_EVENT_STICK, ROT_EVENT_SLIP};
static const double sticking[9][3] = {{1.0, 0.2943953882637205652, 0.43294196961579301331},
                                      {2.0, 0.45839932261373569964, 0.0},
                                      {3.0, 0.4188720115764241738, -0.23129599956416469146},
                                      {5.0, -0.65682250669464141786, 0.0},
                                      {7.5, 0.21371618398648297589, 0.69152678622061839963},
                                      {10.0, 0.070059480095779817626, -0.70555987143712185863},
                                      {12.5, -0.59781400648674772124, 0.28686467194322240204},
                                      {15.0, 0.45839932261373569964, 0.0},
                                      {20.0, 0.16668374630581370028, 0.7243806020753621848}};
#define STICK_HEAT 8.5725184026950955066

static rot_status wave_torque(double t, double theta, double omega, double *torque, void *ctx) {
  (void)theta;
  (void)omega;
  ++*(long *)ctx;
  *torque = 2.0 * cos(t);
  return ROT_OK;
}

/* Also as an R function would come, and by the stiff method. */
static void check_wave_and_friction(void) {
  const double wave[] = {2.0, 1.0, 0.0};
  const rot_term term = {ROT_TERM_SINUSOID, -INFINITY, INFINITY, 3, wave};
  double t[9];
  for (int i = 0; i < 9; i++) t[i] = turning[i][0];
  for (int k = 0; k < 8; k++) {
    const int sticks = k % 2, called = k / 2 % 2, stiff = k / 4;
    long calls = 0;
    rot_axle_scene scene = bare(1.0, 0.0, 0.0);
    if (called) {
      scene.linear.torque = law(wave_torque, &calls);
    } else {
      scene.terms = &term;
      scene.n_terms = 1;
    }
    scene.coulomb_n_m = sticks ? 1.25 : 0.5;
    scene.static_n_m = sticks ? 1.75 : 0.6;
    method = stiff ? ROT_METHOD_RADAU : ROT_METHOD_NONE;
    for (double accuracy = 1e-4; accuracy > 1e-12; accuracy *= 1e-3) {
      calls = 0;
      integrate_scene(&scene, accuracy, 9, t, NULL);
      check_rows(9, sticks ? sticking : turning, accuracy);
      const double within = 100.0 * accuracy;
      if (sticks) {
        check_events(STICKS, sticking_s, sticking_event, within);
      } else {
        const rot_event reverse[] = {ROT_EVENT_REVERSE, ROT_EVENT_REVERSE, ROT_EVENT_REVERSE,
                                     ROT_EVENT_REVERSE, ROT_EVENT_REVERSE, ROT_EVENT_REVERSE};
        check_events(6, turning_s, reverse, within);
      }
      check_balances(9, 100.0 * accuracy);
      ROT_CHECK_EQ_INT(integrated.info.rhs_calls > 0, 1);
      if (called) ROT_CHECK_EQ_INT(integrated.info.rhs_calls, calls);
    }
    /* 0 to 20 less the first row at 1 s: the heat of the first second is 0.5 or 1.25 theta(1). */
    const double heat =
        sticks ? STICK_HEAT - 1.25 * sticking[0][1] : 11.402696399983917901 - 0.5 * turning[0][1];
    ROT_CHECK_REL(integrated.ledger.coulomb_j, heat, 1e-9);
    printf("friction %d %d %d: %zu calls\n", sticks, called, stiff, integrated.info.rhs_calls);
  }
  method = ROT_METHOD_NONE;
}

/* What was once fallen at rest stays there, though pushed both ways below what holds; and a start
 * at rest is no event. */
static void check_held(void) {
  const double wave[] = {1.0, 3.0, 0.3}, t[] = {-3.0, 0.0, 1.0, 7.0};
  const rot_term term = {ROT_TERM_SINUSOID, -INFINITY, INFINITY, 3, wave};
  rot_axle_scene scene = bare(1.0, 2.0, 0.0);
  scene.terms = &term;
  scene.n_terms = 1;
  scene.coulomb_n_m = 0.9;
  scene.static_n_m = 1.0; /* just */
  integrate_scene(&scene, 1e-9, 4, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  check_events(0, NULL, NULL, 0.0);
  for (int i = 0; i < 4; i++) {
    ROT_CHECK(integrated.out.theta_rad[i] == 2.0 && integrated.out.omega_rad_per_s[i] == 0.0);
    ROT_CHECK_ULP(integrated.out.damping_torque_n_m[i], -cos(3.0 * t[i] + 0.3), 4);
    ROT_CHECK(integrated.out.net_torque_n_m[i] == 0.0);
  }
  const double impulse = (sin(21.3) - sin(-8.7)) / 3.0;
  /* A quadrature whose points are close enough not to miss a peak. */
  ROT_CHECK(fabs(integrated.ledger.impulse_n_m_s - impulse) <= 1e-13);
  ROT_CHECK(fabs(integrated.ledger.damping_impulse_n_m_s + impulse) <= 1e-13);
  ROT_CHECK(integrated.ledger.work_j == 0.0 && integrated.ledger.dissipated_j == 0.0);
  /* A hair less, and it breaks loose at a peak that no point of a scan need hit. */
  scene.static_n_m = scene.coulomb_n_m = 1.0 - 1e-7;
  integrate_scene(&scene, 1e-9, 4, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  ROT_CHECK(events.count > 0);
}

/* Quadratic drag: from rest under a constant torque w = w1 tanh(t/T);
 * thrown against the torque it comes to rest at atan(). */
static void check_quadratic(void) {
  const double time_s[] = {-9.0}, torque[] = {3.0}, t[] = {0.0, 0.3, 1.0, 4.0};
  rot_axle_scene scene = bare(2.0, 0.0, 0.0);
  scene.linear.torque = knots(1, time_s, torque);
  scene.quadratic_n_m_s2 = 0.5;
  const double w1 = sqrt(6.0), rate = sqrt(1.5) / 2.0;
  double want[4][3];
  for (int i = 0; i < 4; i++) {
    want[i][1] = w1 / rate * log(cosh(rate * t[i]));
    want[i][2] = w1 * tanh(rate * t[i]);
  }
  for (double accuracy = 1e-3; accuracy > 1e-12; accuracy *= 1e-3) {
    integrate_scene(&scene, accuracy, 4, t, NULL);
    check_rows(4, (const double(*)[3])want, accuracy);
    check_balances(4, 30.0 * accuracy);
    check_events(0, NULL, NULL, 0.0);
    ROT_CHECK(integrated.ledger.quadratic_j > 1.0 && integrated.ledger.coulomb_j == 0.0);
  }
  /* Thrown back at -w1: rest at atan(1)/rate, and on from there as above. */
  scene.linear.omega0_rad_per_s = -w1;
  const double rest = atan(1.0) / rate, on[] = {rest + 0.5, rest + 2.0};
  integrate_scene(&scene, 1e-11, 2, on, NULL);
  for (int i = 0; i < 2; i++) {
    ROT_CHECK_REL(integrated.out.omega_rad_per_s[i], w1 * tanh(rate * (on[i] - rest)), 1e-10);
  }
  const rot_event reverse[] = {ROT_EVENT_REVERSE};
  check_events(1, &rest, reverse, 1e-10);
}

/* All of it backwards again: a slide has no memory, so it comes home. */
static void check_friction_backwards(void) {
  const double time_s[] = {-50.0}, torque[] = {3.0}, back[] = {-2.0, 0.0};
  rot_axle_scene scene = bare(2.0, 0.0, 4.0);
  scene.linear.torque = knots(1, time_s, torque);
  scene.coulomb_n_m = 1.0;
  scene.static_n_m = 1.5;
  integrate_scene(&scene, 1e-10, 2, back, NULL);
  ROT_CHECK_REL(integrated.out.omega_rad_per_s[0], 2.0, 1e-13); /* (3 - 1)/2 = 1 a second */
  ROT_CHECK_REL(integrated.out.theta_rad[0], -6.0, 1e-13);
  /* Before -4 s it came the other way, at (3 + 1)/2 a second. */
  const double further[] = {-6.0, 0.0}, at = -4.0;
  integrate_scene(&scene, 1e-10, 2, further, NULL);
  ROT_CHECK_REL(integrated.out.omega_rad_per_s[0], -4.0, 1e-12);
  const rot_event reverse[] = {ROT_EVENT_REVERSE};
  check_events(1, &at, reverse, 1e-12);
}

/* ---- stiff ---------------------------------------------------------------------------------- */

static rot_status cubic_spring(double t, double theta, double omega, double *torque, void *ctx) {
  (void)omega;
  ++*(long *)ctx;
  *torque = 3.0 * sin(2.0 * t) - theta * theta * theta;
  return ROT_OK;
}

/* c/I from 1e6 to 1e12. Settled, c omega = torque to a part of (I/c)^2; against the stiff method at
 * its finest. */
static void check_stiff(void) {
  static double fine[MAX_ROWS];
  double t[20];
  for (int i = 0; i < 20; i++) t[i] = 0.5 * (i + 1);
  for (double ratio = 1e6; ratio < 2e12; ratio *= 1e2) {
    long calls = 0;
    const rot_axle_params p = axle(2.0, 2.0 * ratio, 0.0, 0.5, 3.0, law(cubic_spring, &calls));
    integrate(&p, 1e-13, 20, t, NULL);
    ROT_CHECK_EQ_INT(integrated.info.method, ROT_METHOD_RADAU);
    memcpy(fine, integrated.out.theta_rad, sizeof fine);
    calls = 0;
    integrate(&p, 1e-9, 20, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
    ROT_CHECK_EQ_INT(integrated.info.method, ROT_METHOD_RADAU);
    ROT_CHECK(calls < 20000);
    double error = 0.0, off = 0.0;
    for (int i = 0; i < 20; i++) {
      const double theta = integrated.out.theta_rad[i];
      const double settled = (3.0 * sin(2.0 * t[i]) - theta * theta * theta) / (2.0 * ratio);
      error = fmax(error, fabs(theta - fine[i]));
      off = fmax(off, fabs(integrated.out.omega_rad_per_s[i] - settled));
    }
    printf("c/I = %.0e: %ld calls, theta off by %.1e, omega by %.1e of its start\n", ratio, calls,
           error, off / 3.0);
    ROT_CHECK(error <= 1e-9);
    ROT_CHECK(off <= 1e-9 * 3.0 + 10.0 / (ratio * ratio));
  }
}

/* No resistance worth the name: the explicit method, and no word of stiffness. */
static void check_not_stiff(void) {
  pendulum p = hanging(18.0);
  const rot_axle_params scene = axle(2.0, 0.8, 0.0, 1.0, 3.0, law(gravity, &p));
  const double t = 20.0;
  for (double accuracy = 1e-2; accuracy > 1e-12; accuracy *= 0.1) {
    integrate(&scene, accuracy, 1, &t, NULL);
    ROT_CHECK_EQ_INT(integrated.info.method, ROT_METHOD_RK8PD);
  }
}

/* ---- changing inertia ----------------------------------------------------------------------- */

/* A skater: I from 4 to 1 in 3 s, L = 8, free; theta = (L t / I0) log1p(x)/x, x = (I - I0)/I0. Then
 * at 5 s I jumps to 2: omega halves, L stays. */
static void check_skater(void) {
  const double at_s[] = {0.0, 3.0, 5.0, 5.0}, moment[] = {4.0, 1.0, 1.0, 2.0};
  const double t[] = {0.0, 1.5, 3.0, 4.0, 6.0};
  rot_axle_scene scene = bare(4.0, 0.0, 2.0);
  scene.n_inertia = 4;
  scene.inertia_time_s = at_s;
  scene.inertia_kg_m2 = moment;
  const double to_3 = -8.0 * log(0.25), to_half = -8.0 * log(0.625);
  const double want[5][3] = {{0.0, 0.0, 2.0},
                             {1.5, to_half, 3.2},
                             {3.0, to_3, 8.0},
                             {4.0, to_3 + 8.0, 8.0},
                             {6.0, to_3 + 20.0, 4.0}};
  for (double accuracy = 1e-4; accuracy > 1e-12; accuracy *= 1e-3) {
    integrate_scene(&scene, accuracy, 5, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
    for (int i = 0; i < 5; i++) {
      ROT_CHECK(fabs(integrated.out.theta_rad[i] - want[i][1]) <=
                integrated.info.measure[ROT_THETA].error);
      ROT_CHECK(fabs(integrated.out.omega_rad_per_s[i] - want[i][2]) <=
                integrated.info.measure[ROT_OMEGA].error);
      ROT_CHECK_REL(integrated.out.angular_momentum_kg_m2_per_s[i], 8.0, 1e-13);
    }
    ROT_CHECK(rot_info_error(&integrated.info) <= accuracy);
  }
  /* 8 J at first, 32 J at 5 s, 16 J after. */
  ROT_CHECK_REL(integrated.ledger.inertia_work_j, 8.0, 1e-10);
  check_balances(5, 1e-9);
  ROT_CHECK(integrated.ledger.work_j == 0.0);
}

/* Torque, drag of every kind and a changing inertia, back and forth: the ledger balances. */
static void check_everything(void) {
  const double at_s[] = {-1.0, 2.0, 4.0}, moment[] = {1.0, 3.0, 0.5};
  const double wave[] = {2.0, 1.3, 0.4}, curve[] = {3.0, -1.0, 0.0, 5.0, 1.0, 0.2, -1.0};
  const double gravity_x[] = {1.5, 0.3};
  const rot_term terms[] = {{ROT_TERM_SINUSOID, -INFINITY, 5.0, 3, wave},
                            {ROT_TERM_CURVE, -INFINITY, INFINITY, 7, curve},
                            {ROT_TERM_GRAVITY, 1.0, INFINITY, 2, gravity_x}};
  const double breaks[] = {1.0, 5.0}, t[] = {-2.0, 0.0, 1.0, 3.0, 6.0, 9.0};
  rot_axle_scene scene = bare(1.0, 0.1, 2.0);
  scene.n_terms = 3;
  scene.terms = terms;
  scene.viscous_n_m_s = 0.1;
  scene.motor_n_m_s = 0.05;
  scene.linear.viscous_n_m_s = 0.15;
  scene.quadratic_n_m_s2 = 0.02;
  scene.coulomb_n_m = 0.2;
  scene.static_n_m = 0.3;
  scene.n_inertia = 3;
  scene.inertia_time_s = at_s;
  scene.inertia_kg_m2 = moment;
  scene.n_breaks = 2;
  scene.breaks_s = breaks;
  integrate_scene(&scene, 1e-9, 6, t, NULL);
  ROT_CHECK_EQ_INT(integrated.status, ROT_OK);
  check_balances(6, 1e-7);
  ROT_CHECK(events.count > 0);
  for (size_t i = 1; i < events.count; i++) {
    ROT_CHECK(events.time_s[i] >= events.time_s[i - 1]);
  }
  ROT_CHECK(integrated.ledger.viscous_j > 0.0 && integrated.ledger.quadratic_j > 0.0 &&
            integrated.ledger.coulomb_j > 0.0);
}

/* ---- the damped pendulum of the Modelica library --------------------------------------------- */

/* (I + m r^2) phi'' = -d phi' - m g r cos phi: gravity about -pi/2. The rows by mpmath's Taylor
 * series, 40 digits, from the doubles used here; the file holds to 5e-6 rad and 2.6e-5 rad/s. */
static void check_modelica(void) {
  const double x[] = {1.0 * 9.80665 * 0.5, -1.57079632679489661923};
  const rot_term term = {ROT_TERM_GRAVITY, -INFINITY, INFINITY, 2, x};
  rot_axle_scene scene = bare(0.001 + 1.0 * 0.25, 0.0, 0.0);
  scene.terms = &term;
  scene.n_terms = 1;
  scene.viscous_n_m_s = scene.linear.viscous_n_m_s = 0.1;
  const double t[] = {1.0, 2.5, 5.0};
  const double want[3][3] = {{1.0, -2.580710968569105819, 3.1741425660500984947},
                             {2.5, -2.3697869871195290011, 2.0091603032328570678},
                             {5.0, -1.679631565079194638, -2.318170232991577164}};
  for (double accuracy = 1e-5; accuracy > 1e-13; accuracy *= 1e-2) {
    integrate_scene(&scene, accuracy, 3, t, NULL);
    check_rows(3, want, accuracy);
  }
  FILE *file = shared_table("cases/modelica_damped_pendulum/reference.csv");
  double row[3];
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 3, row)) {
    integrate_scene(&scene, 1e-9, 1, row, NULL);
    ROT_CHECK(fabs(integrated.out.theta_rad[0] - row[1]) <= 5.1e-6);
    ROT_CHECK(fabs(integrated.out.omega_rad_per_s[0] - row[2]) <= 2.7e-5);
    rows++;
  }
  ROT_CHECK(rows > 100);
}

/* Upside down, pushed by so little that theta, rounded, would never leave: 3 sin(theta), viscous
 * 1/8. mpmath's Taylor series, 30 digits. */
static void check_upside_down(void) {
  const double x[] = {3.0, 0.0}, t[] = {5.0, 15.0, 25.0};
  const rot_term term = {ROT_TERM_GRAVITY, -INFINITY, INFINITY, 2, x};
  const double want[3][3] = {{5.0, 3.1415926548140221757, 2.0452925739752414577e-9},
                             {15.0, 3.1636483468346664542, 0.036847175194872157267},
                             {25.0, 6.2455589035009280418, -2.203993777413677496}};
  rot_axle_scene scene = bare(1.0, 3.141592653589793, 1e-12);
  scene.terms = &term;
  scene.n_terms = 1;
  scene.viscous_n_m_s = scene.linear.viscous_n_m_s = 0.125;
  for (double accuracy = 1e-6; accuracy > 1e-13; accuracy *= 1e-2) {
    integrate_scene(&scene, accuracy, 3, t, NULL);
    check_rows(3, want, accuracy);
    ROT_CHECK_REL(integrated.out.omega_rad_per_s[0], want[0][2], 100.0 * accuracy);
  }
}

/* ---- many rows ------------------------------------------------------------------------------ */

/* The torque of a row is what the law returns in its state, for a call a row; the probes between
 * the steps' own calls are some hundreds. */
static void check_torque_column(void) {
  enum { ROWS = 1000 };
  static double value[7][ROWS], t[ROWS];
  const rot_axle_columns out = {value[0], value[1], value[2], value[3],
                                value[4], value[5], value[6]};
  for (int i = 0; i < ROWS; i++) t[i] = 0.01 * (i + 1);
  for (double accuracy = 1e-3; accuracy > 1e-12; accuracy *= 1e-3) {
    pendulum p = hanging(18.0);
    const rot_axle_params params = axle(2.0, 0.8, 0.0, 1.0, 3.0, law(gravity, &p));
    const rot_axle_scene scene = scene_of(&params);
    const rot_axle_ode_options options = {accuracy, 100000, ROT_METHOD_NONE, 0.0, 0.0};
    rot_info info;
    ROT_CHECK_EQ_INT(rot_axle_integrate(&scene, &options, ROWS, t, &out, NULL, NULL, NULL, &info),
                     ROT_OK);
    double worst = 0.0;
    for (int i = 0; i < ROWS; i++) {
      worst = fmax(worst, fabs(value[2][i] + 18.0 * sin(value[0][i])));
      ROT_CHECK(value[4][i] == value[2][i] + value[3][i]);
    }
    printf("accuracy %.0e: %ld calls for 1000 rows, torque off by %.1e\n", accuracy, p.calls,
           worst / 18.0);
    ROT_CHECK(worst <= 32.0 * 0x1p-53 * 18.0);
    ROT_CHECK_EQ_INT(info.rhs_calls, p.calls);
    const long with_rows = p.calls;
    p.calls = 0;
    ROT_CHECK_EQ_INT(
        rot_axle_integrate(&scene, &options, 1, t + ROWS - 1, &out, NULL, NULL, NULL, &info),
        ROT_OK);
    ROT_CHECK(with_rows <= p.calls + ROWS + ROWS / 2); /* some mend the polynomials */
  }
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

/* Also at the rows: nothing is returned of a run that was stopped before its columns. */
static void check_stop_in_columns(void) {
  const double t[] = {0.5, 1.0, 2.0};
  pendulum whole = hanging(18.0);
  rot_axle_params scene = axle(2.0, 0.0, 0.0, 1.0, 0.0, law(gravity, &whole));
  integrate(&scene, 1e-9, 3, t, NULL);
  for (long before_end = 0; before_end < 40; before_end++) {
    pendulum p = hanging(18.0);
    p.stop_at = whole.calls - before_end;
    p.says = ROT_EUNWIND;
    scene.torque.ctx = &p;
    integrate(&scene, 1e-9, 3, t, NULL);
    ROT_CHECK_EQ_INT(integrated.status, ROT_EUNWIND);
    ROT_CHECK_EQ_INT(integrated.info.rows_done, before_end ? 0 : 2); /* the last row: at its end */
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
  const rot_axle_ode_options options = {1e-9, 60, ROT_METHOD_NONE, 0.0, 0.0};
  const rot_axle_scene whole = scene_of(&scene);
  const double t[] = {0.5, 1.0, 400.0};
  rot_axle_columns out = columns(&integrated);
  ROT_CHECK_EQ_INT(
      rot_axle_integrate(&whole, &options, 3, t, &out, NULL, NULL, NULL, &integrated.info),
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
  ROT_CHECK(integrated.out.damping_torque_n_m[0] == 3.5 &&
            integrated.out.rotational_kinetic_energy_j[0] == 49.0);
  ROT_CHECK(integrated.ledger.work_j == 0.0 && integrated.ledger.impulse_n_m_s == 0.0);
  ROT_CHECK_EQ_INT(p.calls, 1);
  ROT_CHECK(integrated.info.measure[ROT_THETA].largest == 1.0 &&
            integrated.info.measure[ROT_OMEGA].largest == 7.0);
}

int main(void) {
  check_scenes();
  check_pulse_is_not_missed();
  check_pendulum_energy();
  check_small_swing();
  check_balance();
  check_law_of_speed();
  check_law_with_breaks();
  check_constant_torque_and_friction();
  check_wave_and_friction();
  check_held();
  check_quadratic();
  check_friction_backwards();
  check_stiff();
  check_not_stiff();
  check_skater();
  check_everything();
  check_modelica();
  check_upside_down();
  check_torque_column();
  check_stop_by_law();
  check_stop_in_columns();
  check_nan_in_a_column();
  check_nan_later();
  check_budget();
  check_overflow();
  check_no_rows();
  check_only_the_start();
  rot_events_free(&events);
  return rot_test_report("axle_ode");
}
