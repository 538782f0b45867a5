#include "engine/ode/rest.h"

#include <math.h>
#include <string.h>

/* At rest the components beyond the controlled ones go on: their integrals by Lobatto's four points
 * and Kronrod's three (Gander & Gautschi, BIT 40, 2000). */
enum { HELD_POINTS = 7 };
static const double held_at[HELD_POINTS] = {
    0.0, 0.5 - 0.5 * 0.81649658092772603273, 0.5 - 0.5 * 0.44721359549995793928,
    0.5, 0.5 + 0.5 * 0.44721359549995793928, 0.5 + 0.5 * 0.81649658092772603273,
    1.0};
static const double held_weight[HELD_POINTS] = {77.0 / 2940.0,  432.0 / 2940.0, 625.0 / 2940.0,
                                                672.0 / 2940.0, 625.0 / 2940.0, 432.0 / 2940.0,
                                                77.0 / 2940.0};

rot_status rot_ode_held_slope(rot_ode_rest *r, double t, double *drive, double *excess) {
  const rot_status status = rot_ode_slope_at(r->law, t, r->state->y, r->step->trial_slope);
  if (status != ROT_OK) return status;
  *drive = r->step->trial_slope[r->law->p->turn->driver];
  if (!isfinite(*drive)) {
    r->law->info->time_s = t;
    return ROT_ERHS;
  }
  *excess = fabs(*drive) - r->law->p->turn->holds;
  if (rot_ode_is_before(r->clock, t, r->grace)) *excess = fmin(*excess, 0.0);
  return ROT_OK;
}

/* Seven points of a segment at rest. The first loose one in *loose, HELD_POINTS if none; *apart is
 * how far the two rules differ. trial = y at its end, trial_slope the slope there. */
static rot_status held_segment(rot_ode_rest *r, double h, double drive[], double excess[],
                               int *loose, double *difference) {
  const size_t dim = r->law->p->dim, driver = r->law->p->turn->driver;
  double four = 0.0, seven = 0.0;
  memcpy(r->step->trial, r->state->y, dim * sizeof *r->state->y);
  *loose = HELD_POINTS;
  for (int k = 0; k < HELD_POINTS; k++) {
    const double at = k + 1 < HELD_POINTS ? r->clock->t + held_at[k] * h : r->clock->t + h;
    const rot_status status = rot_ode_held_slope(r, at, &drive[k], &excess[k]);
    if (status != ROT_OK) return status;
    if (excess[k] > 0.0 && *loose == HELD_POINTS) *loose = k;
    for (size_t i = r->law->p->controlled; i < dim; i++) {
      r->step->trial[i] += h * held_weight[k] * r->step->trial_slope[i];
    }
    seven += held_weight[k] * r->step->trial_slope[driver];
    if (k == 0 || k == 6) four += r->step->trial_slope[driver] / 12.0;
    if (k == 2 || k == 4) four += r->step->trial_slope[driver] * 5.0 / 12.0;
  }
  *difference = fabs(seven - four);
  return ROT_OK;
}

rot_status rot_ode_integrals_at_rest(rot_ode_law *law, double t, double h, const double from[],
                                     double y[], double slope[]) {
  memcpy(y, from, law->p->dim * sizeof *y);
  for (int k = 0; k < HELD_POINTS; k++) {
    const double at = k + 1 < HELD_POINTS ? t + held_at[k] * h : t + h;
    const rot_status status = rot_ode_slope_at(law, at, from, slope);
    if (status != ROT_OK) return status;
    for (size_t i = law->p->controlled; i < law->p->dim; i++) y[i] += h * held_weight[k] * slope[i];
  }
  return ROT_OK;
}

/* A peak between three points before `loose` that may reach over zero: *at is its place if it
 * does. */
