/* The effects and models of a body with a fixed point. */
#ifndef ROT_PIVOT_MODELS_H
#define ROT_PIVOT_MODELS_H

#include "engine/model.h"

/* Its scene is a rot_free_params. */
extern const rot_constraint rot_pivot_constraint;

#endif
