/* Exact motion of a shaft of rotors: mean motion separately, twists by modes. */
#ifndef ROT_SHAFT_MODAL_H
#define ROT_SHAFT_MODAL_H

#include "scene/shaft/shaft.h"

/* Rows of coupled modes: each from the start, evenly spaced ones by one step that they share, or
 * each from the start without its errors. */
typedef enum rot_shaft_care { ROT_SHAFT_EACH, ROT_SHAFT_EVEN, ROT_SHAFT_SIZES } rot_shaft_care;

/* (shaft, times) => rows, for any stiffness. Without damping, or with c_i = a k_i and d_i = b J_i,
 * each mode has a closed form; otherwise the exponential of the system in energy-scaled modal
 * coordinates. The errors in *info are estimates: rounding times the accumulated phase, plus the
 * residual of the momentum balance. */
rot_status rot_shaft_modal(const rot_shaft_params *p, rot_shaft_care care, size_t n,
                           const double time_s[], const rot_shaft_columns *out,
                           const rot_hooks *hooks, rot_info *info);

/* shaft => n angular frequencies sqrt(eigenvalue) without damping in rad/s, ascending; 0 for the
 * mean motion and for each missing spring. */
rot_status rot_shaft_frequencies(const rot_shaft_params *p, double sigma[], const rot_hooks *hooks);

#endif
