#define _DEFAULT_SOURCE /* clock_gettime, madvise */

#include "glue/ffi.h"

#include <stdint.h>
#include <string.h>
#include <time.h>

#ifdef __linux__
#include <sys/mman.h>
#endif

/* ---- the unwind guard ----------------------------------------------------------------------- */

static double monotonic_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void land(void *data, Rboolean jump) {
  ffi_guard *guard = data;
  if (jump) longjmp(guard->landing, 1);
}

rot_status ffi_guarded(ffi_guard *guard, SEXP (*body)(void *), void *data, SEXP *value) {
  if (setjmp(guard->landing)) return ROT_EUNWIND;
  SEXP result = R_UnwindProtect(body, data, land, guard, guard->token);
  SETCAR(guard->token, R_NilValue); /* else the token keeps the result alive */
  if (value) *value = result;
  return ROT_OK;
}

typedef struct poll_call {
  SEXP progress;
  double fraction;
} poll_call;

/* R checks the limits of setTimeLimit() in one of six calls. If that call happens in the progress
 * display, the display catches the error and the run continues. */
enum { LOOKS = 6 };

static SEXP poll_r(void *data) {
  const poll_call *poll = data;
  for (int k = 0; k < LOOKS; k++) R_CheckUserInterrupt();
  if (!Rf_isNull(poll->progress)) {
    SEXP call = PROTECT(Rf_lang2(poll->progress, PROTECT(Rf_ScalarReal(poll->fraction))));
    Rf_eval(call, R_GlobalEnv);
    UNPROTECT(2);
  }
  return R_NilValue;
}

/* Polls R at most 20 times per second: in some front ends each poll would cost 15 times the work.
 */
static rot_status poll(void *ctx, double fraction) {
  ffi_guard *guard = ctx;
  const double now = monotonic_s();
  if (now < guard->next_poll) return ROT_OK;
  poll_call data = {guard->progress, fraction};
  rot_status status = ffi_guarded(guard, poll_r, &data, NULL);
  guard->next_poll = monotonic_s() + 0.05;
  return status;
}

void ffi_guard_begin(ffi_guard *guard, SEXP progress) {
  guard->token = PROTECT(R_MakeUnwindCont());
  guard->progress = progress;
  guard->next_poll = monotonic_s() + 0.05;
  guard->hooks.poll = poll;
  guard->hooks.ctx = guard;
}

void ffi_guard_end(ffi_guard *guard, rot_status status) {
  if (status == ROT_EUNWIND) R_ContinueUnwind(guard->token);
  UNPROTECT(1);
}

/* ---- arguments and results ------------------------------------------------------------------ */

const double *ffi_reals(SEXP x, const char *what, R_xlen_t length) {
  if (TYPEOF(x) != REALSXP || (length >= 0 && XLENGTH(x) != length)) {
    Rf_error("internal: `%s` is not a double vector of the right length", what);
  }
  return REAL_RO(x);
}

double ffi_real(SEXP x, const char *what) { return ffi_reals(x, what, 1)[0]; }

const char *ffi_text(SEXP x, const char *what) {
  if (TYPEOF(x) != STRSXP || XLENGTH(x) != 1) Rf_error("internal: `%s` is not a string", what);
  return CHAR(STRING_ELT(x, 0));
}

SEXP ffi_element(SEXP list, const char *name) {
  SEXP names = TYPEOF(list) == VECSXP ? Rf_getAttrib(list, R_NamesSymbol) : R_NilValue;
  const R_xlen_t n = TYPEOF(names) == STRSXP ? XLENGTH(names) : 0;
  for (R_xlen_t i = 0; i < n; i++) {
    if (!strcmp(CHAR(STRING_ELT(names, i)), name)) return VECTOR_ELT(list, i);
  }
  return R_NilValue;
}

double ffi_number_of(SEXP list, const char *name) {
  return ffi_real(ffi_element(list, name), name);
}

const double *ffi_numbers_of(SEXP list, const char *name, R_xlen_t length) {
  return ffi_reals(ffi_element(list, name), name, length);
}

rot_column ffi_column(SEXP x, const char *what, R_xlen_t *n) {
  rot_column column = {ffi_reals(x, what, -1), 1};
  const R_xlen_t length = XLENGTH(x);
  if (length == 1) {
    column.step = 0;
  } else if (*n == 1) {
    *n = length;
  } else if (*n != length) {
    Rf_error("internal: `%s` does not recycle", what);
  }
  return column;
}

R_xlen_t ffi_columns_of(SEXP list, int n, rot_column in[]) {
  R_xlen_t rows = 1;
  if (TYPEOF(list) != VECSXP || XLENGTH(list) != n) Rf_error("internal: `columns`");
  for (int j = 0; j < n; j++) in[j] = ffi_column(VECTOR_ELT(list, j), "columns", &rows);
  return rows;
}

int ffi_row_of(const rot_column in[], int n, R_xlen_t i, double x[]) {
  int known = 1;
  for (int j = 0; j < n; j++) {
    x[j] = rot_at(in[j], (size_t)i);
    known &= !ISNAN(x[j]);
  }
  return known;
}

/* Requests huge pages for the part of a large column that they can cover. Page faults at first
 * access are half the time of a large table (1e7 rolling rows: 0.15 of 0.28 s). */
static void use_huge_pages(void *start, size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  const uintptr_t huge = (uintptr_t)1 << 21;
  const uintptr_t begin = ((uintptr_t)start + huge - 1) & ~(huge - 1);
  const uintptr_t end = ((uintptr_t)start + bytes) & ~(huge - 1);
  if (end > begin) (void)madvise((void *)begin, end - begin, MADV_HUGEPAGE);
#else
  (void)start, (void)bytes;
#endif
}

SEXP ffi_new_column(R_xlen_t rows) {
  SEXP column = Rf_allocVector(REALSXP, rows);
  use_huge_pages(REAL(column), (size_t)rows * sizeof(double));
  return column;
}

SEXP ffi_new_flags(R_xlen_t rows) {
  SEXP column = Rf_allocVector(LGLSXP, rows);
  use_huge_pages(LOGICAL(column), (size_t)rows * sizeof(int));
  return column;
}

SEXP ffi_numbers(int n, const double x[]) {
  SEXP out = Rf_allocVector(REALSXP, n);
  for (int i = 0; i < n; i++) REAL(out)[i] = x[i];
  return out;
}

SEXP ffi_vectors(int n, const char *const names[], const ffi_vector parts[]) {
  SEXP out = PROTECT(names ? Rf_mkNamed(VECSXP, (const char **)names) : Rf_allocVector(VECSXP, n));
  for (int i = 0; i < n; i++) SET_VECTOR_ELT(out, i, ffi_numbers(parts[i].n, parts[i].x));
  UNPROTECT(1);
  return out;
}

SEXP ffi_columns(int n, const char *const names[], R_xlen_t rows, double *columns[]) {
  SEXP list = PROTECT(Rf_allocVector(VECSXP, n)), text = PROTECT(Rf_allocVector(STRSXP, n));
  for (int i = 0; i < n; i++) {
    SET_STRING_ELT(text, i, Rf_mkChar(names[i]));
    SET_VECTOR_ELT(list, i, ffi_new_column(rows));
    columns[i] = REAL(VECTOR_ELT(list, i));
  }
  Rf_setAttrib(list, R_NamesSymbol, text);
  UNPROTECT(1);
  return list;
}
