/* The time of a run, outward from the start: where it is, how far it goes, the breaks on the way.
 */
#ifndef ROT_ODE_CLOCK_H
#define ROT_ODE_CLOCK_H

#include "engine/ode/params.h"

typedef struct rot_ode_clock {
  const rot_ode_params *p;
  double t, end; /* end: of this side of the start */
  int forward;
  double after, before; /* rhs is evaluated strictly inside (break, next break) */
  size_t next;          /* breaks[next] is next forward, breaks[next - 1] backward */
} rot_ode_clock;

static inline double rot_ode_way(const rot_ode_clock *c) { return c->forward ? 1.0 : -1.0; }

/* Whether the run comes to a before it comes to b. */
static inline int rot_ode_is_before(const rot_ode_clock *c, double a, double b) {
  return c->forward ? a < b : a > b;
}

rot_ode_clock rot_ode_clock_at_start(const rot_ode_params *p, double end, int forward);

/* The next break, +-Inf if there is none; rhs stays on this side of it from here on. */
double rot_ode_next_break(rot_ode_clock *c);
/* The break at c->t lies behind. */
void rot_ode_cross_break(rot_ode_clock *c);

#endif
