/* Formulas: each operation against C, the rules of R at special numbers, damaged programs. */
#include "design/formula.h"
#include "rot_test.h"

enum { N = 300 };
static double x[N], y[N], z[N], out[N];
static const double *const column[] = {x, y, z};

static void fill(void) {
  const double special[] = {0.0,  -0.0, 1.0,  -1.0,     2.0,       0.5,
                            -2.5, 3.0,  -3.0, HUGE_VAL, -HUGE_VAL, (double)NAN};
  for (int i = 0; i < N; i++) {
    x[i] = i < 144 ? special[i / 12] : 0.01 * i - 2.0;
    y[i] = i < 144 ? special[i % 12] : 1.7 - 0.013 * i;
    z[i] = i % 7;
  }
}

/* The program of one operation on x, y and z. */
static rot_status run(int op) {
  const int operands = rot_formula_operands(op), arg[] = {0, 1, 2, 0};
  int code[] = {ROT_OP_INPUT, ROT_OP_INPUT, ROT_OP_INPUT, 0};
  code[operands] = op;
  const rot_formula f = {(size_t)operands + 1, code, arg, 0, NULL, 3};
  return rot_formula_rows(&f, N, column, out);
}

static double c_value(int op, double a, double b, double c) {
  switch (op) {
  case ROT_OP_ADD: return a + b;
  case ROT_OP_SUBTRACT: return a - b;
  case ROT_OP_MULTIPLY: return a * b;
  case ROT_OP_DIVIDE: return a / b;
  case ROT_OP_NEGATE: return -a;
  case ROT_OP_SQRT: return sqrt(a);
  case ROT_OP_EXP: return exp(a);
  case ROT_OP_LOG: return log(a);
  case ROT_OP_SIN: return sin(a);
  case ROT_OP_COS: return cos(a);
  case ROT_OP_TAN: return tan(a);
  case ROT_OP_ABS: return fabs(a);
  default: break;
  }
  if (isnan(a) || (op != ROT_OP_IFELSE && isnan(b))) return (double)NAN;
  switch (op) {
  case ROT_OP_PMIN: return b < a ? b : a;
  case ROT_OP_PMAX: return b > a ? b : a;
  case ROT_OP_LESS: return a < b;
  case ROT_OP_LESS_EQUAL: return a <= b;
  case ROT_OP_GREATER: return a > b;
  case ROT_OP_GREATER_EQUAL: return a >= b;
  case ROT_OP_EQUAL: return a == b;
  case ROT_OP_NOT_EQUAL: return a != b;
  case ROT_OP_IFELSE: return a != 0.0 ? b : c;
  default: return (double)NAN;
  }
}

static int same(double a, double b) { return isnan(a) ? isnan(b) : !memcmp(&a, &b, sizeof a); }

static void operations(void) {
  for (int op = ROT_OP_ADD; op < ROT_OP_COUNT; op++) {
    if (op == ROT_OP_POWER) continue;
    ROT_CHECK_EQ_INT(run(op), ROT_OK);
    for (int i = 0; i < N; i++) ROT_CHECK(same(out[i], c_value(op, x[i], y[i], z[i])));
  }
}

/* Where R and pow() differ, and where a square is a product. */
static void powers(void) {
  ROT_CHECK_EQ_INT(run(ROT_OP_POWER), ROT_OK);
  for (int i = 0; i < N; i++) {
    double want = pow(x[i], y[i]);
    if (y[i] == 2.0) want = x[i] * x[i];
    if (x[i] == 0.0 && y[i] != 0.0 && !isnan(y[i])) want = y[i] > 0.0 ? 0.0 : HUGE_VAL;
    /* Even the power of a base of -1 or less with an infinite exponent is NaN in R. */
    if (x[i] < 0.0 && isinf(y[i])) want = (double)NAN;
    if (isinf(x[i]) && x[i] < 0.0 && isfinite(y[i]) && y[i] != floor(y[i])) want = (double)NAN;
    if (isinf(x[i]) && x[i] < 0.0 && isfinite(y[i]) && y[i] < 0.0 && y[i] == floor(y[i]))
      want = 0.0;
    if (!same(out[i], want)) printf("%g ^ %g: %g, not %g\n", x[i], y[i], out[i], want);
    ROT_CHECK(same(out[i], want));
  }
}

