#include "scene/free/gyrostat_motion.h"

#include <math.h>
#include <string.h>

#include "maths/attitude.h"
#include "ground/dd_trig.h"

static const rot_dd none = {0.0, 0.0};
static const rot_dd one = {1.0, 0.0};
static const double pi = 0x1.921fb54442d18p+1;

static rot_dd twice(rot_dd x) { return rot_dd_ldexp(x, 1); }
static rot_dd square(rot_dd x) { return rot_dd_mul(x, x); }

/* ---- the turning points ---------------------------------------------------------------------- */

/* c + 2 b x + a x^2; c >= 0: its value at the start x = 0. */
typedef struct polynomial {
  rot_dd a, b, c;
} polynomial;

typedef struct bounds {
  int is_low, is_high;
  rot_dd low, high;
} bounds;

static void bound(rot_dd x, int at_zero_low, bounds *out) {
  const int low = x.hi < 0.0 || (x.hi == 0.0 && at_zero_low);
  if (!isfinite(x.hi)) return;
  if (low && (!out->is_low || x.hi > out->low.hi)) out->is_low = 1, out->low = x;
  if (!low && (!out->is_high || x.hi < out->high.hi)) out->is_high = 1, out->high = x;
}

/* polynomial => its closest zeros on both sides of the start. */
static bounds zeros_of(const polynomial *p) {
  bounds out = {0, 0, none, none};
  const rot_dd disc = rot_dd_sub(square(p->b), rot_dd_mul(p->a, p->c));
  if (disc.hi < 0.0) return out;
  const rot_dd root = rot_dd_sqrt(disc);
  const rot_dd q = p->b.hi >= 0.0 ? rot_dd_add(p->b, root) : rot_dd_sub(p->b, root);
  /* a zero at the start is the lower end if the polynomial increases, else the upper end */
  const int begins = p->b.hi > 0.0;
  if (q.hi != 0.0) bound(rot_dd_neg(rot_dd_div(p->c, q)), begins, &out);
  if (p->a.hi != 0.0) bound(rot_dd_neg(rot_dd_div(q, p->a)), begins, &out);
  return out;
}

static rot_dd value_at(const polynomial *p, rot_dd x) {
  return rot_dd_add(p->c, rot_dd_mul(x, rot_dd_add(twice(p->b), rot_dd_mul(p->a, x))));
}

/* Cofactor of x - at, at a zero: 2 b + a (x + at). */
static rot_dd factor_at(const polynomial *p, rot_dd at, rot_dd x) {
  return rot_dd_add(twice(p->b), rot_dd_mul(p->a, rot_dd_add(x, at)));
}

/* ---- set-up ---------------------------------------------------------------------------------- */

/* Data that determine the rates of a motion. */
typedef struct given {
  rot_dd moment[3], omega[3], h;
} given;

typedef struct rates {
  rot_dd lambda, psi;        /* rate of the argument, mean rate of psi */
  rot_dd m1, k;              /* m1 = 1 - m of 0 < m < 1 */
  rot_dd start_sn, start_cn; /* sn, cn of A at the start */
} rates;

