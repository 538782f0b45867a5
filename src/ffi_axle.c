#include "ffi_axle.h"
#include "ffi_run.h"

#include <string.h>

#include "ffi_torque.h"
#include "rot_axle_linear.h"
#include "rot_axle_bands.h"
#include "rot_axle_drag.h"
#include "rot_axle_forced.h"
#include "rot_axle_ledger.h"
#include "rot_axle_motor.h"
#include "rot_axle_ode.h"
#include "rot_axle_oscillator.h"
#include "rot_axle_pendulum.h"
#include "rot_axle_scene.h"
#include "rot_axle_skater.h"

/* c(inertia, viscous, start, theta0, omega0, motor) and list(knot times, knot torques, c(before, after)),
 * as R/model-axle.R packs them. */
static rot_torque unpack_knots(SEXP knots) {
  rot_torque torque = {0, NULL, NULL, 0.0, 0.0, NULL, NULL};
  if (Rf_isNull(knots)) return torque;
  if (TYPEOF(knots) != VECSXP || XLENGTH(knots) != 3) Rf_error("internal: `knots`");
  SEXP times = VECTOR_ELT(knots, 0);
  const double *outside = ffi_reals(VECTOR_ELT(knots, 2), "outside", 2);
  torque.time_s = ffi_reals(times, "times", -1);
  torque.torque_n_m = ffi_reals(VECTOR_ELT(knots, 1), "torque", XLENGTH(times));
  torque.n = (size_t)XLENGTH(times);
  torque.before_n_m = outside[0];
  torque.after_n_m = outside[1];
  return torque;
}

static rot_axle_scene unpack(SEXP numbers, SEXP torque) {
  const double *x = ffi_reals(numbers, "numbers", 6);
  const rot_axle_scene scene = {
      .linear = {x[0], x[1] + x[5], x[2], x[3], x[4], unpack_knots(torque)},
      .viscous_n_m_s = x[1],
      .motor_n_m_s = x[5]};
  return scene;
}

static rot_axle_columns new_columns(const ffi_run *run, SEXP time_s) {
  static const char *const names[] = {"time_s", ROT_AXLE_COLUMNS(FFI_COLUMN_NAME) ""};
  const R_xlen_t rows = XLENGTH(time_s);
  rot_axle_columns out;
  R_xlen_t at = 1;
  SEXP list = Rf_mkNamed(VECSXP, (const char **)names);
  SET_VECTOR_ELT(run->out, FFI_COLUMNS, list);
  SET_VECTOR_ELT(list, 0, time_s);
  ROT_AXLE_COLUMNS(FFI_COLUMN_NEW)
  return out;
}

static const char *const ledger_names[] = {ROT_AXLE_LEDGER(FFI_NAME)};

SEXP ffi_axle_free(SEXP numbers, SEXP time_s, SEXP progress) {
  const rot_axle_scene scene = unpack(numbers, R_NilValue);
  const double *t = ffi_reals(time_s, "time_s", -1);
  ffi_run run;
  ffi_run_begin(&run, progress);
  const rot_axle_columns out = new_columns(&run, time_s);
  return ffi_run_end(
      &run,
      rot_axle_free(&scene.linear, (size_t)XLENGTH(time_s), t, &out, &run.guard.hooks, &run.info),
      0);
}

/* `fast` = 0: row by row, a motor's slope counted as resistance; for tests. */
SEXP ffi_axle_linear(SEXP numbers, SEXP torque, SEXP time_s, SEXP fast, SEXP progress) {
  const rot_axle_scene scene = unpack(numbers, torque);
  const double *t = ffi_reals(time_s, "time_s", -1);
  const size_t n = (size_t)XLENGTH(time_s);
  const int by_table = ffi_real(fast, "fast") != 0.0;
  ffi_run run;
  ffi_run_begin(&run, progress);
  const rot_axle_columns out = new_columns(&run, time_s);
  const rot_hooks *hooks = &run.guard.hooks;
  return ffi_run_end(&run,
                     by_table ? rot_axle_linear_scene(&scene, n, t, &out, NULL, hooks, &run.info)
                              : rot_axle_linear(&scene.linear, n, t, &out, hooks, &run.info),
                     0);
}

