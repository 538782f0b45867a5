/* Values of R as the inputs of the core. */
#ifndef FFI_INPUT_H
#define FFI_INPUT_H

#include "glue/ffi.h"
#include "engine/input.h"

/* How the functions among the inputs are called. */
typedef struct ffi_laws {
  /* By the names of inputs: a list of list(call, environment, complain), as glue/torque.h has it,
   * one for each law that is a function. */
  SEXP law;
  ffi_guard *guard;
  SEXP kept; /* a protected list with a place for each input */
} ffi_laws;

/* What was given for input i: 1, or 0 where x is nothing that it takes. NULL: not given. It lives
 * as long as x, and until the call from R ends. Without `laws` a function is only marked. */
int ffi_input_read(const rot_input inputs[], size_t i, SEXP x, const ffi_laws *laws, rot_given *to);
/* An argument of R as scenes have it, or NULL (of C) where R must look at it first: numbers with
 * names or units, functions, what is wrong. `form`: see R/form.R, of that input. */
SEXP ffi_input_plain(const rot_input *input, SEXP x, SEXP form);
/* What such an input must be, in the words of R/form.R; or "body", "inertia" (a body or a number),
 * "changing" (or how it changes), "vector_or_name", "bodies" (numbers, or a list of these),
 * "tensor" (a body or three moments), "torque", "laws" (a list of these, with empty places),
 * "torques" (three numbers, a table, a function), "rates" (a function), "rotors",
 * "resistance", and lists of
 * "resistances", "brakes", "couplings". */
const char *ffi_input_form(const rot_input *input);

#endif
