#include "fit/residuals.h"

#include <math.h>
#include <string.h>

static rot_status motion_of(rot_fit_work *w, size_t r, double value[]) {
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

static double offset_of(const rot_fit_work *w, const rot_fit_series *s) {
  return s->offset == ROT_FIT_NONE ? 0.0 : w->x[s->offset];
}

static double factor_of(const rot_fit_work *w, const rot_fit_series *s) {
  return s->factor == ROT_FIT_NONE ? 1.0 : w->x[s->factor];
}

/* The residuals of a series, motion minus data, from the columns of its record. */
static void residuals_of(const rot_fit_work *w, const rot_fit_samples *s, const double value[],
                         double r[]) {
  const double offset = offset_of(w, s->of), factor = factor_of(w, s->of);
  for (size_t i = 0; i < s->n; i++) r[i] = offset + factor * value[s->at[i]] - s->of->y[s->at[i]];
}

/* Rows of samples in units of their noise; while it is looked for, of their weights. */
static rot_status whiten(const rot_fit_work *w, const rot_fit_samples *s, size_t columns,
                         double x[]) {
  for (size_t i = 0; s->of->weight && i < s->n; i++) {
    for (size_t q = 0; q < columns; q++) x[i * columns + q] /= s->of->weight[s->at[i]];
  }
  if (w->whole) return ROT_OK;
  for (size_t i = 0; i < s->n * columns; i++) x[i] /= s->noise->sigma;
  return rot_whiten(&s->noise->reml.noise, s->n, s->time_s, columns, x, NULL);
}

static void prior_residuals(const rot_fit_work *w, double r[]) {
  const rot_fit_problem *p = w->problem;
  for (size_t k = 0; k < p->n_unknowns; k++) {
    if (rot_fit_has_prior(p, k)) *r++ = (w->x[k] - p->prior[k]) / p->prior_sd[k];
  }
}

rot_status rot_fit_residuals(rot_fit_work *w, double r[]) {
  rot_status status = rot_poll(w->hooks, 0.5);
  size_t k = 0;
  for (size_t i = 0; i < w->problem->n_records && status == ROT_OK; i++) {
    const rot_fit_record *record = &w->problem->records[i];
    status = motion_of(w, i, w->value);
    for (size_t c = 0; c < record->n_series && status == ROT_OK; c++, k++) {
      const rot_fit_samples *s = &w->series[k];
      residuals_of(w, s, w->value + c * record->n, r + s->first);
      status = whiten(w, s, 1, r + s->first);
    }
  }
  if (status == ROT_OK) prior_residuals(w, r + w->n_residuals - w->n_priors);
  return status;
}

rot_status rot_fit_put_fitted(rot_fit_work *w) {
  double *to = w->fit->fitted, *white = w->fit->white;
  size_t k = 0;
  rot_status status = ROT_OK;
  for (size_t r = 0; r < w->problem->n_records && status == ROT_OK; r++) {
    const rot_fit_record *record = &w->problem->records[r];
    status = motion_of(w, r, w->value);
    w->fit->model = rot_fit_motion_model(w->motions[r]);
    for (size_t c = 0; c < record->n_series && status == ROT_OK; c++, k++) {
      const rot_fit_samples *s = &w->series[k];
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

/* ---- derivatives ----------------------------------------------------------------------------- */

/* dx/du */
static double scaling_of(const rot_fit_problem *p, size_t k, double x) {
  return p->logarithm[k] ? x : 1.0;
}

/* Derivatives of the columns of a record by an unknown that is an input of it, or its clock: added
 * to slope[unknown]. */
static rot_status slopes_of(rot_fit_work *w, size_t r, size_t width) {
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
static void jacobian_of(const rot_fit_work *w, const rot_fit_samples *s, size_t c, size_t width,
                        double j[]) {
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

rot_status rot_fit_derivatives(rot_fit_work *w, double j[]) {
  const rot_fit_problem *p = w->problem;
  rot_status status = rot_poll(w->hooks, 0.5);
  size_t k = 0;
  for (size_t r = 0; r < p->n_records && status == ROT_OK; r++) {
    const rot_fit_record *record = &p->records[r];
    const size_t width = record->n * record->n_series;
    status = motion_of(w, r, w->value);
    if (status == ROT_OK) status = slopes_of(w, r, width);
    for (size_t c = 0; c < record->n_series && status == ROT_OK; c++, k++) {
      const rot_fit_samples *s = &w->series[k];
      double *rows = j + s->first * w->n_free;
      jacobian_of(w, s, c, width, rows);
      status = whiten(w, s, w->n_free, rows);
    }
  }
  double *rows = j + (w->n_residuals - w->n_priors) * w->n_free;
  for (size_t u = 0; u < p->n_unknowns && status == ROT_OK; u++) {
    if (!rot_fit_has_prior(p, u)) continue;
    for (size_t q = 0; q < w->n_free; q++) {
      *rows++ = w->free_at[q] == u ? scaling_of(p, u, w->x[u]) / p->prior_sd[u] : 0.0;
    }
  }
  return status;
}
