#include "tables/energy.h"

#include "ground/real.h"

void rot_energy_partition(size_t n, const rot_energy_input *in, const rot_energy_output *out) {
  for (size_t i = 0; i < n; i++) {
    const double m = rot_at(in->mass_kg, i), r = rot_at(in->radius_m, i),
                 beta = rot_at(in->beta, i), v = rot_at(in->speed_m_per_s, i);
    const double translational = rot_product(4, (double[]){0.5, m, v, v}, 1.0);
    out->inertia_kg_m2[i] = rot_product(4, (double[]){beta, m, r, r}, 1.0);
    out->omega_rad_per_s[i] = v / r;
    out->translational_j[i] = translational;
    out->rotational_j[i] = beta * translational;
    out->total_j[i] = (1.0 + beta) * translational;
    if (!(translational > 1e-290 && translational < 1e290)) { /* times beta it may be in range */
      out->rotational_j[i] = rot_product(5, (double[]){0.5, beta, m, v, v}, 1.0);
      out->total_j[i] = rot_product(5, (double[]){0.5, 1.0 + beta, m, v, v}, 1.0);
    }
  }
}
