/* Fits of coast-downs: exact data come back, noise is covered, bounds hold. */
#include <stdlib.h>

#include "measure/coast_fit.h"
#include "ground/gsl.h"
#include "rot_test.h"

enum { P = ROT_COAST_PARAMETERS, ALL = ROT_COAST_ALL, MAX = 400 };

static double uniform(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return ((double)(*state >> 11) + 0.5) * 0x1p-53;
}

static double normal(uint64_t *state) {
  const double r = sqrt(-2.0 * log(uniform(state)));
  return r * cos(6.283185307179586 * uniform(state));
}

typedef struct sample {
  double t[MAX], y[MAX];
  rot_coast_record record;
  int fitted[ALL];
} sample;

/* A record of n samples over `end` seconds. */
static void make(sample *s, rot_coast_kind kind, size_t n, double end, const double p[P],
                 double sigma, uint64_t *seed) {
  const rot_coast_load none = {0.0, 0.0, 0, 0, NULL, NULL};
  double theta[MAX], omega[MAX];
  static const int all[ALL] = {1, 1, 1, 1, 1};
  for (size_t i = 0; i < n; i++) s->t[i] = end * (double)i / (double)(n - 1);
  ROT_CHECK(rot_coast_rows(&none, p, 0.0, n, s->t, theta, omega, NULL, NULL) == ROT_OK);
  for (size_t i = 0; i < n; i++) {
    const double e = sigma * normal(seed);
    s->y[i] = kind == ROT_COAST_RATES ? omega[i] : theta[i];
    if (kind == ROT_COAST_PULSES) {
      s->t[i] += i > 0 ? e : 0.0; /* the angle of the pulse is exact, its time is not */
    } else {
      s->y[i] += e;
    }
  }
  memcpy(s->fitted, all, sizeof all);
  s->fitted[ROT_COAST_THETA] = kind != ROT_COAST_RATES;
  s->record = (rot_coast_record){kind, n, s->t, s->y, none, NULL};
}

static rot_coast_fit start_at(double omega0) {
  rot_coast_fit fit;
  memset(&fit, 0, sizeof fit);
  fit.p[ROT_COAST_OMEGA] = omega0;
  fit.p[ROT_COAST_LOAD] = 1.0;
  fit.reml.noise.white = 1.0;
  return fit;
}

/* Without noise: the parameters to within their error bars, which are those of rounding. */
static void check_exact(void) {
  uint64_t seed = 1;
  for (int kind = 0; kind < 3; kind++) {
    for (int stops = 0; stops < (kind == ROT_COAST_PULSES ? 1 : 2); stops++) {
      const double p[P] = {0.3, 20.0, 1.2, 0.1, 0.004, 1.0, 0.0};
      sample s;
      make(&s, (rot_coast_kind)kind, 200, stops ? 20.0 : 7.0, p, 0.0, &seed);
      rot_coast_fit fit = start_at(stops && kind == 0 ? 0.0 : 15.0); /* also from all zeros */
      ROT_CHECK(rot_coast_solve(&s.record, s.fitted, NULL, &fit) == ROT_OK);
      for (int j = ROT_COAST_OMEGA; j <= ROT_COAST_QUADRATIC; j++) {
        const double se = sqrt(fit.covariance[j][j]);
        ROT_CHECK(fabs(fit.p[j] - p[j]) <= 3.0 * se);
        ROT_CHECK(se <= 4e-12 * p[j]);
      }
    }
  }
}

/* White noise: in 200 records the errors in units of their standard errors have a mean square near
 * 1 (its own s.d. is 0.1). */
static void check_errors(void) {
  uint64_t seed = 5;
  static const double sigma[3] = {0.01, 0.02, 5e-4};
  for (int kind = 0; kind < 3; kind++) {
    double square[ALL] = {0};
    for (int trial = 0; trial < 200; trial++) {
      const double p[P] = {0.0, 20.0, 1.2, 0.1, 0.004, 1.0, 0.0};
      sample s;
      make(&s, (rot_coast_kind)kind, 100, 7.0, p, sigma[kind], &seed);
      rot_coast_fit fit = start_at(18.0);
      ROT_CHECK(rot_coast_solve(&s.record, s.fitted, NULL, &fit) == ROT_OK);
      ROT_CHECK(fabs(fit.sigma / sigma[kind] - 1.0) < 0.4);
      for (int j = ROT_COAST_COULOMB; j <= ROT_COAST_QUADRATIC; j++) {
        square[j] += pow(fit.p[j] - p[j], 2) / fit.covariance[j][j] / 200.0;
      }
    }
    for (int j = ROT_COAST_COULOMB; j <= ROT_COAST_QUADRATIC; j++) {
      ROT_CHECK(square[j] > 0.7 && square[j] < 1.4);
    }
  }
}

