/* Sobol's sequence by the number of its point, in the order of the Gray code, with or without
 * Owen's scrambling. 52 bits, so that 2^52 points differ.
 *
 * References: I. M. Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86; I. A. Antonov and V. M.
 * Saleev, ibid. 19 (1979) 252 (Gray code); A. B. Owen, in Monte Carlo and Quasi-Monte Carlo Methods
 * in Scientific Computing (1995) 299; B. Burley, J. Comput. Graph. Tech. 9(4) (2020) 1 (nested
 * permutations by a hash of the reversed bits). */
#ifndef ROT_SOBOL_H
#define ROT_SOBOL_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"
#include "design/sobol_table.h"

enum { ROT_SOBOL_BITS = 52, ROT_SOBOL_NEAR = 64, ROT_SOBOL_ROUNDS = 3 };

/* One dimension, ready for use. Bits are those of the coordinate times 2^64; where it is scrambled,
 * in reverse order. */
typedef struct rot_sobol {
  uint64_t direction[ROT_SOBOL_BITS];
  uint64_t near[ROT_SOBOL_NEAR]; /* points 0 .. 63 */
  int scrambled;
  /* Keys of the hash: terms, odd and even factors, those of later rounds below 2^32. */
  uint64_t add[ROT_SOBOL_ROUNDS], odd[ROT_SOBOL_ROUNDS], even[ROT_SOBOL_ROUNDS];
} rot_sobol;

/* dimension < ROT_SOBOL_DIMENSIONS, seed (NULL: not scrambled) => *s */
void rot_sobol_begin(rot_sobol *s, size_t dimension, const uint64_t *seed);

/* Points first .. first + n - 1, at most 2^52 of them => coordinates in (0, 1), multiples of 2^-52,
 * but 2^-53 for 0. */
void rot_sobol_column(const rot_sobol *s, uint64_t first, size_t n, double u[]);

#endif
