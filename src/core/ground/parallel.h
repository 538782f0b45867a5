/* Independent rows, computed in parts by several threads. */
#ifndef ROT_PARALLEL_H
#define ROT_PARALLEL_H

#include "ground/status.h"

/* Computes rows first .. last - 1; `frame`: arguments of the worker. */
typedef void (*rot_parallel_worker)(const void *frame, size_t first, size_t last);

/* (worker, n rows, `part` rows at a time) => info. At most `threads` threads; all for threads < 1.
 * Polls between parts: a part should take some 0.1 ms. `info` has no measures; exactly the first
 * info->rows_done rows are computed. */
rot_status rot_parallel_rows(rot_parallel_worker work, const void *frame, size_t n, size_t part,
                             int threads, const rot_hooks *hooks, rot_info *info);

/* => maximum number of threads; 1 without OpenMP */
int rot_parallel_threads(void);

#endif
