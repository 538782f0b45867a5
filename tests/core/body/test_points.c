#include "body/points.h"

#include <float.h>

#include "ground/real.h"
#include "rot_test.h"

static uint64_t seed = 11;
static int below(int n) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return (int)((seed >> 33) % (uint64_t)n);
}

static rot_points cloud(size_t n, const double m[], const double x[], const double y[],
                        const double z[]) {
  rot_points points = {n, {m, 1}, {{x, 1}, {y, 1}, {z, 1}}, 0};
  return points;
}

/* Every figure within the bound that comes with it, and the bound small. Returns the largest error
 * of the second moment relative to the trace. */
static double compare(const rot_moments *got, double mass, const double centre[3],
                      const double c[6], double max) {
  const double trace = c[0] + c[1] + c[2];
  double worst = 0.0;
  ROT_CHECK_REL(got->mass, mass, 2.0 * got->mass_error);
  for (int k = 0; k < 3; k++) {
    const double size = ldexp(fabs(centre[k]), -52); /* the reference is rounded, too */
    const double off = (got->centre[k] - centre[k]) + got->centre_lo[k];
    ROT_CHECK(fabs(off) <= got->centre_error + size);
  }
  for (int k = 0; k < 6; k++) worst = fmax(worst, fabs(got->c[k] - c[k]) / trace);
  if (!(trace > 0.0)) worst = 0.0;
  ROT_CHECK(worst <= got->error);
  ROT_CHECK(got->error <= max);
  return worst;
}

/* ---- clouds known to 20 digits --------------------------------------------------------------- */

