#include "summary/indices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/exact.h"
#include "summary/sum.h"

enum { GROUPS = ROT_INDEX_GROUPS };

rot_indices *rot_indices_new(size_t n_inputs, size_t n_columns, const double shift[], uint64_t run,
                             uint64_t block_rows) {
  if (n_inputs < 1 || n_inputs > ROT_INDEX_INPUTS || run < 1) return NULL;
  if (!rot_extent_is_size(block_rows)) return NULL;
  for (size_t i = 0; shift && i < n_columns; i++) {
    if (!isfinite(shift[i])) return NULL;
  }
  rot_indices *x = calloc(1, sizeof *x);
  if (!x) return NULL;
  x->n_inputs = n_inputs;
  x->run = run;
  x->span.block_rows = block_rows;
  x->terms = ROT_INDEX_DIFFERENCE + 2 * n_inputs;
  x->column = calloc(n_columns + 1, sizeof *x->column);
  for (size_t i = 0; x->column && i < n_columns; i++) {
    rot_indices_column *c = &x->column[i];
    x->n_columns = i + 1;
    c->shift = shift ? shift[i] : 0.0;
    c->sum = calloc(GROUPS * x->terms, sizeof *c->sum);
    c->head = calloc(n_inputs + 2, sizeof *c->head);
    c->tail = calloc(n_inputs + 2, sizeof *c->tail);
    if (!c->sum || !c->head || !c->tail) {
      rot_indices_free(x);
      return NULL;
    }
  }
  if (x->column) return x;
  rot_indices_free(x);
  return NULL;
}

void rot_indices_free(rot_indices *x) {
  if (!x) return;
  for (size_t i = 0; i < x->n_columns; i++) {
    free(x->column[i].sum);
    free(x->column[i].head);
    free(x->column[i].tail);
  }
  free(x->column);
  free(x);
}

/* ---- base points ----------------------------------------------------------------------------- */

/* How the base points lie in a span. */
typedef struct parts {
  size_t head;     /* rows of a base point that began before; all rows if it does not end here */
  int bounded;     /* 1: a base point ends or begins in the span or at its ends */
  uint64_t points; /* whole ones */
  size_t tail;     /* rows of a base point that goes on behind; 0 if not bounded */
} parts;

static parts parts_of(size_t n_inputs, rot_extent span) {
  const uint64_t length = n_inputs + 2, over = span.first_row % length;
  const uint64_t head = over ? length - over : 0;
  if (head > span.rows) return (parts){(size_t)span.rows, 0, 0, 0};
  const uint64_t rest = span.rows - head;
  return (parts){(size_t)head, 1, rest / length, (size_t)(rest % length)};
}

static void accumulate(rot_dd *sum, double x) { rot_accumulate(&sum->hi, &sum->lo, x); }

/* The terms of one base point, by its d + 2 values; 0 if one is not finite. `add` adds to a sum. */
static int add_point(const rot_indices *x, rot_indices_column *c, uint64_t point, const double v[],
                     void (*add)(rot_dd *, double)) {
  const size_t d = x->n_inputs, group = (size_t)(point / x->run % GROUPS);
  for (size_t k = 0; k < d + 2; k++) {
    if (!isfinite(v[k])) return 0;
  }
  rot_dd *sum = c->sum + group * x->terms, *difference = sum + ROT_INDEX_DIFFERENCE;
  const double a = v[0] - c->shift, b = v[1] - c->shift;
  add(&sum[ROT_INDEX_A], a);
  add(&sum[ROT_INDEX_B], b);
  add(&sum[ROT_INDEX_AA], a * a);
  add(&sum[ROT_INDEX_BB], b * b);
  for (size_t i = 0; i < d; i++) {
    const double from_a = v[0] - v[2 + i], from_b = v[1] - v[2 + i];
    add(&difference[i], from_b * from_b);
    add(&difference[d + i], from_a * from_a);
  }
  c->points[group]++;
  return 1;
}

static void add_whole(rot_dd *sum, double x) { *sum = rot_sum_add(*sum, (rot_dd){x, 0.0}); }

