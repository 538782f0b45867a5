/* For R: engagements of clutches. */
#include <math.h>

#include "glue/ffi.h"
#include "scene/clutch/clutch.h"

/* seven columns => columns of the engagement; NA for a row with NA */
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
