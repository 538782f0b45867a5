#include "measure/smooth_fit.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = ROT_SMOOTH_CHANNELS, ANGLE = ROT_SMOOTH_ANGLE, RATE = ROT_SMOOTH_RATE };

/* Advantage in -2 log L that order 3 needs over order 4. On 60 random spin-ups it reduces the error
 * of alpha by 6 %, on pendulums by 3 %; on stops it increases it by 0.4 %. */
static const double reluctance = 8.0;

/* Upper end of log10 lambda, width at which the search ends, points of its grid. */
static const double highest = 6.0, width = 0.02;
enum { GRID = 13 };
static const double golden = 0.6180339887498949;

/* ---- records as nodes ------------------------------------------------------------------------ */

rot_status rot_smooth_grid_new(rot_smooth_grid *grid, const rot_smooth_record *record,
                               size_t max_breaks, size_t others) {
  const size_t n = record->n + 2 * max_breaks + others;
  memset(grid, 0, sizeof *grid);
  if (n > ((size_t)-1) / 256) return ROT_ENOMEM;
  char *memory = malloc((n + 1) * ((3 + 2 * CHANNELS) * sizeof(double) + 2 * sizeof(size_t)));
  grid->memory = memory;
  if (!memory) return ROT_ENOMEM;
  grid->gap = (double *)(void *)memory;
  for (int c = 0; c < CHANNELS; c++) {
    grid->y[c] = grid->gap + (size_t)(1 + c) * n;
    grid->w[c] = grid->gap + (size_t)(1 + CHANNELS + c) * n;
  }
  grid->slow = grid->gap + (1 + 2 * CHANNELS) * n;
  grid->keep = grid->slow + n;
  grid->sample = (size_t *)(void *)(grid->keep + n);
  grid->other = grid->sample + record->n;
  grid->at_break = grid->other + others;
  grid->first = (signed char *)(grid->sample + n);
  double total = 0.0;
  size_t gaps = 0;
  for (size_t i = 1; i < record->n; i++)
    if (!record->segment || record->segment[i] == record->segment[i - 1]) {
      total += record->time_s[i] - record->time_s[i - 1];
      gaps++;
    }
  grid->unit_s = total > 0.0 ? total / (double)gaps : 1.0;
  return ROT_OK;
}

void rot_smooth_grid_free(rot_smooth_grid *grid) {
  free(grid->memory);
  grid->memory = NULL;
}

static int is_before(int segment, double time_s, int other_segment, double other_s) {
  return segment < other_segment || (segment == other_segment && time_s < other_s);
}

/* => time in correlation times at time_s, between the samples i - 1 and i of a segment */
static double clock_at(const rot_smooth_record *record, size_t i, int segment, double time_s) {
  const int here = i < record->n && (!record->segment || record->segment[i] == segment);
  const int before = i > 0 && (!record->segment || record->segment[i - 1] == segment);
  if (here && before) {
    const double t0 = record->time_s[i - 1], t1 = record->time_s[i];
    const double fraction = t1 > t0 ? fmin(fmax((time_s - t0) / (t1 - t0), 0.0), 1.0) : 1.0;
    return record->clock[i - 1] + fraction * (record->clock[i] - record->clock[i - 1]);
  }
  return here ? record->clock[i] : before ? record->clock[i - 1] : 0.0;
}

