/* What a constraint says of itself: its inputs and how a scene is built of them, its columns, and
 * its effects and models, for the choice among them (scene/choice.h) and their runs
 * (scene/run.h). */
#ifndef ROT_MODEL_H
#define ROT_MODEL_H

#include "engine/events.h"
#include "engine/input.h"

enum { ROT_MOST_EFFECTS = 16, ROT_MOST_MODELS = 16, ROT_MOST_COLUMNS = 32 };

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

/* A run: rows at n times, not decreasing, of an error, in a number of steps. */
typedef struct rot_task {
  size_t n;
  const double *time_s;
  double accuracy;
  size_t max_steps;  /* of an integrator */
  double resolution; /* of changes of a law that is called: see engine/ode/params.h; 0: as there */
  int asked;         /* the caller named the model: it does not switch to another */
} rot_task;

/* A column of the rows: doubles, or flags (int). */
typedef struct rot_column_of {
  const char *name;
  int flag;
  unsigned only_with; /* 0: always; else with one of these effects alone */
} rot_column_of;

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

/* How a model is run. A run that ended by the steps of `method` ended as this model. `column`: one
 * for each of the constraint's, of n values. */
typedef struct rot_model_run {
  rot_method method;
  rot_status (*run)(const void *scene, const rot_task *task, rot_method method,
                    void *const column[], rot_events *events, const rot_hooks *hooks,
                    rot_info *info);
} rot_model_run;

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
  /* What follows is 0 where the core does not build scenes of the constraint yet. */
  const char *constructor; /* of its scenes, as users call it */
  size_t n_inputs, n_columns;
  const rot_input *inputs;
  const rot_column_of *columns; /* in the order of rot_model.run */
  const rot_model_run *runs;    /* one for each model */
  size_t scene_size;
  /* From inputs that rot_inputs_check() passed, which must live as long as the scene. */
  rot_status (*build)(const rot_given given[], void *scene, rot_refusal *refusal);
  double (*start_s)(const void *scene);
} rot_constraint;

#endif
