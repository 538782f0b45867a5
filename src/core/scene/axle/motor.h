/* The torque of a motor decreases with the speed like a viscous resistance; the closed forms use
 * the sum of both coefficients. These functions separate them; without a motor they do nothing. */
#ifndef ROT_AXLE_MOTOR_H
#define ROT_AXLE_MOTOR_H

#include "scene/axle/ledger.h"
#include "scene/axle/scene.h"

/* rows with the summed resistance => torque columns, separated. */
void rot_axle_motor_columns(const rot_axle_scene *scene, size_t n, const rot_axle_columns *out);
/* ledger with the summed heat => work and heat, separated. */
void rot_axle_motor_ledger(const rot_axle_scene *scene, rot_axle_ledger *ledger);
/* (scene, times) => *info: adds the rounding of the slope of the motor, and of its sum with the
 * viscous coefficient, to the bounds of a closed form. */
void rot_axle_motor_error(const rot_axle_scene *scene, size_t n, const double time_s[],
                          rot_info *info);

#endif
