#include "engine/ode/accept.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/law.h"
#include "engine/ode/norm.h"
#include "engine/ode/probe.h"
#include "engine/ode/rows.h"
#include "engine/ode/track.h"
#include "ground/real.h"

rot_status rot_ode_trace_end(rot_ode_march *run, double error) {
  const size_t stride = 2 + run->p->dim;
  rot_ode_trace *m = run->trace;
  if (m->count == m->room) {
    const size_t room = m->room ? 2 * m->room : 64;
    double *data = realloc(m->data, room * stride * sizeof *data);
    if (!data) return ROT_ENOMEM;
    m->data = data;
    m->room = room;
  }
  double *node = m->data + m->count++ * stride;
  node[0] = run->t;
  node[1] = error;
  memcpy(node + 2, run->y, run->p->dim * sizeof *node);
  return ROT_OK;
}

rot_status rot_ode_add_node(rot_ode_march *run) {
  if (run->track && rot_ode_track_node(run->track, run) != ROT_OK) return ROT_ENOMEM;
  return run->y_rows ? rot_dense_insert(&run->dense, run->dense.count, run->t, run->y, run->slope)
                     : ROT_OK;
}

void rot_ode_note_sizes(rot_ode_march *run) {
  for (size_t m = 0; m < rot_ode_measures(run->p); m++) {
    const rot_ode_group g = rot_ode_group_of(run->p, m);
    run->largest[m] = fmax(run->largest[m], rot_ode_size(g, run->y));
  }
}

/* A slope that belongs to a state off the manifold by less than a part of what a step may err is
 * kept. */
static rot_status project(rot_ode_march *run) {
  const rot_ode_params *p = run->p;
  if (!p->project) return ROT_OK;
  memcpy(run->change, run->y, p->dim * sizeof *run->y);
  p->project(run->t, run->y, p->ctx);
  for (size_t i = 0; i < p->dim; i++) run->change[i] = run->y[i] - run->change[i];
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    const double size = fmax(run->largest[m], rot_ode_size(g, run->y));
    const double by = rot_ode_apart(g, run->y, run->change);
    if (!(by <= 16.0 * ROT_EPS * size)) run->moved[m] += by;
    if (!(rot_ode_rate(g, run->change) <= 1e-3 * run->tolerance * size)) run->slope_known = 0;
  }
  return rot_ode_know_slope(run);
}

static void cover_calls(rot_ode_march *run) {
  for (size_t k = ROT_ODE_UNWEIGHED; k < run->n_called; k++) {
    const double *call = run->called + k * (1 + run->p->controlled);
    rot_ode_probes_cover(run->probes, call[0], call + 1);
  }
  run->n_called = 0;
}

rot_status rot_ode_accept(rot_ode_march *run, double t, double error) {
  if (run->probes) cover_calls(run);
  double *swap = run->y;
  run->y = run->trial;
  run->trial = swap;
  swap = run->slope;
  run->slope = run->trial_slope;
  run->trial_slope = swap;
  run->t = t;
  run->slope_known = 1;
  const rot_status status = project(run);
  if (status != ROT_OK) return status;
  rot_ode_note_sizes(run);
  run->info->steps++;
  if (rot_ode_trace_end(run, error) != ROT_OK || rot_ode_add_node(run) != ROT_OK) return ROT_ENOMEM;
  enum { BLOCK = 512 };
  return run->dense.count >= BLOCK ? rot_ode_fill_rows(run, 0) : ROT_OK;
}
