/* Summaries of rows: counts, extremes and statuses against plain loops, sums against exact ones,
 * all bits of the whole for any chunks, quantiles within their bound, the long form and its
 * damages. */
#include "ground/parallel.h"
#include "long_double.h"
#include "rot_test.h"
#include "summary/summary.h"
#include "summary_kit.h"

#include <float.h>

static const rot_tree_node *const type = &rot_summary_node;

static kit_table table_of(const rot_summary *s) {
  kit_table table = kit_table_new(rot_summary_rows_size(s));
  rot_summary_rows(s, &table.rows);
  return table;
}

/* One column in one block. */
static rot_summary *of_column(size_t n, const double x[], const int status[], double shift) {
  const double *column[] = {x};
  const rot_summary_block block = {0, n, column, status, NULL, 0.0, 0};
  rot_summary *s = rot_summary_new(1, &shift, 65536);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_OK);
  return s;
}

/* ---- known answers --------------------------------------------------------------------------- */

static void small_block(void) {
  const double x[] = {3.0, NAN, -2.0, INFINITY, 7.0, -INFINITY, 7.0, -2.0, NAN, 100.0, INFINITY};
  const double y[] = {0.0, -0.0, 1.0, 1.0, 0.0, -0.0, 1.0, 1.0, 1.0, -9.0, 0.0};
  const int status[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0};
  const double error[] = {1e-9, 2e-9, 4e-9, NAN, 4e-9, 0.0, 3e-9, 0.0, 0.0, 1.0, 0.0};
  const double *column[] = {x, y}, shift[] = {1.0, -1.0};
  const rot_summary_block block = {5 * 65536, 11, column, status, error, 2e-9, 4};
  const uint64_t first = 5 * 65536;
  rot_summary *s = rot_summary_new(2, shift, 65536);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_OK);
  const rot_summary_column *c = &s->column[0];
  ROT_CHECK_EQ_INT(c->finite, 5);
  ROT_CHECK_EQ_INT(c->nan, 2);
  ROT_CHECK_EQ_INT(c->plus_inf, 2);
  ROT_CHECK_EQ_INT(c->minus_inf, 1);
  ROT_CHECK_EQ_INT(c->nan_row, first + 1);
  ROT_CHECK_EQ_INT(c->plus_inf_row, first + 3);
  ROT_CHECK_EQ_INT(c->minus_inf_row, first + 5);
  ROT_CHECK(c->sum.hi == 13.0 && c->sum.lo == 0.0);
  ROT_CHECK(c->squares.hi == 4.0 + 9.0 + 36.0 + 36.0 + 9.0);
  ROT_CHECK(c->minimum == -2.0 && c->maximum == 7.0);
  ROT_CHECK_EQ_INT(c->minimum_row, first + 2);
  ROT_CHECK_EQ_INT(c->maximum_row, first + 4);
  ROT_CHECK_EQ_INT(c->buckets.n, 3);
  ROT_CHECK_ULP(rot_summary_mean(s, 0), 2.6, 0);
  ROT_CHECK_ULP(rot_summary_sd(s, 0), sqrt(20.3), 1);
  c++;
  ROT_CHECK_EQ_INT(c->finite, 10);
  ROT_CHECK(c->minimum == 0.0 && !signbit(c->minimum) && c->maximum == 1.0);
  ROT_CHECK_EQ_INT(c->minimum_row, first);
  ROT_CHECK_EQ_INT(c->maximum_row, first + 2);
  ROT_CHECK_ULP(rot_summary_mean(s, 1), 0.5, 0);
  ROT_CHECK_EQ_INT(c->buckets.n, 2);
  ROT_CHECK_EQ_INT(s->rows_with_status[0], 10);
  ROT_CHECK_EQ_INT(s->rows_with_status[3], 1);
  ROT_CHECK_EQ_INT(s->n_failed, 1);
  ROT_CHECK_EQ_INT(s->failed_row[0], first + 9);
  ROT_CHECK_EQ_INT(s->failed_status[0], 3);
  ROT_CHECK_EQ_INT(s->error_above, 4);
  ROT_CHECK_EQ_INT(s->error_unknown, 1);
  ROT_CHECK(s->has_error_max && s->error_max == 4e-9);
  ROT_CHECK_EQ_INT(s->error_max_row, first + 2);
  ROT_CHECK_EQ_INT(s->kept, 4);
  ROT_CHECK_EQ_INT(s->span.first_row, first);
  ROT_CHECK_EQ_INT(s->span.rows, 11);
  double low, high, lows[3], highs[3], counts[3];
  static const double want[][2] = {{0.0, -INFINITY}, {0.125, -INFINITY}, {0.126, -2.0},
                                   {0.25, -2.0},     {0.375, -2.0},      {0.5, 3.0},
                                   {0.75, 7.0},      {0.76, INFINITY},   {1.0, INFINITY}};
  for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
    ROT_CHECK_EQ_INT(rot_summary_quantile(s, 0, want[i][0], &low, &high), ROT_OK);
    ROT_CHECK(low <= want[i][1] && want[i][1] <= high);
    ROT_CHECK(i == 5 || i == 3 || i == 4 || low == high);
  }
  rot_summary_buckets(s, 0, lows, highs, counts);
  ROT_CHECK(lows[0] < -2.0 && highs[0] == -2.0 && counts[0] == 2.0);
  ROT_CHECK(lows[1] == 3.0 && highs[1] > 3.0 && counts[1] == 1.0);
  ROT_CHECK(lows[2] == 7.0 && highs[2] > 7.0 && counts[2] == 2.0);
  rot_summary_buckets(s, 0, NULL, NULL, NULL);
  rot_summary_free(s);
}

