/* References in long double are of use where it has more digits than double. Valgrind computes it
 * with 53 bits, and so do some processors. */
#ifndef LONG_DOUBLE_H
#define LONG_DOUBLE_H

#include <stdio.h>

/* 0, and a line that counts as a skip, where it has not. */
static inline int long_double_is_longer(const char *needed_by) {
  volatile long double one = 1.0L;
  volatile const long double more = one + 0x1p-60L;
  if (more != one) return 1;
  printf("skip - %s: long double has no more digits than double here\n", needed_by);
  return 0;
}

#endif
