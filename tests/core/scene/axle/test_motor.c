/* A linear motor beside viscous resistance: columns, ledger and bounds keep the two apart. */
#include "scene/axle/forced.h"
#include "scene/axle/linear.h"
#include "scene/axle/motor.h"
#include "ground/real.h"
#include "rot_test.h"

enum { ROWS = 3 };
static double column[7][ROWS];
static const rot_axle_columns out = {column[0], column[1], column[2], column[3],
                                     column[4], column[5], column[6]};
static const double time_s[ROWS] = {0.0, 1.0, 3.0};

/* 3 - 0.5 omega from the motor, c = 0.25, I = 2: omega = 4 (1 - exp(-3 t/8)). */
static rot_axle_scene motor_scene(double motor, double viscous) {
  const rot_axle_scene scene = {.linear = {.inertia_kg_m2 = 2.0,
                                           .viscous_n_m_s = viscous + motor,
                                           .torque = {.before_n_m = 3.0, .after_n_m = 3.0}},
                                .viscous_n_m_s = viscous,
                                .motor_n_m_s = motor};
  return scene;
}

static void check_columns(void) {
  const rot_axle_scene scene = motor_scene(0.5, 0.25);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear_scene(&scene, ROWS, time_s, &out, NULL, NULL, &info), ROT_OK);
  for (int i = 0; i < ROWS; i++) {
    const double omega = -4.0 * expm1(-0.375 * time_s[i]);
    ROT_CHECK_ULP(out.omega_rad_per_s[i], omega, 2);
    ROT_CHECK(out.applied_torque_n_m[i] == 3.0 - 0.5 * out.omega_rad_per_s[i]);
    ROT_CHECK(out.damping_torque_n_m[i] == -0.25 * out.omega_rad_per_s[i]);
    ROT_CHECK(out.net_torque_n_m[i] == out.applied_torque_n_m[i] + out.damping_torque_n_m[i]);
  }
  /* The same by superposition. */
  const double omega = out.omega_rad_per_s[2], applied = out.applied_torque_n_m[2];
  ROT_CHECK_EQ_INT(rot_axle_forced(&scene, ROWS, time_s, &out, NULL, NULL, &info), ROT_OK);
  ROT_CHECK_ULP(out.omega_rad_per_s[2], omega, 4);
  ROT_CHECK_ULP(out.applied_torque_n_m[2], applied, 4);
}

/* Work of the motor's own torque: that of 3 N m less what its slope takes, two thirds of the
 * heat. */
static void check_ledger(void) {
  const rot_axle_scene scene = motor_scene(0.5, 0.25);
  rot_axle_ledger both, parted;
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(&scene.linear, 0.0, 3.0, NULL, &both, &info), ROT_OK);
  parted = both;
  rot_axle_motor_ledger(&scene, &parted);
  ROT_CHECK_ULP(parted.work_j, both.work_j - 2.0 / 3.0 * both.dissipated_j, 2);
  ROT_CHECK_ULP(parted.dissipated_j, both.dissipated_j / 3.0, 4);
  ROT_CHECK_ULP(parted.damping_impulse_n_m_s, both.damping_impulse_n_m_s / 3.0, 4);
  ROT_CHECK_REL(parted.work_j - parted.dissipated_j, both.work_j - both.dissipated_j, 1e-15);
  const rot_axle_scene plain = motor_scene(0.0, 0.75);
  parted = both;
  rot_axle_motor_ledger(&plain, &parted);
  ROT_CHECK(parted.work_j == both.work_j && parted.dissipated_j == both.dissipated_j);
}

/* A slope that is off by a rounding: the true motion stays within the bound, also where slope and
 * resistance cancel. */