static rot_status peak_between(rot_ode_rest *r, double h, int loose, const double excess[],
                               int *before, double *at) {
  *before = -1;
  for (int k = 1; k + 1 < HELD_POINTS && k < loose; k++) {
    if (excess[k] < excess[k - 1] || excess[k] < excess[k + 1]) continue;
    const double left = held_at[k] - held_at[k - 1], right = held_at[k + 1] - held_at[k];
    const double up = (excess[k] - excess[k - 1]) / left,
                 down = (excess[k + 1] - excess[k]) / right;
    const double bend = (down - up) / (left + right);
    if (!(bend < 0.0)) continue;
    const double x = 0.5 * (held_at[k] + held_at[k - 1]) - 0.5 * up / bend;
    const double off = (x - held_at[k - 1]) * (up + bend * (x - held_at[k]));
    const double room = fmax(excess[k] - excess[k - 1], excess[k] - excess[k + 1]);
    if (!(excess[k - 1] + off > -0.2 * room)) continue;
    double drive, there;
    const rot_status status = rot_ode_held_slope(r, r->clock->t + x * h, &drive, &there);
    if (status != ROT_OK) return status;
    if (there > 0.0) {
      *before = x > held_at[k] ? k : k - 1;
      *at = x;
      return ROT_OK;
    }
  }
  return ROT_OK;
}

/* From lo, held, to hi, loose: the first double at which it is loose (regula falsi, halved). */
static rot_status find_loose(rot_ode_rest *r, double lo, double hi, double excess_lo, double *at) {
  double drive, excess_hi;
  rot_status status = rot_ode_held_slope(r, hi, &drive, &excess_hi);
  for (int k = 0; k < 200 && status == ROT_OK; k++) {
    double mid = lo + (hi - lo) * (excess_lo / (excess_lo - excess_hi));
    if (k % 3 == 2 || !((mid > lo && mid < hi) || (mid < lo && mid > hi))) mid = 0.5 * (lo + hi);
    if (mid == lo || mid == hi) break;
    double excess;
    status = rot_ode_held_slope(r, mid, &drive, &excess);
    if (status != ROT_OK) break;
    if (excess > 0.0) {
      hi = mid;
      excess_hi = excess;
    } else {
      lo = mid;
      excess_lo = excess;
    }
  }
  *at = hi;
  return status;
}

rot_status rot_ode_hold(rot_ode_rest *r, double stop, double whole, double *h, double *end,
                        int *broke_loose) {
  const double t = r->clock->t;
  double drive[HELD_POINTS], excess[HELD_POINTS], difference = 0.0, to = t + *h, at;
  int loose, before = -1;
  *end = NAN;
  if (fabs(stop - to) <= 1e-6 * fabs(*h) || rot_ode_is_before(r->clock, stop, to) || to == t) {
    to = stop;
  }
  const double width = to - t;
  rot_status status = held_segment(r, width, drive, excess, &loose, &difference);
  if (status != ROT_OK) return status;
  const double size = fmax(r->law->p->turn->holds, fabs(drive[0]));
  /* Points too far apart may pass over a segment in which it breaks loose. */
  if (difference > 1e-7 * size && fabs(width) > 1e-5 * fabs(whole) && t + 0.5 * width != t) {
    r->law->info->rejected++;
    *h = 0.5 * width;
    return ROT_OK;
  }
  if (loose > 0) status = peak_between(r, width, loose, excess, &before, &at);
  if (status != ROT_OK) return status;
  if (loose < HELD_POINTS || before >= 0) {
    /* The pieces before are done when the segment ends at the place itself. */
    const int k = before >= 0 ? before : loose - 1;
    const double hi = t + (before >= 0 ? at : held_at[loose]) * width;
    *broke_loose = 1;
    if (k < 0) return ROT_OK; /* from the start */
    status = find_loose(r, t + held_at[k] * width, hi, excess[k], &to);
    if (status != ROT_OK) return status;
    const double grace = r->grace;
    r->grace = r->clock->forward ? INFINITY : -INFINITY; /* for the sums alone */
    status = held_segment(r, to - t, drive, excess, &loose, &difference);
    r->grace = grace;
  }
  *end = to;
  return status;
}
