/* A torus of 2 n m triangles, its vertices and faces in columns as R has them. FILE holds n, m, the
 * offset of the torus from the origin in each axis, and three numbers more; the first column of the
 * result has the second moment per unit of mass, xx, yy, zz, xy, xz, yz.
 *
 *   HOW = core      rotdyn's C core: area, closure and error bound as well
 *         checked   welded, and its edges and components checked, before
 *         plain     the loop as one would write it: no local origin, one sum for each integral
 *         exact     the same about the first vertex in numbers of 32 digits, for reference */
#include "child.h"
#include "ground/dd.h"
#include "body/mesh_edges.h"
#include "body/mesh.h"
#include "body/mesh_nesting.h"
#include "body/mesh_weld.h"

#include <math.h>

static rot_mesh mesh;
static uint32_t *same, *component;

static void *room(size_t n, size_t size) {
  void *x = rot_mesh_alloc(n, size);
  if (!x) exit(EXIT_FAILURE);
  return x;
}

static void make_torus(size_t n, size_t m, double offset) {
  const double turn = 6.283185307179586;
  const size_t nv = n * m, nf = 2 * nv;
  double *xyz = room(nv, 3 * sizeof *xyz);
  int *corner = room(nf, 3 * sizeof *corner);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < m; j++) {
      const double u = turn * (double)i / (double)n, v = turn * (double)j / (double)m;
      const size_t at = i * m + j, face = 2 * at, r = (i + 1) % n * m, k = (j + 1) % m;
      xyz[at] = (1.0 + 0.25 * cos(v)) * cos(u) + offset;
      xyz[at + nv] = (1.0 + 0.25 * cos(v)) * sin(u) + offset;
      xyz[at + 2 * nv] = 0.25 * sin(v) + offset;
      corner[face] = corner[face + 1] = (int)at + 1;
      corner[face + nf] = (int)(r + j) + 1;
      corner[face + 1 + nf] = corner[face + 2 * nf] = (int)(r + k) + 1;
      corner[face + 1 + 2 * nf] = (int)(i * m + k) + 1;
    }
  }
  mesh = (rot_mesh){nv, nf, xyz, 1, nv, corner, 1, nf, NULL, NULL};
  same = room(nv, sizeof *same);
  component = room(nf, sizeof *component);
}

static void plain(double c[6]) {
  double v = 0.0, x = 0.0, y = 0.0, z = 0.0, xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0,
         yz = 0.0;
  const double *px = mesh.xyz, *py = px + mesh.vertices, *pz = py + mesh.vertices;
  for (size_t i = 0; i < mesh.faces; i++) {
    const int p = mesh.corner[i] - 1, q = mesh.corner[i + mesh.faces] - 1,
              r = mesh.corner[i + 2 * mesh.faces] - 1;
    const double ax = px[p], ay = py[p], az = pz[p], bx = px[q], by = py[q], bz = pz[q], cx = px[r],
                 cy = py[r], cz = pz[r];
    const double d = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    const double sx = ax + bx + cx, sy = ay + by + cy, sz = az + bz + cz;
    v += d;
    x += d * sx;
    y += d * sy;
    z += d * sz;
    xx += d * (sx * sx + ax * ax + bx * bx + cx * cx);
    yy += d * (sy * sy + ay * ay + by * by + cy * cy);
    zz += d * (sz * sz + az * az + bz * bz + cz * cz);
    xy += d * (sx * sy + ax * ay + bx * by + cx * cy);
    xz += d * (sx * sz + ax * az + bx * bz + cx * cz);
    yz += d * (sy * sz + ay * az + by * bz + cy * cz);
  }
  x /= 4.0 * v;
  y /= 4.0 * v;
  z /= 4.0 * v;
  c[0] = xx / (20.0 * v) - x * x;
  c[1] = yy / (20.0 * v) - y * y;
  c[2] = zz / (20.0 * v) - z * z;
  c[3] = xy / (20.0 * v) - x * y;
  c[4] = xz / (20.0 * v) - x * z;
  c[5] = yz / (20.0 * v) - y * z;
}

