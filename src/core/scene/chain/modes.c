#include "scene/chain/modes.h"

#include <float.h>
#include <math.h>

#include "ground/real.h"
#include "maths/eigen.h"

/* The bound holds for amplitudes A with sin(A/2) <= MAX_SINE. */
#define MAX_SINE 0.25

/* Singular value decomposition of G K^-1/2. */
rot_status rot_links_modes_build(const rot_links *c, rot_links_modes *to) {
  const size_t n = c->n, rows = c->rods ? 2 * n : n;
  double g[2 * ROT_LINKS_MAX * ROT_LINKS_MAX] = {0.0}, period[ROT_LINKS_MAX];
  double u[ROT_LINKS_MAX * ROT_LINKS_MAX];
  /* Rows of G. Points: velocities of the ends. Rods: velocities of the centres, and of the ends
   * relative to them. */
  for (size_t j = 0; j < n; j++) {
    to->root[j] = sqrt(c->length_m[j]) * sqrt(rot_links_weight(c, j) / c->length_m[j]);
    const double by = sqrt(c->length_m[j]) / sqrt(rot_links_weight(c, j) / c->length_m[j]);
    for (size_t k = j; k < n; k++) {
      g[k * n + j] = sqrt(c->fraction[k]) * by * (k == j ? rot_links_first(c) : 1.0);
    }
    if (c->rods) g[(n + j) * n + j] = sqrt(c->fraction[j] / 12.0) * by;
  }
  rot_status status = rot_eigen_singular(rows, n, g, period, u, NULL);
  if (status != ROT_OK) return status == ROT_EVALUE ? ROT_ERANGE : status;
  for (size_t j = 0; j < n; j++) { /* descending periods */
    to->rate[j] = 1.0 / period[n - 1 - j];
    if (!(to->rate[j] > 0.0 && to->rate[j] < INFINITY)) return ROT_ERANGE;
    for (size_t i = 0; i < n; i++) to->shape[i * n + j] = u[i * n + n - 1 - j];
  }
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < n; k++) {
      double sum = 0.0;
      for (size_t j = 0; j < n; j++) {
        sum += (to->shape[i * n + j] * to->rate[j]) * (to->shape[k * n + j] * to->rate[j]);
      }
      to->inverse[i * n + k] = sum / to->root[i] / to->root[k];
    }
  }
  return ROT_OK;
}

/* ---- the linear motion ----------------------------------------------------------------------- */

void rot_links_swing_start(const rot_links *c, const rot_links_modes *m, const double theta[],
                           const double omega[], rot_links_swing *to) {
  const size_t n = c->n;
  const double root_g = sqrt(c->gravity_m_per_s2);
  for (size_t j = 0; j < n; j++) {
    to->eta[j] = to->beside[j] = 0.0;
    for (size_t i = 0; i < n; i++) {
      to->eta[j] += m->shape[i * n + j] * (m->root[i] * theta[i]);
      to->beside[j] += m->shape[i * n + j] * (m->root[i] * (omega[i] / (root_g * m->rate[j])));
    }
  }
}

void rot_links_swing_at(const rot_links *c, const rot_links_modes *m, const rot_links_swing *swing,
                        double time_s, double theta[], double omega[], double *sum) {
  const size_t n = c->n;
  const double root_g = sqrt(c->gravity_m_per_s2);
  double along[ROT_LINKS_MAX];
  for (size_t i = 0; i < n; i++) theta[i] = omega[i] = along[i] = 0.0;
  for (size_t j = 0; j < n; j++) {
    const double rate = root_g * m->rate[j], phase = rate * time_s;
    const double cosine = cos(phase), sine = sin(phase), half = sin(0.5 * phase);
    const double eta = swing->eta[j] * cosine + swing->beside[j] * sine;
    const double turn = rate * (swing->beside[j] * cosine - swing->eta[j] * sine);
    const double passed = (swing->eta[j] * sine + 2.0 * swing->beside[j] * half * half) / rate;
    for (size_t i = 0; i < n; i++) {
      theta[i] += m->shape[i * n + j] * eta;
      omega[i] += m->shape[i * n + j] * turn;
      along[i] += m->shape[i * n + j] * passed;
    }
  }
  if (sum) *sum = 0.0;
  for (size_t i = 0; i < n; i++) {
    theta[i] /= m->root[i];
    omega[i] /= m->root[i];
    if (sum) *sum += c->gravity_m_per_s2 * (m->root[i] * along[i]);
  }
}

/* ---- error bound ----------------------------------------------------------------------------- */

/* Upper bound of sqrt(2 (kinetic + potential energy)) of a state; hypot avoids squares that
 * underflow. */
