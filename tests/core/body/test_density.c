#include "body/density.h"

#include "body/points.h"
#include "rot_test.h"

enum { MAX = 40000 };
static double x[MAX], y[MAX], z[MAX], w[MAX], mass[MAX];
static double t[3][512], v[3][512];

#define PI 3.14159265358979323846

typedef double density(double, double, double);

static double even(double a, double b, double c) {
  (void)a, (void)b, (void)c;
  return 1.0;
}

/* Moments of a density on a domain with n nodes a parameter, parameter `turn` (or -1) evenly
 * spaced. The weights are left with their power of two. */
static rot_moments moments(const rot_domain *domain, const size_t n[3], int turn, density *rho) {
  rot_rule rule[3];
  for (int k = 0; k < 3; k++) {
    ROT_CHECK_EQ_INT((long long)rot_rule_size(n[k]), (long long)n[k]);
    if (k == turn)
      rot_rule_even(n[k], t[k], v[k]);
    else
      ROT_CHECK_EQ_INT(rot_rule_gauss(n[k], t[k], v[k]), ROT_OK);
    rule[k] = (rot_rule){n[k], t[k], v[k]};
  }
  const size_t all = n[0] * n[1] * n[2];
  ROT_CHECK(all <= MAX);
  rot_density_nodes(domain, rule, 0, all, x, y, z, w);
  for (size_t i = 0; i < all; i++) mass[i] = w[i] * rho(x[i], y[i], z[i]);
  const rot_points points = {all, {mass, 1}, {{x, 1}, {y, 1}, {z, 1}}, rot_domain_exponent(domain)};
  rot_moments got;
  ROT_CHECK_EQ_INT(rot_points_moments(&points, NULL, &got), ROT_OK);
  return got;
}

/* ---- rules ---------------------------------------------------------------------------------- */

/* int t^k over [-1, 1] is 2/(k + 1) for even k up to 2 n - 1; every size that rot_rule_size() can
 * give, since GSL's own weights of other orders are good to ten digits only. */
static void check_rules(void) {
  size_t last = 0;
  for (size_t n = 1; n <= 500; n++) {
    const size_t size = rot_rule_size(n);
    ROT_CHECK(size >= n && size >= last && (n <= 96 ? size == n : size < n + 64));
    if (size == last) continue;
    last = size;
    ROT_CHECK_EQ_INT(rot_rule_gauss(size, t[0], v[0]), ROT_OK);
    for (int k = 0; k <= 2 * (int)(size <= 96 ? size : 64) - 1 && k < 60; k++) {
      double sum = 0.0;
      for (size_t i = 0; i < size; i++) sum += v[0][i] * pow(t[0][i], k);
      ROT_CHECK(fabs(sum - (k % 2 ? 0.0 : 2.0 / (k + 1))) <= 4e-15);
    }
  }
  /* exp: (e - 1/e); mpmath, 50 digits. */
  ROT_CHECK_EQ_INT(rot_rule_gauss(10, t[0], v[0]), ROT_OK);
  double sum = 0.0;
  for (int i = 0; i < 10; i++) sum += v[0][i] * exp(t[0][i]);
  ROT_CHECK_REL(sum, 2.3504023872876029138, 4e-16);
  /* A full turn: 1/(2 pi) int exp(cos) = I0(1) with 16 nodes; mpmath, 50 digits. */
  rot_rule_even(16, t[0], v[0]);
  sum = 0.0;
  for (int i = 0; i < 16; i++) sum += 0.5 * v[0][i] * exp(cos(PI * t[0][i]));
  ROT_CHECK_REL(sum, 1.2660658777520083356, 4e-16);
}

/* ---- domains -------------------------------------------------------------------------------- */

