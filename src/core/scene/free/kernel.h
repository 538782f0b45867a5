/* The batch kernel of scene/free/table.c: rot_free_begin() and rot_free_at() (scene/free/motion.c)
 * for tumbling bodies, one per lane. Lanes are independent: the result of a body does not depend on
 * the others. Compiled for registers of two lanes there, of four in scene/free/kernel.c.
 *
 * The motion of a single body handles numbers of any magnitude, calls the C library, branches, and
 * divides where the lanes multiply by an inverse: it takes 8 times as long (2260 and 270 ns); this
 * text compiled for doubles (ROT_ALONE) takes 4 times as long. */
#ifndef ROT_FREE_PASS_H
#define ROT_FREE_PASS_H

#include "ground/pair_dd.h"

enum { ROT_FREE_BLOCK = 64 };

typedef struct rot_free_block {
  double moment[3][ROT_FREE_BLOCK]; /* principal */
  double omega[3][ROT_FREE_BLOCK];  /* principal axes; in: at the start, out: at the time */
  double q[4][ROT_FREE_BLOCK];      /* attitude; in: at the start, any length, out: at the time */
  double time[ROT_FREE_BLOCK];
  double error[ROT_FREE_BLOCK];       /* out: bound on the angle of the error of the attitude */
  double omega_error[ROT_FREE_BLOCK]; /* out: bound on the length of the error of the rates */
  /* out: 0: the kernel does not apply (steady spin, m1 below 1e-30, more than 2^50 half periods,
   * numbers whose squares nearly under- or overflow, NaN). */
  double good[ROT_FREE_BLOCK];
} rot_free_block;

/* ---- functions ------------------------------------------------------------------------------- */

ROT_INLINE rot_pair rot_free_rounded(rot_pair x) { /* |x| < 2^51 */
  return (x + 0x1.8p52) - 0x1.8p52;
}

/* atan(x)/x for x^2 = z <= 0.19: fdlibm's polynomial. */
ROT_INLINE rot_pair rot_free_arc(rot_pair z) {
  const rot_pair w = z * z;
  const rot_pair even =
      3.33333333333329318027e-01 +
      w * (1.42857142725034663711e-01 +
           w * (9.09088713343650656196e-02 +
                w * (6.66107313738753120669e-02 +
                     w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02))));
  const rot_pair odd =
      -1.99999999998764832476e-01 +
      w * (-1.11111104054623557880e-01 +
           w * (-7.69187620504482999495e-02 +
                w * (-5.83357013379057348645e-02 + w * (-3.65315727442169155270e-02))));
  return 1.0 - z * (even + z * odd);
}

/* atan(x), 0 <= x <= 1. */
ROT_INLINE rot_pair rot_free_arctangent(rot_pair x) {
  const rot_pair one = ROT_BOTH(1.0), limit = ROT_BOTH(0.41421356237309503);
  const rot_pair folded = rot_pair_if_more(x, limit, (x - one) / (x + one), x);
  const rot_pair arc = folded * rot_free_arc(folded * folded);
  return rot_pair_if_more(x, limit, 0x1.921fb54442d18p-1 + arc, arc);
}

