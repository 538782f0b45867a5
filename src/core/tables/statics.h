/* Forces on a rigid body at rest: sums about a point, and the reactions of its supports.
 *
 * Unknown reactions x and loads b: A x + b = 0. Forces are in units of the largest load and lengths
 * in units of the structure's extent (powers of two), so that N and N m have similar sizes.
 * Singular values of A below rank_tolerance times the largest count as 0. Residuals are computed in
 * double-double and refined.
 *
 * Unilateral reactions are those of min norm in their cones (maths/cone.h), for any redundancy. The
 * body is in equilibrium if such reactions exist.
 *
 * Reference: Golub & Van Loan, Matrix Computations (2013), 5.5. */
#ifndef ROT_STATICS_H
#define ROT_STATICS_H

#include <stddef.h>

#include "ground/status.h"

typedef struct rot_sums {
  double force[3], torque[3];
  double force_terms, torque_terms; /* sums of absolute terms, for rounding errors */
} rot_sums;

/* (n points, forces, couples of 3 numbers each; point `about`) => sums about the point */
rot_sums rot_statics_sums(size_t n, const double at[], const double force[], const double couple[],
                          const double about[3]);

/* The central axis, about whose points force and torque are parallel. */
typedef struct rot_axis {
  int kind;        /* 0: no force and no couple, 1: a force, 2: a couple, 3: both */
  double point[3]; /* of the axis, nearest to `about` */
  double couple;   /* along the force, signed */
  double pitch_m;  /* couple/force */
} rot_axis;

/* sums => central axis; sums below 4 roundings of their terms count as 0 */
rot_axis rot_statics_axis(const rot_sums *sums, const double about[3]);

/* A reaction along to - from, through `at`. */
typedef struct rot_reaction {
  double at[3], from[3], to[3];
  int is_couple; /* 1: a couple, else a force */
  int one_sided; /* 1: >= 0 */
} rot_reaction;

/* A unilateral contact with friction. */
typedef struct rot_contact {
  size_t first;     /* first of its reactions, forces along the axes: 3, or 2 in a plane */
  double normal[3]; /* unit vector */
  double friction;  /* 0 to Inf */
} rot_contact;

typedef struct rot_structure {
  int plane; /* 1: forces along z and torques about x and y are ignored */
  size_t reactions, contacts, loads;
  const rot_reaction *reaction;
  const rot_contact *contact;
  const double *load_at, *load_force, *load_couple; /* 3 numbers per load: m, N, N m */
  double rank_tolerance;                            /* relative, of singular values */
} rot_structure;

typedef struct rot_rest {
  size_t equations, rank;
  double sigma[6]; /* singular values, ascending */
  double about[3]; /* reference point of motions and residuals */
  int driven;      /* 1: the loads drive a motion that even bilateral supports do not prevent */
  int rests;       /* 1: equilibrium with unilateral supports and friction */
  int sticks;      /* the same with unlimited friction */
  int projected;   /* 1: the reactions are of min norm within their cones */
  double velocity[3], omega[3];           /* initial motion or, in equilibrium, a free motion */
  double residual_force, residual_torque; /* N, N m */
} rot_rest;

/* structure => for each reaction: value (of min norm if undetermined), error, determined or not,
 * min and max possible value; equilibrium in `rest`. Errors are for an error of half an ulp in each
 * number given. */
rot_status rot_statics_solve(const rot_structure *structure, double x[], double error[],
                             int determined[], double lowest[], double highest[], rot_rest *rest);

/* (structure, chosen loads) => min and max factor on these loads for equilibrium; NaN if there is
 * none */
rot_status rot_statics_factors(const rot_structure *structure, const int chosen[],
                               double limits[2]);

#endif
