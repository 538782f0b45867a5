/* Gyrostats in closed form: against Taylor series at 40 digits (mpmath), and integration. */
#include <stdlib.h>

#include "free_rows.h"
#include "maths/attitude.h"
#include "scene/free/gyrostat.h"
#include "rot_test.h"

static rot_free_rotor rotor_of(double x, double y, double z, double moment, double omega,
                               int driven) {
  return (rot_free_rotor){{x, y, z}, moment, omega, driven, 0.0, 0, NULL, NULL};
}

static rot_status exact(const rot_free_params *p, size_t n, const double t[], rows *r,
                        rot_info *info) {
  const rot_free_columns out = columns_of(r);
  return rot_free_gyrostat(p, n, t, &out, NULL, NULL, info);
}

/* Reference: mpmath.odefun(), 40 digits. Free of torque, the rotor moves alike. */
static void check_reference(void) {
  static rows r;
  static const double t[2] = {1.0, 8.0};
  static const double q[2][4] = {{0.83738313266012353307, 0.15130089609740503125,
                                  -0.057469338102073032797, 0.522106122502456215},
                                 {-0.1484125166484641331, 0.0065440363409930505126,
                                  0.017449263661188870637, -0.9887499298043562604}};
  static const double w[2][2] = {{0.35712723752804911858, -0.049599760237166321208},
                                 {-0.35753161355921457861, 0.046595550278373685894}};
  for (int driven = 0; driven < 2; driven++) {
    for (int back = 0; back < 2; back++) { /* the axis the other way, and its speed */
      rot_free_rotor rotor = rotor_of(0, 0, back ? -1 : 1, 0.1, back ? -20 : 20, driven);
      rot_free_params p = scene(2.0, 2.0, 1.0, 0.3, -0.2, 1.1);
      rot_info info;
      p.n_rotors = 1;
      p.rotors = &rotor;
      ROT_CHECK(rot_free_not_gyrostat(&p) == NULL);
      ROT_CHECK_EQ_INT(exact(&p, 2, t, &r, &info), ROT_OK);
      for (size_t i = 0; i < 2; i++) {
        double unit[4] = {q[i][0], q[i][1], q[i][2], q[i][3]};
        const double got[4] = {r.qw[i], r.qx[i], r.qy[i], r.qz[i]};
        (void)rot_attitude_unit(unit);
        ROT_CHECK(rot_attitude_angle(got, unit) <= 2e-15);
        ROT_CHECK(fabs(r.omega_x_rad_per_s[i] - w[i][0]) <= 1e-15);
        ROT_CHECK(fabs(r.omega_y_rad_per_s[i] - w[i][1]) <= 1e-15);
        ROT_CHECK(r.omega_z_rad_per_s[i] == 1.1);
        ROT_CHECK_ULP(r.speed[0][i], back ? -20.0 : 20.0, 4);
        ROT_CHECK_ULP(r.momentum[0][i], back ? -2.11 : 2.11, 4);
        /* L of all: 0.6, -0.4, 3.1 in space */
        ROT_CHECK(fabs(r.angular_momentum_x_kg_m2_per_s[i] - 0.6) <= 1e-14);
        ROT_CHECK(fabs(r.angular_momentum_y_kg_m2_per_s[i] + 0.4) <= 1e-14);
        ROT_CHECK(fabs(r.angular_momentum_z_kg_m2_per_s[i] - 3.1) <= 1e-14);
        /* 0.5 (2 0.13 + 1.21) + 2 1.1 + 20 */
        ROT_CHECK_ULP(r.rotational_kinetic_energy_j[i], 22.935, 4);
      }
      ROT_CHECK(info.measure[0].error <= 5e-15 && rot_info_error(&info) <= 2e-14);
    }
  }
}