static int all_good(size_t n, const int status[]) {
  for (size_t i = 0; status && i < n; i++) {
    if (status[i] != 0) return 0;
  }
  return 1;
}

static void keep_rows(size_t n, const double x[], const int status[], double to[]) {
  for (size_t i = 0; i < n; i++) to[i] = isfinite(x[i]) && !(status && status[i]) ? x[i] : NAN;
}

rot_status rot_indices_add(rot_indices *x, uint64_t first_row, size_t n,
                           const double *const column[], const int status[]) {
  const rot_extent span = {first_row, n, x->span.block_rows};
  const size_t length = x->n_inputs + 2;
  if (x->span.rows > 0 || !rot_extent_is_block(span)) return ROT_EVALUE;
  const parts p = parts_of(x->n_inputs, span);
  const uint64_t point = (first_row + p.head) / length;
  for (size_t i = 0; i < x->n_columns; i++) {
    rot_indices_column *c = &x->column[i];
    keep_rows(p.head, column[i], status, c->head);
    for (size_t k = 0; k < p.points; k++) {
      const size_t at = p.head + k * length;
      if (!all_good(length, status ? status + at : NULL) ||
          !add_point(x, c, point + k, column[i] + at, accumulate)) {
        c->skipped++;
      }
    }
    for (size_t k = 0; k < GROUPS * x->terms; k++)
      c->sum[k] = rot_sum_of(c->sum[k].hi, c->sum[k].lo);
    keep_rows(p.tail, column[i] + n - p.tail, status ? status + n - p.tail : NULL, c->tail);
  }
  x->span = span;
  return ROT_OK;
}

/* ---- merging --------------------------------------------------------------------------------- */

/* The base point across the border is completed, or has more rows now. */
static void merge_border(rot_indices *into, const parts *left, const rot_indices_column *from,
                         const parts *right, rot_indices_column *c) {
  const uint64_t end = into->span.first_row + into->span.rows;
  double *to = left->bounded ? c->tail : c->head;
  const size_t n = left->bounded ? left->tail : left->head;
  memcpy(to + n, from->head, right->head * sizeof *to);
  if (!right->bounded) return;
  if (left->bounded && n + right->head > 0 &&
      !add_point(into, c, (end - 1) / (into->n_inputs + 2), to, add_whole)) {
    c->skipped++;
  }
  memcpy(c->tail, from->tail, right->tail * sizeof *to);
}

static int same_form(const rot_indices *a, const rot_indices *b) {
  if (a->n_inputs != b->n_inputs || a->n_columns != b->n_columns || a->run != b->run) return 0;
  for (size_t i = 0; i < a->n_columns; i++) {
    if (memcmp(&a->column[i].shift, &b->column[i].shift, sizeof(double)) != 0) return 0;
  }
  return 1;
}

rot_status rot_indices_merge(rot_indices *into, const rot_indices *from) {
  if (!rot_extent_are_children(into->span, from->span) || !same_form(into, from)) return ROT_EVALUE;
  const parts left = parts_of(into->n_inputs, into->span);
  const parts right = parts_of(into->n_inputs, from->span);
  for (size_t i = 0; i < into->n_columns; i++) {
    rot_indices_column *c = &into->column[i];
    const rot_indices_column *more = &from->column[i];
    for (size_t g = 0; g < GROUPS; g++) {
      if (more->points[g] == 0) continue; /* its sums are 0 */
      c->points[g] += more->points[g];
      for (size_t k = g * into->terms; k < (g + 1) * into->terms; k++) {
        c->sum[k] = rot_sum_add(c->sum[k], more->sum[k]);
      }
    }
    c->skipped += more->skipped;
    merge_border(into, &left, more, &right, c);
  }
  into->span.rows += from->span.rows;
  return ROT_OK;
}

static rot_extent span_of(const void *node) { return ((const rot_indices *)node)->span; }
static rot_status merge(void *into, void *from) { return rot_indices_merge(into, from); }
static void free_node(void *node) { rot_indices_free(node); }

const rot_tree_node rot_indices_node = {span_of, merge, NULL, free_node};

/* ---- estimates ------------------------------------------------------------------------------- */