static void check_uniform(void) {
  const size_t n[3] = {4, 4, 6}, nc[3] = {4, 8, 4}, nb[3] = {4, 4, 8};
  /* Box 2 x 4 x 6: m (side^2)/12. */
  const rot_domain box = {ROT_DOMAIN_BOX, {-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}};
  rot_moments got = moments(&box, n, -1, even);
  ROT_CHECK_REL(got.mass, 48.0, 1e-15);
  ROT_CHECK_REL(got.c[0], 48.0 * 4.0 / 12.0, 1e-15);
  ROT_CHECK_REL(got.c[1], 48.0 * 16.0 / 12.0, 1e-15);
  ROT_CHECK_REL(got.c[2], 48.0 * 36.0 / 12.0, 1e-15);
  ROT_CHECK(fabs(got.c[3]) + fabs(got.c[4]) + fabs(got.c[5]) <= 1e-13);
  /* Tube, radii 2 and 3, height 5: int x^2 = M (R^2 + r^2)/4. */
  const rot_domain tube = {ROT_DOMAIN_CYLINDER, {2.0, -PI, -2.5}, {3.0, PI, 2.5}, {1.0, 1.0, 1.0}};
  got = moments(&tube, nc, 1, even);
  ROT_CHECK_REL(got.mass, 25.0 * PI, 1e-15);
  ROT_CHECK_REL(got.c[0], 25.0 * PI * 13.0 / 4.0, 1e-15);
  ROT_CHECK_REL(got.c[1], 25.0 * PI * 13.0 / 4.0, 1e-15);
  ROT_CHECK_REL(got.c[2], 25.0 * PI * 25.0 / 12.0, 1e-15);
  /* A quarter of a disk, radius 2: centre at 4 R/(3 pi) in x and y. */
  const rot_domain quarter = {
      ROT_DOMAIN_CYLINDER, {0.0, 0.0, -0.5}, {2.0, PI / 2.0, 0.5}, {1.0, 1.0, 1.0}};
  const size_t nq[3] = {3, 16, 2};
  got = moments(&quarter, nq, -1, even);
  ROT_CHECK_REL(got.mass, PI, 1e-15);
  ROT_CHECK_REL(got.centre[0], 8.0 / (3.0 * PI), 1e-15);
  ROT_CHECK_REL(got.centre[1], 8.0 / (3.0 * PI), 1e-15);
  /* int x y = R^4/8 less M g^2. */
  ROT_CHECK_REL(got.c[3], 2.0 - PI * 64.0 / (9.0 * PI * PI), 1e-14);
  /* Hollow ball, radii 1 and 3: int x^2 = 4 pi (R^5 - r^5)/15. */
  const rot_domain hollow = {ROT_DOMAIN_BALL, {1.0, -1.0, -PI}, {3.0, 1.0, PI}, {1.0, 1.0, 1.0}};
  got = moments(&hollow, nb, 2, even);
  ROT_CHECK_REL(got.mass, 4.0 / 3.0 * PI * 26.0, 1e-15);
  for (int k = 0; k < 3; k++) ROT_CHECK_REL(got.c[k], 4.0 * PI * 242.0 / 15.0, 2e-15);
  /* Ellipsoid 2, 3, 5: M a^2/5. */
  const rot_domain egg = {ROT_DOMAIN_BALL, {0.0, -1.0, -PI}, {1.0, 1.0, PI}, {2.0, 3.0, 5.0}};
  got = moments(&egg, nb, 2, even);
  ROT_CHECK_REL(got.mass, 40.0 * PI, 1e-15);
  ROT_CHECK_REL(got.c[0], 40.0 * PI * 4.0 / 5.0, 1e-15);
  ROT_CHECK_REL(got.c[1], 40.0 * PI * 9.0 / 5.0, 1e-15);
  ROT_CHECK_REL(got.c[2], 40.0 * PI * 25.0 / 5.0, 1e-15);
}

