/* For R: second moments and inertia tensors. */
#include "glue/ffi.h"
#include "body/inertia.h"
#include "ground/real.h"

/* symmetric 3 x 3 matrix, or its six numbers => tensor */
static void read_tensor(SEXP x, double t[ROT_TENSOR]) {
  if (XLENGTH(x) == ROT_TENSOR) {
    const double *six = ffi_reals(x, "tensor", ROT_TENSOR);
    for (int k = 0; k < ROT_TENSOR; k++) t[k] = six[k];
    return;
  }
  const double *m = ffi_reals(x, "tensor", 9);
  t[ROT_XX] = m[0];
  t[ROT_YY] = m[4];
  t[ROT_ZZ] = m[8];
  t[ROT_XY] = m[3];
  t[ROT_XZ] = m[6];
  t[ROT_YZ] = m[7];
}

static SEXP new_matrix(void) {
  static const char *const axes[] = {"x", "y", "z"};
  SEXP matrix = PROTECT(Rf_allocMatrix(REALSXP, 3, 3));
  SEXP names = PROTECT(Rf_allocVector(VECSXP, 2)), xyz = PROTECT(Rf_allocVector(STRSXP, 3));
  for (int i = 0; i < 3; i++) SET_STRING_ELT(xyz, i, Rf_mkChar(axes[i]));
  SET_VECTOR_ELT(names, 0, xyz);
  SET_VECTOR_ELT(names, 1, xyz);
  Rf_setAttrib(matrix, R_DimNamesSymbol, names);
  UNPROTECT(3);
  return matrix;
}

static SEXP write_tensor(const double t[]) {
  SEXP matrix = new_matrix();
  double *m = REAL(matrix);
  m[0] = t[ROT_XX];
  m[4] = t[ROT_YY];
  m[8] = t[ROT_ZZ];
  m[1] = m[3] = t[ROT_XY];
  m[2] = m[6] = t[ROT_XZ];
  m[5] = m[7] = t[ROT_YZ];
  return matrix;
}

/* matrix of R, by columns => matrix by rows */
static void read_rotation(SEXP x, double r[9]) {
  const double *m = ffi_reals(x, "rotation", 9);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) r[3 * i + j] = m[3 * j + i];
  }
}

/* second moment => list(second moment, inertia tensor) as matrices */
SEXP ffi_inertia_tensors(SEXP second) {
  double c[ROT_TENSOR], inertia[ROT_TENSOR];
  read_tensor(second, c);
  rot_inertia_of_second(c, inertia);
  SEXP out = PROTECT(Rf_allocVector(VECSXP, 2));
  SET_VECTOR_ELT(out, 0, write_tensor(c));
  SET_VECTOR_ELT(out, 1, write_tensor(inertia));
  UNPROTECT(1);
  return out;
}

SEXP ffi_inertia_second(SEXP inertia) {
  double c[ROT_TENSOR], t[ROT_TENSOR];
  read_tensor(inertia, t);
  rot_inertia_to_second(t, c);
  return write_tensor(c);
}

/* inertia tensor => about the point at -sign d from its reference point */
SEXP ffi_inertia_shift(SEXP inertia, SEXP mass, SEXP d, SEXP sign) {
  double t[ROT_TENSOR], out[ROT_TENSOR];
  read_tensor(inertia, t);
  rot_inertia_shift(ffi_real(mass, "mass"), ffi_reals(d, "d", 3), ffi_real(sign, "sign"), t, out);
  return write_tensor(out);
}

/* second moment => inertia tensor about the point at -d from the centre, in the axes given by the
 * columns of `axes` */
SEXP ffi_inertia_about(SEXP second, SEXP mass, SEXP d, SEXP axes) {
  double c[ROT_TENSOR], moved[ROT_TENSOR], inertia[ROT_TENSOR];
  read_tensor(second, c);
  rot_inertia_shift_second(ffi_real(mass, "mass"), ffi_reals(d, "d", 3), 1.0, c, moved);
  if (!Rf_isNull(axes)) {
    /* R's columns read as rows are the transpose, which transforms components to the new axes. */
    rot_inertia_rotate(ffi_reals(axes, "axes", 9), moved, c);
    for (int k = 0; k < ROT_TENSOR; k++) moved[k] = c[k];
  }
  rot_inertia_of_second(moved, inertia);
  return write_tensor(inertia);
}

