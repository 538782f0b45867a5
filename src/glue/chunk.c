/* For R: chunks of a sweep, and the sums of several. */
#include "sweep/chunk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "glue/block.h"
#include "glue/design.h"
#include "glue/formula.h"
#include "glue/object.h"
#include "glue/run.h"

/* ---- the long form --------------------------------------------------------------------------- */

static const char *const long_names[] = {"quantity", "kind", "key", "value", ""};

/* Memory of a long form, in C; keys are doubles in R: whole numbers up to 2^53. */
typedef struct rows_of {
  size_t n;
  rot_long rows;
} rows_of;

static int open_rows(rows_of *to, size_t n) {
  to->n = n;
  to->rows.quantity = malloc((n + 1) * sizeof *to->rows.quantity);
  to->rows.kind = malloc((n + 1) * sizeof *to->rows.kind);
  to->rows.key = malloc((n + 1) * sizeof *to->rows.key);
  to->rows.value = malloc((n + 1) * sizeof *to->rows.value);
  return to->rows.quantity && to->rows.kind && to->rows.key && to->rows.value;
}

static void free_rows(rows_of *of) {
  free(of->rows.quantity);
  free(of->rows.kind);
  free(of->rows.key);
  free(of->rows.value);
  memset(of, 0, sizeof *of);
}

static rot_long from_row(const rot_long *rows, size_t at) {
  return (rot_long){rows->quantity + at, rows->kind + at, rows->key + at, rows->value + at};
}

/* The sums of a chunk, or of a whole sweep. */
typedef struct sums {
  rot_summary *summary;
  rot_means *means;
  rot_indices *indices; /* or NULL */
} sums;

static void free_sums(sums *of) {
  if (of->summary) rot_summary_free(of->summary);
  if (of->means) rot_means_free(of->means);
  if (of->indices) rot_indices_free(of->indices);
  memset(of, 0, sizeof *of);
}

/* Sums => long form, one behind the other. */
static rot_status write_sums(const sums *of, rows_of *to) {
  const size_t a = rot_summary_rows_size(of->summary), b = rot_means_rows_size(of->means);
  const size_t c = of->indices ? rot_indices_rows_size(of->indices) : 0;
  if (!open_rows(to, a + b + c)) return ROT_ENOMEM;
  rot_long at = from_row(&to->rows, 0);
  rot_summary_rows(of->summary, &at);
  at = from_row(&to->rows, a);
  rot_means_rows(of->means, &at);
  at = from_row(&to->rows, a + b);
  if (of->indices) rot_indices_rows(of->indices, &at);
  return ROT_OK;
}

/* Kinds below 100: a summary; 100 to 199: indices; 200 and on: means. */
static size_t count_kinds(const rows_of *of, size_t from, int below) {
  size_t n = from;
  while (n < of->n && of->rows.kind[n] < below) n++;
  return n - from;
}

static rot_status read_sums(const rows_of *from, sums *to) {
  size_t means = 0;
  const size_t a = count_kinds(from, 0, 100);
  while (a + means < from->n && from->rows.kind[a + means] >= 200) means++;
  const size_t b = from->n - a - means;
  rot_long at = from_row(&from->rows, 0);
  rot_status status = rot_summary_read(a, &at, &to->summary);
  at = from_row(&from->rows, a);
  if (status == ROT_OK) status = rot_means_read(means, &at, &to->means);
  at = from_row(&from->rows, a + means);
  if (status == ROT_OK && b) status = rot_indices_read(b, &at, &to->indices);
  return status;
}

static SEXP long_form(const rows_of *of) {
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)long_names));
  const R_xlen_t n = (R_xlen_t)of->n;
  SEXP quantity = Rf_allocVector(INTSXP, n);
  SET_VECTOR_ELT(out, 0, quantity);
  SEXP kind = Rf_allocVector(INTSXP, n);
  SET_VECTOR_ELT(out, 1, kind);
  double *key = ffi_new_double(out, 2, n), *value = ffi_new_double(out, 3, n);
  for (R_xlen_t i = 0; i < n; i++) {
    INTEGER(quantity)[i] = of->rows.quantity[i];
    INTEGER(kind)[i] = of->rows.kind[i];
    key[i] = (double)of->rows.key[i];
    value[i] = of->rows.value[i];
  }
  UNPROTECT(1);
  return out;
}

