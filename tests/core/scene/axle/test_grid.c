/* Rows of even grids from a table against rows one by one. */
#include "scene/axle/linear.h"
#include "scene/axle/grid.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

enum { N = 3000 };

static double exact[7][N], fast[7][N];

static rot_axle_columns columns(double to[7][N]) {
  const rot_axle_columns out = {to[0], to[1], to[2], to[3], to[4], to[5], to[6]};
  return out;
}

static rot_axle_params article(double viscous, double omega0) {
  static const double time_s[] = {0.0, 1.0, 4.0, 6.0, 8.0};
  static const double torque_n_m[] = {0.0, 0.8, 0.8, 0.0, 0.0};
  const rot_axle_params p = {0.0625, viscous, 0.0,
                             0.5,    omega0,  {5, time_s, torque_n_m, 0.0, 0.0, NULL, NULL}};
  return p;
}

/* Both ways; the worst relative difference of omega and theta, row by row. */
static double worst_difference(const rot_axle_params *p, size_t n, const double t[]) {
  const rot_axle_columns out_exact = columns(exact), out_fast = columns(fast);
  rot_info info, info_fast;
  double worst = 0.0;
  ROT_CHECK(rot_axle_linear(p, n, t, &out_exact, NULL, &info) == ROT_OK);
  ROT_CHECK(rot_axle_linear_fast(p, n, t, &out_fast, NULL, &info_fast) == ROT_OK);
  ROT_CHECK(info_fast.rows_done == n && info_fast.steps == info.steps);
  for (size_t i = 0; i < n; i++) {
    const double theta = fabs(fast[0][i] - exact[0][i]), omega = fabs(fast[1][i] - exact[1][i]);
    ROT_CHECK(theta <= info_fast.measure[ROT_THETA].error &&
              omega <= info_fast.measure[ROT_OMEGA].error);
    if (exact[0][i] != 0.0) worst = fmax(worst, theta / fabs(exact[0][i]));
    if (exact[1][i] != 0.0) worst = fmax(worst, omega / fabs(exact[1][i]));
    for (int k = 2; k < 7; k++) {
      ROT_CHECK(fabs(fast[k][i] - exact[k][i]) <= 1e-14 * fabs(exact[k][i]) + 1e-300 + 1e-14);
    }
  }
  ROT_CHECK(info_fast.measure[ROT_THETA].largest >= 0.999 * info.measure[ROT_THETA].largest);
  ROT_CHECK(info_fast.measure[ROT_OMEGA].largest >= 0.999 * info.measure[ROT_OMEGA].largest);
  return worst;
}

static void even(size_t n, double from, double to, double t[]) {
  for (size_t i = 0; i < n; i++) t[i] = from + (to - from) * (double)i / (double)(n - 1);
}

static void check_even_grids(void) {
  static const size_t sizes[] = {16, 17, 100, 255, 256, 257, 1000, 3000};
  static const double viscous[] = {0.0, 1e-12, 0.03, 0.5, 5.0, 60.0};
  double t[N], worst = 0.0;
  for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
    for (size_t k = 0; k < sizeof viscous / sizeof viscous[0]; k++) {
      const rot_axle_params p = article(viscous[k], k % 2 ? 3.0 : 0.0);
      even(sizes[i], 0.0, 8.5, t);
      worst = fmax(worst, worst_difference(&p, sizes[i], t));
    }
  }
  printf("  even grids: worst difference %.2g of the value\n", worst);
  ROT_CHECK(worst < 16.0 * 2.0 * ROT_EPS);
}

