#include "tables/collide_flow.h"

#include <math.h>
#include <string.h>

enum {
  TERMS = 24,      /* of the series of a step */
  MAX_STEPS = 5000 /* a slip that stops takes some 15 */
};

/* Slip relative to the velocity that counts as 0, stick: rounding. */
static const double slip_gone = 0x1p-60;

typedef enum phase { COMPRESSION, RESTITUTION, ENDED } phase;

/* dp = (-a t, b) dq along the slip direction t, with a/b the friction coefficient. */
typedef struct flow {
  const rot_contact *c;
  double a, b;
  double slip;          /* speed, >= 0 */
  double t[2];          /* direction of the slip, unit vector */
  double normal;        /* u_n */
  double p[3];          /* impulse so far */
  double start;         /* |u_n| at the start */
  double speed;         /* max of slip and |u_n| at the start */
  double compressed;    /* work of compression, >= 0 */
  double restored;      /* work of restitution, >= 0 */
  double compression_p; /* p_n at the end of compression */
  double target;        /* work, p_n or u_n that ends the restitution, by the law */
  double heat;          /* work of friction, >= 0 */
  phase phase;
} flow;

static void begin_restitution(flow *f) {
  const double e = f->c->restitution;
  f->normal = 0.0;
  f->phase = RESTITUTION;
  f->compression_p = f->p[2];
  switch (f->c->law) {
  case ROT_ENERGETIC: f->target = e * e * f->compressed; break;
  case ROT_KINETIC: f->target = (1.0 + e) * f->p[2]; break;
  default: f->target = e * f->start; break;
  }
  if (e <= 0.0 || (f->c->law == ROT_ENERGETIC && f->restored >= f->target) ||
      (f->c->law == ROT_KINETIC && f->p[2] >= f->target))
    f->phase = ENDED;
}

/* ---- constant rates: stick, a fixed direction of slip, no friction --------------------------- */

/* => length q > 0 with u q + h q^2/2 = c; Inf if there is none */
static double length_of_work(double u, double h, double c) {
  const double square = u * u + 2.0 * h * c;
  if (!(square >= 0.0)) return HUGE_VAL;
  const double below = u + sqrt(square);
  return below > 0.0 ? 2.0 * c / below : HUGE_VAL;
}

/* Integrates dp = dir dq up to q = max or the end of the collision, with constant rates of u_n and
 * of the slip. */
static void straight(flow *f, const double dir[3], double rate, double slip_rate, double friction,
                     double max) {
  double left = max;
  while (f->phase != ENDED && left > 0.0) {
    const double u = f->normal, b = dir[2];
    /* u_n increasing through 0 ends the compression; decreasing, it starts another one. */
    const int meets = f->phase == COMPRESSION ? rate > 0.0 : rate < 0.0;
    const double zero = meets ? fmax(0.0, -u / rate) : HUGE_VAL;
    double end = HUGE_VAL, q = left;
    if (f->phase == RESTITUTION) {
      if (f->c->law == ROT_ENERGETIC)
        end = b > 0.0 ? length_of_work(u, rate, (f->target - f->restored) / b) : HUGE_VAL;
      else if (f->c->law == ROT_KINETIC)
        end = b > 0.0 ? (f->target - f->p[2]) / b : HUGE_VAL;
      else if (rate > 0.0)
        end = (f->target - u) / rate;
      if (!(end > 0.0)) end = 0.0;
      q = fmin(q, end);
    }
    if (zero <= q && zero < end) q = zero;
    if (!(q < HUGE_VAL)) { /* no end: the numbers exceed double precision */
      f->normal = NAN;
      f->phase = ENDED;
      return;
    }
    const double work = b * (u * q + 0.5 * rate * q * q);
    if (f->phase == COMPRESSION) f->compressed += fmax(0.0, -work);
    if (f->phase == RESTITUTION) f->restored += fmax(0.0, work);
    for (int i = 0; i < 3; i++) f->p[i] += dir[i] * q;
    const double slip = fmax(0.0, f->slip + slip_rate * q);
    f->heat += 0.5 * friction * (f->slip + slip) * q;
    f->slip = slip;
    f->normal = u + rate * q;
    left -= q;
    if (f->phase == COMPRESSION) {
      if (q == zero) begin_restitution(f);
    } else if (q == end) {
      f->phase = ENDED;
    } else if (q == zero) {
      f->normal = 0.0;
      f->phase = COMPRESSION;
    }
  }
}

