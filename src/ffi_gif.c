#include <string.h>

#include "ffi.h"
#include "rot_gif.h"

/* Pixels as raw bytes below 2^bits. */
SEXP ffi_gif_pack(SEXP pixels, SEXP bits) {
  const R_xlen_t n = XLENGTH(pixels);
  const double wide = ffi_real(bits, "bits");
  if (TYPEOF(pixels) != RAWSXP || !(wide >= 2.0 && wide <= 8.0)) Rf_error("internal: `pixels`");
  SEXP room = PROTECT(Rf_allocVector(RAWSXP, (R_xlen_t)rot_gif_most((size_t)n)));
  const size_t size = rot_gif_pack(RAW(pixels), (size_t)n, (int)wide, RAW(room));
  SEXP out = PROTECT(Rf_allocVector(RAWSXP, (R_xlen_t)size));
  memcpy(RAW(out), RAW(room), size);
  UNPROTECT(2);
  return out;
}
