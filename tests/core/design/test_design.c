/* Designs: rows by their numbers equal rows of longer pieces, each kind against its definition,
 * correlated scores, designs that are refused. */
#include "design/design.h"
#include "rot_test.h"

enum { PIECE = 5000, INPUTS = 6 };
static double piece[INPUTS][PIECE], single[INPUTS][PIECE];
static double *const columns[INPUTS] = {piece[0], piece[1], piece[2], piece[3], piece[4], piece[5]};
static double *const singles[INPUTS] = {single[0], single[1], single[2],
                                        single[3], single[4], single[5]};
static const double levels[] = {3.0, -0.0, 7.0}, weights[] = {1.0, 2.0, 1.0};
static double listed[PIECE];

static rot_vary law(rot_vary_kind kind, double a, double b, double c) {
  rot_vary l = {0};
  l.kind = kind;
  l.p[0] = a;
  l.p[1] = b;
  l.p[2] = c;
  l.low = -HUGE_VAL;
  l.high = HUGE_VAL;
  return l;
}

/* Inputs of each kind of design: a fixed one among five that vary. */
static void set(rot_vary input[INPUTS], rot_design_kind kind) {
  rot_vary values = law(ROT_VARY_VALUES, 0, 0, 0), column = law(ROT_VARY_COLUMN, 0, 0, 0);
  values.n = 3;
  values.x = levels;
  column.n = PIECE;
  column.x = listed;
  input[0] = law(ROT_VARY_UNIFORM, 0.0, 1.0, 0.0);
  input[1] = law(ROT_VARY_FIXED, 2.5, 0.0, 0.0);
  input[2] = law(ROT_VARY_NORMAL, 3.0, 2.0, 0.0);
  input[3] = values;
  input[3].weight = weights;
  input[4] = law(ROT_VARY_LOGNORMAL, 1.0, 1.5, 0.0);
  input[5] = law(ROT_VARY_TRIANGULAR, 0.0, 1.0, 3.0);
  for (int i = 0; i < INPUTS; i++) {
    if (kind == ROT_DESIGN_GRID && i != 1) input[i] = values;
    if (kind == ROT_DESIGN_ROWS) input[i] = column;
  }
}

static rot_design design(rot_design_kind kind, rot_vary input[], uint64_t points) {
  rot_design d = {0};
  d.kind = kind;
  d.n_inputs = INPUTS;
  d.input = input;
  d.points = points;
  d.seeded = 1;
  d.seed = ((uint64_t)1 << 35) + 17;
  return d;
}

/* Memory of the present design. */
static rot_store store;

static rot_status begin(rot_design *d) {
  rot_store_free(&store);
  return rot_design_begin(d, &store);
}

/* 1, 2, 3, ... of a simple generator. */
static uint64_t next_random(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return *state >> 20;
}

static void rows_by_number(void) {
  static const double matrix[] = {1.0, 0.5, -0.3, 0.5, 1.0, 0.2, -0.3, 0.2, 1.0};
  static const size_t which[] = {0, 2, 5};
  for (int i = 0; i < PIECE; i++) listed[i] = sqrt(i);
  for (int kind = 0; kind < ROT_DESIGN_COUNT; kind++)
    for (int with = 0; with < 3; with++) {
      rot_vary input[INPUTS];
      const int is_far = with == 1;
      const rot_design_kind of = (rot_design_kind)kind;
      uint64_t state = 1, first;
      set(input, of);
      rot_design d = design(of, input, is_far ? (uint64_t)1 << 49 : 1000 * PIECE);
      if (with == 2 &&
          (of == ROT_DESIGN_RANDOM || of == ROT_DESIGN_LATIN || of == ROT_DESIGN_SOBOL)) {
        d.n_correlated = 3;
        d.correlated = which;
        d.correlation = matrix;
      }
      ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
      const size_t n = d.n < PIECE ? (size_t)d.n : PIECE;
      first = d.n > PIECE ? (is_far ? d.n - PIECE : 777 * PIECE + 3) : 0;
      ROT_CHECK_EQ_INT(rot_design_rows(&d, first, n, columns), ROT_OK);
      for (int k = 0; k < rot_test_trials(40000); k++) {
        const size_t i = next_random(&state) % n;
        const size_t m = 1 + next_random(&state) % 5, take = m < n - i ? m : n - i;
        rot_design_rows(&d, first + i, take, singles);
        int bad = 0;
        for (int j = 0; j < INPUTS; j++)
          bad += !!memcmp(single[j], piece[j] + i, take * sizeof(double));
        ROT_CHECK(!bad);
      }
      ROT_CHECK_EQ_INT(rot_design_rows(&d, d.n, 0, columns), ROT_OK);
      ROT_CHECK_EQ_INT(rot_design_rows(&d, d.n, 1, columns), ROT_EVALUE);
      ROT_CHECK_EQ_INT(rot_design_rows(&d, d.n - 1, 2, columns), ROT_EVALUE);
      ROT_CHECK_EQ_INT(rot_design_rows(&d, UINT64_MAX, 1, columns), ROT_EVALUE);
      ROT_CHECK_EQ_INT(rot_design_rows(&d, d.n - 1, 1, singles), ROT_OK);
    }
}

