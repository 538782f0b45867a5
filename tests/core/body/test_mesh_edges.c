/* Each defect put into a sound mesh must be the one that is counted, and nothing else. */
#include "mesh_shapes.h"
#include "body/mesh_edges.h"
#include "rot_test.h"

enum { MAX = 3000 };

static uint32_t component[MAX];
static const double low[3] = {0.0, 0.0, 0.0}, high[3] = {1.0, 2.0, 3.0};

static rot_mesh_edges check(shape *s) {
  rot_mesh_edges e;
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(s), NULL, component, &e), ROT_OK);
  return e;
}

/* open, miswound, crowded, touching, degenerate, duplicate, unused, components */
static void expect(const rot_mesh_edges *e, size_t edges, const size_t want[8]) {
  const size_t got[8] = {e->open_edges,      e->miswound_edges,   e->crowded_edges,
                         e->touching_edges,  e->degenerate_faces, e->duplicate_faces,
                         e->unused_vertices, e->components};
  ROT_CHECK_EQ_INT(e->edges, edges);
  for (int i = 0; i < 8; i++) ROT_CHECK_EQ_INT(got[i], want[i]);
}

#define EXPECT(s, edges, ...)                                                                      \
  do {                                                                                             \
    const rot_mesh_edges e_ = check(s);                                                            \
    expect(&e_, edges, (const size_t[8])__VA_ARGS__);                                              \
  } while (0)

static shape box(void) {
  shape s = shape_room(40, 60);
  add_box(&s, low, high, 0);
  return s;
}

static void test_sound(void) {
  shape s = shape_room(1000, 2400);
  add_torus(&s, 30, 20, 2.0, 0.75);
  EXPECT(&s, 1800, {0, 0, 0, 0, 0, 0, 0, 1});
  add_sphere(&s, 10, 8, 1.0, low); /* 140 faces, 210 edges, nothing in common */
  EXPECT(&s, 2010, {0, 0, 0, 0, 0, 0, 0, 2});
  ROT_CHECK(component[0] == 0 && component[1199] == 0 && component[1200] == 1);
  for (size_t i = 0; i < s.faces; i++) shape_flip(&s, i);
  EXPECT(&s, 2010, {0, 0, 0, 0, 0, 0, 0, 2});
  shape_free(&s);
}

static void test_defects(void) {
  shape s = box();
  EXPECT(&s, 18, {0, 0, 0, 0, 0, 0, 0, 1});
  s.faces--; /* a hole */
  EXPECT(&s, 18, {3, 0, 0, 0, 0, 0, 0, 1});
  s.faces++;
  shape_flip(&s, 4);
  EXPECT(&s, 18, {0, 3, 0, 0, 0, 0, 0, 1});
  shape_flip(&s, 4);
  const int *f = s.corner + 3 * 7;
  shape_face(&s, f[1], f[2], f[0]); /* a face once more, from another corner */
  EXPECT(&s, 18, {0, 0, 3, 0, 0, 1, 0, 1});
  s.faces--;
  shape_face(&s, f[0], f[2], f[1]); /* and the other way around */
  EXPECT(&s, 18, {0, 0, 3, 0, 0, 1, 0, 1});
  s.faces--;
  shape_face(&s, f[0], f[1], f[0]); /* bounds nothing */
  EXPECT(&s, 18, {0, 0, 0, 0, 1, 0, 0, 1});
  ROT_CHECK(component[12] == ROT_NO_COMPONENT);
  s.faces--;
  shape_vertex(&s, 7, 7, 7);
  EXPECT(&s, 18, {0, 0, 0, 0, 0, 0, 1, 1});
  /* A fin: one edge with a third face, two of the fin's own. */
  shape_face(&s, f[0], f[1], 9);
  EXPECT(&s, 20, {2, 0, 1, 0, 0, 0, 0, 1});
  shape_free(&s);
}

