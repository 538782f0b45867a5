#include "fit/scene_fit.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/expm.h"

/* A series without its missing samples, whitened by its noise. */
typedef struct series {
  const rot_fit_series *of;
  size_t record, first; /* of the residuals */
  size_t n;
  size_t *at; /* rows of the record */
  double *time_s;
  rot_fit_noise *noise;
  int counted; /* 1: its errors are those of its counts */
} series;

typedef struct work {
  const rot_fit_problem *problem;
  const rot_hooks *hooks;
  rot_fit *fit;
  rot_fit_motion **motions; /* of each record */
  rot_fit_motion_plan *plans;
  rot_fit_column *columns;
  size_t n_series, n_residuals, n_priors, longest;
  series *series;
  int whole;               /* 1: residuals and derivatives by weight alone, for the noise */
  size_t n_free, *free_at; /* variables that the solver moves */
  double *u, *x;           /* all variables; the inputs of their values, in their domains */
  double *step;            /* of each record and unknown, and its shift */
  double *value, *slope, *block, *input;
  double size;          /* of the whitened residuals that are not of counters */
  double error;         /* of the motions, relative, the largest so far */
  rot_status ended;     /* what ended the search in a call by the solver */
  double *best_u, best; /* the lowest sum of squares so far */
  rot_store store;
} work;

/* ---- variables ------------------------------------------------------------------------------- */

static double variable_of(const rot_fit_problem *p, size_t k, double x) {
  return p->logarithm[k] ? log(x) : x;
}

static double value_of(const rot_fit_problem *p, size_t k, double u) {
  const double x = p->logarithm[k] ? exp(u) : u;
  return x < p->low[k] ? p->low[k] : x > p->high[k] ? p->high[k] : x;
}

/* dx/du */
static double scaling_of(const rot_fit_problem *p, size_t k, double x) {
  return p->logarithm[k] ? x : 1.0;
}

static int edge_of(const rot_fit_problem *p, size_t k, double u) {
  const double x = p->logarithm[k] ? exp(u) : u;
  return x <= p->low[k] ? -1 : x >= p->high[k] ? 1 : 0;
}

static void take(work *w, const double free_u[]) {
  for (size_t j = 0; j < w->n_free; j++) w->u[w->free_at[j]] = free_u[j];
  for (size_t k = 0; k < w->problem->n_unknowns; k++) w->x[k] = value_of(w->problem, k, w->u[k]);
}

static int has_prior(const rot_fit_problem *p, size_t k) { return p->prior_sd[k] > 0.0; }

/* ---- opening --------------------------------------------------------------------------------- */

static size_t present(const rot_fit_record *record, const rot_fit_series *of, size_t at[]) {
  size_t n = 0;
  for (size_t i = 0; i < record->n; i++) {
    if (!isfinite(of->y[i])) continue;
    if (at) at[n] = i;
    n++;
  }
  return n;
}

static rot_status open_series(work *w) {
  const rot_fit_problem *p = w->problem;
  size_t k = 0;
  for (size_t r = 0; r < p->n_records; r++) {
    const rot_fit_record *record = &p->records[r];
    for (size_t c = 0; c < record->n_series; c++, k++) {
      series *s = &w->series[k];
      s->of = &record->series[c];
      s->record = r;
      s->first = w->n_residuals;
      s->noise = &w->fit->noise[k];
      s->at = rot_store_get(&w->store, record->n + 1, sizeof *s->at);
      s->time_s = rot_store_get(&w->store, record->n + 1, sizeof *s->time_s);
      if (!s->at || !s->time_s) return ROT_ENOMEM;
      s->n = present(record, s->of, s->at);
      for (size_t i = 0; i < s->n; i++) s->time_s[i] = record->time_s[s->at[i]];
      w->n_residuals += s->n;
    }
  }
  w->fit->samples = w->n_residuals;
  for (size_t j = 0; j < p->n_unknowns; j++) w->n_priors += (size_t)has_prior(p, j);
  w->n_residuals += w->n_priors;
  return ROT_OK;
}

