/* Sobol indices: the Ishigami function and a sum, sums against plain loops, base points across
 * blocks, all bits for any chunks, standard errors over many seeds, the long form. */
#include "rot_test.h"
#include "summary/indices.h"
#include "summary_kit.h"

static const rot_tree_node *const type = &rot_indices_node;
static const double pi = 3.14159265358979323846;

/* ---- designs --------------------------------------------------------------------------------- */

typedef double function(const double x[]);

static double ishigami(const double x[]) {
  return sin(x[0]) + 7.0 * sin(x[1]) * sin(x[1]) + 0.1 * pow(x[2], 4.0) * sin(x[0]);
}

/* Variances 1, 4 and 9 of 14. */
static double weighted(const double x[]) { return 100.0 + x[0] + 2.0 * x[1] - 3.0 * x[2]; }

/* Row of a Saltelli design of random numbers in (-pi, pi), d = 3: a function of seed and row. */
static double row_value(function *f, uint64_t seed, uint64_t row) {
  const uint64_t point = row / 5, variant = row % 5;
  uint64_t state = seed * 0x100000001 + point * 16;
  double a[3], b[3];
  for (int i = 0; i < 3; i++) a[i] = pi * (2.0 * kit_uniform(&state) - 1.0);
  for (int i = 0; i < 3; i++) b[i] = pi * (2.0 * kit_uniform(&state) - 1.0);
  if (variant == 1) return f(b);
  if (variant >= 2) a[variant - 2] = b[variant - 2];
  return f(a);
}

/* The rows of a design in x (and status), block by block. */
static rot_indices *block_of(const rot_indices *form, uint64_t block, uint64_t rows,
                             const double x[], const int status[]) {
  const uint64_t first = block * form->span.block_rows;
  const uint64_t most = form->span.block_rows;
  const size_t n = (size_t)(rows - first < most ? rows - first : most);
  const double *column[] = {x + first, x + first};
  double shift[2] = {0.0, 0.0};
  for (size_t i = 0; i < form->n_columns; i++) shift[i] = form->column[i].shift;
  rot_indices *s =
      rot_indices_new(form->n_inputs, form->n_columns, shift, form->run, form->span.block_rows);
  ROT_CHECK_EQ_INT(rot_indices_add(s, first, n, column, status ? status + first : NULL), ROT_OK);
  return s;
}

static kit_table table_of(const rot_indices *s) {
  kit_table table = kit_table_new(rot_indices_rows_size(s));
  rot_indices_rows(s, &table.rows);
  return table;
}

/* Through the long form and back. */
static rot_indices *read_back(rot_indices *s) {
  kit_table table = table_of(s), again;
  rot_indices *read = NULL;
  ROT_CHECK(kit_sorted(&table));
  ROT_CHECK_EQ_INT(rot_indices_read(table.n, &table.rows, &read), ROT_OK);
  again = table_of(read);
  ROT_CHECK(kit_same(&table, &again));
  kit_table_free(&table);
  kit_table_free(&again);
  rot_indices_free(s);
  return read;
}

static rot_indices *whole(const rot_indices *form, uint64_t rows, const double x[],
                          const int status[], uint64_t size, uint64_t turn) {
  const uint64_t blocks = rot_extent_blocks((rot_extent){0, rows, form->span.block_rows});
  rot_tree *tree = rot_tree_new(type), *part = rot_tree_new(type);
  void *node = NULL;
  uint64_t places = 16;
  while (places * size < blocks) places *= 2;
  for (uint64_t i = 0; i < places; i++) {
    const uint64_t chunk = i * turn % places;
    if (chunk * size >= blocks) continue;
    for (uint64_t k = 0; k < size; k++) {
      const uint64_t b = chunk * size + k * turn % size;
      if (b < blocks) rot_tree_add(part, block_of(form, b, rows, x, status));
    }
    ROT_CHECK_EQ_INT(rot_tree_finish(part, &node), ROT_OK);
    ROT_CHECK_EQ_INT(rot_tree_add(tree, read_back(node)), ROT_OK);
  }
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  rot_tree_free(tree);
  rot_tree_free(part);
  return node;
}

