/* The models of an axle. */
#ifndef ROT_AXLE_MODELS_H
#define ROT_AXLE_MODELS_H

#include "scene/axle/effects.h"
#include "engine/model.h"

extern const rot_constraint rot_axle_constraint;

#endif