/* Rounded times far from zero, a jittered grid, two grids in one piece, repeated rows. */
static void check_other_grids(void) {
  double t[N];
  const rot_axle_params p = article(0.03, 2.0);
  even(1000, 1e6, 1e6 + 3.0, t);
  ROT_CHECK(worst_difference(&p, 1000, t) < 1e-14);
  even(1000, 0.0, 8.0, t);
  for (int i = 0; i < 1000; i++) t[i] += 1e-6 * (i % 7);
  ROT_CHECK(worst_difference(&p, 1000, t) < 1e-14);
  for (int i = 0; i < 1000; i++) t[i] = i < 400 ? 1.0 + 0.001 * i : 1.4 + 0.002 * (i - 400);
  ROT_CHECK(worst_difference(&p, 1000, t) < 1e-14);
  for (int i = 0; i < 1000; i++) { /* between two that fit, one too coarse for a table */
    t[i] = i < 300   ? 1.001 * i / 300.0
           : i < 320 ? 1.001 + 0.14 * (i - 300)
                     : 4.2 + 0.003 * (i - 320);
  }
  ROT_CHECK(worst_difference(&p, 1000, t) < 1e-14);
  for (int i = 0; i < 1000; i++) t[i] = 1.5 + 0.001 * (i / 2);
  ROT_CHECK(worst_difference(&p, 1000, t) < 1e-14);
}

/* What the table itself says: how many rows, and none where it must not be used. */
static size_t rows_done(const rot_axle_params *p, const rot_torque_piece *piece, size_t n,
                        const double t[]) {
  rot_info info;
  rot_axle_grid grid;
  const rot_axle_columns out = columns(fast);
  rot_axle_state base = rot_axle_start(p);
  rot_info_clear(&info, rot_turning);
  rot_axle_grid_begin(&grid);
  rot_axle_grid_enter(&grid, p, piece);
  const size_t done = rot_axle_grid_rows(&grid, p, &base, piece, n, t, &out, &info);
  if (done == 0) ROT_CHECK(base.time_s == p->start_s && info.measure[ROT_OMEGA].largest == 0.0);
  if (done > 0) {
    ROT_CHECK(base.time_s >= t[0] && base.time_s <= t[done - 1]);
    ROT_CHECK(info.measure[ROT_OMEGA].largest > 0.0 && info.measure[ROT_OMEGA].error > 0.0 &&
              info.measure[ROT_THETA].error > 0.0);
  }
  return done;
}

static void check_refusals(void) {
  double t[N];
  const rot_axle_params p = article(0.03, 2.0);
  const rot_torque_piece rise = {0.0, 1.0, 0.0, 0.8}, turn = {0.0, 1.0, -0.4, 0.8};
  even(1000, 0.001, 0.9, t);
  ROT_CHECK_EQ_INT(rows_done(&p, &rise, 1000, t), 1000);
  ROT_CHECK_EQ_INT(rows_done(&p, &rise, 40, t), 40);
  ROT_CHECK_EQ_INT(rows_done(&p, &rise, 2 * ROT_GRID_ROWS + 1, t), 2 * ROT_GRID_ROWS + 1);
  ROT_CHECK_EQ_INT(rows_done(&p, &rise, ROT_GRID_MIN - 1, t), 0);
  ROT_CHECK_EQ_INT(rows_done(&p, &turn, 40, t), 0);
  t[300] += 1e-8;
  ROT_CHECK_EQ_INT(rows_done(&p, &rise, 1000, t), 300);
  t[5] += 1e-8;
  ROT_CHECK_EQ_INT(rows_done(&p, &rise, 1000, t), 0);
  const rot_axle_params stiff = article(10.0, 2.0);
  even(40, 0.001, 0.9, t);
  ROT_CHECK_EQ_INT(rows_done(&stiff, &rise, 40, t), 0);
}

/* One step at a time, from hardly any to the longest that is short, against rot_axle_step(). The
 * bound may be wider: a falling torque is a start and a slope here, and two ends there. */
