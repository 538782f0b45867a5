/* Kernels for registers of four doubles (AVX2), where processor and compiler support them: the same
 * operations as with two, lane by lane, and so the same bits. */
#ifndef ROT_WIDE_H
#define ROT_WIDE_H

#include "rot_axle_grid.h"
#include "rot_mesh.h"
#include "rot_sweep_block.h"

enum { ROT_WIDE_PAIR = 4 };

/* Whether the routines below may be called. */
int rot_wide_ok(void);
/* For tests: 0 forbids them, 1 allows them where they can run. */
void rot_wide_allow(int allowed);

void rot_axle_grid_table_wide(rot_axle_grid *grid, double lambda, int terms);
/* n >= ROT_WIDE_PAIR */
int rot_axle_grid_fill_wide(const rot_axle_grid *grid, const rot_axle_state *from,
                            const rot_axle_departure *go, size_t n, const double time_s[],
                            const rot_axle_columns *out);
struct rot_mesh_sums;
void rot_mesh_sum_wide(const rot_mesh *mesh, struct rot_mesh_sums *sums, size_t from, size_t end,
                       int shell);
void rot_sweep_pass_wide(rot_sweep_block *block, const rot_torque_piece *piece, double start_n_m);

#endif
