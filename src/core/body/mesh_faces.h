/* A mesh of triangles: its vertices, and the corners of its faces. */
#ifndef ROT_MESH_FACES_H
#define ROT_MESH_FACES_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"

/* Coordinate k of vertex i is xyz[i * vertex_step + k * axis_step]; corner k of face i is
 * corner[i * face_step + k * corner_step], a vertex index from 1. */
typedef struct rot_mesh {
  size_t vertices, faces;
  const double *xyz;
  size_t vertex_step, axis_step;
  const int *corner;
  size_t face_step, corner_step;
  /* For each vertex, the vertex (from 0) that replaces it after welding; NULL: itself. */
  const uint32_t *same;
  /* For each vertex, whether a face uses it; NULL: all. The others do not affect bounds and
   * reach. */
  const unsigned char *used;
} rot_mesh;

static inline double rot_mesh_at(const rot_mesh *mesh, size_t vertex, size_t axis) {
  return mesh->xyz[vertex * mesh->vertex_step + axis * mesh->axis_step];
}

/* The vertex at a corner, from 0. */
static inline size_t rot_mesh_corner(const rot_mesh *mesh, size_t face, size_t k) {
  const size_t i = (size_t)mesh->corner[face * mesh->face_step + k * mesh->corner_step] - 1;
  return mesh->same ? mesh->same[i] : i;
}

#endif
