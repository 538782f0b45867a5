#include "glue/scene.h"
#include "glue/run.h"
#include "glue/scenes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/axle/inputs.h"
#include "scene/axle/models.h"
#include "scene/clutch/models.h"
#include "scene/drive/models.h"
#include "scene/free/models.h"
#include "scene/incline/models.h"
#include "scene/pivot/models.h"
#include "scene/run.h"
#include "scene/shaft/models.h"

const rot_constraint *ffi_constraint(SEXP id) {
  const rot_constraint *found = rot_choice_constraint(ffi_text(id, "constraint"));
  if (!found) Rf_error("internal: no such constraint");
  return found;
}

/* ---- reading --------------------------------------------------------------------------------- */

enum {
  ONE_NUMBER = ROT_INPUT_NUMBER | ROT_INPUT_LIMIT,
  NUMBERS = ONE_NUMBER | ROT_INPUT_NUMBERS | ROT_INPUT_TIMES | ROT_INPUT_VECTOR | ROT_INPUT_ATTITUDE
};

/* The kinds with one number, and those with several. */
static unsigned kind_of(unsigned kinds, R_xlen_t n) {
  const unsigned one = kinds & ONE_NUMBER, more = kinds & NUMBERS & ~one;
  const unsigned from = one && (n == 1 || !more) ? one : more;
  return from & (~from + 1u); /* the first */
}

/* 1, or 0 where it is no value of these kinds. NULL: not given. */
static int read_input(const rot_input *input, SEXP x, rot_given *given) {
  memset(given, 0, sizeof *given);
  if (Rf_isNull(x)) return 1;
  if (TYPEOF(x) == REALSXP && input->kinds & NUMBERS) {
    *given = (rot_given){
        .is = kind_of(input->kinds, XLENGTH(x)), .n = (size_t)XLENGTH(x), .x = REAL_RO(x)};
    return 1;
  }
  if (TYPEOF(x) == STRSXP && XLENGTH(x) == 1 && input->kinds & ROT_INPUT_CHOICE) {
    const char *text = CHAR(STRING_ELT(x, 0));
    given->is = ROT_INPUT_CHOICE;
    while (input->options[given->option] && strcmp(input->options[given->option], text)) {
      given->option++;
    }
    return input->options[given->option] != NULL;
  }
  return 0;
}

/* ROT_OK, or ROT_EVALUE with the input that is refused. `to`: room for the scene. */
static rot_status read_scene(const rot_constraint *constraint, SEXP scene, void *to,
                             rot_refusal *refusal) {
  rot_given given[ROT_MOST_INPUTS];
  for (size_t i = 0; i < constraint->n_inputs; i++) {
    const rot_input *input = &constraint->inputs[i];
    if (!read_input(input, ffi_element(scene, input->name), &given[i])) {
      return rot_refuse(refusal, i, "is damaged");
    }
  }
  const rot_status status =
      rot_inputs_check(constraint->n_inputs, constraint->inputs, given, refusal);
  return status == ROT_OK ? constraint->build(given, to, refusal) : status;
}

/* Stands for the law of a scene, which is not called here. */
static rot_status no_call(double t, double theta, double omega, double *torque, void *ctx) {
  (void)t, (void)theta, (void)omega, (void)torque, (void)ctx;
  return ROT_ETORQUE;
}

/* Scenes that R holds in other forms than the inputs of their table, kept until the call ends. */
#define KEPT(name, type)                                                                           \
  static const void *read_##name(SEXP scene) {                                                     \
    type *kept = (type *)R_alloc(1, sizeof *kept);                                                 \
    *kept = ffi_##name##_scene(scene);                                                             \
    return kept;                                                                                   \
  }
KEPT(shaft, rot_shaft_params)
KEPT(clutch, rot_clutch_params)
KEPT(drive, rot_drive_scene)
KEPT(incline, rot_incline_scene)
KEPT(free, rot_free_params)

