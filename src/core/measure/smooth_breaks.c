#include "measure/smooth_breaks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = ROT_SMOOTH_CHANNELS };

/* A sample is excluded beyond 4.5 leave-one-out s.d. The score of an absent shock exceeds 11 to 22
 * once in 100 records of 200 to 5000 samples; actual shocks gave 48 to 366. */
static const double outlier = 4.5 * 4.5, shock_level = 25.0;
/* A kink of the acceleration is a shock of one state: without one the largest score is 5 to 16.
 * After the kink and the smoothness are fitted, torque ramps have 38 to 95, others up to 28 (350
 * coast-downs). */
static const double kink_level = 10.0, kink_shows = 30.0;
enum { IMPACT = 1, SWITCH = 2, KINK = 3 }; /* the first diffuse state */
enum {
  FROM_END = 4,   /* min samples between a break and an end or another break */
  SPACING = 5,    /* min samples between new breaks */
  NEIGHBOURS = 2, /* samples compared with an outlier on each side */
  POINTS = 20,    /* of a grid of times */
  ROUNDS = 400    /* max changes */
};
static const double golden = 0.6180339887498949;

/* ---- the time of a break --------------------------------------------------------------------- */

/* The part of a record around one break, with the breaks of that part. */
typedef struct window {
  rot_smooth_record part;
  rot_smooth_grid grid;
  rot_smooth_break *breaks;
  size_t n;  /* breaks in the window */
  size_t at; /* index of the break studied */
  const rot_smooth_fit *fit;
  size_t first; /* index of the window's first sample in the record */
} window;

/* => memory of the smoother in samples, about lambda^(-1/(2p)) */
static double memory_of(const rot_smooth_fit *fit) {
  return pow(fit->model.lambda, -0.5 / fit->model.order);
}

