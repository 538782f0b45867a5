/* A mesh of triangles: vertices, corners of faces. */
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
  /* Vertex (from 0) that replaces each vertex after welding; NULL: itself. */
  const uint32_t *same;
  /* 1 for vertices of faces, NULL: all; other vertices do not affect bounds and reach. */
  const unsigned char *used;
} rot_mesh;

/* (vertex, axis) => coordinate */
static inline double rot_mesh_at(const rot_mesh *mesh, size_t vertex, size_t axis) {
  return mesh->xyz[vertex * mesh->vertex_step + axis * mesh->axis_step];
}

/* (face, corner k) => vertex, from 0 */
static inline size_t rot_mesh_corner(const rot_mesh *mesh, size_t face, size_t k) {
  const size_t i = (size_t)mesh->corner[face * mesh->face_step + k * mesh->corner_step] - 1;
  return mesh->same ? mesh->same[i] : i;
}

#endif
