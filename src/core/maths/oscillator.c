#include "maths/oscillator.h"

#include <math.h>
#include <stdlib.h>

#include "maths/phi.h"

/* ---- set-up --------------------------------------------------------------------------------- */

/* => larger exponent of sqrt(k/I) and c/(2 I) */
static int rate_exponent(int ei, int ec, int ek, int damped) {
  const int swing = (int)floor(0.5 * (ek - ei)), damp = ec - ei - 1;
  return damped && damp > swing ? damp : swing;
}

/* => k/I - (c/(2 I))^2 = (4 k I - c^2)/(4 I^2). Both products are exact, so their difference is
 * accurate at critical damping. */
static rot_dd discriminant(double mi, double mc, double mk, int scale_ki, int scale_cc) {
  const rot_dd ki = rot_dd_ldexp(rot_dd_mul2(mk, mi), scale_ki);
  const rot_dd cc = rot_dd_ldexp(rot_dd_mul2(mc, mc), scale_cc);
  return rot_dd_div(rot_dd_sub(ki, cc), rot_dd_mul2(mi, mi));
}

rot_status rot_oscillator_begin(double inertia, double damping, double stiffness,
                                rot_oscillator *out) {
  int ei, ec = 0, ek;
  const double mi = frexp(inertia, &ei), mc = frexp(damping, &ec), mk = frexp(stiffness, &ek);
  const int e = -rate_exponent(ei, ec, ek, damping != 0.0);
  *out = (rot_oscillator){.inertia = inertia, .damping = damping, .stiffness = stiffness};
  out->exponent = e;
  out->half_rate = rot_dd_ldexp(rot_dd_div((rot_dd){mc, 0.0}, (rot_dd){mi, 0.0}), ec - ei - 1 + e);
  out->stiff = rot_dd_ldexp(rot_dd_div((rot_dd){mk, 0.0}, (rot_dd){mi, 0.0}), ek - ei + 2 * e);
  out->omega0 = sqrt(out->stiff.hi);
  if (abs(e) > 1000 || !(out->stiff.hi > 1e-280)) return ROT_ERANGE;
  const rot_dd d = discriminant(mi, mc, mk, ek - ei + 2 * e, 2 * (ec - ei - 1 + e));
  out->regime = d.hi > 0.0 ? 1 : d.hi < 0.0 ? -1 : 0;
  out->split = rot_dd_sqrt(rot_dd_abs(d));
  out->fast = rot_dd_add(rot_dd_abs(out->half_rate), out->split);
  out->slow = rot_dd_div(out->stiff, out->fast); /* never a difference */
  return ROT_OK;
}

/* ---- one step ------------------------------------------------------------------------------- */

/* exp(x.hi + x.lo) */
static double exp_dd(rot_dd x) {
  const double e = exp(x.hi);
  return isfinite(e) ? e + e * x.lo : e;
}

/* u, psi_0, psi_1 for a phase below 1/2 or an underdamped motion. With C = cos or cosh of the phase
 * and S = sin or sinh of the phase, over the split:
 * u = exp(-g s)(C + g S),  psi_0 = exp(-g s)(C - g S),  psi_1 = exp(-g s) S. */
static void by_phase(const rot_oscillator *of, double half_rate, rot_oscillator_step *out) {
  const double x = out->phase.hi, E = out->decay;
  double C, S;
  if (of->regime > 0) {
    const double c = cos(x), s = sin(x), cl = cos(out->phase.lo), sl = sin(out->phase.lo);
    C = out->cosine = c * cl - s * sl;
    out->sine = s * cl + c * sl;
    S = out->sine / of->split.hi;
  } else {
    C = cosh(x);
    S = of->split.hi > 0.0 ? sinh(x) / of->split.hi : out->s.hi;
  }
  const double gS = half_rate * S;
  out->u = E * (C + gS);
  out->psi0 = E * (C - gS);
  out->psi1 = E * S;
  out->u_size = out->psi0_size = E * (fabs(C) + fabs(gS));
  out->psi1_phase = E * ROT_DD_EPS * 4.0 * out->s.hi;
  out->u_phase = E * ROT_DD_EPS * 4.0 * (x + fabs(out->damped));
}

/* The same for separated real roots: F = 1 - exp(-2 phase), P = 1 + slow F/(2 phase) and
 * Q = exp(-2 phase) - slow F/(2 phase), all times the slowest decaying exponential. */
static void by_roots(const rot_oscillator *of, rot_oscillator_step *out) {
  const int grows = out->damped < 0.0;
  const double difference = 2.0 * out->phase.hi, F = -expm1(-difference),
               f = out->slow.hi * F / difference;
  const double E = grows ? exp_dd(out->fast) : exp_dd(rot_dd_neg(out->slow));
  const double rest = exp_dd(rot_dd_ldexp(rot_dd_neg(out->phase), 1)), P = E * (1.0 + f),
               Q = E * (rest - f);
  out->u = grows ? Q : P;
  out->psi0 = grows ? P : Q;
  out->u_size = grows ? E * (rest + f) : P;
  out->psi0_size = grows ? P : E * (rest + f);
  out->psi1 = E * F / (2.0 * of->split.hi);
  out->psi1_phase = out->u_phase = 0.0;
}

