/* Motions of rotors in a chain in quadruple precision: the truth for scenes.R. It shares no formula
 * with the models that it judges. Smooth motions of linear chains by the exponential of their
 * matrix, pendulums by Jacobi's functions, all others by extrapolated midpoint steps (Gragg,
 * Bulirsch, Stoer) that end where a contact begins to slip or to stick; which contacts stick is
 * found by releasing them in turn where loads begin, by trying all combinations elsewhere.
 *
 * A scene a line, numbers between blanks:
 *   start, n, degrees
 *   for each rotor: moment of inertia, theta0, omega0, viscous, quadratic, sliding friction, static
 *   friction, stiffness, rest angle, three factors of a gravity torque (their product is m g d),
 *   constant torque, amplitude, angular frequency, phase; brake: capacity, static ratio, from, to;
 *   pulses: how many, then start, duration, torque of each
 *   for each coupling: kind (0 shaft, 1 clutch, 2 gear), ratio, stiffness, damping, capacity,
 *   static ratio, from, to, efficiency
 *   how many rows, their times (not decreasing)
 * degrees: NAN, or the angle of an incline. Rotor 1 is then the mass on the slope, its amplitude
 * the acceleration of gravity; rotor 2 the body that turns, its sliding friction the arm of the
 * rolling resistance. The clutch between them has the radius as ratio, the coefficients of friction
 * as capacity and as static ratio (here not a multiple).
 *
 * A line for each scene: theta and omega of each row and rotor, each as two doubles whose sum it
 * is; nothing where no truth was found. */
#include <math.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "midpoint.h"

enum {
  ROTORS = 6,
  PULSES = 8,
  ROWS = 64,
  CONTACTS = 2 * ROTORS,
  SIZE = 4 * ROTORS + 2,
  MOST_STEPS = 20000
};

typedef struct rotor {
  double inertia, theta0, omega0, viscous, quadratic, sliding, holding, stiffness, rest, gravity[3];
  double constant, amplitude, frequency, phase, brake, brake_ratio, from, to;
  int n_pulses;
  double pulse[PULSES][3];
  /* derived */
  quad mgd, over; /* the ratio to the first rotor of its unit */
  quad torque;    /* constant and pulses, of the present piece */
  int unit, brakes;
} rotor;

typedef struct coupling {
  double kind, ratio, stiffness, damping, capacity, capacity_ratio, from, to, efficiency;
  int acts;
} coupling;

/* A contact's slip is v[a] * pa + v[b] * pb. Sliding forward it resists with forward, backward with
 * backward; it holds up to hold_forward, hold_backward. */
typedef struct contact {
  int a, b, unit; /* unit: that of a ground contact, else -1 */
  quad pa, pb, forward, backward, hold_forward, hold_backward;
  int mode; /* 1, -1, 0 sticks, 2 does not act */
} contact;

typedef struct chain {
  int n, m, n_contacts;
  rotor r[ROTORS];
  coupling c[ROTORS];
  contact k[CONTACTS];
  quad inertia[ROTORS];
  quad start, highest; /* the highest angular frequency of a torque */
  int incline;
  quad push[2], press; /* along the slope, and the normal force */
} chain;

static quad square(quad x) { return x * x; }

static int linear(const chain *s) {
  if (s->n_contacts) return 0;
  for (int i = 0; i < s->n; i++) {
    if (s->r[i].mgd != 0 || s->r[i].quadratic != 0.0) return 0;
  }
  return 1;
}

/* ---- forces ---------------------------------------------------------------------------------- */

static quad angle_of(const chain *s, const quad y[], int i) {
  const rotor *r = &s->r[i];
  int first = i;
  while (first > 0 && s->r[first - 1].unit == r->unit) first--;
  return (quad)r->theta0 + (y[2 * r->unit] - (quad)s->r[first].theta0) / r->over;
}

/* Forces on the units without the contacts. */
static void forces(const chain *s, quad t, const quad y[], quad f[]) {
  for (int u = 0; u < s->m; u++) f[u] = 0;
  for (int i = 0; i < s->n; i++) {
    const rotor *r = &s->r[i];
    const quad omega = y[2 * r->unit + 1] / r->over, theta = angle_of(s, y, i);
    quad q = r->torque - (quad)r->viscous * omega - (quad)r->quadratic * fabsq(omega) * omega;
    if (s->incline)
      q = s->push[i];
    else if (r->amplitude != 0.0)
      q += (quad)r->amplitude * cosq((quad)r->frequency * t + (quad)r->phase);
    if (r->stiffness != 0.0) q -= (quad)r->stiffness * (theta - (quad)r->rest);
    if (r->mgd != 0) q -= r->mgd * sinq(theta - (quad)r->rest);
    f[r->unit] += q / r->over;
  }
  for (int i = 0; i + 1 < s->n; i++) {
    const coupling *c = &s->c[i];
    if (c->kind != 0.0) continue;
    const int a = s->r[i].unit, b = s->r[i + 1].unit;
    const quad ratio = c->ratio;
    const quad torque =
        (quad)c->stiffness * (angle_of(s, y, i) - ratio * angle_of(s, y, i + 1)) +
        (quad)c->damping * (y[2 * a + 1] / s->r[i].over - ratio * y[2 * b + 1] / s->r[i + 1].over);
    f[a] -= torque / s->r[i].over;
    f[b] += ratio * torque / s->r[i + 1].over;
  }
}

