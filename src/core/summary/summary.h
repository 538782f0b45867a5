/* What a sweep keeps of its rows: counts, sums, extremes and histograms of its output columns.
 *
 *   rot_summary *part = rot_summary_new(n_columns, shift);
 *   rot_summary_add(part, &block);              one block of rows (summary/extent.h)
 *   rot_tree_add(tree, part);                   tree of type rot_summary_node (summary/tree.h)
 *   ...
 *   rot_tree_finish(tree, &whole);
 *   rot_summary_mean(), rot_summary_sd(), rot_summary_quantile(), the members of rot_summary.
 *
 * A row with a status other than 0 failed: it is counted by its status and enters nothing else. Of
 * the other rows, NaN and infinities of a column are counted, each with the lowest row that has
 * one; sums, extremes and buckets have the finite values. So for each column finite + nan +
 * plus_inf + minus_inf = rows_with_status[0].
 *
 * All members of a whole depend on the rows and block_rows alone, bit for bit: not on threads,
 * chunks, order of arrival or width of registers. Within a block, four sums take the values in
 * turns (row modulo 4; within a piece of 1024 rows with failures or values that are not finite: the
 * n-th finite value, n modulo 4); blocks are added along the tree.
 *
 * Sums are double-double numbers with an error of some 2^-90 of the sum of |x|. Squares are those
 * of the rounded difference of value and shift, so choose a shift near the mean, the same for all
 * parts. They overflow for differences above 1e154 and vanish below 1e-162: then the standard
 * deviation is Inf or 0. */
#ifndef ROT_SUMMARY_H
#define ROT_SUMMARY_H

#include <stddef.h>
#include <stdint.h>

#include "ground/dd.h"
#include "ground/status.h"
#include "summary/buckets.h"
#include "summary/long.h"
#include "summary/extent.h"
#include "summary/tree.h"

enum { ROT_SUMMARY_STATUSES = 32, ROT_SUMMARY_FAILED = 100 };

typedef struct rot_summary_column {
  double shift;
  uint64_t finite, nan, plus_inf, minus_inf;     /* number of values */
  uint64_t nan_row, plus_inf_row, minus_inf_row; /* lowest row with one; 0 without */
  rot_dd sum, squares;                           /* of x; of (x - shift)^2 */
  double minimum, maximum;                       /* finite; 0 for finite = 0 */
  uint64_t minimum_row, maximum_row;             /* lowest row with it; -0 equals 0 */
  rot_buckets buckets;                           /* of the finite values */
} rot_summary_column;

typedef struct rot_summary {
  rot_extent span; /* rows covered; none at first */
  size_t n_columns;
  rot_summary_column *column;
  uint64_t rows_with_status[ROT_SUMMARY_STATUSES];
  uint64_t kept; /* rows kept, as the caller counted them */
  /* the lowest rows with a status other than 0, in order, with it */
  size_t n_failed;
  uint64_t failed_row[ROT_SUMMARY_FAILED];
  int failed_status[ROT_SUMMARY_FAILED];
  /* error figures, of rows with status 0 */
  uint64_t error_above;   /* rows with an error above the accuracy, or NaN */
  uint64_t error_unknown; /* rows with the error NaN */
  int has_error_max;      /* 1: some error is a number */
  double error_max;
  uint64_t error_max_row; /* lowest row with it */
} rot_summary;

/* One block of rows. */
typedef struct rot_summary_block {
  uint64_t first_row;          /* a multiple of block_rows */
  size_t n;                    /* block_rows, or fewer in the last block of the sweep */
  const double *const *column; /* n_columns columns of n values */
  const int *status;           /* 0 .. 31 each; NULL: all 0 */
  const double *error;         /* error figures; NULL: not known, nothing is counted */
  double accuracy;             /* to compare the errors with */
  uint64_t kept;               /* number of rows kept, up to n */
} rot_summary_block;

/* shift[]: one finite number a column; NULL: 0. block_rows: rows of a block (summary/extent.h).
 * NULL: no memory, or an argument outside its domain. */
rot_summary *rot_summary_new(size_t n_columns, const double shift[], uint64_t block_rows);
/* Empties a summary, shifts and block_rows excepted. */
void rot_summary_clear(rot_summary *summary);
void rot_summary_free(rot_summary *summary);

/* Fills an empty summary. ROT_EVALUE: the summary is not empty, the rows are no block, or a status
 * is not 0 .. 31. After a failure it is empty. Different summaries may be filled by threads. */
rot_status rot_summary_add(rot_summary *summary, const rot_summary_block *block);

/* Completes the histograms. Blocks of fewer than 2^16 rows leave their values in buckets.later, to
 * be counted together: rot_tree_finish(), rot_summary_merge(), rot_summary_quantile() and
 * rot_summary_rows_size() do it. Only who reads column.buckets or calls rot_summary_buckets() after
 * rot_summary_add() alone needs to call this. One thread at a time. ROT_ENOMEM: may be called
 * again. */
rot_status rot_summary_count(const rot_summary *summary);

/* Joins the left and the right child of a node of the tree; ROT_EVALUE for any other rows, columns,
 * shifts or block_rows. `into` is unchanged by a failure. rot_tree_add() does it where the order is
 * due. */
rot_status rot_summary_merge(rot_summary *into, const rot_summary *from);

/* The type of nodes for rot_tree_new(). */
extern const rot_tree_node rot_summary_node;

/* ---- figures --------------------------------------------------------------------------------- */

/* => mean of the finite values, to 1 ulp of the largest |x| or better; NaN without one */
double rot_summary_mean(const rot_summary *summary, size_t column);
/* => standard deviation of the finite values, n - 1 in the denominator; NaN for n < 2 */
double rot_summary_sd(const rot_summary *summary, size_t column);

/* (column, p) => interval that contains the p-quantile: the order statistic of rank ceil(p n), at
 * least 1, of the n values of the column that are not NaN, infinities included; p n is rounded to a
 * double, so that p = 0.1 of n = 10 is rank 1.
 *
 * high - low < 2^-8 |x| for each x in the interval, so the middle is within 2^-9 of the quantile: a
 * bound. low = high for 0, infinities, and ranks 1 and n, which are the minimum and the maximum;
 * these limit the other intervals. NaN for n = 0. ROT_EVALUE, and NaN, for p outside [0, 1];
 * ROT_ENOMEM, and NaN. */
rot_status rot_summary_quantile(const rot_summary *summary, size_t column, double p, double *low,
                                double *high);
/* (low, high) => middle of such an interval */
double rot_summary_middle(double low, double high);

/* => the histogram: limits (both in the bucket) and counts of column.buckets.n buckets in
 * increasing order, into the caller's memory; each may be NULL. Counts as doubles are exact. */
void rot_summary_buckets(const rot_summary *summary, size_t column, double low[], double high[],
                         double count[]);

/* ---- long form ------------------------------------------------------------------------------- */

/* => number of rows (summary/long.h); 0 for an empty summary, which has no long form, and without
 * memory for rot_summary_count() */
size_t rot_summary_rows_size(const rot_summary *summary);
/* Fills that many rows; after rot_summary_rows_size(). */
void rot_summary_rows(const rot_summary *summary, const rot_long *rows);
/* n rows => summary, which the caller frees. ROT_EVALUE for rows that no summary has;
 * ROT_ENOMEM. */
rot_status rot_summary_read(size_t n, const rot_long *rows, rot_summary **summary);

#endif
