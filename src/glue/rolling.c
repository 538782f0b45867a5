/* For R: rolling; first value outside its domain. */
#include "glue/ffi.h"
#include "tables/rolling.h"

/* The arguments and their domains. */
enum { BETA, ANGLE, HEIGHT, GRAVITY, ARGUMENTS };

static const struct {
  const char *name;
  double lo, hi;
} domains[ARGUMENTS] = {
    {"beta", 0.0, HUGE_VAL},
    {"incline_angle_deg", -90.0, 90.0},
    {"height_drop_m", 0.0, HUGE_VAL},
    {"gravity_m_per_s2", 0.0, HUGE_VAL},
};

/* arguments `which` => columns; returns c(argument, row, min, max) of the first value outside its
 * domain, argument and row from 1, or NULL */
static SEXP read_columns(const SEXP x[], const int which[], int count, rot_column to[],
                         R_xlen_t *n) {
  for (int j = 0; j < count; j++) to[j] = ffi_column(x[j], domains[which[j]].name, n);
  for (int j = 0; j < count; j++) {
    const double lo = domains[which[j]].lo, hi = domains[which[j]].hi;
    const size_t row = rot_rolling_first_outside(to[j], (size_t)*n, lo, hi);
    if (row == (size_t)*n) continue;
    return ffi_numbers(4, (const double[]){j + 1, (double)row + 1, lo, hi});
  }
  return R_NilValue;
}

static double acceleration(const double x[]) { return rot_rolling_acceleration(x[0], x[1], x[2]); }
static double final_speed(const double x[]) { return rot_rolling_final_speed(x[0], x[1], x[2]); }
static double rotational(const double x[]) { return rot_rolling_rotational_fraction(x[0]); }
static double translational(const double x[]) { return rot_rolling_translational_fraction(x[0]); }
static double friction(const double x[]) { return rot_rolling_friction(x[0], x[1]); }

static const struct {
  double (*value)(const double x[]);
  int count, arguments[3];
} functions[] = {
    {acceleration, 3, {BETA, ANGLE, GRAVITY}},
    {final_speed, 3, {BETA, HEIGHT, GRAVITY}},
    {rotational, 1, {BETA}},
    {translational, 1, {BETA}},
    {friction, 2, {BETA, ANGLE}},
};

/* columns => list(values of function `which`, from 1), or the position of an invalid value */
SEXP ffi_rolling_value(SEXP which, SEXP columns) {
  const int f = Rf_asInteger(which) - 1;
  if (f < 0 || f >= (int)(sizeof functions / sizeof functions[0])) {
    Rf_error("internal: no such function of rolling");
  }
  if (TYPEOF(columns) != VECSXP || XLENGTH(columns) != functions[f].count) {
    Rf_error("internal: columns of another function of rolling");
  }
  SEXP in[3];
  rot_column column[3];
  R_xlen_t n = 1;
  for (int j = 0; j < functions[f].count; j++) in[j] = VECTOR_ELT(columns, j);
  SEXP bad = read_columns(in, functions[f].arguments, functions[f].count, column, &n);
  if (!Rf_isNull(bad)) return bad;
  static const char *const names[] = {"value"};
  double *to, x[3];
  SEXP out = ffi_columns(1, names, n, &to);
  for (R_xlen_t i = 0; i < n; i++) {
    for (int j = 0; j < functions[f].count; j++) x[j] = rot_at(column[j], (size_t)i);
    to[i] = functions[f].value(x);
  }
  UNPROTECT(1);
  return out;
}

/* => the four columns of the table, or the position of an invalid value */
SEXP ffi_rolling_table(SEXP beta, SEXP angle, SEXP height, SEXP gravity, SEXP progress) {
  static const char *const names[] = {"acceleration_m_per_s2", "final_speed_m_per_s",
                                      "rotational_energy_fraction",
                                      "translational_energy_fraction"};
  static const int all[ARGUMENTS] = {BETA, ANGLE, HEIGHT, GRAVITY};
  const SEXP x[ARGUMENTS] = {beta, angle, height, gravity};
  rot_column in[ARGUMENTS];
  R_xlen_t n = XLENGTH(beta);
  SEXP bad = read_columns(x, all, ARGUMENTS, in, &n);
  if (!Rf_isNull(bad)) return bad;
  double *c[4];
  SEXP out = ffi_columns(4, names, n, c);
  const rot_rolling_input input = {in[BETA], in[ANGLE], in[HEIGHT], in[GRAVITY]};
  const rot_rolling_output output = {c[0], c[1], c[2], c[3]};
  ffi_guard guard;
  rot_info info;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_rolling_table((size_t)n, &input, &output, &guard.hooks, &info));
  UNPROTECT(1);
  return out;
}
