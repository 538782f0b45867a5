/* For R: balls, hinged bodies, disks. */
#include "tables/impact.h"

#include "glue/run.h"

enum { MAX_COLUMNS = 9 };

/* columns: mass, radius, beta, vx, vy, omega, restitution, friction, tangential => columns after */
SEXP ffi_impact_bounce(SEXP list) {
  static const char *const names[] = {
      "vx_m_per_s",           "vy_m_per_s",    "omega_rad_per_s", "normal_impulse_n_s",
      "friction_impulse_n_s", "normal_loss_j", "friction_loss_j", "sticks"};
  rot_column in[MAX_COLUMNS];
  double *c[8], x[MAX_COLUMNS];
  const R_xlen_t n = ffi_columns_of(list, 9, in);
  SEXP out = ffi_columns(8, names, n, c);
  for (size_t i = 0; i < (size_t)n; i++) {
    rot_bounce row = {NA_REAL, NA_REAL, NA_REAL, NA_REAL, NA_REAL, NA_REAL, NA_REAL, 0};
    const int known = ffi_row_of(in, 9, (R_xlen_t)i, x);
    const rot_bounce_input input = {x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8]};
    if (known) row = rot_impact_bounce(&input);
    c[0][i] = row.vx;
    c[1][i] = row.vy;
    c[2][i] = row.omega;
    c[3][i] = row.normal_impulse;
    c[4][i] = row.friction_impulse;
    c[5][i] = row.normal_loss;
    c[6][i] = row.friction_loss;
    c[7][i] = known ? row.sticks : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}

/* columns: inertia, mass, centre, distance, omega, particle mass, particle v, restitution =>
 * columns after */
SEXP ffi_impact_hinged(SEXP list) {
  static const char *const names[] = {"omega_rad_per_s", "particle_v_m_per_s", "impulse_n_s",
                                      "hinge_impulse_n_s", "normal_loss_j"};
  rot_column in[MAX_COLUMNS];
  double *c[5], x[MAX_COLUMNS];
  const R_xlen_t n = ffi_columns_of(list, 8, in);
  SEXP out = ffi_columns(5, names, n, c);
  for (size_t i = 0; i < (size_t)n; i++) {
    rot_hinged row = {NA_REAL, NA_REAL, NA_REAL, NA_REAL, NA_REAL};
    const int known = ffi_row_of(in, 8, (R_xlen_t)i, x);
    const rot_hinged_input input = {x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]};
    if (known) row = rot_impact_hinged(&input);
    c[0][i] = row.omega;
    c[1][i] = row.particle_v;
    c[2][i] = row.impulse;
    c[3][i] = row.hinge_impulse;
    c[4][i] = row.loss;
  }
  UNPROTECT(1);
  return out;
}

/* columns: two inertias, two radii, two speeds, restitution, max impulse => columns after */
SEXP ffi_impact_rims(SEXP list) {
  static const char *const names[] = {"omega_1_rad_per_s", "omega_2_rad_per_s", "impulse_n_s",
                                      "friction_loss_j", "locked"};
  rot_column in[MAX_COLUMNS];
  double *c[5], x[MAX_COLUMNS];
  const R_xlen_t n = ffi_columns_of(list, 8, in);
  SEXP out = ffi_columns(5, names, n, c);
  for (size_t i = 0; i < (size_t)n; i++) {
    rot_rims row = {{NA_REAL, NA_REAL}, NA_REAL, NA_REAL, 0};
    const int known = ffi_row_of(in, 8, (R_xlen_t)i, x);
    const rot_rims_input input = {{x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]}, x[6], x[7]};
    if (known) row = rot_impact_rims(&input);
    c[0][i] = row.omega[0];
    c[1][i] = row.omega[1];
    c[2][i] = row.impulse;
    c[3][i] = row.loss;
    c[4][i] = known ? row.locked : NA_REAL;
  }
  UNPROTECT(1);
  return out;
}
