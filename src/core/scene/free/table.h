/* Many free bodies, a row each: where they are at a time. */
#ifndef ROT_FREE_TABLE_H
#define ROT_FREE_TABLE_H

#include "ground/column.h"
#include "scene/free/free.h"

typedef struct rot_free_table_rows {
  size_t n;
  rot_column moment_kg_m2[3], omega_rad_per_s[3]; /* principal axes, which are the body's own */
  rot_column q[4];                                /* attitude at the start, of any length */
  rot_column time_s;                              /* since the start */
} rot_free_table_rows;

#define ROT_FREE_TABLE_COLUMNS(X)                                                                  \
  X(double, final_qw)                                                                              \
  X(double, final_qx)                                                                              \
  X(double, final_qy)                                                                              \
  X(double, final_qz)                                                                              \
  X(double, final_omega_x_rad_per_s)                                                               \
  X(double, final_omega_y_rad_per_s)                                                               \
  X(double, final_omega_z_rad_per_s)                                                               \
  X(double, error) /* of the attitude, a bound on its angle */

typedef struct rot_free_table_columns {
#define X(type, name) type *name;
  ROT_FREE_TABLE_COLUMNS(X)
#undef X
} rot_free_table_columns;

/* At most `threads` threads (ground/parallel.h). A row without a motion (scene/free/motion.h), or
 * with NaN, has NaN. */
rot_status rot_free_table(const rot_free_table_rows *rows, int threads,
                          const rot_free_table_columns *out, const rot_hooks *hooks,
                          rot_info *info);

#endif