/* sin(x), cos(x) for |x| <= pi/4: fdlibm's polynomials. */
ROT_INLINE void rot_free_sine_cosine(rot_pair x, rot_pair *s, rot_pair *c) {
  const rot_pair z = x * x, half = 0.5 * z, one = ROT_BOTH(1.0), w = one - half;
  const rot_pair by_s =
      8.33333333332248946124e-03 +
      z * (-1.98412698298579493134e-04 +
           z * (2.75573137070700676789e-06 +
                z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  const rot_pair by_c =
      4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 +
           z * (2.48015872894767294178e-05 +
                z * (-2.75573143513906633035e-07 +
                     z * (2.08757232129817482790e-09 + z * (-1.13596475577881948265e-11)))));
  *s = x + z * x * (-1.66666666666666324348e-01 + z * by_s);
  *c = w + (((one - w) - half) + z * (z * by_c));
}

/* (cosine, sine) rotated by n quarter turns, -2 <= n <= 2. */
ROT_INLINE void rot_free_quarters(rot_pair n, rot_pair *c, rot_pair *s) {
  const rot_pair none = ROT_BOTH(0.0), half = ROT_BOTH(0.5), size = rot_pair_abs(n);
  const rot_pair over = rot_pair_if_more(size, ROT_BOTH(1.5), ROT_BOTH(-1.0), ROT_BOTH(1.0));
  const rot_pair direction = rot_pair_if_more(none, n, ROT_BOTH(-1.0), ROT_BOTH(1.0));
  const rot_pair odd =
      rot_pair_if_more(size, half, rot_pair_if_more(ROT_BOTH(1.5), size, half, none), none);
  const rot_pair c0 = *c, s0 = *s;
  *c = rot_pair_if(odd, none - direction * s0, over * c0);
  *s = rot_pair_if(odd, direction * c0, over * s0);
}

/* Remainder of n modulo 4, -2 to 2. */
ROT_INLINE rot_pair rot_free_fourth(rot_pair n) { return n - 4.0 * rot_free_rounded(n * 0.25); }

/* sin(x), cos(x) for |x| < 1e5. */
ROT_INLINE void rot_free_any_sine_cosine(rot_pair x, rot_pair *s, rot_pair *c) {
  const rot_pair n = rot_free_rounded(x * 0x1.45f306dc9c883p-1);
  const rot_pair r = ((x - n * 1.57079632673412561417e+00) - n * 6.07710050630396597660e-11) -
                     n * 2.02226624879595063154e-21;
  rot_free_sine_cosine(r, s, c);
  rot_free_quarters(rot_free_fourth(n), c, s);
}

/* rot_carlson_rf(x, y, 1) */
ROT_INLINE rot_pair rot_free_rf(rot_pair x, rot_pair y) {
  const rot_pair one = ROT_BOTH(1.0), third = ROT_BOTH(1.0 / 3.0), quarter = ROT_BOTH(0.25);
  rot_pair z = one, mean, dx, dy, dz;
  for (int i = 0;; i++) {
    mean = (x + y + z) * third;
    dx = mean - x;
    dy = mean - y;
    dz = mean - z;
    const rot_pair far =
        rot_pair_max(rot_pair_max(rot_pair_abs(dx), rot_pair_abs(dy)), rot_pair_abs(dz));
    const rot_pair close = 0.003 * mean;
    if (i == 60 || rot_pair_count_more(far, close) == 0) break;
    const rot_pair sx = rot_pair_sqrt(x), sy = rot_pair_sqrt(y), sz = rot_pair_sqrt(z);
    const rot_pair l = sx * (sy + sz) + sy * sz;
    x = rot_pair_if_more(far, close, quarter * (x + l), x);
    y = rot_pair_if_more(far, close, quarter * (y + l), y);
    z = rot_pair_if_more(far, close, quarter * (z + l), z);
  }
  const rot_pair each = one / mean;
  dx *= each;
  dy *= each;
  dz = 0.0 - (dx + dy);
  const rot_pair e2 = dx * dy - dz * dz, e3 = dx * dy * dz, e22 = e2 * e2;
  const rot_pair sum = (one - e2 * (1 / 10.0)) + (e3 * (1 / 14.0) + e22 * (1 / 24.0)) -
                       (3 / 44.0 * e2 * e3 + (5 / 208.0 * e22 * e2 - (3 / 104.0) * e3 * e3));
  return sum / rot_pair_sqrt(mean);
}

/* Carlson's duplication for R_J(x, y, 1, p). */
typedef struct rot_free_third {
  rot_pair x, y, z, p, part, sum, delta, far, close;
} rot_free_third;

ROT_INLINE rot_free_third rot_free_third_begin(rot_pair x, rot_pair y, rot_pair p) {
  const rot_pair one = ROT_BOTH(1.0), none = ROT_BOTH(0.0);
  return (rot_free_third){x, y, one, p, one, none, (p - x) * (p - y) * (p - one), none, none};
}

ROT_INLINE int rot_free_third_left(rot_free_third *t) {
  const rot_pair mean = 0.2 * (t->x + t->y + t->z + (t->p + t->p));
  t->far = rot_pair_max(rot_pair_max(rot_pair_abs(mean - t->x), rot_pair_abs(mean - t->y)),
                        rot_pair_max(rot_pair_abs(mean - t->z), rot_pair_abs(mean - t->p)));
  t->close = 0.008 * mean;
  return rot_pair_count_more(t->far, t->close);
}

/* One duplication. delta/d^2 <= 0.18 for the p of swing_at(). */
ROT_INLINE void rot_free_third_double(rot_free_third *t) {
  const rot_pair quarter = ROT_BOTH(0.25), far = t->far, close = t->close;
  const rot_pair sx = rot_pair_sqrt(t->x), sy = rot_pair_sqrt(t->y), sz = rot_pair_sqrt(t->z);
  const rot_pair sp = rot_pair_sqrt(t->p);
  const rot_pair l = sx * (sy + sz) + sy * sz;
  const rot_pair each = 1.0 / ((sp + sx) * (sp + sy) * (sp + sz));
  const rot_pair more = t->part * each * rot_free_arc(t->delta * each * each);
  t->sum = rot_pair_if_more(far, close, t->sum + more, t->sum);
  t->delta *= 1 / 64.0;
  t->part = rot_pair_if_more(far, close, t->part * quarter, t->part);
  t->x = rot_pair_if_more(far, close, quarter * (t->x + l), t->x);
  t->y = rot_pair_if_more(far, close, quarter * (t->y + l), t->y);
  t->z = rot_pair_if_more(far, close, quarter * (t->z + l), t->z);
  t->p = rot_pair_if_more(far, close, quarter * (t->p + l), t->p);
}

ROT_INLINE rot_pair rot_free_third_end(const rot_free_third *t) {
  const rot_pair one = ROT_BOTH(1.0);
  const rot_pair mean = 0.2 * (t->x + t->y + t->z + (t->p + t->p)), each = one / mean;
  const rot_pair dx = (mean - t->x) * each, dy = (mean - t->y) * each, dz = (mean - t->z) * each;
  const rot_pair dp = -0.5 * (dx + dy + dz), xyz = dx * dy * dz, p2 = dp * dp;
  const rot_pair e2 = dx * dy + dx * dz + dy * dz - 3.0 * p2;
  const rot_pair e3 = xyz + 2.0 * e2 * dp + 4.0 * p2 * dp;
  const rot_pair e4 = (2.0 * xyz + e2 * dp + 3.0 * p2 * dp) * dp;
  const rot_pair e5 = xyz * p2, e22 = e2 * e2;
  const rot_pair series =
      (one + (1 / 6.0 * e3 - (3 / 14.0) * e2)) +
      ((9 / 88.0 * e22 - (3 / 22.0) * e4) + (3 / 26.0 * e5 - (9 / 52.0) * e2 * e3)) +
      ((3 / 40.0 * e3 * e3 - (1 / 16.0) * e22 * e2) +
       (3 / 20.0 * e2 * e4 + (45 / 272.0) * e22 * e3) - (9 / 68.0) * (e3 * e4 + e2 * e5));
  return t->part * series * each / rot_pair_sqrt(mean) + 6.0 * t->sum;
}

/* ---- the arithmetic-geometric mean ----------------------------------------------------------- */

enum { ROT_FREE_LEVELS = 12 }; /* m1 = 1e-30 needs 8 */

typedef struct rot_free_means {
  rot_pair_dd k, mean; /* K; rot_jacobi_mean(m1, 1 + nu) */
  int n;
  rot_pair left; /* > 0: not converged */
  rot_pair a[ROT_FREE_LEVELS], g[ROT_FREE_LEVELS];
} rot_free_means;

/* rot_jacobi_begin() and rot_jacobi_mean(). A converged lane keeps its a; g = a leaves the
 * functions of later levels unchanged. */
ROT_INLINE void rot_free_begin_means(rot_pair_dd m1, rot_pair_dd one_nu, rot_free_means *out) {
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0);
  rot_pair_dd a = rot_pair_dd_of(one), g = rot_pair_dd_sqrt(m1), square = one_nu, q = a, sum = a;
  rot_pair live = one;
  int n = 0;
  out->a[0] = one;
  out->g[0] = g.hi;
  while (n + 1 < ROT_FREE_LEVELS) {
    const rot_pair_dd ag = rot_pair_dd_mul(a, g), both = rot_pair_dd_plus(square, ag);
    const rot_pair_dd less = rot_pair_dd_sub(square, ag);
    const rot_pair_dd more =
        rot_pair_dd_scale(rot_pair_dd_div(rot_pair_dd_mul(q, less), both), 0.5);
    /* converged: last mean gives K to 2^-108, next term of the sum below 2^-104 of it */
    const rot_pair difference = rot_pair_abs(a.hi - g.hi) * 0x1p52;
    const rot_pair last = rot_pair_abs(more.hi) * 0x1p104;
    const rot_pair left =
        rot_pair_if_more(difference, a.hi, one, rot_pair_if_more(last, sum.hi, one, none));
    q = more;
    sum = rot_pair_dd_if(live, rot_pair_dd_plus(sum, q), sum);
    const rot_pair_dd mean = rot_pair_dd_scale(rot_pair_dd_plus(a, g), 0.5);
    a = rot_pair_dd_if(live, mean, a);
    live = rot_pair_if(left, live, none);
    g = rot_pair_dd_if(live, rot_pair_dd_sqrt(ag), a);
    n++;
    out->a[n] = a.hi;
    out->g[n] = g.hi;
    if (rot_pair_count_more(live, none) == 0) break;
    /* its root: (square + a g)/(2 old root) */
    square = rot_pair_dd_div(rot_pair_dd_scale(rot_pair_dd_mul(both, both), 0.25), square);
  }
  const rot_pair_dd half_pi = {ROT_BOTH(0x1.921fb54442d18p+0), ROT_BOTH(0x1.1a62633145c07p-54)};
  out->n = n;
  out->left = live;
  out->k = rot_pair_dd_div(half_pi, a);
  out->mean = rot_pair_dd_scale(rot_pair_dd_div(sum, one_nu), 0.5);
}

