#include "body/mesh_edges.h"

#include <stdlib.h>
#include <string.h>

/* One use of an edge, in the bucket of its lower vertex. */
typedef struct use {
  uint32_t other;     /* higher vertex */
  uint32_t face_down; /* 2 face, + 1 if the face goes from the higher vertex to the lower one */
} use;

/* Uses of the edge from the bucket's vertex to this vertex. */
typedef struct tally {
  uint32_t bucket;   /* bucket counted here, from 1 */
  uint32_t up, down; /* uses in each direction */
  uint32_t first;    /* first face that uses it */
} tally;

typedef struct work {
  const rot_mesh *mesh;
  size_t *bucket;       /* start of each bucket */
  use *uses;            /* sorted into buckets */
  tally *tallies;       /* for each vertex */
  uint32_t *parent;     /* union-find: parent face, towards the first face of the component */
  unsigned char *crowd; /* 1: face on an edge that is used more than twice */
} work;

enum { POLL_STEP = 1 << 16 };

/* ---- components: union by least face, path halving ------------------------------------------ */

static uint32_t root_of(uint32_t parent[], uint32_t face) {
  while (parent[face] != face) {
    parent[face] = parent[parent[face]];
    face = parent[face];
  }
  return face;
}

static void join(uint32_t parent[], uint32_t a, uint32_t b) {
  a = root_of(parent, a);
  b = root_of(parent, b);
  if (a < b) {
    parent[b] = a;
  } else {
    parent[a] = b;
  }
}

/* ---- buckets -------------------------------------------------------------------------------- */

