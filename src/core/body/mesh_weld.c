#include "body/mesh_weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Hash table with open addressing: a slot holds a vertex (from 1) or 0; at most half are used. */
typedef struct table {
  uint32_t *slot;
  size_t mask;
} table;

static rot_status open_table(table *t, size_t n) {
  size_t slots = 16;
  while (slots / 2 < n) slots *= 2;
  t->mask = slots - 1;
  t->slot = rot_mesh_alloc(slots, sizeof *t->slot);
  if (!t->slot) return ROT_ENOMEM;
  memset(t->slot, 0, slots * sizeof *t->slot);
  return ROT_OK;
}

/* The finalizer of MurmurHash3: each bit of x changes half of the bits. */
static uint64_t mix(uint64_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdU;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53U;
  return x ^ x >> 33;
}

static uint64_t hash3(const double key[3]) {
  uint64_t h = 0;
  for (int k = 0; k < 3; k++) {
    uint64_t bits;
    const double x = key[k] + 0.0; /* -0 is 0 */
    memcpy(&bits, &x, sizeof bits);
    h = mix(h + bits + 0x9e3779b97f4a7c15U);
  }
  return h;
}

static void place(const rot_mesh *mesh, size_t i, double at[3]) {
  for (size_t k = 0; k < 3; k++) at[k] = rot_mesh_at(mesh, i, k);
}

static int equal(const double a[3], const double b[3]) {
  return !(a[0] < b[0] || a[0] > b[0] || a[1] < b[1] || a[1] > b[1] || a[2] < b[2] || a[2] > b[2]);
}

static int within(const double a[3], const double b[3], double tolerance) {
  return fabs(a[0] - b[0]) <= tolerance && fabs(a[1] - b[1]) <= tolerance &&
         fabs(a[2] - b[2]) <= tolerance;
}

enum { POLL_STEP = 1 << 16 };

/* Merges vertices with equal coordinates. */
static rot_status weld_exactly(const rot_mesh *mesh, table *t, const rot_hooks *hooks,
                               uint32_t same[], size_t *merged) {
  for (size_t i = 0; i < mesh->vertices; i++) {
    double at[3], other[3];
    if (i % POLL_STEP == 0) {
      const rot_status status = rot_poll(hooks, (double)i / (double)mesh->vertices);
      if (status != ROT_OK) return status;
    }
    place(mesh, i, at);
    size_t s = (size_t)hash3(at) & t->mask;
    for (; t->slot[s]; s = (s + 1) & t->mask) {
      place(mesh, t->slot[s] - 1, other);
      if (equal(at, other)) break;
    }
    if (!t->slot[s]) t->slot[s] = (uint32_t)i + 1;
    same[i] = t->slot[s] - 1;
    *merged += same[i] != i;
  }
  return ROT_OK;
}

/* Merges vertices within the tolerance, by cubes of twice the tolerance: each vertex within the
 * tolerance is in a cube of one of the eight points at -+ tolerance. A cube may contain several
 * kept vertices, so the search continues to an empty slot. */
static rot_status weld_nearly(const rot_mesh *mesh, double tolerance, table *t,
                              const rot_hooks *hooks, uint32_t same[], size_t *merged) {
  for (size_t i = 0; i < mesh->vertices; i++) {
    double at[3], other[3], cube[3], its[3];
    size_t found = i;
    if (i % POLL_STEP == 0) {
      const rot_status status = rot_poll(hooks, (double)i / (double)mesh->vertices);
      if (status != ROT_OK) return status;
    }
    place(mesh, i, at);
    for (unsigned corner = 0; corner < 8; corner++) {
      for (int k = 0; k < 3; k++) {
        const double side = corner >> k & 1U ? 0.5 : -0.5;
        cube[k] = floor(at[k] / (2.0 * tolerance) + side);
      }
      for (size_t s = (size_t)hash3(cube) & t->mask; t->slot[s]; s = (s + 1) & t->mask) {
        const size_t j = t->slot[s] - 1;
        if (j >= found) continue;
        place(mesh, j, other);
        if (within(at, other, tolerance)) found = j;
      }
    }
    same[i] = (uint32_t)found;
    *merged += found != i;
    if (found != i) continue;
    for (int k = 0; k < 3; k++) its[k] = floor(at[k] / (2.0 * tolerance));
    size_t s = (size_t)hash3(its) & t->mask;
    while (t->slot[s]) s = (s + 1) & t->mask;
    t->slot[s] = (uint32_t)i + 1;
  }
  return ROT_OK;
}

rot_status rot_mesh_weld(const rot_mesh *mesh, double tolerance, const rot_hooks *hooks,
                         uint32_t same[], size_t *merged) {
  table t = {NULL, 0};
  *merged = 0;
  if (!(tolerance >= 0.0 && isfinite(tolerance)) || mesh->vertices > INT32_MAX) return ROT_EVALUE;
  if (tolerance > 0.0) {
    for (size_t i = 0; i < mesh->vertices; i++) {
      for (size_t k = 0; k < 3; k++) {
        if (!(fabs(rot_mesh_at(mesh, i, k)) <= 0x1p52 * tolerance)) return ROT_EVALUE;
      }
    }
  }
  rot_status status = open_table(&t, mesh->vertices);
  if (status != ROT_OK) return status;
  status = tolerance > 0.0 ? weld_nearly(mesh, tolerance, &t, hooks, same, merged)
                           : weld_exactly(mesh, &t, hooks, same, merged);
  free(t.slot);
  return status;
}