/* Solves a x = b; 0 where it is singular. */
static int solve(int n, quad a[][CONTACTS], quad b[]) {
  for (int j = 0; j < n; j++) {
    int best = j;
    for (int i = j + 1; i < n; i++) {
      if (fabsq(a[i][j]) > fabsq(a[best][j])) best = i;
    }
    quad largest = 0;
    for (int k = 0; k < n; k++) largest = fmaxq(largest, fabsq(a[best][k]));
    if (!(fabsq(a[best][j]) > 1e-25Q * largest)) return 0;
    for (int k = 0; k < n; k++) {
      const quad swap = a[j][k];
      a[j][k] = a[best][k];
      a[best][k] = swap;
    }
    const quad swap = b[j];
    b[j] = b[best];
    b[best] = swap;
    for (int i = j + 1; i < n; i++) {
      const quad w = a[i][j] / a[j][j];
      for (int k = j; k < n; k++) a[i][k] -= w * a[j][k];
      b[i] -= w * b[j];
    }
  }
  for (int j = n; j-- > 0;) {
    for (int k = j + 1; k < n; k++) b[j] -= a[j][k] * b[k];
    b[j] /= a[j][j];
  }
  return 1;
}

static quad along(const contact *k, int u) {
  return (k->a == u ? k->pa : 0) + (k->b == u ? k->pb : 0);
}

/* Accelerations with the present modes; what each contact that sticks must carry, positive against
 * forward slip. 0 where the modes do not determine it. */
static int accelerations(const chain *s, quad t, const quad y[], quad rate[], quad carried[]) {
  quad f[ROTORS], g[CONTACTS][CONTACTS], h[CONTACTS];
  int stuck[CONTACTS], n = 0;
  forces(s, t, y, f);
  for (int k = 0; k < s->n_contacts; k++) {
    const contact *c = &s->k[k];
    carried[k] = 0;
    if (c->mode == 0) stuck[n++] = k;
    if (c->mode != 1 && c->mode != -1) continue;
    const quad resist = c->mode > 0 ? -c->forward : c->backward;
    for (int u = 0; u < s->m; u++) f[u] += resist * along(c, u);
  }
  for (int i = 0; i < n; i++) {
    h[i] = 0;
    for (int u = 0; u < s->m; u++) h[i] += along(&s->k[stuck[i]], u) * f[u] / s->inertia[u];
    for (int j = 0; j < n; j++) {
      g[i][j] = 0;
      for (int u = 0; u < s->m; u++) {
        g[i][j] += along(&s->k[stuck[i]], u) * along(&s->k[stuck[j]], u) / s->inertia[u];
      }
    }
  }
  if (n && !solve(n, g, h)) return 0;
  for (int i = 0; i < n; i++) {
    carried[stuck[i]] = h[i];
    for (int u = 0; u < s->m; u++) f[u] -= h[i] * along(&s->k[stuck[i]], u);
  }
  for (int u = 0; u < s->m; u++) rate[u] = f[u] / s->inertia[u];
  return 1;
}

static quad slip_of(const contact *k, const quad y[]) {
  return k->pa * y[2 * k->a + 1] + (k->b >= 0 ? k->pb * y[2 * k->b + 1] : 0);
}

/* ---- steps ----------------------------------------------------------------------------------- */

static void slope(const void *system, quad t, const quad y[], quad f[]) {
  const chain *s = system;
  quad rate[ROTORS], carried[CONTACTS];
  accelerations(s, t, y, rate, carried);
  for (int u = 0; u < s->m; u++) {
    f[2 * u] = y[2 * u + 1];
    f[2 * u + 1] = rate[u];
  }
}

static double step(const chain *s, quad t, const quad y[], quad h, const quad size[], quad out[]) {
  const midpoint rule = {slope, 2 * s->m, 10, 1e-25};
  return midpoint_step(&rule, s, t, h, y, size, out);
}

/* ---- contacts -------------------------------------------------------------------------------- */

