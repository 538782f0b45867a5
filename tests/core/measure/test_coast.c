/* The coast-down's motion against mpmath, its derivatives against differences. */
#include <stdlib.h>

#include "measure/coast.h"
#include "maths/drag.h"
#include "rot_test.h"

enum { P = ROT_COAST_PARAMETERS, ROWS = 12 };

static const rot_coast_load none = {0.0, 0.0, 0, 0, NULL, NULL};

static double uniform(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

/* The largest difference between the derivatives and central differences of the motion, relative to
 * the column's largest value. Rows next to a stop or a release, where the slope jumps, are not
 * compared. */
static double differences(const rot_coast_load *load, const double p[P], const double t[],
                          double part) {
  double theta[ROWS], omega[ROWS], x[ROWS * P], s[ROWS * P], worst = 0.0;
  if (rot_coast_rows(load, p, t[0], ROWS, t, theta, omega, x, s) != ROT_OK) return HUGE_VAL;
  for (int j = 0; j < P; j++) {
    const int fitted = j < ROT_COAST_LOAD || load->torque_ratio != 0.0;
    /* Below 0 the losses turn round: the motion has a kink at omega0 = 0. */
    if (!fitted || (j == ROT_COAST_OMEGA && p[j] == 0.0)) continue;
    double size = 0.0, change = 0.0, small = 0.0;
    for (int i = 0; i < ROWS; i++) {
      size = fmax(size, fmax(fabs(x[i * P + j]), fabs(s[i * P + j])));
      small = fmax(small, fmax(fabs(theta[i]), fabs(omega[i])));
    }
    if (size == 0.0) continue;
    /* A step that changes the motion by a part of itself; differences of order 4. */
    const double h = part * small / size;
    double d[4][2][ROWS];
    int alike = 1;
    static const double at[4] = {-2.0, -1.0, 1.0, 2.0};
    for (int k = 0; k < 4; k++) {
      double q[P];
      memcpy(q, p, sizeof q);
      q[j] += at[k] * h;
      if (rot_coast_rows(load, q, t[0], ROWS, t, d[k][0], d[k][1], NULL, NULL) != ROT_OK) alike = 0;
    }
    if (!alike) continue;
    for (int i = 0; i < ROWS; i++) {
      const int rests = omega[i] == 0.0;
      int smooth = 1;
      for (int k = 0; k < 4; k++) {
        if ((d[k][1][i] == 0.0) != rests || d[k][1][i] * omega[i] < 0.0) smooth = 0;
      }
      const double to = p[ROT_COAST_RELEASE];
      if (!smooth || (j == ROT_COAST_RELEASE && fabs(t[i] - to) <= 3.0 * h)) continue;
      for (int m = 0; m < 2; m++) {
        const double slope =
            (d[0][m][i] - 8.0 * d[1][m][i] + 8.0 * d[2][m][i] - d[3][m][i]) / (12.0 * h);
        change = fmax(change, fabs(slope - (m ? s : x)[i * P + j]));
      }
    }
    worst = fmax(worst, change / size);
  }
  return worst;
}

/* The better of two steps: a longer one reaches into what bends, a shorter one into rounding. */
static double worst_difference(const rot_coast_load *load, const double p[P], const double t[]) {
  const double d = differences(load, p, t, 3e-4);
  return d <= 1e-8 ? d : fmin(d, differences(load, p, t, 3e-5));
}

static void make_times(uint64_t *seed, double end, double t[]) {
  t[0] = 0.0;
  for (int i = 1; i < ROWS; i++) t[i] = end * (i - 0.8 * uniform(seed)) / (ROWS - 1);
}

/* Losses each at 0 in a third of the sets, all at 0, negative ones, stops inside. */
static void check_derivatives(void) {
  uint64_t seed = 15;
  double worst = 0.0;
  int stopped = 0;
  for (int trial = 0; trial < 10000; trial++) {
    double p[P] = {0}, t[ROWS], theta[ROWS], omega[ROWS];
    p[ROT_COAST_THETA] = 3.0 * uniform(&seed) - 1.0;
    p[ROT_COAST_OMEGA] = (trial % 2 ? -1.0 : 1.0) * (0.5 + 20.0 * uniform(&seed));
    for (int i = 0; i < 3; i++) {
      static const double size[3] = {3.0, 0.5, 0.05};
      const double x = uniform(&seed);
      p[ROT_COAST_COULOMB + i] = x < 0.33 ? 0.0 : size[i] * uniform(&seed);
      if (trial % 10 == 9 && i == trial / 10 % 3) p[ROT_COAST_COULOMB + i] *= -0.02;
    }
    if (trial % 100 == 0) memset(p + ROT_COAST_COULOMB, 0, 3 * sizeof(double));
    make_times(&seed, 12.0, t);
    const double d = worst_difference(&none, p, t);
    ROT_CHECK(rot_coast_rows(&none, p, 0.0, ROWS, t, theta, omega, NULL, NULL) == ROT_OK);
    stopped += omega[ROWS - 1] == 0.0;
    worst = fmax(worst, d);
    ROT_CHECK(d <= 1e-7);
  }
  ROT_CHECK(stopped > 2000);
  printf("derivatives: %.1e of the largest\n", worst);
}

/* A weight that unwinds until a time, then the coast-down, with the stop; a constant torque. */
static void check_load(void) {
  uint64_t seed = 4;
  double worst = 0.0;
  for (int trial = 0; trial < 3000; trial++) {
    const rot_coast_load load = {4.0 * uniform(&seed) - (trial % 4 == 3 ? 4.0 : 0.0),
                                 trial % 3 ? uniform(&seed) : 0.0,
                                 trial % 2,
                                 0,
                                 NULL,
                                 NULL};
    double p[P] = {0}, t[ROWS];
    p[ROT_COAST_OMEGA] = trial % 5 ? 3.0 * uniform(&seed) + 0.1 : 0.0;
    p[ROT_COAST_COULOMB] = 0.8 * uniform(&seed);
    p[ROT_COAST_VISCOUS] = 0.2 * uniform(&seed);
    p[ROT_COAST_QUADRATIC] = 0.02 * uniform(&seed);
    p[ROT_COAST_LOAD] = 0.7 + 0.6 * uniform(&seed);
    p[ROT_COAST_RELEASE] = 4.0 + uniform(&seed);
    if (fabs(load.torque_ratio * p[ROT_COAST_LOAD]) < 1.2 * p[ROT_COAST_COULOMB]) continue;
    make_times(&seed, 20.0, t);
    const double d = worst_difference(&load, p, t);
    worst = fmax(worst, d);
    ROT_CHECK(d <= 1e-7);
  }
  printf("derivatives with a load: %.1e\n", worst);
}

/* From a row to the next as from the start: the motion does not depend on the rows asked for. */
static void check_rows(void) {
  uint64_t seed = 7;
  for (int trial = 0; trial < 2000; trial++) {
    double p[P] = {0}, t[ROWS], theta[ROWS], omega[ROWS], one[2], last[2];
    p[ROT_COAST_OMEGA] = 20.0 * uniform(&seed);
    for (int i = 0; i < 3; i++) p[ROT_COAST_COULOMB + i] = uniform(&seed) / pow(10.0, i);
    if (trial % 4 == 0) p[ROT_COAST_VISCOUS] = -0.03;
    make_times(&seed, 10.0, t);
    const double *end = t + ROWS - 1;
    double x[ROWS * P], s[ROWS * P], x1[P], s1[P];
    ROT_CHECK(rot_coast_rows(&none, p, 0.0, ROWS, t, theta, omega, x, s) == ROT_OK);
    ROT_CHECK(rot_coast_rows(&none, p, 0.0, 1, end, one, last, x1, s1) == ROT_OK);
    ROT_CHECK(fabs(one[0] - theta[ROWS - 1]) <= 1e-14 * fabs(one[0]));
    ROT_CHECK(fabs(last[0] - omega[ROWS - 1]) <= 1e-14 * p[ROT_COAST_OMEGA]);
    for (int j = 0; j < P; j++) {
      const double want = x1[j], got = x[(ROWS - 1) * P + j];
      ROT_CHECK(fabs(got - want) <= 1e-11 * fabs(want));
    }
  }
}

/* The general flow, which negative losses take, against that of rot_drag, where both hold: a loss
 * of -1e-300 changes nothing but the way. */
static void check_directions(void) {
  uint64_t seed = 11;
  for (int trial = 0; trial < 2000; trial++) {
    double p[P] = {0}, q[P], t[ROWS], theta[ROWS], omega[ROWS], other[ROWS], rate[ROWS];
    p[ROT_COAST_OMEGA] = 20.0 * uniform(&seed);
    p[ROT_COAST_COULOMB] = trial % 3 ? uniform(&seed) : 0.0;
    p[ROT_COAST_QUADRATIC] = trial % 2 ? 0.02 * uniform(&seed) : 0.0;
    memcpy(q, p, sizeof q);
    q[ROT_COAST_VISCOUS] = -1e-300;
    make_times(&seed, 10.0, t);
    ROT_CHECK(rot_coast_rows(&none, p, 0.0, ROWS, t, theta, omega, NULL, NULL) == ROT_OK);
    ROT_CHECK(rot_coast_rows(&none, q, 0.0, ROWS, t, other, rate, NULL, NULL) == ROT_OK);
    for (int i = 0; i < ROWS; i++) {
      ROT_CHECK(fabs(other[i] - theta[i]) <= 2e-14 * theta[ROWS - 1]);
      ROT_CHECK(fabs(rate[i] - omega[i]) <= 2e-14 * p[ROT_COAST_OMEGA]);
    }
  }
}

/* Known by hand. Coulomb alone: omega = 4 - 2 t, at rest from t = 2 with theta = 4; there d theta/
 * d omega0 = omega0/a, d theta/d a = -omega0^2/(2 a^2). Negative omega is its mirror image. */
static void check_coulomb(void) {
  const double t[3] = {0.0, 1.0, 3.0};
  for (int side = -1; side <= 1; side += 2) {
    double p[P] = {0}, theta[3], omega[3], x[3 * P], s[3 * P];
    p[ROT_COAST_OMEGA] = side * 4.0;
    p[ROT_COAST_COULOMB] = 2.0;
    ROT_CHECK(rot_coast_rows(&none, p, 0.0, 3, t, theta, omega, x, s) == ROT_OK);
    ROT_CHECK(omega[1] == side * 2.0 && theta[1] == side * 3.0);
    ROT_CHECK(omega[2] == 0.0 && fabs(theta[2] - side * 4.0) < 1e-15);
    ROT_CHECK(fabs(x[2 * P + ROT_COAST_OMEGA] - 2.0) < 1e-14);
    ROT_CHECK(fabs(x[2 * P + ROT_COAST_COULOMB] + side * 2.0) < 1e-14);
    ROT_CHECK(s[2 * P + ROT_COAST_COULOMB] == 0.0 && s[2 * P + ROT_COAST_OMEGA] == 0.0);
  }
}

/* A weight: (I + m r^2) omega' = m g r - tau_c until 2 s, then I omega' = -tau_c. With T/I = 3,
 * J/I = 0.5, tau_c/I = 0.6: omega' = 2.4/1.5 = 1.6, then -0.6. */
static void check_weight(void) {
  const rot_coast_load load = {3.0, 0.5, 1, 0, NULL, NULL};
  const double t[3] = {0.0, 2.0, 4.0};
  double p[P] = {0}, theta[3], omega[3];
  p[ROT_COAST_COULOMB] = 0.6;
  p[ROT_COAST_LOAD] = 1.0;
  p[ROT_COAST_RELEASE] = 2.0;
  ROT_CHECK(rot_coast_rows(&load, p, 0.0, 3, t, theta, omega, NULL, NULL) == ROT_OK);
  ROT_CHECK(fabs(omega[1] - 3.2) < 1e-15 && fabs(theta[1] - 3.2) < 1e-15);
  ROT_CHECK(fabs(omega[2] - 2.0) < 1e-15 && fabs(theta[2] - 8.4) < 1e-14);
}

/* tau_c/I = 0.6 and T/I = 3 until 2 s, -1 until 7 s, then 0: omega' = 2.4, then -1.6 to the turn at
 * 5 s, then -0.4, then 0.6 to the stop 4/3 s later. */
static void check_steps(void) {
  const double step_s[3] = {0.0, 2.0, 7.0}, step_ratio[3] = {3.0, -1.0, 0.0};
  const rot_coast_load load = {0.0, 0.0, 0, 3, step_s, step_ratio};
  const double t[5] = {0.0, 2.0, 5.0, 7.0, 20.0};
  const double by_hand[5][2] = {
      {0.0, 0.0}, {4.8, 4.8}, {12.0, 0.0}, {11.2, -0.8}, {11.2 - 0.64 / 1.2, 0.0}};
  double p[P] = {0}, theta[5], omega[5];
  p[ROT_COAST_COULOMB] = 0.6;
  p[ROT_COAST_LOAD] = 1.0;
  p[ROT_COAST_RELEASE] = 21.0;
  ROT_CHECK(rot_coast_rows(&load, p, 0.0, 5, t, theta, omega, NULL, NULL) == ROT_OK);
  for (int i = 0; i < 5; i++) {
    ROT_CHECK(fabs(theta[i] - by_hand[i][0]) < 2e-14);
    ROT_CHECK(fabs(omega[i] - by_hand[i][1]) < 2e-14);
  }
  uint64_t seed = 11;
  for (int trial = 0; trial < 1000; trial++) {
    double q[P] = {0}, times[ROWS];
    q[ROT_COAST_OMEGA] = 3.0 * uniform(&seed) + 0.1;
    q[ROT_COAST_COULOMB] = 0.8 * uniform(&seed);
    q[ROT_COAST_VISCOUS] = 0.2 * uniform(&seed);
    q[ROT_COAST_QUADRATIC] = 0.02 * uniform(&seed);
    q[ROT_COAST_LOAD] = 1.0;
    q[ROT_COAST_RELEASE] = 30.0;
    make_times(&seed, 20.0, times);
    ROT_CHECK(worst_difference(&load, q, times) <= 1e-7);
  }
}

/* Losses that drive without bound are no motion; nothing at all is one. */
static void check_ends(void) {
  const double t[2] = {0.0, 100.0};
  double p[P] = {0}, theta[2], omega[2], x[2 * P], s[2 * P];
  ROT_CHECK(rot_coast_rows(&none, p, 0.0, 2, t, theta, omega, x, s) == ROT_OK);
  ROT_CHECK(theta[1] == 0.0 && omega[1] == 0.0);
  ROT_CHECK(fabs(x[P + ROT_COAST_OMEGA] - 100.0) < 1e-12);
  ROT_CHECK(fabs(x[P + ROT_COAST_COULOMB] + 5000.0) < 1e-10);
  p[ROT_COAST_OMEGA] = 1.0;
  p[ROT_COAST_QUADRATIC] = -1.0;
  ROT_CHECK(rot_coast_rows(&none, p, 0.0, 2, t, theta, omega, x, s) == ROT_ERANGE);
}

/* From rest under 2/s^2 less 0.5/s^2 of friction until 4 s, either way. */
static void check_start(void) {
  for (int side = -1; side <= 1; side += 2) {
    const rot_coast_load load = {2.0 * side, 0.0, 0, 0, NULL, NULL};
    const double t[] = {1.0, 4.0, 10.0, 20.0};
    double p[P] = {0}, theta[4], omega[4];
    p[ROT_COAST_COULOMB] = 0.5;
    p[ROT_COAST_LOAD] = 1.0;
    p[ROT_COAST_RELEASE] = 4.0;
    ROT_CHECK(rot_coast_rows(&load, p, 0.0, 4, t, theta, omega, NULL, NULL) == ROT_OK);
    ROT_CHECK_REL(side * omega[0], 1.5, 1e-15);
    ROT_CHECK_REL(side * omega[1], 6.0, 1e-15);
    ROT_CHECK_REL(side * omega[2], 3.0, 1e-15);
    ROT_CHECK(omega[3] == 0.0);
    ROT_CHECK_REL(side * theta[0], 0.75, 1e-15);
    ROT_CHECK_REL(side * theta[3], 12.0 + 36.0, 1e-15);
  }
}

int main(void) {
  check_coulomb();
  check_start();
  check_weight();
  check_steps();
  check_rows();
  check_directions();
  check_derivatives();
  check_load();
  check_ends();
  return rot_test_report("coast");
}
