/* Where a run is: the time, outward from the start, with the breaks on the way; and the motion. */
#ifndef ROT_ODE_STATE_H
#define ROT_ODE_STATE_H

#include "engine/ode/params.h"

typedef struct rot_ode_clock {
  const rot_ode_params *p;
  double t, end; /* end: of this side of the start */
  int forward;
  double after, before; /* rhs is evaluated strictly inside (break, next break) */
  size_t next;          /* breaks[next] is next forward, breaks[next - 1] backward */
} rot_ode_clock;

static inline double rot_ode_direction(const rot_ode_clock *c) { return c->forward ? 1.0 : -1.0; }

/* Whether the run comes to a before it comes to b. */
static inline int rot_ode_is_before(const rot_ode_clock *c, double a, double b) {
  return c->forward ? a < b : a > b;
}

rot_ode_clock rot_ode_clock_at_start(const rot_ode_params *p, double end, int forward);

/* The next break, +-Inf if there is none; rhs stays on this side of it from here on. */
double rot_ode_next_break(rot_ode_clock *c);
/* The break at c->t lies behind. */
void rot_ode_cross_break(rot_ode_clock *c);

/*   MOVING     -> a step -> MOVING, CUT
 *   CUT        -> the last step was cut where an event seemed near; a step -> MOVING
 *   LEAVING    -> a segment begins at rest, its direction known; a step -> MOVING; none -> HELD
 *   UNDECIDED  -> the same where nothing drives: the direction is a guess, and may flip -> LEAVING
 *   HELD       -> until it breaks loose -> LEAVING
 *   STIFF      -> ended: not for an explicit method
 *   ENDED      -> ended by an event */
typedef enum rot_ode_phase {
  ROT_ODE_MOVING,
  ROT_ODE_CUT,
  ROT_ODE_LEAVING,
  ROT_ODE_UNDECIDED,
  ROT_ODE_HELD,
  ROT_ODE_STIFF,
  ROT_ODE_ENDED
} rot_ode_phase;

typedef struct rot_ode_state {
  rot_ode_phase phase;
  double *y, *slope; /* dim each */
  int slope_known;   /* slope holds rhs of the time and y */
  double *largest;   /* size of each measure so far */
} rot_ode_state;

#endif