/* data => turning points, rates, constants of psi. ROT_OK or ROT_ERANGE. */
static rot_status find_rates(const given *in, rot_gyrostat_motion *g, rates *out) {
  const rot_dd *m = in->moment, *w = in->omega;
  const rot_dd l1 = rot_dd_mul(m[0], w[0]), l2 = rot_dd_mul(m[1], w[1]);
  const rot_dd z0 = rot_dd_add(rot_dd_mul(m[2], w[2]), in->h);
  const rot_dd total = rot_dd_sqrt(rot_dd_add(rot_dd_add(square(l1), square(l2)), square(z0)));
  const rot_dd d = rot_dd_div(rot_dd_sub(m[0], m[1]), rot_dd_mul(m[0], m[1]));
  polynomial p[2];
  bounds ends[2];
  /* L1^2 and L2^2 relative to the start: differences of moments are exact */
  for (int k = 0; k < 2; k++) {
    const rot_dd other = m[1 - k];
    const rot_dd b = rot_dd_sub(rot_dd_div(z0, other), w[2]);
    const rot_dd a = rot_dd_div(rot_dd_sub(m[2], other), rot_dd_mul(other, m[2]));
    p[k].c = square(k ? l2 : l1);
    p[k].b = rot_dd_div(k ? b : rot_dd_neg(b), d);
    p[k].a = rot_dd_div(k ? a : rot_dd_neg(a), d);
    ends[k] = zeros_of(&p[k]);
  }
  if (!(ends[0].is_low || ends[1].is_low) || !(ends[0].is_high || ends[1].is_high)) {
    return ROT_ERANGE;
  }
  const int low = !ends[0].is_low || (ends[1].is_low && ends[1].low.hi > ends[0].low.hi);
  const int high = !ends[0].is_high || (ends[1].is_high && ends[1].high.hi < ends[0].high.hi);
  const rot_dd x1 = ends[low].low, x2 = ends[high].high, span = rot_dd_sub(x2, x1);
  rot_dd at1, at2, m1, k4;
  if (low != high) {
    const rot_dd f1 = factor_at(&p[low], x1, x1), f2 = factor_at(&p[low], x1, x2);
    const rot_dd g1 = rot_dd_neg(factor_at(&p[high], x2, x1));
    const rot_dd g2 = rot_dd_neg(factor_at(&p[high], x2, x2));
    if (!(f1.hi > 0.0 && f2.hi > 0.0 && g1.hi > 0.0 && g2.hi > 0.0)) return ROT_ERANGE;
    const rot_dd u = rot_dd_sqrt(rot_dd_mul(f1, g2)), v = rot_dd_sqrt(rot_dd_mul(f2, g1));
    at1 = rot_dd_mul(f1, g1);
    at2 = rot_dd_mul(f2, g2);
    m1 = rot_dd_ldexp(rot_dd_div(square(rot_dd_add(u, v)), rot_dd_mul(u, v)), -2);
    g->low1 = f1.hi, g->low2 = f2.hi, g->high1 = g1.hi, g->high2 = g2.hi;
    g->root = sqrt(span.hi);
  } else {
    const polynomial *other = &p[1 - low];
    const rot_dd v1 = value_at(other, x1), v2 = value_at(other, x2);
    const rot_dd lead = rot_dd_neg(p[low].a);
    if (!(v1.hi > 0.0 && v2.hi > 0.0 && lead.hi > 0.0)) return ROT_ERANGE;
    const rot_dd u = rot_dd_sqrt(v1), v = rot_dd_sqrt(v2);
    const rot_dd both = rot_dd_sub(square(rot_dd_add(u, v)), rot_dd_mul(other->a, square(span)));
    at1 = rot_dd_mul(lead, v1);
    at2 = rot_dd_mul(lead, v2);
    m1 = rot_dd_ldexp(rot_dd_div(both, rot_dd_mul(u, v)), -2);
    g->root = sqrt(lead.hi) * span.hi;
    g->low1 = sqrt(sqrt(v1.hi * v2.hi));
  }
  if (!(m1.hi > 1e-280 && m1.hi < 1e280)) return ROT_ERANGE;
  k4 = rot_dd_div(at1, at2);
  const rot_dd k2 = rot_dd_sqrt(k4), k = rot_dd_sqrt(k2);
  rot_dd lambda = rot_dd_mul(rot_dd_abs(d), rot_dd_sqrt(rot_dd_sqrt(rot_dd_mul(at1, at2))));
  const rot_dd rate = lambda; /* of am */
  g->negative = rot_dd_sub(m1, one).hi > 0.0;
  if (g->negative) {
    lambda = rot_dd_mul(lambda, rot_dd_sqrt(m1));
    m1 = rot_dd_div(one, m1);
  }
  /* psi' = N/D, both linear in x */
  const rot_dd slope = rot_dd_div(in->h, m[2]), by = rot_dd_div(total, m[2]);
  const rot_dd lw =
      rot_dd_add(rot_dd_add(rot_dd_mul(l1, w[0]), rot_dd_mul(l2, w[1])), rot_dd_mul(z0, w[2]));
  const rot_dd z1 = rot_dd_add(z0, x1), z2 = rot_dd_add(z0, x2);
  const double up = fmin(rot_dd_add(total, z1).hi, rot_dd_add(total, z2).hi);
  const double down = fmin(rot_dd_sub(total, z1).hi, rot_dd_sub(total, z2).hi);
  const int away = up >= down;
  const rot_dd gw = rot_dd_mul(total, away ? w[2] : rot_dd_neg(w[2]));
  const rot_dd n0 = rot_dd_add(lw, gw), dn = rot_dd_add(slope, away ? by : rot_dd_neg(by));
  const rot_dd n1 = rot_dd_add(n0, rot_dd_mul(x1, dn));
  const rot_dd n2 = rot_dd_mul(k2, rot_dd_add(n0, rot_dd_mul(x2, dn)));
  const rot_dd d1 = away ? rot_dd_add(total, z1) : rot_dd_sub(total, z1);
  const rot_dd d2 = away ? rot_dd_add(total, z2) : rot_dd_sub(total, z2);
  if (!(fmin(d1.hi, d2.hi) > 1e-12 * total.hi)) return ROT_ERANGE;
  const rot_dd kd2 = rot_dd_mul(k2, d2), sum = rot_dd_add(d1, kd2);
  const rot_dd eta = rot_dd_div(rot_dd_sub(d1, kd2), sum);
  const rot_dd a0 = rot_dd_div(rot_dd_add(n1, n2), sum), a1 = rot_dd_div(rot_dd_sub(n1, n2), sum);
  const rot_dd e = rot_dd_sub(a1, rot_dd_mul(a0, eta));
  const rot_dd left = rot_dd_div(rot_dd_ldexp(rot_dd_mul(d1, kd2), 2), square(sum)); /* 1 - eta^2 */
  rot_dd p1 = rot_dd_div(one, left); /* 1 + nu, nu = eta^2/(1 - eta^2) */
  if (g->negative) p1 = rot_dd_mul(p1, m1);
  const rot_dd swing = rot_dd_div(rot_dd_mul(e, eta), left);
  const rot_dd mean = rot_jacobi_mean(m1, p1);
  const rot_dd even = rot_dd_sub(one, rot_dd_mul(p1, mean)); /* mean of cn^2/(1 + nu sn^2) */
  out->psi = rot_dd_sub(a0, rot_dd_mul(swing, even));
  out->lambda = lambda;
  out->m1 = m1;
  out->k = k;
  const rot_dd kx2 = rot_dd_mul(k2, x2), all = rot_dd_sub(kx2, x1);
  out->start_cn = rot_dd_div(rot_dd_add(kx2, x1), all);
  out->start_sn =
      rot_dd_div(rot_dd_mul(twice(k), rot_dd_sqrt(rot_dd_mul(rot_dd_neg(x1), x2))), all);
  const double part = g->negative ? sqrt(m1.hi) : 1.0;
  g->low = low, g->high = high;
  g->momentum = total.hi;
  g->x1 = x1.hi, g->x2 = x2.hi;
  g->k = k.hi, g->square = k2.hi;
  g->root_m1 = sqrt(m1.hi);
  g->direction = away ? 1.0 : -1.0;
  g->d1 = d1.hi, g->d2 = d2.hi;
  /* e/(1 - eta^2) times the integral of cn/(1 + nu sn^2), plus the third kind */
  const rot_dd of_m = rot_dd_sub(one, m1);
  g->nu = g->negative ? rot_dd_sub(rot_dd_mul(rot_dd_div(square(eta), left), m1), of_m).hi
                      : rot_dd_div(square(eta), left).hi;
  const double g2 = g->negative ? g->nu : rot_dd_add(rot_dd_div(square(eta), left), of_m).hi;
  g->turn = part * e.hi / left.hi / rate.hi;
  g->turn_root = g2;
  g->swing = part * swing.hi * p1.hi / rate.hi;
  g->mean = mean.hi;
  return ROT_OK;
}

