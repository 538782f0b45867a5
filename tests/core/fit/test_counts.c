/* The covariance for errors of counts, beside the mean over all zeros of the counter. */
#include "fit/counts.h"

#include <math.h>

#include "rot_test.h"

enum { N = 60, ZEROS = 20000 };

/* A counter of size d on a motion of `a_sample` counts a sample; weights of every third sample 2.
 * The variance of sum j e, j = 1/weight, against that over the zeros of the counter. */
static void steady(double a_sample, int weighed) {
  const double d = 0.05, unit = 0.02;
  double y[N], x[N], r[N], j[N], weight[N], sum = 0.0;
  size_t at[N];
  for (int i = 0; i < N; i++) {
    at[i] = (size_t)i;
    weight[i] = weighed && i % 3 == 0 ? 2.0 : 1.0;
    x[i] = d * (0.31 + a_sample * i);
    y[i] = d * floor(x[i] / d + 0.5);
    r[i] = (x[i] - y[i]) / unit / weight[i];
    j[i] = 1.0 / weight[i];
  }
  for (int k = 0; k < ZEROS; k++) {
    double e = 0.0;
    for (int i = 0; i < N; i++) {
      const double moved = x[i] / d + (k + 0.5) / ZEROS;
      e += j[i] * (floor(moved + 0.5) - moved) * d / (weight[i] * unit);
    }
    sum += e * e / ZEROS;
  }
  const rot_fit_counts counts = {N, 1, at, y, weighed ? weight : NULL, d, unit, r, j};
  const double none = 0.0, inverse = 1e-18;
  double variance = 0.0, wave = 0.0;
  ROT_CHECK(rot_fit_counts_rule(&counts));
  rot_fit_counts_covariance(&counts, &none, &inverse, &variance, &wave);
  /* Harmonics beyond the 32nd, 1.9 % of the variance of a sawtooth, are white here. */
  double white = 0.0;
  for (int i = 0; i < N; i++) white += j[i] * j[i] * d * d / 12.0 / pow(weight[i] * unit, 2);
  ROT_CHECK(fabs(variance - sum) < 0.019 * fmax(white, sum));
  /* In the inverse's units: no more than the whole. */
  ROT_CHECK(wave > 0.0 && wave <= inverse * inverse * variance * (1.0 + 1e-12));
}

/* A factor of the motion, off by a twentieth: the covariance of the motion there. An
 * error of it that moves the last sample by a fiftieth of a count moves the counts' errors. */
static void moved(void) {
  const double d = 0.05, unit = 0.02, inverse = 1.0, off = 0.05, none = 0.0;
  double y[N], r[N], beyond[N], j[N];
  size_t at[N];
  for (int i = 0; i < N; i++) {
    const double x = 0.2 * d * i;
    at[i] = (size_t)i;
    y[i] = d * floor(x / d + 0.5);
    j[i] = x / unit;
    r[i] = (x - y[i]) / unit;
    beyond[i] = y[i] + off * x;
  }
  const rot_fit_counts here = {N, 1, at, y, NULL, d, unit, r, j};
  rot_fit_counts there = here;
  there.y = beyond;
  double left = 0.0, direct = 0.0, unmoved = 0.0, wave = 0.0;
  rot_fit_counts_covariance(&here, &off, &inverse, &left, &wave);
  rot_fit_counts_covariance(&here, &none, &inverse, &unmoved, &wave);
  rot_fit_counts_covariance(&there, &none, &inverse, &direct, &wave);
  ROT_CHECK_REL(left, direct, 1e-9);
  ROT_CHECK(fabs(left / unmoved - 1.0) > 0.1);
  const double last = 0.2 * (N - 1), root[] = {0.0201 / last, 0.0199 / last};
  ROT_CHECK(rot_fit_counts_moved(&here, root) && !rot_fit_counts_moved(&here, root + 1));
}

/* Noise of half a count: errors of their own. */
static void noise(void) {
  const double d = 0.05;
  double y[N], r[N];
  size_t at[N];
  for (int i = 0; i < N; i++) {
    at[i] = (size_t)i;
    y[i] = d * i;
    r[i] = i % 2 ? 0.5 * d : -0.5 * d;
  }
  rot_fit_counts counts = {N, 1, at, y, NULL, d, 1.0, r, NULL};
  ROT_CHECK(!rot_fit_counts_rule(&counts));
  for (int i = 0; i < N; i++) r[i] *= 0.5;
  ROT_CHECK(rot_fit_counts_rule(&counts));
  counts.count = 0.0;
  ROT_CHECK(!rot_fit_counts_rule(&counts));
}

static void squares(void) {
  const double j[] = {1.0, 2.0, 3.0, -1.0};
  double to[] = {1.0, 0.0, 0.0, 0.0};
  rot_fit_squares(2, 2, 0.5, j, to);
  ROT_CHECK(to[0] == 6.0 && to[1] == -0.5 && to[2] == -0.5 && to[3] == 2.5);
}

int main(void) {
  steady(1.0, 0);
  steady(1.02, 0);
  steady(0.37, 0);
  steady(0.04, 1);
  steady(0.51, 1);
  noise();
  moved();
  squares();
  return rot_test_report("fit_counts");
}
