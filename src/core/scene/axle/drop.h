/* Bounds on the change of the motion when effects of an axle are ignored.
 *
 * A torque of at most D changes omega by at most D/I min(T, I/c) in a time T, and theta by T times
 * that; more where disturbances grow. */
#ifndef ROT_AXLE_DROP_H
#define ROT_AXLE_DROP_H

#include "scene/axle/scene.h"
#include "engine/model.h"

/* The change due to a torque of at most size_n_m, of any course, whose integral is at most
 * impulse_n_m_s (INFINITY: unknown), up to the first and last of the times. `growth` is the
 * growth of a disturbance relative to free motion; NaN: a bound on it. */
void rot_axle_disturbance(const rot_axle_scene *scene, const rot_query *query, double size_n_m,
                          double impulse_n_m_s, double propagation, double *theta, double *omega);

/* The scene without effects; its terms go to terms[], which has room for all of them. */
rot_axle_scene rot_axle_without(const rot_axle_scene *scene, unsigned effects, rot_term terms[]);

/* rot_constraint.drop of the axle. */
void rot_axle_drop(const void *scene, const rot_model *model, rot_axle_model run, unsigned effects,
                   const rot_query *query, double worst, rot_drop *drop);

#endif