/* rot_jacobi_at() for |u| <= K up to rounding. */
ROT_INLINE void rot_free_jacobi(const rot_free_means *j, rot_pair m, rot_pair_dd u, rot_pair *sn,
                                rot_pair *cn, rot_pair *dn) {
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0);
  const rot_pair_dd x = rot_pair_dd_abs(u), beyond = rot_pair_dd_sub(j->k, x);
  const rot_pair far = x.hi - beyond.hi; /* > 0: closer to K */
  const rot_pair_dd w = rot_pair_dd_if(far, rot_pair_dd_abs(beyond), x);
  const rot_pair a = j->a[j->n], phase = a * rot_pair_max(w.hi, ROT_BOTH(1e-100));
  rot_pair s, c, d = one;
  rot_free_sine_cosine(phase, &s, &c);
  rot_pair y = a * c / s;
  for (int i = j->n - 1; i >= 0; i--) {
    const rot_pair p = y * y / j->a[i + 1];
    y *= d;
    d = (j->g[i] + p) / (j->a[i] + p);
  }
  const rot_pair size = one + y * y;
  y -= d * size * w.lo;
  d -= m * (y / size) * w.lo;
  const rot_pair k1 = rot_pair_if_more(none, beyond.hi, none - j->g[0], j->g[0]);
  y = rot_pair_if(far, k1 / y, y);
  d = rot_pair_if(far, j->g[0] / d, d);
  const rot_pair sine = one / rot_pair_sqrt(one + y * y);
  *cn = y * sine;
  *dn = d;
  *sn = rot_pair_if_more(none, u.hi, none - sine, sine);
}

/* ---- a body in each lane --------------------------------------------------------------------- */

typedef struct rot_free_swing {
  rot_pair near, by, m1, nu, one_nu, root, mean, near_mean;
} rot_free_swing;

