/* The constructors of torque laws. */
#ifndef ROT_LAWS_H
#define ROT_LAWS_H

#include "engine/loads.h"

extern const rot_part rot_law_parts[];
extern const size_t rot_law_n_parts;

/* The torque of a weight that hangs from an axle, as torque_gravity() makes it. ROT_EVALUE: it is
 * beyond double precision. */
rot_status rot_law_gravity(double mass_kg, double distance_m, double gravity_m_per_s2,
                           double rest_rad, rot_store *store, rot_law_sum *to);

/* A torque over the angular velocity, as torque_curve() makes it: n >= 2 points, increasing. */
rot_status rot_law_curve(size_t n, const double omega_rad_per_s[], const double torque_n_m[],
                         rot_store *store, rot_law_sum *to);

/* Inputs from when on and until when something acts: LIMITs that may be infinite. */
#define ROT_WINDOW_INPUTS(from)                                                                    \
  {"from_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, INFINITY, 0, from, "it acts from then on", NULL}, \
  {                                                                                                \
    "to_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, INFINITY, 0, INFINITY, "and before", NULL          \
  }

/* Of an input `from` of a table and the one behind it. */
rot_status rot_law_window(const rot_input inputs[], const rot_given given[], size_t from,
                          double window[2], rot_refusal *refusal);

#endif