/* ---- sums ------------------------------------------------------------------------------------ */

/* Plain loops in long double, whatever its length: sums of whole numbers are exact. */
static void check_sums(const rot_indices *s, size_t column, uint64_t rows, const double x[],
                       const int status[]) {
  const rot_indices_column *c = &s->column[column];
  const size_t d = s->n_inputs, length = d + 2;
  long double *want = calloc(16 * s->terms, sizeof *want);
  uint64_t points[16] = {0}, skipped = 0;
  for (uint64_t j = 0; (j + 1) * length <= rows; j++) {
    const double *v = x + j * length;
    const size_t g = (size_t)(j / s->run % 16);
    int good = 1;
    for (size_t k = 0; k < length; k++) {
      if (!isfinite(v[k]) || (status && status[j * length + k])) good = 0;
    }
    skipped += !good;
    if (!good) continue;
    points[g]++;
    long double *w = want + g * s->terms;
    const long double a = v[0] - c->shift, b = v[1] - c->shift;
    w[0] += a;
    w[1] += b;
    w[2] += a * a;
    w[3] += b * b;
    for (size_t i = 0; i < d; i++) {
      w[4 + i] += ((long double)v[1] - v[2 + i]) * ((long double)v[1] - v[2 + i]);
      w[4 + d + i] += ((long double)v[0] - v[2 + i]) * ((long double)v[0] - v[2 + i]);
    }
  }
  ROT_CHECK_EQ_INT(c->skipped, skipped);
  for (size_t g = 0; g < 16; g++) {
    ROT_CHECK_EQ_INT(c->points[g], points[g]);
    for (size_t k = 0; k < s->terms; k++) {
      ROT_CHECK(c->sum[g * s->terms + k].hi == (double)want[g * s->terms + k]);
    }
  }
  free(want);
}

static void check_chunks(size_t d, uint64_t run, uint64_t block_rows, const double shift[],
                         uint64_t rows, const double x[], const int status[]) {
  rot_indices *form = rot_indices_new(d, 2, shift, run, block_rows);
  char want[ROT_HASH_SIZE], got[ROT_HASH_SIZE];
  for (uint64_t size = 1; size <= 16; size *= 4) {
    for (uint64_t turn = 1; turn <= 7; turn += 6) {
      rot_indices *s = whole(form, rows, x, status, size, turn);
      kit_table table = table_of(s);
      kit_hash(&table, got);
      if (size == 1 && turn == 1) {
        memcpy(want, got, sizeof want);
        check_sums(s, 0, rows, x, status);
        check_sums(s, 1, rows, x, status);
      }
      ROT_CHECK(strcmp(want, got) == 0);
      kit_table_free(&table);
      rot_indices_free(s);
      if (d > 1000) size = 16;
    }
  }
  rot_indices_free(form);
}

/* Whole numbers, lengths of base points that do and do not divide 2^16, failed rows, ragged ends,
 * incomplete last base points. */
static void any_chunks(void) {
  static const struct {
    size_t d;
    uint64_t rows, run;
  } row[] = {{1, 3 * 65536, 1},
             {2, 65536 + 8, 3},
             {3, 5 * 65536 + 65, 1},
             {5, 7 * 37449, 100},
             {5, 3 * 65536 + 3, 1},
             {11, 65537, 2},
             {20000, 65536 + 5000, 1},
             {20000, 80008, 1},
             {300, 20000, 2},
             {254, 1024, 1},
             {3, 4, 1},
             {3, 5, 1}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    const uint64_t rows = row[i].rows;
    const double shift[] = {3.0, -7.0};
    uint64_t state = i;
    double *x = malloc(rows * sizeof *x);
    int *status = calloc(rows, sizeof *status);
    for (uint64_t r = 0; r < rows; r++) {
      x[r] = (double)kit_below(&state, 1000) - 300.0;
      if (row[i].d > 1000) continue;
      if (kit_below(&state, 997) == 0) status[r] = 2;
      if (kit_below(&state, 1999) == 0) x[r] = kit_below(&state, 2) ? NAN : INFINITY;
    }
    /* The base points on both sides of the first border. */
    if (rows > 65540 && row[i].d < 1000) {
      status[65535] = i % 2 ? 1 : 0;
      status[65536] = 0;
    }
    /* Base points of 20002 rows take 20 MB a block: through blocks of 256 rows some minutes. */
    const int from = row[i].d < 1000 ? 0 : getenv("ROTDYN_LONG") && i == 7 ? 0 : KIT_SIZES - 1;
    for (int k = from; k < KIT_SIZES; k++) {
      check_chunks(row[i].d, row[i].run, kit_block_rows[k], shift, rows, x, status);
    }
    free(x);
    free(status);
  }
}