void rot_smooth_grid_fill(rot_smooth_grid *grid, const rot_smooth_record *record, double ratio,
                          size_t n_breaks, const rot_smooth_break *breaks,
                          const rot_smooth_times *others) {
  const size_t n_others = others ? others->n : 0;
  const int both = record->y[ANGLE] && record->y[RATE];
  size_t n = 0, i = 0, b = 0, o = 0;
  int segment = 0;
  double time_s = 0.0, clock = 0.0;
  while (i < record->n || b < n_breaks || o < n_others) {
    const int si = i < record->n && record->segment ? record->segment[i] : 0;
    const int so = o < n_others && others->segment ? others->segment[o] : 0;
    /* Order at equal times: break, sample, other time. */
    const int break_next =
        b < n_breaks &&
        (i == record->n ||
         !is_before(si, record->time_s[i], breaks[b].segment, breaks[b].time_s)) &&
        (o == n_others || !is_before(so, others->time_s[o], breaks[b].segment, breaks[b].time_s));
    const int sample_next =
        !break_next && i < record->n &&
        (o == n_others || !is_before(so, others->time_s[o], si, record->time_s[i]));
    const double t = break_next    ? breaks[b].time_s
                     : sample_next ? record->time_s[i]
                                   : others->time_s[o];
    const int s = break_next ? breaks[b].segment : sample_next ? si : so;
    const int starts = n == 0 || s != segment;
    grid->gap[n] = starts ? 0.0 : (t - time_s) / grid->unit_s;
    grid->first[n] = starts ? ROT_SMOOTH_STARTS : ROT_SMOOTH_FLOWS;
    grid->slow[n] = 0.0;
    grid->keep[n] = 1.0;
    if (record->slow) {
      const double now = clock_at(record, i, s, t);
      if (!starts && grid->gap[n] > 0.0) grid->keep[n] = exp(fmin(clock - now, 0.0));
      clock = now;
    }
    for (int c = 0; c < CHANNELS; c++) {
      grid->y[c][n] = NAN;
      grid->w[c][n] = 1.0;
    }
    if (break_next) {
      n++;
      grid->gap[n] = 0.0;
      grid->slow[n] = 0.0;
      grid->keep[n] = 1.0;
      grid->first[n] = (signed char)breaks[b].first;
      for (int c = 0; c < CHANNELS; c++) {
        grid->y[c][n] = NAN;
        grid->w[c][n] = 1.0;
      }
      grid->at_break[b++] = n;
    } else if (sample_next) {
      for (int c = 0; c < CHANNELS; c++)
        if (record->y[c]) {
          const double w = record->w[c] ? record->w[c][i] : 1.0;
          if (!(w < HUGE_VAL)) continue;
          grid->y[c][n] = c == RATE ? record->y[c][i] * grid->unit_s : record->y[c][i];
          grid->w[c][n] = c == RATE && both ? w * ratio : w;
          if (record->slow && c == record->slow_channel)
            grid->slow[n] = record->slow[i] * (c == RATE && both ? ratio : 1.0);
        }
      grid->sample[i++] = n;
    } else
      grid->other[o++] = n;
    segment = s;
    time_s = t;
    n++;
  }
  grid->nodes.n = n;
  grid->nodes.gap = grid->gap;
  grid->nodes.first = grid->first;
  grid->nodes.settles = 0;
  grid->nodes.slow = record->slow ? grid->slow : NULL;
  grid->nodes.keep = record->slow ? grid->keep : NULL;
  grid->nodes.slow_channel = record->slow_channel;
  for (int c = 0; c < CHANNELS; c++) {
    grid->nodes.y[c] = record->y[c] ? grid->y[c] : NULL;
    grid->nodes.w[c] = record->y[c] ? grid->w[c] : NULL;
  }
}

/* ---- likelihood ------------------------------------------------------------------------------ */

double rot_smooth_floor(const rot_smooth_grid *grid, const rot_smooth_record *record,
                        double ratio) {
  const int both = record->y[ANGLE] && record->y[RATE];
  double floor = 0.0;
  for (int c = 0; c < CHANNELS; c++) {
    double largest = 0.0;
    if (!record->y[c]) continue;
    for (size_t i = 0; i < record->n; i++)
      if (fabs(record->y[c][i]) > largest) largest = fabs(record->y[c][i]);
    double min = fmax(record->floor[c], 4.0 * DBL_EPSILON * largest);
    if (c == RATE) min *= grid->unit_s / (both ? ratio : 1.0);
    floor = fmax(floor, min);
  }
  return fmax(floor, 1e-150);
}

