#include "body/parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/inertia.h"
#include "body/shapes.h"
#include "ground/real.h"

double rot_body_moment(const rot_given_body *body, const double axis[3], const double through[3]) {
  rot_inertial own = {.mass_kg = body->mass_kg};
  memcpy(own.centre_m, body->centre_m, sizeof own.centre_m);
  memcpy(own.second_kg_m2, body->second_kg_m2, sizeof own.second_kg_m2);
  return rot_inertia_axis(&own, axis, through ? through : body->axle_m);
}

size_t rot_body_count(const rot_given *bodies) {
  return bodies->is == ROT_INPUT_BODY ? 1 : bodies->n;
}

static double moment_of(const rot_given *given, size_t i) {
  static const double z[3] = {0.0, 0.0, 1.0};
  const rot_given *one = given->is == ROT_INPUT_LIST ? &given->item[i] : given;
  if (one->is == ROT_INPUT_BODY) return rot_body_moment(&one->body, z, NULL);
  if (one->is == ROT_INPUT_LIST || (one != given && one->n != 1)) return NAN;
  return one->x[one == given ? i : 0];
}

rot_status rot_body_moments(const rot_given given[], size_t input, double inertia_kg_m2[],
                            rot_refusal *no) {
  const size_t n = rot_body_count(&given[input]);
  if (n == 0) return rot_refuse(no, input, "is empty");
  for (size_t i = 0; i < n; i++) {
    inertia_kg_m2[i] = moment_of(&given[input], i);
    if (inertia_kg_m2[i] > 0.0 && inertia_kg_m2[i] < INFINITY) continue;
    (void)rot_refuse(no, input,
                     "must have a moment of inertia, finite and greater than 0; it is %g",
                     inertia_kg_m2[i]);
    if (n > 1) rot_refused_in(no, "item %zu", i + 1);
    return ROT_EVALUE;
  }
  return ROT_OK;
}

/* ---- the catalogue --------------------------------------------------------------------------- */

/* Inputs: the mass, the sizes, the density. */
#define LENGTH(name, words) ROT_NUMBER_INPUT(name, "m", 1, 0.0, 0, NAN, words)

#define SIZE_ROT_RADIUS       LENGTH("radius_m", "radius")
#define SIZE_ROT_LENGTH       LENGTH("length_m", "length")
#define SIZE_ROT_OUTER_RADIUS LENGTH("outer_radius_m", "outer radius")
#define SIZE_ROT_INNER_RADIUS LENGTH("inner_radius_m", "inner radius")
#define SIZE_ROT_BASE_RADIUS  LENGTH("base_radius_m", "radius of the base")
#define SIZE_ROT_TOP_RADIUS   LENGTH("top_radius_m", "radius of the top")
#define SIZE_ROT_RING_RADIUS  LENGTH("ring_radius_m", "radius of the circle that the tube follows")
#define SIZE_ROT_TUBE_RADIUS  LENGTH("tube_radius_m", "radius of the tube")
#define SIZE_ROT_SEMI_X       LENGTH("semi_x_m", "semi-axis along x")
#define SIZE_ROT_SEMI_Y       LENGTH("semi_y_m", "semi-axis along y")
#define SIZE_ROT_SEMI_Z       LENGTH("semi_z_m", "semi-axis along z")
#define SIZE_ROT_WIDTH        LENGTH("width_m", "width")
#define SIZE_ROT_HEIGHT       LENGTH("height_m", "height")
#define SIZE_ROT_EDGE         LENGTH("edge_m", "edge")
#define SIZE_ROT_BASE         LENGTH("base_m", "base")
#define SIZE_ROT_APEX                                                                              \
  ROT_NUMBER_INPUT("apex_m", "m", 0, -DBL_MAX, 0, NAN,                                             \
                   "foot of the apex along the base; default: half the base")
#define SIZE_ROT_SIDES ROT_NUMBER_INPUT("sides", "1", 1, 3.0, 0, NAN, "a whole number")

#define SIZES_1(a)          SIZE_##a
#define SIZES_2(a, b)       SIZE_##a, SIZE_##b
#define SIZES_3(a, b, c)    SIZE_##a, SIZE_##b, SIZE_##c
#define SIZES_4(a, b, c, d) SIZE_##a, SIZE_##b, SIZE_##c, SIZE_##d

