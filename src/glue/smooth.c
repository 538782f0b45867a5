/* For R: smoothing of records: fits, rows, breaks, random draws. */
#include "measure/smooth.h"

#include <math.h>
#include <string.h>

#include "glue/ffi.h"
#include "measure/smooth_breaks.h"

enum { ANGLE = ROT_SMOOTH_ANGLE, RATE = ROT_SMOOTH_RATE, CHANNELS = ROT_SMOOTH_CHANNELS };

static const int *segments_of(SEXP list, R_xlen_t n) {
  SEXP x = ffi_element(list, "segment");
  if (Rf_isNull(x)) return NULL;
  if (TYPEOF(x) != INTSXP || XLENGTH(x) != n) Rf_error("internal: `segment`");
  return INTEGER_RO(x);
}

/* list(time_s, theta, omega, w_theta, w_omega, segment, floor, slow, clock, slow_channel) =>
 * record. theta, omega, slow may be NULL; the weights are copied; slow_channel: 0 angles, 1 rates.
 */
static rot_smooth_record read_record(SEXP list) {
  static const char *const values[] = {"theta", "omega"}, *const weights[] = {"w_theta", "w_omega"};
  rot_smooth_record record;
  SEXP time = ffi_element(list, "time_s");
  const R_xlen_t n = XLENGTH(time);
  const double *floor = ffi_numbers_of(list, "floor", CHANNELS);
  record.n = (size_t)n;
  record.time_s = ffi_reals(time, "time_s", n);
  record.segment = segments_of(list, n);
  for (int c = 0; c < CHANNELS; c++) {
    SEXP y = ffi_element(list, values[c]);
    record.floor[c] = floor[c];
    record.y[c] = Rf_isNull(y) ? NULL : ffi_reals(y, values[c], n);
    record.w[c] = NULL;
    if (!record.y[c]) continue;
    const double *w = ffi_numbers_of(list, weights[c], n);
    record.w[c] = (double *)R_alloc((size_t)n + 1, sizeof(double));
    memcpy(record.w[c], w, (size_t)n * sizeof *w);
  }
  SEXP slow = ffi_element(list, "slow");
  record.slow = record.clock = NULL;
  record.slow_channel = 0;
  if (!Rf_isNull(slow)) {
    record.slow = ffi_reals(slow, "slow", n);
    record.clock = ffi_numbers_of(list, "clock", n);
    record.slow_channel = *ffi_numbers_of(list, "slow_channel", 1) > 0.0 ? RATE : ANGLE;
    if (!record.y[record.slow_channel]) Rf_error("internal: `slow_channel`");
  }
  return record;
}

/* list(time_s, segment, first) => n breaks, with space for `room` more */
static rot_smooth_break *read_breaks(SEXP list, size_t room, size_t *n) {
  SEXP time = ffi_element(list, "time_s");
  *n = (size_t)XLENGTH(time);
  const double *time_s = ffi_reals(time, "time_s", -1);
  const double *segment = ffi_numbers_of(list, "segment", (R_xlen_t)*n);
  const double *first = ffi_numbers_of(list, "first", (R_xlen_t)*n);
  rot_smooth_break *out = (rot_smooth_break *)R_alloc(*n + room + 1, sizeof *out);
  for (size_t i = 0; i < *n; i++) {
    if (!(first[i] >= 1.0 && first[i] <= 3.0)) Rf_error("internal: `first`");
    out[i].time_s = time_s[i];
    out[i].segment = (int)segment[i];
    out[i].first = (int)first[i];
  }
  return out;
}

/* c(order, lambda, ratio, sigma), or all numbers of write_fit() => fit */
static rot_smooth_fit read_fit(SEXP x) {
  const int whole = XLENGTH(x) == 8;
  const double *v = ffi_reals(x, "fit", whole ? 8 : 4);
  rot_smooth_fit fit = {{(int)v[0], v[1]}, v[2], v[3], NAN, NAN, 0, 0, 0};
  if (whole) {
    fit.objective = v[4];
    fit.end = (int)v[5];
    fit.samples = (size_t)v[6];
    fit.fresh = (size_t)v[7];
  }
  if (!(v[0] >= ROT_SMOOTH_MIN && v[0] <= ROT_SMOOTH_MAX)) Rf_error("internal: `order`");
  return fit;
}

static SEXP write_fit(const rot_smooth_fit *fit) {
  const double numbers[] = {fit->model.order,     fit->model.lambda, fit->ratio,
                            fit->sigma,           fit->objective,    fit->end,
                            (double)fit->samples, (double)fit->fresh};
  return ffi_numbers(8, numbers);
}

