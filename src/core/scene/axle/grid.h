/* Rows of the closed form on an even grid. Each chunk of rows starts from one exact state; weights
 * that depend only on the step are tabulated: a row costs a few multiplications instead of an
 * exponential and three polynomials. The state is carried from chunk to chunk in twice the
 * precision: the bounds are about as wide as those of rot_axle_linear(). */
#ifndef ROT_AXLE_GRID_H
#define ROT_AXLE_GRID_H

#include "scene/axle/grid_table.h"

/* Empty grid, without a table. The table is kept between calls: one grid per scene. */
void rot_axle_grid_begin(rot_axle_grid *grid);
/* piece => constants of the grid; call before rows and steps in the piece. */
void rot_axle_grid_enter(rot_axle_grid *grid, const rot_axle_params *p,
                         const rot_torque_piece *piece);

/* (base, times in the piece entered, not before the base) => rows; returns the number of rows done,
 * from the first on; 0: the times are not even. Requires well-scaled numbers and viscous_n_m_s >=
 * 0. The base moves to the first row of a chunk. *info: sizes and bounds. */
size_t rot_axle_grid_rows(rot_axle_grid *grid, const rot_axle_params *p, rot_axle_state *base,
                          const rot_torque_piece *piece, size_t n, const double time_s[],
                          const rot_axle_columns *out, rot_info *info);

/* (state, time in the piece entered or its end, not before the base) => state at the time, as
 * rot_axle_step(); much faster if c s/I is small. */
rot_axle_state rot_axle_grid_step(const rot_axle_grid *grid, const rot_axle_params *p,
                                  const rot_axle_state *from, const rot_torque_piece *piece,
                                  double time_s);

#endif
