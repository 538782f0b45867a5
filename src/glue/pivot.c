/* For R: bodies with a fixed point. */
#include "glue/scenes.h"
#include "scene/pivot/pivot.h"
#include "scene/pivot/approx.h"

SEXP ffi_pivot_top(SEXP list, SEXP time_s, SEXP progress) {
  return ffi_free_rows(list, time_s, progress, rot_pivot_top);
}

SEXP ffi_pivot_precession(SEXP list, SEXP time_s, SEXP progress) {
  return ffi_free_rows(list, time_s, progress, rot_pivot_precession);
}

SEXP ffi_pivot_small_nutation(SEXP list, SEXP time_s, SEXP progress) {
  return ffi_free_rows(list, time_s, progress, rot_pivot_small_nutation);
}

/* c(period s, lowest and highest cosine, precession in a period); NULL: no symmetric top. */
SEXP ffi_pivot_nutation(SEXP list) {
  const rot_free_params p = ffi_free_scene(list);
  double out[4];
  return rot_pivot_nutation(&p, out) == ROT_OK ? ffi_numbers(4, out) : R_NilValue;
}
