/* Bodies made of others, or of points and vertices, as parts of scenes. */
#ifndef ROT_BODY_COMPOUND_H
#define ROT_BODY_COMPOUND_H

#include "engine/part.h"

extern const rot_part rot_compound_parts[];
extern const size_t rot_compound_n_parts;

/* => 1 if the numbers of the part follow from others, or none depends on them: they do not vary
 * alone. */
int rot_compound_is_derived(const rot_part *part);

#endif
