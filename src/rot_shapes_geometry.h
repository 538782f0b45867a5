/* The geometry of a shape from its sizes, per unit mass: second moments about the centre of mass,
 * the centre, volume (area, length), reach, and beta where it rolls.
 *
 *     c_xx = int (x - g_x)^2 dm / m,   I_xx/m = c_yy + c_zz,   I_xy/m = -c_xy
 *
 * All forms are sums of terms of one sign (except a triangle's c_xy and centre), so no sizes
 * cancel: a hollow sphere is (1 + x + .. + x^4)/(1 + x + x^2) with x = r/R, a cap is written in its
 * height h and the rest of the diameter, b = 2 R - h. The sizes must be near 1: callers scale by a
 * power of two.
 *
 * Source: Goldstein, Classical Mechanics, 3rd ed., ch. 5; Beer & Johnston, Vector Mechanics for
 * Engineers, inside cover; the rest by integration of the same kind. */
#ifndef ROT_SHAPES_GEOMETRY_H
#define ROT_SHAPES_GEOMETRY_H

#include "rot_ieee.h"

enum { ROT_SIZES = 4 };

typedef struct rot_geometry {
  double second[4]; /* xx, yy, zz, xy; xz and yz are zero in every shape's own axes */
  double moment;    /* the one in tables: I_zz about the centre, unless the shape says otherwise */
  double centre[3]; /* in the own axes */
  double measure;   /* volume, area or length, by the shape's dimension; NaN if it has none */
  double reach;     /* from the centre of mass to the farthest point */
  double beta;      /* I_zz/(m r^2) on the outer radius; NaN where it does not roll about z */
} rot_geometry;

typedef void rot_geometry_function(const double size[ROT_SIZES], rot_geometry *out);

#endif
