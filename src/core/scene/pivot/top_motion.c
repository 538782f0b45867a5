#include "scene/pivot/top_motion.h"

#include <math.h>
#include <string.h>

#include "maths/attitude.h"
#include "ground/dd_trig.h"

static const rot_dd none = {0.0, 0.0}, one = {1.0, 0.0};
static const double pi = 0x1.921fb54442d18p+1;

static rot_dd square(rot_dd x) { return rot_dd_mul(x, x); }

static rot_dd twice(rot_dd x) { return rot_dd_ldexp(x, 1); }

static rot_dd root(rot_dd x) { return x.hi > 0.0 ? rot_dd_sqrt(x) : none; }

/* ---- the start ------------------------------------------------------------------------------- */

void rot_top_from_euler(double phi, double theta, double psi, double phi_rate, double theta_rate,
                        double omega3, rot_top_start *out) {
  rot_dd st, ct, ss, cs, sd, cd, sp, cp, sine, cosine;
  rot_dd_sine_cosine((rot_dd){0.5 * theta, 0.0}, &st, &ct);
  rot_dd_sine_cosine(rot_dd_ldexp(rot_dd_sum2(phi, psi), -1), &ss, &cs);
  rot_dd_sine_cosine(rot_dd_ldexp(rot_dd_sum2(phi, -psi), -1), &sd, &cd);
  rot_dd_sine_cosine((rot_dd){psi, 0.0}, &sp, &cp);
  rot_dd_sine_cosine((rot_dd){theta, 0.0}, &sine, &cosine);
  out->q[0] = rot_dd_mul(ct, cs);
  out->q[1] = rot_dd_mul(st, cd);
  out->q[2] = rot_dd_mul(st, sd);
  out->q[3] = rot_dd_mul(ct, ss);
  const rot_dd across = rot_dd_mul1(sine, phi_rate);
  out->omega[0] = rot_dd_add(rot_dd_mul1(cp, theta_rate), rot_dd_mul(across, sp));
  out->omega[1] = rot_dd_sub(rot_dd_mul(across, cp), rot_dd_mul1(sp, theta_rate));
  out->omega[2] = (rot_dd){omega3, 0.0};
}

/* Constants during the set-up, in the unit of time of the motion. */
typedef struct setup {
  rot_dd q[4], omega[3];
  rot_dd wheels;      /* angular momentum of the wheels */
  rot_dd a, beta;     /* L3/I1 with L3 = I3 omega3 + wheels, 2 G/I1 > 0 */
  rot_dd down, up;    /* 1 - u and 1 + u at the start */
  rot_dd minus, plus; /* b - a, b + a; b: vertical angular momentum over I1 */
  rot_dd rise;        /* u' at the start */
  rot_dd turning;     /* phi' sin^2(theta) at the start */
  rot_dd x[3];        /* zeros of u'^2 minus u at the start */
  rot_dd above, below, swing, m, m1;
} setup;

static int finite_dd(rot_dd x) { return isfinite(x.hi) && isfinite(x.lo); }

/* Normalises q. Returns 0 if q or its exponents are out of range, else 1. */
static int unit(rot_dd q[4]) {
  int e;
  rot_dd sum = none;
  double max = 0.0;
  for (int i = 0; i < 4; i++) max = fmax(max, fabs(q[i].hi));
  if (!(max > 0.0)) return 0;
  (void)frexp(max, &e);
  for (int i = 0; i < 4; i++) {
    q[i] = rot_dd_ldexp(q[i], -e);
    sum = rot_dd_add(sum, square(q[i]));
  }
  const rot_dd length = rot_dd_sqrt(sum);
  for (int i = 0; i < 4; i++) q[i] = rot_dd_div(q[i], length);
  return 1;
}

/* Reverses body axes 2 and 3. */
static void turn_over(rot_dd q[4], rot_dd omega[3]) {
  const rot_dd p[4] = {rot_dd_neg(q[1]), q[0], q[3], rot_dd_neg(q[2])};
  memcpy(q, p, sizeof p);
  omega[1] = rot_dd_neg(omega[1]);
  omega[2] = rot_dd_neg(omega[2]);
}

/* a/b without overflow: m 2^*e, m near 1. */
static rot_dd quotient(rot_dd a, double b, int *e) {
  int ea, eb;
  const double mb = frexp(b, &eb);
  (void)frexp(a.hi, &ea);
  *e = ea - eb;
  return rot_dd_div(rot_dd_ldexp(a, -ea), (rot_dd){mb, 0.0});
}

/* ---- the zeros ------------------------------------------------------------------------------- */

static rot_dd cubic(const rot_dd c[3], rot_dd x, rot_dd *slope) {
  const rot_dd high = rot_dd_add(x, c[2]), mid = rot_dd_add(rot_dd_mul(high, x), c[1]);
  *slope = rot_dd_add(rot_dd_mul(rot_dd_add(high, x), x), mid);
  return rot_dd_add(rot_dd_mul(mid, x), c[0]);
}

/* (sum, product) => both real zeros of x^2 - sum x + product, ascending. */
static void quadratic(rot_dd sum, rot_dd product, rot_dd *low, rot_dd *high) {
  const rot_dd width = root(rot_dd_sub(square(sum), rot_dd_ldexp(product, 2)));
  const int up = sum.hi >= 0.0;
  const rot_dd far = rot_dd_ldexp(up ? rot_dd_add(sum, width) : rot_dd_sub(sum, width), -1);
  const rot_dd near = far.hi != 0.0 ? rot_dd_div(product, far) : none;
  *low = up ? near : far;
  *high = up ? far : near;
}

/* Zeros x[0] <= 0 <= x[1] <= x[2] of x^3 + c2 x^2 + c1 x + c0. The isolated one: Newton's method
 * from the trigonometric formula; the others: from their sum and product. */
