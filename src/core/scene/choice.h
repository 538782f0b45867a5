/* Choice of a model: candidates for a scene, their promised errors and predicted times.
 *
 * A model applies if it takes every effect of the scene, has no reason against it and reaches the
 * accuracy. If no model with a proven bound applies, a model may apply to the scene without some
 * effects, if these provably change little enough. The cheapest applicable model is chosen. */
#ifndef ROT_CHOICE_H
#define ROT_CHOICE_H

#include "engine/model.h"

/* The judgement of one model on one scene. */
typedef struct rot_candidate {
  const rot_model *model;
  int applies;         /* 0 or 1 */
  unsigned untaken;    /* mask of the effects that the model does not take */
  int dropped;         /* 1: the model applies without the untaken effects */
  rot_drop drop;       /* error of dropping them; error Inf: not evaluated */
  const char *why_not; /* the model's own reason, or NULL */
  double error;        /* promised, relative */
  double cost_s;       /* predicted time */
} rot_candidate;

/* id => constraint; NULL: no constraint has this id. */
const rot_constraint *rot_choice_constraint(const char *id);
/* => all constraints, their number. */
const rot_constraint *const *rot_choice_constraints(size_t *n);
/* (constraint, id) => model; NULL: no model of the constraint has this id. */
const rot_model *rot_choice_model(const rot_constraint *constraint, const char *id);

/* (model, scene, query) => candidate; effects are dropped if the model applies only without
 * them. */
void rot_choice_judge(const rot_constraint *constraint, const rot_model *model, const void *scene,
                      const rot_query *query, rot_candidate *out);
/* The same for the run of a named model: without predicted time (NaN), and without the reason that
 * the run tells itself (rot_constraint.run_tells). */
void rot_choice_judge_named(const rot_constraint *constraint, const rot_model *model,
                            const void *scene, const rot_query *query, rot_candidate *out);

/* (scene, query) => all models of the constraint, ascending by cost (equal costs: in the order of
 * the table); their number. */
size_t rot_choice_candidates(const rot_constraint *constraint, const void *scene,
                             const rot_query *query, rot_candidate out[ROT_MAX_MODELS]);

/* (scene, query) => the models to run, ascending by cost; their number (0: no model applies). These
 * are the cheapest applicable model that is not on trial, and the cheaper ones on trial. */
size_t rot_choice_pick(const rot_constraint *constraint, const void *scene, const rot_query *query,
                       rot_candidate out[ROT_MAX_MODELS]);

/* mask of effects => text "a, b and c", of at most size - 1 characters. */
void rot_choice_effects(const rot_constraint *constraint, unsigned effects, size_t size,
                        char text[]);
/* candidate => why it does not apply, or which effects were dropped; "" if it takes the scene
 * unchanged. At most size - 1 characters. */
void rot_choice_reason(const rot_constraint *constraint, const rot_candidate *candidate,
                       size_t size, char text[]);

#endif
