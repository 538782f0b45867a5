#include "engine/ode/kink.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"

/* The slope is sampled at the ends of equal gaps. Over the gap with the kink the slope's slope
 * changes so many times as much as over the gaps beside it. */
enum { GAPS = 12, SIDE = 3 };
#define SHARP 4.0

/* A cubic between two states, and room for what is sampled along it. */
typedef struct path {
  rot_ode_law *law;
  double t, h, wish;             /* wish: a step here, by which surfaces are apart */
  double *y[2], *slope[2];       /* at its ends */
  double *state, *moved, *after; /* dim each */
  double *sample;                /* GAPS + 1 times dim */
} path;

/* The path's state at s, and its time. */
static double state_at(const path *w, double s, double y[]) {
  for (size_t k = 0; k < w->law->p->dim; k++) {
    const double up = w->y[1][k] - w->y[0][k];
    const double bend = (1.0 - s) * (w->h * w->slope[0][k] - up) - s * (w->h * w->slope[1][k] - up);
    y[k] = w->y[0][k] + s * (up + (1.0 - s) * bend);
  }
  return w->t + s * w->h;
}

static rot_status slope_at(const path *w, double s, double dydt[]) {
  const double t = state_at(w, s, w->state);
  return rot_ode_slope_at(w->law, t, w->state, dydt);
}

/* The zero in [0, 1] of the parabola through d at 0, 1/2, 1; NaN if there is none. */
static double parabola_zero(const double d[3]) {
  const double bend = 2.0 * (d[0] - 2.0 * d[1] + d[2]), rise = d[2] - d[0] - bend;
  const double root = sqrt(fmax(0.0, rise * rise - 4.0 * bend * d[0]));
  const double part = -2.0 * d[0] / (rise + copysign(root, rise));
  return part >= 0.0 && part <= 1.0 ? part : NAN;
}

/* The parabolas through three values on the left and on the right of a point, 1, 3 and 5 away:
 * their difference at -1, 0 and 1. */
static void subtract_parabolas(const double l[SIDE], const double r[SIDE], double d[3]) {
  d[0] = (3.0 * r[0] - 3.0 * r[1] + r[2]) - l[0];
  d[1] = (1.875 * r[0] - 1.25 * r[1] + 0.375 * r[2]) - (1.875 * l[0] - 1.25 * l[1] + 0.375 * l[2]);
  d[2] = r[0] - (3.0 * l[0] - 3.0 * l[1] + l[2]);
}

static rot_status sample(const path *w) {
  const size_t dim = w->law->p->dim;
  rot_status status = ROT_OK;
  memcpy(w->sample, w->slope[0], dim * sizeof *w->sample);
  memcpy(w->sample + GAPS * dim, w->slope[1], dim * sizeof *w->sample);
  for (size_t i = 1; i < GAPS && status == ROT_OK; i++) {
    status = slope_at(w, (double)i / GAPS, w->sample + i * dim);
  }
  return status;
}

/* Of component k of the samples: by what each gap changes it, and its largest size. */
static double rises(const path *w, size_t k, double rise[GAPS]) {
  const size_t dim = w->law->p->dim;
  const double *f = w->sample + k;
  double size = fabs(f[0]);
  for (size_t i = 0; i < GAPS; i++, f += dim) {
    size = fmax(size, fabs(f[dim]));
    rise[i] = f[dim] - f[0];
  }
  return size;
}

/* The sharpest kink of the samples, as a part of the path, in component *which of the slope; NaN
 * where they show none. */
