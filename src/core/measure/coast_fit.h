/* A coast-down fitted to angles, rates or pulses: least squares on the exact motion with its exact
 * derivatives, residuals whitened by a noise that REML finds. */
#ifndef ROT_COAST_FIT_H
#define ROT_COAST_FIT_H

#include "measure/coast.h"
#include "maths/whiten.h"

typedef enum rot_coast_kind { ROT_COAST_ANGLES, ROT_COAST_RATES, ROT_COAST_PULSES } rot_coast_kind;

/* After the parameters of the motion come those of the runout: the angle read is
 * theta + sum of c_h cos(h theta) + s_h sin(h theta). */
enum {
  ROT_COAST_HARMONICS = 2,
  ROT_COAST_RUNOUT = ROT_COAST_PARAMETERS,
  ROT_COAST_ALL = ROT_COAST_RUNOUT + 2 * ROT_COAST_HARMONICS
};

/* y: angles, rates, or the angles at which pulses at the times t come. The first time is the start
 * of the motion. */
typedef struct rot_coast_record {
  rot_coast_kind kind;
  size_t n;
  const double *t, *y;
  rot_coast_load load;
} rot_coast_record;

typedef struct rot_coast_fit {
  double p[ROT_COAST_ALL];                         /* in: the start; out: the estimate */
  double covariance[ROT_COAST_ALL][ROT_COAST_ALL]; /* 0 where a parameter is not fitted */
  /* The covariance is this times its transpose. The error of a sum of nearly dependent parameters
   * keeps its digits in it. */
  double factor[ROT_COAST_ALL][ROT_COAST_ALL];
  rot_reml reml;
  double squares; /* sum of squares of the whitened residuals */
  double sigma;   /* s.d. of a residual: rad, rad/s, or s for pulses */
  double condition;
  size_t free, iterations;
  double runout_f;                         /* F of the harmonics, NaN where they are unknown */
  double runout_size[ROT_COAST_HARMONICS]; /* their amplitudes, rad */
  size_t runout_columns;
} rot_coast_fit;

/* Fits what `fitted` marks, from fit->p, with the noise of fit->reml. */
rot_status rot_coast_solve(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit);
/* The same with the noise found by rounds of REML; then the runout's F. `residual`: NULL, or n
 * numbers, data minus model in the units of sigma. */
rot_status rot_coast_fit_noise(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                               double threshold, const rot_hooks *hooks, rot_coast_fit *fit,
                               double residual[]);
/* From an unbounded fit to one with no loss below 0 (an active set); `at_bound` marks the losses
 * that are held at 0. */
rot_status rot_coast_bound(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit, int at_bound[3]);

#endif
