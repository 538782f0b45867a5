/* A planar chain of pendulums from a fixed pivot: n links, uniform rods or point masses on massless
 * rods, with viscous joints (equations: scene/chain/links.h). */
#ifndef ROT_CHAIN_H
#define ROT_CHAIN_H

#include "engine/model.h"

extern const rot_constraint rot_chain_constraint;

/* (links, gravity) => frequencies (ascending) and shapes of the small-amplitude modes. shape[i * n
 * + j]: angle of link i in mode j, scaled to a largest angle of 1. ROT_EVALUE: an argument outside
 * its domain; ROT_ERANGE: a frequency overflows or underflows. */
rot_status rot_chain_modes(const double length[], const double mass[], size_t n, int rods,
                           double gravity, double omega_rad_per_s[], double shape[]);

#endif