static rot_status open_motions(work *w, rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  rot_fit_column *columns = w->columns;
  for (size_t r = 0; r < p->n_records; r++) {
    const rot_fit_record *record = &p->records[r];
    for (size_t c = 0; c < record->n_series; c++) columns[c] = record->series[c].of;
    w->plans[r] = (rot_fit_motion_plan){.scene = p->scene,
                                        .run = p->run,
                                        .ctx = p->ctx,
                                        .record = r,
                                        .n_inputs = p->n_inputs,
                                        .inputs = p->inputs,
                                        .n_columns = record->n_series,
                                        .columns = columns,
                                        .n = record->n,
                                        .time_s = record->time_s,
                                        .accuracy = p->accuracy,
                                        .max_steps = p->max_steps};
    columns += record->n_series;
    const rot_status status = rot_fit_motion_open(&w->plans[r], &w->motions[r], no);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

static rot_status open_work(work *w, rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  const size_t m = p->n_unknowns;
  size_t longest_block = 0;
  for (size_t r = 0; r < p->n_records; r++) {
    const rot_fit_record *record = &p->records[r];
    w->n_series += record->n_series;
    if (record->n * record->n_series > longest_block) longest_block = record->n * record->n_series;
    if (record->n > w->longest) w->longest = record->n;
  }
  w->series = rot_store_get(&w->store, w->n_series + 1, sizeof *w->series);
  w->motions = rot_store_get(&w->store, p->n_records + 1, sizeof *w->motions);
  w->plans = rot_store_get(&w->store, p->n_records + 1, sizeof *w->plans);
  w->columns = rot_store_get(&w->store, w->n_series + 1, sizeof *w->columns);
  w->free_at = rot_store_get(&w->store, m + 1, sizeof *w->free_at);
  double *numbers = rot_store_get(&w->store, 4 * m + p->n_inputs + 1, sizeof *numbers);
  w->step = rot_store_get(&w->store, p->n_records * (p->n_inputs + 1) + 1, sizeof *w->step);
  w->value = rot_store_get(&w->store, longest_block + 1, sizeof *w->value);
  w->slope = rot_store_get(&w->store, longest_block * (m + 1) + 1, sizeof *w->slope);
  w->block = rot_store_get(&w->store, w->longest * (m + 1) + 1, sizeof *w->block);
  if (!w->series || !w->motions || !w->plans || !w->columns || !w->free_at || !numbers ||
      !w->step || !w->value || !w->slope || !w->block) {
    return ROT_ENOMEM;
  }
  w->u = numbers;
  w->x = numbers + m;
  w->best_u = numbers + 2 * m;
  w->input = numbers + 3 * m;
  memset(w->motions, 0, (p->n_records + 1) * sizeof *w->motions);
  memset(w->step, 0, (p->n_records * (p->n_inputs + 1) + 1) * sizeof *w->step);
  const rot_status status = open_series(w);
  return status == ROT_OK ? open_motions(w, no) : status;
}

static void close_work(work *w) {
  for (size_t r = 0; w->motions && r < w->problem->n_records; r++) {
    if (w->motions[r]) w->fit->runs += rot_fit_motion_runs(w->motions[r]);
    rot_fit_motion_close(w->motions[r]);
  }
  rot_store_free(&w->store);
}

/* ---- residuals ------------------------------------------------------------------------------- */

/* The error of a whitened residual by the rounding of the data and the error of the motion. */
static double rounding_of(const work *w) {
  double largest = 0.0;
  for (size_t k = 0; k < w->n_series; k++) {
    const series *s = &w->series[k];
    double size = 0.0;
    for (size_t i = 0; i < s->n; i++) size = fmax(size, fabs(s->of->y[s->at[i]]));
    largest = fmax(largest, (s->of->rounding + w->error * size) / s->noise->sigma);
  }
  return largest;
}

static rot_status motion_of(work *w, size_t r, double value[]) {
  const rot_fit_problem *p = w->problem;
  const rot_fit_record *record = &p->records[r];
  for (size_t i = 0; i < p->n_inputs; i++) {
    const int k = record->unknown[i];
    w->input[i] = k == ROT_FIT_NONE ? record->value[i] : w->x[k];
  }
  const double shift = record->shift == ROT_FIT_NONE ? 0.0 : w->x[record->shift];
  double error = 0.0;
  const rot_status status = rot_fit_motion_at(w->motions[r], w->input, shift, value, &error);
  if (status == ROT_OK && error < INFINITY) w->error = fmax(w->error, error);
  return status;
}

static double offset_of(const work *w, const rot_fit_series *s) {
  return s->offset == ROT_FIT_NONE ? 0.0 : w->x[s->offset];
}

static double factor_of(const work *w, const rot_fit_series *s) {
  return s->factor == ROT_FIT_NONE ? 1.0 : w->x[s->factor];
}

/* The residuals of a series, motion minus data, from the columns of its record. */
static void residuals_of(const work *w, const series *s, const double value[], double r[]) {
  const double offset = offset_of(w, s->of), factor = factor_of(w, s->of);
  for (size_t i = 0; i < s->n; i++) r[i] = offset + factor * value[s->at[i]] - s->of->y[s->at[i]];
}

/* Rows of samples in units of their noise; while it is looked for, of their weights. */
static rot_status whiten(const work *w, const series *s, size_t columns, double x[]) {
  for (size_t i = 0; s->of->weight && i < s->n; i++) {
    for (size_t q = 0; q < columns; q++) x[i * columns + q] /= s->of->weight[s->at[i]];
  }
  if (w->whole) return ROT_OK;
  for (size_t i = 0; i < s->n * columns; i++) x[i] /= s->noise->sigma;
  return rot_whiten(&s->noise->reml.noise, s->n, s->time_s, columns, x, NULL);
}

static void prior_residuals(const work *w, double r[]) {
  const rot_fit_problem *p = w->problem;
  for (size_t k = 0; k < p->n_unknowns; k++) {
    if (has_prior(p, k)) *r++ = (w->x[k] - p->prior[k]) / p->prior_sd[k];
  }
}

static rot_status all_residuals(work *w, double r[]) {
  rot_status status = rot_poll(w->hooks, 0.5);
  size_t k = 0;
  for (size_t i = 0; i < w->problem->n_records && status == ROT_OK; i++) {
    const rot_fit_record *record = &w->problem->records[i];
    status = motion_of(w, i, w->value);
    for (size_t c = 0; c < record->n_series && status == ROT_OK; c++, k++) {
      const series *s = &w->series[k];
      residuals_of(w, s, w->value + c * record->n, r + s->first);
      status = whiten(w, s, 1, r + s->first);
    }
  }
  if (status == ROT_OK) prior_residuals(w, r + w->n_residuals - w->n_priors);
  return status;
}

static int is_over(rot_status status) { return status == ROT_EUNWIND || status == ROT_ENOMEM; }

static rot_status call_residual(const double free_u[], double r[], void *ctx) {
  work *w = ctx;
  double sum = 0.0;
  take(w, free_u);
  const rot_status status = all_residuals(w, r);
  if (is_over(status)) return w->ended = status;
  if (status != ROT_OK) { /* the solver comes back by a shorter step */
    for (size_t i = 0; i < w->n_residuals; i++) r[i] = DBL_MAX;
    return ROT_OK;
  }
  for (size_t i = 0; i < w->n_residuals; i++) sum += r[i] * r[i];
  if (sum < w->best) {
    w->best = sum;
    memcpy(w->best_u, w->u, w->problem->n_unknowns * sizeof *w->u);
  }
  return ROT_OK;
}

/* ---- derivatives ----------------------------------------------------------------------------- */

/* Derivatives of the columns of a record by an unknown that is an input of it, or its clock: added
 * to slope[unknown]. */
static rot_status slopes_of(work *w, size_t r, size_t width) {
  const rot_fit_problem *p = w->problem;
  const rot_fit_record *record = &p->records[r];
  const size_t n = record->n * record->n_series;
  double *own = w->slope + p->n_unknowns * width;
  memset(w->slope, 0, p->n_unknowns * width * sizeof *w->slope);
  for (size_t i = 0; i <= p->n_inputs; i++) {
    const int k = i < p->n_inputs ? record->unknown[i] : record->shift;
    if (k == ROT_FIT_NONE || w->fit->held[k]) continue;
    const rot_status status = rot_fit_motion_slope(w->motions[r], i, p->low[k], p->high[k],
                                                   &w->step[r * (p->n_inputs + 1) + i], own);
    if (status != ROT_OK) return status;
    for (size_t q = 0; q < n; q++) w->slope[(size_t)k * width + q] += own[q];
  }
  return ROT_OK;
}

/* Rows of the free variables for a series. */
static void jacobian_of(const work *w, const series *s, size_t c, size_t width, double j[]) {
  const rot_fit_problem *p = w->problem;
  const size_t n = p->records[s->record].n;
  const double factor = factor_of(w, s->of);
  for (size_t q = 0; q < w->n_free; q++) {
    const size_t k = w->free_at[q];
    const double scaling = scaling_of(p, k, w->x[k]);
    const double *slope = w->slope + k * width + c * n, *value = w->value + c * n;
    for (size_t i = 0; i < s->n; i++) {
      double d = factor * slope[s->at[i]];
      if (s->of->offset == (int)k) d += 1.0;
      if (s->of->factor == (int)k) d += value[s->at[i]];
      j[i * w->n_free + q] = d * scaling;
    }
  }
}

static rot_status all_derivatives(work *w, double j[]) {
  const rot_fit_problem *p = w->problem;
  rot_status status = rot_poll(w->hooks, 0.5);
  size_t k = 0;
  for (size_t r = 0; r < p->n_records && status == ROT_OK; r++) {
    const rot_fit_record *record = &p->records[r];
    const size_t width = record->n * record->n_series;
    status = motion_of(w, r, w->value);
    if (status == ROT_OK) status = slopes_of(w, r, width);
    for (size_t c = 0; c < record->n_series && status == ROT_OK; c++, k++) {
      const series *s = &w->series[k];
      double *rows = j + s->first * w->n_free;
      jacobian_of(w, s, c, width, rows);
      status = whiten(w, s, w->n_free, rows);
    }
  }
  double *rows = j + (w->n_residuals - w->n_priors) * w->n_free;
  for (size_t u = 0; u < p->n_unknowns && status == ROT_OK; u++) {
    if (!has_prior(p, u)) continue;
    for (size_t q = 0; q < w->n_free; q++) {
      *rows++ = w->free_at[q] == u ? scaling_of(p, u, w->x[u]) / p->prior_sd[u] : 0.0;
    }
  }
  return status;
}

static rot_status call_jacobian(const double free_u[], double j[], void *ctx) {
  work *w = ctx;
  take(w, free_u);
  const rot_status status = all_derivatives(w, j);
  if (is_over(status)) w->ended = status;
  return status;
}

/* ---- the minimum within the domains ---------------------------------------------------------- */

static void set_free(work *w) {
  w->n_free = 0;
  for (size_t k = 0; k < w->problem->n_unknowns; k++) {
    if (!w->fit->held[k]) w->free_at[w->n_free++] = k;
  }
}

/* Whitened residuals have the s.d. 1 where the noise is known, and no less where a series has its
 * least noise. What the last round found differs from it by some percent. */
static double size_of_noise(const work *w, double found) {
  if (w->problem->noise) return 1.0;
  for (size_t k = 0; k < w->n_series; k++) {
    const series *s = &w->series[k];
    if (s->of->floor > 0.0 && s->noise->sigma <= s->of->floor) return fmax(found, 1.0);
  }
  return found;
}

/* Results of the solver to the places of all variables. */
static void put_result(work *w, const rot_squares *found) {
  const size_t m = w->problem->n_unknowns, n = w->n_free;
  w->size = size_of_noise(w, found->size);
  const double size = w->size / found->size;
  memset(w->fit->covariance, 0, m * m * sizeof *w->fit->covariance);
  memset(w->fit->factor, 0, m * m * sizeof *w->fit->factor);
  memset(w->fit->triangle, 0, m * m * sizeof *w->fit->triangle);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      const size_t at = w->free_at[i] * m + w->free_at[j];
      w->fit->covariance[at] = size * size * found->covariance[i * n + j];
      w->fit->factor[at] = size * found->factor[i * n + j];
      w->fit->triangle[at] = found->triangle[i * n + j];
    }
  }
  w->fit->squares = found->squares;
  w->fit->condition = found->condition;
}

