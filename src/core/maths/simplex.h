/* Linear programs with few equations: minimize sum cost_j x_j with sum x_j column_j = rhs and
 * x >= 0, by the revised simplex method with column generation (tangents of circular cones). Each
 * step inverts the basis from its columns, so that rounding does not accumulate.
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

/* (dual, phase) => column that minimizes cost - dual . column, its cost; returns 0 if no column is
 * below 0. Costs are 0 in phase 1. */
typedef int rot_simplex_price(void *ctx, const double dual[], int phase, double column[],
                              double *cost);

typedef struct rot_simplex {
  size_t m;                     /* equations, at most ROT_SIMPLEX_ROWS */
  size_t n, capacity;           /* columns used, columns allocated */
  double *column;               /* capacity x m, by columns */
  double *cost;                 /* capacity */
  double rhs[ROT_SIMPLEX_ROWS]; /* well scaled: the tolerances are absolute */
  double tolerance;             /* of the equations, relative to the largest of rhs */
  rot_simplex_price *price;     /* or NULL */
  void *ctx;
  /* results */
  double value;                  /* cost; of phase 1 if infeasible */
  double dual[ROT_SIMPLEX_ROWS]; /* if infeasible: dual . column <= 0 < dual . rhs */
} rot_simplex;

/* lp => value and dual in lp */
rot_simplex_result rot_simplex_solve(rot_simplex *lp);

#endif
