/* The connected components of a closed mesh: their volumes, and which lie inside which.
 *
 * The winding number of a component at a point is the sum of the solid angles of its faces over
 * 4 pi. In a solid, the other components have winding number 0 at a component oriented like the
 * whole mesh, and 1 at one oriented the other way, a cavity; any other number counts a region
 * twice, or negatively.
 *
 * Reference: van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125. */
#ifndef ROT_MESH_NESTING_H
#define ROT_MESH_NESTING_H

#include "body/mesh.h"

typedef struct rot_mesh_nesting {
  size_t zero_area_faces; /* corners collinear, within rounding */
  int flipped;            /* the whole mesh is oriented inwards: its volume is negative */
  size_t cavities;        /* oriented against the whole, inside of it */
  size_t inverted;        /* oriented against the whole, inside of nothing */
  size_t doubled;         /* oriented like the whole, inside of it; or a winding number above 1 */
  size_t crossing;        /* a face intersects one of another component */
  size_t flat;            /* volume zero within rounding */
  size_t unchecked;       /* the work budget was used up */
} rot_mesh_nesting;

/* `component` from rot_mesh_check_edges(), of a mesh without boundary, non-manifold or
 * inconsistently oriented edges. volume[i] is the signed volume of component i. Components that
 * intersect are found from up to 1e8 pairs of faces. The winding number is computed at up to 64
 * points, the centroids of faces, or at interior points where all of these touch other components.
 * A component that intersects itself is not detected. */
rot_status rot_mesh_check_nesting(const rot_mesh *mesh, const uint32_t component[],
                                  size_t components, const rot_hooks *hooks, double volume[],
                                  rot_mesh_nesting *out);

#endif