static void exact(double c[6]) {
  static const int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  rot_dd v = {0.0, 0.0}, g[3] = {{0.0, 0.0}}, q[6] = {{0.0, 0.0}};
  for (size_t i = 0; i < mesh.faces; i++) {
    rot_dd r[3][3], s[3], d = {0.0, 0.0};
    for (size_t k = 0; k < 3; k++) {
      const size_t at = rot_mesh_corner(&mesh, i, k);
      for (size_t j = 0; j < 3; j++) {
        r[k][j] = rot_dd_sum2(rot_mesh_at(&mesh, at, j), -rot_mesh_at(&mesh, 0, j));
      }
    }
    for (int j = 0; j < 3; j++) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      const rot_dd n = rot_dd_sub(rot_dd_mul(r[1][k], r[2][l]), rot_dd_mul(r[1][l], r[2][k]));
      d = rot_dd_add(d, rot_dd_mul(r[0][j], n));
      s[j] = rot_dd_add(rot_dd_add(r[0][j], r[1][j]), r[2][j]);
    }
    v = rot_dd_add(v, d);
    for (int j = 0; j < 3; j++) g[j] = rot_dd_add(g[j], rot_dd_mul(d, s[j]));
    for (int j = 0; j < 6; j++) {
      const int a = axes[j][0], b = axes[j][1];
      rot_dd sum = rot_dd_mul(s[a], s[b]);
      for (int k = 0; k < 3; k++) sum = rot_dd_add(sum, rot_dd_mul(r[k][a], r[k][b]));
      q[j] = rot_dd_add(q[j], rot_dd_mul(d, sum));
    }
  }
  for (int j = 0; j < 3; j++) g[j] = rot_dd_div(g[j], rot_dd_mul1(v, 4.0));
  for (int j = 0; j < 6; j++) {
    const rot_dd mean = rot_dd_div(q[j], rot_dd_mul1(v, 20.0));
    c[j] = rot_dd_sub(mean, rot_dd_mul(g[axes[j][0]], g[axes[j][1]])).hi;
  }
}

static int checked(rot_mesh_moments *m) {
  rot_mesh_edges edges;
  rot_mesh_nesting nesting;
  size_t merged;
  double volume[1];
  rot_mesh welded = mesh;
  welded.same = same;
  return rot_mesh_weld(&mesh, 0.0, NULL, same, &merged) != ROT_OK ||
         rot_mesh_check_edges(&welded, NULL, component, &edges) != ROT_OK || edges.open_edges ||
         edges.components != 1 ||
         rot_mesh_check_nesting(&welded, component, 1, NULL, volume, &nesting) != ROT_OK ||
         rot_mesh_solid(&welded, NULL, m) != ROT_OK;
}

static int solve(const char *how, solution *s) {
  rot_mesh_moments m;
  int failed = 0;
  if (s->n < 6) return 1;
  if (!mesh.xyz) make_torus((size_t)s->time_s[0], (size_t)s->time_s[1], s->time_s[2]);
  s->rhs_calls = 0;
  for (size_t k = 0; k < s->n; k++) s->theta_rad[k] = s->omega_rad_per_s[k] = 0.0;
  if (!strcmp(how, "plain")) {
    plain(s->theta_rad);
    return 0;
  }
  if (!strcmp(how, "exact")) {
    exact(s->theta_rad);
    return 0;
  }
  failed = strcmp(how, "core") ? checked(&m) : rot_mesh_solid(&mesh, NULL, &m) != ROT_OK;
  memcpy(s->theta_rad, m.second_moment, sizeof m.second_moment);
  s->omega_rad_per_s[0] = m.error;
  return failed;
}

int main(int argc, char **argv) { return child_main(argc, argv, solve); }
