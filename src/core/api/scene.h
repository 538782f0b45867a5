/* Runs of scenes for the C interface. */
#ifndef ROT_API_SCENE_H
#define ROT_API_SCENE_H

#include "api/interface.h"

#endif
