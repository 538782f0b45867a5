/* A body on an axle with a spring:
 *
 *   I th'' + c th' + k (th - rest) = knots(t) + sum A_j cos(Omega_j t + phi_j),
 *
 * exactly, in every regime of damping and at every distance from resonance. */
#ifndef ROT_AXLE_OSCILLATOR_H
#define ROT_AXLE_OSCILLATOR_H

#include "scene/axle/scene.h"

/* One spring with k > 0, knots, any number of sinusoids, all the time; viscous resistance of any
 * sign and nothing else: ROT_EVALUE otherwise. ROT_ERANGE at once where c^2/(k I) is above 1e280.
 * The errors in *info are bounds. */
rot_axle_run rot_axle_oscillator;

#endif
