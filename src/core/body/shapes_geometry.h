/* Geometry of a shape from its sizes, per unit mass: second moments about the centre of mass,
 * centre, volume (area, length), reach, and beta of shapes that roll.
 *
 *     c_xx = int (x - g_x)^2 dm / m,   I_xx/m = c_yy + c_zz,   I_xy/m = -c_xy
 *
 * All forms are sums of terms of one sign (except a triangle's c_xy and centre), so nothing
 * cancels: a hollow sphere is (1 + x + .. + x^4)/(1 + x + x^2) with x = r/R; a cap is expressed by
 * its height h and b = 2 R - h. The sizes must be near 1: callers scale by a power of two.
 *
 * Source: Goldstein, Classical Mechanics, 3rd ed., ch. 5; Beer & Johnston, Vector Mechanics for
 * Engineers, inside cover; the rest by integration of the same kind. */
#ifndef ROT_SHAPES_GEOMETRY_H
#define ROT_SHAPES_GEOMETRY_H

#include <stddef.h>

#include "ground/ieee.h"

enum { ROT_SIZES = 4 };

typedef struct rot_geometry {
  double second[4]; /* xx, yy, zz, xy; xz and yz are zero in the axes of each shape */
  double moment;    /* moment in tables: I_zz about the centre, except point and rod_end */
  double centre[3]; /* in the axes of the shape */
  double measure;   /* volume, area or length, by the shape's dimension; NaN if it has none */
  double reach;     /* from the centre of mass to the farthest point */
  double beta;      /* I_zz/(m r^2) on the outer radius; NaN if it does not roll about z */
} rot_geometry;

/* size => geometry */
typedef void rot_geometry_function(const double size[ROT_SIZES], rot_geometry *out);

typedef enum rot_size_kind {
  ROT_KIND_LENGTH, /* >= 0 */
  ROT_KIND_OFFSET, /* length of either sign */
  ROT_KIND_COUNT   /* integer >= 3 */
} rot_size_kind;

/* Sizes of shapes: id, name of R's argument and column, kind. */
#define ROT_SIZE_LIST(X)                                                                           \
  X(ROT_RADIUS, "radius_m", ROT_KIND_LENGTH)                                                       \
  X(ROT_LENGTH, "length_m", ROT_KIND_LENGTH)                                                       \
  X(ROT_OUTER_RADIUS, "outer_radius_m", ROT_KIND_LENGTH)                                           \
  X(ROT_INNER_RADIUS, "inner_radius_m", ROT_KIND_LENGTH)                                           \
  X(ROT_BASE_RADIUS, "base_radius_m", ROT_KIND_LENGTH)                                             \
  X(ROT_TOP_RADIUS, "top_radius_m", ROT_KIND_LENGTH)                                               \
  X(ROT_RING_RADIUS, "ring_radius_m", ROT_KIND_LENGTH)                                             \
  X(ROT_TUBE_RADIUS, "tube_radius_m", ROT_KIND_LENGTH)                                             \
  X(ROT_SEMI_X, "semi_x_m", ROT_KIND_LENGTH)                                                       \
  X(ROT_SEMI_Y, "semi_y_m", ROT_KIND_LENGTH)                                                       \
  X(ROT_SEMI_Z, "semi_z_m", ROT_KIND_LENGTH)                                                       \
  X(ROT_WIDTH, "width_m", ROT_KIND_LENGTH)                                                         \
  X(ROT_HEIGHT, "height_m", ROT_KIND_LENGTH)                                                       \
  X(ROT_EDGE, "edge_m", ROT_KIND_LENGTH)                                                           \
  X(ROT_BASE, "base_m", ROT_KIND_LENGTH)                                                           \
  X(ROT_APEX, "apex_m", ROT_KIND_OFFSET)                                                           \
  X(ROT_SIDES, "sides", ROT_KIND_COUNT)

typedef enum rot_size_id {
#define X(id, name, kind) id,
  ROT_SIZE_LIST(X)
#undef X
      ROT_SIZE_COUNT
} rot_size_id;

typedef struct rot_size {
  const char *name;
  rot_size_kind kind;
} rot_size;

/* rot_size_id => size */
const rot_size *rot_size_at(int id);

/* Constraints on the sizes. */
typedef enum rot_fit {
  ROT_FIT_ANY,
  ROT_FIT_INSIDE,   /* second size <= first size */
  ROT_FIT_IN_SPHERE /* second size, a height, <= twice the first, a radius */
} rot_fit;

/* name, dimension, roundings, constraint, number of sizes, sizes. The roundings of each form are
 * counted (constant, square, factor, mass); test_shapes.c checks each form against 50 digits. */