static void refused_blocks(void) {
  const double x[] = {1.0, 2.0}, *column[] = {x}, bad = NAN;
  int status[] = {0, 32};
  rot_summary_block block = {0, 2, column, status, NULL, 0.0, 0};
  rot_summary *s = rot_summary_new(1, NULL, 65536);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  status[1] = -1;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  ROT_CHECK_EQ_INT(s->rows_with_status[0], 0);
  status[1] = 31;
  block.kept = 3;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  block.kept = 2;
  block.first_row = 1;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  block.first_row = ROT_SWEEP_ROWS;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  block.first_row = 0;
  block.n = 0;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  block.n = 65537;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_summary_rows_size(s), 0);
  block.n = 2;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_OK);
  ROT_CHECK_EQ_INT(s->rows_with_status[31], 1);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_EVALUE);
  double low, high;
  ROT_CHECK_EQ_INT(rot_summary_quantile(s, 0, -0.1, &low, &high), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_summary_quantile(s, 0, 1.1, &low, &high), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_summary_quantile(s, 0, NAN, &low, &high), ROT_EVALUE);
  ROT_CHECK(isnan(low) && isnan(high));
  ROT_CHECK(rot_summary_new(1, &bad, 65536) == NULL);
  for (int i = 0; i < KIT_NO_SIZES; i++) {
    ROT_CHECK(rot_summary_new(1, NULL, kit_no_block_rows[i]) == NULL);
  }
  rot_summary_clear(s);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_OK);
  rot_summary_free(s);
  rot_summary_free(NULL);
}

static void nothing_finite(void) {
  const double x[] = {NAN, NAN, INFINITY};
  double low, high;
  for (size_t n = 2; n <= 3; n++) {
    rot_summary *s = of_column(n, x, NULL, 0.0), *back;
    ROT_CHECK(isnan(rot_summary_mean(s, 0)) && isnan(rot_summary_sd(s, 0)));
    ROT_CHECK_EQ_INT(rot_summary_quantile(s, 0, 0.5, &low, &high), ROT_OK);
    ROT_CHECK(n == 2 ? isnan(low) && isnan(high) : low == INFINITY && high == INFINITY);
    kit_table table = table_of(s);
    ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_OK);
    rot_summary_free(back);
    kit_table_free(&table);
    rot_summary_free(s);
  }
}

/* Extremes at each place of blocks of all small sizes, each lane, each edge of a piece. */
static void extremes_anywhere(void) {
  enum { N = 2100 };
  double x[N];
  int status[N] = {0};
  for (size_t i = 0; i < N; i++) x[i] = (double)(i % 5) - 2.0;
  for (size_t n = 1; n <= N; n += n < 12 ? 1 : 261) {
    for (size_t at = 0; at < n; at += n < 12 ? 1 : 37) {
      for (int bad = 0; bad < 3; bad++) {
        const double old = x[at], other = x[0];
        x[at] = 9.0;
        if (bad == 1 && at > 0) x[0] = NAN;
        status[0] = bad == 2 && at > 0;
        rot_summary *s = of_column(n, x, status, 0.0);
        ROT_CHECK(s->column[0].maximum == 9.0 && s->column[0].maximum_row == at);
        rot_summary_free(s);
        x[at] = -9.0;
        s = of_column(n, x, status, 0.0);
        ROT_CHECK(s->column[0].minimum == -9.0 && s->column[0].minimum_row == at);
        rot_summary_free(s);
        x[at] = old;
        x[0] = other;
        status[0] = 0;
      }
    }
  }
}

static void large_values(void) {
  const double x[] = {1e308, 1e308, -1e308, 1.0}, y[] = {1e200, -1e200, 1.0};
  rot_summary *s = of_column(4, x, NULL, 0.0);
  ROT_CHECK(s->column[0].sum.lo == 0.0 || isfinite(s->column[0].sum.hi));
  ROT_CHECK(rot_summary_sd(s, 0) == INFINITY);
  rot_summary_free(s);
  s = of_column(3, y, NULL, 0.0);
  ROT_CHECK_ULP(rot_summary_mean(s, 0), 1.0 / 3.0, 0);
  ROT_CHECK(s->column[0].squares.hi == INFINITY && s->column[0].squares.lo == 0.0);
  kit_table table = table_of(s);
  rot_summary *back;
  ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_OK);
  rot_summary_free(back);
  kit_table_free(&table);
  rot_summary_free(s);
  double many[64];
  for (int i = 0; i < 64; i++) many[i] = i < 32 ? 1e308 : -1e308;
  s = of_column(64, many, NULL, 0.0);
  ROT_CHECK(!isfinite(s->column[0].sum.hi) && s->column[0].sum.lo == 0.0);
  rot_summary_free(s);
}

