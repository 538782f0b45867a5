/* Nodes of a scene's text (R/scene-text.R) => objects of the core. */
#ifndef FFI_OBJECT_H
#define FFI_OBJECT_H

#include "glue/ffi.h"
#include "object/object.h"

enum { FFI_OBJECT_FAULT = 256 };

/* node => scene, to be freed by rot_object_free(); NULL with the reason in `fault`. Functions are
 * laws that end a run, or left out: such a scene can be walked, not run. Calls nothing of R that
 * may jump. */
rot_object *ffi_object(SEXP node, char fault[FFI_OBJECT_FAULT]);

#endif