/* A slip of this share of the rates. Below 1e-22 it counts as none where modes are chosen, beyond
 * 1e-27 it ends a mode: so what ended is none, and so are the slips that its projection makes. */
static quad least_slip(const contact *k, const quad size[], quad share) {
  return share *
         (fabsq(k->pa) * size[2 * k->a + 1] + (k->b >= 0 ? fabsq(k->pb) * size[2 * k->b + 1] : 0));
}

static int consistent(const chain *s, const int zero[], int n, quad t, const quad y[]) {
  quad rate[ROTORS], carried[CONTACTS];
  if (!accelerations(s, t, y, rate, carried)) return 0;
  for (int i = 0; i < n; i++) {
    const contact *k = &s->k[zero[i]];
    if (k->mode == 0) {
      const quad slack = 1e-24Q * fmaxq(k->hold_forward, k->hold_backward);
      if (carried[zero[i]] > k->hold_forward + slack) return 0;
      if (carried[zero[i]] < -k->hold_backward - slack) return 0;
    } else {
      const quad a = k->pa * rate[k->a] + (k->b >= 0 ? k->pb * rate[k->b] : 0);
      if (k->mode > 0 ? !(a > 0) : !(a < 0)) return 0;
    }
  }
  return 1;
}

/* At rest under loads that begin at once: as if they grew. What is loaded most, of what it holds,
 * gives way first and slides; what slides the wrong way sticks again. 0: it does not settle. */
static int release_in_turn(chain *s, const int zero[], int n, quad t, const quad y[]) {
  quad rate[ROTORS], carried[CONTACTS];
  for (int i = 0; i < n; i++) s->k[zero[i]].mode = 0;
  for (int round = 0; round < 4 * n + 4; round++) {
    int worst = -1, caught = 0;
    quad most = 1 + 1e-24Q;
    if (!accelerations(s, t, y, rate, carried)) return 0;
    for (int i = 0; i < n; i++) {
      contact *k = &s->k[zero[i]];
      const quad c = carried[zero[i]];
      const quad a = k->pa * rate[k->a] + (k->b >= 0 ? k->pb * rate[k->b] : 0);
      const quad load = c > 0 ? c / k->hold_forward : -c / k->hold_backward;
      if (k->mode != 0 && k->mode * a <= 0) {
        k->mode = 0;
        caught = 1;
      } else if (k->mode == 0 && load > most) {
        most = load;
        worst = zero[i];
      }
    }
    if (caught) continue;
    if (worst < 0) return consistent(s, zero, n, t, y);
    s->k[worst].mode = carried[worst] > 0 ? 1 : -1;
  }
  return 0;
}

/* Sets the modes for a state; `loose` is a contact that just broke loose, or -1: loads begin. With
 * static above sliding friction more than one set may be consistent: that in which most stick, then
 * that in which those stick that did, for their forces change continuously. */
static int choose_modes(chain *s, quad t, const quad y[], const quad size[], int loose) {
  int zero[CONTACTS], stuck[CONTACTS], n = 0;
  for (int k = 0; k < s->n_contacts; k++) {
    contact *c = &s->k[k];
    if (c->mode == 2) continue;
    stuck[n] = c->mode == 0;
    const quad slip = slip_of(c, y);
    if (fabsq(slip) <= least_slip(c, size, 1e-22Q)) {
      zero[n++] = k;
    } else {
      c->mode = slip > 0 ? 1 : -1;
    }
  }
  if (loose < 0 && release_in_turn(s, zero, n, t, y)) return 1;
  int combinations = 1, best = -1, found = -1;
  for (int i = 0; i < n; i++) combinations *= 3;
  for (int try = 0; try < combinations; try++) {
    int sticks = 0, left = try, allowed = 1;
    for (int i = 0; i < n; i++, left /= 3) {
      s->k[zero[i]].mode = left % 3 - 1;
      if (s->k[zero[i]].mode == 0) sticks += CONTACTS + 1 + stuck[i];
      if (zero[i] == loose && s->k[zero[i]].mode == 0) allowed = 0;
    }
    if (allowed && sticks > best && consistent(s, zero, n, t, y)) {
      best = sticks;
      found = try;
    }
  }
  if (found < 0) return 0;
  for (int i = 0; i < n; i++, found /= 3) s->k[zero[i]].mode = found % 3 - 1;
  return 1;
}

/* How far a contact is beyond its mode: > 0 where the mode has ended. */
static quad beyond(const chain *s, int which, const quad y[], const quad carried[]) {
  const contact *k = &s->k[which];
  if (k->mode == 2) return -1;
  if (k->mode == 0)
    return fmaxq(carried[which] - k->hold_forward, -carried[which] - k->hold_backward);
  const quad slip = slip_of(k, y);
  return k->mode > 0 ? -slip : slip;
}

