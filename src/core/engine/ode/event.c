#include "engine/ode/event.h"

#include <math.h>
#include <stdint.h>

#include "ground/real.h"

/* An event function, or a component less a level. */
typedef struct look {
  rot_ode_event event;
  double level;
  size_t surface; /* or NO_SURFACE */
  int turns;      /* the switch */
  int slides;     /* the function is rot_ode_hold_of_slide() */
  int kink;       /* need not be met exactly */
} look;

static size_t first_surface(const rot_ode_params *p) { return (p->turn != NULL) + p->n_events; }

static size_t watched(const rot_ode_search *in) {
  return first_surface(in->law->p) + in->law->surfaces->count;
}

size_t rot_ode_surface_of(const rot_ode_search *in, size_t which) {
  const size_t first = first_surface(in->law->p);
  return which >= first && which < watched(in) ? which - first : NO_SURFACE;
}

/* The switch counts as the first event, surfaces as the last. */
static look look_at(const rot_ode_search *in, size_t which) {
  const rot_ode_switch *turn = in->law->p->turn;
  look l = {.surface = rot_ode_surface_of(in, which), .turns = turn && which == 0};
  if (l.turns) {
    l.event.component = turn->watched;
  } else if (l.surface != NO_SURFACE) {
    const rot_ode_surface *w = &in->law->surfaces->surface[l.surface];
    l.event.component = w->component;
    l.level = in->law->side[l.surface] > 0 ? w->below : w->above;
    l.slides = in->law->side[l.surface] == 0;
    l.kink = w->below == w->above;
  } else {
    l.event = in->law->p->events[which - (turn != NULL)];
  }
  return l;
}

static double value_at(rot_ode_search *in, const look *l, double t, const double y[]) {
  if (l->slides) return rot_ode_hold_of_slide(in->law, t, y);
  /* On this side of a jump in time, as the right-hand side; of a state it is the motion's own. */
  if (l->event.g) return l->event.g(rot_ode_keep_time(in->law, t), y, in->law->p->ctx);
  return l->event.component < in->law->p->dim ? y[l->event.component] - l->level : t - l->level;
}

static int is_function(const look *l) { return l->event.g || l->slides; }

double rot_ode_event_value(rot_ode_search *in, size_t which) {
  const look l = look_at(in, which);
  return value_at(in, &l, in->clock->t, in->state->y);
}

/* Its slope along the motion; of a function by a difference over 1e-7 of h. */
static double rise_at(rot_ode_search *in, const look *l, double t, const double y[],
                      const double slope[], double h) {
  if (!is_function(l)) return slope[l->event.component];
  const double d = 1e-7 * h;
  for (size_t i = 0; i < in->law->p->dim; i++) in->between[i] = y[i] + d * slope[i];
  return (value_at(in, l, t + d, in->between) - value_at(in, l, t, y)) / d;
}

static int sign_of(double x) { return (x > 0.0) - (x < 0.0); }

/* `fired`: the watch whose zero this is, with the value `at`. */
static void arm(rot_ode_search *in, size_t k, int fired, double at) {
  const double sign = rot_ode_direction(in->clock);
  const look l = look_at(in, k);
  rot_ode_watch *w = &in->watch[k];
  w->value = value_at(in, &l, in->clock->t, in->state->y);
  if (l.surface != NO_SURFACE) { /* a slide lasts while its function is positive */
    const int time = l.event.component == in->law->p->dim;
    w->fresh = !time && !l.slides && (fired || w->value == 0.0);
    if (w->fresh) w->value = 0.0;
    w->side = time ? 0 : l.slides ? 1 : in->law->side[l.surface];
    return;
  }
  if (l.turns) {
    w->side = *in->law->p->mode;
    w->fresh = in->state->phase == ROT_ODE_LEAVING || in->state->phase == ROT_ODE_UNDECIDED;
    return;
  }
  if (fired && w->value == at) w->value = 0.0;
  w->side = sign_of(w->value);
  if (w->side == 0 && l.event.side && in->clock->forward) {
    w->side = l.event.side(*in->law->p->mode, l.event.component, in->law->p->ctx);
  }
  if (w->side == 0) {
    w->side =
        sign_of(sign * rise_at(in, &l, in->clock->t, in->state->y, in->state->slope, in->step->h));
  }
  w->fresh = w->value == 0.0 && w->side != 0;
}

