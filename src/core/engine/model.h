/* Effects and models of a constraint, for the choice among them (scene/choice.h). */
#ifndef ROT_MODEL_H
#define ROT_MODEL_H

#include "ground/status.h"

enum { ROT_MOST_EFFECTS = 16, ROT_MOST_MODELS = 16 };

/* Effect i is bit 1 << i of a mask. Each constraint has its own list: two may share a name. */
typedef struct rot_effect {
  const char *name, *words;
  int droppable;    /* a bound is known on what it changes */
  unsigned implies; /* effects that need no words beside this one */
} rot_effect;

/* The question: rows at n times (not decreasing), an error, the time of a call of the law. */
typedef struct rot_query {
  size_t n;
  const double *time_s;
  double accuracy;
  double law_s; /* used where the scene has a law that only the caller can evaluate */
} rot_query;

/* Largest change when effects are ignored, up to until_s. Inf: no bound. */
typedef struct rot_drop {
  double until_s;
  double bound[ROT_MOST_MEASURES]; /* absolute, of each measure */
  double error;                    /* the worst, relative to the size of the motion */
  double each[ROT_MOST_EFFECTS];   /* of omega, relative, effect by effect */
  const char *why_not;             /* the model's reason against the scene without them, or NULL */
} rot_drop;

/* An adaptive model's error is an estimate that follows the accuracy asked for. */
typedef enum rot_error_kind { ROT_ESTIMATE, ROT_BOUND, ROT_ADAPTIVE } rot_error_kind;

/* How the choice takes it. On trial: only a run tells its error; it is kept if that is good enough.
 * By name: never, unless the user names it; its promise is not asked then. */
typedef enum rot_model_use { ROT_FREELY, ROT_ON_TRIAL, ROT_BY_NAME } rot_model_use;

typedef struct rot_model {
  const char *id;
  unsigned takes; /* mask of effects */
  rot_error_kind error_kind;
  double promise; /* smallest relative error */
  rot_model_use use;
  const char *why;
  /* NULL: it takes each scene with these effects. Else a reason against this one, or NULL. */
  const char *(*why_not)(const void *scene, const rot_query *query);
  /* Predicted time of a run in seconds; `seconds` are coefficients of it. */
  double (*cost_s)(const struct rot_model *model, const void *scene, const rot_query *query);
  double seconds[4];
} rot_model;

typedef struct rot_constraint {
  const char *id;
  const char *const *measures; /* names; the list ends with NULL */
  size_t n_effects, n_models;
  const rot_effect *effects;
  const rot_model *models;
  unsigned (*effects_of)(const void *scene);
  /* NULL: nothing may be dropped. An error beyond `worst` is of no use to the caller: Inf will
   * do. */
  void (*drop)(const void *scene, const rot_model *model, unsigned effects, const rot_query *query,
               double worst, rot_drop *drop);
  /* NULL, or the bound on a model's error in this scene: of models that leave out what no effect
   * names. 0 for the others, Inf where there is none. */
  double (*bound)(const rot_model *model, const void *scene, const rot_query *query);
} rot_constraint;

#endif
