/* Derived inputs: formulas as programs for a stack of columns. A program is data; a damaged one is
 * refused.
 *
 * Results are those of R's vector arithmetic, bit for bit: powers, minima, comparisons with NaN. */
#ifndef ROT_FORMULA_H
#define ROT_FORMULA_H

#include <stddef.h>

#include "ground/ieee.h"
#include "ground/status.h"

/* code, name in a formula, operands taken from the stack */
#define ROT_FORMULA_LIST(X)                                                                        \
  X(ROT_OP_CONSTANT, "constant", 0) /* index of a constant */                                      \
  X(ROT_OP_INPUT, "input", 0)       /* index of an input */                                        \
  X(ROT_OP_ADD, "+", 2)                                                                            \
  X(ROT_OP_SUBTRACT, "-", 2)                                                                       \
  X(ROT_OP_MULTIPLY, "*", 2)                                                                       \
  X(ROT_OP_DIVIDE, "/", 2)                                                                         \
  X(ROT_OP_POWER, "^", 2)                                                                          \
  X(ROT_OP_NEGATE, "negate", 1)                                                                    \
  X(ROT_OP_SQRT, "sqrt", 1)                                                                        \
  X(ROT_OP_EXP, "exp", 1)                                                                          \
  X(ROT_OP_LOG, "log", 1)                                                                          \
  X(ROT_OP_SIN, "sin", 1)                                                                          \
  X(ROT_OP_COS, "cos", 1)                                                                          \
  X(ROT_OP_TAN, "tan", 1)                                                                          \
  X(ROT_OP_ABS, "abs", 1)                                                                          \
  X(ROT_OP_PMIN, "pmin", 2)                                                                        \
  X(ROT_OP_PMAX, "pmax", 2)                                                                        \
  X(ROT_OP_LESS, "<", 2)                                                                           \
  X(ROT_OP_LESS_EQUAL, "<=", 2)                                                                    \
  X(ROT_OP_GREATER, ">", 2)                                                                        \
  X(ROT_OP_GREATER_EQUAL, ">=", 2)                                                                 \
  X(ROT_OP_EQUAL, "==", 2)                                                                         \
  X(ROT_OP_NOT_EQUAL, "!=", 2)                                                                     \
  X(ROT_OP_IFELSE, "ifelse", 3)

typedef enum rot_op {
#define X(code, name, operands) code,
  ROT_FORMULA_LIST(X)
#undef X
      ROT_OP_COUNT
} rot_op;

enum { ROT_FORMULA_DEPTH = 32 }; /* of the stack */

/* code => name of the list, NULL if there is none */
const char *rot_formula_name(int op);
/* code => number of operands */
int rot_formula_operands(int op);

typedef struct rot_formula {
  size_t n_ops;
  const int *op;  /* rot_op */
  const int *arg; /* index of the constant or input, else unused */
  size_t n_constants;
  const double *constant;
  size_t n_inputs; /* columns that the program may read */
} rot_formula;

/* ROT_EVALUE: an unknown code, an index out of range, a stack that runs empty, exceeds
 * ROT_FORMULA_DEPTH or does not end with one column. */
rot_status rot_formula_check(const rot_formula *f);

/* n rows of the inputs => results; checks the program first. `out` may be one of the columns.
 * Comparisons are 1, 0 or, of a NaN, NaN. */
rot_status rot_formula_rows(const rot_formula *f, size_t n, const double *const column[],
                            double out[]);

#endif
