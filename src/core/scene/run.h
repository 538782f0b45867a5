/* Scenes of any constraint that builds them, by its table (engine/model.h): run by the cheapest
 * model that reaches the accuracy. */
#ifndef ROT_RUN_H
#define ROT_RUN_H

#include "scene/choice.h"

/* A constructor of scenes, and the constraint of these; NULL: there is none of this name. */
const rot_maker *rot_run_maker(const char *constructor, const rot_constraint **of);

/* A scene from inputs, which are checked. */
rot_status rot_run_build(const rot_maker *maker, const rot_given given[], rot_store *store,
                         void *scene, rot_refusal *refusal);

/* Rows of a scene, and what they are worth. Begin with {0}. */
typedef struct rot_outcome {
  const rot_model *model; /* the one that ran; NULL: none was run */
  rot_candidate picked;   /* why */
  rot_info info;
  double error;      /* relative; Inf: a column leaves the doubles; NaN: not known */
  rot_events events; /* to be freed */
} rot_outcome;

typedef enum rot_run_end {
  ROT_RUN_DONE,     /* as info->status says */
  ROT_RUN_NO_MODEL, /* no such model, or it does not take the scene: picked says why */
  ROT_RUN_NONE_FITS /* no model reaches the accuracy */
} rot_run_end;

/* `model`: the name of the one to run, or NULL. `want`: where rows are written, without events; a
 * column that is NULL is not wanted, nor are all where want->column is. A column that the rows of
 * the scene do not have is not written. */
rot_run_end rot_run(const rot_constraint *constraint, const void *scene, const char *model,
                    const rot_task *task, double law_s, const rot_rows *want, rot_outcome *out,
                    const rot_hooks *hooks);

/* One model, whether or not it promises the accuracy. */
void rot_run_model(const rot_constraint *constraint, const void *scene, const rot_model *model,
                   const rot_task *task, const rot_rows *want, rot_outcome *out,
                   const rot_hooks *hooks);

/* Whether the rows of a scene with these effects have a column. */
int rot_run_shows(const rot_constraint *constraint, const void *scene, unsigned effects,
                  size_t column);

/* The words of a term of the balances in a scene; NULL: it has no such term. */
const char *rot_run_term_words(const rot_constraint *constraint, const void *scene, size_t term);

/* Rows at one time. */
size_t rot_run_rows_per_time(const rot_constraint *constraint, const void *scene);

/* The terms of the balances between two rows, and what explains a residual of each: how far the
 * terms move where each number of the state and each flow is off by its error, in sum, and the
 * rounding of the terms. */
rot_status rot_run_audit(const rot_constraint *constraint, const void *scene, const rot_span *span,
                         double term[], double explained[]);

/* The place of a column; constraint->n_columns: there is none of this name. */
size_t rot_run_column(const rot_constraint *constraint, const char *name);

#endif
