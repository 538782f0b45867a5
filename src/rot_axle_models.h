/* The models of an axle. */
#ifndef ROT_AXLE_MODELS_H
#define ROT_AXLE_MODELS_H

#include "rot_axle_effects.h"
#include "rot_model.h"

extern const rot_constraint rot_axle_constraint;

/* The closed form of that name in the list of models; NULL for another, or an integrator. */
rot_axle_model rot_axle_closed_form(const char *id);

#endif
