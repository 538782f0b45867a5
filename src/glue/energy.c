/* For R: kinetic energies. */
#include "glue/ffi.h"
#include "tables/energy.h"

/* four columns, recycled => columns of energies */
SEXP ffi_energy_partition(SEXP mass, SEXP radius, SEXP beta, SEXP speed) {
  static const char *const names[] = {"moment_of_inertia_kg_m2", "omega_rad_per_s",
                                      "translational_kinetic_energy_j",
                                      "rotational_kinetic_energy_j", "total_kinetic_energy_j"};
  R_xlen_t n = 1;
  rot_energy_input in = {ffi_column(mass, "mass_kg", &n), ffi_column(radius, "radius_m", &n),
                         ffi_column(beta, "beta", &n), ffi_column(speed, "speed_m_per_s", &n)};
  double *c[5];
  SEXP out = ffi_columns(5, names, n, c);
  rot_energy_output to = {c[0], c[1], c[2], c[3], c[4]};
  rot_energy_partition((size_t)n, &in, &to);
  UNPROTECT(1);
  return out;
}
