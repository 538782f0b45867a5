/* A chunk of a sweep: blocks of rows one after the other, the rows that are kept, sums of all. */
#ifndef ROT_CHUNK_H
#define ROT_CHUNK_H

#include "summary/indices.h"
#include "summary/means.h"
#include "summary/summary.h"
#include "sweep/block.h"

/* Which rows are kept. */
typedef enum rot_keep { ROT_KEEP_NONE, ROT_KEEP_ALL, ROT_KEEP_SOME } rot_keep;

typedef struct rot_chunk_plan {
  const rot_sweep *sweep;
  size_t block_rows;      /* power of two, 2^8 to 2^16 */
  const rot_block *given; /* the rows, where the caller has computed them; NULL: rot_block_run() */
  rot_keep keep;
  const rot_formula
      *condition;      /* of ROT_KEEP_SOME: of inputs, derived ones and outputs; not 0: kept */
  int summed;          /* 1: sums are wanted */
  const double *shift; /* of each output, near its mean; NULL: 0 */
  size_t replicates;   /* groups of the standard error of means, 1 or more */
  uint64_t run;        /* rows, or base points, in a row of one group */
} rot_chunk_plan;

/* The rows kept, in order. Columns: the design's inputs, the derived ones, the outputs. */
typedef struct rot_kept {
  size_t n, room, n_columns;
  double **column;
  double *row, *error; /* the row's number, from 0 */
  int *status;
} rot_kept;

/* Begin with {0}; rot_chunk_free() in each case. */
typedef struct rot_chunk {
  rot_kept kept;
  rot_summary *summary; /* of all rows; NULL: no sums */
  rot_means *means;
  rot_indices *indices; /* of a Saltelli design, else NULL */
  /* The sum, modulo 2^64, of a hash of each row's number, inputs, outputs, error figure and status:
   * that of a whole sweep is the sum of its chunks', whatever these are. */
  uint64_t checksum;
} rot_chunk;

/* Rows first .. first + n - 1; `first` a multiple of n's subtree (summary/extent.h), if sums are
 * wanted. ROT_EVALUE: the plan is refused. */
rot_status rot_chunk_run(const rot_chunk_plan *plan, uint64_t first, uint64_t n,
                         const rot_hooks *hooks, rot_chunk *chunk, rot_refusal *no);
void rot_chunk_free(rot_chunk *chunk);

#endif
