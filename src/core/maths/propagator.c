#include "maths/propagator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TERMS = 24 }; /* of the series: 1/4^24/24! is 6e-39 */

/* row of A => its entries that are not 0: where they stand, how many. */
static size_t entries(const rot_propagator *p, size_t row, const size_t **places) {
  *places = p->places + row * p->n;
  return p->entries[row];
}

/* y = A x */
static void apply_rate(const rot_propagator *p, const rot_dd x[], rot_dd y[]) {
  const size_t *places;
  for (size_t i = 0; i < p->n; i++) {
    const size_t count = entries(p, i, &places);
    rot_dd sum = {0.0, 0.0};
    for (size_t k = 0; k < count; k++) {
      sum = rot_dd_add(sum, rot_dd_mul(p->a[i * p->n + places[k]], x[places[k]]));
    }
    y[i] = sum;
  }
}

/* y = a x */
static void apply(size_t n, const rot_dd a[], const rot_dd x[], rot_dd y[]) {
  for (size_t i = 0; i < n; i++) {
    rot_dd sum = {0.0, 0.0};
    for (size_t j = 0; j < n; j++) {
      if (a[i * n + j].hi == 0.0) continue; /* of no weight, whatever x is */
      sum = rot_dd_add(sum, rot_dd_mul(a[i * n + j], x[j]));
    }
    y[i] = sum;
  }
}

/* row += x other */
static void add_row(size_t n, rot_dd row[], rot_dd x, const rot_dd other[]) {
  for (size_t j = 0; j < n; j++) row[j] = rot_dd_add(row[j], rot_dd_mul(x, other[j]));
}

/* A row of a product of this size takes 0.1 ms: worth a poll. */
enum { LARGE = 128 };

static rot_status poll_if_large(const rot_propagator *p) {
  return p->n < LARGE ? ROT_OK : rot_poll(p->hooks, 0.0);
}

/* c = a a; blocks of zeros remain exactly zero */
static rot_status square_of(const rot_propagator *p, const rot_dd a[], rot_dd c[]) {
  const size_t n = p->n;
  rot_status status = ROT_OK;
  for (size_t i = 0; i < n * n; i++) c[i] = (rot_dd){0.0, 0.0};
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    for (size_t k = 0; k < n; k++) {
      if (a[i * n + k].hi != 0.0) add_row(n, c + i * n, a[i * n + k], a + k * n);
    }
    status = poll_if_large(p);
  }
  return status;
}

rot_status rot_propagator_begin(rot_propagator *x, size_t n, const rot_dd a[],
                                const rot_hooks *hooks) {
  double norm = 0.0;
  memset(x, 0, sizeof *x);
  x->n = n;
  x->hooks = hooks;
  for (size_t i = 0; i < n; i++) {
    double sum = 0.0;
    for (size_t j = 0; j < n; j++) sum += fabs(a[i * n + j].hi);
    if (!(sum <= norm)) norm = sum;
  }
  if (!isfinite(norm)) return ROT_ERANGE;
  (void)frexp(norm, &x->exponent);
  x->exponent = -2 - x->exponent;
  x->memory = malloc((n * n + 2 * n) * sizeof *x->memory);
  if (!x->memory) return ROT_ENOMEM;
  x->a = x->memory;
  x->work = x->a + n * n;
  x->places = malloc((n * n + n) * sizeof *x->places);
  if (!x->places) return ROT_ENOMEM;
  x->entries = x->places + n * n;
  for (size_t i = 0; i < n; i++) {
    x->entries[i] = 0;
    for (size_t j = 0; j < n; j++) {
      x->a[i * n + j] = rot_dd_ldexp(a[i * n + j], x->exponent);
      if (x->a[i * n + j].hi != 0.0) x->places[i * n + x->entries[i]++] = j;
    }
  }
  return ROT_OK;
}

