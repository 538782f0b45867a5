/* For R: the choice of a model. */
#include "glue/run.h"
#include "glue/scene.h"

#include <math.h>
#include <string.h>

#include "scene/choice.h"
#include "scene/run.h"

/* ---- questions ------------------------------------------------------------------------------- */

typedef struct question {
  const rot_constraint *constraint;
  const void *scene;
  rot_query query;
} question;

static void read_question(SEXP id, SEXP scene, SEXP time_s, SEXP accuracy, SEXP law_s,
                          question *q) {
  q->constraint = ffi_constraint(id);
  q->query = (rot_query){(size_t)XLENGTH(time_s), ffi_reals(time_s, "time_s", -1),
                         ffi_real(accuracy, "accuracy"), ffi_real(law_s, "law_s")};
  q->scene = ffi_scene_build(q->constraint, scene);
}

/* ---- answers --------------------------------------------------------------------------------- */

static const char *kind_text(const rot_model *model) {
  return model->error_kind == ROT_BOUND ? "bound" : "estimate";
}

/* bits of effects => their names */
static SEXP effect_names(const rot_constraint *constraint, unsigned effects) {
  R_xlen_t n = 0;
  for (size_t i = 0; i < constraint->n_effects; i++) n += effects >> i & 1u;
  SEXP out = PROTECT(Rf_allocVector(STRSXP, n));
  for (size_t i = constraint->n_effects; i-- > 0;) {
    if (effects >> i & 1u) SET_STRING_ELT(out, --n, Rf_mkChar(constraint->effects[i].name));
  }
  UNPROTECT(1);
  return out;
}

/* candidate => NULL, or list(effects, until_s, errors, error, each) of the effects left out */
static SEXP dropped_list(const rot_constraint *constraint, const rot_candidate *c) {
  static const char *const names[] = {"effects", "until_s", "errors", "error", "each", ""};
  size_t n_measures = 0;
  if (!c->dropped) return R_NilValue;
  while (constraint->measures[n_measures]) n_measures++;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SEXP effects = effect_names(constraint, c->untaken), each;
  SET_VECTOR_ELT(out, 0, effects);
  SET_VECTOR_ELT(out, 1, Rf_ScalarReal(c->drop.until_s));
  SET_VECTOR_ELT(out, 2, ffi_named(n_measures, constraint->measures, c->drop.bound));
  SET_VECTOR_ELT(out, 3, Rf_ScalarReal(c->drop.error));
  SET_VECTOR_ELT(out, 4, each = Rf_allocVector(REALSXP, XLENGTH(effects)));
  Rf_setAttrib(each, R_NamesSymbol, effects);
  for (size_t i = 0, k = 0; i < constraint->n_effects; i++) {
    if (c->untaken >> i & 1u) REAL(each)[k++] = c->drop.each[i];
  }
  UNPROTECT(1);
  return out;
}

/* => why a candidate does not take the scene unchanged; NA if it does */
static SEXP reason_text(const rot_constraint *constraint, const rot_candidate *c) {
  char text[1024];
  rot_choice_reason(constraint, c, sizeof text, text);
  return *text ? Rf_mkChar(text) : NA_STRING;
}

/* ---- entries --------------------------------------------------------------------------------- */

/* constraint => description of each effect, named; with a scene: names of the effects in it */
SEXP ffi_choice_effects(SEXP constraint, SEXP scene) {
  question q;
  if (!Rf_isNull(scene)) {
    SEXP one = PROTECT(Rf_ScalarReal(1.0));
    read_question(constraint, scene, one, one, one, &q);
    UNPROTECT(1);
    return effect_names(q.constraint, q.constraint->effects_of(q.scene));
  }
  const rot_constraint *of = ffi_constraint(constraint);
  SEXP out = PROTECT(Rf_allocVector(STRSXP, (R_xlen_t)of->n_effects));
  for (size_t i = 0; i < of->n_effects; i++) {
    SET_STRING_ELT(out, (R_xlen_t)i, Rf_mkChar(of->effects[i].words));
  }
  Rf_setAttrib(out, R_NamesSymbol, effect_names(of, (1u << of->n_effects) - 1u));
  UNPROTECT(1);
  return out;
}

