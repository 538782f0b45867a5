/* For R: scenes on an axle, their runs, ledger and stop. */
#include <math.h>
#include <string.h>

#include "glue/law.h"
#include "glue/run.h"
#include "glue/scenes.h"
#include "glue/torque.h"
#include "scene/choice.h"
#include "scene/axle/drag.h"
#include "scene/axle/ledger.h"
#include "scene/axle/models.h"
#include "scene/axle/motor.h"
#include "scene/axle/ode.h"
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

/* ---- closed forms ---------------------------------------------------------------------------- */

static rot_axle_columns new_columns(const ffi_run *run, SEXP time_s) {
  static const char *const names[] = {"time_s", ROT_AXLE_COLUMNS(FFI_COLUMN_NAME) ""};
  const R_xlen_t rows = XLENGTH(time_s);
  rot_axle_columns out;
  R_xlen_t at = 1;
  SEXP columns = ffi_run_columns(run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_AXLE_COLUMNS(FFI_COLUMN_NEW)
  return out;
}

/* A run with a column beyond double precision has no error figure, though its state may have. */
static void check_columns(const rot_axle_scene *scene, const rot_axle_columns *out, ffi_run *run) {
  if (rot_axle_scene_plain(scene, &run->info)) return;
#define X(type, name)                                                                              \
  for (size_t i = 0; i < run->info.rows_done; i++) run->beyond |= !isfinite(out->name[i]);
  ROT_AXLE_COLUMNS(X)
#undef X
}

/* A closed form by its id in models(). */
SEXP ffi_axle_run(SEXP id, SEXP list, SEXP time_s, SEXP progress) {
  const rot_axle_scene scene = ffi_axle_scene(list, R_NilValue);
  const rot_model *known = rot_choice_model(&rot_axle_constraint, ffi_text(id, "model"));
  const rot_axle_model model = known ? rot_axle_form(known) : NULL;
  const double *t = ffi_reals(time_s, "time_s", -1);
  const size_t n = (size_t)XLENGTH(time_s);
  if (!model) Rf_error("internal: no such model");
  ffi_run run;
  ffi_run_begin(&run, progress);
  const rot_axle_columns out = new_columns(&run, time_s);
  const rot_status status = model(&scene, n, t, &out, &run.events, &run.guard.hooks, &run.info);
  check_columns(&scene, &out, &run);
  return ffi_run_end(&run, status);
}

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

static const char *const ledger_names[] = {ROT_AXLE_LEDGER(FFI_NAME)};

/* Of "axle_free" and "axle_linear". */
SEXP ffi_axle_ledger(SEXP list, SEXP from_s, SEXP to_s, SEXP progress) {
  const rot_axle_scene scene = ffi_axle_scene(list, R_NilValue);
  const double from = ffi_real(from_s, "from_s"), to = ffi_real(to_s, "to_s");
  rot_axle_ledger ledger;
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard,
                rot_axle_linear_ledger(&scene.linear, from, to, &guard.hooks, &ledger, &info));
  rot_axle_motor_ledger(&scene, &ledger);
  const double values[] = {ROT_AXLE_LEDGER(FFI_VALUE)};
  /* A sum over a part of the span is no ledger. */
  return ffi_named(FFI_LENGTH(values), ledger_names, info.status == ROT_OK ? values : NULL);
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

/* ---- integrated ------------------------------------------------------------------------------ */

/* `law` is NULL, or that of an ffi_torque to be added to the scene's torque; `breaks_s` its breaks,
 * or NULL. `control` is c(accuracy, max_steps, method, noise_n_m, resolution), method as in
 * ROT_METHOD_LIST. */
SEXP ffi_axle_integrate(SEXP list, SEXP law, SEXP breaks_s, SEXP time_s, SEXP control,
                        SEXP progress) {
  rot_axle_scene scene = ffi_axle_scene(list, breaks_s);
  const double *t = ffi_reals(time_s, "time_s", -1), *c = ffi_reals(control, "control", 5);
  if (!(c[2] >= 0.0 && c[2] <= ROT_METHOD_RADAU)) Rf_error("internal: `method`");
  /* 1e15 steps are more than any run makes; the conversion of 1e20 is undefined. */
  const double steps = c[1] < 1e15 ? c[1] : 1e15;
  const rot_axle_ode_options options = {c[0], (size_t)steps, (rot_method)(int)c[2], c[4]};
  scene.noise_n_m = c[3];
  rot_axle_ledger ledger;
#define X(name) ledger.name = NA_REAL;
  ROT_AXLE_LEDGER(X)
#undef X
  ffi_run run;
  ffi_torque called;
  if (!Rf_isNull(law)) {
    called = ffi_torque_new(law, NULL, &run.guard);
    scene.linear.torque.call = ffi_torque_call;
    scene.linear.torque.ctx = &called;
  }
  ffi_run_begin(&run, progress);
  const rot_axle_columns out = new_columns(&run, time_s);
  SEXP sums = ffi_named(FFI_LENGTH(ledger_names), ledger_names, NULL);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, sums);
  const rot_status status = rot_axle_integrate(&scene, &options, (size_t)XLENGTH(time_s), t, &out,
                                               &run.events, &ledger, &run.guard.hooks, &run.info);
  const double values[] = {ROT_AXLE_LEDGER(FFI_VALUE)};
  memcpy(REAL(sums), values, sizeof values);
  check_columns(&scene, &out, &run);
  SEXP result = ffi_run_end(&run, status);
  if (!Rf_isNull(law)) UNPROTECT(1);
  return result;
}
