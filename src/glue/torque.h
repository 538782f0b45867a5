/* A torque law that is an R function, called with one number each. */
#ifndef FFI_TORQUE_H
#define FFI_TORQUE_H

#include "glue/ffi.h"

typedef struct ffi_torque {
  ffi_guard *guard;
  SEXP call;     /* f(time_s) or f(time_s, theta_rad, omega_rad_per_s) */
  SEXP env;      /* where f is */
  SEXP complain; /* complain(value, time_s): raises the error about what f returned */
  double x[3];
  double torque_n_m;
} ffi_torque;

/* From list(call, environment, complain), which the caller keeps; the call's arguments are filled
 * in here. Protects one object. */
ffi_torque ffi_torque_new(SEXP law, ffi_guard *guard);

/* The law as a rot_torque_fn; ctx is an ffi_torque. */
rot_status ffi_torque_call(double time_s, double theta_rad, double omega_rad_per_s,
                           double *torque_n_m, void *ctx);

#endif
