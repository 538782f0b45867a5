/* Means with standard errors from groups: groups against plain loops, any chunks, coverage, the
 * long form. */
#include "rot_test.h"
#include "summary/means.h"
#include "summary_kit.h"

static const rot_tree_node *const type = &rot_means_node;

static kit_table table_of(const rot_means *m) {
  kit_table table = kit_table_new(rot_means_rows_size(m));
  rot_means_rows(m, &table.rows);
  return table;
}

static rot_means *whole(size_t replicates, uint64_t run, uint64_t rows, const double x[],
                        const int status[], uint64_t size, uint64_t block_rows) {
  const uint64_t blocks = rot_extent_blocks((rot_extent){0, rows, block_rows});
  rot_tree *tree = rot_tree_new(type), *part = rot_tree_new(type);
  void *node = NULL;
  for (uint64_t chunk = (blocks + size - 1) / size; chunk-- > 0;) {
    for (uint64_t b = chunk * size; b < (chunk + 1) * size && b < blocks; b++) {
      const uint64_t first = b * block_rows, left = rows - first;
      const double *column[] = {x + first, x + first};
      rot_means *m = rot_means_new(2, replicates, run, block_rows);
      ROT_CHECK_EQ_INT(rot_means_add(m, first, left < block_rows ? (size_t)left : block_rows,
                                     column, status + first),
                       ROT_OK);
      ROT_CHECK_EQ_INT(rot_tree_add(part, m), ROT_OK);
    }
    ROT_CHECK_EQ_INT(rot_tree_finish(part, &node), ROT_OK);
    kit_table table = table_of(node), again;
    rot_means *read;
    ROT_CHECK(kit_sorted(&table));
    ROT_CHECK_EQ_INT(rot_means_read(table.n, &table.rows, &read), ROT_OK);
    again = table_of(read);
    ROT_CHECK(kit_same(&table, &again));
    kit_table_free(&table);
    kit_table_free(&again);
    rot_means_free(node);
    ROT_CHECK_EQ_INT(rot_tree_add(tree, read), ROT_OK);
  }
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  rot_tree_free(tree);
  rot_tree_free(part);
  return node;
}

static void groups(void) {
  static const struct {
    size_t replicates;
    uint64_t run, rows;
  } row[] = {
      {16, 1, 65536},   {16, 20000, 5 * 65536}, {3, 7, 2 * 65536 + 11},  {1, 1, 100},
      {4096, 1, 65537}, {16, 65536, 3 * 65536}, {2, 1 << 20, 65536 + 1}, {5, 65537, 9 * 65536 - 1}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    const uint64_t rows = row[i].rows;
    uint64_t state = i;
    double *x = malloc(rows * sizeof *x);
    int *status = calloc(rows, sizeof *status);
    for (uint64_t r = 0; r < rows; r++) {
      x[r] = (double)kit_below(&state, 2001) - 900.0;
      if (kit_below(&state, 500) == 0) x[r] = kit_below(&state, 2) ? NAN : INFINITY;
      status[r] = kit_below(&state, 400) == 0;
    }
    rot_means *m = whole(row[i].replicates, row[i].run, rows, x, status, 1, 65536);
    double *sum = calloc(row[i].replicates, sizeof *sum), all = 0.0, mean, se;
    uint64_t *count = calloc(row[i].replicates, sizeof *count), n = 0;
    for (uint64_t r = 0; r < rows; r++) {
      const size_t g = (size_t)(r / row[i].run % row[i].replicates);
      if (status[r] || !isfinite(x[r])) continue;
      sum[g] += x[r];
      count[g]++;
      all += x[r];
      n++;
    }
    for (size_t g = 0; g < 2 * row[i].replicates; g++) {
      ROT_CHECK(m->group[g].count == count[g % row[i].replicates]);
      ROT_CHECK(m->group[g].sum.hi == sum[g % row[i].replicates] && m->group[g].sum.lo == 0.0);
    }
    rot_means_estimate(m, 1, &mean, &se);
    ROT_CHECK_ULP(mean, all / (double)n, 0);
    ROT_CHECK(row[i].replicates == 1 || i == 6 ? isnan(se) : se > 0.0);
    kit_table table = table_of(m);
    /* Sums are exact: blocks of other sizes give the same numbers, but for the size. */
    for (uint64_t size = 2; size <= 32; size *= 4) {
      for (int k = 0; k < KIT_SIZES; k++) {
        /* Many groups of many blocks take some seconds. */
        if (row[i].replicates > 1000 && k < 2 && size < 32) continue;
        rot_means *other =
            whole(row[i].replicates, row[i].run, rows, x, status, size, kit_block_rows[k]);
        kit_table again = table_of(other);
        ROT_CHECK(again.rows.kind[5] == ROT_KIND_MEAN_BLOCK_ROWS);
        ROT_CHECK(again.rows.value[5] == (double)kit_block_rows[k]);
        again.rows.value[5] = 65536.0;
        ROT_CHECK(kit_same(&table, &again));
        kit_table_free(&again);
        rot_means_free(other);
      }
    }
    kit_table_free(&table);
    rot_means_free(m);
    free(x);
    free(status);
    free(sum);
    free(count);
  }
}