/* mpmath, 700 digits, from the doubles as they stand. */
static const struct {
  const char *name;
  size_t n;
  double point[8][4]; /* mass, x, y, z */
  double mass, centre[3], c[6];
} known[] = {
    {"generic",
     5,
     {{1.5, 0.3, -1.2, 4.0},
      {2.25, -3.1, 0.7, 0.2},
      {0.4, 5.5, 6.25, -7.0},
      {3.0, 1.0, 2.0, 3.0},
      {0.0, 100.0, 0.0, 0.0}},
     7.1500000000000000222,
     {-0.18531468531468532731, 1.1573426573426573538, 1.769230769230769207},
     {36.611958041958043825, 21.310489510489510843, 48.30923076923077086, 15.860979020979022076,
      -3.6507692307692316726, -21.025384615384616082}},
    {"two points",
     2,
     {{2.0, 1.0, 0.0, 0.0}, {3.0, 2.0, 3.0, -1.0}},
     5.0,
     {1.6, 1.8, -0.6},
     {1.2, 10.8, 1.2, 3.6, -1.2, -3.6}},
    {"heavy spot, light point far off",
     4,
     {{1.0, 1.0, 0.0, 0.0},
      {2.0, 1.0000000074505806, 3.725290298461914e-09, 0.0},
      {1.0, 1.0, -7.450580596923828e-09, 1.4901161193847656e-08},
      {1e-20, -1.0, 0.5, 0.25}},
     4.0,
     {1.0000000037252902985, 1.2499999999999999314e-21, 3.7252902984625390625e-9},
     {5.5551151231406838631e-17, 8.3269226846886740532e-17, 1.6653407869375485461e-16,
      5.550115123123920057e-17, -5.5516151231192634441e-17, -1.1102105246253428049e-16}},
    {"spot below the rounding of the box",
     4,
     {{1.0, 1e-20, 0.0, 3e-20},
      {2.0, 2e-20, 1e-20, 0.0},
      {1.0, -3e-20, 2e-20, 1e-20},
      {1e-60, 1.0, -2.0, 0.5}},
     4.0,
     {4.9999999999999985973e-21, 9.9999999999999994515e-21, 1.000000000000000058e-20},
     {1.7000000000000001295e-39, 1.9999999999999997807e-40, 6.0000000000000011474e-40,
      -4.0000000000000000126e-40, -1.9999999999999995549e-40, -2.000000000000000232e-40}},
    {"masses 1e300 and 1e-300",
     2,
     {{1e+300, 0.1, 0.2, 0.3}, {1e-300, 1.1, 2.2, -0.7}},
     1.0000000000000000525e+300,
     {0.10000000000000000555, 0.2000000000000000111, 0.2999999999999999889},
     {1.0000000000000001916e-300, 4.0000000000000007664e-300, 9.9999999999999991404e-301,
      2.0000000000000003832e-300, -1.0000000000000000528e-300, -2.0000000000000001056e-300}},
    {"three bands",
     4,
     {{1e+200, 1e-50, 2e-50, 0.0},
      {1.0, 1.0, -2.0, 3.0},
      {2.0, 1.5, 1.0, 0.0},
      {1e-200, 1e+100, -3e+100, 2e+100}},
     9.9999999999999996973e+199,
     {1.0000000000000000076e-50, 2.0000000000000000152e-50, 3.0000000000000000908e-200},
     {6.5000000000000000139, 14.99999999999999896, 13.000000000000000056, -1.9999999999999998475,
      5.0000000000000000278, -11.999999999999999695}},
    {"coordinates of 1e150",
     3,
     {{1.0, 1e+150, 2e+150, -1e+150}, {2.0, -3e+150, 1e+150, 5e+149}, {0.5, 1e+149, 0.0, 4e+150}},
     3.5,
     {-1.4142857142857143615e+150, 1.1428571428571428352e+150, 5.7142857142857141762e+149},
     {1.2004285714285714988e+301, 1.4285714285714285167e+300, 8.3571428571428568225e+300,
      1.6571428571428571274e+300, -9.714285714285713537e+299, -3.2857142857142855883e+300}},
    {"coordinates of 1e-150",
     3,
     {{1.0, 1e-150, 2e-150, -1e-150}, {2.0, -3e-150, 1e-150, 5e-151}, {0.5, 1e-151, 0.0, 4e-150}},
     3.5,
     {-1.4142857142857143731e-150, 1.1428571428571428643e-150, 5.7142857142857143217e-151},
     {1.2004285714285715287e-299, 1.4285714285714285894e-300, 8.3571428571428572481e-300,
      1.6571428571428572064e-300, -9.7142857142857143305e-301, -3.2857142857142857557e-300}},
    {"large masses",
     2,
     {{1e+300, 0.001, 0.002, 0.0}, {3e+299, -0.001, 0.001, 0.005}},
     1.3000000000000000683e+300,
     {0.00053846153846153847275, 0.0017692307692307692676, 0.0011538461538461538702},
     {9.2307692307692316382e+293, 2.3076923076923079095e+293, 5.7692307692307697739e+294,
      4.6153846153846158191e+293, -2.3076923076923079095e+294, -1.1538461538461539548e+294}},
    {"small masses, far apart",
     2,
     {{1e-300, 1e+140, 2e+140, 0.0}, {3e-300, -1e+140, 1e+140, 5e+140}},
     4.000000000000000266e-300,
     {-5.0000000000000005036e+139, 1.2500000000000000637e+140, 3.7500000000000001155e+140},
     {3.0000000000000004723e-20, 7.5000000000000011808e-21, 1.8750000000000001365e-19,
      1.5000000000000002362e-20, -7.5000000000000008635e-20, -3.7500000000000004318e-20}},
    {"offset 1e8",
     8,
     {{5.0, 100000000.43408203, -100000000.8840332, 100000000.86230469},
      {4.0, 99999999.20727539, -100000000.37280273, 99999999.45263672},
      {6.0, 100000000.8762207, -100000000.01391602, 100000000.52294922},
      {9.0, 99999999.40771484, -100000000.00268555, 99999999.0522461},
      {4.0, 100000000.63256836, -99999999.88208008, 99999999.72827148},
      {7.0, 99999999.6381836, -100000000.71240234, 99999999.55493164},
      {8.0, 99999999.5065918, -100000000.4711914, 99999999.00708008},
      {1.0, 99999999.83764648, -100000000.1381836, 99999999.66333008}},
     44.0,
     {99999999.882141113281, -100000000.32822487571, 99999999.64198996804},
     {15.099306002259254456, 5.128044404766776345, 18.684146442196585915, 1.4874877035617828369,
      13.965663760900497437, -2.3057256557724692605}},
    {"two neighbours of 1",
     3,
     {{1.0, 1.0, 1.0, 1.0},
      {3.0, 1.0000000000000002, 1.0, 1.0},
      {1.0, 1.0, 1.0000000000000002, 0.9999999999999999}},
     5.0,
     {1.0000000000000001332, 1.0000000000000000444, 0.9999999999999999778},
     {5.9164567891575885406e-32, 3.9443045261050590271e-32, 9.8607613152626475676e-33,
      -2.9582283945787942703e-32, 1.4791141972893971351e-32, -1.9721522630525295135e-32}},
};

