#include "engine/ode/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"

rot_status rot_ode_make_room(double **data, size_t *room, size_t count, size_t each) {
  if (count < *room) return ROT_OK;
  const size_t more = *room ? 2 * *room : 64;
  double *moved = realloc(*data, more * each * sizeof *moved);
  if (!moved) return ROT_ENOMEM;
  *data = moved;
  *room = more;
  return ROT_OK;
}

rot_status rot_ode_trace_add(rot_ode_trace *m, double t, double error, const double y[]) {
  const size_t each = 2 + m->dim;
  if (rot_ode_make_room(&m->data, &m->room, m->count, each) != ROT_OK) return ROT_ENOMEM;
  double *node = m->data + m->count++ * each;
  node[0] = t;
  node[1] = error;
  memcpy(node + 2, y, m->dim * sizeof *node);
  return ROT_OK;
}

/* A step so much shorter than the one before is not divided where its error is a small part of the
 * accuracy, as of one that passes a kink. Others are, as the first in a narrow change of the law:
 * two runs with the same error would not show it. */
#define SLIVER      1e-3
#define SLIVER_PART 0.02

/* (reference, stop) => end of the next step. If the next node of the reference is closer than a
 * third of a substep, the one after it: events shift the two runs against each other. */
double rot_ode_reference_aim(rot_ode_reference *g, double stop) {
  const rot_ode_trace *m = g->trace;
  const double t = g->clock->t, direction = rot_ode_direction(g->clock),
               start = g->clock->p->start_s;
  if (!m || m->count == 0 || !(fabs(rot_ode_node(m, m->count - 1)[0] - start) > fabs(t - start))) {
    return NAN;
  }
  while (g->at + 2 < m->count && !rot_ode_is_before(g->clock, t, rot_ode_node(m, g->at + 1)[0])) {
    g->at++;
  }
  for (size_t k = g->at; k + 1 < m->count; k++) {
    const double a = rot_ode_node(m, k)[0], b = rot_ode_node(m, k + 1)[0];
    const int whole = k > 0 && fabs(b - a) < SLIVER * fabs(a - rot_ode_node(m, k - 1)[0]) &&
                      rot_ode_node(m, k + 1)[1] <= SLIVER_PART * g->clock->p->accuracy;
    const double parts = whole ? 1.0 : (double)g->parts;
    const double part = (b - a) / parts, min = 0.3 * fabs(part);
    const double done = floor((t - a) / part + 0.3) + 1.0;
    const double aim = done < parts ? a + fmax(1.0, done) * part : b;
    if (direction * (aim - t) <= 0.0) continue;
    if (direction * (stop - aim) <= 0.0) return stop;
    if (direction * (aim - t) > min) return aim;
  }
  return stop;
}

int rot_ode_is_unresolved(const rot_ode_reference *g, double error) {
  const rot_ode_trace *m = g->trace;
  if (!m || g->at + 1 >= m->count) return 0;
  double before = rot_ode_node(m, g->at + 1)[1];
  if (g->at + 2 < m->count) { /* after a zero the reference is some way off */
    before = fmax(before, rot_ode_node(m, g->at + 2)[1]);
  }
  const double want = before / g->gain;
  return error > 4.0 * want && error > 64.0 * ROT_EPS;
}

void rot_ode_trajectory_free(rot_ode_trajectory *trajectory) {
  rot_dense_free(&trajectory->nodes);
  free(trajectory->derivative);
  trajectory->derivative = NULL;
  trajectory->room = 0;
}

rot_status rot_ode_trajectory_node(rot_ode_trajectory *trajectory, const rot_ode_params *p,
                                   double t, const double y[], const double slope[]) {
  const size_t each = p->dim * p->controlled;
  trajectory->controlled = p->controlled;
  trajectory->nodes.dim = p->dim;
  trajectory->nodes.slopes = 1;
  if (rot_dense_insert(&trajectory->nodes, trajectory->nodes.count, t, y, slope) != ROT_OK) {
    return ROT_ENOMEM;
  }
  if (trajectory->room != trajectory->nodes.room) {
    double *more = realloc(trajectory->derivative, trajectory->nodes.room * each * sizeof *more);
    if (!more) return ROT_ENOMEM;
    trajectory->derivative = more;
    trajectory->room = trajectory->nodes.room;
  }
  for (size_t i = 0; i < each; i++)
    trajectory->derivative[(trajectory->nodes.count - 1) * each + i] = NAN;
  return ROT_OK;
}
