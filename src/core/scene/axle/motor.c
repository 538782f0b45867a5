#include "scene/axle/motor.h"

#include <math.h>

#include "ground/real.h"

void rot_axle_motor_columns(const rot_axle_scene *scene, size_t n, const rot_axle_columns *out) {
  if (scene->motor_n_m_s == 0.0) return;
  for (size_t i = 0; i < n; i++) {
    const double omega = out->omega_rad_per_s[i];
    out->applied_torque_n_m[i] -= scene->motor_n_m_s * omega;
    out->damping_torque_n_m[i] = 0.0 - scene->viscous_n_m_s * omega;
    out->net_torque_n_m[i] = out->applied_torque_n_m[i] + out->damping_torque_n_m[i];
  }
}

void rot_axle_motor_ledger(const rot_axle_scene *scene, rot_axle_ledger *ledger) {
  const double both = scene->linear.viscous_n_m_s;
  const double fraction = both != 0.0 ? scene->motor_n_m_s / both : 0.0, rest = 1.0 - fraction;
  if (fraction == 0.0) return;
  ledger->work_j -= fraction * ledger->dissipated_j;
  ledger->work_rounding_j += fabs(fraction) * ledger->dissipated_rounding_j;
  ledger->impulse_n_m_s += fraction * ledger->damping_impulse_n_m_s;
  ledger->dissipated_j *= rest;
  ledger->dissipated_rounding_j *= rest;
  ledger->viscous_j *= rest;
  ledger->damping_impulse_n_m_s *= rest;
}

/* The sum c has an error d, and cancels if the resistance drives. d changes each term of a closed
 * form by at most the fraction d t/I, and for c > 0, forward in time, by at most 3.4 d/c of the
 * largest omega. The bounds count 12 roundings of the terms. */
void rot_axle_motor_error(const rot_axle_scene *scene, size_t n, const double time_s[],
                          rot_info *info) {
  const rot_axle_params *p = &scene->linear;
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s, motor = scene->motor_n_m_s;
  if (motor == 0.0 || n == 0 || info->status != ROT_OK) return;
  rot_measure *theta = &info->measure[ROT_THETA], *omega = &info->measure[ROT_OMEGA];
  const double span_s = fmax(fabs(time_s[0] - p->start_s), fabs(time_s[n - 1] - p->start_s));
  const double off = fabs(motor) + fabs(c), moved = off / I * span_s / 12.0;
  double of_omega = omega->error > 0.0 ? moved * omega->error : 0.0;
  double of_theta = theta->error > 0.0 ? moved * theta->error : 0.0;
  if (c > 0.0 && isfinite(off) && time_s[0] >= p->start_s) {
    const double fraction = 3.4 * off / c;
    of_omega = fmin(of_omega, ROT_EPS * fraction * omega->largest);
    of_theta =
        fmin(of_theta, fraction / 12.0 * theta->error + (of_omega > 0.0 ? I / c * of_omega : 0.0));
  }
  omega->error += of_omega;
  theta->error += of_theta;
}