/* swing_of_psi(): integrals of the third kind for two arguments at once. */
ROT_INLINE void rot_free_thirds(const rot_free_swing *f, const rot_pair sn[2], const rot_pair cn[2],
                                const rot_pair dn[2], rot_pair third[2]) {
  const rot_pair one = ROT_BOTH(1.0), scale = one / f->one_nu;
  rot_free_third t[2];
  for (int k = 0; k < 2; k++) {
    const rot_pair x = cn[k] * cn[k], y = dn[k] * dn[k];
    t[k] = rot_free_third_begin(
        x, y, rot_pair_if(f->near, (y + f->nu * x) * scale, one + f->nu * (sn[k] * sn[k])));
  }
  for (int i = 0; i < 60; i++) {
    if (rot_free_third_left(&t[0]) + rot_free_third_left(&t[1]) == 0) break;
    rot_free_third_double(&t[0]);
    rot_free_third_double(&t[1]);
  }
  for (int k = 0; k < 2; k++) {
    third[k] = sn[k] * sn[k] * sn[k] * (1 / 3.0) * rot_free_third_end(&t[k]);
  }
}

ROT_INLINE rot_pair rot_free_swing_at(const rot_free_swing *f, rot_pair u, rot_pair sn, rot_pair cn,
                                      rot_pair dn, rot_pair third, rot_pair *rounding) {
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0), scale = one / f->one_nu;
  rot_pair swing = f->by * (u * f->mean - third);
  rot_pair size = rot_pair_abs(third) + rot_pair_abs(u * f->mean);
  if (rot_pair_count_more(f->near, none) > 0) {
    const rot_pair slope = sn * (cn / dn), angle = rot_pair_abs(f->root * slope);
    const rot_pair any = rot_pair_if(f->root, f->root, one);
    const rot_pair arc = rot_free_arctangent(rot_pair_if_more(one, angle, angle, one)) / any;
    const rot_pair turn =
        rot_pair_if(f->root, rot_pair_if_more(none, slope, none - arc, arc), slope);
    const rot_pair part = f->m1 * scale * third, even = u * f->near_mean;
    swing = rot_pair_if(f->near, f->by * scale * (turn + (part - even)), swing);
    size = rot_pair_if(f->near, rot_pair_abs(turn) + rot_pair_abs(part) + rot_pair_abs(even), size);
  }
  *rounding = 8.0 * rot_pair_abs(f->by) * size;
  return swing;
}

/* Positions of the axes of cn (o) and dn (c) and of the reference axis r; numbers > 0: yes. */
typedef struct rot_free_frame {
  rot_pair high;                 /* c is the third axis */
  rot_pair by_o;                 /* r is o */
  rot_pair is_x;                 /* the lead is x: r is the third axis */
  rot_pair momentum;             /* |L| */
  rot_pair quarter_c, quarter_s; /* cosine, sine of half the angle about r at the start */
} rot_free_frame;

/* Quaternion, in axes (x, y, z), of the rotation about z by psi after that of L to z, by half
 * angles. Also used for a single body. */
ROT_INLINE void rot_free_to_z(rot_pair cos_psi, rot_pair sin_psi, rot_pair ct, rot_pair st,
                              rot_pair cc, rot_pair sc, rot_pair q[4]) {
  q[0] = ct * (cos_psi * cc - sin_psi * sc);
  q[1] = st * (cos_psi * cc + sin_psi * sc);
  q[2] = st * (sin_psi * cc - cos_psi * sc);
  q[3] = ct * (sin_psi * cc + cos_psi * sc);
}

/* angles_of() with psi: quaternion in axes (x, y, r). */
ROT_INLINE void rot_free_turn(const rot_free_frame *f, rot_pair side, rot_pair l_r, rot_pair l_1,
                              rot_pair l_lead, rot_pair quarters, rot_pair cos_psi,
                              rot_pair sin_psi, rot_pair q[4]) {
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0), half = ROT_BOTH(0.5);
  const rot_pair rho = rot_pair_sqrt(l_lead * l_lead + l_1 * l_1), each = one / f->momentum;
  const rot_pair ct = rot_pair_sqrt(half * (one + l_r * each)), st = half * rho * each / ct;
  const rot_pair under = one / rho;
  const rot_pair s = rot_pair_if(f->is_x, none - side, side) * l_1 * under;
  rot_pair cc = rot_pair_sqrt(half * (one + rot_pair_abs(l_lead) * under)), sc = half * s / cc;
  const rot_pair c0 = cc;
  cc = c0 * f->quarter_c - sc * f->quarter_s;
  sc = c0 * f->quarter_s + sc * f->quarter_c;
  rot_free_quarters(quarters, &cc, &sc);
  rot_free_to_z(cos_psi, sin_psi, ct, st, cc, sc, q);
}

/* Numbers of one body per lane. */
typedef struct rot_free_lanes {
  rot_pair moment[3], omega[3]; /* sorted */
  rot_pair axis[3];             /* sorted axis k is body axis axis[k] */
  rot_pair sense;               /* sign of the middle axis */
  rot_pair unit;                /* of the rates */
  rot_pair time, good;
} rot_free_lanes;

/* One step of sort_axes(). */
ROT_INLINE void rot_free_order(rot_free_lanes *x, int k) {
  const rot_pair a = x->moment[k], b = x->moment[k + 1], none = ROT_BOTH(0.0);
  const rot_pair wa = x->omega[k], wb = x->omega[k + 1], ka = x->axis[k], kb = x->axis[k + 1];
  x->moment[k] = rot_pair_if_more(a, b, b, a);
  x->moment[k + 1] = rot_pair_if_more(a, b, a, b);
  x->omega[k] = rot_pair_if_more(a, b, wb, wa);
  x->omega[k + 1] = rot_pair_if_more(a, b, wa, wb);
  x->axis[k] = rot_pair_if_more(a, b, kb, ka);
  x->axis[k + 1] = rot_pair_if_more(a, b, ka, kb);
  x->sense = rot_pair_if_more(a, b, none - x->sense, x->sense);
}

