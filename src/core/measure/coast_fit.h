/* Fit of a coast-down to angles, rates or pulses: least squares on the exact motion with exact
 * derivatives; residuals whitened by a noise model from REML. */
#ifndef ROT_COAST_FIT_H
#define ROT_COAST_FIT_H

#include "measure/coast.h"
#include "maths/whiten.h"

typedef enum rot_coast_kind { ROT_COAST_ANGLES, ROT_COAST_RATES, ROT_COAST_PULSES } rot_coast_kind;

/* The parameters of the motion are followed by those of the runout: the measured angle is
 * theta + sum of c_h cos(h theta) + s_h sin(h theta). */
enum {
  ROT_COAST_HARMONICS = 2,
  ROT_COAST_RUNOUT = ROT_COAST_PARAMETERS,
  ROT_COAST_ALL = ROT_COAST_RUNOUT + 2 * ROT_COAST_HARMONICS
};

typedef struct rot_coast_record {
  rot_coast_kind kind;
  size_t n;
  const double *t; /* s; the first is the start of the motion */
  const double *y; /* angles, rates, or the angles of pulses at the times t */
  rot_coast_load load;
  const double *weight; /* n: s.d. of each sample in those of the noise, > 0; NULL: 1 */
} rot_coast_record;

typedef struct rot_coast_fit {
  double p[ROT_COAST_ALL];                         /* in: initial values; out: estimates */
  double covariance[ROT_COAST_ALL][ROT_COAST_ALL]; /* 0 for parameters that are not fitted */
  /* covariance = factor factor'; accurate for sums of nearly dependent parameters. */
  double factor[ROT_COAST_ALL][ROT_COAST_ALL];
  rot_reml reml;
  double squares;                          /* sum of squares of the whitened residuals */
  double sigma;                            /* s.d. of a residual: rad, rad/s, or s for pulses */
  double condition;                        /* of the Jacobian with columns of length 1 */
  size_t free;                             /* fitted parameters */
  size_t iterations;                       /* of all rounds */
  double runout_f;                         /* F statistic of the harmonics, NaN if undetermined */
  double runout_size[ROT_COAST_HARMONICS]; /* their amplitudes, rad */
  size_t runout_columns;                   /* independent columns of the harmonics */
} rot_coast_fit;

/* (record, parameters marked in `fitted`, initial fit->p, noise fit->reml) => fit */
rot_status rot_coast_solve(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit);
/* The same with the noise estimated in rounds of REML, and the F statistic of the runout.
 * `residual`: NULL, or n numbers, data minus model in the units of sigma; `white`: the same without
 * the correlation of the noise, by their weights. */
rot_status rot_coast_fit_noise(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                               double threshold, const rot_hooks *hooks, rot_coast_fit *fit,
                               double residual[], double white[]);
/* unbounded fit => fit with losses >= 0 (active set); at_bound: 1 for losses fixed at 0 */
rot_status rot_coast_bound(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit, int at_bound[3]);

#endif