/* Variables at or beyond an edge are held there => how many are new. */
static size_t hold_edges(work *w) {
  size_t new = 0;
  for (size_t k = 0; k < w->problem->n_unknowns; k++) {
    const int edge = w->fit->held[k] ? 0 : edge_of(w->problem, k, w->u[k]);
    if (!edge) continue;
    w->fit->held[k] = edge;
    w->u[k] = variable_of(w->problem, k, edge < 0 ? w->problem->low[k] : w->problem->high[k]);
    new ++;
  }
  return new;
}

/* A held variable whose way into the domain lowers the sum of squares is freed => 1: one is. */
static rot_status release(work *w, double r[], double j[], int *one) {
  const rot_fit_problem *p = w->problem;
  rot_status status = ROT_OK;
  *one = 0;
  for (size_t k = 0; k < p->n_unknowns && status == ROT_OK && !*one; k++) {
    const int edge = w->fit->held[k];
    if (!edge || p->low[k] == p->high[k]) continue;
    w->fit->held[k] = 0;
    set_free(w);
    for (size_t i = 0; i < p->n_unknowns; i++) w->x[i] = value_of(p, i, w->u[i]);
    status = all_residuals(w, r);
    if (status == ROT_OK) status = all_derivatives(w, j);
    size_t q = 0;
    while (q < w->n_free && w->free_at[q] != k) q++;
    double dot = 0.0, length = 0.0;
    for (size_t i = 0; i < w->n_residuals; i++) {
      dot += j[i * w->n_free + q] * r[i];
      length += j[i * w->n_free + q] * j[i * w->n_free + q];
    }
    /* More than a hundredth of a standard deviation. */
    *one = (edge < 0 ? -dot : dot) > 1e-2 * sqrt(length);
    if (!*one) w->fit->held[k] = edge;
  }
  set_free(w);
  return status;
}