/* Groups 1, 3 and 2, 6, 4 (means 2 and 4): mean 3.2, jackknife by hand. */
static void by_hand(void) {
  const double x[] = {1.0, 3.0, 2.0, 6.0, 4.0}, *column[] = {x};
  double mean, se;
  rot_means *m = rot_means_new(1, 16, 2, 65536);
  ROT_CHECK_EQ_INT(rot_means_add(m, 0, 4, column, NULL), ROT_OK);
  rot_means_estimate(m, 0, &mean, &se);
  ROT_CHECK_ULP(mean, 3.0, 0);
  ROT_CHECK_REL(se, 1.0, 1e-15); /* standard deviation of 2 and 4 over sqrt(2) */
  ROT_CHECK_EQ_INT(rot_means_add(m, 0, 4, column, NULL), ROT_EVALUE);
  rot_means_free(m);
  m = rot_means_new(1, 2, 2, 65536); /* the fifth in group 0: 8/3 and 4 */
  ROT_CHECK_EQ_INT(rot_means_add(m, 0, 5, column, NULL), ROT_OK);
  rot_means_estimate(m, 0, &mean, &se);
  ROT_CHECK_ULP(mean, 3.2, 0);
  ROT_CHECK_REL(se, 2.0 / 3.0, 1e-14);
  rot_means_free(m);
  m = rot_means_new(1, 4, 1, 65536);
  rot_means_estimate(m, 0, &mean, &se);
  ROT_CHECK(isnan(mean) && isnan(se));
  ROT_CHECK_EQ_INT(rot_means_add(m, 2, 4, column, NULL), ROT_EVALUE);
  rot_means_free(m);
  ROT_CHECK(!rot_means_new(1, 0, 1, 256) && !rot_means_new(1, 4097, 1, 256));
  ROT_CHECK(!rot_means_new(1, 1, 0, 256) && !rot_means_new(SIZE_MAX / 2, 16, 1, 256));
  for (int i = 0; i < KIT_NO_SIZES; i++) ROT_CHECK(!rot_means_new(1, 1, 1, kit_no_block_rows[i]));
}

/* The numbers that files keep. */
static void known_rows(void) {
  const double x[] = {0x1p60, 1.0, 2.0, 6.0, 4.0, 7.0}, *column[] = {x};
  static const kit_row want[] = {{-1, 200, 0, 131072.0}, {-1, 201, 0, 6.0}, {-1, 202, 0, 1.0},
                                 {-1, 203, 0, 2.0},      {-1, 204, 0, 4.0}, {-1, 205, 0, 4096.0},
                                 {0, 210, 0, 4.0},       {0, 210, 1, 2.0},  {0, 211, 0, 0x1p60},
                                 {0, 211, 1, 11.0},      {0, 212, 0, 9.0},  {0, 212, 1, 0.0}};
  rot_means *m = rot_means_new(1, 2, 4, 4096);
  ROT_CHECK_EQ_INT(rot_means_add(m, 131072, 6, column, NULL), ROT_OK);
  kit_table table = table_of(m);
  ROT_CHECK(kit_is(&table, sizeof want / sizeof want[0], want));
  kit_table_free(&table);
  rot_means_free(m);
}

