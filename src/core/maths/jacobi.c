#include "maths/jacobi.h"

#include <float.h>
#include <math.h>

/* K = pi/(2 M(1, sqrt(m1))). The steps of the mean M are stored for the descent to sn, cn, dn. */
void rot_jacobi_begin(rot_dd m1, rot_jacobi *out) {
  static const rot_dd half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  rot_dd a = {1.0, 0.0}, g = rot_dd_sqrt(m1);
  out->m1 = m1.hi;
  out->n = 0;
  out->a[0] = 1.0;
  out->g[0] = g.hi;
  if (!(m1.hi > 0.0)) {
    out->k = (rot_dd){m1.hi == 0.0 ? INFINITY : NAN, 0.0};
    return;
  }
  /* At 2^-56 the last a is accurate enough for the functions; one more mean gives K to 2^-113. */
  for (int known = 0; !known && out->n < 22;) {
    known = fabs(a.hi - g.hi) < 0x1p-56 * a.hi;
    const rot_dd mean = rot_dd_half(rot_dd_add(a, g));
    g = rot_dd_sqrt(rot_dd_mul(a, g));
    a = mean;
    if (known) break;
    out->n++;
    out->a[out->n] = a.hi;
    out->g[out->n] = g.hi;
  }
  out->k = rot_dd_div(half_pi, a);
}

void rot_jacobi_begin_far(rot_dd root, double halvings, rot_jacobi *out) {
  static const rot_dd log2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  rot_jacobi_begin(rot_dd_mul(root, root), out);
  out->k = rot_dd_add(out->k, rot_dd_mul1(log2, halvings));
  out->n = -1;
  out->m1 = fmax(16.0 * exp(-2.0 * out->k.hi), DBL_MIN);
  out->g[0] = 4.0 * exp(-out->k.hi);
}

double rot_jacobi_reduce(const rot_jacobi *jacobi, rot_dd *u, int *quarter) {
  const rot_dd period = rot_dd_add(jacobi->k, jacobi->k);
  double turns = 0.0, rest = 0.0;
  /* Twice: the first quotient is rounded and may leave more than K. */
  for (int i = 0; i < 2; i++) {
    if (!(fabs(u->hi) > jacobi->k.hi)) break;
    const double n = nearbyint(u->hi / period.hi);
    *u = rot_dd_sub(*u, rot_dd_mul1(period, n));
    turns += n;
    rest += fmod(n, 4.0);
  }
  *quarter = (int)fmod(rest + 8.0, 4.0);
  return turns;
}

/* m1 = 0: the separatrix. */
static void hyperbolic(double u, double *sn, double *cn, double *dn) {
  *sn = tanh(u);
  *cn = *dn = 1.0 / cosh(u);
}

/* u => sn, cn, dn for m1 below 2^-100. Near K, cn = k' sinh(K - u) and dn = k' cosh(K - u),
 * k' = 4 exp(-K). */
static void far_at(const rot_jacobi *jacobi, rot_dd u, double *sn, double *cn, double *dn) {
  const rot_dd x = rot_dd_abs(u), beyond = rot_dd_sub(jacobi->k, x);
  if (x.hi < beyond.hi) {
    hyperbolic(x.hi, sn, cn, dn);
  } else {
    *sn = 1.0;
    *cn = -2.0 * exp(-x.hi) * expm1(-2.0 * beyond.hi);
    *dn = 2.0 * exp(-x.hi) * (1.0 + exp(-2.0 * beyond.hi));
  }
  if (u.hi < 0.0) *sn = -*sn;
}

/* u => cn/sn, dn by Bulirsch's descent: y = cn/sn and d = dn at each level have positive terms
 * only, so small values are relatively accurate for u <= K/2. The recursion of the phase (an arc
 * sine at each level) loses cn and dn near K: error 7e-9 for m1 < 1e-16. */
static void descend(const rot_jacobi *jacobi, rot_dd u, double *y_out, double *d_out) {
  const double x = jacobi->a[jacobi->n] * u.hi;
  double y = jacobi->a[jacobi->n] * cos(x) / sin(x), d = 1.0;
  for (int i = jacobi->n - 1; i >= 0; i--) {
    const double p = y * y / jacobi->a[i + 1];
    y *= d;
    d = (jacobi->g[i] + p) / (jacobi->a[i] + p);
  }
  const double one = 1.0 + y * y;
  *y_out = y - d * one * u.lo;
  *d_out = d - (1.0 - jacobi->m1) * (y / one) * u.lo;
}

