/* Integrals of several functions of time over panels: adaptive Gauss-Kronrod quadrature. */
#ifndef ROT_PANELS_H
#define ROT_PANELS_H

#include <stddef.h>

#include "ground/status.h"

/* n non-decreasing times => value[i * width + k], integrand k at time i */
typedef rot_status (*rot_panels_rates)(size_t n, const double time_s[], double value[], void *ctx);

typedef struct rot_panels {
  size_t width;         /* integrands */
  size_t n;             /* panels */
  const double *edge_s; /* edges of the panels, 0 .. n, increasing */
  const double *min;    /* width, or NULL: panels are not halved for errors below rounding of it */
  double *value;        /* out: n * width, integrals over each panel */
  double *error;        /* out: width, of their sums, with the rounding of times; NaN: unknown */
  double *size;         /* out: width, integrals of the absolute values */
  size_t max;           /* panels evaluated; 0: 200,000 and 4 n */
  int bounded;          /* 1: the error of panels that stay unresolved is no NaN: see below */
} rot_panels;

/* Halves panels until the error is below rounding, 24 times at most; with too many panels the error
 * is NaN, or with `bounded` the range of the integrand times the length, or ten times the
 * difference of the two rules. A panel whose integral is not finite is not halved. */
rot_status rot_panels_integrate(const rot_panels *panels, rot_panels_rates rates, void *ctx);

#endif
