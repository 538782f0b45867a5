#include "rot_ode_rows.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "rot_ode_step.h"

static size_t row_now(const rot_ode_march *run) {
  return run->forward ? run->first + run->done : run->first + run->total - 1 - run->done;
}

static void row_is(rot_ode_march *run, const double y[], double slope) {
  const size_t row = row_now(run);
  memcpy(run->y_rows + row * run->p->dim, y, run->p->dim * sizeof *y);
  if (run->slope_rows) run->slope_rows[row] = slope;
  run->done++;
  if (run->forward) run->info->rows_done = row + 1;
}

void rot_ode_rows_at_start(rot_ode_march *run) {
  const rot_ode_params *p = run->p;
  while (run->y_rows && run->done < run->total && run->time_s[row_now(run)] == p->start_s) {
    row_is(run, p->start, NAN);
  }
}

/* Share of the last node, or of the last mend, that a row may have, of the accuracy; and how often
 * it counts as an error: waves shorter than the steps show little of themselves in it. */
#define MOST_SHARE  0.003
#define SHARE_COUNT 7.0

/* A row from the polynomials; 0 if they are not good enough there. */
static int row_between(rot_ode_march *run, double t, int held) {
  const rot_ode_params *p = run->p;
  double slope = NAN;
  for (size_t i = 0; i < p->dim; i++) {
    double rise, rise_share;
    run->work[i] = rot_dense_at(&run->form[i], t, &rise, &run->change[i], &rise_share);
    if (i == p->sloped && run->slope_rows && run->dense.slopes) {
      const double *a = rot_dense_node(&run->dense, 0) + 1 + p->dim + i;
      const size_t stride = 1 + 2 * p->dim;
      double size = 0.0;
      for (size_t k = 0; k < run->dense.count; k++) size = fmax(size, fabs(a[k * stride]));
      if (rise_share <= SHARE_COUNT * MOST_SHARE * p->accuracy * size) slope = rise;
    }
  }
  for (size_t m = 0; m < rot_ode_steering(p) && !held; m++) {
    const double share = rot_ode_rate(rot_ode_group_of(p, m), run->change);
    if (!(share <= MOST_SHARE * p->accuracy * run->largest[m])) return 0;
    run->share[m] = fmax(run->share[m], SHARE_COUNT * share);
  }
  if (p->project) p->project(t, run->work, p->ctx);
  row_is(run, run->work, slope);
  return 1;
}

/* A call of rhs within the interval, at the value of the polynomials, mends them: their error e
 * makes one of h e in the slope, where the slope of e itself is 7 e/h. */
static int mend(rot_ode_march *run) {
  rot_dense_form *form = run->form;
  if (!run->dense.slopes || form[0].mends == ROT_DENSE_MENDS) return 0;
  const double t = rot_dense_mend_at(&form[0]);
  for (size_t i = 0; i < run->p->dim; i++) {
    run->work[i] = rot_dense_at(&form[i], t, NULL, NULL, NULL);
  }
  if (rot_ode_slope_at(t, run->work, run->change, run) != GSL_SUCCESS) return 0;
  for (size_t i = 0; i < run->p->dim; i++) rot_dense_mend(&form[i], run->change[i]);
  return 1;
}

/* A node of its own for a row, or for the middle of an interval with several. */
static rot_status step_between(rot_ode_march *run, size_t i, size_t rows) {
  const rot_ode_params *p = run->p;
  const double *node = rot_dense_node(&run->dense, i);
  const double a = node[0], b = rot_dense_node(&run->dense, i + 1)[0],
               t = run->time_s[row_now(run)];
  const double mid = 0.5 * (a + b);
  const int split = rows > 2 && mid != a && mid != b;
  const double to = split ? mid : t;
  const rot_status status = rot_ode_attempt(run, a, to - a, node + 1, node + 1 + p->dim);
  if (status != ROT_OK) return status;
  if (split) return rot_dense_insert(&run->dense, i + 1, mid, run->trial, run->trial_slope);
  if (p->project) p->project(to, run->trial, p->ctx);
  row_is(run, run->trial, run->dense.slopes ? run->trial_slope[p->sloped] : NAN);
  return ROT_OK;
}

/* Radau steps over a transient that dies out within its first step, and the values at the steps'
 * ends do not show it; the slope where the stretch begins does. */
static int in_transient(const rot_ode_march *run, const double *node, double t) {
  if (run->method != ROT_METHOD_RADAU || node[0] != run->stretch_t) return 0;
  for (size_t i = 0; i < run->p->controlled; i++) {
    double rise;
    rot_dense_at(&run->form[i], node[0], &rise, NULL, NULL);
    run->change[i] = (node[1 + run->p->dim + i] - rise) * (t - node[0]);
  }
  for (size_t m = 0; m < rot_ode_steering(run->p); m++) {
    const double missed = rot_ode_rate(rot_ode_group_of(run->p, m), run->change);
    if (!(missed <= SHARE_COUNT * MOST_SHARE * run->p->accuracy * run->largest[m])) return 1;
  }
  return 0;
}

rot_status rot_ode_fill_rows(rot_ode_march *run, int whole_stretch) {
  enum { BEYOND = 4, BEHIND = 8 };
  rot_dense *d = &run->dense;
  if (!run->y_rows) return ROT_OK;
  const int watching = run->watch_stiffness, held = run->phase == ROT_ODE_HELD;
  const double way = run->forward ? 1.0 : -1.0;
  const size_t beyond = whole_stretch ? 0 : BEYOND;
  size_t i = 0, formed = (size_t)-1;
  rot_status status = ROT_OK;
  run->watch_stiffness = 0;
  while (status == ROT_OK && run->done < run->total && d->count > beyond) {
    const double t = run->time_s[row_now(run)];
    const size_t last = d->count - 1 - beyond;
    if (way * (t - rot_dense_node(d, last)[0]) > 0.0) break;
    while (i < last && way * (t - rot_dense_node(d, i + 1)[0]) >= 0.0) i++;
    const double *node = rot_dense_node(d, i);
    if (t == node[0]) {
      const int inside = i > 0 && i + 1 < d->count;
      row_is(run, node + 1, inside ? node[1 + run->p->dim + run->p->sloped] : NAN);
      continue;
    }
    if (formed != i) {
      for (size_t k = 0; k < run->p->dim; k++) run->form[k] = rot_dense_between(d, i, k);
      formed = i;
    }
    const int enough = held || run->form[0].terms >= 4 * (d->slopes ? 2 : 1);
    int filled = enough && !in_transient(run, node, t) && row_between(run, t, held);
    while (enough && !filled && mend(run)) filled = row_between(run, t, held);
    if (run->status != ROT_OK && run->status != ROT_ERHS) return run->status;
    if (filled) continue;
    size_t rows = 1;
    while (run->done + rows < run->total && rows < 3) {
      const double next = run->time_s[run->forward ? row_now(run) + rows : row_now(run) - rows];
      if (way * (next - rot_dense_node(d, i + 1)[0]) >= 0.0) break;
      rows++;
    }
    const size_t count = d->count;
    status = step_between(run, i, rows);
    if (d->count != count) formed = (size_t)-1;
  }
  if (!whole_stretch && d->count > BEYOND + BEHIND + 1) {
    rot_dense_drop(d, d->count - (BEYOND + BEHIND + 1));
  }
  run->watch_stiffness = watching;
  return status;
}
