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

/* list(columns, info); the columns are as long as rows times rotors. `how`: 0 rigid, 1 modal, 2
 * modal, fast. */
SEXP ffi_rotors_run(SEXP pack, SEXP time_s, SEXP how, SEXP progress) {
  static const char *const names[] = {"theta_rad", "omega_rad_per_s", "shaft_torque_n_m"};
  const rot_shaft_params p = ffi_rotors_scene(pack);
  const double *t = ffi_reals(time_s, "time_s", -1), kind = ffi_real(how, "how");
  const R_xlen_t rows = XLENGTH(time_s);
  double *c[3];
  SEXP list = ffi_columns(3, names, rows * (R_xlen_t)p.n, c);
  const rot_shaft_columns out = {c[0], c[1], c[2]};
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard,
                kind == 0.0
                    ? rot_shaft_rigid(&p, (size_t)rows, t, &out, &guard.hooks, &info)
                    : rot_shaft_modal(&p, kind == 2.0, (size_t)rows, t, &out, &guard.hooks, &info));
  for (R_xlen_t i = 0; i < rows; i++) c[2][i * (R_xlen_t)p.n + (R_xlen_t)p.n - 1] = NA_REAL;
  SEXP result = PROTECT(Rf_allocVector(VECSXP, 2));
  SET_VECTOR_ELT(result, 0, list);
  SET_VECTOR_ELT(result, 1, ffi_info(&info));
  UNPROTECT(2);
  return result;
}

/* c(work, dissipated, and the rounding of both) from span[0] to span[1]; NA where it failed. */
SEXP ffi_rotors_balance(SEXP pack, SEXP rigid, SEXP span) {
  const rot_shaft_params p = ffi_rotors_scene(pack);
  const double *x = ffi_reals(span, "span", 2);
  rot_shaft_ledger ledger;
  if (rot_shaft_balance(&p, ffi_real(rigid, "rigid") != 0.0, x[0], x[1], &ledger) != ROT_OK) {
    ledger = (rot_shaft_ledger){NA_REAL, NA_REAL, NA_REAL, NA_REAL};
  }
  const double numbers[] = {ledger.work_j, ledger.dissipated_j, ledger.work_rounding_j,
                            ledger.dissipated_rounding_j};
  SEXP out = Rf_allocVector(REALSXP, 4);
  for (int i = 0; i < 4; i++) REAL(out)[i] = numbers[i];
  return out;
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
