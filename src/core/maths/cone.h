/* Reactions of least norm that only push: minimize |x|^2/2 with B x = c and x in K, for a few
 * equations and a product K of half-lines, half-spaces and circular cones.
 *
 * With the projection P on K, x = P(B'y), where y minimizes the convex |P(B'y)|^2/2 - c.y: a
 * problem of as many unknowns as there are equations. Newton's method on its gradient
 * B P(B'y) - c, with a generalized Jacobian and a regularization; x is always in K, the equations
 * hold at the end.
 *
 * x.B'y <= x.P(B'y) gives |x| >= c.y/|P(B'y)| for each x that is allowed, and each y: where that
 * exceeds all measure, there is none.
 *
 * Reference: Qi & Sun, Mathematical Programming 58 (1993) 353; Faraut & Koranyi, Analysis on
 * Symmetric Cones (1994), for the projection. */
#ifndef ROT_CONE_H
#define ROT_CONE_H

#include <stddef.h>

#include "ground/dd.h"
#include "ground/status.h"

enum { ROT_CONE_ROWS = 7 };

/* Elements `first` and the next of x. Size 1: x >= 0. Size 2 or 3: a force with a push n >= 0 along
 * the normal and at most friction n across it. What is in no part is free. */
typedef struct rot_cone_part {
  size_t first, size;
  double normal[3], friction; /* unit normal; above 0, Inf: a half-space */
} rot_cone_part;

typedef struct rot_cone {
  size_t m, k, parts; /* equations, at most ROT_CONE_ROWS; unknowns */
  const rot_cone_part *part;
  const rot_dd *b; /* m x k, by columns; well scaled: rows of some length near 1 */
  const rot_dd *c;
  /* The equations hold where each residual is at most slack + sum blur |x|; of the sum 1e-9 |c|
   * counts at most: the rounding of x of 1e10 |c| would balance what no x of the cone balances. */
  const double *slack, *blur;
} rot_cone;

typedef enum rot_cone_result {
  ROT_CONE_FOUND,
  ROT_CONE_NONE,   /* each x is larger than 1e13 |c|, or 1e8 |c| after 100 steps */
  ROT_CONE_STOPPED /* 400 steps */
} rot_cone_result;

/* Steps from y, 0 for a start; y and x (k numbers) are the result where one is found.
 * `gap`: |B x - c| at the end. */
rot_status rot_cone_solve(const rot_cone *cone, rot_dd y[], rot_dd x[], rot_cone_result *result,
                          double *gap);

/* The nearest point of K. */
void rot_cone_project(const rot_cone *cone, rot_dd x[]);

/* The derivative of the projection at z: V d, k numbers each. Where it jumps, the larger one. */
void rot_cone_derivative(const rot_cone *cone, const rot_dd z[], const double d[], double to[]);

#endif
