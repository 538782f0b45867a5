#include "engine/ode/kink.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/law.h"
#include "engine/ode/step.h"
#include "engine/ode/wall.h"
#include "ground/real.h"

/* The slope is sampled at the ends of equal gaps. Over the gap with the kink the slope's slope
 * changes so many times as much as over the gaps beside it. */
enum { GAPS = 12, SIDE = 3 };
#define SHARP 4.0

/* A cubic between two states, and room for what is sampled along it. */
typedef struct path {
  rot_ode_march *run;
  double t, h;
  double *y[2], *slope[2];       /* at its ends */
  double *state, *moved, *after; /* dim each */
  double *sample;                /* GAPS + 1 times dim */
} path;

/* The path's state at s, and its time. */
static double state_at(const path *w, double s, double y[]) {
  for (size_t k = 0; k < w->run->p->dim; k++) {
    const double up = w->y[1][k] - w->y[0][k];
    const double bend = (1.0 - s) * (w->h * w->slope[0][k] - up) - s * (w->h * w->slope[1][k] - up);
    y[k] = w->y[0][k] + s * (up + (1.0 - s) * bend);
  }
  return w->t + s * w->h;
}

static rot_status slope_at(const path *w, double s, double dydt[]) {
  const double t = state_at(w, s, w->state);
  rot_ode_slope_at(t, w->state, dydt, w->run);
  return w->run->status;
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
static void apart_parabolas(const double l[SIDE], const double r[SIDE], double d[3]) {
  d[0] = (3.0 * r[0] - 3.0 * r[1] + r[2]) - l[0];
  d[1] = (1.875 * r[0] - 1.25 * r[1] + 0.375 * r[2]) - (1.875 * l[0] - 1.25 * l[1] + 0.375 * l[2]);
  d[2] = r[0] - (3.0 * l[0] - 3.0 * l[1] + l[2]);
}

/* Where the parabolas through three points of component k on either side of *s meet, at most
 * `apart` from it. */
static rot_status refine(const path *w, size_t k, double apart, double *s) {
  double f[2][SIDE], d[3];
  for (int j = 0; j < 2 * SIDE; j++) {
    const double way = j < SIDE ? -1.0 : 1.0;
    const rot_status status =
        slope_at(w, *s + way * (double)(1 + 2 * (j % SIDE)) * apart, w->sample);
    if (status != ROT_OK) return status;
    f[j / SIDE][j % SIDE] = w->sample[k];
  }
  apart_parabolas(f[0], f[1], d);
  *s += apart * (2.0 * parabola_zero(d) - 1.0);
  return ROT_OK;
}

static rot_status sample(const path *w) {
  const size_t dim = w->run->p->dim;
  for (size_t i = 0; i <= GAPS; i++) {
    rot_status status = ROT_OK;
    if (i % GAPS) {
      status = slope_at(w, (double)i / GAPS, w->sample + i * dim);
    } else {
      memcpy(w->sample + i * dim, w->slope[i / GAPS], dim * sizeof *w->sample);
    }
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* The sharpest kink of the samples, as a part of the path, in component *which of the slope; NaN
 * where they show none. */
static double sharpest(const path *w, size_t *which) {
  const size_t dim = w->run->p->dim;
  double most = 0.0, s = NAN;
  *which = 0;
  for (size_t k = 0; k < w->run->p->controlled; k++) {
    const double *f = w->sample + k;
    double size = 0.0, rise[GAPS];
    for (size_t i = 0; i <= GAPS; i++) size = fmax(size, fabs(f[i * dim]));
    for (size_t i = 0; i < GAPS; i++) rise[i] = f[(i + 1) * dim] - f[i * dim];
    for (size_t i = 1; i + 1 < GAPS; i++) {
      const double turn = rise[i + 1] - rise[i - 1], part = (rise[i + 1] - rise[i]) / turn;
      const double smooth = (i > 1 ? fabs(rise[i - 1] - rise[i - 2]) : 0.0) +
                            (i + 2 < GAPS ? fabs(rise[i + 2] - rise[i + 1]) : 0.0);
      if (part >= -0.1 && part <= 1.1 && fabs(turn) > fmax(SHARP * smooth, most * size)) {
        most = fabs(turn) / size;
        s = ((double)i + part) / GAPS;
        *which = k;
      }
    }
  }
  return s;
}

static rot_status find(const path *w, double *s) {
  size_t which;
  const rot_status status = sample(w);
  if (status != ROT_OK) return status;
  *s = sharpest(w, &which);
  return isnan(*s) ? ROT_OK : refine(w, which, 0.125 / GAPS, s);
}

/* ---- walls ----------------------------------------------------------------------------------- */

/* Component k of the slope at w->state, with coordinate i (dim: time) put to x. */
static rot_status slope_with(const path *w, double t, size_t i, double x, size_t k, double *f) {
  rot_ode_march *run = w->run;
  const size_t dim = run->p->dim;
  double *y = w->moved;
  memcpy(y, w->state, dim * sizeof *y);
  if (i < dim) {
    y[i] = x;
  } else {
    t = x;
  }
  rot_ode_slope_at(t, y, w->sample, run);
  *f = w->sample[k];
  return run->status;
}

/* The gap of the samples over which component *which of the slope jumps; -1: there is none. */
static int jump_gap(const path *w, size_t *which) {
  const size_t dim = w->run->p->dim;
  double most = 0.0;
  int gap = -1;
  for (size_t k = 0; k < w->run->p->controlled; k++) {
    const double *f = w->sample + k;
    double size = 0.0, rise[GAPS];
    for (size_t i = 0; i <= GAPS; i++) size = fmax(size, fabs(f[i * dim]));
    for (size_t i = 0; i < GAPS; i++) rise[i] = fabs(f[(i + 1) * dim] - f[i * dim]);
    for (int i = 0; i < GAPS; i++) {
      double beside = 0.0;
      for (int j = -2; j <= 2; j++) {
        if (j && i + j >= 0 && i + j < GAPS) beside = fmax(beside, rise[i + j]);
      }
      if (rise[i] > fmax(SHARP / 2.0 * beside, most * size)) {
        most = rise[i] / size;
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
static rot_status bisect_jump(path *w, double t, size_t i, size_t k, double least, double *lo,
                              double *hi, int *jumps) {
  const size_t path_ = w->run->p->dim + 1;
  double a, b, f;
  rot_status status = ROT_OK;
  for (int end = 0; end < 2 && status == ROT_OK; end++) {
    const double x = end ? *hi : *lo;
    if (i == path_) {
      status = slope_at(w, x, w->sample);
      f = w->sample[k];
    } else {
      status = slope_with(w, t, i, x, k, &f);
    }
    *(end ? &b : &a) = f;
  }
  const double height = fabs(b - a);
  *jumps = status == ROT_OK && height > 0.0;
  while (*jumps && fabs(*hi - *lo) > least) {
    const double mid = *lo + 0.5 * (*hi - *lo);
    if (mid == *lo || mid == *hi) break;
    if (i == path_) {
      status = slope_at(w, mid, w->sample);
      f = w->sample[k];
    } else {
      status = slope_with(w, t, i, mid, k, &f);
    }
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
  return status;
}

static rot_status add(const path *w, size_t i, double lo, double hi, int *added) {
  return rot_ode_add_wall(w->run, i, fmin(lo, hi), fmax(lo, hi), added);
}

/* A jump of component k of the slope between lo and hi, at a value of one coordinate, whatever the
 * others are. */
static rot_status jump_wall(path *w, double lo, double hi, size_t k, int *added) {
  rot_ode_march *run = w->run;
  const size_t dim = run->p->dim, controlled = run->p->controlled;
  double a, b;
  int jumps, found = 0;
  size_t which = 0;
  rot_status status = bisect_jump(w, 0.0, dim + 1, k, 0x1p-24, &lo, &hi, &jumps);
  if (status != ROT_OK || !jumps) return status;
  /* Each coordinate alone, from the state before to the state after. */
  const double t[2] = {state_at(w, lo, w->moved), w->t + hi * w->h};
  double *after = w->after;
  state_at(w, hi, after);
  memcpy(w->state, w->moved, dim * sizeof *w->state);
  status = slope_with(w, t[0], 0, w->state[0], k, &a);
  memcpy(w->state, after, dim * sizeof *w->state);
  if (status == ROT_OK) status = slope_with(w, t[1], 0, after[0], k, &b);
  state_at(w, lo, w->state);
  for (size_t i = 0; i <= controlled && status == ROT_OK; i++) {
    const size_t c = i < controlled ? i : dim;
    double f;
    status = slope_with(w, t[0], c, c < dim ? after[c] : t[1], k, &f);
    if (status == ROT_OK && fabs(f - b) < fabs(f - a)) {
      found++;
      which = c;
    }
  }
  if (status != ROT_OK || found != 1) return status;
  double x[2] = {which < dim ? w->state[which] : t[0], which < dim ? after[which] : t[1]};
  const double whole = which < dim ? fabs(w->y[1][which] - w->y[0][which]) : fabs(w->h);
  const double least = 2.0 * ROT_EPS * fmin(fabs(x[0]), fabs(x[1])) + 1e-17 * whole;
  status = bisect_jump(w, t[0], which, k, least, &x[0], &x[1], &jumps);
  /* At the jump itself there may be a third value, as that of sign(0): the levels lie beside it. */
  for (int side = 0; side < 2 && status == ROT_OK && jumps; side++) {
    const double out = x[side] + 4.0 * copysign(fmax(least, 1e-300), x[side] - x[1 - side]);
    double here, beside;
    status = slope_with(w, t[0], which, x[side], k, &here);
    if (status == ROT_OK) status = slope_with(w, t[0], which, out, k, &beside);
    if (status == ROT_OK && !(fabs(here - beside) < 0.1 * fabs(b - a))) x[side] = out;
  }
  if (status != ROT_OK || !jumps) return status;
  /* The same at the ends of the path. */
  for (int end = 0; end < 2 && status == ROT_OK; end++) {
    const double at = state_at(w, end, w->state);
    double f[2];
    for (int side = 0; side < 2 && status == ROT_OK; side++) {
      status = slope_with(w, at, which, x[side], k, &f[side]);
    }
    if (status == ROT_OK && !(fabs(f[1] - f[0]) > 1e-3 * fabs(b - a))) return ROT_OK;
  }
  return status == ROT_OK ? add(w, which, x[0], x[1], added) : status;
}

/* The difference of the parabolas on the two sides of *x along coordinate i, as `strength`, twice
 * `apart` times the jump of the slope; *x moves to where they meet. */
static rot_status kink_along(const path *w, double t, size_t i, size_t k, double apart, double *x,
                             double *strength) {
  double f[2][SIDE], d[3];
  for (int j = 0; j < 2 * SIDE; j++) {
    const double way = j < SIDE ? -1.0 : 1.0;
    const rot_status status = slope_with(w, t, i, *x + way * (double)(1 + 2 * (j % SIDE)) * apart,
                                         k, &f[j / SIDE][j % SIDE]);
    if (status != ROT_OK) return status;
  }
  apart_parabolas(f[0], f[1], d);
  *strength = fabs(d[2] - d[0]);
  *x += apart * (2.0 * parabola_zero(d) - 1.0);
  return ROT_OK;
}

/* A kink of the slope at a value of one coordinate, whatever the others are. */
static rot_status kink_wall(const path *w, double s, size_t k, int *added) {
  rot_ode_march *run = w->run;
  const size_t dim = run->p->dim, controlled = run->p->controlled;
  double most = 0.0, second = 0.0, at = NAN, apart = 0.0;
  size_t which = 0;
  const double t = state_at(w, s, w->state);
  for (size_t i = 0; i <= controlled; i++) {
    const size_t c = i < controlled ? i : dim;
    const double whole = c < dim ? fabs(w->y[1][c] - w->y[0][c]) : fabs(w->h);
    const double near = 0.5 * whole / GAPS;
    double x = c < dim ? w->state[c] : t, strength;
    if (!(near > 1e-12 * fabs(x))) continue;
    const rot_status status = kink_along(w, t, c, k, near, &x, &strength);
    if (status != ROT_OK) return status;
    if (strength > most) {
      second = most;
      most = strength;
      which = c;
      at = x;
      apart = near;
    } else {
      second = fmax(second, strength);
    }
  }
  if (isnan(at) || !(most > SHARP * second)) return ROT_OK;
  double x = at, strength;
  for (int k_ = 0; k_ < 5; k_++) {
    apart /= 16.0;
    const rot_status status = kink_along(w, t, which, k, apart, &x, &strength);
    if (status != ROT_OK || isnan(x)) return status;
  }
  /* The same at the end of the path that is further away. */
  const double end = s < 0.5 ? 1.0 : 0.0, near = 16.0 * 16.0 * apart;
  const double there = state_at(w, end, w->state);
  double same = x, other;
  const rot_status status = kink_along(w, there, which, k, near, &same, &other);
  if (status != ROT_OK || !(fabs(same - x) < 0.1 * near)) return status;
  return add(w, which, x, x, added);
}

/* A path by a step of the method, good to the last digits where it meets no kink. */
static rot_status step_to(path *w, double t, double h) {
  const size_t dim = w->run->p->dim;
  const rot_status status = rot_ode_attempt(w->run, t, h, w->y[0], w->slope[0]);
  w->t = t;
  w->h = h;
  memcpy(w->y[1], w->run->trial, dim * sizeof *w->y[1]);
  memcpy(w->slope[1], w->run->trial_slope, dim * sizeof *w->slope[1]);
  return status;
}

/* The cubic of the whole step tells the kink to some h/400. Then a step that ends just before it,
 * and one from there over it, a thirty-second of the length: its cubic is 1000 times as good. Until
 * that is enough. */
static rot_status close_in(path *w, double h) {
  rot_ode_march *run = w->run;
  const size_t dim = run->p->dim;
  const double apart = sqrt(run->p->accuracy) * h / 8.0;
  double at = run->t, margin = h / 64.0, s, last, t = NAN;
  rot_status status = find(w, &s);
  do {
    if (status != ROT_OK || isnan(s)) return status;
    last = t;
    t = w->t + s * w->h;
    if (fabs(t - last) < 1000.0 * fabs(apart)) break;
    status = step_to(w, at, t - margin - at);
    if (status != ROT_OK || !(rot_ode_trial_ratio(run, w->h) <= 1.0)) return status;
    memcpy(w->y[0], w->y[1], dim * sizeof *w->y[0]);
    memcpy(w->slope[0], w->slope[1], dim * sizeof *w->slope[0]);
    at = w->t + w->h;
    status = step_to(w, at, 2.0 * margin);
    if (status == ROT_OK) status = find(w, &s);
    margin /= 32.0;
  } while (fabs(margin) > fabs(apart) / 1024.0);
  run->kink = t - apart;
  run->over = t + apart;
  if ((run->kink - run->t) * h <= 0.0) run->kink = run->over;
  return ROT_OK;
}

static path path_with(rot_ode_march *run, double h, double *scratch) {
  const size_t dim = run->p->dim;
  return (path){run,
                run->t,
                h,
                {scratch, scratch + dim},
                {scratch + 2 * dim, scratch + 3 * dim},
                scratch + 4 * dim,
                scratch + 5 * dim,
                scratch + 6 * dim,
                scratch + 7 * dim};
}

static rot_status look(rot_ode_march *run, double h, int walls_alone) {
  const size_t dim = run->p->dim;
  double *scratch = malloc((GAPS + 8) * dim * sizeof *scratch);
  if (!scratch) return ROT_ENOMEM;
  path w = path_with(run, h, scratch);
  memcpy(w.y[0], run->y, dim * sizeof *scratch);
  memcpy(w.slope[0], run->slope, dim * sizeof *scratch);
  memcpy(w.y[1], run->trial, dim * sizeof *scratch);
  memcpy(w.slope[1], run->trial_slope, dim * sizeof *scratch);
  int added = 0;
  rot_status status = sample(&w);
  if (status == ROT_OK) {
    size_t jumps = 0, bends = 0;
    const int gap = jump_gap(&w, &jumps);
    const double s = sharpest(&w, &bends);
    if (gap >= 0) {
      status = jump_wall(&w, (double)gap / GAPS, (double)(gap + 1) / GAPS, jumps, &added);
    }
    if (status == ROT_OK && !added && !isnan(s)) status = kink_wall(&w, s, bends, &added);
  }
  if (status == ROT_OK && !added && !walls_alone) status = close_in(&w, h);
  free(scratch);
  return status == ROT_ERHS || status == ROT_ESTEP ? ROT_OK : status;
}

rot_status rot_ode_look_for_wall(rot_ode_march *run, double h) { return look(run, h, 1); }

rot_status rot_ode_look_for_kink(rot_ode_march *run, double h) {
  return look(run, h, run->method != ROT_METHOD_RK8PD);
}

/* ---- what a probe saw ------------------------------------------------------------------------ */

/* The straight line from one place of a sight to the next. */
static void line(path *w, const rot_ode_sight *sight, size_t from) {
  const size_t dim = w->run->p->dim;
  w->t = sight->t[from];
  w->h = sight->t[from + 1] - sight->t[from];
  memcpy(w->y[0], sight->y + from * dim, 2 * dim * sizeof *w->y[0]);
  for (size_t i = 0; i < dim; i++) {
    w->slope[0][i] = w->slope[1][i] = (w->y[1][i] - w->y[0][i]) / w->h;
  }
  w->run->h = w->h;
}

/* The coordinate (dim: time) that alone changes component k of the slope from one end of a line to
 * the other as far as all do; NO_WALL: none, or several. */
static rot_status lone_coordinate(path *w, size_t k, size_t *which) {
  const size_t dim = w->run->p->dim, controlled = w->run->p->controlled;
  double a, b;
  size_t found = 0;
  rot_status status = slope_at(w, 1.0, w->sample);
  b = w->sample[k];
  if (status == ROT_OK) status = slope_at(w, 0.0, w->sample);
  a = w->sample[k];
  *which = NO_WALL;
  memcpy(w->state, w->y[0], dim * sizeof *w->state);
  for (size_t i = 0; i <= controlled && status == ROT_OK; i++) {
    const size_t c = i < controlled ? i : dim;
    double f;
    status = slope_with(w, w->t, c, c < dim ? w->y[1][c] : w->t + w->h, k, &f);
    if (status == ROT_OK && fabs(f - b) < fabs(f - a)) {
      found++;
      *which = c;
    }
  }
  if (found != 1) *which = NO_WALL;
  return status;
}

rot_status rot_ode_look_at_sight(rot_ode_march *run, const rot_ode_sight *sight, double *break_s) {
  const size_t dim = run->p->dim, k = sight->component;
  int added = 0, any = 0;
  size_t which = NO_WALL;
  *break_s = NAN;
  double *scratch = malloc((GAPS + 8) * dim * sizeof *scratch);
  if (!scratch) return ROT_ENOMEM;
  path w = path_with(run, 0.0, scratch);
  run->forward = sight->t[2] > sight->t[0];
  run->t = sight->t[0];
  memcpy(run->y, sight->y, dim * sizeof *run->y);
  rot_status status = rot_ode_choose_sides(run);
  for (size_t from = 0; from < 2 && status == ROT_OK; from++) {
    if (sight->t[from] == sight->t[from + 1]) continue;
    line(&w, sight, from);
    status = jump_wall(&w, 0.0, 1.0, k, &added);
    any |= added;
  }
  if (status == ROT_OK && !any && sight->t[0] != sight->t[1]) {
    line(&w, sight, 0);
    status = lone_coordinate(&w, k, &which);
    if (status == ROT_OK && which < dim) {
      status = rot_ode_add_wall(run, which, w.y[1][which], w.y[1][which], &added);
      any |= added;
    }
  }
  free(scratch);
  if (!any) *break_s = sight->t[1];
  return status == ROT_ERHS || status == ROT_ESTEP ? ROT_OK : status;
}
