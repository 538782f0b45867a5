#include "glue/scene.h"
#include "glue/input.h"
#include "glue/run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "ground/real.h"
#include "scene/run.h"

const rot_constraint *ffi_constraint(SEXP id) {
  const rot_constraint *found = rot_choice_constraint(ffi_text(id, "constraint"));
  if (!found) Rf_error("internal: no such constraint");
  return found;
}

static SEXP texts(size_t n, const char *const text[]) {
  SEXP out = PROTECT(Rf_allocVector(STRSXP, (R_xlen_t)n));
  for (size_t i = 0; i < n; i++) {
    SET_STRING_ELT(out, (R_xlen_t)i, text[i] ? Rf_mkChar(text[i]) : NA_STRING);
  }
  UNPROTECT(1);
  return out;
}

/* ---- constructors ---------------------------------------------------------------------------- */

/* constructor => class of its scenes, rot_<constructor> */
static const char *class_of(const rot_maker *maker, size_t room, char name[]) {
  (void)snprintf(name, room, "rot_%s", maker->constructor);
  return name;
}

/* scene => its constructor, by class. Compared without its prefix: the names of all classes were
 * 5 % of the instructions of a spin-up. */
static const rot_maker *maker_of(const rot_constraint *c, SEXP scene) {
  SEXP classes = c->n_makers > 1 ? Rf_getAttrib(scene, R_ClassSymbol) : R_NilValue;
  for (R_xlen_t k = 0; k < Rf_xlength(classes); k++) {
    const char *own = CHAR(STRING_ELT(classes, k));
    if (strncmp(own, "rot_", 4) != 0) continue;
    for (size_t i = 1; i < c->n_makers; i++) {
      if (!strcmp(own + 4, c->makers[i].constructor)) return &c->makers[i];
    }
  }
  return c->makers;
}

/* ---- reading --------------------------------------------------------------------------------- */

/* Memory until the call from R ends. */
static void *take(size_t bytes) { return R_alloc(bytes, 1); }

/* scene of R => scene of the core at `to`; ROT_EVALUE with the refused input */
static rot_status read_scene(const rot_maker *maker, SEXP scene, const ffi_laws *laws, void *to,
                             rot_refusal *refusal) {
  rot_given *given =
      (rot_given *)R_alloc(maker->n_inputs + 1, sizeof *given); /* scenes refer to it */
  rot_store store = {.take = take};
  for (size_t i = 0; i < maker->n_inputs; i++) {
    SEXP x = ffi_element(scene, maker->inputs[i].name);
    if (!ffi_input_read(maker->inputs, i, x, laws, &given[i])) {
      return rot_refuse(refusal, i, "is damaged");
    }
  }
  return rot_run_build(maker, given, &store, to, refusal);
}

static const void *build_scene(const rot_constraint *constraint, SEXP scene, const ffi_laws *laws) {
  rot_refusal no;
  const rot_maker *maker = maker_of(constraint, scene);
  void *built = R_alloc(1, (int)constraint->scene_size);
  if (read_scene(maker, scene, laws, built, &no) != ROT_OK) {
    Rf_error("internal: `%s` %s", maker->inputs[no.input].name, no.reason);
  }
  return built;
}

/* scene => bits of the effects named in its element `without` */
static unsigned left_out(const rot_constraint *c, SEXP scene) {
  SEXP without = ffi_element(scene, "without");
  unsigned mask = 0;
  if (TYPEOF(without) != STRSXP || !c->reduce) return 0;
  for (R_xlen_t k = 0; k < XLENGTH(without); k++) {
    for (size_t i = 0; i < c->n_effects; i++) {
      if (!strcmp(c->effects[i].name, CHAR(STRING_ELT(without, k)))) mask |= 1u << i;
    }
  }
  return mask;
}

const void *ffi_scene_build(const rot_constraint *constraint, SEXP scene) {
  const void *whole = build_scene(constraint, scene, NULL);
  const unsigned without = left_out(constraint, scene);
  rot_store store = {.take = take};
  if (!without) return whole;
  void *solved = R_alloc(1, (int)constraint->scene_size);
  if (constraint->reduce(whole, without, &store, solved) != ROT_OK) Rf_error("out of memory");
  return solved;
}

/* built scene => numbers of one derived name, their count *n */
static const double *derived(const rot_constraint *c, const rot_derived *of, const void *built,
                             R_xlen_t *n) {
  const char *at = (const char *)built + of->offset;
  *n = (R_xlen_t)(of->n ? of->n : rot_run_rows_per_time(c, built));
  return of->n ? (const double *)at : *(const double *const *)at;
}

