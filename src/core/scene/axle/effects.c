#include "scene/axle/effects.h"

/* One bit for each kind of load present. */
unsigned rot_axle_effects(const rot_axle_scene *scene) {
  const rot_torque *torque = &scene->linear.torque;
  int acts = torque->before_n_m != 0.0 || torque->after_n_m != 0.0, ramp = 0;
  for (size_t i = 0; i < torque->n && !ramp; i++) {
    acts |= torque->torque_n_m[i] != 0.0;
    ramp = i > 0 && torque->torque_n_m[i] != torque->torque_n_m[i - 1] &&
           torque->time_s[i] > torque->time_s[i - 1];
  }
  unsigned mask = (acts || ramp ? ROT_AXLE_TORQUE : 0u) | (ramp ? ROT_AXLE_RAMP : 0u);
  for (size_t i = 0; i < scene->n_terms; i++) {
    mask |= 1u << (ROT_AXLE_INDEX_SINUSOID + (int)scene->terms[i].kind);
  }
  if (torque->call) mask |= ROT_AXLE_FUNCTION;
  if (scene->viscous_n_m_s != 0.0) mask |= ROT_AXLE_VISCOUS;
  if (scene->motor_n_m_s != 0.0) mask |= ROT_AXLE_MOTOR;
  if (scene->quadratic_n_m_s2 != 0.0) mask |= ROT_AXLE_QUADRATIC;
  if (scene->static_n_m != 0.0) mask |= ROT_AXLE_FRICTION;
  if (scene->n_inertia > 0) mask |= ROT_AXLE_INERTIA;
  return mask;
}

int rot_axle_fits(const rot_axle_scene *scene, unsigned takes) {
  if (rot_axle_effects(scene) & ~takes) return 0;
  int possible = scene->linear.inertia_kg_m2 > 0.0;
  for (size_t i = 0; i < scene->n_inertia; i++) possible &= scene->inertia_kg_m2[i] > 0.0;
  return possible;
}