/* The contact that is furthest beyond its mode, or -1. */
static int ended(const chain *s, quad t, const quad y[], const quad size[]) {
  quad rate[ROTORS], carried[CONTACTS];
  if (!s->n_contacts) return -1;
  accelerations(s, t, y, rate, carried);
  for (int k = 0; k < s->n_contacts; k++) {
    const contact *c = &s->k[k];
    const quad slack = c->mode == 0 ? 1e-23Q * fmaxq(c->hold_forward, c->hold_backward)
                                    : least_slip(c, size, 1e-27Q);
    if (beyond(s, k, y, carried) > slack) return k;
  }
  return -1;
}

static int march(chain *s, quad *t, quad y[], quad end, quad *h, quad size[]) {
  const int n = 2 * s->m;
  const quad most = s->n_contacts ? 0.04Q / fmaxq(s->highest, 1e-3Q) : (end - *t);
  for (int steps = 0; *t < end; steps++) {
    if (steps > MOST_STEPS) return 0;
    quad out[2 * ROTORS], left = end - *t, d = fminq(fminq(*h, most), left);
    int last = d == left;
    const double error = step(s, *t, y, d, size, out);
    if (!(error < 1e-22)) {
      *h = d / 2;
      if (*h < 1e-25Q * fmaxq(1, fabsq(*t))) return 0;
      continue;
    }
    if (error < 1e-25) *h = d * 1.5Q;
    int which = ended(s, *t + d, out, size);
    if (which >= 0) {
      quad lo = 0, hi = d;
      for (int i = 0; i < 110 && hi - lo > 1e-29Q * fmaxq(d, 1e-3Q); i++) {
        const quad mid = (lo + hi) / 2;
        step(s, *t, y, mid, size, out);
        const int now = ended(s, *t + mid, out, size);
        if (now >= 0) {
          hi = mid;
          which = now;
        } else {
          lo = mid;
        }
      }
      d = hi;
      step(s, *t, y, d, size, out);
      last = 0;
    }
    *t = last ? end : *t + d;
    for (int i = 0; i < n; i++) {
      y[i] = out[i];
      size[i] = fmaxq(size[i], fabsq(y[i]));
    }
    if (which >= 0) {
      contact *k = &s->k[which];
      const int loose = k->mode == 0 ? which : -1;
      if (loose < 0) { /* on the surface exactly, by the least change of the rates */
        const quad weight =
            square(k->pa) / s->inertia[k->a] + (k->b >= 0 ? square(k->pb) / s->inertia[k->b] : 0);
        const quad push = slip_of(k, y) / weight;
        y[2 * k->a + 1] -= push * k->pa / s->inertia[k->a];
        if (k->b >= 0) y[2 * k->b + 1] -= push * k->pb / s->inertia[k->b];
      }
      if (!choose_modes(s, *t, y, size, loose)) return 0;
    }
  }
  return 1;
}

/* ---- linear chains --------------------------------------------------------------------------- */

/* exp(a) by Taylor's series, scaled and squared. */
static void exponential(int n, quad a[SIZE][SIZE], quad e[SIZE][SIZE]) {
  static quad term[SIZE][SIZE], next[SIZE][SIZE];
  quad norm = 0;
  for (int i = 0; i < n; i++) {
    quad row = 0;
    for (int j = 0; j < n; j++) row += fabsq(a[i][j]);
    norm = fmaxq(norm, row);
  }
  int halvings = 0;
  while (norm > 0.25Q) {
    norm /= 2;
    halvings++;
  }
  const quad scale = ldexpq(1, -halvings);
  /* exp(a) - 1, which keeps its digits where a is small. */
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++) e[i][j] = term[i][j] = a[i][j] * scale;
  }
  for (int k = 2; k < 30; k++) {
    for (int i = 0; i < n; i++) {
      for (int j = 0; j < n; j++) {
        quad sum = 0;
        for (int l = 0; l < n; l++) sum += term[i][l] * a[l][j];
        next[i][j] = sum * scale / k;
      }
    }
    for (int i = 0; i < n; i++) {
      for (int j = 0; j < n; j++) {
        term[i][j] = next[i][j];
        e[i][j] += next[i][j];
      }
    }
  }
  for (int k = 0; k < halvings; k++) { /* (1 + e)^2 - 1 */
    for (int i = 0; i < n; i++) {
      for (int j = 0; j < n; j++) {
        quad sum = 2 * e[i][j];
        for (int l = 0; l < n; l++) sum += e[i][l] * e[l][j];
        next[i][j] = sum;
      }
    }
    memcpy(e, next, sizeof next);
  }
}

