#include "maths/eigen.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "ground/real.h"

/* Matrices of 64 rows, graded over 1e-30, took at most 11 sweeps. */
enum { MAX_SWEEPS = 60 };

/* A row of rotations takes more than 20 us from this many columns on: worth a poll. */
enum { LARGE = 64 };

static rot_status poll_if_large(size_t n, const rot_hooks *hooks) {
  return n < LARGE ? ROT_OK : rot_poll(hooks, 0.0);
}

enum { NOT_FINITE = -100000 };

/* Scales n numbers by a power of two to at most 1, so that no square overflows. Returns the
 * exponent, or NOT_FINITE. */
static int scale_to_one(size_t n, double a[]) {
  double max = 0.0;
  int exponent = 0;
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(a[i])) return NOT_FINITE;
    if (fabs(a[i]) > max) max = fabs(a[i]);
  }
  if (max > 0.0) frexp(max, &exponent);
  for (size_t i = 0; i < n; i++) a[i] = ldexp(a[i], -exponent);
  return exponent;
}

static void set_identity(size_t n, double a[]) {
  for (size_t i = 0; i < n * n; i++) a[i] = i % (n + 1) == 0 ? 1.0 : 0.0;
}

/* [alpha gamma; gamma beta] => tangent of the smaller angle of the rotation that diagonalises it */
static double tangent(double alpha, double beta, double gamma) {
  const double cot = (beta - alpha) / (2.0 * gamma);
  if (fabs(cot) > 1e150) return 0.5 / cot;
  return (cot >= 0.0 ? 1.0 : -1.0) / (fabs(cot) + sqrt(1.0 + cot * cot));
}

/* x, y (strided) => c x - s y, s x + c y, with tau = s/(1 + c) for smaller rounding errors
 * (Rutishauser 1966). */
static void rotate(size_t n, size_t step, double x[], double y[], double s, double tau) {
  for (size_t i = 0; i < n; i++) {
    const double a = x[i * step], b = y[i * step];
    x[i * step] = a - s * (b + tau * a);
    y[i * step] = b + s * (a - tau * b);
  }
}

/* ---- symmetric ------------------------------------------------------------------------------ */

/* One Jacobi rotation of a, applied to v. Returns 0 if a_pq is negligible. */
static int rotate_pair(size_t n, double a[], double v[], size_t p, size_t q) {
  const double gamma = a[p * n + q], alpha = a[p * n + p], beta = a[q * n + q];
  /* Relative to both diagonal elements, not to the norm, to resolve small eigenvalues. */
  if (fabs(gamma) <= ROT_EPS * sqrt(fabs(alpha)) * sqrt(fabs(beta)) || fabs(gamma) < DBL_MIN) {
    return 0;
  }
  const double t = tangent(alpha, beta, gamma), c = 1.0 / sqrt(1.0 + t * t), s = t * c;
  const double tau = s / (1.0 + c);
  for (size_t r = 0; r < n; r++) {
    if (r == p || r == q) continue;
    const double x = a[r * n + p], y = a[r * n + q];
    a[r * n + p] = a[p * n + r] = x - s * (y + tau * x);
    a[r * n + q] = a[q * n + r] = y + s * (x - tau * y);
  }
  a[p * n + p] = alpha - t * gamma;
  a[q * n + q] = beta + t * gamma;
  a[p * n + q] = a[q * n + p] = 0.0;
  rotate(n, n, v + p, v + q, s, tau);
  return 1;
}

static void swap(double *x, double *y) {
  const double keep = *x;
  *x = *y;
  *y = keep;
}

static void sort_ascending(size_t n, double values[], double vectors[]) {
  for (size_t i = 0; i + 1 < n; i++) {
    size_t min = i;
    for (size_t j = i + 1; j < n; j++) {
      if (values[j] < values[min]) min = j;
    }
    if (min == i) continue;
    swap(&values[i], &values[min]);
    for (size_t r = 0; r < n; r++) swap(&vectors[r * n + i], &vectors[r * n + min]);
  }
}

