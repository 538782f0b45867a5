/* What a fit is asked, records of a motion and what is unknown in it, and what it gives. */

#ifndef ROT_FIT_PROBLEM_H
#define ROT_FIT_PROBLEM_H

#include "fit/counts.h"
#include "fit/motion.h"
#include "maths/trust_region.h"
#include "maths/whiten.h"

enum { ROT_FIT_NONE = -1 };

/* One observed column of a record. y = offset + factor * motion. */
typedef struct rot_fit_series {
  rot_fit_column of;
  const double *y;      /* n; NaN: not measured */
  const double *weight; /* n: s.d. of each sample in those of the noise, > 0; NULL: 1 */
  int offset, factor;   /* unknowns, or ROT_FIT_NONE */
  double rounding;      /* of its numbers */
  double floor;         /* of the s.d. of the noise: a counter's */
  double count;         /* > 0: y are counts of this size, rounded; 0: they are not */
} rot_fit_series;

typedef struct rot_fit_record {
  size_t n;
  const double *time_s;
  const int *unknown;  /* of each path: the unknown that it is, or ROT_FIT_NONE */
  const double *value; /* of each path that is none */
  int shift;           /* unknown: s, added to the times; or ROT_FIT_NONE */
  size_t n_series;
  const rot_fit_series *series;
} rot_fit_record;

/* Of one series. */
typedef struct rot_fit_noise {
  rot_reml reml;
  double sigma;
  size_t n; /* samples */
} rot_fit_noise;

typedef struct rot_fit_problem {
  const rot_object *scene;
  size_t n_inputs;
  const char *const *inputs;
  size_t n_records;
  const rot_fit_record *records;
  size_t n_unknowns;    /* up to ROT_FIT_UNKNOWNS */
  const int *logarithm; /* 1: of positive ones, the fit's variable is the logarithm */
  const double *low, *high;
  const double *prior, *prior_sd; /* NaN: none */
  double accuracy, max_steps;
  double threshold;           /* of the noise: gain of the likelihood; Inf: white */
  const rot_fit_noise *noise; /* of each series; NULL: it is found */
  rot_fit_run run;            /* computes the motions instead of the core, or NULL */
  void *ctx;
} rot_fit_problem;

/* Memory of the caller: p = n_unknowns; wave: p, the part of the variance that is one harmonic of
 * the counts of one series, whose distribution is that of a sine; covariance, factor, triangle: p x
 * p, of the fit's variables; noise: one for each series, in order; fitted: n of each series in
 * order, offset + factor * motion; white: data minus fitted in standard deviations, without the
 * correlation of the noise; NaN where not measured. */
typedef struct rot_fit {
  double *x;
  int *held; /* 1: at the edge of its domain, -1 low, 1 high */
  double *wave;
  double *covariance, *factor, *triangle;
  rot_fit_noise *noise;
  double *fitted, *white;
  double squares; /* of the whitened residuals */
  double condition;
  size_t samples, iterations, runs;
  const rot_model *model;
} rot_fit;

#endif
