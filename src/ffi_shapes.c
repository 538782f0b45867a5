#include "ffi.h"
#include "rot_shapes.h"

/* The list of shapes as columns. */
SEXP ffi_shapes_list(void) {
  static const char *const names[] = {"shape", "axis", "formula", "size", "k",
                                      "kx",    "ky",   "kz",      ""};
  const R_xlen_t n = (R_xlen_t)rot_shape_count();
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  for (int j = 0; j < 8; j++) {
    SET_VECTOR_ELT(out, j, Rf_allocVector(j < 4 ? STRSXP : REALSXP, n));
  }
  for (R_xlen_t i = 0; i < n; i++) {
    const rot_shape *shape = rot_shape_at((size_t)i);
    const char *text[] = {shape->name, shape->axis_text, shape->formula, shape->size};
    const double k[] = {shape->axis, shape->principal[0], shape->principal[1], shape->principal[2]};
    for (int j = 0; j < 4; j++) SET_STRING_ELT(VECTOR_ELT(out, j), i, Rf_mkChar(text[j]));
    for (int j = 0; j < 4; j++) REAL(VECTOR_ELT(out, j + 4))[i] = k[j];
  }
  UNPROTECT(1);
  return out;
}

SEXP ffi_shapes_table(SEXP k, SEXP mass, SEXP size) {
  static const char *const names[] = {"moment_of_inertia_kg_m2", "radius_of_gyration_m"};
  R_xlen_t n = 1;
  const rot_column ks = ffi_column(k, "k", &n), m = ffi_column(mass, "mass_kg", &n),
                   s = ffi_column(size, "size_m", &n);
  double *columns[2];
  SEXP out = ffi_columns(2, names, n, columns);
  rot_shapes_table((size_t)n, ks, m, s, columns[0], columns[1]);
  UNPROTECT(1);
  return out;
}
