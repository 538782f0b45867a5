#include "scene/free/free.h"

#include <math.h>

#include "maths/attitude.h"
#include "scene/free/motion.h"
#include "ground/real.h"

const char *const rot_free_measures[] = {"attitude", "omega", "angular_momentum", NULL};

void rot_free_principal(const rot_free_params *p, double omega[3], double q[4]) {
  for (int i = 0; i < 3; i++) omega[i] = p->omega0_rad_per_s[i];
  for (int i = 0; i < 4; i++) q[i] = p->q0[i];
  if (!p->turned) return;
  rot_attitude_to_body(p->axes, p->omega0_rad_per_s, omega);
  rot_attitude_times(p->q0, p->axes, q);
  (void)rot_attitude_unit(q);
}

/* Quaternion, rates and momentum in own and space axes, energy. */
rot_status rot_free_write(const rot_free_params *p, const double omega[3], const double q[4],
                          size_t i, const rot_free_columns *out) {
  double own_q[4] = {q[0], q[1], q[2], q[3]}, own[3] = {omega[0], omega[1], omega[2]};
  double l[3], space[3], energy = 0.0, sum = 0.0;
  if (p->turned) {
    const double back[4] = {p->axes[0], -p->axes[1], -p->axes[2], -p->axes[3]};
    rot_attitude_times(q, back, own_q);
    (void)rot_attitude_unit(own_q);
    rot_attitude_to_space(p->axes, omega, own);
  }
  out->qw[i] = own_q[0];
  out->qx[i] = own_q[1];
  out->qy[i] = own_q[2];
  out->qz[i] = own_q[3];
  out->omega_x_rad_per_s[i] = own[0];
  out->omega_y_rad_per_s[i] = own[1];
  out->omega_z_rad_per_s[i] = own[2];
  rot_attitude_to_space(q, omega, space);
  out->omega_space_x_rad_per_s[i] = space[0];
  out->omega_space_y_rad_per_s[i] = space[1];
  out->omega_space_z_rad_per_s[i] = space[2];
  for (int k = 0; k < 3; k++) {
    l[k] = p->moment_kg_m2[k] * omega[k];
    energy += 0.5 * l[k] * omega[k];
  }
  rot_attitude_to_space(q, l, space);
  out->angular_momentum_x_kg_m2_per_s[i] = space[0];
  out->angular_momentum_y_kg_m2_per_s[i] = space[1];
  out->angular_momentum_z_kg_m2_per_s[i] = space[2];
  out->rotational_kinetic_energy_j[i] = energy;
  for (int k = 0; k < 3; k++) sum += own[k] + space[k] + own_q[k];
  return isfinite(sum + energy) ? ROT_OK : ROT_ERANGE;
}

/* Converts both errors to the three measures. */
void rot_free_note(const rot_free_params *p, const double omega[3], double angle_error,
                   double omega_error, rot_info *info) {
  double l[3], max = 0.0;
  for (int i = 0; i < 3; i++) {
    l[i] = p->moment_kg_m2[i] * omega[i];
    max = fmax(max, p->moment_kg_m2[i]);
  }
  const double size = rot_length(omega), momentum = rot_length(l);
  const double errors[] = {angle_error, omega_error + 4.0 * ROT_EPS * size,
                           max * omega_error + momentum * (angle_error + 8.0 * ROT_EPS)};
  const double sizes[] = {1.0, size, momentum};
  for (int k = 0; k < 3; k++) {
    rot_note_value(&info->measure[k], sizes[k]);
    if (!(errors[k] <= info->measure[k].error)) info->measure[k].error = errors[k];
  }
}

int rot_free_flips(const double moment_kg_m2[3], const double omega_rad_per_s[3]) {
  rot_free_motion m;
  if (rot_free_begin(moment_kg_m2, omega_rad_per_s, 0.0, &m) != ROT_OK) return 0;
  return !m.still && !m.steady &&
         fabs(m.moment[1] * m.amplitude[1]) >= 0x1.6a09e667f3bcdp-1 * m.momentum;
}