static int corners_of(const rot_mesh *mesh, size_t face, uint32_t v[3]) {
  for (size_t k = 0; k < 3; k++) v[k] = (uint32_t)rot_mesh_corner(mesh, face, k);
  return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

static rot_status poll_at(const rot_hooks *hooks, size_t i, size_t n) {
  return i % POLL_STEP == 0 ? rot_poll(hooks, (double)i / (double)n) : ROT_OK;
}

/* Sorts the uses of edges into buckets. bucket[v + 1] is first a count, then the start of v's
 * bucket, after filling its end. */
static rot_status fill_buckets(const work *w, const rot_hooks *hooks, rot_mesh_edges *out) {
  const rot_mesh *mesh = w->mesh;
  rot_status status;
  uint32_t v[3];
  memset(w->bucket, 0, (mesh->vertices + 2) * sizeof *w->bucket);
  for (size_t i = 0; i < mesh->faces; i++) {
    if ((status = poll_at(hooks, i, mesh->faces)) != ROT_OK) return status;
    w->parent[i] = (uint32_t)i;
    w->crowd[i] = 0;
    if (!corners_of(mesh, i, v)) {
      w->parent[i] = ROT_NO_COMPONENT;
      out->degenerate_faces++;
      continue;
    }
    for (int k = 0; k < 3; k++) {
      const uint32_t from = v[k], to = v[(k + 1) % 3];
      w->bucket[(from < to ? from : to) + 2]++;
    }
  }
  for (size_t i = 2; i < mesh->vertices + 2; i++) w->bucket[i] += w->bucket[i - 1];
  for (size_t i = 0; i < mesh->faces; i++) {
    if ((status = poll_at(hooks, i, mesh->faces)) != ROT_OK) return status;
    if (w->parent[i] == ROT_NO_COMPONENT || !corners_of(mesh, i, v)) continue;
    for (int k = 0; k < 3; k++) {
      const uint32_t from = v[k], to = v[(k + 1) % 3], low = from < to ? from : to;
      use *one = &w->uses[w->bucket[low + 1]++];
      one->other = from < to ? to : from;
      one->face_down = (uint32_t)(2 * i) + (from > to);
    }
  }
  return ROT_OK;
}

static void judge_edge(const tally *edge, rot_mesh_edges *out) {
  const size_t uses = (size_t)edge->up + edge->down;
  out->edges++;
  if (uses == 1) {
    out->open_edges++;
  } else if (uses == 2) {
    out->miswound_edges += edge->up != edge->down;
  } else if (edge->up == edge->down) {
    out->touching_edges++;
  } else {
    out->crowded_edges++;
  }
}

/* Counts the edges of one bucket and joins the faces on each. */
static void count_bucket(const work *w, uint32_t vertex, rot_mesh_edges *out) {
  const use *begin = w->uses + w->bucket[vertex], *end = w->uses + w->bucket[vertex + 1];
  for (const use *u = begin; u < end; u++) {
    tally *edge = &w->tallies[u->other];
    const uint32_t face = u->face_down / 2;
    if (edge->bucket != vertex + 1) *edge = (tally){vertex + 1, 0, 0, face};
    if (u->face_down & 1U) {
      edge->down++;
    } else {
      edge->up++;
    }
    if (face != edge->first) join(w->parent, face, edge->first);
  }
  for (const use *u = begin; u < end; u++) {
    const tally *edge = &w->tallies[u->other];
    const uint32_t face = u->face_down / 2;
    if (edge->up > 2 || edge->down > 2 || edge->up + edge->down > 2) w->crowd[face] = 1;
    /* Each edge is classified once, for the first face that uses it. */
    if (face == edge->first) judge_edge(edge, out);
  }
}

/* ---- results from the buckets --------------------------------------------------------------- */

static void number_components(const work *w, uint32_t component[], rot_mesh_edges *out) {
  for (size_t i = 0; i < w->mesh->faces; i++) {
    if (w->parent[i] == ROT_NO_COMPONENT) {
      component[i] = ROT_NO_COMPONENT;
      continue;
    }
    const uint32_t root = root_of(w->parent, (uint32_t)i);
    component[i] = root == i ? (uint32_t)out->components++ : component[root];
  }
}

typedef struct triple {
  uint32_t v[3];
} triple;

static triple sorted_corners(const rot_mesh *mesh, size_t face) {
  triple t;
  uint32_t swap;
  (void)corners_of(mesh, face, t.v);
  for (int pass = 0; pass < 2; pass++) {
    for (int k = 0; k < 2; k++) {
      if (t.v[k] > t.v[k + 1]) swap = t.v[k], t.v[k] = t.v[k + 1], t.v[k + 1] = swap;
    }
  }
  return t;
}

static int same_corners(const triple *s, const triple *t) {
  return s->v[0] == t->v[0] && s->v[1] == t->v[1] && s->v[2] == t->v[2];
}

static size_t hash_of(const triple *t) {
  uint64_t h = 0;
  for (int k = 0; k < 3; k++) {
    h = (h ^ t->v[k]) * 0x9e3779b97f4a7c15U;
    h ^= h >> 29;
  }
  return (size_t)h;
}

/* n triples => number equal to an earlier one, by open addressing: a slot holds a triple, from 1,
 * or 0 */
static rot_status count_repeated(size_t n, const triple list[], const rot_hooks *hooks,
                                 size_t *repeated) {
  size_t slots = 16;
  while (slots / 2 < n) slots *= 2;
  uint32_t *slot = rot_mesh_alloc(slots, sizeof *slot);
  if (!slot) return ROT_ENOMEM;
  memset(slot, 0, slots * sizeof *slot);
  rot_status status = ROT_OK;
  for (size_t i = 0; i < n && (status = poll_at(hooks, i, n)) == ROT_OK; i++) {
    size_t s = hash_of(&list[i]) & (slots - 1);
    while (slot[s] && !same_corners(&list[slot[s] - 1], &list[i])) s = (s + 1) & (slots - 1);
    if (slot[s]) {
      ++*repeated;
    } else {
      slot[s] = (uint32_t)i + 1;
    }
  }
  free(slot);
  return status;
}

/* Two faces with the same corners share three edges. So either a third face is on one of these, or
 * the two faces are a whole component: only such faces are compared. `sizes`: work space, one
 * element per component. */
static rot_status count_duplicates(const work *w, const rot_hooks *hooks,
                                   const uint32_t component[], uint32_t sizes[],
                                   rot_mesh_edges *out) {
  size_t candidates = 0, n = 0;
  memset(sizes, 0, out->components * sizeof *sizes);
  for (size_t i = 0; i < w->mesh->faces; i++) {
    if (component[i] != ROT_NO_COMPONENT) sizes[component[i]]++;
  }
  for (size_t i = 0; i < w->mesh->faces; i++) {
    if (component[i] == ROT_NO_COMPONENT) continue;
    if (sizes[component[i]] == 2) w->crowd[i] = 1;
    candidates += w->crowd[i];
  }
  if (!candidates) return ROT_OK;
  triple *list = rot_mesh_alloc(candidates, sizeof *list);
  if (!list) return ROT_ENOMEM;
  for (size_t i = 0; i < w->mesh->faces; i++) {
    if (component[i] != ROT_NO_COMPONENT && w->crowd[i]) {
      list[n++] = sorted_corners(w->mesh, i);
    }
  }
  const rot_status status = count_repeated(n, list, hooks, &out->duplicate_faces);
  free(list);
  return status;
}

/* The tallies are reused: `bucket` marks the vertices of faces. */
static void count_unused(const work *w, rot_mesh_edges *out) {
  const rot_mesh *mesh = w->mesh;
  for (size_t i = 0; i < mesh->vertices; i++) w->tallies[i].bucket = 0;
  for (size_t i = 0; i < mesh->faces; i++) {
    for (size_t k = 0; k < 3; k++) {
      w->tallies[mesh->corner[i * mesh->face_step + k * mesh->corner_step] - 1].bucket = 1;
    }
  }
  for (size_t i = 0; i < mesh->vertices; i++) out->unused_vertices += !w->tallies[i].bucket;
}

static rot_status check(const work *w, const rot_hooks *hooks, uint32_t component[],
                        rot_mesh_edges *out) {
  const size_t vertices = w->mesh->vertices;
  rot_status status = fill_buckets(w, hooks, out);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < vertices; i++) w->tallies[i].bucket = 0;
  for (size_t v = 0; v < vertices; v++) {
    if ((status = poll_at(hooks, v, vertices)) != ROT_OK) return status;
    count_bucket(w, (uint32_t)v, out);
  }
  number_components(w, component, out);
  count_unused(w, out);
  /* The parents are reused: components are at most as many as faces. */
  return count_duplicates(w, hooks, component, w->parent, out);
}