/* => list of all models of the core, a column for each field */
SEXP ffi_choice_models(void) {
  static const char *const names[] = {"model",    "constraint", "error", "error_kind",
                                      "on_trial", "why",        "takes", ""};
  static const SEXPTYPE types[] = {STRSXP, STRSXP, REALSXP, STRSXP, LGLSXP, STRSXP, VECSXP};
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  R_xlen_t rows = 0, row = 0;
  for (size_t i = 0; i < n; i++) rows += (R_xlen_t)list[i]->n_models;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), c[7];
  for (int i = 0; i < 7; i++) SET_VECTOR_ELT(out, i, c[i] = Rf_allocVector(types[i], rows));
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < list[i]->n_models; k++, row++) {
      const rot_model *model = &list[i]->models[k];
      SET_STRING_ELT(c[0], row, Rf_mkChar(model->id));
      SET_STRING_ELT(c[1], row, Rf_mkChar(list[i]->id));
      REAL(c[2])[row] = model->promise;
      SET_STRING_ELT(c[3], row, Rf_mkChar(kind_text(model)));
      LOGICAL(c[4])[row] = model->use == ROT_ON_TRIAL;
      SET_STRING_ELT(c[5], row, Rf_mkChar(model->why));
      SET_VECTOR_ELT(c[6], row, effect_names(list[i], model->takes));
    }
  }
  UNPROTECT(1);
  return out;
}

/* => list of the candidates, cheapest first, a column for each field: see R/choice.R. Those on
 * trial run. */
SEXP ffi_choice_table(SEXP constraint, SEXP scene, SEXP time_s, SEXP accuracy, SEXP law_s) {
  enum { FIELDS = 8 };
  static const char *const names[] = {
      "model", "applies", "error", "error_kind", "cost_s", "chosen", "reason", "dropped", ""};
  static const SEXPTYPE types[] = {STRSXP,  LGLSXP, REALSXP, STRSXP,
                                   REALSXP, LGLSXP, STRSXP,  VECSXP};
  question q;
  rot_candidate all[ROT_MAX_MODELS];
  read_question(constraint, scene, time_s, accuracy, law_s, &q);
  const rot_task task = {.n = q.query.n,
                         .time_s = q.query.time_s,
                         .accuracy = q.query.accuracy,
                         .max_steps = 1000000 + q.query.n};
  size_t n;
  const size_t chosen = rot_run_candidates(q.constraint, q.scene, &task, q.query.law_s, all, &n);
  char text[1024];
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), c[FIELDS];
  for (int i = 0; i < FIELDS; i++) {
    SET_VECTOR_ELT(out, i, c[i] = Rf_allocVector(types[i], (R_xlen_t)n));
  }
  for (size_t i = 0; i < n; i++) {
    const R_xlen_t row = (R_xlen_t)i;
    SET_STRING_ELT(c[0], row, Rf_mkChar(all[i].model->id));
    LOGICAL(c[1])[i] = all[i].applies;
    REAL(c[2])[i] = all[i].error;
    SET_STRING_ELT(c[3], row, Rf_mkChar(kind_text(all[i].model)));
    REAL(c[4])[i] = all[i].cost_s;
    LOGICAL(c[5])[i] = i == chosen;
    rot_run_reason(q.constraint, n, all, chosen, i, sizeof text, text);
    SET_STRING_ELT(c[6], row, Rf_mkChar(text));
    SET_VECTOR_ELT(c[7], row, dropped_list(q.constraint, &all[i]));
  }
  UNPROTECT(1);
  return out;
}

/* => list(model, dropped, applies, reason): see R/choice.R. `model`: NULL, or a required model. */
SEXP ffi_choice_pick(SEXP constraint, SEXP scene, SEXP time_s, SEXP accuracy, SEXP law_s,
                     SEXP model) {
  static const char *const names[] = {"model", "dropped", "applies", "reason", ""};
  question q;
  rot_candidate picked[ROT_MAX_MODELS];
  size_t n = 1;
  read_question(constraint, scene, time_s, accuracy, law_s, &q);
  if (Rf_isNull(model)) {
    n = rot_choice_pick(q.constraint, q.scene, &q.query, picked);
  } else {
    const rot_model *of = rot_choice_model(q.constraint, ffi_text(model, "model"));
    if (!of) Rf_error("internal: no such model");
    rot_choice_judge(q.constraint, of, q.scene, &q.query, picked);
  }
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), ids, dropped;
  SET_VECTOR_ELT(out, 0, ids = Rf_allocVector(STRSXP, (R_xlen_t)n));
  SET_VECTOR_ELT(out, 1, dropped = Rf_allocVector(VECSXP, (R_xlen_t)n));
  for (size_t i = 0; i < n; i++) {
    SET_STRING_ELT(ids, (R_xlen_t)i, Rf_mkChar(picked[i].model->id));
    SET_VECTOR_ELT(dropped, (R_xlen_t)i, dropped_list(q.constraint, &picked[i]));
  }
  const int applies = n > 0 && picked[0].applies;
  SET_VECTOR_ELT(out, 2, Rf_ScalarLogical(applies));
  if (n > 0 && !applies) {
    SET_VECTOR_ELT(out, 3, Rf_ScalarString(reason_text(q.constraint, picked)));
  }
  UNPROTECT(1);
  return out;
}
