#include "rot_rotors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_dd.h"
#include "rot_eigen.h"
#include "rot_expm.h"
#include "rot_phi.h"
#include "rot_real.h"

enum { ROWS_PER_ANCHOR = 64 };

/* Modes: 0 is the mean motion, 1 .. floppy are those without a spring (groups of rotors that
 * missing springs leave), the rest are twists, slowest first. In each the motion is q, with
 * p = sigma q (q itself where sigma = 0) and r = q'. */
typedef struct shaft {
  const rot_rotors_params *p;
  size_t n, floppy;
  double inertia, root_inertia;      /* all together, and its square root */
  double theta0, omega0;             /* means at the start, weighted by inertia */
  double theta_spread, omega_spread; /* largest distance of a rotor from the first, at the start */
  double alpha, decay;               /* mean: omega' = alpha - decay omega, if it is by itself */
  int mean_alone;                    /* external damping does not couple the mean to the twists */
  int decoupled;                     /* each mode by itself */
  double norm;                       /* of the twists' matrix, 1/s */
  double *memory;
  double *leak, *force_leak; /* n: sizes whose roundings p0 and r0, and force, carry */
  double *sigma_lo;          /* n: what sigma lacks, to 1e-30 */
  double *share;             /* J_i / sum J */
  double *sigma, *damp;      /* n: frequency; the damping of each mode by itself */
  double *p0, *r0, *force;   /* n: state at the start, modal torque; r0[0] = omega0 */
  double *shape;             /* n x n: theta_i per q_m; column 0 is 1 */
  double *twist;             /* (n - 1) x n: shape_i - shape_(i+1) */
  double *lever;             /* (n - 1) x n: elastic torque per p_m */
  double *coupling;          /* n x n: damping of the modes, masses 1 */
} shaft;

/* ---- building it ----------------------------------------------------------------------------- */

static int allocate(shaft *s, size_t n) {
  double *next = s->memory = calloc(n * (4 * n + 9), sizeof *next);
  if (!next) return 0;
  double **small[] = {&s->leak, &s->force_leak, &s->sigma_lo, &s->share, &s->sigma,
                      &s->damp, &s->p0,         &s->r0,       &s->force};
  double **large[] = {&s->shape, &s->twist, &s->lever, &s->coupling};
  for (int i = 0; i < 9; i++, next += n) *small[i] = next;
  for (int i = 0; i < 4; i++, next += n * n) *large[i] = next;
  return 1;
}

/* Weighted by inertia, from the first one on: rotors that agree have exactly their own mean. */
static double mean_of(const shaft *s, const double x[]) {
  double sum = 0.0, lo = 0.0;
  for (size_t i = 1; i < s->n; i++) {
    double e, d = rot_two_prod(s->share[i], x[i] - x[0], &e);
    rot_accumulate(&sum, &lo, d);
    lo += e;
  }
  return x[0] + (sum + lo);
}

/* The twists: singular vectors of sqrt(k) B J^-1/2, whose small singular values keep their digits
 * however much the rotors and springs differ. Fills sigma and lever. */
static rot_status find_twists(shaft *s) {
  const size_t n = s->n, springs = n - 1 - s->floppy;
  const double *k = s->p->stiffness_n_m_per_rad, *J = s->p->inertia_kg_m2;
  if (springs == 0) return ROT_OK;
  double *g = calloc((n + springs) * springs, sizeof *g);
  if (!g) return ROT_ENOMEM;
  double *u = g + n * springs;
  size_t column = 0;
  for (size_t j = 0; j + 1 < n; j++) {
    if (k[j] == 0.0) continue;
    g[j * springs + column] = sqrt(k[j]) / sqrt(J[j]);
    g[(j + 1) * springs + column] = -sqrt(k[j]) / sqrt(J[j + 1]);
    column++;
  }
  rot_status status = rot_eigen_singular(n, springs, g, s->sigma + 1 + s->floppy, u);
  for (size_t j = 0, row = 0; status == ROT_OK && j + 1 < n; j++) {
    if (k[j] == 0.0) continue;
    for (size_t m = 0; m < springs; m++) {
      s->lever[j * n + 1 + s->floppy + m] = sqrt(k[j]) * u[row * springs + m];
    }
    row++;
  }
  free(g);
  return status == ROT_EVALUE ? ROT_ERANGE : status;
}

/* Shapes of the twists in rotors first .. last, joined by springs: each rotor from the twists to
 * its right and left, with the shares of inertia beyond. No difference of large numbers, and no
 * net momentum. */
static void shape_group(shaft *s, size_t first, size_t last) {
  const size_t n = s->n;
  const double *k = s->p->stiffness_n_m_per_rad;
  double all = 0.0, left = 0.0;
  for (size_t i = first; i <= last; i++) all += s->share[i];
  for (size_t j = first; j < last; j++) {
    double right = 0.0;
    left += s->share[j];
    for (size_t i = j + 1; i <= last; i++) right += s->share[i];
    for (size_t m = 1 + s->floppy; m < n; m++) {
      const double twist = s->sigma[m] * (s->lever[j * n + m] / k[j]);
      s->twist[j * n + m] = twist;
      for (size_t i = first; i <= j; i++) s->shape[i * n + m] += twist * (right / all);
      for (size_t i = j + 1; i <= last; i++) s->shape[i * n + m] -= twist * (left / all);
    }
  }
}

/* Mode f moves the groups before group f against group f. */
static void shape_floppy(shaft *s, size_t f, size_t first, size_t last) {
  double before = 0.0, here = 0.0;
  for (size_t i = 0; i < first; i++) before += s->share[i];
  for (size_t i = first; i <= last; i++) here += s->share[i];
  const double root = s->root_inertia, both = before + here;
  for (size_t i = 0; i < first; i++) s->shape[i * s->n + f] = sqrt(here / both / before) / root;
  for (size_t i = first; i <= last; i++) {
    s->shape[i * s->n + f] = -sqrt(before / both / here) / root;
  }
}

static void find_shapes(shaft *s) {
  const size_t n = s->n;
  const double *k = s->p->stiffness_n_m_per_rad;
  for (size_t first = 0, last = 0, group = 0; first < n; first = ++last, group++) {
    while (last + 1 < n && k[last] > 0.0) last++;
    shape_group(s, first, last);
    if (group > 0) shape_floppy(s, group, first, last);
  }
  for (size_t i = 0; i < n; i++) s->shape[i * n] = 1.0;
  for (size_t j = 0; j + 1 < n; j++) {
    for (size_t m = 1; m < n && k[j] == 0.0; m++) {
      s->twist[j * n + m] = s->shape[j * n + m] - s->shape[(j + 1) * n + m];
    }
  }
}

/* ---- phases of the modes ---------------------------------------------------------------------- */

