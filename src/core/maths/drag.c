#include "maths/drag.h"

#include <limits.h>
#include <stddef.h>

#include "ground/real.h"

/* ---- units and constants -------------------------------------------------------------------- */

enum { NOTHING = -1000000, LARGE = 300 };

/* x => log2 |x|, rounded up; for 0 less than for any other number */
static int exponent(double x) {
  int e = 0;
  if (x == 0.0) return NOTHING;
  frexp(x, &e);
  return e;
}

static int min(int a, int b) { return a < b ? a : b; }
static int max(int a, int b) { return a > b ? a : b; }

static double scaled(double x, int e) { return ldexp(x, max(-5000, min(5000, e))); }

/* (x + x_lo, d, e) => (x + x_lo)/d 2^e, to twice the precision */
static double ratio(double x, double x_lo, double d, int e, double *lo) {
  int ex = 0, ed = 0;
  const double mx = frexp(x, &ex), md = frexp(d, &ed), q = mx / md;
  const double rest = (fma(-q, md, mx) + scaled(x_lo, -ex)) / md;
  *lo = scaled(rest, ex - ed + e);
  return scaled(q, ex - ed + e);
}

/* Units in which the significant numbers are near 1. Time: the span, or the decay time if shorter.
 * Rate: the larger of omega0 and the final rate. A term that underflows in these units is below
 * 1e-300 of the rest over the whole span. */
static void choose_units(const rot_drag_law *law, double omega0, double span_s, rot_drag *flow) {
  const int ei = exponent(law->inertia_kg_m2), ew = exponent(omega0);
  const int ea = exponent(law->drive_n_m) - ei, eb = exponent(law->viscous_n_m_s) - ei,
            ek = exponent(law->quadratic_n_m_s2) - ei;
  int p = isfinite(span_s) ? exponent(span_s) : 1024;
  p = min(p, LARGE - max(eb, (ea + ek) / 2));
  p = min(p, LARGE - ek - ew);
  if (law->drive_n_m < 0.0) p = min(p, ew - ea + 2); /* it stops within omega0/|a| */
  p = max(-2000, min(2000, p));
  int q = ew;
  if (law->drive_n_m > 0.0) {
    q = max(q, min(ea + p, min(ea - eb, ek < NOTHING / 2 ? INT_MAX : (ea - ek) / 2)));
  }
  flow->time_exp = p;
  flow->omega_exp = q < NOTHING / 2 ? 0 : q;
}

rot_drag rot_drag_from(const rot_drag_law *law, double omega0, double span_s) {
  rot_drag flow;
  double a_lo, b_lo, k_lo, bb_lo, ak_lo, d_lo;
  const double I = law->inertia_kg_m2;
  choose_units(law, omega0, span_s, &flow);
  const int p = flow.time_exp, q = flow.omega_exp;
  flow.a = ratio(law->drive_n_m, law->drive_lo, I, p - q, &a_lo);
  flow.b = ratio(law->viscous_n_m_s, 0.0, I, p, &b_lo);
  flow.k = ratio(law->quadratic_n_m_s2, 0.0, I, p + q, &k_lo);
  flow.omega0 = scaled(omega0, -q);
  /* D to twice the precision: for a < 0 the two parts may nearly cancel. */
  const double bb = rot_two_prod(0.5 * flow.b, 0.5 * flow.b, &bb_lo);
  const double ak = rot_two_prod(flow.a, flow.k, &ak_lo);
  double d = rot_two_sum(bb, ak, &d_lo);
  d_lo += (bb_lo + 0.5 * flow.b * b_lo) + (ak_lo + (flow.a * k_lo + a_lo * flow.k));
  d = rot_two_sum(d, d_lo, &d_lo);
  flow.turns = !(d > 0.0);
  if (d < 0.0) {
    d = -d;
    d_lo = -d_lo;
  }
  flow.s = sqrt(d);
  flow.s_lo = flow.s > 0.0 ? (fma(-flow.s, flow.s, d) + d_lo) / (2.0 * flow.s) : 0.0;
  flow.rest = flow.a / (flow.s + 0.5 * flow.b);
  flow.slope = 0.5 * flow.b + flow.k * flow.omega0;
  return flow;
}

/* ---- omega ---------------------------------------------------------------------------------- */

/* In the units of the flow. */
typedef struct parts {
  double omega;
  double terms;        /* sum of the absolute terms of omega */
  double gain;         /* derivative of omega by omega0 */
  double reach;        /* derivative of theta by omega0 */
  double x, gone;      /* D > 0: 2 s t and 1 - exp(-2 s t), also used for theta */
  double sine, cosine; /* else: sin(s t)/s and cos(s t) */
} parts;

