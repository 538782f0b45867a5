#define ROT_ALONE /* formulas of the lanes, for one body */

#include "scene/free/motion.h"

#include <math.h>

#include "maths/attitude.h"
#include "scene/free/kernel.h"
#include "ground/dd_trig.h"

static const rot_dd none = {0.0, 0.0};
static const double pi = 0x1.921fb54442d18p+1;
static const double tiny = 1e-140; /* relative to the rate: squares do not underflow */

/* ---- set-up ---------------------------------------------------------------------------------- */

/* Sorts the moments, ascending. An odd permutation reverses the middle axis: right-handed axes. */
static void sort_axes(const double moment[3], rot_free_motion *out) {
  int *k = out->order, odd = 0;
  for (int i = 0; i < 3; i++) {
    k[i] = i;
    out->sign[i] = 1.0;
  }
  for (int i = 0; i < 3; i++) {
    const int at = i == 1; /* compare 0-1, 1-2, 0-1 */
    if (moment[k[at]] > moment[k[at + 1]]) {
      const int first = k[at];
      k[at] = k[at + 1];
      k[at + 1] = first;
      odd = !odd;
    }
  }
  if (odd) out->sign[1] = -1.0;
}

static double largest_of(const double x[3]) {
  return fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
}

static rot_dd square(rot_dd x) { return rot_dd_mul(x, x); }

static rot_dd difference(double a, double b) { return rot_dd_sum2(a, -b); }

/* a (a - b) w^2, a >= b; *exact = 0 if a product was rounded. */
static rot_dd term(double a, rot_dd by, double w, int *exact) {
  const rot_dd first = rot_dd_mul1(by, a), second = rot_dd_mul2(w, w);
  const rot_dd out = rot_dd_mul(first, second);
  if (by.lo != 0.0 || first.lo != 0.0 || second.lo != 0.0 || out.lo != 0.0) *exact = 0;
  return out;
}

static void begin_steady(const double w[3], rot_free_motion *out) {
  rot_dd sum = none;
  out->steady = 1;
  for (int i = 0; i < 3; i++) sum = rot_dd_add(sum, rot_dd_mul2(w[i], w[i]));
  out->psi = rot_dd_sqrt(sum);
  for (int i = 0; i < 3; i++) out->axis[i] = w[i] / out->psi.hi;
}

/* (cosine >= 0, sine) of an angle => those of its half. */
static void half(double cosine, double sine, double *c, double *s) {
  *c = sqrt(0.5 * (1.0 + cosine));
  *s = sine / (2.0 * *c);
}

static void turn_by_quarters(int quarters, double *c, double *s) {
  static const double root = 0x1.6a09e667f3bcdp-1;
  static const double cosine[8] = {1.0, root, 0.0, -root, -1.0, -root, 0.0, root};
  const int k = ((quarters % 8) + 8) % 8;
  const double x = cosine[k], y = cosine[(k + 6) % 8], c0 = *c;
  *c = c0 * x - *s * y;
  *s = c0 * y + *s * x;
}

/* Half of the angle chi about the reference axis z and of the angle theta from L to z, for L with
 * (l_x, l_y) = rho (sin chi, cos chi). chi is an offset plus an angle in [-pi/2, pi/2]: continuous,
 * with the offset of the component that keeps its sign. */
static void angles_of(const rot_free_motion *m, const double l[3], double *cos_theta,
                      double *sin_theta, double *cos_chi, double *sin_chi) {
  const int x = (m->r + 1) % 3, y = (m->r + 2) % 3, lead = m->lead;
  const int other = lead == x ? y : x;
  const double rho = hypot(l[x], l[y]), side = m->amplitude[lead] < 0.0 ? -1.0 : 1.0;
  half(l[m->r] / m->momentum, rho / m->momentum, cos_theta, sin_theta);
  half(fabs(l[lead]) / rho, (lead == x ? -side : side) * l[other] / rho, cos_chi, sin_chi);
}

/* Constants of a motion that is not steady. Close to the middle axis the other two rates are scaled
 * before squaring. */
