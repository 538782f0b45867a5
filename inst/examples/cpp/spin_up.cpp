// A disk under a torque that rises, is constant and falls: ./spin_up [mass_kg [radius_m [viscous]]]
// The model is the cheapest that reaches the accuracy; its name and error go to standard error.
#include <rotdyn.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

// An object that is freed, and what is wrong with it, if anything is.
struct Object {
  std::unique_ptr<rotdyn_object, void (*)(rotdyn_object *)> own;
  explicit Object(const char *constructor)
      : own(rotdyn_object_new(constructor), rotdyn_object_free) {}
  Object &set(const char *input, double value) {
    return done(rotdyn_set_number(own.get(), input, value), input);
  }
  Object &set(const char *input, const std::vector<double> &values) {
    return done(rotdyn_set_numbers(own.get(), input, values.size(), values.data()), input);
  }
  Object &set(const char *input, const Object &value) {
    return done(rotdyn_set_object(own.get(), input, value.own.get()), input);
  }
  Object &done(int status, const char *input) {
    if (status != ROTDYN_OK) std::fprintf(stderr, "%s: %s\n", input, rotdyn_status_text(status));
    return *this;
  }
};

int main(int argc, char *argv[]) {
  Object disk("body_disk"), torque("torque_knots"), resistance("resistance"), scene("scene_axle");
  disk.set("mass_kg", argc > 1 ? std::atof(argv[1]) : 2.0);
  disk.set("radius_m", argc > 2 ? std::atof(argv[2]) : 0.25);
  torque.set("time_s", {0, 1, 4, 6, 8}).set("torque_n_m", {0, 0.8, 0.8, 0, 0});
  resistance.set("viscous_n_m_s", argc > 3 ? std::atof(argv[3]) : 0.03);
  scene.set("body", disk).set("torque", torque).set("resistance", resistance);

  const std::size_t n = 801;
  std::vector<double> time(n), theta(n), omega(n), energy(n);
  for (std::size_t i = 0; i < n; i++) time[i] = double(i) / 100.0;
  const char *const names[] = {"theta_rad", "omega_rad_per_s", "rotational_kinetic_energy_j"};
  double *const columns[] = {theta.data(), omega.data(), energy.data()};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const int status = rotdyn_scene_run(scene.own.get(), n, time.data(), nullptr, n, 3, names,
                                      columns, &report);
  if (status != ROTDYN_OK) {
    std::fprintf(stderr, "%s: %s %s\n", rotdyn_status_text(status),
                 report.input ? report.input : "", report.reason);
    return 1;
  }
  std::fprintf(stderr, "model %s, error %s %.2g\n", report.model,
               report.error_is_bound ? "at most" : "about", report.error);
  std::puts("time_s,theta_rad,omega_rad_per_s,rotational_kinetic_energy_j");
  for (std::size_t i = 0; i < n; i++) {
    std::printf("%.17g,%.17g,%.17g,%.17g\n", time[i], theta[i], omega[i], energy[i]);
  }
}
