/* A motor's torque that falls with the speed resists like a viscous coefficient, and the closed
 * forms take both as one. These functions separate them; without a motor they change nothing. */
#ifndef ROT_AXLE_MOTOR_H
#define ROT_AXLE_MOTOR_H

#include "scene/axle/ledger.h"
#include "scene/axle/scene.h"

/* Torque columns of rows in which the resistance holds both. */
void rot_axle_motor_columns(const rot_axle_scene *scene, size_t n, const rot_axle_columns *out);
/* A ledger in which the heat holds both. */
void rot_axle_motor_ledger(const rot_axle_scene *scene, rot_axle_ledger *ledger);
/* Adds the rounding of the slope, and of its sum with the viscous coefficient, to the bounds of a
 * closed form. */
void rot_axle_motor_error(const rot_axle_scene *scene, size_t n, const double time_s[],
                          rot_info *info);

#endif
