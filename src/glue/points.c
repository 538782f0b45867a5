/* For R: point masses. */
#include "glue/ffi.h"

#include <stddef.h>
#include <string.h>

#include "body/points.h"

static rot_points read_points(SEXP mass, SEXP x, SEXP y, SEXP z, SEXP exponent) {
  R_xlen_t n = 1;
  rot_points points = {0};
  points.mass = ffi_column(mass, "mass", &n);
  points.x[0] = ffi_column(x, "x", &n);
  points.x[1] = ffi_column(y, "y", &n);
  points.x[2] = ffi_column(z, "z", &n);
  points.n = (size_t)n;
  points.mass_exponent = (int)ffi_real(exponent, "exponent");
  return points;
}

/* Moments in R: numbers in the order of the struct's members; R/body-points.R names them. */
enum { DOUBLES = offsetof(rot_moments, vanished) / sizeof(double), N = DOUBLES + 1 };

static rot_moments read_moments(SEXP x) {
  const double *v = ffi_reals(x, "moments", N);
  rot_moments m;
  memcpy(&m, v, DOUBLES * sizeof *v);
  m.vanished = v[DOUBLES] > 0.0;
  return m;
}

static void write_moments(const rot_moments *m, double v[]) {
  memcpy(v, m, DOUBLES * sizeof *v);
  v[DOUBLES] = (double)m->vanished;
}

/* => row (from 1, 0: none) and column (from 0) of the first invalid value */
SEXP ffi_points_bad(SEXP mass, SEXP x, SEXP y, SEXP z) {
  SEXP exponent = PROTECT(Rf_ScalarReal(0.0));
  const rot_points points = read_points(mass, x, y, z, exponent);
  int column = 0;
  const size_t row = rot_points_bad(&points, &column);
  UNPROTECT(1);
  return ffi_numbers(2, (const double[]){row < points.n ? (double)row + 1.0 : 0.0, column});
}

/* points => moments; NULL if a distance of points overflows */
SEXP ffi_points_moments(SEXP mass, SEXP x, SEXP y, SEXP z, SEXP exponent, SEXP progress) {
  const rot_points points = read_points(mass, x, y, z, exponent);
  rot_moments moments;
  ffi_guard guard;
  SEXP out = PROTECT(Rf_allocVector(REALSXP, N));
  ffi_guard_begin(&guard, progress);
  const rot_status status = rot_points_moments(&points, &guard.hooks, &moments);
  ffi_guard_end(&guard, status);
  write_moments(&moments, REAL(out));
  UNPROTECT(1);
  return status == ROT_OK ? out : R_NilValue;
}

SEXP ffi_points_join(SEXP a, SEXP b) {
  const rot_moments first = read_moments(a), second = read_moments(b);
  rot_moments both;
  SEXP out = PROTECT(Rf_allocVector(REALSXP, N));
  rot_moments_join(&first, &second, &both);
  write_moments(&both, REAL(out));
  UNPROTECT(1);
  return out;
}

/* => TRUE unless the mass or a moment over- or underflowed */
SEXP ffi_points_fit(SEXP moments) {
  const rot_moments m = read_moments(moments);
  return Rf_ScalarLogical(rot_moments_check(&m) == ROT_OK);
}

SEXP ffi_points_reach(SEXP x, SEXP y, SEXP z, SEXP moments) {
  SEXP one = PROTECT(Rf_ScalarReal(1.0)), none = PROTECT(Rf_ScalarReal(0.0));
  const rot_points points = read_points(one, x, y, z, none);
  const rot_moments m = read_moments(moments);
  SEXP out = Rf_ScalarReal(rot_points_reach(&points, &m));
  UNPROTECT(2);
  return out;
}
