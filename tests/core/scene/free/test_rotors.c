/* Rotors in a free body, integrated: against Taylor series at 40 digits (mpmath), motions known by
 * hand, the order of every method, the balance of energy and momentum. */
#include "scene/free/rotors.h"
#include "free_rows.h"
#include "maths/attitude.h"
#include "scene/free/steps.h"
#include "rot_test.h"

static rot_status stepped(const rot_free_params *p, rot_method method, double step_s, size_t n,
                          const double t[], rows *r, rot_info *info) {
  const rot_free_columns out = columns_of(r);
  double *flow[ROT_FREE_FLOWS];
  const rot_free_step_options options = {method, step_s, 10000000};
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = flows[k];
  return rot_free_step_through(p, &options, n, t, &out, flow, flow_error, NULL, info);
}

static double angle_off(const rows *r, size_t i, const double q[4]) {
  const double got[4] = {r->qw[i], r->qx[i], r->qy[i], r->qz[i]};
  double unit[4] = {q[0], q[1], q[2], q[3]};
  (void)rot_attitude_unit(unit);
  return rot_attitude_angle(got, unit);
}

static double rate_off(const rows *r, size_t i, const double w[3]) {
  return hypot(hypot(r->omega_x_rad_per_s[i] - w[0], r->omega_y_rad_per_s[i] - w[1]),
               r->omega_z_rad_per_s[i] - w[2]);
}

static const double third = 1.0 / 3.0;

/* A driven rotor along no principal axis. */
static rot_free_params oblique(rot_free_rotor *rotor) {
  rot_free_params p = scene(1.0, 2.0, 2.5, 1.0, 0.5, -0.3);
  memset(rotor, 0, sizeof *rotor);
  rotor->axis[0] = rotor->axis[2] = 2.0 * third, rotor->axis[1] = third;
  rotor->moment_kg_m2 = 0.1, rotor->omega_rad_per_s = 12.0, rotor->driven = 1;
  p.n_rotors = 1;
  p.rotors = rotor;
  return p;
}

/* A driven rotor, and two with motors; a torque. */
static rot_free_params three(rot_free_rotor rotor[3]) {
  rot_free_params p = scene(1.0, 2.0, 2.5, 1.0, 0.5, -0.3);
  memset(rotor, 0, 3 * sizeof *rotor);
  p.torque[0] = 0.1, p.torque[1] = -0.05, p.torque[2] = 0.02;
  rotor[0] = (rot_free_rotor){{1.0, 0.0, 0.0}, 0.1, 5.0, 1, 0.0, 0, NULL, NULL};
  rotor[1] =
      (rot_free_rotor){{2.0 * third, third, 2.0 * third}, 0.05, -3.0, 0, 0.01, 0, NULL, NULL};
  rotor[2] = (rot_free_rotor){{0.0, 0.0, -1.0}, 0.02, 30.0, 0, -0.04, 0, NULL, NULL};
  p.n_rotors = 3;
  p.rotors = rotor;
  return p;
}

/* Reference: mpmath.odefun(), 40 digits. */
static const double oblique_q[2][4] = {{0.86697247806156361985, 0.3571886804513477935,
                                        0.31087602602147261728, -0.15534176929053313269},
                                       {-0.37731371762056535552, 0.88734131387405444008,
                                        0.2493985006230198593, 0.089778277298044836397}};
static const double oblique_w[2][3] = {
    {0.46652958892826230121, 0.74296147509159916618, -0.40167979073578334096},
    {1.2892370901480241189, -0.16991231522284638828, 0.045287241726030073335}};
static const double three_q[2][4] = {{0.81372442331919634252, 0.54249088227569038458,
                                      0.084937283482853476593, -0.19063542015097239992},
                                     {-0.60936343712161966198, -0.18357061958947484921,
                                      0.10406100960265001111, -0.76429662788955138465}};
static const double three_w[2][3] = {
    {1.2650756485301201982, -0.15571776289902208221, -0.3411257434902722896},
    {-0.59653735519864733682, -0.91337406902272952044, -0.54221240293398722959}};
static const double three_speed[2][3] = {{5.0, -2.7307273490602245822, 27.95887425650972771},
                                         {5.0, -0.30304213823733387645, 19.75778759706601277}};

