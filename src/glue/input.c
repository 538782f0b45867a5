#include "glue/input.h"

#include <math.h>
#include <string.h>

#include "glue/law.h"
#include "glue/torque.h"
#include "body/inertia.h"
#include "scene/parts.h"

enum {
  ONE_NUMBER = ROT_INPUT_NUMBER | ROT_INPUT_LIMIT,
  NUMBERS = ONE_NUMBER | ROT_INPUT_NUMBERS | ROT_INPUT_TIMES | ROT_INPUT_VECTOR | ROT_INPUT_ATTITUDE
};

/* => kind as which an input reads n numbers */
static unsigned kind_of(unsigned kinds, R_xlen_t n) {
  const unsigned one = kinds & ONE_NUMBER, more = kinds & NUMBERS & ~one;
  const unsigned from = one && (n == 1 || !more) ? one : more;
  return from & (~from + 1u); /* the first */
}

const char *ffi_input_form(const rot_input *input) {
  const unsigned kinds = input->kinds;
  if (kinds & ROT_INPUT_TORQUE) return kinds & ROT_INPUT_NOTHING ? "laws" : "torque";
  if (kinds & ROT_INPUT_BODY && kinds & ROT_INPUT_LIST) return "bodies";
  if (kinds & ROT_INPUT_MOMENTS) return "tensor";
  if (kinds & ROT_INPUT_INERTIA) return "changing";
  if (kinds & ROT_INPUT_BODY) return kinds & ROT_INPUT_NUMBER ? "inertia" : "body";
  if (kinds & ROT_INPUT_ROTOR) return "rotors";
  if (kinds & ROT_INPUT_COUPLING) return "couplings";
  if (kinds & ROT_INPUT_BRAKE) return "brakes";
  if (kinds & ROT_INPUT_RESISTANCE) {
    return kinds & ROT_INPUT_NUMBERS ? "viscous"
           : kinds & ROT_INPUT_LIST  ? "resistances"
                                     : "resistance";
  }
  if (kinds & ROT_INPUT_TABLE) return "torques";
  if (kinds & ROT_INPUT_RATES) return "rates";
  if (kinds & ROT_INPUT_LAW) return kinds & ROT_INPUT_NUMBER ? "force" : "function";
  if (kinds & ROT_INPUT_CHOICE) return kinds & ROT_INPUT_VECTOR ? "vector_or_name" : "text";
  if (kinds & ROT_INPUT_TIMES) return "sorted";
  if (kinds & ROT_INPUT_VECTOR) return "numbers:3";
  if (kinds & ROT_INPUT_ATTITUDE) return "numbers:4";
  if (kinds & ROT_INPUT_NUMBERS) return "numbers";
  return kinds & ROT_INPUT_LIMIT ? "limit" : "number";
}

/* => n numbers of a part of a body, or NULL */
static const double *part_of(SEXP body, const char *name, R_xlen_t n) {
  SEXP x = ffi_element(body, name);
  return TYPEOF(x) == REALSXP && XLENGTH(x) == n ? REAL_RO(x) : NULL;
}

/* body => axle of shapes that name one (rod end, point), as moved; returns 0 if its size has no
 * name */
static int read_axle(SEXP body, rot_given_body *to) {
  SEXP shape = ffi_element(body, "shape"), from = ffi_element(body, "provenance");
  if (TYPEOF(shape) != STRSXP || TYPEOF(from) != STRSXP || XLENGTH(shape) != 1 ||
      XLENGTH(from) != 1 || strcmp(CHAR(STRING_ELT(from, 0)), "formula")) {
    return 1;
  }
  const char *name = CHAR(STRING_ELT(shape, 0));
  const int point = !strcmp(name, "point");
  if (!point && strcmp(name, "rod_end")) return 1;
  SEXP size = Rf_getAttrib(ffi_element(body, "size_m"), R_NamesSymbol);
  if (TYPEOF(size) != STRSXP || XLENGTH(size) != 1 ||
      strcmp(CHAR(STRING_ELT(size, 0)), point ? "radius_m" : "length_m")) {
    return 0;
  }
  SEXP frame = ffi_element(ffi_element(body, "detail"), "frame");
  const double *at = Rf_isNull(frame) ? NULL : part_of(frame, "at_m", 3);
  for (int k = 0; k < 3; k++) to->axle_m[k] = at ? at[k] : 0.0;
  return 1;
}

