/* For R: precession of tops. */
#include "scene/pivot/precession.h"

#include "glue/run.h"

enum { INPUTS = 7, OUTPUTS = 10 };

/* columns: mass, lever arm, axial moment, spin, transverse moment, angle, gravity => 10 columns.
 * Without a transverse moment those that depend on it are missing. */
SEXP ffi_precession(SEXP list) {
  static const char *const names[] = {"gravity_torque_n_m",
                                      "spin_angular_momentum_kg_m2_per_s",
                                      "precession_rad_per_s",
                                      "precession_period_s",
                                      "slow_precession_rad_per_s",
                                      "fast_precession_rad_per_s",
                                      "formula_error",
                                      "nutation_period_s",
                                      "lowest_angle_deg",
                                      "mean_precession_rad_per_s"};
  rot_column in[INPUTS];
  double *column[OUTPUTS];
  const R_xlen_t n = ffi_columns_of(list, INPUTS, in);
  SEXP out = ffi_columns(OUTPUTS, names, n, column);
  for (size_t i = 0; i < (size_t)n; i++) {
    double x[INPUTS];
    int known = 1;
    for (int j = 0; j < INPUTS; j++) {
      x[j] = rot_at(in[j], i);
      known &= j == 4 || !ISNAN(x[j]);
    }
    const rot_precession_input input = {x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
    const rot_precession row = rot_precession_of(&input);
    const double value[OUTPUTS] = {row.torque_n_m,    row.momentum_kg_m2_per_s, row.rate_rad_per_s,
                                   row.period_s,      row.slow_rad_per_s,       row.fast_rad_per_s,
                                   row.error,         row.nutation_s,           row.lowest_deg,
                                   row.mean_rad_per_s};
    for (int k = 0; k < OUTPUTS; k++) column[k][i] = known ? value[k] : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* columns: axial moment, transverse moment, mass, lever arm, gravity => min spins of stable upright
 * (sleeping) tops */
SEXP ffi_precession_sleeps(SEXP list) {
  rot_column in[5];
  const R_xlen_t n = ffi_columns_of(list, 5, in);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    double x[5];
    (void)ffi_row_of(in, 5, i, x);
    REAL(out)[i] = rot_precession_sleeps(x[0], x[1], x[2], x[3], x[4]);
  }
  UNPROTECT(1);
  return out;
}