static void check_reference(void) {
  static rows r;
  rot_free_rotor rotor[3];
  rot_info info;
  const double t[2] = {1.0, 7.0}, u[2] = {1.0, 5.0};
  rot_free_params p = oblique(rotor);
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 2, t, &r, NULL, &info), ROT_OK);
  for (size_t i = 0; i < 2; i++) {
    printf("driven: off %.1e rad (said %.1e), %.1e rad/s\n", angle_off(&r, i, oblique_q[i]),
           info.measure[0].error, rate_off(&r, i, oblique_w[i]));
    ROT_CHECK(angle_off(&r, i, oblique_q[i]) <= info.measure[0].error + 1e-15);
    ROT_CHECK(rate_off(&r, i, oblique_w[i]) <= info.measure[1].error + 1e-15);
    ROT_CHECK(angle_off(&r, i, oblique_q[i]) <= 1e-12);
  }
  p = three(rotor);
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 2, u, &r, NULL, &info), ROT_OK);
  for (size_t i = 0; i < 2; i++) {
    printf("motors: off %.1e rad (said %.1e), %.1e rad/s\n", angle_off(&r, i, three_q[i]),
           info.measure[0].error, rate_off(&r, i, three_w[i]));
    ROT_CHECK(angle_off(&r, i, three_q[i]) <= 1e-12);
    ROT_CHECK(angle_off(&r, i, three_q[i]) <= info.measure[0].error + 1e-15);
    ROT_CHECK(rate_off(&r, i, three_w[i]) <= info.measure[1].error + 1e-15);
    for (int k = 0; k < 3; k++) ROT_CHECK(fabs(r.speed[k][i] - three_speed[i][k]) <= 1e-11);
  }
}

/* In other axes than the principal ones: the same motion. */
static void check_turned(void) {
  static rows r;
  rot_free_rotor rotor[3];
  rot_info info;
  const double u[2] = {1.0, 5.0};
  rot_free_params p = three(rotor);
  double axes[4] = {0.5, -0.5, 0.1, 0.7};
  (void)rot_attitude_unit(axes);
  p.turned = 1;
  memcpy(p.axes, axes, sizeof axes);
  for (int k = 0; k < 3; k++) rot_attitude_to_space(axes, rotor[k].axis, rotor[k].axis);
  rot_attitude_to_space(axes, p.omega0_rad_per_s, p.omega0_rad_per_s);
  rot_attitude_to_space(axes, p.torque, p.torque);
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 2, u, &r, NULL, &info), ROT_OK);
  for (size_t i = 0; i < 2; i++) {
    const double back[4] = {axes[0], -axes[1], -axes[2], -axes[3]};
    double want[4], w[3];
    rot_attitude_times(axes, three_q[i], want);
    rot_attitude_times(want, back, want);
    rot_attitude_to_space(axes, three_w[i], w);
    ROT_CHECK(angle_off(&r, i, want) <= 1e-12);
    ROT_CHECK(rate_off(&r, i, w) <= 1e-12);
  }
}

/* By hand: a wheel J = 0.01 about z of a body I = 2, both at rest. A torque u for 5 s gives it
 * J W' = u + J u/(I - J), and the body -u/(I - J): it turns the other way. Knots say the same. */
static rot_status steady(double t, const double omega[3], const double q[4], double torque[],
                         void *ctx) {
  (void)omega, (void)q, (void)ctx;
  torque[0] = t >= 0.0 && t <= 5.0 ? 0.02 : 0.0;
  return ROT_OK;
}

static void check_slew(void) {
  static const double knot_s[2] = {0.0, 5.0}, knot_torque[2] = {0.02, 0.02};
  static const double t[3] = {2.5, 5.0, 9.0};
  static rows r;
  for (int kind = 0; kind < 2; kind++) {
    rot_free_rotor wheel = {{0.0, 0.0, 1.0}, 0.01, 0.0, 0, 0.0, 0, NULL, NULL};
    rot_free_params p = scene(4.0, 5.0, 2.0, 0.0, 0.0, 0.0);
    rot_info info;
    p.n_rotors = 1;
    p.rotors = &wheel;
    p.n_breaks = 2;
    p.breaks_s = knot_s;
    if (kind == 0) wheel.n_knots = 2, wheel.knot_s = knot_s, wheel.knot_torque = knot_torque;
    if (kind == 1) p.motors = steady;
    ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 3, t, &r, NULL, &info), ROT_OK);
    for (size_t i = 0; i < 3; i++) {
      const double on = fmin(t[i], 5.0), rate = -0.02 * on / 1.99;
      const double angle = -0.01 * on * on / 1.99 + rate * (t[i] - on);
      const double want[4] = {cos(0.5 * angle), 0.0, 0.0, sin(0.5 * angle)};
      ROT_CHECK(fabs(r.omega_z_rad_per_s[i] - rate) <= 1e-14);
      ROT_CHECK(fabs(r.speed[0][i] - (2.0 * on - rate)) <= 1e-12);
      ROT_CHECK(fabs(r.momentum[0][i] - 0.02 * on) <= 1e-15);
      ROT_CHECK(angle_off(&r, i, want) <= 1e-13);
      ROT_CHECK(fabs(r.angular_momentum_z_kg_m2_per_s[i]) <= 1e-15);
      /* what the motor did is in body and wheel */
      const double energy = 0.5 * 1.99 * rate * rate + 0.5 * 0.02 * on * 0.02 * on / 0.01;
      ROT_CHECK(fabs(r.rotational_kinetic_energy_j[i] - energy) <= 1e-13);
      ROT_CHECK(fabs(flows[ROT_FREE_MOTOR_WORK][i] - energy) <= 1e-13);
    }
    ROT_CHECK(rot_info_error(&info) < 1e-12);
  }
}

