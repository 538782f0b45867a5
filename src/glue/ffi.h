/* Shared by the glue: the unwind guard, polling, columns, and the declarations of the entries.
 *
 * The glue reads arguments, allocates results, calls the core and translates its results. R checks
 * the values before; the glue checks types and lengths only, so that a wrong .Call is an R error
 * and never a crash. */
#ifndef FFI_H
#define FFI_H

#define R_NO_REMAP
#include <R.h>
#include <Rinternals.h>
#include <setjmp.h>

#include "ground/column.h"
#include "ground/status.h"

/* ---- the unwind guard ------------------------------------------------------------------------
 *
 * While the core is on the stack, calls that may jump (by an R error, a condition, an interrupt, a
 * time limit) run inside ffi_guarded(). It catches the jump, the core returns ROT_EUNWIND and frees
 * its memory, and ffi_guard_end() continues the jump. */
typedef struct ffi_guard {
  SEXP token;
  jmp_buf landing;
  SEXP progress;    /* an R function of the fraction done, or NULL */
  double next_poll; /* monotonic seconds */
  rot_hooks hooks;  /* pass &guard.hooks to the core */
} ffi_guard;

/* Protects one object; ffi_guard_end() unprotects it. */
void ffi_guard_begin(ffi_guard *guard, SEXP progress);
rot_status ffi_guarded(ffi_guard *guard, SEXP (*body)(void *), void *data, SEXP *value);
void ffi_guard_end(ffi_guard *guard, rot_status status);

/* ---- arguments and results ------------------------------------------------------------------ */

double ffi_real(SEXP x, const char *what);
const double *ffi_reals(SEXP x, const char *what, R_xlen_t length);
const char *ffi_text(SEXP x, const char *what);
/* The element of that name, R_NilValue where there is none; the same as a number, as numbers. */
SEXP ffi_element(SEXP list, const char *name);
double ffi_number_of(SEXP list, const char *name);
const double *ffi_numbers_of(SEXP list, const char *name, R_xlen_t length);
/* A column of length 1 or *n; *n grows from 1 to the first length that is not. */
rot_column ffi_column(SEXP x, const char *what, R_xlen_t *n);
/* The n columns of a list, and the rows that they make. Row i; 0 where a value is missing. */
R_xlen_t ffi_columns_of(SEXP list, int n, rot_column in[]);
int ffi_row_of(const rot_column in[], int n, R_xlen_t i, double x[]);
SEXP ffi_new_column(R_xlen_t rows);
SEXP ffi_new_flags(R_xlen_t rows); /* logical */
/* A list of `n` real columns with `rows` rows, named; protects one object. */
SEXP ffi_columns(int n, const char *const names[], R_xlen_t rows, double *columns[]);
/* A vector of these numbers; a list of such vectors, named up to a "" (or NULL: without names). */
SEXP ffi_numbers(int n, const double x[]);
typedef struct ffi_vector {
  int n;
  const double *x;
} ffi_vector;
SEXP ffi_vectors(int n, const char *const names[], const ffi_vector parts[]);

/* ---- entries -------------------------------------------------------------------------------- */

#define FFI_ARGS_0 void
#define FFI_ARGS_1 SEXP
#define FFI_ARGS_2 SEXP, SEXP
#define FFI_ARGS_3 SEXP, SEXP, SEXP
#define FFI_ARGS_4 SEXP, SEXP, SEXP, SEXP
#define FFI_ARGS_5 SEXP, SEXP, SEXP, SEXP, SEXP
#define FFI_ARGS_6 SEXP, SEXP, SEXP, SEXP, SEXP, SEXP
#define FFI_ARGS_7 SEXP, SEXP, SEXP, SEXP, SEXP, SEXP, SEXP
#define FFI_ARGS_8 SEXP, SEXP, SEXP, SEXP, SEXP, SEXP, SEXP, SEXP

#define X(name, n) SEXP name(FFI_ARGS_##n);
#include "glue/entries.h"
#undef X

#endif
