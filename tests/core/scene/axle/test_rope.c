/* Masses on a rope over the body of an axle: rows by hand, and what explains their potential
 * energy. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "rot_test.h"
#include "scene/axle/rope.h"

enum { COLUMNS = 7 };

/* One row: the state, and the torques of weights and resistance on body and masses together. */
typedef struct row {
  double of[COLUMNS], alpha, mass[2][ROT_AXLE_OF_MASS];
} row;

static row row_of(const rot_axle_rope *rope, double theta, double omega, double damping) {
  row r;
  double *column[2][ROT_AXLE_OF_MASS];
  const double whole = rope->inertia_kg_m2 + rot_axle_rope_moment(rope);
  const double weight =
      (rope->mass_kg[0] - rope->mass_kg[1]) * rope->gravity_m_per_s2 * rope->radius_m;
  const rot_axle_columns rows = {&r.of[0], &r.of[1], &r.of[2], &r.of[3],
                                 &r.of[4], &r.of[5], &r.of[6]};
  memset(&r, 0, sizeof r);
  r.of[0] = theta;
  r.of[1] = omega;
  r.of[2] = weight;
  r.of[3] = damping;
  r.of[4] = weight + damping;
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < ROT_AXLE_OF_MASS; i++) column[k][i] = &r.mass[k][i];
  }
  rot_axle_rope_rows(rope, whole, 1, &rows, &r.alpha, (double *const(*)[ROT_AXLE_OF_MASS])column);
  return r;
}

/* 3 kg and 1 kg at 0.5 m, on 1 kg m^2, g = 10 m/s^2: 10 N m on 2 kg m^2 in all, a = 2.5 m/s^2,
 * T1 = 3 (10 - 2.5), T2 = 1 (10 + 2.5). */
static void check_two_masses(void) {
  const rot_axle_rope rope = {{3.0, 1.0}, 0.5, 1.0, 10.0};
  const row r = row_of(&rope, 4.0, 2.0, 0.0);
  ROT_CHECK_REL(rot_axle_rope_moment(&rope), 1.0, 1e-15);
  ROT_CHECK_REL(r.alpha, 5.0, 1e-15);
  ROT_CHECK_REL(r.mass[0][0], 22.5, 1e-15);
  ROT_CHECK_REL(r.mass[1][0], 12.5, 1e-15);
  ROT_CHECK_REL(r.of[4], 5.0, 1e-15);                 /* net, on the body alone */
  ROT_CHECK_REL(r.of[2], (22.5 - 12.5) * 0.5, 1e-15); /* of the rope */
  ROT_CHECK_REL(r.of[6], 0.5 * 1.0 * 4.0, 1e-15);
  ROT_CHECK_REL(r.mass[0][1], -2.0, 1e-15); /* it is 2 m below its start */
  ROT_CHECK_REL(r.mass[1][1], 2.0, 1e-15);
  ROT_CHECK_REL(r.mass[0][2], 0.5 * 3.0, 1e-15);
  ROT_CHECK_REL(r.mass[1][2], 0.5, 1e-15);
  ROT_CHECK_REL(r.mass[0][3], -60.0, 1e-15);
  ROT_CHECK_REL(r.mass[1][3], 20.0, 1e-15);
  /* A resistance of 2 N m against it: a = 2 m/s^2, and the rope has the rest. */
  const row slow = row_of(&rope, 4.0, 2.0, -2.0);
  ROT_CHECK_REL(slow.alpha, 4.0, 1e-15);
  ROT_CHECK_REL(slow.mass[0][0], 24.0, 1e-15);
  ROT_CHECK_REL(slow.mass[1][0], 12.0, 1e-15);
  ROT_CHECK_REL(slow.of[2], 6.0, 1e-15);
  ROT_CHECK_REL(slow.of[4], 4.0, 1e-15);
}

/* Angles that are off by 0.1 and 0.25 rad move 10 N m by 1 and 2.5 J; no more is explained but
 * rounding. */
static void check_potential(void) {
  const rot_axle_rope rope = {{3.0, 1.0}, 0.5, 1.0, 10.0};
  const double theta[] = {1.0, 4.0}, first[] = {0.1, 0.0}, both[] = {0.1, 0.25}, none[2] = {0.0};
  double explained;
  ROT_CHECK_REL(rot_axle_rope_potential(&rope, theta, none, &explained), -30.0, 1e-15);
  ROT_CHECK(explained >= 2.0 * DBL_EPSILON * 30.0 && explained <= 8.0 * DBL_EPSILON * 30.0);
  (void)rot_axle_rope_potential(&rope, theta, first, &explained);
  ROT_CHECK_REL(explained, 1.0, 1e-12);
  (void)rot_axle_rope_potential(&rope, theta, both, &explained);
  ROT_CHECK_REL(explained, 3.5, 1e-12);
}

int main(void) {
  check_two_masses();
  check_potential();
  return rot_test_report("rope");
}
