#include "ffi_run.h"
#include "ffi_scenes.h"
#include "rot_free_exact.h"
#include "rot_free_ode.h"
#include "rot_free_steps.h"

#include <string.h>

/* ---- scenes ---------------------------------------------------------------------------------- */

/* Stands for the law of a scene, which is not called here. */
static rot_status no_call(double t, const double omega[3], const double q[4], double torque[3],
                          void *ctx) {
  (void)t, (void)omega, (void)q, (void)torque, (void)ctx;
  return ROT_ETORQUE;
}

rot_free_params ffi_free_scene(SEXP list) {
  rot_free_params p;
  memset(&p, 0, sizeof p);
  SEXP knots = ffi_element(list, "knots"), breaks = ffi_element(list, "breaks_s");
  SEXP lever = ffi_element(list, "lever_n_m"); /* a body with a fixed point has one */
  memcpy(p.moment_kg_m2, ffi_numbers_of(list, "moment_of_inertia_kg_m2", 3), 3 * sizeof(double));
  memcpy(p.axes, ffi_numbers_of(list, "axes", 4), 4 * sizeof(double));
  memcpy(p.omega0_rad_per_s, ffi_numbers_of(list, "omega0_rad_per_s", 3), 3 * sizeof(double));
  memcpy(p.q0, ffi_numbers_of(list, "attitude0", 4), 4 * sizeof(double));
  memcpy(p.torque, ffi_numbers_of(list, "torque_n_m", 3), 3 * sizeof(double));
  if (!Rf_isNull(lever)) memcpy(p.lever_n_m, ffi_reals(lever, "lever_n_m", 3), 3 * sizeof(double));
  p.turned = p.axes[0] != 1.0;
  p.given = ffi_number_of(list, "moment_error");
  p.start_s = ffi_number_of(list, "start_s");
  p.damping_per_s = ffi_number_of(list, "damping_per_s");
  p.in_space = ffi_number_of(list, "in_space") != 0.0;
  if (!Rf_isNull(knots)) {
    static const char *const names[] = {"x_n_m", "y_n_m", "z_n_m"};
    SEXP time_s = ffi_element(knots, "time_s");
    p.knot_s = ffi_reals(time_s, "time_s", -1);
    for (int k = 0; k < 3; k++) p.knot_torque[k] = ffi_numbers_of(knots, names[k], XLENGTH(time_s));
    p.n_knots = (size_t)XLENGTH(time_s);
  }
  p.breaks_s = ffi_reals(breaks, "breaks_s", -1);
  p.n_breaks = (size_t)XLENGTH(breaks);
  if (!Rf_isNull(ffi_element(list, "law"))) p.law = no_call;
  return p;
}

/* ---- closed form ----------------------------------------------------------------------------- */

SEXP ffi_free_rows(SEXP list, SEXP time_s, SEXP progress, ffi_free_form *form) {
  static const char *const names[] = {"time_s", ROT_FREE_COLUMNS(FFI_COLUMN_NAME) ""};
  const rot_free_params p = ffi_free_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_free_columns out;
  R_xlen_t at = 1;
  ffi_run run;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_FREE_COLUMNS(FFI_COLUMN_NEW)
  const rot_status status =
      form(&p, (size_t)rows, t, &out, &run.events, &run.guard.hooks, &run.info);
  return ffi_run_end(&run, status);
}

SEXP ffi_free_exact(SEXP list, SEXP time_s, SEXP progress) {
  return ffi_free_rows(list, time_s, progress, rot_free_exact);
}

/* The ledger from span[0] to span[1]. */
SEXP ffi_free_flows(SEXP list, SEXP span) {
  static const char *const names[] = {ROT_FREE_LEDGER(FFI_NAME)};
  const rot_free_params p = ffi_free_scene(list);
  const double *x = ffi_reals(span, "span", 2);
  double flow[ROT_FREE_FLOWS];
  rot_free_flows(&p, x[0], x[1], flow);
  return ffi_named(ROT_FREE_FLOWS, names, flow);
}

/* By row: six columns, principal moments and rates. NA where there is no motion of such numbers. */
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

/* ---- integrated ------------------------------------------------------------------------------ */

typedef struct called {
  ffi_guard *guard;
  SEXP call; /* f(x) with x = c(time_s, omega, attitude); returns three numbers */
  double x[8], torque[3];
} called;

static SEXP call_law(void *data) {
  called *law = data;
  SEXP x = PROTECT(Rf_allocVector(REALSXP, 8));
  memcpy(REAL(x), law->x, sizeof law->x);
  SEXP call = PROTECT(Rf_lang2(law->call, x)), value = PROTECT(Rf_eval(call, R_GlobalEnv));
  memcpy(law->torque, ffi_reals(value, "torque", 3), sizeof law->torque);
  UNPROTECT(3);
  return R_NilValue;
}

