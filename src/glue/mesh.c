/* For R: meshes. */
#include <string.h>

#include "glue/ffi.h"
#include "body/mesh_edges.h"
#include "body/mesh.h"
#include "body/mesh_nesting.h"
#include "body/mesh_weld.h"

/* matrices with a row per vertex and face, or (by_column, as in mesh3d) a column => mesh */
static rot_mesh read_mesh(SEXP vertices, SEXP faces, SEXP by_column) {
  if (TYPEOF(vertices) != REALSXP || !Rf_isMatrix(vertices) || TYPEOF(faces) != INTSXP ||
      !Rf_isMatrix(faces)) {
    Rf_error("internal: a mesh is a matrix of doubles and one of integers");
  }
  const size_t vr = (size_t)Rf_nrows(vertices), vc = (size_t)Rf_ncols(vertices),
               fr = (size_t)Rf_nrows(faces), fc = (size_t)Rf_ncols(faces);
  const int turned = Rf_asLogical(by_column) == TRUE;
  if ((turned ? vr : vc) < 3 || (turned ? fr : fc) < 3) {
    Rf_error("internal: a mesh has three coordinates and three corners");
  }
  if (turned) {
    return (rot_mesh){vc, fc, REAL_RO(vertices), vr, 1, INTEGER_RO(faces), fr, 1, NULL, NULL};
  }
  return (rot_mesh){vr, fr, REAL_RO(vertices), 1, vr, INTEGER_RO(faces), 1, fr, NULL, NULL};
}

/* integer vector => replacements after welding, or NULL */
static const uint32_t *read_same(SEXP same, const rot_mesh *mesh) {
  if (Rf_isNull(same)) return NULL;
  if (TYPEOF(same) != INTSXP || (size_t)XLENGTH(same) != mesh->vertices) {
    Rf_error("internal: `same` is not one number for each vertex");
  }
  const int *at = INTEGER_RO(same);
  for (size_t i = 0; i < mesh->vertices; i++) {
    if (at[i] < 0 || (size_t)at[i] >= mesh->vertices) Rf_error("internal: `same` is not a vertex");
  }
  return (const uint32_t *)(const void *)at;
}

typedef struct findings {
  rot_mesh_entries entries;
  size_t merged;
  rot_mesh_edges edges;
  rot_mesh_nesting nesting;
} findings;

/* The counts: name, value, and the stage that determines it. */
enum { ENTRIES, EDGES, NESTING };
#define COUNT_LIST(X)                                                                              \
  X("vertices", mesh->vertices, ENTRIES)                                                           \
  X("faces", mesh->faces, ENTRIES)                                                                 \
  X("bad_vertices", f->entries.bad_vertices, ENTRIES)                                              \
  X("bad_faces", f->entries.bad_faces, ENTRIES)                                                    \
  X("merged_vertices", f->merged, EDGES)                                                           \
  X("edges", f->edges.edges, EDGES)                                                                \
  X("open_edges", f->edges.open_edges, EDGES)                                                      \
  X("miswound", f->edges.miswound_edges, EDGES)                                                    \
  X("crowded", f->edges.crowded_edges, EDGES)                                                      \
  X("touching", f->edges.touching_edges, EDGES)                                                    \
  X("degenerate", f->edges.degenerate_faces, EDGES)                                                \
  X("duplicate_faces", f->edges.duplicate_faces, EDGES)                                            \
  X("unused", f->edges.unused_vertices, EDGES)                                                     \
  X("components", f->edges.components, EDGES)                                                      \
  X("zero_area", f->nesting.zero_area_faces, NESTING)                                              \
  X("flipped", f->nesting.flipped, NESTING)                                                        \
  X("cavities", f->nesting.cavities, NESTING)                                                      \
  X("inverted", f->nesting.inverted, NESTING)                                                      \
  X("overlapping", f->nesting.doubled + f->nesting.crossing, NESTING)                              \
  X("flat", f->nesting.flat, NESTING)                                                              \
  X("unchecked_parts", f->nesting.unchecked, NESTING)

static const char *const count_names[] = {
#define X(name, value, stage) name,
    COUNT_LIST(X)
#undef X
        ""};

static void write_counts(const rot_mesh *mesh, const findings *f, int reached, double to[]) {
#define X(name, value, stage) *to++ = stage <= reached ? (double)(value) : NA_REAL;
  COUNT_LIST(X)
#undef X
}

/* mesh => list(kind of status, counts, replacements or NULL, volumes of components or NULL). R
 * makes the message. Undetermined counts are NA. tolerance < 0: no welding. */
