#include "design/formula.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 128 }; /* rows at a time */

static const struct {
  const char *name;
  int operands;
} ops[ROT_OP_COUNT] = {
#define X(code, name, operands) {name, operands},
    ROT_FORMULA_LIST(X)
#undef X
};

static int is_op(int op) { return op >= 0 && op < ROT_OP_COUNT; }

const char *rot_formula_name(int op) { return is_op(op) ? ops[op].name : NULL; }

int rot_formula_operands(int op) { return is_op(op) ? ops[op].operands : 0; }

rot_status rot_formula_check(const rot_formula *f) {
  int depth = 0;
  for (size_t i = 0; i < f->n_ops; i++) {
    const int op = f->op[i], arg = f->arg[i];
    if (!is_op(op)) return ROT_EVALUE;
    if (op == ROT_OP_CONSTANT && (arg < 0 || (size_t)arg >= f->n_constants)) return ROT_EVALUE;
    if (op == ROT_OP_INPUT && (arg < 0 || (size_t)arg >= f->n_inputs)) return ROT_EVALUE;
    if (depth < ops[op].operands) return ROT_EVALUE;
    depth += 1 - ops[op].operands;
    if (depth > ROT_FORMULA_DEPTH) return ROT_EVALUE;
  }
  return depth == 1 ? ROT_OK : ROT_EVALUE;
}

/* x^y by the rules of R: 1^NaN and NaN^0 are 1, (-0)^y has no sign, a square is a product. */
static double power(double x, double y) {
  if (y == 2.0) return x * x;
  if (x == 1.0 || y == 0.0) return 1.0;
  if (x == 0.0) return y > 0.0 ? 0.0 : y < 0.0 ? HUGE_VAL : y;
  if (isfinite(x) && isfinite(y)) return pow(x, y);
  if (isnan(x) || isnan(y)) return x + y;
  if (isinf(x)) {
    if (x > 0.0) return y < 0.0 ? 0.0 : HUGE_VAL;
    if (isfinite(y) && y == floor(y)) return y < 0.0 ? 0.0 : fabs(fmod(y, 2.0)) > 0.0 ? x : -x;
  }
  if (isinf(y) && x >= 0.0) return (y > 0.0) == (x >= 1.0) ? HUGE_VAL : 0.0;
  return (double)NAN;
}

/* Comparison as a number: NaN where one of the numbers is. */
static inline double truth(int is, double a, double b) {
  return isnan(a) || isnan(b) ? (double)NAN : is ? 1.0 : 0.0;
}

/* One operation on m rows; the result replaces the first operand a. */
#define EACH(expression)                                                                           \
  do {                                                                                             \
    for (size_t i = 0; i < m; i++) a[i] = (expression);                                            \
  } while (0)

static void apply(int op, size_t m, double a[], const double b[], const double c[]) {
  switch (op) {
  case ROT_OP_ADD: EACH(a[i] + b[i]); return;
  case ROT_OP_SUBTRACT: EACH(a[i] - b[i]); return;
  case ROT_OP_MULTIPLY: EACH(a[i] * b[i]); return;
  case ROT_OP_DIVIDE: EACH(a[i] / b[i]); return;
  case ROT_OP_POWER: EACH(power(a[i], b[i])); return;
  case ROT_OP_NEGATE: EACH(-a[i]); return;
  case ROT_OP_SQRT: EACH(sqrt(a[i])); return;
  case ROT_OP_EXP: EACH(exp(a[i])); return;
  case ROT_OP_LOG: EACH(log(a[i])); return;
  case ROT_OP_SIN: EACH(sin(a[i])); return;
  case ROT_OP_COS: EACH(cos(a[i])); return;
  case ROT_OP_TAN: EACH(tan(a[i])); return;
  case ROT_OP_ABS: EACH(fabs(a[i])); return;
  case ROT_OP_PMIN:
    EACH(isnan(a[i]) || isnan(b[i]) ? a[i] + b[i] : b[i] < a[i] ? b[i] : a[i]);
    return;
  case ROT_OP_PMAX:
    EACH(isnan(a[i]) || isnan(b[i]) ? a[i] + b[i] : b[i] > a[i] ? b[i] : a[i]);
    return;
  case ROT_OP_LESS: EACH(truth(a[i] < b[i], a[i], b[i])); return;
  case ROT_OP_LESS_EQUAL: EACH(truth(a[i] <= b[i], a[i], b[i])); return;
  case ROT_OP_GREATER: EACH(truth(a[i] > b[i], a[i], b[i])); return;
  case ROT_OP_GREATER_EQUAL: EACH(truth(a[i] >= b[i], a[i], b[i])); return;
  case ROT_OP_EQUAL: EACH(truth(a[i] == b[i], a[i], b[i])); return;
  case ROT_OP_NOT_EQUAL: EACH(truth(a[i] != b[i], a[i], b[i])); return;
  case ROT_OP_IFELSE: EACH(isnan(a[i]) ? a[i] : a[i] != 0.0 ? b[i] : c[i]); return;
  default: return;
  }
}

rot_status rot_formula_rows(const rot_formula *f, size_t n, const double *const column[],
                            double out[]) {
  double stack[ROT_FORMULA_DEPTH][BLOCK];
  const rot_status status = rot_formula_check(f);
  if (status != ROT_OK) return status;
  for (size_t first = 0; first < n; first += BLOCK) {
    const size_t m = n - first < BLOCK ? n - first : BLOCK;
    size_t top = 0;
    for (size_t k = 0; k < f->n_ops; k++) {
      const int op = f->op[k];
      if (op == ROT_OP_CONSTANT) {
        for (size_t i = 0; i < m; i++) stack[top][i] = f->constant[f->arg[k]];
        top++;
      } else if (op == ROT_OP_INPUT) {
        memcpy(stack[top++], column[f->arg[k]] + first, m * sizeof **stack);
      } else {
        const size_t operands = (size_t)ops[op].operands, at = top - operands;
        apply(op, m, stack[at], stack[operands > 1 ? at + 1 : at],
              stack[operands > 2 ? at + 2 : at]);
        top = at + 1;
      }
    }
    memcpy(out + first, stack[0], m * sizeof *out);
  }
  return ROT_OK;
}