static void zeros(const rot_dd c[3], rot_dd x[3]) {
  if (c[0].hi == 0.0) { /* the start is a turning point */
    rot_dd low, high;
    quadratic(rot_dd_neg(c[2]), c[1], &low, &high);
    x[0] = low.hi <= 0.0 ? low : none;
    x[1] = low.hi <= 0.0 ? none : low;
    x[2] = high;
    if (high.hi < 0.0) x[2] = none;
    return;
  }
  const double third = -c[2].hi / 3.0;
  const double p = c[1].hi - 3.0 * third * third;
  const double q = (2.0 * third * third - c[1].hi) * -third + c[0].hi;
  const double r = sqrt(fmax(-p / 3.0, 0.0));
  const double cosine = r > 0.0 ? fmax(-1.0, fmin(1.0, -0.5 * q / r / r / r)) : 1.0;
  const double angle = acos(cosine) / 3.0;
  const double high = third + 2.0 * r * cos(angle), low = third - 2.0 * r * cos(pi / 3.0 - angle);
  const int lonely_high = angle < pi / 6.0; /* the middle zero is closer to the low one */
  rot_dd z = {lonely_high ? fmax(high, 0.0) : fmin(low, 0.0), 0.0};
  for (int i = 0; i < 60; i++) {
    rot_dd slope;
    const rot_dd value = cubic(c, z, &slope);
    if (slope.hi == 0.0) break;
    const rot_dd step = rot_dd_div(value, slope);
    z = rot_dd_sub(z, step);
    if (!(fabs(step.hi) > 0x1p-95 * fabs(z.hi))) break;
  }
  /* x^2 + (c2 + z) x - c0/z */
  const rot_dd product = rot_dd_neg(rot_dd_div(c[0], z));
  /* Sum of the other two by c1: no cancellation if |z| is the largest. */
  const rot_dd by_c1 = rot_dd_div(rot_dd_sub(c[1], product), z);
  const rot_dd by_c2 = rot_dd_neg(rot_dd_add(c[2], z));
  const double loss1 = (fabs(c[1].hi) + fabs(product.hi)) / fabs(z.hi);
  const double loss2 = fabs(c[2].hi) + fabs(z.hi);
  const rot_dd sum = loss1 < loss2 ? by_c1 : by_c2;
  if (lonely_high) {
    x[2] = z;
    quadratic(sum, product, &x[0], &x[1]);
  } else {
    x[0] = z;
    quadratic(sum, product, &x[1], &x[2]);
  }
  if (x[0].hi > 0.0) x[0] = none;
  if (x[1].hi < 0.0) x[1] = none;
  if (x[2].hi < x[1].hi) x[2] = x[1];
}

/* u'^2 = beta (x - x0)(x - x1)(x - x2), x = u - u(0). The coefficients are expressed by values at
 * the start: no cancellation next to a turning point. */
static void find_zeros(setup *s) {
  const rot_dd u0 = rot_dd_ldexp(rot_dd_sub(s->up, s->down), -1);
  const rot_dd across = rot_dd_add(square(s->omega[0]), square(s->omega[1]));
  const rot_dd f0 = square(s->rise);
  const rot_dd f1 = rot_dd_sub(rot_dd_sub(twice(rot_dd_mul(s->a, s->turning)),
                                          rot_dd_mul(s->beta, rot_dd_mul(s->up, s->down))),
                               twice(rot_dd_mul(u0, across)));
  const rot_dd f2 = rot_dd_sub(rot_dd_sub(twice(rot_dd_mul(s->beta, u0)), across), square(s->a));
  const rot_dd c[3] = {rot_dd_div(f0, s->beta), rot_dd_div(f1, s->beta), rot_dd_div(f2, s->beta)};
  zeros(c, s->x);
}

/* (root, other root, product) => root; the smaller one as product / larger. */
static rot_dd lesser(rot_dd direct, rot_dd other, rot_dd product) {
  if (direct.hi > other.hi && direct.hi > 0.0) return direct;
  return other.hi > 0.0 ? rot_dd_div(product, other) : none;
}

static void find_range(setup *s) {
  const rot_dd down = rot_dd_sub(s->down, s->x[0]);   /* 1 - u1 */
  const rot_dd up = rot_dd_add(s->up, s->x[1]);       /* 1 + u2 */
  const rot_dd beyond = rot_dd_sub(s->x[2], s->down); /* u3 - 1 */
  const rot_dd top = rot_dd_div(square(s->minus), rot_dd_mul(s->beta, down));
  const rot_dd bottom = rot_dd_mul(s->beta, rot_dd_mul(up, rot_dd_add(s->up, s->x[2])));
  s->above = lesser(rot_dd_sub(s->down, s->x[1]), beyond, top);
  s->below = bottom.hi > 0.0 ? rot_dd_div(square(s->plus), bottom) : none;
  s->swing = rot_dd_sub(s->x[1], s->x[0]);
  const rot_dd width = rot_dd_sub(s->x[2], s->x[0]);
  s->m = rot_dd_div(s->swing, width);
  s->m1 = rot_dd_div(rot_dd_sub(s->x[2], s->x[1]), width);
  if (s->m1.hi < 1e-285) s->m1 = none;
}

/* ---- the angles ------------------------------------------------------------------------------ */

/* Periodic part of the angle at argument |u| <= K: integral of g/(1 + part sn^2) minus its mean,
 * over lambda. */
