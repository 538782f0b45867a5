/* Bodies given by their vertices: a flat polygon, a tetrahedron. The centre of mass is found first,
 * relative to the first vertex, and the sums are taken about it: distance from the origin costs no
 * digits.
 *
 *     polygon      C = (M/A) sum_i d_i (a a' + b b' + (a + b)(a + b)')/24,  d_i = a x b,
 *                  a and b the ends of edge i, from the centre (Green)
 *     tetrahedron  C = (M/20) sum_i (v_i - g)(v_i - g)'
 *
 * Source: Steger, On the calculation of arbitrary moments of polygons (1996); Tonon, J. Math.
 * Stat. 1 (2005) 8. */
#ifndef ROT_VERTICES_H
#define ROT_VERTICES_H

#include <stddef.h>

#include "ground/status.h"

typedef enum rot_vertices_fault {
  ROT_VERTICES_FIT,
  ROT_VERTICES_FLAT,    /* area, or volume, zero within rounding */
  ROT_VERTICES_CROSSING /* two edges cross */
} rot_vertices_fault;

typedef struct rot_vertices_body {
  double mass_kg;
  double second_kg_m2[6]; /* about the centre of mass: xx, yy, zz, xy, xz, yz */
  double centre_m[3], reach_m;
  double measure; /* area or volume */
  double error;   /* bound of the second moment's error, relative to its trace */
  size_t edge[2]; /* the edges that cross: from these vertices to the next */
} rot_vertices_body;

/* `amount` is the mass, or the density of area or volume. Coordinates are finite. ROT_ENOMEM, or
 * ROT_EVALUE with *fault. */

/* n vertices in order, in either sense; vertex i is at (v[i], v[n + i]), the plate in z = 0. The
 * hooks' poll can end it. */
rot_status rot_polygon(size_t n, const double v[], double amount, int is_density,
                       const rot_hooks *hooks, rot_vertices_body *out, rot_vertices_fault *fault);

/* Vertex i is at (v[i], v[4 + i], v[8 + i]). */
rot_status rot_tetrahedron(const double v[12], double amount, int is_density,
                           rot_vertices_body *out, rot_vertices_fault *fault);

#endif
