/* Bodies that roll down an incline: ./rolling [angle_deg [height_m [beta...]]] */
#include <rotdyn.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char *argv[]) {
  static const double five[] = {1.0, 0.5, 0.4, 2.0 / 3.0,
                                0.0}; /* hoop, disk, sphere, shell, sliding */
  const double angle_deg = argc > 1 ? atof(argv[1]) : 20.0;
  const double height_m = argc > 2 ? atof(argv[2]) : 1.0;
  const int n = argc > 3 ? argc - 3 : 5;
  puts("beta,acceleration_m_per_s2,final_speed_m_per_s,rotational_energy_fraction,friction");
  for (int i = 0; i < n; i++) {
    const double beta = argc > 3 ? atof(argv[i + 3]) : five[i];
    printf("%.17g,%.17g,%.17g,%.17g,%.17g\n", beta,
           rotdyn_rolling_acceleration(beta, angle_deg, 9.80665),
           rotdyn_rolling_final_speed(beta, height_m, 9.80665),
           rotdyn_rolling_rotational_fraction(beta), rotdyn_rolling_friction(beta, angle_deg));
  }
  return 0;
}
