/* Bounds on the change of the motion if effects of an axle are ignored.
 *
 * A torque of at most D changes omega by at most D/I min(T, I/c) in a time T, and theta by T times
 * that; unstable motions amplify both. */
#ifndef ROT_AXLE_DROP_H
#define ROT_AXLE_DROP_H

#include "scene/axle/scene.h"
#include "engine/model.h"

/* (torque of any course, at most size_n_m, with an integral of at most impulse_n_m_s (INFINITY:
 * unknown)) => bounds of the changes of theta and omega up to the first and last time. propagation:
 * growth factor of a disturbance relative to free motion; NaN: use a bound of it. */
void rot_axle_disturbance(const rot_axle_scene *scene, const rot_query *query, double size_n_m,
                          double impulse_n_m_s, double propagation, double *theta, double *omega);

/* (scene, mask of effects) => scene without them; terms[]: memory for all terms of the scene. */
rot_axle_scene rot_axle_without(const rot_axle_scene *scene, unsigned effects, rot_term terms[]);

/* rot_constraint.drop: bound of the change if effects are ignored. */
void rot_axle_drop(const void *scene, const rot_model *model, rot_axle_model run, unsigned effects,
                   const rot_query *query, double worst, rot_drop *drop);

#endif
