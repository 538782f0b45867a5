/* For R: free bodies. */
#include "glue/run.h"
#include "glue/scenes.h"
#include "scene/free/exact.h"
#include "scene/free/gyrostat.h"
#include "scene/free/ode.h"
#include "scene/free/steps.h"
#include "scene/pivot/pivot.h"

#include <stdio.h>
#include <string.h>

/* ---- scenes ---------------------------------------------------------------------------------- */

/* Stands for the law of a scene, which is not called here. */
static rot_status no_call(double t, const double omega[3], const double q[4], double torque[3],
                          void *ctx) {
  (void)t, (void)omega, (void)q, (void)torque, (void)ctx;
  return ROT_ETORQUE;
}

static rot_status no_motors(double t, const double omega[3], const double q[4], double torque[],
                            void *ctx) {
  (void)t, (void)omega, (void)q, (void)torque, (void)ctx;
  return ROT_ETORQUE;
}

static rot_free_rotor rotor_of(SEXP list) {
  rot_free_rotor out;
  SEXP knots = ffi_element(list, "knots");
  memset(&out, 0, sizeof out);
  memcpy(out.axis, ffi_numbers_of(list, "axis", 3), 3 * sizeof(double));
  out.moment_kg_m2 = ffi_number_of(list, "inertia_kg_m2");
  out.omega_rad_per_s = ffi_number_of(list, "omega_rad_per_s");
  out.driven = ffi_number_of(list, "driven") != 0.0;
  out.torque = ffi_number_of(list, "torque_n_m");
  if (!Rf_isNull(knots)) {
    SEXP time_s = ffi_element(knots, "time_s");
    out.knot_s = ffi_reals(time_s, "time_s", -1);
    out.knot_torque = ffi_numbers_of(knots, "torque_n_m", XLENGTH(time_s));
    out.n_knots = (size_t)XLENGTH(time_s);
  }
  return out;
}

static void read_rotors(SEXP list, rot_free_params *p) {
  const R_xlen_t n = XLENGTH(list);
  if (TYPEOF(list) != VECSXP || n > ROT_FREE_MOST_ROTORS) Rf_error("internal: `rotors`");
  rot_free_rotor *rotors = (rot_free_rotor *)R_alloc((size_t)n, sizeof *rotors);
  for (R_xlen_t k = 0; k < n; k++) {
    rotors[k] = rotor_of(VECTOR_ELT(list, k));
    if (!Rf_isNull(ffi_element(VECTOR_ELT(list, k), "law"))) p->motors = no_motors;
  }
  p->n_rotors = (size_t)n;
  p->rotors = rotors;
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
  if (!Rf_isNull(lever)) {
    rot_pivot_sharpen(&p, ffi_number_of(list, "mass_kg"), ffi_number_of(list, "gravity_m_per_s2"),
                      ffi_numbers_of(list, "centre_m", 3));
  }
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
  SEXP rotors = ffi_element(list, "rotors");
  if (!Rf_isNull(rotors)) read_rotors(rotors, &p);
  return p;
}

/* ---- columns --------------------------------------------------------------------------------- */

enum { OWN_COLUMNS = 15, NAME = 48 };

/* Of a run's rows, with two for each rotor. */
typedef struct table {
  rot_free_columns out;
  double *omega[ROT_FREE_MOST_ROTORS], *momentum[ROT_FREE_MOST_ROTORS];
} table;

static void new_table(const ffi_run *run, const rot_free_params *p, SEXP time_s, table *t) {
  static const char *const own[] = {"time_s", ROT_FREE_COLUMNS(FFI_COLUMN_NAME)};
  const char *names[OWN_COLUMNS + 2 * ROT_FREE_MOST_ROTORS + 1];
  char more[2 * ROT_FREE_MOST_ROTORS][NAME];
  const R_xlen_t rows = XLENGTH(time_s);
  size_t n = 0;
  R_xlen_t at = 1;
  for (; n < FFI_LENGTH(own); n++) names[n] = own[n];
  for (size_t k = 0; k < p->n_rotors; k++) {
    const int of = (int)k + 1;
    (void)snprintf(more[2 * k], NAME, "rotor_%d_omega_rad_per_s", of);
    (void)snprintf(more[2 * k + 1], NAME, "rotor_%d_angular_momentum_kg_m2_per_s", of);
    names[n++] = more[2 * k];
    names[n++] = more[2 * k + 1];
  }
  names[n] = "";
  SEXP columns = ffi_run_columns(run, names);
  rot_free_columns out;
  SET_VECTOR_ELT(columns, 0, time_s);
  ROT_FREE_COLUMNS(FFI_COLUMN_NEW)
  for (size_t k = 0; k < p->n_rotors; k++) {
    t->omega[k] = ffi_new_double(columns, at++, rows);
    t->momentum[k] = ffi_new_double(columns, at++, rows);
  }
  out.rotor_omega = t->omega;
  out.rotor_momentum = t->momentum;
  t->out = out;
}

/* ---- closed form ----------------------------------------------------------------------------- */

SEXP ffi_free_rows(SEXP list, SEXP time_s, SEXP progress, ffi_free_form *form) {
  const rot_free_params p = ffi_free_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1);
  table rows;
  ffi_run run;
  ffi_run_begin(&run, progress);
  new_table(&run, &p, time_s, &rows);
  const rot_status status =
      form(&p, (size_t)XLENGTH(time_s), t, &rows.out, &run.events, &run.guard.hooks, &run.info);
  return ffi_run_end(&run, status);
}

SEXP ffi_free_exact(SEXP list, SEXP time_s, SEXP progress) {
  return ffi_free_rows(list, time_s, progress, rot_free_exact);
}

