/* Closed form of a free body with rotors: no torque, no damping; motors with constant speed or
 * without torque; all momenta of the rotors along one principal axis a of the body (of a ball: any
 * axis). Unequal moments across a: scene/free/gyrostat_motion.h. Equal moments A, with the total L,
 *
 *   omega = L/A - c a,   c = L_a/A - omega_a,   omega_a constant:
 *
 * a rotation about L, fixed in space, by |L|/A, after a rotation about a by -c. Both rates have
 * twice the precision. Reference: Hughes, Spacecraft Attitude Dynamics (1986), section 6.3. */
#ifndef ROT_FREE_GYROSTAT_H
#define ROT_FREE_GYROSTAT_H

#include "scene/free/free.h"

/* parameters => NULL, or why there is no closed form. */
const char *rot_free_not_gyrostat(const rot_free_params *p);

/* (parameters, times) => rows, errors (bounds), no events. Times: not decreasing, also before
 * start_s. */
rot_status rot_free_gyrostat(const rot_free_params *p, size_t n, const double time_s[],
                             const rot_free_columns *out, rot_events *events,
                             const rot_hooks *hooks, rot_info *info);

#endif
