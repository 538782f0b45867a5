#include "maths/eigen.h"

#include <float.h>
#include <stdlib.h>

#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

static uint64_t seed = 7;
static double uniform(void) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(seed >> 11) * 0x1p-53;
}

/* ---- symmetric ------------------------------------------------------------------------------ */

/* refs/eig3.csv: 40 digits. Graded matrices lose no digit of the small eigenvalues; those of nearly
 * equal ones are conditioned as well as any. */
static void check_shared_table(void) {
  FILE *file = shared_table("refs/eig3.csv");
  double x[9], values[3], vectors[9], worst = 0.0;
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 9, x)) {
    double a[9] = {x[0], x[1], x[2], x[1], x[3], x[4], x[2], x[4], x[5]};
    ROT_CHECK_EQ_INT(rot_eigen_symmetric(3, a, values, vectors, NULL), ROT_OK);
    for (int i = 0; i < 3; i++) {
      ROT_CHECK_REL(values[i], x[6 + i], 1e-15);
      worst = fmax(worst, rot_test_rel(values[i], x[6 + i]));
    }
    rows++;
  }
  printf("3 x 3: worst %.2g relative\n", worst);
  ROT_CHECK(rows >= 20);
}

/* A v = lambda v and V'V = 1, at sizes up to 64, and scaled out of the range of squares. */
static void check_random(void) {
  static double a[64 * 64], copy[64 * 64], vectors[64 * 64];
  double values[64];
  const size_t size[] = {1, 2, 5, 17, 64};
  for (int s = 0; s < 5; s++) {
    const size_t n = size[s];
    const double scale = s == 2 ? 0x1p900 : s == 3 ? 0x1p-900 : 1.0;
    for (size_t i = 0; i < n; i++) {
      for (size_t j = 0; j <= i; j++) {
        a[i * n + j] = a[j * n + i] = scale * (2.0 * uniform() - 1.0);
      }
    }
    for (size_t i = 0; i < n * n; i++) copy[i] = a[i];
    ROT_CHECK_EQ_INT(rot_eigen_symmetric(n, a, values, vectors, NULL), ROT_OK);
    double off = 0.0, skew = 0.0;
    for (size_t j = 0; j < n; j++) {
      if (j > 0) ROT_CHECK(values[j] >= values[j - 1]);
      for (size_t i = 0; i < n; i++) {
        double sum = 0.0, product = 0.0;
        for (size_t k = 0; k < n; k++) {
          sum += copy[i * n + k] / scale * vectors[k * n + j];
          product += vectors[k * n + i] * vectors[k * n + j];
        }
        off = fmax(off, fabs(sum - values[j] / scale * vectors[i * n + j]));
        skew = fmax(skew, fabs(product - (i == j)));
      }
    }
    ROT_CHECK(off <= 1e-14 * (double)(n + 2));
    ROT_CHECK(skew <= 4e-15 * (double)(n + 2));
  }
}