SEXP ffi_free_gyrostat(SEXP list, SEXP time_s, SEXP progress) {
  return ffi_free_rows(list, time_s, progress, rot_free_gyrostat);
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
  SEXP call; /* f(x) with x = c(time_s, omega, attitude); returns n numbers */
  R_xlen_t n;
  double x[8], torque[ROT_FREE_MOST_ROTORS];
} called;

static SEXP call_law(void *data) {
  called *law = data;
  SEXP x = PROTECT(Rf_allocVector(REALSXP, 8));
  memcpy(REAL(x), law->x, sizeof law->x);
  SEXP call = PROTECT(Rf_lang2(law->call, x)), value = PROTECT(Rf_eval(call, R_GlobalEnv));
  memcpy(law->torque, ffi_reals(value, "torque", law->n), (size_t)law->n * sizeof *law->torque);
  UNPROTECT(3);
  return R_NilValue;
}

static rot_status by_law(double t, const double omega[3], const double q[4], double torque[],
                         void *ctx) {
  called *law = ctx;
  law->x[0] = t;
  memcpy(law->x + 1, omega, 3 * sizeof(double));
  memcpy(law->x + 4, q, 4 * sizeof(double));
  const rot_status status = ffi_guarded(law->guard, call_law, law, NULL);
  memcpy(torque, law->torque, (size_t)law->n * sizeof *law->torque);
  return status;
}

/* The rows of a run by steps, from what it asks for. */
typedef rot_status run_steps(const rot_free_params *p, const double control[4], size_t n,
                             const double time_s[], const rot_free_columns *out,
                             double *const flow[], double flow_error[], ffi_run *run);

/* `laws`: that of the torque, that of the motors; NULL for none. */
static SEXP rows_by_steps(SEXP list, SEXP laws, SEXP time_s, SEXP control, SEXP progress,
                          run_steps *steps) {
  static const char *const flows[] = {ROT_FREE_LEDGER(FFI_NAME) "errors", ""};
  rot_free_params p = ffi_free_scene(list);
  const double *t = ffi_reals(time_s, "time_s", -1), *c = ffi_reals(control, "control", 4);
  const R_xlen_t rows = XLENGTH(time_s);
  if (TYPEOF(laws) != VECSXP || XLENGTH(laws) != 2) Rf_error("internal: `laws`");
  table columns;
  double *flow[ROT_FREE_FLOWS];
  ffi_run run;
  called fn = {&run.guard, VECTOR_ELT(laws, 0), 3, {0.0}, {0.0}};
  called motors = {&run.guard, VECTOR_ELT(laws, 1), (R_xlen_t)p.n_rotors, {0.0}, {0.0}};
  p.law = Rf_isNull(fn.call) ? NULL : by_law;
  p.ctx = &fn;
  p.motors = Rf_isNull(motors.call) ? NULL : by_law;
  p.motors_ctx = &motors;
  ffi_run_begin(&run, progress);
  new_table(&run, &p, time_s, &columns);
  SEXP ledger = Rf_mkNamed(VECSXP, (const char **)flows);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, ledger);
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = ffi_new_double(ledger, k, rows);
  double *errors = ffi_new_double(ledger, ROT_FREE_FLOWS, ROT_FREE_FLOWS);
  return ffi_run_end(&run, steps(&p, c, (size_t)rows, t, &columns.out, flow, errors, &run));
}

static size_t budget_of(double max_steps) { return (size_t)(max_steps < 1e15 ? max_steps : 1e15); }

static rot_status adaptive(const rot_free_params *p, const double control[4], size_t n,
                           const double time_s[], const rot_free_columns *out, double *const flow[],
                           double flow_error[], ffi_run *run) {
  const rot_free_ode_options options = {control[0], budget_of(control[1]),
                                        (rot_method)(int)control[2], control[3]};
  return rot_free_integrate(p, &options, n, time_s, out, flow, flow_error, &run->events,
                            &run->guard.hooks, &run->info);
}

static rot_status fixed(const rot_free_params *p, const double control[4], size_t n,
                        const double time_s[], const rot_free_columns *out, double *const flow[],
                        double flow_error[], ffi_run *run) {
  const rot_free_step_options options = {(rot_method)(int)control[2], control[0],
                                         budget_of(control[1])};
  return rot_free_step_through(p, &options, n, time_s, out, flow, flow_error, &run->guard.hooks,
                               &run->info);
}

/* `control` is c(accuracy, max_steps, method, resolution). The ledger has a value for each row, and
 * `errors`, one for each of its columns. */
SEXP ffi_free_integrate(SEXP list, SEXP laws, SEXP time_s, SEXP control, SEXP progress) {
  const double method = ffi_reals(control, "control", 4)[2];
  if (!(method >= 0.0 && method <= ROT_METHOD_RADAU)) Rf_error("internal: `method`");
  return rows_by_steps(list, laws, time_s, control, progress, adaptive);
}

/* By steps of fixed length: `control` is c(step_s, max_steps, method, 0). */
SEXP ffi_free_step_through(SEXP list, SEXP laws, SEXP time_s, SEXP control, SEXP progress) {
  const double method = ffi_reals(control, "control", 4)[2];
  if (!(method > ROT_METHOD_RADAU && method < ROT_METHOD_COUNT)) Rf_error("internal: `method`");
  return rows_by_steps(list, laws, time_s, control, progress, fixed);
}

/* The length of steps where none is asked. */
SEXP ffi_free_step(SEXP list, SEXP method, SEXP span_s) {
  const rot_free_params p = ffi_free_scene(list);
  const int of = (int)ffi_real(method, "method");
  return Rf_ScalarReal(rot_free_default_step(&p, (rot_method)of, ffi_real(span_s, "span_s")));
}
