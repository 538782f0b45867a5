/* Mass, centre of mass and second moment of point masses:
 *
 *   M = sum m,   g = sum m x / M,   C = sum m (x - g)(x - g)'
 *
 * The sums are compensated and taken about a double next to the centre (x minus that double is
 * rounded once); the remaining offset of the centre is subtracted at the end. The error does not
 * depend on the place of the points: 1e-16 at every offset, where sums about the origin lose all
 * digits at an offset of 1e8 sizes.
 *
 * Reference: Chan, Golub & LeVeque, The American Statistician 37 (1983) 242. */
#ifndef ROT_POINTS_H
#define ROT_POINTS_H

#include <stddef.h>

#include "ground/column.h"
#include "ground/status.h"

typedef struct rot_points {
  size_t n;
  rot_column mass, x[3];
  int mass_exponent; /* masses are those of the column times 2^mass_exponent */
} rot_points;

typedef struct rot_moments {
  double mass;
  double centre[3];    /* the unweighted mean if there is no mass */
  double centre_lo[3]; /* low part of the centre */
  double c[6];         /* about the centre: xx, yy, zz, xy, xz, yz */
  double mass_error;   /* bound, relative */
  double centre_error; /* bound of each coordinate of centre + centre_lo, in m */
  double error;        /* bound of each element of c, relative to the trace */
  int vanished;        /* a mass or moment underflowed */
} rot_moments;

/* The first row with a value that is not finite, or a mass below 0; n if none. *column: 0 mass,
 * 1 to 3 x, y, z. */
size_t rot_points_bad(const rot_points *points, int *column);

/* Masses are finite and at least 0, coordinates finite. ROT_ERANGE where the points are farther
 * apart than the largest double. Masses and moments may overflow or underflow:
 * rot_moments_check(). */
rot_status rot_points_moments(const rot_points *points, const rot_hooks *hooks, rot_moments *out);

/* The moments of two bodies together, about their common centre. */
void rot_moments_join(const rot_moments *a, const rot_moments *b, rot_moments *out);

/* ROT_ERANGE where the mass or a moment overflowed or underflowed. */
rot_status rot_moments_check(const rot_moments *moments);

/* Distance from the centre to the farthest point, rounded up. */
double rot_points_reach(const rot_points *points, const rot_moments *moments);

#endif
