/* Binary searches in n non-decreasing numbers. The result for t = NaN is 0. */
#ifndef ROT_SEARCH_H
#define ROT_SEARCH_H

#include <stddef.h>

#include "ground/ieee.h"

/* (x, t) => number of x[i] < t or, with `or_equal`, x[i] <= t */
static inline size_t rot_bound(size_t n, const double x[], double t, int or_equal) {
  size_t lo = 0, hi = n;
  while (lo < hi) {
    const size_t mid = lo + (hi - lo) / 2;
    if (or_equal ? x[mid] <= t : x[mid] < t) {
      lo = mid + 1;
    } else {
      hi = mid;
    }
  }
  return lo;
}

/* The first i with x[i] >= t; n if none. */
static inline size_t rot_lower_bound(size_t n, const double x[], double t) {
  return rot_bound(n, x, t, 0);
}

/* The first i with x[i] > t; n if none. */
static inline size_t rot_upper_bound(size_t n, const double x[], double t) {
  return rot_bound(n, x, t, 1);
}

#endif
