/* The effects and models of a free body. */
#ifndef ROT_FREE_MODELS_H
#define ROT_FREE_MODELS_H

#include "scene/free/free.h"
#include "engine/model.h"

/* Its scene is a rot_free_params. */
extern const rot_constraint rot_free_constraint;

/* parameters => 1 if the motor of a rotor has a torque. */
int rot_free_has_motors(const rot_free_params *p);

/* Predicted times; the constants in the model: scene/free/models.c. A run in closed form. */
double rot_free_exact_s(const rot_model *model, const void *scene, const rot_query *query);
/* An integrated run. */
double rot_free_integrated_s(const rot_model *model, const void *scene, const rot_query *query);
/* A run by fixed steps. */
double rot_free_steps_s(const rot_model *model, const void *scene, const rot_query *query);

/* (scene, query) => why the model does not apply, or NULL: closed form of a free body. */
const char *rot_free_refuses_exact(const void *scene, const rot_query *query);
/* The same: closed form of a gyrostat. */
const char *rot_free_refuses_gyrostat(const void *scene, const rot_query *query);
/* The same: integrators. */
const char *rot_free_refuses_ode(const void *scene, const rot_query *query);
/* The same: splitting. */
const char *rot_free_refuses_split(const void *scene, const rot_query *query);

/* Integrators and fixed-step methods of a free body and of one with a fixed point. effects: mask of
 * the effects that they take; conservative: of those that the splitting takes. */
#define ROT_FREE_STEPPED(id, takes, kind, error, offered, why, refuses, time_s, ...)               \
  {                                                                                                \
    id, takes, kind, error, offered, why, refuses, time_s, { __VA_ARGS__ }                         \
  }

#define ROT_FREE_INTEGRATED(prefix, effects)                                                       \
  ROT_FREE_STEPPED(prefix "rk8pd", effects, ROT_ADAPTIVE, 1e-13, ROT_FREELY,                       \
                   "integrated, with explicit steps: it is not stiff", rot_free_refuses_ode,       \
                   rot_free_integrated_s, 0.6, -1.0 / 8.5, 2.5e-6, 1.5e-6),                        \
      ROT_FREE_STEPPED(prefix "radau", effects, ROT_ADAPTIVE, 1e-13, ROT_FREELY,                   \
                       "integrated, with implicit steps: it is stiff", rot_free_refuses_ode,       \
                       rot_free_integrated_s, 0.6, -1.0 / 9.0, 60e-6, 1.5e-6)

#define ROT_FREE_FIXED(id, takes, why, refuses, step_s)                                            \
  ROT_FREE_STEPPED(id, takes, ROT_ESTIMATE, 1.0, ROT_BY_NAME, why, refuses, rot_free_steps_s,      \
                   step_s, 0.0, 0.0, 0.0)

#define ROT_FREE_STEPS(prefix, effects, conservative)                                              \
  ROT_FREE_FIXED(prefix "euler", effects, "steps of fixed length, explicit Euler: order 1",        \
                 rot_free_refuses_ode, 0.1e-6),                                                    \
      ROT_FREE_FIXED(prefix "semi_implicit", effects,                                              \
                     "steps of fixed length, semi-implicit Euler: order 1", rot_free_refuses_ode,  \
                     0.3e-6),                                                                      \
      ROT_FREE_FIXED(prefix "rk4", effects, "steps of fixed length, Runge-Kutta: order 4",         \
                     rot_free_refuses_ode, 0.4e-6),                                                \
      ROT_FREE_FIXED(prefix "split", conservative,                                                 \
                     "steps that keep the energy within a bound: order 6", rot_free_refuses_split, \
                     1.5e-6)

#endif