/* record, breaks => fit, breaks, excluded samples of each channel. options: first and last order,
 * max breaks to find, whether samples may be excluded. */
SEXP ffi_smooth_fit(SEXP list, SEXP breaks, SEXP options, SEXP progress) {
  static const char *const names[] = {"fit", "time_s", "segment", "first", "left_out", ""};
  const double *v = ffi_reals(options, "options", 4);
  const rot_smooth_finding how = {v[2] > 0.0, v[3] > 0.0, (int)v[0], (int)v[1], (size_t)v[2]};
  if (!(v[0] >= ROT_SMOOTH_MIN && v[1] <= ROT_SMOOTH_MAX)) Rf_error("internal: `order`");
  rot_smooth_record record = read_record(list);
  rot_smooth_fit fit;
  size_t n_breaks;
  rot_smooth_break *found = read_breaks(breaks, how.max_breaks, &n_breaks);
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  const rot_status status = rot_smooth_find(&record, &how, found, &n_breaks, &guard.hooks, &fit);
  ffi_guard_end(&guard, status);
  if (status != ROT_OK) return Rf_mkString(rot_status_kind(status));
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, write_fit(&fit));
  for (int j = 1; j < 4; j++) {
    SEXP column = Rf_allocVector(REALSXP, (R_xlen_t)n_breaks);
    SET_VECTOR_ELT(out, j, column);
    double *to = REAL(column);
    for (size_t i = 0; i < n_breaks; i++)
      to[i] = j == 1 ? found[i].time_s : j == 2 ? found[i].segment : found[i].first;
  }
  SEXP left = Rf_allocVector(LGLSXP, (R_xlen_t)(CHANNELS * record.n));
  SET_VECTOR_ELT(out, 4, left);
  for (int c = 0; c < CHANNELS; c++)
    for (size_t i = 0; i < record.n; i++)
      LOGICAL(left)[(size_t)c * record.n + i] = record.y[c] != NULL && !(record.w[c][i] < HUGE_VAL);
  UNPROTECT(1);
  return out;
}

/* => -2 log L and sigma for the fit's order, lambda and ratio */
SEXP ffi_smooth_objective(SEXP list, SEXP breaks, SEXP fit) {
  const rot_smooth_record record = read_record(list);
  const rot_smooth_fit of = read_fit(fit);
  size_t n_breaks;
  const rot_smooth_break *known = read_breaks(breaks, 0, &n_breaks);
  rot_smooth_grid grid;
  rot_smooth_sums sums;
  double out[2] = {NAN, NAN};
  const rot_status status = rot_smooth_grid_new(&grid, &record, n_breaks, 0);
  if (status == ROT_OK) {
    rot_smooth_grid_fill(&grid, &record, of.ratio, n_breaks, known, NULL);
    out[0] = rot_smooth_objective(&grid.nodes, &of.model,
                                  rot_smooth_floor(&grid, &record, of.ratio), &out[1], &sums);
  }
  rot_smooth_grid_free(&grid);
  if (status != ROT_OK) Rf_error("%s", rot_status_text(status));
  return ffi_numbers(2, out);
}

/* fit with known breaks => refined fit, see rot_smooth_refine() */
SEXP ffi_smooth_refine(SEXP list, SEXP breaks, SEXP fit, SEXP last_order, SEXP progress) {
  const double *last = ffi_reals(last_order, "last_order", 1);
  const rot_smooth_record record = read_record(list);
  rot_smooth_fit refined = read_fit(fit);
  size_t n_breaks;
  const rot_smooth_break *known = read_breaks(breaks, 0, &n_breaks);
  ffi_guard guard;
  if (!(last[0] >= ROT_SMOOTH_MIN && last[0] <= ROT_SMOOTH_MAX)) Rf_error("internal: `order`");
  ffi_guard_begin(&guard, progress);
  const rot_status status =
      rot_smooth_refine(&record, n_breaks, known, (int)last[0], &guard.hooks, &refined);
  ffi_guard_end(&guard, status);
  if (status != ROT_OK) return Rf_mkString(rot_status_kind(status));
  return write_fit(&refined);
}

/* A filtered grid of samples, breaks and other times. */
typedef struct smoothed {
  rot_smooth_record record;
  rot_smooth_break *breaks;
  size_t n_breaks;
  rot_smooth_times times;
  rot_smooth_fit fit;
  rot_smooth_grid grid;
  rot_smooth_store store;
} smoothed;

