/* Rows of a motion, outward from its start: backward in time first, then forward, one piece of time
 * after the other. The loop handles times, rows, polls and the report of the run; the model
 * computes the motion. */
#ifndef ROT_STEPPING_H
#define ROT_STEPPING_H

#include "ground/status.h"

typedef struct rot_stepping {
  /* Go to the start and enter the first piece from there; ROT_EVALUE if this direction is not
   * possible. NULL: no state is carried from row to row, and all rows are written in order. */
  rot_status (*restart)(void *model, int forward);
  /* Does the time lie before the end of the piece, in the direction of travel? */
  int (*holds)(const void *model, double time_s);
  /* Go to the end of the piece and enter the next one; *end_s: the time there. */
  rot_status (*next_piece)(void *model, double *end_s);
  /* Write row i of the piece; */
  rot_status (*write_row)(void *model, size_t i);
  /* or, instead, rows first .. last - 1 of it: *end is the first one that is not written. A model
   * without restart() may stop early, and is polled each time. */
  rot_status (*write_rows)(void *model, size_t first, size_t last, size_t *end);
} rot_stepping;

/* Times are finite and do not decrease. info is cleared by the caller; steps counts pieces. Polls
 * after every 8192 rows and pieces. On failure the first info->rows_done rows are valid. */
rot_status rot_step_rows(const rot_stepping *stepping, void *model, double start_s, size_t n,
                         const double time_s[], const rot_hooks *hooks, rot_info *info);

#endif