/* Of R => 0: it is damaged or there is no memory. */
static int copy_long(SEXP x, rows_of *to) {
  SEXP quantity = ffi_element(x, "quantity"), kind = ffi_element(x, "kind");
  SEXP key = ffi_element(x, "key"), value = ffi_element(x, "value");
  if (TYPEOF(quantity) != INTSXP || TYPEOF(kind) != INTSXP || TYPEOF(key) != REALSXP ||
      TYPEOF(value) != REALSXP) {
    return 0;
  }
  const R_xlen_t n = XLENGTH(value);
  if (XLENGTH(quantity) != n || XLENGTH(kind) != n || XLENGTH(key) != n) return 0;
  if (!open_rows(to, (size_t)n)) return 0;
  for (R_xlen_t i = 0; i < n; i++) {
    const double k = REAL_RO(key)[i];
    if (!(fabs(k) <= 9007199254740992.0) || k != floor(k)) return 0;
    to->rows.quantity[i] = INTEGER_RO(quantity)[i];
    to->rows.kind[i] = INTEGER_RO(kind)[i];
    to->rows.key[i] = (int64_t)k;
    to->rows.value[i] = REAL_RO(value)[i];
  }
  return 1;
}

/* ---- a chunk --------------------------------------------------------------------------------- */

typedef struct finished {
  const rot_chunk *chunk;
  const rows_of *rows;
  int summed;
} finished;

static SEXP copied(const double *x, size_t n) {
  SEXP to = Rf_allocVector(REALSXP, (R_xlen_t)n);
  if (n) memcpy(REAL(to), x, n * sizeof *x);
  return to;
}

/* => list(column, row, error, status, sums, checksum = c(upper, lower 32 bits)) */
static SEXP take_chunk(void *data) {
  static const char *const names[] = {"column", "row", "error", "status", "sums", "checksum", ""};
  const finished *from = data;
  const rot_kept *kept = &from->chunk->kept;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), columns, status;
  SET_VECTOR_ELT(out, 0, columns = Rf_allocVector(VECSXP, (R_xlen_t)kept->n_columns));
  for (size_t k = 0; k < kept->n_columns; k++) {
    SET_VECTOR_ELT(columns, (R_xlen_t)k, copied(kept->column[k], kept->n));
  }
  SET_VECTOR_ELT(out, 1, copied(kept->row, kept->n));
  SET_VECTOR_ELT(out, 2, copied(kept->error, kept->n));
  SET_VECTOR_ELT(out, 3, status = Rf_allocVector(INTSXP, (R_xlen_t)kept->n));
  if (kept->n) memcpy(INTEGER(status), kept->status, kept->n * sizeof(int));
  if (from->summed) SET_VECTOR_ELT(out, 4, long_form(from->rows));
  const uint64_t sum = from->chunk->checksum;
  const double halves[] = {(double)(sum >> 32), (double)(sum & 0xffffffffu)};
  SET_VECTOR_ELT(out, 5, ffi_numbers(2, halves));
  UNPROTECT(1);
  return out;
}

static SEXP refused(const char *reason, size_t at) {
  static const char *const names[] = {"refused", "at", ""};
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, Rf_mkString(reason));
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal((double)at));
  UNPROTECT(1);
  return out;
}

/* list(input, output, status, error), lists of columns of n numbers => rows of the core. R error
 * where they are damaged. */
static rot_block given_rows(SEXP rows, const rot_sweep *sweep, R_xlen_t n) {
  static const char *const names[] = {"input", "output"};
  const size_t count[] = {sweep->design.n_inputs + sweep->n_derived, sweep->plan.n_outputs};
  double **column[2];
  for (int k = 0; k < 2; k++) {
    SEXP list = ffi_element(rows, names[k]);
    if (TYPEOF(list) != VECSXP || XLENGTH(list) != (R_xlen_t)count[k]) {
      Rf_error("internal: `%s`", names[k]);
    }
    column[k] = (double **)R_alloc(count[k] + 1, sizeof **column);
    for (size_t i = 0; i < count[k]; i++) {
      SEXP x = VECTOR_ELT(list, (R_xlen_t)i);
      (void)ffi_reals(x, names[k], n);
      column[k][i] = REAL(x);
    }
  }
  SEXP status = ffi_element(rows, "status"), error = ffi_element(rows, "error");
  if (TYPEOF(status) != INTSXP || XLENGTH(status) != n) Rf_error("internal: `status`");
  for (R_xlen_t i = 0; i < n; i++) {
    if (INTEGER_RO(status)[i] < 0 || INTEGER_RO(status)[i] >= ROT_ROW_STATUS_COUNT) {
      Rf_error("internal: `status`");
    }
  }
  (void)ffi_reals(error, "error", n);
  return (rot_block){column[0], column[1], INTEGER(status), REAL(error)};
}