/* ---- indices --------------------------------------------------------------------------------- */

typedef struct answer {
  double first[3], first_se[3], total[3], total_se[3];
  rot_indices_info info;
} answer;

static answer answer_of(function *f, uint64_t seed, uint64_t points, uint64_t run) {
  const uint64_t rows = 5 * points;
  double *x = malloc(rows * sizeof *x), shift = 3.0;
  answer a;
  for (uint64_t r = 0; r < rows; r++) x[r] = row_value(f, seed, r);
  rot_indices *form = rot_indices_new(3, 1, &shift, run, 65536);
  rot_indices *s = whole(form, rows, x, NULL, 1, 1);
  ROT_CHECK_EQ_INT(rot_indices_estimate(s, 0, a.first, a.first_se, a.total, a.total_se, &a.info),
                   ROT_OK);
  rot_indices_free(form);
  rot_indices_free(s);
  free(x);
  return a;
}

/* Ishigami's function, a = 7, b = 0.1: exact variances. */
static void ishigami_indices(void) {
  const double a = 7.0, b = 0.1, p4 = pow(pi, 4.0), p8 = p4 * p4;
  const double v1 = 0.5 * (1.0 + b * p4 / 5.0) * (1.0 + b * p4 / 5.0), v2 = a * a / 8.0;
  const double v13 = b * b * p8 * (1.0 / 18.0 - 1.0 / 50.0), v = v1 + v2 + v13;
  const double first[] = {v1 / v, v2 / v, 0.0};
  const double total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  const int seeds = rot_test_trials(100) < 25 ? 25 : 100, outside = seeds == 25 ? 2 : 5;
  int inside[6] = {0}, mean_inside = 0;
  double ratio = 0.0;
  ROT_CHECK_REL(first[0], 0.3139, 2e-4);
  ROT_CHECK_REL(total[2], 0.2437, 2e-4);
  for (int seed = 0; seed < seeds; seed++) {
    const answer r = answer_of(ishigami, (uint64_t)seed, 4096, seed % 2 ? 1 : 256);
    ROT_CHECK_EQ_INT(r.info.points, 4096);
    ROT_CHECK_EQ_INT(r.info.skipped, 0);
    ROT_CHECK_REL(r.info.variance, v, 0.1);
    mean_inside += fabs(r.info.mean - a / 2.0) < 4.0 * sqrt(v / 8192.0);
    for (int i = 0; i < 3; i++) {
      inside[i] += fabs(r.first[i] - first[i]) <= 3.0 * r.first_se[i];
      inside[3 + i] += fabs(r.total[i] - total[i]) <= 3.0 * r.total_se[i];
      ROT_CHECK(r.first_se[i] < 0.1 && r.total_se[i] < 0.05);
      ratio += (r.total[i] - total[i]) * (r.total[i] - total[i]) / (r.total_se[i] * r.total_se[i]);
    }
  }
  printf("indices: within three standard errors of %d seeds: first %d %d %d, total %d %d %d\n",
         seeds, inside[0], inside[1], inside[2], inside[3], inside[4], inside[5]);
  ratio /= 3.0 * seeds;
  printf("indices: mean square of error over standard error, total indices: %.3g\n", ratio);
  for (int i = 0; i < 6; i++) ROT_CHECK(inside[i] >= seeds - outside);
  ROT_CHECK(mean_inside >= seeds - 1);
  ROT_CHECK(ratio > 0.6 && ratio < 1.9);
}

