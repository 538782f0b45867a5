/* Bodies of standard shapes: one body, or a table with a shape in each row. */
#ifndef ROT_SHAPES_H
#define ROT_SHAPES_H

#include <stddef.h>

#include "ground/column.h"
#include "body/shapes_geometry.h"

/* Errors in a row. NaN is not an error: the results are NaN. */
typedef enum rot_shape_fault {
  ROT_SHAPE_FITS,
  ROT_SHAPE_NEGATIVE, /* a length below 0 */
  ROT_SHAPE_SIDES,    /* not a whole number of at least 3 */
  ROT_SHAPE_OUTSIDE,  /* an inner size above the outer one */
  ROT_SHAPE_TOO_HIGH, /* a cap higher than its sphere */
  ROT_SHAPE_MASS,     /* a mass below 0 */
  ROT_SHAPE_BETA      /* a beta below 0 */
} rot_shape_fault;

/* (shape, size) => fault, *slot: index of the invalid size */
rot_shape_fault rot_shape_check(const rot_shape *shape, const double size[], int *slot);

typedef struct rot_shape_body {
  double mass_kg;
  double second_kg_m2[6]; /* about the centre of mass: xx, yy, zz, xy, xz, yz */
  double centre_m[3];
  double reach_m;      /* from the centre of mass to the farthest point */
  double beta;         /* I/(m r^2) of a shape that rolls about z, else NaN */
  double moment_kg_m2; /* I in tables */
  double gyration_m;   /* sqrt(I/m), also for m = 0 */
  double error;        /* bound of the second moment's error, relative to its trace */
} rot_shape_body;

/* (shape, amount, size) => body. `amount`: mass, or density of volume, area or length by the
 * shape's dimension. Sizes have passed rot_shape_check(); they may have any scale, and ratios up to
 * 1e300 (1e150 with a density). Results that over- or underflow are Inf or 0. */
void rot_shape_make(const rot_shape *shape, double amount, int is_density, const double size[],
                    rot_shape_body *out);

typedef struct rot_shape_rows {
  const int *shape;  /* index in the list; -1: none, the moment is beta m r^2 */
  size_t shape_step; /* 1, or 0: one shape for all rows */
  rot_column mass_kg;
  rot_column beta;
  rot_column size[ROT_SIZE_COUNT]; /* by rot_size_id; read only if a row needs it */
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

/* n rows => columns, fault of the first invalid row *row with size *slot; a NaN in a row makes its
 * results NaN */
rot_shape_fault rot_shapes_table(size_t n, const rot_shape_rows *rows,
                                 double *out[ROT_SHAPE_COLUMNS], size_t *row, int *slot);

#endif