/* Whole numbers, so that sums and squares are exact; and a large shift. */
static void exact_sums(void) {
  enum { N = 65536 };
  uint64_t state = 8;
  double *x = malloc(N * sizeof *x);
  int64_t sum = 0, squares = 0;
  const double shift = 1e9;
  for (size_t i = 0; i < N; i++) {
    const int64_t d = (int64_t)kit_below(&state, 1 << 20) - (1 << 19);
    x[i] = shift + (double)d;
    sum += d;
    squares += d * d;
  }
  rot_summary *s = of_column(N, x, NULL, shift);
  const rot_dd rest = rot_dd_sub(s->column[0].sum, rot_dd_mul2(N, shift));
  ROT_CHECK(rest.hi + rest.lo == (double)sum);
  ROT_CHECK(s->column[0].squares.hi == (double)squares);
  ROT_CHECK(s->column[0].squares.lo == (double)(squares - (int64_t)s->column[0].squares.hi));
  const double mean = (double)sum / N;
  ROT_CHECK_REL(rot_summary_sd(s, 0), sqrt(((double)squares - N * mean * mean) / (N - 1)), 1e-12);
  ROT_CHECK_ULP(rot_summary_mean(s, 0), shift + mean, 1);
  rot_summary_free(s);
  /* A sum that cancels to 3 beside 1e16: each value has its negative elsewhere. */
  for (size_t i = 0; i < N / 2; i++) {
    x[i] = 1e16 * kit_normal(&state);
    x[N - 1 - i] = -x[i];
  }
  x[100] = 1.0;
  x[N - 101] = 2.0;
  s = of_column(N, x, NULL, 0.0);
  ROT_CHECK_ULP(s->column[0].sum.hi, 3.0, 0);
  rot_summary_free(s);
  /* Against long double where terms have one sign: its error is below 2^-64 65536. */
  if (long_double_is_longer("sums")) {
    long double wanted = 0.0L, wanted_squares = 0.0L;
    for (size_t i = 0; i < N; i++) {
      x[i] = exp(kit_normal(&state));
      wanted += x[i];
      wanted_squares += (long double)((x[i] - 0.3) * (x[i] - 0.3));
    }
    s = of_column(N, x, NULL, 0.3);
    const rot_dd a = s->column[0].sum, b = s->column[0].squares;
    ROT_CHECK(fabsl(((long double)a.hi + a.lo) / wanted - 1.0L) < 0x1p-52L);
    ROT_CHECK(fabsl(((long double)b.hi + b.lo) / wanted_squares - 1.0L) < 0x1p-52L);
    ROT_CHECK(a.lo != 0.0 && b.lo != 0.0);
    rot_summary_free(s);
  }
  free(x);
}

/* ---- a sweep in any chunks ------------------------------------------------------------------- */

enum { COLUMNS = 3 };

static const double shifts[COLUMNS] = {0.5, 0.0, -3.0};

/* Value of a column of a row, status and error: functions of the row alone. */
static double value_of(uint64_t row, int column) {
  uint64_t state = row * 8 + (uint64_t)column;
  const double u = kit_uniform(&state);
  if (column == 0) return row % 100000 == 70001 ? NAN : u;
  if (column == 1) return 1e3 * (u - 0.5) * (u - 0.5) * (u - 0.5);
  return row % 65536 == 5 ? INFINITY : row == 9 ? -INFINITY : floor(10.0 * u) - 5.0;
}

static int status_of(uint64_t row) { return row % 5003 == 17 ? (int)(row % 31) + 1 : 0; }

static double error_of(uint64_t row) {
  uint64_t state = row ^ 0x5555;
  return row % 30011 == 3 ? NAN : 1e-9 * kit_uniform(&state);
}

static rot_summary *block_of(uint64_t block, uint64_t rows, uint64_t block_rows) {
  const uint64_t first = block * block_rows;
  const size_t n = (size_t)(rows - first < block_rows ? rows - first : block_rows);
  double *x = malloc((COLUMNS + 1) * n * sizeof *x);
  int *status = malloc(n * sizeof *status);
  const double *column[COLUMNS];
  uint64_t kept = 0;
  for (int k = 0; k < COLUMNS; k++) {
    column[k] = x + (size_t)k * n;
    for (size_t i = 0; i < n; i++) x[(size_t)k * n + i] = value_of(first + i, k);
  }
  for (size_t i = 0; i < n; i++) {
    status[i] = status_of(first + i);
    x[COLUMNS * n + i] = error_of(first + i);
    kept += x[n + i] > 10.0;
  }
  const rot_summary_block in = {first, n, column, status, x + COLUMNS * n, 9e-10, kept};
  rot_summary *s = rot_summary_new(COLUMNS, shifts, block_rows);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &in), ROT_OK);
  free(status);
  free(x);
  return s;
}

static rot_summary *copy_of(const rot_summary *s) {
  kit_table table = table_of(s), again;
  rot_summary *copy = NULL;
  ROT_CHECK(kit_sorted(&table));
  ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &copy), ROT_OK);
  again = table_of(copy);
  ROT_CHECK(kit_same(&table, &again));
  kit_table_free(&again);
  kit_table_free(&table);
  return copy;
}

/* Chunks of `size` blocks, whose parts and which themselves arrive in the order of `turn` (odd). */
static rot_summary *in_chunks(uint64_t blocks, rot_summary *const block[], uint64_t size,
                              uint64_t turn) {
  rot_tree *tree = rot_tree_new(type), *part = rot_tree_new(type);
  void *node = NULL;
  uint64_t places = 64;
  while (places * size < blocks) places *= 2;
  for (uint64_t i = 0; i < places; i++) {
    const uint64_t chunk = i * turn % places;
    if (chunk * size >= blocks) continue;
    for (uint64_t k = 0; k < size; k++) {
      const uint64_t b = chunk * size + k * turn % size;
      if (b < blocks) ROT_CHECK_EQ_INT(rot_tree_add(part, copy_of(block[b])), ROT_OK);
    }
    ROT_CHECK_EQ_INT(rot_tree_finish(part, &node), ROT_OK);
    rot_summary *read = copy_of(node);
    rot_summary_free(node);
    ROT_CHECK_EQ_INT(rot_tree_add(tree, read), ROT_OK);
  }
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  rot_tree_free(tree);
  rot_tree_free(part);
  return node;
}

