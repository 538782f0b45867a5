/* A child of bench/peers.R: solves and prints, or times itself.
 *
 *   PROGRAM HOW FILE solve
 *   PROGRAM HOW FILE time BATCHES MICROSECONDS */
#ifndef BENCH_CHILD_H
#define BENCH_CHILD_H

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clock.h"

typedef struct solution {
  size_t n;
  double *time_s, *theta_rad, *omega_rad_per_s;
  long rhs_calls;
} solution;

typedef int (*solver)(const char *how, solution *s); /* 0 for success */

/* Columns as long as the rows, as R has them: their place in memory counts, too. */
static int read_times(const char *file, solution *s) {
  FILE *in = fopen(file, "r");
  double t;
  s->n = 0;
  if (!in) return 1;
  while (fscanf(in, "%lf", &t) == 1) s->n++;
  s->time_s = malloc(s->n * sizeof t + 1);
  s->theta_rad = malloc(s->n * sizeof t + 1);
  s->omega_rad_per_s = malloc(s->n * sizeof t + 1);
  if (!s->time_s || !s->theta_rad || !s->omega_rad_per_s) return 1;
  rewind(in);
  for (size_t i = 0; i < s->n; i++) {
    if (fscanf(in, "%lf", &s->time_s[i]) != 1) return 1;
  }
  fclose(in);
  return s->n == 0;
}

static double time_batch(solver solve, const char *how, solution *s, long calls) {
  const double from = clock_us();
  for (long i = 0; i < calls; i++) solve(how, s);
  return (clock_us() - from) / (double)calls;
}

static double take_turn(solver solve, const char *how, solution *s, int batches, double batch_us) {
  long calls = 1;
  double us, best = 0.0;
  while ((us = time_batch(solve, how, s, calls)) * (double)calls < batch_us / 4.0) calls *= 4;
  calls = us < batch_us ? (long)(batch_us / us) + 1 : 1;
  for (int b = 0; b < batches; b++) {
    us = time_batch(solve, how, s, calls);
    if (b == 1 || (b > 1 && us < best)) best = us;
  }
  return best;
}

static int child_main(int argc, char **argv, solver solve) {
  solution s = {0, NULL, NULL, NULL, 0};
  if (argc < 4 || read_times(argv[2], &s) || solve(argv[1], &s)) return EXIT_FAILURE;
  if (argc == 6 && !strcmp(argv[3], "time")) {
    printf("%.17g\n", take_turn(solve, argv[1], &s, atoi(argv[4]), atof(argv[5])));
  } else {
    for (size_t i = 0; i < s.n; i++) printf("%a %a\n", s.theta_rad[i], s.omega_rad_per_s[i]);
    printf("%ld\n", s.rhs_calls);
  }
  free(s.time_s);
  free(s.theta_rad);
  free(s.omega_rad_per_s);
  return EXIT_SUCCESS;
}

#endif
