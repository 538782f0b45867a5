#include "maths/propagator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TERMS = 24 }; /* of the series: 1/4^24/24! is 6e-39 */

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

/* c = a b; blocks of zeros remain exactly zero */
static void multiply(size_t n, const rot_dd a[], const rot_dd b[], rot_dd c[]) {
  for (size_t i = 0; i < n * n; i++) c[i] = (rot_dd){0.0, 0.0};
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < n; k++) {
      const rot_dd x = a[i * n + k];
      if (x.hi == 0.0) continue;
      for (size_t j = 0; j < n; j++) {
        c[i * n + j] = rot_dd_add(c[i * n + j], rot_dd_mul(x, b[k * n + j]));
      }
    }
  }
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
  for (size_t i = 0; i < n * n; i++) x->a[i] = rot_dd_ldexp(a[i], x->exponent);
  return ROT_OK;
}

/* x => exp(A h fraction) x by the series, the fraction at most 1; y, work: n each */
static void move_little(const rot_propagator *p, rot_dd fraction, rot_dd x[], rot_dd term[],
                        rot_dd next[]) {
  const size_t n = p->n;
  memcpy(term, x, n * sizeof *x);
  for (int k = 1; k <= TERMS; k++) {
    const rot_dd factor = rot_dd_div(fraction, (rot_dd){(double)k, 0.0});
    apply(n, p->a, term, next);
    for (size_t i = 0; i < n; i++) {
      term[i] = rot_dd_mul(next[i], factor);
      x[i] = rot_dd_add(x[i], term[i]);
    }
  }
}

/* One more power: that of h by its columns, the others by squaring. */
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
  if (p->levels == 0) {
    rot_dd *column = malloc(n * sizeof *column);
    if (!column) return ROT_ENOMEM;
    for (size_t j = 0; j < n; j++) {
      for (size_t i = 0; i < n; i++) column[i] = (rot_dd){i == j ? 1.0 : 0.0, 0.0};
      move_little(p, (rot_dd){1.0, 0.0}, column, p->work, p->work + n);
      for (size_t i = 0; i < n; i++) to[i * n + j] = column[i];
    }
    free(column);
  } else {
    multiply(n, to - square, to - square, to);
  }
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
  free(x->power);
  x->memory = x->power = NULL;
}