/* 2^k for 2^k <= x < 2^(k + 1): Rump, Ogita & Oishi, SIAM J. Sci. Comput. 31 (2009) 1269. */
ROT_INLINE rot_pair rot_free_power_below(rot_pair x) {
  const rot_pair q = (0x1p52 + 1.0) * x;
  return rot_pair_abs(q - (1.0 - ROT_EPS) * q);
}

ROT_INLINE rot_pair rot_free_within(rot_pair x, double low, double high, rot_pair good) {
  const rot_pair none = ROT_BOTH(0.0);
  return rot_pair_if_more(x, ROT_BOTH(low), rot_pair_if_more(ROT_BOTH(high), x, good, none), none);
}

/* block => lanes: moments ascending, the largest < 1; largest |rate| < 1; time in the corresponding
 * unit. Lanes with numbers too different in magnitude compute another body. */
ROT_INLINE void rot_free_take(const rot_free_block *x, size_t i, rot_free_lanes *out) {
  static const double moment[3] = {0.5, 0.625, 0.75};
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0), half = ROT_BOTH(0.5);
  for (int k = 0; k < 3; k++) {
    out->moment[k] = rot_load(x->moment[k] + i);
    out->omega[k] = rot_load(x->omega[k] + i);
    out->axis[k] = ROT_BOTH((double)k);
  }
  out->sense = one;
  rot_free_order(out, 0);
  rot_free_order(out, 1);
  rot_free_order(out, 0);
  const rot_pair time = rot_load(x->time + i), largest = out->moment[2];
  const rot_pair rate =
      rot_pair_max(rot_pair_max(rot_pair_abs(out->omega[0]), rot_pair_abs(out->omega[1])),
                   rot_pair_abs(out->omega[2]));
  rot_pair good = rot_free_within(out->moment[0], 1e-200, 1e200, one);
  good = rot_free_within(largest, 1e-200, 1e200, good);
  good = rot_free_within(out->moment[0] / largest, 1e-12, 2.0, good);
  good = rot_free_within(rate, 1e-100, 1e100, good);
  good = rot_free_within(rot_pair_abs(time), 1e-100, 1e100, good);
  rot_pair length = none;
  for (int k = 0; k < 4; k++) length += rot_load(x->q[k] + i) * rot_load(x->q[k] + i);
  good = rot_free_within(length, 1e-100, 1e100, good);
  for (int k = 0; k < 3; k++) {
    const rot_pair part = rot_pair_abs(out->omega[k]) / rate;
    good = rot_free_within(rot_pair_if(part, part, one), 1e-40, 2.0, good);
  }
  out->unit = rot_pair_if(good, rot_free_power_below(rate + rate), one);
  const rot_pair per_rate = one / out->unit;
  const rot_pair per_moment = rot_pair_if(good, half / rot_free_power_below(largest), one);
  for (int k = 0; k < 3; k++) {
    out->moment[k] = rot_pair_if(good, out->moment[k] * per_moment, ROT_BOTH(moment[k]));
    out->omega[k] = rot_pair_if(good, out->omega[k] * per_rate, half);
  }
  out->omega[1] = out->omega[1] * out->sense;
  out->time = rot_pair_if(good, time * out->unit, one);
  out->good = good;
}

/* Vector in sorted axes => in body axes, times `by`. */
ROT_INLINE void rot_free_unsort(const rot_free_lanes *x, const rot_pair v[3], rot_pair by,
                                rot_pair out[3]) {
  const rot_pair middle = v[1] * x->sense, half = ROT_BOTH(0.5);
  for (int k = 0; k < 3; k++) {
    const rot_pair axis = ROT_BOTH((double)k);
    const rot_pair first = rot_pair_abs(x->axis[0] - axis), last = rot_pair_abs(x->axis[2] - axis);
    out[k] = by * rot_pair_if_more(half, first, v[0], rot_pair_if_more(half, last, v[2], middle));
  }
}

/* back: p* q; else p q. */
ROT_INLINE void rot_free_after(const rot_pair p[4], const rot_pair q[4], int back,
                               rot_pair out[4]) {
  const rot_pair side = back ? ROT_BOTH(-1.0) : ROT_BOTH(1.0);
  const rot_pair x = side * p[1], y = side * p[2], z = side * p[3];
  out[0] = p[0] * q[0] - x * q[1] - y * q[2] - z * q[3];
  out[1] = p[0] * q[1] + x * q[0] + y * q[3] - z * q[2];
  out[2] = p[0] * q[2] + y * q[0] + z * q[1] - x * q[3];
  out[3] = p[0] * q[3] + z * q[0] + x * q[2] - y * q[1];
}

