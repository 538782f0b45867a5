/* Scenes of R (inputs of a constraint) => scenes of the core, by the constraint's table. */
#ifndef FFI_SCENE_H
#define FFI_SCENE_H

#include "glue/ffi.h"
#include "engine/model.h"

/* name => constraint; an R error if there is none */
const rot_constraint *ffi_constraint(SEXP id);
/* scene => as its models read it, valid until the call from R ends. An R error for an invalid
 * scene; R calls ffi_scene_fault() before. */
const void *ffi_scene_build(const rot_constraint *constraint, SEXP scene);

#endif
