/* Balances by the C interface: an engagement by hand, a planted law, and what is refused. */
#include "api/audit.h"

#include <math.h>
#include <string.h>

#include "rot_test.h"

static rotdyn_object *clutch(void) {
  rotdyn_object *scene = rotdyn_object_new("scene_clutch");
  (void)rotdyn_set_number(scene, "body_1", 2.0);
  (void)rotdyn_set_number(scene, "body_2", 3.0);
  (void)rotdyn_set_number(scene, "capacity_n_m", 12.0);
  (void)rotdyn_set_numbers(scene, "omega0_rad_per_s", 2, (double[]){10.0, 0.0});
  return scene;
}

/* I = 2 and 3, 10 and 0 rad/s: from 100 J to 40 J, 60 J of heat, 20 kg m^2/s kept. */
static void check_engagement(void) {
  rotdyn_object *scene = clutch();
  const double time_s[] = {0.0, 0.25, 2.0};
  rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 3, time_s, NULL, 0, &b, &report), ROTDYN_OK);
  ROT_CHECK(!strcmp(b.quantity, "energy") && !b.about && !strcmp(b.unit, "J"));
  ROT_CHECK_REL(b.change, -60.0, 1e-14);
  ROT_CHECK_REL(b.dissipated, 60.0, 1e-14);
  ROT_CHECK(b.supplied == 0.0 && b.balanced == 1 && b.conserved == 0);
  ROT_CHECK(b.explained > 0.0 && b.explained < 1e-11 && fabs(b.residual) <= b.explained);
  ROT_CHECK(!strcmp(b.why, "the clutch slips: heat") && b.n_terms == 3 && b.role[0] == 2);
  ROT_CHECK(!strcmp(report.model, "clutch_exact") && report.status == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 3, time_s, NULL, 1, &b, NULL), ROTDYN_OK);
  ROT_CHECK(!strcmp(b.quantity, "angular_momentum") && !strcmp(b.about, "the axle"));
  ROT_CHECK(b.conserved == 1 && b.balanced == 1 && fabs(b.change) <= b.explained);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 3, time_s, NULL, 2, &b, NULL), ROTDYN_EEND);
  rotdyn_object_free(scene);
}

/* A law of time along a slope: its work is in the balance, at any accuracy. */
static int push(const double *argument, double *value, void *context) {
  (void)context;
  *value = 3.0 * sin(2.0 * argument[0]);
  return 0;
}

static void check_law(void) {
  rotdyn_object *scene = rotdyn_object_new("scene_incline");
  rotdyn_object *ball = rotdyn_object_new("body_sphere");
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
  const double time_s[] = {0.5, 1.0, 3.0};
  (void)rotdyn_set_number(ball, "mass_kg", 2.0);
  (void)rotdyn_set_number(ball, "radius_m", 0.1);
  (void)rotdyn_set_object(scene, "body", ball);
  (void)rotdyn_set_number(scene, "incline_angle_deg", 5.0);
  (void)rotdyn_set_number(scene, "static_friction", 0.4);
  (void)rotdyn_set_law(scene, "force", push, NULL);
  for (int i = 3; i < 12; i += 4) {
    options.accuracy = pow(10.0, -i);
    ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 3, time_s, &options, 0, &b, NULL), ROTDYN_OK);
    ROT_CHECK(b.balanced == 1 && b.explained <= 1e3 * options.accuracy * fabs(b.change) + 1e-12);
    ROT_CHECK(b.n_terms >= 5 && b.supplied != 0.0);
  }
  rotdyn_object_free(ball);
  rotdyn_object_free(scene);
}

/* I omega' = -mu: 10 rad/s, 2 kg m^2, 4 N m stop after 5 s, 25 rad. */
static void check_axle(void) {
  rotdyn_object *axle = rotdyn_object_new("scene_axle");
  rotdyn_object *dry = rotdyn_object_new("resistance");
  rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const double time_s[] = {0.0, 1.0, 8.0};
  (void)rotdyn_set_number(axle, "body", 2.0);
  (void)rotdyn_set_number(axle, "omega0_rad_per_s", 10.0);
  (void)rotdyn_set_number(dry, "coulomb_n_m", 4.0);
  (void)rotdyn_set_object(axle, "resistance", dry);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(axle, 3, time_s, NULL, 0, &b, NULL), ROTDYN_OK);
  ROT_CHECK_REL(b.change, -100.0, 1e-15);
  ROT_CHECK_REL(b.dissipated, 100.0, 1e-14);
  ROT_CHECK(b.balanced == 1 && b.conserved == 0 && b.explained <= 1e-11);
  ROT_CHECK(!strcmp(b.why, "the resistance dissipates"));
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(axle, 3, time_s, NULL, 1, &b, NULL), ROTDYN_OK);
  ROT_CHECK_REL(b.change, -20.0, 1e-15);
  ROT_CHECK_REL(b.dissipated, 20.0, 1e-14);
  ROT_CHECK(b.balanced == 1 && !strcmp(b.about, "the axle"));
  /* What is so weak that it is left out is no part of the balance. */
  rotdyn_object *spring = rotdyn_object_new("torque_spring");
  (void)rotdyn_set_number(spring, "stiffness_n_m_per_rad", 8.0);
  (void)rotdyn_set_object(axle, "torque", spring);
  (void)rotdyn_set_number(dry, "coulomb_n_m", 0.0);
  (void)rotdyn_set_number(dry, "quadratic_n_m_s2", 1e-15);
  (void)rotdyn_set_object(axle, "resistance", dry);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(axle, 3, time_s, NULL, 0, &b, &report), ROTDYN_OK);
  ROT_CHECK(strstr(report.reason, "quadratic drag ignored") != NULL);
  rotdyn_object_free(spring);
  ROT_CHECK(b.conserved == 1 && b.balanced == 1 && b.dissipated == 0.0);
  rotdyn_object_free(dry);
  rotdyn_object_free(axle);
}

static void check_refusals(void) {
  rotdyn_object *scene = clutch();
  const double time_s[] = {0.0, 1.0}, falls[] = {1.0, 0.0};
  rotdyn_balance b = ROTDYN_INIT(rotdyn_balance), none = {0};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 0, NULL, NULL, 0, &b, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, falls, NULL, 0, &b, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, NULL, 0, NULL, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, NULL, 0, &none, NULL), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(NULL, 2, time_s, NULL, 0, &b, NULL), ROTDYN_EARGUMENT);
  options.model = "clutch_none";
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, &options, 0, &b, NULL), ROTDYN_EMODEL);
  (void)rotdyn_set_number(scene, "capacity_n_m", -1.0);
  ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, NULL, 0, &b, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(report.input && !strcmp(report.input, "capacity_n_m"));
  rotdyn_object_free(scene);
}

int main(void) {
  check_engagement();
  check_axle();
  check_law();
  check_refusals();
  return rot_test_report("api audit");
}
