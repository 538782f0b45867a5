/* The effects and models of a body on an incline. */
#ifndef ROT_INCLINE_MODELS_H
#define ROT_INCLINE_MODELS_H

#include "engine/model.h"

/* Its scene is a rot_incline_scene. */
extern const rot_constraint rot_incline_constraint;

#endif