/* Components: x and v of each unit, 1, then cosine and sine of each rotor's torque. */
static void linear_to(const chain *s, quad from, quad to, quad y[]) {
  static quad a[SIZE][SIZE], e[SIZE][SIZE];
  memset(a, 0, sizeof a);
  const int one = 2 * s->m;
  int n = one + 1;
  quad z[SIZE] = {0}, probe[2 * ROTORS] = {0}, f[ROTORS], f0[ROTORS];
  chain still = *s;
  for (int i = 0; i < s->n; i++) still.r[i].amplitude = 0.0;
  forces(&still, from, probe, f0);
  for (int u = 0; u < s->m; u++) {
    a[2 * u][2 * u + 1] = 1;
    a[2 * u + 1][one] = f0[u] / s->inertia[u];
  }
  for (int j = 0; j < 2 * s->m; j++) {
    probe[j] = 1;
    forces(&still, from, probe, f);
    for (int u = 0; u < s->m; u++) a[2 * u + 1][j] += (f[u] - f0[u]) / s->inertia[u];
    probe[j] = 0;
  }
  memcpy(z, y, (size_t)(2 * s->m) * sizeof *z);
  z[one] = 1;
  for (int i = 0; i < s->n && !s->incline; i++) {
    const rotor *r = &s->r[i];
    if (r->amplitude == 0.0) continue;
    const quad w = r->frequency, phase = w * from + (quad)r->phase;
    z[n] = cosq(phase);
    z[n + 1] = sinq(phase);
    a[n][n + 1] = -w;
    a[n + 1][n] = w;
    a[2 * r->unit + 1][n] += (quad)r->amplitude / r->over / s->inertia[r->unit];
    n += 2;
  }
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++) a[i][j] *= to - from;
  }
  exponential(n, a, e);
  for (int i = 0; i < 2 * s->m; i++) {
    quad sum = 0;
    for (int j = 0; j < n; j++) sum += e[i][j] * z[j];
    y[i] = z[i] + sum;
  }
}

/* ---- pendulums ------------------------------------------------------------------------------- */

/* Jacobi's amplitude of u for the modulus k < 1, by the arithmetic-geometric mean. */
static quad amplitude(quad u, quad k) {
  quad a[20] = {1}, c[20] = {k}, b = sqrtq((1 - k) * (1 + k));
  int n = 0;
  while (n < 18 && fabsq(c[n]) > 1e-33Q) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = sqrtq(a[n] * b);
    n++;
  }
  quad phi = ldexpq(1, n) * a[n] * u;
  for (; n > 0; n--) phi = (phi + asinq(c[n] / a[n] * sinq(phi))) / 2;
  return phi;
}

static quad quarter_period(quad k) {
  quad a = 1, b = sqrtq((1 - k) * (1 + k));
  for (int i = 0; i < 20; i++) {
    const quad next = (a + b) / 2;
    b = sqrtq(a * b);
    a = next;
  }
  return M_PIq / 2 / a;
}

/* u with amplitude phi: bisection and Newton's iteration. */
static quad argument(quad phi, quad k) {
  const quad whole = roundq(phi / M_PIq), K = quarter_period(k);
  const quad rest = phi - whole * M_PIq;
  quad lo = -K * 1.0001Q, hi = K * 1.0001Q, u = rest;
  for (int i = 0; i < 200; i++) {
    const quad off = amplitude(u, k) - rest;
    if (off > 0)
      hi = u;
    else
      lo = u;
    quad next = u - off / sqrtq(1 - square(k * sinq(amplitude(u, k))));
    if (!(next > lo && next < hi)) next = (lo + hi) / 2;
    if (fabsq(next - u) <= 1e-33Q * K) break;
    u = next;
  }
  return u + 2 * whole * K;
}