/* A shell of thickness 1e-13 radii: M = 4 pi R^2 d, int x^2 = M R^2/3. */
static void check_thin(void) {
  const size_t n[3] = {2, 4, 8};
  const double inner = 1.0 - 0x1p-43;
  const rot_domain shell = {ROT_DOMAIN_BALL, {inner, -1.0, -PI}, {1.0, 1.0, PI}, {1.0, 1.0, 1.0}};
  const rot_moments got = moments(&shell, n, 2, even);
  ROT_CHECK_REL(got.mass, 4.0 * PI * 0x1p-43, 1e-12);
  ROT_CHECK_REL(got.c[2] / got.mass, 1.0 / 3.0, 1e-12);
}

/* Sizes whose volume is no double: the weights are numbers near 1 all the same. */
static void check_sizes(void) {
  const size_t n[3] = {4, 4, 8};
  const double radius[2] = {0x1p-450, 0x1p400};
  for (int i = 0; i < 2; i++) {
    const double r = radius[i];
    const rot_domain ball = {ROT_DOMAIN_BALL, {0.0, -1.0, -PI}, {r, 1.0, PI}, {1.0, 1.0, 1.0}};
    const rot_domain egg = {ROT_DOMAIN_BALL, {0.0, -1.0, -PI}, {1.0, 1.0, PI}, {r, r, r}};
    const rot_domain *domain[2] = {&ball, &egg};
    for (int j = 0; j < 2; j++) {
      const int e = rot_domain_exponent(domain[j]);
      (void)moments(domain[j], n, 2, even);
      double volume = 0.0;
      for (int k = 0; k < 4 * 4 * 8; k++) volume += w[k];
      ROT_CHECK_REL(ldexp(volume, e - 3 * (i ? 400 : -450)), 4.0 / 3.0 * PI, 1e-15);
    }
  }
}

/* In pieces or at once: the same nodes. */
static void check_pieces(void) {
  const rot_domain egg = {ROT_DOMAIN_BALL, {0.0, -1.0, -PI}, {1.0, 1.0, PI}, {2.0, 3.0, 5.0}};
  const size_t n[3] = {5, 7, 9};
  (void)moments(&egg, n, 2, even);
  const rot_rule rule[3] = {{5, t[0], v[0]}, {7, t[1], v[1]}, {9, t[2], v[2]}};
  double a[100], b[100], c[100], d[100];
  rot_density_nodes(&egg, rule, 123, 100, a, b, c, d);
  ROT_CHECK(memcmp(a, x + 123, sizeof a) == 0 && memcmp(b, y + 123, sizeof b) == 0);
  ROT_CHECK(memcmp(c, z + 123, sizeof c) == 0 && memcmp(d, w + 123, sizeof d) == 0);
  ROT_CHECK_EQ_INT(rot_density_strata(&egg, 20, 3, 1, 0, 8000, x, y, z, w), ROT_OK);
  ROT_CHECK_EQ_INT(rot_density_strata(&egg, 20, 3, 1, 4090, 100, a, b, c, d), ROT_OK);
  ROT_CHECK(memcmp(a, x + 4090, sizeof a) == 0 && memcmp(d, w + 4090, sizeof d) == 0);
}

/* ---- random points -------------------------------------------------------------------------- */

/* One point in each cell; others with another seed or replicate; and the mean of x^2 of a box over
 * replicates as far off as its own spread says. */
