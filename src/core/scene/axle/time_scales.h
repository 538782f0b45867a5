/* How fast the motion of a body on an axle goes, by what acts on it. */
#ifndef ROT_AXLE_TIME_SCALES_H
#define ROT_AXLE_TIME_SCALES_H

#include "engine/model.h"
#include "scene/axle/scene.h"

/* A rate adds up, a swing is the fastest: decay_per_s of the transients, at the largest rate. */
typedef struct rot_axle_rates {
  double decay_per_s, swing_rad_per_s;
} rot_axle_rates;

rot_axle_rates rot_axle_rates_of(const rot_axle_scene *scene, double omega_rad_per_s);

/* rot_constraint.time_scales of sizes by measure: theta, omega; and of those at the start. */
void rot_axle_time_scales(const void *built, const double sizes[], rot_time_scales *time_scales);
void rot_axle_time_scales_of_start(const void *built, rot_time_scales *time_scales);

/* rot_constraint.breaks */
const double *rot_axle_breaks(const void *built, size_t *n);

#endif
