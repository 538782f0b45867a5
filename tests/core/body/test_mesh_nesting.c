/* Bodies in bodies: cavities, islands, parts turned inside out, parts that cross. */
#include "mesh_shapes.h"
#include "body/mesh_edges.h"
#include "body/mesh_nesting.h"
#include "rot_test.h"

static uint32_t component[5000];
static double volume[64];

static rot_mesh_nesting check(shape *s) {
  rot_mesh_edges e;
  rot_mesh_nesting n;
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(s), NULL, component, &e), ROT_OK);
  ROT_CHECK_EQ_INT(rot_mesh_check_nesting(shape_mesh(s), component, e.components, NULL, volume, &n),
                   ROT_OK);
  return n;
}

/* flipped, cavities, inverted, doubled, crossing, flat, zero area */
static void expect(const rot_mesh_nesting *n, const size_t want[7]) {
  const size_t got[7] = {(size_t)n->flipped, n->cavities, n->inverted,       n->doubled,
                         n->crossing,        n->flat,     n->zero_area_faces};
  for (int i = 0; i < 7; i++) ROT_CHECK_EQ_INT(got[i], want[i]);
  ROT_CHECK_EQ_INT(n->unchecked, 0);
}

#define EXPECT(s, ...)                                                                             \
  do {                                                                                             \
    const rot_mesh_nesting n_ = check(s);                                                          \
    expect(&n_, (const size_t[7])__VA_ARGS__);                                                     \
  } while (0)

static void add_cube(shape *s, double x, double half, int in) {
  const double lo[3] = {x - half, -half, -half}, hi[3] = {x + half, half, half};
  add_box(s, lo, hi, in);
}

static void flip_all(shape *s) {
  for (size_t i = 0; i < s->faces; i++) shape_flip(s, i);
}

static void test_nested(void) {
  shape s = shape_room(100, 200);
  add_cube(&s, 0.0, 1.0, 0);
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  ROT_CHECK_REL(volume[0], 8.0, 1e-15);
  flip_all(&s);
  EXPECT(&s, {1, 0, 0, 0, 0, 0, 0});
  ROT_CHECK_REL(volume[0], -8.0, 1e-15);
  flip_all(&s);
  add_cube(&s, 5.0, 0.5, 0); /* beside it */
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  add_cube(&s, 0.1, 0.75, 1); /* a cavity, an island in it, a cavity in that */
  EXPECT(&s, {0, 1, 0, 0, 0, 0, 0});
  ROT_CHECK_REL(volume[2], -3.375, 1e-15);
  add_cube(&s, 0.2, 0.5, 0);
  EXPECT(&s, {0, 1, 0, 0, 0, 0, 0});
  add_cube(&s, 0.3, 0.25, 1);
  EXPECT(&s, {0, 2, 0, 0, 0, 0, 0});
  flip_all(&s);
  EXPECT(&s, {1, 2, 0, 0, 0, 0, 0});
  shape_free(&s);
}

static void test_wrong(void) {
  shape s = shape_room(3000, 5000);
  add_cube(&s, 0.0, 1.0, 0);
  add_cube(&s, 5.0, 0.5, 1); /* inside out, beside */
  EXPECT(&s, {0, 0, 1, 0, 0, 0, 0});
  s.vertices = s.faces = 0;
  add_cube(&s, 0.0, 1.0, 0);
  add_cube(&s, 0.1, 0.5, 0); /* a body in a body */
  EXPECT(&s, {0, 0, 0, 1, 0, 0, 0});
  add_cube(&s, 0.1, 0.25, 1); /* and a cavity in both: what is left is still there once too often */
  EXPECT(&s, {0, 0, 0, 2, 0, 0, 0});
  s.vertices = s.faces = 0;
  add_cube(&s, 0.0, 1.0, 0);
  add_cube(&s, 0.1, 0.5, 1); /* a cavity in a cavity */
  add_cube(&s, 0.1, 0.25, 1);
  EXPECT(&s, {0, 1, 1, 0, 0, 0, 0});
  s.vertices = s.faces = 0;
  add_sphere(&s, 40, 20, 1.0, (const double[3]){0.0, 0.0, 0.0});
  add_sphere(&s, 40, 20, 1.0, (const double[3]){0.3, 0.9, 0.2});
  const rot_mesh_nesting crossing = check(&s);
  ROT_CHECK_EQ_INT(crossing.crossing, 2);
  s.vertices = s.faces = 0;
  add_cube(&s, 0.0, 1.0, 0);
  shape_vertex(&s, 9, 0, 0);
  shape_vertex(&s, 9, 1, 0);
  shape_vertex(&s, 9, 0, 1);
  shape_face(&s, 9, 10, 11);
  shape_face(&s, 9, 11, 10);
  EXPECT(&s, {0, 0, 0, 0, 0, 1, 0});
  s.xyz[3 * 10 + 1] = 3.0; /* the corners on a line */
  s.xyz[3 * 10 + 2] = 0.0;
  EXPECT(&s, {0, 0, 0, 0, 0, 1, 2});
  s.vertices = s.faces = 0; /* a sheet through a cube, before and after it, crosses nothing */
  for (int k = 0; k < 2; k++) {
    const double z = 0.3 * k;
    if (k) add_cube(&s, 0.0, 1.0, 0);
    const int i = shape_vertex(&s, 0.1, 0.2, z - 3.0), j = shape_vertex(&s, 0.2, 0.1, z + 3.0);
    const int last = shape_vertex(&s, 5.0, 0.3, z);
    shape_face(&s, i, j, last);
    shape_face(&s, i, last, j);
  }
  EXPECT(&s, {0, 0, 0, 0, 0, 2, 0});
  shape_free(&s);
}

