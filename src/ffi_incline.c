#include "ffi_run.h"
#include "ffi_scenes.h"

rot_incline_params ffi_incline_scene(SEXP list) {
  return (rot_incline_params){
      .mass_kg = ffi_number_of(list, "mass_kg"),
      .radius_m = ffi_number_of(list, "radius_m"),
      .inertia_kg_m2 = ffi_number_of(list, "moment_of_inertia_kg_m2"),
      .angle_deg = ffi_number_of(list, "incline_angle_deg"),
      .gravity_m_per_s2 = ffi_number_of(list, "gravity_m_per_s2"),
      .mu_kinetic = ffi_number_of(list, "kinetic_friction"),
      .mu_static = ffi_number_of(list, "static_friction"),
      .arm_m = ffi_number_of(list, "rolling_arm_m"),
      .x0_m = ffi_number_of(list, "x0_m"),
      .v0_m_per_s = ffi_number_of(list, "v0_m_per_s"),
      .theta0_rad = ffi_number_of(list, "theta0_rad"),
      .omega0_rad_per_s = ffi_number_of(list, "omega0_rad_per_s"),
      .start_s = ffi_number_of(list, "start_s"),
  };
}

SEXP ffi_incline_run(SEXP list, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"time_s", ROT_INCLINE_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_incline_params p = ffi_incline_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_incline_columns out;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_INCLINE_COLUMNS(FFI_COLUMN_NEW)
  const rot_status status =
      rot_incline_run(&p, (size_t)rows, t, &out, &run.events, &run.guard.hooks, &run.info);
  return ffi_run_end(&run, status);
}

/* From span[0] to span[1]; NA where it failed. */
SEXP ffi_incline_ledger(SEXP list, SEXP span) {
  static const char *const names[] = {ROT_INCLINE_LEDGER(FFI_NAME)};
  const rot_incline_params p = ffi_incline_scene(list);
  const double *x = ffi_reals(span, "span", 2);
  rot_incline_ledger ledger;
  const rot_status status = rot_incline_flows(&p, x[0], x[1], &ledger);
  const double values[] = {ROT_INCLINE_LEDGER(FFI_VALUE)};
  return ffi_named(FFI_LENGTH(values), names, status == ROT_OK ? values : NULL);
}

SEXP ffi_incline_critical(SEXP beta, SEXP mu) {
  R_xlen_t n = 1;
  const rot_column b = ffi_column(beta, "beta", &n), m = ffi_column(mu, "mu", &n);
  SEXP out = PROTECT(ffi_new_column(n));
  for (size_t i = 0; i < (size_t)n; i++) {
    const double x = rot_at(b, i), y = rot_at(m, i);
    REAL(out)[i] = ISNAN(x) || ISNAN(y) ? NA_REAL : rot_incline_critical_deg(x, y);
  }
  UNPROTECT(1);
  return out;
}