/* ---- the motion ------------------------------------------------------------------------------ */

typedef struct phase {
  double turns;          /* removed multiples of 2 K */
  double r, s, c, d;     /* reduced argument; its sn, cn, dn */
  double sn, cn, dn;     /* of the full argument */
  double half_c, half_s; /* cosine and sine of A/2 */
} phase;

static void phase_at(const rot_gyrostat_motion *g, rot_dd u, phase *out) {
  rot_dd r = u;
  int n;
  out->turns = rot_jacobi_reduce(&g->jacobi, &r, &n);
  out->r = r.hi;
  rot_jacobi_at(&g->jacobi, r, &out->s, &out->c, &out->d);
  const double sn = g->negative ? g->root_m1 * out->s / out->d : out->s;
  const double cn = g->negative ? out->c / out->d : out->c;
  out->dn = g->negative ? 1.0 / out->d : out->d;
  const double c = sqrt(0.5 * (1.0 + cn)), s = 0.5 * sn / c;
  out->half_c = n == 0 ? c : n == 1 ? -s : n == 2 ? -c : s;
  out->half_s = n == 0 ? s : n == 1 ? c : n == 2 ? -s : -c;
  out->sn = n % 2 ? -sn : sn;
  out->cn = n % 2 ? -cn : cn;
}