/* Of a point the radius is its distance from the axis. */
#define SIZED_0(n, ...) ROT_NUMBER_INPUT("radius_m", "m", 0, 0.0, 0, 0.0, "distance from the axis")
#define SIZED_1(n, ...) SIZES_##n(__VA_ARGS__)
#define SIZED_2(n, ...) SIZES_##n(__VA_ARGS__)
#define SIZED_3(n, ...) SIZES_##n(__VA_ARGS__)

#define MASS(required, words) ROT_NUMBER_INPUT("mass_kg", "kg", required, 0.0, 0, NAN, words)
#define DENSITY(name, unit)   ROT_NUMBER_INPUT(name, unit, 0, 0.0, 0, NAN, "instead of the mass")

#define MASS_0    MASS(1, "mass")
#define MASS_1    MASS(0, "mass, or the density is given")
#define MASS_2    MASS_1
#define MASS_3    MASS_1
#define DENSITY_0 /* none */
#define DENSITY_1 , DENSITY("linear_density_kg_m", "kg/m")
#define DENSITY_2 , DENSITY("areal_density_kg_m2", "kg/m^2")
#define DENSITY_3 , DENSITY("density_kg_m3", "kg/m^3")

#define X(name, dimension, roundings, fit, n, ...)                                                 \
  static const rot_input name##_inputs[] = {MASS_##dimension, SIZED_##dimension(n, __VA_ARGS__)    \
                                                                  DENSITY_##dimension};
ROT_SHAPE_LIST(X)
#undef X

static rot_status refuse_size(const rot_shape *shape, rot_shape_fault fault, int slot,
                              rot_refusal *no) {
  const char *first = rot_size_at((int)shape->size[0])->name;
  const size_t input = 1 + (size_t)slot;
  switch (fault) {
  case ROT_SHAPE_SIDES: return rot_refuse(no, input, "must be a whole number of at least 3");
  case ROT_SHAPE_OUTSIDE: return rot_refuse(no, input, "must be at most `%s`", first);
  case ROT_SHAPE_TOO_HIGH: return rot_refuse(no, input, "must be at most twice `%s`", first);
  default: return rot_refuse(no, input, "must be at least 0");
  }
}

/* => rolling radius about z: a radius of the shape if it agrees with the moments */
static double rolling_radius(const rot_shape *shape, const rot_shape_body *of, const double size[],
                             double inertia) {
  if (!(of->beta > 0.0)) return NAN;
  const double from_beta = sqrt(inertia / of->mass_kg / of->beta);
  for (int k = 0; k < shape->sizes; k++) {
    const int radius = shape->size[k] == ROT_RADIUS || shape->size[k] == ROT_OUTER_RADIUS;
    /* Without mass (an ideal pulley) there are no moments to compare with. */
    const int agrees = of->mass_kg == 0.0 || fabs(size[k] - from_beta) <= 1e-9 * from_beta;
    if (radius && agrees) return size[k];
  }
  return from_beta;
}

/* (mass or density, sizes) => body of the catalogue */
static rot_status build_shape(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  const rot_shape *shape = rot_shape_at((size_t)(part - rot_body_parts));
  const size_t n = (size_t)shape->sizes, density = n + 1;
  const int by_density = density < part->n_inputs && given[density].is;
  rot_given_body *body = to;
  rot_shape_body of;
  double size[ROT_SIZES] = {0.0};
  int slot = 0;
  (void)store;
  if (by_density && given[0].is) return rot_refuse(no, density, "is given, and so is the mass");
  if (!by_density && !given[0].is) return rot_refuse(no, 0, "is missing: it has no default");
  for (size_t k = 0; k < n; k++) {
    const double otherwise = part->inputs[1 + k].otherwise; /* NaN: an apex, after its base */
    size[k] = given[1 + k].is ? given[1 + k].x[0] : isnan(otherwise) ? size[0] / 2.0 : otherwise;
  }
  const rot_shape_fault fault = rot_shape_check(shape, size, &slot);
  if (fault != ROT_SHAPE_FITS) return refuse_size(shape, fault, slot, no);
  rot_shape_make(shape, given[by_density ? density : 0].x[0], by_density, size, &of);
  memset(body, 0, sizeof *body);
  body->mass_kg = of.mass_kg;
  memcpy(body->centre_m, of.centre_m, sizeof of.centre_m);
  memcpy(body->second_kg_m2, of.second_kg_m2, sizeof of.second_kg_m2);
  rot_inertia_of_second(of.second_kg_m2, body->inertia_kg_m2);
  if (!isfinite(of.mass_kg) || !rot_all_finite(6, body->second_kg_m2) ||
      !rot_all_finite(6, body->inertia_kg_m2)) {
    return rot_refuse(no, by_density ? density : 0,
                      "gives a mass or moments beyond double precision, or none");
  }
  /* The axle of a rod end and of a point is at the origin. */
  const int named = !strcmp(shape->name, "point") || !strcmp(shape->name, "rod_end");
  if (!named) memcpy(body->axle_m, of.centre_m, sizeof of.centre_m);
  body->radius_m = rolling_radius(shape, &of, size, body->inertia_kg_m2[ROT_ZZ]);
  return ROT_OK;
}

