/* How fast the motion of a drive goes. */
#ifndef ROT_DRIVE_TIME_SCALES_H
#define ROT_DRIVE_TIME_SCALES_H

#include "engine/model.h"

/* rot_constraint.time_scales of sizes by measure: theta, omega; and of those at the start. */
void rot_drive_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);
void rot_drive_time_scales_of_start(const void *scene, rot_time_scales *time_scales);

#endif
