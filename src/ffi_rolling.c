#include "ffi.h"
#include "rot_rolling.h"

/* One column in the domain of its quantity, or the place where it is not. */
typedef struct checked_column {
  rot_column column;
  double lo, hi;
} checked_column;

/* c(argument, row), both from 1, of the first value outside its domain; NULL if there is none. */
static SEXP first_outside(const checked_column *columns, int count, R_xlen_t n) {
  for (int j = 0; j < count; j++) {
    size_t row =
        rot_rolling_first_outside(columns[j].column, (size_t)n, columns[j].lo, columns[j].hi);
    if (row == (size_t)n) continue;
    SEXP place = Rf_allocVector(REALSXP, 2);
    REAL(place)[0] = j + 1;
    REAL(place)[1] = (double)row + 1;
    return place;
  }
  return R_NilValue;
}

static checked_column beta_column(SEXP x, R_xlen_t *n) {
  return (checked_column){ffi_column(x, "beta", n), 0.0, R_PosInf};
}
static checked_column angle_column(SEXP x, R_xlen_t *n) {
  return (checked_column){ffi_column(x, "incline_angle_deg", n), -90.0, 90.0};
}
static checked_column height_column(SEXP x, R_xlen_t *n) {
  return (checked_column){ffi_column(x, "height_drop_m", n), 0.0, R_PosInf};
}
static checked_column gravity_column(SEXP x, R_xlen_t *n) {
  return (checked_column){ffi_column(x, "gravity_m_per_s2", n), 0.0, R_PosInf};
}

/* A function of up to three columns, row by row: list(values), or the place of a bad one. */
typedef double (*row_function)(const double x[]);

static SEXP by_row(row_function f, const checked_column *columns, int count, R_xlen_t n) {
  SEXP bad = first_outside(columns, count, n);
  if (!Rf_isNull(bad)) return bad;
  SEXP values = PROTECT(Rf_allocVector(REALSXP, n)), out = PROTECT(Rf_allocVector(VECSXP, 1));
  double *to = REAL(values), x[3];
  for (R_xlen_t i = 0; i < n; i++) {
    for (int j = 0; j < count; j++) x[j] = rot_at(columns[j].column, (size_t)i);
    to[i] = f(x);
  }
  SET_VECTOR_ELT(out, 0, values);
  UNPROTECT(2);
  return out;
}

static double acceleration(const double x[]) { return rot_rolling_acceleration(x[0], x[1], x[2]); }
static double final_speed(const double x[]) { return rot_rolling_final_speed(x[0], x[1], x[2]); }
static double rotational(const double x[]) { return rot_rolling_rotational_fraction(x[0]); }
static double translational(const double x[]) { return rot_rolling_translational_fraction(x[0]); }
static double friction(const double x[]) { return rot_rolling_friction(x[0], x[1]); }

SEXP ffi_rolling_acceleration(SEXP beta, SEXP angle, SEXP gravity) {
  R_xlen_t n = 1;
  const checked_column in[] = {beta_column(beta, &n), angle_column(angle, &n),
                               gravity_column(gravity, &n)};
  return by_row(acceleration, in, 3, n);
}

SEXP ffi_rolling_final_speed(SEXP beta, SEXP height, SEXP gravity) {
  R_xlen_t n = 1;
  const checked_column in[] = {beta_column(beta, &n), height_column(height, &n),
                               gravity_column(gravity, &n)};
  return by_row(final_speed, in, 3, n);
}

SEXP ffi_rolling_rotational_fraction(SEXP beta) {
  R_xlen_t n = 1;
  const checked_column in[] = {beta_column(beta, &n)};
  return by_row(rotational, in, 1, n);
}

SEXP ffi_rolling_translational_fraction(SEXP beta) {
  R_xlen_t n = 1;
  const checked_column in[] = {beta_column(beta, &n)};
  return by_row(translational, in, 1, n);
}

SEXP ffi_rolling_friction(SEXP beta, SEXP angle) {
  R_xlen_t n = 1;
  const checked_column in[] = {beta_column(beta, &n), angle_column(angle, &n)};
  return by_row(friction, in, 2, n);
}

/* The table's four columns, or the place of a bad value. */
SEXP ffi_rolling_table(SEXP beta, SEXP angle, SEXP height, SEXP gravity, SEXP progress) {
  static const char *const names[] = {"acceleration_m_per_s2", "final_speed_m_per_s",
                                      "rotational_energy_fraction",
                                      "translational_energy_fraction"};
  R_xlen_t n = XLENGTH(beta) == 1 ? 1 : XLENGTH(beta);
  const checked_column in[] = {beta_column(beta, &n), angle_column(angle, &n),
                               height_column(height, &n), gravity_column(gravity, &n)};
  SEXP bad = first_outside(in, 4, n);
  if (!Rf_isNull(bad)) return bad;
  double *c[4];
  SEXP out = ffi_columns(4, names, n, c);
  const rot_rolling_input input = {in[0].column, in[1].column, in[2].column, in[3].column};
  const rot_rolling_output output = {c[0], c[1], c[2], c[3]};
  ffi_guard guard;
  rot_info info;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_rolling_table((size_t)n, &input, &output, &guard.hooks, &info));
  UNPROTECT(1);
  return out;
}
