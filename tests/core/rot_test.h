/* A test kit in one header, for one test program.
 *
 *   #include "rot_test.h"
 *   static void known_values(void) {
 *     ROT_CHECK(n == 3);
 *     ROT_CHECK_ULP(rot_phi1(-1.0), 0.63212055882855767, 2);
 *   }
 *   int main(void) {
 *     known_values();
 *     return rot_test_report("phi");
 *   }
 *
 * A failed check prints its place, its text and its values; the program continues. The report
 * counts tests: functions that make checks. */
#ifndef ROT_TEST_H
#define ROT_TEST_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Failed checks so far. */
static long rot_test_failed = 0;

/* A test is a function that makes checks, however many; it passes if none of its checks fails. */
#define ROT_TEST_MAX_CASES 200
static struct {
  const char *name;
  long failed;
} rot_test_case[ROT_TEST_MAX_CASES];
static int rot_test_cases = 0, rot_test_current = 0;

/* A loop that fails a million times should not print a million lines. */
#define ROT_TEST_MAX_LINES 40

/* Counts a check of the function `name` (its __func__, compared by address). True if the failure
 * should be printed. Functions beyond the last place share that place. */
static inline int rot_test_count(int ok, const char *name) {
  if (rot_test_cases == 0 || rot_test_case[rot_test_current].name != name) {
    int i = 0;
    while (i < rot_test_cases && rot_test_case[i].name != name) i++;
    if (i == ROT_TEST_MAX_CASES) i--;
    if (i == rot_test_cases) rot_test_case[rot_test_cases++].name = name;
    rot_test_current = i;
  }
  if (ok) return 0;
  rot_test_case[rot_test_current].failed++;
  return ++rot_test_failed <= ROT_TEST_MAX_LINES;
}

/* How many of n random cases a test takes: all of them with ROTDYN_LONG (`make check-long`), a
 * quarter where the core is optimised (ROT_TEST_OPTIMISED of tests/core/run.sh, or a test program
 * that is), a sixteenth where each takes long: without optimisation (the sanitizers). */
static inline int rot_test_trials(int n) {
#if defined __OPTIMIZE__ || defined ROT_TEST_OPTIMISED
  const int part = 4;
#else
  const int part = 16;
#endif
  return getenv("ROTDYN_LONG") ? n : (n + part - 1) / part;
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

static inline void rot_test_true(int ok, const char *func, const char *file, int line,
                                 const char *what) {
  if (rot_test_count(ok, func)) printf("%s:%d: failed: %s\n", file, line, what);
}

static inline void rot_test_near(double off, double max, const char *unit, double got, double want,
                                 const char *func, const char *file, int line, const char *what) {
  /* Written so that a NaN distance or a NaN limit fails. */
  if (rot_test_count(off <= max, func))
    printf("%s:%d: failed: %s\n  got  %.17g\n  want %.17g\n  off by %.4g %s, allowed %.4g\n", file,
           line, what, got, want, off, unit, max);
}

static inline void rot_test_int(long long a, long long b, const char *func, const char *file,
                                int line, const char *what) {
  if (rot_test_count(a == b, func))
    printf("%s:%d: failed: %s\n  got  %lld\n  want %lld\n", file, line, what, a, b);
}

#define ROT_CHECK(cond) rot_test_true((cond) ? 1 : 0, __func__, __FILE__, __LINE__, #cond)

#define ROT_CHECK_ULP(got, want, max_ulp)                                                          \
  do {                                                                                             \
    const double rot_test_g_ = (got), rot_test_w_ = (want);                                        \
    rot_test_near(rot_test_ulp(rot_test_g_, rot_test_w_), (double)(max_ulp), "ulp", rot_test_g_,   \
                  rot_test_w_, __func__, __FILE__, __LINE__, #got " == " #want);                   \
  } while (0)

#define ROT_CHECK_REL(got, want, rel)                                                              \
  do {                                                                                             \
    const double rot_test_g_ = (got), rot_test_w_ = (want);                                        \
    rot_test_near(rot_test_rel(rot_test_g_, rot_test_w_), (double)(rel), "relative", rot_test_g_,  \
                  rot_test_w_, __func__, __FILE__, __LINE__, #got " == " #want);                   \
  } while (0)

#define ROT_CHECK_EQ_INT(a, b)                                                                     \
  rot_test_int((long long)(a), (long long)(b), __func__, __FILE__, __LINE__, #a " == " #b)

/* Prints the tests that failed and the closing line that tests/core/run.sh adds up; returns the
 * exit code of main(). A program without a check fails. */
static inline int rot_test_report(const char *topic) {
  int i, failed = 0;
  if (rot_test_failed > ROT_TEST_MAX_LINES)
    printf("(%ld more failures not shown)\n", rot_test_failed - ROT_TEST_MAX_LINES);
  for (i = 0; i < rot_test_cases; i++)
    if (rot_test_case[i].failed > 0) {
      printf("failed test: %s, %ld checks\n", rot_test_case[i].name, rot_test_case[i].failed);
      failed++;
    }
  printf("core %s: %d passed, %d failed\n", topic, rot_test_cases - failed, failed);
  return rot_test_cases == 0 || failed > 0;
}

#endif
