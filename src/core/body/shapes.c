#include "body/shapes.h"

#include <math.h>

#include "body/inertia.h"
#include "ground/real.h"

/* ---- sizes ---------------------------------------------------------------------------------- */

rot_shape_fault rot_shape_check(const rot_shape *shape, const double size[], int *slot) {
  for (int k = 0; k < shape->sizes; k++) {
    *slot = k;
    switch (rot_size_at((int)shape->size[k])->kind) {
    case ROT_KIND_LENGTH:
      if (size[k] < 0.0) return ROT_SHAPE_NEGATIVE;
      break;
    case ROT_KIND_COUNT:
      if (size[k] < 3.0 || (isfinite(size[k]) && size[k] != floor(size[k]))) return ROT_SHAPE_SIDES;
      break;
    case ROT_KIND_OFFSET: break;
    }
  }
  *slot = 1;
  if (shape->fit == ROT_FIT_INSIDE && size[1] > size[0]) return ROT_SHAPE_OUTSIDE;
  if (shape->fit == ROT_FIT_IN_SPHERE && size[1] / 2.0 > size[0]) return ROT_SHAPE_TOO_HIGH;
  return ROT_SHAPE_FITS;
}

/* Exponent of the ratio of sizes above which each size needs a separate scale. */
#define RANGE_BITS 400

/* size => sizes scaled to near 1, their exponent; *separate: 1 if one scale is not enough. Sizes
 * between 2^-60 and 2^60 are not scaled: no form of body/shapes_geometry.c over- or underflows. */
static int scale_sizes(const rot_shape *shape, const double size[], double scaled[ROT_SIZES],
                       int *separate) {
  double big = 0.0, small = 1.0;
  for (int k = 0; k < shape->sizes; k++) {
    const double a = fabs(size[k]);
    scaled[k] = size[k];
    if (rot_size_at((int)shape->size[k])->kind == ROT_KIND_COUNT) continue;
    if (a > big) big = a;
    if (a > 0.0 && a < small) small = a;
  }
  int e = 0, min = 0;
  *separate = 0;
  if ((big <= 0x1p60 && small >= 0x1p-60) || !(big > 0.0) || isinf(big)) return 0;
  (void)frexp(big, &e);
  (void)frexp(small, &min);
  *separate = e - min > RANGE_BITS;
  for (int k = 0; k < shape->sizes; k++) {
    if (rot_size_at((int)shape->size[k])->kind != ROT_KIND_COUNT) scaled[k] = ldexp(size[k], -e);
  }
  return e;
}

/* => a b 2^e with one rounding, for factors of any size */
static double times(double a, double b, int e) {
  const double p = a * b, size = fabs(p);
  if (e == 0 && size > 0x1p-900 && size < 0x1p900) return p;
  int ea = 0, eb = 0;
  const double f = frexp(a, &ea) * frexp(b, &eb);
  return ldexp(f, ea + eb + e);
}

/* ---- geometry of any sizes ------------------------------------------------------------------ */

typedef struct scaled_geometry {
  rot_geometry is;
  int e;     /* lengths are in units of 2^e */
  int of[3]; /* second moments are in units of 4^of[k] */
} scaled_geometry;

/* Second moments for ratios of sizes above 2^400, where squares of the small sizes may underflow.
 * Each size sets the scale once, with larger sizes clamped to 2^400 of it. Clamping and underflow
 * only reduce a moment, so the largest value is correct. */
static void widen(const rot_shape *shape, const double size[], scaled_geometry *g) {
  for (int j = 0; j < shape->sizes; j++) {
    double scaled[ROT_SIZES] = {0.0};
    rot_geometry other;
    int e;
    (void)frexp(size[j], &e);
    if (rot_size_at((int)shape->size[j])->kind == ROT_KIND_COUNT || !(fabs(size[j]) > 0.0))
      continue;
    if (g->e - e <= RANGE_BITS) continue;
    for (int k = 0; k < shape->sizes; k++) {
      const int counts = rot_size_at((int)shape->size[k])->kind == ROT_KIND_COUNT;
      scaled[k] = counts ? size[k] : fmax(fmin(ldexp(size[k], -e), 0x1p400), -0x1p400);
    }
    shape->geometry(scaled, &other);
    for (int k = 0; k < 3; k++) {
      /* Converted to the new unit; Inf if the old unit is much larger. */
      const double was = ldexp(g->is.second[k], 2 * (g->of[k] - e));
      if (!(other.second[k] > was)) continue;
      g->is.second[k] = other.second[k];
      g->of[k] = e;
    }
  }
}

static void geometry_of(const rot_shape *shape, const double size[], scaled_geometry *g) {
  double scaled[ROT_SIZES] = {0.0};
  int separate;
  g->e = scale_sizes(shape, size, scaled, &separate);
  shape->geometry(scaled, &g->is);
  for (int k = 0; k < 3; k++) g->of[k] = g->e;
  if (separate) widen(shape, size, g);
}

static double second_of(const scaled_geometry *g, double mass, int k) {
  return times(mass, g->is.second[k], 2 * g->of[k]);
}

/* 0 if the sizes need separate scales; the reported moment is then that about z. */
static int one_scale(const scaled_geometry *g) { return g->of[0] == g->e && g->of[1] == g->e; }