static void grid(void) {
  rot_vary input[INPUTS];
  set(input, ROT_DESIGN_GRID);
  input[0].n = 2;
  rot_design d = design(ROT_DESIGN_GRID, input, 0);
  ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
  ROT_CHECK_EQ_INT(d.n, 2 * 81);
  rot_design_rows(&d, 0, 162, columns);
  for (size_t i = 0; i < 162; i++) {
    ROT_CHECK_ULP(piece[0][i], levels[i % 2], 0);
    ROT_CHECK_ULP(piece[1][i], 2.5, 0);
    ROT_CHECK_ULP(piece[2][i], levels[i / 2 % 3], 0);
    ROT_CHECK_ULP(piece[3][i], levels[i / 6 % 3], 0);
    ROT_CHECK_ULP(piece[5][i], levels[i / 54 % 3], 0);
  }
  ROT_CHECK(signbit(piece[0][1]) && signbit(piece[2][2]));
}

static void list(void) {
  rot_vary input[INPUTS];
  set(input, ROT_DESIGN_ROWS);
  rot_design d = design(ROT_DESIGN_ROWS, input, 0);
  for (int i = 0; i < PIECE; i++) listed[i] = i == 3 ? -0.0 : i;
  ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
  ROT_CHECK_EQ_INT(d.n, PIECE);
  rot_design_rows(&d, 3, 2, columns);
  ROT_CHECK(signbit(piece[0][0]));
  ROT_CHECK_ULP(piece[5][1], 4.0, 0);
}

/* Coordinates are numbered by the inputs that take one: 0, 2, 3, 4, 5 have 0 .. 4. */
static void random_rows(void) {
  rot_vary input[INPUTS];
  double even[100], odd[100];
  for (int kind = 0; kind < ROT_DESIGN_COUNT; kind++) {
    set(input, ROT_DESIGN_RANDOM);
    for (int i = 0; i < INPUTS; i++)
      if (i != 1) input[i] = law(ROT_VARY_UNIFORM, 0, 1, 0);
    rot_design d = design((rot_design_kind)kind, input, 1000);
    if (kind == ROT_DESIGN_GRID || kind == ROT_DESIGN_ROWS) continue;
    ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
    rot_design_rows(&d, 50, 100, columns);
    for (uint32_t v = 0; v < 5; v++) {
      const double *got = piece[v ? v + 1 : 0], *want = v % 2 ? odd : even;
      rot_philox_columns(d.seed, 50, 100, v / 2, ROT_STREAM_INPUTS, even, odd);
      if (kind == ROT_DESIGN_LATIN) {
        rot_permutation p;
        rot_permutation_begin(&p, 1000, d.seed, v, ROT_STREAM_PERMUTATIONS);
        rot_latin_column(&p, 50, 100, v % 2 ? odd : even);
      } else if (kind == ROT_DESIGN_SOBOL) {
        rot_sobol s;
        rot_sobol_begin(&s, v, &d.seed);
        rot_sobol_column(&s, 50, 100, v % 2 ? odd : even);
      } else if (kind == ROT_DESIGN_SALTELLI) {
        rot_sobol a, b;
        rot_sobol_begin(&a, v, &d.seed);
        rot_sobol_begin(&b, v + 5, &d.seed);
        for (uint64_t i = 0; i < 100; i++) {
          const uint64_t j = (i + 50) / 7, k = (i + 50) % 7;
          rot_sobol_column(k == 1 || k == v + 2 ? &b : &a, j, 1, (v % 2 ? odd : even) + i);
        }
      }
      for (int i = 0; i < 100; i++) ROT_CHECK_ULP(got[i], want[i], 0);
    }
    for (int i = 0; i < 100; i++) ROT_CHECK_ULP(piece[1][i], 2.5, 0);
  }
}

