/* Scenes of R that are the inputs of their constraint, read by its table. */
#ifndef FFI_SCENE_H
#define FFI_SCENE_H

#include "glue/ffi.h"
#include "engine/model.h"

/* The constraint of this name. */
const rot_constraint *ffi_constraint(SEXP id);
/* The scene as its models read it, kept until the call from R ends; an R error where it is damaged:
 * R asks ffi_scene_fault() before. */
const void *ffi_scene_build(const rot_constraint *constraint, SEXP scene);

#endif