static void check_against_loops(const rot_summary *s, uint64_t rows) {
  uint64_t statuses[32] = {0}, above = 0, unknown = 0, max_row = 0, n_failed = 0, kept = 0;
  double max = -1.0;
  for (uint64_t row = 0; row < rows; row++) {
    const int status = status_of(row);
    statuses[status]++;
    kept += value_of(row, 1) > 10.0;
    if (status && n_failed < 100) {
      ROT_CHECK(s->failed_row[n_failed] == row && s->failed_status[n_failed] == status);
    }
    n_failed += status != 0;
    if (status) continue;
    const double error = error_of(row);
    above += isnan(error) || error > 9e-10;
    unknown += isnan(error) ? 1 : 0;
    if (error > max) {
      max = error;
      max_row = row;
    }
  }
  ROT_CHECK(memcmp(statuses, s->rows_with_status, sizeof statuses) == 0);
  ROT_CHECK_EQ_INT(s->n_failed, n_failed < 100 ? n_failed : 100);
  ROT_CHECK_EQ_INT(s->error_above, above);
  ROT_CHECK_EQ_INT(s->error_unknown, unknown);
  ROT_CHECK(s->error_max == max && s->error_max_row == max_row);
  ROT_CHECK_EQ_INT(s->kept, kept);
  ROT_CHECK(s->span.first_row == 0 && s->span.rows == rows);
  for (int k = 0; k < COLUMNS; k++) {
    const rot_summary_column *c = &s->column[k];
    uint64_t finite = 0, nan = 0, plus = 0, minus = 0, low_row = 0, high_row = 0;
    uint64_t nan_row = 0, plus_row = 0, minus_row = 0;
    double low = INFINITY, high = -INFINITY, sum = 0.0, lo = 0.0, squares = 0.0, squares_lo = 0.0;
    for (uint64_t row = 0; row < rows; row++) {
      const double x = value_of(row, k);
      if (status_of(row)) continue;
      if (isnan(x) && nan++ == 0) nan_row = row;
      if (x == INFINITY && plus++ == 0) plus_row = row;
      if (x == -INFINITY && minus++ == 0) minus_row = row;
      if (!isfinite(x)) continue;
      finite++;
      if (x < low) {
        low = x;
        low_row = row;
      }
      if (x > high) {
        high = x;
        high_row = row;
      }
      rot_accumulate(&sum, &lo, x);
      rot_accumulate(&squares, &squares_lo, (x - shifts[k]) * (x - shifts[k]));
    }
    ROT_CHECK(c->finite == finite && c->nan == nan && c->plus_inf == plus && c->minus_inf == minus);
    ROT_CHECK(c->nan_row == nan_row && c->plus_inf_row == plus_row &&
              c->minus_inf_row == minus_row);
    ROT_CHECK(c->minimum == low && c->minimum_row == low_row);
    ROT_CHECK(c->maximum == high && c->maximum_row == high_row);
    ROT_CHECK_ULP(c->sum.hi, sum + lo, 0);
    ROT_CHECK_ULP(c->squares.hi, squares + squares_lo, 0);
    uint64_t counted = 0;
    for (size_t i = 0; i < c->buckets.n; i++) counted += c->buckets.at[i].count;
    ROT_CHECK_EQ_INT(counted, finite);
  }
}

/* All bits for any chunks of blocks of one size => their hash */
static void check_chunks(uint64_t rows, uint64_t block_rows, char want[ROT_HASH_SIZE]) {
  const uint64_t blocks = rot_extent_blocks((rot_extent){0, rows, block_rows});
  rot_summary **block = malloc(blocks * sizeof(rot_summary *));
  char got[ROT_HASH_SIZE];
  for (uint64_t b = 0; b < blocks; b++) block[b] = block_of(b, rows, block_rows);
  for (uint64_t size = 1; size <= 64; size *= 4) {
    for (uint64_t turn = 1; turn <= 27; turn += 26) {
      rot_summary *s = in_chunks(blocks, block, size, turn);
      kit_table table = table_of(s);
      kit_hash(&table, got);
      if (size == 1 && turn == 1) {
        memcpy(want, got, sizeof got);
        check_against_loops(s, rows);
      }
      ROT_CHECK(strcmp(want, got) == 0);
      kit_table_free(&table);
      rot_summary_free(s);
    }
  }
  /* Blocks as they come from rot_summary_add(), their values not counted yet. */
  rot_tree *tree = rot_tree_new(type);
  void *node = NULL;
  for (uint64_t b = blocks; b-- > 0;) {
    ROT_CHECK_EQ_INT(rot_tree_add(tree, block_of(b, rows, block_rows)), ROT_OK);
  }
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  rot_summary *s = node;
  for (int k = 0; k < COLUMNS; k++) ROT_CHECK(s->column[k].buckets.later == NULL);
  kit_table table = table_of(s);
  kit_hash(&table, got);
  ROT_CHECK(strcmp(want, got) == 0);
  kit_table_free(&table);
  rot_summary_free(s);
  rot_tree_free(tree);
  for (uint64_t b = 0; b < blocks; b++) rot_summary_free(block[b]);
  free(block);
}

