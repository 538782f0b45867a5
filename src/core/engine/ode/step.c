#include "engine/ode/step.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

/* In GSL's form; with another code rk8pd would not stop at once. */
static int slope_at(double t, const double y[], double dydt[], void *law) {
  return rot_ode_slope_at(law, t, y, dydt) == ROT_OK ? GSL_SUCCESS : GSL_EBADFUNC;
}

rot_status rot_ode_stepper_open(rot_ode_stepper *s) {
  const size_t dim = s->law->p->dim;
  s->system = (gsl_odeiv2_system){slope_at, NULL, dim, s->law};
  if (rot_ode_is_fixed(s->method)) {
    s->stage = malloc(4 * dim * sizeof *s->stage);
  } else if (s->method == ROT_METHOD_RADAU) {
    s->radau = rot_radau_alloc(dim, s->law->p->controlled);
  } else {
    s->rk = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, dim);
  }
  return s->rk || s->radau || s->stage ? ROT_OK : ROT_ENOMEM;
}

void rot_ode_stepper_close(rot_ode_stepper *s) {
  if (s->rk) gsl_odeiv2_step_free(s->rk);
  rot_radau_free(s->radau);
  free(s->stage);
}

double rot_ode_gain(rot_method method, double parts) {
  return pow(parts, method == ROT_METHOD_RADAU ? ROT_RADAU_ERROR_ORDER + 1.0 : 8.0);
}

/* What Newton's iteration may leave in each component. */
static void allow(rot_ode_stepper *s, double h, const double y[], const double slope[]) {
  const rot_ode_params *p = s->law->p;
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    double size = fmax(s->state->largest[m], rot_ode_size(g, y));
    if (s->state->largest[m] == 0.0) size = fabs(h) * rot_ode_rate(g, slope);
    if (g.norm == ROT_ODE_QUATERNION) size = 0.5;
    const double noise = p->noise ? p->noise[m] * fabs(h) : 0.0;
    for (size_t i = 0; i < g.count; i++) {
      s->allowed[g.first + i] = fmax(ROT_ODE_MIN_SIZE, s->tolerance * size + noise);
    }
  }
}

/* (t, y, its slope) => trial, which has no error estimate. */
static rot_status fixed_step(rot_ode_stepper *s, double t, double h, const double y[],
                             const double slope[]) {
  static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
  const rot_ode_params *p = s->law->p;
  double *at = s->stage, *f = s->stage + p->dim;
  memset(s->trial_error, 0, p->dim * sizeof *s->trial_error);
  if (s->method != ROT_METHOD_RK4) {
    for (size_t i = 0; i < p->dim; i++) s->trial[i] = y[i] + h * slope[i];
    if (s->method == ROT_METHOD_SEMI_IMPLICIT) p->positions(t + h, h, y, s->trial, p->ctx);
    return ROT_OK;
  }
  double *sum = s->trial;
  memcpy(f, slope, p->dim * sizeof *f);
  memcpy(sum, slope, p->dim * sizeof *sum);
  for (int k = 1; k < 4; k++) {
    for (size_t i = 0; i < p->dim; i++) at[i] = y[i] + h * node[k] * f[i];
    const rot_status status = rot_ode_slope_at(s->law, t + h * node[k], at, f);
    if (status != ROT_OK) return status;
    for (size_t i = 0; i < p->dim; i++) sum[i] += weight[k] * f[i];
  }
  for (size_t i = 0; i < p->dim; i++) s->trial[i] = y[i] + h / 6.0 * sum[i];
  return ROT_OK;
}

/* Squares of a larger state leave the doubles. */
#define LARGEST_STATE 1e150

/* A step of fixed length, with its slope; a run that leaves the doubles is out of range. */
static rot_status attempt_fixed(rot_ode_stepper *s, double t, double h, const double y[],
                                const double slope[]) {
  const size_t controlled = s->law->p->controlled;
  const double part = h / (double)s->fixed_parts;
  double *from = s->stage + 2 * s->law->p->dim, *rise = from + s->law->p->dim;
  rot_status status = fixed_step(s, t, part, y, slope);
  for (size_t k = 1; k < s->fixed_parts && status == ROT_OK; k++) {
    const double start = t + (double)k * part;
    memcpy(from, s->trial, s->law->p->dim * sizeof *from);
    status = rot_ode_slope_at(s->law, start, from, rise);
    if (status == ROT_OK) status = fixed_step(s, start, part, from, rise);
  }
  if (status == ROT_OK) status = rot_ode_slope_at(s->law, t + h, s->trial, s->trial_slope);
  for (size_t i = 0; i < controlled; i++) {
    const int large = !(fabs(s->trial[i]) <= LARGEST_STATE) || fabs(y[i]) > LARGEST_STATE;
    if (large && (status == ROT_OK || status == ROT_ERHS)) status = ROT_ERANGE;
  }
  if (status == ROT_ERHS || status == ROT_ERANGE) s->law->info->time_s = t + h;
  return status;
}

rot_status rot_ode_attempt(rot_ode_stepper *s, double t, double h, const double y[],
                           const double slope[]) {
  rot_ode_law *law = s->law;
  const size_t dim = law->p->dim;
  int code;
  law->status = ROT_OK;
  s->calls.count = 0;
  if (s->fixed_s > 0.0) return attempt_fixed(s, t, h, y, slope);
  if (s->calls.data && s->method == ROT_METHOD_RK8PD && law->slides == NO_SURFACE) {
    law->record = &s->calls;
  }
  memcpy(s->trial, y, dim * sizeof *y);
  if (s->method == ROT_METHOD_RADAU) {
    allow(s, h, y, slope);
    code = rot_radau_step(s->radau, slope_at, law, t, h, s->trial, s->trial_error, slope,
                          s->allowed, law->surfaces->count > 0);
    if (code == ROT_RADAU_DIVERGED) return ROT_ESTEP;
    if (code == GSL_SUCCESS) code = slope_at(t + h, s->trial, s->trial_slope, law);
  } else {
    code = gsl_odeiv2_step_apply(s->rk, t, h, s->trial, s->trial_error, slope, s->trial_slope,
                                 &s->system);
  }
  law->record = NULL;
  if (code == GSL_SUCCESS) return ROT_OK;
  return law->status != ROT_OK ? law->status : ROT_ENOMEM;
}

double rot_ode_trial_ratio(const rot_ode_stepper *s, double h) {
  const rot_ode_params *p = s->law->p;
  double ratio = 0.0;
  for (size_t i = 0; i < p->controlled; i++) {
    if (!isfinite(s->trial[i])) return NAN;
  }
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    /* Breaking loose, what drives and what resists cancel: their rounding is no error of a step. */
    const double lost = p->turn && g.first == p->turn->watched ? fabs(h) : h * h;
    const double error = fmax(0.0, rot_ode_difference(g, s->trial, s->trial_error) -
                                       16.0 * ROT_EPS * s->noise * lost);
    /* Of its size so far, never of its size later: where errors grow with the motion, what is
     * small against the end is all there is at the start. */
    const double scale =
        fmax(ROT_ODE_MIN_SIZE, fmax(s->state->largest[m], rot_ode_size(g, s->trial)));
    const double noise = p->noise ? p->noise[m] * fabs(h) : 0.0;
    const double allowed = s->tolerance * scale + noise;
    if (error != 0.0 && !(error / allowed <= ratio)) ratio = error / allowed;
  }
  return ratio;
}