/* Each axis, in other axes, a ball with rotors along several axes, sums of rotors. */
static void check_integrated(void) {
  static rows x, y;
  static const double t[5] = {-4.0, -0.5, 0.25, 3.0, 12.0};
  for (int kind = 0; kind < 10; kind++) {
    const int axis = kind % 3, ball = kind / 3 == 3, turned = kind / 3 == 2;
    double m[3] = {1.7, 1.7, 1.7};
    rot_free_rotor rotor[2] = {rotor_of(0, 0, 0, 0.2, 9.0, 1), rotor_of(0, 0, 0, 0.1, 7.0, 0)};
    rotor[0].axis[axis] = 1.0;
    rotor[1].axis[axis] = -1.0;
    if (!ball) m[axis] = kind / 3 ? 0.9 : 2.9;
    if (ball) { /* two driven */
      rotor[1].driven = 1;
      rotor[1].axis[0] = 0.6, rotor[1].axis[1] = 0.8, rotor[1].axis[2] = 0.0;
    }
    rot_free_params p = scene(m[0], m[1], m[2], 0.4, 1.1, -0.6);
    rot_info by_form, by_steps;
    p.start_s = 0.125;
    p.n_rotors = 2;
    p.rotors = rotor;
    if (turned) {
      const double axes[4] = {0.5, -0.5, 0.1, 0.7}, q0[4] = {0.1, 0.2, -0.3, 0.4};
      memcpy(p.axes, axes, sizeof axes);
      memcpy(p.q0, q0, sizeof q0);
      (void)rot_attitude_unit(p.axes);
      (void)rot_attitude_unit(p.q0);
      p.turned = 1;
      p.given = 2e-15;
      for (int k = 0; k < 2; k++) rot_attitude_to_space(p.axes, rotor[k].axis, rotor[k].axis);
    }
    ROT_CHECK(rot_free_not_gyrostat(&p) == NULL);
    ROT_CHECK_EQ_INT(exact(&p, 5, t, &x, &by_form), ROT_OK);
    ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 5, t, &y, NULL, &by_steps), ROT_OK);
    double worst = 0.0, rate = 0.0, speed = 0.0;
    for (size_t i = 0; i < 5; i++) {
      worst = fmax(worst, angle_between(&x, &y, i));
      rate = fmax(rate, fabs(x.omega_x_rad_per_s[i] - y.omega_x_rad_per_s[i]));
      rate = fmax(rate, fabs(x.omega_y_rad_per_s[i] - y.omega_y_rad_per_s[i]));
      rate = fmax(rate, fabs(x.omega_z_rad_per_s[i] - y.omega_z_rad_per_s[i]));
      speed = fmax(speed, fabs(x.speed[1][i] - y.speed[1][i]));
      ROT_CHECK(fabs(x.rotational_kinetic_energy_j[i] - y.rotational_kinetic_energy_j[i]) < 1e-11);
    }
    printf("gyrostat %d: %.1e rad (said %.1e, by steps %.1e)\n", kind, worst,
           by_form.measure[0].error, by_steps.measure[0].error);
    ROT_CHECK(worst <= by_form.measure[0].error + by_steps.measure[0].error);
    ROT_CHECK(rate <= by_form.measure[1].error + by_steps.measure[1].error);
    ROT_CHECK(worst <= 5e-12 && speed <= 1e-11);
    ROT_CHECK(by_form.measure[0].error <= (turned ? 1e-10 : 1e-14));
  }
}

/* Three moments: all cases of the turning points, against integration; steady spins; both signs of
 * the rotor's axis say the same. */