static void check_steps(void) {
  static const rot_torque_piece pieces[] = {
      {0.0, 4.0, 0.0, 0.8}, {0.0, 4.0, 0.8, 0.1}, {0.0, 4.0, 0.7, 0.7}, {0.0, 4.0, -0.4, 0.8}};
  rot_axle_grid grid;
  rot_axle_grid_begin(&grid);
  for (size_t k = 0; k < sizeof pieces / sizeof pieces[0]; k++) {
    const rot_axle_params p = article(0.03, 2.0);
    const rot_axle_state from = {1.0, 0.5, 1e-17, 2.0, 1e-16, 0.0, 0.0};
    rot_axle_grid_enter(&grid, &p, &pieces[k]);
    for (double s = 0.99; s < 1.1; s += 0.005) { /* at rest, torque from nothing: E3 and E2 alone */
      const rot_torque_piece ramp = {1.0, 4.0, 0.0, 0.8};
      const rot_axle_state rest = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
      rot_axle_grid_enter(&grid, &p, &ramp);
      const rot_axle_state a = rot_axle_grid_step(&grid, &p, &rest, &ramp, 1.0 + s);
      const rot_axle_state b = rot_axle_step(&p, &rest, &ramp, 1.0 + s);
      ROT_CHECK_REL(a.omega_rad_per_s, b.omega_rad_per_s, 6.0 * ROT_EPS);
      ROT_CHECK_REL(a.theta_rad, b.theta_rad, 6.0 * ROT_EPS);
    }
    rot_axle_grid_enter(&grid, &p, &pieces[k]);
    for (double s = 1e-9; s < 2.9; s *= 1.07) { /* c s/I from 5e-10 to 1.4 */
      const rot_axle_state a = rot_axle_grid_step(&grid, &p, &from, &pieces[k], 1.0 + s);
      const rot_axle_state b = rot_axle_step(&p, &from, &pieces[k], 1.0 + s);
      ROT_CHECK_REL(a.omega_rad_per_s, b.omega_rad_per_s, 8.0 * ROT_EPS);
      ROT_CHECK_REL(a.theta_rad, b.theta_rad, 8.0 * ROT_EPS);
      ROT_CHECK(a.omega_error > 0.0 && a.omega_error <= 2.0 * b.omega_error);
      ROT_CHECK(a.theta_error > 0.0 && a.theta_error <= 2.0 * b.theta_error);
    }
  }
}

/* A row of the first chunk is the step to its time, to the last bit where the series are of one
 * length: c s/I from 0.06 to 0.3. */
static void check_bits(void) {
  enum { ROWS = 64, FIRST = 14 };
  double t[ROWS];
  rot_info info;
  rot_axle_grid grid;
  const rot_torque_piece piece = {0.0, 4.0, 0.1, 0.8};
  const rot_axle_params p = article(0.01875, 2.0);
  const rot_axle_columns out = columns(fast);
  const rot_axle_state start = rot_axle_start(&p);
  rot_axle_state base = start;
  for (int i = 0; i < ROWS; i++) t[i] = i / 64.0;
  rot_info_clear(&info, rot_turning);
  rot_axle_grid_begin(&grid);
  rot_axle_grid_enter(&grid, &p, &piece);
  ROT_CHECK_EQ_INT(rot_axle_grid_rows(&grid, &p, &base, &piece, ROWS, t, &out, &info), ROWS);
  for (int i = FIRST; i < ROWS; i++) {
    const rot_axle_state to = rot_axle_grid_step(&grid, &p, &start, &piece, t[i]);
    ROT_CHECK(fast[0][i] == to.theta_rad && fast[1][i] == to.omega_rad_per_s);
  }
}

/* fixed_axis_linear.csv, 40 digits: the last row of N on an even grid, which the state has reached
 * through every chunk, and one short step. */
