/* All parts of scenes that have a constructor. */
#ifndef ROT_PARTS_H
#define ROT_PARTS_H

#include "engine/part.h"

/* i => part, from 0; NULL after the last. */
const rot_part *rot_part_at(size_t i);
/* name of a constructor => part; NULL: no part has this name. */
const rot_part *rot_part_named(const char *constructor);

#endif
