/* For R: many inclines, one per row. */
#include "scene/incline/table.h"

#include "glue/run.h"

/* columns `rows_in`, each of one value or one per row => list(columns, bad, info); `bad`: indices
 * of rows that were not computed */
SEXP ffi_incline_table(SEXP rows_in, SEXP threads, SEXP progress) {
  static const char *const names[] = {ROT_INCLINE_TABLE_COLUMNS(FFI_COLUMN_NAME) ""};
  static const char *const parts[] = {"columns", "bad", "info", ""};
  const double max = ffi_real(threads, "threads");
  if (!(max >= 0.0 && max <= 4096.0)) Rf_error("internal: `threads`");
  R_xlen_t rows = 1, at = 0;
#define IN(name) ffi_column(ffi_element(rows_in, #name), #name, &rows)
  rot_incline_rows in = {0,
                         IN(beta),
                         IN(radius_m),
                         IN(mass_kg),
                         IN(incline_angle_deg),
                         IN(gravity_m_per_s2),
                         IN(static_friction),
                         IN(kinetic_friction),
                         IN(rolling_arm_m),
                         IN(v0_m_per_s),
                         IN(omega0_rad_per_s),
                         IN(time_s)};
#undef IN
  in.n = (size_t)rows;
  SEXP result = PROTECT(Rf_mkNamed(VECSXP, (const char **)parts)), columns, bad;
  SET_VECTOR_ELT(result, 0, columns = Rf_mkNamed(VECSXP, (const char **)names));
  rot_incline_table_columns out;
  ROT_INCLINE_TABLE_COLUMNS(FFI_COLUMN_NEW)
  out.status = LOGICAL(PROTECT(ffi_new_flags(rows)));
  out.none = NA_REAL;
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_incline_table(&in, (int)max, &out, &guard.hooks, &info));
  R_xlen_t n_bad = 0;
  for (R_xlen_t i = 0; i < rows; i++) n_bad += out.status[i] != ROT_OK;
  SET_VECTOR_ELT(result, 1, bad = Rf_allocVector(INTSXP, n_bad));
  for (R_xlen_t i = 0, k = 0; k < n_bad; i++) {
    if (out.status[i] == ROT_OK) continue;
    out.rolling[i] = NA_LOGICAL;
    INTEGER(bad)[k++] = (int)i + 1;
  }
  SET_VECTOR_ELT(result, 2, ffi_info(&info));
  UNPROTECT(2);
  return result;
}
