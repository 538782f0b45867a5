/* What a constraint says of itself: its inputs and how a scene is built of them, its columns, its
 * effects and models, for the choice among them (scene/choice.h) and their runs (scene/run.h), and
 * its balances. */
#ifndef ROT_MODEL_H
#define ROT_MODEL_H

#include <stdint.h>

#include "engine/batch.h"
#include "engine/events.h"
#include "engine/input.h"
#include "engine/resistance.h"
#include "ground/store.h"

enum { ROT_MAX_EFFECTS = 16, ROT_MAX_MODELS = 16, ROT_MAX_COLUMNS = 64 };

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
  double bound[ROT_MAX_MEASURES]; /* absolute, of each measure */
  double error;                   /* the worst, relative to the size of the motion */
  double each[ROT_MAX_EFFECTS];   /* of omega, relative, effect by effect */
  const char *why_not;            /* the model's reason against the scene without them, or NULL */
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
  size_t max_steps;   /* of an integrator */
  double resolution;  /* of changes of a law that is called: see engine/ode/params.h; 0: as there */
  int asked;          /* the caller named the model: it does not switch to another */
  double step_s;      /* of a model with steps of fixed length; 0: its own choice */
  unsigned without;   /* effects that the run leaves out; the torques of its rows have them */
  int sizes_only;     /* only the size of the motion is asked for: no errors, where they cost */
  int flows_of_whole; /* the flows are those of all effects, too; else of those that are solved */
} rot_task;

/* The method of a run: the integrator's own choice, unless the caller named the model or its steps
 * are of fixed length. */
static inline rot_method rot_task_method(const rot_task *task, rot_method method) {
  const int chosen = method == ROT_METHOD_RK8PD || method == ROT_METHOD_RADAU;
  return task->asked || !chosen ? method : ROT_METHOD_NONE;
}

/* A column of the rows: doubles, or flags (int). */
typedef struct rot_column_of {
  const char *name;
  int flag; /* 1, 0, or below 0: it means nothing in this row */
  /* 0: always; else with one of these effects alone, if shows() agrees; ROT_AS_SHOWN: as that
   * says. */
  unsigned only_with;
  const char *unit; /* NULL: as the dictionary of R has it */
  size_t measure;   /* 1 + the measure that it holds; 0: none. These are the state. */
  size_t flow;      /* 1 + the flow that it adds up, with whose error; 0: none */
} rot_column_of;

#define ROT_AS_SHOWN (~0u)

/* Of doubles, in all rows; measure: as there. */
#define ROT_COLUMN(name, unit, measure)                                                            \
  { name, 0, 0, unit, measure, 0 }

/* Where a run writes; n rows, times their copies. */
typedef struct rot_rows {
  void *const *column; /* one for each of the constraint's, of n values */
  /* Doubles from column[0] on where all columns lie one after another, none NULL, all numbers set;
   * 0: they do not. */
  size_t cells;
  /* One for each of its flows, since the start or since the first row: their differences count.
   * NULL: not wanted. */
  double *const *flow;
  double *flow_error; /* of each flow, absolute; NULL where `flow` is */
  rot_events *events;
  rot_event_rows *at_events; /* takes columns, then flows; NULL: not wanted */
} rot_rows;

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

/* How a model is run. A run that ended by the steps of `method` ended as this model. */
typedef struct rot_model_run {
  rot_method method;
  rot_status (*run)(const void *scene, const rot_task *task, rot_method method,
                    const rot_rows *rows, const rot_hooks *hooks, rot_info *info);
} rot_model_run;

/* ---- balances -------------------------------------------------------------------------------- */

enum { ROT_MAX_FLOWS = 16, ROT_MAX_TERMS = 24, ROT_MAX_BALANCES = 8, ROT_MAX_CAUSES = 8 };

/* change = supplied - dissipated, of one quantity; `about`: the point or axis of a momentum. */
typedef struct rot_balance {
  const char *quantity, *about, *unit;
} rot_balance;

typedef enum rot_role { ROT_SUPPLIED, ROT_DISSIPATED, ROT_CHANGE } rot_role;

typedef struct rot_balance_term {
  size_t balance;
  rot_role role;
  const char *words;
  unsigned only_with; /* as of columns */
} rot_balance_term;

/* Two rows of a motion, and what flowed between them. */
typedef struct rot_span {
  double time_s[2];
  const double *first, *last; /* by column, each with its copies */
  const double *flow, *flow_error;
  const double *error; /* of the measures, absolute */
} rot_span;

/* Numbers of a built scene that follow from its inputs, or an input that may be left out. */
typedef struct rot_derived {
  const char *name;
  size_t offset, n; /* n doubles, in the scene; n = 0: a pointer to one for each copy */
} rot_derived;

