#include "body/compound.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/inertia.h"
#include "body/points.h"
#include "body/shapes_geometry.h"
#include "body/vertices.h"
#include "maths/attitude.h"

/* (mass, centre, second moment) => the other members: an axle through the centre, no rolling radius
 */
static rot_status finish(rot_given_body *body, rot_refusal *no) {
  double sum = body->mass_kg;
  rot_inertia_of_second(body->second_kg_m2, body->inertia_kg_m2);
  for (int k = 0; k < ROT_TENSOR; k++) sum += fabs(body->inertia_kg_m2[k]);
  for (int k = 0; k < 3; k++) sum += fabs(body->centre_m[k]);
  if (!isfinite(sum)) return rot_refuse(no, 0, "gives moments beyond double precision");
  memcpy(body->axle_m, body->centre_m, sizeof body->axle_m);
  body->radius_m = NAN;
  return ROT_OK;
}

/* ---- placed ---------------------------------------------------------------------------------- */

enum { BODY, AT, ROTATION };
static const rot_input place_inputs[] = {
    {"body", "", ROT_INPUT_BODY, 1, ROT_NO_DOMAIN, NAN, "that is turned, then moved", NULL},
    {"at_m", "m", ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,
     "where its origin comes to lie; default: 0, 0, 0", NULL},
    {"rotation", "1", ROT_INPUT_ATTITUDE | ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 0, ROT_NO_DOMAIN,
     NAN, "a quaternion, scalar first, or the three rows of a matrix; default: none", NULL}};

/* given => r, one Newton step towards the nearest orthogonal matrix, for numbers with few digits.
 * Returns 0 for a matrix too far from a rotation, or a reflection. */
static int nearest(const double given[9], double r[9]) {
  double m[9], off = 0.0;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      double sum = 0.0;
      for (int k = 0; k < 3; k++) sum += given[3 * k + i] * given[3 * k + j];
      off = fmax(off, fabs(sum - (i == j)));
      m[3 * i + j] = (i == j ? 3.0 : 0.0) - sum;
    }
  }
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      double sum = 0.0;
      for (int k = 0; k < 3; k++) sum += given[3 * i + k] * m[3 * k + j];
      r[3 * i + j] = sum / 2.0;
    }
  }
  const double determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) -
                             r[1] * (r[3] * r[8] - r[5] * r[6]) +
                             r[2] * (r[3] * r[7] - r[4] * r[6]);
  return off <= 1e-8 && determinant > 0.0;
}

/* given => rotation matrix by rows; returns 0 if it is not a rotation */
static int read_rotation(const rot_given *given, double r[9]) {
  double rows[9], q[4];
  if (given->is == ROT_INPUT_ATTITUDE) {
    (void)rot_attitude_from(ROT_FORM_QUATERNION, given->x, NULL, q);
    (void)rot_attitude_to(ROT_FORM_MATRIX, q, NULL, r);
    return 1;
  }
  if (given->is != ROT_INPUT_LIST || given->n != 3) return 0;
  for (size_t i = 0; i < 3; i++) {
    const rot_given *row = &given->item[i];
    if (row->is != ROT_INPUT_NUMBERS || row->n != 3) return 0;
    memcpy(rows + 3 * i, row->x, 3 * sizeof *rows);
  }
  return nearest(rows, r);
}

static int is_identity(const double r[9]) {
  for (int i = 0; i < 9; i++) {
    if (r[i] != (i % 4 == 0)) return 0;
  }
  return 1;
}

static void move(const double r[9], const double at[3], double x[3]) {
  double turned[3] = {x[0], x[1], x[2]};
  for (int i = 0; i < 3 && r; i++) {
    turned[i] = r[3 * i] * x[0] + r[3 * i + 1] * x[1] + r[3 * i + 2] * x[2];
  }
  for (int i = 0; i < 3; i++) x[i] = turned[i] + at[i];
}

