/* Merges coincident vertices: files of separate triangles (STL) repeat a vertex in each face. */
#ifndef ROT_MESH_WELD_H
#define ROT_MESH_WELD_H

#include "body/mesh.h"

/* mesh => same[i], *merged: number of vertices replaced. same[i] is the first vertex with the
 * coordinates of vertex i (-0 equals 0), or the first kept vertex within `tolerance` of it in each
 * coordinate. Coordinates are finite; mesh->same is ignored. ROT_EVALUE for a tolerance below 2^-52
 * of the largest coordinate or not finite, or for more than 2^31 - 1 vertices. */
rot_status rot_mesh_weld(const rot_mesh *mesh, double tolerance, const rot_hooks *hooks,
                         uint32_t same[], size_t *merged);

#endif
