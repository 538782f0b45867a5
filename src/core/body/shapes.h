/* Bodies of a standard shape: one, or a table with a shape in each row. */
#ifndef ROT_SHAPES_H
#define ROT_SHAPES_H

#include <stddef.h>

#include "ground/column.h"
#include "body/shapes_geometry.h"

/* Errors in a row; NaN is none, it passes to the results. */
typedef enum rot_shape_fault {
  ROT_SHAPE_FITS,
  ROT_SHAPE_NEGATIVE, /* a length below 0 */
  ROT_SHAPE_SIDES,    /* not a whole number of at least 3 */
  ROT_SHAPE_OUTSIDE,  /* an inner size above the outer one */
  ROT_SHAPE_TOO_HIGH, /* a cap higher than its sphere */
  ROT_SHAPE_MASS,     /* a mass below 0 */
  ROT_SHAPE_BETA      /* a beta below 0 */
} rot_shape_fault;

/* *slot: index of the wrong size. */
rot_shape_fault rot_shape_check(const rot_shape *shape, const double size[], int *slot);

typedef struct rot_shape_body {
  double mass_kg;
  double second_kg_m2[6]; /* about the centre of mass: xx, yy, zz, xy, xz, yz */
  double centre_m[3], reach_m, beta;
  double moment_kg_m2; /* the one that the table reports */
  double gyration_m;   /* of it: sqrt(I/m), also where m is 0 */
  double error;        /* bound of the second moment's, relative to its trace */
} rot_shape_body;

/* `amount` is the mass, or the density (of volume, area or length, by the shape's dimension). Sizes
 * have passed rot_shape_check(); they may be of any scale, in ratios of up to 1e300 (1e150 with a
 * density). Results that overflow or underflow are Inf or 0. */
void rot_shape_make(const rot_shape *shape, double amount, int is_density, const double size[],
                    rot_shape_body *out);

/* Row i has shape `shape[i]` of the list, or none (-1): then its moment is beta m r^2. Columns of
 * sizes are in the order of ROT_SIZE_LIST; those that no row needs are not read. */
typedef struct rot_shape_rows {
  const int *shape;
  size_t shape_step; /* 1, or 0: one shape for all */
  rot_column mass_kg, beta, size[ROT_SIZE_COUNT];
} rot_shape_rows;

enum {
  ROT_SHAPE_MOMENT,
  ROT_SHAPE_IXX,
  ROT_SHAPE_IYY,
  ROT_SHAPE_IZZ,
  ROT_SHAPE_ROLLS,
  ROT_SHAPE_GYRATION,
  ROT_SHAPE_COLUMNS
};

/* Stops at the first wrong row, *row, and its size *slot. A NaN in a row fills its results. */
rot_shape_fault rot_shapes_table(size_t n, const rot_shape_rows *rows,
                                 double *out[ROT_SHAPE_COLUMNS], size_t *row, int *slot);

#endif
