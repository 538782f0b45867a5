/* Whitening of correlated residuals; parameters of the noise by restricted likelihood (REML).
 *
 * The covariance of two samples is sigma^2 [(1 - white) exp(-|t - t'|/tau) + white (same sample)]:
 * an Ornstein-Uhlenbeck process plus white noise. A scalar Kalman filter whitens columns in linear
 * time, for any spacing. tau = 0 is white noise; white > 1: neighbours are anticorrelated.
 *
 * Reference: Harville 1977, J. Am. Stat. Assoc. 72, 320 (REML). */
#ifndef ROT_WHITEN_H
#define ROT_WHITEN_H

#include <stddef.h>

#include "ground/status.h"

enum { ROT_WHITEN_COLUMNS = 16 }; /* at most */

typedef struct rot_noise {
  double tau_s; /* correlation time, >= 0 */
  double white; /* white fraction of the variance, > 0; > 1: the other part is negative */
} rot_noise;

typedef struct rot_reml {
  rot_noise noise;
  double gain;   /* twice the log likelihood ratio to white noise, >= 0 */
  double logdet; /* log |V/sigma^2| */
  int at_cap;    /* 1: tau is at its upper limit */
  size_t evaluations;
} rot_reml;

/* (noise, t, x) => whitened x in place, log |V/sigma^2| (logdet may be NULL). x has n rows of
 * `columns` numbers; times do not decrease. ROT_EVALUE, with x unchanged, for more than
 * ROT_WHITEN_COLUMNS; ROT_ERANGE if the noise has no positive variance at these times. */
rot_status rot_whiten(const rot_noise *noise, size_t n, const double t[], size_t columns,
                      double x[], double *logdet);

/* (t, J, r) => noise of the residuals r of a linear model. J: its columns (n rows of p numbers, p <
 * ROT_WHITEN_COLUMNS), as fixed effects. tau is between the median spacing/4 and cap_s. `near`: an
 * initial noise, or NULL for a search. The result is white noise unless another gains more than
 * `threshold`. */
rot_status rot_whiten_reml(size_t n, const double t[], size_t p, const double J[], const double r[],
                           double cap_s, double threshold, const rot_noise *near,
                           const rot_hooks *hooks, rot_reml *out);

#endif