/* As its runs expect it: nothing else in it is set. */
static const void *read_axle(SEXP scene) {
  rot_axle_built *axle = (rot_axle_built *)R_alloc(1, sizeof *axle);
  memset(axle, 0, sizeof *axle);
  axle->scene = ffi_axle_scene(scene, R_NilValue);
  if (!Rf_isNull(ffi_element(ffi_element(scene, "loads"), "law"))) {
    axle->scene.linear.torque.call = no_call;
  }
  return axle;
}

static const struct {
  const rot_constraint *of;
  const void *(*read)(SEXP scene);
} own_forms[] = {{&rot_axle_constraint, read_axle},       {&rot_shaft_constraint, read_shaft},
                 {&rot_clutch_constraint, read_clutch},   {&rot_drive_constraint, read_drive},
                 {&rot_incline_constraint, read_incline}, {&rot_free_constraint, read_free},
                 {&rot_pivot_constraint, read_free}};

const void *ffi_scene_build(const rot_constraint *constraint, SEXP scene) {
  rot_refusal no;
  for (size_t i = 0; i < ROT_COUNT(own_forms); i++) {
    if (own_forms[i].of == constraint) return own_forms[i].read(scene);
  }
  void *built = R_alloc(1, (int)constraint->scene_size);
  if (read_scene(constraint, scene, built, &no) != ROT_OK) {
    Rf_error("internal: `%s` %s", constraint->inputs[no.input].name, no.reason);
  }
  return built;
}

/* NULL, or c(input, reason) of the first that is refused. */
SEXP ffi_scene_fault(SEXP id, SEXP scene) {
  const rot_constraint *constraint = ffi_constraint(id);
  rot_refusal no;
  if (read_scene(constraint, scene, R_alloc(1, (int)constraint->scene_size), &no) == ROT_OK) {
    return R_NilValue;
  }
  SEXP out = PROTECT(Rf_allocVector(STRSXP, 2));
  SET_STRING_ELT(out, 0, Rf_mkChar(constraint->inputs[no.input].name));
  SET_STRING_ELT(out, 1, Rf_mkChar(no.reason));
  UNPROTECT(1);
  return out;
}

/* ---- the table ------------------------------------------------------------------------------- */

static SEXP texts(size_t n, const char *const text[]) {
  SEXP out = PROTECT(Rf_allocVector(STRSXP, (R_xlen_t)n));
  for (size_t i = 0; i < n; i++) {
    SET_STRING_ELT(out, (R_xlen_t)i, text[i] ? Rf_mkChar(text[i]) : NA_STRING);
  }
  UNPROTECT(1);
  return out;
}

static SEXP options_of(const rot_input *input) {
  size_t n = 0;
  if (!input->options) return R_NilValue;
  while (input->options[n]) n++;
  return texts(n, input->options);
}

static SEXP inputs_of(const rot_constraint *c) {
  static const char *const names[] = {"unit", "required",  "low",   "high",    "above", "limit",
                                      "many", "otherwise", "words", "options", ""};
  SEXP out = PROTECT(Rf_allocVector(VECSXP, (R_xlen_t)c->n_inputs));
  SEXP of = PROTECT(Rf_allocVector(STRSXP, (R_xlen_t)c->n_inputs));
  for (size_t i = 0; i < c->n_inputs; i++) {
    const rot_input *input = &c->inputs[i];
    SEXP one = Rf_mkNamed(VECSXP, (const char **)names);
    SET_VECTOR_ELT(out, (R_xlen_t)i, one);
    SET_STRING_ELT(of, (R_xlen_t)i, Rf_mkChar(input->name));
    SET_VECTOR_ELT(one, 0, Rf_mkString(input->unit));
    SET_VECTOR_ELT(one, 1, Rf_ScalarLogical(input->required));
    SET_VECTOR_ELT(one, 2, Rf_ScalarReal(input->low));
    SET_VECTOR_ELT(one, 3, Rf_ScalarReal(input->high));
    SET_VECTOR_ELT(one, 4, Rf_ScalarLogical(input->above));
    SET_VECTOR_ELT(one, 5, Rf_ScalarLogical((input->kinds & ROT_INPUT_LIMIT) != 0));
    SET_VECTOR_ELT(one, 6, Rf_ScalarLogical((input->kinds & NUMBERS & ~ONE_NUMBER) != 0));
    SET_VECTOR_ELT(one, 7, Rf_ScalarReal(input->otherwise));
    SET_VECTOR_ELT(one, 8, Rf_mkString(input->words));
    SET_VECTOR_ELT(one, 9, options_of(input));
  }
  Rf_setAttrib(out, R_NamesSymbol, of);
  UNPROTECT(2);
  return out;
}