/* ---- direction of a slip that starts from rest ----------------------------------------------- */

/* => unit vector t, rate r > 0 with (a Ktt + r) t = b k: the only direction in which a slip can
 * grow */
static double outward(const rot_contact *c, double a, double b, double t[2]) {
  const double k0 = a * c->k[0][0], k1 = a * c->k[1][1], k01 = a * c->k[0][1];
  const double half = 0.5 * (k0 - k1), length = hypot(half, k01);
  const double mean = 0.5 * (k0 + k1);
  const double large = mean + length, det = k0 * k1 - k01 * k01;
  const double small = large > 0.0 ? fmax(0.0, det / large) : 0.0;
  /* Exact if the contact axes are principal axes. */
  const double angle = 0.5 * atan2(k01, half);
  const double across_x = half < 0.0 ? 1.0 : 0.0;
  const double x[2] = {k01 == 0.0 ? 1.0 - across_x : cos(angle),
                       k01 == 0.0 ? across_x : sin(angle)};
  const double along = b * (c->k[0][2] * x[0] + c->k[1][2] * x[1]);
  const double across = b * (c->k[1][2] * x[0] - c->k[0][2] * x[1]);
  /* 1/|..| - 1 is concave and increasing in r: Newton's steps approach the root from one side. */
  double r = 0.0, lo = 0.0, hi = hypot(along, across);
  for (int i = 0; i < 100; i++) {
    const double f1 = along / (large + r), f2 = across / (small + r);
    const double size = hypot(f1, f2), slope = f1 * f1 / (large + r) + f2 * f2 / (small + r);
    if (!(size > 1.0)) hi = fmin(hi, r);
    if (size >= 1.0) lo = fmax(lo, r);
    double next = r + size * size * (size - 1.0) / slope;
    if (!(next > lo && next < hi)) next = lo + 0.5 * (hi - lo);
    if (fabs(next - r) <= 0x1p-52 * next) break;
    r = next;
  }
  const double y[2] = {along / (large + r), across / (small + r)}, size = hypot(y[0], y[1]);
  t[0] = (y[0] * x[0] - y[1] * x[1]) / size;
  t[1] = (y[0] * x[1] + y[1] * x[0]) / size;
  return r;
}

static double rate_along(const flow *f, const double dir[3]) {
  const rot_contact *c = f->c;
  return c->k[2][0] * dir[0] + c->k[2][1] * dir[1] + c->k[2][2] * dir[2];
}

/* Integrates from zero slip to the end: stick within the friction cone, else slip. */
static void from_stick(flow *f) {
  const double(*r)[3] = f->c->root;
  double q[2];
  q[1] = r[1][2] / r[1][1];
  q[0] = (r[0][2] - r[0][1] * q[1]) / r[0][0];
  f->slip = 0.0;
  if (f->b * hypot(q[0], q[1]) <= f->a) {
    const double dir[3] = {-q[0], -q[1], 1.0};
    straight(f, dir, r[2][2] * r[2][2], 0.0, 0.0, HUGE_VAL);
    return;
  }
  const double grows = outward(f->c, f->a, f->b, f->t);
  const double dir[3] = {-f->a * f->t[0], -f->a * f->t[1], f->b};
  straight(f, dir, rate_along(f, dir), grows, f->a, HUGE_VAL);
}

/* ---- slip of changing direction: Taylor series in tau, dq = slip dtau ------------------------ */

typedef struct series {
  double c[TERMS], s[TERMS]; /* direction */
  double slip[TERMS];        /* speed */
  double normal[TERMS];      /* u_n */
  double rise[TERMS];        /* du_n/dq */
  double q[TERMS];           /* int dq */
  double x[TERMS], y[TERMS]; /* int t dq */
  double work[TERMS];        /* int u_n dq */
  double heat[TERMS];        /* int slip dq */
} series;

static double product(const double a[], const double b[], int n) {
  double sum = 0.0;
  for (int i = 0; i <= n; i++) sum += a[i] * b[n - i];
  return sum;
}

