#include "ground/sort.h"

#include <math.h>

#include "rot_test.h"

static void check_sort(void) {
  double x[] = {3.0, -INFINITY, 2.0, 2.0, INFINITY, -1.0}, in_order[] = {-1.0, 0.5, 0.5, 2.0};
  const double want[] = {-INFINITY, -1.0, 2.0, 2.0, 3.0, INFINITY};
  rot_sort(6, x);
  for (int i = 0; i < 6; i++) ROT_CHECK(x[i] == want[i]);
  ROT_CHECK_EQ_INT((long)rot_sort_once(6, x), 5);
  ROT_CHECK(x[0] == -INFINITY && x[2] == 2.0 && x[3] == 3.0 && x[4] == INFINITY);
  ROT_CHECK_EQ_INT((long)rot_sort_once(4, in_order), 3);
  ROT_CHECK(in_order[1] == 0.5 && in_order[2] == 2.0);
  double falls[] = {2.0, 1.0, 0.0};
  ROT_CHECK_EQ_INT((long)rot_sort_once(3, falls), 3);
  ROT_CHECK(falls[0] == 0.0 && falls[2] == 2.0);
  ROT_CHECK_EQ_INT((long)rot_sort_once(1, x), 1);
  ROT_CHECK_EQ_INT((long)rot_sort_once(0, NULL), 0);
}

int main(void) {
  check_sort();
  return rot_test_report("sort");
}
