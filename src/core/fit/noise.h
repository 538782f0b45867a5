/* The noise of the series of a fit, from its residuals. */

#ifndef ROT_FIT_NOISE_H
#define ROT_FIT_NOISE_H

#include "fit/work.h"

/* Before a motion is known: white, by the data alone. scratch: s->n numbers. */
void rot_fit_first_noise(const rot_fit_samples *s, double scratch[]);
/* (room for residuals and derivatives) => noise of each series, and 1 where it is that of before */
rot_status rot_fit_find_noise(rot_fit_work *w, double r[], double j[], int *same);

#endif
