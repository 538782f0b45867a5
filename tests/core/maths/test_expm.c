#include "maths/expm.h"

#include <gsl/gsl_linalg.h>

#include "rot_test.h"

/* Rotations of many turns, whose exponential is known; GSL beside it. */
static void check_exponential(void) {
  const double angle[] = {1e-3, 0.3, 1.0, 3.0, 40.0, 1e4};
  for (int i = 0; i < 6; i++) {
    double a[9] = {0.0}, e[9], work[ROT_EXPM_WORK(3)], turned[9];
    a[1] = -angle[i];
    a[3] = angle[i];
    a[8] = -0.5;
    ROT_CHECK_EQ_INT(rot_expm(3, a, e, work, NULL), ROT_OK);
    const double max = 4e-16 * (1.0 + angle[i]);
    ROT_CHECK(fabs(e[0] - cos(angle[i])) <= max);
    ROT_CHECK(fabs(e[1] + sin(angle[i])) <= max);
    ROT_CHECK(fabs(e[3] - sin(angle[i])) <= max);
    ROT_CHECK(fabs(e[8] - exp(-0.5)) <= max);
    ROT_CHECK(e[2] == 0.0 && e[6] == 0.0);
    if (i > 3) continue;
    gsl_matrix_view from = gsl_matrix_view_array(a, 3, 3), to = gsl_matrix_view_array(turned, 3, 3);
    ROT_CHECK_EQ_INT(gsl_linalg_exponential_ss(&from.matrix, &to.matrix, GSL_PREC_DOUBLE), 0);
    for (int j = 0; j < 9; j++) ROT_CHECK(fabs(e[j] - turned[j]) <= 1e-13);
  }
  double bad = NAN, e, work[7];
  ROT_CHECK_EQ_INT(rot_expm(1, &bad, &e, work, NULL), ROT_ERANGE);
}

int main(void) {
  check_exponential();
  return rot_test_report("expm");
}
