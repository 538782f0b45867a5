/* Closed form of a free body: no torque except damping proportional to L. With s = (1 -
 * exp(-damping t))/damping, omega is exp(-damping t) times that of the undamped motion at time s;
 * the attitude is that of the undamped motion at time s. */
#ifndef ROT_FREE_EXACT_H
#define ROT_FREE_EXACT_H

#include "scene/free/free.h"

/* parameters => NULL, or why there is no closed form. */
const char *rot_free_not_exact(const rot_free_params *p);

/* (parameters, times) => rows, events, errors (bounds). Times: not decreasing, also before start_s.
 * Events: flip, if rot_free_flips(): the component of L along the middle axis changes its sign; at
 * most ROT_FREE_MAX_FLIPS, else none. */
rot_status rot_free_exact(const rot_free_params *p, size_t n, const double time_s[],
                          const rot_free_columns *out, rot_events *events, const rot_hooks *hooks,
                          rot_info *info);

/* (parameters, two times) => ROT_FREE_LEDGER between them. */
void rot_free_flows(const rot_free_params *p, double from_s, double to_s,
                    double flow[ROT_FREE_FLOWS]);

typedef enum rot_free_cycle {
  ROT_FREE_STILL,
  ROT_FREE_WOBBLE,    /* omega repeats in the body's axes */
  ROT_FREE_ROTATION,  /* steady spin: a turn */
  ROT_FREE_SEPARATRIX /* tends to a spin about the middle axis: Inf */
} rot_free_cycle;

/* undamped motion without torque and rotors => period in s; NaN: it does not move, or has no closed
 * form. cycle may be NULL. */
double rot_free_period(const rot_free_params *p, rot_free_cycle *cycle);

/* (moments, rates) => time between two flips of the undamped motion; Inf: none. ROT_EVALUE,
 * ROT_ERANGE as rot_free_begin(). */
rot_status rot_free_flip_time(const double moment_kg_m2[3], const double omega_rad_per_s[3],
                              double *time_s);

#endif
