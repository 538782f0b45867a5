#include "engine/ode/probe.h"

#include <stdlib.h>
#include <string.h>

#include "engine/ode/norm.h"

/* Bins of a gap; gaps of a range at most. */
enum { FINE = 16, MAX_GAPS = 1000000 };
/* States of a piece, straight lines between which show the bins that it visits: these miss a step
 * over a third of the range by 1e-4 of it. */
enum { SAMPLES = 16 };
/* Differences below so many times what is unsure are those of the polynomials. */
#define UNSURE     8.0
/* Differences that change the state by less than this part of the accuracy are ignored: the
 * polynomials themselves may be off by 0.02 of it. */
#define IGNORED    1e-3
/* The same where the law is steep and the state unsure. */
#define STEEP      2.0
/* Where they are too unsure: differences between neighbouring probes beyond so many times those
 * around. */
#define STANDS_OUT 8.0
enum { AROUND = 4 };
/* Of the error figure: beside a weak kink the polynomials err as the steps do. */
#define EXPLAINED 0.5
/* Of the slope of a polynomial, and of its values over its length. */
#define ROUNDING  1e-14
/* Of a piece: the longest time between two calls of its step, 0.275 for rk8pd. */
#define BETWEEN   0.3

rot_ode_probes *rot_ode_probes_new(const rot_ode_params *p) {
  const size_t coordinates = p->controlled + 1, dim = p->dim;
  rot_ode_probes *q = calloc(1, sizeof *q);
  if (!q) return NULL;
  const double gaps = ceil(1.0 / (ROT_ODE_GAP * p->resolution));
  q->p = p;
  q->bins = FINE * (size_t)fmin(fmax(gaps, 1.0), MAX_GAPS);
  q->low = malloc(((5 + SAMPLES) * coordinates + 9 * dim) * sizeof *q->low);
  q->seen = malloc(coordinates * q->bins);
  q->states = malloc(3 * dim * ROT_ODE_MAX_SIGHTS * sizeof *q->states);
  if (!q->low || !q->seen || !q->states) {
    rot_ode_probes_free(q);
    return NULL;
  }
  q->width = q->low + coordinates;
  q->since = q->width + coordinates;
  q->span = q->since + coordinates;
  q->scratch = q->span + (2 + SAMPLES) * coordinates;
  for (size_t k = 0; k < ROT_ODE_MAX_SIGHTS; k++) q->sight[k].y = q->states + 3 * dim * k;
  rot_ode_probes_clear(q);
  return q;
}

void rot_ode_probes_free(rot_ode_probes *q) {
  if (!q) return;
  free(q->values);
  free(q->states);
  free(q->seen);
  free(q->low);
  free(q);
}

void rot_ode_probes_uncover(rot_ode_probes *q) {
  q->n_sights = 0;
  for (size_t i = 0; i <= q->p->controlled; i++) {
    q->since[i] = NAN;
    memset(q->seen + i * q->bins, isinf(q->width[i]), q->bins);
  }
}

void rot_ode_probes_clear(rot_ode_probes *q) {
  q->looked = 0;
  for (size_t i = 0; i <= q->p->controlled; i++) q->width[i] = INFINITY;
  q->n_sights = 0;
}

void rot_ode_probes_sift(rot_ode_probes *q, const double error[]) {
  size_t kept = 0;
  for (size_t k = 0; k < q->n_sights; k++) {
    const rot_ode_sight s = q->sight[k];
    if (!(s.worth > EXPLAINED * error[s.measure])) continue;
    q->sight[k] = q->sight[kept]; /* its memory goes with it */
    q->sight[kept++] = s;
  }
  q->n_sights = kept;
}

void rot_ode_probes_range(rot_ode_probes *q, const rot_ode_trace traces[2]) {
  const size_t n = q->p->controlled;
  for (size_t i = 0; i <= n; i++) {
    double low = INFINITY, high = -INFINITY;
    for (int side = 0; side < 2; side++) {
      for (size_t k = 0; k < traces[side].count; k++) {
        const double *node = rot_ode_node(&traces[side], k);
        const double x = i < n ? node[2 + i] : node[0];
        low = fmin(low, x);
        high = fmax(high, x);
      }
    }
    q->low[i] = low;
    q->width[i] = (high - low) / (double)q->bins;
    /* One value: nothing to cover. */
    if (!(q->width[i] > 0.0 && isfinite(q->width[i]))) q->width[i] = INFINITY;
  }
  q->looked = 1;
  rot_ode_probes_uncover(q);
}

/* ---- what is covered ------------------------------------------------------------------------- */

