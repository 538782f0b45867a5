/* A body on an axle under gravity only, any amplitude:
 *
 *   I th'' = -G sin(th - rest),   G = m g d of either sign.
 *
 * With phi the angle from the hanging position (rest, or rest + pi for G < 0) and w0 = sqrt(|G|/I),
 * half the angle is an elliptic function of u = w0 t + u0:
 *
 *   oscillation:   sin(phi/2) = k sn u,  cos(phi/2) = dn u,  omega = 2 k w0 cn u,   m = k^2
 *   rotation:      phi/2 = am(k u),      omega = +-2 k w0 dn(k u),                  m = 1/k^2
 *   k^2 = sin^2(phi0/2) + (omega0/(2 w0))^2; separatrix between them: k = 1. */
#ifndef ROT_AXLE_PENDULUM_H
#define ROT_AXLE_PENDULUM_H

#include "scene/axle/scene.h"

/* A model. ROT_EVALUE: loads other than one gravity term with G != 0 at all times. theta includes
 * whole turns. ROT_ERANGE, without rows: |theta0 - rest| > 1e15, or within 1e-130 of the top but
 * not at rest there. The errors in *info are bounds. */
rot_axle_run rot_axle_pendulum;

/* (I, G, state) => period of the oscillation, or of a turn if it rotates; theta from the rest
 * angle. Inf on the separatrix and if balanced; limit of small swings if hanging at rest; NaN
 * without gravity. */
double rot_pendulum_period(double inertia_kg_m2, double gravity_n_m, double theta_rad,
                           double omega_rad_per_s);

/* scene of the model (else ROT_EVALUE) => period, amplitude: pi on the separatrix, NaN if it
 * rotates. ROT_ERANGE: too close to the top to be resolved. */
rot_status rot_axle_pendulum_period(const rot_axle_scene *scene, double *period_s,
                                    double *amplitude_rad);

#endif
