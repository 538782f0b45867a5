/* A mechanical system of a few coordinates, integrated: coordinates and their rates are the state,
 * flows (work, heat, impulses) go along. Its laws are the core's own and do not know the time. */
#ifndef ROT_ODE_SYSTEM_H
#define ROT_ODE_SYSTEM_H

#include "engine/model.h"

enum { ROT_SYSTEM_MOST = 16 }; /* coordinates */

typedef struct rot_system_state {
  const double *q, *q_low; /* coordinates, and what these doubles lack of the exact sum */
  const double *v;         /* their rates */
  int sign;                /* of the rate, where friction is dry; 0: it is held at rest */
} rot_system_state;

typedef struct rot_system {
  size_t n;       /* coordinates */
  size_t n_flows; /* at most ROT_MOST_FLOWS; a hidden one for dry friction besides */
  double start_s;
  const double *q0, *v0;
  /* Slopes of the rates, and of the flows. `drive`: where friction is dry, the force along the one
   * coordinate over the normal force; else NULL. */
  void (*slopes)(const void *scene, const rot_system_state *state, double acceleration[],
                 double flow[], double *drive);
  /* Dry friction of one coordinate: it is held at rest up to |drive| = holds. */
  int dry;
  double holds;
  double rounding; /* of an acceleration: the sum of what acts */
  void (*row)(const void *scene, const rot_system_state *state, size_t at, void *const column[]);
} rot_system;

/* Predicted time of a run, with a pace that its start tells; seconds of the model: of a step, of a
 * row. Implicit steps do not count what fades. */
double rot_system_cost_s(const rot_model *model, const rot_query *query, double start_s,
                         const rot_pace *pace, int implicit);

/* The two models of such a system: `prefix` of their names, all effects, their costs. */
#define ROT_SYSTEM_MODELS(prefix, effects, explicit_s, implicit_s)                                 \
  {prefix "rk8pd", effects,    ROT_ADAPTIVE,                                                       \
   1e-13,          ROT_FREELY, "integrated, with explicit steps: it is not stiff",                 \
   NULL,           explicit_s, {3e-6, 0.4e-6, 0.0, 0.0}},                                          \
  {                                                                                                \
    prefix "radau", effects, ROT_ADAPTIVE, 1e-13, ROT_FREELY,                                      \
        "integrated, with implicit steps: it is stiff", NULL, implicit_s, {                        \
      20e-6, 0.4e-6, 0.0, 0.0                                                                      \
    }                                                                                              \
  }

/* Rows n_copies to a time. Measures: the largest |q|, the largest |v| of all coordinates. */
rot_status rot_system_run(const rot_system *system, const void *scene, const char *const measures[],
                          size_t n_copies, const rot_task *task, rot_method method,
                          const rot_rows *rows, const rot_hooks *hooks, rot_info *info);

#endif