static size_t bin_of(const rot_ode_probes *q, size_t i, double x) {
  const double at = (x - q->low[i]) / q->width[i];
  return at > 0.0 ? (size_t)fmin(at, (double)(q->bins - 1)) : 0;
}

static double coordinate(const rot_ode_probes *q, size_t i, double t, const double y[]) {
  return i < q->p->controlled ? y[i] : t;
}

void rot_ode_probes_cover(rot_ode_probes *q, double t, const double y[]) {
  if (!q->looked) return;
  for (size_t i = 0; i <= q->p->controlled; i++) {
    const size_t at = bin_of(q, i, coordinate(q, i, t, y));
    const size_t first = at > FINE / 2 ? at - FINE / 2 : 0;
    const size_t last = at + FINE / 2 < q->bins ? at + FINE / 2 : q->bins - 1;
    memset(q->seen + i * q->bins + first, 1, last - first + 1);
    q->since[i] = NAN;
  }
}

/* Into how many parts a piece is to be divided so that none passes over a bin that is not covered;
 * 0: it visits none. */
static size_t parts_of(rot_ode_probes *q, const rot_ode_piece *piece) {
  const size_t n = q->p->controlled + 1;
  double max = 0.0;
  for (size_t k = 0; k <= SAMPLES; k++) {
    const double t = piece->t + (piece->end - piece->t) * (double)k / SAMPLES;
    piece->state(piece->path, t, q->scratch);
    for (size_t i = 0; i < n; i++) q->span[i * (SAMPLES + 1) + k] = coordinate(q, i, t, q->scratch);
  }
  for (size_t i = 0; i < n; i++) {
    const double *x = q->span + i * (SAMPLES + 1);
    double low = x[0], high = x[0], path = 0.0;
    if (isinf(q->width[i])) continue;
    for (size_t k = 1; k <= SAMPLES; k++) {
      low = fmin(low, x[k]);
      high = fmax(high, x[k]);
      path += fabs(x[k] - x[k - 1]);
    }
    const size_t first = bin_of(q, i, low - q->width[i]), last = bin_of(q, i, high + q->width[i]);
    if (!memchr(q->seen + i * q->bins + first, 0, last - first + 1)) continue;
    max = fmax(max, path / q->width[i]);
  }
  return max > 0.0 ? (size_t)ceil(fmin(max, 1e6)) + 1 : 0;
}

/* A coordinate at a part of the piece. */
static double sampled(const rot_ode_probes *q, size_t i, double part) {
  const size_t k = (size_t)fmin(part * SAMPLES, SAMPLES - 1);
  const double *x = q->span + i * (SAMPLES + 1) + k;
  return x[0] + (part * SAMPLES - (double)k) * (x[1] - x[0]);
}

/* ---- a probe --------------------------------------------------------------------------------- */

/* The nearest calls of the steps before and behind t, or the ends of the piece. */
static void calls_beside(const rot_ode_piece *piece, double t, double beside[2]) {
  const double whole = piece->end - piece->t, s = (t - piece->t) / whole;
  double before = 0.0, behind = 1.0;
  for (size_t k = 0; k < piece->n_called; k++) {
    if (piece->called[k] < s) before = fmax(before, piece->called[k]);
    if (piece->called[k] > s) behind = fmin(behind, piece->called[k]);
  }
  beside[0] = piece->t + before * whole;
  beside[1] = piece->t + behind * whole;
}

/* Of too many sights the least is given up. */
static rot_ode_sight *new_sight(rot_ode_probes *q, double worth) {
  size_t min = 0;
  if (q->n_sights < ROT_ODE_MAX_SIGHTS) return &q->sight[q->n_sights++];
  for (size_t k = 1; k < q->n_sights; k++) {
    if (q->sight[k].worth < q->sight[min].worth) min = k;
  }
  return worth > q->sight[min].worth ? &q->sight[min] : NULL;
}

/* The measure that differs most, by how much, and the component that differs most in it. */
typedef struct difference {
  size_t component, measure;
  double worth;
} difference;

static size_t largest_of(rot_ode_group g, const double gap[]) {
  size_t largest = g.first;
  for (size_t i = 1; i < g.count; i++) {
    if (fabs(gap[g.first + i]) > fabs(gap[largest])) largest = g.first + i;
  }
  return largest;
}

