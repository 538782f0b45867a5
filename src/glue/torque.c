#include "glue/torque.h"

#include <string.h>

#include "engine/term.h"
#include "engine/torque.h"

ffi_torque ffi_torque_new(SEXP law, const rot_input *input, ffi_guard *guard) {
  if (TYPEOF(law) != VECSXP || XLENGTH(law) != 3) Rf_error("internal: `law`");
  SEXP call = PROTECT(Rf_duplicate(VECTOR_ELT(law, 0)));
  ffi_torque out = {.guard = guard,
                    .call = call,
                    .env = VECTOR_ELT(law, 1),
                    .complain = VECTOR_ELT(law, 2),
                    .n_arguments = 3,
                    .size = {1, 1, 1},
                    .n_values = 1};
  if (input) {
    out.n_arguments = rot_input_arguments(input, out.size);
    out.n_values = rot_input_values(input);
  }
  const int given = Rf_length(call) - 1;
  if (input && input->kinds & ROT_INPUT_RATES) { /* time and states, a number each */
    if (given < 2 || given > FFI_LAW_NUMBERS) Rf_error("internal: `call`");
    out.n_arguments = (size_t)given;
    out.n_values = out.n_arguments - 1;
    for (int i = 0; i < given; i++) out.size[i] = 1;
  }
  if (given != 1 && given != (int)out.n_arguments) Rf_error("internal: `call`");
  return out;
}

static SEXP numbers_of(const double x[], size_t n) {
  SEXP out = Rf_allocVector(REALSXP, (R_xlen_t)n);
  memcpy(REAL(out), x, n * sizeof *x);
  return out;
}

/* 1 if the value is n numbers; a logical NA counts as one number. */
static int fits(SEXP value, size_t n) {
  const int type = TYPEOF(value);
  if (Rf_xlength(value) != (R_xlen_t)n || Rf_isObject(value)) return 0;
  if (type == LGLSXP) return n == 1 && LOGICAL_RO(value)[0] == NA_LOGICAL;
  return type == REALSXP || type == INTSXP;
}

static double number_at(SEXP value, size_t i) {
  if (TYPEOF(value) == REALSXP) return REAL_RO(value)[i];
  const int x = TYPEOF(value) == INTSXP ? INTEGER_RO(value)[i] : NA_INTEGER;
  return x == NA_INTEGER ? NA_REAL : x;
}

/* law->x => law->value by a call of the R function; may jump */
static SEXP call_torque(void *data) {
  ffi_torque *law = data;
  const double *x = law->x;
  const size_t *size = law->size;
  /* New vectors for each call: f may keep its arguments. */
  for (SEXP cell = CDR(law->call); cell != R_NilValue; cell = CDR(cell)) {
    SETCAR(cell, numbers_of(x, *size));
    x += *size++;
  }
  SEXP value = PROTECT(Rf_eval(law->call, law->env));
  if (fits(value, law->n_values)) {
    for (size_t i = 0; i < law->n_values; i++) law->value[i] = number_at(value, i);
  } else {
    SEXP time = PROTECT(Rf_ScalarReal(law->x[0]));
    SEXP call = PROTECT(Rf_lang3(law->complain, value, time));
    Rf_eval(call, R_GlobalEnv);
    UNPROTECT(2);
  }
  UNPROTECT(1);
  return R_NilValue;
}

rot_status ffi_torque_values_at(const double argument[], double value[], void *ctx) {
  ffi_torque *law = ctx;
  size_t n = 0;
  for (size_t i = 0; i < law->n_arguments; i++) n += law->size[i];
  memcpy(law->x, argument, n * sizeof *argument);
  const rot_status status = ffi_guarded(law->guard, call_torque, law, NULL);
  memcpy(value, law->value, law->n_values * sizeof *value);
  return status;
}

rot_status ffi_torque_call(double time_s, double theta_rad, double omega_rad_per_s,
                           double *torque_n_m, void *ctx) {
  const double argument[] = {time_s, theta_rad, omega_rad_per_s};
  return ffi_torque_values_at(argument, torque_n_m, ctx);
}

/* (law, times) => values at constant state = c(theta, omega). The core is not on the stack: no
 * guard. */
SEXP ffi_torque_values(SEXP law, SEXP time_s, SEXP state) {
  const double *t = ffi_reals(time_s, "time_s", -1), *y = ffi_reals(state, "state", 2);
  const R_xlen_t n = XLENGTH(time_s);
  ffi_torque f = ffi_torque_new(law, NULL, NULL);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    f.x[0] = t[i];
    f.x[1] = y[0];
    f.x[2] = y[1];
    call_torque(&f);
    REAL(out)[i] = f.value[0];
  }
  UNPROTECT(2);
  return out;
}

/* (x of the term, from, to) => c(integral, bound of its error) */
SEXP ffi_sinusoid_impulse(SEXP x, SEXP from, SEXP to) {
  SEXP out = PROTECT(Rf_allocVector(REALSXP, 2));
  REAL(out)
  [0] = rot_sinusoid_impulse(ffi_reals(x, "x", 3), ffi_real(from, "from"), ffi_real(to, "to"),
                             REAL(out) + 1);
  UNPROTECT(1);
  return out;
}
