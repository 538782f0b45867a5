/* Effects of an axle, as bits of a mask. */
#ifndef ROT_AXLE_EFFECTS_H
#define ROT_AXLE_EFFECTS_H

#include "scene/axle/scene.h"

/* code, name, words, whether it may be dropped, effects implied by it in texts. The kinds of terms
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
  X(FUNCTION, "function", "a torque function", 0, 0)                                               \
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

/* scene => mask of its effects. */
unsigned rot_axle_effects(const rot_axle_scene *scene);

/* Mask of the effects that each closed form takes. */
enum {
  ROT_AXLE_LINEAR_TAKES = ROT_AXLE_TORQUE | ROT_AXLE_RAMP | ROT_AXLE_VISCOUS | ROT_AXLE_MOTOR,
  ROT_AXLE_SKATER_TAKES = ROT_AXLE_TORQUE | ROT_AXLE_INERTIA,
  ROT_AXLE_DRAG_TAKES =
      ROT_AXLE_TORQUE | ROT_AXLE_VISCOUS | ROT_AXLE_MOTOR | ROT_AXLE_QUADRATIC | ROT_AXLE_FRICTION,
  ROT_AXLE_FORCED_TAKES =
      ROT_AXLE_LINEAR_TAKES | ROT_AXLE_SINUSOID | ROT_AXLE_EXPONENTIAL | ROT_AXLE_POLYNOMIAL,
  ROT_AXLE_OSCILLATOR_TAKES = ROT_AXLE_LINEAR_TAKES | ROT_AXLE_SINUSOID | ROT_AXLE_SPRING,
  ROT_AXLE_PENDULUM_TAKES = ROT_AXLE_GRAVITY,
  ROT_AXLE_BANDS_TAKES = ROT_AXLE_LINEAR_TAKES | ROT_AXLE_CURVE | ROT_AXLE_FRICTION
};

/* 1 if the scene has only effects of the mask, and a valid moment of inertia; else 0. */
int rot_axle_fits(const rot_axle_scene *scene, unsigned takes);

#endif
