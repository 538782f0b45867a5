/* The kernel for registers of four lanes (ground/simd.h). */
#include "ground/simd.h"

#ifdef ROT_SIMD_CAN
#define ROT_SIMD
#endif

#include "scene/axle/grid_fill.h"

/* phi3(-z), 0 <= z <= 1/2: truncation error below 2^-54 of the first term. */
const double rot_axle_grid_series[ROT_GRID_TERMS] = {1 / 6.0,
                                                     -1 / 24.0,
                                                     1 / 120.0,
                                                     -1 / 720.0,
                                                     1 / 5040.0,
                                                     -1 / 40320.0,
                                                     1 / 362880.0,
                                                     -1 / 3628800.0,
                                                     1 / 39916800.0,
                                                     -1 / 479001600.0,
                                                     1 / 6227020800.0,
                                                     -1 / 87178291200.0,
                                                     1 / 1307674368000.0,
                                                     -1 / 20922789888000.0};

ROT_TARGET void rot_axle_grid_table_simd(rot_axle_grid *grid, double lambda, int terms) {
  fill_table(grid, lambda, terms);
}

ROT_TARGET int rot_axle_grid_fill_simd(const rot_axle_grid *grid, const rot_axle_state *from,
                                       const rot_axle_departure *go, size_t n,
                                       const double time_s[], const rot_axle_columns *out) {
  return fill_chunk(grid, from, go, n, time_s, out);
}
