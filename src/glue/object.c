#include "glue/object.h"

#include <stdio.h>
#include <string.h>

enum { MAX_LEVELS = 64 };

typedef struct reading {
  char *fault;
  int level;
} reading;

static rot_object *named_object(const char *constructor, SEXP inputs, reading *r);

static int refuse(reading *r, const char *name, const char *what) {
  if (!*r->fault) {
    (void)snprintf(r->fault, FFI_OBJECT_FAULT, "`%s` %s", name ? name : "an item", what);
  }
  return 0;
}

static const char *name_at(SEXP x, R_xlen_t i) {
  SEXP names = Rf_getAttrib(x, R_NamesSymbol);
  return TYPEOF(names) == STRSXP && i < XLENGTH(names) ? CHAR(STRING_ELT(names, i)) : "";
}

static int has_names(SEXP x) { return !Rf_isNull(Rf_getAttrib(x, R_NamesSymbol)); }

/* `kind`: the input that takes x, also where x is an item of its list (input NULL). */
static int put(rot_object *to, const char *input, const char *kind, SEXP x, reading *r);

static int put_object(rot_object *to, const char *input, const char *kind, rot_object *part,
                      reading *r) {
  if (!part) return refuse(r, kind, "is damaged");
  const rot_set set = rot_object_part(to, input, part);
  rot_object_free(part);
  return set == ROT_SET_DONE || refuse(r, kind, "takes no such object");
}

/* A named list: {constructor: inputs}, or the inputs of the constructor that the input names. */
static int put_named(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  rot_made made;
  const int one = XLENGTH(x) == 1 && TYPEOF(x) == VECSXP && rot_object_made(name_at(x, 0), &made);
  rot_object *part =
      one ? named_object(name_at(x, 0), VECTOR_ELT(x, 0), r) : named_object(kind, x, r);
  return put_object(to, input, kind, part, r);
}

static int put_list(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  rot_object *list = rot_object_new("list");
  int ok = list != NULL;
  for (R_xlen_t i = 0; i < XLENGTH(x) && ok; i++) {
    ok = put(list, NULL, kind, VECTOR_ELT(x, i), r);
  }
  if (ok) return put_object(to, input, kind, list, r);
  rot_object_free(list);
  return refuse(r, kind, "is damaged");
}

static int put_numbers(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  const R_xlen_t n = XLENGTH(x);
  rot_set set = ROT_SET_NOT_TAKEN;
  if (n == 1) set = rot_object_number(to, input, REAL_RO(x)[0]);
  if (set != ROT_SET_DONE) set = rot_object_numbers(to, input, (size_t)n, REAL_RO(x));
  return set == ROT_SET_DONE || refuse(r, kind, "takes no such numbers");
}

/* The rows of a matrix, as items of a list. */
static int put_matrix(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  enum { MAX_COLUMNS = 64 };
  const R_xlen_t rows = Rf_nrows(x), columns = Rf_ncols(x);
  rot_object *list = rot_object_new("list");
  int ok = list != NULL && columns <= MAX_COLUMNS;
  for (R_xlen_t i = 0; i < rows && ok; i++) {
    double row[MAX_COLUMNS];
    for (R_xlen_t k = 0; k < columns; k++) row[k] = REAL_RO(x)[i + k * rows];
    ok = rot_object_numbers(list, NULL, (size_t)columns, row) == ROT_SET_DONE;
  }
  if (ok) return put_object(to, input, kind, list, r);
  rot_object_free(list);
  return refuse(r, kind, "takes no such matrix");
}

static int put_wholes(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  const int *from = TYPEOF(x) == INTSXP ? INTEGER_RO(x) : LOGICAL_RO(x);
  if (XLENGTH(x) != 1 || from[0] == NA_INTEGER) return refuse(r, kind, "takes no such numbers");
  return rot_object_number(to, input, from[0]) == ROT_SET_DONE ||
         refuse(r, kind, "takes no number");
}

/* 1 for functions and lists of them. */
static int is_called(SEXP x) {
  R_xlen_t i = 0;
  if (Rf_isFunction(x)) return 1;
  while (TYPEOF(x) == VECSXP && i < XLENGTH(x) && Rf_isFunction(VECTOR_ELT(x, i))) i++;
  return TYPEOF(x) == VECSXP && i > 0 && i == XLENGTH(x);
}

