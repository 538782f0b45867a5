/* Bodies given by vertices: plane polygon, tetrahedron. The centre of mass is computed first,
 * relative to the first vertex; the sums are about it, so a distant origin causes no loss of
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
  double centre_m[3];
  double reach_m; /* from the centre of mass to the farthest vertex */
  double measure; /* area or volume, m^2 or m^3 */
  double error;   /* bound of the second moment's error, relative to its trace */
  size_t edge[2]; /* first vertices of the edges that cross */
} rot_vertices_body;

/* (n finite vertices in order, in either sense; mass or areal density `amount`) => plate in z = 0.
 * Vertex i is at (v[i], v[n + i]). ROT_ENOMEM, ROT_EVALUE with *fault, or the status of a poll. */
rot_status rot_polygon(size_t n, const double v[], double amount, int is_density,
                       const rot_hooks *hooks, rot_vertices_body *out, rot_vertices_fault *fault);

/* (4 finite vertices, mass or density `amount`) => solid. Vertex i is at (v[i], v[4 + i],
 * v[8 + i]). ROT_EVALUE with *fault. */
rot_status rot_tetrahedron(const double v[12], double amount, int is_density,
                           rot_vertices_body *out, rot_vertices_fault *fault);

#endif
