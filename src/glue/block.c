#include "glue/block.h"

#include <stdio.h>

#include "glue/design.h"
#include "glue/formula.h"
#include "glue/object.h"
#include "glue/run.h"
#include "sweep/table.h"

static const char **texts(SEXP x, const char *what, size_t *n) {
  if (TYPEOF(x) != STRSXP) Rf_error("internal: `%s` is not text", what);
  *n = (size_t)XLENGTH(x);
  const char **to = (const char **)R_alloc(*n + 1, sizeof *to);
  for (size_t i = 0; i < *n; i++) to[i] = CHAR(STRING_ELT(x, (R_xlen_t)i));
  return to;
}

rot_sweep ffi_sweep(SEXP x) {
  rot_sweep to = {.threads = 1};
  SEXP model = ffi_element(x, "model"), time_s = ffi_element(x, "time_s");
  SEXP derived = ffi_element(x, "derived");
  to.plan.inputs = texts(ffi_element(x, "inputs"), "inputs", &to.plan.n_inputs);
  to.plan.outputs = texts(ffi_element(x, "outputs"), "outputs", &to.plan.n_outputs);
  to.plan.time_s = ffi_reals(time_s, "time_s", -1);
  to.plan.n_times = (size_t)XLENGTH(time_s);
  to.plan.model = Rf_isNull(model) ? NULL : ffi_text(model, "model");
  to.table = ffi_number_of(x, "table") != 0.0;
  to.plan.asked = ffi_number_of(x, "asked") != 0.0;
  to.plan.accuracy = ffi_number_of(x, "accuracy");
  to.plan.max_steps = ffi_number_of(x, "max_steps");
  to.design = *ffi_design(ffi_element(x, "design"));
  if (TYPEOF(derived) != VECSXP) Rf_error("internal: `derived` is not a list");
  to.n_derived = (size_t)XLENGTH(derived);
  rot_formula *formula = (rot_formula *)R_alloc(to.n_derived + 1, sizeof *formula);
  for (size_t i = 0; i < to.n_derived; i++) {
    formula[i] = ffi_formula(VECTOR_ELT(derived, (R_xlen_t)i), to.design.n_inputs + i);
  }
  to.derived = formula;
  const double *bound = ffi_numbers_of(x, "bound", (R_xlen_t)to.plan.n_inputs);
  size_t *places = (size_t *)R_alloc(to.plan.n_inputs + 1, sizeof *places);
  for (size_t i = 0; i < to.plan.n_inputs; i++) {
    if (!(bound[i] >= 0.0 && bound[i] < (double)(to.design.n_inputs + to.n_derived))) {
      Rf_error("internal: `bound`");
    }
    places[i] = (size_t)bound[i];
  }
  to.bound = places;
  const double part = ffi_number_of(x, "part"), threads = ffi_number_of(x, "threads");
  to.part = part >= 1.0 && part <= 65536.0 ? (size_t)part : 256;
  /* The core starts no more than the system has. */
  to.threads = !(threads >= 1.0) ? 1 : threads <= 4096.0 ? (int)threads : 4096;
  return to;
}

rot_object *ffi_sweep_scene(SEXP x, rot_sweep *to, char fault[]) {
  rot_object *scene = ffi_object(ffi_element(x, "node"), fault);
  to->plan.scene = scene;
  return scene;
}

/* => a list of n columns of doubles, their addresses */
static SEXP new_columns(size_t n, R_xlen_t rows, double *column[]) {
  SEXP list = PROTECT(Rf_allocVector(VECSXP, (R_xlen_t)n));
  for (size_t i = 0; i < n; i++) column[i] = ffi_new_double(list, (R_xlen_t)i, rows);
  UNPROTECT(1);
  return list;
}

static SEXP refused(const char *reason, size_t at) {
  static const char *const names[] = {"refused", "at", ""};
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, Rf_mkString(reason));
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal((double)at));
  UNPROTECT(1);
  return out;
}

/* (sweep, first row from 0, n rows up to 2^16) => list(input, output, status, error) of the rows,
 * or list(refused, at): why, and the place of the input or output. */
