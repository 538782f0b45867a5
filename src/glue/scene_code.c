/* For R: the R code that makes a scene. */
#include <stdlib.h>
#include <string.h>

#include "glue/ffi.h"
#include "text/scene_code.h"

/* JSON text of a scene => its code; NULL: there is none. */
SEXP ffi_scene_code(SEXP text) {
  rot_json *tree = rot_json_read(CHAR(STRING_ELT(text, 0)));
  rot_writer code = {0};
  const int fine = tree && rot_scene_code(tree, &code);
  rot_json_free(tree);
  char *copy = fine ? R_alloc(code.length + 1, 1) : NULL;
  if (copy) memcpy(copy, code.text, code.length + 1);
  free(code.text);
  return copy ? Rf_ScalarString(Rf_mkCharLenCE(copy, (int)code.length, CE_UTF8)) : R_NilValue;
}
