#include "scene/choice.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene/axle/models.h"
#include "scene/chain/chain.h"
#include "scene/clutch/models.h"
#include "scene/drive/models.h"
#include "scene/equations/equations.h"
#include "scene/free/models.h"
#include "scene/hoop/hoop.h"
#include "scene/incline/models.h"
#include "scene/pivot/models.h"
#include "scene/shaft/models.h"

/* All constraints. */
static const rot_constraint *const constraints[] = {
    &rot_axle_constraint,      &rot_shaft_constraint,   &rot_clutch_constraint,
    &rot_drive_constraint,     &rot_incline_constraint, &rot_free_constraint,
    &rot_pivot_constraint,     &rot_hoop_constraint,    &rot_chain_constraint,
    &rot_equations_constraint,
};

const rot_constraint *const *rot_choice_constraints(size_t *n) {
  *n = sizeof constraints / sizeof *constraints;
  return constraints;
}

const rot_constraint *rot_choice_constraint(const char *id) {
  for (size_t i = 0; i < sizeof constraints / sizeof *constraints; i++) {
    if (!strcmp(constraints[i]->id, id)) return constraints[i];
  }
  return NULL;
}

const rot_model *rot_choice_model(const rot_constraint *constraint, const char *id) {
  for (size_t i = 0; i < constraint->n_models; i++) {
    if (!strcmp(constraint->models[i].id, id)) return &constraint->models[i];
  }
  return NULL;
}

/* ---- one model ------------------------------------------------------------------------------- */

/* (model, scene, effects) => candidate, without dropping effects and without predicted time; asks
 * 0: without the model's own reason. A NaN accuracy compares false: no model reaches it. */
static void judge(const rot_constraint *constraint, const rot_model *model, unsigned effects,
                  const void *scene, const rot_query *query, int asks, rot_candidate *out) {
  out->model = model;
  out->untaken = effects & ~model->takes;
  out->dropped = 0;
  out->drop.error = INFINITY;
  out->drop.why_not = NULL;
  out->why_not = asks && !out->untaken && model->why_not ? model->why_not(scene, query) : NULL;
  out->cost_s = NAN;
  out->error = model->promise;
  if (model->error_kind == ROT_ADAPTIVE && query->accuracy > out->error) {
    out->error = query->accuracy;
  }
  if (constraint->bound && !out->untaken && !out->why_not && out->error <= query->accuracy) {
    out->error = fmax(out->error, constraint->bound(model, scene, query));
  }
  out->applies = !out->untaken && !out->why_not &&
                 (out->error <= query->accuracy || model->use == ROT_BY_NAME);
}

static unsigned droppable(const rot_constraint *constraint) {
  unsigned mask = 0;
  for (size_t i = 0; i < constraint->n_effects; i++) {
    if (constraint->effects[i].droppable) mask |= 1u << i;
  }
  return mask;
}

static int may_drop(const rot_constraint *constraint, const rot_candidate *c) {
  return c->untaken && c->model->error_kind == ROT_BOUND && constraint->drop &&
         !(c->untaken & ~droppable(constraint));
}

static void try_without(const rot_constraint *constraint, const void *scene, const rot_query *query,
                        double worst, rot_candidate *c) {
  constraint->drop(scene, c->model, c->untaken, query, worst, &c->drop);
  c->dropped = c->applies =
      !c->drop.why_not && c->drop.error + c->model->promise <= query->accuracy;
  if (c->applies) c->error = c->drop.error + c->model->promise;
}

void rot_choice_judge(const rot_constraint *constraint, const rot_model *model, const void *scene,
                      const rot_query *query, rot_candidate *out) {
  judge(constraint, model, constraint->effects_of(scene), scene, query, 1, out);
  out->cost_s = model->cost_s(model, scene, query);
  if (may_drop(constraint, out)) try_without(constraint, scene, query, INFINITY, out);
}

void rot_choice_judge_named(const rot_constraint *constraint, const rot_model *model,
                            const void *scene, const rot_query *query, rot_candidate *out) {
  const int asks = !(constraint->run_tells >> (model - constraint->models) & 1u);
  judge(constraint, model, constraint->effects_of(scene), scene, query, asks, out);
  if (may_drop(constraint, out)) try_without(constraint, scene, query, INFINITY, out);
}

/* ---- all models ------------------------------------------------------------------------------ */

/* scene => candidates in the order of the table, without dropping effects; returns 1 if a model
 * with a proven bound applies. */