static void any_chunks(void) {
  static const uint64_t row_counts[] = {
      1, 300, 65535, 65536, 65537, 5 * 65536 + 77, 19 * 65536, 22 * 65536 - 1};
  const size_t last = getenv("ROTDYN_LONG") || rot_test_trials(16) > 1 ? 8 : 6;
  for (size_t i = 0; i < last; i++) {
    char hash[KIT_SIZES][ROT_HASH_SIZE];
    for (int k = 0; k < KIT_SIZES; k++) {
      if (kit_block_rows[k] == 256 && i > 5) continue; /* some seconds */
      check_chunks(row_counts[i], kit_block_rows[k], hash[k]);
    }
  }
}

static rot_summary *of_values(uint64_t block_rows, uint64_t first, size_t n, const double x[]) {
  const double *column[] = {x};
  const rot_summary_block block = {first, n, column, NULL, NULL, 0.0, 0};
  rot_summary *s = rot_summary_new(1, NULL, block_rows);
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_OK);
  return s;
}

/* Values of a small block are counted when they are asked for, and once. */
static void counted_later(void) {
  double x[512], low, high, limits[512], count[512];
  uint64_t state = 41;
  for (int i = 0; i < 512; i++) x[i] = i % 9 ? kit_normal(&state) : i % 2 ? -0x1p-1060 * i : 0.0;
  rot_summary *large = of_values(65536, 0, 512, x);
  for (int how = 0; how < 6; how++) {
    rot_summary *s = of_values(512, 0, how == 4 ? 300 : 512, x), *more, *back;
    ROT_CHECK(s->column[0].buckets.later && s->column[0].buckets.n == 0);
    kit_table table;
    switch (how) {
    case 0: ROT_CHECK_EQ_INT(rot_summary_count(s), ROT_OK); break;
    case 1: rot_summary_quantile(s, 0, 0.5, &low, &high); break;
    case 2: ROT_CHECK(rot_summary_rows_size(s) > 0); break;
    case 3: /* through the long form */
      table = table_of(s);
      ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_OK);
      rot_summary_free(s);
      s = back;
      kit_table_free(&table);
      break;
    case 4: /* emptied, filled again */
      rot_summary_clear(s);
      ROT_CHECK_EQ_INT(s->span.block_rows, 512);
      rot_summary_free(s);
      s = of_values(512, 0, 512, x);
      ROT_CHECK_EQ_INT(rot_summary_count(s), ROT_OK);
      ROT_CHECK_EQ_INT(rot_summary_count(s), ROT_OK);
      break;
    default:
      rot_summary_free(s);
      s = of_values(256, 0, 256, x);
      more = of_values(256, 256, 256, x + 256);
      ROT_CHECK_EQ_INT(rot_summary_merge(s, more), ROT_OK);
      rot_summary_free(more);
      break;
    }
    const rot_buckets *a = &s->column[0].buckets, *b = &large->column[0].buckets;
    ROT_CHECK(a->later == NULL && a->n == b->n);
    for (size_t i = 0; i < a->n; i++) {
      ROT_CHECK(a->at[i].bucket == b->at[i].bucket && a->at[i].count == b->at[i].count);
    }
    rot_summary_buckets(s, 0, limits, NULL, count);
    ROT_CHECK(limits[0] <= s->column[0].minimum);
    rot_summary_free(s);
  }
  rot_summary_free(large);
}

/* A part that is counted among others that are not; more than 2^16 rows. */
static void mixed_parts(void) {
  enum { N = 65536 + 4096 + 300 };
  char want[ROT_HASH_SIZE], got[ROT_HASH_SIZE];
  for (int how = 0; how < 3; how++) {
    rot_tree *tree = rot_tree_new(type);
    void *node = NULL;
    for (uint64_t b = 0; b * 256 < N; b++) {
      rot_summary *s = block_of(b, N, 256);
      if (how == 1 ? b % 3 == 0 : how == 2 && b % 2 == 0) {
        ROT_CHECK_EQ_INT(rot_summary_count(s), ROT_OK);
      }
      ROT_CHECK_EQ_INT(rot_tree_add(tree, s), ROT_OK);
    }
    ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
    rot_tree_free(tree);
    kit_table table = table_of(node);
    kit_hash(&table, how ? got : want);
    ROT_CHECK(how == 0 || strcmp(want, got) == 0);
    kit_table_free(&table);
    rot_summary_free(node);
  }
}

/* Blocks of different sizes are not merged, nor read for each other. */
static void mixed_sizes(void) {
  double x[512] = {0.0};
  const double *column[] = {x};
  rot_summary *a = of_values(256, 0, 256, x), *b = of_values(512, 512, 256, x), *back;
  rot_summary *empty = rot_summary_new(1, NULL, 256);
  rot_summary_block block = {0, 257, column, NULL, NULL, 0.0, 0};
  ROT_CHECK_EQ_INT(rot_summary_add(empty, &block), ROT_EVALUE);
  block.first_row = 128;
  block.n = 128;
  ROT_CHECK_EQ_INT(rot_summary_add(empty, &block), ROT_EVALUE);
  rot_summary_free(empty);
  rot_tree *tree = rot_tree_new(type);
  b->span.first_row = 256;
  ROT_CHECK_EQ_INT(rot_summary_merge(a, b), ROT_EVALUE);
  ROT_CHECK_EQ_INT(type->merge(a, b), ROT_EVALUE);
  b->span.first_row = 512;
  ROT_CHECK_EQ_INT(rot_tree_add(tree, a), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_add(tree, b), ROT_EVALUE);
  kit_table table = table_of(b);
  size_t i = 0;
  while (table.rows.kind[i] != ROT_KIND_BLOCK_ROWS) i++;
  for (int k = 0; k < KIT_NO_SIZES; k++) {
    table.rows.value[i] = (double)kit_no_block_rows[k];
    ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_EVALUE);
  }
  table.rows.value[i] = 1024.0; /* row 512 begins no block */
  ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_EVALUE);
  table.rows.value[i] = 256.0; /* a block of another sweep */
  ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_OK);
  rot_summary_free(back);
  kit_table_free(&table);
  rot_summary_free(b);
  rot_tree_free(tree);
}

