/* Free bodies: against 110-digit values at times to 1e12 (the shared table), an integrator of order
 * 10 in long double, motions known by hand, scaling, relabelled axes. */
#include <stdlib.h>

#include "long_double.h"
#include "maths/attitude.h"
#include "scene/free/motion.h"
#include "rot_test.h"
#include "shared_table.h"

static rot_free_state at(const double moment[3], const double omega[3], double t) {
  rot_free_motion motion;
  rot_free_state out = {{NAN, NAN, NAN, NAN}, {NAN, NAN, NAN}, NAN, NAN};
  if (rot_free_begin(moment, omega, 0.0, &motion) == ROT_OK) {
    rot_free_at(&motion, (rot_dd){t, 0.0}, &out);
  }
  return out;
}

static double difference(const double x[3], const double y[3]) {
  return sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
              (x[2] - y[2]) * (x[2] - y[2]));
}

static double length(const double x[3]) { return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

/* I1..3, omega, t, omega(t), q. */
static void check_table(void) {
  FILE *table = shared_table("refs/free_rigid_body.csv");
  double x[14], worst = 0.0, worst_omega = 0.0;
  int rows = 0;
  if (!table) return;
  while (shared_row(table, 14, x)) {
    const rot_free_state s = at(x, x + 3, x[6]);
    const double off = rot_attitude_angle(s.q, x + 10), off_omega = difference(s.omega, x + 7);
    rows++;
    worst = fmax(worst, off);
    worst_omega = fmax(worst_omega, off_omega / length(x + 7));
    ROT_CHECK(off <= 4e-15 && off <= s.q_error);
    ROT_CHECK(off_omega <= s.omega_error || off_omega == 0.0);
    ROT_CHECK(s.q_error <= 2e-14);
  }
  printf("table: %d rows, attitude %.2e rad, omega %.2e\n", rows, worst, worst_omega);
  ROT_CHECK(rows == 175 && worst_omega <= 1e-15);
}

/* ---- another way: Gragg's midpoint rule, extrapolated, in long double ------------- */

enum { DIM = 7 };

static void rates(const double moment[3], const long double y[DIM], long double f[DIM]) {
  const long double *q = y, *w = y + 4;
  const long double a = moment[0], b = moment[1], c = moment[2];
  f[0] = (-q[1] * w[0] - q[2] * w[1] - q[3] * w[2]) / 2;
  f[1] = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
  f[2] = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
  f[3] = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
  f[4] = (b - c) / a * w[1] * w[2];
  f[5] = (c - a) / b * w[2] * w[0];
  f[6] = (a - b) / c * w[0] * w[1];
}

static void gragg(const double moment[3], long double h, long double y[DIM]) {
  enum { LEVELS = 5 };
  long double table[LEVELS][DIM], f[DIM];
  for (int k = 0; k < LEVELS; k++) {
    const int n = 2 * (k + 1);
    const long double step = h / n;
    long double before[DIM], now[DIM];
    rates(moment, y, f);
    for (int c = 0; c < DIM; c++) {
      before[c] = y[c];
      now[c] = y[c] + step * f[c];
    }
    for (int i = 1; i < n; i++) {
      rates(moment, now, f);
      for (int c = 0; c < DIM; c++) {
        const long double next = before[c] + 2 * step * f[c];
        before[c] = now[c];
        now[c] = next;
      }
    }
    rates(moment, now, f);
    for (int c = 0; c < DIM; c++) table[k][c] = (now[c] + before[c] + step * f[c]) / 2;
    for (int j = k - 1; j >= 0; j--) {
      const long double ratio = (long double)(k + 1) / (j + 1);
      for (int c = 0; c < DIM; c++) {
        table[j][c] = table[j + 1][c] + (table[j + 1][c] - table[j][c]) / (ratio * ratio - 1);
      }
    }
  }
  for (int c = 0; c < DIM; c++) y[c] = table[0][c];
}

static double draw(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

/* Both directions of time; q is continuous: it stays on the side of the integrator's. */
static void check_against_integration(void) {
  if (!long_double_is_longer("integration of free bodies")) return;
  uint64_t seed = 1;
  double worst = 0.0;
  for (int i = 0; i < 60; i++) {
    double moment[3], omega[3];
    for (int k = 0; k < 3; k++) {
      moment[k] = i % 3 == 1 && k ? moment[0] * (1.0 + 1e-9 * draw(&seed)) : 0.2 + draw(&seed);
      omega[k] = 2.0 * draw(&seed) - 1.0;
    }
    if (i % 4 == 0) moment[2] = moment[0] + moment[1]; /* a plate */
    if (i % 5 == 0) omega[i % 3] = 0.0;
    if (i % 7 == 0) omega[0] *= 1e-6, omega[2] *= 1e-6;
    long double y[DIM] = {1.0L, 0.0L, 0.0L, 0.0L, omega[0], omega[1], omega[2]};
    const double step = i % 2 ? -0.05 : 0.05;
    for (int k = 1; k <= 400; k++) {
      gragg(moment, step, y);
      if (k % 50) continue;
      const double q[4] = {(double)y[0], (double)y[1], (double)y[2], (double)y[3]};
      const double w[3] = {(double)y[4], (double)y[5], (double)y[6]};
      rot_free_motion motion;
      rot_free_state s;
      ROT_CHECK_EQ_INT(rot_free_begin(moment, omega, 0.0, &motion), ROT_OK);
      rot_free_at(&motion, rot_dd_mul2(step, k), &s);
      const double off = rot_attitude_angle(s.q, q);
      worst = fmax(worst, off);
      ROT_CHECK(off <= s.q_error && off <= 1e-14);
      ROT_CHECK(s.q[0] * q[0] + s.q[1] * q[1] + s.q[2] * q[2] + s.q[3] * q[3] > 0.99);
      ROT_CHECK(difference(s.omega, w) <= s.omega_error + 1e-18);
    }
  }
  printf("against integration: %.2e rad\n", worst);
}

/* ---- by hand --------------------------------------------------------------------------------- */

static void check_steady(void) {
  const double ball[3] = {2.0, 2.0, 2.0}, any[3] = {1.0, 2.0, 3.0}, w[3] = {0.3, -0.4, 1.2};
  for (double t = -1e3; t <= 1e3; t += 173.0) {
    const rot_free_state s = at(ball, w, t);
    ROT_CHECK(fabs(s.q[0] - cos(0.65 * t)) <= 4.0 * ROT_EPS * fabs(0.65 * t) + 1e-15);
    ROT_CHECK(s.omega[0] == w[0] && s.omega[1] == w[1] && s.omega[2] == w[2]);
    for (int k = 0; k < 3; k++) {
      const double one[3] = {k == 0 ? 0.7 : 0.0, k == 1 ? 0.7 : 0.0, k == 2 ? 0.7 : 0.0};
      const rot_free_state p = at(any, one, t); /* about each axis, the middle one, too */
      const double q[4] = {cos(0.35 * t), sin(0.35 * t) * (k == 0), sin(0.35 * t) * (k == 1),
                           sin(0.35 * t) * (k == 2)};
      ROT_CHECK(rot_attitude_angle(p.q, q) <= 4.0 * ROT_EPS * fabs(0.35 * t) + 1e-15);
    }
  }
  /* a rod: about any axis across it */
  const double rod[3] = {3.0, 3.0, 0.0}, across[3] = {0.3, 0.4, 0.0}, along[3] = {0.3, 0.4, 0.1};
  ROT_CHECK_REL(at(rod, across, 2.0).q[0], cos(0.5), 1e-15);
  rot_free_motion motion;
  ROT_CHECK_EQ_INT(rot_free_begin(rod, along, 0.0, &motion), ROT_EVALUE);
  const double rest[3] = {0.0, 0.0, 0.0};
  const rot_free_state s = at(any, rest, 1e300);
  ROT_CHECK(s.q[0] == 1.0 && s.q_error == 0.0 && s.omega[1] == 0.0);
}

/* I = (3, 3, 9): L moves in the body with -14/9 rad/s (ETH's lectures, Principia's test), and the
 * axis goes round L with L/I1. */
static void check_symmetric(void) {
  const double moment[3] = {3.0, 3.0, 9.0}, omega[3] = {0.0, 5.0 / 3.0, 7.0 / 9.0};
  for (double t = -40.0; t <= 40.0; t += 7.7) {
    const rot_free_state s = at(moment, omega, t);
    ROT_CHECK(fabs(3.0 * s.omega[0] - 5.0 * sin(-14.0 / 9.0 * t)) <= 2e-14);
    ROT_CHECK(fabs(3.0 * s.omega[1] - 5.0 * cos(-14.0 / 9.0 * t)) <= 2e-14);
    ROT_CHECK_ULP(s.omega[2], omega[2], 2);
    double axis[3];
    const double z[3] = {0.0, 0.0, 1.0}, l[3] = {0.0, 5.0, 7.0}, big = sqrt(74.0);
    rot_attitude_to_space(s.q, z, axis);
    /* along L constant; about it, from where it was, by L t/I1 */
    const double phi = big / 3.0 * t, height = 7.0 / big;
    const double away[3] = {0.0, -7.0 * 5.0 / 74.0, 1.0 - 49.0 / 74.0};
    const double side[3] = {(l[1] * away[2] - l[2] * away[1]) / big, 0.0, 0.0};
    for (int k = 0; k < 3; k++) {
      const double want = height * l[k] / big + away[k] * cos(phi) + side[k] * sin(phi);
      ROT_CHECK(fabs(axis[k] - want) <= 2e-14);
    }
  }
}

/* Moments apart by one ulp, and nearly steady: 1 - m1 = 1e-22 still turns u by 1e-13 in 1e12 s. The
 * quaternion by quadruple precision: bench/coverage/free.c. */
static void check_nearly_symmetric(void) {
  const double moment[3] = {0.25, 0.25000000000000006, 0.45}, omega[3] = {1e-3, 2e-3, 1.0};
  const double q[4] = {0.47588743873669842, -0.00048980200193787370, 0.00021440831921900783,
                       0.87950603168807018};
  ROT_CHECK(rot_attitude_angle(at(moment, omega, 1e12).q, q) <= 2e-15);
}

/* The separatrix: 2 T I2 = L^2 in numbers that are exact; w2 = tanh, the others sech. */
static void check_separatrix(void) {
  const double moment[3] = {1.0, 2.0, 3.0}, omega[3] = {3.0, 0.0, 1.7320508075688772};
  const double exact[3] = {0.5, 0.75, 1.0}, start[3] = {1.5, 0.0, 1.0};
  rot_free_motion motion;
  /* not quite: sqrt(3) is rounded */
  ROT_CHECK_EQ_INT(rot_free_begin(moment, omega, 0.0, &motion), ROT_OK);
  ROT_CHECK(motion.jacobi.m1 > 0.0 && motion.jacobi.m1 < 1e-15);
  /* I3 (I3 - I2) w3^2 = 0.25, I1 (I2 - I1) w1^2 = 0.28125: not on it */
  ROT_CHECK_EQ_INT(rot_free_begin(exact, start, 0.0, &motion), ROT_OK);
  ROT_CHECK(motion.jacobi.m1 > 1e-3);
  /* I = (1, 2, 4): 1 w1^2 = 8 w3^2 never in doubles; I = (1, 2, 3): w1^2 = 3 w3^2 neither.
   * I = (4, 5, 9): 4 w1^2 = 36 w3^2. */
  const double on[3] = {4.0, 5.0, 9.0}, w[3] = {3.0, 0.0, 1.0};
  ROT_CHECK_EQ_INT(rot_free_begin(on, w, 0.0, &motion), ROT_OK);
  ROT_CHECK(motion.jacobi.m1 == 0.0 && motion.m1_loss == 0.0 &&
            isinf(rot_free_half_period(&motion)));
  const double lambda = 2.0; /* w1' = -4/4 w2 w3, w2 = A tanh, A = 3 sqrt(20/20) */
  for (double t = -1e6; t <= 1e6; t += t > -40.0 && t < 40.0 ? 1.3 : 19999.0) {
    rot_free_state s;
    rot_free_at(&motion, (rot_dd){t, 0.0}, &s);
    double l[3], space[3];
    ROT_CHECK(fabs(s.omega[0] - 3.0 / cosh(lambda * t)) <= 1e-14 || lambda != motion.lambda.hi);
    for (int k = 0; k < 3; k++) l[k] = on[k] * s.omega[k];
    rot_attitude_to_space(s.q, l, space);
    ROT_CHECK(fabs(space[0] - 12.0) <= 4e-14 && fabs(space[1]) <= 4e-14 &&
              fabs(space[2] - 9.0) <= 4e-14);
    ROT_CHECK(s.q_error <= 1e-13);
    ROT_CHECK(fabs(s.omega[1]) <= 3.0 * (1.0 + 1e-15));
    if (t > 20.0) ROT_CHECK_REL(s.omega[1], 3.0, 1e-15);
  }
}

/* ---- invariances ----------------------------------------------------------------------------- */

/* Moments and rates times a power of two: the same attitude at the scaled time, to the last bit. */
static void check_scaling(void) {
  const double moment[3] = {1.0, 2.2, 2.9}, omega[3] = {0.3, -0.2, 1.0};
  const rot_free_state want = at(moment, omega, 37.0);
  for (int e = -500; e <= 500; e += 100) {
    double i[3], w[3];
    for (int k = 0; k < 3; k++) {
      i[k] = ldexp(moment[k], e);
      w[k] = ldexp(omega[k], -e / 2);
    }
    const rot_free_state s = at(i, w, ldexp(37.0, e / 2));
    ROT_CHECK(memcmp(s.q, want.q, sizeof s.q) == 0);
    ROT_CHECK(s.omega[1] == ldexp(want.omega[1], -e / 2));
  }
  const double big[3] = {1e150, 2e150, 3e150}, small[3] = {1e-300, 2e-300, 3e-300};
  const double fast[3] = {3e200, 2e200, 1e201};
  ROT_CHECK(isfinite(at(big, omega, 1e3).q[0]) && isfinite(at(small, omega, 1e3).q[0]));
  ROT_CHECK(isfinite(at(moment, fast, 1e-199).q[0]));
  const double far[3] = {1.0, 2.0, 1e120}, negative[3] = {1.0, 2.0, -1.0},
               none[3] = {1.0, NAN, 1.0};
  rot_free_motion motion;
  ROT_CHECK_EQ_INT(rot_free_begin(far, omega, 0.0, &motion), ROT_ERANGE);
  ROT_CHECK_EQ_INT(rot_free_begin(negative, omega, 0.0, &motion), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_free_begin(moment, none, 0.0, &motion), ROT_EVALUE);
  const double axis[3] = {1e-180, 0.0, 1.0};
  ROT_CHECK_REL(at(moment, axis, 2.0).q[0], cos(1.0), 1e-15);
}

/* However little disturbs the spin about the middle axis: in quadruple precision (the means of
 * bench/coverage/free.c). */
static void check_middle_axis(void) {
  static const struct {
    double moment[3], omega[3], t, q[4];
  } known[] = {
      {{1, 2, 3}, {1e-90, 1, 1e-90}, 700.0, {0.0, 0.72510003765074671, 0.0, -0.68864354741686629}},
      {{1, 2, 3},
       {1e-90, 1, 1e-90},
       12345.5,
       {0.0, -0.99903063930357305, 0.0, 0.044020242306171083}},
      {{1, 2.2, 2.9},
       {0, -1, 1e-300},
       5000.0,
       {0.019836361778492868, 0.0, 0.99980324001845122, 0.0}},
      {{1, 2, 3},
       {1e-80, 1, 0},
       1000.0,
       {-0.84702690329911223, 1.163722182224523e-09, 0.53155002124684037, 4.2880089062223128e-11}},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    const rot_free_state s = at(known[i].moment, known[i].omega, known[i].t);
    const double off = rot_attitude_angle(known[i].q, s.q);
    ROT_CHECK(off <= 3e-15);
    ROT_CHECK(s.q_error > 0.0 && s.q_error < 2e-14);
  }
  /* The time of a half turn grows by log(10)/lambda a decade, lambda = 1/sqrt(3). */
  double before = 0.0;
  for (int e = 20; e <= 600; e += 20) {
    const double moment[3] = {1, 2, 3};
    const double omega[3] = {e > 300 ? pow(10.0, 300.0 - e) : pow(10.0, -e), e > 300 ? 1e300 : 1.0,
                             0.0};
    rot_free_motion motion;
    ROT_CHECK_EQ_INT(rot_free_begin(moment, omega, 0.0, &motion), ROT_OK);
    const double half = rot_free_half_period(&motion) * omega[1];
    if (e > 20) ROT_CHECK_REL(half - before, 40.0 * log(10.0) * sqrt(3.0), 1e-11);
    before = half;
  }
}

/* Axes relabelled, and turned over: the components follow. */
static void check_axes(void) {
  const double moment[3] = {1.0, 2.2, 2.9}, omega[3] = {0.3, -0.2, 1.0}, t = 1234.5;
  static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const rot_free_state want = at(moment, omega, t);
  for (int n = 0; n < 6; n++) {
    const double side = n < 3 ? 1.0 : -1.0; /* axial vectors of a mirrored body */
    double i[3], w[3];
    for (int k = 0; k < 3; k++) {
      i[k] = moment[order[n][k]];
      w[k] = side * omega[order[n][k]];
    }
    const rot_free_state s = at(i, w, t);
    ROT_CHECK(fabs(s.q[0] - want.q[0]) <= 8.0 * ROT_EPS);
    for (int k = 0; k < 3; k++) {
      ROT_CHECK(fabs(s.q[1 + k] - side * want.q[1 + order[n][k]]) <= 8.0 * ROT_EPS);
      ROT_CHECK(fabs(s.omega[k] - side * want.omega[order[n][k]]) <= 8.0 * ROT_EPS);
    }
  }
}

/* Energy and L in space at 1e12 s, for 2000 bodies; the half period against their zeros. */
static void check_invariants(void) {
  uint64_t seed = 7;
  double worst = 0.0;
  for (int i = 0; i < 2000; i++) {
    double moment[3], omega[3], l0[3], l[3], space[3];
    for (int k = 0; k < 3; k++) {
      moment[k] = pow(10.0, 3.0 * draw(&seed));
      omega[k] = 2.0 * draw(&seed) - 1.0;
      l0[k] = moment[k] * omega[k];
    }
    const rot_free_state s = at(moment, omega, (i % 2 ? -1e12 : 1e12) * draw(&seed));
    double energy = 0.0, before = 0.0;
    for (int k = 0; k < 3; k++) {
      l[k] = moment[k] * s.omega[k];
      energy += moment[k] * s.omega[k] * s.omega[k];
      before += moment[k] * omega[k] * omega[k];
    }
    rot_attitude_to_space(s.q, l, space);
    worst = fmax(worst, difference(space, l0) / length(l0));
    ROT_CHECK(difference(space, l0) <= 4e-15 * length(l0));
    ROT_CHECK(fabs(energy - before) <= 8e-15 * before);
    rot_free_motion motion;
    ROT_CHECK_EQ_INT(rot_free_begin(moment, omega, 0.0, &motion), ROT_OK);
    const double half = rot_free_half_period(&motion);
    const int two = motion.order[1];
    rot_free_state next;
    rot_free_at(&motion, (rot_dd){half, 0.0}, &next);
    ROT_CHECK(fabs(next.omega[two] + omega[two]) <= 1e-13 * length(omega));
  }
  printf("L in space at 1e12: %.1e\n", worst);
}

int main(void) {
  check_table();
  check_against_integration();
  check_steady();
  check_symmetric();
  check_nearly_symmetric();
  check_separatrix();
  check_scaling();
  check_middle_axis();
  check_axes();
  check_invariants();
  return rot_test_report("free_motion");
}
