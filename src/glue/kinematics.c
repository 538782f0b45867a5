/* For R: angular motion by row, motion of a point of the body, units of angles. */
#include "glue/ffi.h"
#include "tables/kinematics.h"

static const char *const motion_names[ROT_MOTION_SIZE] = {
    "theta_rad", "omega0_rad_per_s", "omega_rad_per_s", "alpha_rad_per_s2", "time_s"};

typedef struct motion_input {
  unsigned given;
  rot_column column[ROT_MOTION_SIZE];
} motion_input;

/* list of five columns => input; NULL: a quantity to be computed */
static motion_input read_motion(SEXP list, R_xlen_t *n) {
  motion_input in = {0, {{NULL, 0}}};
  if (TYPEOF(list) != VECSXP || XLENGTH(list) != ROT_MOTION_SIZE) Rf_error("internal: `columns`");
  for (int i = 0; i < ROT_MOTION_SIZE; i++) {
    if (Rf_isNull(VECTOR_ELT(list, i))) continue;
    in.column[i] = ffi_column(VECTOR_ELT(list, i), motion_names[i], n);
    in.given |= 1U << i;
  }
  return in;
}

static rot_motion_kind solve_row(const motion_input *in, R_xlen_t row,
                                 double x[2][ROT_MOTION_SIZE]) {
  for (unsigned i = 0; i < ROT_MOTION_SIZE; i++) {
    if (in->given >> i & 1U) x[0][i] = rot_at(in->column[i], (size_t)row);
  }
  if (row % 65536 == 65535) R_CheckUserInterrupt(); /* the core has no memory allocated */
  return rot_motion_solve(in->given, x);
}

/* => rows of the result: one per given row, one per second root */
static R_xlen_t count_rows(const motion_input *in, R_xlen_t n) {
  double x[2][ROT_MOTION_SIZE];
  R_xlen_t rows = n;
  for (R_xlen_t i = 0; i < n; i++) rows += solve_row(in, i, x) == ROT_MOTION_TWO;
  return rows;
}

/* => the five columns; `row` and `root` (from 1); `kind`: 0 impossible, -1 undetermined */
SEXP ffi_angular_motion(SEXP columns) {
  const char *names[ROT_MOTION_SIZE + 3];
  double *to[ROT_MOTION_SIZE + 3], x[2][ROT_MOTION_SIZE];
  R_xlen_t n = 1, at = 0;
  const motion_input in = read_motion(columns, &n);
  for (int i = 0; i < ROT_MOTION_SIZE; i++) names[i] = motion_names[i];
  names[ROT_MOTION_SIZE] = "row";
  names[ROT_MOTION_SIZE + 1] = "root";
  names[ROT_MOTION_SIZE + 2] = "kind";
  SEXP out = ffi_columns(ROT_MOTION_SIZE + 3, names, count_rows(&in, n), to);
  for (R_xlen_t i = 0; i < n; i++) {
    const rot_motion_kind kind = solve_row(&in, i, x);
    for (int k = 0; k < (kind == ROT_MOTION_TWO ? 2 : 1); k++, at++) {
      for (int j = 0; j < ROT_MOTION_SIZE; j++) to[j][at] = x[k][j];
      to[ROT_MOTION_SIZE][at] = (double)i + 1.0;
      to[ROT_MOTION_SIZE + 1][at] = k + 1;
      to[ROT_MOTION_SIZE + 2][at] = kind;
    }
  }
  UNPROTECT(1);
  return out;
}

/* => the five columns of point_motion() */
SEXP ffi_point_motion(SEXP omega, SEXP alpha, SEXP radius) {
  static const char *const names[] = {
      "tangential_speed_m_per_s", "tangential_acceleration_m_per_s2",
      "centripetal_acceleration_m_per_s2", "total_acceleration_m_per_s2", "acceleration_angle_rad"};
  R_xlen_t n = 1;
  const rot_column w = ffi_column(omega, "omega_rad_per_s", &n);
  const rot_column a = ffi_column(alpha, "alpha_rad_per_s2", &n);
  const rot_column r = ffi_column(radius, "radius_m", &n);
  double *to[5];
  SEXP out = ffi_columns(5, names, n, to);
  for (R_xlen_t i = 0; i < n; i++) {
    const double wi = rot_at(w, (size_t)i), ai = rot_at(a, (size_t)i), ri = rot_at(r, (size_t)i);
    to[0][i] = rot_tangential_speed(wi, ri);
    to[1][i] = rot_tangential_acceleration(ai, ri);
    to[2][i] = rot_centripetal_acceleration(wi, ri);
    to[3][i] = rot_total_acceleration(wi, ai, ri);
    to[4][i] = rot_acceleration_angle(wi, ai);
  }
  UNPROTECT(1);
  return out;
}

/* Vectors of three finite numbers. */
SEXP ffi_moment(SEXP factor, SEXP position, SEXP about, SEXP vector) {
  double out[3];
  rot_moment(ffi_real(factor, "factor"), ffi_reals(position, "position", 3),
             ffi_reals(about, "about", 3), ffi_reals(vector, "vector", 3), out);
  return ffi_numbers(3, out);
}

SEXP ffi_lever(SEXP factor, SEXP radius, SEXP size, SEXP angle_deg) {
  R_xlen_t n = 1;
  const rot_column m = ffi_column(factor, "factor", &n), r = ffi_column(radius, "radius", &n);
  const rot_column f = ffi_column(size, "size", &n), a = ffi_column(angle_deg, "angle_deg", &n);
  SEXP out = PROTECT(ffi_new_column(n));
  double *to = REAL(out);
  for (R_xlen_t i = 0; i < n; i++) {
    const size_t at = (size_t)i;
    to[i] = rot_lever(rot_at(m, at), rot_at(r, at), rot_at(f, at), rot_at(a, at));
  }
  UNPROTECT(1);
  return out;
}

/* `unit`: index from 0 in ROT_ANGLE_UNIT_LIST. */
SEXP ffi_convert_angle(SEXP x, SEXP unit) {
  const double u = ffi_real(unit, "unit");
  if (!(u >= 0 && u < ROT_ANGLE_UNIT_COUNT)) Rf_error("internal: `unit`");
  const double *from = ffi_reals(x, "x", -1);
  const R_xlen_t n = XLENGTH(x);
  SEXP out = PROTECT(ffi_new_column(n));
  double *to = REAL(out);
  for (R_xlen_t i = 0; i < n; i++) to[i] = rot_convert_angle(from[i], (rot_angle_unit)u);
  UNPROTECT(1);
  return out;
}
