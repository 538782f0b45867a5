/* For R: bodies with a fixed point. */
#include "glue/run.h"
#include "glue/scene.h"
#include "scene/choice.h"
#include "scene/pivot/pivot.h"

/* => c(period in s, amplitude in rad, mean precession in rad/s); NULL: not a symmetric top */
SEXP ffi_pivot_nutation(SEXP scene) {
  const rot_constraint *pivot = rot_choice_constraint("pivot");
  double out[3];
  if (rot_pivot_nutation(ffi_scene_build(pivot, scene), out) != ROT_OK) return R_NilValue;
  return ffi_numbers(3, out);
}
