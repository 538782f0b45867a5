/* For R: formulas of derived inputs. */
#include "glue/formula.h"

static const int *whole_numbers(SEXP x, const char *what) {
  if (TYPEOF(x) != INTSXP) Rf_error("internal: `%s` is not an integer vector", what);
  return INTEGER(x);
}

rot_formula ffi_formula(SEXP formula, size_t n_inputs) {
  SEXP op = ffi_element(formula, "op"), arg = ffi_element(formula, "arg");
  SEXP constant = ffi_element(formula, "constant");
  rot_formula f = {0};
  f.op = whole_numbers(op, "op");
  f.arg = whole_numbers(arg, "arg");
  f.constant = ffi_reals(constant, "constant", -1);
  f.n_ops = (size_t)XLENGTH(op);
  f.n_constants = (size_t)XLENGTH(constant);
  f.n_inputs = n_inputs;
  if (XLENGTH(arg) != XLENGTH(op) || rot_formula_check(&f) != ROT_OK)
    Rf_error("internal: no sound formula");
  return f;
}

/* => numbers of operands, named by the operations, in the order of their codes */
SEXP ffi_formula_operations(void) {
  SEXP names = PROTECT(Rf_allocVector(STRSXP, ROT_OP_COUNT));
  SEXP out = PROTECT(Rf_allocVector(INTSXP, ROT_OP_COUNT));
  for (int i = 0; i < ROT_OP_COUNT; i++) {
    SET_STRING_ELT(names, i, Rf_mkChar(rot_formula_name(i)));
    INTEGER(out)[i] = rot_formula_operands(i);
  }
  Rf_setAttrib(out, R_NamesSymbol, names);
  UNPROTECT(2);
  return out;
}

/* (program, list of columns, number of rows) => results */
SEXP ffi_formula_rows(SEXP formula, SEXP columns, SEXP rows) {
  if (TYPEOF(columns) != VECSXP) Rf_error("internal: `columns` is not a list");
  const size_t n = (size_t)XLENGTH(columns);
  const rot_formula f = ffi_formula(formula, n);
  const double count = ffi_real(rows, "rows");
  if (!(count >= 0.0 && count <= 0x1p52)) Rf_error("internal: `rows`");
  const double **column = (const double **)R_alloc(n + 1, sizeof *column);
  for (size_t i = 0; i < n; i++)
    column[i] = ffi_reals(VECTOR_ELT(columns, (R_xlen_t)i), "columns", (R_xlen_t)count);
  SEXP out = PROTECT(ffi_new_column((R_xlen_t)count));
  rot_formula_rows(&f, (size_t)count, column, REAL(out));
  UNPROTECT(1);
  return out;
}