void rot_ode_arm(rot_ode_search *in, size_t fired, double at) {
  for (size_t k = 0; k < watched(in); k++) arm(in, k, k == fired, at);
}

void rot_ode_arm_last(rot_ode_search *in) { arm(in, watched(in) - 1, 0, 0.0); }

void rot_ode_watch_on(rot_ode_search *in, size_t passed) {
  for (size_t k = 0; k < watched(in); k++) {
    rot_ode_watch *w = &in->watch[k];
    const look l = look_at(in, k);
    const double value = value_at(in, &l, in->clock->t, in->state->y);
    w->fresh = k == passed;
    w->value = w->fresh ? 0.0 : value;
    if (w->fresh) {
      w->side = -w->side;
    } else if (l.surface == NO_SURFACE && !l.turns && value != 0.0) {
      w->side = sign_of(value);
    }
  }
}

/* Whether an event is one where its function leaves this side of zero. */
static int fires(const rot_ode_search *in, const look *l, int side) {
  const int direction = in->clock->forward ? l->event.direction : -l->event.direction;
  return direction == 0 || direction == -side;
}

int rot_ode_is_beyond(rot_ode_search *in, size_t which) {
  const int side = in->watch[which].side;
  const look l = look_at(in, which);
  const double value = value_at(in, &l, in->clock->t, in->state->y);
  return side != 0 && !(side * value >= 0.0) && fires(in, &l, side);
}

int rot_ode_passes_surface(const rot_ode_search *in) {
  const rot_ode_law *law = in->law;
  for (size_t k = 0; k < law->surfaces->count; k++) {
    const int side = law->side[k];
    const int fresh = in->watch[first_surface(law->p) + k].fresh;
    if (rot_ode_is_time(law, k) || side == 0 || fresh) continue;
    const size_t c = law->surfaces->surface[k].component;
    const double level = look_at(in, first_surface(law->p) + k).level;
    const double from = in->state->y[c] - level, to = in->step->trial[c] - level;
    if (side * from > 0.0 && side * to <= 0.0) return 1;
  }
  return 0;
}

/* ---- one event over the trial step ----------------------------------------------------------- */

/* Times its side, x from 0 to 1: of a component its cubic, else the function of the state's. */
typedef struct sight {
  rot_ode_search *in;
  look at;
  double side, h, w[4]; /* w: value and h times slope, at both ends */
  double value, rise;   /* at the end of the part that was tried last: its slope, too */
} sight;

static double cubic(const double w[4], double x) {
  const double u = 1.0 - x;
  return u * u * ((1.0 + 2.0 * x) * w[0] + x * w[1]) + x * x * ((3.0 - 2.0 * x) * w[2] - u * w[3]);
}

static void aim(sight *s, const rot_ode_watch *at, double h) {
  rot_ode_search *in = s->in;
  const size_t i = s->at.event.component;
  s->h = h;
  s->w[0] = at->fresh ? 0.0 : s->side * at->value;
  s->w[2] = s->side * value_at(in, &s->at, in->clock->t + h, in->step->trial);
  if (is_function(&s->at)) return;
  s->w[1] = s->side * in->state->slope[i] * h;
  s->w[3] = s->side * in->step->trial_slope[i] * h;
}

static double seen(const sight *s, double x) {
  rot_ode_search *in = s->in;
  if (!is_function(&s->at)) return cubic(s->w, x);
  for (size_t i = 0; i < in->law->p->dim; i++) {
    const double w[4] = {in->state->y[i], s->h * in->state->slope[i], in->step->trial[i],
                         s->h * in->step->trial_slope[i]};
    in->between[i] = cubic(w, x);
  }
  return s->side * value_at(in, &s->at, in->clock->t + x * s->h, in->between);
}

