/* Least squares against certified values of NIST's Statistical Reference Datasets (Misra1a, from
 * both of their starts; MGH09), a linear problem, nearly dependent columns, points without
 * residuals. */
#include "maths/trust_region.h"

#include <math.h>
#include <string.h>

#include "rot_test.h"

enum { MISRA = 14 };
static const double misra_x[MISRA] = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                      378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
static const double misra_y[MISRA] = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                      44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};

static rot_status misra_residual(const double b[], double r[], void *ctx) {
  int *calls = ctx;
  ++*calls;
  if (b[1] > 1.0) return ROT_ERANGE; /* refused far away */
  for (size_t i = 0; i < MISRA; i++) r[i] = -b[0] * expm1(-b[1] * misra_x[i]) - misra_y[i];
  return ROT_OK;
}

static rot_status misra_jacobian(const double b[], double j[], void *ctx) {
  (void)ctx;
  for (size_t i = 0; i < MISRA; i++) {
    j[2 * i] = -expm1(-b[1] * misra_x[i]);
    j[2 * i + 1] = b[0] * misra_x[i] * exp(-b[1] * misra_x[i]);
  }
  return ROT_OK;
}

static void certified(void) {
  static const double starts[][2] = {{500.0, 1e-4}, {250.0, 5e-4}};
  int calls = 0;
  const rot_squares_problem problem = {MISRA,  2,     misra_residual, misra_jacobian,
                                       &calls, 1e-14, 1e-12};
  for (int k = 0; k < 2; k++) {
    double x[2] = {starts[k][0], starts[k][1]}, covariance[4], factor[4], r[4];
    rot_squares found = {.covariance = covariance, .factor = factor, .triangle = r};
    ROT_CHECK(rot_squares_solve(&problem, NULL, x, &found) == ROT_OK);
    ROT_CHECK_REL(x[0], 2.3894212918e+02, 1e-8);
    ROT_CHECK_REL(x[1], 5.5015643181e-04, 1e-8);
    ROT_CHECK_REL(found.squares, 1.2455138894e-01, 1e-9);
    ROT_CHECK_REL(found.sigma, 1.0187876330e-01, 1e-9);
    ROT_CHECK_REL(sqrt(covariance[0]), 2.7070075241e+00, 1e-7);
    ROT_CHECK_REL(sqrt(covariance[3]), 7.2668688436e-06, 1e-7);
    ROT_CHECK(covariance[1] == covariance[2] && found.iterations > 0);
    /* covariance = factor factor' */
    ROT_CHECK_REL(factor[0] * factor[0] + factor[1] * factor[1], covariance[0], 1e-14);
    ROT_CHECK_REL(factor[1] * factor[3], covariance[1], 1e-14);
    ROT_CHECK(factor[2] == 0.0);
    /* R R^-1 = 1: covariance = sigma^2 (R'R)^-1 */
    ROT_CHECK_REL(fabs(r[3] * factor[3]), found.sigma, 1e-13);
    ROT_CHECK_REL(fabs(r[0] * factor[0]), found.sigma, 1e-13);
    ROT_CHECK(r[2] == 0.0);
  }
}

/* MGH09, far from its minimum: of 4000 random starts in [0, 10]^4 the dogleg method alone finds it
 * from 765, with Levenberg and Marquardt's after it from 3987. */
enum { MGH = 11 };
static const double mgh_x[MGH] = {4.0,   2.0, 1.0,    0.5,    0.25,  0.167,
                                  0.125, 0.1, 0.0833, 0.0714, 0.0625};
static const double mgh_y[MGH] = {0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627,
                                  0.0456, 0.0342, 0.0323, 0.0235, 0.0246};

static rot_status mgh_residual(const double b[], double r[], void *ctx) {
  (void)ctx;
  for (size_t i = 0; i < MGH; i++) {
    const double x = mgh_x[i];
    r[i] = b[0] * x * (x + b[1]) / (x * (x + b[2]) + b[3]) - mgh_y[i];
  }
  return ROT_OK;
}

static rot_status mgh_jacobian(const double b[], double j[], void *ctx) {
  (void)ctx;
  for (size_t i = 0; i < MGH; i++) {
    const double x = mgh_x[i], above = x * (x + b[1]), below = x * (x + b[2]) + b[3];
    j[4 * i] = above / below;
    j[4 * i + 1] = b[0] * x / below;
    j[4 * i + 2] = -b[0] * above * x / (below * below);
    j[4 * i + 3] = -b[0] * above / (below * below);
  }
  return ROT_OK;
}

