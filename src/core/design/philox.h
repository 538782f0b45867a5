/* Random numbers by their place: Philox 4x32 with 10 rounds, a function of (seed, row, column).
 *
 * Reference: J. K. Salmon, M. A. Moraes, R. O. Dror and D. E. Shaw, Parallel random numbers: as
 * easy as 1, 2, 3, SC11 (2011). */
#ifndef ROT_PHILOX_H
#define ROT_PHILOX_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"

/* What numbers are for: the last word of the counter, so that no two uses share a number. */
typedef enum rot_stream {
  ROT_STREAM_INPUTS,
  ROT_STREAM_SCRAMBLING,
  ROT_STREAM_PERMUTATIONS,
  ROT_STREAM_AUDIT,
  ROT_STREAM_CANARY
} rot_stream;

/* (counter, key) => 4 words, each of 32 random bits */
void rot_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]);

/* (seed, row, column pair, stream) => 2 words of 64 random bits. The counter is (row low, row high,
 * pair, stream), the key the seed, low word first. */
void rot_philox_row(uint64_t seed, uint64_t row, uint32_t pair, rot_stream stream, uint64_t out[2]);

/* 52 leading bits k of a word => (k + 1/2) 2^-52: exact, never 0 or 1 (53 bits and a half would
 * round up to 1) */
static inline double rot_unit(uint64_t bits) {
  return ((double)(int64_t)(bits >> 12) + 0.5) * 0x1p-52;
}

/* Rows first .. first + n - 1 of the columns 2 pair and 2 pair + 1, in (0, 1); even or odd may be
 * NULL. */
void rot_philox_columns(uint64_t seed, uint64_t first, size_t n, uint32_t pair, rot_stream stream,
                        double even[], double odd[]);

#endif
