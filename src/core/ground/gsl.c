#include "ground/gsl.h"

#include <gsl/gsl_errno.h>

void rot_gsl_begin(void) { (void)gsl_set_error_handler_off(); }