static rot_status solve_free(work *w, rot_squares *found) {
  const rot_squares_problem problem = {w->n_residuals, w->n_free, call_residual, call_jacobian, w,
                                       rounding_of(w), 3e-7};
  double u[ROT_FIT_UNKNOWNS];
  for (size_t j = 0; j < w->n_free; j++) u[j] = w->u[w->free_at[j]];
  w->best = INFINITY;
  const rot_status solved = rot_squares_solve(&problem, w->hooks, u, found);
  const rot_status status = w->ended != ROT_OK ? w->ended : solved;
  if (status == ROT_OK) {
    take(w, u);
  } else if (w->best < INFINITY) {
    memcpy(w->u, w->best_u, w->problem->n_unknowns * sizeof *w->u);
  }
  return status;
}

static rot_status solve_in_domain(work *w) {
  const size_t m = w->problem->n_unknowns;
  double covariance[ROT_FIT_UNKNOWNS * ROT_FIT_UNKNOWNS];
  double factor[ROT_FIT_UNKNOWNS * ROT_FIT_UNKNOWNS];
  double triangle[ROT_FIT_UNKNOWNS * ROT_FIT_UNKNOWNS];
  double *r = malloc(w->n_residuals * (m + 1) * sizeof *r);
  if (!r) return ROT_ENOMEM;
  rot_status status = ROT_OK;
  for (size_t turn = 0; turn < 2 * m + 2; turn++) {
    rot_squares found = {.iterations = w->fit->iterations,
                         .covariance = covariance,
                         .factor = factor,
                         .triangle = triangle};
    set_free(w);
    if (w->n_free == 0) {
      memset(w->fit->covariance, 0, m * m * sizeof *covariance);
      break;
    }
    status = solve_free(w, &found);
    w->fit->iterations = found.iterations;
    if (status != ROT_OK && status != ROT_ERANGE && status != ROT_EBUDGET) break;
    if (hold_edges(w)) continue;
    if (status != ROT_OK) break;
    put_result(w, &found);
    int one = 0;
    status = release(w, r, r + w->n_residuals, &one);
    if (status != ROT_OK || !one) break;
  }
  free(r);
  for (size_t k = 0; k < m; k++) w->x[k] = value_of(w->problem, k, w->u[k]);
  return status;
}