typedef struct constants {
  double near[3];              /* sorted rates, the first and the third times 2^halvings */
  int halvings;                /* >= 0 */
  int far;                     /* 1: m1 < 2^-112 */
  rot_dd root;                 /* far: root of m1, scaled for rot_jacobi_begin_far() */
  double root_halvings;        /* far: binary exponent of that scale */
  rot_dd momentum, p, r;       /* L, 2 T I3 - L^2, L^2 - 2 T I1 */
  rot_dd largest_o, largest_c; /* squares of the largest I omega along o and c */
  rot_dd m, m1;
} constants;

/* rot_jacobi_mean(m1, p). For tiny m1 it is (1 - arc/K)/p, with the arc of any small m1. */
static rot_dd mean_of(const constants *k, rot_dd p, rot_free_motion *out) {
  const rot_dd one = {1.0, 0.0};
  rot_jacobi near;
  if (!k->far) return rot_jacobi_mean(k->m1, p);
  const rot_dd m1 = square(k->root);
  rot_jacobi_begin(m1, &near);
  const rot_dd rest = rot_dd_sub(one, rot_dd_mul(p, rot_jacobi_mean(m1, p)));
  const rot_dd slope = rot_dd_div(rot_dd_mul(rest, near.k), out->jacobi.k);
  out->near_mean = slope.hi;
  return rot_dd_div(rot_dd_sub(one, slope), p);
}

/* psi' = L/I_lead - g sn^2/(1 + nu sn^2). Reference axis: o or c, the one along which L has the
 * smaller maximum: L is at least 45 degrees from it, nu <= 1. In terms of L/I of the reference
 * axis, two large terms would cancel for a thin rod. */
static void begin_psi(const constants *k, rot_dd away, rot_free_motion *out) {
  const rot_dd one = {1.0, 0.0};
  const int by_o = k->largest_o.hi <= k->largest_c.hi;
  out->r = by_o ? out->o : out->c;
  out->lead = by_o ? out->c : out->o;
  const rot_dd nu = by_o ? rot_dd_div(k->largest_o, k->largest_c)
                         : rot_dd_div(rot_dd_mul(k->m, k->largest_c), k->largest_o);
  const rot_dd lead = {out->moment[out->lead], 0.0}, one_nu = rot_dd_add(one, nu);
  const rot_dd m_nu = rot_dd_add(k->m, nu);
  const rot_dd inverses = rot_dd_div(away, rot_dd_mul1(lead, out->moment[1]));
  const rot_dd g = rot_dd_mul(rot_dd_mul(k->momentum, inverses), by_o ? m_nu : one_nu);
  const rot_dd mean = mean_of(k, one_nu, out), even = rot_dd_div(k->momentum, lead);
  const rot_dd gj = rot_dd_mul(g, mean);
  out->psi = rot_dd_sub(even, gj);
  out->psi_size = even.hi + fabs(gj.hi);
  out->nu = nu.hi;
  out->g = g.hi;
  out->mean = mean.hi;
  out->near = k->m1.hi < 0.1;
  if (out->near && k->m1.hi > 0.0 && !k->far) { /* mean of sn^2/(1 - sn^2 (m + nu)/(1 + nu)) */
    const rot_dd small = rot_dd_div(k->m1, one_nu);
    const rot_dd part = rot_dd_sub(rot_dd_sub(one, rot_dd_mul(m_nu, mean)), small);
    out->near_mean = rot_dd_div(part, rot_dd_mul(small, rot_dd_div(m_nu, one_nu))).hi;
  }
}

/* Periodic part of psi at |u| <= K: -g times (integral of sn^2/(1 + nu sn^2) minus its mean). Close
 * to the separatrix K is large and both would cancel: there the integral is an arc tangent plus
 * another of the third kind, with the factor m1. *rounding: error in units of ROT_EPS. */
static double swing_of_psi(const rot_free_motion *m, double u, double sn, double cn, double dn,
                           double *rounding) {
  const double by = m->g / m->lambda.hi, nu = m->nu;
  if (!m->near) {
    const double x = sn * sn * sn / 3.0 * rot_carlson_rj(cn * cn, dn * dn, 1.0, 1.0 + nu * sn * sn);
    *rounding = 8.0 * fabs(by) * (fabs(x) + fabs(u * m->mean));
    return -by * (x - u * m->mean);
  }
  const double m1 = m->jacobi.m1, root = sqrt(nu * (1.0 - m1 + nu) / (1.0 + nu));
  const int far = m->jacobi.n < 0;
  const double slope = m1 > 0.0 && !far ? sn * (cn / dn) : sn;
  const double turn = root > 0.0 ? atan(root * slope) / root : slope;
  double x = 0.0, y = 0.0;
  if (far) {
    y = u * m->near_mean;
  } else if (m1 > 0.0) {
    const double p = (dn * dn + nu * cn * cn) / (1.0 + nu);
    x = m1 / (1.0 + nu) * (sn * sn * sn / 3.0 * rot_carlson_rj(cn * cn, dn * dn, 1.0, p));
    y = m1 / (1.0 + nu) * (u * m->near_mean);
  }
  *rounding = 8.0 * fabs(by) * (fabs(turn) + fabs(x) + fabs(y));
  return by / (1.0 + nu) * (turn + (x - y));
}