/* (x + 2) * y - x / 4: order of operands, constants, more than one block; in place. */
static void program(void) {
  const int op[] = {ROT_OP_INPUT, ROT_OP_CONSTANT, ROT_OP_ADD,    ROT_OP_INPUT,   ROT_OP_MULTIPLY,
                    ROT_OP_INPUT, ROT_OP_CONSTANT, ROT_OP_DIVIDE, ROT_OP_SUBTRACT};
  const int arg[] = {0, 1, 0, 1, 0, 0, 0, 0, 0};
  const double constant[] = {4.0, 2.0};
  const rot_formula f = {9, op, arg, 2, constant, 2};
  double want[N], own[N];
  for (int i = 0; i < N; i++) want[i] = (x[i] + 2.0) * y[i] - x[i] / 4.0;
  ROT_CHECK_EQ_INT(rot_formula_rows(&f, N, column, out), ROT_OK);
  for (int i = 0; i < N; i++) ROT_CHECK(same(out[i], want[i]));
  memcpy(own, x, sizeof own);
  const double *const in_place[] = {own, y};
  ROT_CHECK_EQ_INT(rot_formula_rows(&f, N, in_place, own), ROT_OK);
  for (int i = 0; i < N; i++) ROT_CHECK(same(own[i], want[i]));
  out[7] = 5.0;
  ROT_CHECK_EQ_INT(rot_formula_rows(&f, 7, column, out), ROT_OK);
  ROT_CHECK_ULP(out[7], 5.0, 0);
}

static rot_status check(size_t n, const int op[], const int arg[]) {
  const double constant[] = {1.0};
  const rot_formula f = {n, op, arg, 1, constant, 2};
  ROT_CHECK_EQ_INT(rot_formula_rows(&f, 3, column, out), rot_formula_check(&f));
  return rot_formula_check(&f);
}

static void damaged(void) {
  const int none[ROT_FORMULA_DEPTH * 2 + 2] = {0}, one[] = {0, 1};
  int op[ROT_FORMULA_DEPTH * 2 + 2];
  ROT_CHECK_EQ_INT(check(0, none, none), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, none, none), ROT_OK);
  ROT_CHECK_EQ_INT(check(2, none, none), ROT_EVALUE); /* two columns are left */
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_CONSTANT}, (int[]){1}), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_CONSTANT}, (int[]){-1}), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_INPUT}, (int[]){1}), ROT_OK);
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_INPUT}, (int[]){2}), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_INPUT}, (int[]){-2147483647}), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_COUNT}, none), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, (int[]){-1}, none), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(2, (int[]){ROT_OP_INPUT, ROT_OP_ADD}, one), ROT_EVALUE);
  ROT_CHECK_EQ_INT(check(1, (int[]){ROT_OP_SQRT}, none), ROT_EVALUE);
  for (size_t depth = ROT_FORMULA_DEPTH; depth <= ROT_FORMULA_DEPTH + 1; depth++) {
    for (size_t i = 0; i < 2 * depth - 1; i++) op[i] = i < depth ? ROT_OP_CONSTANT : ROT_OP_ADD;
    ROT_CHECK_EQ_INT(check(2 * depth - 1, op, none),
                     depth == ROT_FORMULA_DEPTH ? ROT_OK : ROT_EVALUE);
  }
}

static void names(void) {
  ROT_CHECK(!strcmp(rot_formula_name(ROT_OP_IFELSE), "ifelse"));
  ROT_CHECK_EQ_INT(rot_formula_operands(ROT_OP_IFELSE), 3);
  ROT_CHECK(!rot_formula_name(-1) && !rot_formula_name(ROT_OP_COUNT));
  ROT_CHECK_EQ_INT(rot_formula_operands(ROT_OP_COUNT), 0);
}

int main(void) {
  fill();
  operations();
  powers();
  program();
  damaged();
  names();
  return rot_test_report("formula");
}
