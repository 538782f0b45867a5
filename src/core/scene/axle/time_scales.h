/* Time scales of a body on an axle, from its loads. */
#ifndef ROT_AXLE_TIME_SCALES_H
#define ROT_AXLE_TIME_SCALES_H

#include "engine/model.h"
#include "scene/axle/scene.h"

/* Rates of a motion. */
typedef struct rot_axle_rates {
  double decay_per_s;     /* of the transients, sum over the loads */
  double swing_rad_per_s; /* oscillation, maximum over the loads */
} rot_axle_rates;

/* (scene, largest |omega|) => rates. */
rot_axle_rates rot_axle_rates_of(const rot_axle_scene *scene, double omega_rad_per_s);

/* rot_constraint.time_scales: largest values of theta, omega => time scales. */
void rot_axle_time_scales(const void *built, const double sizes[], rot_time_scales *time_scales);
/* The same with the values at the start. */
void rot_axle_time_scales_of_start(const void *built, rot_time_scales *time_scales);

/* rot_constraint.breaks: scene => breaks, their number. */
const double *rot_axle_breaks(const void *built, size_t *n);

#endif
