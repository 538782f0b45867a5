#include "ffi_run.h"
#include "ffi_scenes.h"

#include "rot_shaft_modal.h"
#include "rot_shaft_ledger.h"
#include "rot_shaft_rigid.h"

/* list(inertia, stiffness, damping, viscous, torque, theta0, omega0, start), as R/model-rotors.R
 * packs it. */
rot_shaft_params ffi_rotors_scene(SEXP pack) {
  if (TYPEOF(pack) != VECSXP || XLENGTH(pack) != 8) Rf_error("internal: `scene`");
  const R_xlen_t n = XLENGTH(VECTOR_ELT(pack, 0));
  if (n < 1) Rf_error("internal: no rotor");
  const double *x[7];
  for (int i = 0; i < 7; i++) {
    x[i] = ffi_reals(VECTOR_ELT(pack, i), "scene", i == 1 || i == 2 ? n - 1 : n);
  }
  return (rot_shaft_params){
      (size_t)n, x[0], x[1], x[2], x[3], x[4], x[5], x[6], ffi_real(VECTOR_ELT(pack, 7), "start")};
}

/* The columns are as long as rows times rotors. `how`: 0 rigid, 1 modal, 2 modal, fast. */
SEXP ffi_rotors_run(SEXP pack, SEXP time_s, SEXP how, SEXP progress) {
  static const char *const names[] = {ROT_SHAFT_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_shaft_params p = ffi_rotors_scene(pack);
  const double *t = ffi_reals(time_s, "time_s", -1), kind = ffi_real(how, "how");
  const size_t n = (size_t)XLENGTH(time_s);
  const R_xlen_t rows = XLENGTH(time_s) * (R_xlen_t)p.n;
  rot_shaft_columns out;
  R_xlen_t at = 0;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP list = Rf_mkNamed(VECSXP, (const char **)names);
  SET_VECTOR_ELT(run.out, FFI_COLUMNS, list);
  ROT_SHAFT_COLUMNS(FFI_COLUMN_NEW)
  const rot_status status =
      kind == 0.0 ? rot_shaft_rigid(&p, n, t, &out, &run.guard.hooks, &run.info)
                  : rot_shaft_modal(&p, kind == 2.0, n, t, &out, &run.guard.hooks, &run.info);
  for (size_t i = 1; i <= n; i++) out.shaft_torque_n_m[i * p.n - 1] = NA_REAL;
  return ffi_run_end(&run, status, 0);
}

/* From span[0] to span[1]; NA where it failed. */
SEXP ffi_rotors_ledger(SEXP pack, SEXP rigid, SEXP span) {
  static const char *const names[] = {ROT_SHAFT_LEDGER(FFI_NAME)};
  const rot_shaft_params p = ffi_rotors_scene(pack);
  const double *x = ffi_reals(span, "span", 2);
  rot_shaft_ledger ledger = {0.0, 0.0, 0.0, 0.0};
  const rot_status status =
      rot_shaft_balance(&p, ffi_real(rigid, "rigid") != 0.0, x[0], x[1], &ledger);
  const double values[] = {ROT_SHAFT_LEDGER(FFI_VALUE)};
  return ffi_named(FFI_LENGTH(values), names, status == ROT_OK ? values : NULL);
}

/* The angular frequencies of the undamped shaft; NA where they are out of range. */
SEXP ffi_rotors_frequencies(SEXP pack) {
  const rot_shaft_params p = ffi_rotors_scene(pack);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t)p.n));
  if (rot_shaft_frequencies(&p, REAL(out)) != ROT_OK) {
    for (size_t i = 0; i < p.n; i++) REAL(out)[i] = NA_REAL;
  }
  UNPROTECT(1);
  return out;
}
