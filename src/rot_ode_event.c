#include "rot_ode_event.h"

#include <math.h>
#include <stdint.h>

#include "rot_ode_step.h"
#include "rot_real.h"

/* The switch counts as the first event. */
static rot_ode_event event_of(const rot_ode_march *run, size_t which) {
  const rot_ode_switch *turn = run->p->turn;
  if (turn && which == 0) {
    const rot_ode_event zero = {NULL, turn->watched, 0, ROT_EVENT_REVERSE, NULL};
    return zero;
  }
  return run->p->events[which - (turn != NULL)];
}

static int is_switch(const rot_ode_march *run, size_t which) { return run->p->turn && which == 0; }

static double value_at(const rot_ode_march *run, const rot_ode_event *e, double t,
                       const double y[]) {
  return e->g ? e->g(t, y, run->p->ctx) : y[e->component];
}

double rot_ode_event_value(const rot_ode_march *run, size_t which) {
  const rot_ode_event e = event_of(run, which);
  return value_at(run, &e, run->t, run->y);
}

/* Its slope along the motion; of a function by a difference over 1e-7 of h. */
static double rise_at(rot_ode_march *run, const rot_ode_event *e, double t, const double y[],
                      const double slope[], double h) {
  if (!e->g) return slope[e->component];
  const double d = 1e-7 * h;
  for (size_t i = 0; i < run->p->dim; i++) run->change[i] = y[i] + d * slope[i];
  return (value_at(run, e, t + d, run->change) - value_at(run, e, t, y)) / d;
}

static int sign_of(double x) { return (x > 0.0) - (x < 0.0); }

void rot_ode_arm(rot_ode_march *run, size_t fired, double at) {
  const double way = run->forward ? 1.0 : -1.0;
  for (size_t k = 0; k < run->n_watch; k++) {
    const rot_ode_event e = event_of(run, k);
    rot_ode_watch *w = &run->watch[k];
    w->value = value_at(run, &e, run->t, run->y);
    if (is_switch(run, k)) {
      w->side = *run->p->mode;
      w->fresh = run->phase == ROT_ODE_LEAVING || run->phase == ROT_ODE_UNDECIDED;
      continue;
    }
    if (k == fired && w->value == at) w->value = 0.0;
    w->side = sign_of(w->value);
    if (w->side == 0) {
      w->side = sign_of(way * rise_at(run, &e, run->t, run->y, run->slope, run->h));
    }
    w->fresh = w->value == 0.0 && w->side != 0;
  }
}

void rot_ode_watch_on(rot_ode_march *run, size_t passed) {
  for (size_t k = 0; k < run->n_watch; k++) {
    rot_ode_watch *w = &run->watch[k];
    w->value = rot_ode_event_value(run, k);
    w->fresh = k == passed;
    if (k == passed) {
      w->value = 0.0;
      w->side = -w->side;
    } else if (!is_switch(run, k) && w->value != 0.0) {
      w->side = sign_of(w->value);
    }
  }
}

/* ---- one event over the trial step ----------------------------------------------------------- */

/* Times its side, x from 0 to 1: of a component its cubic, else the function of the state's. */
typedef struct sight {
  rot_ode_march *run;
  rot_ode_event event;
  double side, h, w[4]; /* w: value and h times slope, at both ends */
} sight;

static double cubic(const double w[4], double x) {
  const double u = 1.0 - x;
  return u * u * ((1.0 + 2.0 * x) * w[0] + x * w[1]) + x * x * ((3.0 - 2.0 * x) * w[2] - u * w[3]);
}

static void aim(sight *s, const rot_ode_watch *at, double h) {
  const rot_ode_march *run = s->run;
  const size_t i = s->event.component;
  s->h = h;
  s->w[0] = at->fresh ? 0.0 : s->side * at->value;
  s->w[2] = s->side * value_at(run, &s->event, run->t + h, run->trial);
  if (s->event.g) return;
  s->w[1] = s->side * run->slope[i] * h;
  s->w[3] = s->side * run->trial_slope[i] * h;
}

static double seen(const sight *s, double x) {
  const rot_ode_march *run = s->run;
  if (!s->event.g) return cubic(s->w, x);
  for (size_t i = 0; i < run->p->dim; i++) {
    const double w[4] = {run->y[i], s->h * run->slope[i], run->trial[i],
                         s->h * run->trial_slope[i]};
    run->change[i] = cubic(w, x);
  }
  return s->side * value_at(run, &s->event, run->t + x * s->h, run->change);
}

static rot_status attempt_part(sight *s, double h, double *w, double *rise) {
  rot_ode_march *run = s->run;
  const rot_status status = rot_ode_attempt(run, run->t, h, run->y, run->slope);
  if (status != ROT_OK) return status;
  *w = s->side * value_at(run, &s->event, run->t + h, run->trial);
  *rise = s->side * rise_at(run, &s->event, run->t + h, run->trial, run->trial_slope, h);
  return ROT_OK;
}

/* Positive at the start and not so after hi: re-step to the zero by Newton, kept between. *hi
 * becomes that step, trial the state there. */