/* ---- noise ----------------------------------------------------------------------------------- */

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* A first s.d.: from second differences of neighbours, whose median size is 0.6745 sqrt(6) s.d. A
 * body at rest under an encoder has differences of 0, which say nothing. */
static void first_noise(const series *s, double scratch[]) {
  size_t n = 0;
  s->noise->reml = (rot_reml){{0.0, 1.0}, 0.0, 0.0, 0, 0};
  s->noise->n = s->n;
  for (size_t i = 1; i + 1 < s->n; i++) {
    const double *y = s->of->y;
    scratch[n] = fabs(y[s->at[i + 1]] - 2.0 * y[s->at[i]] + y[s->at[i - 1]]);
    n += scratch[n] > 0.0;
  }
  qsort(scratch, n, sizeof *scratch, by_size);
  s->noise->sigma = n ? scratch[n / 2] / (0.6745 * sqrt(6.0)) : 1.0;
  s->noise->sigma = fmax(s->noise->sigma, fmax(s->of->rounding, s->of->floor));
  if (!(s->noise->sigma > 0.0)) s->noise->sigma = 1.0;
}

static int settled(const rot_fit_noise *a, const rot_fit_noise *b) {
  const double t = a->reml.noise.tau_s, v = b->reml.noise.tau_s;
  if (fabs(log(a->sigma / b->sigma)) > 0.02) return 0;
  if (!(t > 0.0) || !(v > 0.0)) return !(t > 0.0) && !(v > 0.0);
  return fabs(log(t / v)) < 0.05 && fabs(a->reml.noise.white - b->reml.noise.white) < 0.01;
}

