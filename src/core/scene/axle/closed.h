/* Closed forms of an axle, in the order of its models. */
#ifndef ROT_AXLE_CLOSED_H
#define ROT_AXLE_CLOSED_H

#include "scene/axle/scene.h"

enum { ROT_AXLE_MODELS = 13 };

/* Model index => closed form; NULL: an integrator. */
extern const rot_axle_model rot_axle_forms[ROT_AXLE_MODELS];

#endif
