// A disk under a torque that rises, is constant and falls: ./spin_up [mass_kg [radius_m [viscous]]]
// The model is the cheapest that reaches the accuracy; its name and error go to standard error.
#include <rotdyn.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char *argv[]) {
  const double mass = argc > 1 ? std::atof(argv[1]) : 2.0;
  const double radius = argc > 2 ? std::atof(argv[2]) : 0.25;
  const std::vector<double> knots = {0, 1, 4, 6, 8}, torque = {0, 0.8, 0.8, 0, 0};
  rotdyn_moments disk = ROTDYN_INIT(rotdyn_moments);
  if (rotdyn_shape_moments("disk", mass, 1, &radius, &disk) != ROTDYN_OK) {
    std::fprintf(stderr, "mass and radius must not be negative\n");
    return 1;
  }
  rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);
  axle.inertia_kg_m2 = disk.izz_kg_m2;
  axle.viscous_n_m_s = argc > 3 ? std::atof(argv[3]) : 0.03;
  axle.n_knots = knots.size();
  axle.knot_time_s = knots.data();
  axle.knot_torque_n_m = torque.data();

  const std::size_t n = 801;
  std::vector<double> time(n), theta(n), omega(n), energy(n);
  for (std::size_t i = 0; i < n; i++) time[i] = double(i) / 100.0;
  rotdyn_axle_columns out = ROTDYN_INIT(rotdyn_axle_columns);
  out.theta_rad = theta.data();
  out.omega_rad_per_s = omega.data();
  out.rotational_kinetic_energy_j = energy.data();
  rotdyn_info info = ROTDYN_INIT(rotdyn_info);
  const int status = rotdyn_axle_rows(&axle, n, time.data(), nullptr, &out, &info);
  if (status != ROTDYN_OK) {
    std::fprintf(stderr, "%s: %s\n", rotdyn_status_text(status), info.reason);
    return 1;
  }
  std::fprintf(stderr, "model %s, error %s %.2g\n", info.model,
               info.error_is_bound ? "at most" : "about", info.error);
  std::puts("time_s,theta_rad,omega_rad_per_s,rotational_kinetic_energy_j");
  for (std::size_t i = 0; i < n; i++) {
    std::printf("%.17g,%.17g,%.17g,%.17g\n", time[i], theta[i], omega[i], energy[i]);
  }
}
