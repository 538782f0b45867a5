/* Sobol indices of the outputs of a Saltelli design, from sums over its base points.
 *
 * Rows of the design with d inputs: row j (d + 2) + k is variant k of base point j. k = 0: inputs
 * A; k = 1: inputs B; k = 2 + i: A with input i from B. A and B are independent points.
 *
 * Jansen's estimators, over N base points, f the output, V its variance over all A and B:
 *
 *   first[i] = 1 - sum (f(B) - f(AB_i))^2 / (2 N V),   total[i] = sum (f(A) - f(AB_i))^2 / (2 N V).
 *
 * A base point with a failed row or a value that is not finite is skipped, for that output.
 *
 * Blocks are those of summary/extent.h, as for all designs. A base point may continue in the next
 * blocks: the sums then carry the values of its rows until merging brings the other ones, and it
 * enters the sums of that node. So nothing else depends on the length of a base point, and the bits
 * depend on the rows and block_rows alone.
 *
 * Standard errors are those of the jackknife over 16 groups of base points: base point j is in
 * group floor(j/run) modulo 16. run = 1, interleaved groups, suits independent base points
 * (random). Base points of a Sobol sequence are not independent: those of one j modulo 16 have
 * their first input in one sixteenth of its range. For one scrambled sequence of 4096 base points
 * (Ishigami function) interleaved groups gave standard errors 2 to 20 times the true ones,
 * consecutive ones (run = N/16) 1.6 to 6 times. Sound ones come from 16 independent scramblings,
 * one after another, with run = base points of each. Groups should be of one size: a group of few
 * base points distorts the result.
 *
 * Source: Jansen, Comput. Phys. Commun. 117 (1999) 35; Saltelli et al., Comput. Phys. Commun. 181
 * (2010) 259. */
#ifndef ROT_INDICES_H
#define ROT_INDICES_H

#include <stddef.h>
#include <stdint.h>

#include "ground/dd.h"
#include "ground/status.h"
#include "summary/long.h"
#include "summary/extent.h"
#include "summary/tree.h"

enum { ROT_INDEX_GROUPS = 16, ROT_INDEX_INPUTS = 65534 /* max d: 2^16 rows of a base point */ };

/* Sums of a group over its base points, a = f(A) - shift, b = f(B) - shift, x = f(AB_i) - shift. */
enum {
  ROT_INDEX_A,         /* a */
  ROT_INDEX_B,         /* b */
  ROT_INDEX_AA,        /* a^2 */
  ROT_INDEX_BB,        /* b^2 */
  ROT_INDEX_DIFFERENCE /* and on: d sums of (b - x)^2, d sums of (a - x)^2 */
};

typedef struct rot_indices_column {
  double shift;
  uint64_t skipped;                  /* base points with a value that is missing */
  uint64_t points[ROT_INDEX_GROUPS]; /* base points in the sums */
  rot_dd *sum;                       /* sum[terms * group + term] */
  double *head, *tail;               /* values, NaN for a missing one, up to d + 1 */
} rot_indices_column;

typedef struct rot_indices {
  rot_extent span;
  size_t n_inputs, n_columns;
  uint64_t run;
  size_t terms; /* 4 + 2 n_inputs */
  rot_indices_column *column;
} rot_indices;

/* shift[]: one finite number a column, near the mean; NULL: 0. run: see above. block_rows: rows of
 * a block. NULL: no memory, or an argument outside its domain. */
rot_indices *rot_indices_new(size_t n_inputs, size_t n_columns, const double shift[], uint64_t run,
                             uint64_t block_rows);
void rot_indices_free(rot_indices *indices);

/* Fills empty sums by one block, as rot_summary_add(): n rows from first_row on; status 0: good;
 * NULL: all are. ROT_EVALUE: not empty, or no block. */
rot_status rot_indices_add(rot_indices *indices, uint64_t first_row, size_t n,
                           const double *const column[], const int status[]);
/* As rot_summary_merge(). */
rot_status rot_indices_merge(rot_indices *into, const rot_indices *from);
/* The type of nodes for rot_tree_new(). */
extern const rot_tree_node rot_indices_node;

typedef struct rot_indices_info {
  uint64_t points, skipped; /* base points */
  double mean, variance;    /* of the output over A and B; 2 N - 1 in the denominator */
} rot_indices_info;

/* column => n_inputs indices each with standard errors. NaN for a variance of 0 or no base point;
 * standard errors are NaN with base points in fewer than two groups. ROT_ENOMEM. */
rot_status rot_indices_estimate(const rot_indices *indices, size_t column, double first[],
                                double first_se[], double total[], double total_se[],
                                rot_indices_info *info);

/* Long form, as that of a summary: kinds ROT_KIND_INDEX_... of summary/long.h. */
size_t rot_indices_rows_size(const rot_indices *indices);
void rot_indices_rows(const rot_indices *indices, const rot_long *rows);
rot_status rot_indices_read(size_t n, const rot_long *rows, rot_indices **indices);

#endif
