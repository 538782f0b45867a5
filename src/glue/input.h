/* Values of R => inputs of the core. */
#ifndef FFI_INPUT_H
#define FFI_INPUT_H

#include "glue/ffi.h"
#include "engine/input.h"

/* Calls of the R functions among the inputs. */
typedef struct ffi_laws {
  /* By names of inputs: a list of list(call, environment, complain) (glue/torque.h), one for each
   * law that is a function. */
  SEXP law;
  ffi_guard *guard;
  SEXP kept; /* protected list with an element for each input: calls in use */
} ffi_laws;

/* x (R's NULL: not given) => value of input i; returns 0 if the input does not take x. Valid as
 * long as x and until the call from R ends. Without `laws` a function is marked, not called. */
int ffi_input_read(const rot_input inputs[], size_t i, SEXP x, const ffi_laws *laws, rot_given *to);
/* argument of R => element of a scene; C's NULL if R must process it: numbers with names or units,
 * functions, invalid values. `form`: of that input, see R/form.R. */
SEXP ffi_input_plain(const rot_input *input, SEXP x, SEXP form);
/* input => its form in the words of R/form.R; or "body", "inertia" (a body or a number), "changing"
 * (the same or a changing inertia), "vector_or_name", "bodies" (numbers, or a list of bodies and
 * numbers), "tensor" (a body or three moments), "torque", "laws" (a list of torques and NULL),
 * "torques" (three numbers, a table, a function), "rates" (a function), "rotors",
 * "resistance", and lists of "resistances", "brakes", "couplings" */
const char *ffi_input_form(const rot_input *input);

#endif