/* First and total indices of a sum are its parts of the variance. */
static void additive(void) {
  const answer r = answer_of(weighted, 5, 16384, 1);
  static const double want[] = {1.0 / 14.0, 4.0 / 14.0, 9.0 / 14.0};
  for (int i = 0; i < 3; i++) {
    ROT_CHECK(fabs(r.first[i] - want[i]) < 4.0 * r.first_se[i] && r.first_se[i] < 0.02);
    ROT_CHECK(fabs(r.total[i] - want[i]) < 4.0 * r.total_se[i] && r.total_se[i] < 0.02);
  }
  ROT_CHECK_REL(r.info.variance, 14.0 * pi * pi / 3.0, 0.05);
  ROT_CHECK(fabs(r.info.mean - 100.0) < 0.3);
}

/* Two base points: all by hand. f(A) = 1, 5; f(B) = 2, 4; AB_1 = 4, 7. */
static void by_hand(void) {
  const double x[] = {1.0, 2.0, 4.0, 5.0, 4.0, 7.0}, shift = 10.0, *column[] = {x};
  double first, first_se, total, total_se;
  rot_indices_info info;
  rot_indices *s = rot_indices_new(1, 1, &shift, 1, 65536);
  ROT_CHECK_EQ_INT(rot_indices_add(s, 0, 6, column, NULL), ROT_OK);
  rot_indices_estimate(s, 0, &first, &first_se, &total, &total_se, &info);
  /* variance of 1, 5, 2, 4: mean 3, 10/3; (2 - 4)^2 + (4 - 7)^2 = 13; 3^2 + 2^2 = 13 */
  ROT_CHECK_EQ_INT(info.points, 2);
  ROT_CHECK_ULP(info.mean, 3.0, 0);
  ROT_CHECK_REL(info.variance, 10.0 / 3.0, 1e-15);
  ROT_CHECK_REL(first, 1.0 - 13.0 / 4.0 / (10.0 / 3.0), 1e-13);
  ROT_CHECK_REL(total, 13.0 / 4.0 / (10.0 / 3.0), 1e-15);
  /* without point 0: variance 1/2, total 4/2/0.5 = 4; without point 1: 9/2/0.5 = 9 */
  ROT_CHECK_REL(total_se, 2.5, 1e-14);
  ROT_CHECK_REL(first_se, fabs((9.0 - 4.0) / 2.0), 1e-14);
  rot_indices_free(s);
  s = rot_indices_new(1, 1, NULL, 2, 65536); /* one group: no standard error */
  rot_indices_add(s, 0, 6, column, NULL);
  rot_indices_estimate(s, 0, &first, &first_se, &total, &total_se, &info);
  ROT_CHECK_REL(total, 0.975, 1e-14);
  ROT_CHECK(isnan(total_se) && isnan(first_se));
  ROT_CHECK_EQ_INT(rot_indices_add(s, 0, 6, column, NULL), ROT_EVALUE);
  rot_indices_free(s);
  s = rot_indices_new(1, 1, NULL, 1, 65536);
  ROT_CHECK_EQ_INT(rot_indices_add(s, 3, 6, column, NULL), ROT_EVALUE);
  rot_indices_estimate(s, 0, &first, &first_se, &total, &total_se, &info);
  ROT_CHECK(isnan(first) && isnan(total) && isnan(total_se) && isnan(info.variance));
  const double same[] = {2.0, 2.0, 2.0};
  column[0] = same;
  ROT_CHECK_EQ_INT(rot_indices_add(s, 0, 3, column, NULL), ROT_OK);
  rot_indices_estimate(s, 0, &first, &first_se, &total, &total_se, &info);
  ROT_CHECK(isnan(first) && isnan(total) && info.variance == 0.0 && info.mean == 2.0);
  rot_indices_free(s);
  const double bad = INFINITY;
  ROT_CHECK(!rot_indices_new(0, 1, NULL, 1, 256) && !rot_indices_new(65535, 1, NULL, 1, 256));
  ROT_CHECK(!rot_indices_new(1, 1, NULL, 0, 256) && !rot_indices_new(1, 1, &bad, 1, 256));
  for (int i = 0; i < KIT_NO_SIZES; i++) {
    ROT_CHECK(!rot_indices_new(1, 1, NULL, 1, kit_no_block_rows[i]));
  }
}

