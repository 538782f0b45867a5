#include "body/mesh_nesting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body/mesh_edges.h"
#include "ground/real.h"

/* A connected component. */
typedef struct part {
  double lo[3], hi[3]; /* bounding box */
  double volume;       /* signed */
  double gross;        /* sum of the absolute terms of the volume */
  size_t begin, end;   /* faces, in work.face */
  int flat;            /* 1: volume zero within rounding */
  int crosses;         /* 1: intersects another component */
} part;

typedef struct work {
  const rot_mesh *mesh;
  const uint32_t *component;
  size_t components;
  part *parts;
  uint32_t *face;    /* ordered by component */
  uint32_t *meeting; /* faces of one component that overlap another's box */
  const rot_hooks *hooks;
  rot_status *stopped; /* status of the last poll */
} work;

/* Points tried for each component; the work budget does not limit the first ones. */
enum { POINTS = 64, FIRST_POINTS = 8 };

/* Work budget in box tests (a face costs 16), some seconds: in total and per component. */
static const double max_looks = 4e8, max_looks_each = 2e7;

static void corner_at(const work *w, size_t face, size_t k, double at[3]) {
  const size_t vertex = rot_mesh_corner(w->mesh, face, k);
  for (size_t j = 0; j < 3; j++) at[j] = rot_mesh_at(w->mesh, vertex, j);
}

static void corners_at(const work *w, size_t face, double at[3][3]) {
  for (size_t k = 0; k < 3; k++) corner_at(w, face, k, at[k]);
}

static void centroid_of(double at[3][3], double p[3]) {
  for (int j = 0; j < 3; j++) p[j] = (at[0][j] + at[1][j] + at[2][j]) / 3.0;
}

/* (a, b) => a x b, sum of the absolute values of its terms */
static double cross(const double a[3], const double b[3], double out[3]) {
  double gross = 0.0;
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out[k] = a[i] * b[j] - a[j] * b[i];
    gross += fabs(a[i] * b[j]) + fabs(a[j] * b[i]);
  }
  return gross;
}

/* (a, b, c) => n = (b - a) x (c - a), sum of the absolute values of its terms */
static double normal_of(const double a[3], const double b[3], const double c[3], double n[3]) {
  double u[3], v[3];
  for (int j = 0; j < 3; j++) {
    u[j] = b[j] - a[j];
    v[j] = c[j] - a[j];
  }
  return cross(u, v, n);
}

enum { POLL_STEP = 1 << 15 };

/* 1 if the work must stop; called in each step of a long loop. */
static int ends_at(const work *w, size_t step) {
  if (*w->stopped == ROT_OK && step % POLL_STEP == 0) *w->stopped = rot_poll(w->hooks, 0.0);
  return *w->stopped != ROT_OK;
}

/* ---- volumes and boxes ---------------------------------------------------------------------- */

/* Adds a face to the box and the volume of its component. */
static void add_to_part(const work *w, size_t face, rot_mesh_nesting *out) {
  part *to = &w->parts[w->component[face]];
  double corner[3][3], origin[3], at[3], n[3];
  /* Relative to a corner of the component: accurate for small components far from the origin. */
  corner_at(w, w->face[to->begin], 0, origin);
  corners_at(w, face, corner);
  for (int j = 0; j < 3; j++) {
    at[j] = corner[0][j] - origin[j];
    for (int k = 0; k < 3; k++) {
      to->lo[j] = corner[k][j] < to->lo[j] ? corner[k][j] : to->lo[j];
      to->hi[j] = corner[k][j] > to->hi[j] ? corner[k][j] : to->hi[j];
    }
  }
  const double gross = normal_of(corner[0], corner[1], corner[2], n);
  out->zero_area_faces += !(fabs(n[0]) + fabs(n[1]) + fabs(n[2]) > 8.0 * ROT_EPS * gross);
  to->volume += (at[0] * n[0] + at[1] * n[1] + at[2] * n[2]) / 6.0;
  to->gross += (fabs(at[0]) + fabs(at[1]) + fabs(at[2])) * gross / 6.0;
}

