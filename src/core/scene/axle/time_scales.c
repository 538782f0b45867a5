#include "scene/axle/time_scales.h"

#include <math.h>

/* Largest |slope| of a torque-speed curve. */
static double steepest(const rot_term *curve) {
  const size_t n = (size_t)curve->x[0];
  const double *omega = curve->x + 1, *torque = omega + n;
  double slope = 0.0;
  for (size_t i = 1; i < n; i++) {
    slope = fmax(slope, fabs((torque[i] - torque[i - 1]) / (omega[i] - omega[i - 1])));
  }
  return slope;
}

/* Sums the decays, takes the fastest oscillation of the loads. */
rot_axle_rates rot_axle_rates_of(const rot_axle_scene *scene, double omega) {
  double inertia = scene->linear.inertia_kg_m2;
  for (size_t i = 0; i < scene->n_inertia; i++) inertia = fmin(inertia, scene->inertia_kg_m2[i]);
  const double falls =
      fabs(scene->viscous_n_m_s) + fabs(scene->motor_n_m_s) + 2.0 * scene->quadratic_n_m_s2 * omega;
  rot_axle_rates rates = {falls / inertia, 0.0};
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term *term = &scene->terms[i];
    /* Quotient of roots: the root of the quotient may underflow. */
    const double own = sqrt(fabs(term->x[0])) / sqrt(inertia);
    double decay = 0.0, swing = 0.0;
    switch (term->kind) {
    case ROT_TERM_SINUSOID: decay = swing = fabs(term->x[1]); break;
    case ROT_TERM_EXPONENTIAL: decay = fabs(term->x[1]); break;
    case ROT_TERM_CURVE: decay = steepest(term) / inertia; break;
    case ROT_TERM_SPRING: decay = swing = own; break;
    case ROT_TERM_GRAVITY: /* periodic in the angle: as fast as the body rotates */
      decay = 2.0 * own;
      swing = fmax(decay, omega);
      break;
    default: break;
    }
    rates.decay_per_s = fmax(rates.decay_per_s, decay);
    rates.swing_rad_per_s = fmax(rates.swing_rad_per_s, swing);
  }
  return rates;
}

void rot_axle_time_scales(const void *built, const double sizes[], rot_time_scales *time_scales) {
  const rot_axle_rates rates = rot_axle_rates_of(built, sizes[ROT_OMEGA]);
  *time_scales = (rot_time_scales){1.0 / rates.decay_per_s, rates.swing_rad_per_s};
}

void rot_axle_time_scales_of_start(const void *built, rot_time_scales *time_scales) {
  const rot_axle_scene *scene = built;
  const double sizes[] = {fabs(scene->linear.theta0_rad), fabs(scene->linear.omega0_rad_per_s)};
  rot_axle_time_scales(scene, sizes, time_scales);
}

const double *rot_axle_breaks(const void *built, size_t *n) {
  const rot_axle_scene *scene = built;
  *n = scene->n_breaks;
  return scene->breaks_s;
}