static void check_known(void) {
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    double column[4][8];
    rot_moments got;
    for (size_t j = 0; j < known[i].n; j++) {
      for (int k = 0; k < 4; k++) column[k][j] = known[i].point[j][k];
    }
    const rot_points points = cloud(known[i].n, column[0], column[1], column[2], column[3]);
    ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
    ROT_CHECK_EQ_INT(rot_moments_check(&got), ROT_OK);
    const double worst = compare(&got, known[i].mass, known[i].centre, known[i].c, 6e-15);
    printf("%-38s error %.2g, bound %.2g\n", known[i].name, worst, got.error);
  }
}

/* ---- any offset ------------------------------------------------------------------------------ */

/* Whole coordinates and masses: M^2 C = M sum m x x' - (sum m x)(sum m x)' in whole numbers. The
 * grid is fine enough to stay exact at every offset. */
static void check_offsets(void) {
  enum { N = 500 };
  static const double offsets[] = {0.0, 1.0, 1e4, 1e8, -1e10};
  const double grid = 0x1p-10;
  static int64_t m[N], p[3][N];
  static double mass[N], x[3][N];
  int64_t total = 0, first[3] = {0}, second[6] = {0};
  const int row[] = {0, 1, 2, 0, 0, 1}, col[] = {0, 1, 2, 1, 2, 2};
  for (int i = 0; i < N; i++) {
    m[i] = 1 + below(9);
    mass[i] = (double)m[i];
    total += m[i];
    for (int k = 0; k < 3; k++) {
      p[k][i] = below(2001) - 300 * k;
      first[k] += m[i] * p[k][i];
    }
    for (int k = 0; k < 6; k++) second[k] += m[i] * p[row[k]][i] * p[col[k]][i];
  }
  for (size_t o = 0; o < sizeof offsets / sizeof *offsets; o++) {
    double c[6], centre[3], worst;
    for (int k = 0; k < 6; k++) {
      const int64_t exact = total * second[k] - first[row[k]] * first[col[k]];
      c[k] = (double)exact / (double)total * grid * grid;
    }
    for (int k = 0; k < 3; k++) {
      const double offset = k == 1 ? -offsets[o] : offsets[o];
      for (int i = 0; i < N; i++) x[k][i] = offset + grid * (double)p[k][i];
      centre[k] = offset + grid * ((double)first[k] / (double)total);
    }
    const rot_points points = cloud(N, mass, x[0], x[1], x[2]);
    rot_moments got;
    ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
    worst = compare(&got, (double)total, centre, c, 1.2e-15);
    ROT_CHECK(worst <= 2e-16);
    printf("offset %8.2g: error %.2g, bound %.2g\n", offsets[o], worst, got.error);
  }
}

/* ---- many points ----------------------------------------------------------------------------- */

/* A million points on a line, k = 0 .. n-1 steps of a double that is not a round number: the second
 * moment of their places as they stand differs from n (n^2 - 1)/12 step^2 by rounding of the places
 * alone, so a power of two does for the step. Plain sums lose 1e-13 here. */
static void check_many(void) {
  enum { N = 1000000 };
  static double x[N], mass[1], zero[1];
  const double step = 0x1p-7, n = N;
  for (int i = 0; i < N; i++) x[i] = step * (double)i;
  mass[0] = 0.1;
  const rot_points points = {N, {mass, 0}, {{x, 1}, {zero, 0}, {zero, 0}}, 0};
  rot_moments got;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  const double want[6] = {0.1 * n * (n * n - 1.0) / 12.0 * step * step, 0, 0, 0, 0, 0};
  const double centre[3] = {step * (n - 1.0) / 2.0, 0.0, 0.0};
  compare(&got, 0.1 * n, centre, want, 1.2e-15);
  ROT_CHECK_REL(got.c[0], want[0], 5e-16);
}

