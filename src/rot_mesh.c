#include "rot_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "rot_pair.h"
#include "rot_real.h"

void *rot_mesh_alloc(size_t n, size_t size) {
  if (n > SIZE_MAX / size) return NULL;
  return malloc(n ? n * size : 1);
}

/* ---- what goes in --------------------------------------------------------------------------- */

rot_mesh_entries rot_mesh_check_entries(const rot_mesh *mesh) {
  rot_mesh_entries bad = {0, 0};
  for (size_t i = 0; i < mesh->vertices; i++) {
    bad.bad_vertices += !(isfinite(rot_mesh_at(mesh, i, 0)) && isfinite(rot_mesh_at(mesh, i, 1)) &&
                          isfinite(rot_mesh_at(mesh, i, 2)));
  }
  for (size_t i = 0; i < mesh->faces; i++) {
    int wrong = 0;
    for (size_t k = 0; k < 3; k++) {
      const int at = mesh->corner[i * mesh->face_step + k * mesh->corner_step];
      wrong |= at < 1 || (size_t)at > mesh->vertices;
    }
    bad.bad_faces += wrong != 0;
  }
  return bad;
}

/* Marks the vertices in use; 0 where a face names one that is not there. */
static int mark_used(const rot_mesh *mesh, unsigned char used[]) {
  memset(used, 0, mesh->vertices);
  for (size_t i = 0; i < mesh->faces; i++) {
    for (size_t k = 0; k < 3; k++) {
      const int at = mesh->corner[i * mesh->face_step + k * mesh->corner_step];
      if (at < 1 || (size_t)at > mesh->vertices) return 0;
      used[at - 1] = 1;
    }
  }
  return 1;
}

/* 0 where a coordinate is not finite. */
static int find_box(const rot_mesh *mesh, const unsigned char used[], rot_mesh_local *local) {
  int finite = 1;
  for (size_t k = 0; k < 3; k++) {
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (size_t i = 0; i < mesh->vertices; i++) {
      if (!used[i]) continue;
      const double x = rot_mesh_at(mesh, mesh->same ? mesh->same[i] : i, k);
      finite &= isfinite(x) != 0;
      lo = x < lo ? x : lo;
      hi = x > hi ? x : hi;
    }
    local->lo[k] = lo;
    local->hi[k] = hi;
    local->centre[k] = 0.5 * lo + 0.5 * hi;
  }
  return finite;
}

rot_status rot_mesh_localise(const rot_mesh *mesh, rot_mesh_local *local) {
  const size_t n = mesh->vertices;
  *local = (rot_mesh_local){0};
  if (!n || !mesh->faces) return ROT_EVALUE;
  unsigned char *used = rot_mesh_alloc(n, 1);
  local->xyz = rot_mesh_alloc(n, 3 * sizeof *local->xyz);
  rot_status status = used && local->xyz ? ROT_OK : ROT_ENOMEM;
  if (status == ROT_OK && !mark_used(mesh, used)) status = ROT_EVALUE;
  if (status == ROT_OK && !find_box(mesh, used, local)) status = ROT_EVALUE;
  double half = 0.0;
  for (size_t k = 0; k < 3 && status == ROT_OK; k++) {
    const double lo = local->lo[k], hi = local->hi[k];
    half = fmax(half, fmax(hi - local->centre[k], local->centre[k] - lo));
  }
  if (status == ROT_OK) {
    (void)frexp(half, &local->exponent);
    if (!(half > 0.0)) local->exponent = 0;
    /* Two factors: 2^1074 alone is no double. */
    const int e1 = -local->exponent / 2, e2 = -local->exponent - e1;
    const double s1 = ldexp(1.0, e1), s2 = ldexp(1.0, e2);
    const double c0 = local->centre[0], c1 = local->centre[1], c2 = local->centre[2];
    for (size_t i = 0; i < n; i++) {
      double *to = local->xyz + 3 * i;
      const size_t from = mesh->same ? mesh->same[i] : i;
      const int in = used[i];
      local->used += (size_t)in;
      to[0] = in ? (rot_mesh_at(mesh, from, 0) - c0) * s1 * s2 : 0.0;
      to[1] = in ? (rot_mesh_at(mesh, from, 1) - c1) * s1 * s2 : 0.0;
      to[2] = in ? (rot_mesh_at(mesh, from, 2) - c2) * s1 * s2 : 0.0;
    }
  }
  free(used);
  if (status != ROT_OK) {
    free(local->xyz);
    local->xyz = NULL;
  }
  return status;
}

