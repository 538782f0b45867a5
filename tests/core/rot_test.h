/* A test kit in one header: checks that count, a report that sums up. One per test program.
 *
 *   #include "rot_test.h"
 *   int main(void)
 *   {
 *     ROT_CHECK(n == 3);
 *     ROT_CHECK_ULP(rot_phi1(-1.0), 0.63212055882855767, 2);
 *     return rot_test_report("phi");
 *   }
 *
 * A failed check says where, what and which values, and the program goes on. */
#ifndef ROT_TEST_H
#define ROT_TEST_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static long rot_test_passed = 0;
static long rot_test_failed = 0;

/* A loop that fails a million times should not print a million lines. */
#define ROT_TEST_MOST_LINES 40

static inline int rot_test_count(int ok) {
  if (ok) {
    rot_test_passed++;
    return 0;
  }
  rot_test_failed++;
  return rot_test_failed <= ROT_TEST_MOST_LINES;
}

/* Doubles as integers in the order of the doubles: neighbours differ by 1, -0 equals +0. */
static inline int64_t rot_test_order(double x) {
  int64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits < 0 ? INT64_MIN - bits : bits;
}

/* How many doubles lie between. Two NaN are at distance 0, NaN and a number infinitely far. */
static inline double rot_test_ulp(double got, double want) {
  int64_t a, b;
  if (isnan(got) || isnan(want)) return isnan(got) && isnan(want) ? 0.0 : HUGE_VAL;
  if (isinf(got) || isinf(want))
    return (got > 0) == (want > 0) && isinf(got) && isinf(want) ? 0.0 : HUGE_VAL;
  a = rot_test_order(got);
  b = rot_test_order(want);
  return (double)(a > b ? (uint64_t)a - (uint64_t)b : (uint64_t)b - (uint64_t)a);
}

/* |got - want| / |want|; a want of 0 is met by 0 alone, NaN by NaN, an infinity by itself. */
static inline double rot_test_rel(double got, double want) {
  if (rot_test_ulp(got, want) <= 0.0) return 0.0;
  if (isnan(got) || isnan(want) || isinf(got) || isinf(want)) return HUGE_VAL;
  if (fabs(want) > 0.0) return fabs(got / want - 1.0);
  return HUGE_VAL;
}

static inline void rot_test_true(int ok, const char *file, int line, const char *what) {
  if (rot_test_count(ok)) printf("%s:%d: failed: %s\n", file, line, what);
}

static inline void rot_test_near(double off, double most, const char *unit, double got, double want,
                                 const char *file, int line, const char *what) {
  /* Written so that a NaN distance or a NaN limit fails. */
  if (rot_test_count(off <= most))
    printf("%s:%d: failed: %s\n  got  %.17g\n  want %.17g\n  off by %.4g %s, allowed %.4g\n", file,
           line, what, got, want, off, unit, most);
}

static inline void rot_test_int(long long a, long long b, const char *file, int line,
                                const char *what) {
  if (rot_test_count(a == b))
    printf("%s:%d: failed: %s\n  got  %lld\n  want %lld\n", file, line, what, a, b);
}

#define ROT_CHECK(cond) rot_test_true((cond) ? 1 : 0, __FILE__, __LINE__, #cond)

#define ROT_CHECK_ULP(got, want, max_ulp)                                                          \
  do {                                                                                             \
    const double rot_test_g_ = (got), rot_test_w_ = (want);                                        \
    rot_test_near(rot_test_ulp(rot_test_g_, rot_test_w_), (double)(max_ulp), "ulp", rot_test_g_,   \
                  rot_test_w_, __FILE__, __LINE__, #got " == " #want);                             \
  } while (0)

#define ROT_CHECK_REL(got, want, rel)                                                              \
  do {                                                                                             \
    const double rot_test_g_ = (got), rot_test_w_ = (want);                                        \
    rot_test_near(rot_test_rel(rot_test_g_, rot_test_w_), (double)(rel), "relative", rot_test_g_,  \
                  rot_test_w_, __FILE__, __LINE__, #got " == " #want);                             \
  } while (0)

#define ROT_CHECK_EQ_INT(a, b)                                                                     \
  rot_test_int((long long)(a), (long long)(b), __FILE__, __LINE__, #a " == " #b)

/* The closing line that tests/core/run.sh adds up, and the exit code of main(). A program that
 * checked nothing has failed. */
static inline int rot_test_report(const char *topic) {
  if (rot_test_failed > ROT_TEST_MOST_LINES)
    printf("(%ld more failures not shown)\n", rot_test_failed - ROT_TEST_MOST_LINES);
  if (rot_test_passed + rot_test_failed == 0) {
    printf("core %s: no check was made\n", topic);
    rot_test_failed = 1;
  }
  printf("core %s: %ld passed, %ld failed\n", topic, rot_test_passed, rot_test_failed);
  return rot_test_failed == 0 ? 0 : 1;
}

#endif