static double sharpest(const path *w, size_t *which) {
  double max = 0.0, s = NAN;
  *which = 0;
  for (size_t k = 0; k < w->law->p->controlled; k++) {
    double rise[GAPS];
    const double size = rises(w, k, rise);
    for (size_t i = 1; i + 1 < GAPS; i++) {
      const double turn = rise[i + 1] - rise[i - 1], part = (rise[i + 1] - rise[i]) / turn;
      const double smooth = (i > 1 ? fabs(rise[i - 1] - rise[i - 2]) : 0.0) +
                            (i + 2 < GAPS ? fabs(rise[i + 2] - rise[i + 1]) : 0.0);
      if (part >= -0.1 && part <= 1.1 && fabs(turn) > fmax(SHARP * smooth, max * size)) {
        max = fabs(turn) / size;
        s = ((double)i + part) / GAPS;
        *which = k;
      }
    }
  }
  return s;
}

/* Component k of the slope at w->state, with coordinate i (dim: time) put to x; i = dim + 1: at x
 * along the path. */
static rot_status slope_with(const path *w, double t, size_t i, double x, size_t k, double *f) {
  const size_t dim = w->law->p->dim;
  rot_status status;
  if (i > dim) {
    status = slope_at(w, x, w->sample);
  } else {
    double *y = w->moved;
    memcpy(y, w->state, dim * sizeof *y);
    *(i < dim ? &y[i] : &t) = x;
    status = rot_ode_slope_at(w->law, t, y, w->sample);
  }
  *f = w->sample[k];
  return status;
}

/* The difference of the parabolas on the two sides of *x along coordinate i, as `strength`, twice
 * `apart` times the jump of the slope; *x moves to where they meet, at most `apart` from it. */
static rot_status kink_along(const path *w, double t, size_t i, size_t k, double difference,
                             double *x, double *strength) {
  double f[2][SIDE], d[3];
  for (int j = 0; j < 2 * SIDE; j++) {
    const double direction = j < SIDE ? -1.0 : 1.0;
    const rot_status status =
        slope_with(w, t, i, *x + direction * (double)(1 + 2 * (j % SIDE)) * difference, k,
                   &f[j / SIDE][j % SIDE]);
    if (status != ROT_OK) return status;
  }
  subtract_parabolas(f[0], f[1], d);
  *strength = fabs(d[2] - d[0]);
  *x += difference * (2.0 * parabola_zero(d) - 1.0);
  return ROT_OK;
}

static rot_status find(const path *w, double *s) {
  size_t which;
  double strength;
  const rot_status status = sample(w);
  if (status != ROT_OK) return status;
  *s = sharpest(w, &which);
  if (isnan(*s)) return ROT_OK;
  return kink_along(w, 0.0, w->law->p->dim + 1, which, 0.125 / GAPS, s, &strength);
}

/* ---- surfaces -------------------------------------------------------------------------------- */

/* The gap of the samples over which component *which of the slope jumps; -1: there is none. */
static int jump_gap(const path *w, size_t *which) {
  double max = 0.0;
  int gap = -1;
  for (size_t k = 0; k < w->law->p->controlled; k++) {
    double rise[GAPS];
    const double size = rises(w, k, rise);
    for (int i = 0; i < GAPS; i++) {
      double beside = 0.0;
      for (int j = -2; j <= 2; j++) {
        if (j && i + j >= 0 && i + j < GAPS) beside = fmax(beside, fabs(rise[i + j]));
      }
      if (fabs(rise[i]) > fmax(SHARP / 2.0 * beside, max * size)) {
        max = fabs(rise[i]) / size;
        gap = i;
        *which = k;
      }
    }
  }
  return gap;
}

/* Halves [*lo, *hi] along coordinate i of w->state (dim + 1: along the path) until it is resolved
 * to `least`, keeping the ends on the two sides of a jump of component k; *jumps = 0 where the
 * difference melts away, as that of a smooth function does. */
