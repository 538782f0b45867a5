#include "ground/sort.h"

#include <stdlib.h>

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Most inputs (knots, rows) are sorted already. */
void rot_sort(size_t n, double x[]) {
  size_t sorted = 1;
  while (sorted < n && x[sorted - 1] <= x[sorted]) sorted++;
  if (sorted < n) qsort(x, n, sizeof *x, by_size);
}

size_t rot_sort_once(size_t n, double x[]) {
  size_t kept = 0;
  rot_sort(n, x);
  for (size_t i = 0; i < n; i++) {
    if (kept == 0 || x[i] != x[kept - 1]) x[kept++] = x[i];
  }
  return kept;
}