static SEXP derived_numbers(const rot_constraint *c, const rot_derived *of, const void *built) {
  R_xlen_t n;
  const double *x = derived(c, of, built, &n);
  return ffi_numbers((int)n, x);
}

/* => NULL; or the name of a refused input, or of a derived number that is not that of the inputs */
static const char *fault_of_inputs(const rot_constraint *c, SEXP scene) {
  const rot_maker *maker = maker_of(c, scene);
  void *built = R_alloc(1, (int)c->scene_size);
  rot_refusal no;
  if (read_scene(maker, scene, NULL, built, &no) != ROT_OK) return maker->inputs[no.input].name;
  for (size_t i = 0; i < maker->n_derived; i++) {
    SEXP x = ffi_element(scene, maker->derived[i].name);
    R_xlen_t n, same = 0;
    const double *want = derived(c, &maker->derived[i], built, &n);
    while (TYPEOF(x) == REALSXP && XLENGTH(x) == n && same < n && REAL_RO(x)[same] == want[same]) {
      same++;
    }
    if (same < n) return maker->derived[i].name;
  }
  return NULL;
}

/* The last scene found valid. It is preserved, so R copies it before a change: an equal pointer
 * means an equal scene. */
static SEXP sound = NULL;

static void keep_sound(SEXP scene) {
  R_PreserveObject(scene);
  if (sound) R_ReleaseObject(sound);
  sound = scene;
}

static SEXP fault_of_scene(const rot_constraint *c, SEXP form, SEXP scene) {
  if (scene == sound) return R_NilValue;
  SEXP fault = ffi_form_fault(scene, form);
  if (!Rf_isNull(fault)) return fault;
  const char *part = fault_of_inputs(c, scene);
  if (part) return Rf_mkString(part);
  keep_sound(scene);
  return R_NilValue;
}

/* missing(name) in the frame of a constructor. */
static int is_missing(SEXP name, SEXP env) {
  SEXP call = PROTECT(Rf_lang2(Rf_install("missing"), name));
  const int missing = Rf_asLogical(Rf_eval(call, env)) != 0;
  UNPROTECT(1);
  return missing;
}

/* => scene with empty elements: inputs, then derived numbers */
static SEXP new_scene(const rot_constraint *c, const rot_maker *maker) {
  const char *names[2 * ROT_MAX_INPUTS + 1], *classes[3];
  char own[64], shared[64];
  size_t n = 0, of = 0;
  while (n < maker->n_inputs) {
    names[n] = maker->inputs[n].name;
    n++;
  }
  for (size_t i = 0; i < maker->n_derived; i++) {
    if (rot_input_named(maker->n_inputs, maker->inputs, maker->derived[i].name) ==
        maker->n_inputs) {
      names[n++] = maker->derived[i].name;
    }
  }
  names[n] = "";
  SEXP scene = PROTECT(Rf_mkNamed(VECSXP, names));
  classes[of++] = class_of(maker, sizeof own, own);
  if (maker != c->makers) classes[of++] = class_of(c->makers, sizeof shared, shared);
  classes[of++] = "rot_scene";
  Rf_setAttrib(scene, R_ClassSymbol, texts(of, classes));
  UNPROTECT(1);
  return scene;
}

static R_xlen_t place_of(SEXP list, const char *name) {
  SEXP names = Rf_getAttrib(list, R_NamesSymbol);
  R_xlen_t i = 0;
  while (strcmp(CHAR(STRING_ELT(names, i)), name)) i++;
  return i;
}

/* (constructor, frame of its arguments) => scene; NULL if R must process an argument (units,
 * errors) */
SEXP ffi_scene_describe(SEXP constructor, SEXP form, SEXP env) {
  const rot_constraint *c = NULL;
  const rot_maker *maker = rot_run_maker(ffi_text(constructor, "constructor"), &c);
  rot_refusal no;
  if (!maker || TYPEOF(env) != ENVSXP) Rf_error("internal: `constructor` or `env`");
  void *built = R_alloc(1, (int)c->scene_size);
  SEXP scene = PROTECT(new_scene(c, maker)), out = R_NilValue;
  for (size_t i = 0; i < maker->n_inputs; i++) {
    SEXP name = Rf_install(maker->inputs[i].name);
    if (maker->inputs[i].required && is_missing(name, env)) break;
    SEXP x = PROTECT(Rf_eval(name, env)),
         plain = ffi_input_plain(&maker->inputs[i], x, ffi_element(form, maker->inputs[i].name));
    if (plain) SET_VECTOR_ELT(scene, (R_xlen_t)i, plain);
    UNPROTECT(1);
    if (!plain) break;
    if (i + 1 == maker->n_inputs) out = scene;
  }
  if (Rf_isNull(out) || read_scene(maker, scene, NULL, built, &no) != ROT_OK) {
    UNPROTECT(1);
    return R_NilValue;
  }
  for (size_t i = 0; i < maker->n_derived; i++) {
    SET_VECTOR_ELT(scene, place_of(scene, maker->derived[i].name),
                   derived_numbers(c, &maker->derived[i], built));
  }
  if (Rf_isNull(ffi_form_fault(scene, form))) {
    keep_sound(scene);
  } else {
    out = R_NilValue;
  }
  UNPROTECT(1);
  return out;
}