static rot_status bisect_jump(const path *w, double t, size_t i, size_t k, double min, double *lo,
                              double *hi, int *jumps) {
  double a, b, f;
  rot_status status = slope_with(w, t, i, *lo, k, &a);
  if (status == ROT_OK) status = slope_with(w, t, i, *hi, k, &b);
  if (status != ROT_OK) return status;
  const double height = fabs(b - a);
  *jumps = height > 0.0;
  while (*jumps && fabs(*hi - *lo) > min) {
    const double mid = *lo + 0.5 * (*hi - *lo);
    if (mid == *lo || mid == *hi) break;
    status = slope_with(w, t, i, mid, k, &f);
    if (status != ROT_OK) return status;
    if (fabs(f - a) > fabs(b - f)) {
      *hi = mid;
      b = f;
    } else {
      *lo = mid;
      a = f;
    }
    *jumps = fabs(b - a) > height / 4.0;
  }
  return ROT_OK;
}

/* The coordinate (dim: time) that alone, put to its value of `after`, or of t[1], changes component
 * k of the slope at w->state and t[0], which is a, as far as all do, to b; NO_SURFACE: none, or
 * several. */
static rot_status lone_coordinate(const path *w, const double t[2], const double after[], size_t k,
                                  double a, double b, size_t *which) {
  const size_t dim = w->law->p->dim, controlled = w->law->p->controlled;
  size_t found = 0;
  *which = NO_SURFACE;
  for (size_t i = 0; i <= controlled; i++) {
    const size_t c = i < controlled ? i : dim;
    double f;
    const rot_status status = slope_with(w, t[0], c, c < dim ? after[c] : t[1], k, &f);
    if (status != ROT_OK) return status;
    if (fabs(f - b) < fabs(f - a)) *which = found++ ? NO_SURFACE : c;
  }
  return ROT_OK;
}

static int add(const path *w, size_t i, double lo, double hi) {
  return rot_ode_add_surface(w->law->surfaces, i, fmin(lo, hi), fmax(lo, hi), w->wish);
}

/* A jump of component k of the slope between lo and hi, at a value of one coordinate, whatever the
 * others are. */
static rot_status jump_surface(const path *w, double lo, double hi, size_t k, int *added) {
  const size_t dim = w->law->p->dim;
  double a, b, *after = w->after;
  int jumps;
  size_t which;
  *added = 0;
  rot_status status = bisect_jump(w, 0.0, dim + 1, k, 0x1p-24, &lo, &hi, &jumps);
  if (status != ROT_OK || !jumps) return status;
  /* Each coordinate alone, from the state before to the state after. */
  const double t[2] = {state_at(w, lo, w->state), w->t + hi * w->h};
  status = slope_with(w, t[0], 0, w->state[0], k, &a);
  state_at(w, hi, w->state);
  if (status == ROT_OK) status = slope_with(w, t[1], 0, w->state[0], k, &b);
  memcpy(after, w->state, dim * sizeof *after);
  state_at(w, lo, w->state);
  if (status == ROT_OK) status = lone_coordinate(w, t, after, k, a, b, &which);
  if (status != ROT_OK || which == NO_SURFACE) return status;
  double x[2] = {which < dim ? w->state[which] : t[0], which < dim ? after[which] : t[1]};
  const double whole = which < dim ? fabs(w->y[1][which] - w->y[0][which]) : fabs(w->h);
  const double min = 2.0 * ROT_EPS * fmin(fabs(x[0]), fabs(x[1])) + 1e-17 * whole;
  status = bisect_jump(w, t[0], which, k, min, &x[0], &x[1], &jumps);
  if (status != ROT_OK || !jumps) return status;
  /* At the jump itself there may be a third value, as that of sign(0): the levels lie beside it. */
  for (int side = 0; side < 2; side++) {
    const double out = x[side] + 4.0 * copysign(fmax(min, 1e-300), x[side] - x[1 - side]);
    double here, beside;
    status = slope_with(w, t[0], which, x[side], k, &here);
    if (status == ROT_OK) status = slope_with(w, t[0], which, out, k, &beside);
    if (status != ROT_OK) return status;
    if (!(fabs(here - beside) < 0.1 * fabs(b - a))) x[side] = out;
  }
  /* The same at the ends of the path. */
  for (int end = 0; end < 2; end++) {
    const double at = state_at(w, end, w->state);
    double f[2];
    for (int side = 0; side < 2; side++) {
      status = slope_with(w, at, which, x[side], k, &f[side]);
      if (status != ROT_OK) return status;
    }
    if (!(fabs(f[1] - f[0]) > 1e-3 * fabs(b - a))) return ROT_OK;
  }
  *added = add(w, which, x[0], x[1]);
  return ROT_OK;
}

