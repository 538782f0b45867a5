/* Names of steps and constants are those of the specification: Y. Collet, "xxHash fast digest
 * algorithm". */
#include "ground/hash.h"

#include <stdint.h>
#include <stdio.h>

#define PRIME32_1 0x9E3779B1u
#define PRIME32_2 0x85EBCA77u
#define PRIME32_3 0xC2B2AE3Du
#define PRIME64_1 0x9E3779B185EBCA87u
#define PRIME64_2 0xC2B2AE3D27D4EB4Fu
#define PRIME64_3 0x165667B19E3779F9u
#define PRIME64_4 0x85EBCA77C2B2AE63u
#define PRIME64_5 0x27D4EB2F165667C5u
#define PRIME_MX1 0x165667919E3779F9u
#define PRIME_MX2 0x9FB21C651E98DF25u

enum { SECRET = 192, STRIPE = 64, STRIPES = (SECRET - STRIPE) / 8, BLOCK = STRIPES * STRIPE };

static const unsigned char secret[SECRET] = {
    0xb8, 0xfe, 0x6c, 0x39, 0x23, 0xa4, 0x4b, 0xbe, 0x7c, 0x01, 0x81, 0x2c, 0xf7, 0x21, 0xad, 0x1c,
    0xde, 0xd4, 0x6d, 0xe9, 0x83, 0x90, 0x97, 0xdb, 0x72, 0x40, 0xa4, 0xa4, 0xb7, 0xb3, 0x67, 0x1f,
    0xcb, 0x79, 0xe6, 0x4e, 0xcc, 0xc0, 0xe5, 0x78, 0x82, 0x5a, 0xd0, 0x7d, 0xcc, 0xff, 0x72, 0x21,
    0xb8, 0x08, 0x46, 0x74, 0xf7, 0x43, 0x24, 0x8e, 0xe0, 0x35, 0x90, 0xe6, 0x81, 0x3a, 0x26, 0x4c,
    0x3c, 0x28, 0x52, 0xbb, 0x91, 0xc3, 0x00, 0xcb, 0x88, 0xd0, 0x65, 0x8b, 0x1b, 0x53, 0x2e, 0xa3,
    0x71, 0x64, 0x48, 0x97, 0xa2, 0x0d, 0xf9, 0x4e, 0x38, 0x19, 0xef, 0x46, 0xa9, 0xde, 0xac, 0xd8,
    0xa8, 0xfa, 0x76, 0x3f, 0xe3, 0x9c, 0x34, 0x3f, 0xf9, 0xdc, 0xbb, 0xc7, 0xc7, 0x0b, 0x4f, 0x1d,
    0x8a, 0x51, 0xe0, 0x4b, 0xcd, 0xb4, 0x59, 0x31, 0xc8, 0x9f, 0x7e, 0xc9, 0xd9, 0x78, 0x73, 0x64,
    0xea, 0xc5, 0xac, 0x83, 0x34, 0xd3, 0xeb, 0xc3, 0xc5, 0x81, 0xa0, 0xff, 0xfa, 0x13, 0x63, 0xeb,
    0x17, 0x0d, 0xdd, 0x51, 0xb7, 0xf0, 0xda, 0x49, 0xd3, 0x16, 0x55, 0x26, 0x29, 0xd4, 0x68, 0x9e,
    0x2b, 0x16, 0xbe, 0x58, 0x7d, 0x47, 0xa1, 0xfc, 0x8f, 0xf8, 0xb8, 0xd1, 0x7a, 0xd0, 0x31, 0xce,
    0x45, 0xcb, 0x3a, 0x8f, 0x95, 0x16, 0x04, 0x28, 0xaf, 0xd7, 0xfb, 0xca, 0xbb, 0x4b, 0x40, 0x7e};

typedef struct u128 {
  uint64_t low, high;
} u128;

static uint64_t read32(const unsigned char *p) {
  return (uint64_t)p[0] | (uint64_t)p[1] << 8 | (uint64_t)p[2] << 16 | (uint64_t)p[3] << 24;
}

