/* For R: drives. */
#include <stdlib.h>
#include <string.h>

#include "glue/run.h"
#include "glue/scenes.h"
#include "glue/torque.h"
#include "scene/drive/exact.h"
#include "scene/drive/ledger.h"

/* ---- scenes ---------------------------------------------------------------------------------- */

/* Calls of R functions and their breaks, NULL or list(law, stops) for each rotor, brake and
 * coupling: list(rotors, brakes, couplings), or NULL where nothing is called. */
typedef struct calls {
  SEXP list;
  ffi_guard *guard;
  int protects;
} calls;

static SEXP call_of(const calls *c, const char *kind, R_xlen_t i) {
  if (!c || Rf_isNull(c->list)) return R_NilValue;
  SEXP all = ffi_element(c->list, kind);
  if (TYPEOF(all) != VECSXP || i >= XLENGTH(all)) Rf_error("internal: `%s`", kind);
  return VECTOR_ELT(all, i);
}

/* Stands for the law of a scene that is only looked at. */
static rot_status no_call(double t, double theta, double omega, double *torque, void *ctx) {
  (void)t, (void)theta, (void)omega, (void)torque, (void)ctx;
  return ROT_ETORQUE;
}

static rot_axle_scene loads_of(SEXP list, calls *c, const char *kind, R_xlen_t i) {
  SEXP call = call_of(c, kind, i);
  if (Rf_isNull(call)) {
    rot_axle_scene scene = ffi_axle_scene(list, R_NilValue);
    if (!c && !Rf_isNull(ffi_element(ffi_element(list, "loads"), "law"))) {
      scene.linear.torque.call = no_call;
    }
    return scene;
  }
  rot_axle_scene scene = ffi_axle_scene(list, ffi_element(call, "stops"));
  ffi_torque *called = (ffi_torque *)R_alloc(1, sizeof *called);
  *called = ffi_torque_new(ffi_element(call, "law"), NULL, c->guard);
  c->protects++;
  scene.linear.torque.call = ffi_torque_call;
  scene.linear.torque.ctx = called;
  return scene;
}

static rot_drive_grip grip_of(SEXP list, calls *c, const char *kind, R_xlen_t i) {
  rot_drive_grip grip;
  memset(&grip, 0, sizeof grip);
  if (Rf_isNull(list)) return grip;
  grip.acts = 1;
  grip.law = loads_of(list, c, kind, i);
  grip.static_ratio = ffi_number_of(list, "static_ratio");
  grip.from_s = ffi_number_of(list, "from_s");
  grip.to_s = ffi_number_of(list, "to_s");
  return grip;
}

static rot_drive_scene read_scene(SEXP list, calls *c) {
  SEXP rotors = ffi_element(list, "rotors"), couplings = ffi_element(list, "couplings");
  if (TYPEOF(rotors) != VECSXP || TYPEOF(couplings) != VECSXP || XLENGTH(rotors) < 1 ||
      XLENGTH(couplings) != XLENGTH(rotors) - 1) {
    Rf_error("internal: `rotors`");
  }
  const R_xlen_t n = XLENGTH(rotors);
  rot_axle_scene *rotor = (rot_axle_scene *)R_alloc((size_t)n, sizeof *rotor);
  rot_drive_grip *brake = (rot_drive_grip *)R_alloc((size_t)n, sizeof *brake);
  rot_drive_coupling *coupling = (rot_drive_coupling *)R_alloc((size_t)n, sizeof *coupling);
  for (R_xlen_t i = 0; i < n; i++) {
    SEXP one = VECTOR_ELT(rotors, i);
    rotor[i] = loads_of(one, c, "rotors", i);
    brake[i] = grip_of(ffi_element(one, "brake"), c, "brakes", i);
    if (i + 1 == n) break;
    SEXP joint = VECTOR_ELT(couplings, i);
    const double kind = ffi_number_of(joint, "kind");
    coupling[i] = (rot_drive_coupling){
        kind > 1.5   ? ROT_DRIVE_GEAR
        : kind > 0.5 ? ROT_DRIVE_CLUTCH
                     : ROT_DRIVE_SHAFT,
        ffi_number_of(joint, "ratio"),
        ffi_number_of(joint, "stiffness_n_m_per_rad"),
        ffi_number_of(joint, "damping_n_m_s"),
        grip_of(ffi_element(joint, "grip"), c, "couplings", i),
        Rf_isNull(ffi_element(joint, "efficiency")) ? 1.0 : ffi_number_of(joint, "efficiency")};
  }
  return (rot_drive_scene){(size_t)n, rotor, brake, coupling, ffi_number_of(list, "start_s")};
}

rot_drive_scene ffi_drive_scene(SEXP list) { return read_scene(list, NULL); }

/* ---- places of events ------------------------------------------------------------------------ */

