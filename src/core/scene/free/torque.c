#include "scene/free/torque.h"

#include <math.h>

#include "maths/attitude.h"
#include "ground/dd.h"
#include "ground/real.h"
#include "ground/search.h"

int rot_free_between_knots(size_t n, const double x[], double t, size_t *i, double *part) {
  if (n < 2 || !(t >= x[0] && t <= x[n - 1])) return 0;
  const size_t next = rot_upper_bound(n, x, t);
  *i = (next < n ? next : n - 1) - 1;
  const double width = x[*i + 1] - x[*i];
  *part = width > 0.0 ? (t - x[*i]) / width : 1.0; /* width 0: a jump at the last time */
  return 1;
}

static void add_knots(const rot_free_params *p, double t, double torque[3]) {
  size_t i;
  double part;
  if (!rot_free_between_knots(p->n_knots, p->knot_s, t, &i, &part)) return;
  for (int k = 0; k < 3; k++) {
    const double a = p->knot_torque[k][i], b = p->knot_torque[k][i + 1];
    torque[k] += part < 1.0 ? a + (b - a) * part : b;
  }
}

int rot_free_has_weight(const rot_free_params *p) {
  return p->lever_n_m[0] != 0.0 || p->lever_n_m[1] != 0.0 || p->lever_n_m[2] != 0.0;
}

/* z of a unit quaternion's body axes, |q|^2 divided out. */
static void up_of(const double q[4], rot_dd up[3]) {
  const rot_dd ww = rot_dd_mul2(q[0], q[0]), xx = rot_dd_mul2(q[1], q[1]);
  const rot_dd yy = rot_dd_mul2(q[2], q[2]), zz = rot_dd_mul2(q[3], q[3]);
  const rot_dd across = rot_dd_add(xx, yy), along = rot_dd_add(ww, zz);
  const rot_dd size = rot_dd_add(along, across);
  up[0] = rot_dd_sub(rot_dd_mul2(q[1], q[3]), rot_dd_mul2(q[0], q[2]));
  up[1] = rot_dd_add(rot_dd_mul2(q[2], q[3]), rot_dd_mul2(q[0], q[1]));
  up[2] = rot_dd_sub(along, across);
  for (int k = 0; k < 3; k++) up[k] = rot_dd_div(rot_dd_ldexp(up[k], k < 2), size);
}

/* The constant torque in the axes of the body at the start, |q|^2 divided out. */
static void constant_of(const rot_free_params *p, int exponent, rot_dd torque[3]) {
  const double *q = p->q0, *u = q + 1;
  rot_dd square = {0.0, 0.0}, along = {0.0, 0.0}, v[3];
  for (int k = 0; k < 3; k++) {
    torque[k] = v[k] = (rot_dd){ldexp(p->torque[k], -exponent), 0.0};
    square = rot_dd_add(square, rot_dd_mul2(u[k], u[k]));
    along = rot_dd_add(along, rot_dd_mul1(v[k], u[k]));
  }
  if (!p->in_space) return;
  const rot_dd ww = rot_dd_mul2(q[0], q[0]), size = rot_dd_add(ww, square);
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const rot_dd side = rot_dd_sub(rot_dd_mul1(v[j], u[i]), rot_dd_mul1(v[i], u[j]));
    const rot_dd turns = rot_dd_sub(rot_dd_mul1(along, u[k]), rot_dd_mul1(side, q[0]));
    const rot_dd stays = rot_dd_mul(rot_dd_sub(ww, square), v[k]);
    torque[k] = rot_dd_div(rot_dd_add(stays, rot_dd_ldexp(turns, 1)), size);
  }
}

static double largest_of(const double x[3]) {
  return fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
}

void rot_free_hang(const rot_free_params *p, rot_free_hung *out) {
  const double *high = p->turned ? p->own_lever_n_m[0] : p->lever_n_m;
  const double *low = p->turned ? p->own_lever_n_m[1] : p->lever_low_n_m;
  rot_dd up[3], lever[3], constant[3];
  int exponent;
  (void)frexp(fmax(largest_of(high), largest_of(p->torque)), &exponent);
  up_of(p->q0, up);
  constant_of(p, exponent, constant);
  for (int k = 0; k < 3; k++) {
    lever[k] = rot_dd_sum2(ldexp(high[k], -exponent), ldexp(low[k], -exponent));
    out->up[k] = up[k].hi;
    out->space[k] = p->in_space ? ldexp(constant[k].hi, exponent) : 0.0;
  }
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const rot_dd torque = rot_dd_sub(rot_dd_mul(up[i], lever[j]), rot_dd_mul(up[j], lever[i]));
    out->torque[k] = ldexp(torque.hi, exponent);
    out->lost[k] = ldexp(torque.lo, exponent);
    out->both[k] = ldexp(rot_dd_add(torque, constant[k]).hi, exponent);
  }
  if (p->turned) {
    const rot_free_hung own = *out;
    rot_attitude_to_body(p->axes, own.up, out->up);
    rot_attitude_to_body(p->axes, own.torque, out->torque);
    rot_attitude_to_body(p->axes, own.lost, out->lost);
    rot_attitude_to_body(p->axes, own.both, out->both);
    rot_attitude_to_body(p->axes, own.space, out->space);
  }
}

