/* For R: sums of products to twice the precision. */
#include "glue/ffi.h"
#include "ground/real.h"

/* => c(hi, lo) of first + product of the factors, to twice the precision */
SEXP ffi_sum_product(SEXP first, SEXP factors) {
  const double *x = ffi_reals(factors, "factors", -1);
  double sum[2];
  sum[0] = rot_sum_product(ffi_real(first, "first"), (int)XLENGTH(factors), x, &sum[1]);
  return ffi_numbers(2, sum);
}