static double root_of(rot_dd x) { return rot_dd_sqrt(x).hi; }

/* Amplitudes, argument and angles at the start. */
static void begin_tumbling(const double w[3], const constants *k, rot_dd dcm,
                           rot_free_motion *out) {
  const double *moment = out->moment;
  const int o = out->o, c = out->c;
  const rot_dd x = o == 0 ? k->p : k->r, y = o == 0 ? k->r : k->p;
  const rot_dd dco = difference(moment[2], moment[0]);
  const double side = k->near[o] < 0.0 ? -1.0 : 1.0, direction = k->near[c] < 0.0 ? -1.0 : 1.0;
  out->amplitude[o] = side * root_of(rot_dd_div(x, rot_dd_mul1(dco, moment[o])));
  out->amplitude[c] = direction * root_of(rot_dd_div(y, rot_dd_mul1(dco, moment[c])));
  out->amplitude[1] = side * direction * root_of(rot_dd_div(x, rot_dd_mul1(dcm, moment[1])));
  if (k->far) {
    rot_jacobi_begin_far(k->root, k->root_halvings, &out->jacobi);
  } else {
    rot_jacobi_begin(k->m1, &out->jacobi);
  }
  const int by_o = k->largest_o.hi <= k->largest_c.hi, lead = by_o ? c : o;
  begin_psi(k, lead == 0 ? difference(moment[1], moment[0]) : difference(moment[1], moment[2]),
            out);
  if (k->far) { /* relative to K: cn = k' sinh(K - u), scaled */
    const double size =
        ldexp(k->near[o] / out->amplitude[o] / k->root.hi, (int)k->root_halvings - k->halvings);
    const double before = asinh(size);
    out->start = rot_dd_add1(out->jacobi.k, -before);
    if (w[1] / out->amplitude[1] < 0.0) out->start = rot_dd_neg(out->start);
    out->start_error = 8.0 * ROT_EPS * (1.0 + before);
  } else {
    out->start =
        rot_jacobi_argument(&out->jacobi, w[1] / out->amplitude[1], w[o] / out->amplitude[o],
                            w[c] / out->amplitude[c], &out->start_error);
  }
  /* turns of chi: if o leads, chi increases or decreases by pi for each 2 K */
  const int is_x = lead == (out->r + 1) % 3;
  out->quarter =
      is_x ? (out->amplitude[lead] < 0.0 ? -1 : 1) : (out->amplitude[lead] < 0.0 ? 2 : 0);
  out->turns = lead == c ? 0 : is_x ? (direction < 0.0 ? 1 : -1) : (direction < 0.0 ? -1 : 1);
  double l[3], ct, st, cc, sc, sn, cn, dn;
  for (int i = 0; i < 3; i++) l[i] = moment[i] * w[i];
  angles_of(out, l, &ct, &st, &cc, &sc);
  turn_by_quarters(out->quarter, &cc, &sc);
  rot_free_to_z(1.0, 0.0, ct, st, cc, sc, out->first);
  for (int i = 1; i < 4; i++) out->first[i] = -out->first[i];
  rot_jacobi_at(&out->jacobi, out->start, &sn, &cn, &dn);
  out->swing0 = swing_of_psi(out, out->start.hi, sn, cn, dn, &out->swing0_rounding);
}

