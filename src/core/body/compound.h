/* Bodies made of others, or of points and vertices, as parts of scenes. */
#ifndef ROT_BODY_COMPOUND_H
#define ROT_BODY_COMPOUND_H

#include "engine/part.h"

extern const rot_part rot_compound_parts[];
extern const size_t rot_compound_n_parts;

#endif
