/* Sums of a summary: double-double numbers, or a number that is not finite with compensation 0. */
#ifndef ROT_SUM_H
#define ROT_SUM_H

#include <math.h>

#include "ground/dd.h"

/* (plain sum, sum) => sum; an overflow of the plain sum is one of the result. */
static inline rot_dd rot_sum_sound(double plain, rot_dd sum) {
  if (isfinite(plain) && isfinite(sum.hi)) return sum;
  return (rot_dd){isnan(plain) ? NAN : plain, 0.0};
}

/* Running sum and its compensation (rot_accumulate()) => sum */
static inline rot_dd rot_sum_of(double sum, double lo) {
  return rot_sum_sound(sum, rot_dd_sum2(sum, lo));
}

static inline rot_dd rot_sum_add(rot_dd x, rot_dd y) {
  return rot_sum_sound(x.hi + y.hi, rot_dd_add(x, y));
}

/* Standard error of an estimate by the jackknife: n estimates, each without one of n groups. NaN
 * for fewer than two groups. */
static inline double rot_sum_jackknife(int n, const double without[]) {
  double mean = 0.0, squares = 0.0;
  if (n < 2) return NAN;
  for (int i = 0; i < n; i++) mean += without[i] / n;
  for (int i = 0; i < n; i++) squares += (without[i] - mean) * (without[i] - mean);
  return sqrt(squares * (n - 1) / n);
}

#endif
