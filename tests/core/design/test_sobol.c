/* Sobol's sequence against scipy 1.10.1, points by their numbers, and the properties of a scrambled
 * net. */
#include "design/sobol.h"
#include "ground/simd.h"
#include "rot_test.h"

/* Of each dimension a digest of the first 4096 points, h = 6364136223846793005 h + x + 1 of their
 * bits, and one of the 52 direction numbers, without the 1. From scipy.stats.qmc.Sobol(d = 64,
 * scramble = False, bits = 52). */
static const uint64_t reference[ROT_SOBOL_DIMENSIONS][2] = {
    {0x539375973616b000u, 0x947db1cb17939617u}, {0xd39375973616b000u, 0x34c1b3782fb8ebb5u},
    {0x539375973616b000u, 0xaa89c7ba71c2599bu}, {0xd39375973616b000u, 0x930ea06f912981e3u},
    {0xd39375973616b000u, 0x6e5f3176cdeb1981u}, {0xd39375973616b000u, 0x8d5123a5908fe4adu},
    {0xd39375973616b000u, 0x6e94b19fea8b3b83u}, {0x539375973616b000u, 0x27d4d98c60bd5057u},
    {0x539375973616b000u, 0x8e497dfb58e164c7u}, {0x539375973616b000u, 0xb3f1ed4ac275990fu},
    {0x539375973616b000u, 0x326db6cfd82c62f3u}, {0x539375973616b000u, 0x0186eb76ec8be6f3u},
    {0xd39375973616b000u, 0x0d4f6afeb8637e55u}, {0x539375973616b000u, 0x95a0fc863fe081dbu},
    {0x539375973616b000u, 0xdd8c65ca02c7e3a5u}, {0x539375973616b000u, 0x2c85be1dd63c254bu},
    {0xd39375973616b000u, 0x5db6b7136d84bfc5u}, {0x539375973616b000u, 0xc464c698c7e1844du},
    {0xd39375973616b000u, 0x4e6cd931e1c83263u}, {0xd39375973616b000u, 0xd77d2d6572211ea1u},
    {0x539375973616b000u, 0x13e43aeb228fbda1u}, {0xd39375973616b000u, 0xe221b42d22628e19u},
    {0x539375973616b000u, 0xb65adba28058b8c7u}, {0x539375973616b000u, 0xb0bae120095e9f73u},
    {0xd39375973616b000u, 0xc2708f72e704e327u}, {0x539375973616b000u, 0x6118db328fd2749fu},
    {0x539375973616b000u, 0x507ef3bf4527afcbu}, {0x539375973616b000u, 0x1ad09f52f8771959u},
    {0xd39375973616b000u, 0xa464b27690f1e64fu}, {0x539375973616b000u, 0xf72216346c39df53u},
    {0x539375973616b000u, 0x8f1c5c9ae7d29889u}, {0xd39375973616b000u, 0xce4689e32b40da17u},
    {0xd39375973616b000u, 0x227d606766533fd9u}, {0xd39375973616b000u, 0x389797abf007775du},
    {0x539375973616b000u, 0xfb22cb6d2b040cd3u}, {0x539375973616b000u, 0x435b46edf008ccd3u},
    {0x539375973616b000u, 0x29b9a70ff0d414efu}, {0xd39375973616b000u, 0xd86f0b483f31b8adu},
    {0xd39375973616b000u, 0x48184b16c33cfcd5u}, {0xd39375973616b000u, 0xbee99bf461980aa9u},
    {0xd39375973616b000u, 0x67946972054630d9u}, {0xd39375973616b000u, 0x32ce2fffa379e4b1u},
    {0x539375973616b000u, 0x4c93248cc97e766du}, {0x539375973616b000u, 0x8e0695c770b73c8fu},
    {0x539375973616b000u, 0x99b8d6e19781f9b7u}, {0x539375973616b000u, 0x0ec26631f81502b5u},
    {0x539375973616b000u, 0x6ddf010733b1bc79u}, {0xd39375973616b000u, 0xcf35c167d6a65609u},
    {0xd39375973616b000u, 0x63a874b6a5a5c0a7u}, {0x539375973616b000u, 0x0a155841cfab0145u},
    {0x539375973616b000u, 0xd81c5e689d9c183du}, {0x539375973616b000u, 0x423a3323b351468fu},
    {0xd39375973616b000u, 0xbbd626e920d99173u}, {0xd39375973616b000u, 0x29e0e6a3b9d1a6d5u},
    {0xd39375973616b000u, 0xb2ed478cf0aff6dbu}, {0x539375973616b000u, 0x0f398a973a71ac39u},
    {0x539375973616b000u, 0xe198ae4ac37d78b1u}, {0x539375973616b000u, 0x4b1ecff10ee05e9du},
    {0x539375973616b000u, 0x92f4da6ec86da8c7u}, {0x539375973616b000u, 0x2746529bee6cc987u},
    {0x539375973616b000u, 0x913b008bed4bd23du}, {0x539375973616b000u, 0x995458fcc5285441u},
    {0x539375973616b000u, 0x750666455e13f079u}, {0xd39375973616b000u, 0xd742350865e70851u},
};