static double moment_of(const scaled_geometry *g, double mass) {
  if (one_scale(g)) return times(mass, g->is.moment, 2 * g->e);
  return second_of(g, mass, 0) + second_of(g, mass, 1);
}

static double gyration_of(const scaled_geometry *g) {
  if (one_scale(g)) return ldexp(sqrt(g->is.moment), g->e);
  return hypot(ldexp(sqrt(g->is.second[0]), g->of[0]), ldexp(sqrt(g->is.second[1]), g->of[1]));
}

/* ---- one body ------------------------------------------------------------------------------- */

void rot_shape_make(const rot_shape *shape, double amount, int is_density, const double size[],
                    rot_shape_body *out) {
  scaled_geometry scaled;
  geometry_of(shape, size, &scaled);
  const rot_geometry *g = &scaled.is;
  const int e = scaled.e;
  const double mass = is_density ? times(amount, g->measure, shape->dimension * e) : amount;
  out->mass_kg = mass;
  for (int k = 0; k < 3; k++) out->second_kg_m2[k] = second_of(&scaled, mass, k);
  out->second_kg_m2[3] = times(mass, g->second[3], 2 * e);
  out->second_kg_m2[4] = out->second_kg_m2[5] = 0.0;
  for (int k = 0; k < 3; k++) out->centre_m[k] = ldexp(g->centre[k], e);
  out->reach_m = ldexp(g->reach, e);
  out->beta = g->beta;
  out->moment_kg_m2 = moment_of(&scaled, mass);
  out->gyration_m = gyration_of(&scaled);
  const int has_mass = is_density ? amount > 0.0 && g->measure > 0.0 : mass > 0.0;
  const int has_moment = has_mass && g->second[0] + g->second[1] + g->second[2] > 0.0;
  out->error = rot_inertia_error(out->second_kg_m2, mass, is_density,
                                 shape->roundings + (is_density ? 8.0 : 0.0), has_moment);
}

/* ---- a table -------------------------------------------------------------------------------- */

static void fill(double *out[], size_t i, double x) {
  for (int c = 0; c < ROT_SHAPE_COLUMNS; c++) out[c][i] = x;
}

/* A row without shape: only the moment beta m r^2 is known. */
static void row_of_beta(double *out[], size_t i, double beta, double mass, double r) {
  fill(out, i, NAN);
  out[ROT_SHAPE_MOMENT][i] = rot_product(4, (double[]){beta, mass, r, r}, 1.0);
  out[ROT_SHAPE_ROLLS][i] = beta;
  out[ROT_SHAPE_GYRATION][i] = sqrt(beta) * r;
}

/* (shape, mass, sizes) => row i of all columns */
static void row_of_shape(double *out[], size_t i, const rot_shape *shape, double mass,
                         const double size[]) {
  scaled_geometry scaled;
  geometry_of(shape, size, &scaled);
  const rot_geometry *g = &scaled.is;
  const int e = scaled.e;
  out[ROT_SHAPE_ROLLS][i] = g->beta;
  out[ROT_SHAPE_MOMENT][i] = moment_of(&scaled, mass);
  out[ROT_SHAPE_GYRATION][i] = e ? gyration_of(&scaled) : sqrt(g->moment);
  if (one_scale(&scaled) && scaled.of[2] == e) {
    out[ROT_SHAPE_IXX][i] = times(mass, g->second[1] + g->second[2], 2 * e);
    out[ROT_SHAPE_IYY][i] = times(mass, g->second[0] + g->second[2], 2 * e);
    out[ROT_SHAPE_IZZ][i] = times(mass, g->second[0] + g->second[1], 2 * e);
  } else {
    const double x = second_of(&scaled, mass, 0), y = second_of(&scaled, mass, 1),
                 z = second_of(&scaled, mass, 2);
    out[ROT_SHAPE_IXX][i] = y + z;
    out[ROT_SHAPE_IYY][i] = x + z;
    out[ROT_SHAPE_IZZ][i] = x + y;
  }
}

rot_shape_fault rot_shapes_table(size_t n, const rot_shape_rows *rows,
                                 double *out[ROT_SHAPE_COLUMNS], size_t *row, int *slot) {
  for (size_t i = 0; i < n; i++) {
    const int at = rows->shape[i * rows->shape_step];
    const double mass = rot_at(rows->mass_kg, i), beta = rot_at(rows->beta, i);
    double size[ROT_SIZES] = {0.0}, missing = mass;
    rot_shape_fault fault = mass < 0.0 ? ROT_SHAPE_MASS : ROT_SHAPE_FITS;
    *row = i;
    *slot = 0;
    if (beta < 0.0) return ROT_SHAPE_BETA;
    if (fault) return fault;
    if (at < 0) {
      const double r = rot_at(rows->size[ROT_RADIUS], i);
      if (r < 0.0) return ROT_SHAPE_NEGATIVE;
      row_of_beta(out, i, beta, mass, r);
      continue;
    }
    const rot_shape *shape = rot_shape_at((size_t)at);
    for (int k = 0; k < shape->sizes; k++) {
      size[k] = rot_at(rows->size[shape->size[k]], i);
      if (isnan(size[k])) missing = size[k];
    }
    fault = rot_shape_check(shape, size, slot);
    if (fault) return fault;
    if (isnan(missing)) {
      fill(out, i, missing);
    } else {
      row_of_shape(out, i, shape, mass, size);
    }
  }
  return ROT_SHAPE_FITS;
}
