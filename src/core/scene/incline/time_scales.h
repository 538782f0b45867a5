/* How fast the motion of a body on an incline goes. */
#ifndef ROT_INCLINE_TIME_SCALES_H
#define ROT_INCLINE_TIME_SCALES_H

#include "engine/model.h"

/* rot_constraint.time_scales of sizes by measure; and of those at the start. */
void rot_incline_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);
void rot_incline_time_scales_of_start(const void *scene, rot_time_scales *time_scales);

#endif
