/* Rows that do not depend on each other, computed in chunks by several threads. */
#ifndef ROT_SHARE_H
#define ROT_SHARE_H

#include "rot_status.h"

/* Rows first .. last - 1 in the given frame. */
typedef void (*rot_share_worker)(const void *frame, size_t first, size_t last);

/* At most `threads` threads; less than 1, or more than there are: all. Polls between chunks, whose
 * rows should take some milliseconds. info is cleared: no measures; rows_done counts rows that are
 * done. */
rot_status rot_share_rows(rot_share_worker work, const void *frame, size_t n, size_t chunk,
                          int threads, const rot_hooks *hooks, rot_info *info);

/* Most threads; 1 without OpenMP. */
int rot_share_threads(void);

#endif
