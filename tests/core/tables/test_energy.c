/* The two shares of the kinetic energy of a rolling body. */
#include "tables/energy.h"
#include "rot_test.h"

enum { ROWS = 6, COLUMNS = 5 };
static double result[COLUMNS][ROWS];
static const rot_energy_output out = {result[0], result[1], result[2], result[3], result[4]};

static void partition(double mass, double radius, double beta, double speed) {
  const rot_energy_input in = {{&mass, 0}, {&radius, 0}, {&beta, 0}, {&speed, 0}};
  rot_energy_partition(1, &in, &out);
}

static void check_row(int row, double inertia, double omega, double translational,
                      double rotational, double total, double ulp) {
  ROT_CHECK_ULP(result[0][row], inertia, ulp);
  ROT_CHECK_ULP(result[1][row], omega, ulp);
  ROT_CHECK_ULP(result[2][row], translational, ulp);
  ROT_CHECK_ULP(result[3][row], rotational, ulp);
  ROT_CHECK_ULP(result[4][row], total, ulp);
}

/* m = 2, r = 3, beta = 5, v = -7: I = beta m r^2, omega = v/r, K = m v^2/2 (1 + beta). */
static void check_by_head(void) {
  partition(2.0, 3.0, 5.0, -7.0);
  check_row(0, 90.0, -7.0 / 3.0, 49.0, 245.0, 294.0, 0);
}

static void check_known_values(void) {
  partition(2.5, 0.3, 0.4, -7.0);
  check_row(0, 0.089999999999999998612, -23.333333333333334197, 61.25, 24.500000000000001360,
            85.750000000000001360, 3);
}

/* The rotational share is I omega^2/2, by another road. */
static void check_rotational_fraction(void) {
  for (double beta = 0.1; beta < 3.0; beta += 0.17) {
    partition(2.3, 0.7, beta, 5.1);
    ROT_CHECK_ULP(result[3][0], 0.5 * result[0][0] * result[1][0] * result[1][0], 8);
    ROT_CHECK_ULP(result[4][0], result[2][0] + result[3][0], 3);
  }
}

/* A point slides: no inertia, no share. */
static void check_no_inertia(void) {
  partition(2.0, 3.0, 0.0, 7.0);
  check_row(0, 0.0, 7.0 / 3.0, 49.0, 0.0, 49.0, 0);
}

/* Columns and single values in one call, each from its own row. */
static void check_columns(void) {
  const double mass[ROWS] = {2.0, 3.0, 5.0, 7.0, 11.0, 13.0}, radius = 3.0,
               beta[ROWS] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0},
               speed[ROWS] = {2.0, 4.0, 6.0, 8.0, 10.0, 12.0};
  const rot_energy_input in = {{mass, 1}, {&radius, 0}, {beta, 1}, {speed, 1}};
  for (int c = 0; c < COLUMNS; c++) result[c][ROWS - 1] = -7.0;
  rot_energy_partition(ROWS - 1, &in, &out);
  for (int i = 0; i < ROWS - 1; i++) {
    const double energy = 0.5 * mass[i] * speed[i] * speed[i];
    check_row(i, 9.0 * beta[i] * mass[i], speed[i] / 3.0, energy, beta[i] * energy,
              (1.0 + beta[i]) * energy, 0);
  }
  for (int c = 0; c < COLUMNS; c++) ROT_CHECK(result[c][ROWS - 1] == -7.0);
  rot_energy_partition(0, &in, &out);
  ROT_CHECK(result[0][0] == 18.0);
}

/* v^2 and r^2 may leave the doubles where their products do not. */
static void check_range(void) {
  partition(2e-300, 1e200, 3.0, 1e200);
  check_row(0, 6e100, 1.0, 1e100, 3e100, 4e100, 3);
  partition(2e300, 1e-200, 3.0, 1e-200);
  check_row(0, 6e-100, 1.0, 1e-100, 3e-100, 4e-100, 3);
  partition(2.0, 1.0, 3.0, 1e200);
  ROT_CHECK(result[2][0] == INFINITY && result[4][0] == INFINITY);
  /* A rotational part that is a double where the translational one has lost its digits. */
  partition(1e-300, 1.0, 1e300, 1e-10);
  check_row(0, 1.0, 1e-10, 5e-321, 5e-21, 5e-21, 3);
  partition(1e300, 1.0, 1e-300, 1e10);
  check_row(0, 1.0, 1e10, INFINITY, 5e19, INFINITY, 3);
}

static void check_nan(void) {
  partition(NAN, 3.0, 5.0, 7.0);
  ROT_CHECK(isnan(result[0][0]) && !isnan(result[1][0]) && isnan(result[2][0]));
  ROT_CHECK(isnan(result[3][0]) && isnan(result[4][0]));
  partition(2.0, 3.0, NAN, 7.0);
  ROT_CHECK(isnan(result[0][0]) && !isnan(result[2][0]) && isnan(result[3][0]));
  partition(2.0, 3.0, 5.0, NAN);
  ROT_CHECK(!isnan(result[0][0]) && isnan(result[1][0]) && isnan(result[4][0]));
}

int main(void) {
  check_by_head();
  check_known_values();
  check_rotational_fraction();
  check_no_inertia();
  check_columns();
  check_range();
  check_nan();
  return rot_test_report("energy");
}
