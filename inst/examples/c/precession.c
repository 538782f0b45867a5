/* Gyroscopes with a horizontal axis: ./precession [mass_kg lever_m axial_kg_m2 spin]... */
#include <rotdyn.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char *argv[]) {
  static const double three[][4] = {
      {0.5, 0.08, 0.002, 500.0}, {1.0, 0.1, 0.006, 300.0}, {2.0, 0.12, 0.02, 120.0}};
  const int n = argc > 4 ? (argc - 1) / 4 : 3;
  puts("mass_kg,gravity_torque_n_m,spin_angular_momentum_kg_m2_per_s,precession_rad_per_s,"
       "precession_period_s");
  for (int i = 0; i < n; i++) {
    rotdyn_top top = ROTDYN_INIT(rotdyn_top);
    rotdyn_top_rates rates = ROTDYN_INIT(rotdyn_top_rates);
    double x[4];
    for (int k = 0; k < 4; k++) x[k] = argc > 4 ? atof(argv[4 * i + k + 1]) : three[i][k];
    top.mass_kg = x[0];
    top.lever_arm_m = x[1];
    top.axial_kg_m2 = x[2];
    top.spin_rad_per_s = x[3];
    top.axis_angle_deg = 90.0;
    top.gravity_m_per_s2 = 9.80665;
    const int status = rotdyn_precession_rates(&top, &rates);
    if (status != ROTDYN_OK) {
      fprintf(stderr, "gyroscope %d: %s\n", i + 1, rotdyn_status_text(status));
      return 1;
    }
    printf("%.17g,%.17g,%.17g,%.17g,%.17g\n", x[0], rates.torque_n_m, rates.momentum_kg_m2_per_s,
           rates.precession_rad_per_s, rates.period_s);
  }
  return 0;
}
