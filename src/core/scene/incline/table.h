/* Many inclines, a row each: the state at the end, heat, and when rolling began. Rows depend
 * neither on each other nor on the number of threads. */
#ifndef ROT_INCLINE_TABLE_H
#define ROT_INCLINE_TABLE_H

#include "ground/column.h"
#include "ground/status.h"

typedef struct rot_incline_rows {
  size_t n;
  rot_column beta, radius_m, mass_kg; /* > 0 */
  rot_column angle_deg, gravity_m_per_s2, mu_static, mu_kinetic, arm_m;
  rot_column v0_m_per_s, omega0_rad_per_s; /* omega NaN: it starts rolling */
  rot_column time_s;                       /* since the start */
} rot_incline_rows;

/* roll_time_s: when slip first ended, `none` where it did not; error: the largest bound of x, v,
 * theta and omega, each relative to its largest value at the start, the events and the end. */
#define ROT_INCLINE_TABLE_COLUMNS(X)                                                               \
  X(double, final_x_m)                                                                             \
  X(double, final_v_m_per_s)                                                                       \
  X(double, final_theta_rad)                                                                       \
  X(double, final_omega_rad_per_s)                                                                 \
  X(double, slip_heat_j)                                                                           \
  X(double, rolling_heat_j)                                                                        \
  X(double, roll_time_s)                                                                           \
  X(int, rolling)                                                                                  \
  X(double, error)

typedef struct rot_incline_table_columns {
#define X(type, name) type *name;
  ROT_INCLINE_TABLE_COLUMNS(X)
#undef X
  int *status; /* rot_status: not a number in a row where it is not ROT_OK */
  double none; /* the caller's NaN */
} rot_incline_table_columns;

/* Paths begin at 0. At most `threads` threads; 0: all. The status is ROT_OK even if single rows
 * fail; info->rows_done counts rows that are done, and *info has no measures. */
rot_status rot_incline_table(const rot_incline_rows *rows, int threads,
                             const rot_incline_table_columns *out, const rot_hooks *hooks,
                             rot_info *info);

#endif
