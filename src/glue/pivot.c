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

/* => members of rot_pivot_pendulum; NULL: the motion is not plane */
SEXP ffi_pivot_plane(SEXP scene) {
  rot_pivot_pendulum of;
  if (!rot_pivot_plane(ffi_scene_build(rot_choice_constraint("pivot"), scene), &of)) {
    return R_NilValue;
  }
  const double out[] = {of.moment_kg_m2, of.weight_n_m, of.angle_rad, of.omega_rad_per_s};
  return ffi_numbers(4, out);
}
