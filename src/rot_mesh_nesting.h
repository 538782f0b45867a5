/* The components of a closed mesh: their volumes, and which lie inside which.
 *
 * How often the components around a point enclose it is the sum of the solid angles of their faces
 * over 4 pi. A solid has 0 around a component wound as the whole is, and 1 around one wound the
 * other way, a cavity: anything else would fill a place twice or less than not at all.
 *
 * Reference: van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125. */
#ifndef ROT_MESH_NESTING_H
#define ROT_MESH_NESTING_H

#include "rot_mesh.h"

typedef struct rot_mesh_nesting {
  size_t zero_area_faces; /* corners on a line, within rounding */
  int flipped;            /* the whole is wound inwards: the volume is negative */
  size_t cavities;        /* wound against the whole, inside of it */
  size_t inverted;        /* wound against the whole, and inside of nothing */
  size_t doubled;         /* wound as the whole, inside of it; or more than one way around */
  size_t crossing;        /* a face goes through one of another */
  size_t flat;            /* without a volume beyond rounding */
  size_t unchecked;       /* not looked at: it would have taken too long */
} rot_mesh_nesting;

/* `component` from rot_mesh_check_edges(), of a mesh without open, mis-wound or crowded edges.
 * volume[i] is that of component i, with its sign. Parts that cross are found by their faces, up to
 * 1e8 pairs of these. Where a part lies is tried at up to 64 points, the middles of its faces, or
 * from its inside where all of these touch others. One that crosses itself is not found. */
rot_status rot_mesh_check_nesting(const rot_mesh *mesh, const uint32_t component[],
                                  size_t components, const rot_hooks *hooks, double volume[],
                                  rot_mesh_nesting *out);

#endif
