/* How well the integrator's error estimate covers its error, and what it costs: random smooth
 * scenes at accuracies from 1e-3 to 1e-12. Run by hand:
 *
 *   cc -O2 -Isrc/core bench/coverage/ode.c $(find src/core -name '*.c') \
 *     -lgsl -lgslcblas -lm && ./a.out 1000
 *
 * For each accuracy: scenes whose errors are all covered, the lowest, median and 95 % of the
 * estimate over the true error (the worse component), calls a scene, misses by kind of scene. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/ode.h"

enum { MOST_ROWS = 1000, KINDS = 6 };

typedef struct scene {
  int kind;
  double a, b, c, d;
  long calls;
} scene;

static double uniform(double low, double high) {
  return low + (high - low) * ((double)rand() / (double)RAND_MAX);
}

/* The same law for double and long double. */
#define LAW(name, real, SIN, COS, EXP, TANH)                                                       \
  static real name(const scene *s, real t, real theta, real omega) {                               \
    const real a = s->a, b = s->b, c = s->c, d = s->d;                                             \
    switch (s->kind) {                                                                             \
    case 0: return -a * a * SIN(theta) - c * omega;                 /* pendulum */                 \
    case 1: return a * COS(b * t) - c * omega - d * theta;          /* driven */                   \
    case 2: return a * (1 - theta * theta) * omega - b * theta;     /* van der Pol */              \
    case 3: return a - b * omega * omega * omega - c * TANH(theta); /* a fan */                    \
    case 4: return a * EXP(-b * t) * SIN(d * t * t) - c * omega;    /* a chirp that fades */       \
    default: return -a * SIN(theta) + b * COS(d * t) - c * omega;   /* chaos */                    \
    }                                                                                              \
  }
LAW(law, double, sin, cos, exp, tanh)
LAW(long_law, long double, sinl, cosl, expl, tanhl)

static rot_status rhs(double t, const double y[], double f[], void *ctx) {
  scene *s = ctx;
  s->calls++;
  f[0] = y[1];
  f[1] = law(s, t, y[0], y[1]);
  return ROT_OK;
}

/* The truth: Gragg's midpoint rule, extrapolated eight times (order 16), in long double. */
static void gragg(const scene *s, long double t, long double h, long double y[2]) {
  enum { LEVELS = 8 };
  long double table[LEVELS][2];
  for (int k = 0; k < LEVELS; k++) {
    const int n = 2 * (k + 1);
    const long double step = h / n;
    long double before[2] = {y[0], y[1]};
    long double now[2] = {y[0] + step * y[1], y[1] + step * long_law(s, t, y[0], y[1])};
    for (int i = 1; i < n; i++) {
      const long double f = long_law(s, t + i * step, now[0], now[1]);
      const long double next[2] = {before[0] + 2 * step * now[1], before[1] + 2 * step * f};
      for (int c = 0; c < 2; c++) {
        before[c] = now[c];
        now[c] = next[c];
      }
    }
    const long double f = long_law(s, t + h, now[0], now[1]);
    table[k][0] = (now[0] + before[0] + step * now[1]) / 2;
    table[k][1] = (now[1] + before[1] + step * f) / 2;
    for (int j = k - 1; j >= 0; j--) {
      const long double ratio = (long double)(k + 1) / (j + 1);
      for (int c = 0; c < 2; c++) {
        table[j][c] = table[j + 1][c] + (table[j + 1][c] - table[j][c]) / (ratio * ratio - 1);
      }
    }
  }
  y[0] = table[0][0];
  y[1] = table[0][1];
}

static void truth(const scene *s, const double start[2], size_t n, const double t[],
                  long double y_rows[], double most[2]) {
  long double y[2] = {start[0], start[1]}, at = 0;
  for (int c = 0; c < 2; c++) most[c] = fabs(start[c]);
  for (size_t i = 0; i < n; i++) {
    const int steps = 1 + (int)(40 * (t[i] - at));
    const long double h = (t[i] - at) / steps;
    for (int k = 0; k < steps; k++) {
      gragg(s, at + k * h, h, y);
      for (int c = 0; c < 2; c++) most[c] = fmax(most[c], (double)fabsl(y[c]));
    }
    at = t[i];
    for (int c = 0; c < 2; c++) y_rows[2 * i + (size_t)c] = y[c];
  }
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int main(int argc, char **argv) {
  const int scenes = argc > 1 ? atoi(argv[1]) : 200;
  static double y[2 * MOST_ROWS], t[MOST_ROWS];
  static long double best[2 * MOST_ROWS];
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
      const size_t rows = (const size_t[]){1, 5, 100, MOST_ROWS}[k / KINDS % 4];
      const rot_ode_params p = {.dim = 2,
                                .controlled = 2,
                                .rhs = rhs,
                                .ctx = &s,
                                .start = start,
                                .accuracy = pow(10.0, -digits),
                                .max_steps = 1000000,
                                .sloped = 1};
      double error[2], largest[2], most[2];
      rot_info info;
      for (size_t i = 0; i < rows; i++) t[i] = end * (double)(i + 1) / (double)rows;
      if (rot_ode_run(&p, rows, t, y, NULL, error, largest, NULL, &info) != ROT_OK) continue;
      calls += (double)s.calls;
      truth(&s, start, rows, t, best, most);
      double got = 0.0, said = 0.0, lowest = INFINITY;
      for (size_t c = 0; c < 2; c++) {
        double true_error = 0.0;
        for (size_t i = 0; i < rows; i++) {
          true_error = fmax(true_error, (double)fabsl(y[2 * i + c] - best[2 * i + c]));
        }
        if (error[c] / true_error < lowest) {
          lowest = error[c] / true_error;
          got = true_error / most[c];
          said = error[c] / largest[c];
        }
      }
      if (!(got > 0.0)) continue;
      met += said <= p.accuracy;
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