static void check_three_moments(void) {
  static rows x, y;
  static const double t[5] = {-4.0, -0.5, 0.25, 3.0, 12.0};
  double closest = 0.0;
  srand(7);
  for (int kind = 0; kind < rot_test_trials(120); kind++) {
    double random[8];
    for (int i = 0; i < 8; i++) random[i] = (double)rand() / RAND_MAX;
    const int axis = kind % 3;
    rot_free_params p = scene(0.3 + random[0], 0.3 + random[1], 0.3 + random[2],
                              4.0 * random[3] - 2.0, 4.0 * random[4] - 2.0, 4.0 * random[5] - 2.0);
    rot_free_rotor rotor =
        rotor_of(0, 0, 0, 0.05 + 0.1 * random[6], 40.0 * random[7] - 20.0, kind % 4 < 2);
    rot_info by_form, by_steps;
    rotor.axis[axis] = kind % 2 ? 1.0 : -1.0;
    if (kind % 5 == 0) p.omega0_rad_per_s[(axis + 1) % 3] = 0.0; /* starts at a turning point */
    if (kind % 10 == 5) p.omega0_rad_per_s[(axis + 2) % 3] *= 1e-8;
    p.n_rotors = 1;
    p.rotors = &rotor;
    if (rot_free_not_gyrostat(&p)) continue;
    ROT_CHECK_EQ_INT(exact(&p, 5, t, &x, &by_form), ROT_OK);
    ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 5, t, &y, NULL, &by_steps), ROT_OK);
    for (size_t i = 0; i < 5; i++) {
      const double off = angle_between(&x, &y, i);
      ROT_CHECK(off <=
                by_form.measure[0].error + 2.0 * by_steps.measure[0].error); /* an estimate */
      ROT_CHECK(fabs(x.omega_x_rad_per_s[i] - y.omega_x_rad_per_s[i]) <=
                by_form.measure[1].error + 2.0 * by_steps.measure[1].error);
      ROT_CHECK(fabs(x.omega_z_rad_per_s[i] - y.omega_z_rad_per_s[i]) <=
                by_form.measure[1].error + 2.0 * by_steps.measure[1].error);
      ROT_CHECK(fabs(x.speed[0][i] - y.speed[0][i]) <= 1e-10);
      closest = fmax(closest, off);
    }
    ROT_CHECK(by_form.measure[0].error <= 1e-11);
  }
  printf("three moments: %.1e rad from the steps at most\n", closest);
  ROT_CHECK(closest < 1e-11);
  /* A spin about the middle axis with the rotor on it is steady: 2^40 rad. */
  rot_free_rotor rotor = rotor_of(0, 1, 0, 0.125, 16, 1);
  rot_free_params p = scene(1.0, 2.0, 3.0, 0.0, 1.0, 0.0);
  rot_info info;
  const double late = 0x1p40;
  p.n_rotors = 1;
  p.rotors = &rotor;
  ROT_CHECK_EQ_INT(exact(&p, 1, &late, &x, &info), ROT_OK);
  ROT_CHECK(fabs(x.qw[0] - cos(0x1p39)) <= 1e-15 && fabs(x.qy[0] - sin(0x1p39)) <= 1e-15);
  ROT_CHECK(x.omega_y_rad_per_s[0] == 1.0 && info.measure[0].error <= 5e-15);
}

/* Where there is none: the scene is refused. */
static void check_refused(void) {
  static rows r;
  rot_info info;
  const double t = 1.0;
  rot_free_rotor rotor = rotor_of(0, 0, 1, 0.1, 20, 1);
  rot_free_params p = scene(2.0, 2.0, 1.0, 0.3, -0.2, 1.1);
  ROT_CHECK(rot_free_not_gyrostat(&p) != NULL); /* no rotor */
  p.n_rotors = 1;
  p.rotors = &rotor;
  ROT_CHECK(rot_free_not_gyrostat(&p) == NULL);
  p.moment_kg_m2[0] = 2.0 + 0x1p-51; /* three moments */
  ROT_CHECK(rot_free_not_gyrostat(&p) == NULL);
  p.moment_kg_m2[0] = 2.0;
  rotor.axis[0] = 1e-17;
  ROT_CHECK(rot_free_not_gyrostat(&p) != NULL);
  ROT_CHECK_EQ_INT(exact(&p, 1, &t, &r, &info), ROT_EVALUE);
  rotor.axis[0] = 1.0, rotor.axis[2] = 0.0; /* across the axis of symmetry: a principal axis */
  ROT_CHECK(rot_free_not_gyrostat(&p) == NULL);
  rotor.axis[0] = 0.6, rotor.axis[2] = 0.8;
  ROT_CHECK(rot_free_not_gyrostat(&p) != NULL);
  p.moment_kg_m2[2] = 2.0; /* a ball: any axis */
  ROT_CHECK(rot_free_not_gyrostat(&p) == NULL);
}

