/* Philox against the known answers of its authors, rows by their numbers, ranges, independence. */
#include "design/philox.h"
#include "rot_test.h"

static void check_words(uint32_t counter, uint32_t key, const uint32_t want[4]) {
  const uint32_t c[4] = {counter, counter, counter, counter}, k[2] = {key, key};
  uint32_t out[4];
  rot_philox(c, k, out);
  for (int i = 0; i < 4; i++) ROT_CHECK_EQ_INT(out[i], want[i]);
}

/* The file kat_vectors of Random123. */
static void known_answers(void) {
  const uint32_t zero[4] = {0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u};
  const uint32_t ones[4] = {0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu};
  check_words(0, 0, zero);
  check_words(0xffffffffu, 0xffffffffu, ones);
  const uint32_t c[4] = {0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u};
  const uint32_t k[2] = {0xa4093822u, 0x299f31d0u};
  const uint32_t pi[4] = {0xd16cfe09u, 0x94fdcceb, 0x5001e420u, 0x24126ea1u};
  uint32_t out[4];
  rot_philox(c, k, out);
  for (int i = 0; i < 4; i++) ROT_CHECK_EQ_INT(out[i], pi[i]);
}

static void words_of_a_row(void) {
  const uint64_t seed = 0x299f31d0a4093822u, row = 0x85a308d3243f6a88u;
  const uint32_t c[4] = {0x243f6a88u, 0x85a308d3u, 77, ROT_STREAM_AUDIT};
  const uint32_t k[2] = {0xa4093822u, 0x299f31d0u};
  uint32_t want[4];
  uint64_t got[2];
  rot_philox(c, k, want);
  rot_philox_row(seed, row, 77, ROT_STREAM_AUDIT, got);
  ROT_CHECK(got[0] == ((uint64_t)want[1] << 32 | want[0]));
  ROT_CHECK(got[1] == ((uint64_t)want[3] << 32 | want[2]));
}

static void ends_of_the_range(void) {
  ROT_CHECK_ULP(rot_unit(0), 0x1p-53, 0);
  ROT_CHECK_ULP(rot_unit(0xfffu), 0x1p-53, 0);
  ROT_CHECK_ULP(rot_unit(0x1000u), 3 * 0x1p-53, 0);
  ROT_CHECK_ULP(rot_unit(UINT64_MAX), 1.0 - 0x1p-53, 0);
  ROT_CHECK_ULP(rot_unit((uint64_t)1 << 63), 0.5 + 0x1p-53, 0);
}

enum { N = 4096 };

static void columns_are_rows(void) {
  static double even[N], odd[N], alone[N];
  const uint64_t first = ((uint64_t)1 << 32) - 100, seed = (uint64_t)1 << 40;
  rot_philox_columns(seed, first, N, 3, ROT_STREAM_INPUTS, even, odd);
  for (uint64_t i = 0; i < N; i++) {
    uint64_t words[2];
    rot_philox_row(seed, first + i, 3, ROT_STREAM_INPUTS, words);
    ROT_CHECK_ULP(even[i], rot_unit(words[0]), 0);
    ROT_CHECK_ULP(odd[i], rot_unit(words[1]), 0);
  }
  rot_philox_columns(seed, first, N, 3, ROT_STREAM_INPUTS, NULL, alone);
  ROT_CHECK(!memcmp(odd, alone, sizeof odd));
  rot_philox_columns(seed, first, N, 3, ROT_STREAM_INPUTS, alone, NULL);
  ROT_CHECK(!memcmp(even, alone, sizeof even));
}

/* Sum of the products of two centred columns, in standard deviations. */
static double correlation(const double a[], const double b[]) {
  double sum = 0.0;
  for (int i = 0; i < N; i++) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return sum * 12.0 / sqrt(N);
}

/* Columns of other seeds, pairs, streams and halves of rows have nothing in common. */
static void independent(void) {
  static double x[7][N];
  const uint64_t high = (uint64_t)1 << 32;
  rot_philox_columns(5, 0, N, 0, ROT_STREAM_INPUTS, x[0], x[1]);
  rot_philox_columns(6, 0, N, 0, ROT_STREAM_INPUTS, x[2], NULL);
  rot_philox_columns(5 + high, 0, N, 0, ROT_STREAM_INPUTS, x[3], NULL);
  rot_philox_columns(5, high, N, 0, ROT_STREAM_INPUTS, x[4], NULL);
  rot_philox_columns(5, 0, N, 1, ROT_STREAM_INPUTS, x[5], NULL);
  rot_philox_columns(5, 0, N, 0, ROT_STREAM_CANARY, x[6], NULL);
  for (int a = 0; a < 7; a++) {
    double sum = 0.0;
    for (int i = 0; i < N; i++) sum += x[a][i] - 0.5;
    ROT_CHECK(fabs(sum) < 4.0 * sqrt(N / 12.0));
    ROT_CHECK(fabs(correlation(x[a], x[a]) - sqrt(N)) < 4.0); /* variance 1/12 */
    for (int b = 0; b < a; b++) ROT_CHECK(fabs(correlation(x[a], x[b])) < 4.0);
  }
}

int main(void) {
  known_answers();
  words_of_a_row();
  ends_of_the_range();
  columns_are_rows();
  independent();
  return rot_test_report("philox");
}