/* Blocks made by two threads in the order in which they come. */
typedef struct job {
  uint64_t rows, block_rows;
  rot_summary **block;
} job;

static void work(const void *frame, size_t first, size_t last) {
  const job *j = frame;
  for (size_t b = first; b < last; b++) j->block[b] = block_of(b, j->rows, j->block_rows);
}

static void merges(uint64_t block_rows) {
  rot_summary *block[4], *other = rot_summary_new(COLUMNS, NULL, block_rows);
  const job j = {4 * block_rows, block_rows, block};
  rot_info info;
  ROT_CHECK_EQ_INT(rot_parallel_rows(work, &j, 4, 1, 2, NULL, &info), ROT_OK);
  kit_table before = table_of(block[0]), after;
  ROT_CHECK_EQ_INT(rot_summary_merge(block[0], block[2]), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_summary_merge(block[1], block[2]), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_summary_merge(block[1], block[0]), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_summary_merge(block[0], block[0]), ROT_EVALUE);
  other->span = block[1]->span;
  ROT_CHECK_EQ_INT(rot_summary_merge(block[0], other), ROT_EVALUE); /* other shifts */
  after = table_of(block[0]);
  ROT_CHECK(kit_same(&before, &after));
  kit_table_free(&before);
  kit_table_free(&after);
  ROT_CHECK_EQ_INT(rot_summary_merge(block[0], block[1]), ROT_OK);
  ROT_CHECK_EQ_INT(block[0]->span.rows, 2 * block_rows);
  for (int b = 0; b < 4; b++) rot_summary_free(block[b]);
  rot_summary_free(other);
}

/* ---- quantiles ------------------------------------------------------------------------------- */

static double draw(int kind, uint64_t *state) {
  const double z = kit_normal(state), u = kit_uniform(state);
  switch (kind % 16) {
  case 0: return z;
  case 1: return exp(2.0 * z);
  case 2: return 3.0 + u;
  case 3: return -log(u);
  case 4: return tan(3.141592653589793 * (u - 0.5));
  case 5: return floor(7.0 * u);
  case 6: return -exp(z);
  case 7: return 1e3 * z + 100.0;
  case 8: return 1e-300 * z;
  case 9: return 1e300 * z;
  case 10: return 0x1p-1040 * z; /* subnormal */
  case 11: return 0x1p-1068 * z; /* a few bits */
  case 12: return u < 0.3 ? 0.0 : u < 0.6 ? -0.0 : z;
  case 13: return 42.0;
  case 14: return u < 0.1 ? INFINITY : u < 0.15 ? -INFINITY : u < 0.2 ? NAN : z;
  default: return u < 0.5 ? exp(300.0 * z) : -exp(300.0 * z);
  }
}

static int by_value(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void quantiles(void) {
  enum { MANY = 20000 };
  uint64_t state = 77;
  double *x = malloc(MANY * sizeof *x), loosest = 0.0, widest = 0.0;
  for (int d = 0; d < rot_test_trials(200); d++) {
    const size_t n = d % 3 == 0 ? MANY : 1 + kit_below(&state, 3000);
    for (size_t i = 0; i < n; i++) x[i] = draw(d, &state);
    rot_summary *s = of_column(n, x, NULL, 0.0);
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
      if (!isnan(x[i])) x[m++] = x[i];
    }
    qsort(x, m, sizeof *x, by_value);
    for (int k = 0; k <= 1000; k++) {
      const double p = k / 1000.0;
      size_t rank = (size_t)ceil(p * (double)m);
      double low, high;
      ROT_CHECK_EQ_INT(rot_summary_quantile(s, 0, p, &low, &high), ROT_OK);
      if (m == 0) {
        ROT_CHECK(isnan(low));
        continue;
      }
      if (rank == 0) rank = 1;
      const double want = x[rank - 1], middle = rot_summary_middle(low, high);
      ROT_CHECK(low <= want && want <= high);
      if (isinf(want)) continue;
      const double width = high - low, size = fmin(fabs(low), fabs(high));
      ROT_CHECK(width == 0.0 || width * 256.0 < size);
      /* 2^-9 of subnormal numbers is not one: compared 512 times as large. */
      const double off = fabs(middle - want);
      ROT_CHECK(off == 0.0 || fabs(want) < 0x1p-1060 || off * 512.0 <= fabs(want));
      if (k == 0 || k == 1000) ROT_CHECK(low == high && low == want);
      if (size > 0x1p-1000) {
        loosest = fmax(loosest, off / fabs(want));
        widest = fmax(widest, width / size);
      }
    }
    rot_summary_free(s);
  }
  free(x);
  printf("summary: quantiles off by at most %.3g of 2^-9, interval at most %.4g of 2^-8\n",
         loosest * 512.0, widest * 256.0);
  ROT_CHECK(loosest * 512.0 > 0.5 && widest * 256.0 > 0.9);
}