static double swing_of(const rot_top_motion *m, const rot_top_angle *angle, double u, double sn,
                       double cn, double dn, double *rounding) {
  const double by = angle->g / m->lambda.hi, s3 = sn * sn * sn / 3.0;
  if (angle->g == 0.0) {
    *rounding = 0.0;
    return 0.0;
  }
  if (angle->near[0] == 0.0) {
    const double p =
        angle->part < 0.0 ? cn * cn + angle->whole * sn * sn : 1.0 + angle->part * sn * sn;
    const double x = s3 * rot_carlson_rj(cn * cn, dn * dn, 1.0, p), y = u * angle->j;
    *rounding = 8.0 * fabs(by * angle->part) * (fabs(x) + fabs(y));
    return -by * angle->part * (x - y);
  }
  const double slope = angle->near[0], factor = angle->near[1], by_root = angle->near[2];
  const double turn = atan(slope * sn * (cn / dn));
  const double p = (dn * dn + angle->part * cn * cn) / (1.0 + angle->part);
  const double x = s3 * rot_carlson_rj(cn * cn, dn * dn, 1.0, p), y = u * angle->j;
  *rounding = 8.0 * fabs(by / by_root) * (fabs(turn) + fabs(factor) * (fabs(x) + fabs(y)));
  return by / by_root * (turn + factor * (x - y));
}

/* E/K by the arithmetic-geometric mean. */
static rot_dd complete_ratio(rot_dd m1) {
  rot_dd a = one, g = rot_dd_sqrt(m1), sum = rot_dd_ldexp(rot_dd_sub(one, m1), -1);
  for (int i = 0; i < 30 && fabs(a.hi - g.hi) > 0x1p-54 * a.hi; i++) {
    const rot_dd c = rot_dd_ldexp(rot_dd_sub(a, g), -1), mean = rot_dd_ldexp(rot_dd_add(a, g), -1);
    sum = rot_dd_add(sum, rot_dd_ldexp(square(c), i));
    g = rot_dd_sqrt(rot_dd_mul(a, g));
    a = mean;
  }
  return rot_dd_sub(one, sum);
}

/* Mean of 1/(1 - n sn^2), n = 1 - p, for small p, where the sum of rot_jacobi_mean() cancels: 1 +
 * pi/(2 K) sqrt(n/(p (n - m))) (1 - Lambda0), Heuman's function of the angle with the sine x =
 * sqrt(p/m1) (Abramowitz & Stegun 17.7.14). */
static rot_dd mean_of_peaks(const rot_jacobi *jacobi, rot_dd m1, rot_dd p) {
  enum { TERMS = 13 };
  static const rot_dd half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  const rot_dd n = rot_dd_sub(one, p);
  if (!(p.hi < 1e-3 * m1.hi)) {
    return rot_dd_add(one, rot_dd_mul(n, rot_jacobi_mean(m1, p)));
  }
  const rot_dd y = rot_dd_div(p, m1), x = rot_dd_sqrt(y);
  rot_dd c[TERMS], first = none, third = none, power = one;
  c[0] = one;
  for (int k = 1; k < TERMS; k++) {
    c[k] = rot_dd_div(rot_dd_mul1(c[k - 1], 2.0 * k - 1.0), (rot_dd){2.0 * k, 0.0});
  }
  for (int k = 0; k < TERMS; k++) { /* series of 1/sqrt((1 - y)(1 - m1 y)) */
    rot_dd a = none;
    for (int j = k; j >= 0; j--) a = rot_dd_add(rot_dd_mul(a, m1), rot_dd_mul(c[k - j], c[j]));
    a = rot_dd_mul(a, power);
    first = rot_dd_add(first, rot_dd_div(a, (rot_dd){2.0 * k + 1.0, 0.0}));
    third = rot_dd_add(third, rot_dd_div(a, (rot_dd){2.0 * k + 3.0, 0.0}));
    power = rot_dd_mul(power, y);
  }
  /* F and (F - E)/m1 of the angle, divided by x */
  third = rot_dd_mul(third, y);
  const rot_dd inside = rot_dd_sub(rot_dd_mul(complete_ratio(m1), first), rot_dd_mul(m1, third));
  const rot_dd rest = rot_dd_sub(rot_dd_div(half_pi, jacobi->k), rot_dd_mul(x, inside));
  const rot_dd peak = rot_dd_sqrt(rot_dd_div(n, rot_dd_mul(p, rot_dd_sub(m1, p))));
  return rot_dd_add(one, rot_dd_mul(peak, rest));
}

/* Sets up an angle with the rate even + g/(1 + part sn^2), whole = 1 + part. Large part (next to
 * the lower pole): the integral is an arc tangent plus another integral of the third kind (DLMF
 * 19.7(iii)). */
static void begin_angle(const setup *s, const rot_jacobi *jacobi, rot_dd even, rot_dd g,
                        rot_dd part, rot_dd whole, rot_top_angle *out) {
  rot_dd rate = none;
  out->g = g.hi;
  out->part = part.hi;
  out->whole = whole.hi;
  if (g.hi != 0.0 && part.hi < 0.0) {
    const rot_dd mean = mean_of_peaks(jacobi, s->m1, whole);
    rate = rot_dd_mul(g, mean);
    out->j = rot_dd_div(rot_dd_sub(one, mean), part).hi;
  } else if (g.hi != 0.0 && part.hi <= 1.0) {
    const rot_dd mean = rot_jacobi_mean(s->m1, whole);
    rate = rot_dd_mul(g, rot_dd_sub(one, rot_dd_mul(part, mean)));
    out->j = mean.hi;
  } else if (g.hi != 0.0) {
    const rot_dd m_part = rot_dd_add(s->m, part);
    const rot_dd sigma = rot_dd_sqrt(rot_dd_div(rot_dd_mul(whole, m_part), part));
    const rot_dd slope = rot_dd_sqrt(rot_dd_div(rot_dd_mul(part, m_part), whole));
    const rot_dd n = rot_dd_div(m_part, whole);
    const rot_dd mean =
        s->m1.hi > 0.0 ? mean_of_peaks(jacobi, s->m1, rot_dd_div(s->m1, whole)) : one;
    const rot_dd first = rot_dd_mul(rot_dd_div(s->m1, sigma), mean);
    rate = rot_dd_mul(rot_dd_div(g, sigma), rot_dd_add(first, rot_dd_div(s->m, slope)));
    out->j = rot_dd_div(rot_dd_sub(mean, one), n).hi;
    out->near[0] = slope.hi;
    out->near[1] = s->m1.hi * n.hi / sigma.hi;
    out->near[2] = sigma.hi;
  }
  out->rate = rot_dd_add(even, rate);
  out->size = fabs(even.hi) + fabs(rate.hi);
}

