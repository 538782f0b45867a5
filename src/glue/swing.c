/* For R: rows and extremes of oscillations, with derivatives; noise of residuals, whitening. */
#include <string.h>

#include "glue/ffi.h"
#include "measure/swing.h"
#include "maths/whiten.h"

enum { P = ROT_SWING_PARAMETERS };

static rot_swing read_swing(SEXP parameters, SEXP kind) {
  const double *flags = ffi_reals(kind, "kind", 2);
  rot_swing swing = {{0}, flags[0] > 0.0, flags[1] > 0.0};
  memcpy(swing.p, ffi_reals(parameters, "parameters", P), sizeof swing.p);
  return swing;
}

/* => values, a row of P derivatives for each; kind: c(spring, rate) */
SEXP ffi_swing_rows(SEXP parameters, SEXP kind, SEXP start, SEXP times) {
  static const char *const names[] = {"value", "derivative", "status", ""};
  const rot_swing swing = read_swing(parameters, kind);
  const double *t = ffi_reals(times, "times", -1);
  const R_xlen_t n = XLENGTH(times);
  double *x = (double *)R_alloc((size_t)(n * (1 + P)) + 1, sizeof *x);
  ffi_guard guard;
  const double from = ffi_real(start, "start");
  ffi_guard_begin(&guard, R_NilValue);
  const rot_status status = rot_swing_rows(&swing, from, (size_t)n, t, &guard.hooks, x, x + n);
  ffi_guard_end(&guard, status);
  const double code = (double)status;
  const int rows = code == 0.0 ? (int)n : 0;
  const ffi_vector parts[] = {{rows, x}, {rows * P, x + n}, {1, &code}};
  return ffi_vectors(3, names, parts);
}

/* => times, values and derivatives of at most `max` extremes; span: c(start, end) */
SEXP ffi_swing_extremes(SEXP parameters, SEXP kind, SEXP span, SEXP max) {
  static const char *const names[] = {"time_s", "value", "derivative", "status", ""};
  const rot_swing swing = read_swing(parameters, kind);
  const double *ends = ffi_reals(span, "span", 2);
  const size_t room = (size_t)ffi_real(max, "most");
  double *x = (double *)R_alloc(room * (2 + P) + 1, sizeof *x);
  size_t n = 0;
  ffi_guard guard;
  ffi_guard_begin(&guard, R_NilValue);
  const rot_status status = rot_swing_extremes(&swing, ends[0], ends[1], room, &guard.hooks, &n, x,
                                               x + room, x + 2 * room);
  ffi_guard_end(&guard, status);
  const double code = (double)status;
  const int rows = code == 0.0 ? (int)n : 0;
  const ffi_vector parts[] = {{rows, x}, {rows, x + room}, {rows * P, x + 2 * room}, {1, &code}};
  return ffi_vectors(4, names, parts);
}

/* residuals => c(tau, white fraction, gain, tau at its limit, status) of their noise. columns: a
 * row of p numbers per time, as a vector; limits: c(max tau, threshold). */
SEXP ffi_noise(SEXP times, SEXP columns, SEXP residual, SEXP limits) {
  const double *t = ffi_reals(times, "times", -1), *limit = ffi_reals(limits, "limits", 2);
  const R_xlen_t n = XLENGTH(times);
  const double *r = ffi_reals(residual, "residual", n);
  const R_xlen_t p = n > 0 ? XLENGTH(columns) / n : 0;
  const double *j = ffi_reals(columns, "columns", n * p);
  rot_reml out;
  ffi_guard guard;
  ffi_guard_begin(&guard, R_NilValue);
  const rot_status status =
      rot_whiten_reml((size_t)n, t, (size_t)p, j, r, limit[0], limit[1], NULL, &guard.hooks, &out);
  ffi_guard_end(&guard, status);
  if (status == ROT_ENOMEM) Rf_error("out of memory");
  const double numbers[] = {out.noise.tau_s, out.noise.white, out.gain, (double)out.at_cap,
                            (double)status};
  return ffi_numbers(5, numbers);
}

/* columns as for ffi_noise(), at most ROT_WHITEN_COLUMNS => whitened; noise: c(tau, white fraction)
 */
SEXP ffi_whiten(SEXP times, SEXP columns, SEXP noise) {
  const double *t = ffi_reals(times, "times", -1), *x = ffi_reals(noise, "noise", 2);
  const R_xlen_t n = XLENGTH(times), size = XLENGTH(columns);
  const rot_noise law = {x[0], x[1]};
  SEXP out = PROTECT(Rf_allocVector(REALSXP, size));
  memcpy(REAL(out), ffi_reals(columns, "columns", size), (size_t)size * sizeof(double));
  const size_t count = n > 0 ? (size_t)(size / n) : 0;
  if (size != (R_xlen_t)count * n ||
      rot_whiten(&law, (size_t)n, t, count, REAL(out), NULL) != ROT_OK)
    Rf_error("internal: a wrong number of columns");
  UNPROTECT(1);
  return out;
}
