#include "engine/loads.h"

#include <math.h>
#include <string.h>

#include "ground/sort.h"
#include "ground/real.h"
#include "ground/search.h"

rot_torque rot_loads_constant(double torque_n_m) {
  return (rot_torque){.before_n_m = torque_n_m, .after_n_m = torque_n_m};
}

/* ---- sums of knots --------------------------------------------------------------------------- */

/* A sum that carries what rounding takes (Neumaier): 1e16 + 1 - 1e16 is 1. */
typedef struct total {
  double sum, rest;
} total;

static void add(total *to, double x) {
  double lost;
  to->sum = rot_two_sum(to->sum, x, &lost);
  to->rest += lost;
}

static size_t times_of(size_t n, const rot_torque law[], double time_s[]) {
  size_t all = 0;
  for (size_t i = 0; i < n; i++) {
    if (law[i].n) memcpy(time_s + all, law[i].time_s, law[i].n * sizeof *time_s);
    all += law[i].n;
  }
  return rot_sort_once(all, time_s);
}

/* Between knots i and i + 1. The two shares are 1 within rounding: a level would become a slope of
 * one unit of it. */
static double line(const rot_torque *law, size_t i, double t) {
  const double *at = law->time_s, *tau = law->torque_n_m, width = at[i + 1] - at[i];
  if (tau[i] == tau[i + 1]) return tau[i];
  return tau[i] * ((at[i + 1] - t) / width) + tau[i + 1] * ((t - at[i]) / width);
}

/* Just before and just after a time. */
static void sides(const rot_torque *law, double t, double *before, double *after) {
  const size_t n = law->n;
  const size_t first = rot_lower_bound(n, law->time_s, t); /* the first knot at or after */
  const size_t past = rot_upper_bound(n, law->time_s, t);  /* the first knot after */
  if (first < n && law->time_s[first] == t) {
    *before = first == 0 ? law->before_n_m : law->torque_n_m[first];
    *after = past == n ? law->after_n_m : law->torque_n_m[past - 1];
  } else {
    *before = *after = past == 0   ? law->before_n_m
                       : past >= n ? law->after_n_m
                                   : line(law, past - 1, t);
  }
}

/* To the sums of each side of each time. A law that is zero outside its knots adds to no other. */
static void add_law(const rot_torque *law, size_t n, const double time_s[], total sum[]) {
  size_t from = 0, to = n;
  if (law->n && law->before_n_m == 0.0 && law->after_n_m == 0.0) {
    from = rot_lower_bound(n, time_s, law->time_s[0]);
    to = rot_upper_bound(n, time_s, law->time_s[law->n - 1]);
  }
  for (size_t i = from; i < to; i++) {
    double before, after;
    sides(law, time_s[i], &before, &after);
    add(&sum[2 * i], before);
    add(&sum[2 * i + 1], after);
  }
}

/* The sums with their rests, unless one of these is not finite. */
static void close_sums(size_t n, total sum[]) {
  int finite = 1;
  for (size_t i = 0; i < n; i++) finite &= isfinite(sum[i].rest) != 0;
  for (size_t i = 0; i < n && finite; i++) sum[i].sum += sum[i].rest;
}

rot_status rot_loads_add_knots(size_t n, const rot_torque law[], rot_store *store,
                               rot_torque *sum) {
  size_t room = 0, kept = 0;
  if (n == 0) return (*sum = rot_loads_constant(0.0), ROT_OK);
  if (n == 1) return (*sum = law[0], ROT_OK);
  total outside[2] = {{law[0].before_n_m, 0.0}, {law[0].after_n_m, 0.0}};
  for (size_t i = 0; i < n; i++) {
    room += law[i].n;
    if (i == 0) continue;
    add(&outside[0], law[i].before_n_m);
    add(&outside[1], law[i].after_n_m);
  }
  close_sums(2, outside);
  *sum = (rot_torque){.before_n_m = outside[0].sum, .after_n_m = outside[1].sum};
  if (room == 0) return ROT_OK;
  double *time_s = rot_store_get(store, room, sizeof *time_s);
  total *side = rot_store_get(store, room, 2 * sizeof *side);
  double *knot_s = rot_store_get(store, room, 2 * sizeof *knot_s);
  double *knot_n_m = rot_store_get(store, room, 2 * sizeof *knot_n_m);
  if (!time_s || !side || !knot_s || !knot_n_m) return ROT_ENOMEM;
  const size_t times = times_of(n, law, time_s);
  for (size_t i = 0; i < n; i++) add_law(&law[i], times, time_s, side);
  close_sums(2 * times, side);
  /* A value held outside needs no knot; where the torque ends, its last value is kept. */
  for (size_t i = 0; i < times; i++) {
    const double before = side[2 * i].sum, after = side[2 * i + 1].sum;
    const int ends = i + 1 == times && times > 1 && sum->after_n_m == 0.0;
    if (i > 0) knot_s[kept] = time_s[i], knot_n_m[kept++] = before;
    if (!ends && (i == 0 || before != after)) knot_s[kept] = time_s[i], knot_n_m[kept++] = after;
  }
  sum->n = kept;
  sum->time_s = knot_s;
  sum->torque_n_m = knot_n_m;
  return ROT_OK;
}

/* ---- the laws given -------------------------------------------------------------------------- */

