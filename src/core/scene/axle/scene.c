#include "scene/axle/scene.h"

#include <math.h>

#include "ground/sort.h"
#include "ground/real.h"

size_t rot_axle_scene_room(const rot_axle_scene *scene) {
  size_t room = scene->linear.torque.n + scene->n_inertia + scene->n_breaks + 1;
  for (size_t i = 0; i < scene->n_terms; i++) room += rot_term_breaks(&scene->terms[i], NULL);
  return room;
}

size_t rot_axle_scene_breaks(const rot_axle_scene *scene, double out[]) {
  const rot_torque *torque = &scene->linear.torque;
  size_t total = 0;
  for (size_t i = 0; i < torque->n; i++) out[total++] = torque->time_s[i];
  for (size_t i = 0; i < scene->n_terms; i++) {
    total += rot_term_breaks(&scene->terms[i], out + total);
  }
  for (size_t i = 0; i < scene->n_inertia; i++) out[total++] = scene->inertia_time_s[i];
  for (size_t i = 0; i < scene->n_breaks; i++) out[total++] = scene->breaks_s[i];
  return rot_sort_once(total, out);
}

double rot_axle_scene_applied(const rot_axle_scene *scene, double t, double theta, double theta_lo,
                              double omega) {
  double torque = rot_torque_at(&scene->linear.torque, t);
  for (size_t i = 0; i < scene->n_terms; i++) {
    torque += rot_term_at(&scene->terms[i], t, theta, theta_lo, omega);
  }
  return scene->motor_n_m_s != 0.0 ? torque - scene->motor_n_m_s * omega : torque;
}

double rot_axle_scene_inertia(const rot_axle_scene *scene, double t) {
  const size_t n = scene->n_inertia;
  if (n == 0) return scene->linear.inertia_kg_m2;
  const rot_torque law = {n,
                          scene->inertia_time_s,
                          scene->inertia_kg_m2,
                          scene->inertia_kg_m2[0],
                          scene->inertia_kg_m2[n - 1],
                          NULL,
                          NULL};
  return rot_torque_at(&law, t);
}

double rot_axle_scene_resistance(const rot_axle_scene *scene, double omega) {
  double torque = 0.0 - scene->viscous_n_m_s * omega;
  if (scene->quadratic_n_m_s2 != 0.0) torque -= scene->quadratic_n_m_s2 * omega * fabs(omega);
  if (scene->coulomb_n_m != 0.0 && omega != 0.0) torque -= copysign(scene->coulomb_n_m, omega);
  return torque;
}

int rot_axle_kinks_at_rest(const rot_axle_scene *scene) {
  return scene->quadratic_n_m_s2 != 0.0 || scene->coulomb_n_m != 0.0 || scene->static_n_m != 0.0;
}

int rot_axle_scene_sticks(const rot_axle_scene *scene, double omega, double applied) {
  return omega == 0.0 && scene->static_n_m > 0.0 && fabs(applied) <= scene->static_n_m;
}

/* In motion, or as it breaks loose. */
static double resisting(const rot_axle_scene *scene, double omega, double applied) {
  const double damping = rot_axle_scene_resistance(scene, omega);
  const int leaves = omega == 0.0 && applied != 0.0;
  return leaves ? damping - copysign(scene->coulomb_n_m, applied) : damping;
}

/* Applied, resisting and net torque of each state. */
void rot_axle_scene_torques(const rot_axle_scene *scene, size_t n, const double time_s[],
                            const double theta_rad[], const double omega_rad_per_s[],
                            double applied_n_m[], double damping_n_m[], double net_n_m[]) {
  for (size_t i = 0; i < n; i++) {
    const double omega = omega_rad_per_s[i];
    const double applied = rot_axle_scene_applied(scene, time_s[i], theta_rad[i], 0.0, omega);
    const int sticks = rot_axle_scene_sticks(scene, omega, applied);
    const double damping = sticks ? 0.0 - applied : resisting(scene, omega, applied);
    applied_n_m[i] = applied;
    damping_n_m[i] = damping;
    net_n_m[i] = applied + damping;
  }
}

void rot_axle_scene_row(const rot_axle_scene *scene, const rot_axle_columns *out, size_t i,
                        double t, double theta, double omega, double applied, int stuck) {
  const double resistance = stuck ? 0.0 - applied : resisting(scene, omega, applied);
  const double momentum = rot_axle_scene_inertia(scene, t) * omega;
  out->theta_rad[i] = theta;
  out->omega_rad_per_s[i] = omega;
  out->applied_torque_n_m[i] = applied;
  out->damping_torque_n_m[i] = resistance;
  out->net_torque_n_m[i] = applied + resistance;
  out->angular_momentum_kg_m2_per_s[i] = momentum;
  out->rotational_kinetic_energy_j[i] = 0.5 * momentum * omega;
}

int rot_axle_scene_plain(const rot_axle_scene *scene, const rot_info *info) {
  const rot_torque *torque = &scene->linear.torque;
  const double max = 1e75;
  int ok = fabs(scene->linear.inertia_kg_m2) < max && fabs(scene->viscous_n_m_s) < max &&
           fabs(scene->motor_n_m_s) < max && scene->quadratic_n_m_s2 < max &&
           scene->static_n_m < max && fabs(torque->before_n_m) < max &&
           fabs(torque->after_n_m) < max;
  for (size_t i = 0; i < info->n_measures; i++) ok &= info->measure[i].largest < max;
  for (size_t i = 0; i < torque->n; i++) ok &= fabs(torque->torque_n_m[i]) < max;
  for (size_t i = 0; i < scene->n_inertia; i++) ok &= scene->inertia_kg_m2[i] < max;
  for (size_t i = 0; i < scene->n_terms; i++) {
    for (size_t k = 0; k < scene->terms[i].length; k++) ok &= fabs(scene->terms[i].x[k]) < max;
  }
  return ok;
}
