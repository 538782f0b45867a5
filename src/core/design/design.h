/* Designs: a rule from the number of a row to the inputs of a scene. A row is a pure function of
 * (design, number); nothing is drawn in order, nothing but the rule is stored.
 *
 * References: A. B. Owen, Monte Carlo theory, methods and examples (2013), chapters 10, 15 and 17;
 * A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259 (the rows of a Saltelli design). */
#ifndef ROT_DESIGN_H
#define ROT_DESIGN_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"
#include "ground/status.h"
#include "ground/store.h"
#include "design/latin.h"
#include "design/laws.h"
#include "design/sobol.h"

#define ROT_DESIGN_LIST(X)                                                                         \
  X(ROT_DESIGN_GRID, "grid")     /* all combinations of values, the first input changes fastest */ \
  X(ROT_DESIGN_ROWS, "list")     /* rows given as columns */                                       \
  X(ROT_DESIGN_RANDOM, "random") /* independent rows */                                            \
  X(ROT_DESIGN_LATIN, "latin")   /* one row in each of n strata of each input */                   \
  X(ROT_DESIGN_SOBOL, "sobol")                                                                     \
  X(ROT_DESIGN_SALTELLI, "saltelli") /* pairs of Sobol points A, B and their mixtures */

typedef enum rot_design_kind {
#define X(code, name) code,
  ROT_DESIGN_LIST(X)
#undef X
      ROT_DESIGN_COUNT
} rot_design_kind;

/* kind => name; NULL if there is no such kind */
const char *rot_design_name(int kind);

#define ROT_DESIGN_MAX_ROWS ((uint64_t)1 << 52)

typedef struct rot_design {
  rot_design_kind kind;
  uint64_t points; /* rows, of a Saltelli design base points; not of grids and lists */
  size_t n_inputs;
  rot_vary *input; /* n_inputs laws */
  int seeded;      /* 0: not scrambled, for Sobol designs alone */
  uint64_t seed;
  size_t n_correlated;       /* inputs with correlated normal scores, 0 or at least 2 */
  const size_t *correlated;  /* which, increasing */
  const double *correlation; /* of the scores, n_correlated^2 numbers */
  /* Set by rot_design_begin(). */
  uint64_t n;                   /* rows */
  size_t n_varied;              /* inputs that take a coordinate */
  size_t *varied;               /* which, increasing */
  uint64_t *stride;             /* of a grid: rows before the value of an input changes */
  rot_permutation *permutation; /* of each input that takes a coordinate */
  rot_sobol *sobol;             /* of each of them, behind these for B of a Saltelli design */
  double *factor;               /* Cholesky factor of the correlation, by rows */
} rot_design;

/* Checks the laws and prepares the design; memory from the store. ROT_EVALUE: a design that is not
 * sound: no or too many rows, inputs or dimensions, a law that does not fit the kind, a matrix that
 * is not positive definite. */
rot_status rot_design_begin(rot_design *d, rot_store *store);

/* Rows first .. first + n - 1 => columns of all inputs. ROT_EVALUE beyond the last row. Any number
 * of threads may call it; nothing is allocated. */
rot_status rot_design_rows(const rot_design *d, uint64_t first, size_t n, double *const column[]);

#endif
