/* Checks that a mesh bounds a solid: two faces use each edge, in opposite directions.
 *
 * The uses of edges are sorted into buckets by lower vertex; each bucket is counted with a slot for
 * each upper vertex. Time and memory are linear in the number of faces, and access is local for
 * meshes with local numbering. */
#ifndef ROT_MESH_EDGES_H
#define ROT_MESH_EDGES_H

#include "body/mesh.h"

typedef struct rot_mesh_edges {
  size_t edges;            /* all */
  size_t open_edges;       /* boundary edges: used once */
  size_t miswound_edges;   /* inconsistently oriented: used twice in the same direction */
  size_t crowded_edges;    /* non-manifold: used more than twice, directions not balanced */
  size_t touching_edges;   /* non-manifold: directions balanced, components meet along the edge */
  size_t degenerate_faces; /* with a vertex twice; ignored */
  size_t duplicate_faces;  /* with the vertices of an earlier face */
  size_t unused_vertices;
  size_t components; /* sets of faces connected by shared edges */
} rot_mesh_edges;

#define ROT_NO_COMPONENT UINT32_MAX

/* mesh => counts, component[face]: index from 0 in the order of the first faces, ROT_NO_COMPONENT
 * for a degenerate face. ROT_EVALUE for invalid entries (rot_mesh_check_entries()) or more than
 * 2^31 - 1 faces; ROT_ENOMEM, ROT_EUNWIND. */
rot_status rot_mesh_check_edges(const rot_mesh *mesh, const rot_hooks *hooks, uint32_t component[],
                                rot_mesh_edges *out);

#endif