/* Sum and difference of phi and psi from the constants. */
static void begin_angles(const setup *s, rot_dd spin, rot_top_motion *out) {
  const rot_dd bottom = rot_dd_add(s->below, s->swing); /* 1 + u2 */
  const rot_dd top = rot_dd_add(s->above, s->swing);    /* 1 - u1 */
  if (out->steady) {
    const rot_dd up = s->plus.hi != 0.0 ? rot_dd_div(s->plus, s->up) : none;
    const rot_dd down = s->minus.hi != 0.0 ? rot_dd_div(s->minus, s->down) : none;
    begin_angle(s, &out->jacobi, rot_dd_add(spin, up), none, none, one, &out->sum);
    begin_angle(s, &out->jacobi, rot_dd_sub(down, spin), none, none, one, &out->difference);
    return;
  }
  if (s->plus.hi != 0.0) {
    const rot_dd part = rot_dd_div(s->swing, s->below);
    begin_angle(s, &out->jacobi, spin, rot_dd_div(s->plus, s->below), part,
                rot_dd_div(bottom, s->below), &out->sum);
  } else {
    begin_angle(s, &out->jacobi, spin, none, none, one, &out->sum);
  }
  if (s->minus.hi != 0.0) {
    const rot_dd part = rot_dd_neg(rot_dd_div(s->swing, top));
    begin_angle(s, &out->jacobi, rot_dd_neg(spin), rot_dd_div(s->minus, top), part,
                rot_dd_div(s->above, top), &out->difference);
  } else {
    begin_angle(s, &out->jacobi, rot_dd_neg(spin), none, none, one, &out->difference);
  }
}

/* Steady rate beside the vertical, the slow one: r^2 u - a r + beta/2 = 0. NaN: unstable. */
static double slow_precession(const setup *s) {
  const rot_dd twice_beta = twice(s->up.hi > s->down.hi ? s->beta : rot_dd_neg(s->beta));
  const rot_dd disc = rot_dd_sub(square(s->a), twice_beta);
  if (!(disc.hi >= 0.0)) return NAN;
  return s->beta.hi / (s->a.hi + copysign(root(disc).hi, s->a.hi));
}

/* Mean of phi' = (turning + a swing cn^2)/((1 - u)(1 + u)), turning that of the highest point. A
 * small swing: as the sum of the means over 1 - u and 1 + u, in which the spin does not cancel. */
static double mean_precession(const setup *s, const rot_top_motion *m) {
  if (m->steady && (s->down.hi == 0.0 || s->up.hi == 0.0)) return slow_precession(s);
  if (m->steady) return rot_dd_div(s->turning, rot_dd_mul(s->down, s->up)).hi;
  if (s->swing.hi > s->above.hi || s->swing.hi > s->below.hi) {
    return 0.5 * rot_dd_add(m->sum.rate, m->difference.rate).hi;
  }
  const rot_dd turning = rot_dd_sub(s->turning, rot_dd_mul(s->a, s->x[1]));
  const rot_dd by[2] = {rot_dd_add(s->above, s->swing), s->below}; /* 1 - u, 1 + u at the lowest */
  const rot_dd high[2] = {s->above, rot_dd_add(s->below, s->swing)};
  rot_dd sum = none;
  for (int i = 0; i < 2; i++) {
    const rot_dd whole = rot_dd_div(high[i], by[i]), mean = rot_jacobi_mean(s->m1, whole);
    const rot_dd of_one = rot_dd_sub(one, rot_dd_mul(rot_dd_sub(whole, one), mean));
    const rot_dd of_cn2 = rot_dd_sub(one, rot_dd_mul(whole, mean));
    const rot_dd part =
        rot_dd_add(rot_dd_mul(turning, of_one), rot_dd_mul(rot_dd_mul(s->a, s->swing), of_cn2));
    sum = rot_dd_add(sum, rot_dd_div(part, by[i]));
  }
  return 0.5 * sum.hi;
}

/* ---- set-up ---------------------------------------------------------------------------------- */

/* Half angles at the start. At a pole one of them is undetermined: take that of the motion leaving
 * the pole. */
static void begin_halves(const setup *s, rot_top_motion *out) {
  const double q[4] = {s->q[0].hi, s->q[1].hi, s->q[2].hi, s->q[3].hi};
  const double w1 = s->omega[0].hi, w2 = s->omega[1].hi;
  double a[2] = {q[0], q[3]}, b[2] = {q[1], q[2]};
  if (b[0] == 0.0 && b[1] == 0.0) { /* upright: leaves with cn < 0 */
    b[0] = -(a[0] * w1 - a[1] * w2);
    b[1] = -(a[0] * w2 + a[1] * w1);
  }
  if (a[0] == 0.0 && a[1] == 0.0) { /* upside down: leaves with sn > 0 */
    a[0] = -(b[0] * w1 + b[1] * w2);
    a[1] = -(b[1] * w1 - b[0] * w2);
  }
  const double la = hypot(a[0], a[1]), lb = hypot(b[0], b[1]);
  for (int i = 0; i < 2; i++) {
    out->sum0[i] = la > 0.0 ? a[i] / la : 1.0 - i;
    out->difference0[i] = lb > 0.0 ? b[i] / lb : 1.0 - i;
  }
}

