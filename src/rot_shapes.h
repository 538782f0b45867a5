/* Moments of inertia of the standard shapes: every one is a number times mass times size^2. */
#ifndef ROT_SHAPES_H
#define ROT_SHAPES_H

#include <stddef.h>

#include "rot_column.h"

/* name | I/(m size^2) about the axis named | about the centre: x, y, z | size | axis | formula
 *
 * Axes of the body: z is the axis a body is spun about, a rod lies along x.
 * Source: Goldstein, Classical Mechanics, 3rd ed., ch. 5; Beer & Johnston, inside cover. */
#define ROT_SHAPE_LIST(X)                                                                          \
  X("hoop", 1.0, 0.5, 0.5, 1.0, "radius_m", "symmetry axis", "m r^2")                              \
  X("disk", 0.5, 0.25, 0.25, 0.5, "radius_m", "symmetry axis", "m r^2 / 2")                        \
  X("sphere", 0.4, 0.4, 0.4, 0.4, "radius_m", "any diameter", "2 m r^2 / 5")                       \
  X("spherical_shell", 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, "radius_m", "any diameter",     \
    "2 m r^2 / 3")                                                                                 \
  X("rod", 1.0 / 12.0, 0.0, 1.0 / 12.0, 1.0 / 12.0, "length_m",                                    \
    "perpendicular, through the centre", "m l^2 / 12")                                             \
  X("rod_end", 1.0 / 3.0, 0.0, 1.0 / 12.0, 1.0 / 12.0, "length_m",                                 \
    "perpendicular, through one end", "m l^2 / 3")                                                 \
  X("point", 1.0, 0.0, 0.0, 0.0, "radius_m", "at distance r", "m r^2")                             \
  X("sliding_point", 0.0, 0.0, 0.0, 0.0, "radius_m", "none: it slides", "0")

typedef struct rot_shape {
  const char *name;
  double axis;         /* about the axis named */
  double principal[3]; /* about the centre */
  const char *size, *axis_text, *formula;
} rot_shape;

size_t rot_shape_count(void);
const rot_shape *rot_shape_at(size_t i);

/* I = k m size^2 and the radius of gyration sqrt(k) size, row by row. */
void rot_shapes_table(size_t n, rot_column k, rot_column mass_kg, rot_column size_m,
                       double inertia_kg_m2[], double gyration_m[]);

#endif
