/* A free body in closed form: no torque but damping in proportion to L. With
 * s = (1 - exp(-damping t))/damping, omega is exp(-damping t) times that of the undamped motion at
 * the time s, and the attitude is that of it. */
#ifndef ROT_FREE_EXACT_H
#define ROT_FREE_EXACT_H

#include "scene/free/free.h"

/* NULL, or why there is no closed form. */
const char *rot_free_not_exact(const rot_free_params *p);

/* Times do not decrease, before start_s as well. Events: flip, where rot_free_flips(): the
 * component of L along the middle axis passes zero; at most ROT_FREE_MOST_FLIPS, or none.
 * Errors are bounds. */
rot_status rot_free_exact(const rot_free_params *p, size_t n, const double time_s[],
                          const rot_free_columns *out, rot_events *events, const rot_hooks *hooks,
                          rot_info *info);

/* ROT_FREE_LEDGER from one time to another. */
void rot_free_flows(const rot_free_params *p, double from_s, double to_s,
                    double flow[ROT_FREE_FLOWS]);

/* The time between two flips of the undamped motion: Inf where none follows. ROT_EVALUE, ROT_ERANGE
 * as rot_free_begin(). */
rot_status rot_free_flip_time(const double moment_kg_m2[3], const double omega_rad_per_s[3],
                              double *time_s);

#endif
