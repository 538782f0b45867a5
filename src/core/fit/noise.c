#include "fit/noise.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/counts.h"
#include "fit/covariance.h"
#include "fit/residuals.h"

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* A first s.d.: from second differences of neighbours, whose median size is 0.6745 sqrt(6) s.d. A
 * body at rest under an encoder has differences of 0, which say nothing. */
void rot_fit_first_noise(const rot_fit_samples *s, double scratch[]) {
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

/* The columns that act on a series, for its noise. */
static size_t columns_of(const rot_fit_work *w, const rot_fit_samples *s, const double j[],
                         double to[]) {
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

rot_status rot_fit_find_noise(rot_fit_work *w, double r[], double j[], int *same) {
  const double fraction = (double)w->n_free / (double)w->n_residuals;
  w->whole = 1;
  rot_status status = rot_fit_residuals(w, r);
  if (status == ROT_OK) status = rot_fit_derivatives(w, j);
  w->whole = 0;
  *same = 1;
  for (size_t k = 0; k < w->n_series && status == ROT_OK; k++) {
    rot_fit_samples *s = &w->series[k];
    const rot_fit_noise last = *s->noise;
    const double span = s->n > 1 ? s->time_s[s->n - 1] - s->time_s[0] : 0.0;
    double sum = 0.0;
    const size_t m = columns_of(w, s, j + s->first * w->n_free, w->block);
    const rot_fit_counts counts = rot_fit_counts_of(w, s, 1.0, r + s->first, NULL);
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