/* ---- a tensor -------------------------------------------------------------------------------- */

static const rot_input tensor_inputs[] = {
    MASS(1, "mass"),
    {"inertia_kg_m2", "kg*m^2", ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1, ROT_NO_DOMAIN, NAN,
     "about the centre of mass: three principal moments; xx, yy, zz, xy, xz, yz with the products "
     "-int x y dm; or three rows",
     NULL},
    {"centre_m", "m", ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,
     "centre of mass, in the own axes; default: 0, 0, 0", NULL},
    ROT_NUMBER_INPUT("reach_m", "m", 0, 0.0, 0, NAN, "of its outline: no number depends on it"),
    {"name", "", ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN, "in words", NULL}};

/* 3 or 6 numbers, or 3 rows => xx, yy, zz, xy, xz, yz; returns 0 for another count or asymmetry */
static int read_tensor(const rot_given *given, double t[ROT_TENSOR]) {
  double m[9];
  const double *x = given->x;
  size_t n = given->n;
  memset(t, 0, ROT_TENSOR * sizeof *t);
  if (given->is == ROT_INPUT_LIST) {
    if (n != 3) return 0;
    for (size_t i = 0; i < 3; i++) {
      if (given->item[i].is != ROT_INPUT_NUMBERS || given->item[i].n != 3) return 0;
      memcpy(m + 3 * i, given->item[i].x, 3 * sizeof *m);
    }
    x = m;
    n = 9;
  }
  if (n == 3 || n == 6) return (memcpy(t, x, n * sizeof *t), 1);
  if (n != 9) return 0;
  double max = 0.0;
  for (int i = 0; i < 9; i++) max = fmax(max, fabs(x[i]));
  for (int k = 0; k < ROT_TENSOR; k++) {
    const int i = rot_tensor_row[k], j = rot_tensor_column[k];
    const double a = x[3 * i + j], b = x[3 * j + i];
    if (!(fabs(a - b) <= 1e-12 * max)) return 0;
    t[k] = a == b ? a : a / 2.0 + b / 2.0;
  }
  return 1;
}

/* (mass, inertia tensor, centre) => body */
static rot_status build_tensor(const rot_part *part, const rot_given given[], rot_store *store,
                               void *to, rot_refusal *no) {
  rot_given_body *body = to;
  double t[ROT_TENSOR];
  (void)store;
  memset(body, 0, sizeof *body);
  if (!read_tensor(&given[1], t)) {
    return rot_refuse(no, 1, "must be 3 or 6 numbers, or 3 symmetric rows of 3");
  }
  rot_inertia_to_second(t, body->second_kg_m2);
  rot_inertia_of_second(body->second_kg_m2, body->inertia_kg_m2);
  if (!rot_all_finite(6, body->second_kg_m2) || !rot_all_finite(6, body->inertia_kg_m2)) {
    return rot_refuse(no, 1, "is beyond double precision");
  }
  if (!rot_inertia_possible(body->second_kg_m2)) {
    return rot_refuse(no, 1, "is of no body: a principal moment exceeds the sum of the others");
  }
  body->mass_kg = rot_input_number(part->inputs, given, 0);
  rot_input_vector(&given[2], body->centre_m);
  memcpy(body->axle_m, body->centre_m, sizeof body->axle_m);
  body->radius_m = NAN;
  return ROT_OK;
}

#define PART(constructor, inputs, build)                                                           \
  {                                                                                                \
    constructor, ROT_INPUT_BODY, sizeof inputs / sizeof *inputs, inputs, sizeof(rot_given_body),   \
        build                                                                                      \
  }

const rot_part rot_body_parts[] = {
#define X(name, dimension, roundings, fit, n, ...) PART("body_" #name, name##_inputs, build_shape),
    ROT_SHAPE_LIST(X)
#undef X
        PART("body_tensor", tensor_inputs, build_tensor),
};
const size_t rot_body_n_parts = sizeof rot_body_parts / sizeof *rot_body_parts;
