/* Torque laws of R as those of the core. Vectors stay those of R. */
#ifndef FFI_LAW_H
#define FFI_LAW_H

#include "glue/ffi.h"
#include "engine/loads.h"

rot_torque ffi_law_knots(SEXP knots);
rot_term ffi_law_term(SEXP term);
/* Whether the list is a term that the core may read. */
int ffi_law_term_fits(SEXP list);
/* Laws of a torque, each a part of their sum. `function`: stands for those that are R functions, in
 * their order, as ctx holds the next one. */
rot_law_sum ffi_law_sum(SEXP torque, rot_law (*function)(void *ctx), void *ctx);

/* Samples of a function of time, list(terms, noise) of the class rot_samples, as a law; 0: they are
 * damaged. */
int ffi_law_samples(SEXP samples, rot_law *law);

#endif
