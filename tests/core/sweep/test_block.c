/* Blocks of rows: each row is that of its number, whatever the block, the part and the threads;
 * derived inputs; refused rows and plans. */
#include "sweep/block.h"

#include "sweep_kit.h"

enum { INPUTS = 3, DERIVED = 1, OUTPUTS = 3, ROWS = 1500 };

typedef struct table {
  double number[INPUTS + DERIVED + OUTPUTS + 1][ROWS];
  double *column[INPUTS + DERIVED + OUTPUTS];
  int status[ROWS];
} table;

static table whole, other;

static rot_block block_of(table *t, size_t from) {
  for (size_t k = 0; k < INPUTS + DERIVED + OUTPUTS; k++) t->column[k] = t->number[k] + from;
  return (rot_block){t->column, t->column + INPUTS + DERIVED, t->status + from,
                     t->number[INPUTS + DERIVED + OUTPUTS] + from};
}

static int same_rows(const table *a, const table *b, size_t from, size_t to) {
  for (size_t i = from; i < to; i++) {
    if (a->status[i] != b->status[i]) return 0;
    for (size_t k = 0; k < INPUTS + DERIVED + OUTPUTS + 1; k++) {
      if (memcmp(&a->number[k][i], &b->number[k][i], sizeof(double))) return 0;
    }
  }
  return 1;
}

/* Mass, viscous coefficient (negative in some rows, and NaN for the square root) and speed. */
static rot_vary input[INPUTS];
static const char *const paths[] = {"body$mass_kg", "resistance$coulomb_n_m", "omega0_rad_per_s"};
static const char *const outputs[OUTPUTS] = {"final_theta_rad", "stop_time_s", "lost_j"};
static const size_t bound[] = {0, 3, 2}; /* the coefficient is derived: the square of input 1 */
static const int op[] = {ROT_OP_INPUT, ROT_OP_INPUT, ROT_OP_MULTIPLY}, arg[] = {1, 1, 0};
static const rot_formula square = {3, op, arg, 0, NULL, INPUTS};
static const double end_s = 20.0;
static rot_store store;

static rot_sweep sweep_of(const rot_object *scene) {
  static const double low[] = {-0.1, 0.0, -4.0}, high[] = {3.0, 0.6, 4.0};
  rot_sweep s = {0};
  for (int k = 0; k < INPUTS; k++) {
    input[k] = (rot_vary){.kind = ROT_VARY_UNIFORM, .low = -HUGE_VAL, .high = HUGE_VAL};
    input[k].p[0] = low[k];
    input[k].p[1] = high[k];
  }
  s.plan =
      (rot_row_plan){scene, INPUTS, paths, 1, &end_s, "axle_drag", 0, 1e-9, 1e6, OUTPUTS, outputs};
  s.design.kind = ROT_DESIGN_SOBOL;
  s.design.points = ROWS;
  s.design.n_inputs = INPUTS;
  s.design.input = input;
  s.design.seeded = 1;
  s.design.seed = 42;
  s.n_derived = DERIVED;
  s.derived = &square;
  s.bound = bound;
  s.threads = 1;
  rot_store_free(&store);
  ROT_CHECK(rot_design_begin(&s.design, &store) == ROT_OK);
  return s;
}

static void run(const rot_sweep *s, table *t, size_t first, size_t n) {
  const rot_block block = block_of(t, first);
  rot_info info;
  rot_refusal no;
  ROT_CHECK(rot_block_run(s, first, n, &block, NULL, &info, &no) == ROT_OK);
  ROT_CHECK(info.rows_done == n && info.status == ROT_OK);
}

/* Inputs are those of the design, the derived one is its formula, outputs are those of the rows. */
static void rows_of_a_block(const rot_sweep *s) {
  rot_rows_worker *w;
  rot_refusal no;
  double *columns[INPUTS] = {other.number[0], other.number[1], other.number[2]};
  size_t refused = 0, differ = 0;
  run(s, &whole, 0, ROWS);
  ROT_CHECK(rot_design_rows(&s->design, 0, ROWS, columns) == ROT_OK);
  ROT_CHECK(rot_rows_open(&s->plan, &w, &no) == ROT_OK);
  for (size_t i = 0; i < ROWS; i++) {
    double x[INPUTS], v[OUTPUTS], error;
    for (int k = 0; k < INPUTS; k++) differ += !same_bits(whole.number[k][i], columns[k][i]);
    differ += !same_bits(whole.number[3][i], columns[1][i] * columns[1][i]);
    for (int k = 0; k < INPUTS; k++) x[k] = whole.number[bound[k]][i];
    const int status = rot_rows_run(w, x, v, &error, NULL, NULL);
    differ += status != whole.status[i] || !same_bits(error, whole.number[7][i]);
    for (int k = 0; k < OUTPUTS; k++) differ += !same_bits(v[k], whole.number[4 + k][i]);
    refused += status != ROT_OK;
    if (x[0] > 0.0) continue;
    differ += status != ROT_EVALUE || !isnan(v[0]) || !isnan(v[2]) || !isnan(error);
  }
  ROT_CHECK_EQ_INT(differ, 0);
  ROT_CHECK(refused > ROWS / 50 && refused < ROWS / 20); /* masses below 0: 0.1 of 3.1 */
  rot_rows_close(w);
}

