/* Designs of R => designs of the core. */
#ifndef FFI_DESIGN_H
#define FFI_DESIGN_H

#include "glue/ffi.h"
#include "design/design.h"

/* rot_design of R, a list of plain data => the core's, ready for use. Its memory is R's: valid as
 * long as `design` and until the call from R ends. R error where it is damaged. */
const rot_design *ffi_design(SEXP design);
/* whole number from 0 to `largest` (at most 2^53) in a double => number; R error for another one */
uint64_t ffi_whole(SEXP x, const char *what, uint64_t largest);

#endif
