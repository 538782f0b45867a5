/* For R: shafts of a gear train, and the train reduced to the first shaft. */
#include "glue/run.h"
#include "scene/axle/train.h"

static void *take(size_t bytes) { return R_alloc(bytes, 1); }

/* n shafts, n - 1 meshes => list(columns, law): a row per shaft; named numbers of the law */
SEXP ffi_train(SEXP inertia, SEXP ratios, SEXP efficiency, SEXP torque, SEXP viscous) {
  static const char *const parts[] = {"columns", "law", ""};
  static const char *const names[] = {"ratio_to_first", "reflected_inertia_kg_m2",
                                      "reflected_viscous_n_m_s", "reflected_torque_n_m", ""};
  static const char *const of_law[] = {"applied_n_m", "forward_n_m", "backward_n_m",
                                       "bearings_n_m_s"};
  const R_xlen_t n = XLENGTH(inertia);
  rot_store store = {.take = take};
  rot_axle_train train;
  rot_axle_train_law law;
  if (rot_axle_train_reflect(
          (size_t)n, ffi_reals(ratios, "ratios", n - 1), ffi_reals(inertia, "inertia", n),
          ffi_reals(viscous, "viscous", n), ffi_reals(torque, "torque", n),
          ffi_reals(efficiency, "efficiency", n - 1), &store, &train) != ROT_OK) {
    Rf_error("out of memory");
  }
  const rot_status status = rot_axle_train_law_of(&train, &store, &law);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)parts)), columns;
  SET_VECTOR_ELT(out, 0, columns = Rf_mkNamed(VECSXP, (const char **)names));
  const double *own[] = {train.ratio, train.inertia_kg_m2, train.viscous_n_m_s};
  for (R_xlen_t k = 0; k < 3; k++) {
    double *to = ffi_new_double(columns, k, n);
    for (R_xlen_t i = 0; i < n; i++) to[i] = own[k][i];
  }
  rot_axle_train_steady(&train, ffi_new_double(columns, 3, n));
  const double lossless[] = {law.torque_n_m, 0.0, 0.0, law.viscous_n_m_s};
  const double lossy[] = {law.gears.applied_n_m, law.gears.forward_n_m, law.gears.backward_n_m,
                          law.gears.bearings_n_m_s};
  const double none[] = {NA_REAL, NA_REAL, NA_REAL, NA_REAL};
  const double *of = status != ROT_OK ? none : law.lossy ? lossy : lossless;
  SET_VECTOR_ELT(out, 1, ffi_named(4, of_law, of));
  UNPROTECT(1);
  return out;
}
