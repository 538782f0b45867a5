/* How fast the motion of a drive goes. */
#ifndef ROT_DRIVE_PACE_H
#define ROT_DRIVE_PACE_H

#include "engine/model.h"

/* rot_constraint.pace of sizes by measure: theta, omega; and of those at the start. */
void rot_drive_pace(const void *scene, const double sizes[], rot_pace *pace);
void rot_drive_pace_of_start(const void *scene, rot_pace *pace);

#endif