SEXP ffi_inertia_axis(SEXP mass, SEXP centre, SEXP second, SEXP axis, SEXP point) {
  rot_inertial body = {ffi_real(mass, "mass"), {0.0, 0.0, 0.0}, {0.0}};
  const double *g = ffi_reals(centre, "centre", 3);
  for (int i = 0; i < 3; i++) body.centre_m[i] = g[i];
  read_tensor(second, body.second_kg_m2);
  return Rf_ScalarReal(
      rot_inertia_axis(&body, ffi_reals(axis, "axis", 3), ffi_reals(point, "point", 3)));
}

SEXP ffi_inertia_principal(SEXP second, SEXP tolerance) {
  static const char *const names[] = {"second", "moment", "axes", "equal", ""};
  double c[ROT_TENSOR];
  rot_principal p;
  read_tensor(second, c);
  /* Fails only for numbers that are not finite, which R has excluded. */
  if (rot_inertia_principal(c, ffi_real(tolerance, "tolerance"), &p) != ROT_OK) {
    Rf_error("internal: `second`");
  }
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, ffi_numbers(3, p.second));
  SET_VECTOR_ELT(out, 1, ffi_numbers(3, p.moment));
  SET_VECTOR_ELT(out, 2, Rf_allocMatrix(REALSXP, 3, 3));
  SET_VECTOR_ELT(out, 3, Rf_allocVector(LGLSXP, 2));
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) REAL(VECTOR_ELT(out, 2))[3 * k + i] = p.axes[3 * i + k];
  }
  LOGICAL(VECTOR_ELT(out, 3))[0] = p.equal12;
  LOGICAL(VECTOR_ELT(out, 3))[1] = p.equal23;
  UNPROTECT(1);
  return out;
}

SEXP ffi_inertia_sine(SEXP angle_deg) {
  return Rf_ScalarReal(rot_sin_deg(ffi_real(angle_deg, "angle_deg")));
}

/* (second moment, rotation) => second moment of the rotated body */
SEXP ffi_inertia_rotate(SEXP second, SEXP rotation) {
  double c[ROT_TENSOR], r[9], out[ROT_TENSOR];
  read_tensor(second, c);
  read_rotation(rotation, r);
  rot_inertia_rotate(r, c, out);
  return write_tensor(out);
}

/* n masses, 3 x n centres, 6 x n second moments => those of all parts as one body; NULL if a sum
 * overflows */
SEXP ffi_inertia_join(SEXP mass, SEXP centre, SEXP second) {
  static const char *const names[] = {"mass_kg", "centre_m", "second_kg_m2", "error", ""};
  const R_xlen_t n = XLENGTH(mass);
  const double *m = ffi_reals(mass, "mass", n), *g = ffi_reals(centre, "centre", 3 * n),
               *c = ffi_reals(second, "second", ROT_TENSOR * n);
  rot_inertial *part = (rot_inertial *)R_alloc((size_t)n, sizeof *part), whole;
  double error = 0.0;
  for (R_xlen_t i = 0; i < n; i++) {
    part[i].mass_kg = m[i];
    for (int k = 0; k < 3; k++) part[i].centre_m[k] = g[3 * i + k];
    for (int k = 0; k < ROT_TENSOR; k++) part[i].second_kg_m2[k] = c[ROT_TENSOR * i + k];
  }
  if (rot_inertia_join((size_t)n, part, &whole, &error) != ROT_OK) return R_NilValue;
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SET_VECTOR_ELT(out, 0, Rf_ScalarReal(whole.mass_kg));
  SET_VECTOR_ELT(out, 1, ffi_numbers(3, whole.centre_m));
  SET_VECTOR_ELT(out, 2, write_tensor(whole.second_kg_m2));
  SET_VECTOR_ELT(out, 3, Rf_ScalarReal(error));
  UNPROTECT(1);
  return out;
}
