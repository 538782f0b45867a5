#include "ffi_run.h"
#include "ffi_scenes.h"
#include "rot_pivot.h"

SEXP ffi_pivot_top(SEXP list, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"time_s", ROT_FREE_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_free_params p = ffi_free_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_free_columns out;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_FREE_COLUMNS(FFI_COLUMN_NEW)
  const rot_status status =
      rot_pivot_top(&p, (size_t)rows, t, &out, &run.events, &run.guard.hooks, &run.info);
  return ffi_run_end(&run, status);
}

/* c(period s, lowest and highest cosine, precession in a period); NULL: no symmetric top. */
SEXP ffi_pivot_nutation(SEXP list) {
  const rot_free_params p = ffi_free_scene(list);
  double out[4];
  return rot_pivot_nutation(&p, out) == ROT_OK ? ffi_numbers(4, out) : R_NilValue;
}
