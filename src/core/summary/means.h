/* Means of output columns with a standard error from groups of rows.
 *
 * Row r is in group floor(r/run) modulo `replicates`. For independent rows take run = 1; for a
 * design of 16 scramblings, one after another, replicates = 16 and run = rows of one. Groups of a
 * single Sobol sequence exaggerate the standard error (summary/indices.h). The standard error is
 * that of the jackknife; with as many values in each group it is the standard deviation of the
 * groups' means over the root of their number. Rows with a status other than 0 and values that are
 * not finite are left out. The bits depend on the rows and block_rows alone. */
#ifndef ROT_MEANS_H
#define ROT_MEANS_H

#include <stddef.h>
#include <stdint.h>

#include "ground/dd.h"
#include "ground/status.h"
#include "summary/long.h"
#include "summary/extent.h"
#include "summary/tree.h"

enum { ROT_MEANS_REPLICATES = 4096 };

typedef struct rot_means_group {
  uint64_t count;
  rot_dd sum;
} rot_means_group;

typedef struct rot_means {
  rot_extent span;
  size_t n_columns, replicates;
  uint64_t run;
  rot_means_group *group; /* group[replicates * column + g] */
} rot_means;

/* replicates: 1 .. 4096; run >= 1; block_rows: rows of a block (summary/extent.h). NULL: no
 * memory, or an argument outside its domain. */
rot_means *rot_means_new(size_t n_columns, size_t replicates, uint64_t run, uint64_t block_rows);
void rot_means_free(rot_means *means);

/* Fills empty means by one block, as rot_indices_add(). */
rot_status rot_means_add(rot_means *means, uint64_t first_row, size_t n,
                         const double *const column[], const int status[]);
/* As rot_summary_merge(). */
rot_status rot_means_merge(rot_means *into, const rot_means *from);
/* The type of nodes for rot_tree_new(). */
extern const rot_tree_node rot_means_node;

/* column => mean of all values, NaN without one; its standard error, NaN with values in fewer than
 * two groups */
void rot_means_estimate(const rot_means *means, size_t column, double *mean, double *se);

/* Long form, as that of a summary: kinds ROT_KIND_MEAN_... of summary/long.h. */
size_t rot_means_rows_size(const rot_means *means);
void rot_means_rows(const rot_means *means, const rot_long *rows);
rot_status rot_means_read(size_t n, const rot_long *rows, rot_means **means);

#endif
