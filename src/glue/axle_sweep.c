/* For R: many axles, one per row. */
#include "glue/run.h"
#include "glue/scene.h"
#include "scene/axle/drag.h"
#include "scene/axle/bands.h"
#include "scene/axle/inputs.h"
#include "scene/axle/linear.h"
#include "scene/axle/models.h"
#include "scene/axle/sweep.h"
#include "scene/choice.h"
#include "ground/parallel.h"

/* scene, columns `rows_in` => list(columns, status, info) by the closed form `id`. The named
 * columns, each of one value or one per row, replace the scene's numbers; the viscous coefficient
 * of "axle_linear" includes the motor's. Status 0: the row is valid. */
SEXP ffi_axle_sweep(SEXP id, SEXP list, SEXP rows_in, SEXP threads, SEXP progress) {
  static const char *const names[] = {ROT_AXLE_SWEEP_COLUMNS(FFI_COLUMN_NAME) ""};
  static const char *const parts[] = {"columns", "status", "info", ""};
  const rot_model *known = rot_choice_model(&rot_axle_constraint, ffi_text(id, "model"));
  const rot_axle_model model = known ? rot_axle_form(known) : NULL;
  const rot_axle_built *built = ffi_scene_build(&rot_axle_constraint, list);
  const rot_axle_scene *scene = &built->scene;
  const double max = ffi_real(threads, "threads");
  if (!model) Rf_error("internal: no such model");
  if (!(max >= 0.0 && max <= 4096.0)) Rf_error("internal: `threads`");
  R_xlen_t rows = 1, at = 0;
#define IN(name) ffi_column(ffi_element(rows_in, #name), #name, &rows)
  rot_axle_sweep_rows in = {0,
                            scene->linear.start_s,
                            IN(moment_of_inertia_kg_m2),
                            IN(viscous_n_m_s),
                            IN(torque_scale),
                            IN(omega0_rad_per_s),
                            IN(theta0_rad),
                            IN(time_s)};
  const rot_axle_sweep_friction friction = {IN(quadratic_n_m_s2), IN(coulomb_n_m), IN(static_n_m)};
#undef IN
  in.n = (size_t)rows;
  SEXP result = PROTECT(Rf_mkNamed(VECSXP, (const char **)parts)), columns, status;
  SET_VECTOR_ELT(result, 0, columns = Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(result, 1, status = Rf_allocVector(INTSXP, rows));
  rot_axle_sweep_columns out;
  ROT_AXLE_SWEEP_COLUMNS(FFI_COLUMN_NEW)
  out.status = INTEGER(status);
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(
      &guard,
      model == rot_axle_linear_scene
          ? rot_axle_sweep_linear(&scene->linear.torque, &in, (int)max, &out, &guard.hooks, &info)
          : rot_axle_sweep_scenes(model, scene, &in, &friction,
                                  model == rot_axle_drag || model == rot_axle_bands, (int)max, &out,
                                  &guard.hooks, &info));
  SET_VECTOR_ELT(result, 2, ffi_info(&info));
  UNPROTECT(1);
  return result;
}

SEXP ffi_axle_sweep_threads(void) { return Rf_ScalarInteger(rot_parallel_threads()); }