/* Momentum 0: the body turns steadily against its rotor. At 1e12 s no digit is lost: 2^40 turns of
 * the body by 2 pi x 0.25 would be exact, and so is omega t = -2^40 rad to the rounding of cos. */
static void check_long(void) {
  static rows r;
  rot_info info;
  const double t = 0x1p40;
  rot_free_rotor rotor = rotor_of(0, 0, 1, 0.125, 16, 1);
  rot_free_params p = scene(2.0, 2.0, 2.0, 0.0, 0.0, -1.0);
  p.n_rotors = 1;
  p.rotors = &rotor;
  ROT_CHECK_EQ_INT(exact(&p, 1, &t, &r, &info), ROT_OK);
  ROT_CHECK(fabs(r.qw[0] - cos(0x1p39)) <= 1e-15 && fabs(r.qz[0] + sin(0x1p39)) <= 1e-15);
  ROT_CHECK(r.angular_momentum_z_kg_m2_per_s[0] == 0.0);
  ROT_CHECK(info.measure[0].error <= 5e-15);
  /* and with all momentum in the rotor */
  p.omega0_rad_per_s[2] = 0.0;
  p.omega0_rad_per_s[0] = 0.5;
  ROT_CHECK_EQ_INT(exact(&p, 1, &t, &r, &info), ROT_OK);
  ROT_CHECK(info.measure[0].error <= 5e-15);
}

/* Pairs of rotors of a ball against each other, along x equal but for the last digit that a sum of
 * products has. What is left points along x, but rounding may have it anywhere else. */
static void check_cancelled(void) {
  static rows r;
  rot_info info;
  const double t = 1.0;
  rot_free_rotor rotor[4] = {rotor_of(1, 0, 0, 1.0 + 0x1p-52, 1.0 - 0x1p-52, 1),
                             rotor_of(-1, 0, 0, 1.0, 1.0, 1), rotor_of(0, 1, 0, 1.0, 1.0, 1),
                             rotor_of(0, -1, 0, 1.0, 1.0, 1)};
  rot_free_params p = scene(8.0, 8.0, 8.0, 0.0, 1.0, 0.0);
  p.n_rotors = 4;
  p.rotors = rotor;
  ROT_CHECK_EQ_INT(exact(&p, 1, &t, &r, &info), ROT_OK);
  ROT_CHECK(info.measure[0].error >= 1.0);
  rotor[1].omega_rad_per_s = 2.0; /* the rest is as long as the others: its axis is known */
  ROT_CHECK_EQ_INT(exact(&p, 1, &t, &r, &info), ROT_OK);
  ROT_CHECK(info.measure[0].error > 0.0 && info.measure[0].error <= 1e-14);
}

/* Two rotors of a ball leave 2^-40 of their momenta: the direction of that is known to 16 roundings
 * of double-doubles, 2^-102, of the sum of their sizes over it, and turns the body twice. */
static void check_left_over(void) {
  static rows r;
  rot_info info;
  const double t = 0.0, left = 0x1p-49;
  rot_free_rotor rotor[2] = {rotor_of(0.6, 0.8, 0, 1.0, 1.0, 1),
                             rotor_of(-0.6, -0.8, 0, 1.0, 1.0 - left, 1)};
  rot_free_params p = scene(8.0, 8.0, 8.0, 0.0, 0.0, 1.0);
  p.n_rotors = 2;
  p.rotors = rotor;
  ROT_CHECK_EQ_INT(exact(&p, 1, &t, &r, &info), ROT_OK);
  const double direction = 16.0 * 0x1p-102 * 2.0 / left;

  ROT_CHECK_REL(info.measure[0].error, 2.0 * direction + 32.0 * 0x1p-53, 1e-3);
}

int main(void) {
  check_reference();
  check_integrated();
  check_three_moments();
  check_refused();
  check_long();
  check_cancelled();
  check_left_over();
  return rot_test_report("free_gyrostat");
}
