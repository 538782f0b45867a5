/* Kalman smoothing of samples of an angle, a rate, or both; the motion is an integrated Wiener
 * process.
 *
 * The state is x_i = theta^(i) h0^i / i!, i < order, with the mean spacing h0. Over a gap of s h0
 *
 *   A_ij = C(j,i) s^(j-i),
 *   Q_ij = lambda s^(2p-1-i-j) / [(2p-1-i-j) (p-1-i)! (p-1-j)! i! j!],
 *
 * variances in units of sigma^2. The error of a sample is white, or white plus an
 * Ornstein-Uhlenbeck process of variance 1, an additional state. Filter and smoother use factors S
 * with S'S = P and never subtract covariances: no variance is negative. After a gap of 1000
 * spacings the plain form and the Joseph form are wrong by factors of 1.1 to 5e5.
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
  ROT_SMOOTH_SKIPPED = 6, /* first samples of a segment, excluded from the likelihood */
  ROT_SMOOTH_BEHIND = 4   /* first samples after a break, excluded in comparisons of orders */
};

/* Kinds of nodes. A break is a node at the time of the previous node, where the states from `first`
 * on become diffuse: 1 if omega jumps, 2 if omega' jumps, 3 if omega'' jumps. */
enum { ROT_SMOOTH_FLOWS = -1, ROT_SMOOTH_STARTS = 0 };

/* Nodes in order of time: samples, breaks, other times. Node 0 is a start. */
typedef struct rot_smooth_nodes {
  size_t n;
  const double *gap;                    /* from the previous node, in h0; 0 at a break */
  const double *y[ROT_SMOOTH_CHANNELS]; /* rad; rad/s times h0. NaN: no sample. NULL: none */
  const double *w[ROT_SMOOTH_CHANNELS]; /* s.d. of the samples in units of sigma, > 0 */
  const signed char *first;             /* FLOWS, STARTS, or the first diffuse state of a break */
  size_t settles; /* samples after a start or break excluded in comparisons of orders, if more */
  /* Correlated part of the samples' errors in one channel, a state of variance 1. NULL: none. */
  const double *slow; /* its s.d. in units of sigma */
  const double *keep; /* its correlation with the previous node, 0 to 1 */
  int slow_channel;
} rot_smooth_nodes;

typedef struct rot_smooth_model {
  int order;     /* ROT_SMOOTH_MIN to ROT_SMOOTH_MAX */
  double lambda; /* q h0^(2 order - 1) / sigma^2 */
} rot_smooth_model;

/* => number of states of a node: `order` of the motion, 1 for correlated errors */
int rot_smooth_states(const rot_smooth_nodes *nodes, int order);

/* Filter results for each node. */
typedef struct rot_smooth_store {
  double *x;                      /* states: filtered mean */
  double *s;                      /* states^2: factor by rows, upper triangle */
  double *v[ROT_SMOOTH_CHANNELS]; /* innovation */
  double *f[ROT_SMOOTH_CHANNELS]; /* its variance; 0: no sample */
  double *k[ROT_SMOOTH_CHANNELS]; /* states: gain */
} rot_smooth_store;

/* Allocates the results of n nodes. */
rot_status rot_smooth_store_new(rot_smooth_store *store, size_t n, int states);
/* Frees them. */
void rot_smooth_store_free(rot_smooth_store *store);

/* Sums over the counted samples: all but the first ROT_SMOOTH_SKIPPED of each segment. log F
 * excludes the diffuse variances of states at breaks. */
typedef struct rot_smooth_sums {
  double log_f, square;             /* sums of log F and v^2/F */
  size_t counted, samples;          /* samples counted; all samples */
  size_t fresh;                     /* states made diffuse by breaks */
  double first_log_f, first_square; /* sums over the samples that are not counted */
  /* The same without the first samples after each break. The contribution of a diffuse state to
   * log F depends on its unit, so only these sums are comparable between orders. */
  double order_log_f, order_square;
  size_t order_counted;
} rot_smooth_sums;

/* Filters nodes from..to - 1 => sums and, with `stores`, the results in `store`. For from > 0 it
 * continues from the stored node from - 1. If nothing is stored and spacing and weights repeat, the
 * gain is kept once it converges. */
void rot_smooth_filter(const rot_smooth_nodes *nodes, const rot_smooth_model *model, size_t from,
                       size_t to, rot_smooth_store *store, int stores, rot_smooth_sums *sums);

/* filter results => smoothed means (`order` per node), covariances of the first three states (6 per
 * node: 00, 01, 02, 11, 12, 22; in units of sigma^2); either may be NULL */
void rot_smooth_smooth(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                       const rot_smooth_store *store, double *mean, double *covariance);

/* The jump of the states at a break. */
typedef struct rot_smooth_jump {
  size_t node;                  /* in: the break */
  double mean[ROT_SMOOTH_MAX];  /* `order` numbers */
  double covariance[3];         /* of states 1 and 2: 11, 12, 22 */
  double variance_3;            /* of state 3 */
  double after[ROT_SMOOTH_MAX]; /* state after the break */
  double after_covariance[3];   /* its covariance: 11, 12, 22 */
} rot_smooth_jump;

/* filter results => jumps at n breaks, by the smoother; elements at a start are unchanged */
void rot_smooth_jumps(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                      const rot_smooth_store *store, size_t n, rot_smooth_jump jumps[]);

/* filter results => scores of each node: chi^2 (times sigma^2) of a shock in the states from 1 on,
 * chi^2 of a shock in the last state only, leave-one-out residual u/sqrt(D) (times sigma) of each
 * channel, NaN without a sample. Each may be NULL. */
void rot_smooth_scores(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                       const rot_smooth_store *store, double *shock, double *last,
                       double *residual[ROT_SMOOTH_CHANNELS]);

/* (filter results, seed) => random draws of the states given all samples, at n_at nodes
 * (increasing): draws[(d n_at + i) order + state]. Backward from the last node
 * (Fruehwirth-Schnatter 1994). */
rot_status rot_smooth_draw(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                           const rot_smooth_store *store, double sigma, size_t n_at,
                           const size_t at[], size_t n_draws, unsigned long seed,
                           const rot_hooks *hooks, double *draws);

#endif