/* => h_j for j = 0 .. terms, complete homogeneous symmetric polynomials of the two roots times s */
static void symmetric(const rot_oscillator_step *step, int terms, double h[]) {
  const double p = -2.0 * step->damped, q = -(step->of->stiff.hi * step->s.hi) * step->s.hi;
  h[0] = 1.0;
  h[1] = p;
  for (int j = 2; j <= terms; j++) h[j] = p * h[j - 1] + q * h[j - 2];
}

enum { TERMS = 25 };

/* => terms for a truncation error of 2^-55: |h_j| <= (j + 1) r^j for roots below r */
static int terms_for(double r) { return r < 0.02 ? 6 : r < 0.2 ? 10 : TERMS; }

/* psi_n/s^n = sum h_j/(j + n)! */
static void by_series(rot_oscillator_step *out) {
  double h[TERMS + 1], second = 0.0, third = 0.0, factor = 1.0;
  const int terms = terms_for(2.0 * fabs(out->damped) + sqrt(out->of->stiff.hi) * out->s.hi);
  symmetric(out, terms, h);
  for (int j = 0; j <= terms; j++) { /* factor = 1/(j + 2)! */
    factor = factor / (j == 0 ? 2.0 : j + 2.0);
    second += h[j] * factor;
    third += h[j] * factor / (j + 3.0);
  }
  out->second = second;
  out->third = third;
}

/* psi_n/s^n for separated roots: differences of phi_1 and phi_2 over the distance of the roots. */
static void by_differences(rot_oscillator_step *out) {
  const double difference = 2.0 * out->phase.hi, sign = out->damped < 0.0 ? -1.0 : 1.0;
  double slow[3], fast[3];
  rot_phi(sign * out->slow.hi, sign * out->slow.lo, 2, slow);
  rot_phi(sign * out->fast.hi, sign * out->fast.lo, 2, fast);
  out->second = sign * (slow[1] - fast[1]) / difference;
  out->third = sign * (slow[2] - fast[2]) / difference;
}

/* psi_2 and psi_3 of short steps, where 1 - u loses digits. */
static void integrals(const rot_oscillator *of, rot_oscillator_step *out) {
  out->near_roots = fabs(out->damped) <= 1.25 && of->omega0 * out->s.hi <= 1.0;
  const int far_root = of->regime < 0 && out->phase.hi > 0.5 && out->slow.hi < 0.5;
  out->early = out->near_roots || far_root;
  if (out->near_roots) {
    by_series(out);
  } else if (far_root) {
    by_differences(out);
  }
}

void rot_oscillator_at(const rot_oscillator *of, rot_dd s, rot_oscillator_step *out) {
  const int backward = s.hi < 0.0;
  const rot_dd unit = rot_dd_ldexp(rot_dd_abs(s), -of->exponent);
  const rot_dd half = backward ? rot_dd_neg(of->half_rate) : of->half_rate;
  const rot_dd damped = rot_dd_mul(half, unit);
  *out = (rot_oscillator_step){.of = of, .backward = backward, .s = unit, .damped = damped.hi};
  out->phase = rot_dd_mul(of->split, unit);
  out->slow = rot_dd_mul(of->slow, unit);
  out->fast = rot_dd_mul(of->fast, unit);
  out->decay = exp_dd(rot_dd_neg(damped));
  if (of->regime < 0 && out->phase.hi > 0.5) {
    by_roots(of, out);
  } else if (out->decay > 0.0) {
    by_phase(of, half.hi, out);
  } /* else the motion has decayed to 0 */
  out->first = unit.hi > 0.0 ? out->psi1 / unit.hi : 1.0;
  const double gS = fabs(of->half_rate.hi) * out->psi1;
  out->norm = sqrt(out->decay * out->decay + gS * gS) + fabs(gS);
  integrals(of, out);
  if (backward) out->psi1 = -out->psi1;
}

/* ---- waves ---------------------------------------------------------------------------------- */