double rot_smooth_objective(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                            double floor, double *sigma, rot_smooth_sums *sums) {
  rot_smooth_filter(nodes, model, 0, nodes->n, NULL, 0, sums);
  const double left = sums->counted > sums->fresh ? (double)(sums->counted - sums->fresh) : 0.0;
  const double variance = left > 0.0 ? sums->square / left : 0.0;
  *sigma = fmax(sqrt(variance), floor);
  return left * 2.0 * log(*sigma) + sums->log_f + sums->square / (*sigma * *sigma);
}

/* => the same for the samples with which orders are compared */
static double order_objective(const rot_smooth_sums *sums, double floor) {
  const double n = (double)sums->order_counted;
  const double variance = fmax(n > 0.0 ? sums->order_square / n : 0.0, floor * floor);
  return n * log(variance) + sums->order_log_f + sums->order_square / variance;
}

typedef struct search {
  const rot_smooth_grid *grid;
  double floor; /* lower limit of sigma */
  const rot_hooks *hooks;
  rot_status status;
  rot_smooth_fit best; /* so far */
} search;

/* => objective at a model; updates the best fit */
static double try_at(search *of, int order, double log_lambda) {
  const rot_smooth_model model = {order, pow(10.0, log_lambda)};
  rot_smooth_sums sums;
  double sigma;
  if (of->status == ROT_OK) of->status = rot_poll(of->hooks, 0.0);
  if (of->status != ROT_OK) return HUGE_VAL;
  const double value = rot_smooth_objective(&of->grid->nodes, &model, of->floor, &sigma, &sums);
  if (value < of->best.objective) {
    of->best.model = model;
    of->best.sigma = sigma;
    of->best.objective = value;
    of->best.samples = sums.samples;
    of->best.fresh = sums.fresh;
  }
  return value;
}

/* Golden section between a and d, between which a value is below both. */
static void section(search *of, int order, double a, double d) {
  double b = d - golden * (d - a), c = a + golden * (d - a);
  double at_b = try_at(of, order, b), at_c = try_at(of, order, c);
  while (d - a > width && of->status == ROT_OK) {
    if (at_b < at_c) {
      d = c, c = b, at_c = at_b;
      b = d - golden * (d - a);
      at_b = try_at(of, order, b);
    } else {
      a = b, b = c, at_b = at_c;
      c = a + golden * (d - a);
      at_c = try_at(of, order, c);
    }
  }
}

static double lowest(const rot_smooth_grid *grid, int order) {
  return -(2 * order - 1) * log10((double)grid->nodes.n) - 2.0;
}

static int end_of(const rot_smooth_grid *grid, const rot_smooth_model *model) {
  const double at = log10(model->lambda);
  return at < lowest(grid, model->order) + 2.0 * width ? ROT_SMOOTH_POLYNOMIAL
         : at > highest - 2.0 * width                  ? ROT_SMOOTH_JOINS
                                                       : ROT_SMOOTH_WITHIN;
}

/* Best lambda of an order: near a given log10 lambda, or (NaN) by a grid. */
static void search_lambda(search *of, int order, double near) {
  const double low = lowest(of->grid, order), step = (highest - low) / (GRID - 1);
  double at[GRID];
  int best = 0;
  if (!isnan(near)) {
    const double a = fmax(near - 0.6, low), d = fmin(near + 0.6, highest);
    const double at_a = try_at(of, order, a), at_d = try_at(of, order, d);
    if (try_at(of, order, near) <= fmin(at_a, at_d)) {
      section(of, order, a, d);
      return;
    }
  }
  for (int i = 0; i < GRID; i++) {
    at[i] = try_at(of, order, low + i * step);
    if (at[i] < at[best]) best = i;
  }
  section(of, order, low + (best > 0 ? best - 1 : 0) * step,
          low + (best < GRID - 1 ? best + 1 : best) * step);
}