/* 1 for names of what the core counts. */
static int is_counted(const rot_object *to, const char *input, SEXP x) {
  const size_t at = input ? rot_input_named(to->n, to->inputs, input) : to->n;
  return TYPEOF(x) == STRSXP && at < to->n &&
         !(to->inputs[at].kinds & (ROT_INPUT_CHOICE | ROT_INPUT_TEXT));
}

static int not_called(const double *argument, double *value, void *context) {
  (void)argument, (void)value, (void)context;
  return 1;
}

/* What is no number: a function stays as a law that ends its run; the rest is unset. */
static int leave_out(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  const rot_caller_law law = {not_called, NULL};
  if (Rf_isFunction(x) && rot_object_law(to, input, law) == ROT_SET_DONE) return 1;
  return rot_object_unset(to, input) == ROT_SET_DONE || is_called(x) ||
         refuse(r, kind, "is unknown");
}

static int put(rot_object *to, const char *input, const char *kind, SEXP x, reading *r) {
  if (r->level > MAX_LEVELS) return refuse(r, kind, "is nested too deep");
  if (Rf_isNull(x) || is_called(x) || Rf_isObject(x) || is_counted(to, input, x)) {
    return leave_out(to, input, kind, x, r);
  }
  if (TYPEOF(x) == REALSXP && Rf_isMatrix(x)) return put_matrix(to, input, kind, x, r);
  /* Of names that are no inputs of a part the numbers have an order: the states of equations. */
  rot_made made;
  if (TYPEOF(x) == REALSXP && !(has_names(x) && rot_object_made(kind, &made))) {
    return put_numbers(to, input, kind, x, r);
  }
  if (TYPEOF(x) == INTSXP || TYPEOF(x) == LGLSXP) return put_wholes(to, input, kind, x, r);
  if (TYPEOF(x) == STRSXP && XLENGTH(x) == 1) {
    return rot_object_text(to, input, CHAR(STRING_ELT(x, 0))) == ROT_SET_DONE ||
           refuse(r, kind, "takes no such text");
  }
  if (TYPEOF(x) != VECSXP && TYPEOF(x) != REALSXP) return refuse(r, kind, "is damaged");
  r->level++;
  const int ok = has_names(x)          ? put_named(to, input, kind, x, r)
                 : TYPEOF(x) == VECSXP ? put_list(to, input, kind, x, r)
                                       : refuse(r, kind, "is damaged");
  r->level--;
  return ok;
}

/* => the object with its inputs set, or NULL */
static rot_object *named_object(const char *constructor, SEXP inputs, reading *r) {
  rot_object *object = rot_object_new(constructor);
  int ok = object != NULL && (TYPEOF(inputs) == VECSXP || TYPEOF(inputs) == REALSXP);
  for (R_xlen_t i = 0; ok && i < XLENGTH(inputs); i++) {
    const char *name = name_at(inputs, i);
    if (TYPEOF(inputs) == VECSXP) {
      ok = put(object, name, name, VECTOR_ELT(inputs, i), r);
    } else {
      ok = rot_object_number(object, name, REAL_RO(inputs)[i]) == ROT_SET_DONE ||
           refuse(r, name, "is unknown");
    }
  }
  if (ok) return object;
  rot_object_free(object);
  return NULL;
}

rot_object *ffi_object(SEXP node, char fault[FFI_OBJECT_FAULT]) {
  reading r = {fault, 0};
  rot_made made;
  fault[0] = '\0';
  for (R_xlen_t i = 0; TYPEOF(node) == VECSXP && i < XLENGTH(node); i++) {
    if (!rot_object_made(name_at(node, i), &made) || !made.maker) continue;
    rot_object *scene = named_object(name_at(node, i), VECTOR_ELT(node, i), &r);
    if (!scene && !*fault) (void)refuse(&r, name_at(node, i), "is damaged");
    return scene;
  }
  (void)refuse(&r, "the text", "is no scene");
  return NULL;
}
