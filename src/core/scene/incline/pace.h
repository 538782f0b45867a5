/* How fast the motion of a body on an incline goes. */
#ifndef ROT_INCLINE_PACE_H
#define ROT_INCLINE_PACE_H

#include "engine/model.h"

/* rot_constraint.pace of sizes by measure; and of those at the start. */
void rot_incline_pace(const void *scene, const double sizes[], rot_pace *pace);
void rot_incline_pace_of_start(const void *scene, rot_pace *pace);

#endif
