#include "engine/ode/law.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

/* ---- beside walls ---------------------------------------------------------------------------- */

static void keep_side(const rot_ode_march *run, size_t wall, double *x) {
  const rot_ode_wall *w = &run->walls->wall[wall];
  if (run->side[wall] > 0) *x = fmax(*x, w->above);
  if (run->side[wall] < 0) *x = fmin(*x, w->below);
}

void rot_ode_keep_sides(const rot_ode_march *run, double *t, double y[]) {
  for (size_t k = 0; k < run->walls->count; k++) {
    keep_side(run, k, rot_ode_is_time(run, k) ? t : &y[run->walls->wall[k].component]);
  }
}

double rot_ode_keep_time(const rot_ode_march *run, double t) {
  for (size_t k = 0; k < run->walls->count; k++) {
    if (rot_ode_is_time(run, k)) keep_side(run, k, &t);
  }
  return t;
}

int rot_ode_both_slopes(rot_ode_march *run, size_t wall, double t, const double y[], double below[],
                        double above[]) {
  const int side = run->side[wall];
  const size_t slides = run->slides;
  run->slides = NO_WALL;
  run->side[wall] = -1;
  int code = rot_ode_slope_at(t, y, below, run);
  run->side[wall] = 1;
  if (code == GSL_SUCCESS) code = rot_ode_slope_at(t, y, above, run);
  run->side[wall] = side;
  run->slides = slides;
  return code;
}

int rot_ode_sliding_slope(rot_ode_march *run, double t, const double y[], double dydt[]) {
  const size_t c = run->walls->wall[run->slides].component;
  double *above = run->beyond;
  const int code = rot_ode_both_slopes(run, run->slides, t, y, dydt, above);
  if (code != GSL_SUCCESS) return code;
  const double apart = dydt[c] - above[c];
  const double part = apart != 0.0 ? fmin(1.0, fmax(0.0, dydt[c] / apart)) : 0.5;
  for (size_t i = 0; i < run->p->dim; i++) dydt[i] += part * (above[i] - dydt[i]);
  dydt[c] = 0.0;
  return GSL_SUCCESS;
}

double rot_ode_hold_of_slide(rot_ode_march *run, double t, const double y[]) {
  const size_t c = run->walls->wall[run->slides].component;
  const double way = run->forward ? 1.0 : -1.0;
  double *below = run->beside, *above = run->beyond;
  if (rot_ode_both_slopes(run, run->slides, t, y, below, above) != GSL_SUCCESS) return NAN;
  return fmin(way * below[c], -way * above[c]);
}

double rot_ode_wall_level(const rot_ode_march *run, size_t wall) {
  const rot_ode_wall *w = &run->walls->wall[wall];
  return run->side[wall] > 0 ? w->below : w->above;
}

/* ---- its calls ------------------------------------------------------------------------------- */

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
      const double size = fmax(ROT_ODE_LEAST_SIZE, fmax(run->largest[m], rot_ode_size(g, y)));
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