/* Elastic over kinetic energy of a shape given by its twists, sigma^2 = sum k twist^2 /
 * sum J theta^2 with no net momentum in any group: an error of the shape counts squared, so this
 * has twice its digits. At a phase of 1e5 (k = 1e10 for 1 s) it takes the error of omega from
 * 4e-12 to 1e-16. */
static rot_dd sharp_sigma(const shaft *s, size_t m) {
  const size_t n = s->n;
  const double *k = s->p->stiffness_n_m_per_rad, *J = s->p->inertia_kg_m2;
  /* By powers of two near 1, so that no square leaves the range. */
  int of_k = 0, of_J = 0, of_twist = 0;
  double most_k = 0.0, most_J = 0.0, most = 0.0;
  for (size_t i = 0; i < n; i++) most_J = fmax(most_J, J[i]);
  for (size_t j = 0; j + 1 < n; j++) {
    most_k = fmax(most_k, k[j]);
    most = fmax(most, fabs(s->twist[j * n + m]));
  }
  frexp(most_k, &of_k);
  frexp(most_J, &of_J);
  frexp(most, &of_twist);
  of_J += (of_k - of_J) % 2; /* an even power between them, for the root */
  rot_dd elastic = {0.0, 0.0}, kinetic = {0.0, 0.0};
  for (size_t first = 0, last = 0; first < n; first = ++last) {
    while (last + 1 < n && k[last] > 0.0) last++;
    rot_dd theta = {0.0, 0.0}, momentum = {0.0, 0.0}, inertia = {0.0, 0.0}, energy = {0.0, 0.0};
    for (size_t i = last + 1; i-- > first;) {
      const rot_dd mass = {ldexp(J[i], -of_J), 0.0};
      if (i < last) {
        const rot_dd twist = {ldexp(s->twist[i * n + m], -of_twist), 0.0};
        const rot_dd spring = {ldexp(k[i], -of_k), 0.0};
        theta = rot_dd_add(theta, twist);
        elastic = rot_dd_add(elastic, rot_dd_mul(spring, rot_dd_mul(twist, twist)));
      }
      inertia = rot_dd_add(inertia, mass);
      momentum = rot_dd_add(momentum, rot_dd_mul(mass, theta));
    }
    const rot_dd mean = rot_dd_div(momentum, (rot_dd){-inertia.hi, -inertia.lo});
    theta = mean;
    for (size_t i = last + 1; i-- > first;) {
      if (i < last) {
        theta = rot_dd_add(theta, (rot_dd){ldexp(s->twist[i * n + m], -of_twist), 0.0});
      }
      const rot_dd mass = {ldexp(J[i], -of_J), 0.0};
      energy = rot_dd_add(energy, rot_dd_mul(mass, rot_dd_mul(theta, theta)));
    }
    kinetic = rot_dd_add(kinetic, energy);
  }
  const rot_dd sigma = rot_dd_sqrt(rot_dd_div(elastic, kinetic));
  return rot_dd_ldexp(sigma, (of_k - of_J) / 2);
}

/* Keeps what agrees with the singular value, as it does unless something underflowed. */
static void sharpen(shaft *s) {
  for (size_t m = 1 + s->floppy; m < s->n; m++) {
    const rot_dd sigma = sharp_sigma(s, m);
    if (fabs(sigma.hi - s->sigma[m]) <= 1e-12 * s->sigma[m] && isfinite(sigma.lo)) {
      s->sigma[m] = sigma.hi;
      s->sigma_lo[m] = sigma.lo;
    } else {
      s->sigma_lo[m] = NAN;
    }
  }
}

/* x_i = ratio y_i for all i, to rounding; the ratio is 0 for no damping. */
static int proportional(size_t n, const double x[], const double y[], double *ratio) {
  double least = INFINITY, most = 0.0;
  *ratio = 0.0;
  for (size_t i = 0; i < n; i++) {
    if (x[i] == 0.0 && y[i] == 0.0) continue;
    least = fmin(least, x[i] / y[i]);
    most = fmax(most, x[i] / y[i]);
  }
  if (!(most - least <= 4.0 * ROT_EPS * most || most == 0.0)) return 0;
  *ratio = most;
  return isfinite(most);
}

/* Column 0 of twist is zero, so what acts between the rotors leaves the mean alone, exactly. */
static void find_damping(shaft *s) {
  const size_t n = s->n;
  const double *c = s->p->damping_n_m_s, *d = s->p->viscous_n_m_s, *J = s->p->inertia_kg_m2;
  double of_springs, of_rotors;
  const int springs = proportional(n - 1, c, s->p->stiffness_n_m_per_rad, &of_springs);
  s->mean_alone = proportional(n, d, J, &of_rotors);
  s->decoupled = (springs || n == 2) && s->mean_alone;
  for (size_t a = 0; a < n; a++) {
    for (size_t b = 0; b < n; b++) {
      double sum = 0.0;
      for (size_t j = 0; j + 1 < n; j++) sum += c[j] * s->twist[j * n + a] * s->twist[j * n + b];
      for (size_t i = 0; i < n; i++) {
        if (s->mean_alone) break;
        const double x = a == 0 ? 1.0 / s->root_inertia : s->shape[i * n + a];
        const double y = b == 0 ? 1.0 / s->root_inertia : s->shape[i * n + b];
        sum += d[i] * x * y;
      }
      if (s->mean_alone && a == b) sum += of_rotors;
      s->coupling[a * n + b] = sum;
    }
    s->damp[a] = s->coupling[a * n + a];
    if (springs) s->damp[a] = of_springs * s->sigma[a] * s->sigma[a] + of_rotors;
  }
  s->decay = 0.0;
  for (size_t i = 0; i < n; i++) s->decay += d[i] / s->inertia;
  for (size_t a = 1; a < n; a++) {
    double sum = s->sigma[a];
    for (size_t b = 0; b < n; b++) sum += fabs(s->coupling[a * n + b]);
    if (sum > s->norm) s->norm = sum;
  }
}

static void start_floppy(shaft *s, size_t m) {
  const rot_rotors_params *p = s->p;
  for (size_t i = 0; i < s->n; i++) {
    const double J = p->inertia_kg_m2[i], shape = s->shape[i * s->n + m];
    const double angle = J * shape * (p->theta0_rad[i] - s->theta0);
    const double rate = J * shape * (p->omega0_rad_per_s[i] - s->omega0);
    const double torque = shape * (p->torque_n_m[i] - J * s->alpha);
    s->p0[m] += angle;
    s->r0[m] += rate;
    s->force[m] += torque;
    s->leak[m] += fabs(rate);
    s->force_leak[m] += fabs(torque);
  }
}

