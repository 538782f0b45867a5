/* A table of free bodies, one per row: state at a given time. */
#ifndef ROT_FREE_TABLE_H
#define ROT_FREE_TABLE_H

#include "ground/column.h"
#include "scene/free/free.h"

typedef struct rot_free_table_rows {
  size_t n;
  rot_column moment_kg_m2[3];    /* principal, >= 0 */
  rot_column omega_rad_per_s[3]; /* principal axes, equal to the own axes */
  rot_column q[4];               /* attitude at the start, any length > 0 */
  rot_column time_s;             /* since the start */
} rot_free_table_rows;

#define ROT_FREE_TABLE_COLUMNS(X)                                                                  \
  X(double, final_qw)                                                                              \
  X(double, final_qx)                                                                              \
  X(double, final_qy)                                                                              \
  X(double, final_qz)                                                                              \
  X(double, final_omega_x_rad_per_s)                                                               \
  X(double, final_omega_y_rad_per_s)                                                               \
  X(double, final_omega_z_rad_per_s)                                                               \
  X(double, error) /* bound on the angle of the error of the attitude */

typedef struct rot_free_table_columns {
#define X(type, name) type *name;
  ROT_FREE_TABLE_COLUMNS(X)
#undef X
  double *omega_error; /* bound on the length of the error of the rates, rad/s; NULL: not wanted */
} rot_free_table_columns;

/* bodies => columns. threads: at most that many (ground/parallel.h). A row without a motion
 * (scene/free/motion.h) or with a NaN is NaN. */
rot_status rot_free_table(const rot_free_table_rows *rows, int threads,
                          const rot_free_table_columns *out, const rot_hooks *hooks,
                          rot_info *info);

#endif
