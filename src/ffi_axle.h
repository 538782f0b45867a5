/* Scenes on an axle as R packs them, for the glue that runs them. */
#ifndef FFI_AXLE_H
#define FFI_AXLE_H

#include "ffi.h"
#include "rot_axle_scene.h"

rot_axle_scene ffi_axle_scene(SEXP pack);
rot_axle_model ffi_axle_model_named(SEXP name);

#endif
