#include "engine/ode/rows.h"

#include <math.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "engine/ode/rest.h"
#include "ground/search.h"

int rot_ode_rows_within(const rot_ode_output *out, double a, double b) {
  const size_t first = rot_lower_bound(out->n, out->time_s, fmin(a, b));
  return first < out->n && out->time_s[first] <= fmax(a, b);
}

static size_t row_now(const rot_ode_rows *r) {
  return r->clock->forward ? r->out.before + r->done : r->out.before - 1 - r->done;
}

static void row_is(rot_ode_rows *r, const double y[], double slope) {
  const size_t row = row_now(r), dim = r->law->p->dim;
  memcpy(r->out.y + row * dim, y, dim * sizeof *y);
  if (r->out.slope) r->out.slope[row] = slope;
  r->done++;
  if (r->clock->forward) r->law->info->rows_done = row + 1;
}

void rot_ode_rows_at_start(rot_ode_rows *r) {
  const rot_ode_params *p = r->law->p;
  r->total = r->clock->forward ? r->out.n - r->out.before : r->out.before;
  r->done = 0;
  r->probed_t = p->start_s;
  while (r->out.y && r->done < r->total && r->out.time_s[row_now(r)] == p->start_s) {
    row_is(r, p->start, NAN);
  }
}

void rot_ode_rows_begin(rot_ode_rows *r) {
  r->segment_t = r->clock->t;
  r->dense.count = 0;
}

rot_status rot_ode_rows_node(rot_ode_rows *r) {
  return r->out.y ? rot_dense_insert(&r->dense, r->dense.count, r->clock->t, r->state->y,
                                     r->state->slope)
                  : ROT_OK;
}

/* Fraction of the last node, or of the last correction, that a row may have, of the accuracy; and
 * how often it counts as an error: waves shorter than the steps show little of themselves in it. */
#define MAX_FRACTION   0.003
#define FRACTION_COUNT 7.0

/* Radau steps over a transient that dies out within its first step, and the values at the steps'
 * ends do not show it; the slope where the segment begins does. */
static int in_transient(const rot_ode_rows *r, const double *node, double t) {
  if (r->step->method != ROT_METHOD_RADAU || node[0] != r->segment_t) return 0;
  for (size_t i = 0; i < r->law->p->controlled; i++) {
    double rise;
    rot_dense_at(&r->form[i], node[0], &rise, NULL, NULL);
    r->change[i] = (node[1 + r->law->p->dim + i] - rise) * (t - node[0]);
  }
  for (size_t m = 0; m < rot_ode_steering(r->law->p); m++) {
    const double missed = rot_ode_rate(rot_ode_group_of(r->law->p, m), r->change);
    if (!(missed <= FRACTION_COUNT * MAX_FRACTION * r->law->p->accuracy * r->state->largest[m]))
      return 1;
  }
  return 0;
}

/* ---- the path between two nodes, for probes -------------------------------------------------- */

typedef struct between {
  rot_ode_rows *r;
  size_t i;
} between;

/* The cubic through the nodes. */
static void state_between(void *path, double t, double y[]) {
  const between *w = path;
  const size_t dim = w->r->law->p->dim;
  const double *a = rot_dense_node(&w->r->dense, w->i), *b = a + 1 + 2 * dim;
  const double h = b[0] - a[0], s = (t - a[0]) / h;
  for (size_t k = 0; k < w->r->law->p->controlled; k++) {
    const double up = b[1 + k] - a[1 + k];
    const double bend = (1.0 - s) * (h * a[1 + dim + k] - up) - s * (h * b[1 + dim + k] - up);
    y[k] = a[1 + k] + s * (up + (1.0 - s) * bend);
  }
}

static void form(rot_ode_rows *r, size_t i) {
  if (r->formed == i) return;
  for (size_t k = 0; k < r->law->p->dim; k++) r->form[k] = rot_dense_between(&r->dense, i, k);
  r->formed = i;
}

static int believed_between(void *path, double t, double y[], double slope[], double y_unsure[],
                            double slope_unsure[]) {
  const between *w = path;
  rot_ode_rows *r = w->r;
  form(r, w->i);
  if (r->form[0].terms < 4 * (r->dense.slopes ? 2 : 1)) return 0;
  if (in_transient(r, rot_dense_node(&r->dense, w->i), t)) return 0;
  for (size_t k = 0; k < r->law->p->dim; k++) {
    y[k] = rot_dense_at(&r->form[k], t, &slope[k], &y_unsure[k], &slope_unsure[k]);
  }
  if (r->law->p->project) r->law->p->project(t, y, r->law->p->ctx);
  return 1;
}

