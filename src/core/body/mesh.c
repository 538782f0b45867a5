#include "body/mesh.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body/mesh_sum.h"
#include "ground/real.h"
#include "ground/simd.h"

void *rot_mesh_alloc(size_t n, size_t size) {
  if (n > SIZE_MAX / size) return NULL;
  return malloc(n ? n * size : 1);
}

/* ---- input ---------------------------------------------------------------------------------- */

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

size_t rot_mesh_mark_used(const rot_mesh *mesh, unsigned char used[]) {
  size_t unused = 0;
  memset(used, 0, mesh->vertices);
  for (size_t i = 0; i < mesh->faces; i++) {
    for (size_t k = 0; k < 3; k++) {
      used[mesh->corner[i * mesh->face_step + k * mesh->corner_step] - 1] = 1;
    }
  }
  for (size_t i = 0; i < mesh->vertices; i++) unused += !used[i];
  return unused;
}

/* n corners => 1 if one is below 1 or above `max`: then the top bit of x - 1 or of max - x is set.
 * Four independent chains here and below, for instruction parallelism. */
static unsigned see_corners(const int at[], size_t n, size_t step, unsigned max) {
  unsigned a = 0, b = 0, c = 0, d = 0;
  size_t i = 0;
  for (; i + 4 <= n; i += 4, at += 4 * step) {
    const unsigned p = (unsigned)at[0], q = (unsigned)at[step], r = (unsigned)at[2 * step],
                   s = (unsigned)at[3 * step];
    a |= (p - 1U) | (max - p);
    b |= (q - 1U) | (max - q);
    c |= (r - 1U) | (max - r);
    d |= (s - 1U) | (max - s);
  }
  for (; i < n; i++, at += step) a |= ((unsigned)at[0] - 1U) | (max - (unsigned)at[0]);
  return (a | b | c | d) >> 31;
}

static int corners_ok(const rot_mesh *mesh) {
  if (mesh->faces == 0 || mesh->vertices > INT_MAX) return 0;
  unsigned wrong = 0;
  for (size_t k = 0; k < 3; k++) {
    wrong |= see_corners(mesh->corner + k * mesh->corner_step, mesh->faces, mesh->face_step,
                         (unsigned)mesh->vertices);
  }
  return !wrong;
}

typedef struct spread {
  double lo, hi; /* smallest and largest value */
  double zero;   /* NaN if a value is not finite */
} spread;

static spread see_value(spread s, double x) {
  return (spread){x < s.lo ? x : s.lo, x > s.hi ? x : s.hi, s.zero + 0.0 * x};
}

static spread see_all(spread a, spread b) {
  return (spread){fmin(a.lo, b.lo), fmax(a.hi, b.hi), a.zero + b.zero};
}

/* axis => range of the coordinates in use */
static spread find_spread(const rot_mesh *mesh, size_t axis) {
  const spread none = {HUGE_VAL, -HUGE_VAL, 0.0};
  spread a = none, b = none, c = none, d = none;
  const double *x = mesh->xyz + axis * mesh->axis_step;
  const size_t n = mesh->vertices, step = mesh->vertex_step;
  if (mesh->used || mesh->same) {
    for (size_t i = 0; i < n; i++) {
      if (mesh->used && !mesh->used[i]) continue;
      a = see_value(a, x[(mesh->same ? mesh->same[i] : i) * step]);
    }
    return a;
  }
  size_t i = 0;
  for (; i + 4 <= n; i += 4, x += 4 * step) {
    a = see_value(a, x[0]);
    b = see_value(b, x[step]);
    c = see_value(c, x[2 * step]);
    d = see_value(d, x[3 * step]);
  }
  for (; i < n; i++, x += step) a = see_value(a, x[0]);
  return see_all(see_all(a, b), see_all(c, d));
}

