#define R_NO_REMAP
#define ROTDYN_USE_R
#include <Rinternals.h>
#include <rotdyn.h>

static const rotdyn_api *table(void) {
  static const rotdyn_api *api = NULL;
  if (!api) api = rotdyn_api_from_r();
  if (!api) {
    Rf_error("this package was built for version %d of rotdyn's C interface, and the installed "
             "rotdyn has another: install this package again",
             ROTDYN_API_MAJOR);
  }
  return api;
}

/* The table, if it has the function. */
#define WITH(function)                                                                             \
  (ROTDYN_HAS(table(), function)                                                                   \
       ? table()                                                                                   \
       : (Rf_error("rotdyn %s lacks " #function "(): install a newer rotdyn", table()->version()), \
          (const rotdyn_api *)NULL))

SEXP client_interface(void) {
  SEXP out = PROTECT(Rf_allocVector(INTSXP, 2));
  INTEGER(out)[0] = table()->major;
  INTEGER(out)[1] = table()->minor;
  UNPROTECT(1);
  return out;
}

SEXP client_rolling(SEXP beta, SEXP angle_deg) {
  const rotdyn_api *api = WITH(rolling_acceleration);
  const R_xlen_t n = XLENGTH(beta);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    REAL(out)[i] = api->rolling_acceleration(REAL(beta)[i], Rf_asReal(angle_deg), 9.80665);
  }
  UNPROTECT(1);
  return out;
}

SEXP client_coasting(SEXP inertia, SEXP viscous, SEXP omega0, SEXP time_s) {
  static const char *const name = "omega_rad_per_s";
  const rotdyn_api *api = WITH(scene_run);
  const size_t n = (size_t)XLENGTH(time_s);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  SEXP omega = PROTECT(Rf_allocVector(REALSXP, XLENGTH(time_s)));
  double *const column = REAL(omega);
  /* Nothing that may raise an R error until the objects are freed. */
  const double body = Rf_asReal(inertia), c = Rf_asReal(viscous), start = Rf_asReal(omega0);
  rotdyn_object *scene = api->object_new("scene_axle");
  rotdyn_object *resistance = api->object_new("resistance");
  int status = ROTDYN_EMEMORY;
  if (scene && resistance) {
    api->set_number(resistance, "viscous_n_m_s", c);
    api->set_number(scene, "body", body);
    api->set_number(scene, "omega0_rad_per_s", start);
    api->set_object(scene, "resistance", resistance);
    status = api->scene_run(scene, n, REAL(time_s), NULL, n, 1, &name, &column, &report);
  }
  api->object_free(resistance);
  api->object_free(scene);
  if (status != ROTDYN_OK) {
    Rf_error("%s: %s %s", api->status_text(status), report.input ? report.input : "",
             report.reason);
  }
  UNPROTECT(1);
  return omega;
}

static const R_CallMethodDef entries[] = {{"client_interface", (DL_FUNC)&client_interface, 0},
                                          {"client_rolling", (DL_FUNC)&client_rolling, 2},
                                          {"client_coasting", (DL_FUNC)&client_coasting, 4},
                                          {NULL, NULL, 0}};

void R_init_rotdynclient(DllInfo *dll) {
  R_registerRoutines(dll, NULL, entries, NULL, NULL);
  R_useDynamicSymbols(dll, FALSE);
}