/* Set-up of a motion with nutation: elliptic functions, argument and angles at the start. */
static void begin_moving(setup *s, rot_dd spin, rot_top_motion *out) {
  double sn, cn, dn;
  find_zeros(s);
  find_range(s);
  const double width = s->x[2].hi - s->x[0].hi;
  out->steady = !(s->swing.hi > 0.0) ||
                (s->rise.hi == 0.0 && s->x[1].hi == 0.0 && !(s->x[2].hi > 0.0) && s->x[0].hi < 0.0);
  if (s->rise.hi == 0.0 && s->x[0].hi == 0.0 && !(s->x[1].hi > 0.0)) out->steady = 1;
  out->above = s->above.hi;
  out->below = s->below.hi;
  out->swing = s->swing.hi;
  if (out->steady) out->nutates = sqrt(fmax(s->beta.hi * s->x[2].hi, 0.0));
  if (!out->steady) rot_jacobi_begin(s->m1, &out->jacobi);
  begin_angles(s, spin, out);
  begin_halves(s, out);
  out->precession = mean_precession(s, out);
  if (out->steady) return;
  out->lambda = rot_dd_ldexp(rot_dd_sqrt(rot_dd_mul(s->beta, rot_dd_sub(s->x[2], s->x[0]))), -1);
  const double sn0 = sqrt(-s->x[0].hi / s->swing.hi), cn0 = sqrt(s->x[1].hi / s->swing.hi);
  const double dn0 = sqrt(s->x[2].hi / width);
  out->start =
      rot_jacobi_argument(&out->jacobi, s->rise.hi < 0.0 ? -sn0 : sn0, cn0, dn0, &out->start_error);
  if (s->below.hi == 0.0 && s->rise.hi < 0.0) { /* cos(theta/2) has the sign of sn */
    for (int i = 0; i < 2; i++) out->sum0[i] = -out->sum0[i];
  }
  const double gap = s->x[2].hi - s->x[1].hi;
  const double far = s->x[2].hi / gap;
  out->m1_loss = gap > 0.0
                     ? 32.0 * ROT_DD_EPS * (1.0 + far * far) * (1.0 + fabs(s->x[2].hi) / width)
                     : ROT_DD_EPS;
  rot_jacobi_at(&out->jacobi, out->start, &sn, &cn, &dn);
  out->sum.start = swing_of(out, &out->sum, out->start.hi, sn, cn, dn, &out->sum.rounding);
  out->difference.start =
      swing_of(out, &out->difference, out->start.hi, sn, cn, dn, &out->difference.rounding);
}

/* Largest ratio of the rates to that of gravity, power of two: beta is at least 2^-200 of the
 * squares of the rates. */
enum { MAX_RATIO = 100 };

/* => exponent of the unit of time: of the largest rate; *half: of that of gravity, sqrt(G/I1). */
static int exponent_of(double i1, double weight, double wheels, double omega, int *half) {
  int e_moment, e_own, e;
  (void)frexp(i1, &e_moment);
  (void)frexp(weight, &e_own);
  const int e_beta = e_own - e_moment;
  e = *half = (e_beta >= 0 ? e_beta + 1 : e_beta) / 2;
  (void)frexp(omega, &e_own);
  if (omega != 0.0 && e_own > e) e = e_own;
  (void)frexp(wheels, &e_own);
  return wheels != 0.0 && e_own - e_moment + 1 > e ? e_own - e_moment + 1 : e;
}

int rot_top_excess(double i1, double weight, double wheels, double omega) {
  int half;
  if (weight == 0.0) return 0;
  const int e = exponent_of(i1, weight, wheels, omega, &half);
  return e - half > MAX_RATIO ? e - half - MAX_RATIO : 0;
}

/* (moments, weight, constants) => motion: unit of time, zeros of u'^2, kind of motion. */
static rot_status begin_scaled(double i1, double i3, rot_dd weight, setup *s, rot_top_motion *out) {
  int e_ratio, e_beta, half;
  const double fastest =
      fmax(fabs(s->omega[0].hi), fmax(fabs(s->omega[1].hi), fabs(s->omega[2].hi)));
  const int e = exponent_of(i1, weight.hi, s->wheels.hi, fastest, &half);
  const rot_dd ratio = i3 > 0.0 ? quotient((rot_dd){i3, 0.0}, i1, &e_ratio) : none;
  const rot_dd moments = i3 > 0.0 ? rot_dd_ldexp(ratio, e_ratio) : none;
  const rot_dd beta = quotient(rot_dd_abs(weight), i1, &e_beta);
  int e_wheels = 0;
  rot_dd wheels = none;
  if (s->wheels.hi != 0.0) {
    int e_own, e_moment;
    const double moment = frexp(i1, &e_moment);
    (void)frexp(s->wheels.hi, &e_own);
    wheels = rot_dd_div(rot_dd_ldexp(s->wheels, -e_own), (rot_dd){moment, 0.0});
    e_wheels = e_own - e_moment;
  }
  if (e - half > MAX_RATIO) return ROT_ERANGE;
  out->exponent = e;
  s->beta = rot_dd_ldexp(beta, 1 + e_beta - 2 * e);
  for (int i = 0; i < 3; i++) s->omega[i] = rot_dd_ldexp(s->omega[i], -e);
  s->a = rot_dd_mul(moments, s->omega[2]);
  if (wheels.hi != 0.0) s->a = rot_dd_add(s->a, rot_dd_ldexp(wheels, e_wheels - e));
  const rot_dd spin = rot_dd_sub(s->omega[2], s->a);
  const rot_dd *q = s->q, *w = s->omega;
  s->down = twice(rot_dd_add(square(q[1]), square(q[2])));
  s->up = twice(rot_dd_add(square(q[0]), square(q[3])));
  const rot_dd z1 = twice(rot_dd_sub(rot_dd_mul(q[1], q[3]), rot_dd_mul(q[0], q[2])));
  const rot_dd z2 = twice(rot_dd_add(rot_dd_mul(q[2], q[3]), rot_dd_mul(q[0], q[1])));
  s->turning = rot_dd_add(rot_dd_mul(w[0], z1), rot_dd_mul(w[1], z2));
  s->rise = rot_dd_sub(rot_dd_mul(w[1], z1), rot_dd_mul(w[0], z2));
  s->minus = rot_dd_sub(s->turning, rot_dd_mul(s->a, s->down));
  s->plus = rot_dd_add(s->turning, rot_dd_mul(s->a, s->up));
  out->omega3 = w[2].hi;
  out->spin = spin.hi;
  out->pull = 0.5 * s->beta.hi;
  out->b_minus_a = s->minus.hi;
  out->b_plus_a = s->plus.hi;
  begin_moving(s, spin, out);
  const double across = rot_dd_add(square(w[0]), square(w[1])).hi;
  const double high = out->steady ? across : across + s->beta.hi * s->up.hi;
  out->rate = sqrt(high + w[2].hi * w[2].hi);
  if (wheels.hi != 0.0) out->rate += fabs(ldexp(wheels.hi, e_wheels - e));
  return ROT_OK;
}

