/* Error-free transforms, powers of two.
 *
 * fma() is called explicitly, so contraction of a*b+c by the compiler changes nothing here: the
 * sums contain no product. */
#ifndef ROT_EXACT_H
#define ROT_EXACT_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "ground/ieee.h"

#define ROT_EPS 0x1p-53 /* unit roundoff */

/* (x, e) => x 2^e with the bits of ldexp(): both round once. Calls of ldexp() were 8 % of the time
 * of a free body's row. */
static inline double rot_ldexp(double x, int e) {
  if (e < -1022 || e > 1023) return ldexp(x, e);
  const uint64_t bits = (uint64_t)(e + 1023) << 52;
  double power;
  memcpy(&power, &bits, sizeof power);
  return x * power;
}

/* (a, b) => rounded sum, *lo its error: a + b = returned + *lo exactly (Knuth) */
static inline double rot_two_sum(double a, double b, double *lo) {
  double s = a + b, bb = s - a;
  *lo = (a - (s - bb)) + (b - bb);
  return s;
}

/* (a, b) => rounded product, *lo its error: exact unless it underflows */
static inline double rot_two_prod(double a, double b, double *lo) {
  double p = a * b;
  *lo = fma(a, b, -p);
  return p;
}

/* Adds x to the running sum *sum + *lo. */
static inline void rot_accumulate(double *sum, double *lo, double x) {
  double e;
  *sum = rot_two_sum(*sum, x, &e);
  *lo += e;
}

#endif
