/* Products and lengths without intermediate overflow and underflow; products of vectors; sines of
 * degrees; are numbers finite. */
#ifndef ROT_REAL_H
#define ROT_REAL_H

#include <math.h>
#include <stddef.h>

#include "ground/exact.h"

/* (a, b, c) => a*b/c to 1.5 ulp, c not 0; *lo (or NULL): residual, with which the relative error is
 * some 1e-32. */
double rot_muldiv(double a, double b, double c, double *lo);

/* (x, d) => product of the n numbers x, divided by d: at most n + 1 roundings, for any size. */
double rot_product(int n, const double x[], double d);
/* The same as mantissa (returned) and power of two. */
double rot_product_split(int n, const double x[], double d, int *exponent);

/* => first + x[0] x[1] ... x[n - 1], residual in *lo: relative error some n 1e-32, no intermediate
 * overflow; *lo is 0 where the sum is not finite. */
double rot_sum_product(double first, int n, const double x[], double *lo);

static inline double rot_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out: neither a nor b. */
static inline void rot_cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Length of a vector. hypot() only where a square may over- or underflow: it was 12 % of the time
 * of a free body's row. */
static inline double rot_length(const double x[3]) {
  const double sum = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  return sum > 1e-280 && sum < 1e280 ? sqrt(sum) : hypot(hypot(x[0], x[1]), x[2]);
}

/* 1 if x is 0 or between 1/largest and largest: products of a few such numbers neither overflow nor
 * underflow. */
static inline int rot_well_scaled(double x, double largest) {
  x = fabs(x);
  return x == 0.0 || (x * largest > 1.0 && x < largest);
}

/* 1 if none of n doubles is Inf or NaN. */
int rot_all_finite(size_t n, const void *x);

/* deg => sine; the reduction is exact, so sin(30) = 0.5 */
double rot_sin_deg(double deg);
/* deg => cosine; cos(90) = 0 */
double rot_cos_deg(double deg);
/* deg => sine, cosine, with the same bits */
void rot_sin_cos_deg(double deg, double *sine, double *cosine);

#endif
