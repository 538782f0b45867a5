/* A block of rows of a sweep: the design's inputs, those derived from them, a run for each row. */
#ifndef ROT_BLOCK_H
#define ROT_BLOCK_H

#include <stdint.h>

#include "design/design.h"
#include "design/formula.h"
#include "sweep/rows.h"

enum { ROT_BLOCK_MAX = 65536 }; /* rows */

typedef struct rot_sweep {
  rot_row_plan plan; /* its inputs are `bound` */
  rot_design design;
  size_t n_derived;
  const rot_formula *derived; /* of the design's inputs and of those derived before */
  const size_t *bound;        /* of each input of the plan: which of the inputs and derived ones */
  size_t part;                /* rows that a thread takes at a time */
  int threads;
  int table; /* 1: by a batch kernel, where there is one (sweep/table.h) */
} rot_sweep;

/* Columns of up to ROT_BLOCK_MAX rows. */
typedef struct rot_block {
  double *const *input;  /* n_inputs of the design, then n_derived */
  double *const *output; /* n_outputs of the plan */
  int *status;
  double *error;
} rot_block;

/* Rows first .. first + n - 1; no bit depends on `first`, n, part or threads. info->rows_done of
 * them are done. ROT_EVALUE: the plan is refused. */
rot_status rot_block_run(const rot_sweep *sweep, uint64_t first, size_t n, const rot_block *block,
                         const rot_hooks *hooks, rot_info *info, rot_refusal *no);

#endif