/* What a vector that stays in space, x in the body before it, changes by in the body. */
static void change_of(const double x[3], const double q[4], double change[3]) {
  double side[3];
  rot_cross(q + 1, x, side);
  rot_cross(q + 1, side, change);
  for (int k = 0; k < 3; k++) change[k] = 2.0 * (change[k] - q[0] * side[k]);
}

void rot_free_add_hung(const rot_free_params *p, const rot_free_hung *hung, const double q[4],
                       double torque[3]) {
  double change[3], more[3];
  change_of(hung->up, q, change);
  rot_cross(change, p->lever_n_m, more);
  for (int k = 0; k < 3; k++) torque[k] = torque[k] + hung->torque[k] + (hung->lost[k] + more[k]);
}

/* Sum of constant, table and law. */
static rot_status sum_of(const rot_free_params *p, const double constant[3], double t,
                         const double omega[3], const double q[4], double out[3]) {
  double torque[3] = {constant[0], constant[1], constant[2]};
  add_knots(p, t, torque);
  if (p->law) {
    double own_q[4] = {q[0], q[1], q[2], q[3]}, own[3] = {omega[0], omega[1], omega[2]}, more[3];
    if (p->turned) {
      const double back[4] = {p->axes[0], -p->axes[1], -p->axes[2], -p->axes[3]};
      rot_attitude_times(q, back, own_q);
      rot_attitude_to_space(p->axes, omega, own);
    }
    (void)rot_attitude_unit(own_q); /* the law may depend on q, whose norm is not 1 within a step */
    const rot_status status = p->law(t, own, own_q, more, p->ctx);
    if (status != ROT_OK) return status;
    for (int k = 0; k < 3; k++) torque[k] += more[k];
  }
  if (p->in_space) {
    rot_attitude_to_body(q, torque, out);
  } else if (p->turned) {
    rot_attitude_to_body(p->axes, torque, out);
  } else {
    for (int k = 0; k < 3; k++) out[k] = torque[k];
  }
  return ROT_OK;
}

rot_status rot_free_torque(const rot_free_params *p, double t, const double omega[3],
                           const double q[4], double out[3]) {
  return sum_of(p, p->torque, t, omega, q, out);
}

rot_status rot_free_torque_hung(const rot_free_params *p, const rot_free_hung *hung, double t,
                                const double omega[3], const double q[4], const double turned[4],
                                double out[3]) {
  static const double none[3] = {0.0, 0.0, 0.0};
  double change[3], more[3], space[3] = {0.0, 0.0, 0.0}, varies[3] = {0.0, 0.0, 0.0};
  if (p->law || p->n_knots) {
    const rot_status status = sum_of(p, none, t, omega, q, varies);
    if (status != ROT_OK) return status;
  }
  change_of(hung->up, turned, change);
  rot_cross(change, p->lever_n_m, more);
  if (p->in_space) change_of(hung->space, turned, space);
  for (int k = 0; k < 3; k++) out[k] = varies[k] + hung->both[k] + (more[k] + space[k]);
  return ROT_OK;
}

/* Turned into the axes of the body, the latter twice as much where it stays in space: a body that a
 * called torque held aside moved by 1e-10 rad/s, off by 1.6e6 times the figure. */
double rot_free_law_rounding(const rot_free_params *p) {
  double torque[3], omega[3], q[4];
  if ((!p->law && !p->n_knots) || !rot_free_has_weight(p)) return 0.0;
  rot_free_principal(p, omega, q);
  const double just_after = nextafter(p->start_s, INFINITY);
  const rot_status status = rot_free_torque(p, just_after, omega, q, torque);
  return status == ROT_OK ? (p->in_space ? 16.0 : 8.0) * ROT_EPS * rot_length(torque) : 0.0;
}
