#include "design/sobol.h"

#include <string.h>

#include "design/philox.h"
#include "ground/simd.h"
#ifdef ROT_SIMD_CAN
#include <immintrin.h>
#endif

static inline uint64_t swap_bits(uint64_t x, int by, uint64_t low) {
  return (x >> by & low) | (x & low) << by;
}

static inline uint64_t reversed(uint64_t x) {
  x = swap_bits(x, 1, 0x5555555555555555u);
  x = swap_bits(x, 2, 0x3333333333333333u);
  x = swap_bits(x, 4, 0x0F0F0F0F0F0F0F0Fu);
  x = swap_bits(x, 8, 0x00FF00FF00FF00FFu);
  x = swap_bits(x, 16, 0x0000FFFF0000FFFFu);
  return x >> 32 | x << 32;
}

/* Bit k of the result is bit k of x, changed or not by a hash of the bits below: a permutation that
 * is nested, as each of its steps is. The first term and the first odd factor alone, of 64 random
 * bits each, give any two points the joint distribution of Owen's scrambling, so means have its
 * variance; the other steps bring sums of many points near the normal law. */
static inline uint64_t one_round(const rot_sobol *s, int i, uint64_t x) {
  x = (x + s->add[i]) * s->odd[i];
  return x ^ x * s->even[i];
}

/* ROT_SOBOL_ROUNDS of them, written out: a loop takes a quarter longer. */
static inline uint64_t scramble(const rot_sobol *s, uint64_t x) {
  return one_round(s, 2, one_round(s, 1, one_round(s, 0, x)));
}

/* bits of a coordinate => coordinate in (0, 1): 52 bits behind the 1 of a number in [1, 2) */
static inline double coordinate(uint64_t bits) {
  double x;
  bits = bits >> 12 | 0x3FF0000000000000u;
  memcpy(&x, &bits, sizeof x);
  x -= 1.0;
  return x > 0x1p-53 ? x : 0x1p-53; /* one instruction */
}

/* Points `base` with each of n near ones => scrambled coordinates. */
static void scrambled(const rot_sobol *s, uint64_t base, const uint64_t near[], size_t n,
                      double u[]) {
  for (size_t k = 0; k < n; k++) u[k] = coordinate(reversed(scramble(s, base ^ near[k])));
}

#ifdef ROT_SIMD_CAN
#define ROT_LANES        __attribute__((target("avx2")))
#define ROT_LANES_INLINE static inline __attribute__((always_inline, target("avx2")))

typedef struct lanes {
  __m256i add, odd, odd_high, even, even_high;
} lanes;

ROT_LANES_INLINE lanes lanes_of(const rot_sobol *s, int i) {
  const __m256i odd = _mm256_set1_epi64x((long long)s->odd[i]);
  const __m256i even = _mm256_set1_epi64x((long long)s->even[i]);
  return (lanes){_mm256_set1_epi64x((long long)s->add[i]), odd, _mm256_srli_epi64(odd, 32), even,
                 _mm256_srli_epi64(even, 32)};
}

/* x times a number whose high halves are there, too: the low 64 bits. */
ROT_LANES_INLINE __m256i times(__m256i x, __m256i by, __m256i high) {
  const __m256i across =
      _mm256_add_epi64(_mm256_mul_epu32(x, high), _mm256_mul_epu32(_mm256_srli_epi64(x, 32), by));
  return _mm256_add_epi64(_mm256_mul_epu32(x, by), _mm256_slli_epi64(across, 32));
}

ROT_LANES_INLINE __m256i round_of_four(const lanes *l, __m256i x) {
  x = times(_mm256_add_epi64(x, l->add), l->odd, l->odd_high);
  return _mm256_xor_si256(x, times(x, l->even, l->even_high));
}

/* The same of four numbers at a time, in half the time: the bits of a byte turn round by two
 * look-ups of its halves. */
