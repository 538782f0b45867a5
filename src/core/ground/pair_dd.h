/* Double-double numbers (ground/dd.h) in each lane of a register (ground/pair.h), with the same
 * relative error of 2^-102 per operation. Products below 1e-290 lose their second part.
 *
 * Reference: Joldes, Muller & Popescu, ACM TOMS 44 (2017); Lefevre, Louvet, Muller, Picot &
 * Rideau, ACM TOMS 49 (2023) (the root). */
#ifndef ROT_PAIR_DD_H
#define ROT_PAIR_DD_H

#include "ground/pair.h"
#include "ground/real.h"

typedef struct rot_pair_dd {
  rot_pair hi, lo;
} rot_pair_dd;

/* x => x + 0 */
ROT_INLINE rot_pair_dd rot_pair_dd_of(rot_pair x) { return (rot_pair_dd){x, ROT_BOTH(0.0)}; }

/* (a, b) => a + b, for |a| >= |b| or a = 0 */
ROT_INLINE rot_pair_dd rot_pair_dd_quick(rot_pair a, rot_pair b) {
  const rot_pair s = a + b;
  return (rot_pair_dd){s, b - (s - a)};
}

/* (a, b) => a + b, exact */
ROT_INLINE rot_pair_dd rot_pair_dd_sum2(rot_pair a, rot_pair b) {
  const rot_pair s = a + b, bb = s - a;
  return (rot_pair_dd){s, (a - (s - bb)) + (b - bb)};
}

/* (a, b) => a b, exact. Without a fast fma(): Dekker's product of halves, also exact, so the bits
 * are the same. */
ROT_INLINE rot_pair_dd rot_pair_dd_mul2(rot_pair a, rot_pair b) {
  const rot_pair p = a * b;
#ifdef ROT_SIMD_FMA
  return (rot_pair_dd){p, _mm256_fmsub_pd(a, b, p)};
#elif defined(__FP_FAST_FMA) || defined(FP_FAST_FMA)
  double x[ROT_PAIR], y[ROT_PAIR], lo[ROT_PAIR];
  rot_store(x, a);
  rot_store(y, b);
  rot_store(lo, p);
  for (int i = 0; i < ROT_PAIR; i++) lo[i] = fma(x[i], y[i], -lo[i]);
  return (rot_pair_dd){p, rot_load(lo)};
#else
  const rot_pair split = ROT_BOTH(0x1p27 + 1.0), ta = split * a, tb = split * b;
  const rot_pair ah = ta - (ta - a), bh = tb - (tb - b), al = a - ah, bl = b - bh;
  return (rot_pair_dd){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
#endif
}

ROT_INLINE rot_pair_dd rot_pair_dd_add(rot_pair_dd a, rot_pair_dd b) {
  rot_pair_dd s = rot_pair_dd_sum2(a.hi, b.hi), t = rot_pair_dd_sum2(a.lo, b.lo);
  s = rot_pair_dd_quick(s.hi, s.lo + t.hi);
  return rot_pair_dd_quick(s.hi, s.lo + t.lo);
}

/* (a, b) => a + b, where |a + b| is not much smaller than |a| + |b| */
ROT_INLINE rot_pair_dd rot_pair_dd_plus(rot_pair_dd a, rot_pair_dd b) {
  const rot_pair_dd s = rot_pair_dd_sum2(a.hi, b.hi);
  return rot_pair_dd_quick(s.hi, s.lo + (a.lo + b.lo));
}

ROT_INLINE rot_pair_dd rot_pair_dd_neg(rot_pair_dd a) {
  return (rot_pair_dd){0.0 - a.hi, 0.0 - a.lo};
}

ROT_INLINE rot_pair_dd rot_pair_dd_sub(rot_pair_dd a, rot_pair_dd b) {
  return rot_pair_dd_add(a, rot_pair_dd_neg(b));
}

ROT_INLINE rot_pair_dd rot_pair_dd_mul(rot_pair_dd a, rot_pair_dd b) {
  const rot_pair_dd p = rot_pair_dd_mul2(a.hi, b.hi);
  return rot_pair_dd_quick(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

ROT_INLINE rot_pair_dd rot_pair_dd_mul1(rot_pair_dd a, rot_pair b) {
  const rot_pair_dd p = rot_pair_dd_mul2(a.hi, b);
  return rot_pair_dd_quick(p.hi, p.lo + a.lo * b);
}

/* (a, by) => a times a power of two */
ROT_INLINE rot_pair_dd rot_pair_dd_scale(rot_pair_dd a, double by) {
  return (rot_pair_dd){a.hi * by, a.lo * by};
}

ROT_INLINE rot_pair_dd rot_pair_dd_div(rot_pair_dd a, rot_pair_dd b) {
  const rot_pair q = a.hi / b.hi;
  const rot_pair_dd p = rot_pair_dd_mul1(b, q);
  return rot_pair_dd_quick(q, ((a.hi - p.hi) + (a.lo - p.lo)) / b.hi);
}

/* a => sqrt(a), a > 0 */
ROT_INLINE rot_pair_dd rot_pair_dd_sqrt(rot_pair_dd a) {
  const rot_pair x = rot_pair_sqrt(a.hi);
  const rot_pair_dd p = rot_pair_dd_mul2(x, x);
  return rot_pair_dd_quick(x, ((a.hi - p.hi) + (a.lo - p.lo)) / (x + x));
}

ROT_INLINE rot_pair_dd rot_pair_dd_abs(rot_pair_dd a) {
  const rot_pair none = ROT_BOTH(0.0);
  return (rot_pair_dd){rot_pair_abs(a.hi), rot_pair_if_more(none, a.hi, none - a.lo, a.lo)};
}

/* x where `is` > 0, y elsewhere. */
ROT_INLINE rot_pair_dd rot_pair_dd_if(rot_pair is, rot_pair_dd x, rot_pair_dd y) {
  return (rot_pair_dd){rot_pair_if(is, x.hi, y.hi), rot_pair_if(is, x.lo, y.lo)};
}

#endif
