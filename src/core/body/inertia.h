/* Inertia from second moments. The tensor stored is
 *
 *     C = int (x - g)(x - g)' dm   about the centre of mass g,    I = tr(C) 1 - C.
 *
 * Its eigenvalues are >= 0 and a principal moment is the sum of two of them. So the zero moment of
 * a rod is exactly 0, I1 + I2 = I3 is exact for a plate, and I1 + I2 >= I3 is equivalent to C >= 0.
 * A tensor is six numbers: xx, yy, zz, xy, xz, yz.
 *
 * Source: Goldstein, Classical Mechanics, 3rd ed., 5.3-5.4; Featherstone, Rigid Body Dynamics
 * Algorithms, 2.8; Wensing, Kim & Slotine, IEEE RA-L 3 (2018) 60, for C and its conditions. */
#ifndef ROT_INERTIA_H
#define ROT_INERTIA_H

#include <stddef.h>

#include "ground/status.h"

enum { ROT_XX, ROT_YY, ROT_ZZ, ROT_XY, ROT_XZ, ROT_YZ, ROT_TENSOR };
static const int rot_tensor_row[ROT_TENSOR] = {0, 1, 2, 0, 0, 1},
                 rot_tensor_column[ROT_TENSOR] = {0, 1, 2, 1, 2, 2};

typedef struct rot_inertial {
  double mass_kg; /* < 0 for a hole */
  double centre_m[3];
  double second_kg_m2[ROT_TENSOR]; /* about the centre */
} rot_inertial;

/* C => I = tr(C) 1 - C */
void rot_inertia_of_second(const double c[], double inertia[]);
/* I => C = (tr I)/2 1 - I, one rounding per element */
void rot_inertia_to_second(const double inertia[], double c[]);

/* C => C + sign m d d': parallel axes at distance d, away from the centre (+1) or to it (-1) */
void rot_inertia_shift_second(double mass, const double d[3], double sign, const double c[],
                              double out[]);
/* I => I + sign m (d'd 1 - d d') */
void rot_inertia_shift(double mass, const double d[3], double sign, const double inertia[],
                       double out[]);
/* (R by rows, C) => R C R' */
void rot_inertia_rotate(const double r[9], const double c[], double out[]);

/* (body, n of any length > 0, point) => moment about the axis along n through the point; >= 0 if
 * the mass is */
double rot_inertia_axis(const rot_inertial *body, const double n[3], const double point[3]);

/* Principal axes. The axes are right-handed, with the largest component of the first two positive.
 * If two second moments differ by at most 1e-14 of the largest, their axes are those nearest to the
 * coordinate axes. */
typedef struct rot_principal {
  double second[3]; /* c1 >= c2 >= c3, along the axes */
  double moment[3]; /* I1 = c2 + c3 <= I2 = c1 + c3 <= I3 = c1 + c2 */
  double axes[9];   /* by rows; column k is axis k */
  int equal12;      /* c1 - c2 <= tolerance c1 */
  int equal23;      /* c2 - c3 <= tolerance c1 */
} rot_principal;

/* C => principal moments and axes */
rot_status rot_inertia_principal(const double c[], double tolerance, rot_principal *out);

/* 1 if C is the second moment of a body: >= 0 along each axis, within rounding. */
int rot_inertia_possible(const double c[]);

/* n parts => one body; a hole has negative mass and second moment. The common centre is computed
 * relative to the heaviest part, then the sum about it. *error: bound of the rounding error of the
 * second moment, relative to its trace; Inf where holes leave no trace. */
rot_status rot_inertia_join(size_t n, const rot_inertial part[], rot_inertial *whole,
                            double *error);

/* => bound of the error of a second moment, relative to its trace: `roundings` of each element,
 * underflow of a mass from a density, underflow of small moments. Inf where the trace underflowed
 * (`has_moment`: the exact trace is not 0). */
double rot_inertia_error(const double second[ROT_TENSOR], double mass, int is_density,
                         double roundings, int has_moment);

#endif