SEXP ffi_axle_ledger(SEXP numbers, SEXP torque, SEXP from_s, SEXP to_s, SEXP progress) {
  const rot_axle_scene scene = unpack(numbers, torque);
  const double from = ffi_real(from_s, "from_s"), to = ffi_real(to_s, "to_s");
  rot_axle_ledger ledger;
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard,
                rot_axle_linear_ledger(&scene.linear, from, to, &guard.hooks, &ledger, &info));
  rot_axle_motor_ledger(&scene, &ledger);
  const double values[] = {ROT_AXLE_LEDGER(FFI_VALUE)};
  /* A sum of half the way is no ledger. */
  return ffi_named(FFI_LENGTH(values), ledger_names, info.status == ROT_OK ? values : NULL);
}

/* ---- scenes with more than knots and viscous resistance -------------------------------------- */

static size_t term_count(SEXP terms) {
  if (TYPEOF(terms) != VECSXP) Rf_error("internal: `terms`");
  return (size_t)XLENGTH(terms);
}

/* list(kind, from, to, x) each; the array lives as long as the call from R. */
static const rot_term *unpack_terms(SEXP terms) {
  const size_t n = term_count(terms);
  rot_term *out = (rot_term *)R_alloc(n ? n : 1, sizeof *out);
  for (size_t i = 0; i < n; i++) {
    SEXP term = VECTOR_ELT(terms, (R_xlen_t)i);
    if (TYPEOF(term) != VECSXP || XLENGTH(term) != 4) Rf_error("internal: `term`");
    const double kind = ffi_real(VECTOR_ELT(term, 0), "kind");
    SEXP x = VECTOR_ELT(term, 3);
    if (!(kind >= 0.0 && kind < ROT_TERM_KINDS)) Rf_error("internal: `kind`");
    out[i].kind = (rot_term_kind)(int)kind;
    out[i].from_s = ffi_real(VECTOR_ELT(term, 1), "from");
    out[i].to_s = ffi_real(VECTOR_ELT(term, 2), "to");
    out[i].x = ffi_reals(x, "x", -1);
    out[i].length = (size_t)XLENGTH(x);
    if (!rot_term_valid(&out[i])) Rf_error("internal: a term does not hold together");
  }
  return out;
}

/* list(numbers, knots, terms, list(times, moments) of the inertia, breaks), as R/model-axle.R packs
 * it; numbers = c(inertia, viscous, start, theta0, omega0, motor, quadratic, coulomb, static,
 * noise). */
rot_axle_scene ffi_axle_scene(SEXP pack) {
  if (TYPEOF(pack) != VECSXP || XLENGTH(pack) != 5) Rf_error("internal: `scene`");
  const double *x = ffi_reals(VECTOR_ELT(pack, 0), "numbers", 10);
  SEXP terms = VECTOR_ELT(pack, 2), inertia = VECTOR_ELT(pack, 3), breaks = VECTOR_ELT(pack, 4);
  if (TYPEOF(inertia) != VECSXP || XLENGTH(inertia) != 2) Rf_error("internal: `inertia`");
  const R_xlen_t knots = XLENGTH(VECTOR_ELT(inertia, 0));
  rot_axle_scene scene = {{x[0], x[1] + x[5], x[2], x[3], x[4], unpack_knots(VECTOR_ELT(pack, 1))},
                          x[1],
                          x[5],
                          x[6],
                          x[7],
                          x[8],
                          term_count(terms),
                          unpack_terms(terms),
                          (size_t)knots,
                          ffi_reals(VECTOR_ELT(inertia, 0), "inertia", knots),
                          ffi_reals(VECTOR_ELT(inertia, 1), "inertia", knots),
                          (size_t)XLENGTH(breaks),
                          ffi_reals(breaks, "breaks", -1),
                          x[9]};
  return scene;
}

