/* Data shared by even grids and their kernels. */
#ifndef ROT_AXLE_GRID_TABLE_H
#define ROT_AXLE_GRID_TABLE_H

#include <stddef.h>
#include <stdint.h>

#include "scene/axle/axle.h"

enum { ROT_GRID_ROWS = 64, ROT_GRID_MIN = 16 };

/* The scene in a piece: torque = a (end - t) + b (t - start), or b if constant. */
typedef struct rot_axle_law {
  double I, c;
  double lambda; /* c/I */
  double slope;  /* d(torque)/dt over I */
  double a, b, start_s, end_s;
  int two_signs; /* 1: the torque changes its sign in the piece: use rot_axle_step() */
} rot_axle_law;

/* The table: row j of a chunk is at the offset s[j]; once, twice, thrice: integrals of exp(-c
 * s/I). */
typedef struct rot_axle_grid {
  rot_axle_law law;
  double step_s; /* 0: no table yet */
  size_t rows;   /* number of rows of a chunk, even */
  double s[ROT_GRID_ROWS + 1], once[ROT_GRID_ROWS + 1], twice[ROT_GRID_ROWS + 1],
      thrice[ROT_GRID_ROWS + 1];
} rot_axle_grid;

/* Largest deviation of a row from the even grid, as a fraction of a step. E2 and E3 are corrected
 * to first order: the remainder is below 1e-17. Rounded times deviate by at most 1e-12 of a
 * step. */
#define ROT_GRID_UNEVEN 1e-9

/* Start of a step. */
typedef struct rot_axle_departure {
  double torque;
  double acceleration; /* A */
  double bend;         /* g = d(torque)/dt/I - (c/I) A */
} rot_axle_departure;

/* column => number of rows before the first one aligned to a register of `width` doubles. */
static inline size_t rot_axle_grid_unaligned(const double *column, size_t width) {
  return (width - (uintptr_t)column / sizeof *column % width) % width;
}

#endif
