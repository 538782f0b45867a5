/* The choice of a model: which models take a scene, their promised errors and predicted times.
 *
 * A model applies if it takes every effect of the scene, has no reason against it and reaches the
 * accuracy. Where no model with a proven bound does, a model may apply to the scene without some
 * effects, if those provably change little enough. The cheapest that applies is chosen. */
#ifndef ROT_CHOICE_H
#define ROT_CHOICE_H

#include "engine/model.h"

typedef struct rot_candidate {
  const rot_model *model;
  int applies;
  unsigned untaken;    /* effects that it does not take */
  int dropped;         /* it can run without these */
  rot_drop drop;       /* set where it was worth a try */
  const char *why_not; /* the model's own reason, or NULL */
  double error;        /* relative, promised */
  double cost_s;       /* predicted time */
} rot_candidate;

/* NULL where there is none of this name. */
const rot_constraint *rot_choice_constraint(const char *id);
const rot_constraint *const *rot_choice_constraints(size_t *n);
const rot_model *rot_choice_model(const rot_constraint *constraint, const char *id);

/* One model on one scene; effects are dropped if need be. */
void rot_choice_judge(const rot_constraint *constraint, const rot_model *model, const void *scene,
                      const rot_query *query, rot_candidate *out);

/* All models of the constraint, cheapest first; models of equal cost as they are listed. */
size_t rot_choice_candidates(const rot_constraint *constraint, const void *scene,
                             const rot_query *query, rot_candidate out[ROT_MAX_MODELS]);

/* The models to run, cheapest first: those on trial that cost less than the first that is not, and
 * that one. 0: none applies. */
size_t rot_choice_pick(const rot_constraint *constraint, const void *scene, const rot_query *query,
                       rot_candidate out[ROT_MAX_MODELS]);

/* Text of at most size - 1 characters. Effects: "a, b and c". Reason: why it does not apply, or
 * what was dropped; empty where it takes the scene unchanged. */
void rot_choice_effects(const rot_constraint *constraint, unsigned effects, size_t size,
                        char text[]);
void rot_choice_reason(const rot_constraint *constraint, const rot_candidate *candidate,
                       size_t size, char text[]);

#endif