/* Cubes in a row that touch face to face, at another scale; and one of 1e-100. */
static void test_touching(void) {
  shape s = shape_room(100, 200);
  for (int i = 0; i < 5; i++) add_cube(&s, 2.0 * i, 1.0, 0);
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  for (size_t i = 0; i < 3 * s.vertices; i++) s.xyz[i] *= 1e-100;
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  ROT_CHECK_REL(volume[3], 8e-300, 1e-13);
  shape_free(&s);
}

static void add_bar(shape *s, double x, double y, double z, int in) {
  const double lo[3] = {-x, -y, -z}, hi[3] = {x, y, z};
  add_box(s, lo, hi, in);
}

/* Parts of a few large faces: the middle of none lies in the other part. */
static void test_crossing_bars(void) {
  shape s = shape_room(100, 200);
  add_bar(&s, 0.5, 0.5, 0.5, 0);
  add_box(&s, (const double[3]){0.0, 0.0, 0.0}, (const double[3]){1.5, 1.5, 1.5}, 0);
  EXPECT(&s, {0, 0, 0, 0, 2, 0, 0});
  s.vertices = s.faces = 0;
  add_bar(&s, 100.0, 0.5, 0.5, 0); /* of one thickness: their upper faces lie in one plane */
  add_bar(&s, 0.5, 100.0, 0.5, 0);
  EXPECT(&s, {0, 0, 0, 0, 2, 0, 0});
  s.vertices = s.faces = 0;
  add_bar(&s, 2.0, 2.0, 2.0, 0); /* a shaft through the wall, wound as a cavity */
  add_box(&s, (const double[3]){1.9, -0.1, -0.1}, (const double[3]){9.0, 0.1, 0.1}, 1);
  EXPECT(&s, {0, 0, 0, 0, 2, 0, 0});
  s.vertices = s.faces = 0;
  add_bar(&s, 1.0, 3.0, 1.0, 0); /* against a longer one's side, the corners between its own */
  add_box(&s, (const double[3]){1.0, -1.0, -1.0}, (const double[3]){2.0, 1.0, 1.0}, 0);
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  /* Turned, so that they touch within rounding only. */
  for (size_t i = 0; i < s.vertices; i++) {
    double *p = s.xyz + 3 * i;
    const double x = p[0];
    p[0] = cos(0.7) * x - sin(0.7) * p[1];
    p[1] = sin(0.7) * x + cos(0.7) * p[1];
    p[2] += 0.3 * p[0];
  }
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  for (size_t i = 0; i < 3 * s.vertices; i++) s.xyz[i] = (double)(float)s.xyz[i];
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  shape_free(&s);
}

/* A part that is there twice touches its likeness with every face; so does one that fills a cavity,
 * which is legal. */