/* list(inputs, columns, units, state, measures, index, flows, balances, about): `state` is, by
 * column, the measure that it holds, or NA. NULL where scenes are not read by the table. */
SEXP ffi_scene_table(SEXP id) {
  static const char *const names[] = {"inputs", "columns", "units",    "state", "measures",
                                      "index",  "flows",   "balances", ""};
  const rot_constraint *c = ffi_constraint(id);
  const char *name[ROT_MOST_COLUMNS], *unit[ROT_MOST_COLUMNS], *state[ROT_MOST_COLUMNS];
  const char *quantity[ROT_MOST_BALANCES];
  size_t n_measures = 0;
  if (!ffi_scene_by_table(c)) return R_NilValue;
  while (c->measures[n_measures]) n_measures++;
  for (size_t i = 0; i < c->n_columns; i++) {
    const rot_column_of *column = &c->columns[i];
    name[i] = column->name;
    unit[i] = column->unit;
    state[i] = column->measure ? c->measures[column->measure - 1] : NULL;
  }
  for (size_t i = 0; i < c->n_balances; i++) quantity[i] = c->balances[i].quantity;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, inputs_of(c));
  SET_VECTOR_ELT(out, 1, texts(c->n_columns, name));
  SET_VECTOR_ELT(out, 2, texts(c->n_columns, unit));
  SET_VECTOR_ELT(out, 3, texts(c->n_columns, state));
  SET_VECTOR_ELT(out, 4, texts(n_measures, c->measures));
  SET_VECTOR_ELT(out, 5, c->index ? Rf_mkString(c->index) : R_NilValue);
  SET_VECTOR_ELT(out, 6, texts(c->n_flows, c->flows));
  SET_VECTOR_ELT(out, 7, texts(c->n_balances, quantity));
  UNPROTECT(1);
  return out;
}

