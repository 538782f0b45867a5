/* The error of a count is a sawtooth of the angle: with another zero of the counter it is another,
 * but that of two samples depends on the angle between them. Noise of s.d. s before the count
 * makes it random. The covariance of samples at x and x' is the sum over k of size_k cos(2 pi k (x
 * - x')/D), size_k = D^2/(2 pi^2 k^2) exp(-(2 pi k s/D)^2), and what is left of the variance D^2/12
 * + s^2 is white (Widrow and Kollar, Quantization Noise, 2008, chapters 4 and 9). */
#include "fit/counts.h"

#include <math.h>

#include "ground/ieee.h"

enum { HARMONICS = 32 };
static const double TWO_PI = 6.283185307179586;

/* With noise of a fifth of a count the first harmonic has a fifth of its size: from there on the
 * errors of counts count as independent. */
static const double RANDOM_COUNTS = 0.2;

static double weight_of(const rot_fit_counts *c, size_t i) {
  return c->weight ? c->weight[c->at[i]] : 1.0;
}

/* Variance of the noise before the counts; less than two standard errors of the variance of a
 * sawtooth are none. */
static double noise_before(const rot_fit_counts *c) {
  const double n = (double)c->n, rounded = c->count * c->count / 12.0;
  double sum = 0.0;
  for (size_t i = 0; i < c->n; i++) {
    const double x = c->r[i] * weight_of(c, i) * c->unit;
    sum += x * x;
  }
  return fmax(sum / n - rounded * (1.0 + 2.0 * sqrt(0.8 / n)), 0.0);
}

int rot_fit_counts_rule(const rot_fit_counts *c) {
  const double limit = RANDOM_COUNTS * c->count;
  return c->count > 0.0 && c->n > 0 && noise_before(c) < limit * limit;
}

static void add_row(size_t m, double size, const double row[], double to[]) {
  for (size_t a = 0; a < m; a++) {
    for (size_t b = 0; b < m; b++) to[a * m + b] += size * row[a] * row[b];
  }
}

void rot_fit_squares(size_t n, size_t m, double variance, const double j[], double to[]) {
  for (size_t i = 0; i < n; i++) add_row(m, variance, j + i * m, to);
}

int rot_fit_counts_moved(const rot_fit_counts *c, const double root[]) {
  const size_t m = c->m;
  double farthest = 0.0;
  for (size_t i = 0; i < c->n; i++) {
    for (size_t k = 0; k < m; k++) {
      double moved = 0.0;
      for (size_t q = 0; q < m; q++) moved += c->j[i * m + q] * root[q * m + k];
      farthest = fmax(farthest, fabs(moved) * weight_of(c, i) * c->unit);
    }
  }
  return farthest > 0.02 * c->count;
}

void rot_fit_counts_covariance(const rot_fit_counts *c, const double off[], const double inverse[],
                               double to[], double wave[]) {
  const size_t m = c->m;
  const double d = c->count / c->unit, before = noise_before(c) / (c->count * c->count);
  double left = d * d * (1.0 / 12.0 + before), largest[ROT_FIT_UNKNOWNS] = {0};
  for (int k = 1; k <= HARMONICS; k++) {
    const double turn = TWO_PI * k;
    const double size = 2.0 * d * d / (turn * turn) * exp(-turn * turn * before);
    double even[ROT_FIT_UNKNOWNS] = {0}, odd[ROT_FIT_UNKNOWNS] = {0};
    for (size_t i = 0; i < c->n; i++) {
      const double weight = weight_of(c, i), *row = c->j + i * m;
      double x = c->r[i];
      for (size_t q = 0; q < m; q++) x += row[q] * off[q];
      x = (c->y[c->at[i]] + x * weight * c->unit) / c->count;
      const double cosine = cos(turn * x) / weight, sine = sin(turn * x) / weight;
      for (size_t q = 0; q < m; q++) {
        even[q] += row[q] * cosine;
        odd[q] += row[q] * sine;
      }
    }
    add_row(m, size, even, to);
    add_row(m, size, odd, to);
    for (size_t a = 0; a < m; a++) {
      double x = 0.0, y = 0.0;
      for (size_t b = 0; b < m; b++) {
        x += inverse[a * m + b] * even[b];
        y += inverse[a * m + b] * odd[b];
      }
      largest[a] = fmax(largest[a], size * (x * x + y * y));
    }
    left -= size;
  }
  for (size_t a = 0; a < m; a++) wave[a] += largest[a];
  for (size_t i = 0; i < c->n; i++) {
    const double weight = weight_of(c, i);
    add_row(m, left / (weight * weight), c->j + i * m, to);
  }
}
