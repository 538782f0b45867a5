/* Rows that do not depend on each other, computed in parts by several threads. */
#ifndef ROT_PARALLEL_H
#define ROT_PARALLEL_H

#include "ground/status.h"

/* Rows first .. last - 1 in the given frame. */
typedef void (*rot_parallel_worker)(const void *frame, size_t first, size_t last);

/* At most `threads` threads; less than 1, or more than there are: all. Polls between parts, whose
 * rows should take some 0.1 ms. info is cleared: no measures; the first rows_done rows are done,
 * and no others. */
rot_status rot_parallel_rows(rot_parallel_worker work, const void *frame, size_t n, size_t part,
                             int threads, const rot_hooks *hooks, rot_info *info);

/* Most threads; 1 without OpenMP. */
int rot_parallel_threads(void);

#endif