SEXP ffi_scene_copies(SEXP id, SEXP scene) {
  const rot_constraint *c = ffi_constraint(id);
  return Rf_ScalarInteger((int)rot_run_copies(c, ffi_scene_build(c, scene)));
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* The columns of the rows: time and index, then those of the constraint. */
static void new_columns(const ffi_run *run, const rot_constraint *c, SEXP time_s, size_t copies,
                        void *column[]) {
  const char *names[ROT_MOST_COLUMNS + 3] = {"time_s"};
  const R_xlen_t n = XLENGTH(time_s), rows = n * (R_xlen_t)copies;
  size_t at = 1;
  if (c->index) names[at++] = c->index;
  for (size_t i = 0; i < c->n_columns; i++) names[at++] = c->columns[i].name;
  names[at] = "";
  SEXP list = ffi_run_columns(run, names);
  at = 0;
  if (!c->index) {
    SET_VECTOR_ELT(list, (R_xlen_t)at++, time_s);
  } else {
    double *time = ffi_new_double(list, (R_xlen_t)at++, rows);
    SEXP index = Rf_allocVector(INTSXP, rows);
    SET_VECTOR_ELT(list, (R_xlen_t)at++, index);
    for (R_xlen_t i = 0; i < rows; i++) {
      time[i] = REAL_RO(time_s)[i / (R_xlen_t)copies];
      INTEGER(index)[i] = (int)(i % (R_xlen_t)copies) + 1;
    }
  }
  for (size_t i = 0; i < c->n_columns; i++, at++) {
    column[i] = c->columns[i].flag ? (void *)ffi_new_int(list, (R_xlen_t)at, rows)
                                   : (void *)ffi_new_double(list, (R_xlen_t)at, rows);
  }
}

/* The ledger: a matrix with the time, each flow since the start, and the error of each. */
static void new_ledger(const ffi_run *run, const rot_constraint *c, SEXP time_s, double *flow[]) {
  const R_xlen_t n = XLENGTH(time_s);
  const int columns = 1 + 2 * (int)c->n_flows;
  SEXP ledger = Rf_allocMatrix(REALSXP, (int)n, columns);
  SET_VECTOR_ELT(run->out, FFI_LEDGER, ledger);
  SEXP both = PROTECT(Rf_allocVector(VECSXP, 2)), names = Rf_allocVector(STRSXP, columns);
  SET_VECTOR_ELT(both, 1, names);
  SET_STRING_ELT(names, 0, Rf_mkChar("time_s"));
  if (n) memcpy(REAL(ledger), REAL_RO(time_s), (size_t)n * sizeof(double));
  for (size_t k = 0; k < c->n_flows; k++) {
    char text[64];
    (void)snprintf(text, sizeof text, "%s_error", c->flows[k]);
    flow[k] = REAL(ledger) + (R_xlen_t)(k + 1) * n;
    SET_STRING_ELT(names, (R_xlen_t)k + 1, Rf_mkChar(c->flows[k]));
    SET_STRING_ELT(names, (R_xlen_t)(k + 1 + c->n_flows), Rf_mkChar(text));
  }
  Rf_setAttrib(ledger, R_DimNamesSymbol, both);
  UNPROTECT(1);
}

/* One model. `control` is c(accuracy, max_steps, asked, resolution). */
SEXP ffi_scene_run(SEXP id, SEXP scene, SEXP model, SEXP time_s, SEXP control, SEXP progress) {
  const rot_constraint *c = ffi_constraint(id);
  const rot_model *of = rot_choice_model(c, ffi_text(model, "model"));
  const double *t = ffi_reals(time_s, "time_s", -1), *x = ffi_reals(control, "control", 4);
  const void *built = ffi_scene_build(c, scene);
  const R_xlen_t n = XLENGTH(time_s);
  void *column[ROT_MOST_COLUMNS];
  double *flow[ROT_MOST_FLOWS], errors[ROT_MOST_FLOWS] = {0.0};
  rot_outcome outcome;
  ffi_run run;
  if (!of) Rf_error("internal: no such model");
  memset(&outcome, 0, sizeof outcome);
  ffi_run_begin(&run, progress);
  new_columns(&run, c, time_s, rot_run_copies(c, built), column);
  new_ledger(&run, c, time_s, flow);
  const rot_rows want = {.column = column, .flow = flow, .flow_error = errors};
  const rot_task task = {.n = (size_t)n,
                         .time_s = t,
                         .accuracy = x[0],
                         .max_steps = (size_t)(x[1] < 1e15 ? x[1] : 1e15),
                         .resolution = x[3],
                         .asked = x[2] != 0.0};
  rot_run_model(c, built, of, &task, &want, &outcome, &run.guard.hooks);
  for (size_t k = 0; k < c->n_flows; k++) {
    for (R_xlen_t i = 0; i < n; i++) flow[k][(R_xlen_t)c->n_flows * n + i] = errors[k];
  }
  run.info = outcome.info;
  run.events = outcome.events;
  run.beyond = isinf(outcome.error) && outcome.info.status == ROT_OK;
  return ffi_run_end(&run, outcome.info.status);
}

/* ---- the most common run in one call --------------------------------------------------------- */

/* The scene last found sound. It is kept, so R copies it before it is changed, and an equal pointer
 * means an equal scene. */
static SEXP sound = NULL;

/* As ffi_form_fault(), of a scene. */
SEXP ffi_scene_form_fault(SEXP scene, SEXP form) {
  if (scene == sound) return R_NilValue;
  SEXP fault = ffi_form_fault(scene, form);
  if (Rf_isNull(fault)) {
    R_PreserveObject(scene);
    if (sound) R_ReleaseObject(sound);
    sound = scene;
  }
  return fault;
}

enum { QUICK_ROWS = 100000 }; /* more take so long that they show their progress */

static int quick_times(const rot_constraint *c, const void *built, SEXP time_s) {
  if (TYPEOF(time_s) != REALSXP || Rf_isObject(time_s)) return 0;
  const R_xlen_t n = XLENGTH(time_s);
  const double *t = REAL_RO(time_s), start = c->start_s(built);
  if (n < 1 || n > QUICK_ROWS || !isfinite(t[n - 1] - start) || !isfinite(t[0] - start)) return 0;
  for (R_xlen_t i = 1; i < n; i++) {
    if (!(t[i] >= t[i - 1])) return 0;
  }
  return 1;
}

/* The columns that R shows: those without effects of their own. */
static void quick_columns(const ffi_run *run, const rot_constraint *c, SEXP time_s,
                          void *column[]) {
  const char *names[ROT_MOST_COLUMNS + 2] = {"time_s"};
  const R_xlen_t n = XLENGTH(time_s);
  size_t shown = 0;
  while (shown < c->n_columns && !c->columns[shown].only_with) {
    names[shown + 1] = c->columns[shown].name;
    shown++;
  }
  names[shown + 1] = "";
  SEXP list = ffi_run_columns(run, names);
  SET_VECTOR_ELT(list, 0, time_s);
  for (size_t i = 0; i < shown; i++) column[i] = ffi_new_double(list, (R_xlen_t)i + 1, n);
}

/* list(model, run) by the cheapest model: a closed form that takes the scene unchanged, has no
 * column of its own, and errs by roundings. NULL where anything else is so, which R says. */
SEXP ffi_scene_quick(SEXP id, SEXP form, SEXP scene, SEXP time_s, SEXP accuracy) {
  const rot_constraint *c = ffi_constraint(id);
  if (c->index || !c->runs || !Rf_isNull(ffi_scene_form_fault(scene, form))) return R_NilValue;
  const void *built = ffi_scene_build(c, scene);
  if (!quick_times(c, built, time_s)) return R_NilValue;
  const rot_task task = {.n = (size_t)XLENGTH(time_s),
                         .time_s = REAL_RO(time_s),
                         .accuracy = ffi_real(accuracy, "accuracy"),
                         .max_steps = 1000000};
  const rot_query query = {task.n, task.time_s, task.accuracy, 0.0};
  rot_candidate picked[ROT_MOST_MODELS];
  if (!rot_choice_pick(c, built, &query, picked) || picked[0].dropped) return R_NilValue;
  const rot_model *model = picked[0].model;
  if (model->error_kind != ROT_BOUND || model->use != ROT_FREELY) return R_NilValue;
  void *column[ROT_MOST_COLUMNS] = {NULL};
  ffi_run run;
  ffi_run_begin(&run, R_NilValue);
  quick_columns(&run, c, time_s, column);
  rot_rows rows = {.column = column, .events = &run.events};
  const rot_model_run *of = &c->runs[model - c->models];
  const rot_status status = of->run(built, &task, of->method, &rows, &run.guard.hooks, &run.info);
  const double error = rot_info_error(&run.info);
  int plain = status == ROT_OK && error <= 1e-13 && error <= task.accuracy;
  for (size_t i = 0; i < c->n_columns && column[i]; i++) {
    double sum = 0.0;
    for (size_t k = 0; k < task.n; k++) sum += ((const double *)column[i])[k];
    plain &= isfinite(sum) != 0;
  }
  SEXP result = PROTECT(ffi_run_end(&run, status));
  SEXP out = R_NilValue;
  if (plain) {
    out = PROTECT(Rf_allocVector(VECSXP, 2));
    SET_VECTOR_ELT(out, 0, Rf_mkString(model->id));
    SET_VECTOR_ELT(out, 1, result);
    UNPROTECT(1);
  }
  UNPROTECT(1);
  return out;
}

/* ---- balances -------------------------------------------------------------------------------- */

/* list(value, explained, balance, role, words): of terms; `explained` is of balances. `first` and
 * `last`: the columns at two times, each with its copies; `flow`, `flow_error`: between them;
 * `error`: of the measures. */
SEXP ffi_scene_audit(SEXP id, SEXP scene, SEXP first, SEXP last, SEXP flow, SEXP flow_error,
                     SEXP error) {
  static const char *const names[] = {"value", "explained", "balance", "role", "words", ""};
  const rot_constraint *c = ffi_constraint(id);
  const void *built = ffi_scene_build(c, scene);
  const R_xlen_t cells = (R_xlen_t)(c->n_columns * rot_run_copies(c, built));
  const R_xlen_t flows = (R_xlen_t)c->n_flows, terms = (R_xlen_t)c->n_terms;
  const rot_span span = {ffi_reals(first, "first", cells), ffi_reals(last, "last", cells),
                         ffi_reals(flow, "flow", flows), ffi_reals(flow_error, "flow_error", flows),
                         ffi_reals(error, "error", -1)};
  double term[ROT_MOST_TERMS], explained[ROT_MOST_BALANCES];
  const char *words[ROT_MOST_TERMS];
  if (rot_run_audit(c, built, &span, term, explained) != ROT_OK) Rf_error("out of memory");
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), balance, role;
  SET_VECTOR_ELT(out, 0, ffi_numbers((int)terms, term));
  SET_VECTOR_ELT(out, 1, ffi_numbers((int)c->n_balances, explained));
  SET_VECTOR_ELT(out, 2, balance = Rf_allocVector(INTSXP, terms));
  SET_VECTOR_ELT(out, 3, role = Rf_allocVector(INTSXP, terms));
  for (R_xlen_t i = 0; i < terms; i++) {
    INTEGER(balance)[i] = (int)c->terms[i].balance + 1;
    INTEGER(role)[i] = (int)c->terms[i].role + 1;
    words[i] = c->terms[i].words;
  }
  SET_VECTOR_ELT(out, 4, texts(c->n_terms, words));
  UNPROTECT(1);
  return out;
}