static rot_status attempt_part(sight *s, double h) {
  rot_ode_search *in = s->in;
  const rot_status status =
      rot_ode_attempt(in->step, in->clock->t, h, in->state->y, in->state->slope);
  if (status != ROT_OK) return status;
  s->value = s->side * value_at(in, &s->at, in->clock->t + h, in->step->trial);
  s->rise =
      s->side * rise_at(in, &s->at, in->clock->t + h, in->step->trial, in->step->trial_slope, h);
  return ROT_OK;
}

/* The zero of the cubic over the step x that was just taken, near its end. */
static double zero_near(sight *s, double x) {
  const rot_ode_watch unseen = {s->w[0] * s->side, 0, s->w[0] == 0.0};
  sight near = *s;
  double at = 1.0;
  aim(&near, &unseen, x);
  for (int k = 0; k < 4; k++) {
    const double u = 1.0 - at, *w = near.w;
    const double rise =
        6.0 * at * u * (w[2] - w[0]) + u * (1.0 - 3.0 * at) * w[1] + at * (3.0 * at - 2.0) * w[3];
    at -= cubic(w, at) / rise;
  }
  return at * x;
}

/* A kink is passed so much of the accuracy and of the step off: a stage at the end of the step sees
 * as much of the wrong side. */
#define KINK_RESOLVED 1e-3

/* Of the span: a jump at the time 0, where a run begins, has no place relative to the time. */
#define MIN_TIME 1e-48

/* Resolution of the time after a step x. */
static double resolved_at(const rot_ode_search *in, double x) {
  const double span = fabs(in->clock->end - in->law->p->start_s);
  return fmax(2.0 * ROT_EPS * fmax(fabs(in->clock->t), fabs(x)), MIN_TIME * span);
}

/* Positive at the start and not so after hi: re-step to the zero by Newton, kept between. *hi
 * becomes that step, trial the state there. */
static rot_status find_zero(sight *s, double *hi) {
  rot_ode_search *in = s->in;
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
    const rot_status status = attempt_part(s, x);
    if (status != ROT_OK) return status;
    const double next = is_function(&s->at) ? x - s->value / s->rise : zero_near(s, x);
    double resolved = resolved_at(in, x);
    if (s->at.kink) resolved = fmax(resolved, KINK_RESOLVED * in->law->p->accuracy * fabs(*hi));
    if (s->value > 0.0) {
      lo = x;
    } else {
      high = x;
    }
    const int closed = fabs(high - lo) <= 2.0 * resolved;
    if (closed && s->at.event.far && s->value > 0.0) {
      x = high;
      const rot_status last = attempt_part(s, x);
      if (last != ROT_OK) return last;
      break;
    }
    if (s->value == 0.0 || fabs(next - x) <= resolved || closed) break;
    const int inside = (next - lo) * (next - high) < 0.0; /* NaN is not */
    x = inside ? next : lo + 0.5 * (high - lo);
  }
  /* On, so far that the slope leaves the surface; it is lost only as the square. */
  if (s->at.slides) {
    x += copysign(fmax(1e-8 * fabs(*hi), 8.0 * ROT_EPS * fabs(in->clock->t)), *hi);
    const rot_status status = attempt_part(s, x);
    if (status != ROT_OK) return status;
  }
  *hi = x;
  if (is_function(&s->at) || s->at.kink) return ROT_OK;
  /* The remainder, below the resolution of the time: what is integrated with it, such as impulses,
   * changes as the component does. */
  const double slope = in->step->trial_slope[s->at.event.component];
  const double left = (s->at.level - in->step->trial[s->at.event.component]) / slope;
  const size_t moved = fabs(left) <= resolved_at(in, x) ? in->law->p->dim : 0;
  for (size_t i = 0; i < moved; i++) in->step->trial[i] += in->step->trial_slope[i] * left;
  in->step->trial[s->at.event.component] = s->at.level;
  return ROT_OK;
}

