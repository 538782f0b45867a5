/* For R: checks that an object has the parts of its form. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glue/ffi.h"
#include "glue/law.h"

/* A form describes the parts of the objects of a class (R/form.R lists its words). An invalid
 * object (edited, or of another version) is an error of the caller. R reports it at the entry of
 * its exported functions; internal functions do not check again. */

typedef struct fault {
  char path[120]; /* of the part that does not fit; "" for the object itself */
} fault;

static int all_of_kind(SEXP x, int (*good)(double)) {
  const double *value = REAL_RO(x);
  for (R_xlen_t i = 0; i < XLENGTH(x); i++) {
    if (!good(value[i])) return 0;
  }
  return 1;
}

static int is_finite(double x) { return R_FINITE(x); }
static int is_known(double x) { return !ISNAN(x); }

static int sorted(SEXP x) {
  const double *value = REAL_RO(x);
  for (R_xlen_t i = 1; i < XLENGTH(x); i++) {
    if (value[i] < value[i - 1]) return 0;
  }
  return 1;
}

static int no_text_missing(SEXP x) {
  for (R_xlen_t i = 0; i < XLENGTH(x); i++) {
    if (STRING_ELT(x, i) == NA_STRING) return 0;
  }
  return 1;
}

/* 1 if x is of the kind named by the first n letters of `word`. */
static int has_kind(SEXP x, const char *word, size_t n) {
  const int type = TYPEOF(x);
  /* A number with a class has the arithmetic of the class: dates have no product. */
  if (Rf_isObject(x) && (type == REALSXP || type == INTSXP || type == LGLSXP)) return 0;
#define IS(text) (n == sizeof text - 1 && !memcmp(word, text, n))
  if (IS("number")) return type == REALSXP && XLENGTH(x) == 1 && R_FINITE(REAL_RO(x)[0]);
  if (IS("numbers")) return type == REALSXP && all_of_kind(x, is_finite);
  if (IS("limit")) return type == REALSXP && XLENGTH(x) == 1 && !ISNAN(REAL_RO(x)[0]);
  if (IS("limits")) return type == REALSXP && all_of_kind(x, is_known);
  if (IS("values")) return type == REALSXP;
  if (IS("sorted")) return type == REALSXP && all_of_kind(x, is_finite) && sorted(x);
  if (IS("count")) {
    return (type == INTSXP || type == REALSXP) && XLENGTH(x) == 1 && R_FINITE(Rf_asReal(x));
  }
  if (IS("text")) return type == STRSXP && XLENGTH(x) == 1 && no_text_missing(x);
  if (IS("texts")) return type == STRSXP && no_text_missing(x);
  if (IS("flag")) return type == LGLSXP && XLENGTH(x) == 1 && LOGICAL_RO(x)[0] != NA_LOGICAL;
  if (IS("flags")) return type == LGLSXP;
  if (IS("function")) return Rf_isFunction(x);
  if (IS("list")) return type == VECSXP;
  if (IS("term")) return ffi_law_term_fits(x);
#undef IS
  Rf_error("internal: no kind of part is called `%s`", word);
}

/* 1 if x fits a word of the form kind[:length][=sibling[-1]][?]. */
static int fits_word(SEXP x, const char *text, SEXP parent) {
  const size_t n = strcspn(text, ":=?");
  if (strchr(text, '?') && Rf_isNull(x)) return 1;
  if (!has_kind(x, text, n)) return 0;
  if (text[n] == ':') return XLENGTH(x) == strtol(text + n + 1, NULL, 10);
  if (text[n] == '=') {
    char name[64];
    const size_t length = strcspn(text + n + 1, "-?");
    if (length >= sizeof name) Rf_error("internal: a name in a form is too long");
    memcpy(name, text + n + 1, length);
    name[length] = '\0';
    return XLENGTH(x) + (text[n + 1 + length] == '-') == Rf_xlength(ffi_element(parent, name));
  }
  return 1;
}

/* Prepends the name of a part to the path of the fault in it. */
static int put_before(const char *name, fault *at) {
  char rest[sizeof at->path];
  memcpy(rest, at->path, sizeof rest);
  (void)snprintf(at->path, sizeof at->path, "%.40s%s%.70s", name, rest[0] ? "$" : "", rest);
  return 0;
}

/* name => part of x. R caches strings, so equal names have equal addresses; ffi_element() compares
 * the letters, for a name in another encoding. */
static SEXP part_of(SEXP x, SEXP names_of_x, SEXP name) {
  const R_xlen_t n = TYPEOF(names_of_x) == STRSXP ? XLENGTH(names_of_x) : 0;
  for (R_xlen_t i = 0; i < n; i++) {
    if (STRING_ELT(names_of_x, i) == name) return VECTOR_ELT(x, i);
  }
  return ffi_element(x, CHAR(name));
}

/* 1 if x fits the form, else 0 and the path in *at. A form is a word, or a list of forms by names
 * of parts; names with a dot are further conditions. */
static int fits(SEXP x, SEXP form, SEXP parent, fault *at) {
  if (TYPEOF(form) == STRSXP) return fits_word(x, ffi_text(form, "form"), parent);
  const SEXP names = Rf_getAttrib(form, R_NamesSymbol);
  if (TYPEOF(form) != VECSXP || TYPEOF(names) != STRSXP) Rf_error("internal: `form`");
  if (Rf_isNull(x)) return !Rf_isNull(ffi_element(form, ".optional"));
  /* A choice may be between a list and a number. */
  if (TYPEOF(x) != VECSXP && Rf_isNull(ffi_element(form, ".one_of"))) return 0;
  const SEXP names_of_x = Rf_getAttrib(x, R_NamesSymbol);
  for (R_xlen_t i = 0; i < XLENGTH(form); i++) {
    const char *name = CHAR(STRING_ELT(names, i));
    const SEXP part = VECTOR_ELT(form, i);
    if (name[0] != '.') {
      if (TYPEOF(x) != VECSXP) return 0;
      if (!fits(part_of(x, names_of_x, STRING_ELT(names, i)), part, x, at)) {
        return put_before(name, at);
      }
    } else if (!strcmp(name, ".is")) {
      if (!fits_word(x, ffi_text(part, "word"), parent)) return 0;
    } else if (!strcmp(name, ".class")) {
      if (!Rf_inherits(x, ffi_text(part, "class"))) return 0;
    } else if (!strcmp(name, ".each")) {
      for (R_xlen_t j = 0; j < XLENGTH(x); j++) {
        if (!fits(VECTOR_ELT(x, j), part, x, at)) return 0;
      }
    } else if (!strcmp(name, ".one_of")) {
      R_xlen_t j = 0;
      while (j < XLENGTH(part) && !fits(x, VECTOR_ELT(part, j), parent, at)) j++;
      at->path[0] = '\0';
      if (j == XLENGTH(part)) return 0;
    }
  }
  return 1;
}

/* => NULL if x fits the form; else the path of the part that does not, "" for x itself */
SEXP ffi_form_fault(SEXP x, SEXP form) {
  fault at = {""};
  return fits(x, form, R_NilValue, &at) ? R_NilValue : Rf_mkString(at.path);
}
