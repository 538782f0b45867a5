/* Registers the entries of glue/entries.h and the table of the C interface with R. */
#include <R_ext/Rdynload.h>
#include <R_ext/Visibility.h>

#include "glue/ffi.h"
#include "api/api.h"
#include "ground/gsl.h"

static const R_CallMethodDef entries[] = {
#define X(name, n) {#name, (DL_FUNC)&name, n},
#include "glue/entries.h"
#undef X
    {NULL, NULL, 0}};

void attribute_visible R_init_rotdyn(DllInfo *dll) {
  R_registerRoutines(dll, NULL, entries, NULL, NULL);
  R_useDynamicSymbols(dll, FALSE);
  R_forceSymbols(dll, TRUE);
  R_RegisterCCallable("rotdyn", "rotdyn_get_api", (DL_FUNC)(void (*)(void))rotdyn_get_api);
  rot_gsl_begin();
}
