/* A body on an axle with a spring:
 *
 *   I th'' + c th' + k (th - rest) = knots(t) + sum A_j cos(Omega_j t + phi_j),
 *
 * exact for any damping and any distance from resonance. */
#ifndef ROT_AXLE_OSCILLATOR_H
#define ROT_AXLE_OSCILLATOR_H

#include "scene/axle/scene.h"

/* A model. ROT_EVALUE: loads other than one spring with k > 0, knots and any number of sinusoids,
 * all at all times, and viscous resistance of any sign. ROT_ERANGE, without rows: c^2/(k I) >
 * 1e280. The errors in *info are bounds. */
rot_axle_run rot_axle_oscillator;

#endif
