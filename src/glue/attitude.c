/* For R: attitudes by row. */
#include <math.h>

#include "glue/ffi.h"
#include "maths/attitude.h"

enum { MAX = ROT_FORM_MAX };

/* list => columns, common number of rows *n; returns the count of columns */
static int read_columns(SEXP list, rot_column columns[], R_xlen_t *n) {
  if (TYPEOF(list) != VECSXP || XLENGTH(list) > MAX) Rf_error("internal: no list of columns");
  const int count = (int)XLENGTH(list);
  *n = 1;
  for (int k = 0; k < count; k++) columns[k] = ffi_column(VECTOR_ELT(list, k), "column", n);
  return count;
}

static void check_count(int count, int wanted) {
  if (count != wanted) Rf_error("internal: a wrong number of columns");
}

static rot_attitude_form form_of(SEXP form) {
  const int code = (int)ffi_real(form, "form");
  if (code < 0 || code >= ROT_FORM_COUNT) Rf_error("internal: no such form of attitudes");
  return (rot_attitude_form)code;
}

/* c(axis, axis, axis, intrinsic), used by Euler angles only => sequence */
static rot_euler sequence_of(SEXP x, rot_attitude_form form) {
  rot_euler out = {{0, 1, 2}, 0};
  if (form != ROT_FORM_EULER) return out;
  const double *numbers = ffi_reals(x, "sequence", 4);
  for (int i = 0; i < 3; i++) {
    out.axis[i] = (int)numbers[i];
    if (out.axis[i] < 0 || out.axis[i] > 2 || (i && out.axis[i] == out.axis[i - 1])) {
      Rf_error("internal: no such sequence");
    }
  }
  out.intrinsic = numbers[3] != 0.0;
  return out;
}

static int any_nan(int n, const double x[]) {
  for (int i = 0; i < n; i++) {
    if (ISNAN(x[i])) return 1;
  }
  return 0;
}

/* => list(qw, qx, qy, qz, off) with the size `off` of the correction; a row with NaN is NA */
SEXP ffi_attitude_from(SEXP form, SEXP columns, SEXP sequence) {
  static const char *const names[] = {"qw", "qx", "qy", "qz", "off"};
  rot_column in[MAX];
  R_xlen_t n;
  double *out[5];
  const rot_attitude_form of = form_of(form);
  const rot_euler order = sequence_of(sequence, of);
  const int count = read_columns(columns, in, &n);
  check_count(count, rot_attitude_numbers(of));
  SEXP list = ffi_columns(5, names, n, out);
  for (size_t i = 0; i < (size_t)n; i++) {
    double x[MAX], q[4] = {NA_REAL, NA_REAL, NA_REAL, NA_REAL}, off = NA_REAL;
    for (int k = 0; k < count; k++) x[k] = rot_at(in[k], i);
    if (!any_nan(count, x)) off = rot_attitude_from(of, x, &order, q);
    for (int k = 0; k < 4; k++) out[k][i] = q[k];
    out[4][i] = off;
  }
  UNPROTECT(1);
  return list;
}

/* unit quaternions => columns of a form and a logical column, gimbal lock */
SEXP ffi_attitude_to(SEXP form, SEXP quaternion, SEXP sequence) {
  rot_column in[MAX];
  R_xlen_t n;
  double *out[MAX];
  const rot_attitude_form of = form_of(form);
  const rot_euler order = sequence_of(sequence, of);
  check_count(read_columns(quaternion, in, &n), 4);
  const int count = rot_attitude_numbers(of);
  SEXP list = PROTECT(Rf_allocVector(VECSXP, count + 1)), lock;
  for (int k = 0; k < count; k++) {
    SET_VECTOR_ELT(list, k, ffi_new_column(n));
    out[k] = REAL(VECTOR_ELT(list, k));
  }
  SET_VECTOR_ELT(list, count, lock = Rf_allocVector(LGLSXP, n));
  for (size_t i = 0; i < (size_t)n; i++) {
    double q[4], x[MAX];
    for (int k = 0; k < 4; k++) q[k] = rot_at(in[k], i);
    const int known = !any_nan(4, q);
    LOGICAL(lock)[i] = known ? rot_attitude_to(of, q, &order, x) : NA_LOGICAL;
    for (int k = 0; k < count; k++) out[k][i] = known ? x[k] : NA_REAL;
  }
  UNPROTECT(1);
  return list;
}

/* Two attitudes of 4 columns => which = 1: product, 2: interpolation at a fraction (ninth column),
 * 3: angle of the rotation between them. */
SEXP ffi_attitude_pair(SEXP which, SEXP columns) {
  static const char *const names[] = {"qw", "qx", "qy", "qz"};
  static const char *const angle[] = {"angle_rad"};
  rot_column in[MAX];
  R_xlen_t n;
  double *out[4];
  const int what = (int)ffi_real(which, "which");
  check_count(read_columns(columns, in, &n), what == 2 ? 9 : 8);
  SEXP list = what == 3 ? ffi_columns(1, angle, n, out) : ffi_columns(4, names, n, out);
  for (size_t i = 0; i < (size_t)n; i++) {
    double x[MAX] = {0.0}, q[4] = {NA_REAL, NA_REAL, NA_REAL, NA_REAL};
    for (int k = 0; k < (what == 2 ? 9 : 8); k++) x[k] = rot_at(in[k], i);
    if (!any_nan(MAX, x)) {
      if (what == 1) rot_attitude_times(x, x + 4, q);
      if (what == 2) rot_attitude_slerp(x, x + 4, x[8], q);
      if (what == 3) q[0] = rot_attitude_angle(x, x + 4);
    }
    for (int k = 0; k < (what == 3 ? 1 : 4); k++) out[k][i] = q[k];
  }
  UNPROTECT(1);
  return list;
}

/* 4 columns of attitudes, 3 of vectors => the vectors in space, or in the body */
SEXP ffi_attitude_turn(SEXP columns, SEXP to_space) {
  static const char *const names[] = {"x", "y", "z"};
  rot_column in[MAX];
  R_xlen_t n;
  double *out[3];
  const int space = ffi_real(to_space, "to_space") != 0.0;
  check_count(read_columns(columns, in, &n), 7);
  SEXP list = ffi_columns(3, names, n, out);
  for (size_t i = 0; i < (size_t)n; i++) {
    double x[7], v[3] = {NA_REAL, NA_REAL, NA_REAL};
    for (int k = 0; k < 7; k++) x[k] = rot_at(in[k], i);
    if (!any_nan(7, x)) {
      /* Vectors so long that the terms of a component overflow. */
      const int large = fmax(fabs(x[4]), fmax(fabs(x[5]), fabs(x[6]))) > 1e305;
      for (int k = 4; k < 7 && large; k++) x[k] *= 0x1p-10;
      if (space) {
        rot_attitude_to_space(x, x + 4, v);
      } else {
        rot_attitude_to_body(x, x + 4, v);
      }
      for (int k = 0; k < 3 && large; k++) v[k] *= 0x1p10;
    }
    for (int k = 0; k < 3; k++) out[k][i] = v[k];
  }
  UNPROTECT(1);
  return list;
}