static double value(const double a[], double x) {
  double sum = a[TERMS - 1];
  for (int i = TERMS - 2; i >= 0; i--) sum = sum * x + a[i];
  return sum;
}

static double slope(const double a[], double x) {
  double sum = (TERMS - 1) * a[TERMS - 1];
  for (int i = TERMS - 2; i >= 1; i--) sum = sum * x + i * a[i];
  return sum;
}

/* state => coefficients of all series, term by term */
static void expand(const flow *f, series *z) {
  const double(*k)[3] = f->c->k;
  const double a = f->a, b = f->b;
  double along[TERMS], across[TERMS], f1[TERMS], f2[TERMS];
  memset(z, 0, sizeof *z);
  z->c[0] = f->t[0];
  z->s[0] = f->t[1];
  z->slip[0] = f->slip;
  z->normal[0] = f->normal;
  for (int n = 0; n < TERMS - 1; n++) {
    const double one = n == 0 ? 1.0 : 0.0, next = 1.0 / (n + 1);
    f1[n] = one * b * k[0][2] - a * (k[0][0] * z->c[n] + k[0][1] * z->s[n]);
    f2[n] = one * b * k[1][2] - a * (k[1][0] * z->c[n] + k[1][1] * z->s[n]);
    z->rise[n] = one * b * k[2][2] - a * (k[2][0] * z->c[n] + k[2][1] * z->s[n]);
    along[n] = product(z->c, f1, n) + product(z->s, f2, n);
    across[n] = product(z->c, f2, n) - product(z->s, f1, n);
    z->c[n + 1] = -product(z->s, across, n) * next;
    z->s[n + 1] = product(z->c, across, n) * next;
    z->normal[n + 1] = product(z->slip, z->rise, n) * next;
    z->q[n + 1] = z->slip[n] * next;
    z->x[n + 1] = product(z->slip, z->c, n) * next;
    z->y[n + 1] = product(z->slip, z->s, n) * next;
    z->work[n + 1] = product(z->slip, z->normal, n) * next;
    z->heat[n + 1] = product(z->slip, z->slip, n) * next;
    z->slip[n + 1] = product(z->slip, along, n) * next;
  }
}

/* => step for which the last two terms are below rounding: of the direction, and of velocities and
 * energies relative to the largest */
static double reach(const series *z, double speed) {
  double step = HUGE_VAL;
  for (int n = TERMS - 2; n < TERMS; n++) {
    const double size = fmax(fmax(fmax(fabs(z->c[n]), fabs(z->s[n])),
                                  fmax(fabs(z->slip[n]), fabs(z->normal[n])) / speed),
                             fmax(fabs(z->heat[n]), fabs(z->work[n])) / (speed * speed));
    if (size > 0.0) step = fmin(step, pow(0x1p-56 / size, 1.0 / n));
  }
  return fmin(step, 64.0);
}

/* => zero of a(x) - c, which changes sign between 0 and `hi`, by Newton's method and bisection */
static double zero_of(const double a[], double c, double hi) {
  const int rises = a[0] < c;
  double lo = 0.0, x = 0.5 * hi;
  for (int i = 0; i < 100; i++) {
    const double y = value(a, x) - c;
    if ((y < 0.0) == rises)
      lo = x;
    else
      hi = x;
    double next = x - y / slope(a, x);
    if (!(next > lo && next < hi)) next = lo + 0.5 * (hi - lo);
    if (fabs(next - x) <= 0x1p-52 * x) return next;
    x = next;
  }
  return x;
}

/* Advances the state by tau. */
static void commit(flow *f, const series *z, double tau) {
  const double work = f->b * value(z->work, tau);
  if (f->phase == COMPRESSION)
    f->compressed += fmax(0.0, -work);
  else
    f->restored += fmax(0.0, work);
  f->p[0] -= f->a * value(z->x, tau);
  f->p[1] -= f->a * value(z->y, tau);
  f->p[2] += f->b * value(z->q, tau);
  f->heat += f->a * fmax(0.0, value(z->heat, tau));
  f->slip = fmax(0.0, value(z->slip, tau));
  f->normal = value(z->normal, tau);
  const double c = value(z->c, tau), s = value(z->s, tau), size = hypot(c, s);
  f->t[0] = c / size;
  f->t[1] = s / size;
}