/* mesh => bounding box; returns 0 if a coordinate is not finite */
static int find_box(const rot_mesh *mesh, rot_mesh_box *box) {
  double half = 0.0;
  for (size_t k = 0; k < 3; k++) {
    const spread side = find_spread(mesh, k);
    if (!(side.zero <= 0.0)) return 0;
    box->lo[k] = side.lo;
    box->hi[k] = side.hi;
    box->centre[k] = 0.5 * box->lo[k] + 0.5 * box->hi[k];
    half = fmax(half, fmax(box->hi[k] - box->centre[k], box->centre[k] - box->lo[k]));
  }
  (void)frexp(half, &box->exponent);
  return 1;
}

/* Exponents of sizes for which fifth powers of lengths and their squares neither over- nor
 * underflow. */
enum { TAME = 64 };

/* Copies the coordinates, scaled to near 1, if the box is too large or too small. */
static rot_status shrink(rot_mesh_tamed *tame) {
  rot_mesh *mesh = &tame->mesh;
  rot_mesh_box *box = &tame->box;
  if (abs(box->exponent) <= TAME) return ROT_OK;
  tame->exponent = box->exponent;
  tame->xyz = rot_mesh_alloc(mesh->vertices, 3 * sizeof *tame->xyz);
  if (!tame->xyz) return ROT_ENOMEM;
  /* Two factors: 2^1074 alone is not a double. */
  const int e1 = -tame->exponent / 2, e2 = -tame->exponent - e1;
  const double s1 = ldexp(1.0, e1), s2 = ldexp(1.0, e2);
  for (size_t i = 0; i < mesh->vertices; i++) {
    for (size_t k = 0; k < 3; k++) tame->xyz[3 * i + k] = rot_mesh_at(mesh, i, k) * s1 * s2;
  }
  for (int k = 0; k < 3; k++) {
    box->lo[k] = box->lo[k] * s1 * s2;
    box->hi[k] = box->hi[k] * s1 * s2;
    box->centre[k] = box->centre[k] * s1 * s2;
  }
  mesh->xyz = tame->xyz;
  mesh->vertex_step = 3;
  mesh->axis_step = 1;
  return ROT_OK;
}

/* Copies the corners with welded vertices replaced. */
static rot_status resolve(rot_mesh_tamed *tame) {
  rot_mesh *mesh = &tame->mesh;
  if (!mesh->same) return ROT_OK;
  tame->corner = rot_mesh_alloc(mesh->faces, 3 * sizeof *tame->corner);
  if (!tame->corner) return ROT_ENOMEM;
  for (size_t i = 0; i < mesh->faces; i++) {
    for (size_t k = 0; k < 3; k++) tame->corner[3 * i + k] = (int)rot_mesh_corner(mesh, i, k) + 1;
  }
  mesh->corner = tame->corner;
  mesh->face_step = 3;
  mesh->corner_step = 1;
  return ROT_OK;
}

rot_status rot_mesh_tame(const rot_mesh *mesh, rot_mesh_tamed *tame) {
  *tame = (rot_mesh_tamed){0};
  tame->mesh = *mesh;
  if (!corners_ok(mesh) || !find_box(mesh, &tame->box)) return ROT_EVALUE;
  rot_status status = shrink(tame);
  return status == ROT_OK ? resolve(tame) : status;
}

void rot_mesh_tame_free(rot_mesh_tamed *tame) {
  free(tame->xyz);
  free(tame->corner);
  tame->xyz = NULL;
  tame->corner = NULL;
}

/* ---- the sums ------------------------------------------------------------------------------- */

enum { POLL_FACES = 2048 * ROT_MESH_BLOCK };

/* Roundings of a term, relative to the absolute values added in it (4 in n, 3 in d, 5 in q, 1 for
 * their product), and of the sum over a block and its lanes. */
enum { ROUNDINGS = 13 + ROT_MESH_STEPS + ROT_MESH_LANES };