/* (m1 times 4^halvings) => modulus. Returns 0 if m1 is too small, else 1. */
static int begin_modulus(rot_dd m1, constants *k) {
  int e = 0;
  if (m1.hi != 0.0) (void)frexp(m1.hi, &e);
  k->far = m1.hi > 0.0 && e - 2 * k->halvings < -112;
  if (k->far) {
    if (m1.hi < 1e-240) return 0;
    const int half = 56 + (e >= 0 ? e / 2 : -((1 - e) / 2)); /* then the root is near 2^-56 */
    k->root = rot_dd_sqrt(rot_dd_ldexp(m1, -2 * half));
    k->root_halvings = k->halvings - half;
  }
  k->m1 = rot_dd_ldexp(m1, -2 * k->halvings);
  if (k->m1.hi - 1.0 + k->m1.lo > 0.0) k->m1 = (rot_dd){1.0, 0.0};
  return 1;
}

/* Set-up with moments and rates near 1. */
static rot_status begin_sorted(const double w[3], constants *k, rot_free_motion *out) {
  const double *moment = out->moment;
  const rot_dd d21 = difference(moment[1], moment[0]), d32 = difference(moment[2], moment[1]);
  const rot_dd d31 = difference(moment[2], moment[0]);
  int exact = 1;
  const rot_dd t1 = term(moment[0], d21, k->near[0], &exact);
  const rot_dd t3 = term(moment[2], d32, k->near[2], &exact);
  const rot_dd from = rot_dd_sub(t3, t1); /* L^2 - 2 T I2, times 4^halvings */
  const double loss = 4.0 * ROT_DD_EPS * (t1.hi + t3.hi);
  k->p = rot_dd_add(rot_dd_mul1(rot_dd_mul(d31, rot_dd_mul2(w[0], w[0])), moment[0]),
                    rot_dd_mul1(rot_dd_mul(d32, rot_dd_mul2(w[1], w[1])), moment[1]));
  k->r = rot_dd_add(rot_dd_mul1(rot_dd_mul(d21, rot_dd_mul2(w[1], w[1])), moment[1]),
                    rot_dd_mul1(rot_dd_mul(d31, rot_dd_mul2(w[2], w[2])), moment[2]));
  const int high = from.hi >= 0.0;
  out->c = high ? 2 : 0;
  out->o = high ? 0 : 2;
  const rot_dd x = high ? k->p : k->r, y = high ? k->r : k->p;
  const rot_dd dcm = high ? d32 : d21, dom = high ? d21 : d32;
  const int o = out->o, c = out->c;
  const int on_axis = fmax(fabs(w[o]), fabs(w[1])) < tiny;
  if (!(y.hi > 0.0) || !(dcm.hi > 0.0) || on_axis || (k->near[o] == 0.0 && k->near[c] == 0.0)) {
    begin_steady(w, out);
    return ROT_OK;
  }
  const rot_dd dcmy = rot_dd_mul(dcm, y);
  if (dcmy.hi < 1e-280) return ROT_ERANGE;
  const rot_dd m1 = rot_dd_div(rot_dd_mul(d31, rot_dd_abs(from)), dcmy);
  k->m = rot_dd_div(rot_dd_mul(dom, x), dcmy);
  if (!begin_modulus(m1, k)) return ROT_ERANGE;
  out->m1_loss = from.hi != 0.0 ? loss / fabs(from.hi) + 16.0 * ROT_DD_EPS
                 : exact        ? 0.0
                                : ldexp(loss * d31.hi / dcmy.hi, -2 * k->halvings);
  rot_dd l2 = none;
  for (int i = 0; i < 3; i++) l2 = rot_dd_add(l2, square(rot_dd_mul2(moment[i], w[i])));
  k->momentum = rot_dd_sqrt(l2);
  out->momentum = k->momentum.hi;
  k->largest_o = rot_dd_div(rot_dd_mul1(x, moment[o]), d31);
  k->largest_c = rot_dd_div(rot_dd_mul1(y, moment[c]), d31);
  const rot_dd product = rot_dd_mul1(rot_dd_mul2(moment[0], moment[1]), moment[2]);
  out->lambda = rot_dd_sqrt(rot_dd_div(dcmy, product));
  begin_tumbling(w, k, dcm, out);
  return ROT_OK;
}

