#include "engine/ode/step.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "engine/ode/law.h"
#include "engine/ode/norm.h"
#include "ground/real.h"

/* What Newton's iteration may leave in each component. */
static void allow(rot_ode_march *run, double h, const double y[], const double slope[]) {
  const rot_ode_params *p = run->p;
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    double size = fmax(run->largest[m], rot_ode_size(g, y));
    if (run->largest[m] == 0.0) size = fabs(h) * rot_ode_rate(g, slope);
    if (g.norm == ROT_ODE_QUATERNION) size = 0.5;
    for (size_t i = 0; i < g.count; i++) {
      run->allowed[g.first + i] = fmax(ROT_ODE_LEAST_SIZE, run->tolerance * size);
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
    const double scale =
        fmax(ROT_ODE_LEAST_SIZE, fmax(run->largest[m], rot_ode_size(g, run->trial)));
    const double noise = p->noise ? p->noise[m] * fabs(h) : 0.0;
    const double allowed = run->tolerance * scale + noise;
    if (error != 0.0 && !(error / allowed <= ratio)) ratio = error / allowed;
  }
  return ratio;
}
