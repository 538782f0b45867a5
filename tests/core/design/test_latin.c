/* Permutations: bijections, every permutation of a few numbers alike, and strata. */
#include "design/latin.h"
#include "rot_test.h"

enum { MAX = 70000 };

static void bijections(void) {
  static unsigned char seen[MAX];
  const uint64_t sizes[] = {1, 2, 3, 4, 5, 7, 8, 9, 1000, 1024, 1025, 65537};
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
    for (uint32_t column = 0; column < 4; column++) {
      rot_permutation p;
      int bad = 0;
      memset(seen, 0, sizeof seen);
      rot_permutation_begin(&p, sizes[k], 9, column, ROT_STREAM_PERMUTATIONS);
      for (uint64_t i = 0; i < sizes[k]; i++) {
        const uint64_t at = rot_permutation_of(&p, i);
        bad += at >= sizes[k] || seen[at]++;
      }
      ROT_CHECK(!bad);
    }
}

/* Each image of each number occurs alike, and each of the 24 orders of 4 numbers: chi^2. */
static void uniform(void) {
  enum { SEEDS = 24000 };
  static int count[1000], image[7][7];
  double chi2 = 0.0;
  for (uint64_t seed = 0; seed < SEEDS; seed++) {
    rot_permutation p;
    size_t code = 0;
    rot_permutation_begin(&p, 4, seed, 0, ROT_STREAM_PERMUTATIONS);
    for (uint64_t i = 0; i < 3; i++) code = code * 4 + (size_t)rot_permutation_of(&p, i);
    count[code]++;
    rot_permutation_begin(&p, 7, seed, 1, ROT_STREAM_PERMUTATIONS);
    for (uint64_t i = 0; i < 7; i++) image[i][rot_permutation_of(&p, i)]++;
  }
  for (int i = 0; i < 64; i++)
    if (count[i]) chi2 += (count[i] - SEEDS / 24.0) * (count[i] - SEEDS / 24.0) * 24.0 / SEEDS;
  ROT_CHECK(chi2 < 23.0 + 4.5 * sqrt(46.0));
  for (int i = 0; i < 7; i++)
    for (int j = 0; j < 7; j++)
      ROT_CHECK(fabs(image[i][j] - SEEDS / 7.0) < 4.5 * sqrt(SEEDS * 6.0 / 49.0));
}

/* Columns have no rank correlation; neighbours no order. */
static void independent(void) {
  enum { N = 1000 };
  for (uint64_t seed = 1; seed <= 50; seed++) {
    rot_permutation a, b;
    double sum = 0.0, next = 0.0;
    rot_permutation_begin(&a, N, seed, 0, ROT_STREAM_PERMUTATIONS);
    rot_permutation_begin(&b, N, seed, 1, ROT_STREAM_PERMUTATIONS);
    for (uint64_t i = 0; i < N; i++) {
      const double x = (double)rot_permutation_of(&a, i) - (N - 1) / 2.0;
      sum += x * ((double)rot_permutation_of(&b, i) - (N - 1) / 2.0);
      if (i + 1 < N) next += x * ((double)rot_permutation_of(&a, i + 1) - (N - 1) / 2.0);
    }
    ROT_CHECK(fabs(sum) < 4.5 * N * N * sqrt(N) / 12.0);
    ROT_CHECK(fabs(next) < 4.5 * N * N * sqrt(N) / 12.0);
  }
}

static void strata(void) {
  static double u[MAX];
  static unsigned char seen[MAX];
  const size_t sizes[] = {1, 7, 1000, 65537};
  for (size_t k = 0; k < 4; k++) {
    const size_t n = sizes[k];
    rot_permutation p;
    double place = 0.0;
    int bad = 0;
    memset(seen, 0, sizeof seen);
    rot_permutation_begin(&p, n, 5, 2, ROT_STREAM_PERMUTATIONS);
    rot_philox_columns(5, 0, n, 1, ROT_STREAM_INPUTS, u, NULL);
    rot_latin_column(&p, 0, n, u);
    for (size_t i = 0; i < n; i++) {
      const size_t at = (size_t)(u[i] * (double)n);
      bad += !(u[i] > 0.0 && u[i] < 1.0) || at >= n || seen[at]++;
      bad += at != rot_permutation_of(&p, i);
      place += u[i] * (double)n - (double)at - 0.5;
    }
    ROT_CHECK(!bad);
    ROT_CHECK(fabs(place) < 4.5 * sqrt((double)n / 12.0));
  }
}

/* Coordinates near the ends of a stratum stay in it, at any size. */
static void ends_of_strata(void) {
  const uint64_t sizes[] = {3, 1000, ((uint64_t)1 << 40) - 87, ((uint64_t)1 << 52)};
  for (size_t k = 0; k < 4; k++) {
    rot_permutation p;
    rot_permutation_begin(&p, sizes[k], 1, 0, ROT_STREAM_PERMUTATIONS);
    for (uint64_t i = 0; i < 3; i++) {
      const uint64_t row = sizes[k] - 1 - i;
      const double at = (double)rot_permutation_of(&p, row), size = (double)sizes[k];
      double low = 0x1p-53, high = 1.0 - 0x1p-53;
      rot_latin_column(&p, row, 1, &low);
      rot_latin_column(&p, row, 1, &high);
      ROT_CHECK(low > 0.0 && low >= at / size);
      ROT_CHECK(high < 1.0 && high <= (at + 1.0) / size);
      ROT_CHECK(sizes[k] > 1000 || high - low > 0.999 / size);
    }
  }
}

int main(void) {
  bijections();
  uniform();
  independent();
  strata();
  ends_of_strata();
  return rot_test_report("latin");
}