static uint64_t read64(const unsigned char *p) { return read32(p) | read32(p + 4) << 32; }

static uint64_t swap32(uint64_t x) {
  return (x & 0xff) << 24 | (x & 0xff00) << 8 | (x >> 8 & 0xff00) | (x >> 24 & 0xff);
}

static uint64_t swap64(uint64_t x) { return swap32(x & 0xffffffffu) << 32 | swap32(x >> 32); }

static u128 multiply(uint64_t a, uint64_t b) {
  const uint64_t half = 0xffffffffu;
  const uint64_t ll = (a & half) * (b & half), lh = (a & half) * (b >> 32);
  const uint64_t hl = (a >> 32) * (b & half), hh = (a >> 32) * (b >> 32);
  const uint64_t middle = (ll >> 32) + (lh & half) + hl;
  const u128 product = {middle << 32 | (ll & half), hh + (lh >> 32) + (middle >> 32)};
  return product;
}

static uint64_t fold(uint64_t a, uint64_t b) {
  const u128 product = multiply(a, b);
  return product.low ^ product.high;
}

static uint64_t avalanche(uint64_t x) {
  x = (x ^ x >> 37) * PRIME_MX1;
  return x ^ x >> 32;
}

static uint64_t avalanche_xxh64(uint64_t x) {
  x = (x ^ x >> 33) * PRIME64_2;
  x = (x ^ x >> 29) * PRIME64_3;
  return x ^ x >> 32;
}

static u128 hash_1_to_3(const unsigned char *in, size_t n) {
  const uint64_t combined =
      (uint64_t)in[n - 1] | (uint64_t)n << 8 | (uint64_t)in[0] << 16 | (uint64_t)in[n >> 1] << 24;
  const uint64_t swapped = swap32(combined);
  const uint64_t turned = (swapped << 13 | swapped >> 19) & 0xffffffffu;
  const u128 hash = {avalanche_xxh64((read32(secret) ^ read32(secret + 4)) ^ combined),
                     avalanche_xxh64((read32(secret + 8) ^ read32(secret + 12)) ^ turned)};
  return hash;
}

static u128 hash_4_to_8(const unsigned char *in, size_t n) {
  const uint64_t combined = read32(in) | read32(in + n - 4) << 32;
  const uint64_t value = (read64(secret + 16) ^ read64(secret + 24)) ^ combined;
  u128 hash = multiply(value, PRIME64_1 + ((uint64_t)n << 2));
  hash.high += hash.low << 1;
  hash.low ^= hash.high >> 3;
  hash.low = (hash.low ^ hash.low >> 35) * PRIME_MX2;
  hash.low ^= hash.low >> 28;
  hash.high = avalanche(hash.high);
  return hash;
}

static u128 hash_9_to_16(const unsigned char *in, size_t n) {
  const uint64_t first = read64(in), last = read64(in + n - 8);
  const uint64_t a = (read64(secret + 32) ^ read64(secret + 40)) ^ first ^ last;
  const uint64_t b = (read64(secret + 48) ^ read64(secret + 56)) ^ last;
  u128 hash = multiply(a, PRIME64_1);
  hash.low += (uint64_t)(n - 1) << 54;
  hash.high += b + (b & 0xffffffffu) * (PRIME32_2 - 1);
  hash.low ^= swap64(hash.high);
  const u128 product = multiply(hash.low, PRIME64_2);
  hash.low = avalanche(product.low);
  hash.high = avalanche(product.high + hash.high * PRIME64_2);
  return hash;
}

static uint64_t mix_step(const unsigned char *data, size_t at) {
  return fold(read64(data) ^ read64(secret + at), read64(data + 8) ^ read64(secret + at + 8));
}

static void mix_two(u128 *sum, const unsigned char *one, const unsigned char *two, size_t at) {
  sum->low = (sum->low + mix_step(one, at)) ^ (read64(two) + read64(two + 8));
  sum->high = (sum->high + mix_step(two, at + 16)) ^ (read64(one) + read64(one + 8));
}

