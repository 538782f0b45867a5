#include "fit/covariance.h"

#include <math.h>
#include <string.h>

#include "fit/residuals.h"
#include "maths/expm.h"

rot_fit_counts rot_fit_counts_of(const rot_fit_work *w, const rot_fit_samples *s, double unit,
                                 const double r[], const double j[]) {
  const rot_fit_counts counts = {s->n,         w->n_free, s->at, s->of->y, s->of->weight,
                                 s->of->count, unit,      r,     j};
  return counts;
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
static void covariance_at(rot_fit_work *w, const double r[], const double j[], const double c[],
                          const double off[], square e, double wave[]) {
  const size_t m = w->n_free, priors = w->n_residuals - w->n_priors;
  square half;
  memset(e, 0, m * m * sizeof *e);
  for (size_t k = 0; k < w->n_series; k++) {
    const rot_fit_samples *s = &w->series[k];
    const double *rows = j + s->first * m;
    if (s->counted) {
      const rot_fit_counts counts = rot_fit_counts_of(w, s, s->noise->sigma, r + s->first, rows);
      rot_fit_counts_covariance(&counts, off, c, e, wave);
    } else {
      rot_fit_squares(s->n, m, w->size * w->size, rows, e);
    }
  }
  rot_fit_squares(w->n_priors, m, w->size * w->size, j + priors * m, e);
  (void)rot_expm_multiply(m, c, e, half, NULL);
  (void)rot_expm_multiply(m, half, c, e, NULL);
}

static int counts_moved(rot_fit_work *w, const double r[], const double j[], const double root[]) {
  int moved = 0;
  for (size_t k = 0; k < w->n_series && !moved; k++) {
    const rot_fit_samples *s = &w->series[k];
    if (!s->counted) continue;
    const rot_fit_counts counts =
        rot_fit_counts_of(w, s, s->noise->sigma, r + s->first, j + s->first * w->n_free);
    moved = rot_fit_counts_moved(&counts, root);
  }
  return moved;
}

rot_status rot_fit_put_counts(rot_fit_work *w, double r[], double j[]) {
  const size_t m = w->n_free, p = w->problem->n_unknowns;
  square c, e, root, mean;
  double wave[ROT_FIT_UNKNOWNS];
  int some = 0;
  for (size_t k = 0; k < w->n_series; k++) some |= w->series[k].counted;
  if (!some || m == 0) return ROT_OK;
  rot_status status = rot_fit_residuals(w, r);
  if (status == ROT_OK) status = rot_fit_derivatives(w, j);
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