/* phase => L1, L2; x; |L| (1 + l.r). */
static void momenta(const rot_gyrostat_motion *g, const phase *at, double l[2], double *x,
                    double *away) {
  const double cc = at->half_c * at->half_c, ss = at->half_s * at->half_s * g->square;
  const double norm = cc + ss, c = at->half_c / sqrt(norm), s = g->k * at->half_s / sqrt(norm);
  const double c2 = cc / norm, s2 = ss / norm;
  *x = g->x1 * c2 + g->x2 * s2;
  *away = g->d1 * c2 + g->d2 * s2;
  if (g->low != g->high) {
    l[g->low] = g->sign_low * g->root * s * sqrt(g->low1 * c2 + g->low2 * s2);
    l[g->high] = g->sign_high * g->root * c * sqrt(g->high1 * c2 + g->high2 * s2);
  } else {
    l[g->low] = g->sign_low * g->root * s * c;
    l[1 - g->low] = g->sign_high * g->low1 * g->k / norm * at->dn;
  }
}

/* phase => periodic parts of psi. */
static double repeats(const rot_gyrostat_motion *g, const phase *at, double *rounding) {
  const double slope = g->negative ? (at->sn < 0.0 ? -fabs(at->s) : fabs(at->s)) : at->sn / at->dn;
  const double root = sqrt(fabs(g->turn_root));
  double turned = slope;
  if (root > 0.0) {
    turned = (g->turn_root > 0.0 ? atan(root * slope) : atanh(root * slope)) / root;
  }
  const double third =
      at->s * at->s * at->s / 3.0 *
      rot_carlson_rj(at->c * at->c, at->d * at->d, 1.0, 1.0 + g->nu * at->s * at->s);
  const double even = g->mean * at->r;
  *rounding = 4.0 * fabs(g->turn * turned) + 8.0 * fabs(g->swing) * (fabs(third) + fabs(even));
  return g->turn * turned + g->swing * (third - even);
}

/* Quaternion of the smallest rotation from L to r. */
static void smallest(const rot_gyrostat_motion *g, const double l[2], double away, double q[4]) {
  q[0] = away;
  q[1] = g->direction * l[1];
  q[2] = -g->direction * l[0];
  q[3] = 0.0;
  (void)rot_attitude_unit(q);
}

static void begin_steady(const given *in, rot_gyrostat_motion *g) {
  rot_dd sum = none;
  g->steady = 1;
  for (int i = 0; i < 3; i++) sum = rot_dd_add(sum, square(in->omega[i]));
  g->rate = rot_dd_sqrt(sum);
  for (int i = 0; i < 3; i++) {
    g->axis[i] = g->rate.hi > 0.0 ? in->omega[i].hi / g->rate.hi : 0.0;
  }
}

/* 1 if L and omega are parallel, else 0. */
static int is_steady(const given *in) {
  rot_dd l[3];
  for (int i = 0; i < 3; i++) l[i] = rot_dd_mul(in->moment[i], in->omega[i]);
  l[2] = rot_dd_add(l[2], in->h);
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const rot_dd cross = rot_dd_sub(rot_dd_mul(l[j], in->omega[k]), rot_dd_mul(l[k], in->omega[j]));
    if (cross.hi != 0.0) return 0;
  }
  return 1;
}

