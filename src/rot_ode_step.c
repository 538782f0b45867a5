#include "rot_ode_step.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_ode_rows.h"
#include "rot_real.h"

/* Below, doubles have no 16 digits left that an error test could ask for. */
#define LEAST_SIZE 1e-290

/* ---- the right-hand side --------------------------------------------------------------------- */

/* The last two calls of a step are at the same time: the last stage and the result. Their slopes'
 * difference over their own is what h times has a limit for an explicit method (Hairer, Norsett &
 * Wanner, Solving ODEs II, IV.2). */
static void note_stiffness(rot_ode_march *run, double t, const double y[], const double f[]) {
  const size_t n = run->p->controlled;
  if (t == run->stage_t) {
    double apart = 0.0, rise = 0.0;
    for (size_t i = 0; i < n; i++) {
      const double size = fmax(LEAST_SIZE, fmax(run->largest[i], fabs(y[i])));
      apart = fmax(apart, fabs(y[i] - run->stage_y[i]) / size);
      rise = fmax(rise, fabs(f[i] - run->stage_f[i]) / size);
    }
    /* Rounding apart tells nothing. */
    run->stiffness = apart > 64.0 * ROT_EPS ? rise / apart : 0.0;
  }
  run->stage_t = t;
  memcpy(run->stage_y, y, n * sizeof *y);
  memcpy(run->stage_f, f, n * sizeof *f);
}

int rot_ode_slope_at(double t, const double y[], double dydt[], void *ctx) {
  rot_ode_march *run = ctx;
  t = t < run->after ? run->after : t > run->before ? run->before : t;
  run->info->rhs_calls++;
  run->status = run->p->rhs(t, y, dydt, run->p->ctx);
  if (run->status != ROT_OK) return GSL_EBADFUNC; /* the only code at which rk8pd stops at once */
  for (size_t i = 0; i < run->p->controlled; i++) {
    if (!isfinite(dydt[i])) {
      run->wild = 1;
      run->info->time_s = t;
      return GSL_EBADFUNC;
    }
  }
  if (run->watch_stiffness) note_stiffness(run, t, y, dydt);
  return GSL_SUCCESS;
}

rot_status rot_ode_know_slope(rot_ode_march *run) {
  if (run->slope_known) return ROT_OK;
  run->wild = 0;
  if (rot_ode_slope_at(run->t, run->y, run->slope, run) != GSL_SUCCESS) {
    return run->wild ? ROT_ETORQUE : run->status;
  }
  run->slope_known = 1;
  return ROT_OK;
}

/* ---- one step ------------------------------------------------------------------------------- */

rot_status rot_ode_attempt(rot_ode_march *run, double t, double h, const double y[],
                           const double slope[]) {
  const size_t dim = run->p->dim;
  int code;
  run->wild = 0;
  run->status = ROT_OK;
  memcpy(run->trial, y, dim * sizeof *y);
  if (run->method == ROT_METHOD_RADAU) {
    for (size_t i = 0; i < dim; i++) {
      run->allowed[i] = run->tolerance * fmax(LEAST_SIZE, fmax(run->largest[i], fabs(y[i])));
      if (run->largest[i] == 0.0)
        run->allowed[i] = fmax(LEAST_SIZE, run->tolerance * fabs(h * slope[i]));
    }
    code = rot_radau_step(run->radau, rot_ode_slope_at, run, t, h, run->trial, run->trial_error,
                          slope, run->allowed);
    if (code == ROT_RADAU_DIVERGED) return ROT_ETORQUE;
    if (code == GSL_SUCCESS) code = rot_ode_slope_at(t + h, run->trial, run->trial_slope, run);
  } else {
    code = gsl_odeiv2_step_apply(run->rk, t, h, run->trial, run->trial_error, slope,
                                 run->trial_slope, &run->system);
  }
  if (code == GSL_SUCCESS) return ROT_OK;
  return run->wild ? ROT_ETORQUE : run->status != ROT_OK ? run->status : ROT_ENOMEM;
}

double rot_ode_trial_ratio(const rot_ode_march *run, double h) {
  double ratio = 0.0;
  for (size_t i = 0; i < run->p->controlled; i++) {
    /* Breaking loose, what drives and what resists cancel: their rounding is no error of a step. */
    const double lost = run->p->turn && i == run->p->turn->watched ? fabs(h) : h * h;
    const double error = fmax(0.0, fabs(run->trial_error[i]) - 16.0 * ROT_EPS * run->noise * lost);
    /* Of its size so far, never of its size later: where errors grow with the motion, what is
     * small against the end is all there is at the start. */
    const double scale = fmax(LEAST_SIZE, fmax(run->largest[i], fabs(run->trial[i])));
    if (!isfinite(run->trial[i])) return NAN;
    const double noise = run->p->noise ? run->p->noise[i] * fabs(h) : 0.0;
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
  return run->y_rows ? rot_dense_insert(&run->dense, run->dense.count, run->t, run->y, run->slope)
                     : ROT_OK;
}

rot_status rot_ode_accept(rot_ode_march *run, double t, double error) {
  double *swap = run->y;
  run->y = run->trial;
  run->trial = swap;
  swap = run->slope;
  run->slope = run->trial_slope;
  run->trial_slope = swap;
  run->t = t;
  run->at_rest = run->may_flip = 0;
  for (size_t i = 0; i < run->p->dim; i++) {
    run->largest[i] = fmax(run->largest[i], fabs(run->y[i]));
  }
  run->info->steps++;
  if (rot_ode_trace_end(run, error) != ROT_OK || rot_ode_add_node(run) != ROT_OK) return ROT_ENOMEM;
  enum { BLOCK = 512 };
  return run->dense.count >= BLOCK ? rot_ode_fill_rows(run, 0) : ROT_OK;
}
