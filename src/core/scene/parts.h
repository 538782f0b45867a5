/* Every part of a scene that is made by the name of its constructor. */
#ifndef ROT_PARTS_H
#define ROT_PARTS_H

#include "engine/part.h"

/* Part i, from 0; NULL after the last. */
const rot_part *rot_part_at(size_t i);
/* NULL: there is none of this name. */
const rot_part *rot_part_named(const char *constructor);

#endif