SEXP ffi_mesh_check(SEXP vertices, SEXP faces, SEXP by_column, SEXP tolerance, SEXP progress) {
  static const char *const names[] = {"kind", "counts", "same", "volume", ""};
  rot_mesh mesh = read_mesh(vertices, faces, by_column);
  const double weld = ffi_real(tolerance, "tolerance");
  findings f;
  memset(&f, 0, sizeof f);
  rot_status status = ROT_OK;
  int looked = 0, nested = 0;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SEXP counts = Rf_mkNamed(REALSXP, (const char **)count_names);
  SET_VECTOR_ELT(out, 1, counts);
  f.entries = rot_mesh_check_entries(&mesh);
  if (!f.entries.bad_faces && !f.entries.bad_vertices && mesh.faces) {
    SEXP component = PROTECT(Rf_allocVector(INTSXP, (R_xlen_t)mesh.faces));
    uint32_t *parts = (uint32_t *)(void *)INTEGER(component);
    ffi_guard guard;
    if (weld >= 0.0) {
      SEXP same = Rf_allocVector(INTSXP, (R_xlen_t)mesh.vertices);
      SET_VECTOR_ELT(out, 2, same);
      uint32_t *first = (uint32_t *)(void *)INTEGER(same);
      ffi_guard_begin(&guard, progress);
      status = rot_mesh_weld(&mesh, weld, &guard.hooks, first, &f.merged);
      ffi_guard_end(&guard, status);
      mesh.same = (const uint32_t *)(const void *)INTEGER_RO(same);
    }
    if (status == ROT_OK) {
      ffi_guard_begin(&guard, progress);
      status = rot_mesh_check_edges(&mesh, &guard.hooks, parts, &f.edges);
      ffi_guard_end(&guard, status);
      looked = status == ROT_OK;
    }
    const rot_mesh_edges *e = &f.edges;
    nested = looked && !e->components; /* without components all counts are 0 */
    if (looked && e->components && !e->open_edges && !e->miswound_edges && !e->crowded_edges &&
        !e->touching_edges) {
      SEXP volume = Rf_allocVector(REALSXP, (R_xlen_t)e->components);
      SET_VECTOR_ELT(out, 3, volume);
      ffi_guard_begin(&guard, progress);
      status = rot_mesh_check_nesting(&mesh, parts, e->components, &guard.hooks, REAL(volume),
                                      &f.nesting);
      ffi_guard_end(&guard, status);
      nested = status == ROT_OK;
    }
    UNPROTECT(1);
  }
  write_counts(&mesh, &f, nested ? NESTING : looked ? EDGES : ENTRIES, REAL(counts));
  SET_VECTOR_ELT(out, 0, Rf_mkString(rot_status_kind(status)));
  UNPROTECT(1);
  return out;
}

/* mesh => integrals of the solid or the surface, kind of status */
SEXP ffi_mesh_moments(SEXP vertices, SEXP faces, SEXP by_column, SEXP same, SEXP shell,
                      SEXP progress) {
  static const char *const names[] = {"size",    "size_error",
                                      "centre",  "second",
                                      "error",   "coordinate_error",
                                      "reach",   "area",
                                      "closure", "lo",
                                      "hi",      "moved_error",
                                      "kind",    ""};
  rot_mesh mesh = read_mesh(vertices, faces, by_column);
  mesh.same = read_same(same, &mesh);
  rot_mesh_moments m;
  ffi_guard guard;
  if (!rot_mesh_check_entries(&mesh).bad_faces) {
    unsigned char *used = (unsigned char *)R_alloc(mesh.vertices, 1);
    if (rot_mesh_mark_used(&mesh, used)) mesh.used = used;
  }
  ffi_guard_begin(&guard, progress);
  const rot_status status = Rf_asLogical(shell) == TRUE ? rot_mesh_shell(&mesh, &guard.hooks, &m)
                                                        : rot_mesh_solid(&mesh, &guard.hooks, &m);
  ffi_guard_end(&guard, status);
  const ffi_vector parts[] = {{1, &m.size},    {1, &m.size_error},
                              {3, m.centre},   {6, m.second_moment},
                              {1, &m.error},   {1, &m.coordinate_error},
                              {1, &m.reach},   {1, &m.area},
                              {1, &m.closure}, {3, m.lo},
                              {3, m.hi},       {1, &m.moved_error}};
  SEXP out = PROTECT(ffi_vectors(12, names, parts));
  SET_VECTOR_ELT(out, 12, Rf_mkString(rot_status_kind(status)));
  UNPROTECT(1);
  return out;
}