/* Whether a step h may be cut: a part of some roundings of the time may not move the clock, and is
 * then cut for ever. */
static int moves(const rot_ode_search *in, double h) {
  return fabs(h) > 8.0 * ROT_EPS * fabs(in->clock->t);
}

/* Ends the step at this part of it where that is on the right side. */
static rot_status cut(sight *s, double part, double *h, rot_ode_passage *what) {
  const rot_status status = attempt_part(s, part * *h);
  if (status != ROT_OK || !(s->value > 0.0)) return status;
  *h *= part;
  *what = ROT_ODE_CUT_SHORT;
  return ROT_OK;
}

/* The segment begins at zero and the step ends on the wrong side: was it on the right one? */
static rot_status leave_zero(sight *s, size_t which, double *h, rot_ode_passage *what) {
  const int is_other = !s->at.turns;
  double best = 0.0, x = 0.0;
  for (int k = 1; k < 16; k++) {
    const double here = seen(s, k / 16.0);
    if (best > 0.0 && here <= 0.0) break;
    if (here > best) {
      best = here;
      x = k / 16.0;
    }
  }
  for (double near = 1.0 / 32.0; is_other && best == 0.0 && near > 1e-9; near *= 0.5) {
    best = fmax(0.0, seen(s, near));
    x = near;
  }
  if (best > 0.0 && moves(s->in, x * *h)) {
    *what = ROT_ODE_TRY_SHORTER;
    return cut(s, x, h, what);
  }
  if (!is_other) {
    *what = ROT_ODE_TRY_SHORTER;
    return ROT_OK;
  }
  /* The cubic may miss a short way out of a long step: ask the method itself. */
  for (x = 0.25; x > 1e-4 && moves(s->in, x * *h); x *= 0.25) {
    const rot_status status = cut(s, x, h, what);
    if (status != ROT_OK || *what == ROT_ODE_CUT_SHORT) return status;
  }
  const rot_status status = attempt_part(s, *h);
  if (status != ROT_OK) return status;
  /* It touched zero and went back. */
  s->in->watch[which].side = -s->in->watch[which].side;
  if (s->at.surface != NO_SURFACE) *what = ROT_ODE_OTHER_SIDE;
  return ROT_OK;
}

/* The error of the cubic at a minimum within the step: a part of the lower end; near an end, a
 * part of the difference from there. */
#define CLEAR   0.3
/* A minimum so near an end of the step, as a part of it, is ignored. */
#define NEAREST 1e-6

/* Where the cubic has its minimum within the step; 1 where it has none, or at an end. */
static double minimum_of(const sight *s) {
  const double *w = s->w, nearest = fmax(NEAREST, 8.0 * ROT_EPS * fabs(s->in->clock->t / s->h));
  const double a = 2.0 * (w[0] - w[2]) + w[1] + w[3], b = 3.0 * (w[2] - w[0]) - 2.0 * w[1] - w[3];
  const double square = b * b - 3.0 * a * w[1];
  if (is_function(&s->at) || !(square > 0.0)) return 1.0;
  const double x = b > 0.0 ? -w[1] / (b + sqrt(square)) : (sqrt(square) - b) / (3.0 * a);
  return x > nearest && x < 1.0 - nearest ? x : 1.0;
}

/* The value below which a minimum within the step may be one beyond zero. After a cut the step
 * begins near the minimum. */
static double clear_of(const sight *s) {
  if (s->in->state->phase != ROT_ODE_CUT) return CLEAR * fmin(s->w[0], s->w[2]);
  const double x = minimum_of(s);
  return x < 1.0 ? CLEAR * (s->w[0] - cubic(s->w, x)) : 0.0;
}

/* Samples of a step shorter than this, of the span, resolve an event function. */
#define RESOLVED 1e-3

