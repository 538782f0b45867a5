#include "summary/summary.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/pair.h"
#include "summary/sum.h"

/* A block is summed in pieces that stay in the first cache. */
enum { PIECE = 1024, LANES = 4 };

rot_summary *rot_summary_new(size_t n_columns, const double shift[], uint64_t block_rows) {
  if (!rot_extent_is_size(block_rows)) return NULL;
  for (size_t i = 0; shift && i < n_columns; i++) {
    if (!isfinite(shift[i])) return NULL;
  }
  rot_summary *summary = calloc(1, sizeof *summary);
  if (!summary) return NULL;
  summary->span.block_rows = block_rows;
  summary->n_columns = n_columns;
  summary->column = calloc(n_columns + 1, sizeof *summary->column);
  if (!summary->column) {
    free(summary);
    return NULL;
  }
  for (size_t i = 0; shift && i < n_columns; i++) summary->column[i].shift = shift[i];
  return summary;
}

void rot_summary_clear(rot_summary *summary) {
  const size_t n = summary->n_columns;
  const uint64_t block_rows = summary->span.block_rows;
  rot_summary_column *column = summary->column;
  for (size_t i = 0; i < n; i++) {
    const double shift = column[i].shift;
    rot_buckets_free(&column[i].buckets);
    memset(&column[i], 0, sizeof column[i]);
    column[i].shift = shift;
  }
  memset(summary, 0, sizeof *summary);
  summary->span.block_rows = block_rows;
  summary->n_columns = n;
  summary->column = column;
}

void rot_summary_free(rot_summary *summary) {
  if (!summary) return;
  rot_summary_clear(summary);
  free(summary->column);
  free(summary);
}

/* ---- sums and extremes of a piece ------------------------------------------------------------ */

typedef struct lanes {
  double sum[LANES], sum_low[LANES], squares[LANES], squares_low[LANES];
} lanes;

/* As many registers as make four lanes. */
#if defined(ROT_ALONE)
#define EACH(DO) DO(0) DO(1) DO(2) DO(3)
#else
#define EACH(DO) DO(0) DO(1)
#endif

/* Knuth's sum of s and x, its error added to lo. */
#define ADD(s, lo, x)                                                                              \
  do {                                                                                             \
    const rot_pair t_ = (s) + (x), b_ = t_ - (s);                                                  \
    (lo) += ((s) - (t_ - b_)) + ((x)-b_);                                                          \
    (s) = t_;                                                                                      \
  } while (0)

