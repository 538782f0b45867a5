/* What R loads: the clock, and the right-hand side as deSolve calls it. */
#include "clock.h"
#include "spin-up.h"

void bench_clock_us(double *us);
void spin_rates_for_desolve(int *n, double *t, double *y, double *rates, double *out, int *ip);

void bench_clock_us(double *us) { *us = clock_us(); }

void spin_rates_for_desolve(int *n, double *t, double *y, double *rates, double *out, int *ip) {
  (void)n, (void)out, (void)ip;
  spin_rates(*t, y, rates);
}
