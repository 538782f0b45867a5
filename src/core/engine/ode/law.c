#include "engine/ode/law.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

/* ---- beside walls ---------------------------------------------------------------------------- */

static void keep_side(const rot_ode_law *law, size_t wall, double *x) {
  const rot_ode_wall *w = &law->walls->wall[wall];
  if (law->side[wall] > 0) *x = fmax(*x, w->above);
  if (law->side[wall] < 0) *x = fmin(*x, w->below);
}

static void keep_sides(const rot_ode_law *law, double *t, double y[]) {
  for (size_t k = 0; k < law->walls->count; k++) {
    keep_side(law, k, rot_ode_is_time(law, k) ? t : &y[law->walls->wall[k].component]);
  }
}

double rot_ode_keep_time(const rot_ode_law *law, double t) {
  for (size_t k = 0; k < law->walls->count; k++) {
    if (rot_ode_is_time(law, k)) keep_side(law, k, &t);
  }
  return t;
}

int rot_ode_both_slopes(rot_ode_law *law, size_t wall, double t, const double y[], double below[],
                        double above[]) {
  const int side = law->side[wall];
  const size_t slides = law->slides;
  law->slides = NO_WALL;
  law->side[wall] = -1;
  int code = rot_ode_slope_at(t, y, below, law);
  law->side[wall] = 1;
  if (code == GSL_SUCCESS) code = rot_ode_slope_at(t, y, above, law);
  law->side[wall] = side;
  law->slides = slides;
  return code;
}

static int sliding_slope(rot_ode_law *law, double t, const double y[], double dydt[]) {
  const size_t c = law->walls->wall[law->slides].component;
  double *above = law->beyond;
  const int code = rot_ode_both_slopes(law, law->slides, t, y, dydt, above);
  if (code != GSL_SUCCESS) return code;
  const double apart = dydt[c] - above[c];
  const double part = apart != 0.0 ? fmin(1.0, fmax(0.0, dydt[c] / apart)) : 0.5;
  for (size_t i = 0; i < law->p->dim; i++) dydt[i] += part * (above[i] - dydt[i]);
  dydt[c] = 0.0;
  return GSL_SUCCESS;
}

double rot_ode_hold_of_slide(rot_ode_law *law, double t, const double y[]) {
  const size_t c = law->walls->wall[law->slides].component;
  const double way = rot_ode_way(law->clock);
  double *below = law->beside, *above = law->beyond;
  if (rot_ode_both_slopes(law, law->slides, t, y, below, above) != GSL_SUCCESS) return NAN;
  return fmin(way * below[c], -way * above[c]);
}

double rot_ode_wall_level(const rot_ode_law *law, size_t wall) {
  const rot_ode_wall *w = &law->walls->wall[wall];
  return law->side[wall] > 0 ? w->below : w->above;
}

/* ---- its calls ------------------------------------------------------------------------------- */

int rot_ode_slope_at(double t, const double y[], double dydt[], void *ctx) {
  rot_ode_law *law = ctx;
  if (law->slides != NO_WALL) return sliding_slope(law, t, y, dydt);
  t = t < law->clock->after ? law->clock->after : t > law->clock->before ? law->clock->before : t;
  if (law->walls->count) {
    memcpy(law->kept, y, law->p->dim * sizeof *y);
    keep_sides(law, &t, law->kept);
    y = law->kept;
  }
  /* A trial state may have left the doubles: a law is not defined there, and is not called. */
  law->status = ROT_OK;
  for (size_t i = 0; i < law->p->controlled; i++) {
    if (!isfinite(y[i])) law->status = ROT_ERHS;
  }
  if (law->status == ROT_OK) {
    law->info->rhs_calls++;
    if (law->record && law->record->count < ROT_ODE_CALLS) {
      double *call = law->record->data + law->record->count++ * (1 + law->p->controlled);
      call[0] = t;
      memcpy(call + 1, y, law->p->controlled * sizeof *y);
    }
    law->status = law->p->rhs(t, y, dydt, law->p->ctx);
  }
  for (size_t i = 0; i < law->p->controlled && law->status == ROT_OK; i++) {
    if (!isfinite(dydt[i])) law->status = ROT_ERHS;
  }
  if (law->status == ROT_ERHS) law->info->time_s = t;
  if (law->status != ROT_OK) return GSL_EBADFUNC; /* the only code at which rk8pd stops at once */
  if (law->stiffness) rot_ode_stiffness_note(law->stiffness, t, y, dydt);
  return GSL_SUCCESS;
}

rot_status rot_ode_know_slope(rot_ode_law *law, rot_ode_state *state) {
  if (state->slope_known) return ROT_OK;
  if (rot_ode_slope_at(law->clock->t, state->y, state->slope, law) != GSL_SUCCESS)
    return law->status;
  state->slope_known = 1;
  return ROT_OK;
}

rot_status rot_ode_check_repeats(rot_ode_law *law, rot_ode_state *state, double work[]) {
  const rot_ode_params *p = law->p;
  const double may = fmax(1e-12, p->accuracy);
  state->slope_known = 0;
  rot_status status = rot_ode_know_slope(law, state);
  if (status == ROT_OK && rot_ode_slope_at(law->clock->t, state->y, work, law) != GSL_SUCCESS) {
    status = law->status;
  }
  if (law->stiffness) law->stiffness->t = NAN; /* no two stages of a step */
  if (status == ROT_ERHS) return ROT_OK;       /* the step says so */
  for (size_t i = 0; i < p->controlled && status == ROT_OK; i++) {
    const double size = fmax(fabs(state->slope[i]), fabs(work[i]));
    if (fabs(state->slope[i] - work[i]) > may * size) status = ROT_ERANDOM;
  }
  if (status == ROT_ERANDOM) law->info->time_s = law->clock->t;
  return status;
}