/* (record, breaks, fit, times) => filtered grid; smoothed_free() in each case */
static rot_status smoothed_new(SEXP list, SEXP breaks, SEXP fit, SEXP times, smoothed *out) {
  SEXP time = ffi_element(times, "time_s");
  rot_smooth_sums sums;
  out->record = read_record(list);
  out->breaks = read_breaks(breaks, 0, &out->n_breaks);
  out->fit = read_fit(fit);
  out->times.n = (size_t)XLENGTH(time);
  out->times.time_s = ffi_reals(time, "time_s", -1);
  out->times.segment = segments_of(times, XLENGTH(time));
  out->store.x = NULL;
  rot_status status = rot_smooth_grid_new(&out->grid, &out->record, out->n_breaks, out->times.n);
  if (status != ROT_OK) return status;
  rot_smooth_grid_fill(&out->grid, &out->record, out->fit.ratio, out->n_breaks, out->breaks,
                       &out->times);
  status = rot_smooth_store_new(&out->store, out->grid.nodes.n,
                                rot_smooth_states(&out->grid.nodes, out->fit.model.order));
  if (status == ROT_OK)
    rot_smooth_filter(&out->grid.nodes, &out->fit.model, 0, out->grid.nodes.n, &out->store, 1,
                      &sums);
  return status;
}

static void smoothed_free(smoothed *of) {
  rot_smooth_store_free(&of->store);
  rot_smooth_grid_free(&of->grid);
}

/* => at the samples and the other times: angle, rate, acceleration, their covariances; at the
 * samples: leave-one-out residuals in units of sigma, scores of shocks in the last state; sum of
 * P/w^2, the degrees of freedom of the smoother */
SEXP ffi_smooth_rows(SEXP list, SEXP breaks, SEXP fit, SEXP times) {
  enum { COLUMNS = 9 };
  static const char *const names[] = {"theta", "omega", "alpha", "v00", "v01",
                                      "v02",   "v11",   "v12",   "v22"};
  static const char *const parts[] = {"samples", "others", "residual", "used", "rough", ""};
  smoothed of;
  double *column[2][COLUMNS];
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)parts));
  const R_xlen_t n = XLENGTH(ffi_element(list, "time_s"));
  const R_xlen_t m = XLENGTH(ffi_element(times, "time_s"));
  SET_VECTOR_ELT(out, 0, ffi_columns(COLUMNS, names, n, column[0]));
  SET_VECTOR_ELT(out, 1, ffi_columns(COLUMNS, names, m, column[1]));
  SET_VECTOR_ELT(out, 2, Rf_allocVector(REALSXP, CHANNELS * n));
  SET_VECTOR_ELT(out, 4, Rf_allocVector(REALSXP, n));
  double used = 0.0;
  /* No call that may jump follows while the core has memory allocated. */
  const size_t max = (size_t)(n + m + 2 * XLENGTH(ffi_element(breaks, "time_s")));
  double *mean = (double *)R_alloc(max * (ROT_SMOOTH_MAX + 7 + CHANNELS) + 1, sizeof *mean);
  rot_status status = smoothed_new(list, breaks, fit, times, &of);
  if (status == ROT_OK) {
    const size_t nodes = of.grid.nodes.n, p = (size_t)of.fit.model.order;
    const double h = of.grid.unit_s, sigma = of.fit.sigma, unit[3] = {1.0, 1.0 / h, 2.0 / (h * h)};
    double *covariance = mean + nodes * p;
    double *residual[CHANNELS] = {covariance + 6 * nodes, covariance + 7 * nodes};
    double *last = covariance + 8 * nodes;
    rot_smooth_smooth(&of.grid.nodes, &of.fit.model, &of.store, mean, covariance);
    rot_smooth_scores(&of.grid.nodes, &of.fit.model, &of.store, NULL, last, residual);
    for (int part = 0; part < 2; part++)
      for (R_xlen_t i = 0; i < (part ? m : n); i++) {
        const size_t k = part ? of.grid.other[i] : of.grid.sample[i];
        int at = 3;
        for (size_t a = 0; a < 3; a++) {
          column[part][a][i] = a < p ? mean[k * p + a] * unit[a] : 0.0;
          for (size_t b = a; b < 3; b++, at++)
            column[part][at][i] =
                sigma * sigma * covariance[6 * k + (size_t)at - 3] * unit[a] * unit[b];
        }
        if (part == 0) REAL(VECTOR_ELT(out, 4))[i] = last[k] / (sigma * sigma);
        for (int c = 0; part == 0 && c < CHANNELS; c++) {
          REAL(VECTOR_ELT(out, 2))[c * n + i] = residual[c][k] / sigma;
          if (of.grid.nodes.y[c] && !ISNAN(of.grid.nodes.y[c][k])) {
            const double w = of.grid.nodes.w[c][k];
            const double part =
                of.grid.nodes.slow && of.grid.nodes.slow_channel == c ? of.grid.nodes.slow[k] : 0.0;
            used += covariance[6 * k + (c == ANGLE ? 0 : 3)] / (w * w + part * part);
          }
        }
      }
  }
  smoothed_free(&of);
  SET_VECTOR_ELT(out, 3, Rf_ScalarReal(used));
  UNPROTECT(3);
  if (status != ROT_OK) Rf_error("%s", rot_status_text(status));
  return out;
}

