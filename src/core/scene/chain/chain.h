/* A planar chain of pendulums from a fixed pivot: n links, uniform rods or point masses on massless
 * rods, with viscous joints (equations: scene/chain/links.h). */
#ifndef ROT_CHAIN_H
#define ROT_CHAIN_H

#include "engine/model.h"

extern const rot_constraint rot_chain_constraint;

/* Frequencies (ascending) and shapes of the small-amplitude modes of n links: shape[i * n + j] is
 * the angle of link i in mode j, the largest of a mode 1. ROT_EVALUE: a value outside its domain;
 * ROT_ERANGE: a frequency leaves the doubles. */
rot_status rot_chain_modes(const double length[], const double mass[], size_t n, int rods,
                           double gravity, double omega_rad_per_s[], double shape[]);

#endif
