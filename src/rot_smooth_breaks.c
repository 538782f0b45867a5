#include "rot_smooth_breaks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = ROT_SMOOTH_CHANNELS };

/* A sample is left out beyond 4.5 leave-one-out s.d. A shock of a state that is not there exceeds
 * 11 to 22 once in 100 records of 200 to 5000 samples; those that were there gave 48 to 366. */
static const double outlier = 4.5 * 4.5, shock_level = 25.0;
enum { FROM_END = 4, APART = 5, NEIGHBOURS = 2, POINTS = 20, ROUNDS = 400 };
static const double golden = 0.6180339887498949;

/* ---- the time of a break --------------------------------------------------------------------- */

/* The part of a record about a break, with the breaks of that part. */
typedef struct window {
  rot_smooth_record part;
  rot_smooth_grid grid;
  rot_smooth_break *breaks;
  size_t n, at; /* breaks; the one in question */
  const rot_smooth_fit *fit;
  size_t first; /* sample of the record */
} window;

static rot_status window_open(window *w, const rot_smooth_record *record, double unit_s,
                              const rot_smooth_fit *fit, size_t n_breaks,
                              const rot_smooth_break *breaks, size_t which) {
  /* The smoother forgets over some lambda^(-1/(2p)) samples. */
  const double memory = pow(fit->model.lambda, -0.5 / fit->model.order);
  const size_t reach = (size_t)fmin(100.0 + 10.0 * memory, (double)record->n);
  const rot_smooth_break *of = breaks + which;
  size_t low = 0, high = record->n, centre;
  if (record->segment) {
    while (low < record->n && record->segment[low] < of->segment) low++;
    high = low;
    while (high < record->n && record->segment[high] == of->segment) high++;
  }
  centre = low;
  while (centre < high && record->time_s[centre] < of->time_s) centre++;
  const size_t a = centre > low + reach ? centre - reach : low;
  const size_t b = centre + reach < high ? centre + reach : high;
  w->part = *record;
  w->part.n = b - a;
  w->part.time_s += a;
  w->part.segment = NULL;
  for (int c = 0; c < CHANNELS; c++) {
    if (w->part.y[c]) w->part.y[c] += a;
    if (w->part.w[c]) w->part.w[c] += a;
  }
  w->first = a;
  w->fit = fit;
  w->grid.memory = NULL;
  w->breaks = malloc((n_breaks + 1) * sizeof *w->breaks);
  if (!w->breaks) return ROT_ENOMEM;
  w->n = w->at = 0;
  for (size_t i = 0; i < n_breaks; i++) {
    if (breaks[i].segment != of->segment || b == a) continue;
    if (i != which &&
        (breaks[i].time_s <= w->part.time_s[0] || breaks[i].time_s >= w->part.time_s[b - a - 1]))
      continue;
    if (i == which) w->at = w->n;
    w->breaks[w->n] = breaks[i];
    w->breaks[w->n++].segment = 0;
  }
  const rot_status status = rot_smooth_grid_new(&w->grid, &w->part, w->n, 0);
  if (status == ROT_OK) w->grid.unit_s = unit_s;
  return status;
}

static void window_close(window *w) {
  free(w->breaks);
  rot_smooth_grid_free(&w->grid);
}

/* -2 log L of the window with the break at this time, or without it (NaN). */
static double window_try(window *w, double time_s, int first) {
  rot_smooth_sums sums;
  double sigma;
  size_t n = w->n;
  rot_smooth_break *list = w->breaks, without[1];
  const rot_smooth_break kept = list[w->at];
  if (isnan(time_s)) {
    memmove(list + w->at, list + w->at + 1, (n - w->at - 1) * sizeof *list);
    n--;
  } else {
    list[w->at].time_s = time_s;
    list[w->at].first = first;
  }
  rot_smooth_grid_fill(&w->grid, &w->part, w->fit->ratio, n, n > 0 ? list : without, NULL);
  const double value =
      rot_smooth_objective(&w->grid.nodes, &w->fit->model,
                           rot_smooth_floor(&w->grid, &w->part, w->fit->ratio), &sigma, &sums);
  if (isnan(time_s)) {
    memmove(list + w->at + 1, list + w->at, (w->n - w->at - 1) * sizeof *list);
    list[w->at] = kept;
  }
  return value;
}

