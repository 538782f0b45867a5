/* The effects that may act on an axle, and its models. */
#ifndef ROT_AXLE_MODELS_H
#define ROT_AXLE_MODELS_H

#include "rot_axle_scene.h"
#include "rot_model.h"

/* code, name, words, whether it may be dropped, what needs no words beside it. The kinds of terms
 * are in the order of rot_term_kind. */
#define ROT_AXLE_EFFECT_LIST(X)                                                                    \
  X(TORQUE, "torque", "a torque", 0, 0)                                                            \
  X(RAMP, "ramp", "a torque that changes in time", 0, ROT_AXLE_TORQUE)                             \
  X(SINUSOID, "sinusoid", "a sinusoidal torque", 0, 0)                                             \
  X(EXPONENTIAL, "exponential", "an exponential torque", 0, 0)                                     \
  X(POLYNOMIAL, "polynomial", "a polynomial torque", 0, 0)                                         \
  X(CHEBYSHEV, "chebyshev", "a sampled torque", 0, 0)                                              \
  X(CURVE, "curve", "a torque-speed curve", 0, 0)                                                  \
  X(SPRING, "spring", "a spring", 1, 0)                                                            \
  X(GRAVITY, "gravity", "gravity", 1, 0)                                                           \
  X(FUNCTION, "function", "a torque that is an R function", 0, 0)                                  \
  X(VISCOUS, "viscous", "viscous resistance", 1, 0)                                                \
  X(MOTOR, "motor", "a motor", 0, 0)                                                               \
  X(QUADRATIC, "quadratic", "quadratic drag", 1, 0)                                                \
  X(FRICTION, "friction", "dry friction", 1, 0)                                                    \
  X(INERTIA, "inertia", "a changing moment of inertia", 0, 0)

enum {
#define X(code, name, words, droppable, implies) ROT_AXLE_INDEX_##code,
  ROT_AXLE_EFFECT_LIST(X)
#undef X
      ROT_AXLE_EFFECTS
};

enum {
#define X(code, name, words, droppable, implies) ROT_AXLE_##code = 1 << ROT_AXLE_INDEX_##code,
  ROT_AXLE_EFFECT_LIST(X)
#undef X
};

unsigned rot_axle_effects(const rot_axle_scene *scene);

extern const rot_constraint rot_axle_constraint;

/* The closed form of that name in the list of models; NULL for another, or an integrator. */
rot_axle_model rot_axle_closed_form(const char *id);

#endif
