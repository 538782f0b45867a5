/* Connected components of a closed mesh: volumes and nesting.
 *
 * The winding number of a component at a point is the sum of the solid angles of its faces, divided
 * by 4 pi. In a solid, the winding number of the others is 0 at a component oriented like the whole
 * mesh and 1 at a component oriented oppositely, a cavity. Any other number means a region counted
 * twice or negatively.
 *
 * Reference: van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125. */
#ifndef ROT_MESH_NESTING_H
#define ROT_MESH_NESTING_H

#include "body/mesh.h"

typedef struct rot_mesh_nesting {
  size_t zero_area_faces; /* corners collinear, within rounding */
  int flipped;            /* 1: the whole mesh is oriented inwards, its volume is negative */
  size_t cavities;        /* components oriented oppositely, inside another */
  size_t inverted;        /* components oriented oppositely, outside all others */
  size_t doubled;         /* oriented like the whole, inside another; or a winding number above 1 */
  size_t crossing;        /* components that intersect another */
  size_t flat;            /* components of zero volume, within rounding */
  size_t unchecked;       /* components beyond the work budget */
} rot_mesh_nesting;

/* (mesh, component from rot_mesh_check_edges()) => counts, volume[i]: signed volume of component i.
 * The mesh has no boundary, non-manifold or inconsistently oriented edges. Intersections are found
 * among up to 1e8 pairs of faces. The winding number is computed at up to 64 centroids of faces, or
 * at interior points if all of these touch other components. A component that intersects itself is
 * not detected. */
rot_status rot_mesh_check_nesting(const rot_mesh *mesh, const uint32_t component[],
                                  size_t components, const rot_hooks *hooks, double volume[],
                                  rot_mesh_nesting *out);

#endif