/* The best time between a and b for this level: points, then golden section. */
static double window_time(window *w, double a, double b, int first, double *least) {
  double at = a, best = HUGE_VAL;
  const double step = (b - a) / (POINTS - 1);
  for (int i = 0; i < POINTS; i++) {
    const double value = window_try(w, a + i * step, first);
    if (value < best) {
      best = value;
      at = a + i * step;
    }
  }
  double low = fmax(at - step, a), high = fmin(at + step, b);
  double t1 = high - golden * (high - low), t2 = low + golden * (high - low);
  double v1 = window_try(w, t1, first), v2 = window_try(w, t2, first);
  while (high - low > 1e-3 * w->grid.unit_s) {
    if (v1 < v2) {
      high = t2, t2 = t1, v2 = v1;
      t1 = high - golden * (high - low);
      v1 = window_try(w, t1, first);
    } else {
      low = t1, t1 = t2, v1 = v2;
      t2 = low + golden * (high - low);
      v2 = window_try(w, t2, first);
    }
  }
  if (fmin(v1, v2) < best) {
    best = fmin(v1, v2);
    at = v1 < v2 ? t1 : t2;
  }
  *least = best;
  return at;
}

/* Time and level of one break by likelihood at the fit's smoothness, in the interval of `before`
 * samples before it to `after` behind it. `gain`: by how much -2 log L with its penalty falls. */
static rot_status place(const rot_smooth_record *record, double unit_s, const rot_smooth_fit *fit,
                        size_t n_breaks, rot_smooth_break *breaks, size_t which, int before,
                        int after, double *gain) {
  window w;
  const rot_status status = window_open(&w, record, unit_s, fit, n_breaks, breaks, which);
  if (status == ROT_OK && w.part.n > 0) {
    const double penalty = log((double)record->n);
    size_t k = 0;
    double a, b, best = HUGE_VAL;
    while (k + 1 < w.part.n && w.part.time_s[k] < breaks[which].time_s) k++;
    a = w.part.time_s[k > (size_t)before ? k - (size_t)before : 0];
    b = w.part.time_s[k + (size_t)after < w.part.n ? k + (size_t)after : w.part.n - 1];
    if (w.at > 0) a = fmax(a, w.breaks[w.at - 1].time_s + unit_s);
    if (w.at + 1 < w.n) b = fmin(b, w.breaks[w.at + 1].time_s - unit_s);
    const double without = window_try(&w, NAN, 0);
    for (int first = 1; first <= 2 && a < b; first++) {
      double value;
      const double time_s = window_time(&w, a, b, first, &value);
      value += penalty * (fit->model.order - first);
      if (value < best) {
        best = value;
        breaks[which].time_s = time_s;
        breaks[which].first = first;
      }
    }
    *gain = without - best;
  } else
    *gain = -HUGE_VAL;
  window_close(&w);
  return status;
}

rot_status rot_smooth_time_error(const rot_smooth_record *record, const rot_smooth_fit *fit,
                                 size_t n_breaks, const rot_smooth_break *breaks, size_t which,
                                 double *error_s) {
  window w;
  rot_smooth_grid grid;
  rot_status status = rot_smooth_grid_new(&grid, record, 0, 0);
  const double unit_s = grid.unit_s;
  *error_s = NAN;
  if (status == ROT_OK) {
    rot_smooth_grid_free(&grid);
    status = window_open(&w, record, unit_s, fit, n_breaks, breaks, which);
    if (status == ROT_OK) {
      const double t = breaks[which].time_s, at = window_try(&w, t, breaks[which].first);
      double sum = 0.0;
      for (int side = -1; side <= 1; side += 2) {
        double low = 0.0, high = 1e-4 * unit_s;
        while (high < 5.0 * unit_s &&
               !(window_try(&w, t + side * high, breaks[which].first) > at + 1.0)) {
          low = high;
          high *= 2.0;
        }
        if (!(high < 5.0 * unit_s)) {
          sum = NAN;
          break;
        }
        for (int i = 0; i < 12; i++) {
          const double middle = 0.5 * (low + high);
          if (window_try(&w, t + side * middle, breaks[which].first) > at + 1.0)
            high = middle;
          else
            low = middle;
        }
        sum += high;
      }
      *error_s = 0.5 * sum;
    }
    window_close(&w);
  }
  return status;
}

