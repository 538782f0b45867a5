/* Breaks of a motion (impacts, switched torques, stops) and outliers. */
#ifndef ROT_SMOOTH_BREAKS_H
#define ROT_SMOOTH_BREAKS_H

#include "measure/smooth_fit.h"

typedef struct rot_smooth_finding {
  int breaks, outliers;        /* 1: search for them */
  int first_order, last_order; /* range of orders */
  size_t max_breaks;           /* that may be added to the list */
} rot_smooth_finding;

/* record => fit. Excludes outliers (w = Inf; record->w must be given) and adds breaks to the
 * n_breaks of the list, until neither is found. */
rot_status rot_smooth_find(rot_smooth_record *record, const rot_smooth_finding *how,
                           rot_smooth_break *breaks, size_t *n_breaks, const rot_hooks *hooks,
                           rot_smooth_fit *fit);

/* break => error of its time: half the width over which -2 log L rises by 1, NaN if it does not
 * within 5 spacings */
rot_status rot_smooth_time_error(const rot_smooth_record *record, const rot_smooth_fit *fit,
                                 size_t n_breaks, const rot_smooth_break *breaks, size_t which,
                                 double *error_s);

#endif
