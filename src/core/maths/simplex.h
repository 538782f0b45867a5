/* Linear programs with few equations: minimize sum cost_j x_j with sum x_j column_j = rhs and
 * x >= 0, by the revised simplex method, with columns that are generated on demand (the limits of
 * circular cones). The basis is inverted anew in each step, so that no rounding accumulates.
 *
 * Reference: Dantzig, Linear Programming and Extensions (1963); Bland, Math. Oper.
 * Res. 2 (1977). */
#ifndef ROT_SIMPLEX_H
#define ROT_SIMPLEX_H

#include <stddef.h>

#include "ground/ieee.h"

enum { ROT_SIMPLEX_ROWS = 6 };

typedef enum rot_simplex_result {
  ROT_SIMPLEX_OPTIMAL,
  ROT_SIMPLEX_INFEASIBLE,
  ROT_SIMPLEX_UNBOUNDED,
  ROT_SIMPLEX_STOPPED /* 5000 steps */
} rot_simplex_result;

/* Writes the column whose cost - dual . column is least, and its cost; returns 0 where none can be
 * below 0. In phase 1 costs count as 0. */
typedef int rot_simplex_price(void *ctx, const double dual[], int phase, double column[],
                              double *cost);

typedef struct rot_simplex {
  size_t m;           /* equations, at most ROT_SIMPLEX_ROWS */
  size_t n, capacity; /* columns now, and room for them */
  double *column;     /* capacity x m, by columns */
  double *cost;
  double rhs[ROT_SIMPLEX_ROWS]; /* well scaled: the tolerances are absolute */
  double tolerance;             /* of the equations, relative to the largest of rhs */
  rot_simplex_price *price;     /* or NULL */
  void *ctx;
  /* results */
  double value;                  /* of the cost; of phase 1 where infeasible */
  double dual[ROT_SIMPLEX_ROWS]; /* where infeasible: dual . column <= 0 < dual . rhs */
} rot_simplex;

rot_simplex_result rot_simplex_solve(rot_simplex *lp);

#endif
