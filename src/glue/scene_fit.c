/* For R: fits of a scene's inputs to records. */
#include "fit/scene_fit.h"

#include <string.h>

#include "glue/ffi.h"
#include "glue/object.h"
#include "glue/run.h"
#include "scene/run.h"

/* Whole numbers of R's doubles; -1: none. */
static int *places_of(SEXP list, const char *name, R_xlen_t n) {
  const double *x = ffi_numbers_of(list, name, n);
  int *to = (int *)R_alloc((size_t)n + 1, sizeof *to);
  for (R_xlen_t i = 0; i < n; i++) to[i] = (int)x[i];
  return to;
}

static rot_fit_series series_of(SEXP x, const rot_constraint *constraint, R_xlen_t n) {
  SEXP weight = ffi_element(x, "weight");
  const char *column = ffi_text(ffi_element(x, "column"), "column");
  const rot_fit_series to = {.of = {constraint ? rot_run_column(constraint, column) : 0,
                                    (size_t)ffi_number_of(x, "place")},
                             .y = ffi_numbers_of(x, "y", n),
                             .offset = (int)ffi_number_of(x, "offset"),
                             .factor = (int)ffi_number_of(x, "factor"),
                             .weight = Rf_isNull(weight) ? NULL : ffi_reals(weight, "weight", n),
                             .rounding = ffi_number_of(x, "rounding"),
                             .floor = ffi_number_of(x, "floor"),
                             .count = ffi_number_of(x, "count")};
  if (constraint &&
      (to.of.column >= constraint->n_columns || constraint->columns[to.of.column].flag)) {
    Rf_error("internal: no such column");
  }
  return to;
}

static rot_fit_record record_of(SEXP x, const rot_constraint *constraint, R_xlen_t inputs) {
  SEXP times = ffi_element(x, "time_s"), series = ffi_element(x, "series");
  const R_xlen_t n = XLENGTH(times), m = XLENGTH(series);
  rot_fit_series *all = (rot_fit_series *)R_alloc((size_t)m + 1, sizeof *all);
  for (R_xlen_t i = 0; i < m; i++) all[i] = series_of(VECTOR_ELT(series, i), constraint, n);
  return (rot_fit_record){.n = (size_t)n,
                          .time_s = ffi_reals(times, "time_s", -1),
                          .unknown = places_of(x, "unknown", inputs),
                          .value = ffi_numbers_of(x, "value", inputs),
                          .shift = (int)ffi_number_of(x, "shift"),
                          .n_series = (size_t)m,
                          .series = all};
}

enum { NOISE_NUMBERS = 6 };

/* n, sigma, tau, white, cap, gain of each series => noise */
static const rot_fit_noise *noise_of(SEXP x) {
  if (Rf_isNull(x)) return NULL;
  const double *row = ffi_reals(x, "given", -1);
  const size_t n = (size_t)XLENGTH(x) / NOISE_NUMBERS;
  rot_fit_noise *to = (rot_fit_noise *)R_alloc(n + 1, sizeof *to);
  for (size_t i = 0; i < n; i++, row += NOISE_NUMBERS) {
    to[i] = (rot_fit_noise){
        .reml = {.noise = {row[2], row[3]}, .gain = row[5]}, .sigma = row[1], .n = (size_t)row[0]};
  }
  return to;
}

