/* The effects and models of a drive. */
#ifndef ROT_DRIVE_MODELS_H
#define ROT_DRIVE_MODELS_H

#include "engine/model.h"

/* Its scene is a rot_drive_scene. */
extern const rot_constraint rot_drive_constraint;

#endif
