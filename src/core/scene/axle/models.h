/* The models of an axle. */
#ifndef ROT_AXLE_MODELS_H
#define ROT_AXLE_MODELS_H

#include "scene/axle/effects.h"
#include "engine/model.h"
#include "scene/axle/closed.h"

extern const rot_constraint rot_axle_constraint;

/* model => its closed form; NULL: an integrator. */
static inline rot_axle_model rot_axle_form(const rot_model *model) {
  return rot_axle_forms[model - rot_axle_constraint.models];
}

#endif
