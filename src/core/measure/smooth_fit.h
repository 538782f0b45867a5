/* The smoother's parameters by likelihood: smoothness, scatter, order; records as nodes.
 *
 * -2 log L = sum log F + v^2/(sigma^2 F) over the samples after the first six of each segment, with
 * sigma^2 profiled. Leaving these out makes orders comparable: it is a predictive likelihood. */
#ifndef ROT_SMOOTH_FIT_H
#define ROT_SMOOTH_FIT_H

#include "measure/smooth.h"

/* A record: samples in the order of their segments, and of time in each. */
typedef struct rot_smooth_record {
  size_t n;
  const double *time_s;
  const double *y[ROT_SMOOTH_CHANNELS]; /* rad, rad/s; NaN: no sample; NULL: none */
  double *w[ROT_SMOOTH_CHANNELS];       /* s.d. relative to others; Inf: left out; NULL: all 1 */
  const int *segment;                   /* does not decrease; NULL: one */
  double floor[ROT_SMOOTH_CHANNELS];    /* least scatter: rad, rad/s */
  /* The correlated part of the errors of one channel: its s.d. relative to w, and the time of each
   * sample in correlation times, which does not decrease in a segment. NULL: none. */
  const double *slow, *clock;
  int slow_channel;
} rot_smooth_record;

/* A break, ordered as the record is. */
typedef struct rot_smooth_break {
  double time_s;
  int segment, first; /* 1: omega jumps, 2: its derivative does */
} rot_smooth_break;

/* Other times at which the motion is asked for, ordered as the record is. */
typedef struct rot_smooth_times {
  size_t n;
  const double *time_s;
  const int *segment; /* NULL: one */
} rot_smooth_times;

/* A record as nodes, with room for `most_breaks` breaks. */
typedef struct rot_smooth_grid {
  rot_smooth_nodes nodes;
  double unit_s;                     /* h0: the mean spacing */
  size_t *sample, *other, *at_break; /* their nodes; a break's is that behind it */
  double *gap, *slow, *keep, *y[ROT_SMOOTH_CHANNELS], *w[ROT_SMOOTH_CHANNELS];
  signed char *first;
  void *memory;
} rot_smooth_grid;

rot_status rot_smooth_grid_new(rot_smooth_grid *grid, const rot_smooth_record *record,
                               size_t max_breaks, size_t others);
void rot_smooth_grid_free(rot_smooth_grid *grid);
/* `ratio`: the scatter of rates times h0 over that of angles, 1 where one of them is measured. */
void rot_smooth_grid_fill(rot_smooth_grid *grid, const rot_smooth_record *record, double ratio,
                          size_t n_breaks, const rot_smooth_break *breaks,
                          const rot_smooth_times *others);

/* Where the best smoothness lies: within its range, or a polynomial fits, or samples are joined. */
enum { ROT_SMOOTH_WITHIN, ROT_SMOOTH_POLYNOMIAL, ROT_SMOOTH_JOINS };

typedef struct rot_smooth_fit {
  rot_smooth_model model;
  double ratio;
  double sigma;     /* rad; of rates alone rad/s times h0 */
  double objective; /* -2 log L */
  double degrees;   /* of freedom: samples less what the smoother uses up */
  int end;
  size_t samples, fresh;
} rot_smooth_fit;

/* -2 log L at a model; sigma is profiled above `floor`. */
double rot_smooth_objective(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                            double floor, double *sigma, rot_smooth_sums *sums);
/* sigma's least value on this grid. */
double rot_smooth_floor(const rot_smooth_grid *grid, const rot_smooth_record *record, double ratio);

/* Orders first..last, the ratio where both channels are measured, lambda for each. With `near` not
 * NULL the search begins about that fit, at its order and ratio. Does not fill `degrees`. */
rot_status rot_smooth_search(rot_smooth_grid *grid, const rot_smooth_record *record,
                             size_t n_breaks, const rot_smooth_break *breaks, int first_order,
                             int last_order, const rot_smooth_fit *near, const rot_hooks *hooks,
                             rot_smooth_fit *fit);

/* An angle's fit with its breaks known: a higher order up to `last_order` where that predicts
 * better, and a smaller lambda where cross-validation asks for it. Other records, and those whose
 * samples are joined, keep theirs. */
rot_status rot_smooth_refine(const rot_smooth_record *record, size_t n_breaks,
                             const rot_smooth_break *breaks, int last_order, const rot_hooks *hooks,
                             rot_smooth_fit *fit);

#endif
