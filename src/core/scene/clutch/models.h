/* The effects and models of two bodies and a clutch. */
#ifndef ROT_CLUTCH_MODELS_H
#define ROT_CLUTCH_MODELS_H

#include "engine/model.h"

/* Its scene is a rot_clutch_params. */
extern const rot_constraint rot_clutch_constraint;

#endif
