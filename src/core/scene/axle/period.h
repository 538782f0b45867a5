/* The period of an axle's motion where a closed form gives it: a pendulum, an oscillator (with
 * viscous damping: the cycle), a wheel that turns freely. */
#ifndef ROT_AXLE_PERIOD_H
#define ROT_AXLE_PERIOD_H

#include "scene/axle/scene.h"

/* code, name in R */
#define ROT_PERIOD_LIST(X)                                                                         \
  X(ROT_PERIOD_UNKNOWN, "unknown") /* no closed form of it */                                      \
  X(ROT_PERIOD_NONE, "none")       /* nothing brings it back */                                    \
  X(ROT_PERIOD_REST, "rest")       /* hangs still: the time of a small swing */                    \
  X(ROT_PERIOD_OSCILLATION, "oscillation")                                                         \
  X(ROT_PERIOD_ROTATION, "rotation")     /* the time of a turn */                                  \
  X(ROT_PERIOD_SEPARATRIX, "separatrix") /* tends to the top, or is balanced there: Inf */         \
  X(ROT_PERIOD_DAMPED, "damped")         /* between passages in the same sense */                  \
  X(ROT_PERIOD_OVERDAMPED, "overdamped") /* passes the rest angle once at most */

typedef enum rot_period_kind {
#define X(code, name) code,
  ROT_PERIOD_LIST(X)
#undef X
      ROT_PERIOD_KINDS
} rot_period_kind;

typedef struct rot_period {
  rot_period_kind kind;
  double period_s;      /* NaN where there is none, and where cycles differ */
  double amplitude_rad; /* of an undamped swing, else NaN */
  double ratio;         /* of the amplitudes of two cycles: 1 undamped, NaN where there is none */
} rot_period;

rot_period rot_axle_period(const rot_axle_scene *scene);

#endif
