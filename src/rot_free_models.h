/* The effects and models of a free body. */
#ifndef ROT_FREE_MODELS_H
#define ROT_FREE_MODELS_H

#include "rot_model.h"

/* Its scene is a rot_free_params. */
extern const rot_constraint rot_free_constraint;

#endif
