/* Scenes of R, read by the names of their elements. Vectors stay those of R. A wrong type or length
 * is an R error. */
#ifndef FFI_SCENES_H
#define FFI_SCENES_H

#include "glue/ffi.h"
#include "scene/axle/scene.h"

/* With all its breaks, and with those in `breaks_s` (NULL: no others). */
rot_axle_scene ffi_axle_scene(SEXP scene, SEXP breaks_s);

#endif
