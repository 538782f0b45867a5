/* Period of a motion on an axle, if a closed form exists: pendulum, oscillator (viscous damping:
 * the cycle), freely rotating wheel. */
#ifndef ROT_AXLE_PERIOD_H
#define ROT_AXLE_PERIOD_H

#include "scene/axle/scene.h"

/* code, name in R */
#define ROT_PERIOD_LIST(X)                                                                         \
  X(ROT_PERIOD_UNKNOWN, "unknown") /* no closed form */                                            \
  X(ROT_PERIOD_NONE, "none")       /* no restoring torque */                                       \
  X(ROT_PERIOD_REST, "rest")       /* hangs at rest: period of small swings */                     \
  X(ROT_PERIOD_OSCILLATION, "oscillation")                                                         \
  X(ROT_PERIOD_ROTATION, "rotation")     /* period of a turn */                                    \
  X(ROT_PERIOD_SEPARATRIX, "separatrix") /* tends to the top, or balanced there: Inf */            \
  X(ROT_PERIOD_DAMPED, "damped")         /* between passages in one direction */                   \
  X(ROT_PERIOD_OVERDAMPED, "overdamped") /* passes the rest angle at most once */

typedef enum rot_period_kind {
#define X(code, name) code,
  ROT_PERIOD_LIST(X)
#undef X
      ROT_PERIOD_KINDS
} rot_period_kind;

typedef struct rot_period {
  rot_period_kind kind;
  double period_s;      /* > 0, Inf: separatrix; NaN: none, or unequal cycles */
  double amplitude_rad; /* of an undamped oscillation, else NaN */
  double ratio;         /* of the amplitudes of successive cycles; 1: undamped, NaN: none */
} rot_period;

/* scene => period of its motion. */
rot_period rot_axle_period(const rot_axle_scene *scene);

#endif
