/* For R: standard shapes. */
#include "glue/ffi.h"

#include <string.h>

#include "body/shapes.h"

static SEXP strings(R_xlen_t n) { return Rf_allocVector(STRSXP, n); }

/* => names of a shape's sizes */
static SEXP size_names(const rot_shape *shape) {
  SEXP names = PROTECT(strings(shape->sizes));
  for (int k = 0; k < shape->sizes; k++) {
    SET_STRING_ELT(names, k, Rf_mkChar(rot_size_at(shape->size[k])->name));
  }
  UNPROTECT(1);
  return names;
}

/* => columns of the list of shapes, and of the list of sizes */
SEXP ffi_shapes_list(void) {
  static const char *const names[] = {"shape", "dimension", "sizes", "size", "kind", ""};
  const R_xlen_t n = (R_xlen_t)rot_shape_count();
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, strings(n));
  SET_VECTOR_ELT(out, 1, Rf_allocVector(INTSXP, n));
  SET_VECTOR_ELT(out, 2, Rf_allocVector(VECSXP, n));
  SET_VECTOR_ELT(out, 3, strings(ROT_SIZE_COUNT));
  SET_VECTOR_ELT(out, 4, Rf_allocVector(INTSXP, ROT_SIZE_COUNT));
  for (R_xlen_t i = 0; i < n; i++) {
    const rot_shape *shape = rot_shape_at((size_t)i);
    SET_STRING_ELT(VECTOR_ELT(out, 0), i, Rf_mkChar(shape->name));
    INTEGER(VECTOR_ELT(out, 1))[i] = shape->dimension;
    SET_VECTOR_ELT(VECTOR_ELT(out, 2), i, size_names(shape));
  }
  for (int k = 0; k < ROT_SIZE_COUNT; k++) {
    SET_STRING_ELT(VECTOR_ELT(out, 3), k, Rf_mkChar(rot_size_at(k)->name));
    INTEGER(VECTOR_ELT(out, 4))[k] = (int)rot_size_at(k)->kind;
  }
  UNPROTECT(1);
  return out;
}

static const rot_shape *shape_of(SEXP id) {
  if (TYPEOF(id) != INTSXP || XLENGTH(id) != 1 || INTEGER(id)[0] < 1 ||
      (size_t)INTEGER(id)[0] > rot_shape_count()) {
    Rf_error("internal: no such shape");
  }
  return rot_shape_at((size_t)INTEGER(id)[0] - 1);
}

/* => c(fault, row, slot), the last two from 1; R makes the message */
static SEXP fault_of(rot_shape_fault fault, size_t row, int slot) {
  return ffi_numbers(3, (const double[]){(double)fault, (double)row + 1.0, slot + 1.0});
}

/* => one body: mass, six second moments, centre, reach, beta, error */
SEXP ffi_shapes_body(SEXP id, SEXP amount, SEXP is_density, SEXP sizes) {
  const rot_shape *shape = shape_of(id);
  const double *given = ffi_reals(sizes, "sizes", shape->sizes);
  double size[ROT_SIZES] = {0.0};
  int slot = 0;
  for (int k = 0; k < shape->sizes; k++) size[k] = given[k];
  const rot_shape_fault fault = rot_shape_check(shape, size, &slot);
  if (fault) return fault_of(fault, 0, slot);
  rot_shape_body body;
  rot_shape_make(shape, ffi_real(amount, "amount"), Rf_asLogical(is_density) == TRUE, size, &body);
  if (ISNAN(body.beta)) body.beta = NA_REAL;
  const ffi_vector parts[] = {{1, &body.mass_kg}, {6, body.second_kg_m2}, {3, body.centre_m},
                              {1, &body.reach_m}, {1, &body.beta},        {1, &body.error}};
  return ffi_vectors(6, NULL, parts);
}

/* NaN becomes NA for a missing beta and for the moments of a row that has only beta. Other NaN are
 * results. */
static void mark_missing(double *columns[], const int shape[], R_xlen_t n) {
  for (R_xlen_t i = 0; i < n; i++) {
    if (ISNAN(columns[ROT_SHAPE_ROLLS][i])) columns[ROT_SHAPE_ROLLS][i] = NA_REAL;
    for (int c = ROT_SHAPE_IXX; c <= ROT_SHAPE_IZZ && shape[i] < 0; c++) columns[c][i] = NA_REAL;
  }
}

/* Checks that each shape in use has its columns; used[0]: rows that have only beta. */
static void check_columns(const int used[], const rot_shape_rows *rows) {
  if (used[0] && !rows->size[ROT_RADIUS].values) Rf_error("internal: no `radius_m`");
  for (size_t i = 0; i < rot_shape_count(); i++) {
    const rot_shape *shape = rot_shape_at(i);
    for (int k = 0; k < shape->sizes && used[i + 1]; k++) {
      if (!rows->size[shape->size[k]].values) Rf_error("internal: a size is missing");
    }
  }
}

/* rows of shapes => columns. Ids from 1, 0 for a row that has only beta; `sizes`: list of columns
 * in the order of the sizes, NULL for a size that no row needs. */
SEXP ffi_shapes_table(SEXP id, SEXP mass, SEXP beta, SEXP sizes) {
  static const char *const names[] = {
      "moment_of_inertia_kg_m2", "ixx_kg_m2", "iyy_kg_m2", "izz_kg_m2", "beta",
      "radius_of_gyration_m"};
  if (TYPEOF(id) != INTSXP || TYPEOF(sizes) != VECSXP || XLENGTH(sizes) != ROT_SIZE_COUNT) {
    Rf_error("internal: a table of shapes");
  }
  R_xlen_t n = XLENGTH(id);
  rot_shape_rows rows = {NULL, 1, {NULL, 0}, {NULL, 0}, {{NULL, 0}}};
  rows.mass_kg = ffi_column(mass, "mass_kg", &n);
  rows.beta = ffi_column(beta, "beta", &n);
  for (int k = 0; k < ROT_SIZE_COUNT; k++) {
    SEXP column = VECTOR_ELT(sizes, k);
    if (!Rf_isNull(column)) rows.size[k] = ffi_column(column, rot_size_at(k)->name, &n);
  }
  if (XLENGTH(id) != n) Rf_error("internal: a shape for each row");
  int *shape = (int *)R_alloc((size_t)n, sizeof *shape);
  int *used = (int *)R_alloc(rot_shape_count() + 1, sizeof *used);
  memset(used, 0, (rot_shape_count() + 1) * sizeof *used);
  for (R_xlen_t i = 0; i < n; i++) {
    shape[i] = INTEGER(id)[i] - 1;
    if (shape[i] < -1 || shape[i] >= (int)rot_shape_count()) Rf_error("internal: no such shape");
    used[shape[i] + 1] = 1;
  }
  check_columns(used, &rows);
  rows.shape = shape;
  double *columns[ROT_SHAPE_COLUMNS];
  SEXP out = ffi_columns(ROT_SHAPE_COLUMNS, names, n, columns);
  size_t row = 0;
  int slot = 0;
  const rot_shape_fault fault = rot_shapes_table((size_t)n, &rows, columns, &row, &slot);
  if (!fault) mark_missing(columns, shape, n);
  UNPROTECT(1);
  return fault ? fault_of(fault, row, slot) : out;
}
