/* Sweeps of R => sweeps of the core. */
#ifndef FFI_BLOCK_H
#define FFI_BLOCK_H

#include "glue/ffi.h"
#include "sweep/block.h"

/* A sweep of R: list(node, inputs, bound, time_s, model, asked, accuracy, max_steps, outputs,
 * design, derived, part, threads) => the core's. `scene` is NULL until ffi_sweep_scene(). R error
 * where it is damaged. Valid as long as the list and until the call from R ends. */
rot_sweep ffi_sweep(SEXP sweep);
/* Makes the scene of the sweep; the caller frees it by rot_object_free(). Calls nothing of R that
 * may jump; NULL: `fault` says why. */
rot_object *ffi_sweep_scene(SEXP sweep, rot_sweep *to, char fault[]);

#endif