/* Sum of a term over all groups except one (-1: over all). */
static rot_dd over_groups(const rot_indices *x, const rot_indices_column *c, size_t term,
                          int without) {
  rot_dd sum = {0.0, 0.0};
  for (int g = 0; g < GROUPS; g++) {
    if (g != without) sum = rot_sum_add(sum, c->sum[(size_t)g * x->terms + term]);
  }
  return sum;
}

/* => mean of the differences from the shift; the variance */
static double variance_of(const rot_indices *x, const rot_indices_column *c, int without,
                          uint64_t points, double *mean) {
  const rot_dd n = {2.0 * (double)points, 0.0};
  const rot_dd sum =
      rot_sum_add(over_groups(x, c, ROT_INDEX_A, without), over_groups(x, c, ROT_INDEX_B, without));
  const rot_dd squares = rot_sum_add(over_groups(x, c, ROT_INDEX_AA, without),
                                     over_groups(x, c, ROT_INDEX_BB, without));
  *mean = sum.hi / n.hi;
  const rot_dd square = rot_dd_div(rot_dd_mul(sum, sum), n);
  return rot_dd_sub(squares, square).hi / (n.hi - 1.0);
}

/* value[0 .. d - 1]: first-order indices; value[d .. 2 d - 1]: total indices */
static void estimate(const rot_indices *x, const rot_indices_column *c, int without,
                     rot_indices_info *info, double value[]) {
  info->skipped = c->skipped;
  info->points = 0;
  for (int g = 0; g < GROUPS; g++) info->points += g == without ? 0 : c->points[g];
  double offset = NAN;
  info->variance = info->points ? variance_of(x, c, without, info->points, &offset) : NAN;
  info->mean = c->shift + offset;
  for (size_t i = 0; i < 2 * x->n_inputs; i++) {
    const double sum = over_groups(x, c, ROT_INDEX_DIFFERENCE + i, without).hi;
    const double part = sum / (2.0 * (double)info->points) / info->variance;
    value[i] = !(info->variance > 0.0) ? NAN : i < x->n_inputs ? 1.0 - part : part;
  }
}

rot_status rot_indices_estimate(const rot_indices *x, size_t column, double first[],
                                double first_se[], double total[], double total_se[],
                                rot_indices_info *info) {
  const rot_indices_column *c = &x->column[column];
  const size_t d = x->n_inputs;
  double *value = malloc(2 * d * (GROUPS + 1) * sizeof *value);
  if (!value) return ROT_ENOMEM;
  int groups = 0;
  for (int g = 0; g < GROUPS; g++) {
    rot_indices_info rest;
    if (c->points[g]) estimate(x, c, g, &rest, value + 2 * d * (size_t)++groups);
  }
  estimate(x, c, -1, info, value);
  for (size_t i = 0; i < 2 * d; i++) {
    double without[GROUPS];
    for (int g = 0; g < groups; g++) without[g] = value[2 * d * (size_t)(g + 1) + i];
    *(i < d ? &first[i] : &total[i - d]) = value[i];
    *(i < d ? &first_se[i] : &total_se[i - d]) = rot_sum_jackknife(groups, without);
  }
  free(value);
  return ROT_OK;
}

/* ---- long form ------------------------------------------------------------------------------- */

typedef struct header {
  rot_extent span;
  uint64_t n_columns, n_inputs, run;
} header;

static void at_header(rot_long_at *at, header *h) {
  const int run = ROT_RUN_QUANTITY;
  rot_long_count(at, run, ROT_KIND_INDEX_FIRST_ROW, 0, ROT_SWEEP_ROWS, &h->span.first_row);
  rot_long_count(at, run, ROT_KIND_INDEX_ROWS, 0, ROT_SWEEP_ROWS, &h->span.rows);
  rot_long_count(at, run, ROT_KIND_INDEX_COLUMNS, 0, INT32_MAX, &h->n_columns);
  rot_long_count(at, run, ROT_KIND_INDEX_INPUTS, 0, ROT_INDEX_INPUTS, &h->n_inputs);
  rot_long_count(at, run, ROT_KIND_INDEX_RUN, 0, ROT_SWEEP_ROWS, &h->run);
  rot_long_count(at, run, ROT_KIND_INDEX_BLOCK_ROWS, 0, ROT_BLOCK_ROWS_MAX, &h->span.block_rows);
}

