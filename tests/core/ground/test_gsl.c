/* GSL's error handler: set once, and left alone by the core. */
#include "ground/gsl.h"

#include <gsl/gsl_errno.h>

#include "scene/axle/ode.h"
#include "body/density.h"
#include "rot_test.h"

static int called = 0;

static void own(const char *reason, const char *file, int line, int code) {
  (void)reason, (void)file, (void)line, (void)code;
  called++;
}

/* An integration that ends, one whose law fails, Gauss nodes, random points. */
static void use_gsl(void) {
  const double time_s[] = {0.0, 1.0};
  double column[7][2], t[5], w[5];
  const rot_axle_columns out = {column[0], column[1], column[2], column[3],
                                column[4], column[5], column[6]};
  const rot_axle_ode_options options = {1e-9, 1000, ROT_METHOD_RK8PD, 0.0, 0.0};
  rot_axle_scene scene;
  rot_events events = {0};
  rot_info info;
  memset(&scene, 0, sizeof scene);
  scene.linear.inertia_kg_m2 = 1.0;
  scene.linear.omega0_rad_per_s = 1.0;
  scene.quadratic_n_m_s2 = 1.0;
  ROT_CHECK_EQ_INT(
      rot_axle_integrate(&scene, &options, 2, time_s, &out, &events, NULL, NULL, &info), ROT_OK);
  ROT_CHECK_REL(column[1][1], 0.5, 1e-9); /* 1/(1 + t) */
  scene.linear.inertia_kg_m2 = 1e-300;
  scene.quadratic_n_m_s2 = 1e300;
  (void)rot_axle_integrate(&scene, &options, 2, time_s, &out, &events, NULL, NULL, &info);
  rot_events_free(&events);
  ROT_CHECK_EQ_INT(rot_rule_gauss(5, t, w), ROT_OK);
}

static void check_left_alone(void) {
  gsl_set_error_handler(own);
  use_gsl();
  ROT_CHECK(gsl_set_error_handler(own) == own);
  ROT_CHECK_EQ_INT(called, 0);
}

static void check_begin(void) {
  gsl_set_error_handler(own);
  rot_gsl_begin();
  gsl_error("tried", __FILE__, __LINE__, GSL_EINVAL); /* neither aborts nor reaches own() */
  ROT_CHECK_EQ_INT(called, 0);
  use_gsl();
}

int main(void) {
  check_left_alone();
  check_begin();
  return rot_test_report("gsl");
}