static void check_error(void) {
  const double slopes[][2] = {{1.0 / 3.0, 0.1}, {1.0 / 3.0, -0.3}, {1e3 / 3.0, -1e3 / 3.0 + 0.5}};
  for (int k = 0; k < 3; k++) {
    rot_axle_scene scene = motor_scene(slopes[k][0], slopes[k][1]);
    rot_info info, plain;
    ROT_CHECK_EQ_INT(rot_axle_linear_scene(&scene, ROWS, time_s, &out, NULL, NULL, &info), ROT_OK);
    const double omega = out.omega_rad_per_s[2], theta = out.theta_rad[2];
    for (int sign = -1; sign <= 1; sign += 2) {
      scene.linear.viscous_n_m_s =
          slopes[k][0] + slopes[k][1] +
          sign * ROT_EPS * (fabs(slopes[k][0]) + fabs(slopes[k][0] + slopes[k][1]));
      rot_axle_linear(&scene.linear, ROWS, time_s, &out, NULL, &plain);
      ROT_CHECK(fabs(out.omega_rad_per_s[2] - omega) <= info.measure[ROT_OMEGA].error);
      ROT_CHECK(fabs(out.theta_rad[2] - theta) <= info.measure[ROT_THETA].error);
    }
    ROT_CHECK(info.measure[ROT_OMEGA].error > plain.measure[ROT_OMEGA].error);
    ROT_CHECK(rot_info_error(&info) < 1e-12);
  }
}

/* Without a motor nothing is summed, and without rows nothing is known: the bounds stay. */
static void check_no_motor(void) {
  const rot_axle_scene plain = motor_scene(0.0, 0.25), scene = motor_scene(0.5, 0.25);
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(&plain.linear, ROWS, time_s, &out, NULL, &info), ROT_OK);
  const double theta = info.measure[ROT_THETA].error, omega = info.measure[ROT_OMEGA].error;
  rot_axle_motor_error(&plain, ROWS, time_s, &info);
  ROT_CHECK(info.measure[ROT_THETA].error == theta && info.measure[ROT_OMEGA].error == omega);
  rot_axle_motor_error(&scene, 0, NULL, &info);
  ROT_CHECK(info.measure[ROT_THETA].error == theta && info.measure[ROT_OMEGA].error == omega);
}

/* The same where the resistance drives more than the motor brakes, so that all errors grow. */
static void check_growing(void) {
  rot_axle_scene scene = motor_scene(1.0 / 3.0, -0.5);
  rot_info info, plain;
  ROT_CHECK_EQ_INT(rot_axle_linear_scene(&scene, ROWS, time_s, &out, NULL, NULL, &info), ROT_OK);
  const double omega = out.omega_rad_per_s[2], theta = out.theta_rad[2];
  for (int sign = -1; sign <= 1; sign += 2) {
    scene.linear.viscous_n_m_s = 1.0 / 3.0 - 0.5 + sign * ROT_EPS * (0.5 + 1.0 / 3.0);
    rot_axle_linear(&scene.linear, ROWS, time_s, &out, NULL, &plain);
    ROT_CHECK(fabs(out.omega_rad_per_s[2] - omega) <= info.measure[ROT_OMEGA].error);
    ROT_CHECK(fabs(out.theta_rad[2] - theta) <= info.measure[ROT_THETA].error);
  }
  ROT_CHECK(info.measure[ROT_OMEGA].error > plain.measure[ROT_OMEGA].error);
  ROT_CHECK(info.measure[ROT_THETA].error > plain.measure[ROT_THETA].error);
}

/* From above, over times in which the first motion has decayed: the slope has an error of d =
 * ROT_EPS (|motor| + c), which changes omega by at most 3.4 d/c of its largest value, and theta by
 * as much over a time I/c, and beside by that fraction of the twelve roundings of its terms. */
static void check_error_over_long_times(void) {
  const double long_s[ROWS] = {0.0, 1e3, 1e5};
  const rot_axle_scene scene = motor_scene(0.5, 0.25);
  rot_info info, plain;
  ROT_CHECK_EQ_INT(rot_axle_linear(&scene.linear, ROWS, long_s, &out, NULL, &plain), ROT_OK);
  info = plain;
  rot_axle_motor_error(&scene, ROWS, long_s, &info);
  const double part = 3.5 * (0.5 + 0.75) / 0.75;
  const double omega = part * ROT_EPS * info.measure[ROT_OMEGA].largest;
  const double theta = part / 12.0 * plain.measure[ROT_THETA].error + 2.0 / 0.75 * omega;
  const double of_omega = info.measure[ROT_OMEGA].error - plain.measure[ROT_OMEGA].error;
  const double of_theta = info.measure[ROT_THETA].error - plain.measure[ROT_THETA].error;
  ROT_CHECK(of_omega > 0.5 * omega && of_omega <= omega);
  ROT_CHECK(of_theta > 0.5 * theta && of_theta <= theta);
}

int main(void) {
  check_columns();
  check_ledger();
  check_error();
  check_no_motor();
  check_growing();
  check_error_over_long_times();
  return rot_test_report("axle_motor");
}