static void add_sums(lanes *to, double shift, size_t n, const double x[]) {
  const rot_pair origin = ROT_BOTH(shift);
  size_t i = 0;
#define LOAD(r)                                                                                    \
  rot_pair s##r = rot_load(to->sum + (r)*ROT_PAIR), sl##r = rot_load(to->sum_low + (r)*ROT_PAIR);  \
  rot_pair q##r = rot_load(to->squares + (r)*ROT_PAIR);                                            \
  rot_pair ql##r = rot_load(to->squares_low + (r)*ROT_PAIR);
#define STEP(r)                                                                                    \
  {                                                                                                \
    const rot_pair v = rot_load(x + i + (r)*ROT_PAIR), d = v - origin, dd = d * d;                 \
    ADD(s##r, sl##r, v);                                                                           \
    ADD(q##r, ql##r, dd);                                                                          \
  }
#define STORE(r)                                                                                   \
  rot_store(to->sum + (r)*ROT_PAIR, s##r);                                                         \
  rot_store(to->sum_low + (r)*ROT_PAIR, sl##r);                                                    \
  rot_store(to->squares + (r)*ROT_PAIR, q##r);                                                     \
  rot_store(to->squares_low + (r)*ROT_PAIR, ql##r);
  EACH(LOAD)
  for (; i + LANES <= n; i += LANES) {
    EACH(STEP)
  }
  EACH(STORE)
  for (int k = 0; i < n; i++, k++) {
    const double d = x[i] - shift;
    rot_accumulate(&to->sum[k], &to->sum_low[k], x[i]);
    rot_accumulate(&to->squares[k], &to->squares_low[k], d * d);
  }
}

/* => 1 if all values are finite, and then the extremes. x 0 is NaN for infinities. */
static int find_extremes(size_t n, const double x[], double *minimum, double *maximum) {
  double low[LANES], high[LANES], bad[LANES];
  size_t i = 0;
#define BEGIN(r)                                                                                   \
  rot_pair lower##r = ROT_BOTH(-INFINITY), upper##r = ROT_BOTH(-INFINITY), bad##r = ROT_BOTH(0.0);
#define LOOK(r)                                                                                    \
  {                                                                                                \
    const rot_pair v = rot_load(x + i + (r)*ROT_PAIR);                                             \
    upper##r = rot_pair_max(v, upper##r);                                                          \
    lower##r = rot_pair_max(-v, lower##r);                                                         \
    bad##r += v * ROT_BOTH(0.0);                                                                   \
  }
#define END(r)                                                                                     \
  rot_store(low + (r)*ROT_PAIR, lower##r);                                                         \
  rot_store(high + (r)*ROT_PAIR, upper##r);                                                        \
  rot_store(bad + (r)*ROT_PAIR, bad##r);
  EACH(BEGIN)
  for (; i + LANES <= n; i += LANES) {
    EACH(LOOK)
  }
  EACH(END)
  for (; i < n; i++) {
    high[0] = x[i] > high[0] ? x[i] : high[0];
    low[0] = -x[i] > low[0] ? -x[i] : low[0];
    bad[0] += x[i] * 0.0;
  }
  for (int k = 1; k < LANES; k++) {
    high[0] = high[k] > high[0] ? high[k] : high[0];
    low[0] = low[k] > low[0] ? low[k] : low[0];
    bad[0] += bad[k];
  }
  *minimum = -low[0];
  *maximum = high[0];
  return bad[0] == 0.0;
}

/* Index of the first value that equals x, which is there. */
static size_t first_equal(const double x[], double value) {
  size_t i = 0;
  while (x[i] != value) i++;
  return i;
}

/* ---- a block --------------------------------------------------------------------------------- */

static void note_first(uint64_t *count, uint64_t *first, uint64_t row) {
  if ((*count)++ == 0) *first = row;
}

static void note_other(rot_summary_column *column, uint64_t row, double x) {
  if (isnan(x)) {
    note_first(&column->nan, &column->nan_row, row);
  } else if (x > 0.0) {
    note_first(&column->plus_inf, &column->plus_inf_row, row);
  } else {
    note_first(&column->minus_inf, &column->minus_inf_row, row);
  }
}

/* Copies the finite values of rows with status 0 and counts the others. */
static size_t select_finite(rot_summary_column *column, uint64_t row, size_t n, const double x[],
                            const int status[], double value[], uint16_t at[]) {
  size_t kept = 0;
  for (size_t i = 0; i < n; i++) {
    const int failed = status && status[i] != 0, finite = fabs(x[i]) <= DBL_MAX;
    value[kept] = x[i];
    at[kept] = (uint16_t)i;
    kept += (size_t)(finite & !failed);
    if (!finite && !failed) note_other(column, row + i, x[i]);
  }
  return kept;
}

static rot_dd sum_of_lanes(const double sum[], const double low[]) {
  rot_dd s[LANES];
  for (int k = 0; k < LANES; k++) s[k] = rot_sum_of(sum[k], low[k]);
  return rot_sum_add(rot_sum_add(s[0], s[1]), rot_sum_add(s[2], s[3]));
}

/* failures[i]: the number of rows of piece i with a status other than 0. Without a counter values
 * are counted later. */
static rot_status add_column(rot_summary_column *column, const rot_summary_block *block,
                             const double x[], const uint16_t failures[],
                             rot_bucket_counter *counter) {
  double chosen[PIECE];
  uint16_t place[PIECE];
  lanes sums = {{0.0}, {0.0}, {0.0}, {0.0}};
  for (size_t first = 0; first < block->n; first += PIECE) {
    const uint64_t row = block->first_row + first;
    const double *value = x + first;
    const uint16_t *at = NULL;
    size_t n = block->n - first < PIECE ? block->n - first : PIECE;
    double low, high;
    if (failures[first / PIECE] || !find_extremes(n, value, &low, &high)) {
      n = select_finite(column, row, n, value, block->status ? block->status + first : NULL, chosen,
                        place);
      if (n == 0) continue;
      value = chosen;
      at = place;
      find_extremes(n, value, &low, &high);
    }
    add_sums(&sums, column->shift, n, value);
    if (column->finite == 0 || low < column->minimum) {
      const size_t i = first_equal(value, low);
      column->minimum = value[i];
      column->minimum_row = row + (at ? at[i] : i);
    }
    if (column->finite == 0 || high > column->maximum) {
      const size_t i = first_equal(value, high);
      column->maximum = value[i];
      column->maximum_row = row + (at ? at[i] : i);
    }
    column->finite += n;
    const rot_status status = counter ? rot_bucket_counter_add(counter, n, value)
                                      : rot_buckets_later(&column->buckets, n, value);
    if (status != ROT_OK) return status;
  }
  column->sum = sum_of_lanes(sums.sum, sums.sum_low);
  column->squares = sum_of_lanes(sums.squares, sums.squares_low);
  return counter ? rot_bucket_counter_take(counter, &column->buckets) : ROT_OK;
}

/* Counts rows by status and failures by piece. */
static rot_status add_statuses(rot_summary *summary, const rot_summary_block *block,
                               uint16_t failures[]) {
  if (!block->status) summary->rows_with_status[0] = block->n;
  for (size_t i = 0; block->status && i < block->n; i++) {
    const int status = block->status[i];
    if (status < 0 || status >= ROT_SUMMARY_STATUSES) return ROT_EVALUE;
    summary->rows_with_status[status]++;
    if (status == 0) continue;
    failures[i / PIECE]++;
    if (summary->n_failed == ROT_SUMMARY_FAILED) continue;
    summary->failed_row[summary->n_failed] = block->first_row + i;
    summary->failed_status[summary->n_failed++] = status;
  }
  return ROT_OK;
}

static void add_errors(rot_summary *summary, const rot_summary_block *block) {
  for (size_t i = 0; block->error && i < block->n; i++) {
    const double error = block->error[i];
    if (block->status && block->status[i] != 0) continue;
    summary->error_above += !(error <= block->accuracy);
    summary->error_unknown += isnan(error) ? 1 : 0;
    if (isnan(error) || (summary->has_error_max && !(error > summary->error_max))) continue;
    summary->has_error_max = 1;
    summary->error_max = error;
    summary->error_max_row = block->first_row + i;
  }
}

rot_status rot_summary_add(rot_summary *summary, const rot_summary_block *block) {
  const rot_extent span = {block->first_row, block->n, summary->span.block_rows};
  uint16_t failures[ROT_BLOCK_ROWS_MAX / PIECE] = {0};
  if (summary->span.rows > 0 || !rot_extent_is_block(span) || block->kept > block->n) {
    return ROT_EVALUE;
  }
  rot_status status = add_statuses(summary, block, failures);
  rot_bucket_counter *counter = NULL;
  if (status == ROT_OK && span.block_rows == ROT_BLOCK_ROWS_MAX) {
    counter = rot_bucket_counter_new();
    if (!counter) status = ROT_ENOMEM;
  }
  for (size_t i = 0; status == ROT_OK && i < summary->n_columns; i++) {
    status = add_column(&summary->column[i], block, block->column[i], failures, counter);
  }
  rot_bucket_counter_free(counter);
  if (status != ROT_OK) {
    rot_summary_clear(summary);
    return status;
  }
  add_errors(summary, block);
  summary->kept = block->kept;
  summary->span = span;
  return ROT_OK;
}

/* ---- merging --------------------------------------------------------------------------------- */

/* Of two counts with first rows, the left one has the lower rows. */
static void merge_count(uint64_t *count, uint64_t *row, uint64_t more, uint64_t more_row) {
  if (*count == 0) *row = more_row;
  *count += more;
}

static void merge_column(rot_summary_column *into, const rot_summary_column *from) {
  merge_count(&into->nan, &into->nan_row, from->nan, from->nan_row);
  merge_count(&into->plus_inf, &into->plus_inf_row, from->plus_inf, from->plus_inf_row);
  merge_count(&into->minus_inf, &into->minus_inf_row, from->minus_inf, from->minus_inf_row);
  into->sum = rot_sum_add(into->sum, from->sum);
  into->squares = rot_sum_add(into->squares, from->squares);
  if (from->finite > 0 && (into->finite == 0 || from->minimum < into->minimum)) {
    into->minimum = from->minimum;
    into->minimum_row = from->minimum_row;
  }
  if (from->finite > 0 && (into->finite == 0 || from->maximum > into->maximum)) {
    into->maximum = from->maximum;
    into->maximum_row = from->maximum_row;
  }
  into->finite += from->finite;
}

static void merge_run(rot_summary *into, const rot_summary *from) {
  for (int i = 0; i < ROT_SUMMARY_STATUSES; i++) {
    into->rows_with_status[i] += from->rows_with_status[i];
  }
  into->kept += from->kept;
  for (size_t i = 0; i < from->n_failed && into->n_failed < ROT_SUMMARY_FAILED; i++) {
    into->failed_row[into->n_failed] = from->failed_row[i];
    into->failed_status[into->n_failed++] = from->failed_status[i];
  }
  into->error_above += from->error_above;
  into->error_unknown += from->error_unknown;
  if (from->has_error_max && (!into->has_error_max || from->error_max > into->error_max)) {
    into->has_error_max = 1;
    into->error_max = from->error_max;
    into->error_max_row = from->error_max_row;
  }
  into->span.rows += from->span.rows;
}

static int same_columns(const rot_summary *a, const rot_summary *b) {
  if (a->n_columns != b->n_columns) return 0;
  for (size_t i = 0; i < a->n_columns; i++) {
    if (memcmp(&a->column[i].shift, &b->column[i].shift, sizeof(double)) != 0) return 0;
  }
  return 1;
}

/* Through the pointer to the columns: the values that the summary stands for do not change. */
rot_status rot_summary_count(const rot_summary *summary) {
  rot_bucket_counter *counter = NULL;
  rot_status status = ROT_OK;
  for (size_t i = 0; status == ROT_OK && i < summary->n_columns; i++) {
    rot_buckets *buckets = &summary->column[i].buckets;
    if (!buckets->later) continue;
    if (!counter) counter = rot_bucket_counter_new();
    status = counter ? rot_buckets_count(buckets, counter) : ROT_ENOMEM;
  }
  rot_bucket_counter_free(counter);
  return status;
}

/* All memory is taken before anything changes. */
rot_status rot_summary_merge(rot_summary *into, const rot_summary *from) {
  const size_t n = into->n_columns;
  if (!rot_extent_are_children(into->span, from->span) || !same_columns(into, from)) {
    return ROT_EVALUE;
  }
  rot_status status = rot_summary_count(into);
  if (status == ROT_OK) status = rot_summary_count(from);
  if (status != ROT_OK) return status;
  rot_buckets *sum = calloc(n + 1, sizeof *sum);
  if (!sum) status = ROT_ENOMEM;
  for (size_t i = 0; status == ROT_OK && i < n; i++) {
    status = rot_buckets_add(&into->column[i].buckets, &from->column[i].buckets, &sum[i]);
  }
  if (status == ROT_OK) {
    for (size_t i = 0; i < n; i++) {
      rot_buckets_free(&into->column[i].buckets);
      into->column[i].buckets = sum[i];
      merge_column(&into->column[i], &from->column[i]);
    }
    merge_run(into, from);
  } else {
    for (size_t i = 0; sum && i < n; i++) rot_buckets_free(&sum[i]);
  }
  free(sum);
  return status;
}

static int nothing_counted(const rot_summary *summary) {
  for (size_t i = 0; i < summary->n_columns; i++) {
    if (summary->column[i].buckets.n > 0) return 0;
  }
  return 1;
}

/* Small blocks: up to 2^16 rows are counted together. Without memory then, later. */
static rot_status merge(void *left, void *right) {
  rot_summary *into = left, *from = right;
  const uint64_t rows = into->span.rows + from->span.rows;
  if (rows > ROT_BLOCK_ROWS_MAX || !nothing_counted(from)) return rot_summary_merge(into, from);
  if (!rot_extent_are_children(into->span, from->span) || !same_columns(into, from)) {
    return ROT_EVALUE;
  }
  for (size_t i = 0; i < into->n_columns; i++) {
    rot_buckets_move(&into->column[i].buckets, &from->column[i].buckets);
    merge_column(&into->column[i], &from->column[i]);
  }
  merge_run(into, from);
  if (rows == ROT_BLOCK_ROWS_MAX) (void)rot_summary_count(into);
  return ROT_OK;
}

static rot_status finish(void *node) { return rot_summary_count(node); }
static rot_extent span_of(const void *node) { return ((const rot_summary *)node)->span; }
static void free_node(void *node) { rot_summary_free(node); }

const rot_tree_node rot_summary_node = {span_of, merge, finish, free_node};

/* ---- figures --------------------------------------------------------------------------------- */

double rot_summary_mean(const rot_summary *summary, size_t column) {
  const rot_summary_column *c = &summary->column[column];
  if (c->finite == 0) return NAN;
  if (!isfinite(c->sum.hi)) return c->sum.hi;
  return rot_dd_div(c->sum, (rot_dd){(double)c->finite, 0.0}).hi;
}

/* n variance = sum of (x - shift)^2 - n (mean - shift)^2 */
double rot_summary_sd(const rot_summary *summary, size_t column) {
  const rot_summary_column *c = &summary->column[column];
  if (c->finite < 2) return NAN;
  if (!isfinite(c->squares.hi) || !isfinite(c->sum.hi)) return INFINITY;
  const double n = (double)c->finite;
  const rot_dd offset = rot_dd_sub(c->sum, rot_dd_mul2(n, c->shift));
  const rot_dd square = rot_dd_div(rot_dd_mul(offset, offset), (rot_dd){n, 0.0});
  const double variance = rot_dd_sub(c->squares, square).hi / (n - 1.0);
  return variance > 0.0 ? sqrt(variance) : 0.0;
}

double rot_summary_middle(double low, double high) {
  return low == high ? low : low + 0.5 * (high - low);
}

rot_status rot_summary_quantile(const rot_summary *summary, size_t column, double p, double *low,
                                double *high) {
  const rot_summary_column *c = &summary->column[column];
  const uint64_t n = c->minus_inf + c->finite + c->plus_inf;
  *low = *high = NAN;
  if (!(p >= 0.0 && p <= 1.0)) return ROT_EVALUE;
  if (n == 0) return ROT_OK;
  if (rot_summary_count(summary) != ROT_OK) return ROT_ENOMEM;
  uint64_t rank = (uint64_t)ceil(p * (double)n);
  if (rank < 1) rank = 1;
  if (rank <= c->minus_inf) {
    *low = *high = -INFINITY;
  } else if (rank > c->minus_inf + c->finite) {
    *low = *high = INFINITY;
  } else if (rank == c->minus_inf + 1) {
    *low = *high = c->minimum;
  } else if (rank == c->minus_inf + c->finite) {
    *low = *high = c->maximum;
  } else {
    uint64_t up_to = c->minus_inf;
    size_t i = 0;
    while (i + 1 < c->buckets.n && up_to + c->buckets.at[i].count < rank) {
      up_to += c->buckets.at[i++].count;
    }
    rot_bucket_limits(c->buckets.at[i].bucket, low, high);
    *low = c->minimum > *low ? c->minimum : *low;
    *high = c->maximum < *high ? c->maximum : *high;
  }
  return ROT_OK;
}

void rot_summary_buckets(const rot_summary *summary, size_t column, double low[], double high[],
                         double count[]) {
  const rot_buckets *buckets = &summary->column[column].buckets;
  for (size_t i = 0; i < buckets->n; i++) {
    double from, to;
    rot_bucket_limits(buckets->at[i].bucket, &from, &to);
    if (low) low[i] = from;
    if (high) high[i] = to;
    if (count) count[i] = (double)buckets->at[i].count;
  }
}

/* ---- long form ------------------------------------------------------------------------------- */

/* A row that is there for a count above 0: of a reader, if it is the next one; its key is a row of
 * the span. */
static int is_next(const rot_long_at *at, int quantity, rot_kind kind) {
  return !at->bad && at->rows && at->next < at->n && at->rows->quantity[at->next] == quantity &&
         at->rows->kind[at->next] == (int)kind;
}

static int is_row(const rot_summary *summary, int64_t key) {
  return key >= (int64_t)summary->span.first_row &&
         key < (int64_t)(summary->span.first_row + summary->span.rows);
}

/* `there`, of a writer: is there such a row? => 1 if it was read or written. The key becomes
 * *row. */
static int at_row(rot_long_at *at, const rot_summary *summary, int quantity, rot_kind kind,
                  int there, uint64_t *row, double *value) {
  if (at->read) {
    if (!is_next(at, quantity, kind)) return 0;
    if (!is_row(summary, at->rows->key[at->next])) {
      at->bad = 1;
      return 0;
    }
    *row = (uint64_t)at->rows->key[at->next];
  } else if (!there) {
    return 0;
  }
  rot_long_number(at, quantity, kind, (int64_t)*row, value);
  return 1;
}

static void at_count(rot_long_at *at, const rot_summary *summary, int quantity, rot_kind kind,
                     uint64_t *count, uint64_t *row) {
  double value = (double)*count;
  if (!at_row(at, summary, quantity, kind, *count > 0, row, &value)) return;
  if (at->read && (!rot_long_whole(value, summary->span.rows, count) || *count == 0)) at->bad = 1;
}

static void at_statuses(rot_long_at *at, rot_summary *summary) {
  for (int i = 0; i < ROT_SUMMARY_STATUSES; i++) {
    uint64_t *count = &summary->rows_with_status[i];
    const int there =
        at->read ? is_next(at, ROT_RUN_QUANTITY, ROT_KIND_STATUS) && at->rows->key[at->next] == i
                 : *count > 0;
    if (!there) continue;
    rot_long_count(at, ROT_RUN_QUANTITY, ROT_KIND_STATUS, i, summary->span.rows, count);
    if (at->read && *count == 0) at->bad = 1;
  }
}

static void at_failed(rot_long_at *at, rot_summary *summary) {
  for (size_t i = 0; i < ROT_SUMMARY_FAILED; i++) {
    uint64_t status = (uint64_t)summary->failed_status[i];
    double value = (double)status;
    if (!at_row(at, summary, ROT_RUN_QUANTITY, ROT_KIND_FAILED, i < summary->n_failed,
                &summary->failed_row[i], &value)) {
      return;
    }
    if (!at->read) continue;
    if (!rot_long_whole(value, ROT_SUMMARY_STATUSES - 1, &status) || status == 0 ||
        (i > 0 && summary->failed_row[i] <= summary->failed_row[i - 1])) {
      at->bad = 1;
      return;
    }
    summary->failed_status[i] = (int)status;
    summary->n_failed = i + 1;
  }
}

static void at_errors(rot_long_at *at, rot_summary *summary) {
  const int run = ROT_RUN_QUANTITY;
  rot_long_count(at, run, ROT_KIND_ERROR_ABOVE, 0, summary->span.rows, &summary->error_above);
  rot_long_count(at, run, ROT_KIND_ERROR_UNKNOWN, 0, summary->span.rows, &summary->error_unknown);
  const int has = at_row(at, summary, run, ROT_KIND_ERROR_MAX, summary->has_error_max,
                         &summary->error_max_row, &summary->error_max);
  if (at->read) summary->has_error_max = has;
}

static void at_block_rows(rot_long_at *at, rot_extent *span) {
  rot_long_count(at, ROT_RUN_QUANTITY, ROT_KIND_BLOCK_ROWS, 0, ROT_BLOCK_ROWS_MAX,
                 &span->block_rows);
  if (at->read && !rot_extent_is_node(*span)) at->bad = 1;
}

static void at_buckets(rot_long_at *at, int quantity, uint64_t max, rot_buckets *buckets) {
  for (size_t i = 0; i < buckets->n && !at->bad; i++) {
    rot_bucket *b = &buckets->at[i];
    double low, high;
    if (at->read) {
      const int64_t key = at->rows->key[at->next];
      if (!rot_bucket_limits(key, &low, &high) || (i > 0 && key <= b[-1].bucket)) {
        at->bad = 1;
        return;
      }
      b->bucket = (int32_t)key;
    }
    rot_long_count(at, quantity, ROT_KIND_BUCKET, b->bucket, max, &b->count);
    if (at->read && b->count == 0) at->bad = 1;
  }
}

/* Memory for the buckets that come next in the rows. */
static rot_status take_buckets(const rot_long_at *at, int quantity, rot_buckets *buckets) {
  rot_long_at ahead = *at;
  while (is_next(&ahead, quantity, ROT_KIND_BUCKET)) ahead.next++;
  const size_t n = ahead.next - at->next;
  buckets->at = calloc(n + 1, sizeof *buckets->at);
  if (!buckets->at) return ROT_ENOMEM;
  buckets->n = n;
  return ROT_OK;
}

static rot_status at_column(rot_long_at *at, rot_summary *summary, size_t i) {
  rot_summary_column *c = &summary->column[i];
  const int quantity = (int)i;
  rot_long_number(at, quantity, ROT_KIND_SHIFT, 0, &c->shift);
  rot_long_count(at, quantity, ROT_KIND_FINITE, 0, summary->span.rows, &c->finite);
  at_count(at, summary, quantity, ROT_KIND_NAN, &c->nan, &c->nan_row);
  at_count(at, summary, quantity, ROT_KIND_PLUS_INF, &c->plus_inf, &c->plus_inf_row);
  at_count(at, summary, quantity, ROT_KIND_MINUS_INF, &c->minus_inf, &c->minus_inf_row);
  rot_long_number(at, quantity, ROT_KIND_SUM, 0, &c->sum.hi);
  rot_long_number(at, quantity, ROT_KIND_SUM_LOW, 0, &c->sum.lo);
  rot_long_number(at, quantity, ROT_KIND_SQUARES, 0, &c->squares.hi);
  rot_long_number(at, quantity, ROT_KIND_SQUARES_LOW, 0, &c->squares.lo);
  const int has =
      at_row(at, summary, quantity, ROT_KIND_MINIMUM, c->finite > 0, &c->minimum_row, &c->minimum) +
      at_row(at, summary, quantity, ROT_KIND_MAXIMUM, c->finite > 0, &c->maximum_row, &c->maximum);
  if (at->bad) return ROT_EVALUE;
  if (at->read && has != (c->finite > 0 ? 2 : 0)) return ROT_EVALUE;
  if (at->read && take_buckets(at, quantity, &c->buckets) != ROT_OK) return ROT_ENOMEM;
  at_buckets(at, quantity, summary->span.rows, &c->buckets);
  return at->bad ? ROT_EVALUE : ROT_OK;
}

/* Span and number of columns come first: the other rows depend on them. */
static uint64_t at_header(rot_long_at *at, rot_extent *span, uint64_t n_columns) {
  rot_long_count(at, ROT_RUN_QUANTITY, ROT_KIND_FIRST_ROW, 0, ROT_SWEEP_ROWS, &span->first_row);
  rot_long_count(at, ROT_RUN_QUANTITY, ROT_KIND_ROWS, 0, ROT_SWEEP_ROWS, &span->rows);
  rot_long_count(at, ROT_RUN_QUANTITY, ROT_KIND_COLUMNS, 0, INT32_MAX, &n_columns);
  return n_columns;
}

static rot_status at_rest(rot_long_at *at, rot_summary *summary) {
  rot_long_count(at, ROT_RUN_QUANTITY, ROT_KIND_KEPT, 0, summary->span.rows, &summary->kept);
  at_statuses(at, summary);
  at_failed(at, summary);
  at_errors(at, summary);
  at_block_rows(at, &summary->span);
  rot_status status = at->bad ? ROT_EVALUE : ROT_OK;
  for (size_t i = 0; status == ROT_OK && i < summary->n_columns; i++) {
    status = at_column(at, summary, i);
  }
  return status;
}

/* Writing and counting change nothing: the values written are the values there are. */
static size_t write(const rot_summary *summary, const rot_long *rows) {
  rot_long_at at = {rows, 0, 0, 0, 0};
  rot_summary copy = *summary;
  if (copy.span.rows == 0) return 0;
  at_header(&at, &copy.span, copy.n_columns);
  at_rest(&at, &copy);
  return at.next;
}

size_t rot_summary_rows_size(const rot_summary *summary) {
  return rot_summary_count(summary) == ROT_OK ? write(summary, NULL) : 0;
}

void rot_summary_rows(const rot_summary *summary, const rot_long *rows) { write(summary, rows); }

/* Counts of the run agree with each other and with the rows covered. */
static int run_agrees(const rot_summary *s) {
  uint64_t rows = 0, failed[ROT_SUMMARY_STATUSES] = {0};
  for (int i = 0; i < ROT_SUMMARY_STATUSES; i++) {
    if (s->rows_with_status[i] > s->span.rows - rows) return 0;
    rows += s->rows_with_status[i];
  }
  if (rows != s->span.rows) return 0;
  const uint64_t failures = rows - s->rows_with_status[0];
  if (s->n_failed != (failures < ROT_SUMMARY_FAILED ? failures : ROT_SUMMARY_FAILED)) return 0;
  for (size_t i = 0; i < s->n_failed; i++) failed[s->failed_status[i]]++;
  for (int i = 1; i < ROT_SUMMARY_STATUSES; i++) {
    if (failed[i] > s->rows_with_status[i]) return 0;
    if (failures <= ROT_SUMMARY_FAILED && failed[i] != s->rows_with_status[i]) return 0;
  }
  if (s->has_error_max && isnan(s->error_max)) return 0;
  return s->error_unknown <= s->error_above && s->error_above <= s->rows_with_status[0];
}

static int column_agrees(const rot_summary_column *c, uint64_t rows) {
  uint64_t sum = 0, in_buckets = 0;
  const uint64_t count[] = {c->finite, c->nan, c->plus_inf, c->minus_inf};
  for (int i = 0; i < 4; i++) {
    if (count[i] > rows - sum) return 0;
    sum += count[i];
  }
  if (sum != rows || !isfinite(c->shift)) return 0;
  for (size_t i = 0; i < c->buckets.n; i++) {
    if (c->buckets.at[i].count > c->finite - in_buckets) return 0;
    in_buckets += c->buckets.at[i].count;
  }
  if (in_buckets != c->finite) return 0;
  if (!rot_long_is_sum(c->sum.hi, c->sum.lo) || !rot_long_is_sum(c->squares.hi, c->squares.lo) ||
      !(c->squares.hi >= 0.0)) {
    return 0;
  }
  if (c->finite == 0) return c->sum.hi == 0.0 && c->squares.hi == 0.0;
  return isfinite(c->minimum) && isfinite(c->maximum) && c->minimum <= c->maximum &&
         rot_bucket_of(c->minimum) == c->buckets.at[0].bucket &&
         rot_bucket_of(c->maximum) == c->buckets.at[c->buckets.n - 1].bucket;
}

static int agrees(const rot_summary *summary) {
  if (!run_agrees(summary)) return 0;
  for (size_t i = 0; i < summary->n_columns; i++) {
    if (!column_agrees(&summary->column[i], summary->rows_with_status[0])) return 0;
  }
  return 1;
}

/* A column takes at least seven rows: a number of columns that the rows cannot have is refused
 * before memory is taken for it. The size of blocks comes behind other rows: until then the span is
 * checked with the smallest blocks, of which all nodes consist. */
rot_status rot_summary_read(size_t n, const rot_long *rows, rot_summary **summary) {
  rot_long_at at = {rows, n, 0, 1, 0};
  rot_extent span = {0, 0, ROT_BLOCK_ROWS_MIN};
  *summary = NULL;
  const uint64_t n_columns = at_header(&at, &span, 0);
  if (at.bad || !rot_extent_is_node(span) || n_columns > n / 7) return ROT_EVALUE;
  rot_summary *s = rot_summary_new((size_t)n_columns, NULL, span.block_rows);
  if (!s) return ROT_ENOMEM;
  s->span = span;
  rot_status status = at_rest(&at, s);
  if (status == ROT_OK && (at.next != n || !agrees(s))) status = ROT_EVALUE;
  if (status != ROT_OK) {
    rot_summary_free(s);
    return status;
  }
  *summary = s;
  return ROT_OK;
}
