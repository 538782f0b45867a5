/* Scenes of any constraint for the C interface: by names, without a struct of each. */
#ifndef ROT_API_SCENE_H
#define ROT_API_SCENE_H

#include "api/interface.h"

#endif
