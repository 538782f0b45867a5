/* Runs of scenes of any constraint, by its table (engine/model.h): the cheapest model that reaches
 * the accuracy. */
#ifndef ROT_RUN_H
#define ROT_RUN_H

#include "scene/choice.h"

/* name of a constructor => its table, its constraint; NULL: no constructor has this name. */
const rot_maker *rot_run_maker(const char *constructor, const rot_constraint **of);

/* (constructor, inputs) => checked scene, or a refusal. */
rot_status rot_run_build(const rot_maker *maker, const rot_given given[], rot_store *store,
                         void *scene, rot_refusal *refusal);

/* Result of a run. Initialise `events` with {0}; the rest is filled. */
typedef struct rot_outcome {
  const rot_model *model; /* the model that ran; NULL: none */
  rot_candidate picked;   /* the judgement of that model */
  rot_info info;
  double error;      /* relative; Inf: a column overflows; NaN: unknown */
  rot_events events; /* owned: free with rot_events_free() */
} rot_outcome;

typedef enum rot_run_end {
  ROT_RUN_DONE,     /* see info.status */
  ROT_RUN_NO_MODEL, /* unknown model, or it does not apply (reason: picked) */
  ROT_RUN_NONE_FITS /* no model reaches the accuracy */
} rot_run_end;

/* (scene, task, model) => rows, outcome. `model`: the id of the model to run, without a switch to
 * another if task->asked; NULL: choose. `want`:
 * memory for the rows, without events. A column that is NULL is not returned; want->column NULL: no
 * column is. Columns that the scene does not show are not written. */
rot_run_end rot_run(const rot_constraint *constraint, const void *scene, const char *model,
                    const rot_task *task, double law_s, const rot_rows *want, rot_outcome *out,
                    const rot_hooks *hooks);

/* The same of a model of the constraint, not NULL. */
rot_run_end rot_run_named(const rot_constraint *constraint, const void *scene,
                          const rot_model *model, const rot_task *task, double law_s,
                          const rot_rows *want, rot_outcome *out, const rot_hooks *hooks);

/* (scene, task, model) => rows, outcome, also if the promised error exceeds the accuracy. */
void rot_run_model(const rot_constraint *constraint, const void *scene, const rot_model *model,
                   const rot_task *task, const rot_rows *want, rot_outcome *out,
                   const rot_hooks *hooks);

/* (scene, task) => all models, cheapest first, as rot_choice_candidates(); those on trial have run,
 * and have the errors of their runs. *n: how many. => place of the one that rot_run() takes, or *n
 */
size_t rot_run_candidates(const rot_constraint *constraint, const void *scene, const rot_task *task,
                          double law_s, rot_candidate all[], size_t *n);
/* Why candidate k is chosen, would do, or does not apply. */
void rot_run_reason(const rot_constraint *constraint, size_t n, const rot_candidate all[],
                    size_t chosen, size_t k, size_t size, char text[]);

/* (scene, effects, column) => 1 if rows of the scene show the column, else 0. */
int rot_run_shows(const rot_constraint *constraint, const void *scene, unsigned effects,
                  size_t column);

/* (scene, balance term) => its text; NULL: the scene lacks the term. */
const char *rot_run_term_words(const rot_constraint *constraint, const void *scene, size_t term);

/* scene => number of rows per time (links of a chain: one row each). */
size_t rot_run_rows_per_time(const rot_constraint *constraint, const void *scene);

/* (scene, two rows) => terms of the balances, residual of each balance that is explained by errors.
 * explained[b]: sum over all values of the state and all flows of the change of balance b when the
 * value changes by its error, plus the rounding of the terms. */
rot_status rot_run_audit(const rot_constraint *constraint, const void *scene, const rot_span *span,
                         double term[], double explained[]);

/* (columns of a run, place of a time) => all columns at it, as rot_span has them: rows_per_time
 * values each; NaN for a column that is not shown and a flag that means nothing. */
void rot_run_cells(const rot_constraint *constraint, const void *scene, void *const column[],
                   size_t time, double cell[]);

/* One balance: residual = change - supplied + dissipated. */
typedef struct rot_balance_sums {
  double change, supplied, dissipated, residual, explained;
  int balanced; /* 1: `explained` covers the residual; 0: it does not; -1: not known */
} rot_balance_sums;
/* (terms, explained of all balances) => balance k; sums in long double, as R's sum() */
rot_balance_sums rot_run_balance(const rot_constraint *constraint, const void *scene, size_t k,
                                 const double term[], const double explained[]);

/* name => index of the column; constraint->n_columns: no column has this name. */
size_t rot_run_column(const rot_constraint *constraint, const char *name);

#endif