/* A sight with its times and states; NULL where it is not worth as much as those kept. */
static rot_ode_sight *add_sight(rot_ode_probes *q, const difference *found, const double t[3],
                                const double *const y[3]) {
  const size_t dim = q->p->dim;
  rot_ode_sight *s = new_sight(q, found->worth);
  if (!s) return NULL;
  s->component = found->component;
  s->measure = found->measure;
  s->worth = found->worth;
  s->mode = q->p->mode ? *q->p->mode : 0;
  for (size_t k = 0; k < 3; k++) {
    s->t[k] = t[k];
    memcpy(s->y + k * dim, y[k], dim * sizeof *s->y);
  }
  return s;
}

/* At t, where the state is y, between the nearest calls of the steps. */
static void note_sight(rot_ode_probes *q, const rot_ode_piece *piece, double t, const double y[],
                       difference found) {
  double beside[2];
  calls_beside(piece, t, beside);
  const double times[3] = {beside[0], t, beside[1]};
  const double *const states[3] = {y, y, y};
  rot_ode_sight *s = add_sight(q, &found, times, states);
  for (size_t k = 0; s && k < 3; k += 2) piece->state(piece->path, s->t[k], s->y + k * q->p->dim);
}

/* Whether the law differs from the slope by more than what is unsure, and how. */
static int differs(const rot_ode_params *p, const double gap[], const double unsure[], double time,
                   const double largest[], difference *found, int *undecided) {
  double max = -1.0;
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    const double d = rot_ode_rate(g, gap), worth = d * time;
    const double doubt = UNSURE * rot_ode_rate(g, unsure), min = IGNORED * p->accuracy * largest[m];
    if (doubt * time > 1e3 * min && m < rot_ode_steering(p)) *undecided = 1;
    if (d <= doubt || worth <= min) continue;
    const double part = largest[m] > 0.0 ? worth / largest[m] : INFINITY;
    if (!(part > max)) continue;
    max = part;
    *found = (difference){largest_of(g, gap), m, worth};
  }
  return max >= 0.0;
}

rot_status rot_ode_probe_at(rot_ode_probes *q, const rot_ode_piece *piece, double t, double dydt[],
                            int *known) {
  const rot_ode_params *p = q->p;
  const size_t dim = p->dim;
  double *y = q->scratch + dim, *slope = y + dim, *y_unsure = slope + dim, *unsure = y_unsure + dim,
         *gap = unsure + dim, *moved = gap + dim;
  difference found;
  *known = piece->believed(piece->path, t, y, slope, y_unsure, unsure);
  if (!*known) return ROT_OK;
  rot_status status = piece->call(piece->path, t, y, dydt);
  if (status == ROT_ERHS) { /* not defined here: a step that ends here says so */
    note_sight(q, piece, t, y, (difference){0, 0, INFINITY});
    *known = 0;
    return ROT_OK;
  }
  if (status != ROT_OK) return status;
  const double whole = fabs(piece->end - piece->t), time = BETWEEN * whole;
  for (size_t i = 0; i < dim; i++) {
    gap[i] = dydt[i] - slope[i];
    unsure[i] += ROUNDING * (fmax(fabs(dydt[i]), fabs(slope[i])) + fabs(y[i]) / whole);
  }
  if (piece->held && p->turn) { /* what drives it may change as long as it is held */
    const double drive = fabs(dydt[p->turn->driver]);
    if (drive <= p->turn->holds) return ROT_OK;
    note_sight(q, piece, t, y, (difference){p->turn->driver, 0, INFINITY});
    return ROT_OK;
  }
  if (!differs(p, gap, unsure, time, piece->largest, &found, &q->undecided)) return ROT_OK;
  /* A law that is steep in the state differs where the state is unsure. */
  int steep = 0;
  for (size_t i = 0; i < p->controlled; i++) steep |= y_unsure[i] > 0.0;
  if (steep) {
    for (size_t i = 0; i < dim; i++) y_unsure[i] += y[i];
    status = piece->call(piece->path, t, y_unsure, moved);
    if (status != ROT_OK) return status == ROT_ERHS ? ROT_OK : status;
    for (size_t i = 0; i < dim; i++) {
      unsure[i] += STEEP / UNSURE * fabs(moved[i] - dydt[i]);
    }
    if (!differs(p, gap, unsure, time, piece->largest, &found, &q->undecided)) return ROT_OK;
  }
  note_sight(q, piece, t, y, found);
  return ROT_OK;
}

/* ---- probes of a piece compared among themselves --------------------------------------------- */

static rot_status keep_value(rot_ode_probes *q, double t, const double y[], const double dydt[]) {
  const size_t dim = q->p->dim, each = 1 + 2 * dim;
  if (rot_ode_make_room(&q->values, &q->room, q->n_values, each) != ROT_OK) return ROT_ENOMEM;
  double *at = q->values + q->n_values++ * each;
  at[0] = t;
  memcpy(at + 1, y, dim * sizeof *y);
  memcpy(at + 1 + dim, dydt, dim * sizeof *dydt);
  return ROT_OK;
}