/* A true zero: half of the free fits are below it, none of the bounded ones; what is held is held,
 * and the other losses fit as well as they can: letting a held one go either way is no gain. */
static void check_bounds(void) {
  uint64_t seed = 8;
  int held = 0;
  for (int trial = 0; trial < 100; trial++) {
    const double p[P] = {0.0, 20.0, 1.2, 0.1, 0.0, 1.0, 0.0};
    sample s;
    int at_bound[3];
    make(&s, ROT_COAST_ANGLES, 100, 6.0, p, 0.01, &seed);
    rot_coast_fit fit = start_at(18.0);
    ROT_CHECK(rot_coast_solve(&s.record, s.fitted, NULL, &fit) == ROT_OK);
    const double k = fit.p[ROT_COAST_QUADRATIC], free_squares = fit.squares;
    ROT_CHECK(rot_coast_bound(&s.record, s.fitted, NULL, &fit, at_bound) == ROT_OK);
    for (int j = ROT_COAST_COULOMB; j <= ROT_COAST_QUADRATIC; j++) {
      ROT_CHECK(fit.p[j] >= 0.0);
      ROT_CHECK((fit.covariance[j][j] == 0.0) == (at_bound[j - ROT_COAST_COULOMB] != 0));
    }
    ROT_CHECK(fit.squares >= free_squares * (1.0 - 1e-9));
    if (k < 0.0 && at_bound[2] && !at_bound[0] && !at_bound[1]) held++;
    if (k >= 0.0 && !at_bound[0] && !at_bound[1]) ROT_CHECK(fit.squares == free_squares);
  }
  ROT_CHECK(held > 25 && held < 75);
}

/* A record that does not separate the losses: with two of them at 0 the third is far from where it
 * was without a bound. */
static void check_dependent(void) {
  uint64_t seed = 3;
  for (int trial = 0; trial < 100; trial++) {
    const double p[P] = {0.0, 19.7, 1.6e-3, 3.2e-4, 1.6e-6, 1.0, 0.0};
    sample s;
    int at_bound[3];
    make(&s, ROT_COAST_ANGLES, MAX, 30.0, p, 0.028, &seed);
    rot_coast_fit fit = start_at(19.0);
    ROT_CHECK(rot_coast_solve(&s.record, s.fitted, NULL, &fit) == ROT_OK);
    const double free_squares = fit.squares;
    ROT_CHECK(rot_coast_bound(&s.record, s.fitted, NULL, &fit, at_bound) == ROT_OK);
    /* No loss is larger than it were alone: 1.6e-3 + 3.2e-4 omega + 1.6e-6 omega^2. */
    ROT_CHECK(fit.p[ROT_COAST_QUADRATIC] < 5e-5);
    ROT_CHECK(fit.squares >= free_squares * (1.0 - 1e-9) && fit.squares < 1.1 * free_squares);
  }
}

/* Runout of the sensor, 0.02 rad once a turn: found, of that size; none where there is none. */
static void check_runout(void) {
  uint64_t seed = 13;
  int found = 0, wrong = 0;
  for (int trial = 0; trial < 60; trial++) {
    const double p[P] = {0.0, 12.0, 0.5, 0.1, 0.0, 1.0, 0.0};
    sample s;
    const int uneven = trial % 2;
    make(&s, ROT_COAST_ANGLES, 300, 6.0, p, 0.01, &seed);
    const rot_coast_load none = {0.0, 0.0, 0, 0, NULL, NULL};
    double theta[MAX], omega[MAX], residual[MAX];
    rot_coast_rows(&none, p, 0.0, 300, s.t, theta, omega, NULL, NULL);
    for (int i = 0; i < 300 && uneven; i++) s.y[i] += 0.02 * cos(theta[i] - 0.7);
    rot_coast_fit fit = start_at(10.0);
    ROT_CHECK(rot_coast_fit_noise(&s.record, s.fitted, 2.0, NULL, &fit, residual, NULL) == ROT_OK);
    ROT_CHECK(fit.runout_columns == 4);
    if (uneven) {
      found += fit.runout_f > 6.0 && fabs(fit.runout_size[0] - 0.02) < 0.006;
      for (int j = P; j < ALL; j++) s.fitted[j] = 1;
      ROT_CHECK(rot_coast_solve(&s.record, s.fitted, NULL, &fit) == ROT_OK);
      const double got = hypot(fit.p[P], fit.p[P + 1]);
      ROT_CHECK(fabs(got - 0.02) < 0.006);
    } else {
      wrong += fit.runout_f > 3.4; /* the 99 % point of F(4, 290) */
    }
  }
  ROT_CHECK(found >= 28);
  ROT_CHECK(wrong <= 3);
}

