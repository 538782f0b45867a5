/* Bodies as parts of scenes: those of the catalogue, and one given by its tensor. */
#ifndef ROT_BODY_PARTS_H
#define ROT_BODY_PARTS_H

#include "engine/part.h"

extern const rot_part rot_body_parts[];
extern const size_t rot_body_n_parts;

/* Moment of inertia about the axis through a point, in the own axes; NULL: through the axle that
 * the body names. */
double rot_body_moment(const rot_given_body *body, const double axis[3], const double through[3]);

/* Bodies given as numbers, as one body, or as a list of both: how many, and their moments about
 * z through the axle that each names. ROT_EVALUE: there is none, or a moment is not above 0. */
size_t rot_body_count(const rot_given *bodies);
rot_status rot_body_moments(const rot_given given[], size_t input, double inertia_kg_m2[],
                            rot_refusal *refusal);

#define ROT_BODY_KINDS (ROT_INPUT_NUMBER | ROT_INPUT_BODY)

#endif