ROT_LANES static void scrambled_simd(const rot_sobol *s, uint64_t base, const uint64_t near[],
                                     size_t n, double u[]) {
  const __m256i half = _mm256_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15, 0, 8,
                                        4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
  const __m256i bytes = _mm256_setr_epi8(7, 6, 5, 4, 3, 2, 1, 0, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6,
                                         5, 4, 3, 2, 1, 0, 15, 14, 13, 12, 11, 10, 9, 8);
  const __m256i low = _mm256_set1_epi8(15), shifted = _mm256_slli_epi16(half, 4);
  const __m256i from = _mm256_set1_epi64x((long long)base);
  const lanes first = lanes_of(s, 0), second = lanes_of(s, 1), third = lanes_of(s, 2);
  size_t k = 0;
  for (; k + 4 <= n; k += 4) {
    __m256i x =
        _mm256_xor_si256(from, _mm256_loadu_si256((const __m256i *)(const void *)(near + k)));
    x = round_of_four(&third, round_of_four(&second, round_of_four(&first, x)));
    const __m256i high = _mm256_and_si256(_mm256_srli_epi16(x, 4), low);
    x = _mm256_or_si256(_mm256_shuffle_epi8(shifted, _mm256_and_si256(x, low)),
                        _mm256_shuffle_epi8(half, high));
    x = _mm256_srli_epi64(_mm256_shuffle_epi8(x, bytes), 12);
    x = _mm256_or_si256(x, _mm256_set1_epi64x(0x3FF0000000000000));
    const __m256d y = _mm256_sub_pd(_mm256_castsi256_pd(x), _mm256_set1_pd(1.0));
    _mm256_storeu_pd(u + k, _mm256_max_pd(y, _mm256_set1_pd(0x1p-53)));
  }
  _mm256_zeroupper(); /* gcc 12 leaves it out before this call: 5.5 ns a number for 3.5 */
  scrambled(s, base, near + k, n - k, u + k);
}
#endif

/* Direction numbers of a dimension, as bits of the coordinate times 2^64. */
static void directions(size_t dimension, uint64_t v[ROT_SOBOL_BITS]) {
  const rot_sobol_seed *seed = &rot_sobol_table[dimension];
  int degree = 0;
  while (seed->polynomial >> (degree + 1)) degree++;
  for (int i = 0; i < ROT_SOBOL_BITS; i++) {
    if (degree == 0) {
      v[i] = (uint64_t)1 << (63 - i);
    } else if (i < degree) {
      v[i] = (uint64_t)seed->number[i] << (63 - i);
    } else {
      v[i] = v[i - degree] ^ v[i - degree] >> degree;
      for (int j = 1; j < degree; j++)
        if (seed->polynomial >> (degree - j) & 1) v[i] ^= v[i - j];
    }
  }
}

void rot_sobol_begin(rot_sobol *s, size_t dimension, const uint64_t *seed) {
  directions(dimension, s->direction);
  s->scrambled = seed != NULL;
  for (int i = 0; i < ROT_SOBOL_BITS; i++) {
    if (s->scrambled) s->direction[i] = reversed(s->direction[i]);
  }
  s->near[0] = 0;
  for (uint64_t i = 1; i < ROT_SOBOL_NEAR; i++) {
    int lowest = 0;
    while (!(i >> lowest & 1)) lowest++;
    s->near[i] = s->near[i - 1] ^ s->direction[lowest];
  }
  for (uint32_t i = 0; i < ROT_SOBOL_ROUNDS; i++) {
    uint64_t words[4] = {0, 0, 0, 0};
    if (s->scrambled) {
      rot_philox_row(*seed, dimension, 2 * i, ROT_STREAM_SCRAMBLING, words);
      rot_philox_row(*seed, dimension, 2 * i + 1, ROT_STREAM_SCRAMBLING, words + 2);
    }
    s->add[i] = words[0];
    s->odd[i] = words[1] | 1;
    s->even[i] = words[2] & ~(uint64_t)1;
  }
}

/* Point i, by the Gray code of i. */
static uint64_t point(const rot_sobol *s, uint64_t i) {
  uint64_t x = 0;
  int bit = 0;
  for (uint64_t gray = i ^ i >> 1; gray && bit < ROT_SOBOL_BITS; gray >>= 1, bit++)
    if (gray & 1) x ^= s->direction[bit];
  return x;
}

/* Points are linear in their numbers over the field of two elements: point 64 q + k is the
 * exclusive-or of points 64 q and k. */
void rot_sobol_column(const rot_sobol *s, uint64_t first, size_t n, double u[]) {
#ifdef ROT_SIMD_CAN
  const int simd = n >= 4 && rot_simd_ok();
#endif
  for (size_t done = 0; done < n;) {
    const uint64_t at = first + done;
    const size_t skip = (size_t)(at % ROT_SOBOL_NEAR), left = ROT_SOBOL_NEAR - skip;
    const size_t m = n - done < left ? n - done : left;
    const uint64_t base = point(s, at - skip);
    const uint64_t *near = s->near + skip;
    if (s->scrambled) {
#ifdef ROT_SIMD_CAN
      if (simd) {
        scrambled_simd(s, base, near, m, u + done);
        done += m;
        continue;
      }
#endif
      scrambled(s, base, near, m, u + done);
    } else {
      for (size_t k = 0; k < m; k++) u[done + k] = coordinate(base ^ near[k]);
    }
    done += m;
  }
}