/* (sweep; list(first, n, block_rows, keep, condition, summed, shift, replicates, run); rows) =>
 * list(column, row, error, status, sums, checksum), or list(refused, at). keep: 0 no row, 1 all, 2
 * those of the condition. rows: those that R has computed, or NULL. */
SEXP ffi_sweep_chunk(SEXP x, SEXP how, SEXP rows_in, SEXP progress) {
  char fault[FFI_OBJECT_FAULT] = "";
  const double keep = ffi_number_of(how, "keep"), replicates = ffi_number_of(how, "replicates");
  const double block_rows = ffi_number_of(how, "block_rows");
  rot_sweep sweep = ffi_sweep(x);
  rot_formula formula;
  if (!(keep == 0.0 || keep == 1.0 || keep == 2.0)) Rf_error("internal: `keep`");
  if (!(block_rows >= 256.0 && block_rows <= 65536.0)) Rf_error("internal: `block_rows`");
  if (!(replicates >= 1.0 && replicates <= 4096.0)) Rf_error("internal: `replicates`");
  if (keep == 2.0) {
    formula = ffi_formula(ffi_element(how, "condition"),
                          sweep.design.n_inputs + sweep.n_derived + sweep.plan.n_outputs);
  }
  const uint64_t first = ffi_whole(ffi_element(how, "first"), "first", (uint64_t)1 << 52);
  const uint64_t n = ffi_whole(ffi_element(how, "n"), "n", (uint64_t)1 << 52);
  rot_block given;
  const int computed = !Rf_isNull(rows_in);
  if (computed) given = given_rows(rows_in, &sweep, (R_xlen_t)n);
  const rot_chunk_plan plan = {.sweep = &sweep,
                               .block_rows = (size_t)block_rows,
                               .given = computed ? &given : NULL,
                               .keep = keep == 0.0   ? ROT_KEEP_NONE
                                       : keep == 1.0 ? ROT_KEEP_ALL
                                                     : ROT_KEEP_SOME,
                               .condition = keep == 2.0 ? &formula : NULL,
                               .summed = ffi_number_of(how, "summed") != 0.0,
                               .shift =
                                   ffi_numbers_of(how, "shift", (R_xlen_t)sweep.plan.n_outputs),
                               .replicates = (size_t)replicates,
                               .run = ffi_whole(ffi_element(how, "run"), "run", (uint64_t)1 << 52)};
  rot_chunk chunk = {0};
  rows_of rows = {0};
  rot_refusal no = {0};
  ffi_guard guard;
  SEXP out = R_NilValue;
  ffi_guard_begin(&guard, progress);
  rot_object *scene = computed ? NULL : ffi_sweep_scene(x, &sweep, fault);
  rot_status status = ROT_EVALUE;
  if (scene || computed) status = rot_chunk_run(&plan, first, n, &guard.hooks, &chunk, &no);
  rot_object_free(scene);
  const int refusal = status == ROT_EVALUE;
  if (status == ROT_OK && plan.summed) {
    const sums all = {chunk.summary, chunk.means, chunk.indices};
    status = write_sums(&all, &rows);
  }
  finished done = {&chunk, &rows, plan.summed};
  if (status == ROT_OK) status = ffi_guarded(&guard, take_chunk, &done, &out);
  rot_chunk_free(&chunk);
  free_rows(&rows);
  if (refusal) {
    ffi_guard_end(&guard, ROT_OK);
    return refused(*fault ? fault : no.reason, no.input);
  }
  ffi_guard_end(&guard, status);
  if (status != ROT_OK) Rf_error("internal: %s", rot_status_text(status));
  return out;
}

/* ---- sums of several chunks ------------------------------------------------------------------ */

typedef struct joined {
  rot_tree *summary, *means, *indices;
} joined;

static rot_status add_to(rot_tree *tree, void **node) {
  if (!*node) return ROT_OK;
  const rot_status status = rot_tree_add(tree, *node);
  if (status == ROT_OK) *node = NULL;
  return status;
}

