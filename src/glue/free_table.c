/* For R: many free bodies, one per row. */
#include "glue/run.h"
#include "scene/free/table.h"

/* named columns, each of one value or one per row => columns */
SEXP ffi_free_table(SEXP list, SEXP threads, SEXP progress) {
  static const char *const names[] = {ROT_FREE_TABLE_COLUMNS(FFI_COLUMN_NAME) ""};
  const double max = ffi_real(threads, "threads");
  if (!(max >= 0.0 && max <= 4096.0)) Rf_error("internal: `threads`");
  R_xlen_t rows = 1, at = 0;
#define IN(name) ffi_column(ffi_element(list, #name), #name, &rows)
  rot_free_table_rows in = {0,
                            {IN(ixx_kg_m2), IN(iyy_kg_m2), IN(izz_kg_m2)},
                            {IN(omega_x_rad_per_s), IN(omega_y_rad_per_s), IN(omega_z_rad_per_s)},
                            {IN(qw), IN(qx), IN(qy), IN(qz)},
                            IN(time_s)};
#undef IN
  in.n = (size_t)rows;
  SEXP columns = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  rot_free_table_columns out = {.omega_error = NULL};
  ROT_FREE_TABLE_COLUMNS(FFI_COLUMN_NEW)
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_free_table(&in, (int)max, &out, &guard.hooks, &info));
  UNPROTECT(1);
  return columns;
}
