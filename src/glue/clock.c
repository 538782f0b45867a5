/* For R: processor time. */
#include "glue/ffi.h"
#include "ground/clock.h"

SEXP ffi_clock_cpu(void) { return Rf_ScalarReal(rot_clock_cpu_s()); }