/* (body, at, rotation) => the body rotated, then moved */
static rot_status build_place(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  rot_given_body *body = to;
  double at[3], r[9], *turn = given[ROTATION].is ? r : NULL;
  (void)part, (void)store;
  *body = given[BODY].body;
  rot_input_vector(&given[AT], at);
  if (turn && !read_rotation(&given[ROTATION], r)) {
    return rot_refuse(no, ROTATION, "must be a quaternion, or the three rows of a rotation");
  }
  move(turn, at, body->centre_m);
  move(turn, at, body->axle_m);
  for (int k = 0; k < 3; k++) {
    if (!isfinite(body->centre_m[k])) return rot_refuse(no, AT, "is beyond double precision");
  }
  if (!turn) return ROT_OK;
  rot_inertia_rotate(r, given[BODY].body.second_kg_m2, body->second_kg_m2);
  rot_inertia_of_second(body->second_kg_m2, body->inertia_kg_m2);
  if (!is_identity(r)) body->radius_m = NAN; /* the rolling axis may no longer be z */
  return ROT_OK;
}

/* ---- joined, cut ----------------------------------------------------------------------------- */

static rot_inertial inertial_of(const rot_given_body *body, double sign) {
  rot_inertial out = {.mass_kg = sign * body->mass_kg};
  memcpy(out.centre_m, body->centre_m, sizeof out.centre_m);
  for (int k = 0; k < ROT_TENSOR; k++) out.second_kg_m2[k] = sign * body->second_kg_m2[k];
  return out;
}

static rot_status join(size_t n, const rot_inertial part[], rot_given_body *body, rot_refusal *no) {
  rot_inertial whole;
  double error;
  memset(body, 0, sizeof *body);
  if (rot_inertia_join(n, part, &whole, &error) != ROT_OK) {
    return rot_refuse(no, 0, "gives moments beyond double precision");
  }
  body->mass_kg = whole.mass_kg;
  memcpy(body->centre_m, whole.centre_m, sizeof body->centre_m);
  memcpy(body->second_kg_m2, whole.second_kg_m2, sizeof body->second_kg_m2);
  return finish(body, no);
}

#define BODIES "bodies", "", ROT_INPUT_BODY | ROT_INPUT_LIST, 1, ROT_NO_DOMAIN, NAN
static const rot_input join_inputs[] = {
    {BODIES, "in one frame; lists of bodies count as their bodies", NULL},
    {"name", "", ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN, "in words", NULL}};

static size_t count_bodies(const rot_given *given) {
  size_t n = given->is == ROT_INPUT_BODY;
  for (size_t i = 0; i < given->n && given->is == ROT_INPUT_LIST; i++) {
    n += count_bodies(&given->item[i]);
  }
  return n;
}

static rot_inertial *gather(const rot_given *given, rot_inertial *to) {
  if (given->is == ROT_INPUT_BODY) *to++ = inertial_of(&given->body, 1.0);
  for (size_t i = 0; i < given->n && given->is == ROT_INPUT_LIST; i++) {
    to = gather(&given->item[i], to);
  }
  return to;
}

static rot_status build_join(const rot_part *part, const rot_given given[], rot_store *store,
                             void *to, rot_refusal *no) {
  const size_t n = count_bodies(&given[0]);
  (void)part;
  if (n == 0) return rot_refuse(no, 0, "must be one body at least");
  rot_inertial *all = rot_store_get(store, n, sizeof *all);
  if (!all) return ROT_ENOMEM;
  (void)gather(&given[0], all);
  return join(n, all, to, no);
}

static const rot_input cut_inputs[] = {
    {"body", "", ROT_INPUT_BODY, 1, ROT_NO_DOMAIN, NAN, "of which the hole is taken", NULL},
    {"hole", "", ROT_INPUT_BODY, 1, ROT_NO_DOMAIN, NAN, "the material removed", NULL},
    {"name", "", ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN, "in words", NULL}};

static rot_status build_cut(const rot_part *part, const rot_given given[], rot_store *store,
                            void *to, rot_refusal *no) {
  const rot_inertial two[] = {inertial_of(&given[0].body, 1.0), inertial_of(&given[1].body, -1.0)};
  rot_given_body *body = to;
  (void)part, (void)store;
  if (!(given[1].body.mass_kg < given[0].body.mass_kg)) {
    return rot_refuse(no, 1, "must be lighter than the body, %g kg; it has %g kg",
                      given[0].body.mass_kg, given[1].body.mass_kg);
  }
  const rot_status status = join(2, two, body, no);
  if (status != ROT_OK) return status;
  if (rot_inertia_possible(body->second_kg_m2)) return ROT_OK;
  return rot_refuse(no, 1, "must be inside the body: what is left is no body");
}

/* ---- points ---------------------------------------------------------------------------------- */

/* A table of points. */
typedef struct points {
  size_t n;
  size_t length[4];        /* of each column: n, or 1 for a value of all points */
  const double *column[4]; /* mass, x, y, z; NULL: not given */
} points;

