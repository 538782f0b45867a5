#include "engine/ode/law.h"

#include <math.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

/* ---- beside surfaces ------------------------------------------------------------------------- */

static void keep_side(const rot_ode_law *law, size_t surface, double *x) {
  const rot_ode_surface *w = &law->surfaces->surface[surface];
  if (law->side[surface] > 0) *x = fmax(*x, w->above);
  if (law->side[surface] < 0) *x = fmin(*x, w->below);
}

static void keep_sides(const rot_ode_law *law, double *t, double y[]) {
  for (size_t k = 0; k < law->surfaces->count; k++) {
    keep_side(law, k, rot_ode_is_time(law, k) ? t : &y[law->surfaces->surface[k].component]);
  }
}

double rot_ode_keep_time(const rot_ode_law *law, double t) {
  for (size_t k = 0; k < law->surfaces->count; k++) {
    if (rot_ode_is_time(law, k)) keep_side(law, k, &t);
  }
  return t;
}

/* Slopes on both sides of a surface. */
static rot_status both_slopes(rot_ode_law *law, size_t surface, double t, const double y[],
                              double below[], double above[]) {
  const int side = law->side[surface];
  const size_t slides = law->slides;
  law->slides = NO_SURFACE;
  law->side[surface] = -1;
  rot_status status = rot_ode_slope_at(law, t, y, below);
  law->side[surface] = 1;
  if (status == ROT_OK) status = rot_ode_slope_at(law, t, y, above);
  law->side[surface] = side;
  law->slides = slides;
  return status;
}

static rot_status sliding_slope(rot_ode_law *law, double t, const double y[], double dydt[]) {
  const size_t c = law->surfaces->surface[law->slides].component;
  double *above = law->beyond;
  const rot_status status = both_slopes(law, law->slides, t, y, dydt, above);
  if (status != ROT_OK) return status;
  const double difference = dydt[c] - above[c];
  const double part = difference != 0.0 ? fmin(1.0, fmax(0.0, dydt[c] / difference)) : 0.5;
  for (size_t i = 0; i < law->p->dim; i++) dydt[i] += part * (above[i] - dydt[i]);
  dydt[c] = 0.0;
  return ROT_OK;
}

double rot_ode_hold_of_slide(rot_ode_law *law, double t, const double y[]) {
  const size_t c = law->surfaces->surface[law->slides].component;
  const double direction = rot_ode_direction(law->clock);
  double *below = law->beside, *above = law->beyond;
  if (both_slopes(law, law->slides, t, y, below, above) != ROT_OK) return NAN;
  return fmin(direction * below[c], -direction * above[c]);
}

/* ---- its calls ------------------------------------------------------------------------------- */

static void note_stiffness(rot_ode_stiffness *s, double t, const double y[], const double f[]) {
  const rot_ode_params *p = s->p;
  if (t == s->t) {
    double difference = 0.0, rise = 0.0;
    int resolved = 0;
    for (size_t i = 0; i < p->controlled; i++) {
      s->y[i] -= y[i];
      s->f[i] -= f[i];
    }
    for (size_t m = 0; m < rot_ode_steering(p); m++) {
      const rot_ode_group g = rot_ode_group_of(p, m);
      const double now = rot_ode_size(g, y),
                   size = fmax(ROT_ODE_MIN_SIZE, fmax(s->largest[m], now));
      resolved |= rot_ode_rate(g, s->y) > 64.0 * ROT_EPS * now;
      difference = fmax(difference, rot_ode_rate(g, s->y) / size);
      rise = fmax(rise, rot_ode_rate(g, s->f) / size);
    }
    /* Differences at rounding level say nothing about stiffness. */
    s->rate = resolved ? rise / difference : 0.0;
  }
  s->t = t;
  memcpy(s->y, y, p->controlled * sizeof *y);
  memcpy(s->f, f, p->controlled * sizeof *f);
}