/* A kink of the slope at a value of one coordinate, whatever the others are. */
static rot_status kink_surface(const path *w, double s, size_t k, int *added) {
  const size_t dim = w->law->p->dim, controlled = w->law->p->controlled;
  double max = 0.0, second = 0.0, x = NAN, difference = 0.0, strength;
  size_t which = 0;
  const double t = state_at(w, s, w->state);
  for (size_t i = 0; i <= controlled; i++) {
    const size_t c = i < controlled ? i : dim;
    const double whole = c < dim ? fabs(w->y[1][c] - w->y[0][c]) : fabs(w->h);
    const double near = 0.5 * whole / GAPS;
    double at = c < dim ? w->state[c] : t;
    if (!(near > 1e-12 * fabs(at))) continue;
    const rot_status status = kink_along(w, t, c, k, near, &at, &strength);
    if (status != ROT_OK) return status;
    second = fmax(second, strength > max ? max : strength);
    if (!(strength > max)) continue;
    max = strength;
    which = c;
    x = at;
    difference = near;
  }
  if (isnan(x) || !(max > SHARP * second)) return ROT_OK;
  for (int turn = 0; turn < 5; turn++) {
    difference /= 16.0;
    const rot_status status = kink_along(w, t, which, k, difference, &x, &strength);
    if (status != ROT_OK || isnan(x)) return status;
  }
  /* The same at the end of the path that is further away. */
  const double near = 16.0 * 16.0 * difference, there = state_at(w, s < 0.5 ? 1.0 : 0.0, w->state);
  double same = x;
  const rot_status status = kink_along(w, there, which, k, near, &same, &strength);
  if (status == ROT_OK && fabs(same - x) < 0.1 * near) *added = add(w, which, x, x);
  return status;
}

/* ---- kinks ----------------------------------------------------------------------------------- */

static path path_with(rot_ode_law *law, double *scratch) {
  const size_t dim = law->p->dim;
  path w = {.law = law};
  double **part[] = {&w.y[0], &w.y[1], &w.slope[0], &w.slope[1], &w.state, &w.moved, &w.after};
  const size_t n = sizeof part / sizeof *part;
  for (size_t k = 0; k < n; k++) *part[k] = scratch + k * dim;
  w.sample = scratch + n * dim;
  return w;
}

/* A path by a step of the method, good to the last digits where it meets no kink. */
static rot_status step_to(path *w, rot_ode_stepper *s, double t, double h) {
  const size_t dim = w->law->p->dim;
  const rot_status status = rot_ode_attempt(s, t, h, w->y[0], w->slope[0]);
  w->t = t;
  w->h = h;
  memcpy(w->y[1], s->trial, dim * sizeof *s->trial);
  memcpy(w->slope[1], s->trial_slope, dim * sizeof *s->trial);
  return status;
}

/* (step with a kink) => time of the kink. The cubic of the whole step locates it to some h/400.
 * Steps 32 times shorter then bracket it, with a cubic error 1000 times smaller; repeated until
 * resolved. */
