/* Time scales of a body on an incline. */
#ifndef ROT_INCLINE_TIME_SCALES_H
#define ROT_INCLINE_TIME_SCALES_H

#include "engine/model.h"

/* rot_constraint.time_scales: largest values of the measures => time scales. */
void rot_incline_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);
/* The same with the speeds at the start. */
void rot_incline_time_scales_of_start(const void *scene, rot_time_scales *time_scales);

#endif