/* A stiff problem costs an explicit method steps that its error test would not need. */
int rot_ode_is_stiff(rot_ode_stiffness *s, double h, double left) {
  if (fabs(h) * s->rate > 4.0) {
    s->stiff++;
    s->calm = 0;
  } else if (++s->calm >= 6) {
    s->stiff = 0;
  }
  return s->stiff >= 15 && fabs(left) > 50.0 * fabs(h);
}

static rot_status call(rot_ode_law *law, double t, const double y[], double dydt[]) {
  const rot_ode_params *p = law->p;
  rot_ode_calls *record = law->record;
  /* A trial state may have left the doubles: a law is not defined there, and is not called. */
  for (size_t i = 0; i < p->controlled; i++) {
    if (!isfinite(y[i])) return ROT_ERHS;
  }
  law->info->rhs_calls++;
  if (record && record->count < ROT_ODE_CALLS) {
    double *at = record->data + record->count++ * (1 + p->controlled);
    at[0] = t;
    memcpy(at + 1, y, p->controlled * sizeof *y);
  }
  const rot_status status = p->rhs(t, y, dydt, p->ctx);
  for (size_t i = 0; i < p->controlled && status == ROT_OK; i++) {
    if (!isfinite(dydt[i])) return ROT_ERHS;
  }
  return status;
}

rot_status rot_ode_slope_at(rot_ode_law *law, double t, const double y[], double dydt[]) {
  const rot_ode_clock *clock = law->clock;
  if (law->slides != NO_SURFACE) return sliding_slope(law, t, y, dydt);
  t = t < clock->after ? clock->after : t > clock->before ? clock->before : t;
  if (law->surfaces->count) {
    memcpy(law->kept, y, law->p->dim * sizeof *y);
    keep_sides(law, &t, law->kept);
    y = law->kept;
  }
  law->status = call(law, t, y, dydt);
  if (law->status == ROT_ERHS) law->info->time_s = t;
  if (law->status == ROT_OK && law->stiffness) note_stiffness(law->stiffness, t, y, dydt);
  return law->status;
}

rot_status rot_ode_know_slope(rot_ode_law *law, rot_ode_state *state) {
  if (state->slope_known) return ROT_OK;
  const rot_status status = rot_ode_slope_at(law, law->clock->t, state->y, state->slope);
  state->slope_known = status == ROT_OK;
  return status;
}

rot_status rot_ode_check_repeats(rot_ode_law *law, rot_ode_state *state, double work[]) {
  const rot_ode_params *p = law->p;
  const double may = fmax(1e-12, p->accuracy);
  state->slope_known = 0;
  rot_status status = rot_ode_know_slope(law, state);
  if (status == ROT_OK) status = rot_ode_slope_at(law, law->clock->t, state->y, work);
  if (law->stiffness) law->stiffness->t = NAN; /* no two stages of a step */
  if (status == ROT_ERHS) return ROT_OK;       /* the step says so */
  for (size_t i = 0; i < p->controlled && status == ROT_OK; i++) {
    const double size = fmax(fabs(state->slope[i]), fabs(work[i]));
    if (fabs(state->slope[i] - work[i]) > may * size) status = ROT_ERANDOM;
  }
  if (status == ROT_ERANDOM) law->info->time_s = law->clock->t;
  return status;
}

/* ---- sides ----------------------------------------------------------------------------------- */

static void settle(rot_ode_law *law, rot_ode_state *state, size_t surface, int side) {
  const rot_ode_surface *w = &law->surfaces->surface[surface];
  law->side[surface] = side;
  law->slides = side ? law->slides == surface ? NO_SURFACE : law->slides : surface;
  state->slope_known = 0;
  if (w->below == w->above) return;
  if (side) {
    state->y[w->component] = side > 0 ? w->above : w->below;
  } else {
    state->y[w->component] = w->below < 0.0 && w->above > 0.0 ? 0.0 : w->above;
  }
}

