/* For R: bodies on an incline. */
#include "glue/run.h"
#include "glue/scenes.h"
#include "glue/torque.h"

/* Stands for the force of a scene that is only looked at. */
static rot_status no_call(double t, double x, double v, double *force, void *ctx) {
  (void)t, (void)x, (void)v, (void)force, (void)ctx;
  return ROT_ERHS;
}

rot_incline_scene ffi_incline_scene(SEXP list) {
  const rot_incline_params slope = {
      .mass_kg = ffi_number_of(list, "mass_kg"),
      .radius_m = ffi_number_of(list, "radius_m"),
      .inertia_kg_m2 = ffi_number_of(list, "moment_of_inertia_kg_m2"),
      .angle_deg = ffi_number_of(list, "incline_angle_deg"),
      .gravity_m_per_s2 = ffi_number_of(list, "gravity_m_per_s2"),
      .mu_kinetic = ffi_number_of(list, "kinetic_friction"),
      .mu_static = ffi_number_of(list, "static_friction"),
      .arm_m = ffi_number_of(list, "rolling_arm_m"),
      .x0_m = ffi_number_of(list, "x0_m"),
      .v0_m_per_s = ffi_number_of(list, "v0_m_per_s"),
      .theta0_rad = ffi_number_of(list, "theta0_rad"),
      .omega0_rad_per_s = ffi_number_of(list, "omega0_rad_per_s"),
      .start_s = ffi_number_of(list, "start_s"),
  };
  return (rot_incline_scene){
      .slope = slope,
      .drag_n_s_per_m = ffi_number_of(list, "drag_n_s_per_m"),
      .drag_n_s2_per_m2 = ffi_number_of(list, "drag_n_s2_per_m2"),
      .force = Rf_isNull(ffi_element(list, "force")) ? NULL : no_call,
  };
}

#define SUM_NAME(name) #name,

/* Rows at events, and the list that they become: columns, of an integrated run also sums. */
typedef struct event_rows {
  rot_incline_event_rows rows;
  SEXP to;
  int sums;
} event_rows;

static SEXP take_event_rows(void *data) {
  static const char *const names[] = {"time_s", ROT_INCLINE_COLUMNS(FFI_COLUMN_NAME) ""};
  static const char *const all[] = {"time_s", ROT_INCLINE_COLUMNS(FFI_COLUMN_NAME)
                                                  ROT_INCLINE_SUMS(SUM_NAME) ""};
  const event_rows *from = data;
  const R_xlen_t n = (R_xlen_t)from->rows.count;
  SEXP list = Rf_mkNamed(VECSXP, (const char **)(from->sums ? all : names));
  SET_VECTOR_ELT(from->to, FFI_EVENT_ROWS, list);
  R_xlen_t at = 0;
  double *time_s = ffi_new_double(list, at++, n);
  for (R_xlen_t i = 0; i < n; i++) time_s[i] = from->rows.row[i].time_s;
#define X(type, name)                                                                              \
  {                                                                                                \
    type *column = ffi_new_##type(list, at++, n);                                                  \
    for (R_xlen_t i = 0; i < n; i++) column[i] = from->rows.row[i].name;                           \
  }
  ROT_INCLINE_COLUMNS(X)
#undef X
#define X(name)                                                                                    \
  if (from->sums) {                                                                                \
    double *column = ffi_new_double(list, at++, n);                                                \
    for (R_xlen_t i = 0; i < n; i++) column[i] = from->rows.row[i].name;                           \
  }
  ROT_INCLINE_SUMS(X)
#undef X
  return R_NilValue;
}

/* ffi_run_end() with the rows at events, which it frees. */
static SEXP end_with_rows(ffi_run *run, rot_status status, event_rows *rows) {
  rows->to = run->out;
  if (status == ROT_OK && rows->rows.count) {
    status = ffi_guarded(&run->guard, take_event_rows, rows, NULL);
  }
  rot_incline_event_rows_free(&rows->rows);
  return ffi_run_end(run, status);
}