/* Best order and lambda, in of->best. */
static rot_status search_orders(search *of, int first_order, int last_order,
                                const rot_smooth_fit *near) {
  rot_smooth_fit best;
  double min = HUGE_VAL;
  of->best.objective = HUGE_VAL;
  of->status = ROT_OK;
  best = of->best;
  for (int order = first_order; order <= last_order; order++) {
    double value = 0.0;
    of->best.objective = HUGE_VAL;
    search_lambda(of, order, near && near->model.order == order ? log10(near->model.lambda) : NAN);
    if (of->status != ROT_OK || !(of->best.objective < HUGE_VAL)) continue;
    if (first_order < last_order) {
      rot_smooth_sums sums;
      double sigma;
      (void)rot_smooth_objective(&of->grid->nodes, &of->best.model, of->floor, &sigma, &sums);
      value = order_objective(&sums, of->floor) + (order < 4 ? reluctance : 0.0);
    }
    if (value < min) {
      min = value;
      best = of->best;
    }
  }
  of->best = best;
  if (of->status == ROT_OK && !(best.objective < HUGE_VAL)) return ROT_ERANGE;
  return of->status;
}

rot_status rot_smooth_search(rot_smooth_grid *grid, const rot_smooth_record *record,
                             size_t n_breaks, const rot_smooth_break *breaks, int first_order,
                             int last_order, const rot_smooth_fit *near, const rot_hooks *hooks,
                             rot_smooth_fit *fit) {
  const int both = record->y[ANGLE] && record->y[RATE];
  search of = {grid, 0.0, hooks, ROT_OK, {{0, 0.0}, 1.0, 0.0, HUGE_VAL, NAN, 0, 0, 0}};
  double ratio = near ? near->ratio : 1.0;
  rot_status status;
  if (both && !near) { /* initial ratio from separate fits of the channels */
    double sigma[CHANNELS];
    for (int c = 0; c < CHANNELS; c++) {
      rot_smooth_record alone = *record;
      alone.y[1 - c] = NULL;
      if (alone.slow_channel != c) alone.slow = NULL;
      rot_smooth_grid_fill(grid, &alone, 1.0, n_breaks, breaks, NULL);
      of.floor = rot_smooth_floor(grid, &alone, 1.0);
      status = search_orders(&of, first_order, first_order, NULL);
      if (status != ROT_OK) return status;
      sigma[c] = of.best.sigma;
    }
    ratio = sigma[RATE] / sigma[ANGLE];
  }
  if (both) { /* golden section for the ratio, with lambda searched near the last one */
    const double reach = near ? log(1.5) : log(4.0);
    double a = log(ratio) - reach, d = log(ratio) + reach, value[2], u[2];
    rot_smooth_fit held = {{0, 0.0}, 1.0, 0.0, HUGE_VAL, NAN, 0, 0, 0};
    if (near) held = *near;
    for (int turn = 0, next = 2; turn < 14; turn++) {
      for (int i = 0; i < 2; i++) {
        if (next != 2 && next != i) continue;
        u[i] = i == 0 ? d - golden * (d - a) : a + golden * (d - a);
        rot_smooth_grid_fill(grid, record, exp(u[i]), n_breaks, breaks, NULL);
        of.floor = rot_smooth_floor(grid, record, exp(u[i]));
        status = search_orders(&of, first_order, first_order, held.model.order ? &held : NULL);
        if (status != ROT_OK) return status;
        held = of.best;
        value[i] = held.objective;
      }
      if (value[0] < value[1])
        d = u[1], u[1] = u[0], value[1] = value[0], next = 0;
      else
        a = u[0], u[0] = u[1], value[0] = value[1], next = 1;
    }
    ratio = exp((a + d) / 2.0);
  }
  rot_smooth_grid_fill(grid, record, ratio, n_breaks, breaks, NULL);
  of.floor = rot_smooth_floor(grid, record, ratio);
  status = search_orders(&of, first_order, last_order, near);
  if (status != ROT_OK) return status;
  *fit = of.best;
  fit->ratio = ratio;
  fit->degrees = NAN;
  fit->end = end_of(grid, &fit->model);
  return ROT_OK;
}