static void unscrambled(void) {
  rot_vary input[INPUTS];
  set(input, ROT_DESIGN_SOBOL);
  rot_design d = design(ROT_DESIGN_SOBOL, input, 8);
  d.seeded = 0;
  ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
  rot_design_rows(&d, 0, 8, columns);
  const double first[] = {0x1p-53, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125};
  for (int i = 0; i < 8; i++) ROT_CHECK_ULP(piece[0][i], first[i], 0);
  ROT_CHECK(isfinite(piece[2][0])); /* the normal quantile of point 0 */
}

static void saltelli_counts(void) {
  rot_vary input[INPUTS];
  set(input, ROT_DESIGN_SALTELLI);
  rot_design d = design(ROT_DESIGN_SALTELLI, input, 10);
  ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
  ROT_CHECK_EQ_INT(d.n, 70);
}

/* Correlations of the scores in 2^16 rows, and the margins of the laws. */
static void correlated(void) {
  static const double matrix[] = {1.0, 0.5, -0.3, 0.5, 1.0, 0.2, -0.3, 0.2, 1.0};
  static const size_t which[] = {0, 2, 4};
  const rot_design_kind kinds[] = {ROT_DESIGN_RANDOM, ROT_DESIGN_LATIN, ROT_DESIGN_SOBOL};
  for (int k = 0; k < 3; k++) {
    enum { ROWS = 13 * PIECE };
    rot_vary input[INPUTS];
    double sum[3] = {0}, product[3][3] = {{0}}, with_other = 0.0;
    set(input, kinds[k]);
    input[0] = law(ROT_VARY_NORMAL, 0.0, 1.0, 0.0);
    input[0].low = -30.0; /* by the probability; the others by the score */
    rot_design d = design(kinds[k], input, ROWS);
    d.n_correlated = 3;
    d.correlated = which;
    d.correlation = matrix;
    ROT_CHECK_EQ_INT(begin(&d), ROT_OK);
    for (uint64_t first = 0; first < ROWS; first += PIECE) {
      rot_design_rows(&d, first, PIECE, columns);
      for (int i = 0; i < PIECE; i++) {
        const double z[3] = {piece[0][i], (piece[2][i] - 3.0) / 2.0, log(piece[4][i]) / log(1.5)};
        for (int a = 0; a < 3; a++) {
          sum[a] += z[a];
          for (int b = 0; b < 3; b++) product[a][b] += z[a] * z[b];
        }
        with_other += z[1] * (piece[5][i] - 4.0 / 3.0);
      }
    }
    for (int a = 0; a < 3; a++) {
      ROT_CHECK(fabs(sum[a]) < 4.5 * sqrt(ROWS));
      for (int b = 0; b < 3; b++)
        ROT_CHECK(fabs(product[a][b] / ROWS - matrix[3 * a + b]) < 4.5 * sqrt(2.0 / ROWS));
    }
    ROT_CHECK(fabs(with_other) < 4.5 * sqrt(ROWS));
  }
}

