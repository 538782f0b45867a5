/* Shared by the glue: the unwind guard, polling, columns, and the declarations of the entries.
 *
 * The glue reads arguments, allocates results, calls the core and translates its results. Values
 * are checked in R; the glue checks types and lengths only, so that an invalid .Call is an R error
 * and not a crash. */
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
  SEXP token;       /* continuation of R_UnwindProtect() */
  jmp_buf landing;  /* in ffi_guarded() */
  SEXP progress;    /* an R function of the fraction done, or NULL */
  double next_poll; /* monotonic time, s */
  rot_hooks hooks;  /* pass &guard.hooks to the core */
} ffi_guard;

/* Protects one object; ffi_guard_end() unprotects it. */
void ffi_guard_begin(ffi_guard *guard, SEXP progress);
/* (body, data) => *value (or NULL); ROT_EUNWIND if the body jumped */
rot_status ffi_guarded(ffi_guard *guard, SEXP (*body)(void *), void *data, SEXP *value);
/* Continues the jump for ROT_EUNWIND. */
void ffi_guard_end(ffi_guard *guard, rot_status status);

/* ---- arguments and results ------------------------------------------------------------------
 *
 * R error if an argument has another type or length; `what`: its name in the message. */

/* vector of one double => number */
double ffi_real(SEXP x, const char *what);
/* vector of `length` doubles (-1: any) => its numbers */
const double *ffi_reals(SEXP x, const char *what, R_xlen_t length);
/* one string => text */
const char *ffi_text(SEXP x, const char *what);
/* (list, name) => element, R_NilValue if there is none */
SEXP ffi_element(SEXP list, const char *name);
/* (list, name) => element as a number */
double ffi_number_of(SEXP list, const char *name);
/* (list, name) => element as `length` numbers */
const double *ffi_numbers_of(SEXP list, const char *name, R_xlen_t length);
/* vector => column, recycled from length 1 to *n; *n = 1 is set to the length of the column */
rot_column ffi_column(SEXP x, const char *what, R_xlen_t *n);
/* list of n vectors => columns; returns their common number of rows */
R_xlen_t ffi_columns_of(SEXP list, int n, rot_column in[]);
/* columns => row i in x; returns 0 if a value is missing */
int ffi_row_of(const rot_column in[], int n, R_xlen_t i, double x[]);
/* => new double vector, unprotected */
SEXP ffi_new_column(R_xlen_t rows);
/* => new logical vector, unprotected */
SEXP ffi_new_flags(R_xlen_t rows);
/* => named list of n double columns, their addresses; protects one object */
SEXP ffi_columns(int n, const char *const names[], R_xlen_t rows, double *columns[]);
/* n numbers => double vector */
SEXP ffi_numbers(int n, const double x[]);
typedef struct ffi_vector {
  int n;
  const double *x;
} ffi_vector;
/* n vectors => list; `names` ends with "", or NULL: without names */
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