/* One step, in which u_n is monotonic, up to a change of phase or the end. */
static void turn(flow *f) {
  series z;
  expand(f, &z);
  double tau = reach(&z, f->speed);
  if (value(z.rise, 0.0) * value(z.rise, tau) < 0.0) {
    const double flat = zero_of(z.rise, 0.0, tau);
    if (flat > 1e-9 * tau) tau = flat;
  }
  const double to = value(z.normal, tau);
  if (f->phase == COMPRESSION) {
    if (to < 0.0) {
      commit(f, &z, tau);
    } else {
      commit(f, &z, zero_of(z.normal, 0.0, tau));
      begin_restitution(f);
    }
    return;
  }
  const int falls = to < 0.0;
  if (falls) tau = f->normal > 0.0 ? zero_of(z.normal, 0.0, tau) : 0.0;
  double c = 0.0;
  const double *of = NULL;
  switch (f->c->law) {
  case ROT_ENERGETIC:
    of = z.work;
    c = f->b > 0.0 ? (f->target - f->restored) / f->b : HUGE_VAL;
    break;
  case ROT_KINETIC:
    of = z.q;
    c = f->b > 0.0 ? (f->target - f->p[2]) / f->b : HUGE_VAL;
    break;
  default:
    of = z.normal;
    c = f->target;
    break;
  }
  if (c <= of[0] || (tau > 0.0 && value(of, tau) >= c)) {
    if (c > of[0]) commit(f, &z, zero_of(of, c, tau));
    f->phase = ENDED;
    return;
  }
  commit(f, &z, tau);
  if (falls) {
    f->normal = 0.0;
    f->phase = COMPRESSION;
  }
}

int rot_contact_flow(const rot_contact *contact, const double u[3], rot_contact_end *end) {
  const double mu = contact->friction;
  flow f;
  memset(&f, 0, sizeof f);
  f.c = contact;
  f.a = mu > 1.0 ? 1.0 : mu;
  f.b = mu > 1.0 ? 1.0 / mu : 1.0;
  f.slip = hypot(u[0], u[1]);
  f.normal = u[2];
  f.start = -u[2];
  f.phase = COMPRESSION;
  f.speed = fmax(f.slip, f.start);
  const double gone = slip_gone * f.speed;
  if (!(mu > 0.0)) {
    const double dir[3] = {0.0, 0.0, 1.0};
    straight(&f, dir, contact->k[2][2], 0.0, 0.0, HUGE_VAL);
    f.slip = 1.0;
  } else {
    if (f.slip > gone) {
      f.t[0] = u[0] / f.slip;
      f.t[1] = u[1] / f.slip;
    }
    double size = 0.0;
    for (int i = 0; i < 2; i++)
      for (int j = 0; j < 3; j++) size = fmax(size, (j < 2 ? f.a : f.b) * fabs(contact->k[i][j]));
    for (int i = 0; f.slip > gone && f.phase != ENDED && i < MAX_STEPS; i++) {
      const double dir[3] = {-f.a * f.t[0], -f.a * f.t[1], f.b};
      double rate[2];
      for (int j = 0; j < 2; j++)
        rate[j] = contact->k[j][0] * dir[0] + contact->k[j][1] * dir[1] + contact->k[j][2] * dir[2];
      const double along = rate[0] * f.t[0] + rate[1] * f.t[1];
      const double across = rate[1] * f.t[0] - rate[0] * f.t[1];
      if (fabs(across) > 0x1p-51 * size) {
        turn(&f);
      } else { /* constant direction */
        straight(&f, dir, rate_along(&f, dir), along, f.a,
                 along < 0.0 ? f.slip / -along : HUGE_VAL);
        if (f.phase != ENDED) f.slip = 0.0;
      }
    }
    if (f.phase != ENDED && f.slip <= gone) from_stick(&f);
  }
  memcpy(end->p, f.p, sizeof f.p);
  end->compression_work = f.compressed;
  end->restitution_work = f.restored;
  end->slip_heat = f.heat;
  end->sticks = f.slip <= gone;
  return f.phase == ENDED && isfinite(f.normal);
}