typedef struct kept {
  SEXP ledger;
  R_xlen_t at;
  const rot_events *events;
  const rot_drive_places *places;
} kept;

static SEXP keep_places(void *data) {
  const kept *k = data;
  const R_xlen_t n = (R_xlen_t)k->events->count;
  double *out = ffi_new_double(k->ledger, k->at, n);
  for (R_xlen_t i = 0; i < n; i++) out[i] = (double)k->places->place[i];
  return R_NilValue;
}

/* ---- the run --------------------------------------------------------------------------------- */

#define SUM_NEW(name)  sums.name = ffi_new_double(ledger, at++, XLENGTH(time_s));
#define SUM_NAME(name) #name,

/* The columns are as long as times x rotors, those of the ledger as the times; its `errors` are
 * those of the flows, its `places` those of the events (scene/drive/ode.h).
 * `options`: of the integrator; NULL: by a closed form, whose ledger takes a quadrature. */
static SEXP run_drive(SEXP list, SEXP called, SEXP time_s, const rot_drive_ode_options *options,
                      rot_drive_form form, int with_ledger, SEXP progress) {
  static const char *const names[] = {ROT_DRIVE_COLUMNS(FFI_COLUMN_NAME) ""};
  static const char *const sum_names[] = {ROT_DRIVE_LEDGER(SUM_NAME) "errors", "places", ""};
  const double *t = ffi_reals(time_s, "time_s", -1);
  const size_t n = (size_t)XLENGTH(time_s);
  ffi_run run;
  calls laws = {called, &run.guard, 0};
  const rot_drive_scene scene = read_scene(list, &laws);
  const R_xlen_t rows = XLENGTH(time_s) * (R_xlen_t)scene.n;
  rot_drive_columns out;
  rot_drive_ledger sums;
  R_xlen_t at = 0;
  memset(&sums, 0, sizeof sums);
  ffi_run_begin(&run, progress);
  SEXP columns = ffi_run_columns(&run, names);
  ROT_DRIVE_COLUMNS(FFI_COLUMN_NEW)
  SEXP ledger = Rf_mkNamed(VECSXP, (const char **)sum_names);
  SET_VECTOR_ELT(run.out, FFI_LEDGER, ledger);
  at = 0;
  ROT_DRIVE_LEDGER(SUM_NEW)
  double *errors = ffi_new_double(ledger, at++, ROT_DRIVE_FLOWS);
  rot_drive_places places = {0, NULL};
  rot_status status = options
                          ? rot_drive_integrate(&scene, options, n, t, &out, &sums, &run.events,
                                                &places, &run.guard.hooks, &run.info)
                          : rot_drive_exact(&scene, form, n, t, &out, with_ledger ? &sums : NULL,
                                            &run.events, &places, &run.guard.hooks, &run.info);
  rot_drive_flow_errors(&scene, &sums, errors);
  for (R_xlen_t i = 0; i < rows; i++) {
    const int last = (size_t)i % scene.n + 1 == scene.n;
    if (last) out.coupling_torque_n_m[i] = out.coupling_heat_j[i] = NA_REAL;
    if (last) out.locked[i] = NA_LOGICAL;
  }
  kept keep = {ledger, at, &run.events, &places};
  if (status != ROT_EUNWIND && ffi_guarded(&run.guard, keep_places, &keep, NULL) != ROT_OK) {
    status = ROT_EUNWIND;
  }
  free(places.place);
  SEXP result = ffi_run_end(&run, status);
  UNPROTECT(laws.protects);
  return result;
}

/* `control` is c(accuracy, max_steps, method, resolution). */
SEXP ffi_drive_integrate(SEXP list, SEXP called, SEXP time_s, SEXP control, SEXP progress) {
  const double *c = ffi_reals(control, "control", 4);
  if (!(c[2] >= 0.0 && c[2] < ROT_METHOD_COUNT)) Rf_error("internal: `method`");
  /* 1e15 steps are more than any run makes; the conversion of 1e20 is undefined. */
  const double steps = c[1] < 1e15 ? c[1] : 1e15;
  const rot_drive_ode_options options = {c[0], (size_t)steps, (rot_method)(int)c[2], c[3]};
  return run_drive(list, called, time_s, &options, ROT_DRIVE_FORMS, 1, progress);
}

/* `form`: a rot_drive_form. */
SEXP ffi_drive_exact(SEXP list, SEXP form, SEXP time_s, SEXP with_ledger, SEXP progress) {
  const double kind = ffi_real(form, "form");
  if (!(kind >= 0.0 && kind < ROT_DRIVE_FORMS)) Rf_error("internal: `form`");
  return run_drive(list, R_NilValue, time_s, NULL, (rot_drive_form)(int)kind,
                   ffi_real(with_ledger, "with_ledger") != 0.0, progress);
}
