/* For R: numbers and strings as text, values as JSON. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "glue/ffi.h"
#include "ground/text.h"

/* numbers => texts */
SEXP ffi_text_numbers(SEXP x) {
  const R_xlen_t n = XLENGTH(x);
  const double *values = ffi_reals(x, "x", n);
  SEXP out = PROTECT(Rf_allocVector(STRSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    char text[ROT_TEXT_SIZE];
    rot_text_number(values[i], text);
    SET_STRING_ELT(out, i, Rf_mkChar(text));
  }
  UNPROTECT(1);
  return out;
}

/* ---- JSON ------------------------------------------------------------------------------------ */

/* A growing text in R's memory. */
typedef struct text_sink {
  char *text;
  size_t length, room; /* used, allocated */
  const char *comma;   /* separator of the elements of an array of values */
} text_sink;

static char *room_for(text_sink *out, size_t more) {
  if (out->room - out->length < more) {
    out->room = 2 * out->room + more;
    char *text = R_alloc(out->room, 1);
    memcpy(text, out->text, out->length);
    out->text = text;
  }
  return out->text + out->length;
}

static void write_plain(text_sink *out, const char *text) {
  const size_t length = strlen(text);
  memcpy(room_for(out, length), text, length);
  out->length += length;
}

static void write_string(text_sink *out, SEXP string) {
  const char *text = string == NA_STRING ? "NA" : Rf_translateCharUTF8(string);
  out->length += rot_text_string(text, room_for(out, 6 * strlen(text) + 3));
}

/* Writes element i of an atomic vector. */
static void write_value(text_sink *out, SEXP x, R_xlen_t i) {
  char text[ROT_TEXT_SIZE];
  double number = NA_REAL;
  switch (TYPEOF(x)) {
  case STRSXP: write_string(out, STRING_ELT(x, i)); return;
  case LGLSXP:
    write_plain(out, LOGICAL(x)[i] == NA_LOGICAL ? "null" : LOGICAL(x)[i] ? "true" : "false");
    return;
  case REALSXP: number = REAL(x)[i]; break;
  case INTSXP:
    if (INTEGER(x)[i] != NA_INTEGER) number = INTEGER(x)[i];
    break;
  default: Rf_error("`x` must be made of lists, texts, numbers and logical values");
  }
  rot_text_number(number, text);
  const char *quote = R_FINITE(number) ? "" : "\"";
  write_plain(out, quote);
  write_plain(out, text);
  write_plain(out, quote);
}

/* Writes n values as an array, from index `first` in steps of `step`. */
static void write_values(text_sink *out, SEXP x, R_xlen_t first, R_xlen_t n, R_xlen_t step) {
  write_plain(out, "[");
  for (R_xlen_t i = 0; i < n; i++) {
    if (i > 0) write_plain(out, out->comma);
    write_value(out, x, first + i * step);
  }
  write_plain(out, "]");
}

typedef struct text_key {
  const char *name;
  R_xlen_t at;
} text_key;

static int by_bytes(const void *a, const void *b) {
  const text_key *one = a, *two = b;
  const int order = strcmp(one->name, two->name);
  return order != 0 ? order : one->at < two->at ? -1 : 1;
}

/* Writes x: vector, matrix by rows, list as array, named list as object. */
static void write_any(text_sink *out, SEXP x) {
  R_CheckStack();
  const R_xlen_t n = Rf_xlength(x);
  if (x == R_NilValue) {
    write_plain(out, "null");
  } else if (TYPEOF(x) != VECSXP) {
    if (Rf_isMatrix(x)) {
      const R_xlen_t rows = Rf_nrows(x);
      write_plain(out, "[");
      for (R_xlen_t i = 0; i < rows; i++) {
        if (i > 0) write_plain(out, out->comma);
        write_values(out, x, i, Rf_ncols(x), rows);
      }
      write_plain(out, "]");
    } else if (n == 1) {
      write_value(out, x, 0);
    } else {
      write_values(out, x, 0, n, 1);
    }
  } else {
    SEXP names = PROTECT(Rf_getAttrib(x, R_NamesSymbol));
    if (names == R_NilValue) {
      write_plain(out, "[");
      for (R_xlen_t i = 0; i < n; i++) {
        if (i > 0) write_plain(out, ",");
        write_any(out, VECTOR_ELT(x, i));
      }
      write_plain(out, "]");
    } else {
      text_key *keys = (text_key *)R_alloc((size_t)n + 1, sizeof *keys);
      for (R_xlen_t i = 0; i < n; i++) {
        keys[i].name = Rf_translateCharUTF8(STRING_ELT(names, i));
        keys[i].at = i;
      }
      qsort(keys, (size_t)n, sizeof *keys, by_bytes);
      write_plain(out, "{");
      for (R_xlen_t i = 0; i < n; i++) {
        if (i > 0) write_plain(out, ",");
        write_string(out, STRING_ELT(names, keys[i].at));
        write_plain(out, ":");
        write_any(out, VECTOR_ELT(x, keys[i].at));
      }
      write_plain(out, "}");
    }
    UNPROTECT(1);
  }
}

/* x => JSON without blanks, keys sorted by bytes */
SEXP ffi_text_json(SEXP x, SEXP comma) {
  text_sink out = {R_alloc(1024, 1), 0, 1024, ffi_text(comma, "comma")};
  write_any(&out, x);
  if (out.length > INT_MAX) Rf_error("the text is longer than 2^31 - 1 characters");
  return Rf_ScalarString(Rf_mkCharLenCE(out.text, (int)out.length, CE_UTF8));
}

/* strings => quoted strings */
SEXP ffi_text_strings(SEXP x) {
  if (TYPEOF(x) != STRSXP) Rf_error("`x` must be text");
  const R_xlen_t n = XLENGTH(x);
  SEXP out = PROTECT(Rf_allocVector(STRSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    const void *top = vmaxget();
    text_sink one = {R_alloc(64, 1), 0, 64, ","};
    write_string(&one, STRING_ELT(x, i));
    if (one.length > INT_MAX) Rf_error("a text is longer than 2^31 - 1 characters");
    SET_STRING_ELT(out, i, Rf_mkCharLenCE(one.text, (int)one.length, CE_UTF8));
    vmaxset(top);
  }
  UNPROTECT(1);
  return out;
}
