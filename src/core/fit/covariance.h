/* The covariance of a fit whose series are counts. */

#ifndef ROT_FIT_COVARIANCE_H
#define ROT_FIT_COVARIANCE_H

#include "fit/counts.h"
#include "fit/work.h"

/* A series, its residuals and derivatives, as counts of `unit`. */
rot_fit_counts rot_fit_counts_of(const rot_fit_work *w, const rot_fit_samples *s, double unit,
                                 const double r[], const double j[]);

/* The covariance of the least-squares estimate for the errors of counts, and its factor. The
 * estimate itself is that of white noise. Where the motion lies between the counts, and with it the
 * covariance, is known to the estimate's error alone: at points of that error the mean covariance,
 * with the largest variance of each variable. The error is that of white noise at first, then what
 * it led to. */
rot_status rot_fit_put_counts(rot_fit_work *w, double r[], double j[]);

#endif