void rot_jacobi_at(const rot_jacobi *jacobi, rot_dd u, double *sn, double *cn, double *dn) {
  const rot_dd x = rot_dd_abs(u), beyond = rot_dd_sub(jacobi->k, x);
  const int far = beyond.hi < x.hi; /* nearer to K than to 0: u = K - w */
  const rot_dd w = far ? rot_dd_abs(beyond) : x;
  double y, d;
  if (jacobi->n < 0) {
    far_at(jacobi, u, sn, cn, dn);
    return;
  }
  if (jacobi->m1 == 0.0) {
    hyperbolic(x.hi, sn, cn, dn);
  } else if (w.hi < 1e-8 && !far) { /* the next terms are below 2^-53 */
    *sn = w.hi;
    *cn = 1.0 - 0.5 * w.hi * w.hi;
    *dn = 1.0 - 0.5 * (1.0 - jacobi->m1) * w.hi * w.hi;
  } else {
    if (w.hi < 1e-8) {
      y = 1.0 / w.hi;
      d = 1.0 - 0.5 * (1.0 - jacobi->m1) * w.hi * w.hi;
    } else {
      descend(jacobi, w, &y, &d);
    }
    if (far) { /* cs(K - w) = k' sc(w), dn(K - w) = k' nd(w) */
      y = beyond.hi < 0.0 ? -jacobi->g[0] / y : jacobi->g[0] / y;
      d = jacobi->g[0] / d;
    }
    *sn = 1.0 / sqrt(1.0 + y * y);
    *cn = y * *sn;
    *dn = d;
  }
  if (u.hi < 0.0) *sn = -*sn;
}

/* Duplication until the three differ by less than 0.003, then the series to order 7 in their
 * deviations (DLMF 19.36.1): its next term is below 2^-58. */
double rot_carlson_rf(double x, double y, double z) {
  double mean, dx, dy, dz;
  for (int i = 0; i < 600; i++) {
    mean = (x + y + z) / 3.0;
    dx = 1.0 - x / mean;
    dy = 1.0 - y / mean;
    dz = -(dx + dy);
    if (!(fmax(fmax(fabs(dx), fabs(dy)), fabs(dz)) > 0.003)) break;
    const double sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), l = sx * (sy + sz) + sy * sz;
    x = 0.25 * (x + l);
    y = 0.25 * (y + l);
    z = 0.25 * (z + l);
  }
  mean = (x + y + z) / 3.0;
  dx = 1.0 - x / mean;
  dy = 1.0 - y / mean;
  dz = -(dx + dy);
  const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0 -
          5.0 * e2 * e2 * e2 / 208.0 + 3.0 * e3 * e3 / 104.0) /
         sqrt(mean);
}

/* R_C(1, 1 + e), e > -1. */
static double carlson_rc(double e) {
  if (e > 0.01) {
    const double root = sqrt(e);
    return atan(root) / root;
  }
  if (e < -0.01) {
    const double root = sqrt(-e);
    return atanh(root) / root;
  }
  double sum = 0.0;
  for (int k = 8; k >= 0; k--) sum = 1.0 / (2.0 * k + 1.0) - e * sum;
  return sum;
}

/* Carlson, Numer. Algorithms 10 (1995) 13: duplication, then the series to order 7 in the
 * deviations (DLMF 19.36.2), whose next term is below 2^-54. */
