# What one small call costs, beside a bare closure with the same formula where there is one. The
# closure checks nothing, knows no units and returns plain numbers: the ratio is the price of that.

run_calls <- function(rounds) {
  knots_s <- c(0, 1, 4, 6, 8)
  knots_n_m <- c(0, 0.8, 0.8, 0, 0)
  disk <- rotdyn::body_disk(2, 0.25)
  knots <- rotdyn::torque_knots(knots_s, knots_n_m)
  damping <- rotdyn::resistance(spin_viscous)
  scene <- spin_scene()
  motion <- rotdyn::trajectory(scene, spin_times)
  objects <- rotdyn::rolling_table()[c("object", "beta")]
  g <- 9.80665

  one <- function(case, ours, plain = NULL) {
    contenders <- c(
      list(contender("rotdyn", ours)),
      if (!is.null(plain)) list(contender("base R", plain))
    )
    paired("calls", case, contenders, rounds, batch_us = 5e3)
  }
  rbind(
    one(
      "body_disk(2, 0.25)",
      function() rotdyn::body_disk(2, 0.25),
      function() diag(c(0.25, 0.25, 0.5) * 2 * 0.25^2)
    ),
    one("torque_knots(), 5 knots", function() rotdyn::torque_knots(knots_s, knots_n_m)),
    one("resistance(0.03)", function() rotdyn::resistance(0.03)),
    one("scene_axle(), parts given", function() rotdyn::scene_axle(disk, knots, damping)),
    one("trajectory(), 1 row", function() rotdyn::trajectory(scene, 8)),
    one("choose_model(), 1 row", function() rotdyn::choose_model(scene, 8)),
    one("summary(), 1000 rows", function() summary(motion)),
    one("audit(), 1000 rows", function() rotdyn::audit(motion)),
    one(
      "rolling_acceleration(0.5, 20)",
      function() rotdyn::rolling_acceleration(0.5, 20),
      function() g * sin(20 * pi / 180) / (1 + 0.5)
    ),
    one(
      "rolling_table(), 5 rows",
      function() rotdyn::rolling_table(objects),
      function() {
        with(objects, data.frame(
          object, beta,
          acceleration_m_per_s2 = g * sin(20 * pi / 180) / (1 + beta),
          final_speed_m_per_s = sqrt(2 * g * 1 / (1 + beta)),
          rotational_energy_fraction = beta / (1 + beta),
          translational_energy_fraction = 1 / (1 + beta)
        ))
      }
    ),
    one("inertia_table(), standard shapes", function() rotdyn::inertia_table()),
    one(
      "energy_partition(0.5, 3, mass_kg = 1, radius_m = 0.1)",
      function() rotdyn::energy_partition(0.5, 3, mass_kg = 1, radius_m = 0.1),
      function() {
        data.frame(
          moment_of_inertia_kg_m2 = 0.5 * 1 * 0.1^2,
          omega_rad_per_s = 3 / 0.1,
          translational_kinetic_energy_j = 0.5 * 1 * 3^2,
          rotational_kinetic_energy_j = 0.5 * 0.5 * 1 * 3^2,
          total_kinetic_energy_j = 0.5 * (1 + 0.5) * 1 * 3^2,
          rotational_energy_fraction = 0.5 / (1 + 0.5)
        )
      }
    )
  )
}
