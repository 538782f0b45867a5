/* For R: the modes of a chain of pendulums. */
#include "glue/ffi.h"
#include "scene/chain/chain.h"

/* n lengths, n masses => list(omega_rad_per_s, shape): increasing angular frequencies; n x n, link
 * by mode, largest element 1. NULL if they exceed double precision. */
SEXP ffi_chain_modes(SEXP length_m, SEXP mass_kg, SEXP rods, SEXP gravity) {
  const double *length = ffi_reals(length_m, "length_m", -1);
  const R_xlen_t n = XLENGTH(length_m);
  const double *mass = ffi_reals(mass_kg, "mass_kg", n);
  SEXP out = PROTECT(Rf_allocVector(VECSXP, 2)), rate, shape;
  SET_VECTOR_ELT(out, 0, rate = Rf_allocVector(REALSXP, n));
  SET_VECTOR_ELT(out, 1, shape = Rf_allocMatrix(REALSXP, (int)n, (int)n));
  /* Matrices are stored by rows in the core, by columns in R. */
  double *by_rows = (double *)R_alloc((size_t)(n * n) + 1, sizeof *by_rows);
  const rot_status status = rot_chain_modes(length, mass, (size_t)n, ffi_real(rods, "rods") != 0.0,
                                            ffi_real(gravity, "gravity"), REAL(rate), by_rows);
  for (R_xlen_t i = 0; i < n; i++) {
    for (R_xlen_t j = 0; j < n; j++) REAL(shape)[i + j * n] = by_rows[i * n + j];
  }
  UNPROTECT(1);
  return status == ROT_OK ? out : R_NilValue;
}
