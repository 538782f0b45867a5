/* GSL's error handler. It belongs to the process, and aborts it by default. */
#ifndef ROT_GSL_H
#define ROT_GSL_H

#include "ground/ieee.h"

/* Switches it off. Called once, where the package or the library is loaded: from then on a failed
 * call of GSL returns its status. The core changes it nowhere else, so that no thread does while
 * another one runs. */
void rot_gsl_begin(void);

#endif