/* Effect of the rounding of the set-up, 2^-102 of each term, on its results: set-ups with data
 * changed by 2^-76. */
static void judge_setup(const given *in, const rates *found, rot_gyrostat_motion *g) {
  static const int signs[4][7] = {{1, -1, 1, 1, -1, 1, -1},
                                  {-1, 1, 1, -1, 1, 1, 1},
                                  {1, 1, -1, 1, 1, -1, 1},
                                  {-1, -1, -1, 1, 1, 1, -1}};
  const double scale = 64.0 * 0x1p-26; /* 64 roundings */
  for (int k = 0; k < 4; k++) {
    rot_gyrostat_motion other = *g;
    given near = *in;
    rates r;
    rot_dd *all[7] = {&near.moment[0], &near.moment[1], &near.moment[2], &near.omega[0],
                      &near.omega[1],  &near.omega[2],  &near.h};
    for (int i = 0; i < 7; i++) {
      *all[i] = rot_dd_mul(*all[i], rot_dd_sum2(1.0, signs[k][i] * 0x1p-76));
    }
    if (find_rates(&near, &other, &r) != ROT_OK || other.low != g->low || other.high != g->high) {
      g->lambda_error = g->psi_error = g->m1_error = INFINITY;
      return;
    }
    const double lambda = fabs(rot_dd_sub(r.lambda, found->lambda).hi / found->lambda.hi);
    const double m1 = fabs(rot_dd_sub(r.m1, found->m1).hi / found->m1.hi);
    g->lambda_error = fmax(g->lambda_error, scale * lambda);
    g->m1_error = fmax(g->m1_error, scale * m1);
    g->psi_error = fmax(g->psi_error, scale * fabs(rot_dd_sub(r.psi, found->psi).hi));
  }
}

/* Steady spin, or rates, signs, argument and attitude at the start. */
rot_status rot_gyrostat_begin(const rot_dd moment[3], const double omega[3], rot_dd h,
                              rot_gyrostat_motion *out) {
  given in = {{moment[0], moment[1], moment[2]}, {none, none, none}, h};
  rates r;
  double l[2], x, away, rounding, min = INFINITY, size = fabs(h.hi);
  phase at;
  memset(out, 0, sizeof *out);
  for (int i = 0; i < 3; i++) {
    in.omega[i].hi = out->omega0[i] = omega[i];
    out->moment[i] = moment[i].hi;
    min = fmin(min, moment[i].hi);
    size += moment[i].hi * fabs(omega[i]);
  }
  out->size = 2.0 * size / min;
  if (is_steady(&in)) {
    begin_steady(&in, out);
    return ROT_OK;
  }
  const rot_status status = find_rates(&in, out, &r);
  if (status != ROT_OK) return status;
  judge_setup(&in, &r, out);
  if (!(fmax(out->lambda_error, fmax(out->m1_error, out->psi_error)) < 1e-20)) return ROT_ERANGE;
  out->lambda = r.lambda;
  out->psi = r.psi;
  rot_jacobi_begin(r.m1, &out->jacobi);
  /* signs: x increases if the product of D, L1 and L2 is positive */
  const double l1 = moment[0].hi * omega[0], l2 = moment[1].hi * omega[1];
  const double direction =
      moment[0].hi > moment[1].hi || (moment[0].hi == moment[1].hi && moment[0].lo > moment[1].lo)
          ? 1.0
          : -1.0;
  const int kept = out->low != out->high ? out->high : 1 - out->low;
  const double lead = kept ? l2 : l1, other = kept ? l1 : l2;
  out->sign_high = lead < 0.0 ? -1.0 : 1.0;
  out->sign_low = direction * out->sign_high;
  const double sense = other * out->sign_low < 0.0 ? -1.0 : 1.0;
  /* the argument at the start */
  double sn = sense * r.start_sn.hi, cn = r.start_cn.hi;
  const double shift = cn < 0.0 ? sense : 0.0, m1 = r.m1.hi;
  if (shift != 0.0) sn = -sn, cn = -cn;
  if (out->negative) {
    const double dn = sqrt(cn * cn + sn * sn / m1);
    out->start = rot_jacobi_argument(&out->jacobi, sn / out->root_m1 / dn, cn / dn, 1.0 / dn,
                                     &out->start_error);
  } else {
    out->start =
        rot_jacobi_argument(&out->jacobi, sn, cn, sqrt(cn * cn + m1 * sn * sn), &out->start_error);
  }
  if (shift != 0.0) {
    out->start = rot_dd_add(out->start, rot_dd_mul1(twice(out->jacobi.k), shift));
  }
  phase_at(out, out->start, &at);
  momenta(out, &at, l, &x, &away);
  out->psi0 = repeats(out, &at, &rounding);
  const double l0[2] = {l1, l2};
  smallest(out, l0, out->momentum + out->direction * (moment[2].hi * omega[2] + h.hi), out->first);
  if (!(out->momentum + out->direction * (moment[2].hi * omega[2] + h.hi) > 0.01 * out->momentum)) {
    smallest(out, l, away, out->first);
  }
  for (int i = 1; i < 4; i++) out->first[i] = -out->first[i];
  return ROT_OK;
}

