/* The least squares of a fit within the domains of its unknowns: what reaches an edge is held, and
 * freed where the way back lowers the sum. */

#ifndef ROT_FIT_MINIMUM_H
#define ROT_FIT_MINIMUM_H

#include "fit/work.h"

/* The variables that are not held are free. */
void rot_fit_set_free(rot_fit_work *w);
rot_status rot_fit_minimum(rot_fit_work *w);

#endif