static rot_status close_in(rot_ode_kink_search *in, path *w) {
  const size_t dim = w->law->p->dim;
  const double h = w->h, difference = sqrt(w->law->p->accuracy) * h / 8.0;
  double at = w->t, margin = h / 64.0, s, last, t = NAN;
  rot_status status = find(w, &s);
  do {
    if (status != ROT_OK || isnan(s)) return status;
    last = t;
    t = w->t + s * w->h;
    if (fabs(t - last) < 1000.0 * fabs(difference)) break;
    status = step_to(w, in->step, at, t - margin - at);
    if (status != ROT_OK || !(rot_ode_trial_ratio(in->step, w->h) <= 1.0)) return status;
    memcpy(w->y[0], w->y[1], dim * sizeof *w->y[0]);
    memcpy(w->slope[0], w->slope[1], dim * sizeof *w->slope[0]);
    at = w->t + w->h;
    status = step_to(w, in->step, at, 2.0 * margin);
    if (status == ROT_OK) status = find(w, &s);
    margin /= 32.0;
  } while (fabs(margin) > fabs(difference) / 1024.0);
  in->before = t - difference;
  in->behind = t + difference;
  if ((in->before - in->clock->t) * h <= 0.0) in->before = in->behind;
  return ROT_OK;
}

static rot_status no_place(rot_status status) {
  return rot_ode_may_retry(status) ? ROT_OK : status;
}

static rot_status look(rot_ode_kink_search *in, double h, int surfaces_alone) {
  const size_t size = in->law->p->dim * sizeof(double);
  double *scratch = malloc((GAPS + 8) * size);
  if (!scratch) return ROT_ENOMEM;
  path w = path_with(in->law, scratch);
  w.t = in->clock->t;
  w.h = h;
  w.wish = in->step->h;
  memcpy(w.y[0], in->state->y, size);
  memcpy(w.slope[0], in->state->slope, size);
  memcpy(w.y[1], in->step->trial, size);
  memcpy(w.slope[1], in->step->trial_slope, size);
  int added = 0;
  rot_status status = sample(&w);
  if (status == ROT_OK) {
    size_t jumps = 0, bends = 0;
    const int gap = jump_gap(&w, &jumps);
    const double s = sharpest(&w, &bends);
    if (gap >= 0) {
      status = jump_surface(&w, (double)gap / GAPS, (double)(gap + 1) / GAPS, jumps, &added);
    }
    if (status == ROT_OK && !added && !isnan(s)) status = kink_surface(&w, s, bends, &added);
  }
  if (status == ROT_OK && !added && !surfaces_alone) status = close_in(in, &w);
  free(scratch);
  return no_place(status);
}

rot_status rot_ode_look_for_surface(rot_ode_kink_search *in, double h) { return look(in, h, 1); }

/* A smooth law fails the test of a step that it chose itself by less: there may be a kink. */
#define KINK_RATIO 8.0
enum { MAX_LOOKS = 6 };

rot_status rot_ode_look_for_kink(rot_ode_kink_search *in, double h, double ratio, int diverged) {
  const rot_ode_state *state = in->state;
  rot_ode_stepper *s = in->step;
  const double t = in->clock->t;
  if (!in->found || !(ratio > KINK_RATIO || diverged) || in->law->slides != NO_SURFACE)
    return ROT_OK;
  if (state->phase != ROT_ODE_MOVING && state->phase != ROT_ODE_CUT) return ROT_OK;
  in->looks = t == in->looked_t ? in->looks + 1 : 1;
  in->looked_t = t;
  if (in->looks > MAX_LOOKS) {
    in->found->missed = in->found->missed || !diverged;
    return ROT_OK;
  }
  if (diverged) { /* Newton's iteration: along the tangent */
    for (size_t i = 0; i < in->law->p->dim; i++) s->trial[i] = state->y[i] + h * state->slope[i];
    const rot_status status = rot_ode_slope_at(in->law, t + h, s->trial, s->trial_slope);
    if (status != ROT_OK) return status == ROT_ERHS ? ROT_OK : status;
  }
  return look(in, h, s->method != ROT_METHOD_RK8PD);
}

rot_status rot_ode_pass_kink(rot_ode_kink_search *in) {
  rot_ode_kinks *k = in->found;
  if (rot_ode_make_room(&k->time_s, &k->room, k->count, 1) != ROT_OK) return ROT_ENOMEM;
  k->time_s[k->count++] = in->before;
  in->before = in->clock->t == in->behind ? NAN : in->behind;
  return ROT_OK;
}

