/* A table of inclines, one per row: final state, heat, time at which rolling begins. Rows are
 * independent of each other and of the number of threads. */
#ifndef ROT_INCLINE_TABLE_H
#define ROT_INCLINE_TABLE_H

#include "ground/column.h"
#include "ground/status.h"

typedef struct rot_incline_rows {
  size_t n;
  rot_column beta;             /* I/(m R^2), > 0 */
  rot_column radius_m;         /* > 0 */
  rot_column mass_kg;          /* > 0 */
  rot_column angle_deg;        /* -90 to 90 */
  rot_column gravity_m_per_s2; /* >= 0 */
  rot_column mu_static;        /* >= mu_kinetic */
  rot_column mu_kinetic;       /* >= 0 */
  rot_column arm_m;            /* >= 0, of the rolling resistance */
  rot_column v0_m_per_s;
  rot_column omega0_rad_per_s; /* NaN: the start rolls */
  rot_column time_s;           /* >= 0, since the start */
} rot_incline_rows;

/* roll_time_s: time at which slip first ended, `none` if it did not. error: largest bound of x, v,
 * theta and omega, each relative to its largest value at start, events and end. */
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
  int *status; /* a rot_status; if not ROT_OK, the row is NaN */
  double none; /* the caller's NaN */
} rot_incline_table_columns;

/* inclines => columns. x and theta start at 0. threads: at most that many; 0: all. Returns ROT_OK
 * even if rows fail. info->rows_done counts completed rows; *info has no measures. */
rot_status rot_incline_table(const rot_incline_rows *rows, int threads,
                             const rot_incline_table_columns *out, const rot_hooks *hooks,
                             rot_info *info);

#endif
