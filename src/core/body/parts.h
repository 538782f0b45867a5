/* Bodies as parts of scenes: shapes of the catalogue, body given by its inertia tensor. */
#ifndef ROT_BODY_PARTS_H
#define ROT_BODY_PARTS_H

#include "engine/part.h"

extern const rot_part rot_body_parts[];
extern const size_t rot_body_n_parts;

/* (body, axis, point) => moment of inertia, in the body's axes; NULL for the point: the body's axle
 */
double rot_body_moment(const rot_given_body *body, const double axis[3], const double through[3]);

/* numbers, a body, or a list of both => count */
size_t rot_body_count(const rot_given *bodies);
/* The same => moments of inertia about z through each body's axle. ROT_EVALUE if there is none or a
 * moment is not > 0. */
rot_status rot_body_moments(const rot_given given[], size_t input, double inertia_kg_m2[],
                            rot_refusal *refusal);

#define ROT_BODY_KINDS (ROT_INPUT_NUMBER | ROT_INPUT_BODY)

#endif
