/* For R: critical angle of an incline. */
#include "glue/ffi.h"
#include "scene/incline/incline.h"

/* two columns => max angles, deg, for rolling from rest */
SEXP ffi_incline_critical(SEXP beta, SEXP mu) {
  R_xlen_t n = 1;
  const rot_column b = ffi_column(beta, "beta", &n), m = ffi_column(mu, "mu", &n);
  SEXP out = PROTECT(ffi_new_column(n));
  for (size_t i = 0; i < (size_t)n; i++) {
    const double x = rot_at(b, i), y = rot_at(m, i);
    REAL(out)[i] = ISNAN(x) || ISNAN(y) ? NA_REAL : rot_incline_critical_deg(x, y);
  }
  UNPROTECT(1);
  return out;
}
