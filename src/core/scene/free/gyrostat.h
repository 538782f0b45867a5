/* A free body with rotors, in closed form: no torque, no damping, motors that keep a constant speed
 * or do nothing, and one principal axis a of the body along which all momenta of the rotors are (of
 * a ball any axis). Where the moments across it differ: scene/free/gyrostat_motion.h. Where they
 * are equal, both A, with L of all,
 *
 *   omega = L/A - c a,   c = L_a/A - omega_a,   omega_a constant:
 *
 * a turn about L, which is fixed in space, by |L|/A, after one about a by -c. Both rates are known
 * to twice the precision. Reference: Hughes, Spacecraft Attitude Dynamics (1986), section 6.3. */
#ifndef ROT_FREE_GYROSTAT_H
#define ROT_FREE_GYROSTAT_H

#include "scene/free/free.h"

/* NULL, or why there is no closed form. */
const char *rot_free_not_gyrostat(const rot_free_params *p);

/* Times do not decrease, before start_s as well. Errors are bounds. No events. */
rot_status rot_free_gyrostat(const rot_free_params *p, size_t n, const double time_s[],
                             const rot_free_columns *out, rot_events *events,
                             const rot_hooks *hooks, rot_info *info);

#endif