double rot_carlson_rj(double x, double y, double z, double p) {
  const double delta = (p - x) * (p - y) * (p - z);
  double part = 1.0, sum = 0.0, mean;
  for (int i = 0; i < 300; i++, part *= 0.25) {
    mean = 0.2 * (x + y + z + 2.0 * p);
    const double far =
        fmax(fmax(fabs(mean - x), fabs(mean - y)), fmax(fabs(mean - z), fabs(mean - p)));
    if (!(far > 0.008 * mean)) break;
    const double sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), sp = sqrt(p);
    const double l = sx * (sy + sz) + sy * sz, d = (sp + sx) * (sp + sy) * (sp + sz);
    /* Two forms of one number: the first is exact near 0, the second does not underflow. */
    const double e =
        d > 1e-100 ? delta * part * part * part / (d * d)
                   : (sp - sx) / (sp + sx) * ((sp - sy) / (sp + sy)) * ((sp - sz) / (sp + sz));
    sum += part / d * carlson_rc(e);
    x = 0.25 * (x + l);
    y = 0.25 * (y + l);
    z = 0.25 * (z + l);
    p = 0.25 * (p + l);
  }
  mean = 0.2 * (x + y + z + 2.0 * p);
  const double dx = 1.0 - x / mean, dy = 1.0 - y / mean, dz = 1.0 - z / mean;
  const double dp = -0.5 * (dx + dy + dz), xyz = dx * dy * dz, p2 = dp * dp;
  const double e2 = dx * dy + dx * dz + dy * dz - 3.0 * p2;
  const double e3 = xyz + 2.0 * e2 * dp + 4.0 * p2 * dp;
  const double e4 = (2.0 * xyz + e2 * dp + 3.0 * p2 * dp) * dp, e5 = xyz * p2;
  const double series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 -
                        9.0 * e2 * e3 / 52.0 + 3.0 * e5 / 26.0 - e2 * e2 * e2 / 16.0 +
                        3.0 * e3 * e3 / 40.0 + 3.0 * e2 * e4 / 20.0 + 45.0 * e2 * e2 * e3 / 272.0 -
                        9.0 * (e3 * e4 + e2 * e5) / 68.0;
  return part * series / (mean * sqrt(mean)) + 6.0 * sum;
}

/* Arithmetic-geometric mean (DLMF 19.8.5 to 19.8.7): no term cancels. */
rot_dd rot_jacobi_mean(rot_dd m1, rot_dd p) {
  const rot_dd one = {1.0, 0.0};
  if (!(m1.hi > 0.0)) return rot_dd_div(one, p);
  rot_dd a = one, g = rot_dd_sqrt(m1), r = rot_dd_sqrt(p), q = one, sum = one;
  for (int i = 0; i < 30; i++) {
    const rot_dd square = rot_dd_mul(r, r), ag = rot_dd_mul(a, g), both = rot_dd_add(square, ag);
    q = rot_dd_half(rot_dd_div(rot_dd_mul(q, rot_dd_sub(square, ag)), both));
    sum = rot_dd_add(sum, q);
    if (fabs(q.hi) < 0x1p-104 * fabs(sum.hi) && fabs(a.hi - g.hi) < 0x1p-40 * a.hi) break;
    r = rot_dd_half(rot_dd_div(both, r));
    a = rot_dd_half(rot_dd_add(a, g));
    g = rot_dd_sqrt(ag);
  }
  return rot_dd_half(rot_dd_div(sum, p));
}

/* => u = sn R_F(cn^2, dn^2, 1), sn >= 0 */
static double argument(double sn, double cn, double dn) {
  const double size = hypot(sn, cn);
  const double s = sn / size, c = cn / size;
  return s * rot_carlson_rf(c * c, dn * dn, 1.0);
}

rot_dd rot_jacobi_argument(const rot_jacobi *jacobi, double sn, double cn, double dn,
                           double *error) {
  const double s = fabs(sn), k1 = jacobi->g[0];
  rot_dd u = {0.0, 0.0};
  if (jacobi->m1 == 0.0) {
    u.hi = asinh(s / cn);
    *error = 8.0 * ROT_EPS * (1.0 + u.hi);
  } else {
    u.hi = argument(s, cn, dn);
    *error = 8.0 * ROT_EPS * u.hi;
    /* sn(K - u) = cn/dn, cn(K - u) = k' sn/dn, dn(K - u) = k'/dn */
    if (u.hi > 0.5 * jacobi->k.hi) {
      const double w = argument(cn / dn, k1 * (s / dn), k1 / dn);
      u = rot_dd_add1(jacobi->k, -w);
      *error = 8.0 * ROT_EPS * w;
    }
  }
  return sn < 0.0 ? rot_dd_neg(u) : u;
}