rot_status rot_ode_pass_surface(rot_ode_law *law, rot_ode_state *state, size_t surface) {
  const size_t c = law->surfaces->surface[surface].component;
  const double direction = rot_ode_direction(law->clock);
  const int was = law->side[surface];
  double *below = law->beside, *above = law->beyond;
  const rot_status status = both_slopes(law, surface, law->clock->t, state->y, below, above);
  if (status != ROT_OK && status != ROT_ERHS) return status;
  if (status == ROT_ERHS) {
    settle(law, state, surface, was ? -was : 1); /* not defined beyond: the next step says so */
    return ROT_OK;
  }
  const double down = direction * below[c], up = direction * above[c];
  if (down > 0.0 && up < 0.0 && law->slides == NO_SURFACE) {
    settle(law, state, surface, 0);
  } else if (was > 0 || (was == 0 && down <= -up)) {
    settle(law, state, surface, down > 0.0 && up > 0.0 ? 1 : -1);
  } else {
    settle(law, state, surface, up < 0.0 && down < 0.0 ? -1 : 1);
  }
  return ROT_OK;
}

rot_status rot_ode_choose_side(rot_ode_law *law, rot_ode_state *state, size_t k) {
  const rot_ode_surface *w = &law->surfaces->surface[k];
  const double x = rot_ode_is_time(law, k) ? law->clock->t : state->y[w->component];
  const int later = rot_ode_is_time(law, k) && law->clock->forward ? x >= w->above : x > w->above;
  law->side[k] = later ? 1 : -1;
  if (rot_ode_is_time(law, k) || x < w->below || x > w->above) return ROT_OK;
  law->side[k] = 0;
  return rot_ode_pass_surface(law, state, k);
}

rot_status rot_ode_choose_sides(rot_ode_law *law, rot_ode_state *state) {
  rot_status status = ROT_OK;
  law->slides = NO_SURFACE;
  memset(law->side, 0, sizeof law->side);
  for (size_t k = 0; k < law->surfaces->count && status == ROT_OK; k++)
    status = rot_ode_choose_side(law, state, k);
  return status;
}

int rot_ode_add_surface(rot_ode_surfaces *surfaces, size_t component, double below, double above,
                        double size) {
  const double near = 1e-9 * (fabs(below) + fabs(size));
  if (surfaces->count == ROT_ODE_MAX_SURFACES) return 0;
  for (size_t k = 0; k < surfaces->count; k++) {
    const rot_ode_surface *w = &surfaces->surface[k];
    if (w->component == component && above >= w->below - near && below <= w->above + near) return 0;
  }
  surfaces->surface[surfaces->count++] = (rot_ode_surface){component, below, above};
  return 1;
}

double rot_ode_next_stop(const rot_ode_law *law, double stop) {
  for (size_t k = 0; k < law->surfaces->count; k++) {
    const rot_ode_surface *w = &law->surfaces->surface[k];
    if (!rot_ode_is_time(law, k)) continue;
    if (law->clock->forward ? law->side[k] < 0 && w->above < stop
                            : law->side[k] > 0 && w->below > stop) {
      stop = law->clock->forward ? w->above : w->below;
    }
  }
  return stop;
}

static int at_time(const rot_ode_law *law, size_t k) {
  const rot_ode_surface *w = &law->surfaces->surface[k];
  return rot_ode_is_time(law, k) && law->side[k] == (law->clock->forward ? -1 : 1) &&
         law->clock->t == (law->clock->forward ? w->above : w->below);
}

int rot_ode_at_time_surface(const rot_ode_law *law) {
  int at = 0;
  for (size_t k = 0; k < law->surfaces->count; k++) at |= at_time(law, k);
  return at;
}

void rot_ode_pass_time(rot_ode_law *law, rot_ode_state *state) {
  for (size_t k = 0; k < law->surfaces->count; k++) {
    if (at_time(law, k)) law->side[k] = -law->side[k];
  }
  state->slope_known = 0;
}