/* ---- the sums ------------------------------------------------------------------------------- */

/* Terms are added in blocks of faces, the sums of blocks with their rounding errors kept: what a
 * sum loses does not grow with the number of faces. */
enum { BLOCK = 8 * ROT_PAIR, POLL_FACES = 1 << 16 };

/* Roundings of a term, relative to the sizes of what is added in it (4 in n, 3 in d, 8 in the
 * square, 1 for their product), and of the sum over a block and its lanes. */
enum { ROUNDINGS = 16 + BLOCK / ROT_PAIR + ROT_PAIR };

/* The sums of either kind. `gross` has the terms without their cancellation. */
enum {
  SIZE,
  FIRST,              /* 3 */
  SECOND = FIRST + 3, /* xx, yy, zz, xy, xz, yz */
  AREA = SECOND + 6,
  NORMAL, /* 3 */
  GROSS_SIZE = NORMAL + 3,
  GROSS_SECOND,
  FLUX,                   /* 3: of the solid |n|, of the surface the edges, axis by axis */
  FLUX_SECOND = FLUX + 3, /* 3: the same times the square of the distance */
  SUMS = FLUX_SECOND + 3
};

typedef struct corners {
  rot_pair a[3], b[3], c[3];
} corners;

/* Corner k of ROT_PAIR faces. */
ROT_INLINE void load_corner(const double *const at[], rot_pair to[3]) {
#if defined(__GNUC__)
  to[0] = (rot_pair){at[0][0], at[1][0]};
  to[1] = (rot_pair){at[0][1], at[1][1]};
  to[2] = (rot_pair){at[0][2], at[1][2]};
#else
  to[0] = at[0][0];
  to[1] = at[0][1];
  to[2] = at[0][2];
#endif
}

/* Faces `from` on; those past `end` count as the point 0, which adds nothing. */
ROT_INLINE void load_faces(const rot_mesh *mesh, const double xyz[], size_t from, size_t end,
                           corners *to) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  const double *at[3][ROT_PAIR];
  for (size_t lane = 0; lane < ROT_PAIR; lane++) {
    const size_t face = from + lane;
    const int *corner = mesh->corner + face * mesh->face_step;
    for (size_t k = 0; k < 3; k++) {
      at[k][lane] = face < end ? xyz + 3 * ((size_t)corner[k * mesh->corner_step] - 1) : origin;
    }
  }
  load_corner(at[0], to->a);
  load_corner(at[1], to->b);
  load_corner(at[2], to->c);
}

/* What both kinds need of a face. */
typedef struct face {
  rot_pair n[3];     /* twice the area, along the normal */
  rot_pair m[3];     /* the same without cancellation */
  rot_pair s[3];     /* a + b + c */
  rot_pair q[6];     /* s s' + a a' + b b' + c c' */
  rot_pair p;        /* 4 (a.a + b.b + c.c), at least the trace of q */
  rot_pair edges[3]; /* |b - a| + |c - a|, axis by axis */
  rot_pair twice_area;
} face;

