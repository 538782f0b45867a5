/* What the rows of an even grid and their kernels share. */
#ifndef ROT_AXLE_GRID_TABLE_H
#define ROT_AXLE_GRID_TABLE_H

#include <stddef.h>
#include <stdint.h>

#include "scene/axle/axle.h"

enum { ROT_GRID_ROWS = 64, ROT_GRID_MIN = 16 };

/* The scene within a piece: torque = a (end - t) + b (t - start), or b where it is constant. */
typedef struct rot_axle_law {
  double I, c, lambda, slope, a, b, start_s, end_s; /* lambda = c/I, slope over I */
  int two_signs; /* the torque changes sign in the piece: use rot_axle_step() */
} rot_axle_law;

/* The table: row j of a chunk lies at the offset s[j]; integrals 1, 2 and 3 of exp(-c s/I). */
typedef struct rot_axle_grid {
  rot_axle_law law;
  double step_s; /* 0: the table is not made yet */
  size_t rows;   /* of a chunk, even */
  double s[ROT_GRID_ROWS + 1], once[ROT_GRID_ROWS + 1], twice[ROT_GRID_ROWS + 1],
      thrice[ROT_GRID_ROWS + 1];
} rot_axle_grid;

/* A row may be off the even grid by so much of a step. E2 and E3 are carried over to first order,
 * and what that leaves is below 1e-17. Rounded times are off by 1e-12 of a step or less. */
#define ROT_GRID_UNEVEN 1e-9

/* How a step leaves a state: torque, acceleration A and g = d(torque)/dt/I - (c/I) A. */
typedef struct rot_axle_departure {
  double torque, acceleration, bend;
} rot_axle_departure;

/* How many rows lie before the first whose register of so many doubles is aligned. */
static inline size_t rot_axle_grid_unaligned(const double *column, size_t width) {
  return (width - (uintptr_t)column / sizeof *column % width) % width;
}

#endif