rot_status rot_top_begin(double i1, double i3, double weight, const rot_top_start *start,
                         double given, rot_top_motion *out) {
  return rot_top_begin_wheels(i1, i3, (rot_dd){weight, 0.0}, none, start, given, out);
}

/* Checks the domain; reverses axes 2 and 3 if G < 0; free motion if G = 0. */
rot_status rot_top_begin_wheels(double i1, double i3, rot_dd weight, rot_dd wheels,
                                const rot_top_start *start, double given, rot_top_motion *out) {
  setup s;
  memset(&s, 0, sizeof s);
  memset(out, 0, sizeof *out);
  memcpy(s.q, start->q, sizeof s.q);
  memcpy(s.omega, start->omega, sizeof s.omega);
  out->given = given;
  int good = i1 > 0.0 && i3 >= 0.0 && isfinite(i1) && finite_dd(weight) && i3 / i1 < 2.0 + 1e-9 &&
             finite_dd(wheels) && (wheels.hi == 0.0 || weight.hi != 0.0);
  for (int i = 0; i < 4; i++) good = good && finite_dd(s.q[i]);
  for (int i = 0; i < 3; i++) good = good && finite_dd(s.omega[i]);
  if (!good || !unit(s.q)) return ROT_EVALUE;
  for (int i = 0; i < 4; i++) out->q0[i] = s.q[i].hi;
  for (int i = 0; i < 3; i++) out->omega0[i] = s.omega[i].hi;
  out->cosine = out->q0[0] * out->q0[0] + out->q0[3] * out->q0[3] -
                (out->q0[1] * out->q0[1] + out->q0[2] * out->q0[2]);
  if (weight.hi == 0.0) {
    const double moment[3] = {i1, i1, i3};
    out->weightless = 1;
    out->precession = NAN;
    return rot_free_begin(moment, out->omega0, given, &out->free);
  }
  out->hangs = weight.hi < 0.0;
  if (out->hangs) turn_over(s.q, s.omega);
  s.wheels = out->hangs ? rot_dd_neg(wheels) : wheels;
  return begin_scaled(i1, i3, weight, &s, out);
}

/* Difference of the rates. Motions passing a pole on different sides differ by whole turns per
 * nutation: not counted. */
static double rate_gap(rot_dd a, rot_dd b, double period) {
  const double rate = rot_dd_sub(a, b).hi;
  return isfinite(period) && period > 0.0 ? fabs(remainder(rate * period, 2.0 * pi)) / period
                                          : fabs(rate);
}

void rot_top_differ(rot_top_motion *m, const rot_top_motion *other) {
  if (m->weightless || other->weightless) return;
  const int both = !m->steady && !other->steady;
  const double by = ldexp(1.0, other->exponent - m->exponent);
  rot_top_motion o = *other; /* converted to the unit of time of m */
  o.sum.rate = rot_dd_mul1(o.sum.rate, by);
  o.difference.rate = rot_dd_mul1(o.difference.rate, by);
  const double period = m->steady ? INFINITY : 2.0 * m->jacobi.k.hi / m->lambda.hi;
  m->sum_error += rate_gap(o.sum.rate, m->sum.rate, period);
  m->difference_error += rate_gap(o.difference.rate, m->difference.rate, period);
  if (!both) return;
  m->lambda_error += fabs(rot_dd_sub(rot_dd_mul1(o.lambda, by), m->lambda).hi);
  if (m->jacobi.m1 == 0.0 && o.jacobi.m1 == 0.0) return;
  m->k_error += fabs(rot_dd_sub(o.jacobi.k, m->jacobi.k).hi);
}

/* ---- the motion ------------------------------------------------------------------------------ */

/* (cosine, sine) rotated by half of an angle. */
static void turned(const double from[2], double angle, double to[2]) {
  const double c = cos(0.5 * angle), s = sin(0.5 * angle);
  to[0] = from[0] * c - from[1] * s;
  to[1] = from[0] * s + from[1] * c;
}

/* State of theta. */
typedef struct tilt {
  double up, down;         /* cos(theta/2), sin(theta/2), one of them negative beyond a pole */
  double rate, precession; /* theta', phi' sin(theta) */
} tilt;

static tilt tilt_now(const rot_top_motion *m, double sn, double cn, double dn) {
  tilt now;
  const double low = m->below + m->swing * sn * sn, high = m->above + m->swing * cn * cn;
  const double size = sqrt(0.5 * m->swing), lambda = m->lambda.hi;
  now.up = m->below == 0.0 ? size * sn : sqrt(0.5 * low);
  now.down = m->above == 0.0 ? size * cn : sqrt(0.5 * high);
  const double sn_up = m->below == 0.0 ? 1.0 / size : sn / now.up;
  const double cn_down = m->above == 0.0 ? 1.0 / size : cn / now.down;
  now.rate = -m->swing * lambda * dn * sn_up * cn_down;
  now.precession = (m->b_plus_a == 0.0 ? 0.0 : m->b_plus_a * now.down / (2.0 * now.up)) +
                   (m->b_minus_a == 0.0 ? 0.0 : m->b_minus_a * now.up / (2.0 * now.down));
  return now;
}

