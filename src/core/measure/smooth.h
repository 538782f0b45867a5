/* Samples of an angle, of a rate, or of both, smoothed: the motion is an integrated Wiener process.
 *
 * The state is x_i = theta^(i) h0^i / i!, i < order, with the mean spacing h0. Over a gap of s h0
 *
 *   A_ij = C(j,i) s^(j-i),
 *   Q_ij = lambda s^(2p-1-i-j) / [(2p-1-i-j) (p-1-i)! (p-1-j)! i! j!],
 *
 * variances in units of sigma^2. The error of a sample is white, or white and an Ornstein-Uhlenbeck
 * process of variance 1, which is one state more. Filter and smoother keep factors S with S'S = P
 * and never subtract covariances: no variance is negative. The plain and the Joseph form err by
 * factors of 1.1 to 5e5 behind a gap of 1000 spacings.
 *
 * References: Park & Kailath, IEEE Trans. Automat. Contr. 40 (1995) 727 (square-root smoother);
 * de Jong & Penzer, J. Amer. Statist. Assoc. 93 (1998) 796 (scores of shocks). */
#ifndef ROT_SMOOTH_H
#define ROT_SMOOTH_H

#include <stddef.h>

#include "ground/status.h"

enum { ROT_SMOOTH_MIN = 2, ROT_SMOOTH_MAX = 5 }; /* orders */
enum { ROT_SMOOTH_ANGLE, ROT_SMOOTH_RATE, ROT_SMOOTH_CHANNELS };
enum {
  ROT_SMOOTH_SKIPPED = 6, /* first samples of a segment: the likelihood leaves them out */
  ROT_SMOOTH_BEHIND = 4   /* first samples behind a break: left out where orders are compared */
};

/* How the state reaches a node. A break is a node at the time of the one before it, where the
 * states from `first` on are forgotten: 1 where omega jumps, 2 where its derivative does, 3 where
 * the derivative of that does. */
enum { ROT_SMOOTH_FLOWS = -1, ROT_SMOOTH_STARTS = 0 };

/* Nodes in the order of time: samples, breaks, other times. Node 0 starts. */
typedef struct rot_smooth_nodes {
  size_t n;
  const double *gap;                    /* from the node before, in h0; 0 at a break */
  const double *y[ROT_SMOOTH_CHANNELS]; /* rad; rad/s times h0. NaN: no sample. NULL: none */
  const double *w[ROT_SMOOTH_CHANNELS]; /* their s.d. in units of sigma, greater than 0 */
  const signed char *first;             /* FLOWS, STARTS, or the first state that is forgotten */
  size_t settles; /* samples behind a start or break that comparing orders leaves out, if more */
  /* The correlated part of the samples' errors in one channel, a state of variance 1: its s.d. in
   * units of sigma, and its correlation with the node before, 0 to 1. NULL: none. */
  const double *slow, *keep;
  int slow_channel;
} rot_smooth_nodes;

typedef struct rot_smooth_model {
  int order;
  double lambda; /* q h0^(2 order - 1) / sigma^2 */
} rot_smooth_model;

/* States of a node: those of the motion, then the correlated part of the errors. */
int rot_smooth_states(const rot_smooth_nodes *nodes, int order);

/* What the filter stores of each node where the arrays are given: all, or none (NULL). */
typedef struct rot_smooth_store {
  double *x, *s; /* states, states^2 of each node: filtered mean; factor by rows, upper triangle */
  double *v[ROT_SMOOTH_CHANNELS], *f[ROT_SMOOTH_CHANNELS]; /* innovation, its variance; f 0: none */
  double *k[ROT_SMOOTH_CHANNELS];                          /* states of each node: gain */
} rot_smooth_store;

rot_status rot_smooth_store_new(rot_smooth_store *store, size_t n, int states);
void rot_smooth_store_free(rot_smooth_store *store);

/* Sums over the samples that count: those after the first ROT_SMOOTH_SKIPPED of a segment. The
 * diffuse variances of forgotten states are taken out of log F. */
typedef struct rot_smooth_sums {
  double log_f, square; /* log F and v^2/F */
  size_t counted, samples;
  size_t fresh;                     /* states that breaks forget */
  double first_log_f, first_square; /* of the samples that do not count */
  /* The same without the first samples behind each break. What a diffuse state adds to log F
   * depends on its unit, so that orders with breaks are comparable here alone. */
  double order_log_f, order_square;
  size_t order_counted;
} rot_smooth_sums;

/* Nodes from..to - 1; a filter that does not start at node 0 goes on from the store's node
 * from - 1. Where spacing and weights repeat and nothing is stored, the gain is kept once it
 * converges. */
void rot_smooth_filter(const rot_smooth_nodes *nodes, const rot_smooth_model *model, size_t from,
                       size_t to, rot_smooth_store *store, int stores, rot_smooth_sums *sums);

/* Smoothed means (order of each node) and the covariances of the first three states (6 of each
 * node: 00, 01, 02, 11, 12, 22; in units of sigma^2); either may be NULL. */
void rot_smooth_smooth(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                       const rot_smooth_store *store, double *mean, double *covariance);

/* The jump of the states over a break at node k (mean[order], covariance[3] of states 1 and 2: 11,
 * 12, 22; variance of state 3), from a smoother run back to it; NaN where k is none. */
typedef struct rot_smooth_jump {
  size_t node;
  double mean[ROT_SMOOTH_MAX], covariance[3], variance_3;
  double after[ROT_SMOOTH_MAX], after_covariance[3]; /* the state on the far side */
} rot_smooth_jump;
void rot_smooth_jumps(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                      const rot_smooth_store *store, size_t n, rot_smooth_jump jumps[]);

/* Scores: for each node the test chi^2 (times sigma^2) of a shock that reaches it in the states
 * from 1 on and of one in the last state alone, and the leave-one-out residual u/sqrt(D) (times
 * sigma) of each channel, NaN where there is no sample. Any may be NULL. */
void rot_smooth_scores(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                       const rot_smooth_store *store, double *shock, double *last,
                       double *residual[ROT_SMOOTH_CHANNELS]);

/* Draws of the states given all samples, backward from the last node (Fruehwirth-Schnatter 1994):
 * those at n_at nodes (increasing), into draws[(d n_at + i) order + state], with the seed's normal
 * numbers. */
rot_status rot_smooth_draw(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                           const rot_smooth_store *store, double sigma, size_t n_at,
                           const size_t at[], size_t n_draws, unsigned long seed,
                           const rot_hooks *hooks, double *draws);

#endif
