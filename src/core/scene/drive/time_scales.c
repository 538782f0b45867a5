#include "scene/drive/time_scales.h"

#include <math.h>
#include <stddef.h>

#include "scene/axle/time_scales.h"
#include "scene/drive/drive.h"

/* Bound (Gershgorin) on the largest eigenvalue of J^-1/2 K J^-1/2, K of springs or dampers between
 * neighbours with ratios: k (theta_i - ratio theta_(i+1))^2/2. Rigid gears only decrease it. of:
 * offset of k in a coupling. */
static double largest_rate(const rot_drive_scene *scene, size_t of) {
  double max = 0.0, before = 0.0;
  for (size_t i = 0; i < scene->n; i++) {
    double own = before;
    if (i + 1 < scene->n) {
      const rot_drive_coupling *c = &scene->coupling[i];
      const double k = *(const double *)((const char *)c + of);
      const double j = scene->rotor[i].linear.inertia_kg_m2;
      const double next = scene->rotor[i + 1].linear.inertia_kg_m2;
      const double across = k * fabs(c->ratio) / sqrt(j) / sqrt(next);
      own += k / j + across;
      before = k * c->ratio * c->ratio / next + across;
    }
    max = fmax(max, own);
  }
  return max;
}

/* Oscillation: shafts, laws, rates of the rotors; decay: dampers, resistance. */
void rot_drive_time_scales(const void *of, const double sizes[], rot_time_scales *to) {
  const rot_drive_scene *scene = of;
  double decay = 0.0;
  double swing = sqrt(largest_rate(scene, offsetof(rot_drive_coupling, stiffness_n_m_per_rad)));
  for (size_t i = 0; i < scene->n; i++) {
    const rot_drive_friction *friction[] = {&scene->brake[i],
                                            i + 1 < scene->n ? &scene->coupling[i].friction : NULL};
    const rot_axle_rates rotor = rot_axle_rates_of(&scene->rotor[i], sizes[ROT_OMEGA]);
    decay = fmax(decay, rotor.decay_per_s);
    swing = fmax(swing, rotor.swing_rad_per_s);
    for (int k = 0; k < 2; k++) {
      if (!friction[k] || !friction[k]->acts) continue;
      const rot_axle_rates law = rot_axle_rates_of(&friction[k]->law, sizes[ROT_OMEGA]);
      swing = fmax(swing, law.swing_rad_per_s);
    }
  }
  decay += largest_rate(scene, offsetof(rot_drive_coupling, damping_n_m_s));
  *to = (rot_time_scales){1.0 / decay, swing};
}

void rot_drive_time_scales_of_start(const void *of, rot_time_scales *time_scales) {
  const rot_drive_scene *scene = of;
  double sizes[ROT_MAX_MEASURES] = {0.0};
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_params *rotor = &scene->rotor[i].linear;
    sizes[ROT_THETA] = fmax(sizes[ROT_THETA], fabs(rotor->theta0_rad));
    sizes[ROT_OMEGA] = fmax(sizes[ROT_OMEGA], fabs(rotor->omega0_rad_per_s));
  }
  rot_drive_time_scales(of, sizes, time_scales);
}
