/* A body on an axle under gravity alone, at any amplitude:
 *
 *   I th'' = -G sin(th - rest),   G = m g d of either sign.
 *
 * With phi the angle from where it hangs (rest, or rest + pi for G < 0) and w0 = sqrt(|G|/I), half
 * the angle is an elliptic function of u = w0 t + u0:
 *
 *   oscillation:   sin(phi/2) = k sn u,  cos(phi/2) = dn u,  omega = 2 k w0 cn u,   m = k^2
 *   rotation:      phi/2 = am(k u),      omega = +-2 k w0 dn(k u),                  m = 1/k^2
 *   k^2 = sin^2(phi0/2) + (omega0/(2 w0))^2, and on the separatrix between them k = 1. */
#ifndef ROT_AXLE_PENDULUM_H
#define ROT_AXLE_PENDULUM_H

#include "scene/axle/scene.h"

/* One gravity term with G != 0, all the time, and nothing else: ROT_EVALUE otherwise. theta counts
 * whole turns. ROT_ERANGE at once where |theta0 - rest| is above 1e15, or within 1e-130 of the top
 * but not at rest there. The errors in *info are bounds. */
rot_axle_run rot_axle_pendulum;

/* Period of the oscillation, or of a whole turn where it rotates, from any state of the motion;
 * theta counts from the rest angle. Inf on the separatrix and where it is balanced, the time of a
 * small swing where it hangs still; NaN where gravity is 0. */
double rot_pendulum_period(double inertia_kg_m2, double gravity_n_m, double theta_rad,
                           double omega_rad_per_s);

/* The same of a scene that the model takes (else ROT_EVALUE), and its amplitude: pi on the
 * separatrix, NaN where it rotates. ROT_ERANGE too near the top to be resolved. */
rot_status rot_axle_pendulum_period(const rot_axle_scene *scene, double *period_s,
                                    double *amplitude_rad);

#endif
