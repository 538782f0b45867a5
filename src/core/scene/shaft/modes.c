#include "scene/shaft/modes.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "ground/dd.h"
#include "maths/eigen.h"
#include "ground/real.h"

static int allocate(rot_shaft_modes *s, size_t n) {
  double *next = s->memory = calloc(n * (5 * n + 10), sizeof *next);
  if (!next) return 0;
  double **small[] = {&s->leak,  &s->force_leak, &s->sigma_lo, &s->sigma_off, &s->fraction,
                      &s->sigma, &s->damp,       &s->p0,       &s->r0,        &s->force};
  double **large[] = {&s->shape, &s->twist, &s->lever, &s->coupling, &s->coupling_lo};
  for (int i = 0; i < 10; i++, next += n) *small[i] = next;
  for (int i = 0; i < 5; i++, next += n * n) *large[i] = next;
  return 1;
}

/* Number of rotors from which loops poll: one step then takes 4 us. */
enum { LARGE = 64 };

static rot_status poll_if_large(const rot_shaft_modes *s) {
  return s->n < LARGE ? ROT_OK : rot_poll(s->hooks, 0.0);
}

/* Mean weighted by inertia, of the differences from the first rotor: exact for equal values. In
 * twice the precision: a mean that cancels is the rate of all angles. */
static double mean_of(const rot_shaft_modes *s, const double x[]) {
  const double *J = s->p->inertia_kg_m2;
  double largest = 0.0;
  int e = 0;
  for (size_t i = 0; i < s->n; i++) largest = fmax(largest, J[i]);
  (void)frexp(largest, &e);
  rot_dd sum = {0.0, 0.0}, all = {ldexp(J[0], -e), 0.0};
  for (size_t i = 1; i < s->n; i++) {
    const double mass = ldexp(J[i], -e);
    sum = rot_dd_add(sum, rot_dd_mul1(rot_dd_sum2(x[i], -x[0]), mass));
    all = rot_dd_add1(all, mass);
  }
  return rot_dd_add1(rot_dd_div(sum, all), x[0]).hi;
}

/* Twists: singular vectors of sqrt(k) B J^-1/2. Small singular values keep their digits for any
 * ratio of rotors and springs. Fills sigma and lever. */
