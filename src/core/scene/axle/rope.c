#include "scene/axle/rope.h"

#include <float.h>
#include <math.h>

/* With the total moment I: T1 = m1 (g (I0 + 2 m2 r^2) - r tau)/I, T2 = m2 (g (I0 + 2 m1 r^2) + r
 * tau)/I: g - a does not cancel. */
void rot_axle_rope_rows(const rot_axle_rope *rope, double whole, size_t n,
                        const rot_axle_columns *rows, double alpha[],
                        double *const mass[2][ROT_AXLE_OF_MASS]) {
  const double *m = rope->mass_kg, own = rope->inertia_kg_m2;
  const double r = rope->radius_m, g = rope->gravity_m_per_s2;
  const int masses = m[1] > 0.0 ? 2 : 1;
  for (size_t i = 0; i < n; i++) {
    const double omega = rows->omega_rad_per_s[i], damping = rows->damping_torque_n_m[i];
    alpha[i] = rows->net_torque_n_m[i] / whole;
    rows->net_torque_n_m[i] = own * alpha[i];
    rows->applied_torque_n_m[i] =
        rows->applied_torque_n_m[i] * (own / whole) - damping * ((m[0] + m[1]) * r * r / whole);
    rows->rotational_kinetic_energy_j[i] = 0.5 * own * omega * omega;
    for (int k = 0; k < masses; k++) {
      const double side = k ? -1.0 : 1.0, v = r * omega;
      const double height = -side * r * rows->theta_rad[i] + 0.0;
      mass[k][0][i] =
          m[k] * (g * ((own + 2.0 * m[1 - k] * r * r) / whole) - side * r * (damping / whole));
      mass[k][1][i] = height;
      mass[k][2][i] = 0.5 * m[k] * (v * v);
      mass[k][3][i] = m[k] * g * height;
    }
  }
}

double rot_axle_rope_potential(const rot_axle_rope *rope, const double theta[2],
                               const double error[2], double *explained) {
  const double weight =
      (rope->mass_kg[0] - rope->mass_kg[1]) * rope->gravity_m_per_s2 * rope->radius_m;
  const double change = -weight * (theta[1] - theta[0]);
  *explained = fabs(weight) * (error[0] + error[1]) + 4.0 * DBL_EPSILON * fabs(change);
  return change;
}

double rot_axle_rope_moment(const rot_axle_rope *rope) {
  return (rope->mass_kg[0] + rope->mass_kg[1]) * (rope->radius_m * rope->radius_m);
}