/* body of R => body of the core; without radius, which is an input of scenes that roll */
static int read_body(SEXP x, rot_given_body *to) {
  const double *mass = part_of(x, "mass_kg", 1), *centre = part_of(x, "centre_m", 3);
  const double *second = part_of(x, "second_moment_kg_m2", 9);
  if (!mass || !centre || !second) return 0;
  to->mass_kg = *mass;
  to->radius_m = NAN;
  memcpy(to->centre_m, centre, sizeof to->centre_m);
  memcpy(to->axle_m, centre, sizeof to->axle_m);
  for (int k = 0; k < ROT_TENSOR; k++) {
    to->second_kg_m2[k] = second[rot_tensor_row[k] + 3 * rot_tensor_column[k]];
  }
  rot_inertia_of_second(to->second_kg_m2, to->inertia_kg_m2);
  return read_axle(x, to);
}

static rot_status not_called(const double argument[], double value[], void *ctx) {
  (void)argument, (void)value, (void)ctx;
  return ROT_ERHS;
}

/* The functions of one input in order: of a torque, of the motors of rotors. */
typedef struct functions {
  const ffi_laws *laws;
  const rot_input *input; /* input that takes them */
  size_t place;           /* index of the scene's input */
  SEXP specs;             /* list of list(call, environment, complain), or NULL */
  R_xlen_t next;          /* index of the next one */
} functions;

/* => law of the next function; without specs it is not called */
static rot_law next_law(void *ctx) {
  functions *f = ctx;
  const R_xlen_t i = f->next++;
  if (TYPEOF(f->specs) != VECSXP || i >= XLENGTH(f->specs)) return (rot_law){.call = not_called};
  SEXP kept = f->laws->kept;
  ffi_torque *called = (ffi_torque *)R_alloc(1, sizeof *called);
  /* This protects its call. */
  *called = ffi_torque_new(VECTOR_ELT(f->specs, i), f->input, f->laws->guard);
  SEXP both = PROTECT(Rf_allocVector(VECSXP, 2)); /* the call and the earlier ones */
  SET_VECTOR_ELT(both, 0, called->call);
  SET_VECTOR_ELT(both, 1, VECTOR_ELT(kept, (R_xlen_t)f->place));
  SET_VECTOR_ELT(kept, (R_xlen_t)f->place, both);
  UNPROTECT(2);
  return (rot_law){.call = ffi_torque_values_at, .ctx = called};
}

static int read(const rot_input *input, SEXP x, functions *f, rot_given *to);

static int read_list(const rot_input *input, SEXP x, functions *f, rot_given *to) {
  const R_xlen_t n = XLENGTH(x);
  rot_given *item = (rot_given *)R_alloc((size_t)n + 1, sizeof *item);
  for (R_xlen_t k = 0; k < n; k++) {
    if (!read(input, VECTOR_ELT(x, k), f, &item[k])) return 0;
  }
  *to = (rot_given){.is = ROT_INPUT_LIST, .n = (size_t)n, .item = item};
  return 1;
}

/* Memory until the call from R ends. */
static void *take(size_t bytes) { return R_alloc(bytes, 1); }

/* list of the inputs of a part => part, built; returns 0 if it is invalid */
static int read_part(const rot_part *part, SEXP x, functions *f, rot_given *to) {
  const rot_input *outer = f->input;
  rot_given *given = (rot_given *)R_alloc(part->n_inputs + 1, sizeof *given);
  void *built = R_alloc(1, (int)part->size);
  rot_store store = {.take = take};
  rot_refusal no;
  if (TYPEOF(x) != VECSXP) return 0;
  for (size_t i = 0; i < part->n_inputs; i++) {
    f->input = &part->inputs[i];
    if (!read(f->input, ffi_element(x, f->input->name), f, &given[i])) return 0;
  }
  f->input = outer;
  if (rot_inputs_check(part->n_inputs, part->inputs, given, &no) != ROT_OK) return 0;
  if (part->build(part, given, &store, built, &no) != ROT_OK) return 0;
  *to = (rot_given){.is = part->makes, .n = 1, .object = built};
  return 1;
}

