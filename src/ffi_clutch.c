#include "ffi_scenes.h"

#include "rot_clutch.h"

/* list(times, values) of a torque that is constant between times. */
static rot_steps unpack_steps(SEXP steps) {
  if (TYPEOF(steps) != VECSXP || XLENGTH(steps) != 2) Rf_error("internal: `steps`");
  const R_xlen_t n = XLENGTH(VECTOR_ELT(steps, 0));
  return (rot_steps){(size_t)n, ffi_reals(VECTOR_ELT(steps, 0), "times", n),
                     ffi_reals(VECTOR_ELT(steps, 1), "torques", n + 1)};
}

/* list(numbers, torque 1, torque 2); numbers = c(I1, I2, capacity, static capacity, engage, start,
 * theta1, theta2, omega1, omega2), as R/model-clutch.R packs it. */
rot_clutch_params ffi_clutch_scene(SEXP pack) {
  if (TYPEOF(pack) != VECSXP || XLENGTH(pack) != 3) Rf_error("internal: `scene`");
  const double *x = ffi_reals(VECTOR_ELT(pack, 0), "numbers", 10);
  return (rot_clutch_params){
      {x[0], x[1]}, x[2],
      x[3],         {unpack_steps(VECTOR_ELT(pack, 1)), unpack_steps(VECTOR_ELT(pack, 2))},
      x[4],         x[5],
      {x[6], x[7]}, {x[8], x[9]}};
}

typedef struct result_parts {
  SEXP columns;
  const rot_info *info;
  const rot_events *events;
} result_parts;

/* list(columns, info, list(time_s, event)) */
static SEXP make_result(void *data) {
  static const char *const names[] = {"time_s", "event", ""};
  const result_parts *parts = data;
  const R_xlen_t n = (R_xlen_t)parts->events->count;
  SEXP out = PROTECT(Rf_allocVector(VECSXP, 3));
  SEXP list = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(list, 0, Rf_allocVector(REALSXP, n));
  SET_VECTOR_ELT(list, 1, Rf_allocVector(STRSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    REAL(VECTOR_ELT(list, 0))[i] = parts->events->time_s[i];
    SET_STRING_ELT(VECTOR_ELT(list, 1), i, Rf_mkChar(rot_event_name(parts->events->event[i])));
  }
  SET_VECTOR_ELT(out, 0, parts->columns);
  SET_VECTOR_ELT(out, 1, ffi_info(parts->info));
  SET_VECTOR_ELT(out, 2, list);
  UNPROTECT(2);
  return out;
}

SEXP ffi_clutch_run(SEXP pack, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"time_s",
                                      "theta_1_rad",
                                      "omega_1_rad_per_s",
                                      "theta_2_rad",
                                      "omega_2_rad_per_s",
                                      "clutch_torque_n_m",
                                      "heat_j",
                                      "locked",
                                      ""};
  const rot_clutch_params p = ffi_clutch_scene(pack);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const R_xlen_t rows = XLENGTH(time_s);
  SEXP list = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  double *c[6];
  SET_VECTOR_ELT(list, 0, time_s);
  for (int i = 0; i < 6; i++) {
    SET_VECTOR_ELT(list, i + 1, ffi_new_column(rows));
    c[i] = REAL(VECTOR_ELT(list, i + 1));
  }
  SET_VECTOR_ELT(list, 7, Rf_allocVector(LGLSXP, rows));
  const rot_clutch_columns out = {
      {c[0], c[2]}, {c[1], c[3]}, c[4], c[5], LOGICAL(VECTOR_ELT(list, 7))};
  rot_events events = {0, 0, NULL, NULL};
  rot_info info;
  ffi_guard guard;
  SEXP result = R_NilValue;
  ffi_guard_begin(&guard, progress);
  rot_status status = rot_clutch_run(&p, (size_t)rows, t, &out, &events, &guard.hooks, &info);
  result_parts parts = {list, &info, &events};
  if (status != ROT_EUNWIND) status = ffi_guarded(&guard, make_result, &parts, &result);
  rot_events_free(&events);
  PROTECT(result);
  if (status == ROT_EUNWIND) R_ContinueUnwind(guard.token);
  UNPROTECT(3);
  return result;
}

/* c(work, rounding) of the torques from span[0] to span[1]; NA where it failed. */
SEXP ffi_clutch_work(SEXP pack, SEXP span) {
  const rot_clutch_params p = ffi_clutch_scene(pack);
  const double *x = ffi_reals(span, "span", 2);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, 2));
  if (rot_clutch_work(&p, x[0], x[1], REAL(out), REAL(out) + 1) != ROT_OK) {
    REAL(out)[0] = REAL(out)[1] = NA_REAL;
  }
  UNPROTECT(1);
  return out;
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
