/* Sorting of numbers. */
#ifndef ROT_SORT_H
#define ROT_SORT_H

#include <stddef.h>

#include "ground/ieee.h"

/* Sorts x, without NaN, in increasing order in place. */
void rot_sort(size_t n, double x[]);
/* Sorts x and removes repeated values; returns the number kept. */
size_t rot_sort_once(size_t n, double x[]);

#endif
