/* Second moment, mass and centre of a body from a mesh of triangles: of the solid inside a closed
 * mesh, or of the surface.
 *
 * A triangle a, b, c and the origin span a tetrahedron of signed volume d/6, and the sum over all
 * faces is the integral over the solid. With n = (b - a) x (c - a), d = a . n, s = a + b + c:
 *
 *   solid:   V = sum d/6      V g = sum d s/24      C = sum d (s s' + a a' + b b' + c c')/120
 *   surface: A = sum |n|/2    A g = sum |n| s/6     C = sum |n| (s s' + a a' + b b' + c c')/24
 *
 * a is relative to the centre of the bounding box and n is computed from the edges, so neither a
 * distant origin nor small faces cause a loss of digits.
 *
 * Reference: Tonon, J. Math. Stat. 1 (2005) 8; Blow & Binstock, How to find the inertia tensor (or
 * other mass properties) of a 3D solid body represented by a triangle mesh (2004). */
#ifndef ROT_MESH_H
#define ROT_MESH_H

#include "body/mesh_faces.h"
#include "ground/status.h"

/* => n * size bytes, at least 1; NULL also if the product overflows */
void *rot_mesh_alloc(size_t n, size_t size);

/* Invalid entries: no other check is possible. */
typedef struct rot_mesh_entries {
  size_t bad_vertices; /* with a coordinate that is not finite */
  size_t bad_faces;    /* with a corner that is not a vertex */
} rot_mesh_entries;

/* mesh => counts of invalid entries */
rot_mesh_entries rot_mesh_check_entries(const rot_mesh *mesh);

/* valid mesh => used[i] = 1 for vertices of faces, 0 for others; returns the number of others */
size_t rot_mesh_mark_used(const rot_mesh *mesh, unsigned char used[]);

/* Bounding box of the vertices in use. */
typedef struct rot_mesh_box {
  double lo[3], hi[3], centre[3];
  int exponent; /* the largest half side is in [0.5, 1) 2^exponent */
} rot_mesh_box;

/* The mesh with welded corners resolved, scaled by 2^-exponent if squares and cubes of its size
 * would over- or underflow. */
typedef struct rot_mesh_tamed {
  rot_mesh mesh;
  rot_mesh_box box;
  int exponent; /* 0 without scaling */
  double *xyz;  /* scaled coordinates, or NULL */
  int *corner;  /* resolved corners, or NULL */
} rot_mesh_tamed;

/* mesh => tame. ROT_EVALUE for invalid entries or no face, ROT_ENOMEM; to be freed in each case. */
rot_status rot_mesh_tame(const rot_mesh *mesh, rot_mesh_tamed *tame);
/* Frees the copies. */
void rot_mesh_tame_free(rot_mesh_tamed *tame);

typedef struct rot_mesh_moments {
  double size;             /* signed volume, or area */
  double size_error;       /* bound, relative */
  double centre[3];        /* of mass */
  double second_moment[6]; /* about the centre, per unit of mass: xx, yy, zz, xy, xz, yz */
  double error;            /* bound of its rounding error, relative to its trace */
  double coordinate_error; /* the same for half an ulp of each coordinate */
  double moved_error;      /* the same for vertices moved by 1 in each coordinate, to first order */
  double reach;            /* from the centre to the farthest vertex */
  double area;
  double closure;      /* |sum of the area vectors|/area: 0 within rounding for a closed mesh */
  double lo[3], hi[3]; /* bounding box */
} rot_mesh_moments;

/* closed mesh (not checked here: body/mesh_edges.h) => moments of the solid. ROT_ERANGE if the
 * volume is zero within rounding; ROT_EVALUE, ROT_ENOMEM, ROT_EUNWIND. */
rot_status rot_mesh_solid(const rot_mesh *mesh, const rot_hooks *hooks, rot_mesh_moments *out);
/* mesh => moments of the surface, of uniform areal density. ROT_ERANGE for zero area. */
rot_status rot_mesh_shell(const rot_mesh *mesh, const rot_hooks *hooks, rot_mesh_moments *out);

#endif
