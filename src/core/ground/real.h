/* Products and lengths without intermediate overflow and underflow; sines of degrees. */
#ifndef ROT_REAL_H
#define ROT_REAL_H

#include <math.h>

#include "ground/exact.h"

/* a*b/c to 1.5 ulp, with the residual in *lo (may be NULL): the sum has a relative error of some
 * 1e-32; c is not 0. */
double rot_muldiv(double a, double b, double c, double *lo);

/* Product of n numbers, divided by d: at most n + 1 roundings, for factors of any size.
 * rot_product_split() returns the power of two separately. */
double rot_product(int n, const double x[], double d);
double rot_product_split(int n, const double x[], double d, int *exponent);

/* first + x[0] x[1] ... x[n - 1], with its rest in *lo: a relative error of some n 1e-32. Without
 * intermediate overflow; *lo is 0 where the sum is not finite. */
double rot_sum_product(double first, int n, const double x[], double *lo);

/* The length of a vector. hypot() is for squares that leave the doubles: 12 % of the time of a free
 * body's row, where it was taken always. */
static inline double rot_length(const double x[3]) {
  const double sum = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  return sum > 1e-280 && sum < 1e280 ? sqrt(sum) : hypot(hypot(x[0], x[1]), x[2]);
}

/* Products of a few such numbers stay far from overflow and underflow. */
static inline int rot_well_scaled(double x, double largest) {
  x = fabs(x);
  return x == 0.0 || (x * largest > 1.0 && x < largest);
}

/* sin and cos of an angle in degrees: the reduction is exact, so sin(30) = 0.5 and cos(90) = 0. */
double rot_sin_deg(double deg);
double rot_cos_deg(double deg);
void rot_sin_cos_deg(double deg, double *sine, double *cosine);

#endif
