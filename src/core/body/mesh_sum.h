/* Kernel of body/mesh.c: sums over faces. Compiled there for registers of two doubles, in
 * body/mesh_sum.c for registers of four.
 *
 * Face i belongs to lane i mod 4 for either width, and each lane is summed separately, so results
 * do not depend on the width. Terms are added in blocks; the sums of blocks are compensated, so the
 * error does not grow with the number of faces. */
#ifndef ROT_MESH_SUM_H
#define ROT_MESH_SUM_H

#include "body/mesh_faces.h"
#include "ground/pair.h"

enum { ROT_MESH_LANES = 4, ROT_MESH_STEPS = 8, ROT_MESH_BLOCK = ROT_MESH_LANES * ROT_MESH_STEPS };

/* The sums; n, s, q as in body/mesh.h, w is d (solid) or |n| (surface). */
enum {
  SIZE,                   /* w */
  FIRST,                  /* w s */
  SECOND = FIRST + 3,     /* w q: xx, yy, zz, xy, xz, yz */
  AREA = SECOND + 6,      /* |n|; only of the solid */
  NORMAL,                 /* n */
  EXACT = NORMAL + 3,     /* the sums before this are compensated */
  GROSS_SIZE = EXACT,     /* w from absolute values of its terms */
  GROSS_SECOND,           /* w tr q from absolute values */
  FLUX,                   /* for each axis: |n| of the solid, edge lengths of the surface */
  FLUX_SECOND = FLUX + 3, /* the same times the squared distance */
  SUMS = FLUX_SECOND + 3
};

typedef struct rot_mesh_sums {
  const double *centre; /* origin of a, b, c */
  double total[SUMS][ROT_MESH_LANES];
  double lost[EXACT][ROT_MESH_LANES]; /* rounding errors of `total` */
} rot_mesh_sums;

typedef struct mesh_corners {
  rot_pair a[3], b[3], c[3];
} mesh_corners;

/* A register of f(lane), without store and load. */
#ifdef ROT_SIMD
#define ROT_EACH(f) ((rot_pair){f(0), f(1), f(2), f(3)})
#elif defined(__GNUC__)
#define ROT_EACH(f) ((rot_pair){f(0), f(1)})
#else
#define ROT_EACH(f) (f(0))
#endif

/* Addresses of the mesh, with resolved corners; a copy, which the sums cannot alias. */
typedef struct mesh_source {
  const double *x, *y, *z;
  const int *corner[3];
  size_t vertex_step, face_step;
  rot_pair centre[3];
} mesh_source;

/* => addresses of the mesh, origin `centre` */
ROT_INLINE mesh_source open_source(const rot_mesh *mesh, const double centre[3]) {
  const double *x = mesh->xyz;
  const int *c = mesh->corner;
  const mesh_source source = {x,
                              x + mesh->axis_step,
                              x + 2 * mesh->axis_step,
                              {c, c + mesh->corner_step, c + 2 * mesh->corner_step},
                              mesh->vertex_step,
                              mesh->face_step,
                              {ROT_BOTH(centre[0]), ROT_BOTH(centre[1]), ROT_BOTH(centre[2])}};
  return source;
}

/* => corner k of ROT_PAIR faces; faces from `end` on become a point, which adds 0 */
ROT_INLINE void load_corner(const mesh_source *from, size_t face, size_t end, int k, int whole,
                            rot_pair to[3]) {
  size_t at[ROT_PAIR];
  for (size_t lane = 0; lane < ROT_PAIR; lane++) {
    const size_t one = whole || face + lane < end ? face + lane : end - 1;
    at[lane] = (size_t)from->corner[k][one * from->face_step] - 1;
    at[lane] *= from->vertex_step;
  }
#define X(lane) (from->x[at[lane]])
#define Y(lane) (from->y[at[lane]])
#define Z(lane) (from->z[at[lane]])
  to[0] = ROT_EACH(X) - from->centre[0];
  to[1] = ROT_EACH(Y) - from->centre[1];
  to[2] = ROT_EACH(Z) - from->centre[2];
#undef X
#undef Y
#undef Z
  if (whole) return;
#define IN(lane) (face + lane < end ? 1.0 : 0.0)
  const rot_pair in = ROT_EACH(IN);
#undef IN
  to[0] *= in;
  to[1] *= in;
  to[2] *= in;
}