/* ---- order and smoothness with known breaks -------------------------------------------------- */

/* Memories after a start or break in which diffuse states affect the prediction. With only the
 * first six samples excluded, order 5 lost to 4 by 30 to 50 in -2 log L on all coast-downs on which
 * its alpha has half the error. */
static const double settling = 4.0;
/* For motions smoother than the process (oscillations) the likelihood gives too large a lambda:
 * Wahba, Ann. Statist. 13 (1985) 1378. Step in log10 lambda, decrease of n log GCV that each step
 * needs, max steps. Without the required decrease coast-downs lose 5 % of alpha by chance. */
static const double lower = 0.25, enough = 0.5;
enum { LOWER = 5 };

/* => n times the logarithm of the generalised cross-validation score RSS/(n - edf)^2. With S = sum
 * v^2/F and D = sum log F over all samples, RSS = S + dS/d log lambda and edf = dD/d log lambda + 1
 * for each diffuse state. Differences over .25 decades were wrong by 1. */
static double cross_validation(const rot_smooth_nodes *nodes, int order, double log_lambda) {
  const double half = 0.05;
  double square[2], log_f[2], n = 0.0, left = 0.0;
  for (int side = 0; side < 2; side++) {
    const rot_smooth_model model = {order, pow(10.0, log_lambda) * exp(side ? half : -half)};
    rot_smooth_sums sums;
    rot_smooth_filter(nodes, &model, 0, nodes->n, NULL, 0, &sums);
    square[side] = sums.square + sums.first_square;
    log_f[side] = sums.log_f + sums.first_log_f;
    n = (double)sums.samples;
    left = n - (double)sums.fresh;
  }
  for (size_t k = 0; k < nodes->n; k++)
    if (nodes->first[k] == ROT_SMOOTH_STARTS) left -= order;
  left -= (log_f[1] - log_f[0]) / (2.0 * half);
  const double rss = (square[0] + square[1]) / 2.0 + (square[1] - square[0]) / (2.0 * half);
  return left > 1.0 && rss > 0.0 ? n * (log(rss) - 2.0 * log(left)) : HUGE_VAL;
}

/* fit => best fit of the next higher order, by parabolic interpolation in lambda. Starts at the
 * same memory, slightly reduced (the solution is within .6 for spin-ups, stops, pendulums). */
static rot_status next_order(search *of, const rot_smooth_fit *fit, rot_smooth_fit *next) {
  const int order = fit->model.order + 1;
  const double low = lowest(of->grid, order);
  double at[3], value[3], step = 0.5;
  at[1] = log10(fit->model.lambda) * (2 * order) / (2 * order - 2) - 0.65;
  at[1] = fmin(fmax(at[1], low), highest);
  of->best.objective = HUGE_VAL;
  value[1] = try_at(of, order, at[1]);
  for (int side = 0; side < 3; side += 2) {
    at[side] = at[1] + (side - 1) * step;
    value[side] = try_at(of, order, at[side]);
  }
  while (of->status == ROT_OK && at[2] - at[0] > 3.0 * width) {
    const int min = value[0] < value[1] ? 0 : value[2] < value[1] ? 2 : 1;
    if (min != 1) { /* extend the bracket on this side */
      step *= 1.6;
      const double to = at[min] + (min - 1) * step;
      if (to < low || to > highest) break;
      at[2 - min] = at[1], value[2 - min] = value[1];
      at[1] = at[min], value[1] = value[min];
      at[min] = to, value[min] = try_at(of, order, to);
      continue;
    }
    const double a = at[0] - at[1], c = at[2] - at[1];
    const double fa = (value[0] - value[1]) / a, fc = (value[2] - value[1]) / c;
    double by = 0.5 * (a * fc - c * fa) / (fc - fa);
    /* At most 0.4 of the longer side, at least half of `width`. */
    if (!(by > 0.4 * a && by < 0.4 * c)) by = 0.4 * (by > 0.0 || !(by < 0.0) ? c : a);
    if (fabs(by) < width / 2.0) by = c > -a ? width / 2.0 : -width / 2.0;
    const double tried = try_at(of, order, at[1] + by);
    const int side = by > 0.0 ? 2 : 0;
    if (tried < value[1]) {
      at[2 - side] = at[1], value[2 - side] = value[1];
      at[1] += by, value[1] = tried;
    } else
      at[side] = at[1] + by, value[side] = tried;
  }
  *next = of->best;
  next->ratio = fit->ratio;
  next->degrees = NAN;
  next->end = end_of(of->grid, &next->model);
  return of->status;
}