static void check_bad_values(void) {
  double a[4] = {1.0, NAN, NAN, 2.0}, values[2], vectors[4], g[2] = {INFINITY, 1.0};
  ROT_CHECK_EQ_INT(rot_eigen_symmetric(2, a, values, vectors, NULL), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_eigen_singular(2, 1, g, values, vectors, NULL), ROT_EVALUE);
  double zero[4] = {0.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(rot_eigen_symmetric(2, zero, values, vectors, NULL), ROT_OK);
  ROT_CHECK(values[0] == 0.0 && values[1] == 0.0);
}

/* ---- singular values ------------------------------------------------------------------------ */

/* Shafts with rotors from 1e-12 to 1e6 kg m^2 and springs from 1e-6 to 1e9 N m/rad: the matrix
 * sqrt(k) B J^-1/2 that rot_shaft.c takes apart. mpmath, 50 digits (svd_r at 120). */
static const struct {
  size_t n;
  double J[5], k[4], sigma[4];
} graded[] = {
    {3, {1.0, 1e-12, 1.0}, {1.0, 2.0}, {1.154700538379219454, 1732050.8075693584362}},
    {4,
     {2.0, 1e-06, 3.0, 1e-09},
     {1000000.0, 0.001, 5.0},
     {0.028867509112997868602, 70710.678130439863257, 1000000.2504999683975}},
    {5,
     {1e-12, 1000000.0, 0.001, 2.0, 100000.0},
     {1000000000.0, 1e-06, 1.0, 10000.0},
     {3.3165929661499468344e-6, 31.62081648404313562, 70.715804208694790817,
      31622776601.683793654}},
    {3, {0.0465, 2.23e-10, 30700.0}, {12.9, 516.0}, {16.451548226745551775, 1540048.3365565346708}},
    {5,
     {1.73e-12, 1190.0, 4.66e-08, 1.65e-08, 835000.0},
     {11.3, 3520000.0, 14.0, 3850.0},
     {0.10834546292269161794, 483923.35632482742108, 2555737.0575852400067, 8691189.8565284452131}},
    {3,
     {1.49e-08, 5.36e-10, 46200.0},
     {0.706, 1.69e-06},
     {10.463463966047465125, 36939.812843882201254}},
    {3,
     {7.4e-10, 172000.0, 5.89e-12},
     {503000.0, 2260000.0},
     {26071626.909913631759, 619436185.94251376895}},
    {4,
     {0.000323, 8.69, 6590.0, 7.15},
     {65500000.0, 0.84, 1030000.0},
     {0.31110539340706432986, 379.75286895086919895, 450326.45392902234966}},
};

static void check_graded(void) {
  double worst = 0.0;
  for (size_t c = 0; c < sizeof graded / sizeof *graded; c++) {
    const size_t n = graded[c].n, cols = n - 1;
    double g[20] = {0.0}, sigma[4], u[16];
    for (size_t j = 0; j < cols; j++) {
      g[j * cols + j] = sqrt(graded[c].k[j]) / sqrt(graded[c].J[j]);
      g[(j + 1) * cols + j] = -sqrt(graded[c].k[j]) / sqrt(graded[c].J[j + 1]);
    }
    ROT_CHECK_EQ_INT(rot_eigen_singular(n, cols, g, sigma, u, NULL), ROT_OK);
    for (size_t j = 0; j < cols; j++) {
      ROT_CHECK_REL(sigma[j], graded[c].sigma[j], 2e-15);
      worst = fmax(worst, rot_test_rel(sigma[j], graded[c].sigma[j]));
    }
  }
  printf("graded shafts: worst %.2g relative\n", worst);
}

/* |G u| = sigma and u orthogonal. */
static void check_vectors(void) {
  enum { ROWS = 30, COLS = 29 };
  static double g[ROWS * COLS], copy[ROWS * COLS], u[COLS * COLS];
  double sigma[COLS];
  for (int i = 0; i < ROWS * COLS; i++) copy[i] = g[i] = uniform() - 0.3;
  ROT_CHECK_EQ_INT(rot_eigen_singular(ROWS, COLS, g, sigma, u, NULL), ROT_OK);
  for (int j = 0; j < COLS; j++) {
    double length = 0.0, product = 0.0;
    for (int i = 0; i < ROWS; i++) {
      double sum = 0.0;
      for (int k = 0; k < COLS; k++) sum += copy[i * COLS + k] * u[k * COLS + j];
      length = hypot(length, sum);
    }
    for (int k = 0; k < COLS; k++) product += u[k * COLS + j] * u[k * COLS + (j + 1) % COLS];
    ROT_CHECK(fabs(length - sigma[j]) <= 1e-14 * sigma[COLS - 1]);
    ROT_CHECK(fabs(product) <= 1e-14);
  }
}

int main(void) {
  check_shared_table();
  check_random();
  check_bad_values();
  check_graded();
  check_vectors();
  return rot_test_report("eigen");
}