/* Quantities of a face for solids and surfaces. */
typedef struct mesh_face {
  rot_pair n[3];     /* twice the area, along the normal */
  rot_pair m[3];     /* the same from absolute values */
  rot_pair s[3];     /* a + b + c */
  rot_pair q[6];     /* s s' + a a' + b b' + c c' */
  rot_pair trace;    /* of q */
  rot_pair edges[3]; /* |b - a| + |c - a|, axis by axis */
  rot_pair square;   /* n . n */
} mesh_face;

/* corners => quantities of the faces */
ROT_INLINE void see_face(const mesh_corners *v, mesh_face *f) {
  const rot_pair ux = v->b[0] - v->a[0], uy = v->b[1] - v->a[1], uz = v->b[2] - v->a[2];
  const rot_pair wx = v->c[0] - v->a[0], wy = v->c[1] - v->a[1], wz = v->c[2] - v->a[2];
  const rot_pair yz = uy * wz, zy = uz * wy, zx = uz * wx, xz = ux * wz, xy = ux * wy, yx = uy * wx;
  f->n[0] = yz - zy;
  f->n[1] = zx - xz;
  f->n[2] = xy - yx;
  f->m[0] = rot_pair_abs(yz) + rot_pair_abs(zy);
  f->m[1] = rot_pair_abs(zx) + rot_pair_abs(xz);
  f->m[2] = rot_pair_abs(xy) + rot_pair_abs(yx);
  /* s s' + a a' + b b' + c c' = sum of p p' over the sums p of two corners: three products instead
   * of four, and no square of a sum that cancels. */
  const rot_pair px = v->a[0] + v->b[0], py = v->a[1] + v->b[1], pz = v->a[2] + v->b[2];
  const rot_pair qx = v->b[0] + v->c[0], qy = v->b[1] + v->c[1], qz = v->b[2] + v->c[2];
  const rot_pair rx = v->c[0] + v->a[0], ry = v->c[1] + v->a[1], rz = v->c[2] + v->a[2];
  f->s[0] = px + v->c[0];
  f->s[1] = py + v->c[1];
  f->s[2] = pz + v->c[2];
  f->q[0] = px * px + qx * qx + rx * rx;
  f->q[1] = py * py + qy * qy + ry * ry;
  f->q[2] = pz * pz + qz * qz + rz * rz;
  f->q[3] = px * py + qx * qy + rx * ry;
  f->q[4] = px * pz + qx * qz + rx * rz;
  f->q[5] = py * pz + qy * qz + ry * rz;
  f->trace = f->q[0] + f->q[1] + f->q[2];
  f->edges[0] = rot_pair_abs(ux) + rot_pair_abs(wx);
  f->edges[1] = rot_pair_abs(uy) + rot_pair_abs(wy);
  f->edges[2] = rot_pair_abs(uz) + rot_pair_abs(wz);
  f->square = f->n[0] * f->n[0] + f->n[1] * f->n[1] + f->n[2] * f->n[2];
}

/* Adds faces of weight w to the compensated sums. */
ROT_INLINE void add_weighted(rot_pair sum[], const mesh_face *f, rot_pair w) {
  sum[SIZE] += w;
  sum[FIRST] += w * f->s[0];
  sum[FIRST + 1] += w * f->s[1];
  sum[FIRST + 2] += w * f->s[2];
  sum[SECOND] += w * f->q[0];
  sum[SECOND + 1] += w * f->q[1];
  sum[SECOND + 2] += w * f->q[2];
  sum[SECOND + 3] += w * f->q[3];
  sum[SECOND + 4] += w * f->q[4];
  sum[SECOND + 5] += w * f->q[5];
  sum[NORMAL] += f->n[0];
  sum[NORMAL + 1] += f->n[1];
  sum[NORMAL + 2] += f->n[2];
}

/* Adds x, y, z and w times x, y, z to the sums for displacements. */
ROT_INLINE void add_flux(rot_pair sum[], rot_pair x, rot_pair y, rot_pair z, rot_pair w) {
  sum[FLUX] += x;
  sum[FLUX + 1] += y;
  sum[FLUX + 2] += z;
  sum[FLUX_SECOND] += x * w;
  sum[FLUX_SECOND + 1] += y * w;
  sum[FLUX_SECOND + 2] += z * w;
}

