/* GSL's error handler, a global of the process that aborts by default. */
#ifndef ROT_GSL_H
#define ROT_GSL_H

#include "ground/ieee.h"

/* Switches the handler off, so that a failed call of GSL returns its status. Called once, when the
 * package or the library is loaded; the core changes the handler nowhere else, so no thread changes
 * it while another one runs. */
void rot_gsl_begin(void);

#endif