static void refused(void) {
  static const double indefinite[] = {1.0, 0.9, -0.9, 0.9, 1.0, 0.9, -0.9, 0.9, 1.0};
  static const double asymmetric[] = {1.0, 0.5, 0.3, 0.5, 1.0, 0.2, -0.3, 0.2, 1.0};
  static const double diagonal[] = {1.0, 0.5, 0.3, 0.5, 0.9, 0.2, 0.3, 0.2, 1.0};
  static const double sound[] = {1.0, 0.5, 0.3, 0.5, 1.0, 0.2, 0.3, 0.2, 1.0};
  static const size_t which[] = {0, 2, 4}, with_fixed[] = {0, 1, 2}, order[] = {0, 4, 2},
                      beyond[] = {0, 2, 6};
  static rot_vary many[65];
  rot_vary input[INPUTS];
  rot_design d;
#define EXPECT(wanted, kind, points, change)                                                       \
  do {                                                                                             \
    set(input, kind);                                                                              \
    d = design(kind, input, points);                                                               \
    change;                                                                                        \
    ROT_CHECK_EQ_INT(begin(&d), wanted);                                                           \
  } while (0)
  EXPECT(ROT_EVALUE, ROT_DESIGN_RANDOM, 0, (void)0);
  EXPECT(ROT_OK, ROT_DESIGN_RANDOM, 1, (void)0);
  EXPECT(ROT_OK, ROT_DESIGN_RANDOM, (uint64_t)1 << 52, (void)0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_RANDOM, ((uint64_t)1 << 52) + 1, (void)0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SALTELLI, (uint64_t)1 << 50, (void)0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_RANDOM, 5, d.kind = ROT_DESIGN_COUNT);
  EXPECT(ROT_EVALUE, ROT_DESIGN_RANDOM, 5, d.n_inputs = 0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_RANDOM, 5, d.seeded = 0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_LATIN, 5, d.seeded = 0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SALTELLI, 5, d.seeded = 0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SOBOL, 5, input[2].p[1] = -1.0);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SOBOL, 5, input[2].kind = ROT_VARY_COLUMN; input[2].n = 5;
         input[2].x = listed);
  EXPECT(ROT_EVALUE, ROT_DESIGN_GRID, 5, input[2] = law(ROT_VARY_UNIFORM, 0, 1, 0));
  EXPECT(ROT_EVALUE, ROT_DESIGN_GRID, 5, input[2].weight = weights);
  EXPECT(ROT_EVALUE, ROT_DESIGN_GRID, 5, input[2].n = (size_t)1 << 51);
  EXPECT(ROT_EVALUE, ROT_DESIGN_ROWS, 5, input[2].n = 5);
  EXPECT(ROT_EVALUE, ROT_DESIGN_ROWS, 5, input[2] = law(ROT_VARY_FIXED, 1, 0, 0));
  const double *matrices[] = {sound, indefinite, asymmetric, diagonal};
  for (int i = 0; i < 4; i++)
    EXPECT(i ? ROT_EVALUE : ROT_OK, ROT_DESIGN_SOBOL, 5, d.n_correlated = 3; d.correlated = which;
           d.correlation = matrices[i]);
  const size_t *inputs[] = {with_fixed, order, beyond};
  for (int i = 0; i < 3; i++)
    EXPECT(ROT_EVALUE, ROT_DESIGN_SOBOL, 5, d.n_correlated = 3; d.correlated = inputs[i];
           d.correlation = sound);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SALTELLI, 5, d.n_correlated = 3; d.correlated = which;
         d.correlation = sound);
  for (int i = 0; i < 65; i++) many[i] = law(ROT_VARY_UNIFORM, 0, 1, 0);
  EXPECT(ROT_OK, ROT_DESIGN_SOBOL, 5, d.input = many; d.n_inputs = 64);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SOBOL, 5, d.input = many; d.n_inputs = 65);
  EXPECT(ROT_OK, ROT_DESIGN_RANDOM, 5, d.input = many; d.n_inputs = 65);
  EXPECT(ROT_OK, ROT_DESIGN_SALTELLI, 5, d.input = many; d.n_inputs = 32);
  EXPECT(ROT_EVALUE, ROT_DESIGN_SALTELLI, 5, d.input = many; d.n_inputs = 33);
}

static void names(void) {
  ROT_CHECK(!strcmp(rot_design_name(ROT_DESIGN_SALTELLI), "saltelli"));
  ROT_CHECK(!rot_design_name(-1) && !rot_design_name(ROT_DESIGN_COUNT));
}

int main(void) {
  rows_by_number();
  grid();
  list();
  random_rows();
  unscrambled();
  saltelli_counts();
  correlated();
  refused();
  names();
  rot_store_free(&store);
  return rot_test_report("design");
}
