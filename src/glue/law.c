#include "glue/law.h"

rot_torque ffi_law_knots(SEXP knots) {
  SEXP time_s = ffi_element(knots, "time_s");
  const double *t = ffi_reals(time_s, "time_s", -1), *outside = ffi_numbers_of(knots, "outside", 2);
  return (rot_torque){.n = (size_t)XLENGTH(time_s),
                      .time_s = t,
                      .torque_n_m = ffi_numbers_of(knots, "torque_n_m", XLENGTH(time_s)),
                      .before_n_m = outside[0],
                      .after_n_m = outside[1]};
}

int ffi_law_term_fits(SEXP list) {
  SEXP kind = ffi_element(list, "kind"), x = ffi_element(list, "x");
  if (TYPEOF(kind) != STRSXP || XLENGTH(kind) != 1 || TYPEOF(x) != REALSXP) return 0;
  const rot_term term = {rot_term_named(CHAR(STRING_ELT(kind, 0))), 0.0, 0.0, (size_t)XLENGTH(x),
                         REAL_RO(x)};
  return rot_term_valid(&term);
}

rot_term ffi_law_term(SEXP list) {
  SEXP x = ffi_element(list, "x");
  const double *values = ffi_reals(x, "x", -1);
  const rot_term term = {.kind = rot_term_named(ffi_text(ffi_element(list, "kind"), "kind")),
                         .from_s = ffi_number_of(list, "from_s"),
                         .to_s = ffi_number_of(list, "to_s"),
                         .length = (size_t)XLENGTH(x),
                         .x = values};
  if (!rot_term_valid(&term)) Rf_error("internal: a term of the torque is not valid");
  return term;
}

/* Breaks and error of the samples of a function, if x has them. */
static void read_samples(SEXP x, rot_law_one *law) {
  SEXP stops_s = ffi_element(x, "stops_s");
  if (Rf_isNull(stops_s)) return;
  law->breaks_s = ffi_reals(stops_s, "stops_s", -1);
  law->n_breaks = (size_t)XLENGTH(stops_s);
  law->noise_n_m = ffi_number_of(x, "noise_n_m");
}

/* object of R => law; `function`: gives the next law that is an R function */
static rot_law_one law_of(SEXP x, rot_law (*function)(void *ctx), void *ctx) {
  rot_law_one law = {.kind = ROT_LAW_KNOTS};
  if (Rf_inherits(x, "rot_torque_knots")) {
    law.knots = ffi_law_knots(x);
  } else if (Rf_inherits(x, "rot_torque_motor")) {
    law.kind = ROT_LAW_MOTOR;
    law.stall_n_m = ffi_number_of(x, "stall_torque_n_m");
    law.no_load_rad_per_s = ffi_number_of(x, "no_load_omega_rad_per_s");
  } else if (Rf_inherits(x, "rot_torque_term")) {
    law.kind = ROT_LAW_TERM;
    law.term = ffi_law_term(x);
    read_samples(x, &law);
  } else if (Rf_inherits(x, "rot_torque_function")) {
    SEXP breaks_s = ffi_element(x, "breaks_s");
    law.kind = ROT_LAW_CALL;
    law.call = function(ctx);
    if (!Rf_isNull(breaks_s)) {
      law.breaks_s = ffi_reals(breaks_s, "breaks_s", -1);
      law.n_breaks = (size_t)XLENGTH(breaks_s);
    }
  } else {
    Rf_error("internal: no torque law");
  }
  return law;
}

rot_law_sum ffi_law_sum(SEXP torque, rot_law (*function)(void *ctx), void *ctx) {
  const int sum = Rf_inherits(torque, "rot_torque_sum");
  SEXP laws = sum ? ffi_element(torque, "laws") : torque;
  if (sum && TYPEOF(laws) != VECSXP) Rf_error("internal: `laws`");
  const R_xlen_t n = sum ? XLENGTH(laws) : 1;
  rot_law_one *law = (rot_law_one *)R_alloc((size_t)n + 1, sizeof *law);
  for (R_xlen_t i = 0; i < n; i++) {
    law[i] = law_of(sum ? VECTOR_ELT(laws, i) : torque, function, ctx);
  }
  return (rot_law_sum){(size_t)n, law};
}

/* ---- samples --------------------------------------------------------------------------------- */

typedef struct samples {
  size_t n;
  rot_term *term; /* one for each number of the law */
} samples;

static rot_status sampled_values(const double argument[], double value[], void *ctx) {
  const samples *s = ctx;
  for (size_t k = 0; k < s->n; k++) value[k] = rot_term_at(&s->term[k], argument[0], 0.0, 0.0, 0.0);
  return ROT_OK;
}

int ffi_law_samples(SEXP list, rot_law *law) {
  SEXP terms = ffi_element(list, "terms");
  if (TYPEOF(terms) != VECSXP) return 0;
  samples *s = (samples *)R_alloc(1, sizeof *s);
  s->n = (size_t)XLENGTH(terms);
  s->term = (rot_term *)R_alloc(s->n + 1, sizeof *s->term);
  for (size_t k = 0; k < s->n; k++) {
    if (!ffi_law_term_fits(VECTOR_ELT(terms, (R_xlen_t)k))) return 0;
    s->term[k] = ffi_law_term(VECTOR_ELT(terms, (R_xlen_t)k));
  }
  *law = (rot_law){sampled_values, s, ffi_number_of(list, "noise")};
  return 1;
}

/* 1 if x is a function or contains one; bodies have none. */
static int has_function(SEXP x) {
  if (Rf_isFunction(x)) return 1;
  if (TYPEOF(x) != VECSXP || Rf_inherits(x, "rot_body")) return 0;
  for (R_xlen_t i = 0; i < XLENGTH(x); i++) {
    if (has_function(VECTOR_ELT(x, i))) return 1;
  }
  return 0;
}

SEXP ffi_law_called(SEXP x) { return Rf_ScalarLogical(has_function(x)); }

/* (term of time only, times) => values */
SEXP ffi_law_values(SEXP list, SEXP time_s) {
  const rot_term term = ffi_law_term(list);
  const double *t = ffi_reals(time_s, "time_s", -1);
  SEXP out = Rf_allocVector(REALSXP, XLENGTH(time_s));
  for (R_xlen_t i = 0; i < XLENGTH(time_s); i++) {
    REAL(out)[i] = rot_term_at(&term, t[i], 0.0, 0.0, 0.0);
  }
  return out;
}