enum { PARTS = 8 };

static void sample_step(const sight *s, double v[PARTS + 1]) {
  v[0] = s->w[0];
  for (int k = 1; k < PARTS; k++) v[k] = seen(s, k / (double)PARTS);
  v[PARTS] = s->w[2];
}

/* Does the cubic of the even samples miss the odd ones by more than a tenth of `size`? */
static int coarse(const sight *s, const double v[PARTS + 1], double size) {
  double difference = 0.0, highest = 0.0;
  const double span = s->in->clock->end - s->in->law->p->start_s;
  if (!(fabs(s->h) > RESOLVED * fabs(span))) return 0;
  for (int k = 0; k <= PARTS; k++) highest = fmax(highest, fabs(v[k]));
  for (int k = 1; k < PARTS; k += 2) {
    const int a = k == 1 ? 0 : k == PARTS - 1 ? PARTS - 6 : k - 3;
    const double x = (k - a) / 2.0;
    const double cubic = v[a] * (x - 1.0) * (x - 2.0) * (x - 3.0) / -6.0 +
                         v[a + 2] * x * (x - 2.0) * (x - 3.0) / 2.0 -
                         v[a + 4] * x * (x - 1.0) * (x - 3.0) / 2.0 +
                         v[a + 6] * x * (x - 1.0) * (x - 2.0) / 6.0;
    difference = fmax(difference, fabs(v[k] - cubic));
  }
  return difference > 0.1 * size && difference > 1e-9 * highest;
}

/* Where the function comes below `least` within a step with both ends above zero, or that begins at
 * zero: x, 1 where it does not, -1 where eight parts of the step do not resolve it. A function of
 * time may pass zero and come back where the motion rests, and the steps, which see the motion
 * alone, are long: of 977 drives with dry friction one missed a segment of slip. */
static double dip_of(const sight *s, double min, int fresh) {
  double v[PARTS + 1], lowest = INFINITY, dip = 1.0;
  const double bottom = minimum_of(s); /* between two samples */
  if (bottom < 1.0 && cubic(s->w, bottom) < min) return bottom;
  sample_step(s, v);
  for (int k = 0; k <= PARTS; k++) {
    if (k > 0 || !fresh) lowest = fmin(lowest, v[k]);
    if (k > 0 && k < PARTS && v[k] < min) {
      min = v[k];
      dip = k / (double)PARTS;
    }
  }
  if (!s->at.event.g || dip < 1.0) return dip;
  for (int k = 1; k < PARTS; k++) { /* the vertex of the parabola through three */
    const double bend = v[k - 1] - 2.0 * v[k] + v[k + 1], tilt = 0.5 * (v[k + 1] - v[k - 1]);
    if (!(v[k] <= v[k - 1] && v[k] <= v[k + 1] && bend > 0.0)) continue;
    const double x = (k - tilt / bend) / PARTS, here = seen(s, x);
    lowest = fmin(lowest, here);
    if (here < min) {
      min = here;
      dip = x;
    }
  }
  return dip < 1.0 ? dip : coarse(s, v, lowest) ? -1.0 : 1.0;
}

/* The same for a step that ends below zero: where it first comes below, if it rises again. No
 * number of parts resolves a jump; where the function falls all the way, it has one zero. */
static double first_below(const sight *s) {
  double v[PARTS + 1], highest = 0.0;
  int first = PARTS, falls = 1;
  if (!s->at.event.g) return 1.0;
  sample_step(s, v);
  for (int k = 0; k <= PARTS; k++) {
    highest = fmax(highest, fabs(v[k]));
    falls = falls && (k == 0 || v[k] <= v[k - 1]);
    if (first == PARTS && v[k] <= 0.0) first = k;
    if (first < k && v[k] > 0.0) return first / (double)PARTS;
  }
  return !falls && coarse(s, v, highest) ? -1.0 : 1.0;
}

