/* For R: hash of numbers and bytes. */
#include <string.h>

#include "glue/ffi.h"
#include "ground/hash.h"

static size_t bytes_of(SEXP x) {
  switch (TYPEOF(x)) {
  case RAWSXP: return (size_t)XLENGTH(x);
  case REALSXP: return 8 * (size_t)XLENGTH(x);
  case INTSXP:
  case LGLSXP: return 4 * (size_t)XLENGTH(x);
  default: Rf_error("`x` must be a list of numbers and bytes");
  }
}

/* Copies n bytes of numbers, lowest byte first. */
static void write_bytes(unsigned char *out, const void *from, size_t n, size_t each) {
  const int one = 1;
  memcpy(out, from, n);
  if (*(const char *)&one == 1) return;
  for (size_t i = 0; i < n; i += each) {
    for (size_t k = 0; k < each / 2; k++) {
      const unsigned char byte = out[i + k];
      out[i + k] = out[i + each - 1 - k];
      out[i + each - 1 - k] = byte;
    }
  }
}

/* list of vectors => hash of their concatenated bytes */
SEXP ffi_hash(SEXP x) {
  if (TYPEOF(x) != VECSXP) Rf_error("`x` must be a list");
  const R_xlen_t parts = XLENGTH(x);
  size_t n = 0;
  for (R_xlen_t i = 0; i < parts; i++) n += bytes_of(VECTOR_ELT(x, i));
  unsigned char *bytes = (unsigned char *)R_alloc(n + 1, 1), *at = bytes;
  for (R_xlen_t i = 0; i < parts; i++) {
    SEXP part = VECTOR_ELT(x, i);
    const size_t size = bytes_of(part);
    if (size == 0) continue;
    switch (TYPEOF(part)) {
    case RAWSXP: memcpy(at, RAW(part), size); break;
    case REALSXP: write_bytes(at, REAL(part), size, 8); break;
    case LGLSXP: write_bytes(at, LOGICAL(part), size, 4); break;
    default: write_bytes(at, INTEGER(part), size, 4);
    }
    at += size;
  }
  char hash[ROT_HASH_SIZE];
  rot_hash(bytes, n, hash);
  return Rf_mkString(hash);
}
