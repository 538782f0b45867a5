/* Rows of a fixed axle in closed form: free rotation, and piecewise-linear torque with viscous
 * resistance. Work and heat: scene/axle/ledger.h. */
#ifndef ROT_AXLE_LINEAR_H
#define ROT_AXLE_LINEAR_H

#include "scene/axle/scene.h"

/* Times: finite, not decreasing; before start_s: backward in time. */

/* (parameters, times) => rows without torque and resistance: two operations per row. */
rot_status rot_axle_free(const rot_axle_params *p, size_t n, const double time_s[],
                         const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info);

/* (parameters, times) => rows under piecewise-linear torque and viscous resistance, any c t / I.
 * The errors in *info are bounds: 12 units of roundoff (24 if c < 0) times the sum of the
 * |terms|. */
rot_status rot_axle_linear(const rot_axle_params *p, size_t n, const double time_s[],
                           const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info);

/* The same; evenly spaced rows from a table (scene/axle/grid.h): ten times as fast, with equal
 * bounds (1.9e-15 of the largest value in a damped spin-up of 1000 rows). */
rot_status rot_axle_linear_fast(const rot_axle_params *p, size_t n, const double time_s[],
                                const rot_axle_columns *out, const rot_hooks *hooks,
                                rot_info *info);

/* rot_axle_free() and rot_axle_linear_fast() as models of a scene without other loads. */
rot_axle_run rot_axle_free_scene;
rot_axle_run rot_axle_linear_scene;

#endif
