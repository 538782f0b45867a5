/* A law that is an R function, called with numbers. */
#ifndef FFI_TORQUE_H
#define FFI_TORQUE_H

#include "glue/ffi.h"
#include "engine/input.h"

enum { FFI_LAW_VALUES = ROT_MAX_MEASURES, FFI_LAW_NUMBERS = 1 + FFI_LAW_VALUES };

typedef struct ffi_torque {
  ffi_guard *guard;
  SEXP call;     /* f(time_s), or f(time_s, ...) with all arguments */
  SEXP env;      /* where f is */
  SEXP complain; /* complain(value, time_s): raises the error about what f returned */
  size_t n_arguments, size[FFI_LAW_NUMBERS], n_values;
  double x[FFI_LAW_NUMBERS], value[FFI_LAW_VALUES];
} ffi_torque;

/* From list(call, environment, complain), which the caller keeps; the call's arguments are filled
 * in here. `input`: that takes the law; NULL: a torque of time, angle and rate. Protects one
 * object. */
ffi_torque ffi_torque_new(SEXP law, const rot_input *input, ffi_guard *guard);

/* The law as a rot_law. */
rot_status ffi_torque_values_at(const double argument[], double value[], void *ctx);

/* The law as a rot_torque_fn; ctx is an ffi_torque. */
rot_status ffi_torque_call(double time_s, double theta_rad, double omega_rad_per_s,
                           double *torque_n_m, void *ctx);

#endif
