/* Bounds in increasing numbers, against a count one by one. */
#include <math.h>

#include "ground/search.h"
#include "rot_test.h"

enum { MAX = 40 };

static void check_all(size_t n, const double x[]) {
  static const double near[] = {-HUGE_VAL, -0.5, 0.0, 0.5, HUGE_VAL};
  size_t wrong = 0;
  for (size_t at = 0; at <= n; at++) {
    for (size_t k = 0; k < sizeof near / sizeof near[0]; k++) {
      const double t = (at < n ? x[at] : 1e9) + near[k];
      size_t below = 0, upto = 0;
      for (size_t i = 0; i < n; i++) {
        below += x[i] < t;
        upto += x[i] <= t;
      }
      wrong += rot_lower_bound(n, x, t) != below || rot_upper_bound(n, x, t) != upto ||
               rot_bound(n, x, t, 0) != below || rot_bound(n, x, t, 1) != upto;
    }
  }
  ROT_CHECK_EQ_INT(wrong, 0);
}

int main(void) {
  double x[MAX];
  for (size_t n = 0; n <= MAX; n++) {
    for (size_t step = 1; step <= 5; step++) { /* runs of `step` equal numbers */
      for (size_t i = 0; i < n; i++) x[i] = (double)(i / step) - 3.0;
      check_all(n, x);
    }
  }
  static const double ends[] = {-HUGE_VAL, -1e308, -5e-324, -0.0, 0.0, 5e-324, 1e308, HUGE_VAL};
  check_all(8, ends);
  ROT_CHECK_EQ_INT(rot_lower_bound(8, ends, 0.0), 3);
  ROT_CHECK_EQ_INT(rot_upper_bound(8, ends, -0.0), 5);
  ROT_CHECK_EQ_INT(rot_upper_bound(8, ends, HUGE_VAL), 8);
  ROT_CHECK_EQ_INT(rot_lower_bound(8, ends, NAN), 0);
  ROT_CHECK_EQ_INT(rot_upper_bound(8, ends, NAN), 0);
  ROT_CHECK_EQ_INT(rot_lower_bound(0, NULL, 1.0), 0);
  return rot_test_report("search");
}
