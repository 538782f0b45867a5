/* A mechanical system of a few coordinates, integrated: coordinates and their rates are the state,
 * flows (work, heat, impulses) go along. Its laws are the core's own and do not know the time. */
#ifndef ROT_ODE_SYSTEM_H
#define ROT_ODE_SYSTEM_H

#include "engine/dry.h"
#include "engine/ode/fixed.h"

enum { ROT_SYSTEM_MAX = 16 }; /* coordinates */

typedef struct rot_system_state {
  const double *q, *q_low; /* coordinates, and what these doubles lack of the exact sum */
  const double *v;         /* their rates */
  int sign;                /* of the rate, where friction is dry; 0: it is held at rest */
  const double *moved;     /* in a run: coordinates less those of the start */
} rot_system_state;

/* What a run begins with. */
typedef struct rot_system_start {
  size_t n, rows_per_time; /* coordinates; rows at one time */
  const double *q, *v;     /* at start_s */
  double start_s;
  double rounding;    /* of an acceleration: the sum of what acts, without the forces of slopes() */
  const rot_dry *dry; /* friction along one coordinate; NULL: none */
} rot_system_start;

typedef struct rot_system {
  size_t n_flows; /* at most ROT_MOST_FLOWS */
  rot_system_start (*start)(const void *scene);
  /* Slopes of the rates, and of the flows. `forces` are 0; where friction may be dry, those of the
   * one coordinate over its inertia, which are no part of its acceleration. */
  void (*slopes)(const void *scene, const rot_system_state *state, double acceleration[],
                 double flow[], rot_dry_forces *forces);
  void (*row)(const void *scene, const rot_system_state *state, size_t at, void *const column[]);
  void (*time_scales)(const void *scene, const double sizes[], rot_time_scales *time_scales);
} rot_system;

/* Measures: the largest |q|, the largest |v| of all coordinates, as rot_turning. */
rot_status rot_system_run(const rot_system *system, const void *scene, const rot_task *task,
                          rot_method method, const rot_rows *rows, const rot_hooks *hooks,
                          rot_info *info);

/* Predicted time of a run, with the time scales of its start; seconds of the model: of a step, of a
 * row, of each coordinate.
 * Implicit steps do not count what fades. */
double rot_system_cost_s(const rot_system *system, const rot_model *model, const void *scene,
                         const rot_query *query, int implicit);

/* The same of steps of fixed length. */
double rot_system_fixed_s(const rot_system *system, const rot_model *model, const void *scene,
                          const rot_query *query);

/* A constraint `name`, whose parts are as ROT_CONSTRAINT() names them and that the static `system`
 * integrates; its models take the mask of effects. */
#define ROT_SYSTEM_CONSTRAINT(name, system, takes)                                                 \
  ROT_SYSTEM_RUNS(system)                                                                          \
  static const rot_model models[] = {ROT_SYSTEM_MODELS(#name "_", takes)};                         \
  static const rot_model_run runs[] = {ROT_SYSTEM_METHODS};                                        \
  const rot_constraint rot_##name##_constraint = {                                                 \
      ROT_CONSTRAINT(name, rot_turning),                                                           \
      .events = 1u << ROT_EVENT_STICK | 1u << ROT_EVENT_SLIP | 1u << ROT_EVENT_REVERSE}

/* The start, runs and costs of the static `system`, and its models as items of a list. */
#define ROT_SYSTEM_RUNS(system)                                                                    \
  static double start_s(const void *scene) { return system.start(scene).start_s; }                 \
  static rot_status integrate(const void *scene, const rot_task *task, rot_method method,          \
                              const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {      \
    return rot_system_run(&system, scene, task, method, rows, hooks, info);                        \
  }                                                                                                \
  static double explicit_s(const rot_model *model, const void *scene, const rot_query *query) {    \
    return rot_system_cost_s(&system, model, scene, query, 0);                                     \
  }                                                                                                \
  static double fixed_s(const rot_model *model, const void *scene, const rot_query *query) {       \
    return rot_system_fixed_s(&system, model, scene, query);                                       \
  }                                                                                                \
  static double implicit_s(const rot_model *model, const void *scene, const rot_query *query) {    \
    return rot_system_cost_s(&system, model, scene, query, 1);                                     \
  }
#define ROT_SYSTEM_MODELS(prefix, takes)                                                           \
  ROT_SYSTEM_MODEL(prefix "rk8pd", takes, "explicit steps: it is not stiff", explicit_s, 3e-6),    \
      ROT_SYSTEM_MODEL(prefix "radau", takes, "implicit steps: it is stiff", implicit_s, 20e-6),   \
      ROT_FIXED_MODELS(prefix, takes, NULL, fixed_s)
#define ROT_SYSTEM_MODEL(id, takes, steps, cost_s, step_s)                                         \
  {                                                                                                \
    id, takes, ROT_ADAPTIVE, 1e-13, ROT_FREELY, "integrated, with " steps, NULL, cost_s, {         \
      step_s, 0.4e-6, 0.0, 0.0                                                                     \
    }                                                                                              \
  }
#define ROT_SYSTEM_METHODS                                                                         \
  {ROT_METHOD_RK8PD, integrate}, {ROT_METHOD_RADAU, integrate}, ROT_FIXED_METHODS(integrate)

#endif
