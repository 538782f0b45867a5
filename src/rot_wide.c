#include "rot_wide.h"

/* Not on Windows, where the stack is not aligned for registers of four. */
#if defined(__GNUC__) && defined(__x86_64__) && defined(__SSE2__) && !defined(_WIN32)
#define ROT_WIDE
#endif

#include "rot_axle_grid_fill.h"
#include "rot_mesh_sum.h"
#include "rot_sweep_pass.h"

static int forbidden = 0;

void rot_wide_allow(int allowed) { forbidden = !allowed; }

int rot_wide_ok(void) {
#ifdef ROT_WIDE
  return !forbidden && __builtin_cpu_supports("avx2") != 0;
#else
  return 0;
#endif
}

ROT_TARGET void rot_axle_grid_table_wide(rot_axle_grid *grid, double lambda, int terms) {
  fill_table(grid, lambda, terms);
}

ROT_TARGET int rot_axle_grid_fill_wide(const rot_axle_grid *grid, const rot_axle_state *from,
                                       const rot_axle_departure *go, size_t n,
                                       const double time_s[], const rot_axle_columns *out) {
  return fill_chunk(grid, from, go, n, time_s, out);
}

ROT_TARGET void rot_sweep_pass_wide(rot_sweep_block *block, const rot_torque_piece *piece,
                                    double start_n_m) {
  pass_block(block, piece, start_n_m);
}

ROT_TARGET void rot_mesh_sum_wide(const rot_mesh *mesh, struct rot_mesh_sums *sums, size_t from,
                                  size_t end, int shell) {
  sum_faces(mesh, sums, from, end, shell);
}
