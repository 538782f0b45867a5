/* For R: rows of coast-downs with derivatives; fits. */
#include "measure/coast.h"

#include <string.h>

#include "glue/ffi.h"
#include "measure/coast_fit.h"

enum { P = ROT_COAST_PARAMETERS, ALL = ROT_COAST_ALL };

static rot_coast_load read_load(SEXP list) {
  const double *x = ffi_numbers_of(list, "load", 3);
  const R_xlen_t n = XLENGTH(ffi_element(list, "step_s"));
  return (rot_coast_load){x[0],
                          x[1],
                          x[2] > 0.0,
                          (size_t)n,
                          ffi_numbers_of(list, "step_s", n),
                          ffi_numbers_of(list, "step_ratio", n)};
}

/* => theta, omega and their derivatives, P numbers for each time */
SEXP ffi_coast_rows(SEXP list, SEXP parameters, SEXP start, SEXP times) {
  static const char *const names[] = {"theta", "omega", "d_theta", "d_omega", "status", ""};
  const rot_coast_load load = read_load(list);
  const double *t = ffi_reals(times, "times", -1);
  const R_xlen_t n = XLENGTH(times);
  double *x = (double *)R_alloc((size_t)(n * (2 + 2 * P)) + 1, sizeof *x);
  const double status = (double)rot_coast_rows(&load, ffi_reals(parameters, "parameters", P),
                                               ffi_real(start, "start"), (size_t)n, t, x, x + n,
                                               x + 2 * n, x + (2 + P) * n);
  const int rows = (int)n;
  const ffi_vector parts[] = {
      {rows, x}, {rows, x + n}, {rows * P, x + 2 * n}, {rows * P, x + (2 + P) * n}, {1, &status}};
  return ffi_vectors(5, names, parts);
}

/* => unbounded fit, then fit with losses >= 0. `search`: 1 to estimate the noise, 0 to use that of
 * the list. */
SEXP ffi_coast_fit(SEXP list, SEXP search) {
  static const char *const names[] = {"p",       "covariance",      "numbers",
                                      "bounded", "bounded_numbers", "residual",
                                      "factor",  "white",           ""};
  rot_coast_record record;
  SEXP times = ffi_element(list, "time_s");
  const R_xlen_t n = XLENGTH(times);
  const double *wanted = ffi_numbers_of(list, "fitted", ALL);
  const double *noise = ffi_numbers_of(list, "noise", 2);
  int fitted[ALL], at_bound[3];
  double *residual = (double *)R_alloc((size_t)(2 * n) + 1, sizeof *residual);
  SEXP weight = ffi_element(list, "weight");
  rot_coast_fit fit, bounded;
  ffi_guard guard;
  memset(&fit, 0, sizeof fit);
  record.kind = (rot_coast_kind)ffi_number_of(list, "kind");
  record.n = (size_t)n;
  record.t = ffi_reals(times, "time_s", -1);
  record.y = ffi_numbers_of(list, "value", n);
  record.load = read_load(list);
  record.weight = Rf_isNull(weight) ? NULL : ffi_reals(weight, "weight", n);
  memcpy(fit.p, ffi_numbers_of(list, "start", ALL), sizeof fit.p);
  for (int i = 0; i < ALL; i++) fitted[i] = wanted[i] > 0.0;
  fit.reml.noise = (rot_noise){noise[0], noise[1]};
  const double threshold = ffi_number_of(list, "threshold");
  const int searches = ffi_real(search, "search") > 0.0;
  ffi_guard_begin(&guard, R_NilValue);
  rot_status status = searches ? rot_coast_fit_noise(&record, fitted, threshold, &guard.hooks, &fit,
                                                     residual, residual + n)
                               : rot_coast_solve(&record, fitted, &guard.hooks, &fit);
  bounded = fit;
  if (status == ROT_OK) {
    status = rot_coast_bound(&record, fitted, &guard.hooks, &bounded, at_bound);
  }
  ffi_guard_end(&guard, status);
  if (status == ROT_ENOMEM) Rf_error("out of memory");
  const double numbers[] = {(double)status,
                            fit.reml.noise.tau_s,
                            fit.reml.noise.white,
                            fit.reml.gain,
                            fit.reml.logdet,
                            (double)fit.reml.at_cap,
                            fit.squares,
                            fit.sigma,
                            fit.condition,
                            (double)fit.free,
                            (double)fit.iterations,
                            fit.runout_f,
                            (double)fit.runout_columns,
                            fit.runout_size[0],
                            fit.runout_size[1]};
  const double other[] = {bounded.squares, bounded.sigma};
  const ffi_vector parts[] = {{ALL, fit.p},
                              {ALL * ALL, fit.covariance[0]},
                              {15, numbers},
                              {ALL, bounded.p},
                              {2, other},
                              {searches && status == ROT_OK ? (int)n : 0, residual},
                              {ALL * ALL, fit.factor[0]},
                              {searches && status == ROT_OK ? (int)n : 0, residual + n}};
  return ffi_vectors(8, names, parts);
}
