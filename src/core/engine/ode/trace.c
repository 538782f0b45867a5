#include "engine/ode/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"

rot_status rot_ode_trace_add(rot_ode_trace *m, double t, double error, const double y[]) {
  const size_t stride = 2 + m->dim;
  if (m->count == m->room) {
    const size_t room = m->room ? 2 * m->room : 64;
    double *data = realloc(m->data, room * stride * sizeof *data);
    if (!data) return ROT_ENOMEM;
    m->data = data;
    m->room = room;
  }
  double *node = m->data + m->count++ * stride;
  node[0] = t;
  node[1] = error;
  memcpy(node + 2, y, m->dim * sizeof *node);
  return ROT_OK;
}

int rot_ode_is_guided(const rot_ode_guide *g) {
  const rot_ode_trace *m = g->trace;
  const double start = g->clock->p->start_s;
  return m && m->count &&
         fabs(rot_ode_node(m, m->count - 1)[0] - start) > fabs(g->clock->t - start);
}

/* A step so much shorter than the one before is not divided: it passes a kink, and ends where its
 * error is a small part of the accuracy. */
#define SLIVER 1e-3

/* Nearer than a third of a part it goes for the one after, so that after an event, which no two
 * runs meet at the same time, it falls in with the guide again. */
double rot_ode_guided_aim(rot_ode_guide *g, double stop) {
  const rot_ode_trace *m = g->trace;
  const double t = g->clock->t, way = rot_ode_way(g->clock);
  while (g->at + 2 < m->count && !rot_ode_is_before(g->clock, t, rot_ode_node(m, g->at + 1)[0])) {
    g->at++;
  }
  for (size_t k = g->at; k + 1 < m->count; k++) {
    const double a = rot_ode_node(m, k)[0], b = rot_ode_node(m, k + 1)[0];
    const int whole = k > 0 && fabs(b - a) < SLIVER * fabs(a - rot_ode_node(m, k - 1)[0]);
    const double parts = whole ? 1.0 : (double)g->parts;
    const double part = (b - a) / parts, least = 0.3 * fabs(part);
    const double done = floor((t - a) / part + 0.3) + 1.0;
    const double aim = done < parts ? a + fmax(1.0, done) * part : b;
    if (way * (aim - t) <= 0.0) continue;
    if (way * (stop - aim) <= 0.0) return stop;
    if (way * (aim - t) > least) return aim;
  }
  return stop;
}

int rot_ode_is_unresolved(const rot_ode_guide *g, double error) {
  const rot_ode_trace *m = g->trace;
  if (!m || g->at + 1 >= m->count) return 0;
  double before = rot_ode_node(m, g->at + 1)[1];
  if (g->at + 2 < m->count) { /* after a zero the guide is some way off */
    before = fmax(before, rot_ode_node(m, g->at + 2)[1]);
  }
  const double want = before / g->gain;
  return error > 4.0 * want && error > 64.0 * ROT_EPS;
}