/* x => exp(A h fraction) x by the series, the fraction at most 1; y, work: n each */
static void move_little(const rot_propagator *p, rot_dd fraction, rot_dd x[], rot_dd term[],
                        rot_dd next[]) {
  const size_t n = p->n;
  memcpy(term, x, n * sizeof *x);
  for (int k = 1; k <= TERMS; k++) {
    const rot_dd factor = rot_dd_div(fraction, (rot_dd){(double)k, 0.0});
    apply_rate(p, term, next);
    for (size_t i = 0; i < n; i++) {
      term[i] = rot_dd_mul(next[i], factor);
      x[i] = rot_dd_add(x[i], term[i]);
    }
  }
}

/* e = exp(A h), by the series */
static rot_status first_power(const rot_propagator *p, rot_dd e[]) {
  const size_t n = p->n, square = n * n, *places;
  rot_dd *memory = malloc(2 * square * sizeof *memory), *term = memory, *next = memory + square;
  if (!memory) return ROT_ENOMEM;
  for (size_t i = 0; i < square; i++) {
    e[i] = term[i] = (rot_dd){i % (n + 1) == 0 ? 1.0 : 0.0, 0.0};
  }
  rot_status status = ROT_OK;
  for (int k = 1; k <= TERMS && status == ROT_OK; k++) {
    const rot_dd factor = rot_dd_div((rot_dd){1.0, 0.0}, (rot_dd){(double)k, 0.0});
    for (size_t i = 0; i < n && status == ROT_OK; i++) {
      const size_t count = entries(p, i, &places);
      rot_dd *row = next + i * n;
      for (size_t j = 0; j < n; j++) row[j] = (rot_dd){0.0, 0.0};
      for (size_t j = 0; j < count; j++) {
        add_row(n, row, rot_dd_mul(p->a[i * n + places[j]], factor), term + places[j] * n);
      }
      for (size_t j = 0; j < n; j++) e[i * n + j] = rot_dd_add(e[i * n + j], row[j]);
      status = poll_if_large(p);
    }
    rot_dd *keep = term;
    term = next;
    next = keep;
  }
  free(memory);
  return status;
}

/* One more power: the first, or the square of the last. */
static rot_status add_power(rot_propagator *p) {
  const size_t n = p->n, square = n * n;
  if (p->levels == p->room) {
    const size_t room = p->room ? 2 * p->room : 16;
    rot_dd *power = realloc(p->power, room * square * sizeof *power);
    if (!power) return ROT_ENOMEM;
    p->power = power;
    p->room = room;
  }
  rot_dd *to = p->power + p->levels * square;
  const rot_status status = p->levels == 0 ? first_power(p, to) : square_of(p, to - square, to);
  if (status != ROT_OK) return status;
  p->levels++;
  return rot_poll(p->hooks, 0.0);
}

rot_status rot_propagator_move(rot_propagator *p, rot_dd t, rot_dd x[]) {
  const size_t n = p->n;
  rot_dd left = rot_dd_ldexp(t, -p->exponent); /* in units of h */
  if (!isfinite(left.hi)) return ROT_ERANGE;
  while (left.hi >= ldexp(1.0, (int)p->levels)) {
    const rot_status status = add_power(p);
    if (status != ROT_OK) return status;
  }
  for (size_t level = p->levels; level-- > 0;) {
    const double step = ldexp(1.0, (int)level);
    if (!(left.hi > step || (left.hi == step && left.lo >= 0.0))) continue;
    left = rot_dd_add1(left, -step);
    apply(n, p->power + level * n * n, x, p->work);
    memcpy(x, p->work, n * sizeof *x);
  }
  move_little(p, left, x, p->work, p->work + n);
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(x[i].hi)) return ROT_ERANGE;
  }
  return ROT_OK;
}

void rot_propagator_end(rot_propagator *x) {
  free(x->memory);
  free(x->places);
  free(x->power);
  x->memory = x->power = NULL;
  x->places = NULL;
}
