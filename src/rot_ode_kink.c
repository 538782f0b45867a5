#include "rot_ode_kink.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_ode_step.h"

/* The slope is sampled at the ends of equal gaps. Over the gap with the kink the slope's slope
 * changes so many times as much as over the gaps beside it. */
enum { GAPS = 12, SIDE = 3 };
#define SHARP 4.0

/* A cubic between two states, and room for what is sampled along it. */
typedef struct path {
  rot_ode_march *run;
  double t, h;
  double *y[2], *slope[2]; /* at its ends */
  double *state, *sample;  /* dim; GAPS + 1 times dim */
} path;

static rot_status slope_at(const path *w, double s, double dydt[]) {
  for (size_t k = 0; k < w->run->p->dim; k++) {
    const double up = w->y[1][k] - w->y[0][k];
    const double bend = (1.0 - s) * (w->h * w->slope[0][k] - up) - s * (w->h * w->slope[1][k] - up);
    w->state[k] = w->y[0][k] + s * (up + (1.0 - s) * bend);
  }
  rot_ode_slope_at(w->t + s * w->h, w->state, dydt, w->run);
  return w->run->status;
}

/* The zero in [0, 1] of the parabola through d at 0, 1/2, 1; NaN if there is none. */
static double parabola_zero(const double d[3]) {
  const double bend = 2.0 * (d[0] - 2.0 * d[1] + d[2]), rise = d[2] - d[0] - bend;
  const double root = sqrt(fmax(0.0, rise * rise - 4.0 * bend * d[0]));
  const double part = -2.0 * d[0] / (rise + copysign(root, rise));
  return part >= 0.0 && part <= 1.0 ? part : NAN;
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
  /* Their difference at -apart, 0 and apart. */
  const double *l = f[0], *r = f[1];
  d[0] = (3.0 * r[0] - 3.0 * r[1] + r[2]) - l[0];
  d[1] = (1.875 * r[0] - 1.25 * r[1] + 0.375 * r[2]) - (1.875 * l[0] - 1.25 * l[1] + 0.375 * l[2]);
  d[2] = r[0] - (3.0 * l[0] - 3.0 * l[1] + l[2]);
  *s += apart * (2.0 * parabola_zero(d) - 1.0);
  return ROT_OK;
}

/* The sharpest kink on the path, as a part of it; NaN where the slopes show none. */
static rot_status find(const path *w, double *s) {
  const size_t dim = w->run->p->dim;
  double most = 0.0;
  size_t which = 0;
  *s = NAN;
  for (size_t i = 0; i <= GAPS; i++) {
    rot_status status = ROT_OK;
    if (i % GAPS) {
      status = slope_at(w, (double)i / GAPS, w->sample + i * dim);
    } else {
      memcpy(w->sample + i * dim, w->slope[i / GAPS], dim * sizeof *w->sample);
    }
    if (status != ROT_OK) return status;
  }
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
        *s = ((double)i + part) / GAPS;
        which = k;
      }
    }
  }
  return isnan(*s) ? ROT_OK : refine(w, which, 0.125 / GAPS, s);
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

rot_status rot_ode_look_for_kink(rot_ode_march *run, double h) {
  const size_t dim = run->p->dim;
  double *scratch = malloc((GAPS + 6) * dim * sizeof *scratch);
  if (!scratch) return ROT_ENOMEM;
  path w = {run,
            run->t,
            h,
            {scratch, scratch + dim},
            {scratch + 2 * dim, scratch + 3 * dim},
            scratch + 4 * dim,
            scratch + 5 * dim};
  memcpy(w.y[0], run->y, dim * sizeof *scratch);
  memcpy(w.slope[0], run->slope, dim * sizeof *scratch);
  memcpy(w.y[1], run->trial, dim * sizeof *scratch);
  memcpy(w.slope[1], run->trial_slope, dim * sizeof *scratch);
  const rot_status status = close_in(&w, h);
  free(scratch);
  return status == ROT_ERHS || status == ROT_ESTEP ? ROT_OK : status;
}