/* scene => derived numbers by name; or c(input, reason) of the first refused input */
SEXP ffi_scene_derived(SEXP id, SEXP scene) {
  const rot_constraint *c = ffi_constraint(id);
  const rot_maker *maker = maker_of(c, scene);
  void *built = R_alloc(1, (int)c->scene_size);
  rot_refusal no;
  if (read_scene(maker, scene, NULL, built, &no) != ROT_OK) {
    const char *said[] = {maker->inputs[no.input].name, no.reason};
    return texts(2, said);
  }
  SEXP out = PROTECT(Rf_allocVector(VECSXP, (R_xlen_t)maker->n_derived));
  SEXP names = Rf_allocVector(STRSXP, (R_xlen_t)maker->n_derived);
  Rf_setAttrib(out, R_NamesSymbol, names);
  for (size_t i = 0; i < maker->n_derived; i++) {
    SET_VECTOR_ELT(out, (R_xlen_t)i, derived_numbers(c, &maker->derived[i], built));
    SET_STRING_ELT(names, (R_xlen_t)i, Rf_mkChar(maker->derived[i].name));
  }
  UNPROTECT(1);
  return out;
}

/* => NULL, or the path of a part that does not fit the form or contradicts the others */
SEXP ffi_scene_fault(SEXP id, SEXP form, SEXP scene) {
  return fault_of_scene(rot_choice_constraint(ffi_text(id, "constraint")), form, scene);
}

/* ---- the table ------------------------------------------------------------------------------- */

static SEXP options_of(const rot_input *input) {
  size_t n = 0;
  const int has = input->kinds & (ROT_INPUT_CHOICE | ROT_INPUT_RESISTANCE) && input->options;
  if (!has) return R_NilValue;
  while (input->options[n]) n++;
  return texts(n, input->options);
}

enum {
  MANY = ROT_INPUT_NUMBERS | ROT_INPUT_TIMES | ROT_INPUT_VECTOR | ROT_INPUT_ATTITUDE,
};

/* constructor => list of its inputs by name, with their fields */
static SEXP inputs_of(const rot_maker *maker) {
  static const char *const names[] = {"unit", "required", "low",  "high",      "above", "limit",
                                      "many", "options",  "form", "otherwise", "words", ""};
  SEXP out = PROTECT(Rf_allocVector(VECSXP, (R_xlen_t)maker->n_inputs));
  SEXP of = PROTECT(Rf_allocVector(STRSXP, (R_xlen_t)maker->n_inputs));
  for (size_t i = 0; i < maker->n_inputs; i++) {
    const rot_input *input = &maker->inputs[i];
    SEXP one = Rf_mkNamed(VECSXP, (const char **)names);
    SET_VECTOR_ELT(out, (R_xlen_t)i, one);
    SET_STRING_ELT(of, (R_xlen_t)i, Rf_mkChar(input->name));
    SET_VECTOR_ELT(one, 0, Rf_mkString(input->unit));
    SET_VECTOR_ELT(one, 1, Rf_ScalarLogical(input->required));
    SET_VECTOR_ELT(one, 2, Rf_ScalarReal(input->low));
    SET_VECTOR_ELT(one, 3, Rf_ScalarReal(input->high));
    SET_VECTOR_ELT(one, 4, Rf_ScalarLogical(input->above));
    SET_VECTOR_ELT(one, 5, Rf_ScalarLogical((input->kinds & ROT_INPUT_LIMIT) != 0));
    SET_VECTOR_ELT(one, 6, Rf_ScalarLogical((input->kinds & MANY) != 0));
    SET_VECTOR_ELT(one, 7, options_of(input));
    SET_VECTOR_ELT(one, 8, Rf_mkString(ffi_input_form(input)));
    SET_VECTOR_ELT(one, 9, Rf_ScalarReal(input->otherwise));
    SET_VECTOR_ELT(one, 10, Rf_mkString(input->words));
  }
  Rf_setAttrib(out, R_NamesSymbol, of);
  UNPROTECT(2);
  return out;
}

