/* The effects and models of rotors on a shaft. */
#ifndef ROT_SHAFT_MODELS_H
#define ROT_SHAFT_MODELS_H

#include "engine/model.h"

/* Its scene is a rot_shaft_params. */
extern const rot_constraint rot_shaft_constraint;

#endif
