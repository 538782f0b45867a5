#include "engine/ode/step.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/collocate.h"
#include "engine/ode/probe.h"
#include "engine/ode/rows.h"
#include "engine/ode/wall.h"
#include "ground/real.h"

/* Below, doubles have no 16 digits left that an error test could ask for. */
#define LEAST_SIZE 1e-290

/* ---- the right-hand side --------------------------------------------------------------------- */

/* The last two calls of a step are at the same time: the last stage and the result. The difference
 * of their slopes over their own is what h times has a limit for an explicit method (Hairer,
 * Norsett & Wanner, Solving ODEs II, IV.2). */
static void note_stiffness(rot_ode_march *run, double t, const double y[], const double f[]) {
  const rot_ode_params *p = run->p;
  if (t == run->stage_t) {
    double apart = 0.0, rise = 0.0;
    for (size_t i = 0; i < p->controlled; i++) {
      run->stage_y[i] -= y[i];
      run->stage_f[i] -= f[i];
    }
    for (size_t m = 0; m < rot_ode_steering(p); m++) {
      const rot_ode_group g = rot_ode_group_of(p, m);
      const double size = fmax(LEAST_SIZE, fmax(run->largest[m], rot_ode_size(g, y)));
      apart = fmax(apart, rot_ode_rate(g, run->stage_y) / size);
      rise = fmax(rise, rot_ode_rate(g, run->stage_f) / size);
    }
    /* Differences at rounding level say nothing about stiffness. */
    run->stiffness = apart > 64.0 * ROT_EPS ? rise / apart : 0.0;
  }
  run->stage_t = t;
  memcpy(run->stage_y, y, p->controlled * sizeof *y);
  memcpy(run->stage_f, f, p->controlled * sizeof *f);
}

int rot_ode_slope_at(double t, const double y[], double dydt[], void *ctx) {
  rot_ode_march *run = ctx;
  if (run->slides != NO_WALL) return rot_ode_sliding_slope(run, t, y, dydt);
  t = t < run->after ? run->after : t > run->before ? run->before : t;
  if (run->walls->count) {
    memcpy(run->kept, y, run->p->dim * sizeof *y);
    rot_ode_keep_sides(run, &t, run->kept);
    y = run->kept;
  }
  /* A trial state may have left the doubles: a law is not defined there, and is not called. */
  run->status = ROT_OK;
  for (size_t i = 0; i < run->p->controlled; i++) {
    if (!isfinite(y[i])) run->status = ROT_ERHS;
  }
  if (run->status == ROT_OK) {
    run->info->rhs_calls++;
    if (run->attempts && run->n_called < ROT_ODE_CALLS) {
      double *call = run->called + run->n_called++ * (1 + run->p->controlled);
      call[0] = t;
      memcpy(call + 1, y, run->p->controlled * sizeof *y);
    }
    run->status = run->p->rhs(t, y, dydt, run->p->ctx);
  }
  for (size_t i = 0; i < run->p->controlled && run->status == ROT_OK; i++) {
    if (!isfinite(dydt[i])) run->status = ROT_ERHS;
  }
  if (run->status == ROT_ERHS) run->info->time_s = t;
  if (run->status != ROT_OK) return GSL_EBADFUNC; /* the only code at which rk8pd stops at once */
  if (run->watch_stiffness) note_stiffness(run, t, y, dydt);
  return GSL_SUCCESS;
}

rot_status rot_ode_know_slope(rot_ode_march *run) {
  if (run->slope_known) return ROT_OK;
  if (rot_ode_slope_at(run->t, run->y, run->slope, run) != GSL_SUCCESS) return run->status;
  run->slope_known = 1;
  return ROT_OK;
}

rot_status rot_ode_check_repeats(rot_ode_march *run) {
  const rot_ode_params *p = run->p;
  const double may = fmax(1e-12, p->accuracy);
  double *again = run->work;
  run->slope_known = 0;
  rot_status status = rot_ode_know_slope(run);
  if (status == ROT_OK && rot_ode_slope_at(run->t, run->y, again, run) != GSL_SUCCESS) {
    status = run->status;
  }
  run->stage_t = NAN;                    /* no two stages of a step */
  if (status == ROT_ERHS) return ROT_OK; /* the step says so */
  for (size_t i = 0; i < p->controlled && status == ROT_OK; i++) {
    const double size = fmax(fabs(run->slope[i]), fabs(again[i]));
    if (fabs(run->slope[i] - again[i]) > may * size) status = ROT_ERANDOM;
  }
  if (status == ROT_ERANDOM) run->info->time_s = run->t;
  return status;
}

/* ---- one step ------------------------------------------------------------------------------- */

/* What Newton's iteration may leave in each component. */
static void allow(rot_ode_march *run, double h, const double y[], const double slope[]) {
  const rot_ode_params *p = run->p;
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    double size = fmax(run->largest[m], rot_ode_size(g, y));
    if (run->largest[m] == 0.0) size = fabs(h) * rot_ode_rate(g, slope);
    if (g.norm == ROT_ODE_QUATERNION) size = 0.5;
    for (size_t i = 0; i < g.count; i++) {
      run->allowed[g.first + i] = fmax(LEAST_SIZE, run->tolerance * size);
    }
  }
}

rot_status rot_ode_attempt(rot_ode_march *run, double t, double h, const double y[],
                           const double slope[]) {
  const size_t dim = run->p->dim;
  int code;
  run->status = ROT_OK;
  run->n_called = 0;
  run->attempts = run->called && run->method == ROT_METHOD_RK8PD && run->slides == NO_WALL;
  memcpy(run->trial, y, dim * sizeof *y);
  if (run->method == ROT_METHOD_RADAU) {
    allow(run, h, y, slope);
    code = rot_radau_step(run->radau, rot_ode_slope_at, run, t, h, run->trial, run->trial_error,
                          slope, run->allowed);
    if (code == ROT_RADAU_DIVERGED) return ROT_ESTEP;
    if (code == GSL_SUCCESS) code = rot_ode_slope_at(t + h, run->trial, run->trial_slope, run);
  } else {
    code = gsl_odeiv2_step_apply(run->rk, t, h, run->trial, run->trial_error, slope,
                                 run->trial_slope, &run->system);
  }
  run->attempts = 0;
  if (code == GSL_SUCCESS) return ROT_OK;
  return run->status != ROT_OK ? run->status : ROT_ENOMEM;
}

double rot_ode_trial_ratio(const rot_ode_march *run, double h) {
  const rot_ode_params *p = run->p;
  double ratio = 0.0;
  for (size_t i = 0; i < p->controlled; i++) {
    if (!isfinite(run->trial[i])) return NAN;
  }
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    /* Breaking loose, what drives and what resists cancel: their rounding is no error of a step. */
    const double lost = p->turn && g.first == p->turn->watched ? fabs(h) : h * h;
    const double error = fmax(0.0, rot_ode_apart(g, run->trial, run->trial_error) -
                                       16.0 * ROT_EPS * run->noise * lost);
    /* Of its size so far, never of its size later: where errors grow with the motion, what is
     * small against the end is all there is at the start. */
    const double scale = fmax(LEAST_SIZE, fmax(run->largest[m], rot_ode_size(g, run->trial)));
    const double noise = p->noise ? p->noise[m] * fabs(h) : 0.0;
    const double allowed = run->tolerance * scale + noise;
    if (error != 0.0 && !(error / allowed <= ratio)) ratio = error / allowed;
  }
  return ratio;
}

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
