/* For R: modes of rotors on one shaft. */
#include "glue/run.h"
#include "glue/scene.h"
#include "scene/shaft/modal.h"
#include "scene/shaft/models.h"

/* => list(frequencies, info): angular frequencies of the undamped shaft, NA if it failed */
SEXP ffi_rotors_frequencies(SEXP scene, SEXP progress) {
  static const char *const names[] = {"frequencies", "info", ""};
  const rot_shaft_params p =
      *(const rot_shaft_params *)ffi_scene_build(&rot_shaft_constraint, scene);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), frequencies;
  SET_VECTOR_ELT(out, 0, frequencies = Rf_allocVector(REALSXP, (R_xlen_t)p.n));
  rot_info info;
  ffi_guard guard;
  rot_info_clear(&info, NULL);
  ffi_guard_begin(&guard, progress);
  info.status = rot_shaft_frequencies(&p, REAL(frequencies), &guard.hooks);
  ffi_guard_end(&guard, info.status);
  for (size_t i = 0; i < p.n && info.status != ROT_OK; i++) REAL(frequencies)[i] = NA_REAL;
  SET_VECTOR_ELT(out, 1, ffi_info(&info));
  UNPROTECT(1);
  return out;
}