/* (mesh, origin `centre`) => sums over all faces */
static rot_status add_faces(const rot_mesh *mesh, const double centre[3], int shell,
                            const rot_hooks *hooks, double sum[SUMS]) {
  rot_mesh_sums sums;
  memset(&sums, 0, sizeof sums);
  sums.centre = centre;
  for (size_t i = 0; i < mesh->faces; i += POLL_FACES) {
    const size_t end = mesh->faces - i < POLL_FACES ? mesh->faces : i + POLL_FACES;
    rot_status status = rot_poll(hooks, (double)i / (double)mesh->faces);
    if (status != ROT_OK) return status;
    if (rot_simd_ok()) {
      rot_mesh_sum_simd(mesh, &sums, i, end, shell);
    } else {
      sum_faces(mesh, &sums, i, end, shell);
    }
  }
  for (int j = 0; j < SUMS; j++) {
    double lost = 0.0;
    sum[j] = 0.0;
    for (int lane = 0; lane < ROT_MESH_LANES; lane++) {
      rot_accumulate(&sum[j], &lost, sums.total[j][lane]);
      if (j < EXACT) lost += sums.lost[j][lane];
    }
    sum[j] += lost;
  }
  return ROT_OK;
}

/* ---- sums => body --------------------------------------------------------------------------- */

