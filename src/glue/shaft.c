/* For R: rotors on one shaft. */
#include "glue/run.h"
#include "glue/scenes.h"

#include "scene/shaft/modal.h"
#include "scene/shaft/ledger.h"
#include "scene/shaft/rigid.h"

rot_shaft_params ffi_shaft_scene(SEXP list) {
  SEXP inertia = ffi_element(list, "moment_of_inertia_kg_m2");
  rot_shaft_params p = {.inertia_kg_m2 = ffi_reals(inertia, "moment_of_inertia_kg_m2", -1)};
  const R_xlen_t n = XLENGTH(inertia);
  if (n < 1) Rf_error("internal: no rotor");
  p.n = (size_t)n;
  p.stiffness_n_m_per_rad = ffi_numbers_of(list, "stiffness_n_m_per_rad", n - 1);
  p.damping_n_m_s = ffi_numbers_of(list, "damping_n_m_s", n - 1);
  p.viscous_n_m_s = ffi_numbers_of(list, "viscous_n_m_s", n);
  p.torque_n_m = ffi_numbers_of(list, "torque_n_m", n);
  p.theta0_rad = ffi_numbers_of(list, "theta0_rad", n);
  p.omega0_rad_per_s = ffi_numbers_of(list, "omega0_rad_per_s", n);
  p.start_s = ffi_number_of(list, "start_s");
  return p;
}

/* The columns are as long as rows times rotors. `how`: 0 rigid, 1 modal, 2 modal, fast. */
SEXP ffi_rotors_run(SEXP list, SEXP time_s, SEXP how, SEXP progress) {
  static const char *const names[] = {ROT_SHAFT_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_shaft_params p = ffi_shaft_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1), kind = ffi_real(how, "how");
  const size_t n = (size_t)XLENGTH(time_s);
  const R_xlen_t rows = XLENGTH(time_s) * (R_xlen_t)p.n;
  rot_shaft_columns out;
  R_xlen_t at = 0;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  ROT_SHAFT_COLUMNS(FFI_COLUMN_NEW)
  const rot_status status =
      kind == 0.0 ? rot_shaft_rigid(&p, n, t, &out, &run.guard.hooks, &run.info)
                  : rot_shaft_modal(&p, kind == 2.0, n, t, &out, &run.guard.hooks, &run.info);
  for (size_t i = 1; i <= n; i++) out.shaft_torque_n_m[i * p.n - 1] = NA_REAL;
  return ffi_run_end(&run, status);
}

/* From span[0] to span[1]; NA where it failed. */
SEXP ffi_rotors_ledger(SEXP list, SEXP rigid, SEXP span, SEXP progress) {
  static const char *const names[] = {ROT_SHAFT_LEDGER(FFI_NAME)};
  const rot_shaft_params p = ffi_shaft_scene(list);
  const double *x = ffi_reals(span, "span", 2);
  rot_shaft_ledger ledger = {0.0, 0.0, 0.0, 0.0};
  const int as_rigid = ffi_real(rigid, "rigid") != 0.0;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  const rot_status status = rot_shaft_balance(&p, as_rigid, x[0], x[1], &guard.hooks, &ledger);
  ffi_guard_end(&guard, status);
  const double values[] = {ROT_SHAFT_LEDGER(FFI_VALUE)};
  return ffi_named(FFI_LENGTH(values), names, status == ROT_OK ? values : NULL);
}

/* list(frequencies, info): the angular frequencies of the undamped shaft, NA where it failed. */
SEXP ffi_rotors_frequencies(SEXP list, SEXP progress) {
  static const char *const names[] = {"frequencies", "info", ""};
  const rot_shaft_params p = ffi_shaft_scene(list);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), frequencies;
  SET_VECTOR_ELT(out, 0, frequencies = Rf_allocVector(REALSXP, (R_xlen_t)p.n));
  rot_info info;
  ffi_guard guard;
  rot_info_clear(&info, NULL);
  ffi_guard_begin(&guard, progress);
  info.status = rot_shaft_frequencies(&p, REAL(frequencies), &guard.hooks);
  ffi_guard_end(&guard, info.status);
  for (size_t i = 0; i < p.n && info.status != ROT_OK; i++) REAL(frequencies)[i] = NA_REAL;
  SET_VECTOR_ELT(out, 1, ffi_info(&info));
  UNPROTECT(1);
  return out;
}
