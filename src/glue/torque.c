#include "glue/torque.h"

#include "engine/torque.h"

ffi_torque ffi_torque_new(SEXP law, ffi_guard *guard) {
  if (TYPEOF(law) != VECSXP || XLENGTH(law) != 3) Rf_error("internal: `law`");
  SEXP call = PROTECT(Rf_duplicate(VECTOR_ELT(law, 0)));
  if (Rf_length(call) != 2 && Rf_length(call) != 4) Rf_error("internal: `call`");
  return (ffi_torque){guard, call, VECTOR_ELT(law, 1), VECTOR_ELT(law, 2), {0.0, 0.0, 0.0}, 0.0};
}

static SEXP call_torque(void *data) {
  ffi_torque *law = data;
  const double *x = law->x;
  /* New numbers each time: f may keep the ones it was given. */
  for (SEXP cell = CDR(law->call); cell != R_NilValue; cell = CDR(cell)) {
    SETCAR(cell, Rf_ScalarReal(*x++));
  }
  SEXP value = PROTECT(Rf_eval(law->call, law->env));
  const int type = TYPEOF(value);
  const int number =
      Rf_xlength(value) == 1 && !Rf_isObject(value) &&
      (type == REALSXP || type == INTSXP || (type == LGLSXP && LOGICAL(value)[0] == NA_LOGICAL));
  if (number) {
    law->torque_n_m = Rf_asReal(value);
  } else {
    SEXP time = PROTECT(Rf_ScalarReal(law->x[0]));
    SEXP call = PROTECT(Rf_lang3(law->complain, value, time));
    Rf_eval(call, R_GlobalEnv);
    UNPROTECT(2);
  }
  UNPROTECT(1);
  return R_NilValue;
}

rot_status ffi_torque_call(double time_s, double theta_rad, double omega_rad_per_s,
                           double *torque_n_m, void *ctx) {
  ffi_torque *law = ctx;
  law->x[0] = time_s;
  law->x[1] = theta_rad;
  law->x[2] = omega_rad_per_s;
  const rot_status status = ffi_guarded(law->guard, call_torque, law, NULL);
  *torque_n_m = law->torque_n_m;
  return status;
}

/* The law at each time, the angle and rate held at state = c(theta, omega). The core is not on the
 * stack: no guard. */
SEXP ffi_torque_values(SEXP law, SEXP time_s, SEXP state) {
  const double *t = ffi_reals(time_s, "time_s", -1), *y = ffi_reals(state, "state", 2);
  const R_xlen_t n = XLENGTH(time_s);
  ffi_torque f = ffi_torque_new(law, NULL);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    f.x[0] = t[i];
    f.x[1] = y[0];
    f.x[2] = y[1];
    call_torque(&f);
    REAL(out)[i] = f.torque_n_m;
  }
  UNPROTECT(2);
  return out;
}