/* Rayleigh quotient v'Av / v'v with compensated sums. The error of the vector enters squared, so a
 * well-separated small eigenvalue of an ungraded matrix regains the digits lost in the rotations:
 * from 1e-14 to 2e-16 for the 3 x 3 matrices of the tests. */
static double rayleigh(size_t n, const double a[], const double vectors[], size_t j) {
  double top = 0.0, top_lo = 0.0, below = 0.0, below_lo = 0.0;
  for (size_t i = 0; i < n; i++) {
    const double v = vectors[i * n + j];
    double row = 0.0, row_lo = 0.0, e, p;
    for (size_t k = 0; k < n; k++) {
      p = rot_two_prod(a[i * n + k], vectors[k * n + j], &e);
      rot_accumulate(&row, &row_lo, p);
      row_lo += e;
    }
    p = rot_two_prod(row, v, &e);
    rot_accumulate(&top, &top_lo, p);
    top_lo += e + row_lo * v;
    p = rot_two_prod(v, v, &e);
    rot_accumulate(&below, &below_lo, p);
    below_lo += e;
  }
  return (top + top_lo) / (below + below_lo);
}

rot_status rot_eigen_symmetric(size_t n, double a[], double values[], double vectors[],
                               const rot_hooks *hooks) {
  const int exponent = scale_to_one(n * n, a);
  rot_status status = ROT_OK;
  int turned = 1;
  if (exponent == NOT_FINITE) return ROT_EVALUE;
  double *copy = malloc((n ? n * n : 1) * sizeof *copy);
  if (!copy) return ROT_ENOMEM;
  for (size_t i = 0; i < n * n; i++) copy[i] = a[i];
  set_identity(n, vectors);
  for (int sweep = 0; turned && sweep < MAX_SWEEPS && status == ROT_OK; sweep++) {
    turned = 0;
    for (size_t p = 0; p + 1 < n && status == ROT_OK; p++) {
      for (size_t q = p + 1; q < n; q++) turned |= rotate_pair(n, a, vectors, p, q);
      status = poll_if_large(n, hooks);
    }
  }
  for (size_t j = 0; j < n && status == ROT_OK; j++) {
    values[j] = ldexp(rayleigh(n, copy, vectors, j), exponent);
    status = poll_if_large(n, hooks);
  }
  free(copy);
  if (status != ROT_OK) return status;
  sort_ascending(n, values, vectors);
  return turned ? ROT_ESTEP : ROT_OK;
}

/* ---- singular values ------------------------------------------------------------------------ */

static double dot(size_t n, size_t step, const double x[], const double y[]) {
  double sum = 0.0, lo = 0.0;
  for (size_t i = 0; i < n; i++) {
    double e, p = rot_two_prod(x[i * step], y[i * step], &e);
    rot_accumulate(&sum, &lo, p);
    lo += e;
  }
  return sum + lo;
}

static void swap_columns(size_t rows, size_t cols, double g[], size_t p, size_t q) {
  for (size_t i = 0; p != q && i < rows; i++) swap(&g[i * cols + p], &g[i * cols + q]);
}

static void swap_rows(size_t cols, double g[], size_t p, size_t q) {
  for (size_t j = 0; p != q && j < cols; j++) swap(&g[p * cols + j], &g[q * cols + j]);
}

/* Householder reflection of the rows from k on: zeros below element k of column k. */
static void reflect(size_t rows, size_t cols, double g[], size_t k) {
  double *x = g + k * cols + k;
  const size_t length = rows - k;
  const double norm = sqrt(dot(length, cols, x, x)), first = x[0];
  if (norm == 0.0) return;
  const double corner = first >= 0.0 ? -norm : norm;
  x[0] = first - corner;
  for (size_t j = k + 1; j < cols; j++) {
    const double s = dot(length, cols, x, g + k * cols + j) / (corner * x[0]);
    for (size_t i = 0; i < length; i++) g[(k + i) * cols + j] += s * x[i * cols];
  }
  x[0] = corner;
}