/* ---- the loop -------------------------------------------------------------------------------- */

typedef struct finding {
  rot_smooth_record *record;
  const rot_smooth_finding *how;
  const rot_hooks *hooks;
  rot_smooth_grid grid;
  rot_smooth_store store;
  double *shock, *residual[CHANNELS]; /* of each node */
  double *worst;                      /* of each sample: the largest squared residual */
  unsigned char *tried;               /* no break here */
  rot_smooth_break *breaks;
  size_t n_breaks;
  rot_smooth_fit fit;
} finding;

static rot_status look(finding *of) {
  const size_t n = of->record->n;
  const double variance = of->fit.sigma * of->fit.sigma;
  rot_smooth_sums sums;
  rot_smooth_grid_fill(&of->grid, of->record, of->fit.ratio, of->n_breaks, of->breaks, NULL);
  rot_smooth_filter(&of->grid.nodes, &of->fit.model, 0, of->grid.nodes.n, &of->store, 1, &sums);
  rot_smooth_scores(&of->grid.nodes, &of->fit.model, &of->store, of->shock, of->residual);
  for (size_t i = 0; i < n; i++) {
    const size_t k = of->grid.sample[i];
    of->worst[i] = 0.0;
    of->shock[i] = of->shock[k] / variance; /* sample[i] >= i: in place */
    for (int c = 0; c < CHANNELS; c++) {
      const double e = of->residual[c][k];
      if (e * e / variance > of->worst[i]) of->worst[i] = e * e / variance;
    }
  }
  return rot_poll(of->hooks, 0.0);
}

static int segment_of(const finding *of, size_t i) {
  return of->record->segment ? of->record->segment[i] : 0;
}

/* Leaves out samples: local maxima beyond the limit and above the shocks beside them. */
static size_t leave_out(finding *of) {
  const size_t n = of->record->n;
  size_t left = 0;
  for (size_t i = 0; i < n; i++) {
    const double e = of->worst[i];
    int most = e > outlier;
    for (size_t j = i > NEIGHBOURS ? i - NEIGHBOURS : 0; most && j <= i + NEIGHBOURS && j < n;
         j++) {
      if (segment_of(of, j) != segment_of(of, i)) continue;
      if (of->how->breaks && of->shock[j] >= e) most = 0;
      if ((j + 1 == i || j == i + 1) && of->worst[j] > e) most = 0;
    }
    if (!most) continue;
    for (int c = 0; c < CHANNELS; c++) {
      const double r = of->record->y[c] ? of->residual[c][of->grid.sample[i]] : NAN;
      if (r * r > outlier * of->fit.sigma * of->fit.sigma) of->record->w[c][i] = HUGE_VAL;
    }
    left++;
  }
  return left;
}

/* The sample with the largest shock where a break may be, or n. */
static size_t most_shocked(const finding *of) {
  const size_t n = of->record->n;
  size_t best = n, b = 0, since = 0;
  double most = shock_level;
  for (size_t i = 0; i < n; i++) {
    since = i > 0 && segment_of(of, i) == segment_of(of, i - 1) ? since + 1 : 0;
    if (!(of->shock[i] > most) || of->tried[i] || since < FROM_END) continue;
    if (i + FROM_END >= n || segment_of(of, i + FROM_END) != segment_of(of, i)) continue;
    int free_of = 1;
    for (b = 0; b < of->n_breaks && free_of; b++) {
      if (of->breaks[b].segment != segment_of(of, i)) continue;
      const size_t low = i >= APART ? i - APART : 0, high = i + APART < n ? i + APART : n - 1;
      const double t = of->breaks[b].time_s;
      free_of = t < of->record->time_s[low] || t > of->record->time_s[high];
    }
    if (!free_of) continue;
    most = of->shock[i];
    best = i;
  }
  return best;
}

static void insert(finding *of, double time_s, int segment, size_t *at) {
  size_t i = of->n_breaks;
  while (i > 0 && (of->breaks[i - 1].segment > segment ||
                   (of->breaks[i - 1].segment == segment && of->breaks[i - 1].time_s > time_s))) {
    of->breaks[i] = of->breaks[i - 1];
    i--;
  }
  of->breaks[i].time_s = time_s;
  of->breaks[i].segment = segment;
  of->breaks[i].first = 1;
  of->n_breaks++;
  *at = i;
}

