/* Mass, centre of mass and second moment of point masses:
 *
 *   M = sum m,   g = sum m x / M,   C = sum m (x - g)(x - g)'
 *
 * The sums are compensated and taken about a double next to the centre (x minus that double is
 * rounded once); the remaining offset of the centre is subtracted at the end. The error is 1e-16 at
 * any offset from the origin; sums about the origin lose all digits at an offset of 1e8 sizes.
 *
 * Reference: Chan, Golub & LeVeque, The American Statistician 37 (1983) 242. */
#ifndef ROT_POINTS_H
#define ROT_POINTS_H

#include <stddef.h>

#include "ground/column.h"
#include "ground/status.h"

typedef struct rot_points {
  size_t n;
  rot_column mass; /* >= 0, in units of 2^mass_exponent kg */
  rot_column x[3]; /* m */
  int mass_exponent;
} rot_points;

typedef struct rot_moments {
  double mass;         /* kg */
  double centre[3];    /* the unweighted mean if there is no mass */
  double centre_lo[3]; /* low part of the centre */
  double c[6];         /* about the centre: xx, yy, zz, xy, xz, yz */
  double mass_error;   /* bound, relative */
  double centre_error; /* bound of each coordinate of centre + centre_lo, in m */
  double error;        /* bound of each element of c, relative to the trace */
  int vanished;        /* 1: a mass or moment underflowed */
} rot_moments;

/* => first row with a value that is not finite or a mass below 0, n if none; *column: 0 mass,
 * 1 to 3 x, y, z */
size_t rot_points_bad(const rot_points *points, int *column);

/* Points with finite masses >= 0 and finite coordinates => moments. ROT_ERANGE if a distance of
 * points overflows. Masses and moments may over- or underflow: rot_moments_check(). */
rot_status rot_points_moments(const rot_points *points, const rot_hooks *hooks, rot_moments *out);

/* Moments of two bodies => of both together, about their common centre; out may be a or b */
void rot_moments_join(const rot_moments *a, const rot_moments *b, rot_moments *out);

/* ROT_ERANGE if the mass or a moment over- or underflowed. */
rot_status rot_moments_check(const rot_moments *moments);

/* => distance from the centre to the farthest point, rounded up */
double rot_points_reach(const rot_points *points, const rot_moments *moments);

#endif
