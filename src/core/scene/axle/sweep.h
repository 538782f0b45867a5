/* Many axles under one torque law, a row each: its final state, and its extreme speeds.
 * Rows depend neither on each other nor on the number of threads. */
#ifndef ROT_AXLE_SWEEP_H
#define ROT_AXLE_SWEEP_H

#include <stddef.h>

#include "scene/axle/axle.h"
#include "scene/axle/scene.h"
#include "ground/column.h"

typedef struct rot_axle_sweep_rows {
  size_t n;
  double start_s; /* of all */
  rot_column inertia_kg_m2, viscous_n_m_s, torque_scale, omega0_rad_per_s, theta0_rad;
  rot_column time_s; /* where a row ends, not before start_s */
} rot_axle_sweep_rows;

/* Resistance that rot_axle_linear() does not take. */
typedef struct rot_axle_sweep_friction {
  rot_column quadratic_n_m_s2, coulomb_n_m, static_n_m;
} rot_axle_sweep_friction;

/* NaN in a row whose status is not ROT_OK. The largest and the smallest omega are those of the
 * continuous motion, with the first time of the largest; error: the larger bound of theta and
 * omega, each relative to its largest value. */
#define ROT_AXLE_SWEEP_COLUMNS(X)                                                                  \
  X(double, theta_rad)                                                                             \
  X(double, omega_rad_per_s)                                                                       \
  X(double, omega_max)                                                                             \
  X(double, omega_max_time_s)                                                                      \
  X(double, omega_min)                                                                             \
  X(double, speed_max)                                                                             \
  X(double, error)

typedef struct rot_axle_sweep_columns {
#define X(type, name) type *name;
  ROT_AXLE_SWEEP_COLUMNS(X)
#undef X
  int *status; /* rot_status */
} rot_axle_sweep_columns;

/* Knots and viscous resistance, in closed form. At most `threads` threads; 0: all.
 * The status is ROT_OK even if single rows fail; info->rows_done counts rows that are done,
 * and *info has no measures. */
rot_status rot_axle_sweep_linear(const rot_torque *torque, const rot_axle_sweep_rows *rows,
                                 int threads, const rot_axle_sweep_columns *out,
                                 const rot_hooks *hooks, rot_info *info);

/* Any scene, by a model of it; the rows' numbers replace the scene's, the scale that of its knots
 * (ROT_EVALUE in a row where there are other terms and it is not 1). The largest and
 * smallest omega and the largest speed are the model's where the caller knows those to be the true
 * ones, else NaN; the time of the largest is NaN. */
rot_status rot_axle_sweep_scenes(rot_axle_model model, const rot_axle_scene *scene,
                                 const rot_axle_sweep_rows *rows,
                                 const rot_axle_sweep_friction *friction, int true_maximum,
                                 int threads, const rot_axle_sweep_columns *out,
                                 const rot_hooks *hooks, rot_info *info);

#endif
