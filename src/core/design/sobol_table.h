/* The table of Sobol's sequence: primitive polynomials and first direction numbers of 64
 * dimensions.
 *
 * Source: S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional
 * projections, SIAM J. Sci. Comput. 30 (2008) 2635, their file new-joe-kuo-6. */
#ifndef ROT_SOBOL_TABLE_H
#define ROT_SOBOL_TABLE_H

#include "ground/ieee.h"

enum { ROT_SOBOL_DIMENSIONS = 64, ROT_SOBOL_DEGREE = 9 };

typedef struct rot_sobol_seed {
  unsigned short polynomial;               /* its coefficients as bits, the highest power first */
  unsigned short number[ROT_SOBOL_DEGREE]; /* odd, number[i] < 2^(i + 1); one for each degree */
} rot_sobol_seed;

/* Of the first dimension, van der Corput's sequence: the polynomial 1. */
extern const rot_sobol_seed rot_sobol_table[ROT_SOBOL_DIMENSIONS];

#endif