enum { N = 1 << 16 };
static double u[N], v[N];

/* coordinate => its 52 bits; 2^-53 stands for 0 */
static uint64_t bits_of(double x) { return (uint64_t)(x * 0x1p52); }

static void equal_to_scipy(void) {
  for (size_t d = 0; d < ROT_SOBOL_DIMENSIONS; d++) {
    rot_sobol s;
    uint64_t points = 0, directions = 0;
    rot_sobol_begin(&s, d, NULL);
    rot_sobol_column(&s, 0, 4096, u);
    for (int i = 0; i < 4096; i++) points = points * 6364136223846793005u + bits_of(u[i]) + 1;
    ROT_CHECK(points == reference[d][0]);
    /* The Gray code of 2^k - 1 is 2^(k - 1): the point is a direction number. */
    for (int k = 1; k <= ROT_SOBOL_BITS; k++) {
      rot_sobol_column(&s, ((uint64_t)1 << k) - 1, 1, v);
      directions = directions * 6364136223846793005u + bits_of(v[0]);
    }
    ROT_CHECK(directions == reference[d][1]);
  }
}

static void first_points(void) {
  const double third[8] = {0x1p-53, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375};
  rot_sobol s;
  rot_sobol_begin(&s, 2, NULL);
  rot_sobol_column(&s, 0, 8, u);
  for (int i = 0; i < 8; i++) ROT_CHECK_ULP(u[i], third[i], 0);
}

/* Registers of four change no bit, whatever the first point and the length. */
static void registers(void) {
  const uint64_t seed = 5;
  rot_sobol s;
  rot_sobol_begin(&s, 3, &seed);
  for (size_t first = 0; first < 200; first += 7) {
    const size_t n = 1000 + first;
    rot_sobol_column(&s, first, n, u);
    rot_simd_allow(0);
    rot_sobol_column(&s, first, n, v);
    rot_simd_allow(1);
    ROT_CHECK(memcmp(u, v, n * sizeof *u) == 0);
  }
}

/* The last of 2^52 points, too. */
static void points_by_number(void) {
  const uint64_t seed = 11,
                 starts[] = {0, 1, 63, 64, 65, (uint64_t)1 << 31, ((uint64_t)1 << 52) - N};
  for (size_t d = 0; d < ROT_SOBOL_DIMENSIONS; d += 9)
    for (int scrambled = 0; scrambled < 2; scrambled++) {
      rot_sobol s;
      rot_sobol_begin(&s, d, scrambled ? &seed : NULL);
      for (size_t k = 0; k < sizeof starts / sizeof *starts; k++) {
        rot_sobol_column(&s, starts[k], N, u);
        for (size_t i = 0; i < N; i += 1 + i / 8) {
          double one[3];
          const size_t n = N - i < 3 ? N - i : 3;
          rot_sobol_column(&s, starts[k] + i, n, one);
          ROT_CHECK(!memcmp(one, u + i, n * sizeof *one));
        }
      }
    }
}

/* One of 2^k points in each interval of length 2^-k. */
static int one_in_each(const double x[], int k) {
  static unsigned char seen[N];
  memset(seen, 0, sizeof seen);
  for (size_t i = 0; i < (size_t)1 << k; i++) {
    if (!(x[i] > 0.0 && x[i] < 1.0)) return 0;
    if (seen[(size_t)ldexp(x[i], k)]++) return 0;
  }
  return 1;
}

