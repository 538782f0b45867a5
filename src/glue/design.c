/* For R: rows of designs by their numbers. */
#include "glue/design.h"

#include <math.h>
#include <string.h>

static void *take(size_t bytes) { return R_alloc(bytes, 1); }

uint64_t ffi_whole(SEXP x, const char *what, uint64_t largest) {
  const double value = ffi_real(x, what);
  if (!(value >= 0.0 && value <= (double)largest && value == floor(value)))
    Rf_error("internal: `%s` is not a whole number of the right size", what);
  return (uint64_t)value;
}

/* (names, text) => place of the text; R error without one */
static int place_of(const char *(*name)(int), const char *text, const char *what) {
  for (int i = 0; name(i); i++)
    if (!strcmp(name(i), text)) return i;
  Rf_error("internal: unknown `%s`", what);
}

static rot_vary law_of(SEXP x) {
  const int kind = place_of(rot_vary_name, ffi_text(ffi_element(x, "kind"), "kind"), "kind");
  rot_vary law = {.kind = (rot_vary_kind)kind, .low = -HUGE_VAL, .high = HUGE_VAL};
  for (int i = 0; i < ROT_VARY_PARAMETERS; i++)
    if (*rot_vary_parameter(kind, i)) law.p[i] = ffi_number_of(x, rot_vary_parameter(kind, i));
  if (!Rf_isNull(ffi_element(x, "at_least"))) law.low = ffi_number_of(x, "at_least");
  if (!Rf_isNull(ffi_element(x, "at_most"))) law.high = ffi_number_of(x, "at_most");
  if (kind != ROT_VARY_VALUES && kind != ROT_VARY_COLUMN) return law;
  law.x = ffi_numbers_of(x, "x", -1);
  law.n = (size_t)XLENGTH(ffi_element(x, "x"));
  SEXP weights = ffi_element(x, "weights");
  if (!Rf_isNull(weights)) law.weight = ffi_reals(weights, "weights", (R_xlen_t)law.n);
  return law;
}

/* list(inputs = their names, matrix) => members of the design */
static void correlation_of(SEXP x, SEXP names, rot_design *d) {
  if (Rf_isNull(x)) return;
  SEXP inputs = ffi_element(x, "inputs");
  const R_xlen_t n = TYPEOF(inputs) == STRSXP ? XLENGTH(inputs) : 0;
  if (n < 2 || n > (R_xlen_t)d->n_inputs) Rf_error("internal: `correlation`");
  size_t *which = (size_t *)R_alloc((size_t)n, sizeof *which), at = 0;
  for (R_xlen_t i = 0; i < n; i++) {
    while (at < d->n_inputs &&
           strcmp(CHAR(STRING_ELT(names, (R_xlen_t)at)), CHAR(STRING_ELT(inputs, i))))
      at++;
    which[i] = at++;
  }
  d->n_correlated = (size_t)n;
  d->correlated = which;
  d->correlation = ffi_numbers_of(x, "matrix", n * n);
}

const rot_design *ffi_design(SEXP design) {
  SEXP inputs = ffi_element(design, "inputs"), seed = ffi_element(design, "seed");
  SEXP names = TYPEOF(inputs) == VECSXP ? Rf_getAttrib(inputs, R_NamesSymbol) : R_NilValue;
  const char *kind = ffi_text(ffi_element(design, "kind"), "kind");
  rot_design *d = (rot_design *)R_alloc(1, sizeof *d);
  rot_store store = {.take = take};
  if (TYPEOF(names) != STRSXP || XLENGTH(inputs) < 1) Rf_error("internal: `inputs`");
  memset(d, 0, sizeof *d);
  d->kind = (rot_design_kind)place_of(rot_design_name, kind, "kind");
  d->points = ffi_whole(ffi_element(design, "n"), "n", ROT_DESIGN_MAX_ROWS);
  d->n_inputs = (size_t)XLENGTH(inputs);
  d->input = (rot_vary *)R_alloc(d->n_inputs, sizeof *d->input);
  for (size_t i = 0; i < d->n_inputs; i++) {
    d->input[i] = law_of(VECTOR_ELT(inputs, (R_xlen_t)i));
  }
  d->seeded = !Rf_isNull(seed);
  if (d->seeded) d->seed = ffi_whole(seed, "seed", (uint64_t)1 << 53);
  correlation_of(ffi_element(design, "correlation"), names, d);
  const rot_status status = rot_design_begin(d, &store);
  if (status != ROT_OK) Rf_error("internal: no sound design: %s", rot_status_text(status));
  return d;
}

/* design => number of rows */
SEXP ffi_design_size(SEXP design) { return Rf_ScalarReal((double)ffi_design(design)->n); }

/* (design, number of the first row from 0, n) => columns */
SEXP ffi_design_rows(SEXP design, SEXP first, SEXP n) {
  enum { PIECE = 1 << 16 };
  const rot_design *d = ffi_design(design);
  const uint64_t from = ffi_whole(first, "first", d->n), rows = ffi_whole(n, "n", d->n - from);
  const int inputs = (int)d->n_inputs;
  SEXP out = PROTECT(Rf_allocVector(VECSXP, inputs));
  double **column = (double **)R_alloc((size_t)inputs, sizeof *column);
  for (int i = 0; i < inputs; i++) {
    SET_VECTOR_ELT(out, i, ffi_new_column((R_xlen_t)rows));
    column[i] = REAL(VECTOR_ELT(out, i));
  }
  for (uint64_t done = 0; done < rows; done += PIECE) {
    const size_t m = rows - done < PIECE ? (size_t)(rows - done) : PIECE;
    R_CheckUserInterrupt();
    rot_design_rows(d, from + done, m, column);
    for (int i = 0; i < inputs; i++) column[i] += m;
  }
  UNPROTECT(1);
  return out;
}