rot_status rot_smooth_refine(const rot_smooth_record *record, size_t n_breaks,
                             const rot_smooth_break *breaks, int last_order, const rot_hooks *hooks,
                             rot_smooth_fit *fit) {
  rot_smooth_fit of[ROT_SMOOTH_MAX + 1];
  rot_smooth_grid grid;
  rot_smooth_sums sums;
  double sigma, memory = 0.0, min = HUGE_VAL;
  int best = fit->model.order;
  if (!record->y[ANGLE] || record->y[RATE] || fit->end == ROT_SMOOTH_JOINS) return ROT_OK;
  rot_status status = rot_smooth_grid_new(&grid, record, n_breaks, 0);
  if (status != ROT_OK) return status;
  rot_smooth_grid_fill(&grid, record, fit->ratio, n_breaks, breaks, NULL);
  const double floor = rot_smooth_floor(&grid, record, fit->ratio);
  search from = {&grid, floor, hooks, ROT_OK, *fit};
  of[best] = *fit;
  /* Order 3 means a rough motion (a stop that was not detected): no higher order. */
  const int last = best > 3 ? last_order : best;
  for (int order = best; order <= last && status == ROT_OK; order++) {
    if (order > best) status = next_order(&from, &of[order - 1], &of[order]);
    if (status == ROT_OK) memory = fmax(memory, pow(of[order].model.lambda, -0.5 / order));
  }
  grid.nodes.settles = (size_t)fmin(settling * (1.0 + memory), (double)record->n);
  for (int order = best; order <= last && status == ROT_OK; order++) {
    (void)rot_smooth_objective(&grid.nodes, &of[order].model, floor, &sigma, &sums);
    const double value = order_objective(&sums, floor);
    if (3 * sums.order_counted < sums.samples) break;
    if (value < min) min = value, best = order;
    status = rot_poll(hooks, 0.0);
  }
  grid.nodes.settles = 0;
  const double at = log10(of[best].model.lambda);
  double before = 0.0, lambda = of[best].model.lambda;
  /* The score is valid for white errors: at least half of the samples must have them. */
  size_t slow = 0;
  for (size_t i = 0; record->slow && i < record->n; i++) slow += record->slow[i] > 0.0;
  for (int step = 0; step <= LOWER && status == ROT_OK && 2 * slow <= record->n; step++) {
    const double value = cross_validation(&grid.nodes, best, at - step * lower);
    if (step > 0 && !(value < before - enough)) break;
    lambda = pow(10.0, at - step * lower);
    before = value;
    status = rot_poll(hooks, 0.0);
  }
  if (status == ROT_OK) *fit = of[best];
  if (status == ROT_OK && lambda < 0.9 * fit->model.lambda) {
    fit->model.lambda = lambda;
    fit->objective = rot_smooth_objective(&grid.nodes, &fit->model, floor, &fit->sigma, &sums);
  }
  rot_smooth_grid_free(&grid);
  return status;
}
