/* Unilateral reactions of minimum norm: minimize |x|^2/2 with B x = c and x in K, for a few
 * equations and a product K of half-lines, half-spaces and circular cones.
 *
 * With the projection P on K, x = P(B'y), where y minimizes the convex |P(B'y)|^2/2 - c.y: one
 * unknown per equation. Newton's method on the gradient B P(B'y) - c, with a generalized Jacobian
 * and a regularization; x is always in K, the equations hold at the end.
 *
 * x.B'y <= x.P(B'y) gives |x| >= c.y/|P(B'y)| for each feasible x and each y: if this bound exceeds
 * a limit, no x exists.
 *
 * Reference: Qi & Sun, Mathematical Programming 58 (1993) 353; Faraut & Koranyi, Analysis on
 * Symmetric Cones (1994), for the projection. */
#ifndef ROT_CONE_H
#define ROT_CONE_H

#include <stddef.h>

#include "ground/dd.h"
#include "ground/status.h"

enum { ROT_CONE_ROWS = 7 };

/* A constraint on `size` elements of x. Size 1: x >= 0. Size 2 or 3: a force with component n >= 0
 * along the normal and tangential part of at most friction n. Elements in no part are free. */
typedef struct rot_cone_part {
  size_t first;     /* index of the first element */
  size_t size;      /* 1 to 3 */
  double normal[3]; /* unit normal */
  double friction;  /* coefficient > 0; Inf: a half-space */
} rot_cone_part;

typedef struct rot_cone {
  size_t m;     /* equations, at most ROT_CONE_ROWS */
  size_t k;     /* unknowns */
  size_t parts; /* elements of `part` */
  const rot_cone_part *part;
  const rot_dd *b; /* m x k, by columns; well scaled: lengths of the rows near 1 */
  const rot_dd *c; /* m */
  /* An equation holds if its residual is at most max(slack, 2^-70 |c|) + min(sum blur |x|, 1e-9
   * |c|). Without the last limit the rounding of an x of 1e10 |c| would hide an infeasible
   * equation. */
  const double *slack, *blur;
} rot_cone;

typedef enum rot_cone_result {
  ROT_CONE_FOUND,
  ROT_CONE_NONE,   /* each x is larger than 1e13 |c|, or 1e8 |c| after 100 steps */
  ROT_CONE_STOPPED /* 400 steps */
} rot_cone_result;

/* (cone, initial y, 0 by default) => y, x (k numbers), result, `gap` = |B x - c| */
rot_status rot_cone_solve(const rot_cone *cone, rot_dd y[], rot_dd x[], rot_cone_result *result,
                          double *gap);

/* x => nearest point of K, in place */
void rot_cone_project(const rot_cone *cone, rot_dd x[]);

/* (z, d) => V d with the derivative V of the projection at z, k numbers each; where V jumps, the
 * larger one */
void rot_cone_derivative(const rot_cone *cone, const rot_dd z[], const double d[], double to[]);

#endif