/* Scales and sorts; treats rest, rods and steady spins. */
rot_status rot_free_begin(const double moment_kg_m2[3], const double omega_rad_per_s[3],
                          double given, rot_free_motion *out) {
  int scale;
  double w[3];
  *out = (rot_free_motion){0};
  out->given = given;
  for (int i = 0; i < 3; i++) {
    if (!(moment_kg_m2[i] >= 0.0) || !isfinite(moment_kg_m2[i]) || !isfinite(omega_rad_per_s[i])) {
      return ROT_EVALUE;
    }
    out->omega0[i] = omega_rad_per_s[i];
  }
  sort_axes(moment_kg_m2, out);
  (void)frexp(largest_of(moment_kg_m2), &scale);
  (void)frexp(largest_of(omega_rad_per_s), &out->exponent);
  for (int i = 0; i < 3; i++) {
    out->moment[i] = ldexp(moment_kg_m2[out->order[i]], -scale);
    w[i] = out->sign[i] * ldexp(omega_rad_per_s[out->order[i]], -out->exponent);
    out->rate += w[i] * w[i];
  }
  out->rate = sqrt(out->rate);
  if (out->rate == 0.0) {
    out->still = 1;
    return ROT_OK;
  }
  if (out->moment[0] == 0.0) { /* a rod: steady rotation about an axis across it */
    const double gap = out->moment[2] - out->moment[1];
    if (w[0] != 0.0 || gap > 1e-12 * out->moment[2]) return ROT_EVALUE;
    begin_steady(w, out);
    out->given = fmax(given, gap / out->moment[2]);
    return ROT_OK;
  }
  if (out->moment[0] < 1e-100) return ROT_ERANGE;
  constants k = {{w[0], w[1], w[2]}, 0, 0, none, 0.0, none, none, none, none, none, none, none};
  const double a = omega_rad_per_s[out->order[0]], b = omega_rad_per_s[out->order[2]];
  const double max = fmax(fabs(a), fabs(b));
  if (max > 0.0) {
    int e;
    (void)frexp(max, &e);
    if (out->exponent - e > 64) { /* exact, also if w underflows */
      k.halvings = out->exponent - e;
      k.near[0] = ldexp(a, -e);
      k.near[2] = ldexp(b, -e);
    }
  }
  return begin_sorted(w, &k, out);
}

double rot_free_half_period(const rot_free_motion *m) {
  if (m->still || m->steady) return INFINITY;
  return ldexp(2.0 * m->jacobi.k.hi / m->lambda.hi, -m->exponent);
}

/* ---- the motion ------------------------------------------------------------------------------ */

/* Sorted axes => body axes; rates => rad/s. */
static void leave_sorted(const rot_free_motion *m, const double w[3], const double v[3],
                         rot_free_state *out) {
  for (int i = 0; i < 3; i++) {
    out->omega[m->order[i]] = rot_ldexp(m->sign[i] * w[i], m->exponent);
    out->q[1 + m->order[i]] = m->sign[i] * v[i];
  }
}

/* Error of psi in rad. */
static double angle_error(const rot_free_motion *m, rot_dd t, double psi) {
  return 8.0 * ROT_DD_EPS * fabs(psi) + m->given * 8.0 * fabs(t.hi) * m->rate;
}

static void steady_at(const rot_free_motion *m, rot_dd t, rot_free_state *out) {
  const rot_dd turned = rot_dd_mul(m->psi, t), psi = rot_dd_less_double_turns(turned);
  double v[3], w[3];
  for (int i = 0; i < 3; i++) {
    v[i] = sin(0.5 * psi.hi) * m->axis[i];
    w[i] = m->psi.hi * m->axis[i];
  }
  leave_sorted(m, w, v, out);
  out->q[0] = cos(0.5 * psi.hi);
  for (int i = 0; i < 3; i++) out->omega[i] = m->omega0[i];
  out->q_error = 8.0 * ROT_EPS + angle_error(m, t, turned.hi);
  out->omega_error = 0.0;
}

