/* Translational and rotational kinetic energy of a rolling body (Koenig's theorem). */
#ifndef ROT_ENERGY_H
#define ROT_ENERGY_H

#include <stddef.h>

#include "ground/column.h"

typedef struct rot_energy_input {
  rot_column mass_kg, radius_m, beta, speed_m_per_s;
} rot_energy_input;

typedef struct rot_energy_output {
  double *inertia_kg_m2, *omega_rad_per_s, *translational_j, *rotational_j, *total_j;
} rot_energy_output;

/* n rows => moment of inertia, angular velocity, energies of each */
void rot_energy_partition(size_t n, const rot_energy_input *in, const rot_energy_output *out);

#endif