/* ---- long form ------------------------------------------------------------------------------- */

static void kinds(void) {
  ROT_CHECK(strcmp(rot_kind_name(ROT_KIND_BUCKET), "bucket") == 0);
  ROT_CHECK(strcmp(rot_kind_name(0), "first_row") == 0);
  ROT_CHECK(strcmp(rot_kind_name(212), "mean_sum_low") == 0);
  ROT_CHECK(strcmp(rot_kind_name(9), "block_rows") == 0);
  ROT_CHECK(strcmp(rot_kind_name(105), "index_block_rows") == 0);
  ROT_CHECK(strcmp(rot_kind_name(205), "mean_block_rows") == 0);
  ROT_CHECK(rot_kind_name(22) == NULL && rot_kind_name(-1) == NULL && rot_kind_name(300) == NULL);
}

/* The numbers that files keep: 65536 and on: 3, NaN, -Inf, 0x1p60, failed, 1, Inf, 1. */
static void known_rows(void) {
  const double x[] = {3.0, NAN, -INFINITY, 0x1p60, 9.0, 1.0, INFINITY, 1.0}, *column[] = {x};
  const double error[] = {0.5, 3.0, NAN, 1.0, 9.0, 3.0, 0.0, 0.0}, shift = 2.0;
  const int status[] = {0, 0, 0, 0, 6, 0, 0, 0};
  const rot_summary_block block = {65536, 8, column, status, error, 1.0, 2};
  static const kit_row want[] = {
      {-1, 0, 0, 65536.0},     {-1, 1, 0, 8.0},          {-1, 2, 0, 1.0},
      {-1, 3, 0, 2.0},         {-1, 4, 0, 7.0},          {-1, 4, 6, 1.0},
      {-1, 5, 65540, 6.0},     {-1, 6, 0, 3.0},          {-1, 7, 0, 1.0},
      {-1, 8, 65537, 3.0},     {-1, 9, 0, 65536.0},      {0, 10, 0, 2.0},
      {0, 11, 0, 4.0},         {0, 12, 65537, 1.0},      {0, 13, 65542, 1.0},
      {0, 14, 65538, 1.0},     {0, 15, 0, 0x1p60},       {0, 16, 0, 5.0},
      {0, 17, 0, 0x1p120},     {0, 18, 0, 3.0},          {0, 19, 65541, 1.0},
      {0, 20, 65539, 0x1p60},  {0, 21, 256 * 1075, 2.0}, {0, 21, 256 * 1076 + 128, 1.0},
      {0, 21, 256 * 1135, 1.0}};
  rot_summary *s = rot_summary_new(1, &shift, 65536), *back;
  ROT_CHECK_EQ_INT(rot_summary_add(s, &block), ROT_OK);
  kit_table table = table_of(s);
  ROT_CHECK(kit_is(&table, sizeof want / sizeof want[0], want));
  table.rows.value[6] = 5.0; /* a failure with a status that no row has */
  ROT_CHECK_EQ_INT(rot_summary_read(table.n, &table.rows, &back), ROT_EVALUE);
  kit_table_free(&table);
  rot_summary_free(s);
}

/* Standard deviations far from 1, shifts far from the mean. */
static void deviations(void) {
  const double x[] = {1.0, 2.0, 4.0, 5.0};
  for (int e = -400; e <= 400; e += 100) {
    double y[4];
    for (int i = 0; i < 4; i++) y[i] = ldexp(x[i], e);
    for (int k = -2; k <= 2; k++) {
      rot_summary *s = of_column(4, y, NULL, ldexp(k, e));
      ROT_CHECK_REL(rot_summary_sd(s, 0), ldexp(sqrt(10.0 / 3.0), e), 1e-15);
      ROT_CHECK_ULP(rot_summary_mean(s, 0), ldexp(3.0, e), 0);
      rot_summary_free(s);
    }
  }
  rot_summary *s = of_column(1, x, NULL, 0.0);
  ROT_CHECK(isnan(rot_summary_sd(s, 0)) && rot_summary_mean(s, 0) == 1.0);
  rot_summary_free(s);
}

/* A damage is refused, or it gives another summary that is written with the same bits: of a sum, a
 * key of an extreme within the rows, ... */
static void damages(void) {
  uint64_t state = 12;
  rot_summary *s[3];
  kit_table table[3];
  long refused = 0, kept = 0;
  for (int i = 0; i < 3; i++) {
    const double x[] = {1.0, NAN, -3.0, INFINITY, 8.0, 1.5, -INFINITY, 0.0};
    const int status[] = {0, 0, 0, 0, 4, 0, 0, 7};
    s[i] = i == 0   ? block_of(0, 300, 4096)
           : i == 1 ? block_of(3, 4 * 65536, 65536)
                    : of_column(8, x, status, 0);
    table[i] = table_of(s[i]);
  }
  /* All cases also under the sanitizers: a short form takes no time. */
  for (int i = 0; i < 10000; i++) {
    const int from = i % 50 ? 2 * (i % 2) : 1;
    kit_table damaged;
    rot_summary *back;
    kit_table_copy(&table[from], &damaged);
    kit_damage(&state, &damaged);
    if (kit_below(&state, 4) == 0 && damaged.n > 0) kit_damage(&state, &damaged);
    const rot_status status = rot_summary_read(damaged.n, &damaged.rows, &back);
    ROT_CHECK(status == ROT_EVALUE || status == ROT_OK);
    ROT_CHECK((status == ROT_OK) == (back != NULL));
    if (back) {
      kit_table again = table_of(back);
      ROT_CHECK(kit_same(&damaged, &again));
      kept += !kit_same(&damaged, &table[from]);
      kit_table_free(&again);
    }
    refused += status != ROT_OK;
    rot_summary_free(back);
    kit_table_free(&damaged);
  }
  printf("summary: %ld of 10000 damages refused, %ld read as other rows\n", refused, kept);
  ROT_CHECK(refused > 7000);
  for (int i = 0; i < 3; i++) {
    rot_summary_free(s[i]);
    kit_table_free(&table[i]);
  }
}