/* The longest base point: a block. */
static void longest(void) {
  double *x = malloc(65536 * sizeof *x);
  const double *column[] = {x};
  for (int i = 0; i < 65536; i++) x[i] = i;
  rot_indices *s = rot_indices_new(65534, 1, NULL, 1, 65536);
  ROT_CHECK_EQ_INT(rot_indices_add(s, 65536, 65536, column, NULL), ROT_OK);
  ROT_CHECK_EQ_INT(s->column[0].points[1], 1);
  ROT_CHECK(s->column[0].sum[s->terms + 4 + 65533].hi == 65534.0 * 65534.0);
  ROT_CHECK(s->column[0].sum[s->terms + 4 + 2 * 65534 - 1].hi == 65535.0 * 65535.0);
  rot_indices_free(s);
  free(x);
}

/* The numbers that files keep: 65536 = 1 modulo 3, so two rows of base point 21845, then 21846 in
 * group 6 of 16, then one row. */
static void known_rows(void) {
  const double x[] = {8.0, NAN, 1.0, 3.0, 7.0, -5.0}, shift = 1.0, *column[] = {x};
  rot_indices *s = rot_indices_new(1, 1, &shift, 1, 65536);
  ROT_CHECK_EQ_INT(rot_indices_add(s, 65536, 6, column, NULL), ROT_OK);
  kit_row want[6 + 18 + 2 * 96 + 3] = {
      {-1, 100, 0, 65536.0}, {-1, 101, 0, 6.0},     {-1, 102, 0, 1.0}, {-1, 103, 0, 1.0},
      {-1, 104, 0, 1.0},     {-1, 105, 0, 65536.0}, {0, 110, 0, 1.0},  {0, 111, 0, 0.0}};
  /* a = 0, b = 2, their squares, (3 - 7)^2, (1 - 7)^2 */
  static const double sums[] = {0.0, 2.0, 0.0, 4.0, 16.0, 36.0};
  kit_row *row = want + 8;
  for (int g = 0; g < 16; g++) *row++ = (kit_row){0, 112, g, g == 6};
  for (int k = 0; k < 96; k++) *row++ = (kit_row){0, 113, k, k % 16 == 6 ? sums[k / 16] : 0.0};
  for (int k = 0; k < 96; k++) *row++ = (kit_row){0, 114, k, 0.0};
  *row++ = (kit_row){0, 115, 65536, 8.0};
  *row++ = (kit_row){0, 115, 65537, 0.0};
  *row++ = (kit_row){0, 116, 65541, -5.0};
  kit_table table = table_of(s);
  ROT_CHECK(isnan(table.rows.value[table.n - 2]));
  table.rows.value[table.n - 2] = 0.0;
  ROT_CHECK(kit_is(&table, sizeof want / sizeof want[0], want));
  kit_table_free(&table);
  rot_indices_free(s);
}

static void merges(void) {
  enum { N = 3 * 65536 };
  double *x = calloc(N, sizeof *x);
  rot_indices *form = rot_indices_new(3, 1, NULL, 1, 65536);
  rot_indices *other = rot_indices_new(3, 1, NULL, 2, 65536);
  rot_indices *a = block_of(form, 0, N, x, NULL), *b = block_of(form, 1, N, x, NULL);
  rot_indices *c = block_of(form, 2, N, x, NULL), *d = block_of(other, 1, N, x, NULL);
  ROT_CHECK_EQ_INT(rot_indices_merge(a, c), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_indices_merge(b, c), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_indices_merge(a, d), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_indices_merge(a, b), ROT_OK);
  ROT_CHECK_EQ_INT(rot_indices_merge(a, c), ROT_OK);
  ROT_CHECK_EQ_INT(rot_indices_merge(a, c), ROT_EVALUE);
  rot_indices_free(a);
  rot_indices_free(b);
  rot_indices_free(c);
  rot_indices_free(d);
  rot_indices_free(form);
  rot_indices_free(other);
  free(x);
}

