/* Numbers in order. */
#ifndef ROT_SORT_H
#define ROT_SORT_H

#include <stddef.h>

#include "ground/ieee.h"

/* Increasing, in place; no NaN among them. */
void rot_sort(size_t n, double x[]);
/* Each value once, increasing; how many they are. */
size_t rot_sort_once(size_t n, double x[]);

#endif
