/* Nanoseconds a sample of the smoother's likelihood, 1e5 samples, even and uneven; the least of
 * several runs, the worst over orders and smoothness. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "measure/smooth_fit.h"

static double worst(size_t n, int uneven) {
  double *t = malloc(n * sizeof *t), *y = malloc(n * sizeof *y), most = 0.0;
  for (size_t i = 0; i < n; i++) {
    const double u = (double)rand() / RAND_MAX, v = (double)rand() / RAND_MAX;
    t[i] = 0.02 * ((double)i + (uneven ? 0.4 * u : 0.0));
    y[i] = 10.0 * sin(0.5 * t[i]) + 1e-3 * sqrt(12.0) * (v - 0.5);
  }
  rot_smooth_record record = {n, t, {y, NULL}, {NULL, NULL}, NULL, {0.0, 0.0}};
  rot_smooth_grid grid;
  if (rot_smooth_grid_new(&grid, &record, 0, 0) != ROT_OK) return NAN;
  rot_smooth_grid_fill(&grid, &record, 1.0, 0, NULL, NULL);
  for (int order = 3; order <= 4; order++)
    for (int e = -10; e <= 2; e += 4) {
      const rot_smooth_model model = {order, pow(10.0, e)};
      double least = HUGE_VAL, sigma;
      for (int run = 0; run < 5; run++) {
        rot_smooth_sums sums;
        const clock_t from = clock();
        (void)rot_smooth_objective(&grid.nodes, &model, 0.0, &sigma, &sums);
        least = fmin(least, (double)(clock() - from) / CLOCKS_PER_SEC);
      }
      most = fmax(most, least * 1e9 / (double)n);
    }
  rot_smooth_grid_free(&grid);
  free(t);
  free(y);
  return most;
}

int main(void) {
  printf("%.1f %.1f\n", worst(100000, 0), worst(100000, 1));
  return 0;
}
