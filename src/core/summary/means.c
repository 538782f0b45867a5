#include "summary/means.h"

#include <math.h>
#include <stdlib.h>

#include "ground/exact.h"
#include "summary/sum.h"

rot_means *rot_means_new(size_t n_columns, size_t replicates, uint64_t run, uint64_t block_rows) {
  if (replicates < 1 || replicates > ROT_MEANS_REPLICATES || run < 1) return NULL;
  if (!rot_extent_is_size(block_rows)) return NULL;
  if (n_columns > SIZE_MAX / sizeof(rot_means_group) / replicates - 1) return NULL;
  rot_means *m = calloc(1, sizeof *m);
  if (!m) return NULL;
  m->n_columns = n_columns;
  m->replicates = replicates;
  m->run = run;
  m->span.block_rows = block_rows;
  m->group = calloc((n_columns + 1) * replicates, sizeof *m->group);
  if (m->group) return m;
  free(m);
  return NULL;
}

void rot_means_free(rot_means *m) {
  if (!m) return;
  free(m->group);
  free(m);
}

enum { LANES = 4, LONG_RUN = 16 };

/* Rows of one group in a row => added to it. Four sums take the values in turns: one alone waits
 * for its last addition, 6.8 ns a value instead of 1.3. */
static void add_run(rot_means_group *group, size_t n, const double x[], const int status[]) {
  double sum[LANES] = {0.0}, low[LANES] = {0.0};
  for (size_t i = 0; i < n; i += LANES) {
    for (size_t k = 0; k < LANES && i + k < n; k++) {
      const int counts = isfinite(x[i + k]) && !(status && status[i + k]);
      group->count += (uint64_t)counts;
      rot_accumulate(&sum[k], &low[k], counts ? x[i + k] : 0.0);
    }
  }
  rot_dd s[LANES];
  for (int k = 0; k < LANES; k++) s[k] = rot_sum_of(sum[k], low[k]);
  s[0] = rot_sum_add(rot_sum_add(s[0], s[1]), rot_sum_add(s[2], s[3]));
  group->sum = rot_sum_add(group->sum, s[0]);
}

/* Groups that change every few rows: their sums are independent as they are. */
static void add_turns(rot_means *m, rot_means_group *group, uint64_t first_row, size_t n,
                      const double x[], const int status[]) {
  size_t g = (size_t)(first_row / m->run % m->replicates);
  uint64_t left = m->run - first_row % m->run; /* rows left of the group's run */
  for (size_t i = 0; i < n; i++) {
    if (isfinite(x[i]) && !(status && status[i])) {
      group[g].count++;
      rot_accumulate(&group[g].sum.hi, &group[g].sum.lo, x[i]);
    }
    if (--left > 0) continue;
    left = m->run;
    g = g + 1 == m->replicates ? 0 : g + 1;
  }
  for (g = 0; g < m->replicates; g++) {
    group[g].sum = rot_sum_of(group[g].sum.hi, group[g].sum.lo);
  }
}

static void add_runs(rot_means *m, rot_means_group *group, uint64_t first_row, size_t n,
                     const double x[], const int status[]) {
  for (size_t i = 0; i < n;) {
    const uint64_t row = first_row + i, left = m->run - row % m->run;
    const size_t here = left < n - i ? (size_t)left : n - i;
    add_run(&group[row / m->run % m->replicates], here, x + i, status ? status + i : NULL);
    i += here;
  }
}

rot_status rot_means_add(rot_means *m, uint64_t first_row, size_t n, const double *const column[],
                         const int status[]) {
  const rot_extent span = {first_row, n, m->span.block_rows};
  if (m->span.rows > 0 || !rot_extent_is_block(span)) return ROT_EVALUE;
  for (size_t c = 0; c < m->n_columns; c++) {
    rot_means_group *group = m->group + c * m->replicates;
    if (m->run < LONG_RUN) {
      add_turns(m, group, first_row, n, column[c], status);
    } else {
      add_runs(m, group, first_row, n, column[c], status);
    }
  }
  m->span = span;
  return ROT_OK;
}

rot_status rot_means_merge(rot_means *into, const rot_means *from) {
  if (!rot_extent_are_children(into->span, from->span) || into->n_columns != from->n_columns ||
      into->replicates != from->replicates || into->run != from->run) {
    return ROT_EVALUE;
  }
  for (size_t i = 0; i < into->n_columns * into->replicates; i++) {
    if (from->group[i].count == 0) continue; /* its sum is 0 */
    into->group[i].count += from->group[i].count;
    into->group[i].sum = rot_sum_add(into->group[i].sum, from->group[i].sum);
  }
  into->span.rows += from->span.rows;
  return ROT_OK;
}

static rot_extent span_of(const void *node) { return ((const rot_means *)node)->span; }
static rot_status merge(void *into, void *from) { return rot_means_merge(into, from); }
static void free_node(void *node) { rot_means_free(node); }