static rot_fit_counts counts_of(const work *w, const series *s, double unit, const double r[],
                                const double j[]) {
  const rot_fit_counts counts = {s->n,         w->n_free, s->at, s->of->y, s->of->weight,
                                 s->of->count, unit,      r,     j};
  return counts;
}

/* The columns that act on a series, for its noise. */
static size_t columns_of(const work *w, const series *s, const double j[], double to[]) {
  size_t m = 0;
  int acts[ROT_FIT_UNKNOWNS] = {0};
  for (size_t q = 0; q < w->n_free; q++) {
    for (size_t i = 0; i < s->n && !acts[q]; i++) acts[q] = j[i * w->n_free + q] != 0.0;
    m += (size_t)acts[q];
  }
  for (size_t i = 0, at = 0; i < s->n; i++) {
    for (size_t q = 0; q < w->n_free; q++) {
      if (acts[q]) to[at++] = j[i * w->n_free + q];
    }
  }
  return m;
}

static rot_status find_noise(work *w, double r[], double j[], int *same) {
  const double fraction = (double)w->n_free / (double)w->n_residuals;
  w->whole = 1;
  rot_status status = all_residuals(w, r);
  if (status == ROT_OK) status = all_derivatives(w, j);
  w->whole = 0;
  *same = 1;
  for (size_t k = 0; k < w->n_series && status == ROT_OK; k++) {
    series *s = &w->series[k];
    const rot_fit_noise last = *s->noise;
    const double span = s->n > 1 ? s->time_s[s->n - 1] - s->time_s[0] : 0.0;
    double sum = 0.0;
    const size_t m = columns_of(w, s, j + s->first * w->n_free, w->block);
    const rot_fit_counts counts = counts_of(w, s, 1.0, r + s->first, NULL);
    s->counted = isfinite(w->problem->threshold) && rot_fit_counts_rule(&counts);
    if (s->counted) {
      s->noise->reml = (rot_reml){{0.0, 1.0}, 0.0, 0.0, 0, 0};
    } else if (s->n > m + 3) {
      status = rot_whiten_reml(
          s->n, s->time_s, m, w->block, r + s->first, 0.1 * span, w->problem->threshold,
          last.reml.noise.tau_s > 0.0 ? &last.reml.noise : NULL, w->hooks, &s->noise->reml);
    }
    memcpy(w->block, r + s->first, s->n * sizeof *r);
    if (status == ROT_OK) {
      status = rot_whiten(&s->noise->reml.noise, s->n, s->time_s, 1, w->block, NULL);
    }
    for (size_t i = 0; i < s->n; i++) sum += w->block[i] * w->block[i];
    if (s->n) s->noise->sigma = sqrt(sum / ((double)s->n * (1.0 - fraction)));
    s->noise->sigma = fmax(s->noise->sigma, fmax(s->of->rounding, s->of->floor));
    if (!(s->noise->sigma > 0.0)) s->noise->sigma = DBL_MIN;
    if (!settled(&last, s->noise)) *same = 0;
  }
  return status;
}

/* Cholesky's factor; where the variance left is of rounding, 0. */
static void factor_of_covariance(size_t m, const double e[], double root[]) {
  for (size_t a = 0; a < m; a++) {
    for (size_t b = 0; b < m; b++) {
      double sum = b <= a ? e[a * m + b] : 0.0;
      for (size_t k = 0; k < b && b <= a; k++) sum -= root[a * m + k] * root[b * m + k];
      if (b == a)
        root[a * m + a] = sum > 1e-13 * e[a * m + a] ? sqrt(sum) : 0.0;
      else
        root[a * m + b] = b < a && root[b * m + b] > 0.0 ? sum / root[b * m + b] : 0.0;
    }
  }
}

enum { PASSES = 2 };
typedef double square[ROT_FIT_UNKNOWNS * ROT_FIT_UNKNOWNS];

