#include "scene/chain/links.h"

#include <float.h>
#include <math.h>

#include "ground/real.h"

int rot_links_masses(rot_links *c, const double mass_kg[]) {
  double total = 0.0, below = 0.0;
  int normal = 1;
  for (size_t i = 0; i < c->n; i++) total += mass_kg[i];
  for (size_t i = c->n; i-- > 0;) {
    c->fraction[i] = mass_kg[i] / total;
    c->below[i] = below;
    below += c->fraction[i];
    normal = normal && c->fraction[i] >= DBL_MIN / ROT_EPS;
  }
  c->total_kg = total;
  return normal && total < INFINITY;
}

double rot_links_inertia(const rot_links *c, size_t i, size_t j) {
  const size_t lower = i > j ? i : j;
  const double part = i == j ? rot_links_second(c) : rot_links_first(c);
  return c->length_m[i] * (c->length_m[j] * (part * c->fraction[lower] + c->below[lower]));
}

double rot_links_weight(const rot_links *c, size_t i) {
  return c->length_m[i] * (rot_links_first(c) * c->fraction[i] + c->below[i]);
}

double rot_links_joint(const rot_links *c, const double omega[], size_t i) {
  if (c->joint_n_m_s[i] == 0.0) return 0.0;
  return -c->joint_n_m_s[i] * (omega[i] - (i ? omega[i - 1] : 0.0));
}

void rot_links_sine(double theta, double low, double *sine, double *cosine) {
  const double s = sin(theta), c = cos(theta);
  *sine = s + low * c;
  *cosine = c - low * s;
}

/* Articulated body of the chain below a joint: force = mass * acceleration + bias of that joint, in
 * components along e and t of its first link. */
typedef struct articulated {
  double ee, et, tt; /* mass matrix over the total mass */
  double det;        /* ee tt - et^2 */
  double bias_e, bias_t;
} articulated;

/* Rotation into the axes of the link above; sine, cosine: of the angle between the two links. */
static articulated turned(const articulated *p, double sine, double cosine) {
  const double cs = cosine * sine, cc = cosine * cosine, ss = sine * sine;
  return (articulated){
      p->ee * cc - 2.0 * p->et * cs + p->tt * ss, (p->ee - p->tt) * cs + p->et * (cc - ss),
      p->ee * ss + 2.0 * p->et * cs + p->tt * cc, p->det,
      p->bias_e * cosine - p->bias_t * sine,      p->bias_e * sine + p->bias_t * cosine};
}

void rot_links_accelerations(const rot_links *c, const double theta[], const double low[],
                             const double omega[], double acceleration[]) {
  const size_t n = c->n;
  const double f = rot_links_first(c), h = rot_links_second(c);
  /* h - f^2 and 1 + h - 2 f, exactly 0 for points. */
  const double spread = c->rods ? 1.0 / 12.0 : 0.0, across = c->rods ? 1.0 / 3.0 : 0.0;
  double sine[ROT_LINKS_MAX], cosine[ROT_LINKS_MAX]; /* relative to the link above */
  double d[ROT_LINKS_MAX], et[ROT_LINKS_MAX], free[ROT_LINKS_MAX];
  articulated p = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  double below = 0.0; /* torque of the joint at the lower end on the link below */
  for (size_t k = n; k-- > 0;) {
    if (k + 1 < n) p = turned(&p, sine[k + 1], cosine[k + 1]);
    double lo = 0.0;
    const double difference = k ? rot_two_sum(theta[k], -theta[k - 1], &lo) : theta[0];
    rot_links_sine(difference, lo + (low[k] - (k ? low[k - 1] : 0.0)), &sine[k], &cosine[k]);
    const double m = c->fraction[k], l = c->length_m[k], spin = l * omega[k] * omega[k];
    const double above = rot_links_joint(c, omega, k);
    const double pull = (above - below) / c->total_kg / l;
    const double q = spread * m + across * p.tt; /* divided by m */
    d[k] = h * m + p.tt;
    et[k] = p.et;
    /* With the upper joint at rest: l theta'' = free. */
    const double rest = spin * p.et - p.bias_t;
    free[k] = (pull + rest) / d[k];
    const double mass = p.ee * (h * m / d[k]) + p.det / d[k]; /* ee - et^2/d */
    articulated next;
    next.ee = m + mass;
    next.et = -p.et * ((f - h) * m / d[k]);
    next.tt = m * (q / d[k]);
    next.det = m * ((m * q + spread * m * p.ee) / d[k] +
                    p.det / d[k] * ((q + (f - h) * (f - h) * m) / d[k]));
    next.bias_e = p.et * ((pull - p.bias_t) / d[k]) + p.bias_e - spin * (f * m + mass);
    next.bias_t = pull * ((f * m + p.tt) / d[k]) + rest * ((f - h) * m / d[k]);
    p = next;
    below = above;
  }
  /* Acceleration of each joint minus gravity. */
  double e = -c->gravity_m_per_s2 * cosine[0], t = c->gravity_m_per_s2 * sine[0];
  for (size_t k = 0; k < n; k++) {
    const double l = c->length_m[k];
    const double end = free[k] - (et[k] * e + (f - h) * c->fraction[k] * t) / d[k];
    acceleration[k] = (end - t) / l;
    const double along = e - l * omega[k] * omega[k];
    if (k + 1 == n) break;
    e = along * cosine[k + 1] + end * sine[k + 1];
    t = end * cosine[k + 1] - along * sine[k + 1];
  }
}
