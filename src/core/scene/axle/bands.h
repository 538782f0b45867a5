/* Fixed axle, torque piecewise linear in time, plus one curve piecewise linear in omega:
 *
 *   I omega' = tau(t) + curve(omega) - c omega - tau_c sign(omega).
 *
 * Static contact at rest: |tau + curve(0)| <= tau_s. Between two points of the curve, and between a
 * point and rest, the law is linear: a band. Closed forms in a band (scene/axle/axle.h); the times
 * of leaving it are found by iteration. */
#ifndef ROT_AXLE_BANDS_H
#define ROT_AXLE_BANDS_H

#include "scene/axle/scene.h"

/* A model (scene/axle/scene.h). ROT_EVALUE: quadratic resistance, changing inertia, terms other
 * than one curve that acts at all times, or times before the start. */
rot_axle_run rot_axle_bands;

#endif