ROT_INLINE void see_face(const corners *v, face *f) {
  const rot_pair ux = v->b[0] - v->a[0], uy = v->b[1] - v->a[1], uz = v->b[2] - v->a[2];
  const rot_pair wx = v->c[0] - v->a[0], wy = v->c[1] - v->a[1], wz = v->c[2] - v->a[2];
  const rot_pair yz = uy * wz, zy = uz * wy, zx = uz * wx, xz = ux * wz, xy = ux * wy, yx = uy * wx;
  f->n[0] = yz - zy;
  f->n[1] = zx - xz;
  f->n[2] = xy - yx;
  f->m[0] = rot_pair_abs(yz) + rot_pair_abs(zy);
  f->m[1] = rot_pair_abs(zx) + rot_pair_abs(xz);
  f->m[2] = rot_pair_abs(xy) + rot_pair_abs(yx);
  f->s[0] = v->a[0] + v->b[0] + v->c[0];
  f->s[1] = v->a[1] + v->b[1] + v->c[1];
  f->s[2] = v->a[2] + v->b[2] + v->c[2];
  const rot_pair x2 = v->a[0] * v->a[0] + v->b[0] * v->b[0] + v->c[0] * v->c[0];
  const rot_pair y2 = v->a[1] * v->a[1] + v->b[1] * v->b[1] + v->c[1] * v->c[1];
  const rot_pair z2 = v->a[2] * v->a[2] + v->b[2] * v->b[2] + v->c[2] * v->c[2];
  f->q[0] = f->s[0] * f->s[0] + x2;
  f->q[1] = f->s[1] * f->s[1] + y2;
  f->q[2] = f->s[2] * f->s[2] + z2;
  f->q[3] = f->s[0] * f->s[1] + (v->a[0] * v->a[1] + v->b[0] * v->b[1] + v->c[0] * v->c[1]);
  f->q[4] = f->s[0] * f->s[2] + (v->a[0] * v->a[2] + v->b[0] * v->b[2] + v->c[0] * v->c[2]);
  f->q[5] = f->s[1] * f->s[2] + (v->a[1] * v->a[2] + v->b[1] * v->b[2] + v->c[1] * v->c[2]);
  f->p = ROT_BOTH(4.0) * (x2 + y2 + z2);
  f->edges[0] = rot_pair_abs(ux) + rot_pair_abs(wx);
  f->edges[1] = rot_pair_abs(uy) + rot_pair_abs(wy);
  f->edges[2] = rot_pair_abs(uz) + rot_pair_abs(wz);
  f->twice_area = rot_pair_sqrt(f->n[0] * f->n[0] + f->n[1] * f->n[1] + f->n[2] * f->n[2]);
}

