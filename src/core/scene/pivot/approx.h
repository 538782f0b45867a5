/* Approximations of the heavy symmetric top, with bounds on what they leave out.
 *
 *   precession   the gyroscope: the axis keeps its angle and goes round at G/(I3 w3), torque over
 *                the angular momentum of the spin
 *   nutation     and small nutation: u = cos(theta) swings as the equation linear in u - u(0) says,
 *                phi and psi follow to first order
 *
 * The angles are those of z-x-z. Bounds use the exact motion's limits of u, its period and its mean
 * rates (scene/pivot/top_motion.h). They grow with time; near the poles there is none. */
#ifndef ROT_PIVOT_APPROX_H
#define ROT_PIVOT_APPROX_H

#include "scene/free/free.h"

/* NULL, or why they do not apply. */
const char *rot_pivot_not_spinning(const rot_free_params *p);

/* Bound on the relative error, the worst of the measures, until |t| seconds from the start. Inf
 * where there is none. */
double rot_pivot_precession_bound(const rot_free_params *p, double t);
double rot_pivot_nutation_bound(const rot_free_params *p, double t);

/* Rows as rot_free_exact() writes them, without events. */
rot_status rot_pivot_precession(const rot_free_params *p, size_t n, const double time_s[],
                                const rot_free_columns *out, rot_events *events,
                                const rot_hooks *hooks, rot_info *info);
rot_status rot_pivot_small_nutation(const rot_free_params *p, size_t n, const double time_s[],
                                    const rot_free_columns *out, rot_events *events,
                                    const rot_hooks *hooks, rot_info *info);

#endif