#define ROT_SHAPE_LIST(X)                                                                          \
  X(point, 0, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                                       \
  X(sliding_point, 0, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                               \
  X(rod, 1, 4, ROT_FIT_ANY, 1, ROT_LENGTH)                                                         \
  X(rod_end, 1, 4, ROT_FIT_ANY, 1, ROT_LENGTH)                                                     \
  X(hoop, 1, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                                        \
  X(half_hoop, 1, 5, ROT_FIT_ANY, 1, ROT_RADIUS)                                                   \
  X(disk, 2, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                                        \
  X(annulus, 2, 5, ROT_FIT_INSIDE, 2, ROT_OUTER_RADIUS, ROT_INNER_RADIUS)                          \
  X(half_disk, 2, 5, ROT_FIT_ANY, 1, ROT_RADIUS)                                                   \
  X(elliptic_plate, 2, 4, ROT_FIT_ANY, 2, ROT_SEMI_X, ROT_SEMI_Y)                                  \
  X(rectangle, 2, 4, ROT_FIT_ANY, 2, ROT_LENGTH, ROT_WIDTH)                                        \
  X(triangle, 2, 8, ROT_FIT_ANY, 3, ROT_BASE, ROT_HEIGHT, ROT_APEX)                                \
  X(polygon_plate, 2, 8, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_SIDES)                                    \
  X(tube, 2, 4, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_LENGTH)                                            \
  X(can, 2, 9, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_LENGTH)                                             \
  X(spherical_shell, 2, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                             \
  X(hemispherical_shell, 2, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                         \
  X(spherical_cap_shell, 2, 8, ROT_FIT_IN_SPHERE, 2, ROT_RADIUS, ROT_HEIGHT)                       \
  X(cone_shell, 2, 4, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_HEIGHT)                                      \
  X(frustum_shell, 2, 18, ROT_FIT_ANY, 3, ROT_BASE_RADIUS, ROT_TOP_RADIUS, ROT_HEIGHT)             \
  X(torus_shell, 2, 6, ROT_FIT_INSIDE, 2, ROT_RING_RADIUS, ROT_TUBE_RADIUS)                        \
  X(ellipsoid_shell, 2, 4, ROT_FIT_ANY, 3, ROT_SEMI_X, ROT_SEMI_Y, ROT_SEMI_Z)                     \
  X(box_shell, 2, 10, ROT_FIT_ANY, 3, ROT_LENGTH, ROT_WIDTH, ROT_HEIGHT)                           \
  X(cylinder, 3, 4, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_LENGTH)                                        \
  X(thick_tube, 3, 5, ROT_FIT_INSIDE, 3, ROT_OUTER_RADIUS, ROT_INNER_RADIUS, ROT_LENGTH)           \
  X(half_cylinder, 3, 5, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_LENGTH)                                   \
  X(elliptic_cylinder, 3, 4, ROT_FIT_ANY, 3, ROT_SEMI_X, ROT_SEMI_Y, ROT_LENGTH)                   \
  X(sphere, 3, 4, ROT_FIT_ANY, 1, ROT_RADIUS)                                                      \
  X(hollow_sphere, 3, 14, ROT_FIT_INSIDE, 2, ROT_OUTER_RADIUS, ROT_INNER_RADIUS)                   \
  X(hemisphere, 3, 5, ROT_FIT_ANY, 1, ROT_RADIUS)                                                  \
  X(spherical_cap, 3, 18, ROT_FIT_IN_SPHERE, 2, ROT_RADIUS, ROT_HEIGHT)                            \
  X(cone, 3, 5, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_HEIGHT)                                            \
  X(frustum, 3, 24, ROT_FIT_ANY, 3, ROT_BASE_RADIUS, ROT_TOP_RADIUS, ROT_HEIGHT)                   \
  X(paraboloid, 3, 4, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_HEIGHT)                                      \
  X(ellipsoid, 3, 4, ROT_FIT_ANY, 3, ROT_SEMI_X, ROT_SEMI_Y, ROT_SEMI_Z)                           \
  X(torus, 3, 6, ROT_FIT_INSIDE, 2, ROT_RING_RADIUS, ROT_TUBE_RADIUS)                              \
  X(capsule, 3, 12, ROT_FIT_ANY, 2, ROT_RADIUS, ROT_LENGTH)                                        \
  X(box, 3, 4, ROT_FIT_ANY, 3, ROT_LENGTH, ROT_WIDTH, ROT_HEIGHT)                                  \
  X(cube, 3, 4, ROT_FIT_ANY, 1, ROT_EDGE)                                                          \
  X(polygon_prism, 3, 8, ROT_FIT_ANY, 3, ROT_RADIUS, ROT_SIDES, ROT_LENGTH)                        \
  X(triangular_prism, 3, 8, ROT_FIT_ANY, 4, ROT_BASE, ROT_HEIGHT, ROT_APEX, ROT_LENGTH)            \
  X(pyramid, 3, 5, ROT_FIT_ANY, 3, ROT_LENGTH, ROT_WIDTH, ROT_HEIGHT)                              \
  X(regular_tetrahedron, 3, 4, ROT_FIT_ANY, 1, ROT_EDGE)                                           \
  X(regular_octahedron, 3, 4, ROT_FIT_ANY, 1, ROT_EDGE)

typedef struct rot_shape {
  const char *name;
  int dimension; /* 3: solid, 2: surface, 1: line, 0: point */
  int sizes;     /* 1 to ROT_SIZES */
  rot_size_id size[ROT_SIZES];
  rot_fit fit;
  int roundings; /* max of each second moment, with that of the mass */
  rot_geometry_function *geometry;
} rot_shape;

/* => number of shapes in the list */
size_t rot_shape_count(void);
/* i => shape i of the list */
const rot_shape *rot_shape_at(size_t i);

#endif
