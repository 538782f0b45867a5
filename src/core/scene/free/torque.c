#include "scene/free/torque.h"

#include "maths/attitude.h"
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

void rot_free_add_weight(const rot_free_params *p, const double q[4], double torque[3]) {
  static const double up[3] = {0.0, 0.0, 1.0};
  const double *g = p->lever_n_m;
  double z[3];
  rot_attitude_to_body(q, up, z);
  torque[0] += z[1] * g[2] - z[2] * g[1];
  torque[1] += z[2] * g[0] - z[0] * g[2];
  torque[2] += z[0] * g[1] - z[1] * g[0];
}

/* Sum of constant, table, law and gravity. */
rot_status rot_free_torque(const rot_free_params *p, double t, const double omega[3],
                           const double q[4], int weight, double out[3]) {
  double torque[3] = {p->torque[0], p->torque[1], p->torque[2]};
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
  if (weight && rot_free_has_weight(p)) rot_free_add_weight(p, q, out);
  return ROT_OK;
}