/* A constructor of scenes: its inputs, and what follows from them. */
typedef struct rot_maker {
  const char *constructor; /* as users call it */
  size_t n_inputs;
  const rot_input *inputs;
  /* From inputs that rot_inputs_check() passed, which must live as long as the scene, as what it
   * takes from the store. */
  rot_status (*build)(const rot_given given[], rot_store *store, void *scene, rot_refusal *refusal);
  size_t n_derived;
  const rot_derived *derived;
} rot_maker;

/* How fast a motion goes: the shortest time in which a transient fades (Inf: none), the fastest
 * swing. */
typedef struct rot_time_scales {
  double fades_s, swing_rad_per_s;
} rot_time_scales;

/* Of these times, those in which the slowest transients fade, too. */
#define ROT_SETTLED 1e6

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
  size_t n_makers, n_columns;
  const rot_maker *makers;      /* all make scenes of scene_size */
  const rot_column_of *columns; /* in the order of rot_model.run */
  const rot_model_run *runs;    /* one for each model */
  /* Mask of models whose run fails, without a row, where why_not() has a reason: a run of such a
   * model that is named asks for the reason after a failure alone. */
  unsigned run_tells;
  size_t scene_size;
  double (*start_s)(const void *scene);
  const char *index; /* of the rows at one time, a column of R's from 1 on; NULL: one row a time */
  const char *between; /* what couples these copies, for the places of events; NULL: no such */
  size_t (*rows_per_time)(const void *scene); /* how many these are; NULL: 1 */
  size_t n_flows, n_balances, n_terms;
  const char *const *flows; /* names */
  const rot_balance *balances;
  /* Those of which keeps() knows: the first balances, or all of them and more; 0: n_balances. */
  size_t n_kept;
  const rot_balance_term *terms;
  /* The terms between two rows, each a smooth function of state and flows: what their errors
   * explain is found by moving them (scene/run.h). */
  void (*audit)(const void *scene, const rot_span *span, double term[]);
  /* NULL, or what errors explain of each balance, where they are known better than so. */
  void (*explain)(const void *scene, const rot_span *span, const double term[], double explained[]);
  /* How many causes change the quantity of a balance, and which; 0: it is conserved, and why. */
  size_t (*conserved)(const void *scene, size_t balance, const char *why[ROT_MAX_CAUSES]);
  void (*time_scales)(const void *scene, const double sizes[],
                      rot_time_scales *time_scales); /* sizes of measures */
  /* NULL, or the times where what acts jumps or kinks, increasing, beside those of its inputs. */
  const double *(*breaks)(const void *scene, size_t *n);
  int event_rows;  /* its runs fill rot_rows.at_events */
  unsigned events; /* that its runs may log: a mask of 1 << rot_event */
  /* NULL, or which columns the rows of a scene have, if they have the effects of `only_with`:
   * column i is bit i. Columns without `only_with` are always among them. */
  uint64_t (*shows)(const void *scene);
  /* NULL, or the words of a term in this scene; NULL: it has no such term. */
  const char *(*term_words)(const void *scene, size_t term);
  /* NULL where no effect may be dropped; else the scene without effects, in the store. */
  rot_status (*reduce)(const void *scene, unsigned without, rot_store *store, void *to);
  /* NULL, or the period of the motion (of the axle's cycle, of a free body's wobble); NaN: none. */
  double (*period_s)(const void *scene);
  const rot_batch *batches; /* kernels of some of its models; NULL: none. Ends with a model NULL. */
} rot_constraint;

#define ROT_COUNT(list) (sizeof(list) / sizeof *(list))

/* The members of a constraint with one constructor. */
#define ROT_MADE_BY(constructor, inputs, n_inputs, build, derived, n_derived)                      \
  .n_makers = 1, .makers = &(const rot_maker) {                                                    \
    constructor, n_inputs, inputs, build, n_derived, derived                                       \
  }

/* The members of a constraint whose parts have these names in its file. */
#define ROT_CONSTRAINT(name, of_measures)                                                          \
  .id = #name, .measures = of_measures, .n_effects = ROT_COUNT(effects), .effects = effects,       \
  .effects_of = effects_of, .n_models = ROT_COUNT(models), .models = models, .runs = runs,         \
  ROT_MADE_BY("scene_" #name, inputs, ROT_COUNT(inputs), build, NULL, 0),                          \
  .scene_size = sizeof(name), .start_s = start_s, .n_columns = ROT_COUNT(columns),                 \
  .columns = columns, .n_flows = ROT_COUNT(flows), .flows = flows,                                 \
  .n_balances = ROT_COUNT(balances), .balances = balances, .n_terms = ROT_COUNT(terms),            \
  .terms = terms, .audit = audit, .conserved = conserved, .time_scales = time_scales

#endif