/* object of the class rot_<constructor> => its part; a list without class: a table */
static const rot_part *part_for(const rot_input *input, SEXP x) {
  if (!Rf_isObject(x)) {
    const int is = input->kinds & ROT_INPUT_TABLE && TYPEOF(x) == VECSXP;
    return is ? rot_part_named("torque") : NULL;
  }
  SEXP classes = Rf_getAttrib(x, R_ClassSymbol);
  for (R_xlen_t i = 0; TYPEOF(classes) == STRSXP && i < XLENGTH(classes); i++) {
    const char *name = CHAR(STRING_ELT(classes, i));
    const rot_part *part = strncmp(name, "rot_", 4) ? NULL : rot_part_named(name + 4);
    if (part && part->makes & input->kinds) return part;
  }
  return NULL;
}

/* x => value of the input; returns 0 if the input does not take it */
static int read(const rot_input *input, SEXP x, functions *f, rot_given *to) {
  const unsigned kinds = input->kinds;
  memset(to, 0, sizeof *to);
  if (Rf_isNull(x)) return 1;
  if (TYPEOF(x) == REALSXP && kinds & NUMBERS) {
    *to = (rot_given){.is = kind_of(kinds, XLENGTH(x)), .n = (size_t)XLENGTH(x), .x = REAL_RO(x)};
    return 1;
  }
  if (TYPEOF(x) == STRSXP && XLENGTH(x) == 1 && kinds & ROT_INPUT_CHOICE) {
    const char *text = CHAR(STRING_ELT(x, 0));
    to->is = ROT_INPUT_CHOICE;
    while (input->options[to->option] && strcmp(input->options[to->option], text)) to->option++;
    return input->options[to->option] != NULL;
  }
  if (kinds & ROT_INPUT_BODY && Rf_inherits(x, "rot_body")) {
    to->is = ROT_INPUT_BODY;
    to->n = 1;
    return TYPEOF(x) == VECSXP && read_body(x, &to->body);
  }
  if (kinds & ROT_INPUT_TORQUE && Rf_inherits(x, "rot_torque")) {
    if (TYPEOF(x) != VECSXP) return 0;
    rot_law_sum *sum = (rot_law_sum *)R_alloc(1, sizeof *sum);
    *sum = ffi_law_sum(x, next_law, f);
    *to = (rot_given){.is = ROT_INPUT_TORQUE, .n = 1, .object = sum};
    return 1;
  }
  const rot_part *part = part_for(input, x);
  if (part) return read_part(part, x, f, to);
  if (TYPEOF(x) == VECSXP && !Rf_isObject(x) && kinds & ROT_INPUT_LIST) {
    return read_list(input, x, f, to);
  }
  if (kinds & ROT_INPUT_LAW && Rf_inherits(x, "rot_samples")) {
    to->is = ROT_INPUT_LAW;
    return ffi_law_samples(x, &to->law);
  }
  if (Rf_isFunction(x) && kinds & ROT_INPUT_LAW) {
    to->is = ROT_INPUT_LAW;
    to->law = next_law(f);
    return 1;
  }
  return 0;
}

int ffi_input_read(const rot_input inputs[], size_t i, SEXP x, const ffi_laws *laws,
                   rot_given *to) {
  functions f = {laws, &inputs[i], i, laws ? ffi_element(laws->law, inputs[i].name) : R_NilValue,
                 0};
  return read(&inputs[i], x, &f, to);
}

/* => the option; the first one if x is all options, as in a default argument; NULL otherwise */
static SEXP plain_choice(const rot_input *input, SEXP x) {
  const R_xlen_t n = XLENGTH(x);
  if (n == 1) return x;
  for (R_xlen_t i = 0; i < n; i++) {
    if (!input->options[i] || strcmp(CHAR(STRING_ELT(x, i)), input->options[i])) return NULL;
  }
  return n && !input->options[n] ? Rf_mkString(input->options[0]) : NULL;
}

