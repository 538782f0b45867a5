/* Approximations of the heavy symmetric top, with error bounds.
 *
 *   precession   gyroscope: theta is constant, phi' = G/(I3 w3) (torque over spin angular momentum)
 *   nutation     small nutation: equation of motion of u = cos(theta) linearised at u(0), phi and
 *                psi to first order
 *
 * Euler angles z-x-z. The bounds use the exact limits of u, period and mean rates
 * (scene/pivot/top_motion.h). They grow with time; near the poles there is none. */
#ifndef ROT_PIVOT_APPROX_H
#define ROT_PIVOT_APPROX_H

#include "scene/free/free.h"

/* parameters => NULL, or why the approximations do not apply. */
const char *rot_pivot_not_spinning(const rot_free_params *p);

/* (parameters, t) => bound of the relative errors of all measures up to |t| seconds from the start;
 * Inf: none. */
double rot_pivot_precession_bound(const rot_free_params *p, double t);
/* The same of small nutation. */
double rot_pivot_nutation_bound(const rot_free_params *p, double t);

/* (parameters, times) => rows as rot_free_exact(), without events. */
rot_status rot_pivot_precession(const rot_free_params *p, size_t n, const double time_s[],
                                const rot_free_columns *out, rot_events *events,
                                const rot_hooks *hooks, rot_info *info);
/* The same of small nutation. */
rot_status rot_pivot_small_nutation(const rot_free_params *p, size_t n, const double time_s[],
                                    const rot_free_columns *out, rot_events *events,
                                    const rot_hooks *hooks, rot_info *info);

#endif
