#include "rot_nesting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_edges.h"
#include "rot_real.h"

typedef struct part {
  double lo[3], hi[3], volume, gross;
  size_t begin, end; /* its faces, in work.face */
} part;

typedef struct work {
  const rot_mesh *mesh;
  const uint32_t *component;
  size_t components;
  part *parts;
  uint32_t *face; /* ordered by component */
} work;

/* Points of a component that are tried; the first few whatever they cost. */
enum { POINTS = 64, FIRST_POINTS = 8 };

/* Boxes that may be looked at, a face counting as 16: some seconds, for all and for one. */
static const double most_looks = 4e8, most_looks_each = 2e7;

static void corner_at(const work *w, size_t face, size_t k, double at[3]) {
  const size_t vertex = rot_mesh_corner(w->mesh, face, k);
  for (size_t j = 0; j < 3; j++) at[j] = rot_mesh_at(w->mesh, vertex, j);
}

static void cross(const double a[3], const double b[3], double out[3], double *gross) {
  *gross = 0.0;
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out[k] = a[i] * b[j] - a[j] * b[i];
    *gross += fabs(a[i] * b[j]) + fabs(a[j] * b[i]);
  }
}

/* ---- volumes and boxes ---------------------------------------------------------------------- */

static void add_to_part(const work *w, size_t face, rot_nesting *out) {
  part *to = &w->parts[w->component[face]];
  double corner[3][3], origin[3], at[3], u[3], v[3], n[3], gross;
  /* From a corner of its own: far away parts of another size cost no digits. */
  corner_at(w, w->face[to->begin], 0, origin);
  for (size_t k = 0; k < 3; k++) {
    corner_at(w, face, k, corner[k]);
    for (int j = 0; j < 3; j++) {
      to->lo[j] = corner[k][j] < to->lo[j] ? corner[k][j] : to->lo[j];
      to->hi[j] = corner[k][j] > to->hi[j] ? corner[k][j] : to->hi[j];
    }
  }
  for (int j = 0; j < 3; j++) {
    at[j] = corner[0][j] - origin[j];
    u[j] = corner[1][j] - corner[0][j];
    v[j] = corner[2][j] - corner[0][j];
  }
  cross(u, v, n, &gross);
  out->zero_area_faces += !(fabs(n[0]) + fabs(n[1]) + fabs(n[2]) > 8.0 * ROT_EPS * gross);
  to->volume += (at[0] * n[0] + at[1] * n[1] + at[2] * n[2]) / 6.0;
  to->gross += (fabs(at[0]) + fabs(at[1]) + fabs(at[2])) * gross / 6.0;
}

static void gather_parts(const work *w, rot_nesting *out) {
  const size_t faces = w->mesh->faces;
  for (size_t i = 0; i < w->components; i++) {
    w->parts[i] =
        (part){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0.0, 0.0, 0, 0};
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
    if (w->component[i] == ROT_NO_COMPONENT) continue;
    w->face[w->parts[w->component[i]].end++] = (uint32_t)i;
  }
  for (size_t i = 0; i < faces; i++) {
    if (w->component[i] != ROT_NO_COMPONENT) add_to_part(w, i, out);
  }
}

/* ---- what is around a point ----------------------------------------------------------------- */

/* Half of the solid angle of a face; HUGE_VAL from a point on it, or so near that rounding decides
 * which side it sees. */