static size_t count_laws(const rot_given *given) {
  size_t n = 0;
  switch ((rot_input_kind)given->is) {
  case ROT_INPUT_TORQUE: return ((const rot_law_sum *)given->object)->n;
  case ROT_INPUT_LIST:
    for (size_t i = 0; i < given->n; i++) n += count_laws(&given->item[i]);
    return n;
  default: return given->is != 0;
  }
}

static rot_law_one *collect_laws(const rot_given *given, rot_law_one *to) {
  const rot_law_sum *sum = given->object;
  switch ((rot_input_kind)given->is) {
  case ROT_INPUT_NUMBER:
    *to = (rot_law_one){.kind = ROT_LAW_KNOTS, .knots = rot_loads_constant(given->x[0])};
    return to + 1;
  case ROT_INPUT_LAW: *to = (rot_law_one){.kind = ROT_LAW_CALL, .call = given->law}; return to + 1;
  case ROT_INPUT_TORQUE:
    if (sum->n) memcpy(to, sum->law, sum->n * sizeof *to);
    return to + sum->n;
  case ROT_INPUT_LIST:
    for (size_t i = 0; i < given->n; i++) to = collect_laws(&given->item[i], to);
    return to;
  default: return to;
  }
}

rot_status rot_law_sum_of(const rot_given *given, rot_store *store, rot_law_sum *sum) {
  const size_t n = count_laws(given);
  rot_law_one *law = rot_store_get(store, n, sizeof *law);
  if (!law) return ROT_ENOMEM;
  (void)collect_laws(given, law);
  *sum = (rot_law_sum){n, law};
  return ROT_OK;
}

/* ---- the laws that are called ---------------------------------------------------------------- */

typedef struct calls {
  size_t n;
  rot_law *law;
} calls;

static rot_status call_all(double t, double theta, double omega, double *torque, void *ctx) {
  const calls *c = ctx;
  const double argument[] = {t, theta, omega};
  double sum = 0.0;
  rot_status status = ROT_OK;
  for (size_t i = 0; i < c->n && status == ROT_OK; i++) {
    double one = 0.0;
    status = c->law[i].call(argument, &one, c->law[i].ctx);
    sum += one;
  }
  *torque = sum;
  return status;
}

static rot_status add_calls(size_t n, const rot_law_one law[], rot_store *store, rot_loads *loads) {
  size_t n_calls = 0, n_breaks = 0;
  for (size_t i = 0; i < n; i++) {
    n_calls += law[i].kind == ROT_LAW_CALL;
    n_breaks += law[i].n_breaks;
  }
  if (n_calls == 0 && n_breaks == 0) return ROT_OK;
  calls *all = rot_store_get(store, 1, sizeof *all);
  rot_law *each = rot_store_get(store, n_calls, sizeof *each);
  double *breaks_s = rot_store_get(store, n_breaks, sizeof *breaks_s);
  if (!all || !each || !breaks_s) return ROT_ENOMEM;
  *all = (calls){0, each};
  n_breaks = 0;
  for (size_t i = 0; i < n; i++) {
    if (law[i].kind == ROT_LAW_CALL) each[all->n++] = law[i].call;
    for (size_t k = 0; k < law[i].n_breaks; k++) breaks_s[n_breaks++] = law[i].breaks_s[k];
  }
  if (all->n) loads->knots.call = call_all;
  if (all->n) loads->knots.ctx = all;
  loads->n_breaks = rot_sort_once(n_breaks, breaks_s);
  loads->breaks_s = breaks_s;
  return ROT_OK;
}

/* ---- the normal form ------------------------------------------------------------------------- */

static int finite_knots(const rot_torque *knots) {
  int finite = isfinite(knots->before_n_m) && isfinite(knots->after_n_m);
  for (size_t i = 0; i < knots->n; i++) finite &= isfinite(knots->torque_n_m[i]) != 0;
  return finite;
}

rot_status rot_loads_of(const rot_given *given, rot_store *store, rot_loads *loads) {
  rot_law_sum sum;
  size_t n_knots = 0, n_terms = 0;
  long double slope = 0.0L; /* as R adds numbers */
  memset(loads, 0, sizeof *loads);
  if (rot_law_sum_of(given, store, &sum) != ROT_OK) return ROT_ENOMEM;
  const size_t n = sum.n;
  const rot_law_one *law = sum.law;
  rot_torque *knots = rot_store_get(store, n, sizeof *knots);
  rot_term *terms = rot_store_get(store, n, sizeof *terms);
  if (!knots || !terms) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) {
    if (law[i].kind == ROT_LAW_KNOTS) knots[n_knots++] = law[i].knots;
    if (law[i].kind == ROT_LAW_TERM) terms[n_terms++] = law[i].term;
    loads->noise_n_m += law[i].noise_n_m;
  }
  for (size_t i = 0; i < n; i++) {
    if (law[i].kind != ROT_LAW_MOTOR) continue;
    knots[n_knots++] = rot_loads_constant(law[i].stall_n_m);
    slope += law[i].stall_n_m / law[i].no_load_rad_per_s;
  }
  loads->motor_n_m_s = (double)slope;
  loads->n_terms = n_terms;
  loads->terms = terms;
  rot_status status = rot_loads_add_knots(n_knots, knots, store, &loads->knots);
  if (status == ROT_OK && !(finite_knots(&loads->knots) && isfinite(loads->motor_n_m_s))) {
    return ROT_EVALUE;
  }
  if (status == ROT_OK) status = add_calls(n, law, store, loads);
  return status;
}