#define COLUMN(name, unit, required, words)                                                        \
  { name, unit, ROT_INPUT_NUMBERS, required, ROT_NO_DOMAIN, NAN, words, NULL }
static const rot_input data_inputs[] = {
    COLUMN("mass_kg", "kg", 0, "of each point, or one for all"),
    COLUMN("x_m", "m", 1, "of each point"), COLUMN("y_m", "m", 1, "of each point"),
    COLUMN("z_m", "m", 0, "of each point, or one for all; default: 0")};

/* columns => table of points; checks their lengths */
static rot_status build_data(const rot_part *part, const rot_given given[], rot_store *store,
                             void *to, rot_refusal *no) {
  points *p = to;
  (void)part, (void)store;
  memset(p, 0, sizeof *p);
  for (size_t k = 0; k < 4; k++) {
    p->column[k] = given[k].is ? given[k].x : NULL;
    p->length[k] = given[k].is ? given[k].n : 0;
    if (p->length[k] > p->n) p->n = p->length[k];
  }
  if (p->n == 0) return rot_refuse(no, 1, "must have one point at least");
  for (size_t k = 0; k < 4; k++) {
    if (p->length[k] == p->n || p->length[k] == 1 || !p->column[k]) continue;
    return rot_refuse(no, k, "must have one number for each of the %zu points; it has %zu", p->n,
                      p->length[k]);
  }
  return ROT_OK;
}

static const rot_input points_inputs[] = {
    {"data", "", ROT_INPUT_POINTS, 1, ROT_NO_DOMAIN, NAN, "the points", NULL},
    {"mass_kg", "kg", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, NAN, "of each, instead of a column",
     NULL},
    {"name", "", ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN, "in words", NULL}};

/* (table, mass of each) => body */
static rot_status build_points(const rot_part *part, const rot_given given[], rot_store *store,
                               void *to, rot_refusal *no) {
  static const double none = 0.0;
  const points *p = given[0].object;
  rot_given_body *body = to;
  rot_points all = {.n = p->n};
  rot_moments moments;
  int bad;
  (void)part, (void)store;
  memset(body, 0, sizeof *body);
  if (!p->column[0] && !given[1].is) return rot_refuse(no, 1, "is missing: no point has a mass");
  if (p->column[0] && given[1].is) return rot_refuse(no, 1, "is given, and the points have masses");
  all.mass =
      given[1].is ? (rot_column){given[1].x, 0} : (rot_column){p->column[0], p->length[0] > 1};
  for (size_t k = 0; k < 3; k++) {
    const double *x = p->column[1 + k];
    all.x[k] = x ? (rot_column){x, p->length[1 + k] > 1} : (rot_column){&none, 0};
  }
  if (rot_points_bad(&all, &bad) < all.n) return rot_refuse(no, 0, "must have no mass below 0");
  if (rot_points_moments(&all, NULL, &moments) != ROT_OK || rot_moments_check(&moments) != ROT_OK) {
    return rot_refuse(no, 0, "gives moments beyond double precision");
  }
  body->mass_kg = moments.mass;
  memcpy(body->centre_m, moments.centre, sizeof body->centre_m);
  memcpy(body->second_kg_m2, moments.c, sizeof body->second_kg_m2);
  return finish(body, no);
}

/* ---- vertices -------------------------------------------------------------------------------- */

enum { MASS, VERTICES, DENSITY };
#define VERTEX_INPUTS(words, density, unit)                                                        \
  ROT_NUMBER_INPUT("mass_kg", "kg", 0, 0.0, 0, NAN, "mass, or the density is given"),              \
      {"vertices_m", "m", ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1, ROT_NO_DOMAIN, NAN, words, NULL}, \
      ROT_NUMBER_INPUT(density, unit, 0, 0.0, 0, NAN, "instead of the mass")
static const rot_input polygon_inputs[] = {
    VERTEX_INPUTS("rows of x, y, in order", "areal_density_kg_m2", "kg/m^2")};
static const rot_input tetrahedron_inputs[] = {
    VERTEX_INPUTS("four rows of x, y, z", "density_kg_m3", "kg/m^3")};