/* => for each break: error of its time; jumps of omega and alpha, their variances and covariance;
 * omega and alpha after it, with the same */
SEXP ffi_smooth_breaks(SEXP list, SEXP breaks, SEXP fit) {
  enum { COLUMNS = 11 };
  static const char *const names[] = {"time_error_s", "omega_jump", "alpha_jump",  "v11",
                                      "v12",          "v22",        "omega_after", "alpha_after",
                                      "after_v11",    "after_v12",  "after_v22"};
  static const char *const none[] = {"time_s", "segment", ""};
  double *column[COLUMNS];
  smoothed of;
  SEXP times = PROTECT(Rf_mkNamed(VECSXP, (const char **)none));
  SET_VECTOR_ELT(times, 0, Rf_allocVector(REALSXP, 0));
  const R_xlen_t n = XLENGTH(ffi_element(breaks, "time_s"));
  SEXP out = ffi_columns(COLUMNS, names, n, column);
  rot_smooth_jump *jump = (rot_smooth_jump *)R_alloc((size_t)n + 1, sizeof *jump);
  rot_status status = smoothed_new(list, breaks, fit, times, &of);
  if (status != ROT_OK) {
    smoothed_free(&of);
    Rf_error("%s", rot_status_text(status));
  }
  const double h = of.grid.unit_s, variance = of.fit.sigma * of.fit.sigma;
  const double u1 = 1.0 / h, u2 = 2.0 / (h * h);
  for (R_xlen_t i = 0; i < n; i++) {
    memset(&jump[i], 0, sizeof jump[i]);
    jump[i].node = of.grid.at_break[i];
  }
  rot_smooth_jumps(&of.grid.nodes, &of.fit.model, &of.store, of.n_breaks, jump);
  for (R_xlen_t i = 0; i < n; i++) {
    const double unit[3] = {u1 * u1, u1 * u2, u2 * u2};
    if (status == ROT_OK)
      status = rot_smooth_time_error(&of.record, &of.fit, of.n_breaks, of.breaks, (size_t)i,
                                     &column[0][i]);
    column[1][i] = jump[i].mean[1] * u1;
    column[2][i] = jump[i].mean[2] * u2;
    column[6][i] = jump[i].after[1] * u1;
    column[7][i] = jump[i].after[2] * u2;
    for (int j = 0; j < 3; j++) {
      column[3 + j][i] = jump[i].covariance[j] * variance * unit[j];
      column[8 + j][i] = jump[i].after_covariance[j] * variance * unit[j];
    }
  }
  smoothed_free(&of);
  UNPROTECT(2);
  if (status != ROT_OK) Rf_error("%s", rot_status_text(status));
  return out;
}

/* => random draws of the rate at other times, a vector by times, then draws; options: number of
 * draws, seed */
SEXP ffi_smooth_draws(SEXP list, SEXP breaks, SEXP fit, SEXP times, SEXP options) {
  smoothed of;
  const double *v = ffi_reals(options, "options", 2);
  if (!(v[0] >= 1.0 && v[0] < 1e7 && v[1] >= 0.0)) Rf_error("internal: `options`");
  const size_t draws = (size_t)v[0], m = (size_t)XLENGTH(ffi_element(times, "time_s"));
  SEXP out = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t)(draws * m)));
  double *x = (double *)R_alloc(draws * m * ROT_SMOOTH_MAX + 1, sizeof *x);
  ffi_guard guard;
  ffi_guard_begin(&guard, R_NilValue);
  rot_status status = smoothed_new(list, breaks, fit, times, &of);
  if (status == ROT_OK) {
    const size_t p = (size_t)of.fit.model.order;
    status = rot_smooth_draw(&of.grid.nodes, &of.fit.model, &of.store, of.fit.sigma, m,
                             of.grid.other, draws, (unsigned long)v[1], &guard.hooks, x);
    for (size_t i = 0; status == ROT_OK && i < draws * m; i++)
      REAL(out)[i] = x[i * p + 1] / of.grid.unit_s;
  }
  smoothed_free(&of);
  ffi_guard_end(&guard, status);
  UNPROTECT(1);
  if (status != ROT_OK) Rf_error("%s", rot_status_text(status));
  return out;
}
