/* The closed forms of an axle by the names of their models. */
#ifndef ROT_AXLE_CLOSED_H
#define ROT_AXLE_CLOSED_H

#include "scene/axle/scene.h"

/* NULL for another name, or an integrator. */
rot_axle_model rot_axle_closed_form(const char *id);

#endif