/* rows of `width` numbers => columns; NULL if a row has another length */
static double *columns_of(const rot_given *rows, size_t width, rot_store *store) {
  double *x =
      rows->is == ROT_INPUT_LIST ? rot_store_get(store, width * rows->n + 1, sizeof *x) : NULL;
  for (size_t i = 0; i < rows->n && x; i++) {
    const rot_given *row = &rows->item[i];
    if (row->is != ROT_INPUT_NUMBERS || row->n != width) return NULL;
    for (size_t k = 0; k < width; k++) x[k * rows->n + i] = row->x[k];
  }
  return x;
}

/* (mass or density, vertices) => polygon or tetrahedron */
static rot_status build_vertices(const rot_part *part, const rot_given given[], rot_store *store,
                                 void *to, rot_refusal *no) {
  const int flat = part->inputs == polygon_inputs, by_density = given[DENSITY].is != 0;
  const size_t n = given[VERTICES].n;
  const double *x = columns_of(&given[VERTICES], flat ? 2 : 3, store);
  rot_given_body *body = to;
  rot_vertices_body of;
  rot_vertices_fault fault = ROT_VERTICES_FIT;
  memset(body, 0, sizeof *body);
  if (!x || (flat ? n < 3 : n != 4)) {
    return rot_refuse(no, VERTICES,
                      flat ? "must be three rows of two numbers, or more"
                           : "must be four rows of three numbers");
  }
  if ((given[MASS].is != 0) == by_density) {
    return rot_refuse(no, MASS, "or a density must be given, and not both");
  }
  const double amount = given[by_density ? DENSITY : MASS].x[0];
  const rot_status status = flat ? rot_polygon(n, x, amount, by_density, NULL, &of, &fault)
                                 : rot_tetrahedron(x, amount, by_density, &of, &fault);
  if (status == ROT_EVALUE) {
    return rot_refuse(no, VERTICES,
                      fault == ROT_VERTICES_CROSSING
                          ? "must be in the order of the outline: two edges cross"
                          : "must not lie on one line, or in one plane");
  }
  if (status != ROT_OK) return status;
  body->mass_kg = of.mass_kg;
  memcpy(body->centre_m, of.centre_m, sizeof body->centre_m);
  memcpy(body->second_kg_m2, of.second_kg_m2, sizeof body->second_kg_m2);
  return finish(body, no);
}

/* ---- body given by all its numbers ----------------------------------------------------------- */

#define X(id, name, kind) ROT_NUMBER_INPUT(name, "", 0, -DBL_MAX, 0, NAN, "as of that shape"),
static const rot_input size_inputs[] = {ROT_SIZE_LIST(X)};
#undef X

static rot_status build_sizes(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  double *size = to;
  (void)store, (void)no;
  for (size_t k = 0; k < part->n_inputs; k++) size[k] = given[k].is ? given[k].x[0] : (double)NAN;
  return ROT_OK;
}

static const char *const named_shapes[] = {"point", "rod_end", NULL};
static const char *const by_formula[] = {"formula", NULL};
#define WORDS(name)                                                                                \
  { name, "", ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN, "in words", NULL }
#define MEASURE(name, unit, words)                                                                 \
  { name, unit, ROT_INPUT_LIMIT, 0, 0.0, INFINITY, 0, NAN, words, NULL }
enum { SHAPE, OF_MASS, CENTRE, SECOND, SIZES, REACH, BETA, PROVENANCE = 9, FRAME_AT = 14, TURN };
static const rot_input numbers_inputs[] = {
    [SHAPE] = {"shape", "", ROT_INPUT_CHOICE | ROT_INPUT_TEXT, 1, ROT_NO_DOMAIN, NAN,
               "its name; those listed have an axle of their own", named_shapes},
    [OF_MASS] = ROT_NUMBER_INPUT("mass_kg", "kg", 1, 0.0, 0, NAN, "mass"),
    [CENTRE] = {"centre_m", "m", ROT_INPUT_VECTOR, 1, ROT_NO_DOMAIN, NAN, "of mass", NULL},
    [SECOND] = {"second_moment_kg_m2", "kg*m^2", ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1,
                ROT_NO_DOMAIN, NAN, "three rows of int x x' dm, about the centre of mass", NULL},
    [SIZES] = {"size_m", "m", ROT_INPUT_NUMBERS | ROT_INPUT_SIZES, 0, ROT_NO_DOMAIN, NAN,
               "of the shape, by name", NULL},
    [REACH] = MEASURE("reach_m", "m", "from the centre of mass to its farthest point"),
    [BETA] = MEASURE("beta", "1", "I/(m r^2) of a round body"),
    WORDS("formula"),
    WORDS("source"),
    [PROVENANCE] = {"provenance", "", ROT_INPUT_CHOICE | ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN,
                    "where the numbers are from", by_formula},
    WORDS("method"),
    MEASURE("error", "1", "of the second moment, over its trace"),
    WORDS("error_kind"),
    MEASURE("centre_error_m", "m", "of each coordinate of the centre"),
    [FRAME_AT] = {"frame_at_m", "m", ROT_INPUT_VECTOR, 0, ROT_NO_DOMAIN, NAN,
                  "where the shape's own origin lies", NULL},
    [TURN] = {"frame_turn", "1", ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 0, ROT_NO_DOMAIN, NAN,
              "three rows: how the shape is turned", NULL}};

