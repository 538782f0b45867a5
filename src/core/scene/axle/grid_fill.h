/* The kernels of scene/axle/grid.c: its table, and the rows of a chunk. Compiled for registers of
 * two there and for registers of four in scene/axle/grid_fill.c. */
#ifndef ROT_AXLE_GRID_FILL_H
#define ROT_AXLE_GRID_FILL_H

#include <stdint.h>

#include "scene/axle/grid_table.h"
#include "ground/pair.h"

/* Taylor's coefficients of phi3(-z). */
enum { ROT_GRID_TERMS = 14 };
extern const double rot_axle_grid_series[ROT_GRID_TERMS];

/* phi3(-z) to z^13: see scene/axle/grid.c. */
ROT_INLINE rot_pair phi3_pair(rot_pair z, int terms) {
  rot_pair sum = ROT_BOTH(rot_axle_grid_series[terms - 1]);
  for (int j = terms - 2; j >= 0; j--) sum = sum * z + rot_axle_grid_series[j];
  return sum;
}

/* For rows of the table 0 .. rows, once s stands there. */
ROT_INLINE void fill_table(rot_axle_grid *grid, double lambda, int terms) {
  const rot_pair l = ROT_BOTH(lambda), half = ROT_BOTH(0.5);
  for (size_t j = 0; j <= grid->rows; j += ROT_PAIR) {
    const size_t at = j + ROT_PAIR <= grid->rows + 1 ? j : grid->rows + 1 - ROT_PAIR;
    const rot_pair s = rot_load(grid->s + at), ss = s * s;
    const rot_pair e3 = ss * s * phi3_pair(l * s, terms), e2 = half * ss - l * e3;
    rot_store(grid->thrice + at, e3);
    rot_store(grid->twice + at, e2);
    rot_store(grid->once + at, s - l * e2);
  }
}

/* What all rows of a chunk share. The bound covers the base's low parts: two sums of thirty. */
typedef struct chunk {
  rot_pair t0, w0, th0, A, half_A, g, I, c, a, b, start, end;
} chunk;

/* The rows from j on; returns how far off the grid they are. */
ROT_INLINE rot_pair fill_pair(const rot_axle_grid *grid, const chunk *k, int sloping, size_t j,
                              const double time_s[], double theta[], double omega[],
                              double applied[], double damping[], double net[], double momentum[],
                              double energy[]) {
  const rot_pair t = rot_load(time_s + j), s = t - k->t0, off = s - rot_load(grid->s + j);
  const rot_pair e2_grid = rot_load(grid->twice + j);
  const rot_pair e2 = e2_grid + off * rot_load(grid->once + j);
  const rot_pair e3 = rot_load(grid->thrice + j) + off * e2_grid;
  const rot_pair w = k->w0 + (k->A * s + k->g * e2);
  const rot_pair th = k->th0 + (s * (k->w0 + k->half_A * s) + k->g * e3);
  const rot_pair tau = sloping ? k->a * (k->end - t) + k->b * (t - k->start) : k->b;
  const rot_pair drag = 0.0 - k->c * w, L = k->I * w;
  rot_store(theta + j, th);
  rot_store(omega + j, w);
  rot_store(applied + j, tau);
  rot_store(damping + j, drag);
  rot_store(net + j, tau + drag);
  rot_store(momentum + j, L);
  rot_store(energy + j, 0.5 * L * w);
  return rot_pair_abs(off);
}

/* Rows 0 .. n-1 of a chunk, n >= ROT_PAIR; whether all of them lie on the grid. A register
 * that straddles two lines of the cache is slow to store: the first one may overlap the second, and
 * so may the last two. */
ROT_INLINE int fill_rows(const rot_axle_grid *grid, const rot_axle_state *from,
                         const rot_axle_departure *go, int sloping, size_t n, const double time_s[],
                         const rot_axle_columns *out) {
  double *const theta = out->theta_rad, *const omega = out->omega_rad_per_s,
                *const applied = out->applied_torque_n_m, *const damping = out->damping_torque_n_m,
                *const net = out->net_torque_n_m,
                *const momentum = out->angular_momentum_kg_m2_per_s,
                *const energy = out->rotational_kinetic_energy_j;
  const rot_axle_law *of = &grid->law;
  const chunk k = {ROT_BOTH(from->time_s),
                   ROT_BOTH(from->omega_rad_per_s),
                   ROT_BOTH(from->theta_rad),
                   ROT_BOTH(go->acceleration),
                   ROT_BOTH(0.5 * go->acceleration),
                   ROT_BOTH(go->bend),
                   ROT_BOTH(of->I),
                   ROT_BOTH(of->c),
                   ROT_BOTH(of->a),
                   ROT_BOTH(of->b),
                   ROT_BOTH(of->start_s),
                   ROT_BOTH(of->end_s)};
  rot_pair worst = ROT_BOTH(0.0);
  size_t j = rot_axle_grid_unaligned(omega, ROT_PAIR);
#define FILL(at)                                                                                   \
  worst = rot_pair_max(worst, fill_pair(grid, &k, sloping, (at), time_s, theta, omega, applied,    \
                                        damping, net, momentum, energy))
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

/* The same for registers of four; n >= ROT_WIDE_PAIR. */
void rot_axle_grid_table_wide(rot_axle_grid *grid, double lambda, int terms);
int rot_axle_grid_fill_wide(const rot_axle_grid *grid, const rot_axle_state *from,
                            const rot_axle_departure *go, size_t n, const double time_s[],
                            const rot_axle_columns *out);

#endif
