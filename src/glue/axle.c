/* For R: torques, stop, period and disturbance of a scene on an axle. */
#include <math.h>
#include <string.h>

#include "glue/run.h"
#include "glue/scene.h"
#include "scene/axle/drag.h"
#include "scene/axle/drop.h"
#include "scene/axle/inputs.h"
#include "scene/axle/models.h"
#include "scene/axle/period.h"

/* scene of any constructor on an axle => its struct */
static const rot_axle_scene *axle_scene(SEXP list) {
  const rot_axle_built *built = ffi_scene_build(&rot_axle_constraint, list);
  return &built->scene;
}

/* ---- single questions ------------------------------------------------------------------------ */

/* rows of states => list(applied_torque_n_m, damping_torque_n_m, net_torque_n_m) */
SEXP ffi_axle_torques(SEXP list, SEXP time_s, SEXP theta_rad, SEXP omega_rad_per_s) {
  static const char *const names[] = {"applied_torque_n_m", "damping_torque_n_m", "net_torque_n_m",
                                      ""};
  const rot_axle_scene *scene = axle_scene(list);
  const R_xlen_t n = XLENGTH(time_s);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const double *theta = ffi_reals(theta_rad, "theta_rad", n);
  const double *omega = ffi_reals(omega_rad_per_s, "omega_rad_per_s", n);
  double *column[3];
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  for (R_xlen_t i = 0; i < 3; i++) column[i] = ffi_new_double(out, i, n);
  rot_axle_scene_torques(scene, (size_t)n, t, theta, omega, column[0], column[1], column[2]);
  UNPROTECT(1);
  return out;
}

/* => c(time of the last stop, angle there, terminal omega) */
SEXP ffi_axle_stopping(SEXP list) {
  const rot_axle_scene *scene = axle_scene(list);
  double x[] = {NA_REAL, NA_REAL, rot_axle_drag_terminal(scene)};
  if (rot_axle_drag_stop(scene, &x[0], &x[1]) != ROT_OK) x[0] = x[1] = NA_REAL;
  return ffi_numbers(3, x);
}

/* => list(kind, period_s, amplitude_rad, ratio) */
SEXP ffi_axle_period(SEXP list) {
  static const char *const kinds[] = {
#define X(code, name) name,
      ROT_PERIOD_LIST(X)
#undef X
  };
  static const char *const names[] = {"kind", "period_s", "amplitude_rad", "ratio", ""};
  const rot_axle_scene *scene = axle_scene(list);
  const rot_period period = rot_axle_period(scene);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, Rf_mkString(kinds[period.kind]));
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal(period.period_s));
  SET_VECTOR_ELT(out, 2, Rf_ScalarReal(period.amplitude_rad));
  SET_VECTOR_ELT(out, 3, Rf_ScalarReal(period.ratio));
  UNPROTECT(1);
  return out;
}

/* numbers = c(size, impulse, growth) of a torque => c(theta, omega), the changes due to it: see
 * scene/axle/drop.h */
SEXP ffi_axle_disturbance(SEXP scene, SEXP time_s, SEXP numbers) {
  static const char *const names[] = {"theta", "omega"};
  const rot_axle_scene *axle = axle_scene(scene);
  const rot_query query = {(size_t)XLENGTH(time_s), ffi_reals(time_s, "time_s", -1), 1.0, 0.0};
  const double *x = ffi_reals(numbers, "numbers", 3);
  double by[2];
  rot_axle_disturbance(axle, &query, x[0], x[1], x[2], &by[0], &by[1]);
  return ffi_named(2, names, by);
}
