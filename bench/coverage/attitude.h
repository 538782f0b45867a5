/* Quaternions in quadruple precision, scalar first, body to space: what the coverage programs of
 * bodies in space need. */
#ifndef COVERAGE_ATTITUDE_H
#define COVERAGE_ATTITUDE_H

#include <quadmath.h>

typedef __float128 quad;

static inline void times(const quad p[4], const quad q[4], quad out[4]) {
  const quad w = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
  const quad x = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
  const quad y = p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3];
  const quad z = p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1];
  out[0] = w, out[1] = x, out[2] = y, out[3] = z;
}

/* q v q* over |q|^2; back: q* v q. */
static inline void turn(const quad q[4], const quad v[3], int back, quad out[3]) {
  const quad s = back ? -1 : 1, norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const quad x = s * q[1], y = s * q[2], z = s * q[3];
  const quad c[3] = {y * v[2] - z * v[1] + q[0] * v[0], z * v[0] - x * v[2] + q[0] * v[1],
                     x * v[1] - y * v[0] + q[0] * v[2]};
  out[0] = v[0] + 2 * (y * c[2] - z * c[1]) / norm;
  out[1] = v[1] + 2 * (z * c[0] - x * c[2]) / norm;
  out[2] = v[2] + 2 * (x * c[1] - y * c[0]) / norm;
}

/* dq/dt = q (0, omega) / 2, omega in the body. */
static inline void attitude_slopes(const quad q[4], const quad w[3], quad f[4]) {
  const quad spin[4] = {0, w[0] / 2, w[1] / 2, w[2] / 2};
  times(q, spin, f);
}

static inline double angle_between(const quad p[4], const quad q[4]) {
  const quad back[4] = {p[0], -p[1], -p[2], -p[3]};
  quad d[4];
  times(back, q, d);
  return (double)(2 * atan2q(sqrtq(d[1] * d[1] + d[2] * d[2] + d[3] * d[3]), fabsq(d[0])));
}

#endif