static void ratio_of(parts *out, double upper, double terms, double lower) {
  out->omega = upper <= 0.0 ? 0.0 : upper / lower; /* NaN stays */
  out->terms = terms / lower;
}

/* t => omega and its parts, D <= 0 */
static parts turning(const rot_drag *f, double t, double t_lo) {
  parts out = {0};
  double y_lo, y = rot_two_prod(f->s, t, &y_lo);
  y_lo += f->s * t_lo + f->s_lo * t;
  const double c = cos(y), sn = sin(y);
  out.cosine = c - sn * y_lo;
  out.sine = f->s > 0.0 ? (sn + c * y_lo) / f->s : t;
  const double lower = out.cosine + f->slope * out.sine;
  ratio_of(&out, f->omega0 * (out.cosine - 0.5 * f->b * out.sine) + f->a * out.sine,
           f->omega0 * (fabs(out.cosine) + 0.5 * f->b * out.sine) + fabs(f->a) * out.sine, lower);
  out.gain = 1.0 / lower / lower;
  out.reach = out.sine / lower;
  return out;
}

/* t => omega and its parts, D > 0 */
static parts settling(const rot_drag *f, double t, double t_lo) {
  parts out = {0};
  double x_lo, x = rot_two_prod(2.0 * f->s, t, &x_lo);
  x_lo += 2.0 * (f->s * t_lo + f->s_lo * t);
  out.x = x;
  if (x < 1.0) {
    const double e0 = -expm1(-x);
    const double gone = e0 + (1.0 - e0) * x_lo, e = 1.0 - gone;
    out.gone = gone;
    const double T = x > 1e-300 ? t * (2.0 * (gone / x) / (1.0 + e)) : t; /* tanh(s t)/s */
    const double lower = 1.0 + f->slope * T;
    ratio_of(&out, f->omega0 * (1.0 - 0.5 * f->b * T) + f->a * T,
             f->omega0 * (1.0 + 0.5 * f->b * T) + fabs(f->a) * T, lower);
    out.gain = 4.0 * e / ((1.0 + e) * (1.0 + e)) / lower / lower;
    out.reach = T / lower;
    return out;
  }
  double e = exp(-x);
  if (isfinite(x)) e -= e * x_lo; /* without the residual E has an error of x/2 roundoff units */
  const double gone = 1.0 - e, half = 0.5 * f->b / f->s;
  const double slow = f->rest * (f->k / f->s); /* 1 - b/(2 s) without the difference */
  const double lower = (1.0 + e) + f->slope / f->s * gone, driven = f->a / f->s * gone;
  out.gone = gone;
  ratio_of(&out, f->omega0 * (slow + e * (1.0 + half)) + driven,
           f->omega0 * (fabs(slow) + e * (1.0 + half)) + fabs(driven), lower);
  out.gain = 4.0 * e / lower / lower;
  out.reach = gone / f->s / lower;
  return out;
}

static parts parts_at(const rot_drag *f, double t, double t_lo) {
  return f->turns ? turning(f, t, t_lo) : settling(f, t, t_lo);
}

/* ---- theta ---------------------------------------------------------------------------------- */

static const double ROUNDINGS = 12.0 * ROT_EPS;

/* log1p(y)/y */
static double log1p_over(double y) { return y != 0.0 ? log1p(y) / y : 1.0; }

/* Closed forms of theta; *terms: sum of the absolute terms, whose roundings make the error. */
static double theta_settling(const rot_drag *f, const parts *at, double t, double *terms) {
  const double arm = at->x > 1e-300 ? t * (at->gone / at->x) : t; /* (1 - exp(-2 s t))/(2 s) */
  const double g = (f->omega0 - f->rest) * arm, y = f->k * g;
  const double steady = f->rest * t, turned = y < 1e300 ? g * log1p_over(y) : log(y) / f->k;
  *terms = fabs(steady) + fabs(turned) + (f->omega0 + fabs(f->rest)) * arm / (1.0 + y);
  return steady + turned;
}

static double theta_turning(const rot_drag *f, const parts *at, double t, double *terms) {
  const double half = sin(0.5 * f->s * t), down = 2.0 * half * half;
  const double up = f->slope * at->sine, y = up - down, turned = log1p(y);
  *terms = (fabs(turned) + 0.5 * f->b * t + (up + down) / (1.0 + y)) / f->k;
  return (turned - 0.5 * f->b * t) / f->k;
}

/* Gauss-Legendre on [0, 1]: half the nodes and weights. */
static const double node[5] = {0.07443716949081560, 0.21669769706462359, 0.33970478414951220,
                               0.43253168334449225, 0.48695326425858589};
