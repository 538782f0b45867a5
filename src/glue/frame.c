/* For R: rotating frames. */
#include "tables/frame.h"

#include "glue/run.h"

enum { MAX_COLUMNS = 12 };
static const double pi = 0x1.921fb54442d18p+1;

/* columns: time, latitude, velocity east, north, up, gravity, rate of rotation => 13 columns */
SEXP ffi_frame_projectile(SEXP list) {
  static const char *const names[] = {"east_m",
                                      "north_m",
                                      "up_m",
                                      "east_m_per_s",
                                      "north_m_per_s",
                                      "up_m_per_s",
                                      "deflection_east_m",
                                      "deflection_north_m",
                                      "deflection_up_m",
                                      "first_order_east_m",
                                      "first_order_north_m",
                                      "first_order_up_m",
                                      "first_order_error_m"};
  rot_column in[7];
  double *column[13], x[7];
  const R_xlen_t n = ffi_columns_of(list, 7, in);
  SEXP out = ffi_columns(13, names, n, column);
  for (R_xlen_t i = 0; i < n; i++) {
    const int known = ffi_row_of(in, 7, i, x);
    const rot_projectile_input input = {x[6], x[1], x[5], {x[2], x[3], x[4]}, x[0]};
    const rot_projectile row = rot_frame_projectile(&input);
    for (int k = 0; k < 3; k++) {
      column[k][i] = known ? row.r_m[k] : NA_REAL;
      column[3 + k][i] = known ? row.v_m_per_s[k] : NA_REAL;
      column[6 + k][i] = known ? row.deflection_m[k] : NA_REAL;
      column[9 + k][i] = known ? row.first_order_m[k] : NA_REAL;
    }
    column[12][i] = known ? row.first_order_error_m : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* columns: rate of rotation, latitude, gravity, height => times */
SEXP ffi_frame_fall_time(SEXP list) {
  rot_column in[4];
  double x[4];
  const R_xlen_t n = ffi_columns_of(list, 4, in);
  SEXP out = PROTECT(Rf_allocVector(REALSXP, n));
  for (R_xlen_t i = 0; i < n; i++) {
    const int known = ffi_row_of(in, 4, i, x);
    REAL(out)[i] = known ? rot_frame_fall_time(x[0], x[1], x[2], x[3]) : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* columns: rate of rotation, latitude, gravity, length, east, north, velocities, time => position,
 * velocity, rate of the plane, period of the swing */
SEXP ffi_frame_foucault(SEXP list) {
  static const char *const names[] = {
      "east_m",        "north_m", "east_m_per_s", "north_m_per_s", "plane_rate_rad_per_s",
      "swing_period_s"};
  rot_column in[9];
  double *column[6], x[9];
  const R_xlen_t n = ffi_columns_of(list, 9, in);
  SEXP out = ffi_columns(6, names, n, column);
  for (R_xlen_t i = 0; i < n; i++) {
    double r[2], v[2], rate, swings;
    const int known = ffi_row_of(in, 9, i, x);
    rot_frame_foucault(x[0], x[1], x[2], x[3], x + 4, x + 6, x[8], r, v, &rate, &swings);
    for (int k = 0; k < 2; k++) {
      column[k][i] = known ? r[k] : NA_REAL;
      column[2 + k][i] = known ? v[k] : NA_REAL;
    }
    column[4][i] = known ? rate : NA_REAL;
    column[5][i] = known ? 2.0 * pi / swings : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* columns: rate, beta, time => angles of rot_frame_angle() */
SEXP ffi_frame_angle(SEXP list) {
  rot_column in[3];
  double x[3];
  const R_xlen_t n = ffi_columns_of(list, 3, in);
  SEXP out = PROTECT(ffi_new_column(n));
  for (R_xlen_t i = 0; i < n; i++) {
    const int known = ffi_row_of(in, 3, i, x);
    REAL(out)[i] = known ? rot_frame_angle(x[0], x[1], x[2]) : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* columns: position, velocity, acceleration (three each); angle, rate, acceleration of the frame =>
 * the nine in the other frame; centrifugal, Coriolis and Euler accelerations in the rotating frame.
 * `axis`: unit vector; `enters`: TRUE for inertial to rotating. */
SEXP ffi_frame_carry(SEXP list, SEXP axis, SEXP enters) {
  static const char *const names[] = {"x_m",
                                      "y_m",
                                      "z_m",
                                      "vx_m_per_s",
                                      "vy_m_per_s",
                                      "vz_m_per_s",
                                      "ax_m_per_s2",
                                      "ay_m_per_s2",
                                      "az_m_per_s2",
                                      "centrifugal_x_m_per_s2",
                                      "centrifugal_y_m_per_s2",
                                      "centrifugal_z_m_per_s2",
                                      "coriolis_x_m_per_s2",
                                      "coriolis_y_m_per_s2",
                                      "coriolis_z_m_per_s2",
                                      "euler_x_m_per_s2",
                                      "euler_y_m_per_s2",
                                      "euler_z_m_per_s2"};
  rot_column in[MAX_COLUMNS];
  double *column[18], x[MAX_COLUMNS];
  const R_xlen_t n = ffi_columns_of(list, MAX_COLUMNS, in);
  const double *unit = ffi_reals(axis, "axis", 3);
  const int enter = Rf_asLogical(enters) == TRUE;
  SEXP out = ffi_columns(18, names, n, column);
  for (R_xlen_t i = 0; i < n; i++) {
    double y[18];
    (void)ffi_row_of(in, MAX_COLUMNS, i, x);
    const rot_frame frame = {{unit[0], unit[1], unit[2]}, x[9], x[10], x[11]};
    if (enter) {
      rot_frame_enter(&frame, x, x + 3, x + 6, y, y + 3, y + 6);
      rot_frame_terms(&frame, y, y + 3, y + 9, y + 12, y + 15);
    } else {
      rot_frame_leave(&frame, x, x + 3, x + 6, y, y + 3, y + 6);
      rot_frame_terms(&frame, x, x + 3, y + 9, y + 12, y + 15);
    }
    for (int k = 0; k < 18; k++) column[k][i] = y[k];
  }
  UNPROTECT(1);
  return out;
}
