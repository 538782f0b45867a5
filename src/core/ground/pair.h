/* Registers of two doubles, if the compiler has vector types. At -O2 it vectorises few loops
 * itself: 38 against 19 ns a row for the phi functions, 13 against 6 for the rolling table.
 *
 * A file that first defines ROT_SIMD gets registers of four (ground/simd.h); ROT_ALONE gives plain
 * doubles. All lanes use the same operations, so results do not depend on the width. In arithmetic
 * a number stands for a register with that number in all lanes. */
#ifndef ROT_PAIR_H
#define ROT_PAIR_H

#include <math.h>
#include <string.h>

#ifdef ROT_SIMD
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "ground/ieee.h"

#ifdef ROT_SIMD_FMA
#define ROT_TARGET __attribute__((target("avx2,fma")))
#elif defined(ROT_SIMD)
#define ROT_TARGET __attribute__((target("avx2")))
#else
#define ROT_TARGET
#endif

/* For kernels that are compiled once for each value of a flag. */
#ifdef __GNUC__
#define ROT_INLINE static inline __attribute__((always_inline)) ROT_TARGET
#else
#define ROT_INLINE static inline
#define ROT_ALONE
#endif

#ifdef ROT_SIMD
enum { ROT_PAIR = 4 };
#define ROT_BOTH(x) ((rot_pair){(x), (x), (x), (x)})
#elif defined(ROT_ALONE)
enum { ROT_PAIR = 1 };
#define ROT_BOTH(x) (x)
#else
enum { ROT_PAIR = 2 };
#define ROT_BOTH(x) ((rot_pair){(x), (x)})
#endif

#ifdef ROT_ALONE
typedef double rot_pair;
typedef unsigned long long rot_bits;
#else
typedef double rot_pair __attribute__((vector_size(ROT_PAIR * sizeof(double))));
typedef unsigned long long rot_bits __attribute__((vector_size(ROT_PAIR * sizeof(double))));
#endif

/* ROT_PAIR numbers from any address */
ROT_INLINE rot_pair rot_load(const double *x) {
  rot_pair pair;
  memcpy(&pair, x, sizeof pair);
  return pair;
}

ROT_INLINE void rot_store(double *x, rot_pair pair) { memcpy(x, &pair, sizeof pair); }

/* Bits of each lane as an integer, and back. */
ROT_INLINE rot_bits rot_bits_of(rot_pair pair) {
  rot_bits bits;
  memcpy(&bits, &pair, sizeof bits);
  return bits;
}

ROT_INLINE rot_pair rot_pair_of(rot_bits bits) {
  rot_pair pair;
  memcpy(&pair, &bits, sizeof pair);
  return pair;
}

/* The first lane: the result of a kernel that is called for one number. */
ROT_INLINE double rot_first(rot_pair pair) {
  double x;
  memcpy(&x, &pair, sizeof x);
  return x;
}

#ifdef ROT_ALONE
ROT_INLINE rot_pair rot_pair_sqrt(rot_pair x) { return sqrt(x); }
ROT_INLINE rot_pair rot_pair_abs(rot_pair x) { return fabs(x); }
ROT_INLINE rot_pair rot_pair_max(rot_pair x, rot_pair y) { return x > y ? x : y; }
ROT_INLINE rot_pair rot_pair_if_more(rot_pair p, rot_pair q, rot_pair x, rot_pair y) {
  return p > q ? x : y;
}
ROT_INLINE int rot_pair_count_more(rot_pair p, rot_pair q) { return p > q; }
#else

/* The compiler does not vectorise sqrt(), which may set errno. */
ROT_INLINE rot_pair rot_pair_sqrt(rot_pair x) {
#ifdef ROT_SIMD
  return _mm256_sqrt_pd(x);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(x);
#else
  return (rot_pair){sqrt(x[0]), sqrt(x[1])};
#endif
}

ROT_INLINE rot_pair rot_pair_abs(rot_pair x) {
  return rot_pair_of(rot_bits_of(x) & ~rot_bits_of(ROT_BOTH(-0.0)));
}

/* x where p > q, y elsewhere. */
ROT_INLINE rot_pair rot_pair_if_more(rot_pair p, rot_pair q, rot_pair x, rot_pair y) {
#ifdef ROT_SIMD
  return _mm256_blendv_pd(y, x, _mm256_cmp_pd(p, q, _CMP_GT_OQ));
#elif defined(__SSE2__)
  const __m128d is = _mm_cmpgt_pd(p, q);
  return _mm_or_pd(_mm_and_pd(is, x), _mm_andnot_pd(is, y));
#else
  const rot_bits is = (rot_bits)(p > q);
  return rot_pair_of((is & rot_bits_of(x)) | (~is & rot_bits_of(y)));
#endif
}

