/* Scenes of R, read by the names of their elements. Vectors stay those of R. A wrong type or length
 * is an R error. */
#ifndef FFI_SCENES_H
#define FFI_SCENES_H

#include "glue/ffi.h"
#include "scene/axle/scene.h"
#include "scene/drive/drive.h"
#include "scene/free/free.h"

/* With all its breaks, and with those in `breaks_s` (NULL: no others). */
rot_axle_scene ffi_axle_scene(SEXP scene, SEXP breaks_s);
/* Its R function is only marked, not called. */
rot_free_params ffi_free_scene(SEXP scene);
/* A run by a closed form of such scenes. */
typedef rot_status ffi_free_form(const rot_free_params *p, size_t n, const double time_s[],
                                 const rot_free_columns *out, rot_events *events,
                                 const rot_hooks *hooks, rot_info *info);
SEXP ffi_free_rows(SEXP scene, SEXP time_s, SEXP progress, ffi_free_form *form);
/* Its R functions are only marked, not called. */
rot_drive_scene ffi_drive_scene(SEXP scene);

#endif