/* ---- joining --------------------------------------------------------------------------------- */

/* A cloud cut in two and joined again is the cloud. */
static void check_join(void) {
  enum { N = 60 };
  static double m[N], x[3][N];
  for (int trial = 0; trial < 50; trial++) {
    const double offset = trial % 3 == 0 ? 1e6 : 0.0;
    for (int i = 0; i < N; i++) {
      m[i] = ldexp(1.0 + below(1000), -below(trial + 1));
      for (int k = 0; k < 3; k++) x[k][i] = offset + (double)below(4096) * 0x1p-10;
    }
    const rot_points all = cloud(N, m, x[0], x[1], x[2]);
    const rot_points left = cloud(20, m, x[0], x[1], x[2]);
    const rot_points right = cloud(N - 20, m + 20, x[0] + 20, x[1] + 20, x[2] + 20);
    rot_moments one, a, b, joined;
    ROT_CHECK_EQ_INT(rot_points_moments(&all, NULL, &one), ROT_OK);
    ROT_CHECK_EQ_INT(rot_points_moments(&left, NULL, &a), ROT_OK);
    ROT_CHECK_EQ_INT(rot_points_moments(&right, NULL, &b), ROT_OK);
    rot_moments_join(&a, &b, &joined);
    const double trace = one.c[0] + one.c[1] + one.c[2];
    for (int k = 0; k < 6; k++) {
      ROT_CHECK(fabs(joined.c[k] - one.c[k]) <= (joined.error + one.error) * trace);
    }
    for (int k = 0; k < 3; k++) {
      const double off =
          (joined.centre[k] - one.centre[k]) + (joined.centre_lo[k] - one.centre_lo[k]);
      ROT_CHECK(fabs(off) <= joined.centre_error + one.centre_error);
    }
    ROT_CHECK(joined.error <= 4e-15);
    rot_moments_join(&a, &b, &a); /* in place */
    ROT_CHECK(memcmp(&a.c, &joined.c, sizeof a.c) == 0);
  }
  /* Two points: 14 roundings, and hardly more in the bound. */
  const rot_moments here = {.mass = 1.0}, there = {.mass = 1.0, .centre = {0.3}};
  rot_moments pair;
  rot_moments_join(&here, &there, &pair);
  ROT_CHECK_REL(pair.c[0], 0.045, pair.error);
  ROT_CHECK(pair.error <= 16.0 * ROT_EPS);
  /* With nothing: the other, whichever side. */
  const rot_moments none = {0};
  rot_moments a = {.mass = 2.0, .centre = {1.0, 2.0, 3.0}, .c = {4.0, 5.0, 6.0, 1.0, 0.5, 0.2}},
              out;
  rot_moments_join(&a, &none, &out);
  ROT_CHECK(out.mass == 2.0 && out.centre[2] == 3.0 && out.c[3] == 1.0);
  rot_moments_join(&none, &a, &out);
  ROT_CHECK(out.mass == 2.0 && out.centre[2] == 3.0 && out.c[3] == 1.0);
}

/* ---- the ends -------------------------------------------------------------------------------- */