static double half_angle(const work *w, size_t face, const double p[3]) {
  double r[3][3], length[3], n[3], gross;
  for (size_t k = 0; k < 3; k++) {
    corner_at(w, face, k, r[k]);
    for (int j = 0; j < 3; j++) r[k][j] -= p[j];
    length[k] = sqrt(r[k][0] * r[k][0] + r[k][1] * r[k][1] + r[k][2] * r[k][2]);
  }
  cross(r[1], r[2], n, &gross);
  const double up = r[0][0] * n[0] + r[0][1] * n[1] + r[0][2] * n[2];
  double down = length[0] * length[1] * length[2];
  for (int k = 0; k < 3; k++) {
    const double *a = r[k], *b = r[(k + 1) % 3];
    down += (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * length[(k + 2) % 3];
  }
  return down < 0.0 && fabs(up) <= 1e-9 * -down ? HUGE_VAL : atan2(up, down);
}

static int in_box(const part *of, const double p[3]) {
  for (int k = 0; k < 3; k++) {
    if (!(p[k] >= of->lo[k] && p[k] <= of->hi[k])) return 0;
  }
  return 1;
}

/* How often the other components enclose p; HUGE_VAL where p is on one of them. */
static double count_around(const work *w, size_t self, const double p[3], double *looks) {
  const double pi = 3.14159265358979323846;
  double around = 0.0;
  for (size_t j = 0; j < w->components; j++) {
    *looks += 1.0;
    if (j == self || !in_box(&w->parts[j], p)) continue;
    double angle = 0.0;
    for (size_t i = w->parts[j].begin; i < w->parts[j].end; i++) {
      angle += half_angle(w, w->face[i], p);
    }
    *looks += 16.0 * (double)(w->parts[j].end - w->parts[j].begin);
    const double turns = angle / (2.0 * pi), whole = nearbyint(turns);
    if (!(fabs(turns - whole) < 1e-6)) return HUGE_VAL;
    around += whole;
  }
  return around;
}

/* The middles of some faces. The golden section spreads them over any order of the faces. */
static int place_component(const work *w, size_t self, double *looks, double *around) {
  const part *of = &w->parts[self];
  const size_t n = of->end - of->begin;
  const double golden = 0.61803398874989485, before = *looks;
  int seen = 0;
  *around = 0.0;
  for (size_t i = 0; i < n && i < POINTS; i++) {
    if (i >= FIRST_POINTS && *looks - before > most_looks_each) break;
    const double turn = golden * (double)i, place = n > POINTS ? turn - floor(turn) : 0.0;
    const size_t face = w->face[of->begin + (n > POINTS ? (size_t)(place * (double)n) : i)];
    double corner[3][3], p[3];
    for (size_t k = 0; k < 3; k++) corner_at(w, face, k, corner[k]);
    for (int j = 0; j < 3; j++) p[j] = (corner[0][j] + corner[1][j] + corner[2][j]) / 3.0;
    const double one = count_around(w, self, p, looks);
    if (!isfinite(one)) continue; /* there it touches another */
    if (seen && (one < *around || one > *around)) return 0;
    *around = one;
    seen = 1;
  }
  return 1;
}

static rot_status judge_parts(const work *w, const rot_hooks *hooks, rot_nesting *out) {
  double total = 0.0, looks = 0.0;
  for (size_t i = 0; i < w->components; i++) total += w->parts[i].volume;
  out->flipped = total < 0.0;
  const double sign = out->flipped ? -1.0 : 1.0;
  for (size_t i = 0; i < w->components; i++) {
    const double volume = sign * w->parts[i].volume;
    const size_t n = w->parts[i].end - w->parts[i].begin;
    double around;
    if (i % 64 == 0) {
      rot_status status = rot_poll(hooks, (double)i / (double)w->components);
      if (status != ROT_OK) return status;
    }
    if (!(fabs(volume) > ROT_EPS * (16.0 + (double)n) * w->parts[i].gross)) {
      out->flat++;
    } else if (looks > most_looks) {
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

rot_status rot_nesting_check(const rot_mesh *mesh, const uint32_t component[], size_t components,
                             const rot_hooks *hooks, double volume[], rot_nesting *out) {
  rot_mesh_tamed tame;
  *out = (rot_nesting){0};
  work w = {&tame.mesh, component, components, NULL, NULL};
  rot_status status = rot_mesh_tame(mesh, &tame);
  if (status == ROT_OK) {
    w.parts = rot_mesh_alloc(components, sizeof *w.parts);
    w.face = rot_mesh_alloc(mesh->faces, sizeof *w.face);
    status = w.parts && w.face ? ROT_OK : ROT_ENOMEM;
  }
  if (status == ROT_OK) {
    gather_parts(&w, out);
    for (size_t i = 0; i < components; i++) {
      volume[i] = w.parts[i].volume;
      for (int k = 0; k < 3; k++) volume[i] = ldexp(volume[i], tame.exponent);
    }
    status = judge_parts(&w, hooks, out);
  }
  free(w.parts);
  free(w.face);
  rot_mesh_tame_free(&tame);
  return status;
}