static rot_status find_twists(rot_shaft_modes *s) {
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
  rot_status status = rot_eigen_singular(n, springs, g, s->sigma + 1 + s->floppy, u, s->hooks);
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

/* Shapes of the twists in rotors first .. last, joined by springs: each rotor from the twists on
 * both sides, weighted by the fractions of inertia beyond. No difference of large numbers, no net
 * momentum. */
static rot_status shape_group(rot_shaft_modes *s, size_t first, size_t last) {
  const size_t n = s->n;
  const double *k = s->p->stiffness_n_m_per_rad;
  double all = 0.0, left = 0.0;
  for (size_t i = first; i <= last; i++) all += s->fraction[i];
  for (size_t j = first; j < last; j++) {
    double right = 0.0;
    left += s->fraction[j];
    for (size_t i = j + 1; i <= last; i++) right += s->fraction[i];
    for (size_t m = 1 + s->floppy; m < n; m++) {
      const double twist = s->sigma[m] * (s->lever[j * n + m] / k[j]);
      s->twist[j * n + m] = twist;
      for (size_t i = first; i <= j; i++) s->shape[i * n + m] += twist * (right / all);
      for (size_t i = j + 1; i <= last; i++) s->shape[i * n + m] -= twist * (left / all);
    }
    const rot_status status = poll_if_large(s);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* Mode f: groups before group f against group f. */
static void shape_floppy(rot_shaft_modes *s, size_t f, size_t first, size_t last) {
  double before = 0.0, here = 0.0;
  for (size_t i = 0; i < first; i++) before += s->fraction[i];
  for (size_t i = first; i <= last; i++) here += s->fraction[i];
  const double root = s->root_inertia, both = before + here;
  for (size_t i = 0; i < first; i++) s->shape[i * s->n + f] = sqrt(here / both / before) / root;
  for (size_t i = first; i <= last; i++) {
    s->shape[i * s->n + f] = -sqrt(before / both / here) / root;
  }
}

/* Shapes of all modes, group by group. */
static rot_status find_shapes(rot_shaft_modes *s) {
  const size_t n = s->n;
  const double *k = s->p->stiffness_n_m_per_rad;
  for (size_t first = 0, last = 0, group = 0; first < n; first = ++last, group++) {
    while (last + 1 < n && k[last] > 0.0) last++;
    const rot_status status = shape_group(s, first, last);
    if (status != ROT_OK) return status;
    if (group > 0) shape_floppy(s, group, first, last);
  }
  for (size_t i = 0; i < n; i++) s->shape[i * n] = 1.0;
  for (size_t j = 0; j + 1 < n; j++) {
    for (size_t m = 1; m < n && k[j] == 0.0; m++) {
      s->twist[j * n + m] = s->shape[j * n + m] - s->shape[(j + 1) * n + m];
    }
  }
  return ROT_OK;
}

/* ---- phases of the modes --------------------------------------------------------------------- */

/* Shape of a twist scaled to numbers near 1: squares do not overflow. */
typedef struct scaled_shape {
  int of_k, of_J, of_twist; /* binary exponents of the scales */
  const double *twist;      /* column m */
  size_t stride;
} scaled_shape;

static rot_dd scaled_mass(const rot_shaft_modes *s, const scaled_shape *x, size_t i) {
  return (rot_dd){ldexp(s->p->inertia_kg_m2[i], -x->of_J), 0.0};
}

static rot_dd scaled_twist(const scaled_shape *x, size_t i) {
  return (rot_dd){ldexp(x->twist[i * x->stride], -x->of_twist), 0.0};
}

/* Torque of shaft piece i. */
static rot_dd scaled_torque(const rot_shaft_modes *s, const scaled_shape *x, size_t i) {
  return rot_dd_mul1(scaled_twist(x, i), ldexp(s->p->stiffness_n_m_per_rad[i], -x->of_k));
}

/* first rotor of a group joined by springs => its last rotor. */
static size_t group_end(const rot_shaft_modes *s, size_t first) {
  while (first + 1 < s->n && s->p->stiffness_n_m_per_rad[first] > 0.0) first++;
  return first;
}

/* Angle of the last rotor of a group with zero momentum. */
static rot_dd last_angle(const rot_shaft_modes *s, const scaled_shape *x, size_t first,
                         size_t last) {
  rot_dd theta = {0.0, 0.0}, momentum = {0.0, 0.0}, inertia = {0.0, 0.0};
  for (size_t i = last + 1; i-- > first;) {
    if (i < last) theta = rot_dd_add(theta, scaled_twist(x, i));
    inertia = rot_dd_add(inertia, scaled_mass(s, x, i));
    momentum = rot_dd_add(momentum, rot_dd_mul(scaled_mass(s, x, i), theta));
  }
  return rot_dd_div(momentum, rot_dd_neg(inertia));
}

/* Sums over all rotors: elastic energy, kinetic energy and, for sigma^2 = square, the squared
 * residual of the equation of motion over the inertia. */
static void energies(const rot_shaft_modes *s, const scaled_shape *x, rot_dd square,
                     rot_dd *elastic, rot_dd *kinetic, double *lacking) {
  const rot_dd zero = {0.0, 0.0};
  *elastic = *kinetic = zero;
  *lacking = 0.0;
  for (size_t first = 0, last = 0; first < s->n; first = ++last) {
    last = group_end(s, first);
    rot_dd theta = last_angle(s, x, first, last);
    for (size_t i = last + 1; i-- > first;) {
      if (i < last) {
        const rot_dd twist = scaled_twist(x, i);
        theta = rot_dd_add(theta, twist);
        *elastic = rot_dd_add(*elastic, rot_dd_mul(scaled_torque(s, x, i), twist));
      }
      const rot_dd swing = rot_dd_mul(scaled_mass(s, x, i), theta);
      const rot_dd out = i < last ? scaled_torque(s, x, i) : zero;
      const rot_dd in = i > first ? scaled_torque(s, x, i - 1) : zero;
      const double off = rot_dd_sub(rot_dd_sub(out, in), rot_dd_mul(square, swing)).hi;
      *kinetic = rot_dd_add(*kinetic, rot_dd_mul(swing, theta));
      *lacking += off / scaled_mass(s, x, i).hi * off;
    }
  }
}

/* Minimum of |sigma_l^2 - sigma_m^2| / sigma_m^2 over the modes l that move the same pieces. */
static double nearest_mode(const rot_shaft_modes *s, size_t m) {
  double min = 1.0; /* the rigid-body modes */
  for (size_t l = 1 + s->floppy; l < s->n; l++) {
    int meet = 0;
    for (size_t j = 0; j + 1 < s->n; j++) {
      meet |= s->twist[j * s->n + l] != 0.0 && s->twist[j * s->n + m] != 0.0;
    }
    const double ratio = s->sigma[l] / s->sigma[m];
    if (l != m && meet) min = fmin(min, fabs(ratio - 1.0) * (ratio + 1.0));
  }
  return min;
}

/* sigma as Rayleigh quotient of a shape: elastic over kinetic energy, sigma^2 = sum k twist^2 / sum
 * J theta^2 without net momentum in any group. An error of the shape enters squared: twice its
 * digits. At a phase of 1e5 (k = 1e10 for 1 s) it reduces the error of omega from 4e-12 to 1e-16.
 * *off: relative error. With the residual r of the equation of motion the error of sigma^2 is at
 * most r, and at most r^2 over the distance to the next eigenvalue (Parlett 1998, sections 4.5 and
 * 11.7). */
static rot_dd sharp_sigma(const rot_shaft_modes *s, size_t m, double *off) {
  const size_t n = s->n;
  scaled_shape x = {0, 0, 0, s->twist + m, n};
  double max_k = 0.0, max_J = 0.0, max = 0.0, lacking;
  for (size_t i = 0; i < n; i++) max_J = fmax(max_J, s->p->inertia_kg_m2[i]);
  for (size_t j = 0; j + 1 < n; j++) {
    max_k = fmax(max_k, s->p->stiffness_n_m_per_rad[j]);
    max = fmax(max, fabs(s->twist[j * n + m]));
  }
  (void)frexp(max_k, &x.of_k);
  (void)frexp(max_J, &x.of_J);
  (void)frexp(max, &x.of_twist);
  x.of_J += (x.of_k - x.of_J) % 2; /* even difference of exponents, for the root */
  rot_dd elastic, kinetic;
  energies(s, &x, (rot_dd){0.0, 0.0}, &elastic, &kinetic, &lacking);
  const rot_dd square = rot_dd_div(elastic, kinetic);
  energies(s, &x, square, &elastic, &kinetic, &lacking);
  const double r = sqrt(lacking / kinetic.hi) / square.hi;
  *off = 0.5 * fmin(r, r * (r / nearest_mode(s, m))) + 64.0 * ROT_EPS * ROT_EPS;
  return rot_dd_ldexp(rot_dd_sqrt(square), (x.of_k - x.of_J) / 2);
}

/* Replaces the singular values that agree with their Rayleigh quotient: all, unless a number
 * underflowed. */
static rot_status sharpen(rot_shaft_modes *s) {
  for (size_t m = 1 + s->floppy; m < s->n; m++) {
    const rot_dd sigma = sharp_sigma(s, m, &s->sigma_off[m]);
    if (fabs(sigma.hi - s->sigma[m]) <= 1e-12 * s->sigma[m] && isfinite(sigma.lo) &&
        s->sigma_off[m] < ROT_EPS) {
      s->sigma[m] = sigma.hi;
      s->sigma_lo[m] = sigma.lo;
    } else {
      s->sigma_lo[m] = NAN;
      s->sigma_off[m] = ROT_EPS;
    }
    const rot_status status = poll_if_large(s);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* 1 if x_i = ratio y_i for all i up to rounding; ratio 0: no damping. */
static int proportional(size_t n, const double x[], const double y[], double *ratio) {
  double min = INFINITY, max = 0.0;
  *ratio = 0.0;
  for (size_t i = 0; i < n; i++) {
    if (x[i] == 0.0 && y[i] == 0.0) continue;
    min = fmin(min, x[i] / y[i]);
    max = fmax(max, x[i] / y[i]);
  }
  if (!(max - min <= 4.0 * ROT_EPS * max || max == 0.0)) return 0;
  *ratio = max;
  return isfinite(max);
}

/* c x y. The rank of a stiff damper is 1 in twice the precision, too: rounded, it would damp the
 * motions that it leaves alone. */
static rot_dd of_part(double c, double x, double y) {
  if (c == 0.0) return (rot_dd){0.0, 0.0};
  const rot_dd product = rot_dd_mul1(rot_dd_mul2(x, y), c);
  return isfinite(product.lo) ? product : (rot_dd){c * x * y, 0.0};
}

/* Column 0 of twist is 0: torques between rotors do not act on the mean, exactly. */
static rot_status find_damping(rot_shaft_modes *s) {
  const size_t n = s->n;
  const double *c = s->p->damping_n_m_s, *d = s->p->viscous_n_m_s, *J = s->p->inertia_kg_m2;
  double of_springs, of_rotors;
  const int springs = proportional(n - 1, c, s->p->stiffness_n_m_per_rad, &of_springs);
  s->mean_alone = proportional(n, d, J, &of_rotors);
  s->decoupled = (springs || n == 2) && s->mean_alone;
  for (size_t a = 0; a < n; a++) {
    for (size_t b = 0; b < n; b++) {
      rot_dd sum = {0.0, 0.0};
      for (size_t j = 0; j + 1 < n; j++) {
        sum = rot_dd_add(sum, of_part(c[j], s->twist[j * n + a], s->twist[j * n + b]));
      }
      for (size_t i = 0; i < n; i++) {
        if (s->mean_alone) break;
        const double x = a == 0 ? 1.0 / s->root_inertia : s->shape[i * n + a];
        const double y = b == 0 ? 1.0 / s->root_inertia : s->shape[i * n + b];
        sum = rot_dd_add(sum, of_part(d[i], x, y));
      }
      if (s->mean_alone && a == b) sum = rot_dd_add1(sum, of_rotors);
      s->coupling[a * n + b] = sum.hi;
      s->coupling_lo[a * n + b] = isfinite(sum.lo) ? sum.lo : 0.0;
    }
    s->damp[a] = s->coupling[a * n + a];
    if (springs) s->damp[a] = of_springs * s->sigma[a] * s->sigma[a] + of_rotors;
    const rot_status status = poll_if_large(s);
    if (status != ROT_OK) return status;
  }
  s->decay = 0.0;
  for (size_t i = 0; i < n; i++) s->decay += d[i] / s->inertia;
  for (size_t a = 1; a < n; a++) {
    double sum = s->sigma[a];
    for (size_t b = 0; b < n; b++) sum += fabs(s->coupling[a * n + b]);
    if (sum > s->norm) s->norm = sum;
  }
  return ROT_OK;
}

static void start_floppy(rot_shaft_modes *s, size_t m) {
  const rot_shaft_params *p = s->p;
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
  double value; /* a sum */
  double size;  /* sum of its |terms|, for its rounding */
} projection;

static projection better_of(projection a, projection b) { return a.size <= b.size ? a : b; }

/* Projection of angles, rates and torques on a twist, from the rotors with weights J shape, or from
 * the springs: sum J_i shape_i x_i = sum lever_j (x_j - x_(j+1))/sigma. The springs are better for
 * rotors of very different inertia, the rotors for very different springs: the rounding of a shape
 * is relative to its largest component. */
static void start_twist(rot_shaft_modes *s, size_t m) {
  const rot_shaft_params *p = s->p;
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
    rate[0].value += J * shape * omega;
    torque[0].value += shape * left;
    carried += left;
    if (shape != 0.0) { /* else exactly: a rotor of another group */
      angle[0].size += sigma * (J * largest * fabs(theta));
      rate[0].size += J * largest * fabs(omega);
      torque[0].size += largest * fabs(left);
    }
    if (i + 1 == n || p->stiffness_n_m_per_rad[i] == 0.0) continue;
    const double lever = s->lever[i * n + m], root = sqrt(p->stiffness_n_m_per_rad[i]);
    const double twist = p->theta0_rad[i] - p->theta0_rad[i + 1];
    const double slip = p->omega0_rad_per_s[i] - p->omega0_rad_per_s[i + 1];
    if (lever == 0.0) continue;
    angle[1].value += lever * twist;
    angle[1].size += root * fabs(twist);
    rate[1].value += lever * slip / sigma;
    rate[1].size += root * fabs(slip) / sigma;
    torque[1].value += s->twist[i * n + m] * carried;
    torque[1].size += sigma / root * fabs(carried);
  }
  const projection p0 = better_of(angle[0], angle[1]), r0 = better_of(rate[0], rate[1]);
  /* Beyond a missing spring the transmitted torque is not 0: the second sum does not hold. */
  const projection force = s->floppy ? torque[0] : better_of(torque[0], torque[1]);
  s->p0[m] = p0.value;
  s->r0[m] = r0.value;
  s->force[m] = force.value;
  s->leak[m] = p0.size + r0.size;
  s->force_leak[m] = force.size;
}

/* angles and rates at the start => p0, r0, modal torques, leaks. */
static void find_start(rot_shaft_modes *s) {
  const rot_shaft_params *p = s->p;
  const size_t n = s->n;
  s->theta0 = mean_of(s, p->theta0_rad);
  s->omega0 = mean_of(s, p->omega0_rad_per_s);
  for (size_t i = 1; i < n; i++) {
    const double theta = fabs(p->theta0_rad[i] - p->theta0_rad[0]);
    const double omega = fabs(p->omega0_rad_per_s[i] - p->omega0_rad_per_s[0]);
    s->theta_spread = fmax(s->theta_spread, theta);
    s->omega_spread = fmax(s->omega_spread, omega);
  }
  double torque = 0.0, lo = 0.0;
  for (size_t i = 0; i < n; i++) rot_accumulate(&torque, &lo, p->torque_n_m[i]);
  s->alpha = (torque + lo) / s->inertia;
  s->r0[0] = s->omega0;
  s->force[0] = s->alpha;
  for (size_t m = 1; m <= s->floppy; m++) start_floppy(s, m);
  for (size_t m = 1 + s->floppy; m < n; m++) start_twist(s, m);
}

/* Mean, twists, shapes, sharp frequencies, damping, start. */
rot_status rot_shaft_modes_build(rot_shaft_modes *s, const rot_shaft_params *p,
                                 const rot_hooks *hooks) {
  memset(s, 0, sizeof *s);
  s->p = p;
  s->n = p->n;
  s->hooks = hooks;
  if (!allocate(s, p->n)) return ROT_ENOMEM;
  for (size_t i = 0; i < p->n; i++) s->inertia += p->inertia_kg_m2[i];
  for (size_t i = 0; i < p->n; i++) s->fraction[i] = p->inertia_kg_m2[i] / s->inertia;
  for (size_t j = 0; j + 1 < p->n; j++) s->floppy += p->stiffness_n_m_per_rad[j] == 0.0;
  s->root_inertia = sqrt(s->inertia);
  rot_status status = find_twists(s);
  if (status == ROT_OK) status = find_shapes(s);
  if (status == ROT_OK) status = sharpen(s);
  if (status == ROT_OK) status = find_damping(s);
  if (status == ROT_OK) find_start(s);
  return status;
}

/* +-1, the next of a sequence (Knuth's multiplier) */
static double sign_of(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return *state >> 63 ? 1.0 : -1.0;
}

/* Moves the levers, finds shapes and damping anew, moves the start. */
rot_status rot_shaft_modes_shift(const rot_shaft_modes *s, double fraction, int which,
                                 rot_shaft_modes *to) {
  const size_t n = s->n;
  uint64_t state = (uint64_t)which + 1;
  *to = *s;
  if (!allocate(to, n)) return ROT_ENOMEM;
  memcpy(to->memory, s->memory, n * (5 * n + 10) * sizeof *to->memory);
  memset(to->shape, 0, n * n * sizeof *to->shape);
  memset(to->twist, 0, n * n * sizeof *to->twist);
  for (size_t j = 0; j + 1 < n; j++) {
    for (size_t m = 1 + s->floppy; m < n; m++) {
      /* Of a singular vector each component is known to some roundings of itself, and to one of
       * the vector: with c = 5e6 the small ones alone moved the rates by 4e-13. */
      const double root = sqrt(s->p->stiffness_n_m_per_rad[j]), lever = s->lever[j * n + m];
      if (lever == 0.0) continue;
      to->lever[j * n + m] += fraction * sign_of(&state) * (fabs(lever) + root / 16.0);
    }
  }
  rot_status status = find_shapes(to);
  if (status == ROT_OK) status = find_damping(to);
  for (size_t m = 0; m < n; m++) {
    to->p0[m] += fraction * sign_of(&state) * (s->leak[m] + fabs(s->p0[m]));
    to->r0[m] += fraction * sign_of(&state) * (s->leak[m] + fabs(s->r0[m]));
    to->force[m] += fraction * sign_of(&state) * (s->force_leak[m] + fabs(s->force[m]));
  }
  to->alpha = to->force[0];
  return status;
}

void rot_shaft_modes_free(rot_shaft_modes *s) { free(s->memory); }