static void check_edges(void) {
  double m[2] = {3.0, 3.0}, x[2] = {0.1, 0.1}, y[2] = {1e8, 1e8}, z[2] = {-7.7, -7.7};
  rot_points points = cloud(2, m, x, y, z);
  rot_moments got;
  /* All in one place: no moment, and no error of it. */
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK(got.mass == 6.0 && got.centre[0] == 0.1 && got.centre[1] == 1e8);
  for (int k = 0; k < 6; k++) ROT_CHECK(got.c[k] == 0.0);
  ROT_CHECK(got.error == 0.0 && rot_moments_check(&got) == ROT_OK);
  /* No points. */
  points.n = 0;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK(got.mass == 0.0 && got.c[0] == 0.0);
  /* No mass: the plain mean, and no moment. */
  m[0] = m[1] = 0.0;
  x[1] = 0.3;
  points = cloud(2, m, x, y, z);
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK_REL(got.centre[0], 0.2, 1e-15);
  ROT_CHECK(got.mass == 0.0 && got.c[0] == 0.0 && rot_moments_check(&got) == ROT_OK);
  /* Beyond doubles: a span, a moment, a mass; one that is too small. */
  m[0] = m[1] = 1.0;
  x[0] = -1.7e308;
  x[1] = 1.7e308;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_ERANGE);
  x[0] = -1e160;
  x[1] = 1e160;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK_EQ_INT(rot_moments_check(&got), ROT_ERANGE);
  x[0] = -1e-160;
  x[1] = 1e-160;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK_EQ_INT(rot_moments_check(&got), ROT_ERANGE);
  m[0] = m[1] = 1.7e308;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK_EQ_INT(rot_moments_check(&got), ROT_ERANGE);
  /* Masses so far apart that they are added in two parts, and what is between them is too small. */
  m[0] = 0x1p-742;
  m[1] = 0x1p-259;
  x[0] = -0x1p-500;
  x[1] = 0x1p-500;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK_EQ_INT(rot_moments_check(&got), ROT_ERANGE);
  /* Masses with a power of two of their own: too small for a double, and not lost. */
  m[0] = m[1] = 0.75;
  x[0] = -0x1p600;
  x[1] = 0x1p600;
  points.mass_exponent = -1000;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  ROT_CHECK(got.mass == ldexp(1.5, -1000) && got.c[0] == ldexp(1.5, 200));
  /* Where the first bad value is. */
  int column;
  points = cloud(2, m, x, y, z);
  ROT_CHECK_EQ_INT((long long)rot_points_bad(&points, &column), 2);
  z[1] = NAN;
  ROT_CHECK_EQ_INT((long long)rot_points_bad(&points, &column), 1);
  ROT_CHECK_EQ_INT(column, 3);
  m[1] = -1.0;
  ROT_CHECK_EQ_INT((long long)rot_points_bad(&points, &column), 1);
  ROT_CHECK_EQ_INT(column, 0);
  y[0] = -INFINITY;
  ROT_CHECK_EQ_INT((long long)rot_points_bad(&points, &column), 0);
  ROT_CHECK_EQ_INT(column, 2);
  m[0] = NAN;
  ROT_CHECK_EQ_INT((long long)rot_points_bad(&points, &column), 0);
  ROT_CHECK_EQ_INT(column, 0);
}

static void check_reach(void) {
  const double m[3] = {1.0, 1.0, 0.0}, x[3] = {1e8, 1e8 + 2.0, 1e8}, y[3] = {0.0, 0.0, 4.0},
               z[3] = {0.0, 0.0, 8.0};
  const rot_points points = cloud(3, m, x, y, z);
  rot_moments got;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  const double reach = rot_points_reach(&points, &got);
  ROT_CHECK(reach >= 9.0); /* from (1e8 + 1, 0, 0) to the one without mass: (-1, 4, 8) */
  ROT_CHECK_REL(reach, 9.0, 1e-14);
}

static rot_status stop(void *ctx, double fraction) {
  double *last = ctx;
  ROT_CHECK(fraction >= *last);
  *last = fraction;
  return fraction > 0.5 ? ROT_EUNWIND : ROT_OK;
}

static void check_poll(void) {
  static double one[] = {1.0}, x[200000];
  double last = 0.0;
  for (int i = 0; i < 200000; i++) x[i] = (double)(i % 7);
  const rot_hooks hooks = {stop, &last};
  const rot_points points = {200000, {one, 0}, {{x, 1}, {one, 0}, {one, 0}}, 0};
  rot_moments got;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, &hooks, &got), ROT_EUNWIND);
}

int main(void) {
  check_known();
  check_offsets();
  check_many();
  check_join();
  check_edges();
  check_reach();
  check_poll();
  return rot_test_report("points");
}
