#include "maths/simplex.h"

#include "rot_test.h"

static double column[200], cost[50];

static rot_simplex program(size_t m, size_t n, const double a[], const double c[],
                           const double rhs[]) {
  rot_simplex lp = {0};
  lp.m = m;
  lp.n = n;
  lp.capacity = 50;
  lp.column = column;
  lp.cost = cost;
  lp.tolerance = 1e-11;
  memcpy(column, a, m * n * sizeof *a);
  memcpy(cost, c, n * sizeof *c);
  memcpy(lp.rhs, rhs, m * sizeof *rhs);
  return lp;
}

/* max 3x + 5y with x <= 4, 2y <= 12, 3x + 2y <= 18: 36 at (2, 6) (Dantzig's example). */
static void known_optimum(void) {
  const double a[] = {1, 0, 3, 0, 2, 2, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double c[] = {-3, -5, 0, 0, 0}, rhs[] = {4, 12, 18};
  rot_simplex lp = program(3, 5, a, c, rhs);
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_OPTIMAL);
  ROT_CHECK_REL(lp.value, -36.0, 1e-15);
  ROT_CHECK(fabs(lp.dual[1] + 1.5) <= 1e-14 && fabs(lp.dual[2] + 1.0) <= 1e-14);
}

/* x >= 0 with x = -1; the certificate separates. And x - y = 0 without bound; -1 has one. */
static void without_an_optimum(void) {
  const double one[] = {1}, none[] = {0}, rhs[] = {-1};
  rot_simplex lp = program(1, 1, one, none, rhs);
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_INFEASIBLE);
  ROT_CHECK(lp.dual[0] * -1.0 > 0.0 && lp.dual[0] * 1.0 <= 0.0);
  const double pair[] = {1, -1}, down[] = {-1, 0}, zero[] = {0};
  lp = program(1, 2, pair, down, zero);
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_UNBOUNDED);
  const double up[] = {1, 0};
  lp = program(1, 2, pair, up, zero);
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_OPTIMAL);
  ROT_CHECK(fabs(lp.value) <= 0.0);
}

/* Redundant equations keep an artificial column at 0; Beale's program cycles without a rule. */
static void degenerate(void) {
  const double twice[] = {1, 2, 1, 2}, c[] = {1, 2}, rhs[] = {3, 6};
  rot_simplex lp = program(2, 2, twice, c, rhs);
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_OPTIMAL);
  ROT_CHECK_REL(lp.value, 3.0, 1e-15);
  const double beale[] = {0.25, 0.5, 0, -60, -90, 0, -0.04, -0.02, 1, 9, 3,
                          0,    1,   0, 0,   0,   1, 0,     0,     0, 1};
  const double prices[] = {-0.75, 150, -0.02, 6, 0, 0, 0}, limit[] = {0, 0, 1};
  lp = program(3, 7, beale, prices, limit);
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_OPTIMAL);
  ROT_CHECK_REL(lp.value, -0.05, 1e-13);
}

/* Columns (cos t, sin t, 1) of a cone, generated: the one that is asked for, and none outside. */
static int cone(void *ctx, const double dual[], int phase, double to[], double *price) {
  (void)ctx;
  const double x = (phase == 1 ? 0.0 : -1.0) - dual[0], y = -dual[1];
  const double size = hypot(x, y);
  if (!(size > 0.0)) return 0;
  to[0] = -x / size;
  to[1] = -y / size;
  to[2] = 1.0;
  *price = -to[0];
  return 1;
}

static void generated_columns(void) {
  const double a[] = {0, 0, 1}, c[] = {0}, rhs[] = {0.8, 0.6, 1.0};
  rot_simplex lp = program(3, 1, a, c, rhs);
  lp.tolerance = 1e-8; /* the point is on the cone */
  lp.price = cone;
  const rot_simplex_result found = rot_simplex_solve(&lp);
  ROT_CHECK(found == ROT_SIMPLEX_OPTIMAL);
  ROT_CHECK_REL(lp.value, -0.8, 1e-7);
  const double outside[] = {0.8, 0.7, 1.0};
  lp = program(3, 1, a, c, outside);
  lp.price = cone;
  ROT_CHECK_EQ_INT(rot_simplex_solve(&lp), ROT_SIMPLEX_INFEASIBLE);
}

int main(void) {
  known_optimum();
  without_an_optimum();
  degenerate();
  generated_columns();
  return rot_test_report("simplex");
}