/* Damages that must be refused, each of its own kind. */
static void known_damages(void) {
  const double x[] = {1.0, NAN, -3.0, 8.0, 1.5};
  const int status[] = {0, 0, 0, 4, 0};
  rot_summary *s = of_column(5, x, status, 0.0), *back;
  const kit_table table = table_of(s);
  static const struct {
    int kind;
    double value;
    int64_t key;
  } row[] = {{ROT_KIND_FIRST_ROW, 1.0, 0},
             {ROT_KIND_ROWS, 0.0, 0},
             {ROT_KIND_ROWS, 6.0, 0},
             {ROT_KIND_COLUMNS, 2.0, 0},
             {ROT_KIND_COLUMNS, 1e9, 0},
             {ROT_KIND_KEPT, 6.0, 0},
             {ROT_KIND_KEPT, -1.0, 0},
             {ROT_KIND_KEPT, 0.5, 0},
             {ROT_KIND_KEPT, -0.0, 0},
             {ROT_KIND_FAILED, 5.0, 3},
             {ROT_KIND_FAILED, 4.0, 5},
             {ROT_KIND_FAILED, 0.0, 3},
             {ROT_KIND_SHIFT, NAN, 0},
             {ROT_KIND_FINITE, 4.0, 0},
             {ROT_KIND_FINITE, 2.0, 0},
             {ROT_KIND_NAN, 1.0, 5},
             {ROT_KIND_NAN, 0.0, 1},
             {ROT_KIND_NAN, 1.0, -1},
             {ROT_KIND_SUM_LOW, 1.0, 0},
             {ROT_KIND_SQUARES, -1.0, 0},
             {ROT_KIND_MINIMUM, -9.0, 2},
             {ROT_KIND_MINIMUM, INFINITY, 2},
             {ROT_KIND_MAXIMUM, 1.5, 5},
             {ROT_KIND_MAXIMUM, 9.0, 4},
             {ROT_KIND_BUCKET, 1.0, 1},
             {ROT_KIND_BUCKET, 2.0, -275584},
             {ROT_KIND_ERROR_ABOVE, 5.0, 0},
             {ROT_KIND_ERROR_UNKNOWN, 1.0, 0},
             {ROT_KIND_BLOCK_ROWS, 0.0, 0},
             {ROT_KIND_BLOCK_ROWS, 128.0, 0},
             {ROT_KIND_BLOCK_ROWS, 65537.0, 0},
             {ROT_KIND_BLOCK_ROWS, 131072.0, 0},
             {ROT_KIND_BLOCK_ROWS, 768.0, 0},
             {ROT_KIND_BLOCK_ROWS, NAN, 0},
             {ROT_KIND_BLOCK_ROWS, 256.0, 1}};
  for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
    kit_table damaged;
    size_t i = 0;
    kit_table_copy(&table, &damaged);
    while (damaged.rows.kind[i] != row[k].kind) i++;
    damaged.rows.value[i] = row[k].value;
    damaged.rows.key[i] = row[k].key;
    ROT_CHECK_EQ_INT(rot_summary_read(damaged.n, &damaged.rows, &back), ROT_EVALUE);
    ROT_CHECK(back == NULL);
    kit_table_free(&damaged);
  }
  /* Any row missing, any row twice. */
  for (size_t i = 0; i < table.n; i++) {
    for (int twice = 0; twice < 2; twice++) {
      kit_table damaged = kit_table_new(table.n + 1);
      damaged.n = 0;
      for (size_t k = 0; k < table.n; k++) {
        for (int times = k == i ? 2 * twice : 1; times > 0; times--) {
          damaged.rows.quantity[damaged.n] = table.rows.quantity[k];
          damaged.rows.kind[damaged.n] = table.rows.kind[k];
          damaged.rows.key[damaged.n] = table.rows.key[k];
          damaged.rows.value[damaged.n++] = table.rows.value[k];
        }
      }
      ROT_CHECK_EQ_INT(rot_summary_read(damaged.n, &damaged.rows, &back), ROT_EVALUE);
      kit_table_free(&damaged);
    }
  }
  ROT_CHECK_EQ_INT(rot_summary_read(0, &table.rows, &back), ROT_EVALUE);
  kit_table copy = table;
  kit_table_free(&copy);
  rot_summary_free(s);
}

int main(void) {
  small_block();
  refused_blocks();
  nothing_finite();
  extremes_anywhere();
  large_values();
  exact_sums();
  any_chunks();
  counted_later();
  mixed_parts();
  mixed_sizes();
  for (int i = 0; i < KIT_SIZES; i++) merges(kit_block_rows[i]);
  quantiles();
  kinds();
  known_rows();
  deviations();
  known_damages();
  damages();
  return rot_test_report("summary");
}