/* At t, where the rough state is y. */
static rot_status probe_in(rot_ode_probes *q, const rot_ode_piece *piece, double t, double y[],
                           double dydt[]) {
  int known;
  rot_status status = rot_ode_probe_at(q, piece, t, dydt, &known);
  if (status != ROT_OK || piece->held) return status;
  for (size_t i = q->p->controlled; i < q->p->dim; i++) y[i] = 0.0;
  if (!known) {
    q->undecided = 1;
    status = piece->call(piece->path, t, y, dydt);
    if (status != ROT_OK) return status == ROT_ERHS ? ROT_OK : status;
  }
  return keep_value(q, t, y, dydt);
}

/* How far measure m of the slope changes from probe k to the next. */
static double change_after(const rot_ode_probes *q, size_t k, size_t m, double change[]) {
  const size_t dim = q->p->dim, each = 1 + 2 * dim;
  const double *a = q->values + k * each + 1 + dim, *b = a + each;
  for (size_t i = 0; i < dim; i++) change[i] = b[i] - a[i];
  return rot_ode_rate(rot_ode_group_of(q->p, m), change);
}

/* The change after probe k against the median of those around it. */
static int stands_out(const rot_ode_probes *q, size_t k, size_t m, double change[], double *d) {
  double around[2 * AROUND];
  size_t n = 0, above = 0;
  *d = change_after(q, k, m, change);
  for (size_t j = k > AROUND ? k - AROUND : 0; j + 1 < q->n_values && j <= k + AROUND; j++) {
    if (j != k) around[n++] = change_after(q, j, m, change);
  }
  for (size_t j = 0; j < n; j++) above += *d <= STANDS_OUT * around[j];
  return n >= AROUND && 2 * above < n;
}

static void look_among(rot_ode_probes *q, const rot_ode_piece *piece) {
  const size_t dim = q->p->dim, each = 1 + 2 * dim;
  const double time = BETWEEN * fabs(piece->end - piece->t);
  double *change = q->scratch + dim, d;
  for (size_t k = 0; k + 1 < q->n_values; k++) {
    for (size_t m = 0; m < rot_ode_steering(q->p); m++) {
      if (!stands_out(q, k, m, change, &d)) continue;
      if (!(d * time > IGNORED * q->p->accuracy * piece->largest[m])) continue;
      const double *before = q->values + k * each, *at = before + each;
      const double *behind = k + 2 < q->n_values ? at + each : at;
      change_after(q, k, m, change);
      const difference found = {largest_of(rot_ode_group_of(q->p, m), change), m, d * time};
      const double times[3] = {before[0], at[0], behind[0]};
      const double *const states[3] = {before + 1, at + 1, behind + 1};
      if (!add_sight(q, &found, times, states)) return;
    }
  }
}

rot_status rot_ode_probe(rot_ode_probes *q, const rot_ode_piece *piece) {
  const size_t n = q->p->controlled;
  const double whole = piece->end - piece->t;
  double *y = q->scratch, *dydt = q->scratch + 7 * q->p->dim;
  if (!q->looked || whole == 0.0) return ROT_OK;
  const size_t parts = parts_of(q, piece);
  q->undecided = 0;
  q->n_values = 0;
  if (parts == 0) {
    for (size_t i = 0; i <= n; i++) q->since[i] = NAN;
    return ROT_OK;
  }
  for (size_t k = 0; k < piece->n_called && !piece->covered; k++) {
    const double t = piece->t + piece->called[k] * whole;
    piece->state(piece->path, t, y);
    rot_ode_probes_cover(q, t, y);
  }
  for (size_t k = 1; k < parts; k++) {
    const double part = (double)k / (double)parts, t = piece->t + part * whole;
    int due = 0;
    for (size_t i = 0; i <= n; i++) {
      const double x = sampled(q, i, part);
      if (q->seen[i * q->bins + bin_of(q, i, x)]) {
        q->since[i] = NAN;
      } else if (isnan(q->since[i])) {
        q->since[i] = x;
      } else {
        due |= fabs(x - q->since[i]) >= (FINE / 2 - 1) * q->width[i];
      }
    }
    if (!due) continue;
    piece->state(piece->path, t, y);
    rot_ode_probes_cover(q, t, y);
    const rot_status status = probe_in(q, piece, t, y, dydt);
    if (status != ROT_OK) return status;
  }
  if (q->undecided && piece->smooth && !piece->held) look_among(q, piece);
  return ROT_OK;
}