typedef struct projection {
  double value, size; /* a sum, and the size that its rounding is of */
} projection;

static projection better_of(projection a, projection b) { return a.size <= b.size ? a : b; }

/* A twist takes its share of angles, rates and torques either from the rotors, with weights
 * J shape, or, by sum J_i shape_i x_i = sum lever_j (x_j - x_(j+1))/sigma, from the springs. With
 * rotors of very different size the springs are better, with springs of very different size the
 * rotors: a shape is rounded by the size of its largest part. */
static void start_twist(shaft *s, size_t m) {
  const rot_rotors_params *p = s->p;
  const size_t n = s->n;
  const double sigma = s->sigma[m];
  projection angle[2] = {{0}}, rate[2] = {{0}}, torque[2] = {{0}};
  double largest = 0.0, carried = 0.0;
  for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(s->shape[i * n + m]));
  for (size_t i = 0; i < n; i++) {
    const double J = p->inertia_kg_m2[i], shape = s->shape[i * n + m];
    const double theta = p->theta0_rad[i] - s->theta0, omega = p->omega0_rad_per_s[i] - s->omega0;
    const double left = p->torque_n_m[i] - J * s->alpha;
    angle[0].value += sigma * (J * shape * theta);
    angle[0].size += sigma * (J * largest * fabs(theta));
    rate[0].value += J * shape * omega;
    rate[0].size += J * largest * fabs(omega);
    torque[0].value += shape * left;
    torque[0].size += largest * fabs(left);
    carried += left;
    if (i + 1 == n || p->stiffness_n_m_per_rad[i] == 0.0) continue;
    const double lever = s->lever[i * n + m], root = sqrt(p->stiffness_n_m_per_rad[i]);
    const double twist = p->theta0_rad[i] - p->theta0_rad[i + 1];
    const double slip = p->omega0_rad_per_s[i] - p->omega0_rad_per_s[i + 1];
    angle[1].value += lever * twist;
    angle[1].size += root * fabs(twist);
    rate[1].value += lever * slip / sigma;
    rate[1].size += root * fabs(slip) / sigma;
    torque[1].value += s->twist[i * n + m] * carried;
    torque[1].size += sigma / root * fabs(carried);
  }
  const projection p0 = better_of(angle[0], angle[1]), r0 = better_of(rate[0], rate[1]);
  /* Beyond a missing spring the torque carried is not zero, and the parts do not add up so. */
  const projection force = s->floppy ? torque[0] : better_of(torque[0], torque[1]);
  s->p0[m] = p0.value;
  s->r0[m] = r0.value;
  s->force[m] = force.value;
  s->leak[m] = p0.size + r0.size;
  s->force_leak[m] = force.size;
}

static void find_start(shaft *s) {
  const rot_rotors_params *p = s->p;
  const size_t n = s->n;
  s->theta0 = mean_of(s, p->theta0_rad);
  s->omega0 = mean_of(s, p->omega0_rad_per_s);
  for (size_t i = 1; i < n; i++) {
    const double theta = fabs(p->theta0_rad[i] - p->theta0_rad[0]);
    const double omega = fabs(p->omega0_rad_per_s[i] - p->omega0_rad_per_s[0]);
    s->theta_spread = fmax(s->theta_spread, theta);
    s->omega_spread = fmax(s->omega_spread, omega);
  }
  for (size_t i = 0; i < n; i++) s->alpha += p->torque_n_m[i] / s->inertia;
  s->r0[0] = s->omega0;
  s->force[0] = s->alpha;
  for (size_t m = 1; m <= s->floppy; m++) start_floppy(s, m);
  for (size_t m = 1 + s->floppy; m < n; m++) start_twist(s, m);
}

static rot_status build(shaft *s, const rot_rotors_params *p) {
  memset(s, 0, sizeof *s);
  s->p = p;
  s->n = p->n;
  if (!allocate(s, p->n)) return ROT_ENOMEM;
  for (size_t i = 0; i < p->n; i++) s->inertia += p->inertia_kg_m2[i];
  for (size_t i = 0; i < p->n; i++) s->share[i] = p->inertia_kg_m2[i] / s->inertia;
  for (size_t j = 0; j + 1 < p->n; j++) s->floppy += p->stiffness_n_m_per_rad[j] == 0.0;
  s->root_inertia = sqrt(s->inertia);
  rot_status status = find_twists(s);
  if (status != ROT_OK) return status;
  find_shapes(s);
  sharpen(s);
  find_damping(s);
  find_start(s);
  return ROT_OK;
}

rot_status rot_rotors_frequencies(const rot_rotors_params *p, double sigma[]) {
  shaft s;
  const rot_status status = build(&s, p);
  if (status == ROT_OK) memcpy(sigma, s.sigma, p->n * sizeof *sigma);
  free(s.memory);
  return status;
}

/* ---- one mode by itself ---------------------------------------------------------------------- */

/* With b = damping/2: fall = exp(-b t) sin(nu t)/nu, stay = exp(-b t) cos(nu t), nu^2 = sigma^2 -
 * b^2; sinh and cosh beyond the critical damping. `drop` is stay - b fall. */
typedef struct impulse {
  double fall, stay, drop;
} impulse;

static impulse impulse_at(double sigma, double sigma_lo, double b, double t) {
  impulse x;
  const double mu = sqrt(fabs(b - sigma)) * sqrt(b + sigma);
  if (b <= sigma) {
    /* The phase mu t to twice the precision. */
    const rot_dd w = {sigma, sigma_lo == sigma_lo ? sigma_lo : 0.0};
    rot_dd nu = w;
    if (b > 0.0) {
      const double ratio = b / sigma;
      rot_dd one = {1.0, 0.0}, square = rot_dd_mul((rot_dd){-ratio, 0.0}, (rot_dd){ratio, 0.0});
      nu = rot_dd_mul(w, rot_dd_sqrt(rot_dd_add(one, square)));
    }
    const rot_dd phase = rot_dd_mul(nu, (rot_dd){t, 0.0});
    const double e = exp(-b * t), sine = sin(phase.hi), cosine = cos(phase.hi);
    const double lo = isfinite(phase.lo) ? phase.lo : 0.0;
    x.fall = e * (mu * fabs(t) > 0.0 ? (sine + cosine * lo) / mu : t);
    x.stay = e * (cosine - sine * lo);
    x.drop = x.stay - b * x.fall;
    return x;
  }
  const double slow = sigma * (sigma / (b + mu)), fast = b + mu;
  const double e = exp(-slow * t), gap = -expm1(-2.0 * mu * t);
  x.fall = mu * fabs(t) > 0.0 ? e * gap / (2.0 * mu) : t * e;
  x.stay = e * (1.0 - 0.5 * gap);
  /* Long after, stay and b fall agree but for slow/mu. */
  x.drop =
      mu * fabs(t) < 1.0 ? x.stay - b * x.fall : 0.5 * (fast / mu * exp(-fast * t) - slow / mu * e);
  if (!isfinite(x.fall) && t > 0.0) x = (impulse){0.0, 0.0, 0.0};
  return x;
}