static void at_values(rot_long_at *at, int quantity, rot_kind kind, uint64_t row, size_t n,
                      double value[]) {
  for (size_t i = 0; i < n; i++) {
    rot_long_number(at, quantity, kind, (int64_t)(row + i), &value[i]);
    if (at->read && isinf(value[i])) at->bad = 1;
  }
}

static void at_column(rot_long_at *at, const rot_indices *x, size_t i) {
  rot_indices_column *c = &x->column[i];
  const parts p = parts_of(x->n_inputs, x->span);
  const int q = (int)i;
  uint64_t points = 0;
  rot_long_number(at, q, ROT_KIND_INDEX_SHIFT, 0, &c->shift);
  rot_long_count(at, q, ROT_KIND_INDEX_SKIPPED, 0, p.points, &c->skipped);
  for (int g = 0; g < GROUPS; g++) {
    rot_long_count(at, q, ROT_KIND_INDEX_POINTS, g, p.points, &c->points[g]);
    points += c->points[g];
  }
  for (int low = 0; low < 2; low++) {
    for (size_t k = 0; k < GROUPS * x->terms; k++) {
      rot_dd *sum = &c->sum[k % GROUPS * x->terms + k / GROUPS];
      rot_long_number(at, q, low ? ROT_KIND_INDEX_SUM_LOW : ROT_KIND_INDEX_SUM, (int64_t)k,
                      low ? &sum->lo : &sum->hi);
      if (!at->read || !low) continue;
      if (!rot_long_is_sum(sum->hi, sum->lo)) at->bad = 1;
      if (c->points[k % GROUPS] == 0 && sum->hi != 0.0) at->bad = 1;
    }
  }
  at_values(at, q, ROT_KIND_INDEX_HEAD, x->span.first_row, p.head, c->head);
  at_values(at, q, ROT_KIND_INDEX_TAIL, x->span.first_row + x->span.rows - p.tail, p.tail, c->tail);
  if (at->read && (points + c->skipped != p.points || !isfinite(c->shift))) at->bad = 1;
}

/* Writing and counting change nothing. */
static size_t write(const rot_indices *x, const rot_long *rows) {
  rot_long_at at = {rows, 0, 0, 0, 0};
  header h = {x->span, x->n_columns, x->n_inputs, x->run};
  if (x->span.rows == 0) return 0;
  at_header(&at, &h);
  for (size_t i = 0; i < x->n_columns; i++) at_column(&at, x, i);
  return at.next;
}

size_t rot_indices_rows_size(const rot_indices *x) { return write(x, NULL); }

void rot_indices_rows(const rot_indices *x, const rot_long *rows) { write(x, rows); }

/* The header says how many rows there must be, which is compared before memory is taken. */
rot_status rot_indices_read(size_t n, const rot_long *rows, rot_indices **indices) {
  rot_long_at at = {rows, n, 0, 1, 0};
  header h = {{0, 0, 0}, 0, 0, 0};
  *indices = NULL;
  at_header(&at, &h);
  if (at.bad || !rot_extent_is_node(h.span) || h.n_inputs < 1 || h.run < 1) return ROT_EVALUE;
  const parts p = parts_of((size_t)h.n_inputs, h.span);
  const uint64_t terms = ROT_INDEX_DIFFERENCE + 2 * h.n_inputs;
  const uint64_t each = 2 + GROUPS + 2 * GROUPS * terms + p.head + p.tail;
  if (h.n_columns > n / each || at.next + h.n_columns * each != n) return ROT_EVALUE;
  rot_indices *x =
      rot_indices_new((size_t)h.n_inputs, (size_t)h.n_columns, NULL, h.run, h.span.block_rows);
  if (!x) return ROT_ENOMEM;
  x->span = h.span;
  for (size_t i = 0; i < x->n_columns; i++) at_column(&at, x, i);
  if (at.bad) {
    rot_indices_free(x);
    return ROT_EVALUE;
  }
  *indices = x;
  return ROT_OK;
}