static void other_ways(rot_sweep s) {
  static const size_t parts[] = {1, 7, 64, 0, ROWS, 3 * ROWS};
  run(&s, &whole, 0, ROWS);
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    for (int threads = 0; threads < 4; threads++) {
      s.part = parts[i];
      s.threads = threads;
      memset(&other, 1, sizeof other);
      run(&s, &other, 0, ROWS);
      ROT_CHECK(same_rows(&whole, &other, 0, ROWS));
    }
  }
  s.threads = 2;
  for (size_t split = 1; split < ROWS; split += 487) {
    memset(&other, 1, sizeof other);
    run(&s, &other, split, ROWS - split);
    run(&s, &other, 0, split);
    ROT_CHECK(same_rows(&whole, &other, 0, ROWS));
  }
  memset(&other, 1, sizeof other);
  run(&s, &other, 1000, 1);
  ROT_CHECK(same_rows(&whole, &other, 1000, 1001) && !same_rows(&whole, &other, 999, 1000));
  run(&s, &other, 0, 0);
}

static size_t polls;

static rot_status stop(void *ctx, double fraction) {
  (void)ctx;
  return fraction > 0.0 && ++polls == 3 ? ROT_EUNWIND : ROT_OK;
}

static void stopped(rot_sweep s) {
  const rot_block block = block_of(&other, 0);
  const rot_hooks hooks = {stop, NULL};
  rot_info info;
  rot_refusal no;
  s.part = 100;
  run(&s, &whole, 0, ROWS);
  ROT_CHECK(rot_block_run(&s, 0, ROWS, &block, &hooks, &info, &no) == ROT_EUNWIND);
  ROT_CHECK(info.rows_done == 300 && same_rows(&whole, &other, 0, 300));
}

static void refused_plans(rot_sweep s) {
  const rot_block block = block_of(&other, 0);
  rot_info info;
  rot_refusal no = {0};
  rot_sweep wrong = s;
  wrong.plan.n_outputs = 65;
  ROT_CHECK(rot_block_run(&wrong, 0, 1, &block, NULL, &info, &no) == ROT_EVALUE);
  ROT_CHECK(strstr(no.reason, "64") != NULL);
  wrong = s;
  wrong.plan.n_inputs = 65;
  ROT_CHECK(rot_block_run(&wrong, 0, 1, &block, NULL, &info, &no) == ROT_EVALUE);
  static const char *const unknown[] = {"body$mass_kg", "resistance$coulomb", "omega0_rad_per_s"};
  wrong = s;
  wrong.plan.inputs = unknown;
  ROT_CHECK(rot_block_run(&wrong, 0, 1, &block, NULL, &info, &no) == ROT_EVALUE && no.input == 1);
  /* Beyond the last row; a program that is damaged. */
  ROT_CHECK(rot_block_run(&s, ROWS, 1, &block, NULL, &info, &no) == ROT_EVALUE);
  ROT_CHECK(rot_block_run(&s, ROWS - 1, 2, &block, NULL, &info, &no) == ROT_EVALUE);
  rot_formula damaged = square;
  damaged.n_ops = 2;
  wrong = s;
  wrong.derived = &damaged;
  ROT_CHECK(rot_block_run(&wrong, 0, 1, &block, NULL, &info, &no) == ROT_EVALUE);
}

int main(void) {
  static const double x[] = {0.05, 0.01, 2.0};
  rot_object *dry = make_dry(x);
  const rot_sweep s = sweep_of(dry);
  rows_of_a_block(&s);
  other_ways(s);
  stopped(s);
  refused_plans(s);
  rot_store_free(&store);
  rot_object_free(dry);
  return rot_test_report("block");
}