/* Inputs of 17 to 128 bytes mix from both ends; up to 240 bytes, in order. */
static u128 hash_17_to_240(const unsigned char *in, size_t n) {
  u128 sum = {(uint64_t)n * PRIME64_1, 0};
  if (n <= 128) {
    for (size_t i = (n - 1) / 32 + 1; i-- > 0;) {
      mix_two(&sum, in + 16 * i, in + n - 16 * i - 16, 32 * i);
    }
  } else {
    for (size_t i = 0; i < 4; i++) mix_two(&sum, in + 32 * i, in + 32 * i + 16, 32 * i);
    sum.low = avalanche(sum.low);
    sum.high = avalanche(sum.high);
    for (size_t i = 4; i < n / 32; i++) {
      mix_two(&sum, in + 32 * i, in + 32 * i + 16, 32 * (i - 4) + 3);
    }
    mix_two(&sum, in + n - 16, in + n - 32, 103);
  }
  const uint64_t high = sum.low * PRIME64_1 + sum.high * PRIME64_4 + (uint64_t)n * PRIME64_2;
  const u128 hash = {avalanche(sum.low + sum.high), 0 - avalanche(high)};
  return hash;
}

static void add_stripe(uint64_t sums[8], const unsigned char *stripe, size_t at) {
  for (size_t i = 0; i < 8; i++) {
    const uint64_t x = read64(stripe + 8 * i), value = x ^ read64(secret + at + 8 * i);
    sums[i ^ 1] += x;
    sums[i] += (value & 0xffffffffu) * (value >> 32);
  }
}

static uint64_t merge(const uint64_t sums[8], uint64_t start, size_t at) {
  for (size_t i = 0; i < 8; i += 2) {
    start +=
        fold(sums[i] ^ read64(secret + at + 8 * i), sums[i + 1] ^ read64(secret + at + 8 * i + 8));
  }
  return avalanche(start);
}

/* Inputs above 240 bytes: blocks of stripes, then the last, overlapping stripe. */
static u128 hash_long(const unsigned char *in, size_t n) {
  uint64_t sums[8] = {PRIME32_3, PRIME64_1, PRIME64_2, PRIME64_3,
                      PRIME64_4, PRIME32_2, PRIME64_5, PRIME32_1};
  const unsigned char *block = in;
  size_t left = n;
  for (; left > BLOCK; left -= BLOCK, block += BLOCK) {
    for (size_t i = 0; i < STRIPES; i++) add_stripe(sums, block + STRIPE * i, 8 * i);
    for (size_t i = 0; i < 8; i++) {
      sums[i] = (sums[i] ^ sums[i] >> 47 ^ read64(secret + SECRET - STRIPE + 8 * i)) * PRIME32_1;
    }
  }
  for (size_t i = 0; i < (left - 1) / STRIPE; i++) add_stripe(sums, block + STRIPE * i, 8 * i);
  add_stripe(sums, in + n - STRIPE, SECRET - 71);
  const u128 hash = {merge(sums, (uint64_t)n * PRIME64_1, 11),
                     merge(sums, ~((uint64_t)n * PRIME64_2), SECRET - 75)};
  return hash;
}

static u128 hash_empty(void) {
  const u128 hash = {avalanche_xxh64(read64(secret + 64) ^ read64(secret + 72)),
                     avalanche_xxh64(read64(secret + 80) ^ read64(secret + 88))};
  return hash;
}

void rot_hash(const unsigned char *bytes, size_t n, char hash[ROT_HASH_SIZE]) {
  const u128 h = n == 0     ? hash_empty()
                 : n <= 3   ? hash_1_to_3(bytes, n)
                 : n <= 8   ? hash_4_to_8(bytes, n)
                 : n <= 16  ? hash_9_to_16(bytes, n)
                 : n <= 240 ? hash_17_to_240(bytes, n)
                            : hash_long(bytes, n);
  snprintf(hash, ROT_HASH_SIZE, "%016llx%016llx", (unsigned long long)h.high,
           (unsigned long long)h.low);
}
