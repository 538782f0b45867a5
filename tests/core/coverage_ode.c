/* How well the integrator's error estimate covers its error, and what it costs: random smooth
 * scenes at accuracies from 1e-3 to 1e-12. Run by hand:
 *
 *   cc -O2 -Isrc tests/core/coverage_ode.c src/rot_*.c -lgsl -lgslcblas -lm && ./a.out 1000
 *
 * The truth is the same run at accuracy 1e-13 with rows landed on by steps of a tenth. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rot_ode.h"

enum { MOST_ROWS = 1000, KINDS = 6 };

typedef struct scene {
  int kind;
  double a, b, c, d;
  long calls;
} scene;

static double uniform(double low, double high) {
  return low + (high - low) * ((double)rand() / (double)RAND_MAX);
}

static rot_status rhs(double t, const double y[], double f[], void *ctx) {
  scene *s = ctx;
  const double theta = y[0], omega = y[1];
  double torque = 0.0;
  s->calls++;
  switch (s->kind) {
  case 0: torque = -s->a * s->a * sin(theta) - s->c * omega; break;            /* pendulum */
  case 1: torque = s->a * cos(s->b * t) - s->c * omega - s->d * theta; break;  /* driven */
  case 2: torque = s->a * (1.0 - theta * theta) * omega - s->b * theta; break; /* van der Pol */
  case 3: torque = s->a - s->b * omega * omega * omega - s->c * tanh(theta); break;
  case 4: torque = s->a * exp(-s->b * t) * sin(s->d * t * t) - s->c * omega; break;
  case 5: torque = -s->a * sin(theta) + s->b * cos(s->d * t) - s->c * omega; break; /* chaos */
  default: break;
  }
  f[0] = omega;
  f[1] = torque;
  return ROT_OK;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int main(int argc, char **argv) {
  const int scenes = argc > 1 ? atoi(argv[1]) : 200;
  static double y[2 * MOST_ROWS], best[2 * MOST_ROWS], t[MOST_ROWS];
  double *ratio = malloc((size_t)scenes * sizeof *ratio);
  if (!ratio) return 1;
  for (int digits = 3; digits <= 12; digits++) {
    int covered = 0, counted = 0, met = 0, by_kind[KINDS] = {0};
    double calls = 0.0, worst = INFINITY;
    srand(7);
    for (int k = 0; k < scenes; k++) {
      scene s = {k % KINDS,         uniform(0.5, 3.0), uniform(0.5, 3.0),
                 uniform(0.0, 0.5), uniform(0.2, 2.0), 0};
      const double start[] = {uniform(-2.0, 2.0), uniform(-2.0, 2.0)}, end = uniform(2.0, 20.0);
      const size_t rows = k % 3 == 0 ? 5 : k % 3 == 1 ? 100 : MOST_ROWS;
      rot_ode_params p = {
          2,    2,    rhs, &s, 0, NULL, 0.0, start, pow(10.0, -digits), 1000000, ROT_METHOD_NONE,
          NULL, NULL, 1};
      double error[2], largest[2], unused[2], most[2];
      rot_info info;
      for (size_t i = 0; i < rows; i++) t[i] = end * (double)(i + 1) / (double)rows;
      if (rot_ode_run(&p, rows, t, y, NULL, error, largest, NULL, &info) != ROT_OK) continue;
      calls += (double)s.calls;
      p.accuracy = 1e-13;
      if (rot_ode_run(&p, rows, t, best, NULL, unused, most, NULL, &info) != ROT_OK) continue;
      double got = 0.0, said = 0.0, lowest = INFINITY;
      for (size_t c = 0; c < 2; c++) {
        double true_error = 0.0;
        for (size_t i = 0; i < rows; i++) {
          true_error = fmax(true_error, fabs(y[2 * i + c] - best[2 * i + c]));
        }
        if (!(unused[c] <= 0.1 * true_error)) continue;
        if (error[c] / true_error < lowest) {
          lowest = error[c] / true_error;
          got = true_error / most[c];
          said = error[c] / largest[c];
        }
      }
      if (!(got > 0.0)) continue;
      met += said <= p.accuracy || said <= pow(10.0, -digits);
      ratio[counted++] = lowest;
      covered += lowest >= 1.0;
      if (lowest < 1.0) by_kind[s.kind]++;
      worst = fmin(worst, lowest);
    }
    qsort(ratio, (size_t)counted, sizeof *ratio, by_size);
    printf("1e-%02d: %4d of %4d covered (%.1f%%), lowest %.3f, median %.1f, 95%% below %.0f; met "
           "%.1f%%; calls %.0f; misses",
           digits, covered, counted, 100.0 * covered / counted, worst, ratio[counted / 2],
           ratio[counted * 95 / 100], 100.0 * met / counted, calls / scenes);
    for (int k = 0; k < KINDS; k++) printf(" %d", by_kind[k]);
    printf("\n");
  }
  free(ratio);
  return 0;
}
