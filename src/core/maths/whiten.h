/* Correlated noise of residuals, whitened, and its two numbers by restricted likelihood (REML).
 *
 * The covariance of two samples is sigma^2 [(1 - white) exp(-|t - t'|/tau) + white (same sample)]:
 * an Ornstein-Uhlenbeck process and white noise. A scalar Kalman filter whitens columns in a time
 * proportional to their length, at any spacing. tau = 0 is white noise.
 *
 * Reference: Harville 1977, J. Am. Stat. Assoc. 72, 320 (REML). */
#ifndef ROT_WHITEN_H
#define ROT_WHITEN_H

#include <stddef.h>

#include "ground/status.h"

enum { ROT_WHITEN_COLUMNS = 16 }; /* at most */

typedef struct rot_noise {
  double tau_s, white; /* correlation time; share of the variance that is white, 0 to 1 */
} rot_noise;

typedef struct rot_reml {
  rot_noise noise;
  double gain;   /* twice the log likelihood gained over white noise, >= 0 */
  double logdet; /* log |V/sigma^2| */
  int at_cap;    /* tau is at the largest value allowed */
  size_t evaluations;
} rot_reml;

/* Whitens the columns of x, n rows of `columns` numbers, in place; `logdet`, or NULL: log
 * |V/sigma^2|. Times do not decrease. ROT_EVALUE, with nothing changed, for more than
 * ROT_WHITEN_COLUMNS. */
rot_status rot_whiten(const rot_noise *noise, size_t n, const double t[], size_t columns,
                      double x[], double *logdet);

/* The noise of the residuals r of a linear model with the columns J (n rows of p numbers), with the
 * columns as fixed effects: at most ROT_WHITEN_COLUMNS - 1. tau is between the median spacing/4 and
 * cap_s. `near`: a noise to start from, or NULL for a search. White noise is returned unless
 * another gains more than `threshold`. */
rot_status rot_whiten_reml(size_t n, const double t[], size_t p, const double J[], const double r[],
                           double cap_s, double threshold, const rot_noise *near,
                           const rot_hooks *hooks, rot_reml *out);

#endif
