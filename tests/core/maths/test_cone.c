#include "maths/cone.h"

#include "rot_test.h"

/* Solves with B (m x k, by columns) and c; returns the result, x in `to`. */
static rot_cone_result solve(size_t m, size_t k, const double b[], const double c[], size_t parts,
                             const rot_cone_part part[], double to[]) {
  rot_dd matrix[60], rhs[6], y[ROT_CONE_ROWS] = {{0.0, 0.0}}, x[10];
  double slack[6], blur[60], gap;
  rot_cone_result result;
  for (size_t i = 0; i < m * k; i++) {
    matrix[i] = (rot_dd){b[i], 0.0};
    blur[i] = 1e-16;
  }
  for (size_t i = 0; i < m; i++) {
    rhs[i] = (rot_dd){c[i], 0.0};
    slack[i] = 1e-16;
  }
  const rot_cone cone = {m, k, parts, part, matrix, rhs, slack, blur};
  ROT_CHECK_EQ_INT(rot_cone_solve(&cone, y, x, &result, &gap), ROT_OK);
  for (size_t j = 0; j < k; j++) to[j] = x[j].hi;
  return result;
}

/* x >= 0 with x + y + z = 3, x - z = 2.5: by hand. */
static void half_lines(void) {
  const double b[] = {1, 1, 1, 0, 1, -1}, c[] = {3, 2.5}, far[] = {3, 3.5};
  const rot_cone_part part[] = {{0, 1, {0}, 0}, {1, 1, {0}, 0}, {2, 1, {0}, 0}};
  double x[3];
  /* Without conditions: (2.25, 1, -0.25); with z = 0: x = 2.5, y = 0.5. */
  ROT_CHECK_EQ_INT(solve(2, 3, b, c, 3, part, x), ROT_CONE_FOUND);
  ROT_CHECK_REL(x[0], 2.5, 1e-15);
  ROT_CHECK_REL(x[1], 0.5, 1e-15);
  ROT_CHECK(x[2] >= 0.0 && x[2] <= 0.0);
  ROT_CHECK_EQ_INT(solve(2, 3, b, c, 0, part, x), ROT_CONE_FOUND);
  ROT_CHECK_REL(x[2], -0.25, 1e-15);
  ROT_CHECK_EQ_INT(solve(2, 3, b, far, 3, part, x), ROT_CONE_NONE); /* y < 0 */
}

/* A push n and a force (t, s) across it, |(t, s)| <= n/2: n = 2 - t/4 of least norm is at the side
 * of the cone, where t = n/2. */
static void round_cone(void) {
  const double b[] = {0.25, 0, 1}, c[] = {2}, half[] = {0.1, 0, -1};
  const rot_cone_part part[] = {{0, 3, {0, 0, 1}, 0.5}}, wall[] = {{0, 3, {0, 0, 1}, INFINITY}};
  double x[3];
  /* Inside: the normal (0.25, 0, 1) of the plane lies in the cone, x = 2 b/|b|^2. */
  ROT_CHECK_EQ_INT(solve(1, 3, b, c, 1, part, x), ROT_CONE_FOUND);
  ROT_CHECK_REL(x[2], 2.0 / 1.0625, 1e-15);
  ROT_CHECK_REL(x[0], 0.5 / 1.0625, 1e-15);
  /* t - n/4 = 1: not along its normal (1, 0, -1/4), but t = n/2, so n = 4. */
  const double steep[] = {1, 0, -0.25}, one[] = {1};
  ROT_CHECK_EQ_INT(solve(1, 3, steep, one, 1, part, x), ROT_CONE_FOUND);
  ROT_CHECK_REL(x[2], 4.0, 1e-15);
  ROT_CHECK_REL(x[0], 2.0, 1e-15);
  /* Never slides: t = 1, n = 0. A pull is nowhere. */
  ROT_CHECK_EQ_INT(solve(1, 3, steep, one, 1, wall, x), ROT_CONE_FOUND);
  ROT_CHECK_REL(x[0], 1.0, 1e-15);
  ROT_CHECK(fabs(x[2]) <= 1e-16);
  ROT_CHECK_EQ_INT(solve(1, 3, half, c, 1, part, x), ROT_CONE_NONE);
}

/* The derivative is the limit of differences of the projection, beside each kind of place. */
static void derivatives(void) {
  const rot_cone_part part[] = {{0, 3, {0.6, 0, 0.8}, 0.7}, {3, 1, {0}, 0}};
  const rot_cone cone = {0, 4, 2, part, NULL, NULL, NULL, NULL};
  const double at[][4] = {{1, 0.1, 1, 2}, {1, 3, 0.2, -2}, {-3, 1, -4, 1}, {-1, -2, 0.5, 1}};
  const double d[] = {0.3, -0.7, 0.2, 1.1}, h = 1e-6;
  for (size_t c = 0; c < 4; c++) {
    rot_dd z[4], more[4], less[4];
    double to[4];
    for (size_t i = 0; i < 4; i++) {
      z[i] = (rot_dd){at[c][i], 0.0};
      more[i] = rot_dd_sum2(at[c][i], h * d[i]);
      less[i] = rot_dd_sum2(at[c][i], -h * d[i]);
    }
    rot_cone_derivative(&cone, z, d, to);
    rot_cone_project(&cone, more);
    rot_cone_project(&cone, less);
    for (size_t i = 0; i < 4; i++)
      ROT_CHECK(fabs(rot_dd_sub(more[i], less[i]).hi / (2 * h) - to[i]) <= 1e-9);
  }
}

int main(void) {
  half_lines();
  round_cone();
  derivatives();
  return rot_test_report("cone");
}
