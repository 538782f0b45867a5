/* Meshes to try: boxes, tori and spheres with their faces outwards, put together in one list. */
#ifndef MESH_SHAPES_H
#define MESH_SHAPES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body/mesh.h"

typedef struct shape {
  size_t vertices, faces;
  double *xyz; /* x, y, z of each vertex */
  int *corner; /* three of each face */
  rot_mesh mesh;
} shape;

static inline shape shape_room(size_t vertices, size_t faces) {
  shape s = {0,
             0,
             malloc(3 * vertices * sizeof(double) + 1),
             malloc(3 * faces * sizeof(int) + 1),
             {0, 0, NULL, 3, 1, NULL, 3, 1, NULL, NULL}};
  if (!s.xyz || !s.corner) abort();
  return s;
}

static inline void shape_free(shape *s) {
  free(s->xyz);
  free(s->corner);
}

/* Call after the last change. */
static inline const rot_mesh *shape_mesh(shape *s) {
  s->mesh.vertices = s->vertices;
  s->mesh.faces = s->faces;
  s->mesh.xyz = s->xyz;
  s->mesh.corner = s->corner;
  return &s->mesh;
}

static inline int shape_vertex(shape *s, double x, double y, double z) {
  double *at = s->xyz + 3 * s->vertices;
  at[0] = x;
  at[1] = y;
  at[2] = z;
  return (int)++s->vertices;
}

static inline void shape_face(shape *s, int a, int b, int c) {
  int *at = s->corner + 3 * s->faces++;
  at[0] = a;
  at[1] = b;
  at[2] = c;
}

/* 8 vertices, 12 faces; inwards where `in`. */
static inline void add_box(shape *s, const double lo[3], const double hi[3], int in) {
  static const int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  int v[8];
  for (int i = 0; i < 8; i++) {
    v[i] = shape_vertex(s, i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]);
  }
  for (int i = 0; i < 6; i++) {
    const int *q = sides[i];
    shape_face(s, v[q[0]], v[q[in ? 2 : 1]], v[q[in ? 1 : 2]]);
    shape_face(s, v[q[0]], v[q[in ? 3 : 2]], v[q[in ? 2 : 3]]);
  }
}

/* n x m vertices, 2 n m faces. */
static inline void add_torus(shape *s, int n, int m, double ring, double tube) {
  const double turn = 2.0 * 3.14159265358979323846;
  const int first = (int)s->vertices + 1;
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < m; j++) {
      const double u = turn * i / n, v = turn * j / m, r = ring + tube * cos(v);
      shape_vertex(s, r * cos(u), r * sin(u), tube * sin(v));
    }
  }
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < m; j++) {
      const int a = first + i * m + j, b = first + (i + 1) % n * m + j;
      const int c = first + (i + 1) % n * m + (j + 1) % m, d = first + i * m + (j + 1) % m;
      shape_face(s, a, b, c);
      shape_face(s, a, c, d);
    }
  }
}

/* 2 + (rings - 1) n vertices, 2 n (rings - 1) faces. */
static inline void add_sphere(shape *s, int n, int rings, double radius, const double at[3]) {
  const double pi = 3.14159265358979323846;
  const int south = shape_vertex(s, at[0], at[1], at[2] - radius);
  const int north = shape_vertex(s, at[0], at[1], at[2] + radius), first = north + 1;
  for (int i = 1; i < rings; i++) {
    for (int j = 0; j < n; j++) {
      const double v = pi * i / rings, u = 2.0 * pi * j / n;
      shape_vertex(s, at[0] + radius * sin(v) * cos(u), at[1] + radius * sin(v) * sin(u),
                   at[2] - radius * cos(v));
    }
  }
  for (int j = 0; j < n; j++) {
    const int k = (j + 1) % n, last = first + (rings - 2) * n;
    shape_face(s, south, first + k, first + j);
    shape_face(s, north, last + j, last + k);
    for (int i = 0; i + 2 < rings; i++) {
      const int low = first + i * n, high = low + n;
      shape_face(s, low + j, low + k, high + k);
      shape_face(s, low + j, high + k, high + j);
    }
  }
}

/* A generator for tests: the same numbers everywhere, in (-1, 1). */
static inline double shape_random(uint64_t *state) {
  *state = *state * 6364136223846793005U + 1442695040888963407U;
  return (double)(int64_t)(*state >> 11) * 0x1p-52 - 1.0;
}

static inline void shape_roughen(shape *s, double by, uint64_t seed) {
  for (size_t i = 0; i < 3 * s->vertices; i++) s->xyz[i] += by * shape_random(&seed);
}

static inline void shape_move(shape *s, double by) {
  for (size_t i = 0; i < 3 * s->vertices; i++) s->xyz[i] += by;
}

static inline void shape_flip(shape *s, size_t face) {
  const int b = s->corner[3 * face + 1];
  s->corner[3 * face + 1] = s->corner[3 * face + 2];
  s->corner[3 * face + 2] = b;
}

#endif
