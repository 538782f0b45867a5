#include "ffi.h"
#include "rot_clock.h"

SEXP ffi_clock_cpu(void) { return Rf_ScalarReal(rot_clock_cpu_s()); }
