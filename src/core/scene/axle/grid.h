/* Rows of the closed form on an even grid. Each chunk of rows starts from one exact state; weights
 * that depend on the step alone are tabulated, so a row costs a few multiplications instead of an
 * exponential and three polynomials. From chunk to chunk the state is carried to twice the
 * precision: the bounds are about as wide as those of rot_axle_linear(). */
#ifndef ROT_AXLE_GRID_H
#define ROT_AXLE_GRID_H

#include "scene/axle/grid_table.h"

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