static void second_method(void) {
  static const double starts[][4] = {
      {8.0, 3.3, 3.8, 4.9}, {5.5, 4.2, 1.7, 7.3}, {2.2, 3.6, 5.6, 4.2}, {7.9, 5.8, 4.0, 6.5}};
  const rot_squares_problem problem = {MGH, 4, mgh_residual, mgh_jacobian, NULL, 1e-14, 1e-12};
  for (int k = 0; k < 4; k++) {
    double x[4], covariance[16], factor[16];
    rot_squares found = {.covariance = covariance, .factor = factor};
    memcpy(x, starts[k], sizeof x);
    ROT_CHECK(rot_squares_solve(&problem, NULL, x, &found) == ROT_OK);
    ROT_CHECK_REL(x[0], 1.9280693458e-01, 1e-4);
    ROT_CHECK_REL(x[1], 1.9128232873e-01, 1e-4);
    ROT_CHECK_REL(x[2], 1.2305650693e-01, 1e-4);
    ROT_CHECK_REL(x[3], 1.3606233068e-01, 1e-4);
    ROT_CHECK_REL(found.squares, 3.0750560385e-04, 1e-9);
  }
}

/* Columns 1 and t + 1e-6 t^2 ..., nearly the same: the sum is known well, the parts are not. */
enum { LINE = 50 };

static double column_of(size_t i, size_t k) {
  const double t = (double)i / LINE;
  return k == 0 ? 1.0 + t : 1.0 + t + 1e-6 * t * t;
}

static rot_status line_residual(const double b[], double r[], void *ctx) {
  (void)ctx;
  for (size_t i = 0; i < LINE; i++) {
    r[i] = (b[0] - 3.0) * column_of(i, 0) + (b[1] + 1.0) * column_of(i, 1) + (i % 2 ? 0.1 : -0.1);
  }
  return ROT_OK;
}

static rot_status line_jacobian(const double b[], double j[], void *ctx) {
  (void)b, (void)ctx;
  for (size_t i = 0; i < LINE; i++) {
    for (size_t k = 0; k < 2; k++) j[2 * i + k] = column_of(i, k);
  }
  return ROT_OK;
}

static void dependent(void) {
  const rot_squares_problem problem = {LINE, 2, line_residual, line_jacobian, NULL, 1e-16, 1e-12};
  double x[2] = {0.0, 0.0}, covariance[4], factor[4];
  rot_squares found = {.covariance = covariance, .factor = factor};
  ROT_CHECK(rot_squares_solve(&problem, NULL, x, &found) == ROT_OK);
  ROT_CHECK_REL(x[0] + x[1], 2.0, 0.02);
  ROT_CHECK(found.condition > 1e6 && sqrt(covariance[0]) > 1e3);
  /* The variance of the sum, by the factor; by the covariance it has no digit. */
  const double a = factor[0] + factor[2], b = factor[1] + factor[3];
  ROT_CHECK(sqrt(a * a + b * b) < 0.1 && sqrt(a * a + b * b) > 1e-3);
}

static rot_status refuse(const double b[], double r[], void *ctx) {
  (void)b, (void)r, (void)ctx;
  return ROT_EVALUE;
}

static void faults(void) {
  int calls = 0;
  rot_squares_problem problem = {MISRA, 2, misra_residual, misra_jacobian, &calls, 0.0, 1e-12};
  double x[2] = {250.0, 5e-4};
  rot_squares found = {0};
  problem.n = 2;
  ROT_CHECK(rot_squares_solve(&problem, NULL, x, &found) == ROT_EVALUE);
  problem.n = MISRA;
  problem.p = 0;
  ROT_CHECK(rot_squares_solve(&problem, NULL, x, &found) == ROT_EVALUE);
  problem.p = 2;
  problem.jacobian = refuse;
  ROT_CHECK(rot_squares_solve(&problem, NULL, x, &found) == ROT_ERANGE);
  ROT_CHECK(x[0] == 250.0 && x[1] == 5e-4);
}

int main(void) {
  certified();
  second_method();
  dependent();
  faults();
  return rot_test_report("trust_region");
}
