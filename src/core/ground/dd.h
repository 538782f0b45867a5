/* Double-double numbers: an unevaluated sum hi + lo, some 32 digits, for set-up calculations whose
 * errors would grow with time. Relative error 2^-102 for each operation, also for sums of exact
 * operands that cancel. Overflow and underflow are not checked: scale first.
 *
 * Reference: Dekker, Numer. Math. 18 (1971); Joldes, Muller & Popescu, ACM TOMS 44 (2017). */
#ifndef ROT_DD_H
#define ROT_DD_H

#include "ground/exact.h"

#define ROT_DD_EPS 0x1p-102

typedef struct rot_dd {
  double hi, lo;
} rot_dd;

/* (a, b) => a + b, for |a| >= |b| or a = 0 */
static inline rot_dd rot_dd_quick(double a, double b) {
  const double s = a + b;
  return (rot_dd){s, b - (s - a)};
}

/* (a, b) => a + b, exact */
static inline rot_dd rot_dd_sum2(double a, double b) {
  double lo, hi = rot_two_sum(a, b, &lo);
  return (rot_dd){hi, lo};
}

static inline rot_dd rot_dd_add(rot_dd a, rot_dd b) {
  rot_dd s = rot_dd_sum2(a.hi, b.hi), t = rot_dd_sum2(a.lo, b.lo);
  s = rot_dd_quick(s.hi, s.lo + t.hi);
  return rot_dd_quick(s.hi, s.lo + t.lo);
}

static inline rot_dd rot_dd_neg(rot_dd a) { return (rot_dd){-a.hi, -a.lo}; }

static inline rot_dd rot_dd_sub(rot_dd a, rot_dd b) { return rot_dd_add(a, rot_dd_neg(b)); }

static inline rot_dd rot_dd_add1(rot_dd a, double b) { return rot_dd_add(a, (rot_dd){b, 0.0}); }

/* (a, b) => a b, exact unless it underflows */
static inline rot_dd rot_dd_mul2(double a, double b) {
  double lo, hi = rot_two_prod(a, b, &lo);
  return (rot_dd){hi, lo};
}

static inline rot_dd rot_dd_mul(rot_dd a, rot_dd b) {
  const rot_dd p = rot_dd_mul2(a.hi, b.hi);
  return rot_dd_quick(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline rot_dd rot_dd_mul1(rot_dd a, double b) {
  const rot_dd p = rot_dd_mul2(a.hi, b);
  return rot_dd_quick(p.hi, p.lo + a.lo * b);
}

/* a/b by three quotients of doubles */
static inline rot_dd rot_dd_div(rot_dd a, rot_dd b) {
  const double q = a.hi / b.hi;
  const rot_dd r = rot_dd_sub(a, rot_dd_mul1(b, q));
  const double q1 = r.hi / b.hi;
  const rot_dd r1 = rot_dd_sub(r, rot_dd_mul1(b, q1));
  return rot_dd_add1(rot_dd_quick(q, q1), r1.hi / b.hi);
}

/* sqrt() and one Newton correction; NaN for a < 0 */
static inline rot_dd rot_dd_sqrt(rot_dd a) {
  if (!(a.hi > 0.0)) return (rot_dd){sqrt(a.hi), 0.0};
  const double x = sqrt(a.hi);
  const rot_dd r = rot_dd_sub(a, rot_dd_mul2(x, x));
  return rot_dd_quick(x, r.hi / (2.0 * x));
}

/* (a, e) => a 2^e */
static inline rot_dd rot_dd_ldexp(rot_dd a, int e) {
  return (rot_dd){rot_ldexp(a.hi, e), rot_ldexp(a.lo, e)};
}

static inline rot_dd rot_dd_half(rot_dd a) { return (rot_dd){0.5 * a.hi, 0.5 * a.lo}; }

static inline rot_dd rot_dd_abs(rot_dd a) { return a.hi < 0.0 ? rot_dd_neg(a) : a; }

#endif