/* => by constructor: list(inputs, derived), with the count of numbers of each derived name */
static SEXP makers_of(const rot_constraint *c) {
  static const char *const names[] = {"inputs", "derived", ""};
  SEXP out = PROTECT(Rf_allocVector(VECSXP, (R_xlen_t)c->n_makers));
  SEXP of = Rf_allocVector(STRSXP, (R_xlen_t)c->n_makers);
  Rf_setAttrib(out, R_NamesSymbol, of);
  for (size_t i = 0; i < c->n_makers; i++) {
    const rot_maker *maker = &c->makers[i];
    const char *follows[ROT_MAX_INPUTS];
    SEXP one = Rf_mkNamed(VECSXP, (const char **)names), counts;
    SET_VECTOR_ELT(out, (R_xlen_t)i, one);
    SET_STRING_ELT(of, (R_xlen_t)i, Rf_mkChar(maker->constructor));
    SET_VECTOR_ELT(one, 0, inputs_of(maker));
    SET_VECTOR_ELT(one, 1, counts = Rf_allocVector(INTSXP, (R_xlen_t)maker->n_derived));
    for (size_t k = 0; k < maker->n_derived; k++) {
      follows[k] = maker->derived[k].name;
      INTEGER(counts)[k] = (int)maker->derived[k].n;
    }
    Rf_setAttrib(counts, R_NamesSymbol, texts(maker->n_derived, follows));
  }
  UNPROTECT(1);
  return out;
}

static size_t kept_by(const rot_constraint *c) { return c->n_kept ? c->n_kept : c->n_balances; }

/* => number of quantities: conserved ones or balances, whichever are more */
static size_t named_by(const rot_constraint *c) {
  return kept_by(c) > c->n_balances ? kept_by(c) : c->n_balances;
}

/* constraint => list(makers, columns, units, state, measures, index, flows, balances, kept,
 * event_rows, always, between). `state`: measure in each column, or NA; `always`: TRUE for a column
 * of all scenes. */
SEXP ffi_scene_table(SEXP id) {
  static const char *const names[] = {"makers", "columns", "units",    "state", "measures",
                                      "index",  "flows",   "balances", "kept",  "event_rows",
                                      "always", "between", ""};
  const rot_constraint *c = ffi_constraint(id);
  const char *name[ROT_MAX_COLUMNS], *unit[ROT_MAX_COLUMNS], *state[ROT_MAX_COLUMNS];
  const char *quantity[ROT_MAX_BALANCES];
  size_t n_measures = 0;
  while (c->measures[n_measures]) n_measures++;
  for (size_t i = 0; i < c->n_columns; i++) {
    const rot_column_of *column = &c->columns[i];
    name[i] = column->name;
    unit[i] = column->unit;
    state[i] = column->measure ? c->measures[column->measure - 1] : NULL;
  }
  for (size_t i = 0; i < named_by(c); i++) quantity[i] = c->balances[i].quantity;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, makers_of(c));
  SET_VECTOR_ELT(out, 1, texts(c->n_columns, name));
  SET_VECTOR_ELT(out, 2, texts(c->n_columns, unit));
  SET_VECTOR_ELT(out, 3, texts(c->n_columns, state));
  SET_VECTOR_ELT(out, 4, texts(n_measures, c->measures));
  SET_VECTOR_ELT(out, 5, c->index ? Rf_mkString(c->index) : R_NilValue);
  SET_VECTOR_ELT(out, 6, texts(c->n_flows, c->flows));
  SET_VECTOR_ELT(out, 7, texts(c->n_balances, quantity));
  SET_VECTOR_ELT(out, 8, texts(kept_by(c), quantity));
  SET_VECTOR_ELT(out, 9, Rf_ScalarLogical(c->event_rows));
  SEXP always = Rf_allocVector(LGLSXP, (R_xlen_t)c->n_columns);
  SET_VECTOR_ELT(out, 10, always);
  for (size_t i = 0; i < c->n_columns; i++) LOGICAL(always)[i] = !c->columns[i].only_with;
  SET_VECTOR_ELT(out, 11, c->between ? Rf_mkString(c->between) : R_NilValue);
  UNPROTECT(1);
  return out;
}

/* Columns of the rows of a scene. */
typedef struct shown {
  const rot_constraint *of;
  unsigned char is[ROT_MAX_COLUMNS]; /* 1: the scene has the column */
} shown;

static shown shown_by(const rot_constraint *c, const void *built) {
  shown s = {.of = c};
  const unsigned effects = c->effects_of(built);
  for (size_t i = 0; i < c->n_columns; i++) {
    s.is[i] = (unsigned char)rot_run_shows(c, built, effects, i);
  }
  return s;
}

/* scene => logical vector: columns that its rows have */
SEXP ffi_scene_shows(SEXP id, SEXP scene) {
  const rot_constraint *c = ffi_constraint(id);
  const shown shows = shown_by(c, ffi_scene_build(c, scene));
  SEXP out = Rf_allocVector(LGLSXP, (R_xlen_t)c->n_columns);
  for (size_t i = 0; i < c->n_columns; i++) LOGICAL(out)[i] = shows.is[i];
  return out;
}