static const double weight[5] = {0.14776211235737644, 0.13463335965499818, 0.10954318125799102,
                                 0.07472567457529030, 0.03333567215434407};

/* theta by ten points per panel; omega is positive at each, so nothing cancels. */
static double theta_by_quadrature(const rot_drag *f, double t, int panels, double *terms) {
  double sum = 0.0;
  const double h = t / panels;
  *terms = 0.0;
  for (int i = 0; i < panels; i++) {
    for (int j = 0; j < 5; j++) {
      const parts lo = parts_at(f, h * (i + (0.5 - node[j])), 0.0),
                  hi = parts_at(f, h * (i + (0.5 + node[j])), 0.0);
      sum += weight[j] * (lo.omega + hi.omega);
      *terms += weight[j] * (lo.terms + hi.terms);
    }
  }
  *terms *= h;
  return sum * h;
}

/* t => number of panels for which ten points give 1e-16: the poles of omega(t), at a distance of
 * i pi/(2 s) from a real time and before -1/slope, are then far enough from each panel. */
static double panels_for(const rot_drag *f, double t) {
  const double by_rate = f->turns && f->s * t > 0.8 ? 8.0 : f->s * t / 0.8;
  return ceil(fmax(1.0, fmax(by_rate, f->slope * t / 0.667)));
}

/* theta by the closed form unless it cancels, else by quadrature. It cancels in nearly uniform
 * acceleration, where the difference of two terms of size 1/k or 1/b is of order t^2. */
static double theta_at(const rot_drag *f, const parts *at, double t, double *terms) {
  const double theta = f->turns ? theta_turning(f, at, t, terms) : theta_settling(f, at, t, terms);
  if (*terms <= 5.0 * fabs(theta)) return theta;
  const double panels = panels_for(f, t);
  if (panels <= 4.0 || !isfinite(theta)) {
    return theta_by_quadrature(f, t, (int)fmin(panels, 64.0), terms);
  }
  return theta;
}

rot_drag_state rot_drag_at(const rot_drag *flow, double t, double t_lo) {
  const int p = flow->time_exp, q = flow->omega_exp;
  const double u = scaled(t, -p), u_lo = scaled(t_lo, -p);
  rot_drag_state out;
  double terms = 0.0, theta = 0.0;
  parts at = parts_at(flow, u, u_lo);
  if (u > 0.0 && (flow->omega0 > 0.0 || flow->a > 0.0)) {
    theta = theta_at(flow, &at, u, &terms) + at.omega * u_lo;
  }
  out.omega = scaled(at.omega, q);
  out.theta = scaled(theta, p + q);
  out.omega_error = scaled(ROUNDINGS * at.terms, q);
  out.theta_error = scaled(ROUNDINGS * terms, p + q);
  out.gain = at.gain;
  out.reach_s = scaled(at.reach, p);
  return out;
}

/* ---- the stop and the terminal rate --------------------------------------------------------- */

double rot_drag_stop(const rot_drag *f) {
  if (!(f->a < 0.0)) return INFINITY;
  double t;
  if (f->turns) {
    const double T = f->omega0 / (0.5 * f->b * f->omega0 - f->a), y = f->s * T;
    t = y > 0.0 ? T * (atan(y) / y) : T;
  } else {
    const double T = f->omega0 / (-f->a * (1.0 + f->k * f->omega0 / (f->s + 0.5 * f->b)));
    t = T * log1p_over(2.0 * f->s * T);
  }
  return scaled(t, f->time_exp);
}

double rot_drag_terminal(const rot_drag_law *law) {
  if (!(law->drive_n_m > 0.0)) return 0.0;
  const rot_drag flow = rot_drag_from(law, 0.0, INFINITY);
  return scaled(flow.rest, flow.omega_exp);
}

double rot_drag_reach(const rot_drag_law *law, double omega0) {
  const double I = law->inertia_kg_m2, c = law->viscous_n_m_s, q = law->quadratic_n_m_s2;
  if (law->drive_n_m != 0.0) return NAN;
  if (omega0 == 0.0) return 0.0;
  if (c == 0.0) return INFINITY;
  const double x = q == 0.0 ? 0.0 : rot_muldiv(q, omega0, c, NULL);
  if (x <= 1.0) return rot_muldiv(I, omega0, c, NULL) * (x == 0.0 ? 1.0 : log1p(x) / x);
  const double log_x = isfinite(x) ? log1p(x) : log(q) + log(omega0) - log(c);
  return rot_muldiv(I, log_x, q, NULL);
}