/* The larger of x and y; a NaN in x is ignored, a NaN in y is returned (maxpd). */
ROT_INLINE rot_pair rot_pair_max(rot_pair x, rot_pair y) {
#ifdef ROT_SIMD
  return _mm256_max_pd(x, y);
#elif defined(__SSE2__)
  return _mm_max_pd(x, y);
#else
  return rot_pair_if_more(x, y, x, y);
#endif
}

/* The number of lanes with p > q. */
ROT_INLINE int rot_pair_count_more(rot_pair p, rot_pair q) {
#ifdef ROT_SIMD
  const int bits = _mm256_movemask_pd(_mm256_cmp_pd(p, q, _CMP_GT_OQ));
  return (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1) + (bits >> 3);
#elif defined(__SSE2__)
  const int bits = _mm_movemask_pd(_mm_cmpgt_pd(p, q));
  return (bits & 1) + (bits >> 1);
#else
  return (p[0] > q[0]) + (p[1] > q[1]);
#endif
}
#endif

/* x where `is` > 0, y elsewhere. */
ROT_INLINE rot_pair rot_pair_if(rot_pair is, rot_pair x, rot_pair y) {
  return rot_pair_if_more(is, ROT_BOTH(0.0), x, y);
}

/* exp(-x) for 0 <= x <= 700, to 1 ulp. */
ROT_INLINE rot_pair rot_pair_decay(rot_pair x) {
  /* x = k log 2 - r, log 2 in two parts, the first with trailing zeros; then the Taylor series. */
  const rot_pair shifted = 0x1.8p52 - x * 0x1.71547652b82fep+0, k = shifted - 0x1.8p52;
  const rot_pair r = (0.0 - x - k * 0x1.62e42feep-1) - k * 0x1.a39ef35793c76p-33;
  const rot_pair r2 = r * r, r4 = r2 * r2;
  const rot_pair low = (1 / 2.0 + r * (1 / 6.0)) + r2 * (1 / 24.0 + r * (1 / 120.0));
  const rot_pair middle = (1 / 720.0 + r * (1 / 5040.0)) + r2 * (1 / 40320.0 + r * (1 / 362880.0));
  const rot_pair high =
      (1 / 3628800.0 + r * (1 / 39916800.0)) + r2 * (1 / 479001600.0 + r * (1 / 6227020800.0));
  const rot_pair e = 1.0 + (r + r2 * (low + r4 * (middle + r4 * high)));
  return rot_pair_of(rot_bits_of(e) + (rot_bits_of(shifted) << 52));
}

/* x => m, k with x = m 2^k and 1/sqrt(2) <= m < sqrt(2), for normal x > 0. The constant shifts the
 * bits so that the exponent changes at sqrt(2). */
ROT_INLINE rot_pair rot_pair_split(rot_pair x, rot_pair *k) {
  const unsigned long long one = 0x3ffULL << 52;
  const unsigned long long turn = 0x95f62ULL << 32; /* upper half of 1 minus that of 1/sqrt(2) */
  const rot_bits bits = rot_bits_of(x) + turn;
  *k = rot_pair_of((bits >> 52) | rot_bits_of(ROT_BOTH(0x1p52))) - (0x1p52 + 1023.0);
  return rot_pair_of((bits & ((1ULL << 52) - 1)) + (one - turn));
}

/* log(1 + x) for 0 <= x <= 1e300, to 2 ulp. */
ROT_INLINE rot_pair rot_pair_log1p(rot_pair x) {
  /* With f = m - 1 and s = f/(2 + f), log m = 2 atanh s = f - f^2/2 + s (f^2/2 + R(s^2)), R the
   * minimax polynomial of fdlibm's log(). The rounding error of 1 + x is added; for k = 0, f is
   * x. */
  const rot_pair none = ROT_BOTH(0.0), u = 1.0 + x;
  rot_pair k;
  const rot_pair m = rot_pair_split(u, &k);
  const rot_pair f = rot_pair_if(k, m - 1.0, x);
  const rot_pair lost = rot_pair_if_more(u, ROT_BOTH(2.0), 1.0 - (u - x), x - (u - 1.0));
  const rot_pair gone = rot_pair_if(k, lost / u, none);
  const rot_pair s = f / (2.0 + f), z = s * s, w = z * z, half = 0.5 * f * f;
  const rot_pair odd =
      3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01);
  const rot_pair even = 6.666666666666735130e-01 +
                        w * (2.857142874366239149e-01 +
                             w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01));
  const rot_pair rest = w * odd + z * even;
  return k * 6.93147180369123816490e-01 -
         ((half - (s * (half + rest) + (k * 1.90821492927058770002e-10 + gone))) - f);
}

#endif
