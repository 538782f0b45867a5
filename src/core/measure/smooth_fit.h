/* Parameters of the smoother by likelihood: smoothness, scatter, order; records as nodes.
 *
 * -2 log L = sum log F + v^2/(sigma^2 F) over the samples after the first six of each segment, with
 * sigma^2 profiled. Without the first six it is a predictive likelihood, comparable between orders.
 */
#ifndef ROT_SMOOTH_FIT_H
#define ROT_SMOOTH_FIT_H

#include "measure/smooth.h"

/* A record: samples ordered by segment, then by time. */
typedef struct rot_smooth_record {
  size_t n;
  const double *time_s;
  const double *y[ROT_SMOOTH_CHANNELS]; /* rad, rad/s; NaN: no sample; NULL: none */
  double *w[ROT_SMOOTH_CHANNELS];       /* relative s.d.; Inf: excluded; NULL: all 1 */
  const int *segment;                   /* does not decrease; NULL: one segment */
  double floor[ROT_SMOOTH_CHANNELS];    /* min scatter: rad, rad/s */
  /* Correlated part of the errors of one channel; NULL: none. */
  const double *slow;  /* its s.d. relative to w */
  const double *clock; /* time in correlation times, non-decreasing in a segment */
  int slow_channel;
} rot_smooth_record;

/* A break, ordered like the record. */
typedef struct rot_smooth_break {
  double time_s;
  int segment;
  int first; /* 1: omega jumps, 2: omega', 3: omega'' */
} rot_smooth_break;

/* Other times at which the motion is wanted, ordered like the record. */
typedef struct rot_smooth_times {
  size_t n;
  const double *time_s;
  const int *segment; /* NULL: one segment */
} rot_smooth_times;

/* A record as nodes. */
typedef struct rot_smooth_grid {
  rot_smooth_nodes nodes;
  double unit_s;    /* h0, the mean spacing */
  size_t *sample;   /* node of each sample */
  size_t *other;    /* node of each other time */
  size_t *at_break; /* node after each break */
  double *gap, *slow, *keep, *y[ROT_SMOOTH_CHANNELS], *w[ROT_SMOOTH_CHANNELS]; /* of the nodes */
  signed char *first;
  void *memory;
} rot_smooth_grid;

/* Allocates nodes for a record, up to max_breaks breaks and `others` other times. */
rot_status rot_smooth_grid_new(rot_smooth_grid *grid, const rot_smooth_record *record,
                               size_t max_breaks, size_t others);
/* Frees them. */
void rot_smooth_grid_free(rot_smooth_grid *grid);
/* (record, breaks, other times or NULL) => nodes. `ratio`: scatter of rates times h0 over that of
 * angles; 1 if only one of them is measured. */
void rot_smooth_grid_fill(rot_smooth_grid *grid, const rot_smooth_record *record, double ratio,
                          size_t n_breaks, const rot_smooth_break *breaks,
                          const rot_smooth_times *others);

/* Best smoothness: within its range, or at an end: a polynomial, or interpolation of the samples.
 */
enum { ROT_SMOOTH_WITHIN, ROT_SMOOTH_POLYNOMIAL, ROT_SMOOTH_JOINS };

typedef struct rot_smooth_fit {
  rot_smooth_model model;
  double ratio;     /* as in rot_smooth_grid_fill() */
  double sigma;     /* rad; of rates only: rad/s times h0 */
  double objective; /* -2 log L */
  double degrees;   /* of freedom: samples minus those of the smoother */
  int end;          /* ROT_SMOOTH_WITHIN, ... */
  size_t samples;
  size_t fresh; /* states made diffuse by breaks */
} rot_smooth_fit;

/* model => -2 log L, sigma (profiled, at least `floor`), sums */
double rot_smooth_objective(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                            double floor, double *sigma, rot_smooth_sums *sums);
/* => lower limit of sigma on this grid */
double rot_smooth_floor(const rot_smooth_grid *grid, const rot_smooth_record *record, double ratio);

/* (record, breaks) => fit: best order from first_order to last_order, lambda, and ratio if both
 * channels are measured. If `near` is not NULL, the search starts at its order and ratio. `degrees`
 * is not filled. */
rot_status rot_smooth_search(rot_smooth_grid *grid, const rot_smooth_record *record,
                             size_t n_breaks, const rot_smooth_break *breaks, int first_order,
                             int last_order, const rot_smooth_fit *near, const rot_hooks *hooks,
                             rot_smooth_fit *fit);

/* Refines the fit of an angle with known breaks: a higher order, up to last_order, if it predicts
 * better; a smaller lambda if cross-validation requires it. Fits of other records, and those that
 * interpolate the samples, are unchanged. */
rot_status rot_smooth_refine(const rot_smooth_record *record, size_t n_breaks,
                             const rot_smooth_break *breaks, int last_order, const rot_hooks *hooks,
                             rot_smooth_fit *fit);

#endif