static void check_strata(void) {
  enum { SIDE = 12, CELLS = SIDE * SIDE * SIDE, RUNS = 60 };
  const rot_domain box = {ROT_DOMAIN_BOX, {-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
  const int e = rot_domain_exponent(&box);
  static int seen[CELLS];
  double sum = 0.0, squares = 0.0, first[3] = {0};
  for (unsigned long run = 0; run < RUNS; run++) {
    double total = 0.0, volume = 0.0;
    ROT_CHECK_EQ_INT(rot_density_strata(&box, SIDE, 5, run, 0, CELLS, x, y, z, w), ROT_OK);
    memset(seen, 0, sizeof seen);
    for (int i = 0; i < CELLS; i++) {
      const int a = (int)floor((x[i] + 1.0) / 2.0 * SIDE),
                b = (int)floor((y[i] + 1.0) / 2.0 * SIDE),
                c = (int)floor((z[i] + 1.0) / 2.0 * SIDE);
      ROT_CHECK(a >= 0 && a < SIDE && b >= 0 && b < SIDE && c >= 0 && c < SIDE);
      seen[(a * SIDE + b) * SIDE + c]++;
      volume += ldexp(w[i], e);
      total += ldexp(w[i], e) * x[i] * x[i] * (1.0 + y[i]);
    }
    for (int i = 0; i < CELLS; i++) ROT_CHECK_EQ_INT(seen[i], 1);
    ROT_CHECK_REL(volume, 8.0, 1e-13);
    if (run < 3) first[run] = x[0];
    sum += total;
    squares += total * total;
  }
  ROT_CHECK(fabs(first[0] - first[1]) > 0.0 && fabs(first[1] - first[2]) > 0.0);
  const double mean = sum / RUNS, se = sqrt((squares / RUNS - mean * mean) / RUNS);
  ROT_CHECK(fabs(mean - 8.0 / 3.0) <= 4.0 * se);
  /* Random points anywhere: sd(8 x^2 (1 + y)) = sqrt(448/45), so 0.0098. Within a cell the density
   * hardly changes: seven times better. */
  const double plain = sqrt(448.0 / 45.0 / ((double)CELLS * RUNS));
  printf("strata: mean off by %.2g, standard error %.2g, of plain random points %.2g\n",
         mean - 8.0 / 3.0, se, plain);
  ROT_CHECK(se > plain / 12.0 && se < plain / 4.0);
  ROT_CHECK_EQ_INT(rot_density_strata(&box, SIDE, 6, 0, 0, CELLS, x, y, z, w), ROT_OK);
  ROT_CHECK(fabs(x[0] - first[0]) > 0.0);
}

/* ---- a density with structure --------------------------------------------------------------- */

static double sloped(double a, double b, double c) { return exp(a + 0.5 * b - 0.25 * c); }

/* exp(k . x) in a ball of radius 1.5, which no rule does exactly: the mass is
 * 4 pi (R k cosh(R k) - sinh(R k))/k^3 with k = |(1, 0.5, -0.25)|, the centre along k. Errors fall
 * from 128 nodes to 1024 as they should. mpmath, 50 digits. */
static void check_convergence(void) {
  const rot_domain ball = {ROT_DOMAIN_BALL, {0.0, -1.0, -PI}, {1.5, 1.0, PI}, {1.0, 1.0, 1.0}};
  const double mass_exact = 18.777275372498116306, centre = 0.41639691410162124857,
               cxx = 6.9667875177303063278, cxy = -0.4260060013071399704;
  const size_t n[4][3] = {{4, 4, 8}, {6, 6, 12}, {8, 8, 16}, {12, 12, 24}};
  const double max[] = {1e-4, 4e-9, 6e-14, 2e-15};
  for (int i = 0; i < 4; i++) {
    const rot_moments got = moments(&ball, n[i], 2, sloped);
    const double trace = got.c[0] + got.c[1] + got.c[2];
    ROT_CHECK_REL(got.mass, mass_exact, max[i]);
    ROT_CHECK_REL(got.centre[0], centre, 10.0 * max[i]);
    ROT_CHECK(fabs(got.c[0] - cxx) <= max[i] * trace);
    ROT_CHECK(fabs(got.c[3] - cxy) <= max[i] * trace);
    printf("%4d nodes: mass %.2g, second moment %.2g\n", (int)(n[i][0] * n[i][1] * n[i][2]),
           rot_test_rel(got.mass, mass_exact), fabs(got.c[0] - cxx) / trace);
  }
}

int main(void) {
  check_rules();
  check_uniform();
  check_thin();
  check_sizes();
  check_pieces();
  check_strata();
  check_convergence();
  return rot_test_report("density");
}
