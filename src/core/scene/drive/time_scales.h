/* Time scales of a drive. */
#ifndef ROT_DRIVE_TIME_SCALES_H
#define ROT_DRIVE_TIME_SCALES_H

#include "engine/model.h"

/* rot_constraint.time_scales: largest values of theta, omega => time scales. */
void rot_drive_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);
/* The same with the values at the start. */
void rot_drive_time_scales_of_start(const void *scene, rot_time_scales *time_scales);

#endif