static rot_status add_sums(joined *to, SEXP x) {
  rows_of rows = {0};
  sums part = {0};
  rot_status status = copy_long(x, &rows) ? read_sums(&rows, &part) : ROT_EVALUE;
  void *summary = part.summary, *means = part.means, *indices = part.indices;
  if (status == ROT_OK) status = add_to(to->summary, &summary);
  if (status == ROT_OK) status = add_to(to->means, &means);
  if (status == ROT_OK) status = add_to(to->indices, &indices);
  part = (sums){summary, means, indices};
  free_sums(&part);
  free_rows(&rows);
  return status;
}

/* list of long forms, of neighbouring chunks => that of all; NULL: one is damaged, or rows are
 * missing between them */
SEXP ffi_sweep_join(SEXP list) {
  joined to = {rot_tree_new(&rot_summary_node), rot_tree_new(&rot_means_node),
               rot_tree_new(&rot_indices_node)};
  rot_status status = to.summary && to.means && to.indices ? ROT_OK : ROT_ENOMEM;
  sums all = {0};
  rows_of rows = {0};
  int indexed = 0;
  for (R_xlen_t i = 0; TYPEOF(list) == VECSXP && i < XLENGTH(list) && status == ROT_OK; i++) {
    status = add_sums(&to, VECTOR_ELT(list, i));
  }
  void *node;
  if (status == ROT_OK) status = rot_tree_finish(to.summary, &node);
  if (status == ROT_OK) {
    all.summary = node;
    status = rot_tree_finish(to.means, &node);
  }
  if (status == ROT_OK) {
    all.means = node;
    indexed = rot_tree_finish(to.indices, &node) == ROT_OK;
    if (indexed) all.indices = node;
    status = write_sums(&all, &rows);
  }
  if (to.summary) rot_tree_free(to.summary);
  if (to.means) rot_tree_free(to.means);
  if (to.indices) rot_tree_free(to.indices);
  free_sums(&all);
  SEXP out = R_NilValue;
  if (status == ROT_OK) {
    /* An error of R for want of memory would leak the rows: R keeps them. */
    out = PROTECT(long_form(&rows));
    UNPROTECT(1);
  }
  free_rows(&rows);
  return out;
}

/* ---- figures --------------------------------------------------------------------------------- */

enum { FIGURES = 12 };
static const char *const figure_names[] = {"finite",  "nan",        "plus_inf", "minus_inf",
                                           "mean",    "mean_error", "sd",       "min",
                                           "min_row", "max",        "max_row",  "shift"};

/* (long form, probabilities) => list(column = matrix of figures, low, high = matrices of quantile
 * limits, status = rows by status, failed = rows, failed_status, whole = c(rows, kept, error_above,
 * error_unknown, error_max, error_max_row)); NULL: it is damaged */