/* Steady motion: theta of the start. */
static tilt tilt_steady(const rot_top_motion *m) {
  const double down = hypot(m->hangs ? m->q0[0] : m->q0[1], m->hangs ? m->q0[3] : m->q0[2]);
  const double up = hypot(m->hangs ? m->q0[1] : m->q0[0], m->hangs ? m->q0[2] : m->q0[3]);
  const tilt now = {up, down, 0.0,
                    (up > 0.0 ? m->b_plus_a * down / (2.0 * up) : 0.0) +
                        (down > 0.0 ? m->b_minus_a * up / (2.0 * down) : 0.0)};
  return now;
}

/* (theta, sum, difference) => attitude, angular velocity. */
static void put_state(const rot_top_motion *m, const tilt *now, double sum, double difference,
                      rot_top_state *out) {
  double s[2], d[2];
  turned(m->sum0, sum, s);
  turned(m->difference0, difference, d);
  double *q = out->q, *w = out->omega;
  q[0] = now->up * s[0];
  q[1] = now->down * d[0];
  q[2] = now->down * d[1];
  q[3] = now->up * s[1];
  /* w1 + i w2 = exp(-i psi) (theta' + i phi' sin(theta)), -psi = (difference - sum)/2 */
  const double c = d[0] * s[0] + d[1] * s[1], e = d[1] * s[0] - d[0] * s[1];
  w[0] = c * now->rate - e * now->precession;
  w[1] = e * now->rate + c * now->precession;
  w[2] = m->omega3;
  if (m->hangs) {
    const double p[4] = {q[1], -q[0], -q[3], q[2]};
    memcpy(q, p, sizeof p);
    w[1] = -w[1];
    w[2] = -w[2];
  }
  (void)rot_attitude_unit(q);
  for (int i = 0; i < 3; i++) w[i] = rot_ldexp(w[i], m->exponent);
}

/* Deviation of the rate of an angle from its mean. *width: reduced to the width of the peak of the
 * rate, in the argument. */
static double unsteadiness(const rot_top_angle *angle, double even, double sn, double *width) {
  const double whole = angle->part < 0.0 ? angle->whole : 1.0 / angle->whole;
  *width = fmin(*width, sqrt(whole));
  return angle->g / (1.0 + angle->part * sn * sn) + (even - angle->rate.hi);
}

/* Error bounds of the state, from errors of the argument, the rates and the functions. sn: of the
 * argument; depth: its distance from the nearer of 0 and K. */
static void judge(const rot_top_motion *m, rot_dd t, double u, double turns, double sn,
                  double depth, const tilt *now, double rounding, rot_top_state *out) {
  const double time = fabs(t.hi), m1 = m->jacobi.m1, up = fabs(now->up), down = fabs(now->down);
  const double mean = fabs(m->sum.rate.hi * up) + fabs(m->difference.rate.hi * down);
  const double even = m->sum.size * up + m->difference.size * down;
  const double q = 16.0 * ROT_EPS + ROT_EPS * rounding +
                   (16.0 * ROT_DD_EPS + 8.0 * m->given) * time * (even + m->rate) +
                   time * (m->sum_error * up + m->difference_error * down);
  /* The rate along the axis is exact. */
  const double across = hypot(now->rate, now->precession);
  const double psi = time * (m->sum_error + m->difference_error);
  const double known =
      2.0 * m->rate * (q - time * (m->sum_error * up + m->difference_error * down)) + across * psi;
  double turn = 0.0, speed = 0.0; /* due to the error of the argument */
  double plane = INFINITY;        /* error of the rate of a plane motion */
  if (!m->steady) {
    const double modulus = m->m1_loss + m->given * (m1 > 0.0 ? 16.0 / m1 : 16.0);
    double width = 1e-3, du = m->start_error + 8.0 * (ROT_DD_EPS + m->given) * fabs(u) +
                              (fabs(turns) + 1.0) * fmin(modulus, 1.0) + time * m->lambda_error +
                              2.0 * (fabs(turns) + 1.0) * m->k_error;
    if (m1 == 0.0) du += ROT_DD_EPS * fmin(cosh(u) * cosh(u), 1e300);
    const double sum = unsteadiness(&m->sum, m->spin, sn, &width);
    const double difference = unsteadiness(&m->difference, -m->spin, sn, &width);
    const int small = du < 1e-3 * width;
    const double slope = fabs(now->rate) + fabs(sum) * up + fabs(difference) * down;
    const double pull = across * (m->rate + fabs(m->sum.rate.hi) + fabs(m->difference.rate.hi));
    const double by = du / m->lambda.hi, any = 1.5 * (m->rate + mean);
    turn = by * (small ? fmin(any, 1.1 * slope + du * any) : any);
    speed =
        by * (small ? fmin(2.0 * m->rate * any, 1.1 * (pull + m->pull) + 2.0 * m->rate * du * any)
                    : 2.0 * m->rate * any);
    /* In a plane, where u'' is the torque, digits do not cancel: close to the top all are small. */
    if (small && m->spin == 0.0 && m->b_minus_a == 0.0 && m->b_plus_a == 0.0) {
      plane = 32.0 * ROT_EPS * (1.0 + depth) * fabs(now->rate) + 2.4 * by * m->pull * up * down;
    }
  }
  out->q_error = fmin(q + turn, pi);
  const double any = 16.0 * ROT_EPS * m->rate + fmin(known + speed, 4.0 * m->rate);
  out->omega_error = rot_ldexp(fmin(any, plane), m->exponent);
}

