#include "ffi.h"
#include "rot_text.h"

/* Each number as text. */
SEXP ffi_text_numbers(SEXP x) {
  const R_xlen_t n = XLENGTH(x);
  const double *values = ffi_reals(x, "x", n);
  SEXP out = PROTECT(Rf_allocVector(STRSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    char text[ROT_TEXT_SIZE];
    rot_text_number(values[i], text);
    SET_STRING_ELT(out, i, Rf_mkChar(text));
  }
  UNPROTECT(1);
  return out;
}
