/* Latin hypercubes by the number of the row: a keyed permutation of row numbers, one for each
 * column, that needs no memory.
 *
 * References: M. D. McKay, R. J. Beckman and W. J. Conover, Technometrics 21 (1979) 239; J. Black
 * and P. Rogaway, Ciphers with arbitrary finite domains, CT-RSA (2002) 114 (Feistel network with
 * cycle walking). */
#ifndef ROT_LATIN_H
#define ROT_LATIN_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"
#include "design/philox.h"

enum { ROT_PERMUTATION_ROUNDS = 8 };

/* A permutation of 0 .. n - 1. */
typedef struct rot_permutation {
  uint64_t n;    /* at most 2^52 */
  int low, high; /* bits of the halves; 2^(low + high) is the least power of two >= n */
  uint64_t key[ROT_PERMUTATION_ROUNDS];
} rot_permutation;

/* (n, seed, column, stream) => *p; the same arguments give the same permutation */
void rot_permutation_begin(rot_permutation *p, uint64_t n, uint64_t seed, uint32_t column,
                           rot_stream stream);
/* i < n => its image; less than two walks of 8 rounds on average */
uint64_t rot_permutation_of(const rot_permutation *p, uint64_t i);

/* Rows first .. first + n - 1 of one column: random numbers in (0, 1) in u => coordinates, the
 * strata from the permutation, the places in the strata from u. */
void rot_latin_column(const rot_permutation *p, uint64_t first, size_t n, double u[]);

#endif
