/* The kernel for registers of four (rot_wide.h). */
#include "rot_wide.h"

#ifdef ROT_WIDE_CAN
#define ROT_WIDE
#endif

#include "rot_axle_grid_fill.h"

ROT_TARGET void rot_axle_grid_table_wide(rot_axle_grid *grid, double lambda, int terms) {
  fill_table(grid, lambda, terms);
}

ROT_TARGET int rot_axle_grid_fill_wide(const rot_axle_grid *grid, const rot_axle_state *from,
                                       const rot_axle_departure *go, size_t n,
                                       const double time_s[], const rot_axle_columns *out) {
  return fill_chunk(grid, from, go, n, time_s, out);
}
