/* Shared by the entries that run a motion under the guard: list(columns, info, ledger, events).
 *
 *   ffi_run_begin(&run, progress);
 *   SEXP columns = ffi_run_columns(&run, names);
 *   ROT_..._COLUMNS(FFI_COLUMN_NEW)
 *   return ffi_run_end(&run, rot_...(..., &out, &run.guard.hooks, &run.info)); */
#ifndef FFI_RUN_H
#define FFI_RUN_H

#include "glue/ffi.h"
#include "engine/events.h"

/* Elements of run.out; the last one only in some runs. */
enum { FFI_COLUMNS, FFI_INFO, FFI_LEDGER, FFI_EVENTS, FFI_EVENT_ROWS };

typedef struct ffi_run {
  ffi_guard guard;
  SEXP out; /* protected */
  rot_info info;
  rot_events events; /* freed by ffi_run_end() */
  int beyond;        /* 1: a column is not finite, the error figure is Inf */
} ffi_run;

/* Begins the guard; protects run->out. */
void ffi_run_begin(ffi_run *run, SEXP progress);
/* names, ending with "" => named list of columns, to be filled */
SEXP ffi_run_columns(const ffi_run *run, const char *const names[]);
/* Adds report and events to run->out and ends the guard; returns run->out, unprotected. */
SEXP ffi_run_end(ffi_run *run, rot_status status);

/* report => list */
SEXP ffi_info(const rot_info *info);
/* => named double vector; NA for NULL values */
SEXP ffi_named(size_t n, const char *const names[], const double values[]);
/* Sets element i of a list to a new column of doubles; returns its address. */
double *ffi_new_double(SEXP list, R_xlen_t i, R_xlen_t rows);
/* The same for a column of logicals. */
int *ffi_new_int(SEXP list, R_xlen_t i, R_xlen_t rows);

/* For the lists of columns X(type, name) and ledgers X(name) of the core: columns[at++] becomes
 * out.name. */
#define FFI_COLUMN_NAME(type, name) #name,
#define FFI_COLUMN_NEW(type, name)  out.name = ffi_new_##type(columns, at++, rows);
#define FFI_NAME(name)              #name,
#define FFI_VALUE(name)             ledger.name,
#define FFI_LENGTH(array)           (sizeof(array) / sizeof *(array))

#endif
