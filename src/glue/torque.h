/* Laws that are R functions. */
#ifndef FFI_TORQUE_H
#define FFI_TORQUE_H

#include "glue/ffi.h"
#include "engine/input.h"

enum { FFI_LAW_VALUES = ROT_MAX_MEASURES, FFI_LAW_NUMBERS = 1 + FFI_LAW_VALUES };

typedef struct ffi_torque {
  ffi_guard *guard;
  SEXP call;     /* f(time_s), or f(time_s, ...) with all arguments */
  SEXP env;      /* environment of f */
  SEXP complain; /* complain(value, time_s): raises an error about the value of f */
  size_t n_arguments;
  size_t size[FFI_LAW_NUMBERS]; /* numbers in each argument */
  size_t n_values;
  double x[FFI_LAW_NUMBERS];    /* all arguments */
  double value[FFI_LAW_VALUES]; /* result */
} ffi_torque;

/* list(call, environment, complain), which the caller keeps => law, with its own call. `input`:
 * input that takes the law; NULL: a torque of time, angle and rate. Protects one object. */
ffi_torque ffi_torque_new(SEXP law, const rot_input *input, ffi_guard *guard);

/* The function of a rot_law; ctx: an ffi_torque. */
rot_status ffi_torque_values_at(const double argument[], double value[], void *ctx);

/* The same as a rot_torque_fn. */
rot_status ffi_torque_call(double time_s, double theta_rad, double omega_rad_per_s,
                           double *torque_n_m, void *ctx);

#endif