rot_status rot_mesh_check_edges(const rot_mesh *mesh, const rot_hooks *hooks, uint32_t component[],
                                rot_mesh_edges *out) {
  *out = (rot_mesh_edges){0};
  const rot_mesh_entries bad = rot_mesh_check_entries(mesh);
  if (bad.bad_faces || bad.bad_vertices || mesh->faces > INT32_MAX || mesh->vertices > INT32_MAX) {
    return ROT_EVALUE;
  }
  work w = {mesh, NULL, NULL, NULL, NULL, NULL};
  w.bucket = rot_mesh_alloc(mesh->vertices + 2, sizeof *w.bucket);
  w.uses = rot_mesh_alloc(mesh->faces, 3 * sizeof *w.uses);
  w.tallies = rot_mesh_alloc(mesh->vertices, sizeof *w.tallies);
  w.parent = rot_mesh_alloc(mesh->faces, sizeof *w.parent);
  w.crowd = rot_mesh_alloc(mesh->faces, 1);
  rot_status status = ROT_ENOMEM;
  if (w.bucket && w.uses && w.tallies && w.parent && w.crowd) {
    status = check(&w, hooks, component, out);
  }
  free(w.bucket);
  free(w.uses);
  free(w.tallies);
  free(w.parent);
  free(w.crowd);
  return status;
}
