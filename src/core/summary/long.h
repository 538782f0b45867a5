/* The long form of summaries, for files: rows of quantity, kind, key and value.
 *
 * quantity: ROT_RUN_QUANTITY for the run, or the index of an output column, from 0 on. kind: the
 * numbers below, which files keep: they never change. key: what the list says; 0 where it says
 * nothing. value: a number; counts and row numbers are whole, exact, and not above 2^52. Rows are
 * sorted by quantity, kind, key, none twice. Summaries (kinds below 100), indices (100 to 199) and
 * means (200 to 299) may share a table: each reader is given the rows of its own kinds, in order.
 *
 * Rows to summary to rows gives the same bits. Readers refuse rows that no summary writes. */
#ifndef ROT_LONG_H
#define ROT_LONG_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"
#include "summary/extent.h"

enum { ROT_RUN_QUANTITY = -1 };

/* code, number, name; (key => value). "If any": the row is absent for a count of 0. */
#define ROT_KIND_LIST(X)                                                                           \
  /* run, of a summary */                                                                          \
  X(ROT_KIND_FIRST_ROW, 0, "first_row")                                                            \
  X(ROT_KIND_ROWS, 1, "rows")                                                                      \
  X(ROT_KIND_COLUMNS, 2, "columns")                                                                \
  X(ROT_KIND_KEPT, 3, "kept")                   /* => rows kept */                                 \
  X(ROT_KIND_STATUS, 4, "status")               /* status => rows, if any */                       \
  X(ROT_KIND_FAILED, 5, "failed")               /* row => its status; the first 100 rows */        \
  X(ROT_KIND_ERROR_ABOVE, 6, "error_above")     /* => rows with an error above the accuracy */     \
  X(ROT_KIND_ERROR_UNKNOWN, 7, "error_unknown") /* => rows with the error NaN */                   \
  X(ROT_KIND_ERROR_MAX, 8, "error_max")         /* row => largest error, if any is a number */     \
  X(ROT_KIND_BLOCK_ROWS, 9, "block_rows")       /* => rows of a block (summary/extent.h) */        \
  /* a column of a summary */                                                                      \
  X(ROT_KIND_SHIFT, 10, "shift")                                                                   \
  X(ROT_KIND_FINITE, 11, "finite")           /* => finite values */                                \
  X(ROT_KIND_NAN, 12, "nan")                 /* first row => number of NaN, if any */              \
  X(ROT_KIND_PLUS_INF, 13, "plus_inf")       /* first row => number of +Inf, if any */             \
  X(ROT_KIND_MINUS_INF, 14, "minus_inf")     /* first row => number of -Inf, if any */             \
  X(ROT_KIND_SUM, 15, "sum")                 /* => sum of the finite values */                     \
  X(ROT_KIND_SUM_LOW, 16, "sum_low")         /* => its compensation */                             \
  X(ROT_KIND_SQUARES, 17, "squares")         /* => sum of (value - shift)^2 */                     \
  X(ROT_KIND_SQUARES_LOW, 18, "squares_low") /* => its compensation */                             \
  X(ROT_KIND_MINIMUM, 19, "minimum")         /* first row => smallest finite value, if any */      \
  X(ROT_KIND_MAXIMUM, 20, "maximum")         /* first row => largest finite value, if any */       \
  X(ROT_KIND_BUCKET, 21, "bucket")           /* bucket (summary/buckets.h) => values, if any */    \
  /* indices; in keys, g is a group, 0 .. 15 */                                                    \
  X(ROT_KIND_INDEX_FIRST_ROW, 100, "index_first_row")                                              \
  X(ROT_KIND_INDEX_ROWS, 101, "index_rows")                                                        \
  X(ROT_KIND_INDEX_COLUMNS, 102, "index_columns")                                                  \
  X(ROT_KIND_INDEX_INPUTS, 103, "index_inputs")                                                    \
  X(ROT_KIND_INDEX_RUN, 104, "index_run") /* => base points in a row of one group */               \
  X(ROT_KIND_INDEX_BLOCK_ROWS, 105, "index_block_rows")                                            \
  X(ROT_KIND_INDEX_SHIFT, 110, "index_shift")                                                      \
  X(ROT_KIND_INDEX_SKIPPED, 111,                                                                   \
    "index_skipped")                            /* => base points with a value that is missing */  \
  X(ROT_KIND_INDEX_POINTS, 112, "index_points") /* g => base points */                             \
  X(ROT_KIND_INDEX_SUM, 113, "index_sum")       /* 16 term + g => sum (summary/indices.h) */       \
  X(ROT_KIND_INDEX_SUM_LOW, 114, "index_sum_low") /* 16 term + g => its compensation */            \
  X(ROT_KIND_INDEX_HEAD, 115, "index_head")       /* row => value; base point begun before */      \
  X(ROT_KIND_INDEX_TAIL, 116, "index_tail")       /* row => value; base point not completed */     \
  /* means; in keys, g is a group */                                                               \
  X(ROT_KIND_MEAN_FIRST_ROW, 200, "mean_first_row")                                                \
  X(ROT_KIND_MEAN_ROWS, 201, "mean_rows")                                                          \
  X(ROT_KIND_MEAN_COLUMNS, 202, "mean_columns")                                                    \
  X(ROT_KIND_MEAN_REPLICATES, 203, "mean_replicates")                                              \
  X(ROT_KIND_MEAN_RUN, 204, "mean_run") /* => rows in a row of one group */                        \
  X(ROT_KIND_MEAN_BLOCK_ROWS, 205, "mean_block_rows")                                              \
  X(ROT_KIND_MEAN_COUNT, 210, "mean_count")     /* g => values */                                  \
  X(ROT_KIND_MEAN_SUM, 211, "mean_sum")         /* g => sum */                                     \
  X(ROT_KIND_MEAN_SUM_LOW, 212, "mean_sum_low") /* g => its compensation */

typedef enum rot_kind {
#define X(code, number, name) code = number,
  ROT_KIND_LIST(X)
#undef X
} rot_kind;

/* kind => name of the list above; NULL for another number */
const char *rot_kind_name(int kind);

/* Columns of the long form, each of the caller's memory. Readers change nothing. */
typedef struct rot_long {
  int *quantity, *kind;
  int64_t *key;
  double *value;
} rot_long;

/* ---- for the readers and writers of this folder ---------------------------------------------- */

/* 1, and the number, if x is a whole number from 0 to max <= 2^52; -0 is none. */
int rot_long_whole(double x, uint64_t max, uint64_t *whole);

/* 1 if sum and compensation are a double-double number, or not finite without compensation. */
int rot_long_is_sum(double hi, double lo);

/* A place in the rows. Writers and readers of a fixed form go through the same places: one routine,
 * the form, serves counting (rows NULL), writing and reading. */
typedef struct rot_long_at {
  const rot_long *rows; /* NULL: count only */
  size_t n, next;       /* rows there are, of readers; next row */
  int read;             /* 1: read; 0: write */
  int bad;              /* 1: a row is not what the form has here */
} rot_long_at;

/* The next row: writes *value, or reads it. */
void rot_long_number(rot_long_at *at, int quantity, rot_kind kind, int64_t key, double *value);
/* The same for a whole number up to max. */
void rot_long_count(rot_long_at *at, int quantity, rot_kind kind, int64_t key, uint64_t max,
                    uint64_t *value);

#endif
