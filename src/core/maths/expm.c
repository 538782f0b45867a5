#include "maths/expm.h"

#include <math.h>
#include <string.h>

/* A product of this size takes 2 ms: worth a poll. */
enum { LARGE = 128 };

static rot_status poll_if_large(size_t n, const rot_hooks *hooks) {
  return n < LARGE ? ROT_OK : rot_poll(hooks, 0.0);
}

rot_status rot_expm_multiply(size_t n, const double a[], const double b[], double c[],
                             const rot_hooks *hooks) {
  rot_status status = ROT_OK;
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    double *row = c + i * n;
    for (size_t j = 0; j < n; j++) row[j] = 0.0;
    for (size_t k = 0; k < n; k++) {
      const double x = a[i * n + k];
      if (x == 0.0) continue; /* blocks of zeros remain exactly zero */
      for (size_t j = 0; j < n; j++) row[j] += x * b[k * n + j];
    }
    status = poll_if_large(n, hooks);
  }
  return status;
}

void rot_expm_apply(size_t n, const double a[], const double x[], double y[]) {
  for (size_t i = 0; i < n; i++) {
    double sum = 0.0;
    for (size_t j = 0; j < n; j++) sum += a[i * n + j] * x[j];
    y[i] = sum;
  }
}

/* The 1-norm. */
static double norm_of(size_t n, const double a[]) {
  double max = 0.0;
  for (size_t j = 0; j < n; j++) {
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += fabs(a[i * n + j]);
    if (!(sum <= max)) max = sum;
  }
  return max;
}

/* (a, b) => x of a x = b in b, for n right-hand sides; a is overwritten. Partial pivoting: the
 * denominator of a Pade approximant is well conditioned. */
static rot_status solve(size_t n, double a[], double b[], const rot_hooks *hooks) {
  rot_status status = ROT_OK;
  for (size_t k = 0; k < n && status == ROT_OK; k++) {
    size_t pivot = k;
    for (size_t i = k + 1; i < n; i++) {
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) pivot = i;
    }
    for (size_t j = 0; pivot != k && j < n; j++) {
      double keep = a[k * n + j];
      a[k * n + j] = a[pivot * n + j];
      a[pivot * n + j] = keep;
      keep = b[k * n + j];
      b[k * n + j] = b[pivot * n + j];
      b[pivot * n + j] = keep;
    }
    for (size_t i = k + 1; i < n; i++) {
      const double m = a[i * n + k] / a[k * n + k];
      if (m == 0.0) continue;
      for (size_t j = k + 1; j < n; j++) a[i * n + j] -= m * a[k * n + j];
      for (size_t j = 0; j < n; j++) b[i * n + j] -= m * b[k * n + j];
    }
    status = poll_if_large(n, hooks);
  }
  for (size_t k = n; k-- > 0 && status == ROT_OK;) {
    for (size_t j = 0; j < n; j++) {
      double sum = b[k * n + j];
      for (size_t i = k + 1; i < n; i++) sum -= a[k * n + i] * b[i * n + j];
      b[k * n + j] = sum / a[k * n + k];
    }
    status = poll_if_large(n, hooks);
  }
  return status;
}

static void add_scaled(size_t size, double to[], double factor, const double x[]) {
  for (size_t i = 0; i < size; i++) to[i] += factor * x[i];
}

static void add_identity(size_t n, double to[], double factor) {
  for (size_t i = 0; i < n; i++) to[i * (n + 1)] += factor;
}

/* Pade approximants: degree, largest 1-norm with an error below the unit roundoff (Higham 2005,
 * table 2.3), coefficients. */
static const struct {
  int degree;
  double norm, b[14];
} pade[] = {
    {3, 1.495585217958292e-2, {120, 60, 12, 1}},
    {5, 2.539398330063230e-1, {30240, 15120, 3360, 420, 30, 1}},
    {7, 9.504178996162932e-1, {17297280, 8648640, 1995840, 277200, 25200, 1512, 56, 1}},
    {9,
     2.097847961257068,
     {17643225600, 8821612800, 2075673600, 302702400, 30270240, 2162160, 110880, 3960, 90, 1}},
    {13,
     5.371920351148152,
     {64764752532480000, 32382376266240000, 7771770303897600, 1187353796428800, 129060195264000,
      10559470521600, 670442572800, 33522128640, 1323241920, 40840800, 960960, 16380, 182, 1}},
};
enum { HIGHEST = 4 };

/* a => e = (v - u)^-1 (v + u) by approximant `which`, u odd and v even in a; work: 6 n^2 */
static rot_status approximate(size_t n, const double a[], int which, double e[], double work[],
                              const rot_hooks *hooks) {
  const size_t size = n * n;
  const double *b = pade[which].b;
  const int degree = pade[which].degree;
  double *power = work, *next = work + size, *a2 = work + 2 * size, *u = work + 3 * size,
         *v = work + 4 * size, *odd = work + 5 * size;
  rot_status status = rot_expm_multiply(n, a, a, a2, hooks);
  memset(odd, 0, size * sizeof *odd);
  memset(v, 0, size * sizeof *v);
  memcpy(power, a2, size * sizeof *power);
  for (int k = 2; k < degree && status == ROT_OK; k += 2) {
    add_scaled(size, v, b[k], power);
    add_scaled(size, odd, b[k + 1], power);
    if (k + 2 < degree) {
      status = rot_expm_multiply(n, power, a2, next, hooks);
      double *keep = power;
      power = next;
      next = keep;
    }
  }
  add_identity(n, v, b[0]);
  add_identity(n, odd, b[1]);
  if (status == ROT_OK) status = rot_expm_multiply(n, a, odd, u, hooks);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < size; i++) {
    e[i] = v[i] + u[i];
    v[i] -= u[i];
  }
  return solve(n, v, e, hooks);
}

rot_status rot_expm(size_t n, const double a[], double e[], double work[], const rot_hooks *hooks) {
  const size_t size = n * n;
  const double norm = norm_of(n, a);
  double *scaled = work + 6 * size;
  int which = 0, squarings = 0;
  if (!isfinite(norm)) return ROT_ERANGE;
  while (which < HIGHEST && norm > pade[which].norm) which++;
  if (norm > pade[which].norm) squarings = (int)ceil(log2(norm / pade[which].norm));
  for (size_t i = 0; i < size; i++) scaled[i] = ldexp(a[i], -squarings);
  rot_status status = approximate(n, scaled, which, e, work, hooks);
  for (; squarings > 0 && status == ROT_OK; squarings--) {
    status = rot_expm_multiply(n, e, e, work, hooks);
    memcpy(e, work, size * sizeof *e);
  }
  if (status != ROT_OK) return status;
  return isfinite(norm_of(n, e)) ? ROT_OK : ROT_ERANGE;
}