static rot_status by_law(double t, const double omega[3], const double q[4], double torque[3],
                         void *ctx) {
  called *law = ctx;
  law->x[0] = t;
  memcpy(law->x + 1, omega, 3 * sizeof(double));
  memcpy(law->x + 4, q, 4 * sizeof(double));
  const rot_status status = ffi_guarded(law->guard, call_law, law, NULL);
  memcpy(torque, law->torque, sizeof law->torque);
  return status;
}

/* The rows of a run by steps, from what it asks for. */
typedef rot_status run_steps(const rot_free_params *p, const double control[3], size_t n,
                             const double time_s[], const rot_free_columns *out,
                             double *const flow[], double flow_error[], ffi_run *run);

static SEXP rows_by_steps(SEXP list, SEXP law, SEXP time_s, SEXP control, SEXP progress,
                          run_steps *steps) {
  static const char *const names[] = {"time_s", ROT_FREE_COLUMNS(FFI_COLUMN_NAME) ""};
  static const char *const flows[] = {ROT_FREE_LEDGER(FFI_NAME) "errors", ""};
  rot_free_params p = ffi_free_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1), *c = ffi_reals(control, "control", 3);
  const R_xlen_t rows = XLENGTH(time_s);
  rot_free_columns out;
  double *flow[ROT_FREE_FLOWS];
  R_xlen_t at = 1;
  ffi_run run;
  called fn = {&run.guard, law, {0.0}, {0.0}};
  p.law = Rf_isNull(law) ? NULL : by_law;
  p.ctx = &fn;
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_FREE_COLUMNS(FFI_COLUMN_NEW)
  SEXP ledger = Rf_mkNamed(VECSXP, (const char **)flows);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, ledger);
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = ffi_new_double(ledger, k, rows);
  double *errors = ffi_new_double(ledger, ROT_FREE_FLOWS, ROT_FREE_FLOWS);
  return ffi_run_end(&run, steps(&p, c, (size_t)rows, t, &out, flow, errors, &run));
}

static size_t budget_of(double max_steps) { return (size_t)(max_steps < 1e15 ? max_steps : 1e15); }

static rot_status adaptive(const rot_free_params *p, const double control[3], size_t n,
                           const double time_s[], const rot_free_columns *out, double *const flow[],
                           double flow_error[], ffi_run *run) {
  const rot_free_ode_options options = {control[0], budget_of(control[1]),
                                        (rot_method)(int)control[2]};
  return rot_free_integrate(p, &options, n, time_s, out, flow, flow_error, &run->events,
                            &run->guard.hooks, &run->info);
}

static rot_status fixed(const rot_free_params *p, const double control[3], size_t n,
                        const double time_s[], const rot_free_columns *out, double *const flow[],
                        double flow_error[], ffi_run *run) {
  const rot_free_step_options options = {(rot_method)(int)control[2], control[0],
                                         budget_of(control[1])};
  return rot_free_step_through(p, &options, n, time_s, out, flow, flow_error, &run->guard.hooks,
                               &run->info);
}

/* `control` is c(accuracy, max_steps, method). The ledger has a value for each row, and `errors`,
 * one for each of its columns. */
SEXP ffi_free_integrate(SEXP list, SEXP law, SEXP time_s, SEXP control, SEXP progress) {
  const double method = ffi_reals(control, "control", 3)[2];
  if (!(method >= 0.0 && method <= ROT_METHOD_RADAU)) Rf_error("internal: `method`");
  return rows_by_steps(list, law, time_s, control, progress, adaptive);
}

/* By steps of fixed length: `control` is c(step_s, max_steps, method). */
SEXP ffi_free_step_through(SEXP list, SEXP law, SEXP time_s, SEXP control, SEXP progress) {
  const double method = ffi_reals(control, "control", 3)[2];
  if (!(method > ROT_METHOD_RADAU && method < ROT_METHOD_COUNT)) Rf_error("internal: `method`");
  return rows_by_steps(list, law, time_s, control, progress, fixed);
}

/* The length of steps where none is asked. */
SEXP ffi_free_step(SEXP list, SEXP method, SEXP span_s) {
  const rot_free_params p = ffi_free_scene(list);
  const int of = (int)ffi_real(method, "method");
  return Rf_ScalarReal(rot_free_default_step(&p, (rot_method)of, ffi_real(span_s, "span_s")));
}
