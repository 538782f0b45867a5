/* Scenes of rotors and clutches as R packs them. */
#ifndef FFI_SCENES_H
#define FFI_SCENES_H

#include "ffi.h"
#include "rot_clutch.h"
#include "rot_shaft.h"

rot_shaft_params ffi_rotors_scene(SEXP pack);
rot_clutch_params ffi_clutch_scene(SEXP pack);

#endif