/* list(conserved, why, about, unit), by balance. */
SEXP ffi_scene_keeps(SEXP id, SEXP scene) {
  static const char *const names[] = {"conserved", "why", "about", "unit", ""};
  const rot_constraint *c = ffi_constraint(id);
  const void *built = ffi_scene_build(c, scene);
  const char *text[3][ROT_MOST_BALANCES];
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), kept;
  SET_VECTOR_ELT(out, 0, kept = Rf_allocVector(LGLSXP, (R_xlen_t)c->n_balances));
  for (size_t i = 0; i < c->n_balances; i++) {
    LOGICAL(kept)[i] = c->keeps(built, i, &text[0][i]);
    text[1][i] = c->balances[i].about;
    text[2][i] = c->balances[i].unit;
  }
  for (int k = 0; k < 3; k++) SET_VECTOR_ELT(out, k + 1, texts(c->n_balances, text[k]));
  UNPROTECT(1);
  return out;
}

/* c(fades_s, swing_rad_per_s) */
SEXP ffi_scene_pace(SEXP id, SEXP scene, SEXP sizes) {
  const rot_constraint *c = ffi_constraint(id);
  rot_pace pace;
  c->pace(ffi_scene_build(c, scene), ffi_reals(sizes, "sizes", -1), &pace);
  const double x[] = {pace.fades_s, pace.swing_rad_per_s};
  return ffi_numbers(2, x);
}
