/* Torque laws of R => laws of the core, which refer to R's vectors. */
#ifndef FFI_LAW_H
#define FFI_LAW_H

#include "glue/ffi.h"
#include "engine/loads.h"

/* list(time_s, torque_n_m, outside) => piecewise linear torque */
rot_torque ffi_law_knots(SEXP knots);
/* list(kind, x, from_s, to_s) => term; an R error if it is invalid */
rot_term ffi_law_term(SEXP term);
/* 1 if the list is a valid term. */
int ffi_law_term_fits(SEXP list);
/* torque => sum of its laws. function(ctx) gives the laws that are R functions, in order. */
rot_law_sum ffi_law_sum(SEXP torque, rot_law (*function)(void *ctx), void *ctx);

/* samples of a function of time, list(terms, noise) of the class rot_samples => law; returns 0 if
 * they are invalid */
int ffi_law_samples(SEXP samples, rot_law *law);

#endif
