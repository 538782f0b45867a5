/* Kernels of scene/axle/grid.c: the table, and the rows of a chunk. Compiled for registers of two
 * lanes there, of four in scene/axle/grid_fill.c. */
#ifndef ROT_AXLE_GRID_FILL_H
#define ROT_AXLE_GRID_FILL_H

#include <stdint.h>

#include "scene/axle/grid_table.h"
#include "ground/pair.h"

/* Taylor coefficients of phi3(-z). */
enum { ROT_GRID_TERMS = 14 };
extern const double rot_axle_grid_series[ROT_GRID_TERMS];

/* steps s => E2, E3 (scene/axle/grid.c), by an even number of terms in two interleaved sums. */
ROT_INLINE rot_pair short_integrals(double lambda, rot_pair s, int terms, rot_pair *e3) {
  const double *series = rot_axle_grid_series;
  const rot_pair z = lambda * s, zz = z * z;
  rot_pair odd = ROT_BOTH(series[terms - 2]), even = ROT_BOTH(series[terms - 1]);
  for (int j = terms - 4; j >= 0; j -= 2) {
    even = even * zz + series[j + 1];
    odd = odd * zz + series[j];
  }
  *e3 = s * s * s * (even * z + odd);
  return 0.5 * s * s - lambda * *e3;
}

/* Offsets s => rows 0 .. rows of the table. */
ROT_INLINE void fill_table(rot_axle_grid *grid, double lambda, int terms) {
  for (size_t j = 0; j <= grid->rows; j += ROT_PAIR) {
    const size_t at = j + ROT_PAIR <= grid->rows + 1 ? j : grid->rows + 1 - ROT_PAIR;
    const rot_pair s = rot_load(grid->s + at);
    rot_pair e3, e2 = short_integrals(lambda, s, terms, &e3);
    rot_store(grid->thrice + at, e3);
    rot_store(grid->twice + at, e2);
    rot_store(grid->once + at, s - lambda * e2);
  }
}

/* Rows from j on, all columns of rot_axle_row(). Returns their deviations from the grid. */
ROT_INLINE rot_pair fill_pair(const rot_axle_grid *grid, const rot_axle_law *k,
                              const rot_axle_state *from, const rot_axle_departure *go, int sloping,
                              size_t j, const double time_s[], const rot_axle_columns *out) {
  const rot_pair t = rot_load(time_s + j), s = t - from->time_s, off = s - rot_load(grid->s + j);
  const rot_pair e2_grid = rot_load(grid->twice + j);
  const rot_pair e2 = e2_grid + off * rot_load(grid->once + j);
  const rot_pair e3 = rot_load(grid->thrice + j) + off * e2_grid;
  const double A = go->acceleration, w0 = from->omega_rad_per_s;
  const rot_pair w = w0 + (A * s + go->bend * e2);
  const rot_pair th = from->theta_rad + (s * (w0 + 0.5 * A * s) + go->bend * e3);
  const rot_pair tau = sloping ? k->a * (k->end_s - t) + k->b * (t - k->start_s) : ROT_BOTH(k->b);
  const rot_pair drag = 0.0 - k->c * w, L = k->I * w;
  rot_store(out->theta_rad + j, th);
  rot_store(out->omega_rad_per_s + j, w);
  rot_store(out->applied_torque_n_m + j, tau);
  rot_store(out->damping_torque_n_m + j, drag);
  rot_store(out->net_torque_n_m + j, tau + drag);
  rot_store(out->angular_momentum_kg_m2_per_s + j, L);
  rot_store(out->rotational_kinetic_energy_j + j, 0.5 * L * w);
  return rot_pair_abs(off);
}

/* Rows 0 .. n-1 of a chunk, n >= ROT_PAIR. Returns 1 if all are on the grid, else 0. A store across
 * two cache lines is slow: the first register may overlap the second, and the last two each other.
 * Local copies of the shared values: the compiler knows that stores do not change them. */
ROT_INLINE int fill_rows(const rot_axle_grid *grid, const rot_axle_state *from,
                         const rot_axle_departure *go, int sloping, size_t n, const double time_s[],
                         const rot_axle_columns *out) {
  const rot_axle_columns to = *out;
  const rot_axle_law law = grid->law;
  const rot_axle_state at = *from;
  const rot_axle_departure leaves = *go;
  rot_pair worst = ROT_BOTH(0.0);
  size_t j = rot_axle_grid_unaligned(to.omega_rad_per_s, ROT_PAIR);
#define FILL(row)                                                                                  \
  worst = rot_pair_max(worst, fill_pair(grid, &law, &at, &leaves, sloping, (row), time_s, &to))
  if (j > 0) FILL(0);
  for (; j + ROT_PAIR <= n; j += ROT_PAIR) FILL(j);
  if (j < n) FILL(n - ROT_PAIR);
#undef FILL
  return rot_pair_count_more(ROT_BOTH(ROT_GRID_UNEVEN * grid->step_s), worst) == ROT_PAIR;
}

ROT_INLINE int fill_chunk(const rot_axle_grid *grid, const rot_axle_state *from,
                          const rot_axle_departure *go, size_t n, const double time_s[],
                          const rot_axle_columns *out) {
  return grid->law.slope != 0.0 ? fill_rows(grid, from, go, 1, n, time_s, out)
                                : fill_rows(grid, from, go, 0, n, time_s, out);
}

/* fill_table() for registers of four lanes. */
void rot_axle_grid_table_simd(rot_axle_grid *grid, double lambda, int terms);
/* fill_chunk() for registers of four lanes; n >= 4. */
int rot_axle_grid_fill_simd(const rot_axle_grid *grid, const rot_axle_state *from,
                            const rot_axle_departure *go, size_t n, const double time_s[],
                            const rot_axle_columns *out);

#endif