static void pendulum_to(const chain *s, quad t, quad y[]) {
  const rotor *r = &s->r[0];
  const quad w = sqrtq(s->r[0].mgd / (quad)r->inertia);
  const quad theta = (quad)r->theta0 - (quad)r->rest, rate = r->omega0;
  const quad kappa = sqrtq(square(sinq(theta / 2)) + square(rate / (2 * w)));
  const quad span = t - s->start;
  if (kappa < 1) {
    const quad whole = 2 * M_PIq * roundq(theta / (2 * M_PIq)); /* theta0 may be turns away */
    const quad u0 = argument(atan2q(sinq((theta - whole) / 2), rate / (2 * w)), kappa);
    const quad phi = amplitude(w * span + u0, kappa);
    y[0] = (quad)r->rest + whole + 2 * asinq(kappa * sinq(phi));
    y[1] = 2 * w * kappa * cosq(phi);
  } else {
    const quad sign = rate < 0 ? -1 : 1;
    const quad u0 = argument(theta / 2, 1 / kappa);
    const quad phi = amplitude(sign * kappa * w * span + u0, 1 / kappa);
    y[0] = (quad)r->rest + 2 * phi;
    y[1] = 2 * w * kappa * sign * sqrtq(1 - square(sinq(phi) / kappa));
  }
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static int numbers(int n, double x[]) {
  for (int i = 0; i < n; i++) {
    char word[64];
    if (scanf("%63s", word) != 1) return 0;
    x[i] = strtod(word, NULL);
  }
  return 1;
}

/* Sine and cosine of an angle in degrees. */
static void of_degrees(double degrees, quad *sine, quad *cosine) {
  const quad x = (quad)degrees * M_PIq / 180;
  *sine = fabs(degrees) == 90.0 ? copysignq(1, x) : sinq(x);
  *cosine = fabs(degrees) == 90.0 ? 0 : cosq(x);
}

static int read_chain(chain *s) {
  double head[3];
  memset(s, 0, sizeof *s);
  if (!numbers(3, head)) return 0;
  s->start = head[0];
  s->n = (int)head[1];
  s->incline = !isnan(head[2]);
  for (int i = 0; i < s->n; i++) {
    rotor *r = &s->r[i];
    double x[21];
    if (!numbers(21, x)) return 0;
    memcpy(&r->inertia, x, 20 * sizeof *x);
    r->n_pulses = (int)x[20];
    for (int j = 0; j < r->n_pulses; j++) {
      if (!numbers(3, r->pulse[j])) return 0;
    }
    r->mgd = (quad)r->gravity[0] * r->gravity[1] * r->gravity[2];
    if (r->amplitude != 0.0) s->highest = fmaxq(s->highest, fabsq(r->frequency));
    if (r->mgd != 0) s->highest = fmaxq(s->highest, sqrtq(fabsq(r->mgd) / r->inertia));
    if (r->stiffness != 0.0) s->highest = fmaxq(s->highest, sqrtq(r->stiffness / r->inertia));
  }
  for (int i = 0; i + 1 < s->n; i++) {
    if (!numbers(9, &s->c[i].kind)) return 0;
    const quad k = s->c[i].stiffness;
    s->highest = fmaxq(
        s->highest, sqrtq(k / s->r[i].inertia + k * square(s->c[i].ratio) / s->r[i + 1].inertia));
  }
  if (s->incline) {
    quad sine, cosine;
    of_degrees(head[2], &sine, &cosine);
    const quad weight = (quad)s->r[0].inertia * (quad)s->r[0].amplitude;
    s->push[0] = weight * sine;
    s->push[1] = 0;
    s->press = weight * cosine;
  }
  s->m = 0;
  for (int i = 0; i < s->n; i++) {
    const int geared = i > 0 && s->c[i - 1].kind == 2.0;
    if (i > 0 && !geared) s->m++;
    s->r[i].unit = s->m;
    s->r[i].over = geared ? s->r[i - 1].over * (quad)s->c[i - 1].ratio : 1;
    s->inertia[s->m] += (quad)s->r[i].inertia / square(s->r[i].over);
  }
  s->m++;
  return 1;
}

/* What acts from t on. */
static void set_piece(chain *s, quad t) {
  s->n_contacts = 0;
  for (int i = 0; i < s->n; i++) {
    rotor *r = &s->r[i];
    r->torque = r->constant;
    for (int j = 0; j < r->n_pulses; j++) {
      const quad from = r->pulse[j][0], to = from + (quad)r->pulse[j][1];
      if (t >= from && t < to) r->torque += r->pulse[j][2];
    }
    r->brakes = r->brake > 0.0 && t >= (quad)r->from && t < (quad)r->to;
  }
  for (int u = 0; u < s->m; u++) {
    contact k = {.a = u, .b = -1, .unit = u, .pa = 1, .mode = 1};
    int dry = 0;
    for (int i = 0; i < s->n; i++) {
      const rotor *r = &s->r[i];
      if (r->unit != u) continue;
      const quad over = fabsq(r->over), press = s->incline ? s->press : 1;
      const quad sliding = r->sliding * press + (r->brakes ? r->brake : 0);
      const quad holding =
          r->holding * press + (r->brakes ? (quad)r->brake * (quad)r->brake_ratio : 0);
      if (sliding > 0 || holding > 0 || r->quadratic > 0.0) dry = 1;
      k.forward += sliding / over;
      k.hold_forward += holding / over;
    }
    k.backward = k.forward;
    k.hold_backward = k.hold_forward;
    if (dry) s->k[s->n_contacts++] = k;
  }
  for (int i = 0; i + 1 < s->n; i++) {
    const coupling *c = &s->c[i];
    if (c->kind != 1.0 || !(t >= (quad)c->from && t < (quad)c->to)) continue;
    const quad press = s->incline ? s->press : 1;
    contact k = {.a = s->r[i].unit, .b = s->r[i + 1].unit, .unit = -1, .mode = 1};
    k.pa = 1 / s->r[i].over;
    k.pb = -(quad)c->ratio / s->r[i + 1].over;
    k.forward = k.backward = press * (quad)c->capacity;
    k.hold_forward = k.hold_backward =
        s->incline ? press * (quad)c->capacity_ratio : (quad)c->capacity * (quad)c->capacity_ratio;
    s->k[s->n_contacts++] = k;
  }
}

static int by_size(const void *a, const void *b) {
  const quad x = *(const quad *)a, y = *(const quad *)b;
  return (x > y) - (x < y);
}

static int breaks_of(const chain *s, quad at[]) {
  int n = 0;
  for (int i = 0; i < s->n; i++) {
    const rotor *r = &s->r[i];
    for (int j = 0; j < r->n_pulses; j++) {
      at[n++] = r->pulse[j][0];
      at[n++] = (quad)r->pulse[j][0] + (quad)r->pulse[j][1];
    }
    if (r->brake > 0.0 && isfinite(r->from)) at[n++] = r->from;
    if (r->brake > 0.0 && isfinite(r->to)) at[n++] = r->to;
    if (i + 1 < s->n && s->c[i].kind == 1.0) {
      if (isfinite(s->c[i].from)) at[n++] = s->c[i].from;
      if (isfinite(s->c[i].to)) at[n++] = s->c[i].to;
    }
  }
  qsort(at, (size_t)n, sizeof *at, by_size);
  return n;
}

/* ---- gears with losses ----------------------------------------------------------------------- */

/* One unit under constant torques and viscous resistance, with gears that let through a part of the
 * power, from either side. What rotor i and those behind it need at the coordinate is
 * need = J a - F + its mesh's share of the need behind: over the efficiency where power goes on,
 * times it where power comes back. For given ways of the power a = A - B v, so v is an exponential
 * until one of the ways, or v itself, changes its sign. */
static int loses(const chain *s) {
  for (int i = 0; i + 1 < s->n; i++) {
    if (s->c[i].kind == 2.0 && s->c[i].efficiency < 1.0) return 1;
  }
  return 0;
}

/* a = law[0] - law[1] v for these ways of the power (1 on, -1 back), and the needs at mesh i,
 * need[i][0] + need[i][1] v. */
static void geared_law(const chain *s, const int on[], quad law[2], quad need[][2]) {
  quad force = 0, drag = 0, inertia = 0, j[ROTORS], f[ROTORS], c[ROTORS];
  quad forces[ROTORS], drags[ROTORS], inertias[ROTORS];
  for (int i = s->n; i-- > 0;) {
    const rotor *r = &s->r[i];
    quad gain = 1;
    if (i + 1 < s->n) {
      const quad efficiency = s->c[i].efficiency;
      gain = on[i] > 0 ? 1 / efficiency : efficiency;
    }
    j[i] = (quad)r->inertia / square(r->over);
    f[i] = r->torque / r->over;
    c[i] = (quad)r->viscous / square(r->over);
    force = force * gain + f[i];
    drag = drag * gain + c[i];
    inertia = inertia * gain + j[i];
    forces[i] = force, drags[i] = drag, inertias[i] = inertia;
  }
  law[0] = force / inertia;
  law[1] = drag / inertia;
  for (int i = 0; i + 1 < s->n; i++) { /* of the part behind mesh i */
    need[i][0] = inertias[i + 1] * law[0] - forces[i + 1];
    need[i][1] = drags[i + 1] - inertias[i + 1] * law[1];
  }
}

/* The ways that agree with the needs at v for motion in this way. */
static void geared_ways(const chain *s, quad v, quad way, int on[], quad law[2], quad need[][2]) {
  for (int i = 0; i < ROTORS; i++) on[i] = 1;
  for (int tries = 0; tries < 100; tries++) {
    int changed = 0;
    geared_law(s, on, law, need);
    for (int i = 0; i + 1 < s->n; i++) {
      const quad power = way * (need[i][0] + need[i][1] * v);
      const int is = power > 0 ? 1 : power < 0 ? -1 : on[i];
      changed |= is != on[i];
      on[i] = is;
    }
    if (!changed) return;
  }
}

/* When v, from v0, reaches `level`; INFINITY: it does not. */
static quad reaches(quad v0, const quad law[2], quad level) {
  const quad a = law[0] - law[1] * v0;
  if (level == v0 || a == 0) return INFINITY;
  if (law[1] == 0) return (level - v0) / a > 0 ? (level - v0) / a : (quad)INFINITY;
  const quad left = 1 - law[1] * (level - v0) / a;
  const quad t = left > 0 ? -logq(left) / law[1] : (quad)INFINITY;
  return t > 0 ? t : (quad)INFINITY;
}

static void geared_to(const chain *s, quad t, quad end, quad y[]) {
  int on[ROTORS];
  quad law[2], need[ROTORS][2];
  for (int pieces = 0; pieces < 1000 && t < end; pieces++) {
    quad v = y[1], way = v > 0 ? 1 : -1;
    if (v == 0) {
      geared_ways(s, 0, 1, on, law, need);
      if (law[0] > 0) {
        way = 1;
      } else {
        geared_ways(s, 0, -1, on, law, need);
        if (law[0] >= 0) return; /* the loss holds it */
      }
    }
    /* Just behind v, on the way on which it goes: at a change of a way both are right at v. */
    geared_ways(s, v, way, on, law, need);
    const quad slope = law[0] - law[1] * v;
    const quad beside = v + slope * 1e-20Q * fmaxq(fabsq(v), 1) / fmaxq(fabsq(slope), 1e-30Q);
    geared_ways(s, v == 0 ? v : beside, way, on, law, need);
    quad next = end - t, level = 0;
    int stops = 0;
    const quad zero = v == 0 ? (quad)INFINITY : reaches(v, law, 0);
    if (zero < next) next = zero, stops = 1;
    for (int i = 0; i + 1 < s->n; i++) {
      if (need[i][1] == 0) continue;
      level = -need[i][0] / need[i][1];
      if (fabsq(level - v) <= 1e-18Q * fmaxq(fabsq(v), 1)) continue;
      const quad at = reaches(v, law, level);
      if (at < next) next = at, stops = 0;
    }
    const quad decay = law[1] * next, a = law[0] - law[1] * v;
    const quad s1 = decay == 0 ? next : -expm1q(-decay) / law[1];
    const quad s2 =
        fabsq(decay) < 1e-9Q
            ? next * next * (0.5Q - decay / 6 + decay * decay / 24 - decay * decay * decay / 120)
            : (next - s1) / law[1];
    y[0] += v * next + a * s2;
    y[1] = stops ? 0 : v + a * s1;
    t += next;
  }
}

static int is_pendulum(const chain *s) {
  const rotor *r = &s->r[0];
  return s->n == 1 && r->mgd != 0 && s->n_contacts == 0 && r->viscous == 0.0 &&
         r->constant == 0.0 && r->amplitude == 0.0 && r->stiffness == 0.0 && r->n_pulses == 0;
}

static void show(quad x) {
  const double high = (double)x;
  printf("%.17g %.17g ", high, (double)(x - high));
}

int main(void) {
  static chain s;
  while (read_chain(&s)) {
    double rows, row_s[ROWS];
    quad at[3 * ROTORS * PULSES], y[2 * ROTORS] = {0}, size[2 * ROTORS], t = s.start, h = 1e-3Q;
    if (!numbers(1, &rows) || !(rows <= ROWS) || !numbers((int)rows, row_s)) return 1;
    const int n_breaks = breaks_of(&s, at);
    int k = 0, good = 1;
    while (k < n_breaks && at[k] <= t) k++;
    for (int i = s.n; i-- > 0;) { /* of the first rotor of each unit */
      y[2 * s.r[i].unit] = s.r[i].theta0;
      y[2 * s.r[i].unit + 1] = s.r[i].omega0;
    }
    for (int i = 0; i < 2 * s.m; i++) size[i] = fmaxq(1e-3Q, fabsq(y[i]));
    set_piece(&s, t);
    if (s.n_contacts) good = choose_modes(&s, t, y, size, -1);
    for (int i = 0; i < (int)rows && good; i++) {
      for (;;) {
        const int at_break = k < n_breaks && at[k] <= (quad)row_s[i];
        const quad end = at_break ? at[k] : (quad)row_s[i];
        if (loses(&s))
          geared_to(&s, t, end, y);
        else if (is_pendulum(&s))
          pendulum_to(&s, end, y);
        else if (linear(&s))
          linear_to(&s, t, end, y);
        else
          good = march(&s, &t, y, end, &h, size);
        t = end;
        if (!at_break || !good) break;
        k++;
        set_piece(&s, t);
        for (int j = 0; j < 2 * s.m; j++) size[j] = fmaxq(size[j], fabsq(y[j]));
        if (s.n_contacts) good = choose_modes(&s, t, y, size, -1);
      }
      for (int j = 0; j < s.n && good; j++) {
        show(angle_of(&s, y, j));
        show(y[2 * s.r[j].unit + 1] / s.r[j].over);
      }
    }
    printf("\n");
    fflush(stdout);
  }
  return 0;
}