ROT_INLINE void add_weighted(rot_pair sum[], const face *f, rot_pair w) {
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

ROT_INLINE void add_flux(rot_pair sum[], const rot_pair flux[], rot_pair w) {
  sum[FLUX] += flux[0];
  sum[FLUX + 1] += flux[1];
  sum[FLUX + 2] += flux[2];
  sum[FLUX_SECOND] += flux[0] * w;
  sum[FLUX_SECOND + 1] += flux[1] * w;
  sum[FLUX_SECOND + 2] += flux[2] * w;
}

ROT_INLINE void add_solid(rot_pair sum[], const corners *v) {
  face f;
  see_face(v, &f);
  const rot_pair d = v->a[0] * f.n[0] + v->a[1] * f.n[1] + v->a[2] * f.n[2];
  const rot_pair gross = rot_pair_abs(v->a[0]) * f.m[0] + rot_pair_abs(v->a[1]) * f.m[1] +
                         rot_pair_abs(v->a[2]) * f.m[2];
  add_weighted(sum, &f, d);
  sum[AREA] += f.twice_area;
  sum[GROSS_SIZE] += gross;
  sum[GROSS_SECOND] += gross * f.p;
  const rot_pair n[3] = {rot_pair_abs(f.n[0]), rot_pair_abs(f.n[1]), rot_pair_abs(f.n[2])};
  add_flux(sum, n, f.q[0] + f.q[1] + f.q[2]);
}

ROT_INLINE void add_shell(rot_pair sum[], const corners *v) {
  face f;
  see_face(v, &f);
  const rot_pair gross = f.m[0] + f.m[1] + f.m[2];
  add_weighted(sum, &f, f.twice_area);
  sum[GROSS_SIZE] += gross;
  sum[GROSS_SECOND] += gross * f.p;
  add_flux(sum, f.edges, f.p);
}

ROT_INLINE void add_block(const rot_mesh *mesh, const double xyz[], size_t from, size_t end,
                          int shell, double total[], double lost[]) {
  rot_pair sum[SUMS];
  for (int j = 0; j < SUMS; j++) sum[j] = ROT_BOTH(0.0);
  for (size_t i = from; i < end; i += ROT_PAIR) {
    corners v;
    load_faces(mesh, xyz, i, end, &v);
    if (shell) {
      add_shell(sum, &v);
    } else {
      add_solid(sum, &v);
    }
  }
  for (int j = 0; j < SUMS; j++) {
    double lane[ROT_PAIR], one = 0.0;
    rot_store(lane, sum[j]);
    for (int k = 0; k < ROT_PAIR; k++) one += lane[k];
    rot_accumulate(&total[j], &lost[j], one);
  }
}

static rot_status add_faces(const rot_mesh *mesh, const double xyz[], int shell,
                            const rot_hooks *hooks, double total[SUMS]) {
  double lost[SUMS] = {0.0};
  for (int j = 0; j < SUMS; j++) total[j] = 0.0;
  for (size_t i = 0; i < mesh->faces; i += BLOCK) {
    const size_t end = mesh->faces - i < BLOCK ? mesh->faces : i + BLOCK;
    if (i % POLL_FACES == 0) {
      rot_status status = rot_poll(hooks, (double)i / (double)mesh->faces);
      if (status != ROT_OK) return status;
    }
    if (shell) {
      add_block(mesh, xyz, i, end, 1, total, lost);
    } else {
      add_block(mesh, xyz, i, end, 0, total, lost);
    }
  }
  for (int j = 0; j < SUMS; j++) total[j] += lost[j];
  return ROT_OK;
}

/* ---- from sums to a body -------------------------------------------------------------------- */

/* The sums in scaled units, as integrals. */
typedef struct integrals {
  double size, area, centre[3], about[6], trace; /* `about` the centre, divided by the size */
  double shift;                                  /* |centre|^2 */
} integrals;

static void integrate(const double sum[SUMS], int shell, integrals *to) {
  const double size = sum[SIZE], first = shell ? 3.0 : 4.0, second = shell ? 12.0 : 20.0;
  to->size = size / (shell ? 2.0 : 6.0);
  to->area = (shell ? size : sum[AREA]) / 2.0;
  double *g = to->centre;
  for (int k = 0; k < 3; k++) g[k] = sum[FIRST + k] / (first * size);
  const double outer[6] = {g[0] * g[0], g[1] * g[1], g[2] * g[2],
                           g[0] * g[1], g[0] * g[2], g[1] * g[2]};
  for (int k = 0; k < 6; k++) to->about[k] = sum[SECOND + k] / (second * size) - outer[k];
  to->trace = to->about[0] + to->about[1] + to->about[2];
  to->shift = outer[0] + outer[1] + outer[2];
}

/* What it costs to move each vertex by at most by[k] along axis k: bounds relative to the trace and
 * to the size. Along its normal the solid's surface moves by sum by[k] |n_k|/|n|; that changes C by
 * that times the surface's own second moment, V by that times the area. */
static double displace_solid(const double sum[SUMS], const integrals *of, const double by[3],
                             double *of_size) {
  double first = 0.0, second = 0.0;
  for (int k = 0; k < 3; k++) {
    first += by[k] * sum[FLUX + k] / 2.0;
    second += by[k] * sum[FLUX_SECOND + k] / 24.0;
  }
  const double root = sqrt(second) + sqrt(of->shift * first), size = fabs(of->size);
  *of_size = first / size;
  return root * root / (size * of->trace) + *of_size;
}

/* |n| changes by at most twice the displacement along one axis times the edges along another, and
 * the corners themselves move. */
static double displace_shell(const double sum[SUMS], const integrals *of, const double by[3],
                             double *of_size) {
  double first = 0.0, second = 0.0, all = 0.0;
  for (int k = 0; k < 3; k++) {
    const double others = by[(k + 1) % 3] + by[(k + 2) % 3];
    first += others * sum[FLUX + k];
    second += others * sum[FLUX_SECOND + k] / 6.0;
    all += by[k];
  }
  *of_size = first / of->area;
  return (second + 2.0 * of->shift * first) / (of->area * of->trace) + *of_size +
         2.0 * all / sqrt(of->trace);
}

/* `most` is the largest coordinate. */
static double rounding(const double sum[SUMS], int shell, const integrals *of, double most,
                       double *of_size) {
  const double size = fabs(of->size), u = ROT_EPS * ROUNDINGS, g = sqrt(of->shift);
  const double of_first = sum[GROSS_SIZE] * sqrt(3.0) * most / (shell ? 2.0 : 8.0);
  const double of_second = sum[GROSS_SECOND] / (shell ? 24.0 : 120.0);
  *of_size = u * sum[GROSS_SIZE] / (shell ? 2.0 : 6.0) / size;
  const double of_shift =
      2.0 * g * (u * of_first / size + g * *of_size) + 4.0 * ROT_EPS * of->shift;
  return (u * of_second / size + of_shift) / of->trace + *of_size + 4.0 * ROT_EPS;
}

static double farthest(const rot_mesh *mesh, const double xyz[], const double from[3]) {
  double most = 0.0;
  for (size_t i = 0; i < mesh->faces; i++) {
    for (size_t k = 0; k < 3; k++) {
      const double *at =
          xyz + 3 * ((size_t)mesh->corner[i * mesh->face_step + k * mesh->corner_step] - 1);
      const double x = at[0] - from[0], y = at[1] - from[1], z = at[2] - from[2];
      const double square = x * x + y * y + z * z;
      most = square > most ? square : most;
    }
  }
  return sqrt(most);
}

static double power_of_two(double x, int exponent, int times) {
  for (int i = 0; i < times; i++) x = ldexp(x, exponent);
  return x;
}

static rot_status moments(const rot_mesh *mesh, int shell, const rot_hooks *hooks,
                          rot_mesh_moments *out) {
  rot_mesh_local local;
  double sum[SUMS], before[3] = {0.0, 0.0, 0.0}, most = 1.0;
  integrals of = {0};
  *out = (rot_mesh_moments){0};
  rot_status status = rot_mesh_localise(mesh, &local);
  if (status != ROT_OK) return status;
  status = add_faces(mesh, local.xyz, shell, hooks, sum);
  if (status == ROT_OK) integrate(sum, shell, &of);
  /* Where the centre of mass is far from the middle of the box and most of the mass close to it,
   * the shift cancels: once more, from there. */
  if (status == ROT_OK && isfinite(of.shift) && !(of.shift <= of.trace)) {
    memcpy(before, of.centre, sizeof before);
    for (size_t i = 0; i < mesh->vertices; i++) {
      for (size_t k = 0; k < 3; k++) local.xyz[3 * i + k] -= before[k];
    }
    most = 2.0;
    status = add_faces(mesh, local.xyz, shell, hooks, sum);
    if (status == ROT_OK) integrate(sum, shell, &of);
  }
  if (status == ROT_OK) out->reach = farthest(mesh, local.xyz, of.centre);
  free(local.xyz);
  if (status != ROT_OK) return status;

  const int e = local.exponent;
  out->error = rounding(sum, shell, &of, most, &out->size_error);
  /* No size beyond rounding, or NaN: sums of 0, or volumes that cancel. */
  if (!(out->size_error < 0.125) || !(of.trace > 0.0)) return ROT_ERANGE;
  double (*const displace)(const double[SUMS], const integrals *, const double[3], double *) =
      shell ? displace_shell : displace_solid;
  /* About the middle of the box each coordinate is off by a rounding of its own; of two, moved. */
  double own[3], last[3], moved;
  for (int k = 0; k < 3; k++) {
    const double lo = local.lo[k], hi = local.hi[k];
    own[k] = ROT_EPS * ldexp(fmax(hi - local.centre[k], local.centre[k] - lo), -e);
    last[k] = ROT_EPS * ldexp(fmax(fabs(lo), fabs(hi)), -e);
    if (most > 1.0) own[k] *= 3.0;
  }
  out->error += displace(sum, &of, own, &moved);
  out->size_error += moved;
  out->coordinate_error = displace(sum, &of, last, &moved);

  out->size = power_of_two(of.size, e, shell ? 2 : 3);
  out->area = power_of_two(of.area, e, 2);
  out->reach = ldexp(out->reach * (1.0 + 8.0 * ROT_EPS), e);
  for (int k = 0; k < 3; k++) out->centre[k] = local.centre[k] + ldexp(before[k] + of.centre[k], e);
  for (int k = 0; k < 6; k++) out->second_moment[k] = power_of_two(of.about[k], e, 2);
  const double *n = sum + NORMAL;
  out->closure = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / (2.0 * of.area);
  memcpy(out->lo, local.lo, sizeof out->lo);
  memcpy(out->hi, local.hi, sizeof out->hi);
  return ROT_OK;
}

rot_status rot_mesh_solid(const rot_mesh *mesh, const rot_hooks *hooks, rot_mesh_moments *out) {
  return moments(mesh, 0, hooks, out);
}

rot_status rot_mesh_shell(const rot_mesh *mesh, const rot_hooks *hooks, rot_mesh_moments *out) {
  return moments(mesh, 1, hooks, out);
}
