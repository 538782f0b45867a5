#include "scene/shaft/decoupled.h"

#include <math.h>

#include "ground/dd.h"
#include "maths/divided.h"
#include "ground/gauss.h"
#include "maths/phi.h"
#include "ground/real.h"

/* Impulse response, b = damping/2, nu^2 = sigma^2 - b^2: fall = exp(-b t) sin(nu t)/nu, stay =
 * exp(-b t) cos(nu t), drop = stay - b fall; with sinh and cosh for overcritical damping. */
typedef struct impulse {
  double fall, stay, drop;
} impulse;

/* (sigma, b, t) => impulse response. */
static impulse impulse_at(double sigma, double sigma_lo, double b, rot_dd time) {
  impulse x;
  const double t = time.hi;
  const double mu = sqrt(fabs(b - sigma)) * sqrt(b + sigma);
  if (b <= sigma) {
    /* Phase mu t in twice the precision. */
    const rot_dd w = {sigma, sigma_lo == sigma_lo ? sigma_lo : 0.0};
    rot_dd nu = w;
    if (b > 0.0) {
      const double ratio = b / sigma;
      rot_dd one = {1.0, 0.0}, square = rot_dd_mul((rot_dd){-ratio, 0.0}, (rot_dd){ratio, 0.0});
      nu = rot_dd_mul(w, rot_dd_sqrt(rot_dd_add(one, square)));
    }
    const rot_dd phase = rot_dd_mul(nu, time);
    const double e = exp(-b * t), lo = isfinite(phase.lo) ? phase.lo : 0.0;
    double sine, cosine;
    rot_sin_cos(phase.hi, lo, &sine, &cosine);
    x.fall = e * (mu * fabs(t) > 0.0 ? sine / mu : t);
    x.stay = e * cosine;
    x.drop = x.stay - b * x.fall;
    return x;
  }
  const double slow = sigma * (sigma / (b + mu)), fast = b + mu;
  const double e = exp(-slow * t), gap = -expm1(-2.0 * mu * t);
  x.fall = mu * fabs(t) > 0.0 ? e * gap / (2.0 * mu) : t * e;
  x.stay = e * (1.0 - 0.5 * gap);
  /* For large t stay and b fall cancel up to slow/mu. */
  x.drop =
      mu * fabs(t) < 1.0 ? x.stay - b * x.fall : 0.5 * (fast / mu * exp(-fast * t) - slow / mu * e);
  if (!isfinite(x.fall) && t > 0.0) x = (impulse){0.0, 0.0, 0.0};
  return x;
}

/* Integral of `fall` from 0 to t: the angle by a torque of 1. */
static double turned_by_force(double sigma, double b, double t, const impulse *x) {
  /* `fall` is positive: quadrature has no cancellation at short times; the closed forms cancel
   * there. */
  if (fmax(sigma, b) * fabs(t) <= 2.0) {
    double sum = 0.0;
    for (int i = 0; i < 12; i++) {
      const rot_gauss_node at = rot_gauss(i);
      sum += at.weight * impulse_at(sigma, 0.0, b, (rot_dd){at.x * t, 0.0}).fall;
    }
    return sum * t;
  }
  const double mu = sqrt(fabs(b - sigma)) * sqrt(b + sigma);
  if (b > sigma && mu * fabs(t) >= 1.0) {
    double slow[2], fast[2];
    rot_phi(sigma * (sigma / (b + mu)) * t, 0.0, 1, slow);
    rot_phi((b + mu) * t, 0.0, 1, fast);
    return t * (slow[1] - fast[1]) / (2.0 * mu);
  }
  return (1.0 - (x->stay + b * x->fall)) / sigma / sigma;
}

/* (p, r) at the start, t => (p, r) at t. */
static void move_mode(double sigma, double sigma_lo, double damp, double force, rot_dd time,
                      double *p, double *r) {
  const double p0 = *p, r0 = *r, t = time.hi;
  if (sigma == 0.0) {
    double phi[3];
    rot_phi(damp * t, 0.0, 2, phi);
    *r = r0 * phi[0] + force * t * phi[1];
    *p = p0 + (r0 * t * phi[1] + force * t * t * phi[2]);
    return;
  }
  const double b = 0.5 * damp;
  const impulse x = impulse_at(sigma, sigma_lo, b, time);
  const double turned = force == 0.0 ? 0.0 : force * turned_by_force(sigma, b, t, &x);
  *r = r0 * x.drop + (force - sigma * p0) * x.fall;
  *p = p0 * (x.stay + b * x.fall) + sigma * (r0 * x.fall + turned);
}

/* Cases: sigma = 0; backward in time (errors grow with the damping); forward. */
double rot_shaft_mode_error(const rot_shaft_modes *s, size_t m, double t) {
  const double sigma = s->sigma[m], b = 0.5 * s->damp[m], T = fabs(t);
  const double start = hypot(s->p0[m], s->r0[m]), force = fabs(s->force[m]);
  const double reach = sigma > 0.0 ? fmin(T, 2.0 / sigma) : T;
  const double leak = s->leak[m] + s->force_leak[m] * reach;
  if (sigma == 0.0) {
    const double grown = t < 0.0 ? exp(2.0 * b * T) * (1.0 + 2.0 * b * T) : 1.0;
    return grown * (leak + fabs(s->r0[m]) + force * T);
  }
  const double driven = force * fmin(T, 2.0 / sigma);
  if (t < 0.0) return (start + leak + driven) * exp(2.0 * b * T) * (1.0 + (sigma + b) * T);
  /* What the start leaves: exp(A t) at most (1 + 2 b t) exp(-b t), overdamped (1 + 2 sigma t)
   * exp(-slow t). The rounding of b changes nu by the fraction b^2/nu of it, and exp(-b t) by the
   * fraction b t. */
  double phase = 1.0, slow = b;
  if (b < sigma) {
    const double known = s->sigma_off[m] / ROT_EPS;
    phase += (known * sigma + b + b * (b / sigma)) * T * exp(-b * T);
  } else {
    slow = sigma * (sigma / (b + sqrt(b - sigma) * sqrt(b + sigma)));
  }
  const double left = fmin(1.0, (1.0 + 2.0 * fmin(b, sigma) * T) * exp(-slow * T));
  return s->leak[m] * left + s->force_leak[m] * reach + start * (left + phase - 1.0) +
         driven * phase;
}

double rot_shaft_roundings(const rot_shaft_modes *s) {
  return fmin(4.0 + 2.0 * (double)s->n, 24.0);
}

void rot_shaft_decoupled_at(const rot_shaft_modes *s, rot_dd t, double p[], double r[],
                            double error[]) {
  for (size_t m = 0; m < s->n; m++) {
    p[m] = s->p0[m];
    r[m] = s->r0[m];
    move_mode(s->sigma[m], s->sigma_lo[m], s->damp[m], s->force[m], t, &p[m], &r[m]);
    error[m] = ROT_EPS * rot_shaft_roundings(s) * rot_shaft_mode_error(s, m, t.hi);
    error[s->n + m] = error[m];
  }
}