static rot_status call_between(void *path, double t, const double y[], double dydt[]) {
  const between *w = path;
  return rot_ode_slope_at(w->r->law, t, y, dydt);
}

/* No transient, which dies out within: then the slopes at the ends are far from that between. */
static int is_smooth(const between *w) {
  const size_t dim = w->r->law->p->dim;
  const double *a = rot_dense_node(&w->r->dense, w->i), *b = a + 1 + 2 * dim;
  const double h = b[0] - a[0];
  int smooth = 1;
  for (size_t k = 0; k < w->r->law->p->controlled; k++) {
    const double up = b[1 + k] - a[1 + k], from = h * a[1 + dim + k], to = h * b[1 + dim + k];
    smooth &= fabs(up - 0.5 * (from + to)) <= 0.1 * fmax(fabs(from), fabs(to));
  }
  return smooth;
}

/* Stages of rk8pd that its error test weighs; the step has covered what they called. */
static const double stages[] = {
    0.0, 0.1475, 0.375, 0.465, 5490023248.0 / 9719169821.0, 0.65, 1201146811.0 / 1299019798.0, 1.0};

static rot_ode_piece piece_between(between *w, int held) {
  const rot_dense *d = &w->r->dense;
  const int explicit = w->r->step->method == ROT_METHOD_RK8PD && !held;
  return (rot_ode_piece){.t = rot_dense_node(d, w->i)[0],
                         .end = rot_dense_node(d, w->i + 1)[0],
                         .held = held,
                         .n_called = explicit ? sizeof stages / sizeof *stages : 0,
                         .called = stages,
                         .smooth = is_smooth(w),
                         .covered = 1,
                         .largest = w->r->state->largest,
                         .path = w,
                         .state = state_between,
                         .believed = believed_between,
                         .call = call_between};
}

/* Probes the steps of this segment up to node `last`. */
static rot_status probe_steps(rot_ode_rows *r, size_t last, int held) {
  const double direction = rot_ode_direction(r->clock);
  rot_status status = ROT_OK;
  for (size_t i = 0; r->probes && i < last && status == ROT_OK; i++) {
    const double end = rot_dense_node(&r->dense, i + 1)[0];
    if (direction * (end - r->probed_t) <= 0.0) continue;
    between w = {r, i};
    const rot_ode_piece piece = piece_between(&w, held);
    status = rot_ode_probe(r->probes, &piece);
    r->probed_t = end;
  }
  return status;
}

/* The law's own slope at a row. */
static double slope_of_row(rot_ode_rows *r, size_t i, double t, int held) {
  double slope = NAN;
  int known = 0;
  if (!r->out.slope || !r->probes) return slope;
  between w = {r, i};
  const rot_ode_piece piece = piece_between(&w, held);
  if (rot_ode_probe_at(r->probes, &piece, t, r->change, &known) == ROT_OK && known) {
    slope = r->change[r->law->p->sloped];
  }
  return slope;
}

/* A row from the polynomials; 0 if they are not good enough there. */
static int row_between(rot_ode_rows *r, size_t i, double t, int held) {
  const rot_ode_params *p = r->law->p;
  for (size_t k = 0; k < p->dim; k++) {
    r->row[k] = rot_dense_at(&r->form[k], t, NULL, &r->change[k], NULL);
  }
  /* At rest the integrals alone go on. */
  const size_t first = held ? rot_ode_steering(p) : 0;
  const size_t end = held ? rot_ode_measures(p) : rot_ode_steering(p);
  for (size_t m = first; m < end; m++) {
    const double fraction = rot_ode_rate(rot_ode_group_of(p, m), r->change);
    if (!(fraction <= MAX_FRACTION * p->accuracy * r->state->largest[m])) return 0;
    r->fraction[m] = fmax(r->fraction[m], FRACTION_COUNT * fraction);
  }
  /* No step is shortened for integrals; the polynomials' error in theirs was more than all else in
   * a tenth of the hoops and chains, up to 100 times. */
  const size_t all = p->integrals_between && !held ? rot_ode_measures(p) : 0;
  for (size_t m = rot_ode_steering(p); m < all; m++) {
    const double fraction = rot_ode_rate(rot_ode_group_of(p, m), r->change);
    r->fraction[m] = fmax(r->fraction[m], FRACTION_COUNT * fraction);
  }
  if (p->project) p->project(t, r->row, p->ctx);
  row_is(r, r->row, slope_of_row(r, i, t, held));
  return 1;
}

/* A call of rhs within the interval, at the value of the polynomials, corrects them: their error e
 * makes one of h e in the slope, where the slope of e itself is 7 e/h. */