static void test_same_place(void) {
  shape s = shape_room(3000, 5000);
  add_cube(&s, 0.0, 1.0, 0);
  add_cube(&s, 0.0, 1.0, 0);
  EXPECT(&s, {0, 0, 0, 2, 0, 0, 0});
  s.vertices = s.faces = 0;
  add_sphere(&s, 20, 10, 1e-3, (const double[3]){5.0, 6.0, 7.0});
  add_sphere(&s, 20, 10, 1e-3, (const double[3]){5.0, 6.0, 7.0});
  flip_all(&s);
  EXPECT(&s, {1, 0, 0, 2, 0, 0, 0});
  s.vertices = s.faces = 0;
  /* The middle of a face on an edge of another, whose side rounding would choose. */
  add_box(&s, (const double[3]){0.0, 1.0, 1.0}, (const double[3]){2.0, 3.0, 4.0}, 0);
  add_box(&s, (const double[3]){2.0, 1.0, 2.0}, (const double[3]){3.0, 2.0, 5.0}, 0);
  for (size_t i = 0; i < 3 * s.vertices; i++) s.xyz[i] *= 0.1;
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  s.vertices = s.faces = 0;
  add_box(&s, (const double[3]){2.0, 2.0, 1.0}, (const double[3]){4.0, 5.0, 3.0}, 0);
  add_box(&s, (const double[3]){1.0, 1.0, 3.0}, (const double[3]){4.0, 4.0, 4.0}, 0);
  for (int turn = 0; turn < 20; turn++) { /* and on a corner */
    for (size_t i = 0; i < s.vertices; i++) {
      double *p = s.xyz + 3 * i;
      const double x = p[0], y = p[1], z = p[2];
      p[0] = cos(0.7) * x - sin(0.7) * y;
      p[1] = cos(0.3) * (sin(0.7) * x + cos(0.7) * y) - sin(0.3) * z;
      p[2] = sin(0.3) * (sin(0.7) * x + cos(0.7) * y) + cos(0.3) * z;
    }
    EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  }
  s.vertices = s.faces = 0;
  add_cube(&s, 0.0, 1.0, 0);
  add_cube(&s, 0.1, 0.5, 1);
  add_cube(&s, 0.1, 0.5, 0);
  EXPECT(&s, {0, 1, 0, 0, 0, 0, 0});
  flip_all(&s);
  EXPECT(&s, {1, 1, 0, 0, 0, 0, 0});
  s.vertices = s.faces = 0;
  add_cube(&s, 0.0, 1.0, 0);
  add_cube(&s, 0.1, 0.5, 1); /* a cavity that is there twice */
  add_cube(&s, 0.1, 0.5, 1);
  EXPECT(&s, {0, 0, 2, 0, 0, 0, 0});
  shape_free(&s);
}

/* Cubes that share faces, edges and corners within rounding, turned: none crosses another. */
static void test_voxels(void) {
  shape s = shape_room(600, 800);
  for (int i = 0; i < 64; i++) {
    const double at[3] = {0.1 * (i % 4), 0.1 * (i / 4 % 4), 0.1 * (i / 16)};
    add_box(&s, at, (const double[3]){at[0] + 0.1, at[1] + 0.1, at[2] + 0.1}, 0);
  }
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  for (size_t i = 0; i < s.vertices; i++) {
    double *p = s.xyz + 3 * i;
    const double x = p[0], y = p[1];
    p[0] = cos(0.7) * x - sin(0.7) * y;
    p[1] = sin(0.7) * x + cos(0.7) * y;
    p[2] += 0.3 * x - 0.4 * y;
  }
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  for (size_t i = 0; i < 3 * s.vertices; i++) s.xyz[i] = 2.0 * s.xyz[i] - 50.0;
  EXPECT(&s, {0, 0, 0, 0, 0, 0, 0});
  shape_free(&s);
}

/* A poll is asked for often enough, and each of them can end the work. */
typedef struct patience {
  long polls, last;
} patience;

static rot_status count_polls(void *ctx, double fraction) {
  patience *p = ctx;
  (void)fraction;
  return p->polls++ < p->last ? ROT_OK : ROT_EUNWIND;
}

static void test_stops(void) {
  /* Two tori through each other: each face of one is tested with each of the other. */
  shape s = shape_room(2 * 120 * 80, 4 * 120 * 80);
  add_torus(&s, 120, 80, 2.0, 0.75);
  const size_t from = s.vertices;
  add_torus(&s, 120, 80, 2.0, 0.75);
  for (size_t i = from; i < s.vertices; i++) s.xyz[3 * i] += 0.5;
  uint32_t *parts = malloc(s.faces * sizeof *parts);
  if (!parts) abort();
  rot_mesh_edges e;
  rot_mesh_nesting found;
  double size[2];
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), NULL, parts, &e), ROT_OK);
  ROT_CHECK_EQ_INT(e.components, 2);
  patience endless = {0, 1000000000L};
  const rot_hooks hooks = {count_polls, &endless};
  ROT_CHECK_EQ_INT(rot_mesh_check_nesting(shape_mesh(&s), parts, 2, &hooks, size, &found), ROT_OK);
  ROT_CHECK_EQ_INT(found.crossing, 2);
  ROT_CHECK(endless.polls > 5);
  for (long last = 0; last < endless.polls; last++) {
    patience short_of = {0, last};
    const rot_hooks ends = {count_polls, &short_of};
    ROT_CHECK_EQ_INT(rot_mesh_check_nesting(shape_mesh(&s), parts, 2, &ends, size, &found),
                     ROT_EUNWIND);
    ROT_CHECK_EQ_INT(short_of.polls, last + 1);
  }
  free(parts);
  shape_free(&s);
}

int main(void) {
  test_stops();
  test_voxels();
  test_crossing_bars();
  test_same_place();
  test_nested();
  test_wrong();
  test_touching();
  return rot_test_report("mesh_nesting");
}