static int judge_all(const rot_constraint *constraint, const void *scene, const rot_query *query,
                     rot_candidate out[]) {
  const unsigned effects = constraint->effects_of(scene);
  int bounded = 0;
  for (size_t i = 0; i < constraint->n_models; i++) {
    judge(constraint, &constraint->models[i], effects, scene, query, 1, &out[i]);
    out[i].cost_s = out[i].model->cost_s(out[i].model, scene, query);
    if (out[i].applies && out[i].model->use == ROT_BY_NAME) {
      out[i].applies = 0;
      out[i].why_not = "it runs only where it is named";
    }
    bounded |= out[i].applies && out[i].model->error_kind == ROT_BOUND &&
               out[i].model->use != ROT_ON_TRIAL;
  }
  return bounded;
}

/* order[k]: index of the k-th cheapest; equal and NaN costs keep the order of the table. */
static void order_by_cost(size_t n, const rot_candidate c[], size_t order[]) {
  for (size_t i = 0; i < n; i++) {
    size_t j = i;
    for (; j > 0 && c[i].cost_s < c[order[j - 1]].cost_s; j--) order[j] = order[j - 1];
    order[j] = i;
  }
}

size_t rot_choice_candidates(const rot_constraint *constraint, const void *scene,
                             const rot_query *query, rot_candidate out[ROT_MAX_MODELS]) {
  const size_t n = constraint->n_models;
  rot_candidate all[ROT_MAX_MODELS];
  size_t order[ROT_MAX_MODELS];
  const int bounded = judge_all(constraint, scene, query, all);
  order_by_cost(n, all, order);
  for (size_t i = 0; i < n; i++) {
    out[i] = all[order[i]];
    if (!bounded && may_drop(constraint, &out[i])) {
      try_without(constraint, scene, query, INFINITY, &out[i]);
    }
  }
  return n;
}

size_t rot_choice_pick(const rot_constraint *constraint, const void *scene, const rot_query *query,
                       rot_candidate out[ROT_MAX_MODELS]) {
  const size_t n = constraint->n_models;
  rot_candidate all[ROT_MAX_MODELS];
  size_t order[ROT_MAX_MODELS], picked = 0;
  const int bounded = judge_all(constraint, scene, query, all);
  order_by_cost(n, all, order);
  for (size_t i = 0; i < n; i++) {
    rot_candidate *c = &all[order[i]];
    if (!bounded && may_drop(constraint, c)) {
      try_without(constraint, scene, query, query->accuracy - c->model->promise, c);
    }
    if (!c->applies) continue;
    out[picked++] = *c;
    if (c->model->use != ROT_ON_TRIAL) break;
  }
  return picked;
}

/* ---- words ----------------------------------------------------------------------------------- */

typedef struct writer {
  size_t size, used;
  char *text;
} writer;

static void append(writer *w, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (w->used < w->size) {
    const int length = vsnprintf(w->text + w->used, w->size - w->used, format, arguments);
    if (length > 0) w->used += (size_t)length;
  }
  va_end(arguments);
}

static void append_effects(writer *w, const rot_constraint *constraint, unsigned effects) {
  unsigned hidden = 0;
  size_t left = 0;
  for (size_t i = 0; i < constraint->n_effects; i++) {
    if (effects >> i & 1u) hidden |= constraint->effects[i].implies;
  }
  effects &= ~hidden;
  for (size_t i = 0; i < constraint->n_effects; i++) left += effects >> i & 1u;
  for (size_t i = 0; i < constraint->n_effects; i++) {
    if (!(effects >> i & 1u)) continue;
    append(w, "%s%s", constraint->effects[i].words, left > 2 ? ", " : left == 2 ? " and " : "");
    left--;
  }
}

void rot_choice_effects(const rot_constraint *constraint, unsigned effects, size_t size,
                        char text[]) {
  writer w = {size, 0, text};
  append(&w, "%s", "");
  append_effects(&w, constraint, effects);
}

void rot_choice_reason(const rot_constraint *constraint, const rot_candidate *c, size_t size,
                       char text[]) {
  writer w = {size, 0, text};
  append(&w, "%s", "");
  if (c->applies && c->dropped) {
    const char *before = "";
    for (size_t i = 0; i < constraint->n_effects; i++) {
      if (!(c->untaken >> i & 1u)) continue;
      append(&w, "%s%s ignored: it changes omega by at most %.2g of its maximum", before,
             constraint->effects[i].words, c->drop.each[i]);
      before = "; ";
    }
  } else if (c->untaken) {
    append(&w, "it does not take ");
    append_effects(&w, constraint, c->untaken);
    if (c->drop.error < INFINITY) {
      append(&w, ", and without %s the error could be %.2g",
             c->untaken & (c->untaken - 1) ? "them" : "it", c->drop.error);
    }
  } else if (c->why_not) {
    append(&w, "%s", c->why_not);
  } else if (!c->applies) {
    append(&w, "its error of %.2g exceeds the accuracy asked", c->error);
  }
}
