/* Whether a mesh bounds a solid: each edge must be used once in either direction.
 *
 * The uses of the edges are put into one bucket for each lower vertex, and a bucket is counted with
 * a place for each other vertex: time and memory are linear in the faces whatever they are, and
 * what lies together in the mesh lies together in memory. */
#ifndef ROT_MESH_EDGES_H
#define ROT_MESH_EDGES_H

#include "rot_mesh.h"

typedef struct rot_mesh_edges {
  size_t edges;
  size_t open_edges;       /* used once */
  size_t miswound_edges;   /* used twice, both in the same direction */
  size_t crowded_edges;    /* used more than twice, not as often in one direction as in the other */
  size_t touching_edges;   /* used more than twice, as often in either: parts meet along the edge */
  size_t degenerate_faces; /* with a vertex twice; they bound nothing and are left out */
  size_t duplicate_faces;  /* with the vertices of an earlier one */
  size_t unused_vertices;
  size_t components; /* of faces that hang together by edges */
} rot_mesh_edges;

#define ROT_NO_COMPONENT UINT32_MAX

/* component[face] counts from 0 in the order of their first faces; ROT_NO_COMPONENT for a
 * degenerate face. ROT_EVALUE for bad entries (rot_mesh_check_entries()) or more than 2^31 - 1
 * faces; ROT_ENOMEM, ROT_EUNWIND. */
rot_status rot_mesh_check_edges(const rot_mesh *mesh, const rot_hooks *hooks, uint32_t component[],
                                rot_mesh_edges *out);

#endif