const rot_tree_node rot_means_node = {span_of, merge, NULL, free_node};

/* Sum over all groups except one (the number of groups: over all) => mean; NaN without values */
static double mean_without(const rot_means *m, const rot_means_group *group, size_t without) {
  rot_dd sum = {0.0, 0.0};
  uint64_t count = 0;
  for (size_t g = 0; g < m->replicates; g++) {
    if (g == without) continue;
    sum = rot_sum_add(sum, group[g].sum);
    count += group[g].count;
  }
  if (!count || !isfinite(sum.hi)) return count ? sum.hi : NAN;
  return rot_dd_div(sum, (rot_dd){(double)count, 0.0}).hi;
}

void rot_means_estimate(const rot_means *m, size_t column, double *mean, double *se) {
  const rot_means_group *group = m->group + column * m->replicates;
  double without[ROT_MEANS_REPLICATES];
  int n = 0;
  for (size_t g = 0; g < m->replicates; g++) {
    if (group[g].count) without[n++] = mean_without(m, group, g);
  }
  *mean = mean_without(m, group, m->replicates);
  *se = rot_sum_jackknife(n, without);
}

/* ---- long form ------------------------------------------------------------------------------- */

typedef struct header {
  rot_extent span;
  uint64_t n_columns, replicates, run;
} header;

static void at_header(rot_long_at *at, header *h) {
  const int run = ROT_RUN_QUANTITY;
  rot_long_count(at, run, ROT_KIND_MEAN_FIRST_ROW, 0, ROT_SWEEP_ROWS, &h->span.first_row);
  rot_long_count(at, run, ROT_KIND_MEAN_ROWS, 0, ROT_SWEEP_ROWS, &h->span.rows);
  rot_long_count(at, run, ROT_KIND_MEAN_COLUMNS, 0, INT32_MAX, &h->n_columns);
  rot_long_count(at, run, ROT_KIND_MEAN_REPLICATES, 0, ROT_MEANS_REPLICATES, &h->replicates);
  rot_long_count(at, run, ROT_KIND_MEAN_RUN, 0, ROT_SWEEP_ROWS, &h->run);
  rot_long_count(at, run, ROT_KIND_MEAN_BLOCK_ROWS, 0, ROT_BLOCK_ROWS_MAX, &h->span.block_rows);
}

static void at_column(rot_long_at *at, const rot_means *m, size_t i) {
  rot_means_group *group = m->group + i * m->replicates;
  const int q = (int)i, n = (int)m->replicates;
  uint64_t left = m->span.rows;
  for (int g = 0; g < n; g++) {
    rot_long_count(at, q, ROT_KIND_MEAN_COUNT, g, left, &group[g].count);
    if (at->read) left -= group[g].count;
  }
  for (int g = 0; g < n; g++) rot_long_number(at, q, ROT_KIND_MEAN_SUM, g, &group[g].sum.hi);
  for (int g = 0; g < n; g++) {
    rot_dd *sum = &group[g].sum;
    rot_long_number(at, q, ROT_KIND_MEAN_SUM_LOW, g, &sum->lo);
    if (!at->read) continue;
    if (!rot_long_is_sum(sum->hi, sum->lo) || (group[g].count == 0 && sum->hi != 0.0)) at->bad = 1;
  }
}

/* Writing and counting change nothing. */
static size_t write(const rot_means *m, const rot_long *rows) {
  rot_long_at at = {rows, 0, 0, 0, 0};
  header h = {m->span, m->n_columns, m->replicates, m->run};
  if (m->span.rows == 0) return 0;
  at_header(&at, &h);
  for (size_t i = 0; i < m->n_columns; i++) at_column(&at, m, i);
  return at.next;
}

size_t rot_means_rows_size(const rot_means *m) { return write(m, NULL); }

void rot_means_rows(const rot_means *m, const rot_long *rows) { write(m, rows); }

/* The header says how many rows there must be, which is compared before memory is taken. */
rot_status rot_means_read(size_t n, const rot_long *rows, rot_means **means) {
  rot_long_at at = {rows, n, 0, 1, 0};
  header h = {{0, 0, 0}, 0, 0, 0};
  *means = NULL;
  at_header(&at, &h);
  if (at.bad || !rot_extent_is_node(h.span) || h.replicates < 1 || h.run < 1) return ROT_EVALUE;
  const uint64_t each = 3 * h.replicates;
  if (h.n_columns > n / each || at.next + h.n_columns * each != n) return ROT_EVALUE;
  rot_means *m = rot_means_new((size_t)h.n_columns, (size_t)h.replicates, h.run, h.span.block_rows);
  if (!m) return ROT_ENOMEM;
  m->span = h.span;
  for (size_t i = 0; i < m->n_columns; i++) at_column(&at, m, i);
  if (at.bad) {
    rot_means_free(m);
    return ROT_EVALUE;
  }
  *means = m;
  return ROT_OK;
}
