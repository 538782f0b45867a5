#include "fit/minimum.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/residuals.h"

/* ---- calls by the solver --------------------------------------------------------------------- */

static void take(rot_fit_work *w, const double free_u[]) {
  for (size_t j = 0; j < w->n_free; j++) w->u[w->free_at[j]] = free_u[j];
  for (size_t k = 0; k < w->problem->n_unknowns; k++) {
    w->x[k] = rot_fit_value_of(w->problem, k, w->u[k]);
  }
}

static int is_over(rot_status status) { return status == ROT_EUNWIND || status == ROT_ENOMEM; }

static rot_status call_residual(const double free_u[], double r[], void *ctx) {
  rot_fit_work *w = ctx;
  double sum = 0.0;
  take(w, free_u);
  const rot_status status = rot_fit_residuals(w, r);
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

static rot_status call_jacobian(const double free_u[], double j[], void *ctx) {
  rot_fit_work *w = ctx;
  take(w, free_u);
  const rot_status status = rot_fit_derivatives(w, j);
  if (is_over(status)) w->ended = status;
  return status;
}

/* ---- edges ----------------------------------------------------------------------------------- */

void rot_fit_set_free(rot_fit_work *w) {
  w->n_free = 0;
  for (size_t k = 0; k < w->problem->n_unknowns; k++) {
    if (!w->fit->held[k]) w->free_at[w->n_free++] = k;
  }
}

static int edge_of(const rot_fit_problem *p, size_t k, double u) {
  const double x = p->logarithm[k] ? exp(u) : u;
  return x <= p->low[k] ? -1 : x >= p->high[k] ? 1 : 0;
}

/* The error of a whitened residual by the rounding of the data and the error of the motion. */
static double rounding_of(const rot_fit_work *w) {
  double largest = 0.0;
  for (size_t k = 0; k < w->n_series; k++) {
    const rot_fit_samples *s = &w->series[k];
    double size = 0.0;
    for (size_t i = 0; i < s->n; i++) size = fmax(size, fabs(s->of->y[s->at[i]]));
    largest = fmax(largest, (s->of->rounding + w->error * size) / s->noise->sigma);
  }
  return largest;
}

/* Whitened residuals have the s.d. 1 where the noise is known, and no less where a series has its
 * least noise. What the last round found differs from it by some percent. */
static double size_of_noise(const rot_fit_work *w, double found) {
  if (w->problem->noise) return 1.0;
  for (size_t k = 0; k < w->n_series; k++) {
    const rot_fit_samples *s = &w->series[k];
    if (s->of->floor > 0.0 && s->noise->sigma <= s->of->floor) return fmax(found, 1.0);
  }
  return found;
}

/* Results of the solver to the places of all variables. */
static void put_result(rot_fit_work *w, const rot_squares *found) {
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
static size_t hold_edges(rot_fit_work *w) {
  size_t new = 0;
  for (size_t k = 0; k < w->problem->n_unknowns; k++) {
    const int edge = w->fit->held[k] ? 0 : edge_of(w->problem, k, w->u[k]);
    if (!edge) continue;
    w->fit->held[k] = edge;
    w->u[k] =
        rot_fit_variable_of(w->problem, k, edge < 0 ? w->problem->low[k] : w->problem->high[k]);
    new ++;
  }
  return new;
}

/* A held variable whose way into the domain lowers the sum of squares is freed => 1: one is. */
static rot_status release(rot_fit_work *w, double r[], double j[], int *one) {
  const rot_fit_problem *p = w->problem;
  rot_status status = ROT_OK;
  *one = 0;
  for (size_t k = 0; k < p->n_unknowns && status == ROT_OK && !*one; k++) {
    const int edge = w->fit->held[k];
    if (!edge || p->low[k] == p->high[k]) continue;
    w->fit->held[k] = 0;
    rot_fit_set_free(w);
    for (size_t i = 0; i < p->n_unknowns; i++) w->x[i] = rot_fit_value_of(p, i, w->u[i]);
    status = rot_fit_residuals(w, r);
    if (status == ROT_OK) status = rot_fit_derivatives(w, j);
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
  rot_fit_set_free(w);
  return status;
}

static rot_status solve_free(rot_fit_work *w, rot_squares *found) {
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

rot_status rot_fit_minimum(rot_fit_work *w) {
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
    rot_fit_set_free(w);
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
  for (size_t k = 0; k < m; k++) w->x[k] = rot_fit_value_of(w->problem, k, w->u[k]);
  return status;
}