/* Orders the faces by component; sets all members of the parts but `crosses`. */
static void gather_parts(const work *w, rot_mesh_nesting *out) {
  const size_t faces = w->mesh->faces;
  for (size_t i = 0; i < w->components; i++) {
    w->parts[i] = (part){
        {HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0.0, 0.0, 0, 0, 0, 0};
  }
  for (size_t i = 0; i < faces; i++) {
    if (w->component[i] != ROT_NO_COMPONENT) w->parts[w->component[i]].end++;
  }
  for (size_t i = 0, from = 0; i < w->components; i++) {
    const size_t count = w->parts[i].end;
    w->parts[i].begin = w->parts[i].end = from;
    from += count;
  }
  for (size_t i = 0; i < faces; i++) {
    if (ends_at(w, i)) return;
    if (w->component[i] == ROT_NO_COMPONENT) continue;
    w->face[w->parts[w->component[i]].end++] = (uint32_t)i;
  }
  for (size_t i = 0; i < faces; i++) {
    if (ends_at(w, i)) return;
    if (w->component[i] != ROT_NO_COMPONENT) add_to_part(w, i, out);
  }
  for (size_t i = 0; i < w->components; i++) {
    part *of = &w->parts[i];
    const double n = (double)(of->end - of->begin);
    of->flat = !(fabs(of->volume) > ROT_EPS * (16.0 + n) * of->gross);
  }
}

/* ---- winding numbers ------------------------------------------------------------------------ */

/* Distance relative to the size of a face at which a point counts as on it: single precision
 * resolves 6e-8 of the coordinates. */
static const double touching = 1e-6;

/* (face, point p) => half the solid angle of the face; HUGE_VAL for a point on it */
static double half_angle(const work *w, size_t face, const double p[3]) {
  double r[3][3], length[3], n[3];
  corners_at(w, face, r);
  for (int k = 0; k < 3; k++) {
    for (int j = 0; j < 3; j++) r[k][j] -= p[j];
    length[k] = sqrt(r[k][0] * r[k][0] + r[k][1] * r[k][1] + r[k][2] * r[k][2]);
  }
  (void)cross(r[1], r[2], n);
  const double up = r[0][0] * n[0] + r[0][1] * n[1] + r[0][2] * n[2];
  const double farthest = fmax(fmax(length[0], length[1]), length[2]),
               min = touching * farthest * farthest * farthest;
  double down = length[0] * length[1] * length[2];
  for (int k = 0; k < 3; k++) {
    const double *a = r[k], *b = r[(k + 1) % 3];
    down += (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * length[(k + 2) % 3];
  }
  /* For a point in the plane: down < 0 inside the face, 0 on its edges and corners. */
  return down <= min && fabs(up) <= min ? HUGE_VAL : atan2(up, down);
}

/* 1 if p is in the box, with a tolerance for the rounding of centroids. */
static int in_box(const part *of, const double p[3]) {
  for (int k = 0; k < 3; k++) {
    const double slack = 8.0 * ROT_EPS * (fabs(of->lo[k]) + fabs(of->hi[k]));
    if (!(p[k] >= of->lo[k] - slack && p[k] <= of->hi[k] + slack)) return 0;
  }
  return 1;
}

/* p => winding number of a component; HUGE_VAL if p is on it */
static double count_turns(const work *w, const part *of, const double p[3], double *looks) {
  const double pi = 3.14159265358979323846;
  double angle = 0.0;
  for (size_t i = of->begin; i < of->end && !ends_at(w, i); i++) {
    angle += half_angle(w, w->face[i], p);
  }
  *looks += 16.0 * (double)(of->end - of->begin);
  const double turns = angle / (2.0 * pi), whole = nearbyint(turns);
  return fabs(turns - whole) < 1e-6 ? whole : HUGE_VAL;
}

/* p => winding number of the other components; HUGE_VAL if p is on one of them */
static double count_around(const work *w, size_t self, const double p[3], double *looks) {
  double around = 0.0;
  for (size_t j = 0; j < w->components; j++) {
    *looks += 1.0;
    if (j == self || !in_box(&w->parts[j], p)) continue;
    around += count_turns(w, &w->parts[j], p, looks);
  }
  return around;
}

/* face => its centroid, moved inwards by a thousandth of its size */
static void step_inside(const work *w, const part *of, size_t face, double p[3]) {
  double corner[3][3], n[3];
  corners_at(w, face, corner);
  centroid_of(corner, p);
  (void)normal_of(corner[0], corner[1], corner[2], n);
  /* |n| is a length squared. */
  const double size = sqrt(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
  const double step = size > 0.0 ? (of->volume > 0.0 ? -1e-3 : 1e-3) / size : 0.0;
  for (int j = 0; j < 3; j++) p[j] += step * n[j];
}

/* Winding number from interior points, for a component whose faces all touch others, such as a
 * duplicate. */
static void place_from_inside(const work *w, size_t self, double *looks, double *around) {
  const part *of = &w->parts[self];
  for (size_t i = of->begin; i < of->end && i < of->begin + FIRST_POINTS; i++) {
    double p[3];
    step_inside(w, of, w->face[i], p);
    const double own = count_turns(w, of, p, looks), one = count_around(w, self, p, looks);
    if (!isfinite(one) || !(own * of->volume > 0.0)) continue;
    /* A component that fills a cavity completely does not enclose it. */
    *around = fabs(one + 2.0 * own) < 0.5 ? -own : one;
    return;
  }
}

/* component `self` => winding number of the others around it, from centroids of faces chosen by the
 * golden section. Returns 0 if they differ: the component intersects another. */
static int place_component(const work *w, size_t self, double *looks, double *around) {
  const part *of = &w->parts[self];
  const size_t n = of->end - of->begin;
  const double golden = 0.61803398874989485, before = *looks;
  int seen = 0;
  *around = 0.0;
  for (size_t i = 0; i < n && i < POINTS; i++) {
    if (i >= FIRST_POINTS && *looks - before > max_looks_each) break;
    const double turn = golden * (double)i, place = n > POINTS ? turn - floor(turn) : 0.0;
    const size_t face = w->face[of->begin + (n > POINTS ? (size_t)(place * (double)n) : i)];
    double corner[3][3], p[3];
    corners_at(w, face, corner);
    centroid_of(corner, p);
    const double one = count_around(w, self, p, looks);
    if (!isfinite(one)) continue; /* touches another component there */
    if (seen && (one < *around || one > *around)) return 0;
    *around = one;
    seen = 1;
  }
  if (!seen) place_from_inside(w, self, looks, around);
  return 1;
}

/* ---- intersecting components ---------------------------------------------------------------- */

/* A face. */
typedef struct sheet {
  double at[4][3];     /* corners, centroid */
  double lo[3], hi[3]; /* bounding box */
} sheet;

static void see_sheet(const work *w, size_t face, sheet *to) {
  corners_at(w, face, to->at);
  centroid_of(to->at, to->at[3]);
  for (int j = 0; j < 3; j++) {
    const double a = to->at[0][j], b = to->at[1][j], c = to->at[2][j];
    to->lo[j] = a < b ? (a < c ? a : c) : (b < c ? b : c);
    to->hi[j] = a > b ? (a > c ? a : c) : (b > c ? b : c);
  }
}

static int boxes_meet(const double alo[3], const double ahi[3], const double blo[3],
                      const double bhi[3]) {
  for (int k = 0; k < 3; k++) {
    if (!(alo[k] < bhi[k] && blo[k] < ahi[k])) return 0;
  }
  return 1;
}

/* => side of the plane through a, b, c on which d lies: 1, -1, or 0 for contact, where six times
 * the volume is at most `min` */
static int side_of(const double a[3], const double b[3], const double c[3], const double d[3],
                   double min) {
  double n[3], volume = 0.0;
  (void)normal_of(a, b, c, n);
  for (int j = 0; j < 3; j++) volume += (d[j] - a[j]) * n[j];
  return fabs(volume) > min ? (volume > 0.0 ? 1 : -1) : 0;
}

static double length_of(const double a[3], const double b[3]) {
  return fabs(a[0] - b[0]) + fabs(a[1] - b[1]) + fabs(a[2] - b[2]);
}

/* 1 if the segment from p to q passes through the interior of a face. Heights over the face and
 * distances of lines are relative to the longest length. */
static int pierces(const double p[3], const double q[3], const sheet *s) {
  const double *a = s->at[0], *b = s->at[1], *c = s->at[2];
  const double line = length_of(p, q), ab = length_of(a, b), bc = length_of(b, c),
               ca = length_of(c, a), max = fmax(fmax(line, ab), fmax(bc, ca));
  const double min = touching * max * ab * ca, min_line = touching * max * line;
  if (side_of(a, b, c, p, min) * side_of(a, b, c, q, min) >= 0) return 0;
  const int turn = side_of(p, q, a, b, min_line * ab);
  return turn != 0 && side_of(p, q, b, c, min_line * bc) == turn &&
         side_of(p, q, c, a, min_line * ca) == turn;
}

/* 1 if two faces intersect. Tests their edges and the segments from centroids to corners: in
 * congruent or aligned bodies edges meet edges, and only those segments pass through. */
static int sheets_cross(const sheet *a, const sheet *b) {
  if (!boxes_meet(a->lo, a->hi, b->lo, b->hi)) return 0;
  for (int k = 0; k < 3; k++) {
    const int next = (k + 1) % 3;
    if (pierces(a->at[k], a->at[next], b) || pierces(a->at[k], a->at[3], b) ||
        pierces(b->at[k], b->at[next], a) || pierces(b->at[k], b->at[3], a)) {
      return 1;
    }
  }
  return 0;
}

static size_t gather_meeting(const work *w, const part *of, const part *other, sheet *one) {
  size_t n = 0;
  for (size_t i = of->begin; i < of->end && !ends_at(w, i); i++) {
    see_sheet(w, w->face[i], one);
    if (boxes_meet(one->lo, one->hi, other->lo, other->hi)) w->meeting[n++] = w->face[i];
  }
  return n;
}

/* 1 if a face of one component intersects one of the other; 0 also beyond the work budget. */
static int parts_cross(const work *w, const part *a, const part *b, double *looks) {
  sheet one, other;
  const size_t n = gather_meeting(w, b, a, &other);
  *looks += (double)(b->end - b->begin);
  for (size_t i = a->begin; i < a->end && n; i++) {
    if (ends_at(w, i)) return 0;
    see_sheet(w, w->face[i], &one);
    *looks += 1.0;
    if (!boxes_meet(one.lo, one.hi, b->lo, b->hi)) continue;
    *looks += 4.0 * (double)n;
    if (*looks > max_looks) return 0;
    for (size_t j = 0; j < n; j++) {
      if (ends_at(w, j)) return 0;
      see_sheet(w, w->meeting[j], &other);
      if (sheets_cross(&one, &other)) return 1;
    }
  }
  return 0;
}

/* Marks all components that intersect others. */
static rot_status find_crossings(const work *w) {
  double looks = 0.0;
  for (size_t i = 1; i < w->components && looks <= max_looks; i++) {
    part *a = &w->parts[i];
    for (size_t j = 0; j < i && looks <= max_looks; j++) {
      part *b = &w->parts[j];
      if (ends_at(w, j)) return *w->stopped;
      looks += 1.0;
      if (a->flat || b->flat || (a->crosses && b->crosses)) continue;
      if (!boxes_meet(a->lo, a->hi, b->lo, b->hi)) continue;
      if (parts_cross(w, a, b, &looks)) a->crosses = b->crosses = 1;
      if (*w->stopped != ROT_OK) return *w->stopped;
    }
  }
  return ROT_OK;
}

/* ---- nesting -------------------------------------------------------------------------------- */

/* Classifies each component by volume and winding number of the others. */
static rot_status judge_parts(const work *w, rot_mesh_nesting *out) {
  double total = 0.0, looks = 0.0;
  for (size_t i = 0; i < w->components; i++) total += w->parts[i].volume;
  out->flipped = total < 0.0;
  const double sign = out->flipped ? -1.0 : 1.0;
  for (size_t i = 0; i < w->components; i++) {
    const double volume = sign * w->parts[i].volume;
    double around;
    if (i % 64 == 0) {
      rot_status status = rot_poll(w->hooks, (double)i / (double)w->components);
      if (status != ROT_OK) return status;
    }
    if (w->parts[i].flat) {
      out->flat++;
    } else if (w->parts[i].crosses) {
      out->crossing++;
    } else if (looks > max_looks) {
      out->unchecked++;
    } else if (!place_component(w, i, &looks, &around)) {
      out->crossing++;
    } else {
      around *= sign;
      if (volume > 0.0) {
        out->doubled += around > 0.5 || around < -0.5;
      } else {
        out->cavities += around > 0.5 && around < 1.5;
        out->inverted += around < 0.5;
        out->doubled += around > 1.5;
      }
    }
  }
  return ROT_OK;
}

rot_status rot_mesh_check_nesting(const rot_mesh *mesh, const uint32_t component[],
                                  size_t components, const rot_hooks *hooks, double volume[],
                                  rot_mesh_nesting *out) {
  rot_mesh_tamed tame;
  *out = (rot_mesh_nesting){0};
  rot_status stopped = ROT_OK;
  work w = {&tame.mesh, component, components, NULL, NULL, NULL, hooks, &stopped};
  rot_status status = rot_mesh_tame(mesh, &tame);
  if (status == ROT_OK) {
    w.parts = rot_mesh_alloc(components, sizeof *w.parts);
    w.face = rot_mesh_alloc(mesh->faces, sizeof *w.face);
    w.meeting = rot_mesh_alloc(mesh->faces, sizeof *w.meeting);
    status = w.parts && w.face && w.meeting ? ROT_OK : ROT_ENOMEM;
  }
  if (status == ROT_OK) {
    gather_parts(&w, out);
    for (size_t i = 0; i < components; i++) {
      volume[i] = w.parts[i].volume;
      for (int k = 0; k < 3; k++) volume[i] = ldexp(volume[i], tame.exponent);
    }
    status = stopped == ROT_OK ? find_crossings(&w) : stopped;
    if (status == ROT_OK) status = judge_parts(&w, out);
    if (status == ROT_OK) status = stopped;
  }
  free(w.parts);
  free(w.face);
  free(w.meeting);
  rot_mesh_tame_free(&tame);
  return status;
}