static void test_twice(void) {
  shape s = box();
  /* The whole body twice: each edge twice in either direction, each face a duplicate. */
  for (size_t i = 0; i < 12; i++) {
    const int *f = s.corner + 3 * i;
    shape_face(&s, f[0], f[1], f[2]);
  }
  EXPECT(&s, 18, {0, 0, 0, 18, 0, 12, 0, 1});
  /* A sheet of two faces back to back; the same with both sides alike. */
  s.vertices = s.faces = 0;
  for (int i = 0; i < 3; i++) shape_vertex(&s, i, i * i, 1);
  shape_face(&s, 1, 2, 3);
  shape_face(&s, 2, 1, 3);
  EXPECT(&s, 3, {0, 0, 0, 0, 0, 1, 0, 1});
  shape_flip(&s, 1);
  EXPECT(&s, 3, {0, 3, 0, 0, 0, 1, 0, 1});
  shape_free(&s);
}

/* Two boxes that share an edge; at a vertex alone they are two. */
static void test_touching(void) {
  static const double far[3] = {-1.0, -2.0, 3.0}, corner[3] = {-1.0, -2.0, -3.0};
  shape s = box();
  uint32_t same[16];
  add_box(&s, (const double[3]){far[0], far[1], 0.0}, (const double[3]){0.0, 0.0, far[2]}, 0);
  for (uint32_t i = 0; i < 16; i++) {
    same[i] = i;
    for (uint32_t j = 0; j < i; j++) {
      if (memcmp(s.xyz + 3 * i, s.xyz + 3 * j, 24) == 0) same[i] = j;
    }
  }
  EXPECT(&s, 36, {0, 0, 0, 0, 0, 0, 0, 2});
  s.mesh.same = same;
  EXPECT(&s, 35, {0, 0, 0, 1, 0, 0, 0, 1});
  s.vertices = s.faces = 0;
  add_box(&s, low, high, 0);
  add_box(&s, corner, low, 0);
  for (uint32_t i = 0; i < 16; i++) same[i] = i == 15 ? 0 : i;
  EXPECT(&s, 36, {0, 0, 0, 0, 0, 0, 0, 2});
  shape_free(&s);
}

/* A vertex with very many faces, and very many faces on one edge: still linear. */
static void test_crowd(void) {
  enum { N = 200000 };
  shape s = shape_room(N + 2, 2 * N);
  rot_mesh_edges e;
  uint32_t *parts = malloc(2 * N * sizeof *parts);
  if (!parts) abort();
  shape_vertex(&s, 0, 0, 1);
  shape_vertex(&s, 0, 0, -1);
  for (int i = 0; i < N; i++) shape_vertex(&s, cos(i), sin(i), 0);
  for (int i = 0; i < N; i++) {
    const int a = 3 + i, b = 3 + (i + 1) % N;
    shape_face(&s, 1, a, b);
    shape_face(&s, 2, b, a);
  }
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), NULL, parts, &e), ROT_OK);
  expect(&e, 3 * N, (const size_t[8]){0, 0, 0, 0, 0, 0, 0, 1});
  s.faces = 0;
  for (int i = 0; i < N; i++) shape_face(&s, 1, 2, 3 + i); /* the pages of a book */
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), NULL, parts, &e), ROT_OK);
  expect(&e, 2 * N + 1, (const size_t[8]){2 * N, 0, 1, 0, 0, 0, 0, 1});
  free(parts);
  shape_free(&s);
}

static rot_status stop(void *ctx, double fraction) {
  (void)ctx;
  (void)fraction;
  return ROT_EUNWIND;
}

static void test_refuses(void) {
  const rot_hooks hooks = {stop, NULL};
  shape s = box();
  rot_mesh_edges e;
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), &hooks, component, &e), ROT_EUNWIND);
  s.corner[0] = 9;
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), NULL, component, &e), ROT_EVALUE);
  s.corner[0] = -1;
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), NULL, component, &e), ROT_EVALUE);
  s.corner[0] = 1;
  s.xyz[0] = NAN;
  ROT_CHECK_EQ_INT(rot_mesh_check_edges(shape_mesh(&s), NULL, component, &e), ROT_EVALUE);
  s.vertices = s.faces = 0;
  EXPECT(&s, 0, {0, 0, 0, 0, 0, 0, 0, 0});
  shape_free(&s);
}

int main(void) {
  test_sound();
  test_defects();
  test_twice();
  test_touching();
  test_crowd();
  test_refuses();
  return rot_test_report("mesh_edges");
}
