/* Buckets of doubles: known ones, limits, order, widths, counts against a sorted list. */
#include "rot_test.h"
#include "summary/buckets.h"
#include "summary_kit.h"

#include <float.h>

static void known_buckets(void) {
  static const struct {
    double x;
    int bucket;
  } row[] = {{0.0, 0},
             {-0.0, 0},
             {1.0, 256 * 1075},
             {1.0 + 0x1p-8, 256 * 1075 + 1},
             {1.0 + 0x1p-8 - 0x1p-52, 256 * 1075},
             {2.0 - 0x1p-52, 256 * 1075 + 255},
             {2.0, 256 * 1076},
             {0.75, 256 * 1074 + 128},
             {-3.0, -(256 * 1076 + 128)},
             {DBL_MIN, 256 * 53},
             {DBL_MAX, 256 * 2098 + 255},
             {-DBL_MAX, -(256 * 2098 + 255)},
             {0x1p-1074, 256},
             {0x3p-1074, 256 * 2 + 128},
             {DBL_MIN / 2, 256 * 52},
             {DBL_MIN - 0x1p-1074, 256 * 52 + 255}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    ROT_CHECK_EQ_INT(rot_bucket_of(row[i].x), row[i].bucket);
  }
}

/* Buckets adjoin: the double after the largest of one is the smallest of the next. */
static void limits(void) {
  double before = 0.0, low, high;
  long buckets = 0;
  for (int64_t b = 1; b < 256 * 2099; b++) {
    if (!rot_bucket_limits(b, &low, &high)) continue;
    buckets++;
    int ok = rot_bucket_of(low) == b && rot_bucket_of(high) == b && low <= high &&
             low == nextafter(before, INFINITY) && (high - low) * 256.0 < low;
    double minus_low, minus_high;
    ok = ok && rot_bucket_limits(-b, &minus_low, &minus_high) && minus_low == -high &&
         minus_high == -low && rot_bucket_of(-high) == -b;
    ROT_CHECK(ok);
    before = high;
  }
  ROT_CHECK(before == DBL_MAX);
  /* Those of 1 to 2^9 - 1 units are single numbers. */
  ROT_CHECK_EQ_INT(buckets, 511 + 256 * (2098 - 9));
  ROT_CHECK(rot_bucket_limits(0, &low, &high) && low == 0.0 && high == 0.0);
  static const int64_t none[] = {1,  255,     257,       256 * 2099,  INT64_MAX, INT64_MIN,
                                 -1, 640 + 1, INT32_MIN, -256 * 2099, INT32_MAX, (int64_t)1 << 32};
  for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
    ROT_CHECK(!rot_bucket_limits(none[i], &low, &high));
  }
}

static int by_size(const void *a, const void *b) {
  const int x = *(const int *)a, y = *(const int *)b;
  return (x > y) - (x < y);
}

/* Random bits, so all octaves; in pieces, twice with the same counter, then added. */
static void counts(void) {
  enum { N = 40000 };
  uint64_t state = 3;
  double *x = malloc(N * sizeof *x);
  int *bucket = malloc(N * sizeof *bucket);
  for (int i = 0; i < N; i++) {
    do {
      const uint64_t bits = kit_bits(&state) & (i % 3 ? UINT64_MAX : ~((uint64_t)0x7ff << 52));
      memcpy(&x[i], &bits, sizeof x[i]);
      if (i % 7 == 0) x[i] = i % 2 ? 0.0 : -0.0;
    } while (!isfinite(x[i]));
    bucket[i] = rot_bucket_of(x[i]);
  }
  rot_bucket_counter *counter = rot_bucket_counter_new();
  rot_buckets part[2], all;
  for (int k = 0; k < 2; k++) {
    const size_t first = k ? N / 3 : 0, n = k ? N - N / 3 : N / 3;
    ROT_CHECK_EQ_INT(rot_bucket_counter_add(counter, n / 2, x + first), ROT_OK);
    ROT_CHECK_EQ_INT(rot_bucket_counter_add(counter, n - n / 2, x + first + n / 2), ROT_OK);
    ROT_CHECK_EQ_INT(rot_bucket_counter_take(counter, &part[k]), ROT_OK);
  }
  rot_bucket_counter_free(counter);
  ROT_CHECK_EQ_INT(rot_buckets_add(&part[0], &part[1], &all), ROT_OK);
  qsort(bucket, N, sizeof *bucket, by_size);
  size_t at = 0;
  for (size_t i = 0; i < all.n; i++) {
    size_t n = 0;
    const size_t first = at;
    while (at < N && bucket[at] == bucket[first]) at++, n++;
    ROT_CHECK(all.at[i].bucket == bucket[first] && all.at[i].count == n);
  }
  ROT_CHECK_EQ_INT(at, N);
  for (int k = 0; k < 2; k++) rot_buckets_free(&part[k]);
  rot_buckets_free(&all);
  free(x);
  free(bucket);
}

int main(void) {
  known_buckets();
  limits();
  counts();
  return rot_test_report("buckets");
}
