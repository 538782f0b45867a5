/* Rows of the closed form on an even grid, by doubling: rows h .. 2h-1 follow from rows 0 .. h-1 by
 * one step of length h d, the same for all. A row is at most eight steps from an exact one, and
 * costs a few multiplications instead of an exponential and three polynomials. */
#ifndef ROT_AXLE_GRID_H
#define ROT_AXLE_GRID_H

#include <stddef.h>

#include "rot_axle.h"

enum { ROT_GRID_ROWS = 256, ROT_GRID_LEAST = 16 };

/* The first rows of those given, all inside the piece and after the base, numbers tame and
 * viscous_n_m_s >= 0: how many of them, at most ROT_GRID_ROWS, were done; 0 if they are not even.
 * info takes their sizes and bounds. */
size_t rot_axle_grid_rows(const rot_axle_params *p, const rot_axle_state *base,
                          const rot_torque_piece *piece, size_t n, const double time_s[],
                          const rot_axle_columns *out, rot_info *info);

#endif
