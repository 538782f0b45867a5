/* How fast the motion of a body on an axle goes, by what acts on it. */
#ifndef ROT_AXLE_PACE_H
#define ROT_AXLE_PACE_H

#include "engine/model.h"
#include "scene/axle/scene.h"

/* A rate adds up, a swing is the fastest: decay_per_s of the transients, at the largest rate. */
typedef struct rot_axle_rates {
  double decay_per_s, swing_rad_per_s;
} rot_axle_rates;

rot_axle_rates rot_axle_rates_of(const rot_axle_scene *scene, double omega_rad_per_s);

/* rot_constraint.pace of sizes by measure: theta, omega; and of those at the start. */
void rot_axle_pace(const void *built, const double sizes[], rot_pace *pace);
void rot_axle_pace_of_start(const void *built, rot_pace *pace);

/* rot_constraint.breaks */
const double *rot_axle_breaks(const void *built, size_t *n);

#endif
