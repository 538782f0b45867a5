/* For R: bodies released together on an incline. */
#include "scene/incline/race.h"

#include <string.h>

#include "glue/run.h"

/* columns of bodies => motion of each body from rest, columns of scene/incline/race.h */
SEXP ffi_incline_starts(SEXP bodies_in, SEXP progress) {
  static const char *const names[] = {ROT_RACE_COLUMNS(FFI_COLUMN_NAME) ""};
  R_xlen_t rows = 1, at = 0;
#define IN(name) ffi_column(ffi_element(bodies_in, #name), #name, &rows)
  rot_race_bodies in = {0,
                        IN(beta),
                        IN(radius_m),
                        IN(incline_angle_deg),
                        IN(gravity_m_per_s2),
                        IN(static_friction),
                        IN(kinetic_friction),
                        IN(rolling_arm_m),
                        IN(length_m)};
#undef IN
  in.n = (size_t)rows;
  SEXP columns = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  rot_race_columns out;
  ROT_RACE_COLUMNS(FFI_COLUMN_NEW)
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_race_starts(&in, &out, &guard.hooks, &info));
  UNPROTECT(1);
  return columns;
}

/* (columns above, times) => rows of all bodies at each time, ordered by time */
SEXP ffi_incline_frames(SEXP starts, SEXP time_s, SEXP progress) {
  static const char *const names[] = {"lane",      "time_s",          "x_m",      "v_m_per_s",
                                      "theta_rad", "omega_rad_per_s", "finished", ""};
  const double *t = ffi_reals(time_s, "time_s", -1);
  const double *a = ffi_numbers_of(starts, "acceleration_m_per_s2", -1);
  const R_xlen_t n = XLENGTH(ffi_element(starts, "acceleration_m_per_s2")), times = XLENGTH(time_s);
  const double *turn = ffi_numbers_of(starts, "angular_acceleration_rad_per_s2", n);
  const double *finish = ffi_numbers_of(starts, "finish_time_s", n);
  SEXP columns = PROTECT(Rf_mkNamed(VECSXP, (const char **)names)), lane;
  const R_xlen_t rows = n * times;
  SET_VECTOR_ELT(columns, 0, lane = Rf_allocVector(INTSXP, rows));
  rot_race_frames out;
  out.time_s = ffi_new_double(columns, 1, rows);
  out.x_m = ffi_new_double(columns, 2, rows);
  out.v_m_per_s = ffi_new_double(columns, 3, rows);
  out.theta_rad = ffi_new_double(columns, 4, rows);
  out.omega_rad_per_s = ffi_new_double(columns, 5, rows);
  out.finished = ffi_new_int(columns, 6, rows);
  rot_info info;
  ffi_guard guard;
  ffi_guard_begin(&guard, progress);
  ffi_guard_end(&guard, rot_race_run((size_t)n, a, turn, finish, (size_t)times, t, &out,
                                     &guard.hooks, &info));
  int *number = INTEGER(lane);
  for (R_xlen_t i = 0; i < n && times; i++) number[i] = (int)(i + 1);
  for (R_xlen_t k = 1; k < times; k++) memcpy(number + k * n, number, (size_t)n * sizeof *number);
  UNPROTECT(1);
  return columns;
}
