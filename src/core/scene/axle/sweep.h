/* A table of axles under one torque law, one per row: final state, extreme speeds. Rows are
 * independent of each other and of the number of threads. */
#ifndef ROT_AXLE_SWEEP_H
#define ROT_AXLE_SWEEP_H

#include <stddef.h>

#include "scene/axle/axle.h"
#include "scene/axle/scene.h"
#include "ground/column.h"

typedef struct rot_axle_sweep_rows {
  size_t n;
  double start_s; /* of all rows */
  rot_column inertia_kg_m2;
  rot_column viscous_n_m_s;
  rot_column torque_scale; /* factor on the torque law */
  rot_column omega0_rad_per_s, theta0_rad;
  rot_column time_s; /* final time, >= start_s */
} rot_axle_sweep_rows;

/* Resistance that rot_axle_linear() does not include. */
typedef struct rot_axle_sweep_friction {
  rot_column quadratic_n_m_s2, coulomb_n_m, static_n_m;
} rot_axle_sweep_friction;

/* A row whose status is not ROT_OK is NaN. omega_max and omega_min: of the continuous motion;
 * omega_max_time_s: first time of the maximum; error: the larger bound of theta and omega, each
 * relative to its largest value. */
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

/* (torque knots, rows) => columns, in closed form with viscous resistance. threads: at most that
 * many; 0: all. Returns ROT_OK even if rows fail. info->rows_done counts completed rows; *info has
 * no measures. */
rot_status rot_axle_sweep_linear(const rot_torque *torque, const rot_axle_sweep_rows *rows,
                                 int threads, const rot_axle_sweep_columns *out,
                                 const rot_hooks *hooks, rot_info *info);

/* (model, scene, rows) => columns. The numbers of a row replace those of the scene; torque_scale
 * multiplies its knots (ROT_EVALUE in a row with other terms and a scale other than 1). Extreme
 * speeds: those of the model if the caller knows that they are true (true_maximum), else NaN;
 * omega_max_time_s: NaN. */
rot_status rot_axle_sweep_scenes(rot_axle_model model, const rot_axle_scene *scene,
                                 const rot_axle_sweep_rows *rows,
                                 const rot_axle_sweep_friction *friction, int true_maximum,
                                 int threads, const rot_axle_sweep_columns *out,
                                 const rot_hooks *hooks, rot_info *info);

#endif