/* A weight that unwinds from a drum: I from the fit, where m g r is known. */
static void check_weight(void) {
  uint64_t seed = 17;
  const rot_coast_load load = {2.0, 0.1,  1,
                               0,   NULL, NULL}; /* of an inertia guessed 1.3 times too large */
  const double p[P] = {0.0, 0.0, 0.3, 0.02, 0.002, 1.3, 5.0};
  double theta[MAX], omega[MAX];
  sample s;
  make(&s, ROT_COAST_ANGLES, 300, 15.0, p, 0.0, &seed);
  ROT_CHECK(rot_coast_rows(&load, p, 0.0, 300, s.t, theta, omega, NULL, NULL) == ROT_OK);
  for (int i = 0; i < 300; i++) s.y[i] = theta[i] + 0.005 * normal(&seed);
  s.record.load = load;
  s.fitted[ROT_COAST_OMEGA] = 0;
  s.fitted[ROT_COAST_LOAD] = s.fitted[ROT_COAST_RELEASE] = 1;
  rot_coast_fit fit = start_at(0.0);
  fit.p[ROT_COAST_RELEASE] = 4.5;
  ROT_CHECK(rot_coast_solve(&s.record, s.fitted, NULL, &fit) == ROT_OK);
  for (int j = ROT_COAST_COULOMB; j <= ROT_COAST_RELEASE; j++) {
    ROT_CHECK(fabs(fit.p[j] - p[j]) < 4.0 * sqrt(fit.covariance[j][j]));
  }
  ROT_CHECK(sqrt(fit.covariance[ROT_COAST_LOAD][ROT_COAST_LOAD]) < 0.01);
  ROT_CHECK(fabs(fit.sigma - 0.005) < 0.001);
}

/* From starts that are far off, in a long run at many samples: a trust region that has become tiny
 * takes short steps, which is no minimum. */
static void check_far_starts(void) {
  enum { N = 300 };
  static double t[N], y[N], omega[N];
  const double p[P] = {0.0, 50.0, 0.005, 0.002, 1e-5, 1.0, 0.0};
  const rot_coast_load none = {0.0, 0.0, 0, 0, NULL, NULL};
  const int fitted[ALL] = {1, 1, 1, 1, 1};
  uint64_t seed = 23;
  for (int i = 0; i < N; i++) t[i] = 1000.0 * i / (N - 1);
  ROT_CHECK(rot_coast_rows(&none, p, 0.0, N, t, y, omega, NULL, NULL) == ROT_OK);
  for (int i = 0; i < N; i++) y[i] += 0.005 * normal(&seed);
  const rot_coast_record record = {ROT_COAST_ANGLES, N, t, y, none, NULL};
  int arrived = 0;
  for (int i = 0; i < 16; i++) {
    static const double fraction[4] = {0.05, 0.3, 2.0, 0.7};
    rot_coast_fit fit = start_at(50.0 * fraction[i % 4]);
    fit.p[ROT_COAST_COULOMB] = 0.05 * (i / 4 % 2);
    fit.p[ROT_COAST_VISCOUS] = i % 4 == 3 ? 0.02 : i < 8 ? 0.1 : 0.5;
    const rot_status status = rot_coast_solve(&record, fitted, NULL, &fit);
    const int right = status == ROT_OK && fabs(fit.sigma - 0.005) < 0.0005;
    ROT_CHECK(status != ROT_OK || right);
    arrived += right;
  }
  ROT_CHECK(arrived >= 4);
}

int main(void) {
  rot_gsl_begin();
  check_exact();
  check_errors();
  check_bounds();
  check_dependent();
  check_runout();
  check_weight();
  check_far_starts();
  return rot_test_report("coast_fit");
}
