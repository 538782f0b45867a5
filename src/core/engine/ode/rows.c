#include "engine/ode/rows.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "engine/ode/law.h"
#include "engine/ode/probe.h"
#include "engine/ode/step.h"

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

/* ---- the path between two nodes, for probes -------------------------------------------------- */

typedef struct between {
  rot_ode_march *run;
  size_t i;
  int formed; /* run->form are its polynomials */
} between;

/* The cubic through the nodes. */
static void state_between(void *path, double t, double y[]) {
  const between *w = path;
  const size_t dim = w->run->p->dim;
  const double *a = rot_dense_node(&w->run->dense, w->i), *b = a + 1 + 2 * dim;
  const double h = b[0] - a[0], s = (t - a[0]) / h;
  for (size_t k = 0; k < w->run->p->controlled; k++) {
    const double up = b[1 + k] - a[1 + k];
    const double bend = (1.0 - s) * (h * a[1 + dim + k] - up) - s * (h * b[1 + dim + k] - up);
    y[k] = a[1 + k] + s * (up + (1.0 - s) * bend);
  }
}

static void form_between(between *w) {
  if (w->formed) return;
  for (size_t k = 0; k < w->run->p->dim; k++) {
    w->run->form[k] = rot_dense_between(&w->run->dense, w->i, k);
  }
  w->formed = 1;
}

static int believed_between(void *path, double t, double y[], double slope[], double y_unsure[],
                            double slope_unsure[]) {
  between *w = path;
  rot_ode_march *run = w->run;
  form_between(w);
  if (run->form[0].terms < 4 * (run->dense.slopes ? 2 : 1)) return 0;
  if (in_transient(run, rot_dense_node(&run->dense, w->i), t)) return 0;
  for (size_t k = 0; k < run->p->dim; k++) {
    y[k] = rot_dense_at(&run->form[k], t, &slope[k], &y_unsure[k], &slope_unsure[k]);
  }
  if (run->p->project) run->p->project(t, y, run->p->ctx);
  return 1;
}

static rot_status call_between(void *path, double t, const double y[], double dydt[]) {
  const between *w = path;
  return rot_ode_slope_at(t, y, dydt, w->run) == GSL_SUCCESS ? ROT_OK : w->run->status;
}

/* No transient, which dies out within: then the slopes at the ends are far from that between. */
static int is_smooth(const between *w) {
  const size_t dim = w->run->p->dim;
  const double *a = rot_dense_node(&w->run->dense, w->i), *b = a + 1 + 2 * dim;
  const double h = b[0] - a[0];
  int smooth = 1;
  for (size_t k = 0; k < w->run->p->controlled; k++) {
    const double up = b[1 + k] - a[1 + k], from = h * a[1 + dim + k], to = h * b[1 + dim + k];
    smooth &= fabs(up - 0.5 * (from + to)) <= 0.1 * fmax(fabs(from), fabs(to));
  }
  return smooth;
}

/* Stages of rk8pd that its error test weighs; the step has covered what they called. */
static const double stages[] = {0.0,
                                59.0 / 400,
                                0.375,
                                93.0 / 200,
                                5490023248.0 / 9719169821.0,
                                0.65,
                                1201146811.0 / 1299019798.0,
                                1.0};

static rot_ode_piece piece_between(between *w, int held) {
  const rot_dense *d = &w->run->dense;
  const int explicit = w->run->method == ROT_METHOD_RK8PD && !held;
  return (rot_ode_piece){.t = rot_dense_node(d, w->i)[0],
                         .end = rot_dense_node(d, w->i + 1)[0],
                         .held = held,
                         .n_called = explicit ? sizeof stages / sizeof *stages : 0,
                         .called = stages,
                         .smooth = is_smooth(w),
                         .covered = 1,
                         .largest = w->run->largest,
                         .path = w,
                         .state = state_between,
                         .believed = believed_between,
                         .call = call_between};
}

/* Probes the steps of this stretch up to node `last`. */
static rot_status probe_steps(rot_ode_march *run, size_t last, int held) {
  const double way = run->forward ? 1.0 : -1.0;
  rot_status status = ROT_OK;
  for (size_t i = 0; run->probes && i < last && status == ROT_OK; i++) {
    const double end = rot_dense_node(&run->dense, i + 1)[0];
    if (way * (end - run->probed_t) <= 0.0) continue;
    between w = {run, i, 0};
    const rot_ode_piece piece = piece_between(&w, held);
    status = rot_ode_probe(run->probes, &piece);
    run->probed_t = end;
  }
  return status;
}

/* The law's own slope at a row. */
static double slope_of_row(rot_ode_march *run, size_t i, double t, int held) {
  double slope = NAN;
  int known = 0;
  if (!run->slope_rows || !run->probes) return slope;
  between w = {run, i, 1};
  const rot_ode_piece piece = piece_between(&w, held);
  if (rot_ode_probe_at(run->probes, &piece, t, run->change, &known) == ROT_OK && known) {
    slope = run->change[run->p->sloped];
  }
  return slope;
}

/* A row from the polynomials; 0 if they are not good enough there. */
static int row_between(rot_ode_march *run, size_t i, double t, int held) {
  const rot_ode_params *p = run->p;
  for (size_t k = 0; k < p->dim; k++) {
    run->work[k] = rot_dense_at(&run->form[k], t, NULL, &run->change[k], NULL);
  }
  for (size_t m = 0; m < rot_ode_steering(p) && !held; m++) {
    const double share = rot_ode_rate(rot_ode_group_of(p, m), run->change);
    if (!(share <= MOST_SHARE * p->accuracy * run->largest[m])) return 0;
    run->share[m] = fmax(run->share[m], SHARE_COUNT * share);
  }
  /* No step is shortened for integrals; the polynomials' error in theirs was more than all else in
   * a tenth of the hoops and chains, up to 100 times. */
  const size_t all = p->integrals_between && !held ? rot_ode_measures(p) : 0;
  for (size_t m = rot_ode_steering(p); m < all; m++) {
    const double share = rot_ode_rate(rot_ode_group_of(p, m), run->change);
    run->share[m] = fmax(run->share[m], SHARE_COUNT * share);
  }
  if (p->project) p->project(t, run->work, p->ctx);
  row_is(run, run->work, slope_of_row(run, i, t, held));
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

rot_status rot_ode_fill_rows(rot_ode_march *run, int whole_stretch) {
  enum { BEYOND = 4, BEHIND = 8 };
  rot_dense *d = &run->dense;
  if (!run->y_rows) return ROT_OK;
  const int watching = run->watch_stiffness, held = run->phase == ROT_ODE_HELD;
  const double way = run->forward ? 1.0 : -1.0;
  const size_t beyond = whole_stretch ? 0 : BEYOND;
  size_t i = 0, formed = (size_t)-1;
  run->watch_stiffness = 0;
  rot_status status = d->count > beyond ? probe_steps(run, d->count - 1 - beyond, held) : ROT_OK;
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
    int filled = enough && !in_transient(run, node, t) && row_between(run, i, t, held);
    while (enough && !filled && mend(run)) filled = row_between(run, i, t, held);
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