static void scrambled_nets_in_one_dimension(void) {
  const uint64_t seeds[] = {0, 1, 42, (uint64_t)1 << 31, ((uint64_t)1 << 53) - 1};
  for (size_t d = 0; d < ROT_SOBOL_DIMENSIONS; d++)
    for (size_t j = 0; j < sizeof seeds / sizeof *seeds; j++) {
      rot_sobol s;
      rot_sobol_begin(&s, d, &seeds[j]);
      rot_sobol_column(&s, 0, N, u);
      for (int k = 0; k <= 16; k++) ROT_CHECK(one_in_each(u, k));
      rot_sobol_column(&s, (uint64_t)N * 12345, N, u);
      ROT_CHECK(one_in_each(u, 16));
    }
}

/* The first two dimensions: one of 2^10 points in each rectangle of area 2^-10. */
static void scrambled_nets_in_two_dimensions(void) {
  for (uint64_t seed = 1; seed <= 20; seed++) {
    rot_sobol s[2];
    for (size_t d = 0; d < 2; d++) rot_sobol_begin(&s[d], d, &seed);
    rot_sobol_column(&s[0], 1024 * seed, 1024, u);
    rot_sobol_column(&s[1], 1024 * seed, 1024, v);
    for (int k = 0; k <= 10; k++) {
      unsigned char seen[1024] = {0};
      int twice = 0;
      for (int i = 0; i < 1024; i++)
        twice += seen[((size_t)ldexp(u[i], k) << (10 - k)) + (size_t)ldexp(v[i], 10 - k)]++;
      ROT_CHECK(!twice);
    }
  }
}

/* Means of 1024 points of 1000 seeds: the variance of Owen's scrambling of one dimension, 1/(12
 * n^3), and a fourth moment not far from the normal law's. Sums of the product of two dimensions:
 * no correlation. */
static void variance_of_a_mean(void) {
  enum { SEEDS = 1000, POINTS = 1024 };
  double second = 0.0, fourth = 0.0, first = 0.0, mixed = 0.0;
  for (uint64_t seed = 1; seed <= SEEDS; seed++) {
    double mean[2];
    for (size_t d = 0; d < 2; d++) {
      rot_sobol s;
      rot_sobol_begin(&s, 7 + d, &seed);
      rot_sobol_column(&s, 0, POINTS, u);
      mean[d] = -0.5 * POINTS;
      for (int i = 0; i < POINTS; i++) mean[d] += u[i];
      mean[d] *= sqrt(12.0 * POINTS);
    }
    first += mean[0];
    second += mean[0] * mean[0];
    fourth += pow(mean[0], 4);
    mixed += mean[0] * mean[1];
  }
  ROT_CHECK(fabs(first) < 4.0 * sqrt(SEEDS));
  ROT_CHECK(fabs(second / SEEDS - 1.0) < 4.0 * sqrt(2.0 / SEEDS));
  ROT_CHECK(fourth / SEEDS > 2.3 && fourth / SEEDS < 4.0);
  ROT_CHECK(fabs(mixed) < 4.0 * sqrt(SEEDS));
}

/* Seeds that differ in one bit, and dimensions, have scramblings of their own. */
static void seeds_differ(void) {
  const uint64_t seed = 3;
  rot_sobol s;
  rot_sobol_begin(&s, 0, &seed);
  rot_sobol_column(&s, 0, 64, u);
  for (int bit = 0; bit < 53; bit++) {
    const uint64_t other = seed ^ (uint64_t)1 << bit;
    int same = 0;
    rot_sobol_begin(&s, 0, &other);
    rot_sobol_column(&s, 0, 64, v);
    for (int i = 0; i < 64; i++) same += bits_of(u[i]) >> 36 == bits_of(v[i]) >> 36;
    ROT_CHECK(same < 8);
  }
}

/* Golden values: a scrambling never changes. */
static void scrambled_values(void) {
  const uint64_t seed = 42;
  rot_sobol s;
  uint64_t h = 0;
  for (size_t d = 0; d < ROT_SOBOL_DIMENSIONS; d++) {
    rot_sobol_begin(&s, d, &seed);
    rot_sobol_column(&s, 1000, 256, u);
    for (int i = 0; i < 256; i++) h = h * 6364136223846793005u + bits_of(u[i]) + 1;
  }
  if (h != 0x3ebc6618123217d0u)
    printf("digest of scrambled points: 0x%016llx\n", (unsigned long long)h);
  ROT_CHECK(h == 0x3ebc6618123217d0u);
}

int main(void) {
  equal_to_scipy();
  first_points();
  registers();
  points_by_number();
  scrambled_nets_in_one_dimension();
  scrambled_nets_in_two_dimensions();
  variance_of_a_mean();
  seeds_differ();
  scrambled_values();
  return rot_test_report("sobol");
}