static rot_fit_problem problem_of(SEXP x, const rot_object *scene) {
  SEXP inputs = ffi_element(x, "inputs"), records = ffi_element(x, "records");
  const R_xlen_t n = XLENGTH(inputs), m = XLENGTH(ffi_element(x, "start")), r = XLENGTH(records);
  const char **paths = (const char **)R_alloc((size_t)n + 1, sizeof *paths);
  rot_fit_record *all = (rot_fit_record *)R_alloc((size_t)r + 1, sizeof *all);
  for (R_xlen_t i = 0; i < n; i++) paths[i] = CHAR(STRING_ELT(inputs, i));
  for (R_xlen_t i = 0; i < r; i++) {
    all[i] = record_of(VECTOR_ELT(records, i), scene ? scene->constraint : NULL, n);
  }
  return (rot_fit_problem){.scene = scene,
                           .n_inputs = (size_t)n,
                           .inputs = paths,
                           .n_records = (size_t)r,
                           .records = all,
                           .n_unknowns = (size_t)m,
                           .logarithm = places_of(x, "logarithm", m),
                           .low = ffi_numbers_of(x, "low", m),
                           .high = ffi_numbers_of(x, "high", m),
                           .prior = ffi_numbers_of(x, "prior", m),
                           .prior_sd = ffi_numbers_of(x, "prior_sd", m),
                           .accuracy = ffi_number_of(x, "accuracy"),
                           .max_steps = ffi_number_of(x, "max_steps"),
                           .threshold = ffi_number_of(x, "threshold"),
                           .noise = noise_of(ffi_element(x, "given"))};
}

/* ---- motions that R computes ----------------------------------------------------------------- */

typedef struct callback {
  ffi_guard *guard;
  SEXP run; /* function(record, numbers, time_s) */
  size_t record, n_inputs, n;
  const double *input, *time_s;
  double *value, *error;
  size_t *events, n_values;
  int refused;
} callback;

/* list(value, events, error) of R, or NULL: refused; may jump */
static SEXP call_run(void *data) {
  callback *c = data;
  SEXP record = PROTECT(Rf_ScalarReal((double)c->record + 1.0));
  SEXP input = PROTECT(ffi_numbers((int)c->n_inputs, c->input));
  SEXP time_s = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t)c->n));
  memcpy(REAL(time_s), c->time_s, c->n * sizeof *c->time_s);
  SEXP call = PROTECT(Rf_lang4(c->run, record, input, time_s));
  SEXP found = PROTECT(Rf_eval(call, R_GlobalEnv));
  c->refused = Rf_isNull(found);
  if (!c->refused) {
    const double *value = ffi_numbers_of(found, "value", (R_xlen_t)c->n_values);
    const double *events = ffi_numbers_of(found, "events", (R_xlen_t)c->n);
    memcpy(c->value, value, c->n_values * sizeof *value);
    for (size_t i = 0; i < c->n; i++) c->events[i] = (size_t)events[i];
    *c->error = ffi_number_of(found, "error");
  }
  UNPROTECT(5);
  return R_NilValue;
}

static rot_status run_of_r(size_t record, const double input[], size_t n, const double time_s[],
                           double value[], size_t events[], double *error, void *ctx) {
  callback *c = (callback *)ctx + record;
  c->input = input;
  c->n = n;
  c->time_s = time_s;
  c->value = value;
  c->events = events;
  c->error = error;
  const rot_status status = ffi_guarded(c->guard, call_run, c, NULL);
  return status == ROT_OK && c->refused ? ROT_EVALUE : status;
}

/* A callback for each record. */
static callback *callbacks_of(SEXP run, const rot_fit_problem *problem, ffi_guard *guard) {
  callback *to = (callback *)R_alloc(problem->n_records + 1, sizeof *to);
  for (size_t r = 0; r < problem->n_records; r++) {
    const rot_fit_record *of = &problem->records[r];
    to[r] = (callback){.guard = guard,
                       .run = run,
                       .record = r,
                       .n_inputs = problem->n_inputs,
                       .n_values = of->n * of->n_series};
  }
  return to;
}

/* ---- the fit --------------------------------------------------------------------------------- */

enum { X, HELD, COVARIANCE, FACTOR, TRIANGLE, NOISE, FITTED, WHITE, NUMBERS, WAVE, MODEL };
static const char *const names[] = {"x",      "held",  "covariance", "factor", "triangle", "noise",
                                    "fitted", "white", "numbers",    "wave",   "model",    ""};

/* problem, with a scene as `node`, or `run`: a function that computes the motions => list(x, held,
 * covariance, factor, triangle; noise: n, sigma, tau, white, cap, gain of each series; fitted,
 * white; numbers: status, squares, condition, samples, iterations, runs; wave; model); or
 * list(refused, at) */