/* g => R of G P = Q R, in the upper triangle of g; permutation `place`. Each step first exchanges
 * the largest column and row to the front: row-wise and column-wise stable (Cox & Higham 1998). */
static rot_status triangularize(size_t rows, size_t cols, double g[], size_t place[],
                                const rot_hooks *hooks) {
  rot_status status = ROT_OK;
  for (size_t j = 0; j < cols; j++) place[j] = j;
  for (size_t k = 0; k < cols && status == ROT_OK; k++) {
    size_t column = k, row = k;
    double max = -1.0;
    for (size_t j = k; j < cols; j++) {
      const double size = dot(rows - k, cols, g + k * cols + j, g + k * cols + j);
      if (size > max) {
        max = size;
        column = j;
      }
    }
    swap_columns(rows, cols, g, k, column);
    const size_t keep = place[k];
    place[k] = place[column];
    place[column] = keep;
    for (size_t i = k; i < rows; i++) {
      if (fabs(g[i * cols + k]) > fabs(g[row * cols + k])) row = i;
    }
    swap_rows(cols, g, k, row);
    reflect(rows, cols, g, k);
    status = poll_if_large(cols, hooks);
  }
  return status;
}

static int rotate_columns(size_t n, double a[], size_t p, size_t q) {
  const double alpha = dot(n, n, a + p, a + p), beta = dot(n, n, a + q, a + q);
  const double gamma = dot(n, n, a + p, a + q);
  if (fabs(gamma) <= 2.0 * ROT_EPS * sqrt(alpha) * sqrt(beta) || fabs(gamma) < DBL_MIN) return 0;
  const double t = tangent(alpha, beta, gamma), c = 1.0 / sqrt(1.0 + t * t), s = t * c;
  rotate(n, n, a + p, a + q, s, s / (1.0 + c));
  return 1;
}

/* Rotates the columns until orthogonal, then normalizes them; sigma: their lengths. */
static rot_status orthogonalize(size_t n, double a[], double sigma[], const rot_hooks *hooks) {
  rot_status status = ROT_OK;
  int turned = 1;
  for (int sweep = 0; turned && sweep < MAX_SWEEPS; sweep++) {
    turned = 0;
    for (size_t p = 0; p + 1 < n; p++) {
      for (size_t q = p + 1; q < n; q++) turned |= rotate_columns(n, a, p, q);
      status = poll_if_large(n, hooks);
      if (status != ROT_OK) return status;
    }
  }
  for (size_t j = 0; j < n; j++) {
    sigma[j] = sqrt(dot(n, n, a + j, a + j));
    for (size_t i = 0; i < n && sigma[j] > 0.0; i++) a[i * n + j] /= sigma[j];
  }
  return turned ? ROT_ESTEP : ROT_OK;
}

/* R' W = Z Sigma gives G P = Q W Sigma Z': the right singular vectors are the rows of P Z. */
rot_status rot_eigen_singular(size_t rows, size_t cols, double g[], double sigma[], double u[],
                              const rot_hooks *hooks) {
  const int exponent = scale_to_one(rows * cols, g);
  if (exponent == NOT_FINITE || rows < cols) return ROT_EVALUE;
  size_t *place = malloc((cols ? cols : 1) * sizeof *place);
  if (!place) return ROT_ENOMEM;
  rot_status status = triangularize(rows, cols, g, place, hooks);
  if (status != ROT_OK) {
    free(place);
    return status;
  }
  for (size_t i = 0; i < cols; i++) {
    for (size_t j = 0; j < cols; j++) u[i * cols + j] = j <= i ? g[j * cols + i] : 0.0;
  }
  status = orthogonalize(cols, u, sigma, hooks);
  for (size_t i = 0; i < cols * cols; i++) g[i] = u[i];
  for (size_t i = 0; i < cols; i++) {
    for (size_t j = 0; j < cols; j++) u[place[i] * cols + j] = g[i * cols + j];
  }
  for (size_t j = 0; j < cols; j++) sigma[j] = ldexp(sigma[j], exponent);
  sort_ascending(cols, sigma, u);
  free(place);
  return status;
}