static rot_status find_zero(sight *s, double *hi) {
  rot_ode_march *run = s->run;
  double lo = 0.0, high = *hi, a = 0.0, b = 1.0;
  for (int k = 0; k < 40; k++) { /* first guess: the zero of the cubic, whose 1 is the whole step */
    const double mid = 0.5 * (a + b);
    if (seen(s, mid) > 0.0) {
      a = mid;
    } else {
      b = mid;
    }
  }
  double x = b * *hi;
  for (int k = 0; k < 200; k++) {
    double v, rise;
    const rot_status status = attempt_part(s, x, &v, &rise);
    if (status != ROT_OK) return status;
    const double next = x - v / rise, resolved = 2.0 * ROT_EPS * fmax(fabs(run->t), fabs(x));
    if (v > 0.0) {
      lo = x;
    } else {
      high = x;
    }
    if (v == 0.0 || fabs(next - x) <= resolved || fabs(high - lo) <= 2.0 * resolved) break;
    const int inside = (next - lo) * (next - high) < 0.0; /* NaN is not */
    x = inside ? next : lo + 0.5 * (high - lo);
  }
  *hi = x;
  if (!s->event.g) run->trial[s->event.component] = 0.0;
  return ROT_OK;
}

/* The stretch begins at zero and the step ends on the wrong side: was it on the right one? */
static rot_status leave_zero(sight *s, size_t which, double *h, rot_ode_passage *what) {
  double best = 0.0, x = 0.0, v, rise;
  for (int k = 1; k < 16; k++) {
    const double here = seen(s, k / 16.0);
    if (here > best) {
      best = here;
      x = k / 16.0;
    }
  }
  if (!is_switch(s->run, which)) {
    for (x = best > 0.0 ? x : 1.0 / 32.0; best == 0.0 && x > 1e-9; x *= best > 0.0 ? 1.0 : 0.5) {
      best = fmax(0.0, seen(s, x));
    }
    if (best == 0.0) { /* touched zero and went back */
      s->run->watch[which].side = -s->run->watch[which].side;
      return ROT_OK;
    }
  }
  *what = ROT_ODE_TRY_SHORTER;
  if (best == 0.0) return ROT_OK;
  const rot_status status = attempt_part(s, x * *h, &v, &rise);
  if (status == ROT_OK && v > 0.0) {
    *h *= x;
    *what = ROT_ODE_CUT_SHORT;
  }
  return status;
}

static rot_status look_for(rot_ode_march *run, size_t which, double *h, rot_ode_passage *what) {
  rot_ode_watch *at = &run->watch[which];
  sight s = {run, event_of(run, which), at->side, *h, {0.0}};
  const int upward = run->forward ? s.event.direction : -s.event.direction;
  const int fires = s.event.direction == 0 || upward == -at->side;
  if (at->side == 0) return ROT_OK;
  aim(&s, at, *h);
  const double end = s.w[2];
  if (is_switch(run, which) && at->fresh && s.w[1] == 0.0 && end == 0.0 && s.w[3] == 0.0) {
    return ROT_OK; /* still */
  }
  if (at->fresh && end <= 0.0) {
    if (run->phase != ROT_ODE_UNDECIDED || !is_switch(run, which)) {
      return fires ? leave_zero(&s, which, h, what) : ROT_OK;
    }
    run->phase = ROT_ODE_LEAVING;
    *run->p->mode = at->side = -at->side;
    run->slope_known = 0;
    *what = ROT_ODE_TRY_SHORTER;
    return ROT_OK;
  }
  /* Between two ends on one side it may dip to the other. The cubic is of order 4, so that it is
   * believed only where it stays clear of zero. */
  double dip = 1.0, least = run->phase == ROT_ODE_CUT ? 0.0 : 0.3 * fmin(s.w[0], end);
  for (int k = 1; k < 8 && end > 0.0; k++) {
    const double here = seen(&s, 0.125 * k);
    if (here < least) {
      least = here;
      dip = 0.125 * k;
    }
  }
  if (end > 0.0 ? dip == 1.0 || at->fresh : !fires) return ROT_OK;
  if (dip < 1.0) { /* ask the method itself */
    double v, rise;
    const rot_status status = attempt_part(&s, dip * *h, &v, &rise);
    if (status != ROT_OK) return status;
    *h *= dip;
    if (v > 0.0 || !fires) {
      *what = ROT_ODE_CUT_SHORT;
      return ROT_OK;
    }
    aim(&s, at, *h);
  }
  *what = ROT_ODE_AT_ZERO;
  return find_zero(&s, h);
}

rot_status rot_ode_look_for_events(rot_ode_march *run, double *h, rot_ode_passage *what,
                                   size_t *which) {
  *what = ROT_ODE_SAME_SIDE;
  *which = SIZE_MAX;
  for (size_t k = 0; k < run->n_watch; k++) {
    /* Each event that is found shortens the step, so that the last one found is the first. */
    const double whole = *h;
    rot_ode_passage here = ROT_ODE_SAME_SIDE;
    const rot_status status = look_for(run, k, h, &here);
    if (status != ROT_OK) return status;
    if (here == ROT_ODE_SAME_SIDE && *h == whole) continue;
    *what = here;
    *which = here == ROT_ODE_AT_ZERO ? k : SIZE_MAX;
    if (here == ROT_ODE_TRY_SHORTER) return ROT_OK;
  }
  return ROT_OK;
}
