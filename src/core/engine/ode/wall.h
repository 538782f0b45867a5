/* Walls: values of one component of the state, or times, where the right-hand side jumps or kinks,
 * found in a run, known from then on. On either side of a wall the right-hand side is evaluated
 * with the component kept on that side, so that a step sees no jump; the step that passes it ends
 * on it. Where the slopes of both sides point to the wall the motion slides along it (Filippov,
 * Differential Equations with Discontinuous Righthand Sides, 1988): sign(omega) is dry friction. */
#ifndef ROT_ODE_WALL_H
#define ROT_ODE_WALL_H

#include "engine/ode/law.h"

/* Adds a wall that is not there yet; whether it did. `below` and `above`: values on its two
 * sides, equal at a kink. component = dim: time. `size`: of a step, in time. */
int rot_ode_add_wall(rot_ode_walls *walls, size_t component, double below, double above,
                      double size);

/* The side of a wall, or of all, where a run sets out or a wall was added. */
rot_status rot_ode_choose_side(rot_ode_law *law, rot_ode_state *state, size_t wall);
rot_status rot_ode_choose_sides(rot_ode_law *law, rot_ode_state *state);

/* The state lies on the wall: the side that the motion goes on, or that it slides. */
rot_status rot_ode_pass_wall(rot_ode_law *law, rot_ode_state *state, size_t wall);

/* The first time wall before `stop`, or stop. */
double rot_ode_next_stop(const rot_ode_law *law, double stop);
/* Whether it is time for a time wall that is still ahead; and past it. */
int rot_ode_at_time_wall(const rot_ode_law *law);
void rot_ode_pass_time(rot_ode_law *law, rot_ode_state *state);

#endif