/* (derivatives, inverse of their squares, variables off by so much) => e, the covariance by counts
 * there; wave += */
static void covariance_at(work *w, const double r[], const double j[], const double c[],
                          const double off[], square e, double wave[]) {
  const size_t m = w->n_free, priors = w->n_residuals - w->n_priors;
  square half;
  memset(e, 0, m * m * sizeof *e);
  for (size_t k = 0; k < w->n_series; k++) {
    const series *s = &w->series[k];
    const double *rows = j + s->first * m;
    if (s->counted) {
      const rot_fit_counts counts = counts_of(w, s, s->noise->sigma, r + s->first, rows);
      rot_fit_counts_covariance(&counts, off, c, e, wave);
    } else {
      rot_fit_squares(s->n, m, w->size * w->size, rows, e);
    }
  }
  rot_fit_squares(w->n_priors, m, w->size * w->size, j + priors * m, e);
  (void)rot_expm_multiply(m, c, e, half, NULL);
  (void)rot_expm_multiply(m, half, c, e, NULL);
}

static int counts_moved(work *w, const double r[], const double j[], const double root[]) {
  int moved = 0;
  for (size_t k = 0; k < w->n_series && !moved; k++) {
    const series *s = &w->series[k];
    if (!s->counted) continue;
    const rot_fit_counts counts =
        counts_of(w, s, s->noise->sigma, r + s->first, j + s->first * w->n_free);
    moved = rot_fit_counts_moved(&counts, root);
  }
  return moved;
}

/* The covariance of the least-squares estimate for the errors of counts, and its factor. The
 * estimate itself is that of white noise. Where the motion lies between the counts, and with it the
 * covariance, is known to the estimate's error alone: at points of that error the mean covariance,
 * with the largest variance of each variable. The error is that of white noise at first, then what
 * it led to. */
static rot_status put_counts(work *w, double r[], double j[]) {
  const size_t m = w->n_free, p = w->problem->n_unknowns;
  square c, e, root, mean;
  double wave[ROT_FIT_UNKNOWNS];
  int some = 0;
  for (size_t k = 0; k < w->n_series; k++) some |= w->series[k].counted;
  if (!some || m == 0) return ROT_OK;
  rot_status status = all_residuals(w, r);
  if (status == ROT_OK) status = all_derivatives(w, j);
  if (status != ROT_OK) return status;
  for (size_t a = 0; a < m; a++) {
    for (size_t b = 0; b < m; b++) {
      const size_t at = w->free_at[a] * p + w->free_at[b];
      c[a * m + b] = w->fit->covariance[at] / (w->size * w->size);
      root[a * m + b] = w->fit->factor[at] / w->size;
    }
  }
  for (int pass = 0; pass < PASSES; pass++) {
    const size_t points = counts_moved(w, r, j, root) ? 2 * m : 1;
    double largest[ROT_FIT_UNKNOWNS] = {0}, wider[ROT_FIT_UNKNOWNS];
    memset(mean, 0, sizeof mean);
    memset(wave, 0, sizeof wave);
    for (size_t k = 0; k < points; k++) {
      double off[ROT_FIT_UNKNOWNS] = {0};
      for (size_t q = 0; q < m && points > 1; q++) {
        off[q] = (k % 2 ? -1.0 : 1.0) * sqrt((double)m) * root[q * m + k / 2];
      }
      covariance_at(w, r, j, c, off, e, wave);
      for (size_t a = 0; a < m; a++) largest[a] = fmax(largest[a], e[a * m + a]);
      for (size_t q = 0; q < m * m; q++) mean[q] += e[q] / (double)points;
    }
    for (size_t a = 0; a < m; a++) {
      if (mean[a * m + a] > 0.0)
        w->fit->wave[w->free_at[a]] = fmin(wave[a] / ((double)points * mean[a * m + a]), 1.0);
      wider[a] = mean[a * m + a] > 0.0 ? sqrt(largest[a] / mean[a * m + a]) : 1.0;
    }
    for (size_t q = 0; q < m * m; q++) mean[q] *= wider[q / m] * wider[q % m];
    factor_of_covariance(m, mean, root);
  }
  for (size_t a = 0; a < m; a++) {
    for (size_t b = 0; b < m; b++) {
      const size_t at = w->free_at[a] * p + w->free_at[b];
      w->fit->covariance[at] = mean[a * m + b];
      w->fit->factor[at] = root[a * m + b];
    }
  }
  return ROT_OK;
}

