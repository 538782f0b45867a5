/* For R: clutches. */
#include "glue/run.h"
#include "glue/scenes.h"

static rot_steps steps_of(SEXP list) {
  SEXP time_s = ffi_element(list, "time_s");
  const double *time = ffi_reals(time_s, "time_s", -1);
  return (rot_steps){(size_t)XLENGTH(time_s), time,
                     ffi_numbers_of(list, "torque_n_m", XLENGTH(time_s) + 1)};
}

rot_clutch_params ffi_clutch_scene(SEXP list) {
  SEXP steps = ffi_element(list, "steps");
  if (TYPEOF(steps) != VECSXP || XLENGTH(steps) != 2) Rf_error("internal: `steps`");
  rot_clutch_params p;
  for (int i = 0; i < 2; i++) {
    p.inertia_kg_m2[i] = ffi_numbers_of(list, "moment_of_inertia_kg_m2", 2)[i];
    p.theta0_rad[i] = ffi_numbers_of(list, "theta0_rad", 2)[i];
    p.omega0_rad_per_s[i] = ffi_numbers_of(list, "omega0_rad_per_s", 2)[i];
    p.torque_n_m[i] = steps_of(VECTOR_ELT(steps, i));
  }
  p.capacity_n_m = ffi_number_of(list, "capacity_n_m");
  p.static_n_m = ffi_number_of(list, "static_capacity_n_m");
  p.start_s = ffi_number_of(list, "start_s");
  /* -Inf in R: engaged from the start. */
  p.engage_s = fmax(ffi_number_of(list, "engage_s"), p.start_s);
  return p;
}

SEXP ffi_clutch_run(SEXP list, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"time_s", ROT_CLUTCH_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_clutch_params p = ffi_clutch_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_clutch_columns out;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_CLUTCH_COLUMNS(FFI_COLUMN_NEW)
  const rot_status status =
      rot_clutch_run(&p, (size_t)rows, t, &out, &run.events, &run.guard.hooks, &run.info);
  return ffi_run_end(&run, status);
}

/* From span[0] to span[1]; NA where it failed. */
SEXP ffi_clutch_ledger(SEXP list, SEXP span) {
  static const char *const names[] = {ROT_CLUTCH_LEDGER(FFI_NAME)};
  const rot_clutch_params p = ffi_clutch_scene(list);
  const double *x = ffi_reals(span, "span", 2);
  rot_clutch_ledger ledger = {0.0, 0.0};
  const rot_status status = rot_clutch_work(&p, x[0], x[1], &ledger);
  const double values[] = {ROT_CLUTCH_LEDGER(FFI_VALUE)};
  return ffi_named(FFI_LENGTH(values), names, status == ROT_OK ? values : NULL);
}

SEXP ffi_clutch_engagement(SEXP inertia_1, SEXP inertia_2, SEXP capacity, SEXP torque_1,
                           SEXP torque_2, SEXP omega_1, SEXP omega_2) {
  static const char *const names[] = {"lock_time_s", "common_omega_rad_per_s", "heat_j",
                                      "locked_torque_n_m"};
  R_xlen_t n = 1;
  const rot_column in[] = {
      ffi_column(inertia_1, "inertia_1", &n), ffi_column(inertia_2, "inertia_2", &n),
      ffi_column(capacity, "capacity", &n),   ffi_column(torque_1, "torque_1", &n),
      ffi_column(torque_2, "torque_2", &n),   ffi_column(omega_1, "omega_1", &n),
      ffi_column(omega_2, "omega_2", &n)};
  double *c[4], x[7];
  SEXP out = ffi_columns(4, names, n, c);
  for (size_t i = 0; i < (size_t)n; i++) {
    int known = 1;
    for (int j = 0; j < 7; j++) {
      x[j] = rot_at(in[j], i);
      known &= !ISNAN(x[j]);
    }
    rot_clutch_engagement row = {NA_REAL, NA_REAL, NA_REAL, NA_REAL};
    if (known) row = rot_clutch_engage(x[0], x[1], x[2], x[3], x[4], x[5], x[6]);
    c[0][i] = row.lock_s;
    c[1][i] = isnan(row.omega_rad_per_s) ? NA_REAL : row.omega_rad_per_s;
    c[2][i] = row.heat_j;
    c[3][i] = row.locked_torque_n_m;
  }
  UNPROTECT(1);
  return out;
}