/* The integrator's figures, and the sums: L in space stays without a torque, the energy changes by
 * the work of the motors. */
static void check_balance(void) {
  static rows r;
  const double t[4] = {-3.0, 0.0, 2.0, 6.0};
  rot_free_rotor rotor[3];
  rot_info info;
  rot_free_params p = three(rotor);
  p.torque[0] = p.torque[1] = p.torque[2] = 0.0;
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 4, t, &r, NULL, &info), ROT_OK);
  for (size_t i = 0; i < 4; i++) {
    const double work = flows[ROT_FREE_MOTOR_WORK][i] - flows[ROT_FREE_MOTOR_WORK][1];
    const double energy = r.rotational_kinetic_energy_j[i] - r.rotational_kinetic_energy_j[1];
    ROT_CHECK(fabs(work - energy) <= 1e-10);
    ROT_CHECK(fabs(work - energy) <= flow_error[ROT_FREE_MOTOR_WORK] + 1e-14);
    ROT_CHECK(i == 1 || fabs(work) > 0.1);
    ROT_CHECK(fabs(r.angular_momentum_x_kg_m2_per_s[i] - r.angular_momentum_x_kg_m2_per_s[1]) <
              1e-11);
    ROT_CHECK(fabs(r.angular_momentum_y_kg_m2_per_s[i] - r.angular_momentum_y_kg_m2_per_s[1]) <
              1e-11);
    ROT_CHECK(fabs(r.angular_momentum_z_kg_m2_per_s[i] - r.angular_momentum_z_kg_m2_per_s[1]) <
              1e-11);
  }
}

/* By halved steps: of attitude, rates, and speeds of rotors. */
static void check_orders(void) {
  static const rot_method method[3] = {ROT_METHOD_EULER, ROT_METHOD_SEMI_IMPLICIT, ROT_METHOD_RK4};
  static rows r;
  const double end = 5.0;
  for (int k = 0; k < 3; k++) {
    double off[2][3];
    const double step = k == 2 ? 1.0 / 64.0 : 1.0 / 4096.0;
    for (int half = 0; half < 2; half++) {
      rot_free_rotor rotor[3];
      rot_info info;
      const rot_free_params p = three(rotor);
      ROT_CHECK_EQ_INT(stepped(&p, method[k], ldexp(step, -half), 1, &end, &r, &info), ROT_OK);
      off[half][0] = angle_off(&r, 0, three_q[1]);
      off[half][1] = rate_off(&r, 0, three_w[1]);
      off[half][2] = fabs(r.speed[1][0] - three_speed[1][1]);
      ROT_CHECK(off[half][0] <= 2.0 * info.measure[0].error);
    }
    for (int of = 0; of < 3; of++) {
      const double order = log2(off[0][of] / off[1][of]);
      printf("rotors, %s: %.1e off, order %.2f\n", rot_method_name(method[k]), off[1][of], order);
      ROT_CHECK(fabs(order - rot_free_step_order(method[k])) < 0.12);
    }
  }
}

/* The splitting: order 6 by the distance from 8 times as many steps, a driven rotor and one free of
 * friction; the energy without the rotors' own stays within a bound. */