/* => law of a constant torque as an object of R */
static SEXP constant_law(double torque_n_m) {
  static const char *const names[] = {"time_s", "torque_n_m", "outside", ""};
  const double outside[] = {torque_n_m, torque_n_m};
  SEXP law = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SEXP classes = PROTECT(Rf_allocVector(STRSXP, 2));
  SET_VECTOR_ELT(law, 0, Rf_allocVector(REALSXP, 0));
  SET_VECTOR_ELT(law, 1, Rf_allocVector(REALSXP, 0));
  SET_STRING_ELT(classes, 0, Rf_mkChar("rot_torque_knots"));
  SET_STRING_ELT(classes, 1, Rf_mkChar("rot_torque"));
  Rf_setAttrib(law, R_ClassSymbol, classes);
  SET_VECTOR_ELT(law, 2, ffi_numbers(2, outside));
  UNPROTECT(2);
  return law;
}

/* A law or resistance of zeros alone; R takes it for none. */
static int is_nothing(SEXP part) {
  for (R_xlen_t i = 0; TYPEOF(part) == VECSXP && i < XLENGTH(part); i++) {
    SEXP x = VECTOR_ELT(part, i);
    if (TYPEOF(x) != REALSXP) return 0;
    for (R_xlen_t k = 0; k < XLENGTH(x); k++) {
      if (REAL_RO(x)[k] != 0.0) return 0;
    }
  }
  return 1;
}

/* => x if it is a part of one class that fits the form; else NULL */
static SEXP plain_part(const rot_input *input, SEXP x, SEXP form) {
  const unsigned kinds = input->kinds;
  int fits = 0;
  if (kinds & ROT_INPUT_LIST && kinds & ROT_INPUT_NOTHING) return NULL;
  if (kinds & ROT_INPUT_TORQUE) fits = Rf_inherits(x, "rot_torque");
  if (kinds & ROT_INPUT_RESISTANCE) fits |= Rf_inherits(x, "rot_resistance");
  if (kinds & ROT_INPUT_INERTIA) fits |= Rf_inherits(x, "rot_inertia_knots");
  return fits && Rf_isNull(ffi_form_fault(x, form)) && !is_nothing(x) ? x : NULL;
}

SEXP ffi_input_plain(const rot_input *input, SEXP x, SEXP form) {
  const unsigned kinds = input->kinds;
  /* No choice is NULL: its first one is the default. */
  if (Rf_isNull(x)) return input->required || kinds == ROT_INPUT_CHOICE ? NULL : x;
  if (Rf_inherits(x, "rot_body")) return kinds & ROT_INPUT_BODY ? x : NULL;
  if (Rf_isObject(x)) return plain_part(input, x, form);
  if (kinds & ROT_INPUT_TORQUE) {
    const int one = TYPEOF(x) == REALSXP && XLENGTH(x) == 1 &&
                    Rf_isNull(Rf_getAttrib(x, R_NamesSymbol)) &&
                    Rf_isNull(Rf_getAttrib(x, R_DimSymbol));
    return one && !(kinds & ROT_INPUT_NOTHING) && isfinite(*REAL_RO(x)) && *REAL_RO(x) != 0.0
               ? constant_law(*REAL_RO(x))
               : NULL;
  }
  if (!Rf_isNull(Rf_getAttrib(x, R_NamesSymbol)) || !Rf_isNull(Rf_getAttrib(x, R_DimSymbol))) {
    return NULL;
  }
  if (TYPEOF(x) == STRSXP) return kinds & ROT_INPUT_CHOICE ? plain_choice(input, x) : NULL;
  if (!(kinds & NUMBERS)) return NULL;
  if (TYPEOF(x) == INTSXP && XLENGTH(x) == 1 && INTEGER_RO(x)[0] != NA_INTEGER) {
    return Rf_ScalarReal(INTEGER_RO(x)[0]);
  }
  return TYPEOF(x) == REALSXP ? x : NULL;
}
