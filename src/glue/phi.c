/* For R: the phi functions, for tests. */
#include "glue/ffi.h"
#include "maths/phi.h"

/* z => columns phi_0 .. phi_k of -z */
SEXP ffi_phi(SEXP z, SEXP k_max) {
  static const char *const names[] = {"phi0", "phi1", "phi2", "phi3", "phi4", "phi5", "phi6"};
  const int k = (int)ffi_real(k_max, "k");
  if (k < 0 || k > ROT_PHI_MAX) Rf_error("internal: `k` is not in 0..%d", ROT_PHI_MAX);
  const double *zs = ffi_reals(z, "z", -1);
  double *columns[ROT_PHI_MAX + 1], phi[ROT_PHI_MAX + 1];
  SEXP out = ffi_columns(k + 1, names, XLENGTH(z), columns);
  for (R_xlen_t i = 0; i < XLENGTH(z); i++) {
    rot_phi(zs[i], 0.0, k, phi);
    for (int j = 0; j <= k; j++) columns[j][i] = phi[j];
  }
  UNPROTECT(1);
  return out;
}