/* (record, break `which`) => window around it; window_close() in each case */
static rot_status window_open(window *w, const rot_smooth_record *record, double unit_s,
                              const rot_smooth_fit *fit, size_t n_breaks,
                              const rot_smooth_break *breaks, size_t which) {
  const size_t reach = (size_t)fmin(100.0 + 10.0 * memory_of(fit), (double)record->n);
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
  if (w->part.slow) {
    w->part.slow += a;
    w->part.clock += a;
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

/* => -2 log L of the window with the break at this time, without it for NaN */
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

/* => best time between a and b for a break of kind `first`, by a grid and golden section; *min: its
 * -2 log L */
static double window_time(window *w, double a, double b, int first, double *min) {
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
  *min = best;
  return at;
}

static int is_kept(const rot_smooth_record *record, size_t i) {
  for (int c = 0; c < CHANNELS; c++)
    if (record->y[c] && !isnan(record->y[c][i]) && !(record->w[c] && record->w[c][i] >= HUGE_VAL))
      return 1;
  return 0;
}

/* => limit of the break's time for which FROM_END samples lie between it and the end of the window
 * or the next break, before it (side -1) or after it (1) */
static double nearest(const window *w, int side) {
  const size_t n = w->part.n;
  const int more = side < 0 ? w->at > 0 : w->at + 1 < w->n;
  const double other = more ? w->breaks[side < 0 ? w->at - 1 : w->at + 1].time_s : 0.0;
  int seen = 0;
  for (size_t j = 0; j < n; j++) {
    const size_t i = side < 0 ? j : n - 1 - j;
    if (more && (w->part.time_s[i] - other) * side > 0.0) continue;
    if (is_kept(&w->part, i) && ++seen == FROM_END) return w->part.time_s[i];
  }
  return side < 0 ? HUGE_VAL : -HUGE_VAL;
}

/* Optimizes time and kind of one break by likelihood at the fit's smoothness, from `before` samples
 * before it to `after` samples after it; a kink remains a kink. `gain`: decrease of -2 log L with
 * its penalty. */
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
    a = fmax(a, nearest(&w, -1));
    b = fmin(b, nearest(&w, 1));
    const double without = window_try(&w, NAN, 0);
    const int kink = breaks[which].first == KINK;
    for (int first = kink ? KINK : IMPACT; first <= (kink ? KINK : SWITCH) && a < b; first++) {
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
      const double max = 5.0 * unit_s * (breaks[which].first == KINK ? memory_of(fit) : 1.0);
      double sum = 0.0;
      for (int side = -1; side <= 1; side += 2) {
        double low = 0.0, high = 1e-4 * unit_s;
        while (high < max && !(window_try(&w, t + side * high, breaks[which].first) > at + 1.0)) {
          low = high;
          high *= 2.0;
        }
        if (!(high < max)) {
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
  double *shock, *kink, *residual[CHANNELS]; /* scores of each node, then of each sample */
  double *worst;                             /* of each sample: max squared residual */
  unsigned char *tried, *no_kink;            /* 1: no break, no kink at this sample */
  rot_smooth_break *breaks;
  size_t n_breaks;
  rot_smooth_fit fit;
} finding;

static int segment_of(const finding *of, size_t i) {
  return of->record->segment ? of->record->segment[i] : 0;
}

/* fit => scores and worst residual of each sample */
static rot_status look(finding *of) {
  const size_t n = of->record->n;
  const double variance = of->fit.sigma * of->fit.sigma;
  rot_smooth_sums sums;
  rot_smooth_grid_fill(&of->grid, of->record, of->fit.ratio, of->n_breaks, of->breaks, NULL);
  rot_smooth_filter(&of->grid.nodes, &of->fit.model, 0, of->grid.nodes.n, &of->store, 1, &sums);
  rot_smooth_scores(&of->grid.nodes, &of->fit.model, &of->store, of->shock, of->kink, of->residual);
  size_t since = 0;
  for (size_t i = 0; i < n; i++) {
    const size_t k = of->grid.sample[i];
    since = i > 0 && segment_of(of, i) == segment_of(of, i - 1) ? since + 1 : 0;
    /* Near the ends the residuals of a shock and of an outlier are equal. */
    const int inside =
        since >= FROM_END && i + FROM_END < n && segment_of(of, i + FROM_END) == segment_of(of, i);
    of->worst[i] = 0.0;
    of->shock[i] = inside ? of->shock[k] / variance : 0.0; /* sample[i] >= i: in place */
    of->kink[i] = inside && of->fit.model.order == KINK + 1 ? of->kink[k] / variance : 0.0;
    for (int c = 0; c < CHANNELS; c++) {
      const double e = of->residual[c][k];
      if (e * e / variance > of->worst[i]) of->worst[i] = e * e / variance;
    }
  }
  return rot_poll(of->hooks, 0.0);
}

/* Excludes samples that are local maxima beyond the limit and above the scores of shocks next to
 * them; returns their number. */
static size_t leave_out(finding *of) {
  const size_t n = of->record->n;
  size_t left = 0;
  for (size_t i = 0; i < n; i++) {
    const double e = of->worst[i];
    int max = e > outlier;
    for (size_t j = i > NEIGHBOURS ? i - NEIGHBOURS : 0; max && j <= i + NEIGHBOURS && j < n; j++) {
      if (segment_of(of, j) != segment_of(of, i)) continue;
      if (of->how->breaks && of->shock[j] >= e) max = 0;
      if ((j + 1 == i || j == i + 1) && of->worst[j] > e) max = 0;
    }
    if (!max) continue;
    for (int c = 0; c < CHANNELS; c++) {
      const double r = of->record->y[c] ? of->residual[c][of->grid.sample[i]] : NAN;
      if (r * r > outlier * of->fit.sigma * of->fit.sigma) of->record->w[c][i] = HUGE_VAL;
    }
    left++;
  }
  return left;
}

/* => sample with the largest score above `level`, at least `spacing` samples from breaks and
 * `inside` samples from the ends of its segment; n if none */
static size_t highest(const finding *of, const double *score, double level, size_t spacing,
                      size_t inside, const unsigned char *tried) {
  const size_t n = of->record->n;
  size_t best = n, b = 0;
  double max = level;
  for (size_t i = 0; i < n; i++) {
    if (!(score[i] > max) || tried[i]) continue;
    int free_of =
        i >= inside && i + inside < n && segment_of(of, i - inside) == segment_of(of, i + inside);
    for (b = 0; b < of->n_breaks && free_of; b++) {
      if (of->breaks[b].segment != segment_of(of, i)) continue;
      const size_t low = i >= spacing ? i - spacing : 0,
                   high = i + spacing < n ? i + spacing : n - 1;
      const double t = of->breaks[b].time_s;
      free_of = t < of->record->time_s[low] || t > of->record->time_s[high];
    }
    if (!free_of) continue;
    max = score[i];
    best = i;
  }
  return best;
}

/* Inserts a break into the ordered list; *at: its index. */
static void insert(finding *of, double time_s, int segment, int first, size_t *at) {
  size_t i = of->n_breaks;
  while (i > 0 && (of->breaks[i - 1].segment > segment ||
                   (of->breaks[i - 1].segment == segment && of->breaks[i - 1].time_s > time_s))) {
    of->breaks[i] = of->breaks[i - 1];
    i--;
  }
  of->breaks[i].time_s = time_s;
  of->breaks[i].segment = segment;
  of->breaks[i].first = first;
  of->n_breaks++;
  *at = i;
}

/* *is: 1 if excluding one sample next to a break lowers -2 log L with its penalty by at least
 * `gain`, the decrease due to the break; then the sample is excluded. */
static rot_status rather_sample(finding *of, size_t k, size_t at, double gain, int *is) {
  const size_t n = of->record->n, low = k > FROM_END ? k - FROM_END : 0;
  size_t worst = n;
  *is = 0;
  for (size_t i = low; i < n && i <= k + FROM_END; i++)
    if (segment_of(of, i) == segment_of(of, k) && of->worst[i] > outlier &&
        (worst == n || of->worst[i] > of->worst[worst]))
      worst = i;
  if (worst == n) return ROT_OK;
  window w;
  const rot_status status =
      window_open(&w, of->record, of->grid.unit_s, &of->fit, of->n_breaks, of->breaks, at);
  if (status == ROT_OK) {
    double kept[CHANNELS] = {1.0, 1.0};
    const double with = window_try(&w, NAN, 0);
    for (int c = 0; c < CHANNELS; c++)
      if (of->record->y[c]) {
        kept[c] = of->record->w[c][worst];
        of->record->w[c][worst] = HUGE_VAL;
      }
    *is = with - window_try(&w, NAN, 0) - log((double)n) >= gain;
    for (int c = 0; c < CHANNELS && !*is; c++)
      if (of->record->y[c]) of->record->w[c][worst] = kept[c];
  }
  window_close(&w);
  return status;
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

/* => squared jump at a kink over its variance */
static double kink_score(finding *of, size_t at) {
  rot_smooth_sums sums;
  rot_smooth_jump jump;
  memset(&jump, 0, sizeof jump);
  rot_smooth_grid_fill(&of->grid, of->record, of->fit.ratio, of->n_breaks, of->breaks, NULL);
  rot_smooth_filter(&of->grid.nodes, &of->fit.model, 0, of->grid.nodes.n, &of->store, 1, &sums);
  jump.node = of->grid.at_break[at];
  rot_smooth_jumps(&of->grid.nodes, &of->fit.model, &of->store, 1, &jump);
  return jump.mean[KINK] * jump.mean[KINK] / (jump.variance_3 * of->fit.sigma * of->fit.sigma);
}

/* Inserts a kink at sample k and fits its time and the smoothness in turn: without the kink the
 * process was fitted too rough. */
static rot_status put_kink(finding *of, size_t k, size_t *at, double *score) {
  const int reach = 2 + (int)fmin(memory_of(&of->fit), (double)of->record->n);
  rot_status status = ROT_OK;
  double gain;
  insert(of, of->record->time_s[k], segment_of(of, k), KINK, at);
  for (int turn = 0; turn < 2 && status == ROT_OK; turn++) {
    status = place(of->record, of->grid.unit_s, &of->fit, of->n_breaks, of->breaks, *at, reach,
                   reach, &gain);
    if (status == ROT_OK) status = refit(of, 0);
    *score = status == ROT_OK ? kink_score(of, *at) : 0.0;
    if (!(*score > 0.5 * kink_shows)) break;
  }
  return status;
}

static size_t next_kink(const finding *of) {
  const size_t spacing = SPACING + 2 * (size_t)fmin(memory_of(&of->fit), (double)of->record->n);
  return highest(of, of->kink, kink_level, spacing, spacing, of->no_kink);
}

/* Adds kinks of the acceleration, where the torque's slope jumps: one significant alone, or two
 * significant jointly. `spare`: number of breaks that may be added. */
static rot_status add_kink(finding *of, size_t spare, size_t *changes, int *more) {
  const size_t n = of->record->n, k = next_kink(of);
  const size_t memory = (size_t)fmin(memory_of(&of->fit), (double)n);
  const rot_smooth_fit kept = of->fit;
  size_t at, next = n;
  double score;
  *more = k < n;
  if (k == n) return ROT_OK;
  rot_status status = put_kink(of, k, &at, &score);
  if (status == ROT_OK && score <= kink_shows && score > 0.5 * kink_shows && spare > 1) {
    status = look(of);
    next = next_kink(of);
    if (status == ROT_OK && next < n) {
      size_t second;
      double other;
      status = put_kink(of, next, &second, &other);
      if (second <= at) at++;
      if (status == ROT_OK) score = fmin(kink_score(of, at), other);
      if (!(score > kink_shows)) {
        take_out(of, second);
        if (second < at) at--;
      }
    }
  }
  if (status == ROT_OK && score > kink_shows) {
    memset(of->no_kink, 0, n); /* others may be significant for the smoother motion */
    ++*changes;
    return status;
  }
  take_out(of, at);
  of->fit = kept;
  for (size_t i = k > memory ? k - memory : 0; i < n && i <= k + memory; i++) of->no_kink[i] = 1;
  return status;
}

/* Excludes samples, then adds breaks, at this order, until neither is found. */
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
    if (!of->how->breaks || of->n_breaks - given >= of->how->max_breaks) return ROT_OK;
    const size_t k = highest(of, of->shock, shock_level, SPACING, 0, of->tried);
    /* A shock that a kink explains nearly as well is first tried as a kink. */
    if (k == of->record->n || of->shock[k] - of->kink[k] < 0.5 * shock_level) {
      int more;
      status = add_kink(of, of->how->max_breaks - (of->n_breaks - given), changes, &more);
      if (more) continue;
      if (k == of->record->n) return status;
    }
    size_t at;
    double gain;
    const rot_smooth_fit kept = of->fit;
    insert(of, of->record->time_s[k], segment_of(of, k), IMPACT, &at);
    status =
        place(of->record, of->grid.unit_s, &of->fit, of->n_breaks, of->breaks, at, 3, 2, &gain);
    if (status == ROT_OK && of->how->outliers) {
      int sample;
      status = rather_sample(of, k, at, gain, &sample);
      if (sample) {
        take_out(of, at);
        ++*changes;
        if (status == ROT_OK) status = refit(of, 0);
        continue;
      }
    }
    if (status == ROT_OK && gain > 0.0) status = refit(of, 0);
    /* The smoothness changed with the break: optimize its time again. */
    if (status == ROT_OK && gain > 0.0)
      status =
          place(of->record, of->grid.unit_s, &of->fit, of->n_breaks, of->breaks, at, 3, 3, &gain);
    if (status == ROT_OK && gain > 0.0) {
      ++*changes;
      status = refit(of, 0);
    } else {
      take_out(of, at);
      of->fit = kept;
      /* The adjacent samples were tried with it. */
      of->tried[k] = of->tried[k + 1] = 1;
      if (k > 0) of->tried[k - 1] = 1;
    }
  }
  return status;
}

/* => -2 log L of the whole record at the fit's smoothness, plus log n for each diffuse state and
 * each of `left` excluded samples */
static double total(finding *of, const rot_smooth_break *breaks, size_t n_breaks, long left) {
  rot_smooth_sums sums;
  double sigma;
  rot_smooth_grid_fill(&of->grid, of->record, of->fit.ratio, n_breaks, breaks, NULL);
  const double value =
      rot_smooth_objective(&of->grid.nodes, &of->fit.model,
                           rot_smooth_floor(&of->grid, of->record, of->fit.ratio), &sigma, &sums);
  return value + log((double)of->record->n) * ((double)sums.fresh + (double)left);
}

/* Removes kinks below order 4, which has no such state. */
static void drop_kinks(finding *of) {
  if (of->fit.model.order > KINK) return;
  for (size_t b = of->n_breaks; b-- > 0;)
    if (of->breaks[b].first == KINK) take_out(of, b);
}

static rot_status place_in(finding *of, rot_smooth_break *breaks, size_t n, size_t which) {
  double gain;
  return place(of->record, of->grid.unit_s, &of->fit, n, breaks, which, 3, 3, &gain);
}

static double toggle(finding *of, size_t i, double w) {
  double kept = 1.0;
  for (int c = 0; c < CHANNELS; c++)
    if (of->record->y[c]) {
      kept = of->record->w[c][i];
      of->record->w[c][i] = w;
    }
  return kept;
}

/* Best alternative list of breaks. */
typedef struct better {
  rot_smooth_break *breaks;
  size_t n;      /* breaks */
  size_t sample; /* excluded or included again; the record's n: none */
  double value;  /* total() */
} better;

/* Excludes, or includes again, each sample next to break j of the list `from`, and optimizes the
 * break; updates `best`. */
static rot_status beside(finding *of, const rot_smooth_break *from, size_t m, size_t j,
                         rot_smooth_break *trial, better *best) {
  enum { BESIDE = 3 };
  const size_t n = of->record->n;
  rot_status status = ROT_OK;
  size_t k = 0;
  while (k < n && (segment_of(of, k) < from[j].segment || (segment_of(of, k) == from[j].segment &&
                                                           of->record->time_s[k] < from[j].time_s)))
    k++;
  for (size_t i = k > BESIDE ? k - BESIDE : 0; i < k + BESIDE && i < n && status == ROT_OK; i++) {
    if (segment_of(of, i) != from[j].segment) continue;
    const int is_left = !is_kept(of->record, i);
    const double w = toggle(of, i, is_left ? 1.0 : HUGE_VAL);
    memcpy(trial, from, m * sizeof *trial);
    status = place_in(of, trial, m, j);
    const double value = total(of, trial, m, is_left ? -1 : 1);
    if (value < best->value) {
      best->value = value;
      best->sample = i;
      best->n = m;
      memcpy(best->breaks, trial, m * sizeof *trial);
    }
    toggle(of, i, w);
  }
  return status;
}

/* An outlier next to a break attracts additional breaks. Tries to remove each break, and to exclude
 * or include again each sample next to it, with the breaks nearby optimized; keeps improvements.
 * `room`: work space of three lists of breaks. */
static rot_status polish(finding *of, rot_smooth_break *room, size_t max, size_t *changes) {
  const size_t n = of->record->n;
  const double near_s = 12.0 * of->grid.unit_s;
  rot_smooth_break *without = room, *trial = room + max;
  rot_status status = ROT_OK;
  for (size_t b = 0; b < of->n_breaks && status == ROT_OK; b++) {
    if (of->breaks[b].first == KINK) continue;
    better best = {room + 2 * max, 0, n, total(of, of->breaks, of->n_breaks, 0)};
    const double now = best.value;
    const size_t m = of->n_breaks - 1;
    memcpy(without, of->breaks, b * sizeof *without);
    memcpy(without + b, of->breaks + b + 1, (m - b) * sizeof *without);
    for (size_t j = 0; j < m && status == ROT_OK; j++)
      if (without[j].segment == of->breaks[b].segment &&
          fabs(without[j].time_s - of->breaks[b].time_s) < near_s) {
        status = place_in(of, without, m, j);
        if (status == ROT_OK && of->how->outliers) status = beside(of, without, m, j, trial, &best);
      }
    const double value = total(of, without, m, 0);
    if (value < best.value) {
      best.value = value;
      best.sample = n;
      best.n = m;
      memcpy(best.breaks, without, m * sizeof *without);
    }
    if (status == ROT_OK && of->how->outliers)
      status = beside(of, of->breaks, of->n_breaks, b, trial, &best);
    if (!(best.value < now) || status != ROT_OK) continue;
    const size_t fewer = of->n_breaks - best.n;
    memcpy(of->breaks, best.breaks, best.n * sizeof *best.breaks);
    of->n_breaks = best.n;
    if (best.sample < n) toggle(of, best.sample, is_kept(of->record, best.sample) ? HUGE_VAL : 1.0);
    ++*changes;
    if (fewer > 0) b = (size_t)-1;
  }
  return status;
}

rot_status rot_smooth_find(rot_smooth_record *record, const rot_smooth_finding *how,
                           rot_smooth_break *breaks, size_t *n_breaks, const rot_hooks *hooks,
                           rot_smooth_fit *fit) {
  const size_t room = *n_breaks + how->max_breaks, nodes = record->n + 2 * room;
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
    double *memory = calloc((3 + CHANNELS) * nodes, sizeof *memory);
    status = rot_smooth_store_new(&of.store, nodes, ROT_SMOOTH_MAX + (record->slow ? 1 : 0));
    rot_smooth_break *trial = calloc(3 * room + 1, sizeof *trial);
    of.tried = calloc(2 * record->n + 2, 1);
    if (of.tried) of.no_kink = of.tried + record->n + 1;
    const size_t size = record->n * sizeof(double);
    double *weights = malloc(CHANNELS * size + 1);
    rot_smooth_break *list = calloc(given + 1, sizeof *list);
    if (!memory || !of.tried || !trial || !weights || !list) status = ROT_ENOMEM;
    for (int c = 0; c < CHANNELS && status == ROT_OK; c++)
      if (record->y[c]) memcpy(weights + (size_t)c * record->n, record->w[c], size);
    if (status == ROT_OK) memcpy(list, of.breaks, given * sizeof *list);
    of.shock = memory;
    if (status == ROT_OK) {
      of.worst = memory + nodes;
      of.kink = memory + 2 * nodes;
      for (int c = 0; c < CHANNELS; c++) of.residual[c] = memory + (size_t)(3 + c) * nodes;
    }
    for (int pass = 0; pass < 4 && status == ROT_OK; pass++) {
      size_t changes = 0, polished = 0;
      const int order = of.fit.model.order;
      status = settle(&of, given, &changes);
      if (status != ROT_OK || changes == 0) break;
      status = refit(&of, 1);
      drop_kinks(&of);
      if (status == ROT_OK && how->breaks) status = polish(&of, trial, room, &polished);
      if (status == ROT_OK && polished > 0) status = refit(&of, 1);
      drop_kinks(&of);
      if (of.fit.model.order == order && polished == 0) break;
    }
    for (size_t i = 0; how->breaks && i < of.n_breaks && status == ROT_OK; i++)
      if (of.breaks[i].first != KINK) status = place_in(&of, of.breaks, of.n_breaks, i);
    if (status == ROT_OK && of.n_breaks > given) status = refit(&of, 0);
    /* Interpolated samples have no scatter, so none is an outlier. */
    if (status == ROT_OK && of.fit.end == ROT_SMOOTH_JOINS) {
      for (int c = 0; c < CHANNELS; c++)
        if (record->y[c]) memcpy(record->w[c], weights + (size_t)c * record->n, size);
      of.n_breaks = given;
      memcpy(of.breaks, list, given * sizeof *list);
      status = refit(&of, 1);
    }
    free(weights);
    free(list);
    free(memory);
    free(of.tried);
    free(trial);
    rot_smooth_store_free(&of.store);
  }
  rot_smooth_grid_free(&of.grid);
  *n_breaks = of.n_breaks;
  *fit = of.fit;
  return status;
}