ROT_INLINE void rot_free_pass_one(rot_free_block *x, size_t i) {
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0), half = ROT_BOTH(0.5);
  rot_free_lanes lanes;
  rot_free_take(x, i, &lanes);
  const rot_pair i0 = lanes.moment[0], i1 = lanes.moment[1], i2 = lanes.moment[2];
  const rot_pair w0 = lanes.omega[0], w1 = lanes.omega[1], w2 = lanes.omega[2], t = lanes.time;
  /* begin_sorted() */
  const rot_pair_dd d21 = rot_pair_dd_sum2(i1, none - i0), d32 = rot_pair_dd_sum2(i2, none - i1);
  const rot_pair_dd d31 = rot_pair_dd_sum2(i2, none - i0);
  const rot_pair_dd e0 = rot_pair_dd_mul1(rot_pair_dd_mul2(w0, w0), i0);
  const rot_pair_dd e1 = rot_pair_dd_mul1(rot_pair_dd_mul2(w1, w1), i1);
  const rot_pair_dd e2 = rot_pair_dd_mul1(rot_pair_dd_mul2(w2, w2), i2);
  const rot_pair_dd t1 = rot_pair_dd_mul(e0, d21), t3 = rot_pair_dd_mul(e2, d32);
  const rot_pair_dd from = rot_pair_dd_sub(t3, t1), distance = rot_pair_dd_abs(from);
  rot_free_frame f;
  f.high = rot_pair_if(from.hi, one, none);
  const rot_pair_dd dcm = rot_pair_dd_if(f.high, d32, d21);
  const rot_pair_dd dom = rot_pair_dd_if(f.high, d21, d32);
  const rot_pair_dd eo = rot_pair_dd_if(f.high, e0, e2);
  const rot_pair_dd ec = rot_pair_dd_if(f.high, e2, e0);
  const rot_pair io = rot_pair_if(f.high, i0, i2);
  const rot_pair ic = rot_pair_if(f.high, i2, i0);
  const rot_pair wo = rot_pair_if(f.high, w0, w2);
  const rot_pair wc = rot_pair_if(f.high, w2, w0);
  rot_pair_dd big_o = rot_pair_dd_plus(rot_pair_dd_mul(d31, eo), rot_pair_dd_mul(dcm, e1));
  rot_pair_dd big_c = rot_pair_dd_plus(rot_pair_dd_mul(d31, ec), rot_pair_dd_mul(dom, e1));
  const rot_pair_dd dcmy = rot_pair_dd_mul(dcm, big_c), above = rot_pair_dd_mul(d31, distance);
  const rot_pair_dd under = rot_pair_dd_mul(dom, big_o);
  /* Lanes to which the kernel does not apply compute another body. */
  rot_pair good = rot_pair_if_more(above.hi, 1e-30 * dcmy.hi, lanes.good, none);
  good = rot_pair_if(big_o.hi, good, none);
  const rot_pair_dd other = {one, none};
  big_o = rot_pair_dd_if(good, big_o, other);
  big_c = rot_pair_dd_if(good, big_c, other);
  const rot_pair_dd each = rot_pair_dd_div(other, rot_pair_dd_if(good, dcmy, other));
  rot_pair_dd m1 = rot_pair_dd_mul(above, each);
  m1 = rot_pair_dd_if((m1.hi - one) + m1.lo, other, m1);
  m1 = rot_pair_dd_if(good, m1, other);
  const rot_pair_dd m = rot_pair_dd_if(good, rot_pair_dd_mul(under, each), rot_pair_dd_of(none));
  const rot_pair loss =
      4.0 * 0x1p-102 * (t1.hi + t3.hi) / rot_pair_if(good, distance.hi, one) + 16.0 * 0x1p-102;
  const rot_pair_dd l2 =
      rot_pair_dd_plus(rot_pair_dd_plus(rot_pair_dd_mul1(e0, i0), rot_pair_dd_mul1(e1, i1)),
                       rot_pair_dd_mul1(e2, i2));
  const rot_pair_dd momentum = rot_pair_dd_sqrt(rot_pair_dd_if(good, l2, other));
  f.momentum = momentum.hi;
  /* begin_psi() */
  const rot_pair_dd lo = rot_pair_dd_mul1(big_o, io), lc = rot_pair_dd_mul1(big_c, ic);
  f.by_o = rot_pair_if_more(lo.hi, lc.hi, none, one);
  rot_pair_dd nu = rot_pair_dd_div(rot_pair_dd_if(f.by_o, lo, lc), rot_pair_dd_if(f.by_o, lc, lo));
  nu = rot_pair_dd_if(f.by_o, nu, rot_pair_dd_mul(nu, m));
  const rot_pair_dd one_nu = rot_pair_dd_plus(other, nu), m_nu = rot_pair_dd_plus(m, nu);
  const rot_pair lead = rot_pair_if(f.by_o, ic, io);
  const rot_pair ref = rot_pair_if(f.by_o, io, ic);
  f.is_x = rot_pair_if(f.high, one - f.by_o, f.by_o);
  const rot_pair_dd away = rot_pair_dd_if(f.is_x, d21, rot_pair_dd_neg(d32));
  rot_free_means j;
  rot_free_begin_means(m1, one_nu, &j);
  good = rot_pair_if(j.left, none, good);
  /* psi' = L (I2 - away mean)/(I_lead I2); lambda^2 = dcm y/(I1 I2 I3) */
  const rot_pair_dd inverse =
      rot_pair_dd_div(other, rot_pair_dd_mul1(rot_pair_dd_mul2(lead, i1), ref));
  const rot_pair_dd lambda =
      rot_pair_dd_sqrt(rot_pair_dd_mul(rot_pair_dd_if(good, dcmy, other), inverse));
  const rot_pair_dd factor = rot_pair_dd_mul(away, rot_pair_dd_if(f.by_o, m_nu, one_nu));
  const rot_pair_dd unit = rot_pair_dd_mul(rot_pair_dd_mul1(inverse, ref), momentum);
  const rot_pair_dd even =
      rot_pair_dd_mul(unit, rot_pair_dd_sub(rot_pair_dd_of(i1), rot_pair_dd_mul(factor, j.mean)));
  const rot_pair g = unit.hi * factor.hi;
  const rot_pair psi_size = unit.hi * i1 + rot_pair_abs(g * j.mean.hi);
  rot_free_swing swing;
  swing.near = rot_pair_if_more(ROT_BOTH(0.1), m1.hi, one, none);
  swing.by = g / lambda.hi;
  swing.m1 = m1.hi;
  swing.nu = nu.hi;
  swing.one_nu = one_nu.hi;
  swing.mean = j.mean.hi;
  swing.root = swing.near_mean = none;
  if (rot_pair_count_more(swing.near, none) > 0) {
    const rot_pair_dd part = rot_pair_dd_sub(
        rot_pair_dd_mul(one_nu, rot_pair_dd_sub(other, rot_pair_dd_mul(m_nu, j.mean))), m1);
    swing.root = rot_pair_sqrt(nu.hi * (one_nu.hi - m1.hi) / one_nu.hi);
    swing.near_mean = part.hi / m_nu.hi;
  }
  /* begin_tumbling() */
  const rot_pair side = rot_pair_if_more(none, wo, none - one, one);
  const rot_pair direction = rot_pair_if_more(none, wc, none - one, one);
  const rot_pair simd = rot_pair_if(good, d31.hi, one);
  const rot_pair narrow = rot_pair_if(good, dcm.hi, one);
  const rot_pair amplitude_o = side * rot_pair_sqrt(big_o.hi / (simd * io));
  const rot_pair amplitude_c = direction * rot_pair_sqrt(big_c.hi / (simd * ic));
  const rot_pair amplitude_1 = side * direction * rot_pair_sqrt(big_o.hi / (narrow * i1));
  rot_pair sn0 = w1 / amplitude_1, cn0 = wo / amplitude_o;
  const rot_pair size0 = one / rot_pair_sqrt(sn0 * sn0 + cn0 * cn0);
  sn0 *= size0;
  cn0 *= size0;
  const rot_pair dn0 = wc / amplitude_c, s0 = rot_pair_abs(sn0), k1 = j.g[0];
  /* rot_jacobi_argument(): from K if u > K/2, by sn(K - u) = cn/dn, cn(K - u) = k' sn/dn */
  const rot_pair far = rot_pair_if_more(s0 * s0 * (one + k1), one, one, none);
  rot_pair sw = cn0 / dn0, cw = k1 * (s0 / dn0), dw = k1 / dn0;
  const rot_pair size_w = one / rot_pair_sqrt(sw * sw + cw * cw);
  sw = rot_pair_if(far, sw * size_w, s0);
  cw = rot_pair_if(far, cw * size_w, cn0);
  dw = rot_pair_if(far, dw, dn0);
  const rot_pair w = sw * rot_free_rf(cw * cw, dw * dw);
  rot_pair_dd start =
      rot_pair_dd_if(far, rot_pair_dd_sub(j.k, rot_pair_dd_of(w)), rot_pair_dd_of(w));
  start = rot_pair_dd_if(none - sn0, rot_pair_dd_neg(start), start);
  const rot_pair start_error = 8.0 * ROT_EPS * w;
  /* tumbling_at() */
  const rot_pair_dd u = rot_pair_dd_add(rot_pair_dd_mul1(lambda, t), start);
  const rot_pair_dd period = rot_pair_dd_scale(j.k, 2.0);
  rot_pair turns = rot_free_rounded(u.hi / period.hi);
  good = rot_pair_if_more(ROT_BOTH(0x1p50), rot_pair_abs(turns), good, none);
  turns = rot_pair_if(good, turns, none);
  rot_pair_dd r = rot_pair_dd_sub(u, rot_pair_dd_mul1(period, turns));
  /* A second time: the first quotient is rounded, |r| may exceed K. */
  const rot_pair more =
      rot_pair_if_more(rot_pair_abs(r.hi), j.k.hi, rot_free_rounded(r.hi / period.hi), none);
  r = rot_pair_dd_sub(r, rot_pair_dd_mul1(period, more));
  turns += more;
  rot_pair sines[2] = {sn0}, cosines[2] = {cn0}, deltas[2] = {dn0}, thirds[2];
  rot_free_jacobi(&j, m.hi, r, &sines[1], &cosines[1], &deltas[1]);
  const rot_pair sn = sines[1], cn = cosines[1], dn = deltas[1];
  rot_free_thirds(&swing, sines, cosines, deltas, thirds);
  rot_pair rounding, rounding0;
  const rot_pair swing0 = rot_free_swing_at(&swing, start.hi, sn0, cn0, dn0, thirds[0], &rounding0);
  const rot_pair swung = rot_free_swing_at(&swing, r.hi, sn, cn, dn, thirds[1], &rounding);
  rot_pair_dd psi = rot_pair_dd_mul1(even, t);
  const rot_pair_dd circle = {ROT_BOTH(0x1.921fb54442d18p+3), ROT_BOTH(0x1.1a62633145c07p-51)};
  const rot_pair whole = rot_free_rounded(psi.hi / circle.hi);
  good = rot_pair_if_more(ROT_BOTH(0x1p50), rot_pair_abs(whole), good, none);
  psi = rot_pair_dd_sub(psi, rot_pair_dd_mul1(circle, whole));
  rot_pair sin_psi, cos_psi;
  rot_free_any_sine_cosine(half * (psi.hi + (swung - swing0)), &sin_psi, &cos_psi);
  const rot_pair leading = rot_pair_if(f.by_o, direction, side);
  const rot_pair root = ROT_BOTH(0x1.6a09e667f3bcdp-1);
  f.quarter_c = rot_pair_if(f.is_x, root, rot_pair_if(leading, one, none));
  f.quarter_s = rot_pair_if(f.is_x, root * leading, rot_pair_if(leading, none, one));
  rot_pair first[4], q[4];
  const rot_pair lo0 = io * wo, lc0 = ic * wc, l10 = i1 * w1;
  rot_free_turn(&f, leading, rot_pair_if(f.by_o, lo0, lc0), l10, rot_pair_if(f.by_o, lc0, lo0),
                none, one, none, first);
  const rot_pair left = rot_free_fourth(turns);
  const rot_pair odd = rot_pair_abs(left - 2.0 * rot_free_rounded(half * left));
  const rot_pair flips = rot_pair_if_more(odd, half, none - one, one);
  const rot_pair shown = rot_pair_if(f.by_o, flips, one);
  const rot_pair wo1 = amplitude_o * cn, wc1 = amplitude_c * dn, w11 = amplitude_1 * sn;
  const rot_pair lo1 = shown * io * wo1, lc1 = ic * wc1, l11 = shown * i1 * w11;
  const rot_pair round = rot_pair_if(f.is_x, none - direction, direction);
  const rot_pair quarters = rot_pair_if(f.by_o, none, round * left);
  rot_free_turn(&f, leading, rot_pair_if(f.by_o, lo1, lc1), l11, rot_pair_if(f.by_o, lc1, lo1),
                quarters, cos_psi, sin_psi, q);
  rot_pair turned[4], at[4], end[4];
  rot_free_after(first, q, 1, turned);
  /* (x, y, r) = (1, 2, 3) if r is the third axis, (2, 3, 1) if it is the first */
  const rot_pair sorted[3] = {rot_pair_if(f.is_x, turned[1], turned[3]),
                              rot_pair_if(f.is_x, turned[2], turned[1]),
                              rot_pair_if(f.is_x, turned[3], turned[2])};
  at[0] = turned[0];
  rot_free_unsort(&lanes, sorted, one, at + 1);
  for (int k = 0; k < 4; k++) q[k] = rot_load(x->q[k] + i);
  rot_free_after(q, at, 0, end);
  const rot_pair size =
      rot_pair_sqrt(end[0] * end[0] + end[1] * end[1] + end[2] * end[2] + end[3] * end[3]);
  for (int k = 0; k < 4; k++) rot_store(x->q[k] + i, end[k] / size);
  const rot_pair vo = flips * wo1, v1 = flips * w11;
  const rot_pair v[3] = {rot_pair_if(f.high, vo, wc1), v1, rot_pair_if(f.high, wc1, vo)};
  rot_pair rates[3];
  rot_free_unsort(&lanes, v, lanes.unit, rates);
  for (int k = 0; k < 3; k++) rot_store(x->omega[k] + i, rates[k]);
  /* judge() */
  const rot_pair cross_o = dom.hi * v1 * wo1, cross_c = dcm.hi * v1 * wc1;
  const rot_pair cross_1 = d31.hi * wo1 * wc1;
  const rot_pair tilt = rot_pair_sqrt(cross_o * cross_o + cross_c * cross_c + cross_1 * cross_1);
  const rot_pair times = rot_pair_abs(turns) + one;
  const rot_pair du = start_error + (8.0 * 0x1p-102) * rot_pair_abs(u.hi) +
                      times * rot_pair_if_more(one, loss, loss, one);
  const rot_pair rate = rot_pair_sqrt(w0 * w0 + w1 * w1 + w2 * w2);
  const rot_pair part = rot_pair_abs(g * (sn * sn / (one + nu.hi * sn * sn) - j.mean.hi));
  const rot_pair per_u = rot_pair_if_more(ROT_BOTH(1e-3), du, 1.1 * (tilt / momentum.hi + part),
                                          rate + rate + rot_pair_abs(g)) /
                         lambda.hi;
  const rot_pair by_psi = 8.0 * 0x1p-102 * rot_pair_abs(psi_size * t) +
                          4.0 * times * loss * rot_pair_abs(swing.by) +
                          ROT_EPS * (rounding + rounding0);
  const rot_pair error = 24.0 * ROT_EPS + by_psi + per_u * du;
  const rot_pair turn_o = cross_c / io, turn_c = cross_o / ic, turn_1 = cross_1 / i1;
  const rot_pair speed = rot_pair_sqrt(turn_o * turn_o + turn_c * turn_c + turn_1 * turn_1);
  const rot_pair moved = rot_pair_if_more(ROT_BOTH(1e-3), du, 1.1 * speed / lambda.hi, rate + rate);
  const rot_pair length = rot_pair_sqrt(vo * vo + v1 * v1 + wc1 * wc1);
  rot_store(x->omega_error + i, lanes.unit * (12.0 * ROT_EPS * length + moved * du));
  const rot_pair pi = ROT_BOTH(0x1.921fb54442d18p+1);
  rot_store(x->error + i, rot_pair_if_more(pi, error, error, pi));
  /* error neither too large nor NaN */
  rot_store(x->good + i, rot_pair_if_more(ROT_BOTH(1e300), error, good, none));
}

ROT_INLINE void rot_free_pass(rot_free_block *x) {
  for (size_t i = 0; i < ROT_FREE_BLOCK; i += ROT_PAIR) rot_free_pass_one(x, i);
}

/* The same for registers of four lanes; requires rot_simd_fma_ok(). */
void rot_free_pass_simd(rot_free_block *x);

#endif