/* ---- what a probe saw ------------------------------------------------------------------------ */

/* The straight line from one place of a sight to the next. */
static void line(path *w, const rot_ode_sight *sight, size_t from) {
  const size_t dim = w->law->p->dim;
  w->t = sight->t[from];
  w->h = w->wish = sight->t[from + 1] - sight->t[from];
  memcpy(w->y[0], sight->y + from * dim, 2 * dim * sizeof *w->y[0]);
  for (size_t i = 0; i < dim; i++) {
    w->slope[0][i] = w->slope[1][i] = (w->y[1][i] - w->y[0][i]) / w->h;
  }
}

/* A surface at the value of the coordinate of the place, which alone changes component k from
 * one end of a line to the other as far as all do. */
static rot_status surface_at_place(const path *w, size_t k, int *added) {
  const double t[2] = {w->t, w->t + w->h};
  const size_t path_ = w->law->p->dim + 1;
  double a, b;
  size_t which;
  rot_status status = slope_with(w, 0.0, path_, 1.0, k, &b);
  if (status == ROT_OK) status = slope_with(w, 0.0, path_, 0.0, k, &a);
  memcpy(w->state, w->y[0], w->law->p->dim * sizeof *w->state);
  if (status == ROT_OK) status = lone_coordinate(w, t, w->y[1], k, a, b, &which);
  if (status == ROT_OK && which < w->law->p->dim) {
    *added = add(w, which, w->y[1][which], w->y[1][which]);
  }
  return status;
}

static rot_status look_at_sight(path *w, const rot_ode_sight *sight, double *break_s) {
  int any = 0;
  rot_status status = ROT_OK;
  for (size_t from = 0; from < 2 && status == ROT_OK; from++) {
    int added;
    if (sight->t[from] == sight->t[from + 1]) continue;
    line(w, sight, from);
    status = jump_surface(w, 0.0, 1.0, sight->component, &added);
    any |= added;
  }
  if (status == ROT_OK && !any && sight->t[0] != sight->t[1]) {
    line(w, sight, 0);
    status = surface_at_place(w, sight->component, &any);
  }
  *break_s = any ? NAN : sight->t[1];
  return no_place(status);
}

rot_status rot_ode_look_at_sights(const rot_ode_params *p, const rot_ode_probes *probes,
                                  rot_ode_surfaces *surfaces, double break_s[], rot_info *info) {
  const size_t dim = p->dim;
  const int first_mode = p->mode ? *p->mode : 0;
  rot_ode_clock clock = {p, NAN, NAN, 1, -INFINITY, INFINITY, 0};
  rot_ode_state state = {.phase = ROT_ODE_MOVING};
  rot_ode_law law = {.p = p, .clock = &clock, .info = info, .surfaces = surfaces};
  rot_status status = ROT_OK;
  double *scratch = calloc((GAPS + 12) * dim, sizeof *scratch);
  if (!scratch) return ROT_ENOMEM;
  law.kept = scratch + (GAPS + 8) * dim;
  law.beside = law.kept + dim;
  law.beyond = law.beside + dim;
  state.y = law.beyond + dim;
  for (size_t k = 0; k < probes->n_sights && status == ROT_OK; k++) {
    const rot_ode_sight *sight = &probes->sight[k];
    path w = path_with(&law, scratch);
    if (p->mode) *p->mode = sight->mode;
    clock.forward = sight->t[2] > sight->t[0];
    clock.t = sight->t[0];
    memcpy(state.y, sight->y, dim * sizeof *state.y);
    status = rot_ode_choose_sides(&law, &state);
    if (status == ROT_OK) status = look_at_sight(&w, sight, &break_s[k]);
  }
  if (p->mode) *p->mode = first_mode;
  free(scratch);
  return status;
}
