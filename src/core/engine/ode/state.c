#include "engine/ode/state.h"

#include <math.h>

static double outward(const rot_ode_clock *c) { return c->forward ? INFINITY : -INFINITY; }

static void stay_beyond(rot_ode_clock *c, double t) {
  *(c->forward ? &c->after : &c->before) = nextafter(t, outward(c));
}

rot_ode_clock rot_ode_clock_at_start(const rot_ode_params *p, double end, int forward) {
  rot_ode_clock c = {p, p->start_s, end, forward, -INFINITY, INFINITY, 0};
  const double *breaks = p->breaks;
  while (c.next < p->n_breaks && (forward ? breaks[c.next] <= c.t : breaks[c.next] < c.t)) c.next++;
  const int on_break = forward ? c.next > 0 && breaks[c.next - 1] == c.t
                               : c.next < p->n_breaks && breaks[c.next] == c.t;
  if (on_break || p->start_breaks) stay_beyond(&c, c.t);
  return c;
}

/* Between two neighbours of the doubles there is no other side: the lower of them has the value
 * after it. */
double rot_ode_next_break(rot_ode_clock *c) {
  const int more = c->forward ? c->next < c->p->n_breaks : c->next > 0;
  const double stop = more ? c->p->breaks[c->forward ? c->next : c->next - 1] : outward(c);
  *(c->forward ? &c->before : &c->after) = more ? nextafter(stop, -outward(c)) : stop;
  if (c->after > c->before) c->after = c->before;
  return stop;
}

void rot_ode_cross_break(rot_ode_clock *c) {
  stay_beyond(c, c->t);
  c->next = c->forward ? c->next + 1 : c->next - 1;
}