/* Adds faces of a solid; returns |n|^2, whose root is taken after the block. */
ROT_INLINE rot_pair add_solid(rot_pair sum[], const mesh_corners *v) {
  mesh_face f;
  see_face(v, &f);
  const rot_pair d = v->a[0] * f.n[0] + v->a[1] * f.n[1] + v->a[2] * f.n[2];
  const rot_pair gross = rot_pair_abs(v->a[0]) * f.m[0] + rot_pair_abs(v->a[1]) * f.m[1] +
                         rot_pair_abs(v->a[2]) * f.m[2];
  add_weighted(sum, &f, d);
  sum[GROSS_SIZE] += gross;
  sum[GROSS_SECOND] += gross * f.trace;
  add_flux(sum, rot_pair_abs(f.n[0]), rot_pair_abs(f.n[1]), rot_pair_abs(f.n[2]), f.trace);
  return f.square;
}

/* Adds faces of a surface. */
ROT_INLINE void add_shell(rot_pair sum[], const mesh_corners *v) {
  mesh_face f;
  see_face(v, &f);
  const rot_pair gross = f.m[0] + f.m[1] + f.m[2];
  add_weighted(sum, &f, rot_pair_sqrt(f.square));
  sum[GROSS_SIZE] += gross;
  sum[GROSS_SECOND] += gross * f.trace;
  add_flux(sum, f.edges[0], f.edges[1], f.edges[2], f.trace);
}

/* Adds the lanes group .. group + ROT_PAIR - 1 of a block. */
ROT_INLINE void add_group(const mesh_source *source, rot_mesh_sums *sums, size_t from, size_t end,
                          size_t group, int shell, int whole) {
  rot_pair sum[SUMS], square[ROT_MESH_STEPS];
  for (int j = 0; j < SUMS; j++) sum[j] = ROT_BOTH(0.0);
  for (size_t step = 0; step < ROT_MESH_STEPS; step++) {
    const size_t face = from + step * ROT_MESH_LANES + group;
    mesh_corners v;
    load_corner(source, face, end, 0, whole, v.a);
    load_corner(source, face, end, 1, whole, v.b);
    load_corner(source, face, end, 2, whole, v.c);
    if (shell) {
      add_shell(sum, &v);
    } else {
      square[step] = add_solid(sum, &v);
    }
  }
  for (size_t step = 0; step < ROT_MESH_STEPS && !shell; step++) {
    sum[AREA] += rot_pair_sqrt(square[step]);
  }
  for (int j = 0; j < EXACT; j++) { /* rot_two_sum() of each lane */
    const rot_pair a = rot_load(sums->total[j] + group), b = sum[j], s = a + b, back = s - a;
    rot_store(sums->total[j] + group, s);
    rot_store(sums->lost[j] + group,
              rot_load(sums->lost[j] + group) + ((a - (s - back)) + (b - back)));
  }
  for (int j = EXACT; j < SUMS; j++) {
    rot_store(sums->total[j] + group, rot_load(sums->total[j] + group) + sum[j]);
  }
}

/* Adds faces from .. end - 1; `from` is a multiple of ROT_MESH_BLOCK. */
ROT_INLINE void sum_kind(const rot_mesh *mesh, rot_mesh_sums *sums, size_t from, size_t end,
                         int shell) {
  const mesh_source source = open_source(mesh, sums->centre);
  for (; end - from >= ROT_MESH_BLOCK; from += ROT_MESH_BLOCK) {
    for (size_t group = 0; group < ROT_MESH_LANES; group += ROT_PAIR) {
      add_group(&source, sums, from, end, group, shell, 1);
    }
  }
  for (size_t group = 0; group < ROT_MESH_LANES && from < end; group += ROT_PAIR) {
    add_group(&source, sums, from, end, group, shell, 0);
  }
}

/* The same, compiled separately for solids and surfaces. */
ROT_INLINE void sum_faces(const rot_mesh *mesh, rot_mesh_sums *sums, size_t from, size_t end,
                          int shell) {
  if (shell) {
    sum_kind(mesh, sums, from, end, 1);
  } else {
    sum_kind(mesh, sums, from, end, 0);
  }
}

/* The same for registers of four. */
void rot_mesh_sum_simd(const rot_mesh *mesh, rot_mesh_sums *sums, size_t from, size_t end,
                       int shell);

#endif
