/* Forces on a rigid body at rest: sums about a point, and the reactions of its supports.
 *
 * Unknown reactions x and loads b: A x + b = 0, with forces in units of the largest load and
 * lengths in units of the structure's extent (powers of two), so that N and N m mix well. A is
 * decomposed into singular values; those below rank_tolerance times the largest count as 0.
 * Residuals are taken in double-double and refined.
 *
 * Reactions that only push are the least norm in their cones (maths/cone.h), whatever the
 * redundancy: a body rests where there are some.
 *
 * Reference: Golub & Van Loan, Matrix Computations (2013), 5.5. */
#ifndef ROT_STATICS_H
#define ROT_STATICS_H

#include <stddef.h>

#include "ground/status.h"

/* Sums of n forces (3 n numbers each: points, forces, couples) about a point. The sums of absolute
 * terms measure their rounding. */
typedef struct rot_sums {
  double force[3], torque[3];
  double force_terms, torque_terms;
} rot_sums;

rot_sums rot_statics_sums(size_t n, const double at[], const double force[], const double couple[],
                          const double about[3]);

/* The central axis: where force and torque about the point are parallel. The point of the axis that
 * is nearest to `about`; the couple along the force, with its sign; couple/force. `kind` 0: no
 * force and no couple, 1: a force, 2: a couple, 3: both. Sums below 4 roundings of their terms
 * count as 0. */
typedef struct rot_axis {
  int kind;
  double point[3], couple, pitch_m;
} rot_axis;

rot_axis rot_statics_axis(const rot_sums *sums, const double about[3]);

/* A reaction along to - from, through `at`. */
typedef struct rot_reaction {
  double at[3], from[3], to[3];
  int is_couple, one_sided; /* at least 0 */
} rot_reaction;

/* A contact that pushes along `normal` and has friction: `first` and the next reactions are
 * its forces along the axes, 3 of them, 2 in a plane. */
typedef struct rot_contact {
  size_t first;
  double normal[3], friction; /* unit normal; 0 to Inf */
} rot_contact;

typedef struct rot_structure {
  int plane; /* z and what turns out of the plane are left out */
  size_t reactions, contacts, loads;
  const rot_reaction *reaction;
  const rot_contact *contact;
  const double *load_at, *load_force, *load_couple;
  double rank_tolerance;
} rot_structure;

typedef struct rot_rest {
  size_t equations, rank;
  double sigma[6]; /* ascending */
  double about[3]; /* the point that motions and residuals refer to */
  int driven;      /* the loads drive a motion that no support prevents, even if it pulled */
  int rests;       /* with supports that only push, and friction */
  int sticks;      /* the same with unlimited friction */
  int projected;   /* the reactions are of minimum norm among those that only push */
  double velocity[3], omega[3]; /* of the motion that begins or, at rest, is free */
  double residual_force, residual_torque;
} rot_rest;

/* Arrays of `reactions` numbers: the reactions (of minimum norm where they are not determined),
 * their errors, whether they are determined, the least and the largest that are possible.
 * Errors are for an error of half an ulp in each number given. */
rot_status rot_statics_solve(const rot_structure *structure, double x[], double error[],
                             int determined[], double lowest[], double highest[], rot_rest *rest);

/* The least and the largest factor on the chosen loads for which the body can be at rest;
 * NaN where there is none. */
rot_status rot_statics_factors(const rot_structure *structure, const int chosen[],
                               double limits[2]);

#endif
