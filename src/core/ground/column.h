/* A column of input: n values, or one for all rows. */
#ifndef ROT_COLUMN_H
#define ROT_COLUMN_H

#include <stddef.h>

#include "ground/ieee.h"

typedef struct rot_column {
  const double *values;
  size_t step; /* 1, or 0 for one value in all rows */
} rot_column;

/* => value of the column in a row */
static inline double rot_at(rot_column column, size_t row) {
  return column.values[row * column.step];
}

#endif