/* Every exact model of such a scene by its name in R/model-axle.R. Listed once, here. */
static const struct {
  const char *name;
  rot_axle_model run;
} models[] = {
    {"bands", rot_axle_bands},       {"drag", rot_axle_drag},
    {"forced", rot_axle_forced},     {"oscillator", rot_axle_oscillator},
    {"pendulum", rot_axle_pendulum}, {"skater", rot_axle_skater},
};

rot_axle_model ffi_axle_model_named(SEXP name) {
  if (TYPEOF(name) != STRSXP || XLENGTH(name) != 1) Rf_error("internal: `model`");
  for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
    if (models[i].run && !strcmp(models[i].name, CHAR(STRING_ELT(name, 0)))) return models[i].run;
  }
  Rf_error("internal: no such model");
}

SEXP ffi_axle_model(SEXP name, SEXP pack, SEXP time_s, SEXP progress) {
  const rot_axle_model model = ffi_axle_model_named(name);
  const rot_axle_scene scene = ffi_axle_scene(pack);
  const double *t = ffi_reals(time_s, "time_s", -1);
  ffi_run run;
  ffi_run_begin(&run, progress);
  const rot_axle_columns out = new_columns(&run, time_s);
  return ffi_run_end(
      &run,
      model(&scene, (size_t)XLENGTH(time_s), t, &out, &run.events, &run.guard.hooks, &run.info), 1);
}

/* c(time of the last stop, angle there, terminal omega) */
SEXP ffi_axle_stopping(SEXP pack) {
  const rot_axle_scene scene = ffi_axle_scene(pack);
  double time_s, theta;
  const rot_status status = rot_axle_drag_stop(&scene, &time_s, &theta);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, 3));
  REAL(out)[0] = status == ROT_OK ? time_s : NA_REAL;
  REAL(out)[1] = status == ROT_OK ? theta : NA_REAL;
  REAL(out)[2] = rot_axle_drag_terminal(&scene);
  UNPROTECT(1);
  return out;
}

/* ---- integrated ------------------------------------------------------------------------------ */

/* `law` is NULL, or that of an ffi_torque to be added to the scene's torque. `control` is
 * c(accuracy, max_steps, method), method as in ROT_METHOD_LIST. */
SEXP ffi_axle_integrate(SEXP pack, SEXP law, SEXP time_s, SEXP control, SEXP progress) {
  rot_axle_scene scene = ffi_axle_scene(pack);
  const double *t = ffi_reals(time_s, "time_s", -1), *c = ffi_reals(control, "control", 3);
  if (!(c[2] >= 0.0 && c[2] < ROT_METHOD_COUNT)) Rf_error("internal: `method`");
  const rot_axle_ode_options options = {c[0], (size_t)c[1], (rot_method)(int)c[2]};
  rot_axle_ledger ledger;
#define X(name) ledger.name = NA_REAL;
  ROT_AXLE_LEDGER(X)
#undef X
  ffi_run run;
  ffi_torque called;
  if (!Rf_isNull(law)) {
    called = ffi_torque_new(law, &run.guard);
    scene.linear.torque.call = ffi_torque_call;
    scene.linear.torque.ctx = &called;
  }
  ffi_run_begin(&run, progress);
  const rot_axle_columns out = new_columns(&run, time_s);
  SEXP sums = ffi_named(FFI_LENGTH(ledger_names), ledger_names, NULL);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, sums);
  const rot_status status = rot_axle_integrate(&scene, &options, (size_t)XLENGTH(time_s), t, &out,
                                               &run.events, &ledger, &run.guard.hooks, &run.info);
  const double values[] = {ROT_AXLE_LEDGER(FFI_VALUE)};
  memcpy(REAL(sums), values, sizeof values);
  SEXP result = ffi_run_end(&run, status, 1);
  if (!Rf_isNull(law)) UNPROTECT(1);
  return result;
}
