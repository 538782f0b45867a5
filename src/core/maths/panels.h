/* Integrals of several functions of time over panels: Gauss-Kronrod rules, panels halved where the
 * two rules differ. */
#ifndef ROT_PANELS_H
#define ROT_PANELS_H

#include <stddef.h>

#include "ground/status.h"

/* The integrands at n times, which do not decrease: value[i * width + k] is the k-th at time i. */
typedef rot_status (*rot_panels_rates)(size_t n, const double time_s[], double value[], void *ctx);

typedef struct rot_panels {
  size_t width, n; /* integrands; panels, whose ends are edge_s[0 .. n], increasing */
  const double *edge_s;
  /* NULL, or the size of what each integrand is added to: below its rounding nothing is halved. */
  const double *min;
  double *value; /* out: n * width, of each panel */
  double *error; /* out: width, of their sums, the rounding of the times included; NaN: unknown */
  double *size;  /* out: width, the integrals of the absolute values */
} rot_panels;

/* Halves until the error is below rounding or 24 halvings are done; where the panels become too
 * many, the error is NaN. A panel whose integral is not finite is not halved. */
rot_status rot_panels_integrate(const rot_panels *panels, rot_panels_rates rates, void *ctx);

#endif
