/* The shaft of rotors, exact: the mean motion separately, the twists in modes. */
#ifndef ROT_SHAFT_MODAL_H
#define ROT_SHAFT_MODAL_H

#include "scene/shaft/shaft.h"

/* Exact for any stiffness. Without damping, or with c_i = a k_i and d_i = b J_i, each mode is a
 * closed form; otherwise the exponential of the system in energy-scaled modal coordinates. `fast`
 * lets even segments of rows share one exponential. The errors in *info are estimates:
 * roundings times the phase turned, and what the balance of momentum is off by. */
rot_status rot_shaft_modal(const rot_shaft_params *p, int fast, size_t n, const double time_s[],
                           const rot_shaft_columns *out, const rot_hooks *hooks, rot_info *info);

/* Angular frequencies sqrt(eigenvalue) of the undamped shaft in rad/s, ascending, n of them: 0 for
 * the mean motion and for each spring that is missing. */
rot_status rot_shaft_frequencies(const rot_shaft_params *p, double sigma[], const rot_hooks *hooks);

#endif