SEXP ffi_fit(SEXP x, SEXP progress) {
  static const char *const refused[] = {"refused", "at", ""};
  char fault[FFI_OBJECT_FAULT];
  SEXP run = ffi_element(x, "run");
  rot_object *scene = Rf_isNull(run) ? ffi_object(ffi_element(x, "node"), fault) : NULL;
  if (!scene && Rf_isNull(run)) Rf_error("internal: %s", fault);
  R_xlen_t n_series = 0, n_samples = 0;
  SEXP records = ffi_element(x, "records");
  for (R_xlen_t r = 0; r < XLENGTH(records); r++) {
    SEXP one = VECTOR_ELT(records, r);
    const R_xlen_t m = XLENGTH(ffi_element(one, "series"));
    n_series += m;
    n_samples += m * XLENGTH(ffi_element(one, "time_s"));
  }
  rot_fit_problem problem = problem_of(x, scene);
  const R_xlen_t m = (R_xlen_t)problem.n_unknowns;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  rot_fit fit = {0};
  fit.x = ffi_new_double(out, X, m);
  memcpy(fit.x, ffi_numbers_of(x, "start", m), (size_t)m * sizeof *fit.x);
  fit.covariance = ffi_new_double(out, COVARIANCE, m * m);
  fit.factor = ffi_new_double(out, FACTOR, m * m);
  fit.triangle = ffi_new_double(out, TRIANGLE, m * m);
  fit.fitted = ffi_new_double(out, FITTED, n_samples);
  fit.white = ffi_new_double(out, WHITE, n_samples);
  fit.wave = ffi_new_double(out, WAVE, m);
  memset(fit.wave, 0, (size_t)m * sizeof *fit.wave);
  double *held = ffi_new_double(out, HELD, m);
  fit.held = (int *)R_alloc((size_t)m + 1, sizeof *fit.held);
  for (R_xlen_t i = 0; i < m * m; i++) fit.covariance[i] = fit.factor[i] = fit.triangle[i] = NAN;
  double *noise = ffi_new_double(out, NOISE, NOISE_NUMBERS * n_series);
  fit.noise = (rot_fit_noise *)R_alloc((size_t)n_series + 1, sizeof *fit.noise);
  memset(fit.noise, 0, ((size_t)n_series + 1) * sizeof *fit.noise);
  rot_refusal no = {0};
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  if (!scene) {
    problem.run = run_of_r;
    problem.ctx = callbacks_of(run, &problem, &guard);
  }
  const rot_status status = rot_fit_solve(&problem, &guard.hooks, &fit, &no);
  rot_object_free(scene);
  const int found = status == ROT_OK || status == ROT_ERANGE || status == ROT_EBUDGET;
  ffi_guard_end(&guard, found || status == ROT_EVALUE ? ROT_OK : status);
  if (!found && status != ROT_EVALUE) Rf_error("internal: %s", rot_status_text(status));
  if (status == ROT_EVALUE) {
    SEXP why = PROTECT(Rf_mkNamed(VECSXP, (const char **)refused));
    SET_VECTOR_ELT(why, 0, Rf_mkString(no.reason));
    SET_VECTOR_ELT(why, 1, Rf_ScalarReal((double)no.input));
    UNPROTECT(2);
    return why;
  }
  for (R_xlen_t i = 0; i < m; i++) held[i] = fit.held[i];
  for (R_xlen_t i = 0; i < n_series; i++) {
    const rot_fit_noise *one = &fit.noise[i];
    const double row[] = {(double)one->n,           one->sigma,
                          one->reml.noise.tau_s,    one->reml.noise.white,
                          (double)one->reml.at_cap, one->reml.gain};
    memcpy(noise + NOISE_NUMBERS * i, row, sizeof row);
  }
  const double numbers[] = {(double)status,         fit.squares,
                            fit.condition,          (double)fit.samples,
                            (double)fit.iterations, (double)fit.runs};
  SET_VECTOR_ELT(out, NUMBERS, ffi_numbers(6, numbers));
  if (fit.model) SET_VECTOR_ELT(out, MODEL, Rf_mkString(fit.model->id));
  UNPROTECT(1);
  return out;
}
