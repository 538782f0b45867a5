/* Residuals of a fit, whitened by the noise of their series, and their derivatives. */

#ifndef ROT_FIT_RESIDUALS_H
#define ROT_FIT_RESIDUALS_H

#include "fit/work.h"

rot_status rot_fit_residuals(rot_fit_work *w, double r[]);
/* Rows of residuals, columns of the free variables. */
rot_status rot_fit_derivatives(rot_fit_work *w, double j[]);

/* The fitted data and the whitened residuals, in the rows of the records. */
rot_status rot_fit_put_fitted(rot_fit_work *w);

#endif
