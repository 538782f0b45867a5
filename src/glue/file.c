/* For R: writes bytes and lines to files and descriptors. */
#include <string.h>

#include "glue/ffi.h"
#include "ground/file.h"

/* Adds bytes, or lines of text with a newline after each. */
static void add_all(rot_file *file, SEXP x) {
  if (TYPEOF(x) == RAWSXP) {
    rot_file_add(file, RAW(x), (size_t)XLENGTH(x));
  } else if (TYPEOF(x) == STRSXP) {
    const R_xlen_t n = XLENGTH(x);
    for (R_xlen_t i = 0; i < n; i++) {
      const char *line = CHAR(STRING_ELT(x, i));
      rot_file_add(file, line, strlen(line));
      rot_file_add(file, "\n", 1);
    }
  } else {
    Rf_error("`x` must be bytes or text");
  }
}

/* Writes x to a file (by name) or a descriptor (by number). Returns "", or the error. A pipe
 * without reader is an R error, raised by R's signal handler. */
SEXP ffi_file_write(SEXP to, SEXP x) {
  rot_file *file = (rot_file *)R_alloc(1, sizeof *file);
  if (TYPEOF(to) == INTSXP && XLENGTH(to) == 1) {
    rot_file_on(file, INTEGER(to)[0]);
  } else {
    rot_file_open(file, ffi_text(to, "to"));
  }
  add_all(file, x);
  return Rf_mkString(rot_file_fault(rot_file_close(file)));
}

SEXP ffi_file_special(SEXP path) {
  return Rf_ScalarLogical(rot_file_special(ffi_text(path, "path")));
}