static void take_out(finding *of, size_t at) {
  of->n_breaks--;
  memmove(of->breaks + at, of->breaks + at + 1, (of->n_breaks - at) * sizeof *of->breaks);
}

static rot_status refit(finding *of, int all) {
  const rot_smooth_fit near = of->fit;
  const int order = of->fit.model.order;
  return rot_smooth_search(&of->grid, of->record, of->n_breaks, of->breaks,
                           all ? of->how->first_order : order, all ? of->how->last_order : order,
                           all ? NULL : &near, of->hooks, &of->fit);
}

/* Samples, then breaks, at this order. */
static rot_status settle(finding *of, size_t given, size_t *changes) {
  rot_status status = ROT_OK;
  for (int round = 0; round < ROUNDS && status == ROT_OK; round++) {
    status = look(of);
    if (status != ROT_OK) return status;
    if (of->how->outliers && leave_out(of) > 0) {
      ++*changes;
      status = refit(of, 0);
      continue;
    }
    if (!of->how->breaks || of->n_breaks - given >= of->how->most_breaks) return ROT_OK;
    const size_t k = most_shocked(of);
    if (k == of->record->n) return ROT_OK;
    size_t at;
    double gain;
    const rot_smooth_fit kept = of->fit;
    insert(of, of->record->time_s[k], segment_of(of, k), &at);
    status =
        place(of->record, of->grid.unit_s, &of->fit, of->n_breaks, of->breaks, at, 3, 2, &gain);
    if (status == ROT_OK && gain > 0.0) status = refit(of, 0);
    /* Smoothness was chosen with the break inside: place it again. */
    if (status == ROT_OK && gain > 0.0)
      status =
          place(of->record, of->grid.unit_s, &of->fit, of->n_breaks, of->breaks, at, 3, 3, &gain);
    if (status == ROT_OK && gain > 0.0) {
      ++*changes;
      status = refit(of, 0);
    } else {
      take_out(of, at);
      of->fit = kept;
      of->tried[k] = 1;
    }
  }
  return status;
}

rot_status rot_smooth_find(rot_smooth_record *record, const rot_smooth_finding *how,
                           rot_smooth_break *breaks, size_t *n_breaks, const rot_hooks *hooks,
                           rot_smooth_fit *fit) {
  const size_t room = *n_breaks + how->most_breaks, nodes = record->n + 2 * room;
  const size_t given = *n_breaks;
  finding of;
  memset(&of, 0, sizeof of);
  of.record = record;
  of.how = how;
  of.hooks = hooks;
  of.breaks = breaks;
  of.n_breaks = *n_breaks;
  rot_status status = rot_smooth_grid_new(&of.grid, record, room, 0);
  if (status == ROT_OK) status = refit(&of, 1);
  if (status == ROT_OK && (how->breaks || how->outliers)) {
    double *memory = calloc((2 + CHANNELS) * nodes, sizeof *memory);
    status = rot_smooth_store_new(&of.store, nodes, ROT_SMOOTH_MOST);
    of.tried = calloc(record->n + 1, 1);
    if (!memory || !of.tried) status = ROT_ENOMEM;
    of.shock = memory;
    if (status == ROT_OK) {
      of.worst = memory + nodes;
      for (int c = 0; c < CHANNELS; c++) of.residual[c] = memory + (size_t)(2 + c) * nodes;
    }
    for (int pass = 0; pass < 4 && status == ROT_OK; pass++) {
      size_t changes = 0;
      status = settle(&of, given, &changes);
      if (status != ROT_OK || changes == 0) break;
      const int order = of.fit.model.order;
      status = refit(&of, 1);
      if (of.fit.model.order == order) break;
    }
    for (size_t i = 0; how->breaks && i < of.n_breaks && status == ROT_OK; i++) {
      double gain;
      status = place(record, of.grid.unit_s, &of.fit, of.n_breaks, of.breaks, i, 2, 2, &gain);
    }
    if (status == ROT_OK && of.n_breaks > given) status = refit(&of, 0);
    free(memory);
    free(of.tried);
    rot_smooth_store_free(&of.store);
  }
  rot_smooth_grid_free(&of.grid);
  *n_breaks = of.n_breaks;
  *fit = of.fit;
  return status;
}