/* The fitted data and the whitened residuals, in the rows of the records. */
static rot_status put_fitted(work *w) {
  double *to = w->fit->fitted, *white = w->fit->white;
  size_t k = 0;
  rot_status status = ROT_OK;
  for (size_t r = 0; r < w->problem->n_records && status == ROT_OK; r++) {
    const rot_fit_record *record = &w->problem->records[r];
    status = motion_of(w, r, w->value);
    w->fit->model = rot_fit_motion_model(w->motions[r]);
    for (size_t c = 0; c < record->n_series && status == ROT_OK; c++, k++) {
      const series *s = &w->series[k];
      const double offset = offset_of(w, s->of), factor = factor_of(w, s->of);
      for (size_t i = 0; i < record->n; i++, white++) {
        *to++ = offset + factor * w->value[c * record->n + i];
        *white = NAN;
      }
      residuals_of(w, s, w->value + c * record->n, w->block);
      status = whiten(w, s, 1, w->block);
      for (size_t i = 0; i < s->n; i++) (white - record->n)[s->at[i]] = -w->block[i];
    }
  }
  return status;
}

/* At the start the squares are finite, and each unknown changes what was observed. */
static rot_status check_effects(work *w, double r[], double j[], rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  set_free(w);
  for (size_t k = 0; k < p->n_unknowns; k++) w->x[k] = value_of(p, k, w->u[k]);
  rot_status status = all_residuals(w, r);
  if (status == ROT_OK) status = all_derivatives(w, j);
  if (status == ROT_EVALUE) {
    return rot_refuse(no, p->n_inputs, "no model takes the scene, or its inputs are refused");
  }
  double squares = 0.0;
  for (size_t i = 0; i < w->n_residuals && status == ROT_OK; i++) squares += r[i] * r[i];
  if (!isfinite(squares)) return ROT_ERANGE;
  for (size_t q = 0; q < w->n_free && status == ROT_OK; q++) {
    size_t i = 0;
    while (i < w->n_residuals && j[i * w->n_free + q] == 0.0) i++;
    if (i < w->n_residuals) continue;
    return rot_refuse(no, p->n_inputs + 1 + w->free_at[q],
                      "it has no effect on what was observed, as the scene starts");
  }
  return status;
}

static rot_status solve(work *w, rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  double *r = malloc(w->n_residuals * (p->n_unknowns + 1) * sizeof *r);
  if (!r) return ROT_ENOMEM;
  for (size_t k = 0; k < w->n_series; k++) {
    if (p->noise)
      *w->series[k].noise = p->noise[k];
    else
      first_noise(&w->series[k], w->block);
  }
  for (size_t k = 0; k < p->n_unknowns; k++) {
    w->u[k] = variable_of(p, k, w->fit->x[k]);
    w->fit->held[k] = p->low[k] == p->high[k] ? -1 : 0;
  }
  rot_status status = check_effects(w, r, r + w->n_residuals, no);
  if (status != ROT_OK) {
    free(r);
    return status;
  }
  for (int round = 0; round < 5; round++) {
    int same = 1;
    status = solve_in_domain(w);
    if (status != ROT_OK || round == 4 || p->noise) break;
    set_free(w);
    status = find_noise(w, r, r + w->n_residuals, &same);
    if (status != ROT_OK || (same && round > 0)) break;
  }
  if (status == ROT_OK) status = put_counts(w, r, r + w->n_residuals);
  free(r);
  return status;
}

rot_status rot_fit_solve(const rot_fit_problem *problem, const rot_hooks *hooks, rot_fit *fit,
                         rot_refusal *no) {
  work w = {.problem = problem, .hooks = hooks, .fit = fit};
  fit->iterations = fit->runs = fit->samples = 0;
  fit->condition = fit->squares = NAN;
  fit->model = NULL;
  if (problem->n_unknowns < 1 || problem->n_unknowns > ROT_FIT_UNKNOWNS) return ROT_EVALUE;
  rot_status status = open_work(&w, no);
  if (status == ROT_OK) {
    status = solve(&w, no);
    memcpy(fit->x, w.x, problem->n_unknowns * sizeof *fit->x);
    if (status == ROT_OK || status == ROT_ERANGE || status == ROT_EBUDGET) {
      const rot_status put = put_fitted(&w);
      if (status == ROT_OK) status = put;
    }
  }
  close_work(&w);
  return status;
}