static double energy_norm(const rot_links *c, const rot_links_modes *m, const double theta[],
                          const double omega[]) {
  const double root_g = sqrt(c->gravity_m_per_s2);
  double norm = 0.0, x = 0.0, y = 0.0;
  for (size_t i = 0; i < c->n; i++) {
    const double v = c->length_m[i] * (omega[i] / root_g), f = rot_links_first(c);
    const double dx = v * cos(theta[i]), dy = v * sin(theta[i]), mass = sqrt(c->fraction[i]);
    norm = hypot(norm, 2.0 * m->root[i] * sin(0.5 * theta[i]));
    norm = hypot(norm, mass * hypot(x + f * dx, y + f * dy));
    if (c->rods) norm = hypot(norm, mass * v * sqrt(1.0 / 12.0));
    x += dx;
    y += dy;
  }
  return norm * (1.0 + 64.0 * ROT_EPS);
}

/* Maximum of sqrt(x' M^-1 x) over vectors with |x_i| <= max[i]. */
static double force_norm(const rot_links *c, const rot_links_modes *m, const double max[]) {
  const size_t n = c->n;
  double size = 0.0, sum = 0.0;
  for (size_t i = 0; i < n; i++) size = fmax(size, max[i] * sqrt(m->inverse[i * n + i]));
  if (!(size > 0.0)) return size;
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      sum += fabs(m->inverse[i * n + j]) * (max[i] / size) * (max[j] / size);
    }
  }
  return size * sqrt(sum);
}

/* The error e of the linear motion satisfies M e'' + K e = r with
 *
 *   r = (M - M(theta)) theta'' - C(theta, theta') + K (theta - sin theta)
 *
 * along the exact motion: its energy norm grows by at most |r|_M^-1. The exact motion conserves its
 * energy S^2/2: 2 sqrt(b_i) |sin(theta_i/2)| <= S. With D = diag(cos theta) and E = diag(sin
 * theta), M(theta) = D M D + E M E >= D M D bounds the rates by S and the accelerations by the
 * forces. */
rot_links_bound rot_links_linear_bound(const rot_links *c, const rot_links_modes *m,
                                       const double theta[], const double omega[], double time_s) {
  const size_t n = c->n;
  const double root_g = sqrt(c->gravity_m_per_s2), time = root_g * fabs(time_s);
  const double size = energy_norm(c, m, theta, omega), fastest = m->rate[n - 1];
  double swing[ROT_LINKS_MAX], turn[ROT_LINKS_MAX];
  double bends[ROT_LINKS_MAX] = {0.0}, rest[ROT_LINKS_MAX] = {0.0};
  double min = INFINITY, max = 0.0, trace = 0.0;
  for (size_t i = 0; i < n; i++) {
    if (!(size <= 2.0 * MAX_SINE * m->root[i]) || fabs(theta[i]) > 1.0) {
      return (rot_links_bound){INFINITY, INFINITY, INFINITY};
    }
    swing[i] = 2.0 * asin(0.5 * size / m->root[i]);
    turn[i] = size * sqrt(m->inverse[i * n + i]) / cos(swing[i]);
    max = fmax(max, swing[i]);
    min = fmin(min, m->root[i]);
    trace += m->inverse[i * n + i];
  }
  const double cosine = cos(max);
  for (size_t i = 0; i < n; i++) {
    bends[i] = 0.0; /* |C_i| */
    for (size_t j = 0; j < n; j++) {
      if (j != i)
        bends[i] += rot_links_inertia(c, i, j) * (swing[i] + swing[j]) * turn[j] * turn[j];
    }
  }
  /* |D theta''|_M from D^-1 (K sin theta + C). */
  const double force = (fastest * size + force_norm(c, m, bends)) / cosine;
  for (size_t i = 0; i < n; i++) {
    rest[i] = bends[i];
    for (size_t j = 0; j < n; j++) {
      const double difference = swing[i] + swing[j];
      const double faster = sqrt(m->inverse[j * n + j]) * force / cos(swing[j]);
      if (j != i) rest[i] += rot_links_inertia(c, i, j) * (0.5 * difference * difference) * faster;
    }
  }
  const double part = max > 0.0 ? 0.5 * max / sin(0.5 * max) : 1.0;
  const double left = force_norm(c, m, rest) + fastest * (max * max / 6.0) * part * size;
  const double rounding = 8.0 * ROT_EPS * (double)(n + 2) * (2.0 + fastest * time) * size;
  const double error = 1.0000001 * (time * left) + rounding;
  double sum = 0.0;
  for (size_t i = 0; i < n; i++) {
    const double root = m->root[i];
    sum += root * (root * swing[i] * swing[i] * swing[i] / 6.0 + error);
  }
  return (rot_links_bound){error / min, root_g * error * sqrt(trace),
                           c->gravity_m_per_s2 * sum * fabs(time_s)};
}