/* A step cut at a minimum of the cubic may end behind that of the motion: back to it. Near its end
 * the cubic of the shorter step errs by a part of what it rises from there. */
static rot_status cut_back(sight *s, const rot_ode_watch *at, double *h) {
  rot_status status = ROT_OK;
  for (int k = 0; k < 10 && status == ROT_OK && s->value > 0.0; k++) {
    aim(s, at, *h);
    const double x = minimum_of(s), here = cubic(s->w, x);
    if (!(x < 1.0 && here < CLEAR * (s->w[2] - here))) return ROT_OK;
    *h *= x;
    status = attempt_part(s, *h);
  }
  return status;
}

static rot_status look_for(rot_ode_search *in, size_t which, double *h, rot_ode_passage *what) {
  rot_ode_watch *at = &in->watch[which];
  sight s = {in, look_at(in, which), at->side, *h, {0.0}, 0.0, 0.0};
  const int counts = fires(in, &s.at, at->side);
  if (at->side == 0) return ROT_OK;
  aim(&s, at, *h);
  const double end = s.w[2];
  if (s.at.turns && at->fresh && s.w[1] == 0.0 && end == 0.0 && s.w[3] == 0.0) {
    return ROT_OK; /* still */
  }
  if (at->fresh && end <= 0.0) {
    const int guess = in->state->phase == ROT_ODE_UNDECIDED && s.at.turns;
    if (!guess) return counts ? leave_zero(&s, which, h, what) : ROT_OK;
    at->side = -at->side;
    *what = ROT_ODE_OTHER_SIDE;
    return ROT_OK;
  }
  /* Between two ends on one side it may dip to the other. */
  double dip = end > 0.0 ? dip_of(&s, clear_of(&s), at->fresh) : first_below(&s);
  if (!moves(in, dip * *h)) dip = 1.0;
  if (dip < 0.0) {
    *h *= 0.5;
    rot_status status = attempt_part(&s, *h);
    if (status == ROT_OK) status = look_for(in, which, h, what);
    if (*what == ROT_ODE_SAME_SIDE) *what = ROT_ODE_CUT_SHORT;
    return status;
  }
  if (end > 0.0 ? dip == 1.0 || (at->fresh && !s.at.event.g) : !counts && dip == 1.0) return ROT_OK;
  if (dip < 1.0) { /* ask the method itself */
    rot_status status = attempt_part(&s, dip * *h);
    *h *= dip;
    if (status == ROT_OK && !is_function(&s.at)) status = cut_back(&s, at, h);
    if (status != ROT_OK) return status;
    if (s.value > 0.0 || !counts) {
      *what = ROT_ODE_CUT_SHORT;
      return ROT_OK;
    }
    aim(&s, at, *h);
    if (at->fresh) {
      const rot_status left = leave_zero(&s, which, h, what);
      if (*what == ROT_ODE_SAME_SIDE) *what = ROT_ODE_CUT_SHORT;
      return left;
    }
  }
  *what = ROT_ODE_AT_ZERO;
  return find_zero(&s, h);
}

rot_status rot_ode_look_for_events(rot_ode_search *in, double *h, rot_ode_passage *what,
                                   size_t *which) {
  *what = ROT_ODE_SAME_SIDE;
  *which = SIZE_MAX;
  for (size_t k = 0; k < watched(in); k++) {
    /* Each event that is found shortens the step, so that the last one found is the first. */
    const double whole = *h;
    rot_ode_passage here = ROT_ODE_SAME_SIDE;
    const rot_status status = look_for(in, k, h, &here);
    if (status != ROT_OK) return status;
    if (here == ROT_ODE_SAME_SIDE && *h == whole) continue;
    *what = here;
    *which = here == ROT_ODE_AT_ZERO || here == ROT_ODE_OTHER_SIDE ? k : SIZE_MAX;
    if (here == ROT_ODE_TRY_SHORTER || here == ROT_ODE_OTHER_SIDE) return ROT_OK;
  }
  return ROT_OK;
}