SEXP ffi_sweep_rows(SEXP x, SEXP first, SEXP rows, SEXP progress) {
  static const char *const names[] = {"input", "output", "status", "error", ""};
  char fault[FFI_OBJECT_FAULT];
  const double n = ffi_real(rows, "rows");
  if (!(n >= 0.0 && n <= ROT_BLOCK_MAX)) Rf_error("internal: `rows`");
  const uint64_t from = ffi_whole(first, "first", (uint64_t)1 << 52);
  rot_sweep sweep = ffi_sweep(x);
  const size_t n_inputs = sweep.design.n_inputs + sweep.n_derived;
  double **input = (double **)R_alloc(n_inputs + 1, sizeof *input);
  double **output = (double **)R_alloc(sweep.plan.n_outputs + 1, sizeof *output);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, new_columns(n_inputs, (R_xlen_t)n, input));
  SET_VECTOR_ELT(out, 1, new_columns(sweep.plan.n_outputs, (R_xlen_t)n, output));
  SEXP status = Rf_allocVector(INTSXP, (R_xlen_t)n);
  SET_VECTOR_ELT(out, 2, status);
  const rot_block block = {input, output, INTEGER(status), ffi_new_double(out, 3, (R_xlen_t)n)};
  rot_info info;
  rot_refusal no = {0};
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  rot_object *scene = ffi_sweep_scene(x, &sweep, fault);
  rot_status end = ROT_EVALUE;
  if (scene) end = rot_block_run(&sweep, from, (size_t)n, &block, &guard.hooks, &info, &no);
  rot_object_free(scene);
  if (end == ROT_EVALUE) {
    ffi_guard_end(&guard, ROT_OK);
    out = refused(scene ? no.reason : fault, no.input);
  } else {
    ffi_guard_end(&guard, end);
    if (end != ROT_OK) Rf_error("internal: %s", rot_status_text(end));
  }
  UNPROTECT(1);
  return out;
}

/* (sweep, numbers of rows) => list(model, taken): that of the most rows, and how many; or
 * list(refused, at). */
SEXP ffi_sweep_model(SEXP x, SEXP rows) {
  static const char *const names[] = {"model", "taken", ""};
  char fault[FFI_OBJECT_FAULT];
  const double *number = ffi_reals(rows, "rows", -1);
  const size_t n = (size_t)XLENGTH(rows);
  rot_sweep sweep = ffi_sweep(x);
  const size_t n_inputs = sweep.design.n_inputs + sweep.n_derived;
  double **input = (double **)R_alloc(n_inputs + 1, sizeof *input);
  double **one = (double **)R_alloc(n_inputs + 1, sizeof *one);
  const double **bound = (const double **)R_alloc(sweep.plan.n_inputs + 1, sizeof *bound);
  for (size_t k = 0; k < n_inputs; k++) input[k] = (double *)R_alloc(n + 1, sizeof **input);
  rot_status end = ROT_OK;
  for (size_t i = 0; i < n && end == ROT_OK; i++) {
    if (!(number[i] >= 0.0 && number[i] <= 4503599627370496.0)) Rf_error("internal: `rows`");
    for (size_t k = 0; k < n_inputs; k++) one[k] = &input[k][i];
    end = rot_design_rows(&sweep.design, (uint64_t)number[i], 1, one);
  }
  for (size_t k = 0; k < sweep.n_derived && end == ROT_OK; k++) {
    end = rot_formula_rows(&sweep.derived[k], n, (const double *const *)input,
                           input[sweep.design.n_inputs + k]);
  }
  if (end != ROT_OK) Rf_error("internal: no such rows");
  for (size_t k = 0; k < sweep.plan.n_inputs; k++) bound[k] = input[sweep.bound[k]];
  rot_rows_worker *worker = NULL;
  rot_refusal no = {0};
  size_t taken = 0;
  const rot_model *model = NULL;
  rot_object *scene = ffi_sweep_scene(x, &sweep, fault);
  end = scene ? rot_rows_open(&sweep.plan, &worker, &no) : ROT_EVALUE;
  if (end == ROT_OK) model = rot_rows_model(worker, n, bound, &taken);
  rot_rows_close(worker);
  rot_object_free(scene);
  if (end == ROT_EVALUE) return refused(scene ? no.reason : fault, no.input);
  if (end != ROT_OK) Rf_error("internal: %s", rot_status_text(end));
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, model ? Rf_mkString(model->id) : R_NilValue);
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal((double)taken));
  UNPROTECT(1);
  return out;
}

/* sweep => TRUE if a kernel computes its rows */
SEXP ffi_sweep_is_table(SEXP x) {
  char fault[FFI_OBJECT_FAULT];
  rot_sweep sweep = ffi_sweep(x);
  rot_table *table = NULL;
  rot_object *scene = ffi_sweep_scene(x, &sweep, fault);
  const rot_status status = scene ? rot_table_open(&sweep.plan, &table) : ROT_OK;
  rot_table_close(table);
  rot_object_free(scene);
  if (status != ROT_OK) Rf_error("internal: %s", rot_status_text(status));
  return Rf_ScalarLogical(table != NULL);
}

/* => names of the statuses of rows, from 0 */
SEXP ffi_sweep_statuses(void) {
  SEXP out = PROTECT(Rf_allocVector(STRSXP, ROT_ROW_STATUS_COUNT));
  for (int i = 0; i < ROT_ROW_STATUS_COUNT; i++) {
    SET_STRING_ELT(out, i, Rf_mkChar(rot_row_status_name(i)));
  }
  UNPROTECT(1);
  return out;
}