/* Reduces the argument, evaluates L, psi and their errors. */
void rot_gyrostat_at(const rot_gyrostat_motion *g, rot_dd t, double q[4], double omega[3],
                     double *q_error, double *omega_error) {
  for (int i = 0; i < 3; i++) omega[i] = g->omega0[i];
  *omega_error = 0.0;
  if (g->steady) {
    const rot_dd turned = rot_dd_mul(g->rate, t);
    const double half = 0.5 * rot_dd_less_double_turns(turned).hi;
    q[0] = cos(half);
    for (int i = 0; i < 3; i++) q[1 + i] = sin(half) * g->axis[i];
    *q_error = fmin(12.0 * ROT_EPS + 8.0 * ROT_DD_EPS * fabs(turned.hi), pi);
    return;
  }
  const rot_dd u = rot_dd_add(rot_dd_mul(g->lambda, t), g->start);
  const rot_dd turned = rot_dd_mul(g->psi, t);
  double l[2], x, away, rounding;
  phase at;
  phase_at(g, u, &at);
  momenta(g, &at, l, &x, &away);
  smallest(g, l, away, q);
  const double psi = rot_dd_less_double_turns(turned).hi + (repeats(g, &at, &rounding) - g->psi0);
  const double turn[4] = {cos(0.5 * psi), 0.0, 0.0, g->direction * sin(0.5 * psi)};
  rot_attitude_times(turn, q, q);
  rot_attitude_times(g->first, q, q);
  (void)rot_attitude_unit(q);
  omega[0] = l[0] / g->moment[0];
  omega[1] = l[1] / g->moment[1];
  omega[2] = g->omega0[2] + x / g->moment[2];
  const double du = g->start_error + fabs(u.hi) * (8.0 * ROT_DD_EPS + g->lambda_error) +
                    (fabs(at.turns) + 1.0) * (g->m1_error + 16.0 * ROT_DD_EPS);
  /* Effect of an error of the argument on q (without the rotation about L) and on omega. */
  const double z = g->direction * (away - g->momentum), lz[3] = {l[0], l[1], z};
  double tilt = 0.0, slope = 0.0;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    tilt = hypot(tilt, omega[i] - g->psi.hi * lz[i] / g->momentum);
    slope = hypot(slope, (lz[j] * omega[k] - lz[k] * omega[j]) / g->moment[i]);
  }
  if (!(du < 1e-3)) tilt = g->size + fabs(g->psi.hi), slope = g->size;
  const double by_u = 1.1 * du * tilt / g->lambda.hi;
  const double by_psi =
      fabs(t.hi) * (g->psi_error + 8.0 * ROT_DD_EPS * fabs(g->psi.hi)) + 2.0 * ROT_EPS * rounding;
  *q_error = fmin(24.0 * ROT_EPS + by_u + by_psi, pi);
  *omega_error = 16.0 * ROT_EPS * g->size + fmin(1.1 * du * slope / g->lambda.hi, 2.0 * g->size);
}
