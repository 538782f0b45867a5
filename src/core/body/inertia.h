/* Inertia from second moments. The tensor stored is
 *
 *     C = int (x - g)(x - g)' dm   about the centre of mass g,    I = tr(C) 1 - C.
 *
 * Its eigenvalues are not negative, and a principal moment is the sum of two of them: the zero of a
 * rod stays zero, I1 + I2 = I3 holds exactly for a plate, and I1 + I2 >= I3 becomes C >= 0.
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
  double mass_kg;
  double centre_m[3];
  double second_kg_m2[ROT_TENSOR]; /* about the centre */
} rot_inertial;

void rot_inertia_of_second(const double c[], double inertia[]);
/* One rounding each: C = (tr I)/2 1 - I. */
void rot_inertia_to_second(const double inertia[], double c[]);

/* out = t + sign m d d': a second moment moved by d, away from the centre (+1) or to it (-1). */
void rot_inertia_shift_second(double mass, const double d[3], double sign, const double c[],
                              double out[]);
/* The same of an inertia tensor: t + sign m (d'd 1 - d d'). */
void rot_inertia_shift(double mass, const double d[3], double sign, const double inertia[],
                       double out[]);
/* R C R', R by rows. */
void rot_inertia_rotate(const double r[9], const double c[], double out[]);

/* Moment about the axis along n (of any length but 0) through `point`; at least 0 if the mass
 * is. */
double rot_inertia_axis(const rot_inertial *body, const double n[3], const double point[3]);

/* Second moments along the principal axes, descending, so that the moments
 * I1 = c2 + c3 <= I2 = c1 + c3 <= I3 = c1 + c2 ascend. Column k of `axes` (by rows) is axis k:
 * right-handed, the largest component of the first two positive. Where two second moments differ by
 * no more than 1e-14 of the largest, the axes nearest to the coordinate axes are taken.
 * equal12 and equal23: |c1 - c2| (|c2 - c3|) <= tolerance c1. */
typedef struct rot_principal {
  double second[3], moment[3], axes[9];
  int equal12, equal23;
} rot_principal;

rot_status rot_inertia_principal(const double c[], double tolerance, rot_principal *out);

/* Whether a body has this second moment: along no axis is it below 0, but for rounding. */
int rot_inertia_possible(const double c[]);

/* n bodies as one; a hole has negative mass and second moment. First the common centre, relative to
 * the heaviest part, then the sum about it. *error bounds the rounding error of the second moment,
 * relative to its trace; infinite where holes leave no trace. */
rot_status rot_inertia_join(size_t n, const rot_inertial part[], rot_inertial *whole,
                            double *error);

/* Bound of the error, relative to the trace, of a second moment whose entries carry `roundings`:
 * plus the underflow of a mass from a density, and of moments near the smallest double. Infinite
 * where the trace underflowed (`has_moment`: it is not 0). */
double rot_inertia_error(const double second[ROT_TENSOR], double mass, int is_density,
                         double roundings, int has_moment);

#endif