/* => rolling radius: a radius of the shape if it agrees with the moments, else that from beta */
static double radius_of(const rot_given_body *body, double beta, const rot_given *sizes) {
  if (!(beta > 0.0 && beta < INFINITY)) return NAN;
  const double from_beta = sqrt(body->inertia_kg_m2[ROT_ZZ] / body->mass_kg / beta);
  const double *size = sizes->is == ROT_INPUT_SIZES ? sizes->object : NULL;
  for (int k = ROT_RADIUS; size && k <= ROT_OUTER_RADIUS; k++) {
    const int radius = k == ROT_RADIUS || k == ROT_OUTER_RADIUS;
    if (radius && fabs(size[k] - from_beta) <= 1e-9 * from_beta) return size[k];
  }
  return from_beta;
}

/* all numbers of a body, as R writes them => body */
static rot_status build_numbers(const rot_part *part, const rot_given given[], rot_store *store,
                                void *to, rot_refusal *no) {
  rot_given_body *body = to;
  (void)part;
  memset(body, 0, sizeof *body);
  const double *rows = given[SECOND].n == 3 ? columns_of(&given[SECOND], 3, store) : NULL;
  if (!rows || rows[1] != rows[3] || rows[2] != rows[6] || rows[5] != rows[7]) {
    return rot_refuse(no, SECOND, "must be three symmetric rows of three numbers");
  }
  for (int k = 0; k < ROT_TENSOR; k++) {
    body->second_kg_m2[k] = rows[rot_tensor_row[k] + 3 * rot_tensor_column[k]];
  }
  body->mass_kg = given[OF_MASS].x[0];
  rot_input_vector(&given[CENTRE], body->centre_m);
  const rot_status status = finish(body, no);
  if (status != ROT_OK) return status;
  if (!rot_inertia_possible(body->second_kg_m2)) {
    return rot_refuse(no, SECOND, "is of no body: a second moment along an axis is below 0");
  }
  /* The axle of a rod end and of a point is at the origin of the shape, as moved. */
  if (given[SHAPE].is == ROT_INPUT_CHOICE && given[PROVENANCE].is == ROT_INPUT_CHOICE) {
    rot_input_vector(&given[FRAME_AT], body->axle_m);
  }
  if (given[BETA].is) body->radius_m = radius_of(body, given[BETA].x[0], &given[SIZES]);
  return ROT_OK;
}

#define PART(constructor, makes, inputs, size, build)                                              \
  { constructor, makes, sizeof inputs / sizeof *inputs, inputs, size, build }
#define BODY_PART(constructor, inputs, build)                                                      \
  PART(constructor, ROT_INPUT_BODY, inputs, sizeof(rot_given_body), build)
const rot_part rot_compound_parts[] = {
    BODY_PART("place_body", place_inputs, build_place),
    BODY_PART("join_bodies", join_inputs, build_join),
    BODY_PART("cut_body", cut_inputs, build_cut),
    PART("data", ROT_INPUT_POINTS, data_inputs, sizeof(points), build_data),
    BODY_PART("body_points", points_inputs, build_points),
    BODY_PART("body_polygon", polygon_inputs, build_vertices),
    BODY_PART("body_tetrahedron", tetrahedron_inputs, build_vertices),
    PART("size_m", ROT_INPUT_SIZES, size_inputs, sizeof(double[ROT_SIZE_COUNT]), build_sizes),
    BODY_PART("rot_body", numbers_inputs, build_numbers)};
const size_t rot_compound_n_parts = sizeof rot_compound_parts / sizeof *rot_compound_parts;

int rot_compound_is_derived(const rot_part *part) {
  return part->build == build_numbers || part->build == build_sizes;
}
