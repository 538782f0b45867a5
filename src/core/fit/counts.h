/* The covariance of a fit's estimate for the errors of a counter: a sawtooth of the motion. */
#ifndef ROT_FIT_COUNTS_H
#define ROT_FIT_COUNTS_H

#include <stddef.h>

enum { ROT_FIT_UNKNOWNS = 14 }; /* columns of rot_whiten() */

typedef struct rot_fit_counts {
  size_t n, m;              /* samples; variables of the fit, at most ROT_FIT_UNKNOWNS */
  const size_t *at;         /* places of the samples in y and weight */
  const double *y, *weight; /* weight: factors of the standard deviations; NULL: all 1 */
  double count;             /* 0: no counter */
  double unit;              /* of the residuals */
  const double *r, *j;      /* residuals over weight and unit; their derivatives, n rows of m */
} rot_fit_counts;

/* => 1: the rounding of the counts rules their errors (j is not read) */
int rot_fit_counts_rule(const rot_fit_counts *counts);

/* (`root` root': a covariance of the variables) => 1: an error of that size moves a sample by more
 * than a fiftieth of a count, and its error by counts with it */
int rot_fit_counts_moved(const rot_fit_counts *counts, const double root[]);

/* (where the motion is `off` from the estimate; inverse of j'j) => to += covariance of j'e for the
 * errors e of the counts; wave += variance of each variable by the harmonic that has the largest */
void rot_fit_counts_covariance(const rot_fit_counts *counts, const double off[],
                               const double inverse[], double to[], double wave[]);

/* to += variance times j'j, of n rows of m */
void rot_fit_squares(size_t n, size_t m, double variance, const double j[], double to[]);

#endif
