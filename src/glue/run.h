/* Shared by the entries that run a motion: list(columns, info, ledger, events) under the guard.
 *
 *   ffi_run_begin(&run, progress);
 *   SEXP columns = ffi_run_columns(&run, names);
 *   ROT_..._COLUMNS(FFI_COLUMN_NEW)
 *   return ffi_run_end(&run, rot_...(..., &out, &run.guard.hooks, &run.info)); */
#ifndef FFI_RUN_H
#define FFI_RUN_H

#include "glue/ffi.h"
#include "engine/events.h"

/* Elements of run.out; the last one of some runs alone. */
enum { FFI_COLUMNS, FFI_INFO, FFI_LEDGER, FFI_EVENTS, FFI_EVENT_ROWS };

typedef struct ffi_run {
  ffi_guard guard;
  SEXP out; /* protected */
  rot_info info;
  rot_events events; /* freed by ffi_run_end() */
  int beyond;        /* a column is not finite: the run has no error figure */
} ffi_run;

void ffi_run_begin(ffi_run *run, SEXP progress);
/* The named list of columns, to be filled; `names` ends with "". */
SEXP ffi_run_columns(const ffi_run *run, const char *const names[]);
/* Ends the guard. The report, and the events if there are any, are made under it. */
SEXP ffi_run_end(ffi_run *run, rot_status status);

SEXP ffi_info(const rot_info *info);
/* A named double vector; NA where `values` is NULL. */
SEXP ffi_named(size_t n, const char *const names[], const double values[]);
/* Element i of a list: a new column of doubles, of logicals. */
double *ffi_new_double(SEXP list, R_xlen_t i, R_xlen_t rows);
int *ffi_new_int(SEXP list, R_xlen_t i, R_xlen_t rows);

/* For the lists of columns X(type, name) and ledgers X(name) of the core: columns[at++] becomes
 * out.name. */
#define FFI_COLUMN_NAME(type, name) #name,
#define FFI_COLUMN_NEW(type, name)  out.name = ffi_new_##type(columns, at++, rows);
#define FFI_NAME(name)              #name,
#define FFI_VALUE(name)             ledger.name,
#define FFI_LENGTH(array)           (sizeof(array) / sizeof *(array))

#endif