SEXP ffi_incline_run(SEXP list, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"time_s", ROT_INCLINE_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_incline_params p = ffi_incline_scene(list).slope;
  const double *t = ffi_reals(time_s, "time_s", -1);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_incline_columns out;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_INCLINE_COLUMNS(FFI_COLUMN_NEW)
  event_rows at_events = {.rows = {0, 0, NULL}};
  const rot_status status = rot_incline_run(&p, (size_t)rows, t, &out, &run.events, &at_events.rows,
                                            &run.guard.hooks, &run.info);
  return end_with_rows(&run, status, &at_events);
}

#define SUM_NEW(name) sums.name = ffi_new_double(ledger, at++, rows);

/* `called` is NULL or list(law, stops): the force, as glue/torque.h reads a law, and its breaks.
 * `control` is c(accuracy, max_steps, method, resolution). The ledger has a value for each row; its
 * `errors` are those of heat, work and impulse. */
SEXP ffi_incline_integrate(SEXP list, SEXP called, SEXP time_s, SEXP control, SEXP progress) {
  static const char *const names[] = {"time_s", ROT_INCLINE_COLUMNS(FFI_COLUMN_NAME) ""};
  static const char *const sum_names[] = {ROT_INCLINE_SUMS(SUM_NAME) "errors", ""};
  const double *t = ffi_reals(time_s, "time_s", -1), *c = ffi_reals(control, "control", 4);
  if (!(c[2] >= 0.0 && c[2] <= ROT_METHOD_RADAU)) Rf_error("internal: `method`");
  const double steps = c[1] < 1e15 ? c[1] : 1e15; /* the conversion of 1e20 is undefined */
  const rot_incline_ode_options options = {c[0], (size_t)steps, (rot_method)(int)c[2], c[3]};
  rot_incline_scene scene = ffi_incline_scene(list);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_incline_columns out;
  rot_incline_sums sums;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_torque law;
  const int calls = !Rf_isNull(called);
  if (calls) {
    SEXP stops = ffi_element(called, "stops");
    law = ffi_torque_new(ffi_element(called, "law"), &run.guard);
    scene.force = ffi_torque_call;
    scene.ctx = &law;
    scene.breaks_s = ffi_reals(stops, "stops", -1);
    scene.n_breaks = (size_t)XLENGTH(stops);
  }
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_INCLINE_COLUMNS(FFI_COLUMN_NEW)
  SEXP ledger = Rf_mkNamed(VECSXP, (const char **)sum_names);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, ledger);
  at = 0;
  ROT_INCLINE_SUMS(SUM_NEW)
  double *errors = ffi_new_double(ledger, at, 3);
  event_rows at_events = {.rows = {0, 0, NULL}, .sums = 1};
  const rot_status status =
      rot_incline_integrate(&scene, &options, (size_t)rows, t, &out, &sums, &run.events,
                            &at_events.rows, &run.guard.hooks, &run.info);
  errors[0] = sums.heat_error_j;
  errors[1] = sums.work_error_j;
  errors[2] = sums.impulse_error_n_s;
  SEXP result = end_with_rows(&run, status, &at_events);
  UNPROTECT(calls);
  return result;
}

/* From span[0] to span[1]; NA where it failed. */
SEXP ffi_incline_ledger(SEXP list, SEXP span) {
  static const char *const names[] = {ROT_INCLINE_LEDGER(FFI_NAME)};
  const rot_incline_params p = ffi_incline_scene(list).slope;
  const double *x = ffi_reals(span, "span", 2);
  rot_incline_ledger ledger;
  const rot_status status = rot_incline_flows(&p, x[0], x[1], &ledger);
  const double values[] = {ROT_INCLINE_LEDGER(FFI_VALUE)};
  return ffi_named(FFI_LENGTH(values), names, status == ROT_OK ? values : NULL);
}

SEXP ffi_incline_critical(SEXP beta, SEXP mu) {
  R_xlen_t n = 1;
  const rot_column b = ffi_column(beta, "beta", &n), m = ffi_column(mu, "mu", &n);
  SEXP out = PROTECT(ffi_new_column(n));
  for (size_t i = 0; i < (size_t)n; i++) {
    const double x = rot_at(b, i), y = rot_at(m, i);
    REAL(out)[i] = ISNAN(x) || ISNAN(y) ? NA_REAL : rot_incline_critical_deg(x, y);
  }
  UNPROTECT(1);
  return out;
}
