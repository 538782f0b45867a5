#include "ffi.h"
#include "rot_vertices.h"

/* As ffi_shapes_body() gives it, the measure behind; or c(fault, edge, edge), edges from 1. */
static SEXP result(rot_status status, rot_vertices_fault fault, const rot_vertices_body *body) {
  if (status == ROT_ENOMEM) Rf_error("internal: out of memory");
  if (status != ROT_OK) {
    SEXP out = Rf_allocVector(REALSXP, 3);
    REAL(out)[0] = (double)fault;
    REAL(out)[1] = (double)body->edge[0] + 1.0;
    REAL(out)[2] = (double)body->edge[1] + 1.0;
    return out;
  }
  const double beta = NA_REAL;
  const double *parts[] = {&body->mass_kg, body->second_kg_m2, body->centre_m, &body->reach_m,
                           &beta,          &body->error,       &body->measure};
  const int lengths[] = {1, 6, 3, 1, 1, 1, 1};
  SEXP out = PROTECT(Rf_allocVector(VECSXP, 7));
  for (int i = 0; i < 7; i++) {
    SET_VECTOR_ELT(out, i, Rf_allocVector(REALSXP, lengths[i]));
    for (int k = 0; k < lengths[i]; k++) REAL(VECTOR_ELT(out, i))[k] = parts[i][k];
  }
  UNPROTECT(1);
  return out;
}

/* `vertices` is a matrix of n rows and two columns. */
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

/* A matrix of four rows and three columns. */
SEXP ffi_vertices_tetrahedron(SEXP vertices, SEXP amount, SEXP is_density) {
  rot_vertices_body body = {0};
  rot_vertices_fault fault;
  const rot_status status =
      rot_tetrahedron(ffi_reals(vertices, "vertices", 12), ffi_real(amount, "amount"),
                      Rf_asLogical(is_density) == TRUE, &body, &fault);
  return result(status, fault, &body);
}