static void free_at(const rot_top_motion *m, rot_dd t, rot_top_state *out) {
  rot_free_state state;
  rot_free_at(&m->free, t, &state);
  rot_attitude_times(m->q0, state.q, out->q);
  memcpy(out->omega, state.omega, sizeof out->omega);
  out->q_error = state.q_error + 4.0 * ROT_EPS;
  out->omega_error = state.omega_error;
}

/* Reduces the argument to |u| <= K, evaluates theta and both angles. */
void rot_top_at(const rot_top_motion *m, rot_dd t, rot_top_state *out) {
  if (m->weightless) {
    free_at(m, t, out);
    return;
  }
  const rot_dd now = rot_dd_ldexp(t, m->exponent);
  if (!(fabs(now.hi) < 1e250)) { /* all digits of the angles are lost */
    memcpy(out->q, m->q0, sizeof out->q);
    memcpy(out->omega, m->omega0, sizeof out->omega);
    out->q_error = pi;
    out->omega_error = ldexp(2.0 * m->rate, m->exponent);
    return;
  }
  double sum = rot_dd_less_double_turns(rot_dd_mul(m->sum.rate, now)).hi;
  double difference = rot_dd_less_double_turns(rot_dd_mul(m->difference.rate, now)).hi;
  if (m->steady) {
    const tilt still = tilt_steady(m);
    put_state(m, &still, sum, difference, out);
    judge(m, now, 0.0, 0.0, 0.0, 0.0, &still, 0.0, out);
    return;
  }
  const rot_dd u = rot_dd_add(rot_dd_mul(m->lambda, now), m->start);
  rot_dd r = u;
  int quarter;
  const double turns = rot_jacobi_reduce(&m->jacobi, &r, &quarter);
  double sn, cn, dn, rounding[2];
  rot_jacobi_at(&m->jacobi, r, &sn, &cn, &dn);
  sum += swing_of(m, &m->sum, r.hi, sn, cn, dn, &rounding[0]) - m->sum.start;
  difference += swing_of(m, &m->difference, r.hi, sn, cn, dn, &rounding[1]) - m->difference.start;
  if (quarter % 2) {
    sn = -sn;
    cn = -cn;
  }
  const tilt tilted = tilt_now(m, sn, cn, dn);
  put_state(m, &tilted, sum, difference, out);
  const double depth = fmin(fabs(r.hi), m->jacobi.k.hi - fabs(r.hi));
  judge(m, now, u.hi, turns, sn, depth, &tilted,
        (rounding[0] + m->sum.rounding) * fabs(tilted.up) +
            (rounding[1] + m->difference.rounding) * fabs(tilted.down),
        out);
}

/* ---- answers --------------------------------------------------------------------------------- */

rot_top_nutation rot_top_nutates(const rot_top_motion *m) {
  const double *q = m->q0;
  const double start = 2.0 * atan2(hypot(q[1], q[2]), hypot(q[0], q[3]));
  rot_top_nutation out = {INFINITY, m->cosine, m->cosine, start, 0.0, NAN};
  if (m->weightless) return out;
  out.precession_rad_per_s = ldexp(m->precession, m->exponent);
  if (m->steady && m->nutates > 0.0) out.period_s = ldexp(2.0 * pi / m->nutates, -m->exponent);
  if (m->steady) return out;
  const double flip = m->hangs ? -1.0 : 1.0;
  const double low = m->below < 1.0 ? m->below - 1.0 : 1.0 - (m->above + m->swing);
  const double high = m->above < 1.0 ? 1.0 - m->above : m->below + m->swing - 1.0;
  out.lowest_cosine = flip > 0.0 ? low : -high;
  out.highest_cosine = flip > 0.0 ? high : -low;
  const double period = 2.0 * m->jacobi.k.hi / m->lambda.hi;
  out.period_s = ldexp(period, -m->exponent);
  /* Cosines and sines of half the angles at the lowest and the highest u. */
  const double low_c = sqrt(0.5 * m->below), low_s = sqrt(0.5 * (m->above + m->swing));
  const double high_c = sqrt(0.5 * (m->below + m->swing)), high_s = sqrt(0.5 * m->above);
  out.lowest_rad = 2.0 * (flip > 0.0 ? atan2(low_s, low_c) : atan2(low_c, low_s));
  out.amplitude_rad =
      atan2(0.5 * m->swing / (low_s * high_c + low_c * high_s), low_c * high_c + low_s * high_s);
  return out;
}

void rot_top_steady(double i1, double i3, double weight, double cosine, double omega3, double *slow,
                    double *fast) {
  int e1, e3, eg, ec, ew;
  const double m1 = frexp(i1, &e1), m3 = frexp(i3, &e3), mg = frexp(weight, &eg);
  const double mc = frexp(cosine, &ec), mw = frexp(omega3, &ew);
  const int e_product = e1 + eg + ec + 2, half = (e_product >= 0 ? e_product + 1 : e_product) / 2;
  const int e = e3 + ew > half || cosine == 0.0 || weight == 0.0 ? e3 + ew : half;
  const rot_dd spin = rot_dd_ldexp(rot_dd_mul2(m3, mw), e3 + ew - e);
  const rot_dd product = rot_dd_ldexp(rot_dd_mul1(rot_dd_mul2(m1, mg), mc), e_product - 2 * e);
  const rot_dd disc = rot_dd_sub(square(spin), product);
  *slow = *fast = NAN;
  if (!(disc.hi >= 0.0)) return;
  const double part = rot_dd_add1(spin, copysign(root(disc).hi, spin.hi)).hi;
  if (part != 0.0) *slow = ldexp(2.0 * mg / part, eg - e);
  if (cosine != 0.0) *fast = ldexp(part / (2.0 * m1 * mc), e - e1 - ec);
}