/* Rounded sums: bits for each size of blocks, whatever the chunks. */
static void any_chunks(void) {
  enum { N = 70001 };
  double *x = malloc(N * sizeof *x);
  int *status = calloc(N, sizeof *status);
  uint64_t state = 31;
  char seen[KIT_SIZES][ROT_HASH_SIZE], got[ROT_HASH_SIZE];
  for (int i = 0; i < N; i++) x[i] = 1e6 * kit_uniform(&state) * kit_uniform(&state);
  for (int k = 0; k < KIT_SIZES; k++) {
    for (uint64_t size = 1; size <= 64; size *= 2) {
      rot_means *m = whole(3, 5, N, x, status, size, kit_block_rows[k]);
      kit_table table = table_of(m);
      kit_hash(&table, size == 1 ? seen[k] : got);
      ROT_CHECK(size == 1 || strcmp(seen[k], got) == 0);
      kit_table_free(&table);
      rot_means_free(m);
    }
    for (int j = 0; j < k; j++) ROT_CHECK(strcmp(seen[j], seen[k]) != 0);
  }
  free(x);
  free(status);
}

/* Blocks of different sizes are not merged, nor read for each other. */
static void mixed_sizes(void) {
  double x[512] = {0.0};
  const double *column[] = {x};
  rot_means *a = rot_means_new(1, 4, 1, 256), *b = rot_means_new(1, 4, 1, 512), *back;
  rot_tree *tree = rot_tree_new(type);
  ROT_CHECK_EQ_INT(rot_means_add(a, 0, 257, column, NULL), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_means_add(a, 0, 256, column, NULL), ROT_OK);
  ROT_CHECK_EQ_INT(rot_means_add(b, 256, 256, column, NULL), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_means_add(b, 512, 256, column, NULL), ROT_OK);
  b->span.first_row = 256;
  ROT_CHECK_EQ_INT(rot_means_merge(a, b), ROT_EVALUE);
  b->span.first_row = 512;
  ROT_CHECK_EQ_INT(rot_tree_add(tree, a), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_add(tree, b), ROT_EVALUE);
  kit_table table = table_of(b);
  for (int i = 0; i < KIT_NO_SIZES; i++) {
    table.rows.value[5] = (double)kit_no_block_rows[i];
    ROT_CHECK_EQ_INT(rot_means_read(table.n, &table.rows, &back), ROT_EVALUE);
  }
  table.rows.value[5] = 1024.0; /* row 512 begins no block */
  ROT_CHECK_EQ_INT(rot_means_read(table.n, &table.rows, &back), ROT_EVALUE);
  kit_table_free(&table);
  rot_means_free(b);
  rot_tree_free(tree);
}

/* Independent normal values: (mean/se)^2 has the mean 15/13 of Student's t. */
static void coverage(void) {
  double squares = 0.0;
  const int trials = 400;
  uint64_t state = 4;
  int *status = calloc(3200, sizeof *status);
  double *x = malloc(3200 * sizeof *x), mean, se;
  for (int t = 0; t < trials; t++) {
    for (int i = 0; i < 3200; i++) x[i] = kit_normal(&state);
    rot_means *m = whole(16, t % 2 ? 1 : 200, 3200, x, status, 1, t % 3 ? 65536 : 256);
    rot_means_estimate(m, 0, &mean, &se);
    squares += mean * mean / (se * se) / trials;
    rot_means_free(m);
  }
  ROT_CHECK(squares > 0.85 && squares < 1.5);
  free(x);
  free(status);
}

static void damages(void) {
  uint64_t state = 2;
  double x[300];
  int status[300] = {0};
  long refused = 0;
  for (int i = 0; i < 300; i++) x[i] = kit_uniform(&state);
  rot_means *m = whole(16, 1, 300, x, status, 1, 4096), *back;
  const kit_table table = table_of(m);
  for (int i = 0; i < 10000; i++) {
    kit_table damaged;
    kit_table_copy(&table, &damaged);
    kit_damage(&state, &damaged);
    const rot_status got = rot_means_read(damaged.n, &damaged.rows, &back);
    ROT_CHECK((got == ROT_OK || got == ROT_EVALUE) && (got == ROT_OK) == (back != NULL));
    refused += got != ROT_OK;
    if (back) {
      kit_table again = table_of(back);
      ROT_CHECK(kit_same(&damaged, &again));
      kit_table_free(&again);
    }
    rot_means_free(back);
    kit_table_free(&damaged);
  }
  printf("means: %ld of 10000 damages refused\n", refused);
  ROT_CHECK(refused > 6000);
  kit_table copy = table;
  kit_table_free(&copy);
  rot_means_free(m);
}

int main(void) {
  by_hand();
  known_rows();
  groups();
  any_chunks();
  mixed_sizes();
  coverage();
  damages();
  return rot_test_report("means");
}