typedef struct integrals {
  double size; /* signed volume, or area */
  double area;
  double centre[3]; /* of mass, relative to the origin of the sums */
  double about[6];  /* second moment about the centre, divided by the size */
  double trace;     /* of `about` */
  double shift;     /* |centre|^2 */
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

/* by => bounds of the change of C, relative to its trace, and of the size, relative to itself, if
 * each vertex moves by at most by[k] along axis k. The surface moves along its normal by at most
 * sum by[k] |n_k|/|n|; C changes by that times the surface's second moment, V by that times the
 * area. */
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

/* The same for a surface: |n| changes by at most twice the displacement along one axis times the
 * edges along another, and the corners move. */
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

/* => bound of the rounding error of C relative to its trace, and of the size. `max`: largest
 * coordinate relative to the origin of the sums. */
static double rounding(const double sum[SUMS], int shell, const integrals *of, double max,
                       double *of_size) {
  const double size = fabs(of->size), u = ROT_EPS * ROUNDINGS, g = sqrt(of->shift);
  const double of_first = sum[GROSS_SIZE] * sqrt(3.0) * max / (shell ? 2.0 : 8.0);
  const double of_second = sum[GROSS_SECOND] / (shell ? 24.0 : 120.0);
  *of_size = u * sum[GROSS_SIZE] / (shell ? 2.0 : 6.0) / size;
  const double of_shift = 2.0 * g * (u * of_first / size + g * *of_size);
  return (u * of_second / size + of_shift + 4.0 * ROT_EPS * of->shift) / of->trace + *of_size +
         4.0 * ROT_EPS;
}

static double farthest(const rot_mesh *mesh, const double origin[3], const double from[3]) {
  double max = 0.0;
  for (size_t i = 0; i < mesh->vertices; i++) {
    if (mesh->used && !mesh->used[i]) continue;
    const size_t at = mesh->same ? mesh->same[i] : i;
    const double x = rot_mesh_at(mesh, at, 0) - origin[0] - from[0],
                 y = rot_mesh_at(mesh, at, 1) - origin[1] - from[1],
                 z = rot_mesh_at(mesh, at, 2) - origin[2] - from[2];
    const double square = x * x + y * y + z * z;
    max = square > max ? square : max;
  }
  return sqrt(max);
}

static double power_of_two(double x, int exponent, int times) {
  for (int i = 0; i < times; i++) x = ldexp(x, exponent);
  return x;
}

/* origin => sums about it, their integrals. If the centre of mass is farther from the origin than
 * the radius of gyration, the shift would cancel: repeats with the centre of mass as origin. */
static rot_status gather(const rot_mesh *mesh, int shell, const rot_hooks *hooks, double origin[3],
                         double sum[SUMS], integrals *of) {
  rot_status status = add_faces(mesh, origin, shell, hooks, sum);
  if (status != ROT_OK) return status;
  integrate(sum, shell, of);
  if (!isfinite(of->shift) || of->shift <= of->trace) return ROT_OK;
  for (int k = 0; k < 3; k++) origin[k] += of->centre[k];
  status = add_faces(mesh, origin, shell, hooks, sum);
  if (status == ROT_OK) integrate(sum, shell, of);
  return status;
}

/* scaled mesh => moments and error bounds, in its units */
static rot_status judge(const rot_mesh *mesh, const rot_mesh_box *box, int shell,
                        const rot_hooks *hooks, rot_mesh_moments *out) {
  double sum[SUMS], origin[3], own[3], last[3], max = 0.0, moved;
  integrals of;
  memcpy(origin, box->centre, sizeof origin);
  rot_status status = gather(mesh, shell, hooks, origin, sum, &of);
  if (status != ROT_OK) return status;
  /* Each coordinate relative to the origin is rounded. */
  for (int k = 0; k < 3; k++) {
    const double side = fmax(box->hi[k] - origin[k], origin[k] - box->lo[k]);
    max = fmax(max, side);
    own[k] = ROT_EPS * side;
    last[k] = ROT_EPS * fmax(fabs(box->lo[k]), fabs(box->hi[k]));
    out->centre[k] = origin[k] + of.centre[k];
  }
  out->error = rounding(sum, shell, &of, max, &out->size_error);
  /* The size is zero within rounding, or NaN. */
  if (!(out->size_error < 0.125) || !(of.trace > 0.0)) return ROT_ERANGE;
  double (*const displace)(const double[SUMS], const integrals *, const double[3], double *) =
      shell ? displace_shell : displace_solid;
  out->error += displace(sum, &of, own, &moved);
  out->size_error += moved;
  out->coordinate_error = displace(sum, &of, last, &moved);
  out->moved_error = displace(sum, &of, (const double[3]){1.0, 1.0, 1.0}, &moved);
  const double *n = sum + NORMAL;
  out->closure = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / (2.0 * of.area);
  out->size = of.size;
  out->area = of.area;
  out->reach = farthest(mesh, origin, of.centre);
  memcpy(out->second_moment, of.about, sizeof of.about);
  return ROT_OK;
}

/* mesh => moments in m */
static rot_status moments(const rot_mesh *mesh, int shell, const rot_hooks *hooks,
                          rot_mesh_moments *out) {
  rot_mesh_tamed tame;
  *out = (rot_mesh_moments){0};
  rot_status status = rot_mesh_tame(mesh, &tame);
  if (status == ROT_OK) status = judge(&tame.mesh, &tame.box, shell, hooks, out);
  rot_mesh_tame_free(&tame);
  if (status != ROT_OK) return status;
  const int e = tame.exponent;
  out->size = power_of_two(out->size, e, shell ? 2 : 3);
  out->area = power_of_two(out->area, e, 2);
  out->moved_error = ldexp(out->moved_error, -e);
  for (int k = 0; k < 6; k++) out->second_moment[k] = power_of_two(out->second_moment[k], e, 2);
  for (int k = 0; k < 3; k++) {
    out->centre[k] = ldexp(out->centre[k], e);
    out->lo[k] = ldexp(tame.box.lo[k], e);
    out->hi[k] = ldexp(tame.box.hi[k], e);
  }
  out->reach = ldexp(out->reach * (1.0 + 16.0 * ROT_EPS), e);
  return ROT_OK;
}

rot_status rot_mesh_solid(const rot_mesh *mesh, const rot_hooks *hooks, rot_mesh_moments *out) {
  return moments(mesh, 0, hooks, out);
}

rot_status rot_mesh_shell(const rot_mesh *mesh, const rot_hooks *hooks, rot_mesh_moments *out) {
  return moments(mesh, 1, hooks, out);
}
