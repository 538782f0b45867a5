/* For R: polygons and tetrahedra. */
#include "glue/ffi.h"
#include "body/vertices.h"

/* => list of ffi_shapes_body() and the measure; or c(fault, edge, edge), edges from 1 */
static SEXP result(rot_status status, rot_vertices_fault fault, const rot_vertices_body *body) {
  if (status == ROT_ENOMEM) Rf_error("internal: out of memory");
  if (status != ROT_OK) {
    return ffi_numbers(3, (const double[]){(double)fault, (double)body->edge[0] + 1.0,
                                           (double)body->edge[1] + 1.0});
  }
  const double beta = NA_REAL;
  const ffi_vector parts[] = {
      {1, &body->mass_kg}, {6, body->second_kg_m2}, {3, body->centre_m}, {1, &body->reach_m},
      {1, &beta},          {1, &body->error},       {1, &body->measure}};
  return ffi_vectors(7, NULL, parts);
}

/* matrix of n rows and two columns => body */
SEXP ffi_vertices_polygon(SEXP vertices, SEXP amount, SEXP is_density, SEXP progress) {
  const R_xlen_t n = XLENGTH(vertices) / 2;
  rot_vertices_body body = {0};
  rot_vertices_fault fault;
  const double *v = ffi_reals(vertices, "vertices", 2 * n), by = ffi_real(amount, "amount");
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  const rot_status status =
      rot_polygon((size_t)n, v, by, Rf_asLogical(is_density) == TRUE, &guard.hooks, &body, &fault);
  ffi_guard_end(&guard, status);
  return result(status, fault, &body);
}

/* matrix of four rows and three columns => body */
SEXP ffi_vertices_tetrahedron(SEXP vertices, SEXP amount, SEXP is_density) {
  rot_vertices_body body = {0};
  rot_vertices_fault fault;
  const rot_status status =
      rot_tetrahedron(ffi_reals(vertices, "vertices", 12), ffi_real(amount, "amount"),
                      Rf_asLogical(is_density) == TRUE, &body, &fault);
  return result(status, fault, &body);
}
