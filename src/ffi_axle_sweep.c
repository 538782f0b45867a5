#include "ffi_axle.h"

#include "ffi_run.h"
#include "rot_axle_sweep.h"

/* The order of the columns that come in, and of those that go out. */
enum { INERTIA, VISCOUS, SCALE, OMEGA0, THETA0, TIME, COLUMNS_IN };
static const char *const names_out[] = {
    "theta_rad", "omega_rad_per_s", "omega_max", "omega_max_time_s",
    "omega_min", "speed_max",       "error"};
enum { COLUMNS_OUT = sizeof names_out / sizeof names_out[0] };

/* list(knot times, knot torques, c(before, after)); list of six columns, each of one value or one a
 * row: inertia, viscous, scale, omega0, theta0, time; gives list(columns, status, info), the status
 * of a row 0 where it is good. */
SEXP ffi_sweep_linear(SEXP knots, SEXP columns, SEXP start_s, SEXP threads, SEXP progress) {
  static const char *const what[] = {"inertia", "viscous", "scale", "omega0", "theta0", "time"};
  if (TYPEOF(knots) != VECSXP || XLENGTH(knots) != 3) Rf_error("internal: `knots`");
  if (TYPEOF(columns) != VECSXP || XLENGTH(columns) != COLUMNS_IN) Rf_error("internal: `columns`");
  SEXP times = VECTOR_ELT(knots, 0);
  const double *outside = ffi_reals(VECTOR_ELT(knots, 2), "outside", 2);
  const rot_torque torque = {(size_t)XLENGTH(times),
                             ffi_reals(times, "times", -1),
                             ffi_reals(VECTOR_ELT(knots, 1), "torque", XLENGTH(times)),
                             outside[0],
                             outside[1],
                             NULL,
                             NULL};
  const double start = ffi_real(start_s, "start"), most = ffi_real(threads, "threads");
  if (!(most >= 0.0 && most <= 4096.0)) Rf_error("internal: `threads`");
  rot_column in[COLUMNS_IN];
  R_xlen_t n = 1;
  for (int i = 0; i < COLUMNS_IN; i++) in[i] = ffi_column(VECTOR_ELT(columns, i), what[i], &n);
  const rot_axle_sweep_rows rows = {(size_t)n, start,      in[INERTIA], in[VISCOUS],
                                    in[SCALE], in[OMEGA0], in[THETA0],  in[TIME]};

  double *c[COLUMNS_OUT];
  SEXP list = ffi_columns(COLUMNS_OUT, names_out, n, c);
  SEXP status = PROTECT(Rf_allocVector(INTSXP, n));
  const rot_axle_sweep_columns out = {c[0], c[1], c[2], c[3], c[4], c[5], c[6], INTEGER(status)};
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard,
                rot_axle_sweep_linear(&torque, &rows, (int)most, &out, &guard.hooks, &info));
  SEXP result = PROTECT(Rf_allocVector(VECSXP, 3));
  SET_VECTOR_ELT(result, 0, list);
  SET_VECTOR_ELT(result, 1, status);
  SET_VECTOR_ELT(result, 2, ffi_info(&info));
  UNPROTECT(3);
  return result;
}

/* The same by a model of a scene that may hold more than knots; three columns more: quadratic drag,
 * sliding and static friction. `true_maximum`: 1 where the model knows its largest speed. */
SEXP ffi_sweep_scenes(SEXP model, SEXP pack, SEXP columns, SEXP true_maximum, SEXP threads,
                      SEXP progress) {
  enum { QUADRATIC = COLUMNS_IN, COULOMB, STATIC, ALL };
  static const char *const what[] = {"inertia", "viscous", "scale",   "omega0", "theta0",
                                     "time",    "drag",    "coulomb", "static"};
  const rot_axle_model run = ffi_axle_model_named(model);
  const rot_axle_scene scene = ffi_axle_scene(pack);
  if (TYPEOF(columns) != VECSXP || XLENGTH(columns) != ALL) Rf_error("internal: `columns`");
  const double most = ffi_real(threads, "threads");
  if (!(most >= 0.0 && most <= 4096.0)) Rf_error("internal: `threads`");
  rot_column in[ALL];
  R_xlen_t n = 1;
  for (int i = 0; i < ALL; i++) in[i] = ffi_column(VECTOR_ELT(columns, i), what[i], &n);
  const rot_axle_sweep_rows rows = {(size_t)n, scene.linear.start_s, in[INERTIA], in[VISCOUS],
                                    in[SCALE], in[OMEGA0],           in[THETA0],  in[TIME]};
  const rot_axle_sweep_friction friction = {in[QUADRATIC], in[COULOMB], in[STATIC]};

  double *c[COLUMNS_OUT];
  SEXP list = ffi_columns(COLUMNS_OUT, names_out, n, c);
  SEXP status = PROTECT(Rf_allocVector(INTSXP, n));
  const rot_axle_sweep_columns out = {c[0], c[1], c[2], c[3], c[4], c[5], c[6], INTEGER(status)};
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_axle_sweep_scenes(run, &scene, &rows, &friction,
                                              ffi_real(true_maximum, "true_maximum") != 0.0,
                                              (int)most, &out, &guard.hooks, &info));
  SEXP result = PROTECT(Rf_allocVector(VECSXP, 3));
  SET_VECTOR_ELT(result, 0, list);
  SET_VECTOR_ELT(result, 1, status);
  SET_VECTOR_ELT(result, 2, ffi_info(&info));
  UNPROTECT(3);
  return result;
}

SEXP ffi_sweep_threads(void) { return Rf_ScalarInteger(rot_axle_sweep_threads()); }