static void check_split(void) {
  static rows r, fine;
  const double end = 5.0, t[4] = {50.0, 100.0, 1000.0, 2000.0};
  double off[2][2], drift[2];
  rot_free_rotor rotor[3];
  rot_info info;
  rot_free_params p = three(rotor);
  p.torque[0] = p.torque[1] = p.torque[2] = 0.0;
  rotor[1].driven = 1;
  rotor[2].torque = 0.0;
  ROT_CHECK(rot_free_not_split(&p) == NULL);
  ROT_CHECK_EQ_INT(integrated(&p, 1e-13, ROT_METHOD_NONE, 1, &end, &fine, NULL, &info), ROT_OK);
  const double energy = fine.rotational_kinetic_energy_j[0] - flows[ROT_FREE_MOTOR_WORK][0];
  const double q[4] = {fine.qw[0], fine.qx[0], fine.qy[0], fine.qz[0]};
  const double w[3] = {fine.omega_x_rad_per_s[0], fine.omega_y_rad_per_s[0],
                       fine.omega_z_rad_per_s[0]};
  for (int half = 0; half < 2; half++) {
    const double step = ldexp(0.125, -half);
    ROT_CHECK_EQ_INT(stepped(&p, ROT_METHOD_SPLIT, step, 1, &end, &r, &info), ROT_OK);
    off[half][0] = angle_off(&r, 0, q);
    off[half][1] = rate_off(&r, 0, w);
    ROT_CHECK(off[half][0] <= 1.5 * info.measure[0].error);
  }
  for (int of = 0; of < 2; of++) {
    const double order = log2(off[0][of] / off[1][of]);
    printf("rotors, split: %.1e off, order %.2f\n", off[1][of], order);
    ROT_CHECK(fabs(order - 6.0) < 0.4);
  }
  ROT_CHECK_EQ_INT(stepped(&p, ROT_METHOD_SPLIT, 0.25, 4, t, &r, &info), ROT_OK);
  for (int late = 0; late < 2; late++) {
    drift[late] = 0.0;
    for (int i = 2 * late; i < 2 * late + 2; i++) {
      const double change = r.rotational_kinetic_energy_j[i] - flows[ROT_FREE_MOTOR_WORK][i];
      drift[late] = fmax(drift[late], fabs(change - energy));
    }
  }
  printf("rotors, split: energy off by %.1e early, %.1e late\n", drift[0], drift[1]);
  ROT_CHECK(drift[1] < 1e-4 && drift[1] < 20.0 * drift[0] + 1e-12);
  rotor[1].driven = 0; /* along no principal axis */
  ROT_CHECK(rot_free_not_split(&p) != NULL);
}

/* Which scenes have no motion; and a rotor without speed that is driven changes nothing. */
static void check_limits(void) {
  static rows r, x;
  rot_free_rotor rotor;
  rot_free_rotors begun;
  rot_info info;
  const double t[2] = {1.0, 7.0};
  rot_free_params p = oblique(&rotor);
  rotor.driven = 0;
  rotor.moment_kg_m2 = 3.0; /* more than the body has */
  ROT_CHECK(rot_free_rotors_begin(&p, &begun) != NULL);
  ROT_CHECK(rot_free_not_integrated(&p) != NULL);
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 2, t, &r, NULL, &info), ROT_EVALUE);
  /* Moments 1, 2, 2.5: along an axis less than the body's there, but for a rounding. Two rotors
   * that are too large along two axes leave a tensor of positive determinant. */
  rot_free_rotor two[2] = {rotor, rotor};
  for (int axis = 0; axis < 3; axis++) {
    const double own = p.moment_kg_m2[axis];
    for (int i = 0; i < 3; i++) rotor.axis[i] = i == axis;
    rotor.moment_kg_m2 = own * (1.0 - 1e-10);
    ROT_CHECK(rot_free_rotors_begin(&p, &begun) == NULL);
    rotor.moment_kg_m2 = own * (1.0 + 1e-10);
    ROT_CHECK(rot_free_rotors_begin(&p, &begun) != NULL);
    for (int k = 0; k < 2; k++) {
      const int at = (axis + 1 + k) % 3;
      for (int i = 0; i < 3; i++) two[k].axis[i] = i == at;
      two[k].moment_kg_m2 = 2.0 * p.moment_kg_m2[at];
    }
    p.rotors = two;
    p.n_rotors = 2;
    ROT_CHECK(rot_free_rotors_begin(&p, &begun) != NULL);
    p.rotors = &rotor;
    p.n_rotors = 1;
  }
  rotor.driven = 1;
  rotor.omega_rad_per_s = 0.0;
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 2, t, &r, NULL, &info), ROT_OK);
  p.n_rotors = 0;
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 2, t, &x, NULL, &info), ROT_OK);
  for (size_t i = 0; i < 2; i++) {
    const double q[4] = {x.qw[i], x.qx[i], x.qy[i], x.qz[i]};
    ROT_CHECK(angle_off(&r, i, q) <= 1e-12);
  }
}

int main(void) {
  check_reference();
  check_turned();
  check_slew();
  check_balance();
  check_orders();
  check_split();
  check_limits();
  return rot_test_report("free_rotors");
}
