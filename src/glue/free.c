/* For R: free bodies. */
#include "glue/scene.h"
#include "scene/choice.h"
#include "scene/free/exact.h"

/* three columns of principal moments, three of rates => times between flips; NA for impossible
 * numbers */
SEXP ffi_free_flips(SEXP moments, SEXP rates) {
  rot_column moment[3], rate[3];
  R_xlen_t n = 1;
  if (TYPEOF(moments) != VECSXP || XLENGTH(moments) != 3 || TYPEOF(rates) != VECSXP ||
      XLENGTH(rates) != 3) {
    Rf_error("internal: no columns");
  }
  for (int k = 0; k < 3; k++) {
    moment[k] = ffi_column(VECTOR_ELT(moments, k), "moment", &n);
    rate[k] = ffi_column(VECTOR_ELT(rates, k), "rate", &n);
  }
  SEXP out = PROTECT(ffi_new_column(n));
  for (size_t i = 0; i < (size_t)n; i++) {
    double m[3], w[3], time_s;
    for (int k = 0; k < 3; k++) {
      m[k] = rot_at(moment[k], i);
      w[k] = rot_at(rate[k], i);
    }
    REAL(out)[i] = rot_free_flip_time(m, w, &time_s) == ROT_OK ? time_s : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* scene without torque, damping and rotors => list(period_s, kind) */
SEXP ffi_free_period(SEXP scene) {
  static const char *const names[] = {"period_s", "kind", ""};
  static const char *const kinds[] = {[ROT_FREE_STILL] = "none",
                                      [ROT_FREE_WOBBLE] = "wobble",
                                      [ROT_FREE_ROTATION] = "rotation",
                                      [ROT_FREE_SEPARATRIX] = "separatrix"};
  rot_free_cycle cycle;
  const double period_s =
      rot_free_period(ffi_scene_build(rot_choice_constraint("free"), scene), &cycle);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, Rf_ScalarReal(period_s));
  SET_VECTOR_ELT(out, 1, Rf_mkString(kinds[cycle]));
  UNPROTECT(1);
  return out;
}