SEXP ffi_scene_rows_per_time(SEXP id, SEXP scene) {
  const rot_constraint *c = ffi_constraint(id);
  return Rf_ScalarInteger((int)rot_run_rows_per_time(c, ffi_scene_build(c, scene)));
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* => named empty list: time, index, columns shown */
static SEXP named_columns(const shown *s) {
  const rot_constraint *c = s->of;
  const char *names[ROT_MAX_COLUMNS + 3] = {"time_s"};
  size_t at = 1;
  if (c->index) names[at++] = c->index;
  for (size_t i = 0; i < c->n_columns; i++) {
    if (s->is[i]) names[at++] = c->columns[i].name;
  }
  names[at] = "";
  return Rf_mkNamed(VECSXP, names);
}

/* Allocates the columns of a run; column[i]: address, NULL if not shown. */
static void new_columns(const ffi_run *run, const shown *s, SEXP time_s, size_t rows_per_time,
                        void *column[]) {
  const rot_constraint *c = s->of;
  const R_xlen_t n = XLENGTH(time_s), rows = n * (R_xlen_t)rows_per_time;
  SEXP list = named_columns(s);
  SET_VECTOR_ELT(run->out, FFI_COLUMNS, list);
  size_t at = 0;
  if (!c->index) {
    SET_VECTOR_ELT(list, (R_xlen_t)at++, time_s);
  } else {
    double *time = ffi_new_double(list, (R_xlen_t)at++, rows);
    SEXP index = Rf_allocVector(INTSXP, rows);
    SET_VECTOR_ELT(list, (R_xlen_t)at++, index);
    for (R_xlen_t i = 0; i < rows; i++) {
      time[i] = REAL_RO(time_s)[i / (R_xlen_t)rows_per_time];
      INTEGER(index)[i] = (int)(i % (R_xlen_t)rows_per_time) + 1;
    }
  }
  for (size_t i = 0; i < c->n_columns; i++) {
    column[i] = NULL;
    if (!s->is[i]) continue;
    column[i] = c->columns[i].flag ? (void *)ffi_new_int(list, (R_xlen_t)at, rows)
                                   : (void *)ffi_new_double(list, (R_xlen_t)at, rows);
    at++;
  }
}

/* Undefined values become NA: flags below 0, and NaN in the last row of each time, which has no
 * next neighbour. */
static void mark_missing(const shown *s, R_xlen_t n, R_xlen_t rows_per_time, void *const column[]) {
  const rot_constraint *c = s->of;
  for (size_t k = 0; k < c->n_columns; k++) {
    if (!s->is[k]) continue;
    for (R_xlen_t i = 0; c->columns[k].flag && i < n * rows_per_time; i++) {
      int *flag = column[k];
      if (flag[i] < 0) flag[i] = NA_LOGICAL;
    }
    for (R_xlen_t i = rows_per_time; c->index && !c->columns[k].flag && i <= n * rows_per_time;
         i += rows_per_time) {
      double *x = column[k];
      if (ISNAN(x[i - 1])) x[i - 1] = NA_REAL;
    }
  }
}

/* => ledger: matrix with the time, each flow since the start, the error of each flow */
static SEXP new_ledger(const rot_constraint *c, R_xlen_t n, const double time_s[], double *flow[]) {
  const int columns = 1 + 2 * (int)c->n_flows;
  SEXP ledger = PROTECT(Rf_allocMatrix(REALSXP, (int)n, columns));
  SEXP both = PROTECT(Rf_allocVector(VECSXP, 2)), names = Rf_allocVector(STRSXP, columns);
  SET_VECTOR_ELT(both, 1, names);
  SET_STRING_ELT(names, 0, Rf_mkChar("time_s"));
  if (n) memcpy(REAL(ledger), time_s, (size_t)n * sizeof(double));
  for (size_t k = 0; k < c->n_flows; k++) {
    char text[64];
    (void)snprintf(text, sizeof text, "%s_error", c->flows[k]);
    flow[k] = REAL(ledger) + (R_xlen_t)(k + 1) * n;
    SET_STRING_ELT(names, (R_xlen_t)k + 1, Rf_mkChar(c->flows[k]));
    SET_STRING_ELT(names, (R_xlen_t)(k + 1 + c->n_flows), Rf_mkChar(text));
  }
  Rf_setAttrib(ledger, R_DimNamesSymbol, both);
  UNPROTECT(2);
  return ledger;
}

/* Fills the error columns of the ledger; an error applies to all rows. */
static void fill_errors(const rot_constraint *c, R_xlen_t n, double *const flow[],
                        const double errors[]) {
  for (size_t k = 0; k < c->n_flows; k++) {
    for (R_xlen_t i = 0; i < n; i++) flow[k][(R_xlen_t)c->n_flows * n + i] = errors[k];
  }
}

/* Rows at events. */
typedef struct event_rows {
  const shown *shown;
  rot_event_rows rows;
  SEXP to;              /* run.out */
  const double *errors; /* of the flows; NULL: no ledger */
} event_rows;

/* rows at events => list(columns, ledger), with a ledger if the run has one */
static SEXP take_event_rows(void *data) {
  static const char *const names[] = {"columns", "ledger", ""};
  const event_rows *from = data;
  const rot_constraint *c = from->shown->of;
  const R_xlen_t n = (R_xlen_t)from->rows.count;
  const size_t width = 1 + from->rows.width;
  const double *value = from->rows.value;
  double *flow[ROT_MAX_FLOWS];
  SEXP both = Rf_mkNamed(VECSXP, (const char **)names);
  SET_VECTOR_ELT(from->to, FFI_EVENT_ROWS, both);
  SEXP list = named_columns(from->shown);
  SET_VECTOR_ELT(both, 0, list);
  double *time_s = ffi_new_double(list, 0, n);
  for (R_xlen_t i = 0; i < n; i++) time_s[i] = value[(size_t)i * width];
  R_xlen_t at = 1;
  for (size_t k = 0; k < c->n_columns; k++) {
    if (!from->shown->is[k]) continue;
    if (c->columns[k].flag) {
      int *x = ffi_new_int(list, at++, n);
      for (R_xlen_t i = 0; i < n; i++) x[i] = (int)value[(size_t)i * width + 1 + k];
    } else {
      double *x = ffi_new_double(list, at++, n);
      for (R_xlen_t i = 0; i < n; i++) x[i] = value[(size_t)i * width + 1 + k];
    }
  }
  if (!from->errors) return R_NilValue;
  SET_VECTOR_ELT(both, 1, new_ledger(c, n, time_s, flow));
  for (size_t k = 0; k < c->n_flows; k++) {
    for (R_xlen_t i = 0; i < n; i++) flow[k][i] = value[(size_t)i * width + 1 + c->n_columns + k];
  }
  fill_errors(c, n, flow, from->errors);
  return R_NilValue;
}

enum { ACCURACY, MAX_STEPS, ASKED, RESOLUTION, FLOWS, AT_EVENTS, STEP, CONTROLS };

/* (scene, model, times) => run. control: c(accuracy, max_steps, asked, resolution, flows,
 * event_rows, step_s). flows 1: with a ledger, which models that step in time always have; 2: flows
 * of all effects, also of those left out. laws: see glue/input.h. */
SEXP ffi_scene_run(SEXP id, SEXP scene, SEXP model, SEXP time_s, SEXP control, SEXP laws,
                   SEXP progress) {
  const rot_constraint *c = ffi_constraint(id);
  const rot_model *of = rot_choice_model(c, ffi_text(model, "model"));
  const double *t = ffi_reals(time_s, "time_s", -1), *x = ffi_reals(control, "control", CONTROLS);
  const R_xlen_t n = XLENGTH(time_s);
  void *column[ROT_MAX_COLUMNS];
  double *flow[ROT_MAX_FLOWS], errors[ROT_MAX_FLOWS] = {0.0};
  rot_outcome outcome;
  ffi_run run;
  if (!of) Rf_error("internal: no such model");
  memset(&outcome, 0, sizeof outcome);
  const ffi_laws called = {laws, &run.guard, PROTECT(Rf_allocVector(VECSXP, ROT_MAX_INPUTS))};
  const void *built = build_scene(c, scene, &called);
  const shown shows = shown_by(c, built);
  const int steps = of->error_kind == ROT_ADAPTIVE || of->use == ROT_BY_NAME;
  const int flows = x[FLOWS] != 0.0 || steps;
  ffi_run_begin(&run, progress);
  new_columns(&run, &shows, time_s, rot_run_rows_per_time(c, built), column);
  if (flows) SET_VECTOR_ELT(run.out, FFI_LEDGER, new_ledger(c, n, t, flow));
  event_rows at_events = {
      &shows, {c->n_columns + c->n_flows, 0, 0, NULL}, run.out, flows ? errors : NULL};
  const rot_rows want = {.column = column,
                         .flow = flows ? flow : NULL,
                         .flow_error = flows ? errors : NULL,
                         .at_events = x[AT_EVENTS] != 0.0 ? &at_events.rows : NULL};
  const rot_task task = {.n = (size_t)n,
                         .time_s = t,
                         .accuracy = x[ACCURACY],
                         .max_steps = (size_t)(x[MAX_STEPS] < 1e15 ? x[MAX_STEPS] : 1e15),
                         .resolution = x[RESOLUTION],
                         .step_s = x[STEP],
                         .asked = x[ASKED] != 0.0,
                         .without = left_out(c, scene),
                         .flows_of_whole = x[FLOWS] > 1.0};
  rot_run_model(c, built, of, &task, &want, &outcome, &run.guard.hooks);
  mark_missing(&shows, n, (R_xlen_t)rot_run_rows_per_time(c, built), column);
  if (flows) fill_errors(c, n, flow, errors);
  rot_status status = outcome.info.status;
  if (status == ROT_OK && at_events.rows.count) {
    status = ffi_guarded(&run.guard, take_event_rows, &at_events, NULL);
  }
  rot_event_rows_free(&at_events.rows);
  run.info = outcome.info;
  run.events = outcome.events;
  run.beyond = isinf(outcome.error) && outcome.info.status == ROT_OK;
  SEXP out = PROTECT(ffi_run_end(&run, status));
  UNPROTECT(2);
  return out;
}

/* ---- the most common run in one call --------------------------------------------------------- */

enum { QUICK_ROWS = 100000 }; /* longer runs show their progress */

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

/* 1 if all bodies in x have errors at rounding level. */
static int is_sure(SEXP x) {
  if (TYPEOF(x) != VECSXP) return 1;
  if (Rf_isObject(x)) {
    SEXP error = ffi_element(x, "error");
    return TYPEOF(error) != REALSXP || XLENGTH(error) != 1 || !(*REAL_RO(error) > 1e-14);
  }
  R_xlen_t i = 0;
  while (i < XLENGTH(x) && is_sure(VECTOR_ELT(x, i))) i++;
  return i == XLENGTH(x);
}

static int sure_bodies(const rot_maker *maker, SEXP scene) {
  size_t i = 0;
  while (i < maker->n_inputs && (!(maker->inputs[i].kinds & ROT_INPUT_BODY) ||
                                 is_sure(ffi_element(scene, maker->inputs[i].name)))) {
    i++;
  }
  return i == maker->n_inputs;
}

/* => list(model, run) by the cheapest model, if that is a closed form for the unchanged scene,
 * without index columns, with errors of run and bodies at rounding level. NULL in all other cases,
 * which R handles. */
SEXP ffi_scene_quick(SEXP id, SEXP form, SEXP scene, SEXP time_s, SEXP accuracy) {
  const rot_constraint *c = ffi_constraint(id);
  if (c->index || !Rf_isNull(fault_of_scene(c, form, scene))) return R_NilValue;
  if (!sure_bodies(maker_of(c, scene), scene)) return R_NilValue;
  const void *built = ffi_scene_build(c, scene);
  if (!quick_times(c, built, time_s)) return R_NilValue;
  const rot_task task = {.n = (size_t)XLENGTH(time_s),
                         .time_s = REAL_RO(time_s),
                         .accuracy = ffi_real(accuracy, "accuracy"),
                         .max_steps = 1000000};
  const rot_query query = {task.n, task.time_s, task.accuracy, 0.0};
  rot_candidate picked[ROT_MAX_MODELS];
  if (!rot_choice_pick(c, built, &query, picked) || picked[0].dropped) return R_NilValue;
  const rot_model *model = picked[0].model;
  if (model->error_kind != ROT_BOUND || model->use != ROT_FREELY) return R_NilValue;
  void *column[ROT_MAX_COLUMNS] = {NULL};
  ffi_run run;
  ffi_run_begin(&run, R_NilValue);
  const shown shows = shown_by(c, built);
  new_columns(&run, &shows, time_s, 1, column);
  for (size_t i = 0; i < c->n_columns && !c->shows; i++) {
    if (!column[i]) column[i] = R_alloc((size_t)XLENGTH(time_s) + 1, sizeof(double));
  }
  rot_rows rows = {.column = column, .events = &run.events};
  const rot_model_run *of = &c->runs[model - c->models];
  const rot_status status = of->run(built, &task, of->method, &rows, &run.guard.hooks, &run.info);
  const double error = rot_info_error(&run.info);
  int plain = status == ROT_OK && error <= 1e-13 && error <= task.accuracy;
  for (size_t i = 0; i < c->n_columns; i++) {
    if (!c->columns[i].flag && shows.is[i]) plain &= rot_all_finite(task.n, column[i]);
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

/* => list(value, explained, balance, role, words) of terms; `explained` of balances; words NA: the
 * scene has no such term. first, last: columns at two times, with all rows of that time; flow,
 * flow_error: between them; error: of the measures. */
SEXP ffi_scene_audit(SEXP id, SEXP scene, SEXP time_s, SEXP first, SEXP last, SEXP flow,
                     SEXP flow_error, SEXP error) {
  static const char *const names[] = {"value", "explained", "balance", "role", "words", ""};
  const rot_constraint *c = ffi_constraint(id);
  const void *built = ffi_scene_build(c, scene);
  const R_xlen_t cells = (R_xlen_t)(c->n_columns * rot_run_rows_per_time(c, built));
  const R_xlen_t flows = (R_xlen_t)c->n_flows, terms = (R_xlen_t)c->n_terms;
  const double *t = ffi_reals(time_s, "time_s", 2);
  const rot_span span = {{t[0], t[1]},
                         ffi_reals(first, "first", cells),
                         ffi_reals(last, "last", cells),
                         ffi_reals(flow, "flow", flows),
                         ffi_reals(flow_error, "flow_error", flows),
                         ffi_reals(error, "error", -1)};
  double term[ROT_MAX_TERMS], explained[ROT_MAX_BALANCES];
  const char *words[ROT_MAX_TERMS];
  if (rot_run_audit(c, built, &span, term, explained) != ROT_OK) Rf_error("out of memory");
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), balance, role;
  SET_VECTOR_ELT(out, 0, ffi_numbers((int)terms, term));
  SET_VECTOR_ELT(out, 1, ffi_numbers((int)c->n_balances, explained));
  SET_VECTOR_ELT(out, 2, balance = Rf_allocVector(INTSXP, terms));
  SET_VECTOR_ELT(out, 3, role = Rf_allocVector(INTSXP, terms));
  for (R_xlen_t i = 0; i < terms; i++) {
    INTEGER(balance)[i] = (int)c->terms[i].balance + 1;
    INTEGER(role)[i] = (int)c->terms[i].role + 1;
    words[i] = rot_run_term_words(c, built, (size_t)i);
  }
  SET_VECTOR_ELT(out, 4, texts(c->n_terms, words));
  UNPROTECT(1);
  return out;
}

/* => list(conserved, why, about, unit) of balances and other conserved quantities; a balance of
 * unknown conservation is FALSE */
SEXP ffi_scene_conserved(SEXP id, SEXP scene) {
  static const char *const names[] = {"conserved", "why", "about", "unit", ""};
  const rot_constraint *c = ffi_constraint(id);
  const void *built = ffi_scene_build(c, scene);
  const size_t n = named_by(c);
  const char *about[ROT_MAX_BALANCES], *unit[ROT_MAX_BALANCES];
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), kept, reason;
  SET_VECTOR_ELT(out, 0, kept = Rf_allocVector(LGLSXP, (R_xlen_t)n));
  SET_VECTOR_ELT(out, 1, reason = Rf_allocVector(STRSXP, (R_xlen_t)n));
  for (size_t i = 0; i < n; i++) {
    const char *why[ROT_MAX_CAUSES];
    size_t causes = 1;
    why[0] = "";
    if (i < kept_by(c)) causes = c->conserved(built, i, why);
    char text[512];
    int used = snprintf(text, sizeof text, "%s", why[0]);
    for (size_t k = 1; k < causes; k++) {
      used += snprintf(text + used, sizeof text - (size_t)used, "; %s", why[k]);
    }
    LOGICAL(kept)[i] = causes == 0;
    SET_STRING_ELT(reason, (R_xlen_t)i, Rf_mkChar(text));
    about[i] = c->balances[i].about;
    unit[i] = c->balances[i].unit;
  }
  SET_VECTOR_ELT(out, 2, texts(n, about));
  SET_VECTOR_ELT(out, 3, texts(n, unit));
  UNPROTECT(1);
  return out;
}

/* => list(breaks_s, fades_s, swing_rad_per_s) */
SEXP ffi_scene_time_scales(SEXP id, SEXP scene, SEXP sizes) {
  static const char *const names[] = {"breaks_s", "fades_s", "swing_rad_per_s", ""};
  const rot_constraint *c = ffi_constraint(id);
  const void *built = ffi_scene_build(c, scene);
  const double *breaks_s = NULL;
  size_t n = 0;
  rot_time_scales time_scales;
  c->time_scales(built, ffi_reals(sizes, "sizes", -1), &time_scales);
  if (c->breaks) breaks_s = c->breaks(built, &n);
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  double *to = ffi_new_double(out, 0, (R_xlen_t)n);
  if (n) memcpy(to, breaks_s, n * sizeof *to);
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal(time_scales.fades_s));
  SET_VECTOR_ELT(out, 2, Rf_ScalarReal(time_scales.swing_rad_per_s));
  UNPROTECT(1);
  return out;
}