static rot_complex times(rot_complex a, rot_complex b) {
  return (rot_complex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static rot_complex over(rot_complex a, rot_complex b) {
  const double size = fmax(fabs(b.re), fabs(b.im));
  const rot_complex c = {b.re / size, -b.im / size};
  const double norm = (c.re * c.re + c.im * c.im) * size;
  const rot_complex p = times(a, c);
  return (rot_complex){p.re / norm, p.im / norm};
}

static double size_of(rot_complex a) { return hypot(a.re, a.im); }

/* i Y and both roots s of order 1: exp[..] = sum h_j/(j + 2)! of three variables. */
static void wave_series(const rot_oscillator_step *step, double Y, rot_complex *y, rot_complex *v) {
  double h[TERMS + 1], factor = 1.0;
  const int terms =
      terms_for(fmax(Y, 2.0 * fabs(step->damped) + sqrt(step->of->stiff.hi) * step->s.hi));
  rot_complex h3 = {0.0, 0.0};
  symmetric(step, terms, h);
  *y = *v = (rot_complex){0.0, 0.0};
  for (int j = 0; j <= terms; j++) {
    h3 = (rot_complex){h[j] - Y * h3.im, Y * h3.re};
    factor = factor / (j + 1.0); /* 1/(j + 1)! */
    v->re += h3.re * factor;
    v->im += h3.im * factor;
    y->re += h3.re * factor / (j + 2.0);
    y->im += h3.im * factor / (j + 2.0);
  }
}

/* d => (exp(d) - 1)/d, |d| < 1/2 */
static rot_complex first_phi(rot_complex d) {
  rot_complex sum = {0.0, 0.0};
  double factor = 1.0;
  for (int j = 2; j <= 14; j++) factor /= j; /* 1/14! */
  for (int j = 13; j >= 0; j--) {
    sum = times(sum, d);
    sum.re += factor;
    factor *= j + 1.0;
  }
  return sum;
}

/* => i Y - root s for the root nearest to i Y and for the other; exp(nearest root s) */
static void distances(const rot_oscillator_step *step, rot_dd omega, double Y, rot_complex *nearest,
                      rot_complex *other, rot_complex *power) {
  const rot_oscillator *of = step->of;
  if (of->regime < 0) {
    const double sign = step->damped < 0.0 ? -1.0 : 1.0;
    *nearest = (rot_complex){sign * step->slow.hi, Y};
    *other = (rot_complex){sign * step->fast.hi, Y};
    *power = (rot_complex){exp(-sign * step->slow.hi), 0.0};
    return;
  }
  const double off = rot_dd_mul(rot_dd_sub(omega, of->split), step->s).hi;
  *nearest = (rot_complex){step->damped, off};
  *other = (rot_complex){step->damped, Y + step->phase.hi};
  *power = (rot_complex){step->decay * step->cosine, step->decay * step->sine};
  if (of->regime == 0) *power = (rot_complex){step->decay, 0.0};
}

/* Response near a root a, far from the other root b, c = i Y:
 *   exp[a, b, c]     = (exp[a, c] - exp[a, b])/(c - b),    exp[a, c] = exp(a) phi_1(c - a)
 *   (x exp)[a, b, c] = (c exp[a, c] + exp(a) - psi_0)/(c - b),  for y'. */
static void wave_near(const rot_oscillator_step *step, double Y, rot_complex nearest,
                      rot_complex other, rot_complex power, rot_complex *y, rot_complex *v,
                      double *y_size, double *v_size) {
  const rot_complex ac = times(power, first_phi(nearest));
  const double away = size_of(other);
  *y = over((rot_complex){ac.re - step->first, ac.im}, other);
  *v = over((rot_complex){power.re - step->psi0 - Y * ac.im, power.im + Y * ac.re}, other);
  *y_size = (size_of(ac) + fabs(step->first)) / away;
  *v_size = (Y * size_of(ac) + size_of(power) + step->psi0_size) / away;
}

int rot_oscillator_wave(const rot_oscillator_step *step, double omega, rot_complex *y,
                        rot_complex *v, double *y_size, double *v_size) {
  const rot_dd rate = {ldexp(omega, step->of->exponent), 0.0};
  const double Y = rate.hi * step->s.hi;
  if (step->near_roots && Y <= 1.25) {
    wave_series(step, Y, y, v);
    *y_size = size_of(*y);
    *v_size = size_of(*v);
  } else {
    rot_complex nearest, other, power;
    distances(step, rate, Y, &nearest, &other, &power);
    if (!(size_of(nearest) < 0.5)) return 0;
    wave_near(step, Y, nearest, other, power, y, v, y_size, v_size);
  }
  if (step->backward) { /* reversed time conjugates the wave */
    y->im = -y->im;
    v->im = -v->im;
  }
  return 1;
}

rot_complex rot_oscillator_steady(const rot_oscillator *of, double omega) {
  const double rate = ldexp(omega, of->exponent);
  rot_complex below;
  if (rate < 1e100) {
    below.re = rot_dd_sub(of->stiff, rot_dd_mul2(rate, rate)).hi;
  } else {
    return (rot_complex){-1.0 / rate / rate, 0.0};
  }
  below.im = 2.0 * of->half_rate.hi * rate;
  return over((rot_complex){1.0, 0.0}, below);
}