/* Gauss and Legendre's 12 points in (0, 1). Truncation below 1e-17 for exponentials and sines of
 * up to 3. */
typedef struct node {
  double x, weight;
} node;

static node gauss(int i) {
  static const double place[6] = {0.98156063424671925069, 0.90411725637047485667,
                                  0.76990267419430468703, 0.58731795428661744729,
                                  0.36783149899818019375, 0.12523340851146891547};
  static const double weight[6] = {0.04717533638651182719, 0.10693932599531843096,
                                   0.16007832854334622633, 0.20316742672306592174,
                                   0.23349253653835480876, 0.24914704581340278500};
  const int k = i < 6 ? i : 11 - i;
  return (node){0.5 + (i < 6 ? -0.5 : 0.5) * place[k], 0.5 * weight[k]};
}

/* The integral of `fall` from 0 to t: what a torque of 1 turns. */
static double turned_by_force(double sigma, double b, double t, const impulse *x) {
  /* `fall` is positive, so nothing cancels at short times, where the closed forms do. */
  if (fmax(sigma, b) * fabs(t) <= 2.0) {
    double sum = 0.0;
    for (int i = 0; i < 12; i++) {
      const node at = gauss(i);
      sum += at.weight * impulse_at(sigma, 0.0, b, at.x * t).fall;
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

/* p and r after t, from their values at the start. */
static void move_mode(double sigma, double sigma_lo, double damp, double force, double t, double *p,
                      double *r) {
  const double p0 = *p, r0 = *r;
  if (sigma == 0.0) {
    double phi[3];
    rot_phi(damp * t, 0.0, 2, phi);
    *r = r0 * phi[0] + force * t * phi[1];
    *p = p0 + (r0 * t * phi[1] + force * t * t * phi[2]);
    return;
  }
  const double b = 0.5 * damp;
  const impulse x = impulse_at(sigma, sigma_lo, b, t);
  const double turned = force == 0.0 ? 0.0 : force * turned_by_force(sigma, b, t, &x);
  *r = r0 * x.drop + (force - sigma * p0) * x.fall;
  *p = p0 * (x.stay + b * x.fall) + sigma * (r0 * x.fall + turned);
}

/* Size of the error of (p, r) in units of roundoff: the leak, and the phase turned, while it
 * lasts. */
static double mode_error(const shaft *s, size_t m, double t) {
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
  /* sigma is known to twice the precision, or else to a rounding; b, to a rounding, moves nu by
   * b^2/nu of it, and exp(-b t) by b t. */
  double phase = 1.0;
  if (b < sigma) {
    const double known = isnan(s->sigma_lo[m]) ? 1.0 : 64.0 * ROT_EPS;
    phase += (known * sigma + b + b * (b / sigma)) * T * exp(-b * T);
  }
  return leak + (start + driven) * (1.0 + phase);
}

/* ---- all modes together ---------------------------------------------------------------------- */

/* State (p or q/T in n places, r in n places, the torque as one number) after a step h obeys
 * y' = A y; `a` is A h. Velocities have masses 1, so A is -A' but for the damping, and exp(A t)
 * does not grow. */
typedef struct stepper {
  size_t size;
  double step, unit; /* h; the value of the last place */
  double *a, *e, *work;
} stepper;

static size_t system_room(size_t n) {
  const size_t size = 2 * n + 1;
  return 2 * size * size + ROT_EXPM_WORK(size);
}

static double system_start(const shaft *s, size_t place, double unit, double step) {
  const size_t n = s->n;
  if (place == 2 * n) return unit;
  if (place == n) return s->r0[0] * s->root_inertia;
  if (place > n) return s->r0[place - n];
  return place <= s->floppy ? s->p0[place] / fabs(step) : s->p0[place];
}

static double system_force(const shaft *s, size_t m) {
  return m == 0 ? s->alpha * s->root_inertia : s->force[m];
}

/* Sets up exp(A h). */
static rot_status set_step(const shaft *s, stepper *y, double h) {
  const size_t n = s->n, size = y->size;
  double most = 0.0;
  int exponent = 0;
  memset(y->a, 0, size * size * sizeof *y->a);
  for (size_t m = 0; m < n; m++) most = fmax(most, fabs(system_force(s, m) * h));
  frexp(most, &exponent);
  y->step = h;
  y->unit = most > 0.0 && isfinite(most) ? ldexp(1.0, exponent) : 1.0;
  for (size_t m = 0; m < n; m++) {
    double *position = y->a + m * size, *velocity = y->a + (n + m) * size;
    position[n + m] = m <= s->floppy ? (h < 0.0 ? -1.0 : 1.0) : s->sigma[m] * h;
    if (m > s->floppy) velocity[m] = -s->sigma[m] * h;
    for (size_t b = 0; b < n; b++) velocity[n + b] = -s->coupling[m * n + b] * h;
    velocity[2 * n] = system_force(s, m) * h / y->unit;
  }
  return rot_expm(size, y->a, y->e, y->work);
}

/* Back to p (or q) and r of the modes. */
static void read_system(const shaft *s, const stepper *y, const double state[], double p[],
                        double r[]) {
  for (size_t m = 0; m < s->n; m++) {
    p[m] = state[m] * (m <= s->floppy ? fabs(y->step) : 1.0);
    r[m] = state[s->n + m];
  }
  p[0] /= s->root_inertia;
  r[0] /= s->root_inertia;
}

/* Size of the twists' error, in units of roundoff, if the state has gone from the start to p, r. */
static double system_error(const shaft *s, double t, const double p[], const double r[]) {
  double start = 0.0, now = 0.0, force = 0.0, leak = 0.0;
  for (size_t m = s->mean_alone ? 1 : 0; m < s->n; m++) {
    const double weight = m == 0 ? s->root_inertia : 1.0;
    const int twist = m > s->floppy;
    start = hypot(start, hypot(twist ? s->p0[m] : 0.0, weight * s->r0[m]));
    now = hypot(now, hypot(twist ? p[m] : 0.0, weight * r[m]));
    force = hypot(force, system_force(s, m));
    leak =
        hypot(leak, s->leak[m] + s->force_leak[m] *
                                     (m > s->floppy ? fmin(fabs(t), 2.0 / s->sigma[m]) : fabs(t)));
  }
  const double phase = s->norm * fabs(t), growth = t < 0.0 ? 1.0 + phase : 1.0;
  return growth * leak +
         (2.0 * (double)s->n + phase) *
             (growth * fmax(start, now) + force * (phase > 1.0 ? 1.0 / s->norm : fabs(t)));
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* Roundings of a mode's error, over what mode_error() says; system_error() has four. 200 random
 * shafts of 2 to 6 rotors showed at most 0.6 of what is stated, mostly 0.01. */
static double roundings(const shaft *s) { return fmin(4.0 + 2.0 * (double)s->n, 24.0); }

typedef struct modal_run {
  const shaft *s;
  const rot_rotors_columns *out;
  rot_info *info;
  double *p, *r, *error; /* n each: the modes at the row, and their errors */
} modal_run;

static void modes_by_themselves(const modal_run *run, double t) {
  const shaft *s = run->s;
  for (size_t m = 0; m < s->n; m++) {
    run->p[m] = s->p0[m];
    run->r[m] = s->r0[m];
    move_mode(s->sigma[m], s->sigma_lo[m], s->damp[m], s->force[m], t, &run->p[m], &run->r[m]);
    run->error[m] = ROT_EPS * roundings(s) * mode_error(s, m, t);
  }
}

static void note_system_errors(const modal_run *run, double t, double extra) {
  const shaft *s = run->s;
  const double error = ROT_EPS * 4.0 * system_error(s, t, run->p, run->r) * (1.0 + extra);
  for (size_t m = 1; m < s->n; m++) run->error[m] = error;
  run->error[0] =
      s->mean_alone ? ROT_EPS * roundings(s) * mode_error(s, 0, t) : error / s->root_inertia;
}

/* Angles, rates and torques from the modes. */
static rot_status write_row(const modal_run *run, size_t row, double t) {
  const shaft *s = run->s;
  const rot_rotors_params *p = s->p;
  const size_t n = s->n;
  double *theta = run->out->theta_rad + row * n, *omega = run->out->omega_rad_per_s + row * n;
  double *torque = run->out->shaft_n_m + row * n;
  double momentum = s->omega0 + s->alpha * t, size = fabs(s->omega0) + fabs(s->alpha * t);
  for (size_t i = 0; i < n; i++) {
    double turned = 0.0, rate = 0.0;
    for (size_t m = n; m-- > 1;) {
      const double q = m > s->floppy ? run->p[m] / s->sigma[m] : run->p[m];
      turned += s->shape[i * n + m] * q;
      rate += s->shape[i * n + m] * run->r[m];
    }
    theta[i] = s->theta0 + (run->p[0] + turned);
    omega[i] = run->r[0] + rate;
    if (!(isfinite(theta[i]) && isfinite(omega[i]))) return ROT_ERANGE;
    momentum -= p->viscous_n_m_s[i] / s->inertia * (theta[i] - p->theta0_rad[i]);
    size += p->viscous_n_m_s[i] / s->inertia * fabs(theta[i] - p->theta0_rad[i]);
  }
  for (size_t i = 0; i < n; i++) momentum -= s->share[i] * omega[i];
  /* The rounding of this sum itself is no error of the rows. */
  const double residual = fmax(0.0, fabs(momentum) - 2.0 * (double)n * ROT_EPS * size);
  for (size_t i = 0; i < n; i++) {
    double theta_error = 0.0, omega_error = 0.0;
    for (size_t m = 1; m < n; m++) {
      const double shape = fabs(s->shape[i * n + m]), error = run->error[m];
      const double angle = m > s->floppy
                               ? error / s->sigma[m]
                               : error * fabs(t) + ROT_EPS * roundings(s) * fabs(s->p0[m]);
      /* Together the modes share one error of that norm; by themselves each has its own. */
      omega_error = s->decoupled ? omega_error + shape * error : hypot(omega_error, shape * error);
      theta_error = s->decoupled ? theta_error + shape * angle : hypot(theta_error, shape * angle);
    }
    omega_error += run->error[0] + residual +
                   ROT_EPS * (2.0 * fabs(omega[i]) + roundings(s) * s->omega_spread);
    theta_error +=
        (run->error[0] + residual) * fabs(t) +
        ROT_EPS * (2.0 * fabs(s->theta0) + 2.0 * fabs(theta[i]) + roundings(s) * s->theta_spread);
    rot_note_row(run->info, theta[i], omega[i], theta_error, omega_error);
  }
  for (size_t j = 0; j + 1 < n; j++) {
    double elastic = 0.0, slip = 0.0;
    for (size_t m = 1; m < n; m++) {
      elastic += s->lever[j * n + m] * run->p[m];
      slip += s->twist[j * n + m] * run->r[m];
    }
    torque[j] = elastic + p->damping_n_m_s[j] * slip;
  }
  torque[n - 1] = NAN;
  return ROT_OK;
}

/* How many times from row i on are even: t_i, t_i + h, ... to what a first-order correction sets
 * right. */
static size_t even_rows(const shaft *s, size_t n, const double time_s[], size_t i) {
  if (i + 8 > n) return 1;
  const double h = time_s[i + 1] - time_s[i];
  size_t k = 1;
  if (!(h > 0.0)) return 1;
  while (i + k < n &&
         fabs(time_s[i + k] - (time_s[i] + (double)k * h)) * fmax(s->norm, s->decay) <= 1e-8) {
    k++;
  }
  return k >= 8 ? k : 1;
}

/* The state at time t by one exponential from the start. */
static rot_status jump(const modal_run *run, stepper *y, double t, double state[]) {
  const shaft *s = run->s;
  double *start = y->work; /* free once the exponential is done */
  if (t == 0.0) {
    y->step = 1.0;
    for (size_t i = 0; i < y->size; i++) state[i] = system_start(s, i, 1.0, 1.0);
  } else {
    const rot_status status = set_step(s, y, t);
    if (status != ROT_OK) return status;
    for (size_t i = 0; i < y->size; i++) start[i] = system_start(s, i, y->unit, t);
    rot_expm_apply(y->size, y->e, start, state);
  }
  read_system(s, y, state, run->p, run->r);
  run->info->steps++;
  return ROT_OK;
}

/* Rows i .. i + count - 1, evenly h apart, row i at hand: one matrix times a vector each, with the
 * small part of the time that is not even set right to first order. */
static rot_status even_stretch(const modal_run *run, stepper *grid, double state[], size_t i,
                               size_t count, const double time_s[]) {
  const shaft *s = run->s;
  const size_t n = s->n, size = grid->size;
  double *next = grid->work, *slope = grid->work + size, *moved = grid->work + 2 * size;
  for (size_t m = 0; m < n; m++) {
    const double weight = m == 0 ? s->root_inertia : 1.0;
    state[m] = run->p[m] * weight / (m <= s->floppy ? fabs(grid->step) : 1.0);
    state[n + m] = run->r[m] * weight;
  }
  state[2 * n] = grid->unit;
  for (size_t k = 1; k < count; k++) {
    const double even = time_s[i] + (double)k * grid->step;
    const double off = (time_s[i + k] - even) / grid->step;
    rot_expm_apply(size, grid->e, state, next);
    memcpy(state, next, size * sizeof *state);
    rot_expm_apply(size, grid->a, state, slope);
    for (size_t j = 0; j < size; j++) moved[j] = state[j] + off * slope[j];
    read_system(s, grid, moved, run->p, run->r);
    const double t = time_s[i + k] - s->p->start_s;
    note_system_errors(run, t, 2.0 * (double)k / (1.0 + s->norm * fabs(t)));
    const rot_status status = write_row(run, i + k, t);
    if (status != ROT_OK) return status;
    run->info->rows_done = i + k + 1;
    run->info->time_s = time_s[i + k];
  }
  return ROT_OK;
}

static rot_status rows_together(const modal_run *run, int fast, size_t n, const double time_s[],
                                double memory[], const rot_hooks *hooks) {
  const shaft *s = run->s;
  const size_t size = 2 * s->n + 1, room = system_room(s->n);
  stepper one = {size, 0.0, 0.0, memory, memory + size * size, memory + 2 * size * size};
  stepper grid = {
      size, 0.0, 0.0, memory + room, memory + room + size * size, memory + room + 2 * size * size};
  double *state = memory + 2 * room;
  size_t even_left = 0;
  for (size_t i = 0; i < n;) {
    const double t = time_s[i] - s->p->start_s;
    rot_status status = jump(run, &one, t, state);
    if (status == ROT_OK) {
      note_system_errors(run, t, 0.0);
      status = write_row(run, i, t);
    }
    run->info->time_s = time_s[i];
    if (status != ROT_OK) return status;
    run->info->rows_done = i + 1;
    if (fast && even_left <= 1) {
      even_left = even_rows(s, n, time_s, i);
      if (even_left > 1) status = set_step(s, &grid, time_s[i + 1] - time_s[i]);
    }
    if (status != ROT_OK) return status;
    size_t count = even_left < ROWS_PER_ANCHOR ? even_left : ROWS_PER_ANCHOR;
    if (count > 1) {
      status = even_stretch(run, &grid, state, i, count, time_s);
      even_left -= count;
    } else {
      count = 1;
      even_left = 0;
    }
    if (status != ROT_OK) return status;
    i += count;
    status = rot_poll(hooks, (double)i / (double)n);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

static rot_status rows_by_themselves(const modal_run *run, size_t n, const double time_s[],
                                     const rot_hooks *hooks) {
  for (size_t i = 0; i < n; i++) {
    const double t = time_s[i] - run->s->p->start_s;
    modes_by_themselves(run, t);
    rot_status status = write_row(run, i, t);
    run->info->time_s = time_s[i];
    if (status != ROT_OK) return status;
    run->info->rows_done = i + 1;
    if (i % 256 == 255) status = rot_poll(hooks, (double)i / (double)n);
    if (status != ROT_OK) return status;
  }
  run->info->steps = n > 0;
  return ROT_OK;
}

static void note_start(const rot_rotors_params *p, rot_info *info) {
  rot_info_clear(info);
  for (size_t i = 0; i < p->n; i++) rot_note_state(info, p->theta0_rad[i], p->omega0_rad_per_s[i]);
}

rot_status rot_rotors_modal(const rot_rotors_params *p, int fast, size_t n, const double time_s[],
                            const rot_rotors_columns *out, const rot_hooks *hooks, rot_info *info) {
  shaft s;
  note_start(p, info);
  info->status = build(&s, p);
  if (info->status == ROT_OK) {
    const size_t room = 3 * p->n + (s.decoupled ? 0 : 2 * system_room(p->n) + 2 * p->n + 1);
    double *memory = malloc(room * sizeof *memory);
    const modal_run run = {&s, out, info, memory, memory + p->n, memory + 2 * p->n};
    if (!memory) {
      info->status = ROT_ENOMEM;
    } else if (s.decoupled) {
      info->status = rows_by_themselves(&run, n, time_s, hooks);
    } else {
      info->status = rows_together(&run, fast, n, time_s, memory + 3 * p->n, hooks);
    }
    free(memory);
  }
  free(s.memory);
  return info->status;
}

/* ---- the rigid shaft ------------------------------------------------------------------------- */

/* The rotors turn as one while the springs carry the torques T_j = base_j + slope_j omega that this
 * asks for. Then (twist under T_j, no twist rate) solves the equations of the shaft but for the
 * rate of change of T_j, and since exp(A t) does not grow, the true state differs in the energy
 * norm by at most the difference at the start plus the path of the twists. */
typedef struct lump {
  const rot_rotors_params *p;
  size_t n;
  double inertia, theta0, omega0, alpha, decay;
  double start;   /* energy norm of the difference at the start */
  double path;    /* energy norm of slope_j: what a change of omega by 1 adds */
  int mean_exact; /* the mean motion is that of the rigid shaft */
  int damped, broken;
  double *memory, *share, *base, *slope;
} lump;

static rot_status build_lump(lump *s, const rot_rotors_params *p) {
  const size_t n = p->n;
  memset(s, 0, sizeof *s);
  s->p = p;
  s->n = n;
  s->memory = calloc(3 * n, sizeof *s->memory);
  if (!s->memory) return ROT_ENOMEM;
  s->share = s->memory;
  s->base = s->memory + n;
  s->slope = s->memory + 2 * n;
  for (size_t i = 0; i < n; i++) s->inertia += p->inertia_kg_m2[i];
  for (size_t i = 0; i < n; i++) {
    s->share[i] = p->inertia_kg_m2[i] / s->inertia;
    s->alpha += p->torque_n_m[i] / s->inertia;
    s->decay += p->viscous_n_m_s[i] / s->inertia;
    s->damped |= p->viscous_n_m_s[i] > 0.0;
  }
  s->theta0 = s->omega0 = 0.0;
  for (size_t i = 1; i < n; i++) {
    s->theta0 += s->share[i] * (p->theta0_rad[i] - p->theta0_rad[0]);
    s->omega0 += s->share[i] * (p->omega0_rad_per_s[i] - p->omega0_rad_per_s[0]);
  }
  s->theta0 += p->theta0_rad[0];
  s->omega0 += p->omega0_rad_per_s[0];
  s->mean_exact = 1;
  for (size_t j = 0; j + 1 < n; j++) {
    const double k = p->stiffness_n_m_per_rad[j];
    double left = 0.0, torque_left = 0.0, torque_right = 0.0, drag_left = 0.0, drag_right = 0.0;
    for (size_t i = 0; i < n; i++) {
      left += i <= j ? s->share[i] : 0.0;
      *(i <= j ? &torque_left : &torque_right) += p->torque_n_m[i];
      *(i <= j ? &drag_left : &drag_right) += p->viscous_n_m_s[i];
    }
    double right = 0.0;
    for (size_t i = j + 1; i < n; i++) right += s->share[i];
    s->base[j] = right * torque_left - left * torque_right;
    s->slope[j] = left * drag_right - right * drag_left;
    if (fabs(s->slope[j]) <= 8.0 * ROT_EPS * (drag_left + drag_right)) s->slope[j] = 0.0;
    s->mean_exact &= s->slope[j] == 0.0;
    s->damped |= p->damping_n_m_s[j] > 0.0;
    s->broken |= k == 0.0;
    if (k == 0.0) continue;
    const double twist = p->theta0_rad[j] - p->theta0_rad[j + 1];
    const double carried = (s->base[j] + s->slope[j] * s->omega0) / sqrt(k);
    s->start = hypot(s->start, sqrt(k) * twist - carried);
    s->path = hypot(s->path, s->slope[j] / sqrt(k));
  }
  for (size_t i = 0; i < n; i++) {
    s->start = hypot(s->start, sqrt(p->inertia_kg_m2[i]) * (p->omega0_rad_per_s[i] - s->omega0));
  }
  return ROT_OK;
}

/* Mean angle turned and rate; sizes of the terms added. */
static void lump_at(const lump *s, double t, double *turned, double *omega, double *turned_size,
                    double *omega_size) {
  double phi[3];
  rot_phi(s->decay * t, 0.0, 2, phi);
  *omega = s->omega0 * phi[0] + s->alpha * t * phi[1];
  *turned = s->omega0 * t * phi[1] + s->alpha * t * t * phi[2];
  *omega_size = fabs(s->omega0) * phi[0] * (1.0 + s->decay * fabs(t)) + fabs(s->alpha * t) * phi[1];
  *turned_size = fabs(s->omega0 * t) * phi[1] + fabs(s->alpha * t * t) * phi[2];
}

static rot_status lump_row(const lump *s, const rot_rotors_columns *out, size_t row, double t,
                           rot_info *info) {
  const rot_rotors_params *p = s->p;
  const size_t n = s->n;
  const double rounding = (12.0 + 2.0 * (double)n) * ROT_EPS;
  double turned, omega, turned_size, omega_size;
  lump_at(s, t, &turned, &omega, &turned_size, &omega_size);
  const int known = !s->broken && !(t < 0.0 && s->damped);
  const double off = known ? s->start + s->path * fabs(omega - s->omega0) : (double)INFINITY;
  const double mean_off = s->mean_exact ? 0.0 : off * fabs(t) / sqrt(s->inertia);
  for (size_t i = 0; i < n; i++) {
    const double theta = p->theta0_rad[i] + turned, J = p->inertia_kg_m2[i];
    if (!(isfinite(theta) && isfinite(omega))) return ROT_ERANGE;
    double left = 0.0, twists = 0.0;
    for (size_t j = 0; j + 1 < n; j++) {
      const double k = p->stiffness_n_m_per_rad[j];
      left += s->share[j];
      const double twist = (fabs(s->base[j] + s->slope[j] * omega) + off * sqrt(k)) / k;
      twists += (j >= i ? 1.0 - left : left) * twist;
    }
    out->theta_rad[row * n + i] = theta;
    out->omega_rad_per_s[row * n + i] = omega;
    out->shaft_n_m[row * n + i] = i + 1 < n ? s->base[i] + s->slope[i] * omega : (double)NAN;
    rot_note_row(info, theta, omega,
                 fabs(p->theta0_rad[i] - s->theta0) + twists * (1.0 + rounding) + mean_off +
                     rounding * turned_size + 2.0 * ROT_EPS * fabs(theta),
                 off / sqrt(J) * (1.0 + rounding) + rounding * omega_size);
  }
  return ROT_OK;
}

rot_status rot_rotors_rigid(const rot_rotors_params *p, size_t n, const double time_s[],
                            const rot_rotors_columns *out, const rot_hooks *hooks, rot_info *info) {
  lump s;
  note_start(p, info);
  info->status = build_lump(&s, p);
  for (size_t i = 0; i < n && info->status == ROT_OK; i++) {
    info->time_s = time_s[i];
    info->status = lump_row(&s, out, i, time_s[i] - p->start_s, info);
    if (info->status != ROT_OK) break;
    info->rows_done = i + 1;
    if (i % 4096 == 4095) info->status = rot_poll(hooks, (double)i / (double)n);
  }
  info->steps = n > 0;
  free(s.memory);
  return info->status;
}

/* ---- work and heat --------------------------------------------------------------------------- */

static double angle_of(const shaft *s, const double p[], size_t i) {
  double sum = 0.0;
  for (size_t m = s->n; m-- > 1;) {
    sum += s->shape[i * s->n + m] * (m > s->floppy ? p[m] / s->sigma[m] : p[m]);
  }
  return sum;
}

static void add_transformed(size_t n, double w[], const double weight, const double e[],
                            const double q[], double work[]) {
  /* w += weight e' q e */
  rot_expm_multiply(n, q, e, work);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < n; k++) {
      const double x = weight * e[k * n + i];
      if (x == 0.0) continue;
      for (size_t j = 0; j < n; j++) w[i * n + j] += x * work[k * n + j];
    }
  }
}

/* Heat = x0' W x0 with W = int exp(A't) Q exp(A t) dt: by quadrature over a short time, then by
 * doubling, W(2h) = W(h) + exp(A'h) W(h) exp(A h). All parts are positive: nothing cancels. */
static rot_status find_heat(const shaft *s, double from, double span, const double p[],
                            const double r[], rot_rotors_ledger *ledger) {
  const size_t n = s->n, size = 2 * n + 1, square = size * size;
  double *memory = calloc(4 * square + 2 * size + ROT_EXPM_WORK(size) + 2 * square, sizeof *memory);
  if (!memory) return ROT_ENOMEM;
  double *q = memory, *w = q + square, *sum = w + square, *x = sum + 2 * square, *y = x + size;
  stepper step = {size, 0.0, 0.0, y + size, y + size + square, y + size + 2 * square};
  int doublings = 0;
  const double norm = fmax(s->norm, fmax(s->decay, s->coupling[0]));
  if (norm * span > 1.0) doublings = (int)ceil(log2(norm * span));
  const double h = ldexp(span, -doublings);
  for (size_t a = 0; a < n; a++) {
    for (size_t b = 0; b < n; b++) q[(n + a) * size + n + b] = s->coupling[a * n + b];
  }
  rot_status status = ROT_OK;
  for (int i = 0; i < 12 && status == ROT_OK; i++) {
    const node at = gauss(i);
    status = set_step(s, &step, at.x * h);
    /* The last place holds step.unit then; here it shall hold 1. */
    for (size_t k = 0; k < size; k++) step.e[k * size + 2 * n] *= step.unit;
    step.e[square - 1] = 1.0;
    add_transformed(size, w, at.weight * h, step.e, q, sum);
  }
  if (status == ROT_OK) status = set_step(s, &step, h);
  for (size_t k = 0; k < size; k++) step.e[k * size + 2 * n] *= step.unit;
  step.e[square - 1] = 1.0;
  for (int i = 0; i < doublings && status == ROT_OK; i++) {
    memcpy(sum, w, square * sizeof *w);
    add_transformed(size, w, 1.0, step.e, sum, sum + square);
    rot_expm_multiply(size, step.e, step.e, sum);
    memcpy(step.e, sum, square * sizeof *sum);
  }
  for (size_t m = 0; m < n; m++) {
    x[m] = m <= s->floppy ? 0.0 : p[m];
    x[n + m] = m == 0 ? r[0] * s->root_inertia : r[m];
  }
  x[2 * n] = 1.0;
  rot_expm_apply(size, w, x, y);
  double most = 0.0;
  ledger->dissipated_j = 0.0;
  for (size_t i = 0; i < size; i++) {
    ledger->dissipated_j += x[i] * y[i];
    for (size_t j = 0; j < size; j++) most += fabs(x[i] * w[i * size + j] * x[j]);
  }
  ledger->dissipated_rounding_j =
      ROT_EPS * (32.0 + 8.0 * (double)n + 4.0 * s->norm * (fabs(from) + span)) * most;
  free(memory);
  return isfinite(ledger->dissipated_j) || status != ROT_OK ? status : ROT_ERANGE;
}

/* p and r (or q) of the modes at a time. */
static rot_status modes_at(const shaft *s, double t, double p[], double r[], double error[]) {
  rot_info info;
  const modal_run run = {s, NULL, &info, p, r, error};
  rot_info_clear(&info);
  if (s->decoupled) {
    modes_by_themselves(&run, t);
    return ROT_OK;
  }
  const size_t size = 2 * s->n + 1;
  double *memory = malloc((system_room(s->n) + size) * sizeof *memory);
  if (!memory) return ROT_ENOMEM;
  stepper one = {size, 0.0, 0.0, memory, memory + size * size, memory + 2 * size * size};
  const rot_status status = jump(&run, &one, t, memory + system_room(s->n));
  if (status == ROT_OK) note_system_errors(&run, t, 0.0);
  free(memory);
  return status;
}

static rot_status balance_of_modes(const rot_rotors_params *p, double from, double to,
                                   rot_rotors_ledger *ledger) {
  shaft s;
  const size_t n = p->n;
  double *memory = calloc(6 * n, sizeof *memory);
  rot_status status = memory ? build(&s, p) : ROT_ENOMEM;
  if (!memory) return status;
  double *p0 = memory, *r0 = p0 + n, *p1 = r0 + n, *r1 = p1 + n, *e0 = r1 + n, *e1 = e0 + n;
  if (status == ROT_OK) status = modes_at(&s, from, p0, r0, e0);
  if (status == ROT_OK) status = modes_at(&s, to, p1, r1, e1);
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    const double tau = p->torque_n_m[i], twist = angle_of(&s, p1, i) - angle_of(&s, p0, i);
    double error = 8.0 * ROT_EPS * (fabs(p0[0]) + fabs(p1[0]));
    for (size_t m = 0; m < n; m++) {
      const double shape = fabs(s.shape[i * n + m]);
      error += shape * (e0[m] + e1[m]) * (m > s.floppy ? 1.0 / s.sigma[m] : fabs(to) + fabs(from));
    }
    ledger->work_j += tau * ((p1[0] - p0[0]) + twist);
    ledger->work_rounding_j += fabs(tau) * error;
  }
  int damped = 0;
  for (size_t m = 0; m < n * n; m++) damped |= s.coupling != NULL && s.coupling[m] != 0.0;
  if (damped && to > from && status == ROT_OK) {
    status = find_heat(&s, from, to - from, p0, r0, ledger);
  }
  free(s.memory);
  free(memory);
  return status;
}

/* int omega^2 by Gauss and Legendre over stretches of decay * t = 2. */
static rot_status balance_of_lump(const rot_rotors_params *p, double from, double to,
                                  rot_rotors_ledger *ledger) {
  lump s;
  double theta0, theta1, omega, theta_size, omega_size, torque = 0.0, most = 0.0;
  const rot_status status = build_lump(&s, p);
  if (status != ROT_OK) return status;
  lump_at(&s, from, &theta0, &omega, &theta_size, &omega_size);
  most += theta_size;
  lump_at(&s, to, &theta1, &omega, &theta_size, &omega_size);
  most += theta_size;
  for (size_t i = 0; i < p->n; i++) torque += p->torque_n_m[i];
  ledger->work_j = torque * (theta1 - theta0);
  ledger->work_rounding_j = fabs(torque) * 16.0 * ROT_EPS * most;
  /* After 40 times 1/decay from the start omega has settled: the rest in one go. */
  const double settled = s.decay > 0.0 ? fmin(to, fmax(from, 40.0 / s.decay)) : to;
  const double parts = fmax(1.0, ceil(s.decay * (settled - from) / 2.0));
  double sum = 0.0;
  for (double k = 0.0; k < parts && s.decay > 0.0; k += 1.0) {
    const double h = (settled - from) / parts;
    for (int i = 0; i < 12; i++) {
      const node at = gauss(i);
      lump_at(&s, from + (k + at.x) * h, &theta1, &omega, &theta_size, &omega_size);
      sum += at.weight * h * omega * omega;
    }
  }
  if (s.decay > 0.0 && to > settled) {
    lump_at(&s, to, &theta1, &omega, &theta_size, &omega_size);
    sum += (to - settled) * omega * omega;
  }
  ledger->dissipated_j = s.decay * s.inertia * sum;
  ledger->dissipated_rounding_j = 40.0 * ROT_EPS * ledger->dissipated_j;
  free(s.memory);
  return ROT_OK;
}

rot_status rot_rotors_balance(const rot_rotors_params *p, int rigid, double from_s, double to_s,
                              rot_rotors_ledger *ledger) {
  const double from = from_s - p->start_s, to = to_s - p->start_s;
  *ledger = (rot_rotors_ledger){0.0, 0.0, 0.0, 0.0};
  return rigid ? balance_of_lump(p, from, to, ledger) : balance_of_modes(p, from, to, ledger);
}
