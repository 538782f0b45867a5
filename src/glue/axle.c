/* For R: scenes on an axle, their torques, stop and period. */
#include <math.h>
#include <string.h>

#include "glue/law.h"
#include "glue/run.h"
#include "glue/scenes.h"
#include "scene/axle/drag.h"
#include "scene/axle/period.h"

/* ---- scenes ---------------------------------------------------------------------------------- */

rot_axle_scene ffi_axle_scene(SEXP list, SEXP breaks_s) {
  SEXP loads = ffi_element(list, "loads"), resistance = ffi_element(list, "resistance");
  SEXP terms = ffi_element(loads, "terms"), inertia = ffi_element(list, "inertia");
  rot_axle_scene scene;
  memset(&scene, 0, sizeof scene);
  scene.viscous_n_m_s = ffi_number_of(resistance, "viscous_n_m_s");
  scene.quadratic_n_m_s2 = ffi_number_of(resistance, "quadratic_n_m_s2");
  scene.coulomb_n_m = ffi_number_of(resistance, "coulomb_n_m");
  scene.static_n_m = ffi_number_of(resistance, "static_n_m");
  scene.motor_n_m_s = ffi_number_of(loads, "motor_n_m_s");
  scene.linear.inertia_kg_m2 = ffi_number_of(list, "moment_of_inertia_kg_m2");
  if (!Rf_isNull(ffi_element(list, "inertia_lo"))) {
    scene.inertia_lo = ffi_number_of(list, "inertia_lo");
  }
  scene.linear.viscous_n_m_s = scene.viscous_n_m_s + scene.motor_n_m_s;
  scene.linear.start_s = ffi_number_of(list, "start_s");
  scene.linear.theta0_rad = ffi_number_of(list, "theta0_rad");
  scene.linear.omega0_rad_per_s = ffi_number_of(list, "omega0_rad_per_s");
  scene.linear.torque = ffi_law_knots(ffi_element(loads, "knots"));
  if (TYPEOF(terms) != VECSXP) Rf_error("internal: `terms` is not a list");
  scene.n_terms = (size_t)XLENGTH(terms);
  if (scene.n_terms) {
    rot_term *all = (rot_term *)R_alloc(scene.n_terms, sizeof *all);
    for (size_t i = 0; i < scene.n_terms; i++)
      all[i] = ffi_law_term(VECTOR_ELT(terms, (R_xlen_t)i));
    scene.terms = all;
  }
  if (!Rf_isNull(inertia)) {
    SEXP time_s = ffi_element(inertia, "time_s");
    scene.inertia_time_s = ffi_reals(time_s, "time_s", -1);
    scene.n_inertia = (size_t)XLENGTH(time_s);
    scene.inertia_kg_m2 = ffi_numbers_of(inertia, "moment_of_inertia_kg_m2", XLENGTH(time_s));
  }
  if (!Rf_isNull(breaks_s)) {
    scene.breaks_s = ffi_reals(breaks_s, "breaks_s", -1);
    scene.n_breaks = (size_t)XLENGTH(breaks_s);
  }
  double *all = (double *)R_alloc(rot_axle_scene_room(&scene), sizeof *all);
  scene.n_breaks = rot_axle_scene_breaks(&scene, all);
  scene.breaks_s = all;
  return scene;
}

/* ---- single questions ------------------------------------------------------------------------ */

/* list(applied_torque_n_m, damping_torque_n_m, net_torque_n_m) in the states of these rows. */
SEXP ffi_axle_torques(SEXP list, SEXP time_s, SEXP theta_rad, SEXP omega_rad_per_s) {
  static const char *const names[] = {"applied_torque_n_m", "damping_torque_n_m", "net_torque_n_m",
                                      ""};
  const rot_axle_scene scene = ffi_axle_scene(list, R_NilValue);
  const R_xlen_t n = XLENGTH(time_s);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const double *theta = ffi_reals(theta_rad, "theta_rad", n);
  const double *omega = ffi_reals(omega_rad_per_s, "omega_rad_per_s", n);
  double *column[3];
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  for (R_xlen_t i = 0; i < 3; i++) column[i] = ffi_new_double(out, i, n);
  rot_axle_scene_torques(&scene, (size_t)n, t, theta, omega, column[0], column[1], column[2]);
  UNPROTECT(1);
  return out;
}

/* c(time of the last stop, angle there, terminal omega) */
SEXP ffi_axle_stopping(SEXP list) {
  const rot_axle_scene scene = ffi_axle_scene(list, R_NilValue);
  double x[] = {NA_REAL, NA_REAL, rot_axle_drag_terminal(&scene)};
  if (rot_axle_drag_stop(&scene, &x[0], &x[1]) != ROT_OK) x[0] = x[1] = NA_REAL;
  return ffi_numbers(3, x);
}

/* list(kind, period_s, amplitude_rad, ratio) */
SEXP ffi_axle_period(SEXP list) {
  static const char *const kinds[] = {
#define X(code, name) name,
      ROT_PERIOD_LIST(X)
#undef X
  };
  static const char *const names[] = {"kind", "period_s", "amplitude_rad", "ratio", ""};
  const rot_axle_scene scene = ffi_axle_scene(list, R_NilValue);
  const rot_period period = rot_axle_period(&scene);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, Rf_mkString(kinds[period.kind]));
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal(period.period_s));
  SET_VECTOR_ELT(out, 2, Rf_ScalarReal(period.amplitude_rad));
  SET_VECTOR_ELT(out, 3, Rf_ScalarReal(period.ratio));
  UNPROTECT(1);
  return out;
}