static void check_known_case(const double x[8], double *worst) {
  const double time_s[] = {0.0, x[2]}, torque_n_m[] = {x[3], x[4]};
  const rot_axle_params p = {x[0], x[1], 0.0, 0.0, x[5], {2, time_s, torque_n_m, x[3], x[4], 0, 0}};
  const rot_torque_piece piece = {0.0, x[2], x[3], x[4]};
  const rot_axle_columns out = columns(fast);
  const rot_axle_state start = rot_axle_start(&p);
  double t[N];
  rot_info info;
  rot_axle_grid grid;
  even(N, 0.0, x[2], t);
  ROT_CHECK(rot_axle_linear_fast(&p, N, t, &out, NULL, &info) == ROT_OK);
  const double theta = fabs(fast[0][N - 1] - x[6]), omega = fabs(fast[1][N - 1] - x[7]);
  ROT_CHECK(theta <= info.measure[ROT_THETA].error && omega <= info.measure[ROT_OMEGA].error);
  *worst = fmax(*worst, fmax(theta / info.measure[ROT_THETA].largest,
                             omega / info.measure[ROT_OMEGA].largest));
  rot_axle_grid_begin(&grid);
  rot_axle_grid_enter(&grid, &p, &piece);
  const rot_axle_state end = rot_axle_grid_step(&grid, &p, &start, &piece, x[2]);
  ROT_CHECK(fabs(end.theta_rad - x[6]) <= end.theta_error + ROT_EPS * fabs(x[6]));
  ROT_CHECK(fabs(end.omega_rad_per_s - x[7]) <= end.omega_error + ROT_EPS * fabs(x[7]));
}

static void check_known(void) {
  FILE *file = shared_table("refs/fixed_axis_linear.csv");
  double x[8], worst = 0.0;
  int cases = 0;
  if (!file) return;
  while (shared_row(file, 8, x)) {
    int tame = x[1] >= 0.0 && x[2] > 0.0;
    for (int i = 0; i < 8; i++)
      tame = tame && (x[i] == 0.0 || (fabs(x[i]) > 1e-60 && fabs(x[i]) < 1e60));
    if (!tame) continue;
    check_known_case(x, &worst);
    cases++;
  }
  ROT_CHECK(cases >= 30);
  printf("  %d cases of 40 digits, the last of %d rows: worst error %.2g\n", cases, N, worst);
  ROT_CHECK(worst < 1e-15);
}

/* Constant torque without resistance, by hand: omega = 2 + 3 t, theta = 1 + 2 t + 1.5 t^2. */
static void check_by_hand(void) {
  double t[N];
  rot_info info;
  const rot_axle_columns out = columns(fast);
  const rot_axle_params p = {2.0, 0.0, 0.0, 1.0, 2.0, {0, NULL, NULL, 6.0, 6.0, NULL, NULL}};
  even(300, 0.5, 7.0, t);
  ROT_CHECK(rot_axle_linear_fast(&p, 300, t, &out, NULL, &info) == ROT_OK);
  for (int i = 0; i < 300; i++) {
    ROT_CHECK_REL(fast[1][i], 2.0 + 3.0 * t[i], 1e-15);
    ROT_CHECK_REL(fast[0][i], 1.0 + 2.0 * t[i] + 1.5 * t[i] * t[i], 1e-15);
    ROT_CHECK_REL(fast[6][i], fast[1][i] * fast[1][i], 1e-15);
  }
}

/* The bound of theta without torque or resistance, from above: five roundings of the way, and one
 * of each of the sums. */
static void check_bound(void) {
  double t[N];
  rot_info info;
  const rot_axle_columns out = columns(fast);
  const rot_axle_params p = {2.0, 0.0, 0.0, 0.0, 3.0, {0, NULL, NULL, 0.0, 0.0, NULL, NULL}};
  even(100, 0.0, 7.0, t);
  ROT_CHECK(rot_axle_linear_fast(&p, 100, t, &out, NULL, &info) == ROT_OK);
  const double direction = 21.0 * ROT_EPS, said = info.measure[ROT_THETA].error;
  ROT_CHECK(said >= 5.0 * direction && said <= 6.5 * direction);
}

int main(void) {
  check_even_grids();
  check_other_grids();
  check_refusals();
  check_steps();
  check_bits();
  check_known();
  check_by_hand();
  check_bound();
  return rot_test_report("axle_grid");
}
