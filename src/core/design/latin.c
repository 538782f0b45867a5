#include "design/latin.h"

#include <math.h>

void rot_permutation_begin(rot_permutation *p, uint64_t n, uint64_t seed, uint32_t column,
                           rot_stream stream) {
  int bits = 0;
  while (bits < 63 && (uint64_t)1 << bits < n) bits++;
  p->n = n;
  p->low = bits / 2;
  p->high = bits - bits / 2;
  for (uint32_t i = 0; i < ROT_PERMUTATION_ROUNDS; i += 2)
    rot_philox_row(seed, i, column, stream, p->key + i);
}

/* (half, key) => `bits` bits of a hash */
static inline uint64_t hash(uint64_t half, uint64_t key, int bits) {
  uint64_t x = (half ^ key) * 0x9E3779B97F4A7C15u;
  x = (x ^ x >> 32 ^ key) * 0xD6E8FEB86659FD93u;
  x ^= x >> 32;
  return x & (((uint64_t)1 << bits) - 1);
}

uint64_t rot_permutation_of(const rot_permutation *p, uint64_t i) {
  const int low = p->low, high = p->high;
  if (p->n < 2) return i;
  do {
    uint64_t a = i & (((uint64_t)1 << low) - 1), b = i >> low;
    for (int round = 0; round < ROT_PERMUTATION_ROUNDS; round += 2) {
      a ^= hash(b, p->key[round], low);
      b ^= hash(a, p->key[round + 1], high);
    }
    i = b << low | a;
  } while (i >= p->n);
  return i;
}

/* The place has as many bits as keep stratum + place exact; its last digit is 1/2, so that the
 * quotient by n stays inside of the stratum. */
void rot_latin_column(const rot_permutation *p, uint64_t first, size_t n, double u[]) {
  const int bits = p->low + p->high < 50 ? 50 - p->low - p->high : 0;
  const double scale = ldexp(1.0, bits), unit = ldexp(1.0, -bits), size = (double)p->n;
  for (size_t i = 0; i < n; i++) {
    const double place = (floor(u[i] * scale) + 0.5) * unit;
    u[i] = ((double)rot_permutation_of(p, first + i) + place) / size;
  }
}
