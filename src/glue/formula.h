/* Formulas of R => programs of the core. */
#ifndef FFI_FORMULA_H
#define FFI_FORMULA_H

#include "glue/ffi.h"
#include "design/formula.h"

/* list(op, arg, constant) of R => program that reads n_inputs columns; valid as long as the list. R
 * error where it is damaged. */
rot_formula ffi_formula(SEXP formula, size_t n_inputs);

#endif