/* Error bounds of the state, from errors of u and of the functions. */
static void judge(const rot_free_motion *m, rot_dd t, rot_dd u, double turns, const double w[3],
                  double sn, double rounding, rot_free_state *out) {
  const double *moment = m->moment, m1 = m->jacobi.m1;
  const double cross[3] = {(moment[2] - moment[1]) * w[1] * w[2],
                           (moment[2] - moment[0]) * w[2] * w[0],
                           (moment[1] - moment[0]) * w[0] * w[1]};
  const double lambda = m->lambda.hi;
  double tilt = 0.0, speed = 0.0, size = 0.0;
  for (int i = 0; i < 3; i++) {
    tilt += cross[i] * cross[i];
    speed += cross[i] / moment[i] * (cross[i] / moment[i]);
    size += w[i] * w[i];
  }
  double du = m->start_error + 8.0 * (ROT_DD_EPS + m->given) * fabs(u.hi);
  const double modulus = m->m1_loss + (m1 > 0.0 ? 16.0 * m->given / m1 : 16.0 * m->given);
  if (m1 > 0.0) {
    du += (fabs(turns) + 1.0) * fmin(modulus, 1.0);
  } else {
    du += modulus * fmin(cosh(u.hi) * cosh(u.hi), 1e300);
  }
  const double part = sn * sn / (1.0 + m->nu * sn * sn) - m->mean;
  const int small = du < 1e-3;
  const double per_u =
      (small ? 1.1 * (sqrt(tilt) / m->momentum + fabs(m->g * part)) : 2.0 * m->rate + fabs(m->g)) /
      lambda;
  const double by_psi = angle_error(m, t, m->psi_size * t.hi) +
                        4.0 * (fabs(turns) + 1.0) * modulus * fabs(m->g / lambda) +
                        ROT_EPS * (rounding + m->swing0_rounding);
  out->q_error = fmin(ROT_EPS * 24.0 + by_psi + per_u * du, pi);
  out->omega_error = rot_ldexp(ROT_EPS * 12.0 * sqrt(size) +
                                   (small ? 1.1 * sqrt(speed) / lambda : 2.0 * m->rate) * du,
                               m->exponent);
}

/* Reduces the argument, evaluates L and psi. */
static void tumbling_at(const rot_free_motion *m, rot_dd t, rot_free_state *out) {
  const rot_dd u = rot_dd_add(rot_dd_mul(m->lambda, t), m->start), turned = rot_dd_mul(m->psi, t);
  double sn, cn, dn, w[3], l[3], ct, st, cc, sc, q[4], v[3];
  rot_dd r = u;
  int quarter;
  const double turns = rot_jacobi_reduce(&m->jacobi, &r, &quarter);
  rot_jacobi_at(&m->jacobi, r, &sn, &cn, &dn);
  w[m->o] = m->amplitude[m->o] * cn;
  w[m->c] = m->amplitude[m->c] * dn;
  w[1] = m->amplitude[1] * sn;
  const double flips = quarter % 2 ? -1.0 : 1.0;
  /* If o leads, the turn by pi for each 2 K includes the change of sign. */
  const double shown = m->r == m->o ? flips : 1.0;
  l[m->o] = shown * m->moment[m->o] * w[m->o];
  l[1] = shown * m->moment[1] * w[1];
  l[m->c] = m->moment[m->c] * w[m->c];
  angles_of(m, l, &ct, &st, &cc, &sc);
  turn_by_quarters(m->quarter + 2 * m->turns * quarter, &cc, &sc);
  double rounding;
  const double swing = swing_of_psi(m, r.hi, sn, cn, dn, &rounding);
  const double psi = rot_dd_less_double_turns(turned).hi + (swing - m->swing0);
  rot_free_to_z(cos(0.5 * psi), sin(0.5 * psi), ct, st, cc, sc, q);
  rot_attitude_times(m->first, q, q);
  (void)rot_attitude_unit(q);
  for (int i = 0; i < 3; i++) v[(m->r + 1 + i) % 3] = q[1 + i];
  w[m->o] *= flips;
  w[1] *= flips;
  judge(m, t, u, turns, w, sn, rounding, out);
  leave_sorted(m, w, v, out);
  out->q[0] = q[0];
}

void rot_free_at(const rot_free_motion *m, rot_dd t, rot_free_state *out) {
  *out =
      (rot_free_state){{1.0, 0.0, 0.0, 0.0}, {m->omega0[0], m->omega0[1], m->omega0[2]}, 0.0, 0.0};
  if (m->still || t.hi == 0.0) return;
  const rot_dd scaled = rot_dd_ldexp(t, m->exponent);
  if (!(fabs(scaled.hi) < 1e250)) { /* all digits of the angle are lost */
    out->q_error = pi;
    out->omega_error = m->steady ? 0.0 : ldexp(2.0 * m->rate, m->exponent);
  } else if (m->steady) {
    steady_at(m, scaled, out);
  } else {
    tumbling_at(m, scaled, out);
  }
}