SEXP ffi_sweep_figures(SEXP x, SEXP p) {
  static const char *const names[] = {"column", "low",           "high",  "status",
                                      "failed", "failed_status", "whole", ""};
  const double *at = ffi_reals(p, "p", -1);
  const R_xlen_t n_p = XLENGTH(p);
  SEXP columns = ffi_element(x, "columns");
  const int n = (int)ffi_real(columns, "columns");
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), matrix, low, high, dims;
  SET_VECTOR_ELT(out, 0, matrix = Rf_allocMatrix(REALSXP, n, FIGURES));
  SET_VECTOR_ELT(out, 1, low = Rf_allocMatrix(REALSXP, n, (int)n_p));
  SET_VECTOR_ELT(out, 2, high = Rf_allocMatrix(REALSXP, n, (int)n_p));
  double *status = ffi_new_double(out, 3, ROT_SUMMARY_STATUSES);
  double *failed = ffi_new_double(out, 4, ROT_SUMMARY_FAILED);
  double *failed_status = ffi_new_double(out, 5, ROT_SUMMARY_FAILED);
  double *whole = ffi_new_double(out, 6, 6);
  SEXP both = PROTECT(Rf_allocVector(VECSXP, 2));
  SET_VECTOR_ELT(both, 1, dims = Rf_allocVector(STRSXP, FIGURES));
  for (int i = 0; i < FIGURES; i++) SET_STRING_ELT(dims, i, Rf_mkChar(figure_names[i]));
  Rf_setAttrib(matrix, R_DimNamesSymbol, both);
  rows_of rows = {0};
  sums all = {0};
  int ok = copy_long(ffi_element(x, "sums"), &rows) && read_sums(&rows, &all) == ROT_OK &&
           all.summary->n_columns == (size_t)n && all.means->n_columns == (size_t)n;
  for (int c = 0; c < n && ok; c++) {
    const rot_summary_column *of = &all.summary->column[c];
    double mean, error;
    rot_means_estimate(all.means, (size_t)c, &mean, &error);
    const int any = of->finite > 0;
    const double figures[FIGURES] = {(double)of->finite,
                                     (double)of->nan,
                                     (double)of->plus_inf,
                                     (double)of->minus_inf,
                                     rot_summary_mean(all.summary, (size_t)c),
                                     error,
                                     rot_summary_sd(all.summary, (size_t)c),
                                     any ? of->minimum : NAN,
                                     any ? (double)of->minimum_row + 1.0 : NAN,
                                     any ? of->maximum : NAN,
                                     any ? (double)of->maximum_row + 1.0 : NAN,
                                     of->shift};
    for (int i = 0; i < FIGURES; i++) REAL(matrix)[c + i * n] = figures[i];
    for (R_xlen_t k = 0; k < n_p; k++) {
      rot_summary_quantile(all.summary, (size_t)c, at[k], &REAL(low)[c + k * n],
                           &REAL(high)[c + k * n]);
    }
  }
  if (ok) {
    const rot_summary *s = all.summary;
    for (int i = 0; i < ROT_SUMMARY_STATUSES; i++) status[i] = (double)s->rows_with_status[i];
    for (size_t i = 0; i < ROT_SUMMARY_FAILED; i++) {
      failed[i] = i < s->n_failed ? (double)s->failed_row[i] + 1.0 : NAN;
      failed_status[i] = i < s->n_failed ? s->failed_status[i] : NAN;
    }
    const double of_all[] = {(double)s->span.rows,
                             (double)s->kept,
                             (double)s->error_above,
                             (double)s->error_unknown,
                             s->has_error_max ? s->error_max : NAN,
                             s->has_error_max ? (double)s->error_max_row + 1.0 : NAN};
    memcpy(whole, of_all, sizeof of_all);
  }
  free_sums(&all);
  free_rows(&rows);
  UNPROTECT(2);
  return ok ? out : R_NilValue;
}

/* (long form, column from 0) => matrix(low, high, count) of its buckets; NULL: it is damaged */
SEXP ffi_sweep_buckets(SEXP x, SEXP column) {
  const double c = ffi_real(column, "column");
  rows_of rows = {0};
  sums all = {0};
  int ok = copy_long(x, &rows) && read_sums(&rows, &all) == ROT_OK && c >= 0.0 &&
           c < (double)all.summary->n_columns;
  const size_t n = ok ? all.summary->column[(size_t)c].buckets.n : 0;
  double *low = malloc((3 * n + 1) * sizeof *low);
  ok = ok && low && n <= 100000000;
  if (ok) rot_summary_buckets(all.summary, (size_t)c, low, low + n, low + 2 * n);
  free_sums(&all);
  free_rows(&rows);
  SEXP out = R_NilValue;
  if (ok) {
    out = PROTECT(Rf_allocMatrix(REALSXP, (int)n, 3));
    memcpy(REAL(out), low, 3 * n * sizeof *low);
    UNPROTECT(1);
  }
  free(low);
  return out;
}

/* (long form, column from 0) => matrix(first, first_error, total, total_error), a row for each
 * input, and the mean, the variance and the points as attributes' list; NULL: no indices */
SEXP ffi_sweep_indices(SEXP x, SEXP column) {
  const double c = ffi_real(column, "column");
  rows_of rows = {0};
  sums all = {0};
  const int ok = copy_long(x, &rows) && read_sums(&rows, &all) == ROT_OK && all.indices &&
                 c >= 0.0 && c < (double)all.indices->n_columns;
  const size_t n = ok ? all.indices->n_inputs : 0;
  double *first = malloc((4 * n + 1) * sizeof *first);
  rot_indices_info info;
  rot_status status = ok && first ? rot_indices_estimate(all.indices, (size_t)c, first, first + n,
                                                         first + 2 * n, first + 3 * n, &info)
                                  : ROT_EVALUE;
  free_sums(&all);
  free_rows(&rows);
  SEXP out = R_NilValue;
  if (status == ROT_OK) {
    out = PROTECT(Rf_allocMatrix(REALSXP, (int)n, 4));
    memcpy(REAL(out), first, 4 * n * sizeof *first);
    UNPROTECT(1);
  }
  free(first);
  return out;
}
