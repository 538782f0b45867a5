/* For R: rolling disks. */
#include "glue/run.h"
#include "tables/rolling_disk.h"

#include <math.h>

/* numbers: mass, radius, moments over m r^2 (axial, transverse), gravity, lean, spin, yaw, lean
 * rate, accuracy => run. Its ledger: errors of attitude, omega and position; time at which the disk
 * is flat. */
SEXP ffi_rolling_disk(SEXP numbers, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"time_s", ROT_ROLLING_DISK_COLUMNS(FFI_COLUMN_NAME) ""};
  const double *x = ffi_reals(numbers, "numbers", 10), *t = ffi_reals(time_s, "time_s", -1);
  const rot_rolling_disk p = {x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8]};
  const R_xlen_t rows = XLENGTH(time_s);
  rot_rolling_disk_columns out;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_ROLLING_DISK_COLUMNS(FFI_COLUMN_NEW)
  SEXP more = Rf_allocVector(REALSXP, 4);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, more);
  const rot_status status = rot_rolling_disk_run(&p, x[9], (size_t)rows, t, &out, REAL(more),
                                                 REAL(more) + 3, &run.guard.hooks, &run.info);
  return ffi_run_end(&run, status);
}

/* columns: radius, moments, gravity => min stable angular velocities */
SEXP ffi_rolling_disk_min(SEXP radius, SEXP axial, SEXP transverse, SEXP gravity) {
  R_xlen_t n = 1;
  const rot_column r = ffi_column(radius, "radius_m", &n), a = ffi_column(axial, "axial", &n);
  const rot_column b = ffi_column(transverse, "transverse", &n);
  const rot_column g = ffi_column(gravity, "gravity_m_per_s2", &n);
  SEXP out = PROTECT(ffi_new_column(n));
  for (size_t i = 0; i < (size_t)n; i++) {
    const rot_rolling_disk p = {.radius_m = rot_at(r, i),
                                .axial = rot_at(a, i),
                                .transverse = rot_at(b, i),
                                .gravity_m_per_s2 = rot_at(g, i)};
    REAL(out)[i] = rot_rolling_disk_min(&p);
  }
  UNPROTECT(1);
  return out;
}
