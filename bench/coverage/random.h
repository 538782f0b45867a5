/* Random numbers of the coverage programs: xorshift from `state`, which main() sets. */
#ifndef COVERAGE_RANDOM_H
#define COVERAGE_RANDOM_H

#include <math.h>
#include <stdint.h>

static uint64_t state;

static inline double uniform(double lo, double hi) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return lo + (hi - lo) * (double)(state >> 11) * 0x1p-53;
}

static inline double power(double lo, double hi) { return pow(10.0, uniform(lo, hi)); }
static inline int chance(double p) { return uniform(0.0, 1.0) < p; }
static inline double either(double x) { return chance(0.5) ? x : -x; }

#endif