/* Blocks of different sizes are not merged, nor read for each other. */
static void mixed_sizes(void) {
  double x[512] = {0.0};
  const double *column[] = {x};
  rot_indices *a = rot_indices_new(1, 1, NULL, 1, 256), *b = rot_indices_new(1, 1, NULL, 1, 512);
  rot_indices *back;
  rot_tree *tree = rot_tree_new(type);
  ROT_CHECK_EQ_INT(rot_indices_add(a, 0, 257, column, NULL), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_indices_add(a, 0, 256, column, NULL), ROT_OK);
  ROT_CHECK_EQ_INT(rot_indices_add(b, 256, 256, column, NULL), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_indices_add(b, 512, 256, column, NULL), ROT_OK);
  b->span.first_row = 256;
  ROT_CHECK_EQ_INT(rot_indices_merge(a, b), ROT_EVALUE);
  b->span.first_row = 512;
  ROT_CHECK_EQ_INT(rot_tree_add(tree, a), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_add(tree, b), ROT_EVALUE);
  kit_table table = table_of(b);
  for (int i = 0; i < KIT_NO_SIZES; i++) {
    table.rows.value[5] = (double)kit_no_block_rows[i];
    ROT_CHECK_EQ_INT(rot_indices_read(table.n, &table.rows, &back), ROT_EVALUE);
  }
  table.rows.value[5] = 1024.0; /* row 512 begins no block */
  ROT_CHECK_EQ_INT(rot_indices_read(table.n, &table.rows, &back), ROT_EVALUE);
  kit_table_free(&table);
  rot_indices_free(b);
  rot_tree_free(tree);
}

static void damages(void) {
  uint64_t state = 21;
  double x[70000];
  for (int i = 0; i < 70000; i++) x[i] = kit_uniform(&state);
  rot_indices *form = rot_indices_new(3, 2, NULL, 1, 65536), *back;
  rot_indices *s = block_of(form, 1, 70000, x, NULL);
  kit_table table = table_of(s);
  long refused = 0;
  for (int i = 0; i < 10000; i++) {
    kit_table damaged;
    kit_table_copy(&table, &damaged);
    kit_damage(&state, &damaged);
    const rot_status status = rot_indices_read(damaged.n, &damaged.rows, &back);
    ROT_CHECK(status == ROT_EVALUE || status == ROT_OK);
    ROT_CHECK((status == ROT_OK) == (back != NULL));
    refused += status != ROT_OK;
    if (back) {
      kit_table again = table_of(back);
      ROT_CHECK(kit_same(&damaged, &again));
      kit_table_free(&again);
    }
    rot_indices_free(back);
    kit_table_free(&damaged);
  }
  printf("indices: %ld of 10000 damages refused\n", refused);
  ROT_CHECK(refused > 7000);
  for (size_t i = 0; i < table.n; i++) {
    if (table.rows.kind[i] != ROT_KIND_INDEX_POINTS && table.rows.kind[i] > 105) continue;
    const double old = table.rows.value[i];
    table.rows.value[i] = table.rows.kind[i] == ROT_KIND_INDEX_RUN ? 0.0 : old + 1.0;
    ROT_CHECK_EQ_INT(rot_indices_read(table.n, &table.rows, &back), ROT_EVALUE);
    table.rows.value[i] = old;
  }
  kit_table_free(&table);
  rot_indices_free(s);
  rot_indices_free(form);
}

int main(void) {
  by_hand();
  additive();
  ishigami_indices();
  any_chunks();
  longest();
  known_rows();
  merges();
  mixed_sizes();
  damages();
  return rot_test_report("indices");
}
