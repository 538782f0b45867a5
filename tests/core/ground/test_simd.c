/* Registers of four against registers of two: the same bits, wherever columns lie in memory. */
#include "ground/simd.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/axle/linear.h"
#include "ground/pair.h"
#include "ground/real.h"
#include "scene/axle/sweep.h"
#include "rot_test.h"

enum { N = 700, COLUMNS = 7 };

static const double knots_s[] = {0.0, 1.0, 4.0, 6.0, 8.0};
static const double knots_n_m[] = {0.0, 0.8, 0.8, 0.0, 0.0};
static const rot_torque torque = {5, knots_s, knots_n_m, 0.0, 0.0, NULL, NULL};

static double uniform(void) { return rand() / (RAND_MAX + 1.0); }

static double narrow[COLUMNS][N + 8], simd[COLUMNS][N + 8];

static rot_info grid_rows(double to[COLUMNS][N + 8], size_t shift, size_t n, const double t[],
                          const rot_axle_params *p) {
  const rot_axle_columns out = {to[0] + shift, to[1] + shift, to[2] + shift, to[3] + shift,
                                to[4] + shift, to[5] + shift, to[6] + shift};
  rot_info info;
  memset(to, 0, sizeof narrow);
  ROT_CHECK(rot_axle_linear_fast(p, n, t, &out, NULL, &info) == ROT_OK);
  return info;
}

static void check_grids(void) {
  static const size_t sizes[] = {16, 17, 18, 19, 33, 66, 67, 129, 131, 250, N};
  double t[N];
  for (int turn = 0; turn < 60; turn++) {
    const double viscous = turn % 4 ? 0.2 * uniform() : 0.0,
                 omega0 = turn % 3 ? 6.0 * uniform() : 0.0;
    const rot_axle_params p = {0.0625, viscous, 0.0, 0.5, omega0, torque};
    const size_t n = sizes[turn % 11], shift = (size_t)turn % 5;
    const double step = 8.5 * uniform() / (double)n;
    for (size_t i = 0; i < n; i++) t[i] = 0.01 * turn + step * (double)i;
    rot_simd_allow(0);
    const rot_info slow = grid_rows(narrow, shift, n, t, &p);
    rot_simd_allow(1);
    const rot_info fast = grid_rows(simd, shift, n, t, &p);
    ROT_CHECK(memcmp(narrow, simd, sizeof narrow) == 0); /* and nothing before or after */
    ROT_CHECK(slow.measure[ROT_OMEGA].error == fast.measure[ROT_OMEGA].error &&
              slow.measure[ROT_THETA].error == fast.measure[ROT_THETA].error);
    ROT_CHECK(slow.measure[ROT_OMEGA].largest == fast.measure[ROT_OMEGA].largest &&
              slow.measure[ROT_THETA].largest == fast.measure[ROT_THETA].largest);
  }
}

static void check_sweep(void) {
  static double in[6][N], to[2][COLUMNS][N];
  static int status[2][N];
  for (size_t i = 0; i < N; i++) { /* z below and above 1 side by side, turns and none */
    in[0][i] = 0.01 + uniform();
    in[1][i] = i % 5 ? 3.0 * uniform() * uniform() : 0.0;
    in[2][i] = 2.0 * uniform() - 0.7;
    in[3][i] = i % 3 ? 8.0 * uniform() - 4.0 : 0.0;
    in[4][i] = uniform();
    in[5][i] = i % 7 ? 9.0 * uniform() : 0.0;
  }
  const rot_axle_sweep_rows rows = {N,          0.0,        {in[0], 1}, {in[1], 1},
                                    {in[2], 1}, {in[3], 1}, {in[4], 1}, {in[5], 1}};
  for (int k = 0; k < 2; k++) {
    double(*c)[N] = to[k];
    const rot_axle_sweep_columns out = {c[0], c[1], c[2], c[3], c[4], c[5], c[6], status[k]};
    rot_info info;
    rot_simd_allow(k);
    ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 1, &out, NULL, &info) == ROT_OK);
  }
  ROT_CHECK(memcmp(to[0], to[1], sizeof to[0]) == 0);
  ROT_CHECK(memcmp(status[0], status[1], sizeof status[0]) == 0);
}

/* The logarithm of a pair, against the library's. */
static void check_log1p(void) {
  double worst = 0.0;
  for (double x = 1e-290; x<1e299; x *= x> 1e-4 && x < 1e4 ? 1.0007 : 1.37) {
    double pair[ROT_PAIR];
    rot_store(pair, rot_pair_log1p(ROT_BOTH(x)));
    worst = fmax(worst, rot_test_ulp(pair[0], log1p(x)));
  }
  printf("  log(1 + x) of a pair: %g ulp\n", worst);
  ROT_CHECK(worst <= 2.0);
  double none[ROT_PAIR];
  rot_store(none, rot_pair_log1p(ROT_BOTH(0.0)));
  ROT_CHECK(none[0] == 0.0);
}

int main(void) {
  srand(20);
  if (!rot_simd_ok()) printf("skip - no registers of four here\n");
  rot_simd_allow(0);
  ROT_CHECK(!rot_simd_ok() && !rot_simd_fma_ok());
  check_grids();
  check_sweep();
  check_log1p();
  return rot_test_report("wide");
}
