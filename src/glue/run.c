#include "glue/run.h"

#include <string.h>

SEXP ffi_named(size_t n, const char *const names[], const double values[]) {
  SEXP out = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t)n));
  SEXP text = PROTECT(Rf_allocVector(STRSXP, (R_xlen_t)n));
  for (size_t i = 0; i < n; i++) {
    REAL(out)[i] = values ? values[i] : NA_REAL;
    SET_STRING_ELT(text, (R_xlen_t)i, Rf_mkChar(names[i]));
  }
  Rf_setAttrib(out, R_NamesSymbol, text);
  UNPROTECT(2);
  return out;
}

double *ffi_new_double(SEXP list, R_xlen_t i, R_xlen_t rows) {
  SEXP column = ffi_new_column(rows);
  SET_VECTOR_ELT(list, i, column);
  return REAL(column);
}

int *ffi_new_int(SEXP list, R_xlen_t i, R_xlen_t rows) {
  SEXP column = ffi_new_flags(rows);
  SET_VECTOR_ELT(list, i, column);
  return LOGICAL(column);
}

SEXP ffi_info(const rot_info *info) {
  const char *names[] = {"kind",     "text",      "time_s", "rows_done", "steps",
                         "rejected", "rhs_calls", "error",  "tolerance", "method",
                         "errors",   "sizes",     "",       ""};
  const size_t n = info->n_measures;
  const double numbers[] = {info->time_s,           (double)info->rows_done, (double)info->steps,
                            (double)info->rejected, (double)info->rhs_calls, rot_info_error(info),
                            info->tolerance};
  double errors[ROT_MAX_MEASURES], sizes[ROT_MAX_MEASURES];
  for (size_t i = 0; i < n; i++) {
    errors[i] = info->measure[i].error;
    sizes[i] = info->measure[i].largest;
  }
  if (info->step_s > 0.0) names[12] = "step_s";
  SEXP list = PROTECT(Rf_mkNamed(VECSXP, names));
  SET_VECTOR_ELT(list, 0, Rf_mkString(rot_status_kind(info->status)));
  SET_VECTOR_ELT(list, 1, Rf_mkString(rot_status_text(info->status)));
  for (int i = 0; i < 7; i++) SET_VECTOR_ELT(list, i + 2, Rf_ScalarReal(numbers[i]));
  SET_VECTOR_ELT(list, 9, Rf_mkString(rot_method_name(info->method)));
  SET_VECTOR_ELT(list, 10, ffi_named(n, info->measure_names, errors));
  SET_VECTOR_ELT(list, 11, ffi_named(n, info->measure_names, sizes));
  if (info->step_s > 0.0) SET_VECTOR_ELT(list, 12, Rf_ScalarReal(info->step_s));
  UNPROTECT(1);
  return list;
}

SEXP ffi_error_figure(SEXP errors, SEXP sizes) {
  const double *error = ffi_reals(errors, "errors", -1);
  const double *size = ffi_reals(sizes, "sizes", XLENGTH(errors));
  return Rf_ScalarReal(rot_error_figure((size_t)XLENGTH(errors), error, size));
}

void ffi_run_begin(ffi_run *run, SEXP progress) {
  static const char *const names[] = {"columns", "info", "ledger", "events", "event_rows", ""};
  run->out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  run->beyond = 0;
  run->events = (rot_events){0};
  ffi_guard_begin(&run->guard, progress);
}

SEXP ffi_run_columns(const ffi_run *run, const char *const names[]) {
  SEXP list = Rf_mkNamed(VECSXP, (const char **)names);
  SET_VECTOR_ELT(run->out, FFI_COLUMNS, list);
  return list;
}

/* Report and events => elements of run->out; may jump. */
static SEXP finish(void *data) {
  const char *names[] = {"time_s", "event", "", ""};
  const ffi_run *run = data;
  const R_xlen_t n = (R_xlen_t)run->events.count;
  SEXP info = ffi_info(&run->info);
  SET_VECTOR_ELT(run->out, FFI_INFO, info);
  if (run->beyond) SET_VECTOR_ELT(info, 7, Rf_ScalarReal(R_PosInf));
  if (n == 0) return R_NilValue;
  for (R_xlen_t i = 0; i < n; i++) {
    if (run->events.place[i]) names[2] = "place";
  }
  SEXP list = Rf_mkNamed(VECSXP, names), event, place;
  SET_VECTOR_ELT(run->out, FFI_EVENTS, list);
  memcpy(ffi_new_double(list, 0, n), run->events.time_s, (size_t)n * sizeof(double));
  SET_VECTOR_ELT(list, 1, event = Rf_allocVector(STRSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    SET_STRING_ELT(event, i, Rf_mkChar(rot_event_name(run->events.event[i])));
  }
  if (!names[2][0]) return R_NilValue;
  SET_VECTOR_ELT(list, 2, place = Rf_allocVector(INTSXP, n));
  memcpy(INTEGER(place), run->events.place, (size_t)n * sizeof(int));
  return R_NilValue;
}

/* Allocations may jump: they run under the guard if there are events to be freed. */
SEXP ffi_run_end(ffi_run *run, rot_status status) {
  if (status != ROT_EUNWIND && run->events.room) {
    status = ffi_guarded(&run->guard, finish, run, NULL);
  } else if (status != ROT_EUNWIND) {
    finish(run);
  }
  rot_events_free(&run->events);
  ffi_guard_end(&run->guard, status);
  UNPROTECT(1);
  return run->out;
}