static int correction(rot_ode_rows *r) {
  rot_dense_form *form = r->form;
  if (!r->dense.slopes || form[0].corrections == ROT_DENSE_CORRECTIONS) return 0;
  const double t = rot_dense_correction_at(&form[0]);
  for (size_t i = 0; i < r->law->p->dim; i++) {
    r->row[i] = rot_dense_at(&form[i], t, NULL, NULL, NULL);
  }
  if (rot_ode_slope_at(r->law, t, r->row, r->change) != ROT_OK) return 0;
  for (size_t i = 0; i < r->law->p->dim; i++) rot_dense_correct(&form[i], r->change[i]);
  return 1;
}

/* A row at rest between two nodes, which are too far away for polynomials of its integrals. */
static rot_status row_at_rest(rot_ode_rows *r, const double *node, double t) {
  const double h = t - node[0];
  const rot_status status =
      rot_ode_integrals_at_rest(r->law, node[0], h, node + 1, r->row, r->change);
  if (status == ROT_OK) row_is(r, r->row, r->change[r->law->p->sloped]);
  return status;
}

/* A node of its own for a row, or for the middle of an interval with several. */
static rot_status step_between(rot_ode_rows *r, size_t i, size_t rows) {
  const rot_ode_params *p = r->law->p;
  const double *node = rot_dense_node(&r->dense, i);
  const double a = node[0], b = rot_dense_node(&r->dense, i + 1)[0], t = r->out.time_s[row_now(r)];
  const double mid = 0.5 * (a + b);
  const int split = rows > 2 && mid != a && mid != b;
  const double to = split ? mid : t;
  const rot_status status = rot_ode_attempt(r->step, a, to - a, node + 1, node + 1 + p->dim);
  if (status != ROT_OK) return status;
  if (split) return rot_dense_insert(&r->dense, i + 1, mid, r->step->trial, r->step->trial_slope);
  if (p->project) p->project(to, r->step->trial, p->ctx);
  row_is(r, r->step->trial, r->dense.slopes ? r->step->trial_slope[p->sloped] : NAN);
  return ROT_OK;
}

rot_status rot_ode_fill_rows(rot_ode_rows *r, int whole_segment) {
  enum { BEYOND = 4, BEHIND = 8 };
  rot_dense *d = &r->dense;
  if (!r->out.y) return ROT_OK;
  const int held = r->state->phase == ROT_ODE_HELD;
  const double direction = rot_ode_direction(r->clock);
  const size_t beyond = whole_segment ? 0 : BEYOND;
  size_t i = 0;
  r->formed = (size_t)-1;
  rot_status status = d->count > beyond ? probe_steps(r, d->count - 1 - beyond, held) : ROT_OK;
  while (status == ROT_OK && r->done < r->total && d->count > beyond) {
    const double t = r->out.time_s[row_now(r)];
    const size_t last = d->count - 1 - beyond;
    if (direction * (t - rot_dense_node(d, last)[0]) > 0.0) break;
    while (i < last && direction * (t - rot_dense_node(d, i + 1)[0]) >= 0.0) i++;
    const double *node = rot_dense_node(d, i);
    if (t == node[0]) {
      const int inside = i > 0 && i + 1 < d->count;
      row_is(r, node + 1, inside ? node[1 + r->law->p->dim + r->law->p->sloped] : NAN);
      continue;
    }
    const int by_steps = r->step->fixed_s > 0.0 && !held;
    if (!by_steps) form(r, i);
    const int enough = !by_steps && r->form[0].terms >= 4 * (d->slopes ? 2 : 1);
    int filled = enough && !in_transient(r, node, t) && row_between(r, i, t, held);
    while (enough && !filled && correction(r)) filled = row_between(r, i, t, held);
    if (r->law->status != ROT_OK && r->law->status != ROT_ERHS) return r->law->status;
    if (filled) continue;
    if (held) {
      status = row_at_rest(r, node, t);
      continue;
    }
    size_t rows = 1;
    while (!by_steps && r->done + rows < r->total && rows < 3) {
      const double next = r->out.time_s[r->clock->forward ? row_now(r) + rows : row_now(r) - rows];
      if (direction * (next - rot_dense_node(d, i + 1)[0]) >= 0.0) break;
      rows++;
    }
    const size_t count = d->count;
    status = step_between(r, i, rows);
    if (d->count != count) r->formed = (size_t)-1;
  }
  if (!whole_segment && d->count > BEYOND + BEHIND + 1) {
    rot_dense_drop(d, d->count - (BEYOND + BEHIND + 1));
  }
  return status;
}
