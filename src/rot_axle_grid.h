/* Rows of the closed form on an even grid. Each chunk of rows starts from one exact state; weights
 * that depend on the step alone are tabulated, so a row costs a few multiplications instead of an
 * exponential and three polynomials. From chunk to chunk the state is carried to twice the
 * precision: the bounds are about as wide as those of rot_axle_linear(). */
#ifndef ROT_AXLE_GRID_H
#define ROT_AXLE_GRID_H

#include <stddef.h>
#include <stdint.h>

#include "rot_axle.h"

enum { ROT_GRID_ROWS = 64, ROT_GRID_LEAST = 16 };

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

/* Taylor's coefficients of phi3(-z). */
enum { ROT_GRID_TERMS = 14 };
extern const double rot_axle_grid_series[ROT_GRID_TERMS];

/* How many rows lie before the first whose register of so many doubles is aligned. */
static inline size_t rot_axle_grid_unaligned(const double *column, size_t width) {
  return (width - (uintptr_t)column / sizeof *column % width) % width;
}

/* Begin with no table; it is kept from call to call, so one scene to a grid. Then enter a piece. */
void rot_axle_grid_begin(rot_axle_grid *grid);
void rot_axle_grid_enter(rot_axle_grid *grid, const rot_axle_params *p,
                         const rot_torque_piece *piece);

/* The first rows of those given, all inside the piece entered and not before the base, numbers well
 * scaled and viscous_n_m_s >= 0: how many of them were done; 0 if they are not even. The base moves
 * to a row done, some chunk's first. info takes sizes and bounds. */
size_t rot_axle_grid_rows(rot_axle_grid *grid, const rot_axle_params *p, rot_axle_state *base,
                          const rot_torque_piece *piece, size_t n, const double time_s[],
                          const rot_axle_columns *out, rot_info *info);

/* The state at a time in, or at the end of, the piece entered, not before the base. Far
 * faster than rot_axle_step() where c s/I is small, and the same elsewhere. */
rot_axle_state rot_axle_grid_step(const rot_axle_grid *grid, const rot_axle_params *p,
                                  const rot_axle_state *from, const rot_torque_piece *piece,
                                  double time_s);

#endif
